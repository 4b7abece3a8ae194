"""Sections of a beam from a table with commas: a header with names, a line for each station."""

import csv
import io

import numpy

from .findings import Findings, Place, did_you_mean, refuse
from .keyword_file import number, read_text
from .line_deck import LineDeck, stations_in_order
from .ready_deck import ReadyDeck

FILE = "table, .csv; its header names position, the values of a section (as in the deck), and x, y, twist if there are any"
REQUIRED = ("EA", "GA1", "GA2", "EI1", "EI2", "GIp")
OPTIONAL = (
    "ES1", "ES2", "GS1", "GS2", "EI12", "rhoA", "rhoI1", "rhoI2", "rhoS1", "rhoS2", "rhoI12",
)  # fmt: skip
PLACES = ("position", "x", "y", "twist")


def read(path, arguments):
    """@return the ReadyDeck of a clamped beam along z; positions in m, twist in degrees from d1 to d2"""
    del arguments
    text = read_text(path)
    findings = Findings()
    findings.look_at_end(path)
    lines = [(i, line) for i, line in enumerate(text.split("\n"), 1) if line.strip() and not line.lstrip().startswith("#")]
    if not lines:
        refuse(Place(str(path), 1), "the table is empty")
    rows = [(Place(str(path), i), next(csv.reader(io.StringIO(line)))) for i, line in lines]
    place, header = rows[0]
    names = [cell.strip() for cell in header]
    for name in names:
        if name not in (*REQUIRED, *OPTIONAL, *PLACES):
            refuse(place, f"unknown column '{name[:40]}'{did_you_mean(name, (*REQUIRED, *OPTIONAL, *PLACES))}")
    for name in ("position", *REQUIRED):
        if names.count(name) != 1:
            refuse(place, f"the column '{name}' must be there once")
    if len(set(names)) != len(names):
        refuse(place, "a column is there twice")
    table = {name: [] for name in names}
    for where, cells in rows[1:]:
        if len(cells) != len(names):
            refuse(where, f"expected {len(names)} values, found {len(cells)}")
        for name, cell in zip(names, cells):
            table[name].append(number(cell, where, f"a number in the column '{name}'"))
    table = {name: numpy.array(values) for name, values in table.items()}
    for name in REQUIRED:
        if not (table[name] > 0.0).any():
            refuse(place, f"the column '{name}' has no value > 0: without this stiffness the beam is a mechanism")
    stations_in_order(table["position"], lambda text: refuse(rows[-1][0], text))
    return _deck(path, table, findings, rows[1][0])


def _deck(path, table, findings, place):
    z = table["position"]
    zero = numpy.zeros(len(z))
    points = numpy.stack([table.get("x", zero), table.get("y", zero), z], axis=1)
    bent = numpy.any(points[:, :2] != points[0, :2])
    lengths = numpy.concatenate([[0.0], numpy.cumsum(numpy.linalg.norm(numpy.diff(points, axis=0), axis=1))])
    share = lengths / lengths[-1]
    names = [name for name in (*REQUIRED, *OPTIONAL) if name in table]
    stations = [
        (at, "Stiffness Values", {name: table[name][i] for name in names}, table.get("rhoA", zero)[i])
        for i, at in enumerate(share)
    ]
    deck = LineDeck(path.stem)
    keep = [0] + [i for i in range(1, len(points)) if lengths[i] > lengths[i - 1]]
    axis = points[keep] if bent else points[[0, -1]]
    deck.add_beam("beam", axis, stations, (share, numpy.radians(table.get("twist", zero))), place=place)
    deck.clamp("beam/first")
    findings.read["stations"] = len(z)
    findings.leave_out("a table of sections has no supports and loads: the beam is clamped at its first end")
    return ReadyDeck(deck.finish((0.0, 0.0, -9.81)), findings, deck.mass)

