"""Shells, beams, masses and couplings of Nastran."""

import re

import numpy

from .findings import refuse
from .model import BeamElement, Coupling, PointMass, ShellElement
from .nastran_file import REAL
from .nastran_nodes import find_system
from .nastran_properties import find_property

SHELLS = {"CQUAD4": 4, "CQUADR": 4, "CTRIA3": 3, "CTRIAR": 3, "CQUAD8": 8, "CTRIA6": 6}


def read_shells(reader):
    reader.places = {}
    for card in reader.cards(*SHELLS):
        number = reader.unique(reader.places, card, "element")
        size = SHELLS[card.name]
        nodes = tuple(reader.node(card, 3 + i) for i in range(size))
        wall = find_property(reader, card, "shell")
        angle = {3: 6, 4: 7, 6: 9, 8: 15}[size]
        offset = {3: 7, 4: 8, 6: 10, 8: 16}[size]
        if card.real(offset, default=0.0):
            reader.findings.leave_out("ZOFFS of shells: the nodes are in the middle of the wall", card.place)
        axis = _axis(reader, card, nodes, angle, wall)
        reader.places[number] = ("shell", len(reader.model.shells))
        reader.model.shells.append(ShellElement(number, nodes, wall, card.place, axis))


def _axis(reader, card, nodes, field, wall):
    """Axis 1 of the material: from the first side by an angle, or the x axis of a system."""
    text = card.text(field)
    layers = reader.model.walls[wall].layers
    if all(reader.model.materials[layer.material].type == "Isotropic" for layer in layers):
        return None
    if text and "." not in text and not re.search("[EeDd]", text):
        _, axes = find_system(reader, card, field)
        return tuple(axes[0])
    side = reader.model.nodes[nodes[1]] - reader.model.nodes[nodes[0]]
    last = nodes[3] if SHELLS[card.name] in (4, 8) else nodes[2]
    normal = numpy.cross(side, reader.model.nodes[last] - reader.model.nodes[nodes[0]])
    if numpy.linalg.norm(normal) == 0.0:
        refuse(card.place, "an element has no area")
    normal = normal / numpy.linalg.norm(normal)
    turn = numpy.radians(card.real(field, default=0.0))
    return tuple(side * numpy.cos(turn) + numpy.cross(normal, side) * numpy.sin(turn))


def read_beams(reader):
    for card in reader.cards("CBAR", "CBEAM"):
        number = reader.unique(reader.places, card, "element")
        a, b = reader.node(card, 3), reader.node(card, 4)
        systems = card.text(8).upper() or "GGG"
        if not re.fullmatch("[BG][GEO]{2}", systems):
            refuse(card.place, f"{card.name} with OFFT = {systems[:8]} is not read")
        if card.text(6) or card.text(7) or not re.fullmatch("[0-9]+", card.text(5)):
            up = numpy.array([card.real(5 + i, default=0.0) for i in range(3)])
            up = up @ reader.axes[a] if a in reader.axes and systems[0] == "G" else up
        else:
            up = reader.model.nodes[reader.node(card, 5)] - reader.model.nodes[a]
        if any(card.text(i).strip("0") for i in (9, 10)):
            reader.findings.leave_out("pins of beams: their ends are held fast", card.place)
        ends = tuple(_beside(reader, node, card, 11 + 3 * i, systems[1 + i]) for i, node in enumerate((a, b)))
        reader.places[number] = ("beam", len(reader.model.beams))
        reader.model.beams.append(BeamElement(number, ends, find_property(reader, card, "beam"), tuple(up), card.place))


def _beside(reader, node, card, field, system):
    """The end of a beam: the node, or one that an arm holds beside it."""
    offset = numpy.array([card.real(field + i, default=0.0) for i in range(3)])
    if not offset.any():
        return node
    if system != "G":
        refuse(card.place, f"offsets in the axes of the element (OFFT {card.text(8)}) are not read")
    offset = offset @ reader.axes[node] if node in reader.axes else offset
    key = (node, tuple(numpy.round(offset, 9)))
    if key not in reader.offset_nodes:
        end = f"{node} offset {len(reader.offset_nodes) + 1}"
        reader.offset_nodes[key] = end
        reader.model.nodes[end] = reader.model.nodes[node] + offset
        reader.model.couplings.append(Coupling(node, [end], card.place, "offset"))
        reader.findings.assume("offsets of beams are rigid arms", card.place)
    return reader.offset_nodes[key]


def read_masses(reader):
    for card in reader.cards("CONM2"):
        reader.unique(reader.places, card, "element")
        if card.integer(3, default=0) not in (0,):
            refuse(card.place, "CONM2 in a system of coordinates of its own is not read")
        offset = tuple(card.real(i, default=0.0) for i in (5, 6, 7))
        I11, I21, I22, I31, I32, I33 = (card.real(i, default=0.0) for i in range(9, 15))
        inertia = numpy.array([I11, I22, I33, -I32, -I31, -I21]) * reader.masses_by
        reader.model.masses.append(
            PointMass(
                reader.node(card, 2),
                card.real(4, default=0.0) * reader.masses_by,
                card.place,
                tuple(inertia) if inertia.any() else None,
                offset,
            )
        )


def read_couplings(reader):
    for card in reader.cards("RBE2"):
        followers = [card.text(i) for i in range(4, len(card.fields) + 1)]
        if followers and "." in (last := next((f for f in reversed(followers) if f), "")):
            card.fields[3 + len(followers) - 1 - followers[::-1].index(last)] = ""  # thermal expansion
        freedoms = set(card.text(3))
        if not freedoms >= set("123"):
            refuse(card.place, f"RBE2 that couples {card.text(3) or 'nothing'} is not read; 123 and 123456 are")
        if not freedoms >= set("123456"):
            reader.findings.assume("RBE2 of translations only holds rotations, too", card.place)
        _couple(reader, reader.node(card, 2), card.numbers(4), card, "rbe2")
    for card in reader.cards("RBE3"):
        nodes = []
        words = [card.text(i) for i in range(5, len(card.fields) + 1)]
        for i, word in enumerate(words):
            if word.upper() in ("UM", "ALPHA"):
                break
            # weights are reals; the number after a weight is what is coupled
            if re.fullmatch("[0-9]+", word) and not (i and "." in words[i - 1]):
                nodes.append(int(word))
            elif word and not re.fullmatch(r"[0-9]+", word) and not re.fullmatch(REAL, word.upper()):
                refuse(card.place, f"RBE3 with '{word[:20]}' among its nodes is not read")
        reader.findings.assume("RBE3 is a rigid coupling, which is stiffer", card.place)
        _couple(reader, reader.node(card, 3), nodes, card, "rbe3")


def _couple(reader, reference, followers, card, name):
    for node in followers:
        reader.find(reader.model.nodes, node, card, "node")
    reader.model.couplings.append(Coupling(reference, [n for n in followers if n != reference], card.place, name))


