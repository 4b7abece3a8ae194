"""Cases from their first run to their margin, with a program that is played."""

import pathlib
import tempfile
import types
import unittest

from culm.hard import judge
from culm.hard.case import Case, IllPosed
from culm.hard.trial import Trial

DIAGNOSED = "It failed.\nLikely cause: too much. x\nTry: less.\n"


class Program:
    """Fails beyond a limit that --set x= passes on."""

    def __init__(self, limit, resumes=0, begins=1e9):
        self.begins = begins  # beyond this value the deck is refused, and there are no results
        self.limit = limit
        self.resumes = resumes
        self.values = []

    def run(self, deck, folder, settings, time_limit):
        value = float(settings[0].removeprefix("x="))
        self.values.append(value)
        folder.mkdir(parents=True, exist_ok=True)
        good = value <= self.limit
        if not good and value <= self.begins:
            (folder / "run.checkpoint").write_text("")
        results = types.SimpleNamespace(
            scalars=lambda: {"accepted steps": 3.0},
            report=lambda: "failed",
            last_state=lambda: (0.0, {}),
        )
        return types.SimpleNamespace(
            exit=0 if good else 4 if value <= self.begins else 3,
            errors="" if good else DIAGNOSED,
            output="",
            outcome="how it ended",
            cpu=0.5,
            folder=folder,
            results=results if value <= self.begins else None,
            history=types.SimpleNamespace(is_finite=True, columns={"y": [0.0, value]}),
        )

    def resume(self, folder, walltime, time_limit):
        return types.SimpleNamespace(exit=self.resumes, cpu=0.1)


CASE = Case("a case", "ST", "deck.xml", "x", 2.0, lambda x: [f"x={x!r}"], [], limit=1e4)


class TrialTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def trial(self, program):
        return Trial(program, "inputs", self.folder, 10.0)

    def test_margin_and_what_happens_beyond(self):
        program = Program(70.0)
        trial = self.trial(program)
        entry = trial.measure(CASE)
        self.assertLessEqual(entry.last_good, 70.0)
        self.assertGreater(entry.first_bad, 70.0)
        self.assertLessEqual(entry.first_bad / entry.last_good, 1.1)
        self.assertEqual((entry.kind, entry.how), (judge.FAILED, "exit 4: too much"))
        self.assertEqual(entry.beyond, judge.FAILED)
        self.assertEqual(program.values[-1], 10.0 * entry.first_bad)
        self.assertEqual(list(self.folder.iterdir()), [])  # nothing is kept
        self.assertGreater(sum(trial.times), 0.5 * len(program.values))

    def test_no_limit(self):
        entry = self.trial(Program(1e9)).measure(CASE)
        self.assertTrue(entry.is_open)
        self.assertEqual((entry.kind, entry.beyond), (judge.GOOD, ""))

    def test_coarse_is_cheaper(self):
        fine, coarse = Program(70.0), Program(70.0)
        self.trial(fine).measure(CASE)
        self.trial(coarse).measure(CASE, coarse=True)
        self.assertLess(len(coarse.values), len(fine.values))

    def test_a_checkpoint_that_does_not_resume_is_a_fault(self):
        entry = self.trial(Program(70.0, resumes=6)).measure(CASE)
        self.assertEqual((entry.kind, entry.told), (judge.FAULTY, False))

    def test_a_deck_that_is_refused_far_beyond_needs_no_checkpoint(self):
        entry = self.trial(Program(70.0, begins=100.0)).measure(CASE)
        self.assertEqual((entry.kind, entry.beyond), (judge.FAILED, judge.FAILED))

    def test_a_margin_is_confirmed_by_two_runs(self):
        known = self.trial(Program(70.0)).measure(CASE)
        program = Program(70.0)
        self.assertEqual(self.trial(program).measure_again(CASE, known), known)
        self.assertEqual(program.values, [known.last_good / CASE.resolution, known.first_bad])

    def test_a_margin_that_shrank_is_measured(self):
        known = self.trial(Program(70.0)).measure(CASE)
        entry = self.trial(Program(30.0)).measure_again(CASE, known)
        self.assertLessEqual(entry.last_good, 30.0)

    def test_a_case_that_compares_runs_what_it_compares_with(self):
        case = Case(**{**vars(CASE), "checks": [judge.as_recommended("y", 100.0)]})
        known = self.trial(Program(70.0)).measure(case)
        program = Program(70.0)
        self.trial(program).measure_again(case, known)
        self.assertEqual(program.values[0], case.recommended)

    def test_ill_posed(self):
        def refuse(says):
            one = IllPosed("ill", "deck.xml", ["x=100"], 4, says)
            return self.trial(Program(70.0)).refuse(one).kind

        self.assertEqual(refuse("too much"), judge.FAILED)
        self.assertEqual(refuse("something else"), judge.FAULTY)


if __name__ == "__main__":
    unittest.main()
