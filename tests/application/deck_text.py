"""Decks of tables as text, and what their runs leave in history.csv."""

import csv


def entry(name, **values):
    """A list of parameters; underscores are blanks."""
    parameters = "".join(f'<Parameter name="{key.replace("_", " ")}" value="{value}"/>' for key, value in values.items())
    return f'<ParameterList name="{name}">{parameters}</ParameterList>'


def listed(name, *entries):
    """A list of lists."""
    return f'<ParameterList name="{name}">{"".join(entries)}</ParameterList>'


def rail(node):
    """Supports that leave a body nothing but to slide along x."""
    return [entry(f"{node} {name}", Type="Simple Support", Node=node, Direction=axis) for name, axis in (("y", "{0, 1, 0}"), ("z", "{0, 0, 1}"))] + [
        entry(f"{node} turn {name}", Type="Rotation", Node=node, Axis=axis) for name, axis in (("x", "{1, 0, 0}"), ("y", "{0, 1, 0}"), ("z", "{0, 0, 1}"))]


def cut(text, first, last):
    """The part of a text from one word to the end of another."""
    start = text.index(first)
    return text[start : text.index(last, start) + len(last)]


def rows(folder):
    """Values of all steps by the names of their columns."""
    with open(folder / "out/history.csv", newline="") as file:
        names, *steps = list(csv.reader(file))
    return [{name: float(value or "nan") for name, value in zip(names, step)} for step in steps]


def last_row(folder):
    """Values of the last step by the names of their columns."""
    return rows(folder)[-1]


def ends_with(column, value, tolerance):
    """A check of this value."""
    def check(folder, _):
        found = last_row(folder)[column]
        return "" if abs(found - value) <= tolerance else f"{column} is {found}, not {value}"

    return check
