"""The Pareto front, the sentence, and settings between two runs."""

import pathlib
import tempfile
import types
import unittest

from culm import quantities
from culm.errors import CulmError
from culm.history import History
from culm.resolved_deck import ResolvedDeck
from culm.study import advice
from culm.study.judgement import Point
from culm.study.variation import Axis


def point(index, cpu, error, uncertainty=0.0):
    record = types.SimpleNamespace(cpu=cpu, times=[cpu])
    return Point(index, record, {"tip": error} if error is not None else {}, {}, uncertainty)


class FakeJudgement:
    """Steps 0.4, 0.2, 0.1 of error h^2 that cost 1/h, and what points are given."""

    def __init__(self, points=None):
        self.axes = [Axis("step", ["0.4", "0.2", "0.1"], ["Analyses/motion/Step"], True, True)]
        self.refined = [0]
        points = points or [point((i,), 1.0 / h, h**2) for i, h in enumerate((0.4, 0.2, 0.1))]
        self.points = {one.index: one for one in points}

    def label(self, index):
        return self.axes[0].label(index[0])


class Front(unittest.TestCase):
    def test_leaves_out_what_is_beaten_and_what_failed(self):
        points = [point((0,), 1.0, 0.1), point((1,), 2.0, 0.2), point((2,), 3.0, 0.01), point((3,), None, None)]
        self.assertEqual([p.index for p in advice.front(points)], [(0,), (2,)])

    def test_counts_the_uncertainty_as_error(self):
        points = [point((0,), 1.0, 1e-3, 5e-3), point((1,), 2.0, 1e-4, 5e-3)]
        self.assertEqual([p.index for p in advice.front(points)], [(0,)])
        self.assertFalse(points[0].is_judged)


class Sentence(unittest.TestCase):
    def test_names_the_cheapest_run_of_each_decade(self):
        points = [point((0,), 0.8, 0.02), point((1,), 1.5, 0.008), point((2,), 5.0, 0.0009)]
        self.assertEqual(
            advice.sentence(FakeJudgement(points)),
            "ten per cent costs 0.8 s with step=0.4; one per cent 1.5 s with step=0.2; 0.1 per cent 5 s with step=0.1",
        )

    def test_names_only_the_tightest_of_the_decades_of_a_run(self):
        self.assertEqual(advice.sentence(FakeJudgement([point((0,), 0.5, 2e-3)])), "one per cent costs 0.5 s with step=0.4")

    def test_costs_within_the_spread_are_equal(self):
        points = [point((0,), 0.8, 0.008), point((1,), 0.9, 0.002), point((2,), 1.1, 0.0015)]
        points[0].record.times = [0.7, 0.8, 1.0]
        self.assertEqual(advice.sentence(FakeJudgement(points)), "one per cent costs 0.9 s with step=0.2")

    def test_admits_that_nothing_came_close(self):
        self.assertIn("no run reached ten per cent", advice.sentence(FakeJudgement([point((0,), 0.5, 0.4)])))


class Promises(unittest.TestCase):
    def test_between_two_runs_by_power_laws(self):
        first = advice.promises(FakeJudgement(), 0.1)[0]
        step = float(first.settings[0].partition("=")[2])
        self.assertIsNone(first.index)
        self.assertLess(0.2, step)
        self.assertLess(step, 0.1**0.5)
        self.assertAlmostEqual(first.error, step**2, 12)
        self.assertAlmostEqual(first.cpu, 1.0 / step, 12)

    def test_a_run_that_was_made_where_nothing_is_cheaper(self):
        self.assertEqual(advice.promises(FakeJudgement(), 0.5)[0].index, (0,))

    def test_none_beyond_the_best_run(self):
        self.assertEqual(advice.promises(FakeJudgement(), 1e-3), [])


class Watching(unittest.TestCase):
    DECK = ResolvedDeck(
        """<ParameterList name="culm"><ParameterList name="Output"><ParameterList name="History">
        <ParameterList name="tip"><Parameter name="Type" value="Displacement"/></ParameterList>
        </ParameterList></ParameterList></ParameterList>"""
    )

    def test_entries_components_types_and_drifts(self):
        for name, entry, component, drift in (
            ("tip", "tip", None, None),
            ("tip/uz", "tip", "uz", None),
            ("tip/displacement", "tip", None, None),
            ("energy", None, None, "energy drift"),
            ("momentum drift", None, None, "momentum drift"),
        ):
            (found,) = quantities.parse([name], self.DECK)
            self.assertEqual((found.entry, found.component, found.drift), (entry, component, drift), name)

    def test_of_what_is_not_there(self):
        with self.assertRaisesRegex(CulmError, "did you mean 'tip'"):
            quantities.parse(["tipp"], self.DECK)

    def test_by_which_option(self):
        with self.assertRaisesRegex(CulmError, "--hold-out tipp: no quantity"):
            quantities.parse(["tipp"], self.DECK, "--hold-out")
        (found,) = quantities.parse(["tip/q"], self.DECK, "--hold-out")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "history.csv"
            path.write_text("time,tip ux [m]\n0,1\n")
            with self.assertRaisesRegex(CulmError, "--hold-out tip/q: no component 'q'"):
                found.columns(History(path))

    def test_worst_drift_of_all_analyses(self):
        scalars = {"relative energy drift": 1e-12, "stop: relative energy drift": -3e-9, "iterations": 7.0}
        self.assertEqual(quantities.drift(scalars, "energy drift"), 3e-9)
        self.assertIsNone(quantities.drift(scalars, "momentum drift"))


if __name__ == "__main__":
    unittest.main()
