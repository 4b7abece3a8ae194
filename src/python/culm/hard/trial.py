"""Runs the cases of the catalogue."""

import math
import pathlib
import shutil

from . import judge
from .margins import Entry, Refusal
from .search import search

FAR = 10.0  # how far beyond the first bad value a run must still be diagnosed


class Trial:
    """Runs cases and tells what became of them; each run has a folder of its own."""

    def __init__(self, program, decks, folder, time_limit, keep=False):
        self.program = program
        self.decks = pathlib.Path(decks)
        self.folder = pathlib.Path(folder)
        self.time_limit = time_limit
        self.keep = keep
        self.times = []  # CPU of all runs [s]; cases may be worked on side by side

    def measure(self, case, coarse=False):
        """The margin of a case.

        @param coarse  to a factor of 2 instead of as fine as the case asks
        """
        judge_value = self._judge_of(case)
        resolution = max(2.0, case.resolution) if coarse else case.resolution
        margin = search(
            judge_value, case.recommended, case.limit, case.growth, resolution, case.whole
        )
        beyond = "" if margin.is_open else judge_value(FAR * margin.first_bad).kind
        return self._entry(case, margin.last_good, margin.first_bad, margin.verdict, beyond)

    def measure_again(self, case, known):
        """Confirms a margin by two runs: a little below the last good value and at the first bad
        one; measures anew where the former is not good."""
        if math.isnan(known.last_good):
            return self.measure(case)
        judge_value = self._judge_of(case)
        if any(check.compares for check in case.checks):
            judge_value(case.recommended)
        if not judge_value(case.rounded(known.last_good / case.resolution)).good:
            return self.measure(case)
        if known.is_open:
            return known
        verdict = judge_value(known.first_bad)
        return self._entry(case, known.last_good, known.first_bad, verdict, known.beyond)

    def refuse(self, ill_posed):
        """What is said of an ill-posed deck."""
        run = self._run(ill_posed.name, ill_posed.deck, ill_posed.settings)
        verdict = judge.judge_ill_posed(run, ill_posed.exit, ill_posed.says)
        self._tidy(run.folder)
        return Refusal(ill_posed.name, verdict.kind, verdict.how)

    def _judge_of(self, case):
        """A function that runs a case with a value; the first run is what others are compared
        with."""
        reference = None

        def judge_value(value):
            nonlocal reference
            run = self._run(f"{case.name} {value:.6g}", case.deck, case.settings(value))
            evidence = judge.Evidence(run, value, reference)
            reference = reference or evidence
            verdict = judge.judge(evidence, case.checks)
            if verdict.kind == judge.FAILED and not self._resumes(run):
                verdict = judge.Verdict(judge.FAULTY, "its checkpoint does not resume", False)
            self._tidy(run.folder)
            return verdict

        return judge_value

    def _run(self, name, deck, settings):
        folder = self.folder / "".join(c if c.isalnum() or c in "+-." else "_" for c in name)
        run = self.program.run(self.decks / deck, folder, settings, self.time_limit)
        self.times.append(run.cpu)
        return run

    def _resumes(self, run):
        """The checkpoint of a run that failed is usable; true if it failed before its first step
        and so has none, or if its deck was refused before there were results."""
        if not (run.folder / "run.checkpoint").exists():
            return run.results is None or run.results.scalars().get("accepted steps", 0) == 0
        again = self.program.resume(run.folder, walltime=1, time_limit=self.time_limit)
        self.times.append(again.cpu)
        return again.exit in (0, 4, 5, 7)

    def _tidy(self, folder):
        if not self.keep:
            shutil.rmtree(folder)

    def _entry(self, case, last_good, first_bad, verdict, beyond):
        return Entry(
            case.name,
            case.keys,
            case.stressor,
            case.recommended,
            last_good,
            first_bad,
            judge.GOOD if math.isinf(first_bad) else verdict.kind,
            verdict.how,
            verdict.told,
            beyond,
        )
