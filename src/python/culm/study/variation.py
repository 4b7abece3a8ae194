"""What a study varies: `step=0.04:0.0025/2`, `scheme=Conserving,Trapezoidal`, any path of --set.

A range `a:b*f` or `a:b/f` is refined towards b; a list is compared. Numbers of `step`, `mesh` and
of parameters named Step, Elements or Refinement are always refined, also as a list.
"""

import dataclasses
import difflib
import math
import re
import sys

from ..errors import CulmError

MOST_VALUES = 64

# What a short name stands for, in all places of the deck where it exists.
SHORT_NAMES = {
    "step": ["Analyses/*/Step"],
    "mesh": ["Refinement"],
    "element": ["Structures/*/Element", "Structures/*/Order"],
    "order": ["Structures/*/Order"],
    "fidelity": ["Structures/*/Fidelity"],
    "membrane": ["Structures/*/Enhanced Membrane"],
    "thickness": ["Structures/*/Enhanced Thickness"],
    "dissipation": ["Structures/*/Dissipation"],
    "integrator": ["Analyses/*/Scheme"],
    "scheme": ["Analyses/*/Scheme"],
    "radius": ["Analyses/*/Spectral Radius"],
    "increments": ["Analyses/*/Steps"],
    "tolerance": ["Analyses/*/Newton/Force Tolerance"],
    "solver": ["Solver/Linear Solver"],
    "form": ["Solver/Form"],
    "window": ["Coupling/Window"],
    "agreement": ["Coupling/Tolerance"],
    "coupling": ["Coupling/Scheme"],
    "substeps": ["Coupling/Partners/*/Steps"],
    "stations": ["Loads/*/Stations"],
    "lag": ["Loads/*/Lag"],
    "induction": ["Loads/*/Induction"],
}
SHRINKING = {"step", "tolerance", "window", "agreement", "Step", "Force Tolerance", "Window", "Tolerance"}  # smaller is finer
GROWING = {"mesh", "Refinement", "Elements", "stations", "Stations"}  # larger is finer
REFINED = {"step", "mesh", "window", "stations", "Step", "Elements", "Refinement", "Window", "Stations"}

# Values of these are ways to the same solution; all others are models of their own.
SAME_SOLUTION = {
    *("element", "order", "membrane", "thickness", "integrator", "scheme", "increments"),
    *("tolerance", "solver", "form", "Element", "Order", "Enhanced Membrane", "Scheme"),
    *("Enhanced Thickness", "Steps", "Force Tolerance", "Linear Solver", "Form"),
    *("agreement", "substeps", "Tolerance"),
}

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
RANGE = re.compile(rf"({NUMBER}):({NUMBER})([*/])({NUMBER})")


def declare(parser, required):
    """What is varied, the same for all verbs that vary a deck."""
    parser.add_argument(
        "--vary", nargs="+", required=required, default=[], metavar="NAME=VALUES",
        help="step=0.04:0.0025/2, mesh=1:8*2, scheme=Conserving,Trapezoidal, or any path of --set; "
        f"short names: {', '.join(SHORT_NAMES)}; all combinations are run",
    )
    parser.add_argument(
        "--paired", nargs="+", default=[], metavar="NAME", help="vary these together instead"
    )
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE", help="for all runs")


