"""The history of a run, as it stands in history.csv."""

import csv
import math


def quantity_of(column, quantities):
    """The quantity that a column shows, and its component.

    @param quantities  names of all entries of the history in the deck
    """
    name = column.split(" [")[0]
    fitting = [one for one in quantities if name == one or name.startswith(f"{one} ")]
    if not fitting:
        return name, ""
    longest = max(fitting, key=len)
    return longest, name[len(longest) :].strip()


class History:
    """Columns of history.csv by name, such as 'tip ux [m]', and of its rows the levels, the numbers of analyses in the deck
    and their steps, from 1; 0 is the start of an analysis. Where a cell is empty, because the quantity does not exist there, stands
    nan; whether all numbers that were written are finite says is_finite."""

    def __init__(self, path):
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
        tells_places = rows[0][-2:] == ["analysis", "step"]  # a reference from elsewhere need not
        self.names = rows[0][1:-2] if tells_places else rows[0][1:]
        self.levels = [float(row[0]) for row in rows[1:]]
        self.analyses = [int(row[-2]) if tells_places else 0 for row in rows[1:]]
        self.steps = [int(row[-1]) if tells_places else number for number, row in enumerate(rows[1:])]
        self.is_finite = all(math.isfinite(float(cell)) for row in rows[1:] for cell in row if cell)
        self.columns = {
            name: [float(row[i + 1] or math.nan) for row in rows[1:]] for i, name in enumerate(self.names)
        }

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
        """The columns of a quantity, given by its name in the deck."""
        return [name for name in self.names if name.split(" [")[0].rsplit(" ", 1)[0] == quantity]

    def vector(self, quantity, level=None):
        """The values of all columns of a quantity at a level, at the last one if none is given."""
        row = -1 if level is None else self.row(level)
        names = self.names_of(quantity)
        if not names:
            raise KeyError(f"no quantity '{quantity}' among: {', '.join(self.names)}")
        return [self.columns[name][row] for name in names]
