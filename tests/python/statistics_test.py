"""Ranges are counted as the standard counts them; statistics are those of histories with closed forms."""

import math
import pathlib
import tempfile
import unittest

import numpy as np

from culm import report, statistics
from culm.history import History
from culm.page import Page
from culm.resolved_deck import ResolvedDeck


class Rainflow(unittest.TestCase):
    def test_the_example_of_the_standard(self):
        # ASTM E1049-85, figure 6
        counts = {}
        for size, count in statistics.rainflow([-2, 1, -3, 5, -1, 3, -4, 4, -2]):
            counts[size] = counts.get(size, 0.0) + count
        self.assertEqual(counts, {3: 0.5, 4: 1.5, 6: 0.5, 8: 1.0, 9: 0.5})

    def test_points_on_the_way_and_plateaus_do_not_count(self):
        self.assertEqual(statistics.reversals([0, 1, 2, 2, 3, 1, 1, 1, 2]), [0, 3, 1, 2])
        self.assertEqual(statistics.rainflow([1.0, 1.0, 1.0]), [])

    def test_a_small_cycle_within_a_large_one_is_found(self):
        # 0 to 10 and back, interrupted by 6 to 5: one whole cycle of 1, two halves of 10
        found = sorted(statistics.rainflow([0, 6, 5, 10, 0]))
        self.assertEqual(found, [(1, 1.0), (10, 0.5), (10, 0.5)])

    def test_ranges_add_up_to_the_way(self):
        values = np.random.default_rng(1).normal(size=500).tolist()
        way = sum(2.0 * size * count for size, count in statistics.rainflow(values))
        self.assertAlmostEqual(way, np.abs(np.diff(values)).sum(), places=9)


class Statistics(unittest.TestCase):
    def test_a_sine(self):
        times = np.linspace(0.0, 20.0, 4001)
        found = statistics.of_column(times, 3.0 + 2.0 * np.sin(2.0 * np.pi * 0.5 * times))
        self.assertAlmostEqual(found.mean, 3.0, places=9)
        self.assertAlmostEqual(found.deviation, math.sqrt(2.0), places=5)
        self.assertAlmostEqual(found.least, 1.0, places=9)
        self.assertAlmostEqual(found.largest, 5.0, places=9)
        for exponent in statistics.EXPONENTS:
            # 9.5 cycles of 4 and two halves of 2, over 20 s at 1 Hz
            wanted = ((9.5 * 4.0**exponent + 2.0**exponent) / 20.0) ** (1.0 / exponent)
            self.assertAlmostEqual(found.equivalents[exponent], wanted, places=9)

    def test_means_are_over_time(self):
        found = statistics.of_column([0.0, 1.0, 4.0], [0.0, 2.0, 2.0])
        self.assertAlmostEqual(found.mean, 7.0 / 4.0)
        self.assertEqual(statistics.of_column([0.0, 1.0], [5.0, 5.0]).equivalents[4], 0.0)

    def test_of_too_little(self):
        for times, values in (([], []), ([1.0], [2.0]), ([0.0, 1.0], [2.0])):
            with self.assertRaisesRegex(ValueError, "need at least 2 times"):
                statistics.of_column(times, values)


class PageOfARun(unittest.TestCase):
    def table(self, window):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "history.csv"
            path.write_text("time,tip uz [m],load [N],analysis,step\n0,0,,0,1\n1,4,1,0,2\n2,0,1,0,3\n3,4,1,0,4\n4,8,1,0,5\n")
            page = Page("title")
            parts = [("weight", "Static", slice(0, 1)), ("motion", "Dynamic", slice(0, 5))]
            report._add_statistics(page, History(path), parts, window, ResolvedDeck("<ParameterList/>"))
            return "".join(page.parts[1:])

    def test_it_has_a_row_for_each_column_that_is_there_all_the_time(self):
        text = self.table(None)
        self.assertIn("motion, from 0 to 4 s:", text)
        self.assertIn("<tr><td>tip uz [m]</td><td>3</td><td>0</td><td>8</td>", text)
        self.assertNotIn("<td>load [N]", text)
        self.assertNotIn("weight", text)

    def test_a_window_leaves_out_the_rest(self):
        text = self.table((2.0, 4.0))
        self.assertIn("motion, from 2 to 4 s:", text)
        self.assertIn("<tr><td>tip uz [m]</td><td>4</td><td>0</td><td>8</td>", text)
        self.assertIn("<tr><td>load [N]</td><td>1</td><td>1</td><td>1</td><td>0</td><td>0</td><td>0</td>", text)


if __name__ == "__main__":
    unittest.main()
