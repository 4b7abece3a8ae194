"""Sets of loads of Nastran."""

import collections

import numpy

from .findings import refuse
from .model import ElementLoad, NodeLoad
from .nastran_nodes import vector_of

LINE_LOADS = ("FX", "FY", "FZ", "FXE", "FYE", "FZE")


def read_loads(reader):
    """Load cards by the number of their set."""
    reader.loads = []
    reader.reached = set()
    for name in ("FORCE", "MOMENT", "PLOAD4", "PLOAD2", "PLOAD1", "GRAV"):
        for card in reader.cards(name):
            reader.loads.append((card.integer(1, "the number of a load set"), card))


def add_load_set(reader, text, factor, step, seen):
    number = int(text)
    if number in seen:
        refuse(reader.deck.cards[0].place, f"LOAD {number} contains itself")
    reader.reached.add(number)
    cards = [card for one, card in reader.loads if one == number]
    combined = [card for card in reader.by_name["LOAD"] if card.integer(1) == number]
    if not cards and not combined:
        refuse(reader.deck.cards[0].place, f"there is no load of the set {number} that a case names")
    for card in combined:
        overall = card.real(2, default=1.0)
        for i in range(3, len(card.fields), 2):
            if card.text(i):
                part = str(card.integer(i + 1))
                add_load_set(reader, part, factor * overall * card.real(i), step, seen | {number})
    nodal = collections.defaultdict(lambda: numpy.zeros(6))
    places = {}
    for card in cards:
        if card.name in ("FORCE", "MOMENT"):
            node = reader.node(card, 2)
            first = 0 if card.name == "FORCE" else 3
            nodal[node][first : first + 3] += factor * card.real(4) * vector_of(reader, card, 3, 5)
            places.setdefault(node, card.place)
        else:
            _add_element_load(reader, card, factor, step)
    groups = collections.defaultdict(list)
    for node, vector in nodal.items():
        groups[tuple(vector)].append(node)
    for vector, nodes in groups.items():
        name = f"load {number}"
        reader.model.node_loads.append(NodeLoad(nodes, numpy.array(vector), places[nodes[0]], name, {step}))


def _add_element_load(reader, card, factor, step):
    name = f"{card.name.lower()} {card.integer(1)}"
    if card.name == "GRAV":
        value = factor * card.real(3) * vector_of(reader, card, 2, 4)
        reader.model.element_loads.append(ElementLoad("gravity", [], value, card.place, name, {step}))
        return
    if card.name == "PLOAD1":
        _add_line_load(reader, card, factor, step, name)
        return
    if card.name == "PLOAD4":
        values = [card.real(3), *(card.real(i, default=card.real(3)) for i in (4, 5, 6))]
        if max(values) != min(values):
            reader.findings.assume("pressure that varies over an element is its mean", card.place)
        if any(card.real(i, default=0.0) for i in (10, 11, 12)):
            reader.findings.leave_out("PLOAD4 with a direction", card.place)
            return
        thru = card.text(7).upper() == "THRU"
        elements = range(card.integer(2), card.integer(8) + 1) if thru else [card.integer(2)]
    else:
        thru, values, elements = card.has_thru(3), 4 * [card.real(2)], card.numbers(3)
    if not thru:
        for element in elements:
            reader.find(reader.places, element, card, "element")
    chosen = [reader.places[e][1] for e in elements if reader.places.get(e, ("",))[0] == "shell"]
    if not chosen:
        reader.findings.leave_out(f"{card.name} on elements that are no shells", card.place)
    for corners in (3, 4):
        those = [one for one in chosen if (3 if len(reader.model.shells[one].nodes) in (3, 6) else 4) == corners]
        if those:
            value = factor * sum(values[:corners]) / corners
            reader.model.element_loads.append(ElementLoad("pressure", those, value, card.place, name, {step}))


def _add_line_load(reader, card, factor, step, name):
    """A force per length that is the same all along an element."""
    kind, element = reader.find(reader.places, card.integer(2), card, "element")
    direction, scale = card.text(3).upper(), card.text(4).upper()
    first, last = card.real(5, default=0.0), card.real(7, default=-1.0)
    if kind != "beam" or direction not in LINE_LOADS or scale not in ("LE", "FR"):
        reader.findings.leave_out(f"PLOAD1 of {direction or 'no direction'}, {scale or 'no scale'}", card.place)
        return
    beam = reader.model.beams[element]
    axis = reader.model.nodes[beam.nodes[1]] - reader.model.nodes[beam.nodes[0]]
    length = float(numpy.linalg.norm(axis))
    values = (card.real(6), card.real(8, default=card.real(6)))
    whole = 1.0 if scale == "FR" else length
    if first != 0.0 or abs(last - whole) > 1e-6 * whole or values[0] != values[1]:
        reader.findings.leave_out("PLOAD1 on a part of an element, at a point of it, or that varies", card.place)
        return
    x = axis / length
    z = numpy.cross(x, beam.up)
    z = z / (numpy.linalg.norm(z) or 1.0)
    of_element = numpy.array([x, numpy.cross(z, x), z])
    axes = of_element if direction.endswith("E") else numpy.eye(3)
    force = factor * values[0] * axes["XYZ".index(direction[1])]
    reader.model.element_loads.append(ElementLoad("line", [element], force, card.place, name, {step}))
