"""Errors, uncertainties and observed orders of the runs of a study."""

import dataclasses
import itertools

from ..errors import CulmError
from ..quantities import Measure, drift, refuse_other_span
from .fit import Order, order_of_differences, order_of_errors
from .reference import ROUNDING, Limit, corner_limit, limit


@dataclasses.dataclass
class Plan:
    """What is measured, against what, and how often."""

    watched: list  # quantities.Watched
    held_out: list  # the same, only shown
    norm: str  # of quantities.NORMS
    reference: object  # a History, or None: by refinement
    finer: int  # levels of the reference beyond the finest run
    repeat: int  # times of each run
    jobs: int  # reference runs at once
    truth: dict  # text of the value that the reference has, by axis
    usual: dict  # number of that value where values are different models, by axis


@dataclasses.dataclass
class Point:
    """A run of the grid and what it is worth."""

    index: tuple  # of its value on each axis
    record: object
    errors: dict = dataclasses.field(default_factory=dict)  # by quantity, relative; drifts as they are
    held_out: dict = dataclasses.field(default_factory=dict)  # the same, of what is only shown
    uncertainty: float = 0.0  # of the reference

    @property
    def succeeded(self):
        return bool(self.errors)

    @property
    def error(self):
        """The worst of all quantities."""
        return max(self.errors.values())

    @property
    def bound(self):
        """The error, or the uncertainty of the reference where that is larger."""
        return max(self.error, self.uncertainty)

    @property
    def is_judged(self):
        return self.error > self.uncertainty


@dataclasses.dataclass
class Line:
    """Runs along a refined axis, all others at their finest, measured against the limit of the line."""

    axis: int
    combination: tuple
    numbers: list
    errors: list
    uncertainty: float
    order: Order | None  # of the worst quantity


