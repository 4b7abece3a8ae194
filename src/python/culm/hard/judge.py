"""Judges a run: did it end, does its result hold, and if not, was that said?"""

import dataclasses
import math
import pathlib
from collections.abc import Callable

from ..program import DONE

GOOD = "good"
CUT = "cut back"
INACCURATE = "inaccurate"
WRONG = "wrong"
FAILED = "failed"
FAULTY = "faulty"

@dataclasses.dataclass
class Evidence:
    """A run of a case, and what to compare it with."""

    run: object  # Run
    stress: float
    reference: object = None  # Evidence of the run at the recommended value; None in that run

    def __post_init__(self):
        self.history = self.run.history
        self.scalars = self.run.results.scalars() if self.run.results else {}


@dataclasses.dataclass(frozen=True)
class Check:
    """Holds where the measure does not exceed the bound; a measure that is nan does not hold."""

    what: str
    measure: Callable[[Evidence], float]
    bound: float
    otherwise: str  # kind of outcome where it does not hold
    compares: bool = False  # with the run at the recommended value

    def holds(self, value):
        return value <= self.bound


@dataclasses.dataclass(frozen=True)
class Verdict:
    kind: str
    how: str  # in a few words
    told: bool  # the program said that something is wrong, or nothing is

    @property
    def good(self):
        return self.kind == GOOD


def judge(evidence, checks):
    """What became of a run that should have succeeded."""
    run = evidence.run
    faults = find_faults(run)
    if faults:
        return Verdict(FAULTY, "; ".join(faults), False)
    if run.exit not in DONE:  # whether a promise that was broken matters is for the checks to say
        return Verdict(FAILED, f"exit {run.exit}: {cause(run)}", True)
    for check in checks:
        value = check.measure(evidence)
        if not check.holds(value):
            told = check.otherwise == CUT or warned(run)
            return Verdict(check.otherwise, f"{check.what} {value:.2g}", told)
    return Verdict(GOOD, "", True)


def judge_ill_posed(run, exit_code, says):
    """What became of a run that must fail with this exit code and these words."""
    faults = find_faults(run)
    if faults:
        return Verdict(FAULTY, "; ".join(faults), False)
    if run.exit != exit_code:
        return Verdict(FAULTY, f"{run.outcome} instead of exit {exit_code}", False)
    if says not in run.errors:
        return Verdict(FAULTY, f"does not say '{says}'", False)
    return Verdict(FAILED, f"exit {run.exit}: {cause(run)}", True)


def find_faults(run):
    """What no run may do, whatever is asked of it; a list of few words."""
    if run.exit not in (*DONE, 3, 4, 5, 9):
        return [run.outcome]
    faults = []
    if run.history is not None and not run.history.is_finite:
        faults.append("a number in history.csv is not finite")
    if run.exit == 3 and not run.errors.strip():
        faults.append("no message")
    if run.exit in (4, 5) and "Try:" not in run.errors:
        faults.append("no diagnosis")
    if run.exit in (4, 5, 9) or (run.exit == 3 and run.results is not None):
        faults += _faults_of_state(run.results)
    return faults


def _faults_of_state(results):
    """Of the last state of a run that failed."""
    try:
        _, state = results.last_state()
        report = results.report()
    except (AttributeError, KeyError, OSError, ValueError):
        return ["no last state in run.h5"]
    faults = []
    if not _is_finite(positions.flat for positions in state.values()):
        faults.append("the last state is not finite")
    if not report.strip():
        faults.append("no message in run.h5")
    return faults


def _is_finite(columns):
    return all(math.isfinite(value) for values in columns for value in values)


def cause(run):
    """The likely cause of a failure, or its first line."""
    for line in run.errors.splitlines():
        if line.startswith("Likely cause:"):
            return line.removeprefix("Likely cause:").split(". ")[0].strip().rstrip(".")
    lines = [line for line in run.errors.splitlines() if line.strip()]
    mistakes = [line for line in lines if not line.startswith(("warning:", "note:"))]
    return (mistakes or lines or ["no message"])[0].split(": ", 1)[-1]


def warned(run):
    """A run that ended said itself that something is wrong."""
    said = run.output + run.errors
    return any(word in said for word in ("BROKEN", "not promised", "warning:", "bifurcation at"))


# Checks, to be named in the catalogue.


def uncut():
    """All steps were taken as asked for."""
    return Check("steps cut back", lambda e: e.scalars["rejected steps"], 0, CUT)


def energy(bound=1e-9):
    return Check("energy balance", lambda e: e.scalars["relative energy drift"], bound, WRONG)


def interface(partner, bound=1e-6):
    """What got lost at the port of a partner, or came from nowhere, over what it got."""
    def gap(e):
        return abs(e.scalars[f"gap of partner {partner}"]) / abs(e.scalars[f"work of partner {partner}"])

    return Check("gap of the interface", gap, bound, WRONG)


def momenta(bound=1e-10):
    """Of what nothing holds from outside."""
    names = [f"relative {kind} momentum drift" for kind in ("linear", "angular")]
    return Check("momentum", lambda e: max(e.scalars[name] for name in names), bound, WRONG)


def constraints(bound=1e-10):
    return Check("constraints", lambda e: e.scalars["constraint drift"], bound, WRONG)


def never_rises(column, bound=1e-10):
    """No step adds to a quantity, relative to its largest value. The first row is left out: it is
    written before velocities are made consistent."""

    def rise(evidence):
        values = evidence.history.column(column)[1:]
        steps = zip(values, values[1:])
        return max(after - before for before, after in steps) / max(map(abs, values))

    return Check(f"rise of '{column}'", rise, bound, WRONG)


def near(quantity, value, within):
    """The last value of a quantity, or of one of its columns, against a known one.

    @param value   number or tuple, or a function of the stressor that returns it
    @param within  distance allowed, over the size of the known value
    """

    def distance(evidence):
        known = value(evidence.stress) if callable(value) else value
        return _distance(_last(evidence, quantity), _tuple(known))

    return Check(f"error of '{quantity}'", distance, within, INACCURATE)


def as_recommended(quantity, within, scale=lambda stress: 1.0):
    """The last value, multiplied by scale(stressor), against that at the recommended value."""

    def distance(evidence):
        other = evidence.reference or evidence
        known = [v * scale(other.stress) for v in _last(other, quantity)]
        return _distance([v * scale(evidence.stress) for v in _last(evidence, quantity)], known)

    return Check(f"change of '{quantity}'", distance, within, INACCURATE, compares=True)


def below(what, column, factor, bound):
    """The last value, times a factor, stays below a bound."""
    return Check(what, lambda e: factor * e.history.column(column)[-1], bound, WRONG)


def scalar(name, value, within):
    """A number of the report against a known one; one that is missing does not hold."""
    return Check(
        f"error of '{name}'",
        lambda e: abs(e.scalars.get(name, math.nan) - value) / abs(value),
        within,
        INACCURATE,
    )


def entry_of(table, row, column, value, within):
    """An entry of a table of an analysis against a known one."""

    def error(evidence):
        for one in evidence.run.results.tables():
            if one.title == table:
                return abs(one.rows[row][one.columns.index(column)] - value) / abs(value)
        return math.nan

    return Check(f"error of '{column}'", error, within, INACCURATE)


def _last(evidence, quantity):
    history = evidence.history
    if quantity in history.columns:
        return [history.columns[quantity][-1]]
    return history.vector(quantity)


def _tuple(value):
    return value if isinstance(value, (tuple, list)) else (value,)


def _distance(values, known):
    return math.dist(values, known) / math.hypot(*known)
