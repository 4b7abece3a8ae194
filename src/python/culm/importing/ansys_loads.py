"""Supports and loads of ANSYS."""

import collections

import numpy

from .ansys_nodes import nodes_of, refuse_ranges
from .findings import refuse
from .model import ElementLoad, NodeLoad, Step, Support, supports_along

FREEDOMS = {"UX": [1], "UY": [2], "UZ": [3], "ROTX": [4], "ROTY": [5], "ROTZ": [6], "ALL": [1, 2, 3, 4, 5, 6]}
FORCES = {"FX": 0, "FY": 1, "FZ": 2, "MX": 3, "MY": 4, "MZ": 5}


def read_support(reader, command):
    refuse_ranges(reader, command)
    label = command.text(2).upper()
    if label not in FREEDOMS:
        reader.findings.leave_out(f"D of {label}", command.place)
        return
    for node in nodes_of(reader, command):
        for freedom in FREEDOMS[label]:
            reader.supports[node][freedom] = command.real(3, default=0.0)
    reader.findings.count("lines of supports")


def read_force(reader, command):
    refuse_ranges(reader, command)
    label = command.text(2).upper()
    if label not in FORCES:
        reader.findings.leave_out(f"F of {label}", command.place)
        return
    for node in nodes_of(reader, command):
        reader.forces[node][FORCES[label]] = command.real(3, default=0.0)
    reader.findings.count("lines of forces")


def read_pressure(reader, command):
    if command.text(4) == "2" and not any(cell.strip("0. ") for cell in command.fields[4:]):
        return  # no imaginary part
    if command.text(3).upper() != "PRES" or command.text(4) not in ("0", "", "1"):
        reader.findings.leave_out(f"SFE of {command.text(3)}", command.place)
        return
    reader.pressures[(command.integer(1), command.integer(2))] = command
    reader.findings.count("lines of pressure")


def read_gravity(reader, command):
    """ACEL is the acceleration of the ground, against which masses weigh."""
    reader.gravity = -numpy.array([command.real(i, default=0.0) for i in (1, 2, 3)])
    reader.gravity_place = command.place


def make_loads(reader):
    groups = collections.defaultdict(list)
    for node, held in reader.supports.items():
        groups[tuple(sorted(held.items()))].append(node)
    for held, nodes in groups.items():
        reader.model.supports += supports_along(reader.axes, Support(nodes, dict(held), reader.places[("D", nodes[0])], "support"))
    name = reader.kind or "modal"
    if reader.kind is None:
        reader.findings.leave_out("the file has no ANTYPE that is read: the deck finds modes")
    reader.model.steps.append(Step(name, name, reader.kind_place, reader.modes, reader.nonlinear))
    if name == "static" and not reader.nonlinear:
        reader.findings.assume("a linear static step becomes a nonlinear one, which agrees where displacements are small")
    if name == "modal" and reader.prestress:
        reader.findings.leave_out("PSTRES: modes are those of the unloaded structure", reader.prestress.place)
    if name == "modal":
        if reader.forces or reader.pressures or reader.gravity.any():
            reader.findings.leave_out("loads: modes are those of the unloaded structure")
        return
    by_force = collections.defaultdict(list)
    for node, vector in reader.forces.items():
        if node in reader.axes:
            vector = numpy.concatenate([vector[:3] @ reader.axes[node], vector[3:] @ reader.axes[node]])
        if vector.any():
            by_force[tuple(vector)].append(node)
    for vector, nodes in by_force.items():
        reader.model.node_loads.append(NodeLoad(nodes, numpy.array(vector), reader.places[("F", nodes[0])], "force", {0}))
    _make_pressures(reader)
    if reader.gravity.any():
        reader.model.element_loads.append(ElementLoad("gravity", [], reader.gravity, reader.gravity_place, "gravity", {0}))


def _make_pressures(reader):
    """On face 1, the lower one, pressure is along the normal; on face 2 against it."""
    groups = collections.defaultdict(list)
    places = {}
    for (element, face), command in reader.pressures.items():
        if element not in reader.numbers:
            refuse(command.place, f"there is no element {element}")
        values = [command.real(i) for i in range(5, len(command.fields) + 1) if command.text(i)]
        if element in reader.beam_places and values:
            _add_line_load(reader, reader.beam_places[element], face, values, command)
            continue
        if face not in (1, 2) or reader.numbers[element] is None or not values:
            reader.findings.leave_out("SFE on edges", command.place)
            continue
        if values[0] and any(value == 0.0 for value in values[1:]):
            reader.findings.assume("a pressure of which the other values are 0 is that of its first node, all over", command.place)
            values = values[:1]
        # a triangle has its last corner twice
        corners = 3 if len(set(reader.model.shells[reader.numbers[element]].nodes[:4])) == 3 else 4
        values = [*values, *[values[0]] * 4][:corners]
        if min(values) != max(values):
            reader.findings.assume("pressure that varies over an element is its mean", command.place)
        value = sum(values) / corners if face == 1 else -sum(values) / corners
        groups[value].append(reader.numbers[element])
        places.setdefault(value, command.place)
    for value, elements in groups.items():
        reader.model.element_loads.append(ElementLoad("pressure", elements, value, places[value], "pressure", {0}))


def _add_line_load(reader, beam, face, values, command):
    """Force per length: face 1 pushes against z of the section, face 2 against y, face 3 along the axis."""
    if face not in (1, 2, 3) or any(value != values[0] for value in values[1:]) or len(values) > 2:
        reader.findings.leave_out("SFE on beams that varies, or on their ends", command.place)
        return
    element = reader.model.beams[beam]
    x = reader.model.nodes[element.nodes[1]] - reader.model.nodes[element.nodes[0]]
    x = x / numpy.linalg.norm(x)
    z = numpy.cross(x, element.up) / numpy.linalg.norm(numpy.cross(x, element.up))
    force = values[0] * {1: -z, 2: -numpy.cross(z, x), 3: x}[face]
    reader.model.element_loads.append(ElementLoad("line", [beam], force, command.place, "line load", {0}))
