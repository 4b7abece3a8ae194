"""What the elements of a recorded state carry, as one number each for a picture."""

import dataclasses

import numpy


@dataclasses.dataclass
class Coloured:
    """@param values  a number for each cell, by structure"""

    title: str
    unit: str
    values: dict

    def largest(self):
        return max(float(numpy.abs(one).max()) for one in self.values.values() if one.size)


FAINT = 1e-8  # a force beside a moment over the size of the model, or that beside the force: less is rounding


def of_state(fields, size):
    """Pictures of a state: what is there and not nothing.

    @param size    of the model [m]
    @param fields  of each structure (is_surface, {name: (columns, values (cells, columns))}), as Results.cell_fields()"""
    found = [
        _collect("von Mises stress, largest over layers and faces", "Pa", fields, _of_layers),
        _collect("normal force", "N", fields, lambda names, *table: _column(table, names, "N3")),
        _collect("bending moment", "N m", fields, lambda names, *table: _length(table, names, ("M1", "M2"))),
        _collect("torsion moment", "N m", fields, lambda names, *table: _column(table, names, "M3")),
        _collect("membrane force, largest principal", "N/m", fields, lambda names, *table: _principal(table, names, "N")),
        _collect("bending moment of shells, largest principal", "N m/m", fields, lambda names, *table: _principal(table, names, "M")),
    ]
    found = [one for one in found if one is not None]
    as_forces = [one.largest() / (size if "moment" in one.title else 1.0) for one in found]
    return [one for one, force in zip(found, as_forces) if one.unit == "Pa" or force > FAINT * max(as_forces)]


def _collect(title, unit, fields, number_of):
    values = {}
    for structure, (_, tables) in fields.items():
        found = _of_tables(tables, number_of)
        if found is not None:
            values[structure] = found
    found = Coloured(title, unit, values)
    return found if values and found.largest() > 0.0 else None


def _of_tables(tables, number_of):
    """The largest of what the tables of a structure give; None where none does."""
    found = None
    for name, (columns, values) in tables.items():
        one = number_of([name], columns, values)
        if one is not None:
            found = one if found is None else numpy.maximum(found, one)
    return found


def _of_layers(names, columns, values):
    if not names[0].startswith("stress layer"):
        return None
    S = dict(zip(columns, values.T))
    if not {"S11", "S22", "S33", "S23", "S13", "S12"} <= set(S):
        return None
    differences = (S["S11"] - S["S22"]) ** 2 + (S["S22"] - S["S33"]) ** 2 + (S["S33"] - S["S11"]) ** 2
    return numpy.sqrt(0.5 * differences + 3.0 * (S["S12"] ** 2 + S["S13"] ** 2 + S["S23"] ** 2))


def _column(table, names, column):
    columns, values = table
    if names[0] != "resultants" or column not in columns:
        return None
    return values[:, columns.index(column)]


def _length(table, names, wanted):
    parts = [_column(table, names, column) for column in wanted]
    return None if any(part is None for part in parts) else numpy.sqrt(sum(part**2 for part in parts))


def _principal(table, names, letter):
    """Of the two principal values the one that is larger without its sign."""
    parts = [_column(table, names, letter + axes) for axes in ("11", "22", "12")]
    if any(part is None for part in parts):
        return None
    first, second, shear = parts
    middle, radius = 0.5 * (first + second), numpy.hypot(0.5 * (first - second), shear)
    return middle + numpy.where(middle < 0.0, -radius, radius)
