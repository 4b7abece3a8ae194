"""Which decks run on several ranks: few, but with everything that decks contain."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
from parallel_decks import choose, contents, decks, read_costs  # noqa: E402


class Choice(unittest.TestCase):
    def test_covers_everything(self):
        sets = {"a": {1, 2, 3}, "b": {3, 4}, "c": {4, 5}, "d": {1}}
        chosen = choose(sets, lambda name: 1.0)
        self.assertEqual(set().union(*(sets[name] for name in chosen)), {1, 2, 3, 4, 5})
        self.assertEqual(sorted(chosen), ["a", "c"])

    def test_prefers_what_is_cheap(self):
        sets = {"long": {1, 2}, "short": {1}, "other": {2}}
        cost = {"long": 100.0, "short": 1.0, "other": 1.0}
        self.assertEqual(sorted(choose(sets, cost.get)), ["other", "short"])

    def test_drops_what_later_choices_contain(self):
        sets = {"first": {1, 2, 3, 4}, "left": {1, 2, 5, 6, 7}, "right": {3, 4, 8, 9, 10}}
        cost = {"first": 1.0, "left": 1.5, "right": 1.5}
        self.assertEqual(sorted(choose(sets, cost.get)), ["left", "right"])


class Decks(unittest.TestCase):
    def test_all_that_decks_contain_runs_in_parallel(self):
        contains = {name: contents(name) for name in decks()}
        chosen = choose(contains, lambda name: read_costs()[name.replace("/", ".")])
        covered = set().union(*(contains[name] for name in chosen))
        self.assertEqual(set().union(*contains.values()) - covered, set())
        self.assertLess(len(chosen), len(contains) / 2)

    def test_contents_are_found_in_included_parts_and_without_names(self):
        found = contents("turbine/nrel5mw/turbine_operation")
        self.assertIn("Sections: Type = Stiffness Matrix", found)
        self.assertIn("Constraints: Type = Revolute Joint", found)
        self.assertFalse([one for one in found if one.startswith("Title")])
        # a variant that must fail
        self.assertIn("failure with exit code 4", contents("beam/roll_up") | contents("shell/folded_over"))


if __name__ == "__main__":
    unittest.main()
