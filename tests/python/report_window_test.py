#!/usr/bin/env python3
"""The window of the statistics on the page of a run."""

import types
import unittest

from culm import report
from culm.errors import CulmError
from culm.quantities import begins_unsolved
from culm.resolved_deck import ResolvedDeck


class Page:
    def __init__(self):
        self.paragraphs, self.rows, self.least = [], [], []

    def heading(self, text):
        pass

    def paragraph(self, text, kind=None):
        self.paragraphs.append(text)

    def table(self, columns, rows):
        self.rows += [row[0] for row in rows]
        self.least += [row[2] for row in rows]


HISTORY = types.SimpleNamespace(
    names=["tip [m]", "gone [N]", "foot Fx [N]"],
    levels=[0.0, 0.5, 1.0, 0.0, 1.0, 2.0, 3.0],
    steps=[0, 1, 2, 0, 1, 2, 3],
    columns={
        "tip [m]": [0.0, 1.0, 2.0, 2.0, 3.0, 5.0, 4.0], "gone [N]": [0.0, 1.0, 2.0, 2.0, float("nan"), 1.0, 1.0],
        "foot Fx [N]": [0.0, 1.0, 2.0, 0.0, 9.0, 8.0, 9.0],
    },
)
PARTS = [("up", "Static", slice(0, 3)), ("swing", "Dynamic", slice(3, 7))]


def entry(name, **values):
    return f'<ParameterList name="{name}">' + "".join(
        f'<Parameter name="{key}" value="{value}"/>' for key, value in values.items()) + "</ParameterList>"


DECK = ResolvedDeck(
    '<ParameterList name="culm"><ParameterList name="Signals">' + entry("speed", Type="Velocity") + entry("angle", Type="Integral")
    + '</ParameterList><ParameterList name="Loads">' + entry("oil", Type="Damper") + entry("coil", Type="Spring")
    + '</ParameterList><ParameterList name="Output"><ParameterList name="History">' + entry("foot", Type="Reaction")
    + entry("speed", Type="Signal", Signal="speed") + entry("angle", Type="Signal", Signal="angle")
    + entry("oil", Type="Link", Load="oil") + entry("coil", Type="Link", Load="coil")
    + entry("tip", Type="Displacement") + entry("gone", Type="Fluid Force")
    + "</ParameterList></ParameterList></ParameterList>"
)


class Starts(unittest.TestCase):
    def test_what_belongs_to_steps_has_none(self):
        columns = [("foot", "Fx"), ("speed", ""), ("angle", ""), ("oil", "elongation"), ("oil", "F"), ("coil", "F"), ("tip", "ux")]
        unsolved = [column for column in columns if begins_unsolved(*column, DECK)]
        self.assertEqual(unsolved, [("foot", "Fx"), ("speed", ""), ("oil", "F")])


class Window(unittest.TestCase):
    def page(self, window, parts=PARTS):
        page = Page()
        report._add_statistics(page, HISTORY, parts, window, DECK)
        return page

    def test_leaves_out_the_start_of_what_belongs_to_steps(self):
        page = self.page(None)
        self.assertEqual(dict(zip(page.rows, page.least)), {"tip [m]": "2", "foot Fx [N]": "8"})

    def test_takes_the_part_of_the_motion(self):
        page = self.page((1.5, 9.0))
        self.assertEqual(page.rows, ["tip [m]", "gone [N]", "foot Fx [N]"])
        self.assertIn("swing, from 2 to 3 s:", page.paragraphs)

    def test_names_what_is_not_there_all_the_time(self):
        page = self.page(None)
        self.assertEqual(page.rows, ["tip [m]", "foot Fx [N]"])
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