class Judgement:
    """Runs the grid, finds a reference, and measures all against it."""

    def __init__(self, axes, fixed, runs, plan):
        """@param fixed  settings that all runs share"""
        self.axes = axes
        self.fixed = list(fixed)
        self.runs = runs
        self.plan = plan
        self.refined = [a for a, axis in enumerate(axes) if axis.is_refined]
        self.compared = [a for a, axis in enumerate(axes) if not axis.is_refined]
        self.reference_runs = []
        self.notes = []
        self.points = {}
        self._states = {}
        self._is_checked = False
        self._run_grid()
        self._measure()
        self._refer()
        self.lines = self._lines()

    @property
    def has_broken_promises(self):
        """Whether a run that this rests on broke one."""
        records = [point.record for point in self.points.values()]
        return any(one.broken for one in [*records, *(record for _, record in self.reference_runs)])

    # ---- the grid

    def settings(self, index):
        return [*self.fixed, *(s for axis, i in zip(self.axes, index) for s in axis.settings(i))]

    def label(self, index):
        return ", ".join(axis.label(i) for axis, i in zip(self.axes, index)) or "the deck"

    def combination(self, index):
        """What of an index is compared, not refined: the name of its curve."""
        return tuple(index[a] for a in self.compared)

    def combinations(self):
        return list(itertools.product(*(range(len(self.axes[a].values)) for a in self.compared)))

    def label_of(self, combination):
        return ", ".join(self.axes[a].label(i) for a, i in zip(self.compared, combination))

    def at(self, combination, finer=0):
        """The index of a combination at the finest of all refined axes, or so many values beyond."""
        index = [len(axis.values) - 1 + finer for axis in self.axes]
        for a, i in zip(self.compared, combination):
            index[a] = i
        return tuple(index)

    def _run_grid(self):
        grid = list(itertools.product(*(range(len(axis.values)) for axis in self.axes)))
        # all once before any is repeated: what changes on the machine does not fall on one of them
        for repeat in range(1, self.plan.repeat + 1):
            self.runs.say(f"{len(grid)} runs, {repeat} of {self.plan.repeat}")
            for index in grid:
                self.points[index] = Point(index, self.runs.time(self.settings(index), repeat, self.label(index)))
                self._check_watched(self.points[index].record)
        if not any(point.record.succeeded for point in self.points.values()):
            reason = next(iter(self.points.values())).record.reason
            raise CulmError(f"no run succeeded; the first one: {reason}", 4)

    def _check_watched(self, record):
        """As soon as a run shows what there is."""
        if record.succeeded and not self._is_checked:
            history, scalars = record.history(), record.scalars()
            for one in [*self.plan.watched, *self.plan.held_out]:
                if one.drift is None:
                    one.columns(history)
                elif drift(scalars, one.drift) is None:
                    text = f"{one.option} {one.name}: the certificate of this deck has no such number"
                    raise CulmError(text)
            self._is_checked = True

    # ---- states

    def _measure(self):
        self._histories = {
            index: point.record.history() for index, point in self.points.items() if point.record.succeeded
        }
        histories = list(self._histories.values())
        if self.plan.reference is not None:
            for history in histories:
                refuse_other_span(self.plan.reference, history)
            histories.append(self.plan.reference)
        self.measure = Measure(self.plan.watched, self.plan.norm, histories)
        self.held_out = Measure(self.plan.held_out, self.plan.norm, histories)
        # until there is a reference
        finest = max(self._histories)
        for measure in (self.measure, self.held_out):
            measure.refer_to(measure.state(self._histories[finest]))

    def state(self, index, measure=None):
        measure = measure or self.measure
        key = (id(measure), index)
        if key not in self._states:
            self._states[key] = measure.state(self._histories[index])
        return self._states[key]

    def _along(self, a, index):
        """The successful runs through an index along an axis, from coarse to fine, with those that were
        made for the reference."""
        count = len(self.axes[a].values) + self.plan.finer
        through = [(*index[:a], i, *index[a + 1 :]) for i in range(count)]
        return [one for one in through if one in self._histories]

    # ---- the reference

    def _refer(self):
        if self.plan.reference is not None:
            given = self.plan.reference
            limits = [Limit(m.state(given), dict.fromkeys(m.parts, 0.0)) for m in self._measures()]
            self.reference_label = "the history given"
        elif not any(measure.parts for measure in self._measures()):
            limits = [Limit(self.state(max(self._histories), measure), {}) for measure in self._measures()]
            self.reference_label = "zero, which drifts should be"
        else:
            limits = self._limits_by_refinement()
        for measure, one in zip(self._measures(), limits):
            before = dict(measure.scale)
            measure.refer_to(one.value)
            for title in one.uncertainty:
                one.uncertainty[title] *= before[title] / measure.scale[title]
        self._note_vanishing()
        self.reference, self._held_out_reference = limits
        self.uncertainty = max(self.reference.uncertainty.values(), default=0.0)
        for index, point in self.points.items():
            if point.record.succeeded:
                self._judge(point, self._histories[index], point.record.scalars())

    def _note_vanishing(self):
        for measure in self._measures():
            for title, (size, most) in measure.vanishing(self._histories[max(self._histories)]).items():
                self.notes.append(
                    f"{title} is next to nothing where runs are compared, {size:.2g} of {most:.2g} at most: errors relative "
                    "to that say little. --norm max compares along the whole run."
                )

    def judge(self, record):
        """A run outside of the grid."""
        point = Point((), record)
        self._judge(point, record.history(), record.scalars())
        return point

    def _judge(self, point, history, scalars):
        point.errors = self._errors(self.measure, self.reference, self.plan.watched, history, scalars)
        point.held_out = self._errors(
            self.held_out, self._held_out_reference, self.plan.held_out, history, scalars
        )
        point.uncertainty = self.uncertainty

    @staticmethod
    def _errors(measure, reference, watched, history, scalars):
        errors = measure.sizes(measure.state(history) - reference.value)
        for one in watched:
            if one.drift:
                errors[one.name] = drift(scalars, one.drift)
        return errors

    def _measures(self):
        return self.measure, self.held_out

    def _limits_by_refinement(self):
        combination = self._best_combination()
        for finer in range(self.plan.finer, -1, -1):
            corner = self.at(combination, finer)
            lines = {a: self._towards(corner, a) for a in self.refined}
            needed = [corner, *(index for line in lines.values() for index in line)]
            self._run_untimed(dict.fromkeys(needed))
            if corner in self._histories:
                break
        else:
            text = "no reference: the finest run failed; leave it out, or give one by --reference"
            raise CulmError(text, 4)
        self.reference_label = self.label(corner)
        if not self.refined:
            self.notes.append(
                f"Nothing is refined: errors are differences from {self.reference_label}, "
                "whose own error is not known."
            )
        lines = {a: [index for index in line if index in self._histories] for a, line in lines.items()}
        return [
            corner_limit(self.state(corner, measure), self._sequences(lines, measure), measure)
            for measure in self._measures()
        ]

    def _sequences(self, lines, measure):
        """Sizes and states along lines, by axis."""
        return [
            ([self.axes[a].size(index[a]) for index in line], [self.state(index, measure) for index in line])
            for a, line in lines.items()
        ]

    def _towards(self, corner, a):
        """Up to four indices along an axis that end in a corner."""
        indices = range(max(corner[a] - 3, 0), corner[a] + 1)
        return [(*corner[:a], i, *corner[a + 1 :]) for i in indices]

    def _run_untimed(self, indices):
        """Makes what was not yet tried."""
        known = {*self.points, *(index for index, _ in self.reference_runs)}
        new = [index for index in indices if index not in known]
        wanted = [(self.settings(i), f"{self.label(i)} (reference)") for i in new]
        for index, record in zip(new, self.runs.get(wanted, self.plan.jobs)):
            self.reference_runs.append((index, record))
            if record.succeeded:
                self._histories[index] = record.history()
                self.notes += [f"The reference {self.label(index)} broke a promise: {s}" for s in record.broken]
            else:
                self.notes.append(f"The reference {self.label(index)} failed: {record.reason}")

    def _best_combination(self):
        """Of those that must all lead to the same limit: of the least tolerances, and then the least uncertain one."""
        candidates = [c for c in self.combinations() if all(map(self._may_be_true, self.compared, c))]

        def rank(combination):
            has_failed = self.at(combination) not in self._histories
            return has_failed, self._tolerances(combination), self._uncertainty_of(combination)

        return min(candidates, key=rank)

    def _tolerances(self, combination):
        found = [(self.axes[a], i) for a, i in zip(self.compared, combination)]
        try:
            return [axis.number(i) for axis, i in found if axis.name.lower().endswith("tolerance")]
        except ValueError:  # of a word or a variable
            return []

    def _may_be_true(self, a, i):
        axis = self.axes[a]
        wanted = self.plan.truth.get(axis.name)
        if wanted is not None:
            return axis.value(i) == wanted
        return axis.is_same_solution or i == self.plan.usual.get(axis.name, 0)

    def _uncertainty_of(self, combination):
        corner = self.at(combination)
        if corner not in self._histories:
            return float("inf")
        lines = {a: self._along(a, corner) for a in self.refined}
        if any(len(line) < 2 for line in lines.values()):
            return float("inf")
        found = corner_limit(self.state(corner), self._sequences(lines, self.measure), self.measure)
        return max(found.uncertainty.values(), default=0.0)

    # ---- orders

    def _lines(self):
        lines = []
        for a in self.refined:
            for combination in self.combinations():
                line = self._line(a, combination)
                if line is not None:
                    lines.append(line)
        return lines

    def _line(self, a, combination):
        along = self._along(a, self.at(combination))
        if len(along) < 3:
            return None
        sizes = [self.axes[a].size(i[a]) for i in along]
        numbers = [self.axes[a].number(i[a]) for i in along]
        if not self.measure.parts:
            errors = [self.points[i].error for i in along]  # there are no others without a reference
            return Line(a, combination, numbers, errors, 0.0, _order_of_drifts(sizes, errors))
        states = [self.state(i) for i in along]
        found = limit(sizes, states, self.measure)
        errors = [self.measure.size(state - found.value) for state in states]
        uncertainty = max(found.uncertainty.values())
        differences = [self.measure.size(y - x) for x, y in zip(states, states[1:])]
        return Line(a, combination, numbers, errors, uncertainty, _order(sizes, differences))


def _order_of_drifts(sizes, errors):
    return order_of_errors(sizes, errors) if min(errors) > ROUNDING else None


def _order(sizes, differences):
    """From differences above rounding."""
    used = next((i for i, d in enumerate(differences) if d < ROUNDING), len(differences))
    return order_of_differences(sizes[: used + 1], differences[:used])
