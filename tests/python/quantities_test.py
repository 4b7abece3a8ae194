"""Histories are compared where both have what is watched, and files are found where includes name them."""

import pathlib
import tempfile
import unittest

import culm
from culm import quantities
from culm.errors import CulmError
from culm.history import History
from culm.resolved_deck import ResolvedDeck


def history(rows):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "history.csv"
        path.write_text("time,rotor thrust [N]\n" + "".join(f"{time},{value}\n" for time, value in rows))
        return History(path)


class Names(unittest.TestCase):
    def test_the_function_outlives_the_import_of_the_module_of_its_name(self):
        self.assertTrue(callable(culm.history) and isinstance(History, type))


class Measures(unittest.TestCase):
    def change(self, a, b, norm="rms"):
        measure = quantities.Measure([quantities.Watched("rotor", "rotor")], norm, [a, b])
        state = measure.state(a)
        measure.refer_to(state)
        return measure.size(measure.state(b) - state)

    def test_what_is_absent_at_the_start_is_left_out(self):
        a = history([(0, ""), (1, 10), (2, 10), (3, 10)])
        b = history([(0, ""), (1, 11), (2, 11), (3, 11)])
        for norm in quantities.NORMS:
            self.assertAlmostEqual(self.change(a, b, norm), 0.1)

    def test_nothing_in_common_is_an_error(self):
        a = history([(0, ""), (1, 10), (2, "")])
        b = history([(0, 1), (1, ""), (2, 10)])
        for norm in quantities.NORMS:
            with self.assertRaisesRegex(CulmError, "at no level"):
                self.change(a, b, norm)


class Histories(unittest.TestCase):
    def test_what_is_absent_is_not_infinite(self):
        self.assertTrue(history([(0, ""), (1, 10)]).is_finite)
        for bad in ("nan", "inf"):
            self.assertFalse(history([(0, ""), (1, bad)]).is_finite)


class Files(unittest.TestCase):
    def test_files_of_includes_are_found_beside_them(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "include/tables").mkdir(parents=True)
            deck = folder / "deck.xml"
            deck.write_text('<ParameterList xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="include/a.xml"/></ParameterList>')
            (folder / "include/a.xml").write_text('<ParameterList/>')
            (folder / "include/tables/x.csv").write_text("1")
            (folder / "y.csv").write_text("2")
            resolved = ResolvedDeck(
                '<ParameterList><ParameterList name="a"><Parameter name="File Name" value="tables/x.csv"/></ParameterList>'
                '<ParameterList name="b"><Parameter name="File Name" value="y.csv"/></ParameterList></ParameterList>')
            self.assertEqual(resolved.files(deck), [("tables/x.csv", folder / "include/tables/x.csv"), ("y.csv", folder / "y.csv")])
            (folder / "include/y.csv").write_text("3")
            self.assertEqual([path.read_text() for _, path in resolved.files(deck)], ["1", "2", "3"])
            with self.assertRaisesRegex(CulmError, "of the name 'y.csv' stand in"):
                resolved.only_files(deck)

    def test_states_of_other_runs_are_found(self):
        with tempfile.TemporaryDirectory() as name:
            run = pathlib.Path(name) / "half"
            run.mkdir()
            (run / "run.checkpoint").write_text("1")
            resolved = ResolvedDeck(
                '<ParameterList><ParameterList name="Analyses"><ParameterList name="weight"/><ParameterList name="motion">'
                f'<Parameter name="Start From" value="{run}"/></ParameterList><ParameterList name="modes">'
                '<Parameter name="Start From" value="weight"/></ParameterList></ParameterList></ParameterList>')
            self.assertEqual(resolved.states(), [run / "run.checkpoint"])

    def test_lists_of_files_and_files_beside_others_are_found(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            deck = folder / "deck.xml"
            names = ["hull.1", "hull.3", "hull.hst", "controller.in", "u.bin", "v.bin"]
            for file in names:
                (folder / file).write_text(file)
            deck.write_text(
                '<ParameterList><ParameterList name="a"><Parameter name="File Name" value="hull.1"/>'
                '<Parameter name="File Names" value="{u.bin, v.bin}"/><Parameter name="Input File" value="controller.in"/>'
                '</ParameterList></ParameterList>')
            resolved = ResolvedDeck(deck.read_text())
            self.assertEqual(resolved.only_files(deck), {file: folder / file for file in names})
            moved = resolved.with_files(resolved.text, {file: f"x/{file}" for file in names})
            self.assertEqual(resolved.files(deck)[0][0], "controller.in")
            for text in ('"x/hull.1"', '"{x/u.bin, x/v.bin}"', '"x/controller.in"'):
                self.assertIn(text, moved)


if __name__ == "__main__":
    unittest.main()