@dataclasses.dataclass
class Axis:
    """One variation: values from coarse to fine if it is refined, otherwise as given."""

    name: str
    values: list  # texts
    places: list  # paths of the deck that get the value
    is_refined: bool = False
    shrinks: bool = False  # smaller is finer

    @property
    def leaf(self):
        return self.name.rsplit("/", 1)[-1]

    @property
    def is_same_solution(self):
        """Whether any of the values serves as reference for the others."""
        return self.leaf in SAME_SOLUTION

    def value(self, i):
        """The text of value i; beyond the last one it goes on by the last ratio."""
        last = len(self.values) - 1
        if i <= last:
            return self.values[i]
        ratio = self.number(last) / self.number(last - 1) if last > 0 else self._usual_ratio()
        return _text(self.number(last) * ratio ** (i - last), self._is_whole())

    def number(self, i):
        return float(self.value(i))

    def size(self, i):
        """What tends to zero: the value, or one over it."""
        return self.number(i) if self.shrinks else 1.0 / self.number(i)

    def label(self, i):
        return f"{self.leaf}={self.value(i)}"

    def settings(self, i):
        return self.settings_of(self.value(i))

    def settings_of(self, value):
        """path=value for all places; `element=Director 2` sets Element and Order."""
        if self.name == "element":
            kind, order = re.fullmatch(r"(.*?)[ -]?(\d*)", value).groups()
            return [
                f"{place}={kind if place.endswith('/Element') else order}"
                for place in self.places
                if order or place.endswith("/Element")
            ]
        return [f"{place}={value}" for place in self.places]

    def paths(self):
        """What is set by any of its values."""
        return {setting.partition("=")[0] for i in range(len(self.values)) for setting in self.settings(i)}

    def between(self, coarse, fine, share):
        """A value between two, share 0 to 1 on a logarithmic scale, never coarser than that; None
        if none is left. Two digits for fractions."""
        a, b = self.number(coarse), self.number(fine)
        wanted = a * (b / a) ** share
        if self._is_whole():
            rounded = math.floor(wanted) if self.shrinks else math.ceil(wanted)
        else:
            digit = 10.0 ** (math.floor(math.log10(wanted)) - 1)
            rounded = (math.floor if self.shrinks else math.ceil)(wanted / digit + 1e-9) * digit
        inside = min(a, b) < rounded < max(a, b)
        return _text(rounded, self._is_whole()) if inside else None

    def _usual_ratio(self):
        return 0.5 if self.shrinks else 2.0

    def _is_whole(self):
        return all(re.fullmatch(r"[-+]?\d+", value) for value in self.values)


@dataclasses.dataclass
class PairedAxis:
    """Variations that advance together; the first one names the sizes."""

    axes: list

    @property
    def name(self):
        return self.axes[0].name

    @property
    def leaf(self):
        return self.axes[0].leaf

    @property
    def values(self):
        return self.axes[0].values

    @property
    def is_refined(self):
        return self.axes[0].is_refined

    @property
    def shrinks(self):
        return self.axes[0].shrinks

    @property
    def is_same_solution(self):
        return all(axis.is_same_solution or axis.is_refined for axis in self.axes)

    def value(self, i):
        return self.axes[0].value(i)

    def number(self, i):
        return self.axes[0].number(i)

    def size(self, i):
        return self.axes[0].size(i)

    def label(self, i):
        return ", ".join(axis.label(i) for axis in self.axes)

    def settings(self, i):
        return [setting for axis in self.axes for setting in axis.settings(i)]

    def paths(self):
        """What is set by any of their values."""
        return set().union(*(axis.paths() for axis in self.axes))

    def between(self, coarse, fine, share):
        del coarse, fine, share  # several values would have to be rounded alike
        return None


def parse(text, deck):
    """An axis from 'name=values'.

    @param deck  ResolvedDeck in which short names and patterns are looked up
    """
    name, equals, given = text.partition("=")
    name = name.strip()
    if not equals or not name or not given.strip():
        raise CulmError(f"--vary {text}: expected name=values, such as step=0.04:0.0025/2 or order=1,2")
    leaf = name.rsplit("/", 1)[-1]
    values, rises = _values(text, given)
    if name in SHORT_NAMES:
        values = [_spaced(value) for value in values]
    if len(set(values)) < len(values):
        raise CulmError(f"--vary {text}: a value is given twice")
    axis = Axis(name, values, places(name, deck))
    numeric = all(re.fullmatch(NUMBER, value) for value in values)
    axis.is_refined = numeric and (leaf in REFINED or (rises is not None and leaf != "order"))
    if axis.is_refined:
        axis.shrinks = leaf in SHRINKING or (leaf not in GROWING and rises is False)
        if any(float(value) <= 0.0 for value in values):
            raise CulmError(f"--vary {text}: what is refined must be greater than zero")
        axis.values = sorted(values, key=float, reverse=axis.shrinks)
    return axis


