"""Elements of ANSYS as shells, beams and point masses."""

import numpy

from .ansys_properties import make_profile, make_wall
from .findings import did_you_mean, refuse
from .model import BeamElement, PointMass, ShellElement

SHELLS = {181: 4, 281: 8, 63: 4, 43: 4, 93: 8}
BEAMS = {188: 2, 189: 3, 4: 2}
MASS = 21
# do nothing by themselves, or act on surfaces and contacts
LEFT_OUT = {154: "surface elements", **{i: "contact elements" for i in range(169, 178)}, 200: "elements of a mesh alone"}


def make_elements(reader):
    seen = {}
    for number_, material, type, real, section, system, nodes, place in reader.elements:
        if type not in reader.types:
            refuse(place, f"there is no element type {type}{did_you_mean(type, reader.types)}")
        kind = reader.types[type]
        if kind in LEFT_OUT:
            reader.findings.leave_out(LEFT_OUT[kind], place)
            continue
        for node in nodes:
            if node and node not in reader.model.nodes:
                refuse(place, f"there is no node {node}")
        if number_ in seen:
            refuse(place, f"element {number_} is there twice")
        least = SHELLS.get(kind) or BEAMS.get(kind) or 1
        if len(nodes) < least or 0 in nodes[:least]:
            refuse(place, f"element {number_} of type {kind} has fewer than {least} nodes")
        if kind in SHELLS:
            if reader.keys.get((type, 1), 0) not in (0, 2) and kind in (181, 281):
                refuse(place, f"elements SHELL{kind} with KEYOPT(1) = {reader.keys[(type, 1)]} have no bending or no membrane")
            if reader.keys.get((type, 1), 0) != 0 and kind == 63:
                refuse(place, f"elements SHELL63 with KEYOPT(1) = {reader.keys[(type, 1)]} have no bending or no membrane")
            seen[number_] = len(reader.model.shells)
            wall = make_wall(reader, kind, material, real, section, place)
            axis = _axis(reader, nodes, system, place)
            reader.model.shells.append(ShellElement(number_, tuple(nodes[: SHELLS[kind]]), wall, place, axis))
        elif kind in BEAMS:
            seen[number_] = None
            _beam(reader, number_, kind, material, real, section, nodes, place)
        elif kind == MASS:
            seen[number_] = None
            if reader.keys.get((type, 1), 0) or reader.keys.get((type, 3), 0) not in (0, 2):
                refuse(place, "MASS21 in a plane, or by its volume (KEYOPT(3) = 3 or 4, KEYOPT(1) = 1), is not read")
            _point_mass(reader, nodes[0], real, reader.keys.get((type, 3), 0), place)
        else:
            refuse(place, f"elements of type {kind} have no counterpart in culm: it has shells, beams, point masses")
        reader.findings.count(f"elements of type {kind}")
    reader.numbers = seen
    if not reader.model.shells and not reader.model.beams:
        refuse(reader.kind_place or reader.path, "the file has no shells and no beams")


def _axis(reader, nodes, system, place):
    """Axis 1: x of the system of the element, or from side to side."""
    if system:
        if system in reader.curved:
            refuse(place, f"directions in the system {system}, which is not Cartesian, are not read")
        if system not in reader.systems:
            refuse(place, f"there is no system of coordinates {system}")
        return tuple(reader.systems[system][0])
    p = [reader.model.nodes[node] for node in nodes[:4]]
    return tuple(p[1] + p[2] - p[0] - p[3])


def _beam(reader, number_, kind, material, real, section, nodes, place):
    """Axes y, z of the section are d1, d2; the third node lies in the plane of x and z."""
    size = BEAMS[kind]
    start, end = (reader.model.nodes[node] for node in nodes[:2])
    x = end - start
    if numpy.linalg.norm(x) == 0.0:
        refuse(place, f"beam element {number_} has no length")
    if len(nodes) > size and nodes[size]:
        up = numpy.cross(reader.model.nodes[nodes[size]] - start, x)
    else:
        up = numpy.cross([0.0, 0.0, 1.0], x)
        if numpy.linalg.norm(up) <= 1e-4 * numpy.linalg.norm(x):
            up = numpy.array([0.0, 1.0, 0.0])
    up = tuple(numpy.round(up / (numpy.linalg.norm(up) or 1.0), 12))
    name = make_profile(reader, kind, material, real, section, place)
    reader.beam_places[number_] = len(reader.model.beams)
    reader.model.beams.append(BeamElement(number_, tuple(nodes[:size]), name, up, place))


def _point_mass(reader, node, real, key, place):
    values = [*reader.constants.get(real, []), *[0.0] * 6]
    if key == 2:
        inertia = None
    else:
        inertia = (values[3], values[4], values[5], 0.0, 0.0, 0.0)
        if key == 0 and not (values[0] == values[1] == values[2] or values[1] == values[2] == 0.0):
            reader.findings.assume("a point mass is the same in all directions: that along x", place)
    if values[0] <= 0.0:
        refuse(place, f"the constants {real} give no mass")
    reader.model.masses.append(PointMass(node, values[0], place, inertia if inertia and any(inertia) else None))
