"""What is said of runs: faults, failures, broken laws, wrong results."""

import math
import types
import unittest

from culm.hard import judge

DIAGNOSED = "No equilibrium.\nLikely cause: a limit point. At level 0.5\nTry: a path.\n"


class History:
    def __init__(self, **columns):
        self.columns = columns
        self.is_finite = all(math.isfinite(value) for values in columns.values() for value in values)

    def column(self, name):
        return self.columns[name]

    def vector(self, quantity):
        return [values[-1] for name, values in self.columns.items() if name.startswith(quantity)]


class Results:
    def __init__(self, positions=(0.0, 1.0), report="failed", **scalars):
        self._positions = positions
        self._report = report
        self._scalars = scalars

    def scalars(self):
        return self._scalars

    def report(self):
        return self._report

    def last_state(self):
        return 0.5, {"beam": types.SimpleNamespace(flat=self._positions)}


def run(exit_code=0, errors="", output="", history=None, results=None, outcome="some outcome"):
    return types.SimpleNamespace(
        exit=exit_code,
        errors=errors,
        output=output,
        history=history or History(x=[0.0, 1.0]),
        results=results or Results(),
        outcome=outcome,
    )


def verdict(one, *checks, stress=1.0, reference=None):
    return judge.judge(judge.Evidence(one, stress, reference), checks)


class FaultTest(unittest.TestCase):
    def assert_faulty(self, one, words):
        found = verdict(one)
        self.assertEqual(found.kind, judge.FAULTY)
        self.assertIn(words, found.how)
        self.assertFalse(found.told)

    def test_a_run_that_is_killed_hangs_or_is_a_bug(self):
        for exit_code in (None, -11, 1, 2, 6):
            self.assert_faulty(run(exit_code, outcome="how it ended"), "how it ended")

    def test_a_number_that_is_not_finite(self):
        for bad in (math.nan, math.inf):
            self.assert_faulty(run(history=History(x=[0.0, bad])), "history.csv")
            self.assert_faulty(
                run(4, DIAGNOSED, results=Results(positions=(0.0, bad))), "state is not finite"
            )

    def test_a_failure_without_advice(self):
        self.assert_faulty(run(4, "It failed.\n"), "no diagnosis")

    def test_a_failure_without_its_message_on_disk(self):
        self.assert_faulty(run(5, DIAGNOSED, results=Results(report=" ")), "no message in run.h5")

    def test_a_failure_without_a_state(self):
        one = run(4, DIAGNOSED)
        one.results = None
        self.assert_faulty(one, "no last state")

    def test_a_refusal_without_a_message(self):
        self.assert_faulty(run(3), "no message")




class VerdictTest(unittest.TestCase):
    def test_good(self):
        self.assertTrue(verdict(run()).good)

    def test_a_diagnosed_failure(self):
        found = verdict(run(4, DIAGNOSED))
        self.assertEqual((found.kind, found.told), (judge.FAILED, True))
        self.assertEqual(found.how, "exit 4: a limit point")

    def test_warnings_are_not_the_cause(self):
        errors = "warning: deck.xml: poor\ndeck.xml:3: Structures / shell: out of order\n"
        self.assertEqual(judge.cause(run(3, errors)), "Structures / shell: out of order")

    def test_a_broken_law_that_the_certificate_shows(self):
        broken = {"relative energy drift": 1e-3}
        silent = verdict(run(results=Results(**broken)), judge.energy())
        told = verdict(run(output="BROKEN", results=Results(**broken)), judge.energy())
        self.assertEqual((silent.kind, silent.told), (judge.WRONG, False))
        self.assertEqual((told.kind, told.told), (judge.WRONG, True))
        self.assertIn("0.001", told.how)

    def test_a_drift_that_is_not_a_number_is_broken(self):
        one = run(results=Results(**{"relative energy drift": math.nan}))
        self.assertEqual(verdict(one, judge.energy()).kind, judge.WRONG)

    def test_steps_cut_back_are_told(self):
        one = run(results=Results(**{"rejected steps": 2.0}))
        found = verdict(one, judge.uncut())
        self.assertEqual((found.kind, found.told), (judge.CUT, True))

    def test_both_momenta(self):
        for kind in ("linear", "angular"):
            drifts = {f"relative {k} momentum drift": 0.0 for k in ("linear", "angular")}
            drifts[f"relative {kind} momentum drift"] = 1e-8
            self.assertFalse(verdict(run(results=Results(**drifts)), judge.momenta()).good)

    def test_distance_to_a_known_value(self):
        history = History(**{"tip ux [m]": [0.0, 3.0], "tip uy [m]": [0.0, 4.1]})
        one = run(history=history)
        self.assertTrue(verdict(one, judge.near("tip", (3.0, 4.0), 0.03)).good)
        self.assertFalse(verdict(one, judge.near("tip", (3.0, 4.0), 0.01)).good)
        known = judge.near("tip ux [m]", lambda x: 3 * x, 1e-9)
        self.assertTrue(verdict(one, known).good)
        self.assertFalse(verdict(one, known, stress=2.0).good)

    def test_distance_to_the_recommended_run(self):
        def evidence(value, stress, reference=None):
            return judge.Evidence(run(history=History(energy=[0.0, value])), stress, reference)

        check = judge.as_recommended("energy", 0.1, lambda x: x**2)
        first = evidence(8.0, 1.0)
        self.assertEqual(check.measure(first), 0.0)
        self.assertAlmostEqual(check.measure(evidence(2.0, 2.0, first)), 0.0)
        self.assertAlmostEqual(check.measure(evidence(3.0, 2.0, first)), 0.5)
        self.assertTrue(check.compares)

    def test_energy_that_rises(self):
        check = judge.never_rises("e")
        falls = run(history=History(e=[0.0, 4.0, 3.0, 3.0]))
        rises = run(history=History(e=[0.0, 4.0, 3.0, 3.1]))
        self.assertTrue(verdict(falls, check).good)
        self.assertEqual(verdict(rises, check).kind, judge.WRONG)

    def test_a_number_of_the_report_that_is_missing(self):
        self.assertFalse(verdict(run(), judge.scalar("limit point 1, level", 1.8, 0.1)).good)


class IllPosedTest(unittest.TestCase):
    def test_must_fail_as_told(self):
        def kind(one, exit_code, says):
            return judge.judge_ill_posed(one, exit_code, says).kind

        self.assertEqual(kind(run(4, DIAGNOSED), 4, "a limit point"), judge.FAILED)
        self.assertEqual(kind(run(4, DIAGNOSED), 3, "a limit point"), judge.FAULTY)
        self.assertEqual(kind(run(4, DIAGNOSED), 4, "a mechanism"), judge.FAULTY)
        self.assertEqual(kind(run(), 4, ""), judge.FAULTY)


if __name__ == "__main__":
    unittest.main()
