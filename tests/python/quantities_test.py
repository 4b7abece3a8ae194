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
            self.assertEqual(resolved.files(deck), {"tables/x.csv": folder / "include/tables/x.csv", "y.csv": folder / "y.csv"})


if __name__ == "__main__":
    unittest.main()
