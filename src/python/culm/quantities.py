"""The quantities that a study watches, and how far two runs are apart in them.

A history entry is a vector over its components of one unit, and a function of time or level. Its
distance is a norm over the last uninterrupted stretch of levels: 'rms' the root of the mean square,
'max' the largest, 'end' that of the last value. All are divided by the same norm of the reference.
A drift is a number of the certificate and its own error.
"""

import dataclasses
import difflib

import numpy

from .errors import CulmError
from .history import unit_of

NORMS = ("rms", "max", "end")
DRIFTS = {
    "energy drift": ["relative energy drift"],
    "momentum drift": ["relative linear momentum drift", "relative angular momentum drift"],
    "constraint drift": ["constraint drift"],
}
SHORT_DRIFTS = {"energy": "energy drift", "momentum": "momentum drift", "constraints": "constraint drift"}


@dataclasses.dataclass
class Watched:
    """A quantity as asked for: an entry of the history with all components or one, or a drift."""

    name: str
    entry: str | None = None
    component: str | None = None
    drift: str | None = None
    entries: tuple = ()  # of the history, as the deck has them
    option: str = "--watch"  # by which it was asked for

    def columns(self, history):
        """Columns by unit: {title: [names]}."""
        components = history.owned(self.entries or (self.entry,)).get(self.entry, {})
        if self.component:
            found = [name for name, component in components.items() if component == self.component]
            if not found:
                hint = _hint(self.component, components.values())
                raise CulmError(f"{self.option} {self.name}: no component '{self.component}'{hint}")
            return {self.name: found}
        units = {}
        for name in components:
            units.setdefault(unit_of(name), []).append(name)
        if len(units) == 1:
            return {self.name: list(components)}
        return {f"{self.name} [{unit}]": found for unit, found in units.items()}


def parse(names, deck, option="--watch"):
    """Quantities by their names: 'tip', 'tip/uz', 'tip/displacement' (an entry and its type), or a drift."""
    entries = tuple(deck.names_in("Output/History"))
    known = set(entries)
    return [_parse(name, deck, entries, known, option) for name in names]


def _parse(name, deck, entries, known, option):
    entry, _, component = name.rpartition("/") if name not in known else (name, "", "")
    if not entry:
        entry, component = name, ""
    if entry in known:
        kind = deck.parameters[f"Output/History/{entry}/Type"]
        component = None if component.lower() in ("", kind.lower()) else component
        return Watched(name, entry, component, entries=entries, option=option)
    drift = SHORT_DRIFTS.get(name, name)
    if drift in DRIFTS:
        return Watched(name, drift=drift, option=option)
    raise CulmError(f"{option} {name}: no quantity of the history{_hint(entry, [*entries, *DRIFTS])}")


def drift(scalars, name):
    """The worst value over all analyses; None if the run has none."""
    values = [
        abs(value)
        for key, value in scalars.items()
        if any(key == one or key.endswith(f": {one}") for one in DRIFTS[name])
    ]
    return max(values) if values else None


# Of what it was before, a value that errors should not be relative to.
NOTHING = 1e-3


class Measure:
    """Brings histories to the same levels, and measures their differences."""

    def __init__(self, watched, norm, histories):
        """@param histories  of all runs that will be compared; the one with the fewest levels says where"""
        self.norm = norm
        self.watched = [one for one in watched if one.entry]
        self.parts = {}  # title: slice of columns
        self.columns = []
        for one in self.watched:
            for title, names in one.columns(histories[0]).items():
                self.parts[title] = slice(len(self.columns), len(self.columns) + len(names))
                self.columns += names
        for history in histories:
            lacking = [name for name in self.columns if name not in history.columns]
            if lacking:
                raise CulmError(f"the reference has no column '{lacking[0]}'")
        stretches = [_last_stretch(history.levels) for history in histories]
        fewest = min(stretches, key=len)
        self.levels = numpy.array(fewest if norm != "end" else fewest[-1:])
        self._leave_out_absent(histories)
        self.weights = _weights(self.levels)
        self.scale = {title: 1.0 for title in self.parts}

    def _leave_out_absent(self, histories):
        """Takes away levels at which something does not exist in one of the runs, as the power of a rotor before its first
        step."""
        if not self.columns:
            return
        exists = [numpy.isfinite(self.state(history)).all(axis=1) for history in histories]
        self.levels = self.levels[numpy.logical_and.reduce(exists)]
        if len(self.levels) == 0:
            raise CulmError(f"at no level do all runs have {', '.join(self.columns)}")

    def state(self, history):
        """What is watched of a run, (levels, columns)."""
        if self.norm == "end":
            return numpy.array([[history.columns[name][-1] for name in self.columns]])[: len(self.levels)]
        stretch = _last_stretch(history.levels)
        first = len(history.levels) - len(stretch)
        values = numpy.empty((len(stretch), len(self.columns)))
        for i, name in enumerate(self.columns):
            values[:, i] = history.columns[name][first:]
        return _at(numpy.array(stretch), values, self.levels)

    def refer_to(self, state):
        """Distances are relative to this state from now on; absolute where it is zero."""
        for title, part in self.parts.items():
            size = self._norm(state[:, part])
            self.scale[title] = size if size > 0.0 else 1.0

    def vanishing(self, history):
        """Of quantities that are next to nothing where they are compared, by title: what distances are relative to, and
        the largest value along a history."""
        lengths = {
            title: float(numpy.linalg.norm([history.columns[name] for name in self.columns[part]], axis=0).max())
            for title, part in self.parts.items()
        }
        return {
            title: (self.scale[title], most) for title, most in lengths.items() if self.scale[title] < NOTHING * most
        }

    def sizes(self, difference):
        """The norm of each quantity, relative."""
        return {
            title: self._norm(difference[:, part]) / self.scale[title] for title, part in self.parts.items()
        }

    def size(self, difference):
        """The largest of all quantities."""
        return max(self.sizes(difference).values(), default=0.0)

    def _norm(self, values):
        lengths = numpy.linalg.norm(values, axis=1)
        return float(lengths.max() if self.norm == "max" else numpy.sqrt(self.weights @ lengths**2))


