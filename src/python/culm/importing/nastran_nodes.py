"""Systems of coordinates and nodes of Nastran."""

import numpy

from .findings import refuse
from .model import cylinder_axes


def read_systems(reader):
    """Systems by three points: (origin, rows of axes)."""
    reader.systems = {0: (numpy.zeros(3), numpy.eye(3))}
    reader.curved = {}  # their cards: of these places are read, and directions refused
    cards = {}
    for card in reader.cards("CORD2R", "CORD2C", "CORD2S"):
        cards[reader.unique({**reader.systems, **cards}, card, "coordinate system")] = card
    waiting = list(cards.values())
    while waiting:
        waits_for = [card.integer(2, default=0) for card in waiting]
        ready = [card for card, one in zip(waiting, waits_for) if one in reader.systems or one not in cards]
        if not ready:
            refuse(waiting[0].place, "the system is given in one that is given in it")
        for card in ready:
            _read_system(reader, card)
        waiting = [card for card in waiting if card not in ready]


def _read_system(reader, card):
    """Three points in another system, which may be a cylindrical one."""
    number = card.integer(1)
    reader.find(reader.systems, card.integer(2, default=0), card, "coordinate system")
    a, b, c = (_position(reader, card, 2, first) for first in (3, 6, 9))
    z, x = b - a, c - a
    if numpy.linalg.norm(numpy.cross(z, x)) <= 1e-9 * numpy.linalg.norm(z) * numpy.linalg.norm(x):
        refuse(card.place, "the three points of the system are on one line")
    z = z / numpy.linalg.norm(z)
    y = numpy.cross(z, x) / numpy.linalg.norm(numpy.cross(z, x))
    reader.systems[number] = (a, numpy.array([numpy.cross(y, z), y, z]))
    if card.name != "CORD2R":
        reader.curved[number] = card


def find_system(reader, card, i):
    number = card.integer(i, default=0)
    if number in reader.curved:
        refuse(card.place, f"directions in the system {number}, {reader.curved[number].name}, are not read")
    return reader.find(reader.systems, number, card, "coordinate system")


def _position(reader, card, i, first=None):
    """A place in any system, which field i names: x, y, z, or r, theta, z from field `first` on, or else behind it."""
    number = card.integer(i, default=0)
    origin, axes = reader.find(reader.systems, number, card, "coordinate system")
    first = i + 1 if first is None else first
    place = numpy.array([card.real(first + k, default=0.0) for k in range(3)])
    if number in reader.curved:
        if reader.curved[number].name == "CORD2S":
            refuse(card.place, f"places in the system {number}, CORD2S, are not read")
        angle = numpy.radians(place[1])
        place = numpy.array([place[0] * numpy.cos(angle), place[0] * numpy.sin(angle), place[2]])
    return origin + place @ axes


def vector_of(reader, card, system, first):
    """A direction in a system of coordinates, in space."""
    _, axes = find_system(reader, card, system)
    return numpy.array([card.real(first + k, default=0.0) for k in range(3)]) @ axes


def read_nodes(reader):
    reader.axes = {}  # rows of the system of a node's degrees of freedom
    reader.held = {}  # by the cards of the nodes
    defaults = _defaults(reader)
    for card in reader.cards("GRID"):
        card.fill_in(defaults)
        number = reader.unique(reader.model.nodes, card, "node")
        reader.model.nodes[number] = _position(reader, card, 2)
        if card.integer(6, default=0) > 0:
            reader.axes[number] = _axes_at(reader, reader.model.nodes[number], card, 6)
        if card.text(7).strip("0"):
            reader.held[number] = (card.text(7), card)
    if not reader.model.nodes:
        refuse(reader.deck.cards[0].place if reader.deck.cards else reader.path, "the file has no GRID")


def _defaults(reader):
    """What GRDSET says of nodes that leave fields empty, by the numbers of the fields: systems, and what is held."""
    cards = list(reader.cards("GRDSET"))
    if len(cards) > 1:
        refuse(cards[1].place, "GRDSET is there twice")
    return {i: card.text(i) for card in cards for i in (2, 6, 7)}


def _axes_at(reader, position, card, i):
    number = card.integer(i)
    origin, axes = reader.find(reader.systems, number, card, "coordinate system")
    if number not in reader.curved:
        return axes
    if reader.curved[number].name == "CORD2S":
        refuse(card.place, f"directions in the system {number}, CORD2S, are not read")
    return cylinder_axes(origin, axes[2], position, card.place)
