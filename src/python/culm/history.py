"""The history of a run, as it stands in history.csv."""

import collections
import csv
import io
import math

from .errors import CulmError


def name_of(column):
    """A column without its unit, which stands in brackets at its end."""
    return column.rpartition(" [")[0] if column.endswith("]") and " [" in column else column


def unit_of(column):
    return column.removeprefix(name_of(column)).strip(" []")


def owners_of(columns, quantities):
    """Of each column the quantity that it shows, and its component: {column: (quantity, component)}.

    A name alone does not tell: 'tip ux' is a component of 'tip', or a quantity with one number. The order does: columns stand
    in the order of the quantities, and each quantity has some.

    @param quantities  names of all entries of the history in the deck
    """
    names = [name_of(column) for column in columns]
    numbers = {one: k for k, one in enumerate(quantities)}
    fitting = [_fitting(name, numbers) for name in names]
    chosen = _in_order(names, fitting, quantities)
    if chosen is None:  # a history of another deck
        chosen = [max(which, key=lambda k: len(quantities[k]), default=None) for which in fitting]
    return {column: _named(name, k, quantities) for column, name, k in zip(columns, names, chosen)}


def _fitting(name, numbers):
    """Numbers of the quantities that a column may show by its name: those that it begins with, up to a space or its end."""
    beginnings = (name[:i] for i in range(len(name) + 1) if name[i : i + 1] in (" ", ""))
    return [numbers[one] for one in beginnings if one in numbers]


def _in_order(names, fitting, quantities):
    """The number of the quantity of each column, rising from the first one to the last; None where that cannot be."""
    if not names or not quantities:
        return None
    # from the end: which quantities a column may show so that the columns behind it have theirs
    possible = [set() for _ in names]
    possible[-1] = {len(quantities) - 1} & set(fitting[-1])
    for i in range(len(names) - 2, -1, -1):
        possible[i] = {k for k in fitting[i] if possible[i + 1] & {k, k + 1}}
    if 0 not in possible[0]:
        return None
    chosen = [0]
    for i in range(1, len(names)):
        k = chosen[-1]
        stays, goes_on = k in possible[i], k + 1 in possible[i]
        # 'tip root Fx' is of 'tip root' rather than of 'tip'
        chosen.append(k + 1 if goes_on and (not stays or " " in _named(names[i], k, quantities)[1]) else k)
    return chosen


def _named(name, number, quantities):
    return (name, "") if number is None else (quantities[number], name[len(quantities[number]) :].strip())


def whole_lines(path):
    """Lines of a history.csv; not the last one where its end is missing, which a run is about to write or a full disk had no room for."""
    with open(path, newline="", encoding="utf-8") as file:
        lines = file.readlines()
    return lines if not lines or lines[-1].endswith(("\n", "\r")) else lines[:-1]


def frame_of(path):
    """A history.csv as a pandas frame, by time or level."""
    import pandas

    types = collections.defaultdict(lambda: "float64", analysis="int64", step="int64")
    text = io.StringIO("".join(whole_lines(path)))
    return pandas.read_csv(text, index_col=0, dtype=types, float_precision="round_trip")


def _is_number(cell):
    try:
        float(cell)
    except ValueError:
        return False
    return True


class History:
    """Columns of history.csv by name, such as 'tip ux [m]', and of its rows the levels, the numbers of analyses in the deck
    and their steps, from 1; 0 is the start of an analysis. Where a cell is empty, because the quantity does not exist there, stands
    nan; whether all numbers that were written are finite says is_finite."""

    def __init__(self, path):
        try:
            rows = [row for row in csv.reader(whole_lines(path)) if row]
        except (UnicodeDecodeError, csv.Error) as error:
            raise CulmError(f"'{path}' is no table of a history: {error}", 6) from error
        if not rows:
            raise CulmError(f"'{path}' is no table of a history: it is empty", 6)
        for number, row in enumerate(rows[1:], 2):
            if len(row) != len(rows[0]) or not row[0] or not all(_is_number(cell) for cell in row if cell):
                raise CulmError(f"'{path}', line {number}: not {len(rows[0])} numbers, as the first line has names", 6)
        tells_places = rows[0][-2:] == ["analysis", "step"]  # a reference from elsewhere need not
        self.names = rows[0][1:-2] if tells_places else rows[0][1:]
        self.levels = [float(row[0]) for row in rows[1:]]
        self.analyses = [int(row[-2]) if tells_places else 0 for row in rows[1:]]
        self.steps = [int(row[-1]) if tells_places else number for number, row in enumerate(rows[1:])]
        self.is_finite = all(math.isfinite(float(cell)) for row in rows[1:] for cell in row if cell)
        self.columns = {
            name: [float(row[i + 1] or math.nan) for row in rows[1:]] for i, name in enumerate(self.names)
        }
        self._owned = (None, {})

    def owned(self, quantities):
        """Columns by the quantity that they show, with their components: {quantity: {column: component}}, as owners_of tells."""
        if self._owned[0] is not quantities:  # who asks for each of them in turn hands over the same list
            found = {}
            for column, (quantity, component) in owners_of(self.names, quantities).items():
                found.setdefault(quantity, {})[column] = component
            self._owned = (quantities, found)
        return self._owned[1]

    def row(self, level):
        """The number of the row at a level that was met exactly."""
        for i, one in enumerate(self.levels):
            if abs(one - level) <= 1e-9 * max(1.0, abs(level)):
                return i
        raise KeyError(f"no step ends at level {level}")

    def at(self, level, column):
        return self.column(column)[self.row(level)]

    def column(self, name):
        if name not in self.columns:
            raise KeyError(f"no column '{name}' among: {', '.join(self.names)}")
        return self.columns[name]

    def names_of(self, quantity):
        """The columns of a quantity with several components, given by its name in the deck."""
        return [name for name in self.names if name_of(name).rpartition(" ")[0] == quantity]

    def vector(self, quantity, level=None):
        """The values of all columns of a quantity at a level, at the last one if none is given."""
        row = -1 if level is None else self.row(level)
        names = self.names_of(quantity)
        if not names:
            raise KeyError(f"no quantity '{quantity}' among: {', '.join(self.names)}")
        return [self.columns[name][row] for name in names]
