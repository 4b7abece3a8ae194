"""The case of a flow program: its times, its stations and the files that it exchanges."""

import difflib
import pathlib
import re

import numpy as np

from ..errors import CulmError
from .dictionary import read_dictionary

_NO = ("no", "false", "off", "n", "f", "none")  # how OpenFOAM may say it
INPUT = 3  # exit code: deck and case do not fit


class Case:
    """What of a case concerns the coupling. Raises CulmError for a case that cannot be coupled.

    folder, comms      of the case, and that in which files are exchanged
    application        the flow program that controlDict names
    start, step, end   times [s]
    steps              number of time steps
    locations, axis    where stations are along the axis [m], and its direction
    centre             where the axis stands [m]
    """

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        self._read_times(_Entries(self.folder / "system/controlDict"))
        self._read_movement(_Entries(self.folder / "system/lumpedPointMovement"))

    def _read_times(self, control):
        self.application = control.word("application")
        control.require("startFrom", "startTime", "latestTime would have to be known to the deck")
        control.require("stopAt", "endTime", "both programs must know the end")
        control.require("adjustTimeStep", "no", "culm must know the length of a step", "no")
        self.start, self.end = control.number("startTime"), control.number("endTime")
        self.step = control.number("deltaT")
        if not self.step > 0.0 or not self.end > self.start:
            control.fail(f"there is no step of {self.step:g} s from {self.start:g} s to {self.end:g} s")
        self.steps = round((self.end - self.start) / self.step)

    def _read_movement(self, movement):
        movement.require("relax", "1", "the wall has to be where culm says", "1")
        movement.require("interpolationScheme", "linear", "it is how culm's points move", "linear")
        self.axis = movement.numbers("axis", 3)
        self.locations = movement.numbers("locations")
        self.centre = movement.numbers("centre", 3)
        files = movement.inner("communication")
        for name in ("inputFormat", "outputFormat"):
            files.require(name, "dictionary", "the other format has no names")
        for scale in ("scaleInput", "scaleOutput"):
            if scale in files.entries:
                for name in files.inner(scale).entries:
                    files.inner(scale).require(name, "1", "culm counts in SI units")
        self.comms = self.folder / re.sub(r"\$FOAM_CASE|<case>", str(self.folder), files.word("commsDir"))
        self.positions, self.forces = (self.comms / files.word(name) for name in ("inputName", "outputName"))

    def reference(self):
        """Where stations are before anything moves, shape (stations, 3) [m]."""
        return np.outer(self.locations, self.axis) + self.centre

    def check_stations(self, name, points):
        """Raises CulmError unless the points of a port are the stations."""
        reference, place = self.reference(), self.folder / "system/lumpedPointMovement"
        if len(points) != len(reference):
            raise CulmError(f"port '{name}' has {len(points)} points, and '{place}' {len(reference)} 'locations': both "
                            "must be the same points", INPUT)
        far = np.linalg.norm(points - reference, axis=1)
        worst = int(np.argmax(far))
        if far[worst] > 1e-6 * np.ptp(self.locations):
            raise CulmError(f"point {worst} of port '{name}' is at {_text(points[worst])}, and station {worst} of "
                            f"'{place}' at {_text(reference[worst])}", INPUT)


class _Entries:
    """The entries of a file, or of a dictionary in it."""

    def __init__(self, path, entries=None, place=""):
        self.path = path
        self.entries = read_dictionary(path) if entries is None else entries
        self.place = place

    def fail(self, what):
        raise CulmError(f"'{self.path}': {what}", INPUT)

    def value(self, name):
        if name not in self.entries:
            near = difflib.get_close_matches(name, self.entries, 1)
            self.fail(f"'{self.place}{name}' is missing" + (f"; there is '{self.place}{near[0]}'" if near else ""))
        return self.entries[name]

    def word(self, name):
        word = self.value(name)
        if not isinstance(word, str):
            self.fail(f"'{self.place}{name}' must be a word, got {word}")
        return word.strip('"')

    def inner(self, name):
        inner = self.value(name)
        if not isinstance(inner, dict):
            self.fail(f"'{self.place}{name}' must be a dictionary, got {inner}")
        return _Entries(self.path, inner, f"{self.place}{name}/")

    def number(self, name):
        return float(self._floats(name, [self.value(name)])[0])

    def numbers(self, name, size=None):
        numbers = self._floats(name, self.value(name))
        if numbers.ndim != 1 or size not in (None, len(numbers)):
            self.fail(f"'{self.place}{name}' must be a list of {size or 'some'} numbers")
        return numbers

    def _floats(self, name, words):
        try:
            return np.array(words, dtype=float)
        except (ValueError, TypeError):
            self.fail(f"'{self.place}{name}' must be numbers written out, got {words}")

    def require(self, name, allowed, why, default=None):
        """Raises CulmError unless an entry has the only value with which coupling works."""
        found = default if default is not None and name not in self.entries else self.word(name)
        if not _are_equal(found, allowed):
            self.fail(f"'{self.place}{name}' is {found} and must be {allowed}: {why}")


def _are_equal(found, allowed):
    try:
        return float(found) == float(allowed)
    except ValueError:
        return found == allowed or found in _NO and allowed in _NO


def _text(point):
    return "(" + ", ".join(f"{x:g}" for x in point) + ")"
