#!/usr/bin/env python3
"""Numbers of the command line: what each kind takes, and the words for what it does not."""

import argparse
import unittest

from culm import effects, hard, report, study, sweep, view
from culm.importing import gmsh
from culm.option_types import at_least_one, finite, positive


class Numbers(unittest.TestCase):
    def test_takes(self):
        self.assertEqual(positive("1e-3"), 1e-3)
        self.assertEqual(finite("-2"), -2.0)
        self.assertEqual(at_least_one("007"), 7)

    def refused(self, kind, texts, words):
        for text in texts:
            with self.assertRaisesRegex(argparse.ArgumentTypeError, f"{words}, got '{text}'"):
                kind(text)

    def test_refuses(self):
        self.refused(positive, ("0", "-1"), "needs a number above 0")
        for kind in (positive, finite):
            self.refused(kind, ("nan", "inf", "-inf", "1e999", "five", ""), "needs a finite number")
        self.refused(at_least_one, ("0", "-1", "1.5", "many", ""), "needs a whole number from 1 on")


class Options(unittest.TestCase):
    """Which options refuse what is no number of theirs."""

    def test_refuse(self):
        for verb, words, option, wrong in (
            (effects, ["deck.xml"], "--accuracy", "-1"),
            (effects, ["deck.xml"], "--accuracy", "nan"),
            (effects, ["deck.xml"], "--accuracy", "0"),
            (study, ["deck.xml", "--vary", "mesh=1"], "--repeat", "0"),
            (study, ["deck.xml", "--vary", "mesh=1"], "--time-limit", "nan"),
            (sweep, ["deck.xml"], "--time-limit", "-1"),
            (hard, [], "--time-limit", "0"),
            (view, ["results"], "--states", "0"),
            (report, ["results", "--window", "0"], None, "nan"),
            (gmsh, [], "--thickness", "-0.1"),
        ):
            with self.subTest(verb=verb.__name__, option=option):
                parser = argparse.ArgumentParser(exit_on_error=False)
                verb.declare(parser)
                with self.assertRaises(argparse.ArgumentError):
                    parser.parse_args([*words, *([option] if option else []), wrong])


if __name__ == "__main__":
    unittest.main()