def pair(axes, names):
    """The axes, with those named put together; order as of the first one."""
    refuse_overlaps("--vary", [(axis.name, axis.paths()) for axis in axes])
    chosen = []
    for name in names:
        found = [axis for axis in axes if axis.name == name]
        if not found:
            raise CulmError(f"--paired {name}: not among what varies" + _hint(name, [a.name for a in axes]))
        chosen += found
    if not chosen:
        return axes
    if len({len(axis.values) for axis in chosen}) > 1:
        counts = ", ".join(f"{axis.name} {len(axis.values)}" for axis in chosen)
        raise CulmError(f"--paired: the variations differ in their numbers of values: {counts}")
    if len({axis.is_refined for axis in chosen}) > 1:
        raise CulmError("--paired: one of the variations is refined, another one is not")
    others = [axis for axis in axes if axis not in chosen]
    return [PairedAxis(chosen), *others]


def refuse_overlaps(option, named):
    """An error where two variations set the same: only the last one would count.

    @param named  names of what varies, each with the paths that it sets
    """
    owners = {}
    for number, (name, paths) in enumerate(named):
        for path in paths:
            first = owners.setdefault(path, number)
            if first != number:
                raise CulmError(f"{option}: both '{named[first][0]}' and '{name}' set {path}: only the last one would count", 2)


def refuse_set(settings, named):
    """An error where --set gives what varies: it would count for nothing."""
    given = {setting.partition("=")[0].strip(): setting for setting in settings}
    for name, paths in named:
        for path in paths:
            if path in given:
                raise CulmError(f"--set {given[path]}: '{name}' varies {path}, so that this counts for nothing; leave one of them out", 2)


def places(name, deck):
    """The paths that a name stands for. Other paths are left to the program to judge."""
    if name in deck.variables:
        if name in SHORT_NAMES:
            print(f"note: '{name}' is the variable of the deck, not short for {' and '.join(SHORT_NAMES[name])}", file=sys.stderr)
        return [name]
    if name in SHORT_NAMES:
        found = [path for pattern in SHORT_NAMES[name] for path in deck.matching(pattern)]
        if found:
            return found
        raise CulmError(f"--vary {name}: the deck has no {' and no '.join(SHORT_NAMES[name])}")
    if "*" in name:
        found = deck.matching(name)
        if found:
            return found
        raise CulmError(f"--vary {name}: no parameter of the deck is named so")
    if "/" in name or name in deck.parameters:
        return [name]
    known = [*SHORT_NAMES, *deck.parameters]
    close = difflib.get_close_matches(name, known, 1, 0.5)
    # a variable of the deck is a single word, too, and not in the resolved deck
    return [name] if not close or name[:1].isupper() else _unknown(name, close[0])


def _unknown(name, close):
    raise CulmError(f"--vary {name}: unknown name; did you mean '{close}'?")


def _hint(name, known):
    close = difflib.get_close_matches(name, known, 1, 0.4)
    return f"; did you mean '{close[0]}'?" if close else f" ({', '.join(known)})"


def _values(text, given):
    """Texts, and for a range whether it rises."""
    match = RANGE.fullmatch(given.strip())
    if match:
        return _range(text, *match.groups())
    if ":" in given:
        raise CulmError(f"--vary {text}: a range is written first:last*factor or first:last/factor")
    values = [value.strip() for value in re.split(r",(?![^{]*\})", given)]
    if not all(values):
        raise CulmError(f"--vary {text}: a value is empty")
    return values, None


def _range(text, first, last, sign, by):
    start, end, factor = float(first), float(last), float(by)
    if sign == "/":
        factor = 1.0 / factor if factor > 0.0 else 0.0
    if start <= 0.0 or not 0.0 < end / start < math.inf or not 0.0 < factor < math.inf or factor == 1.0:
        raise CulmError(f"--vary {text}: a range has positive ends and a positive factor other than 1")
    steps = math.log(end / start) / math.log(factor)
    if steps < -1e-9:
        raise CulmError(f"--vary {text}: {sign}{by} leads away from {last}")
    count = math.floor(steps + 1e-6) + 1
    if count > MOST_VALUES:
        raise CulmError(f"--vary {text}: {count} values, more than {MOST_VALUES}")
    whole = re.fullmatch(r"\d+", first) and all(
        abs(start * factor**i - round(start * factor**i)) < 1e-9 for i in range(count)
    )
    return [_text(start * factor**i, whole) for i in range(count)], end > start


def _text(number, whole):
    return str(round(number)) if whole else f"{number:.12g}"


def _spaced(value):
    """Generalised-Alpha is Generalised Alpha; numbers keep their sign."""
    return value if re.fullmatch(NUMBER, value) else value.replace("-", " ")
