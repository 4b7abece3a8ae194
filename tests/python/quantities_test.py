"""Histories are compared where both have what is watched, and files are found where includes name them."""

import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import culm
from culm import quantities
from culm.errors import CulmError
from culm.history import History, name_of, owners_of, unit_of
from culm.resolved_deck import ResolvedDeck


def history(rows):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "history.csv"
        path.write_text("time,rotor thrust [N]\n" + "".join(f"{time},{value}\n" for time, value in rows))
        return History(path)


class Names(unittest.TestCase):
    def test_statistics_come_with_the_package(self):
        subprocess.run([sys.executable, "-c", "import culm; culm.statistics.of_column([0, 1], [2, 3])"], check=True)

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

    def test_a_reference_covers_what_the_runs_cover(self):
        run = history([(0, 1), (1, 2), (2, 3)])
        quantities.refuse_other_span(history([(0, 1), (0.5, 1), (2, 3)]), run)
        for other in ([(0, 1), (1, 2)], [(0, 1), (2, 2), (4, 3)], [(0, 1)], [(1, 2), (2, 3)], []):
            with self.assertRaisesRegex(CulmError, "--reference: its history"):
                quantities.refuse_other_span(history(other), run)

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


    def test_a_line_without_its_end_is_left_out(self):
        text = "time,tip [m],analysis,step\n0,1,0,0\n0.5,2,0,1\n"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "history.csv"
            for last in ("1.0,3", "1.0,3,0,", "1.0,3,0,2"):
                path.write_text(text + last)
                self.assertEqual(History(path).levels, [0.0, 0.5])
                self.assertEqual(culm.history(folder)["tip [m]"].tolist(), [1.0, 2.0])
            path.write_text(text + "1.0,3\n")
            with self.assertRaisesRegex(CulmError, "line 4: not 4 numbers"):
                History(path)


class Owners(unittest.TestCase):
    def owners(self, columns, *quantities):
        found = owners_of(columns, quantities)
        return [found[column] for column in columns]

    def test_names_that_begin_alike(self):
        columns = ["tip ux [m]", "tip uy [m]", "tip ux ux [m]", "tip ux uy [m]", "tip uz [1]", "tip root Fx [N]", "tip root Fy [N]"]
        self.assertEqual(
            self.owners(columns, "tip", "tip ux", "tip uz", "tip root"),
            [("tip", "ux"), ("tip", "uy"), ("tip ux", "ux"), ("tip ux", "uy"), ("tip uz", ""), ("tip root", "Fx"), ("tip root", "Fy")])
        columns = ["a [m]", "a b x [m]", "a b y [m]", "a c [m]"]
        self.assertEqual(self.owners(columns, "a", "a b", "a c"), [("a", ""), ("a b", "x"), ("a b", "y"), ("a c", "")])

    def test_components_of_two_words(self):
        columns = ["strip alpha [rad]", "strip alpha E [rad]", "strip V [m/s]", "strip alpha ux [m]", "strip alpha uy [m]"]
        self.assertEqual(
            self.owners(columns, "strip", "strip alpha"),
            [("strip", "alpha"), ("strip", "alpha E"), ("strip", "V"), ("strip alpha", "ux"), ("strip alpha", "uy")])

    def test_brackets_in_names(self):
        columns = ["tip [left] ux [m]", "tip [left] uy [m]"]
        self.assertEqual(self.owners(columns, "tip [left]"), [("tip [left]", "ux"), ("tip [left]", "uy")])
        self.assertEqual([name_of(columns[0]), unit_of(columns[0])], ["tip [left] ux", "m"])
        self.assertEqual([name_of("step"), unit_of("step")], ["step", ""])

    def test_of_many(self):
        """Of ten thousand entries, each asked for its columns: a look at all of them for each would take minutes."""
        names = [f"node {i}" for i in range(10000)]
        deck = ResolvedDeck(
            '<ParameterList name="culm"><ParameterList name="Output"><ParameterList name="History">'
            + "".join(f'<ParameterList name="{name}"><Parameter name="Type" value="Position"/></ParameterList>' for name in names)
            + "</ParameterList></ParameterList></ParameterList>")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "history.csv"
            path.write_text(",".join(["time", *(f"{name} {x} [m]" for name in names for x in "xyz")]) + "\n")
            read = History(path)
        start = time.process_time()
        columns = [one.columns(read) for one in quantities.parse(names, deck)]
        self.assertLess(time.process_time() - start, 10.0)
        self.assertEqual(columns[1], {"node 1": ["node 1 x [m]", "node 1 y [m]", "node 1 z [m]"]})
        self.assertEqual(sum(len(found[name]) for name, found in zip(names, columns)), 30000)

    def test_of_another_deck(self):
        self.assertEqual(self.owners(["tip ux [m]", "foot Fx [N]", "x [1]"], "foot", "tip"), [("tip", "ux"), ("foot", "Fx"), ("x", "")])

    def test_all_that_an_entry_has_is_watched(self):
        deck = ResolvedDeck(
            '<ParameterList name="culm"><ParameterList name="Output"><ParameterList name="History">'
            + "".join(f'<ParameterList name="{name}"><Parameter name="Type" value="{type}"/></ParameterList>'
                      for name, type in (("strip", "Strip"), ("strip V", "Displacement")))
            + "</ParameterList></ParameterList></ParameterList>")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "history.csv"
            path.write_text("time,strip alpha [rad],strip alpha E [rad],strip V [m/s],strip V ux [m],strip V uy [m]\n0,1,2,3,4,5\n")
            names = ("strip", "strip V", "strip/alpha E", "strip/V", "strip V/ux")
            columns = {one.name: one.columns(History(path)) for one in quantities.parse(names, deck)}
        self.assertEqual(columns["strip"], {"strip [rad]": ["strip alpha [rad]", "strip alpha E [rad]"], "strip [m/s]": ["strip V [m/s]"]})
        self.assertEqual(columns["strip V"], {"strip V": ["strip V ux [m]", "strip V uy [m]"]})
        self.assertEqual(columns["strip/alpha E"], {"strip/alpha E": ["strip alpha E [rad]"]})
        self.assertEqual(columns["strip/V"], {"strip/V": ["strip V [m/s]"]})
        self.assertEqual(columns["strip V/ux"], {"strip V/ux": ["strip V ux [m]"]})


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

    def test_other_places_of_files(self):
        """Of files alone, whatever signs their names have; others may be called like them."""
        resolved = ResolvedDeck(
            '<ParameterList><ParameterList name="a"><Parameter name="File Name" value="a &amp; &lt;b&gt;/&quot;ü&quot;.csv"/></ParameterList>'
            '<ParameterList name="b"><Parameter name="File Names" value="{u, wind, w}"/><Parameter name="Flow" value="wind"/></ParameterList>'
            '<ParameterList name="c"><Parameter name="File Name" value="wind"/></ParameterList></ParameterList>')
        moved = ResolvedDeck(resolved.with_files({'a & <b>/"ü".csv': "0_a.csv", "wind": "1_wind"}))
        self.assertEqual(list(moved.parameters.values()), ["0_a.csv", "{u, 1_wind, w}", "wind", "1_wind"])

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
            moved = resolved.with_files({file: f"x/{file}" for file in names})
            self.assertEqual(resolved.files(deck)[0][0], "controller.in")
            for text in ('"x/hull.1"', '"{x/u.bin, x/v.bin}"', '"x/controller.in"'):
                self.assertIn(text, moved)


if __name__ == "__main__":
    unittest.main()