def _last_stretch(levels):
    """The levels since they last went back or stood still."""
    start = max((i + 1 for i in range(len(levels) - 1) if levels[i + 1] <= levels[i]), default=0)
    return levels[start:]


def refuse_other_span(reference, history):
    """A reference is compared from end to end, so it must begin and end where the run does."""
    there, here = (_last_stretch(one.levels) for one in (reference, history))
    if len(there) == 0:
        raise CulmError("--reference: its history has no rows")
    tolerance = 1e-6 * (here[-1] - here[0])
    if abs(there[0] - here[0]) <= tolerance and abs(there[-1] - here[-1]) <= tolerance:
        return
    raise CulmError(
        f"--reference: its history goes from {there[0]:g} to {there[-1]:g}, that of the runs from "
        f"{here[0]:g} to {here[-1]:g}; both must cover the same"
    )


def _weights(levels):
    """Of the trapezoidal rule, divided by the length."""
    if len(levels) < 2:
        return numpy.ones(len(levels))
    steps = numpy.diff(levels)
    weights = numpy.zeros(len(levels))
    weights[:-1] += steps / 2.0
    weights[1:] += steps / 2.0
    return weights / weights.sum()


def _at(levels, values, wanted):
    """Values at levels that were met, and between others by cubics through the four nearest ones, whose
    error is of fourth order in the step of the run."""
    levels, first = numpy.unique(levels, return_index=True)
    values = values[first]
    tolerance = 1e-9 * max(abs(levels[-1]), 1e-300)
    right = numpy.clip(numpy.searchsorted(levels, wanted - tolerance), 0, len(levels) - 1)
    result = values[right].copy()
    missed = numpy.flatnonzero(numpy.abs(levels[right] - wanted) > tolerance)
    if len(missed) == 0:
        return result
    count = min(4, len(levels))
    start = numpy.clip(right[missed] - count // 2, 0, len(levels) - count)
    nodes = start[:, None] + numpy.arange(count)
    result[missed] = 0.0
    for i in range(count):
        factor = numpy.ones(len(missed))
        for j in range(count):
            if j != i:
                other = levels[nodes[:, j]]
                factor *= (wanted[missed] - other) / (levels[nodes[:, i]] - other)
        result[missed] += factor[:, None] * values[nodes[:, i]]
    return result


# Signals that have a value in each state; the others have one in each step.
OF_STATES = ("Lag", "Actuator", "Integral", "External")


def begins_unsolved(entry, component, deck):
    """Whether a component of an entry of the history belongs to steps, and stands as 0 in the row where an analysis begins,
    step 0."""

    def named(key, place):
        name = deck.parameters.get(f"Output/History/{entry}/{key}")
        return deck.parameters.get(f"{place}/{name}/Type", "")

    kind = deck.parameters.get(f"Output/History/{entry}/Type")
    if kind == "Link":
        return component in ("F", "M") and named("Load", "Loads").endswith(("Damper", "Damper Local", "Drive"))
    return kind == "Reaction" or kind == "Signal" and named("Signal", "Signals") not in OF_STATES


def _hint(name, known):
    close = difflib.get_close_matches(name, known, 1, 0.4)
    return f"; did you mean '{close[0]}'?" if close else f" ({', '.join(known)})"
