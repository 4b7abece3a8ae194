#!/usr/bin/env python3
"""The window of the statistics on the page of a run."""

import types
import unittest

from culm import report
from culm.errors import CulmError


class Page:
    def __init__(self):
        self.paragraphs, self.rows = [], []

    def heading(self, text):
        pass

    def paragraph(self, text, kind=None):
        self.paragraphs.append(text)

    def table(self, columns, rows):
        self.rows += [row[0] for row in rows]


HISTORY = types.SimpleNamespace(
    names=["tip [m]", "gone [N]"],
    levels=[0.0, 0.5, 1.0, 0.0, 1.0, 2.0, 3.0],
    steps=[0, 1, 2, 0, 1, 2, 3],
    columns={"tip [m]": [0.0, 1.0, 2.0, 2.0, 3.0, 5.0, 4.0], "gone [N]": [0.0, 1.0, 2.0, 2.0, float("nan"), 1.0, 1.0]},
)
PARTS = [("up", "Static", slice(0, 3)), ("swing", "Dynamic", slice(3, 7))]


class Window(unittest.TestCase):
    def page(self, window, parts=PARTS):
        page = Page()
        report._add_statistics(page, HISTORY, parts, window)
        return page

    def test_takes_the_part_of_the_motion(self):
        page = self.page((1.5, 9.0))
        self.assertEqual(page.rows, ["tip [m]", "gone [N]"])
        self.assertIn("swing, from 2 to 3 s:", page.paragraphs)

    def test_names_what_is_not_there_all_the_time(self):
        page = self.page(None)
        self.assertEqual(page.rows, ["tip [m]"])
        self.assertIn("Not there all the time, so without a line: gone [N].", page.paragraphs)

    def test_refuses_one_without_motion(self):
        with self.assertRaisesRegex(CulmError, "--window 5 6: holds less than two steps of a motion; 'swing' goes from 0 to 3 s"):
            self.page((5.0, 6.0))
        with self.assertRaisesRegex(CulmError, "; the run has none"):
            self.page((0.0, 1.0), PARTS[:1])

    def test_says_nothing_without_motion_and_window(self):
        self.assertEqual(self.page(None, PARTS[:1]).paragraphs, [])


if __name__ == "__main__":
    unittest.main()
