"""Marks of runs that broke a promise, in tables of text and of pages."""

import pathlib
import tempfile
import unittest

from culm.footnotes import Footnotes
from culm.history import History
from culm.page import Page


class FootnotesTest(unittest.TestCase):
    def test_sentences_are_numbered_once(self):
        notes = Footnotes()
        self.assertEqual(notes.mark([]), "")
        self.assertEqual(notes.mark(["a", "b"]), "BROKEN [1, 2]")
        self.assertEqual(notes.mark(["b"]), "BROKEN [2]")
        self.assertEqual(notes.lines, ["[1] a", "[2] b"])

    def test_a_page_has_broken_rows_in_red(self):
        page = Page("title")
        page.table(["run"], [["good"], ["bad"]], [1])
        self.assertIn("<tr><td>good</td></tr>\n<tr class=\"broken\"><td>bad</td></tr>", page.parts[-1])

    def test_an_empty_cell_is_no_number(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "history.csv"
            path.write_text("time,F [N],analysis,step\n0,,0,0\n1,0,0,1\n")
            first, last = History(path).column("F [N]")
        self.assertNotEqual(first, first)  # nan
        self.assertEqual(last, 0.0)


if __name__ == "__main__":
    unittest.main()
