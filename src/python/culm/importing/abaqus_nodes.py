"""Nodes of Abaqus and CalculiX, and the systems that they are given and held in."""

import numpy

from .abaqus_sets import add_to_set
from .findings import refuse
from .keyword_file import integer, numbers_of
from .model import cylinder_axes


def _nodes(reader, block):
    system = block.get("SYSTEM") or "R"
    if system not in ("R", "C", "S"):
        refuse(block.place, f"*NODE with SYSTEM={system} is not read; R, C and S are")
    found = []
    for place, cells in block.lines:
        key = reader.key(integer(cells[0], place, "the number of a node"))
        values = numbers_of(cells[1:4], place, "a coordinate")
        position = _in_space(system, numpy.array([*values, 0.0, 0.0, 0.0][:3]))
        if key in reader.model.nodes:
            refuse(place, f"node {cells[0]} is there twice")
        reader.model.nodes[key] = placed(reader, position)
        if reader.program == "Abaqus" and any(numbers_of(cells[4:7], place, "a direction")):
            reader.findings.leave_out("normals of *NODE, which directions of beam sections follow", place)
        found.append(key)
    reader.findings.count("nodes", len(found))
    add_to_set(reader.model.node_sets, reader, block.get("NSET"), found)


def _in_space(system, values):
    """Of radius, angle about z and height, or of radius, angle about z and height in degrees."""
    if system == "R":
        return values
    r, around, up = values[0], *numpy.radians(values[1:])
    if system == "C":
        return numpy.array([r * numpy.cos(around), r * numpy.sin(around), values[2]])
    return r * numpy.array([numpy.cos(up) * numpy.cos(around), numpy.cos(up) * numpy.sin(around), numpy.sin(up)])


def _transform(reader, block):
    """Axes of the forces and supports at nodes."""
    kind = block.get("TYPE") or "R"
    if kind not in ("R", "C"):
        refuse(block.place, f"*TRANSFORM of TYPE {kind} is not read; R and C are")
    if reader.transform is not None and reader.transform[0]:
        refuse(block.place, "*TRANSFORM in an instance that is moved is not read")
    if not block.lines:
        refuse(block.place, "*TRANSFORM needs two points")
    place, cells = block.lines[0]
    values = _numbers(cells, 6, place)
    a, b = values[:3], values[3:]
    for node in reader.find_nodes(block.required("NSET"), block.place):
        reader.undirected.pop(node, None)
        if kind == "C":
            if numpy.linalg.norm(b - a) == 0.0:
                refuse(place, "the two points of the axis are one")
            reader.axes[node] = _axes_about(reader, node, a, b - a, place)
        else:
            reader.axes[node] = triad(a, b, place)


def _axes_about(reader, node, origin, along, place):
    """Of a node on the axis any: what acts on it across must be the same in all directions."""
    position = reader.model.nodes[node]
    arm = position - origin
    if numpy.linalg.norm(numpy.cross(arm, along)) <= 1e-9 * numpy.linalg.norm(along) * max(1.0, numpy.linalg.norm(arm)):
        reader.undirected[node] = place
        position = position + numpy.eye(3)[abs(along).argmin()]
    return cylinder_axes(origin, along, position, place)


def refuse_directions(reader, node, what):
    """Of what acts on a node across the axis of its cylindrical system, where the node is on it.

    @param what  degree of freedom -> value"""
    place = reader.undirected.get(node)
    for pair in ((1, 2), (4, 5)):
        there = [what[i] for i in pair if i in what]
        if place is not None and there and (len(there) < 2 or any(there)):
            refuse(place, "a node on the axis of a cylindrical system has no directions in it")


def triad(a, b, place):
    """Rows x through a, y in the plane of a and b, z."""
    third = numpy.cross(a, b)
    if numpy.linalg.norm(third) <= 1e-9 * numpy.linalg.norm(a) * numpy.linalg.norm(b):
        refuse(place, "the two points of a system are on one line with its origin")
    x, z = a / numpy.linalg.norm(a), third / numpy.linalg.norm(third)
    return numpy.array([x, numpy.cross(z, x), z])


def placed(reader, position):
    """In the place of the instance: turned after it is moved, as the manual of Abaqus has it."""
    if reader.transform is None:
        return position
    lines, place = reader.transform
    if lines:
        position = position + _numbers(lines[0], 3, place)
    if len(lines) > 1:
        values = _numbers(lines[1], 7, place)
        start, axis, angle = values[:3], values[3:6] - values[:3], numpy.radians(values[6])
        if numpy.linalg.norm(axis) == 0.0:
            refuse(place, "the two points of the axis that the instance turns about are one")
        axis = axis / numpy.linalg.norm(axis)
        arm = position - start
        turned = arm * numpy.cos(angle) + numpy.cross(axis, arm) * numpy.sin(angle)
        position = start + turned + axis * (axis @ arm) * (1.0 - numpy.cos(angle))
    return position


def turned(reader, vector):
    """A direction of the part as its instance has it."""
    return placed(reader, numpy.array(vector, float)) - placed(reader, numpy.zeros(3))


def is_turned(reader):
    return reader.transform is not None and len(reader.transform[0]) > 1


def _numbers(cells, count, place):
    values = numbers_of(cells, place)
    if len(values) > count:
        refuse(place, f"expected at most {count} numbers, found {len(values)}")
    return numpy.array([*values, *[0.0] * (count - len(values))])


def _generate_nodes(reader, block):
    """Between two nodes, along a line or around a centre, which is the origin where the file does not say."""
    line = block.get("LINE") or ""
    if line not in ("", "C"):
        refuse(block.place, f"*NGEN with LINE={line} is not read; straight lines and arcs, LINE=C, are")
    for place, cells in block.lines:
        first, last = (integer(cell, place) for cell in cells[:2])
        step = integer(cells[2], place) if len(cells) > 2 and cells[2] else 1
        ends = [reader.find_nodes(str(one), place)[0] for one in (first, last)]
        if step == 0 or (last - first) % step or abs((last - first) // step) > 10**6:
            refuse(place, f"the step {step} does not lead from {first} to {last}")
        a, b = (reader.model.nodes[end] for end in ends)
        at = _arc(reader, cells, a, b, place) if line == "C" else lambda part, a=a, b=b: a + (b - a) * part
        made = [*ends]
        for i in range(first + step, last, step):
            made.append(_make_node(reader, i, at((i - first) / (last - first))))
        add_to_set(reader.model.node_sets, reader, block.get("NSET"), made)


def _make_node(reader, number_, position):
    key = reader.key(number_)
    if key not in reader.model.nodes:
        reader.findings.count("nodes")
    reader.model.nodes[key] = position
    return key


def _arc(reader, cells, a, b, place):
    """Places along the arc of less than half a turn from a to b, by a part of it."""
    if len(cells) > 3 and cells[3]:
        centre = reader.model.nodes[reader.find_nodes(cells[3], place)[0]]
    else:
        centre = placed(reader, numpy.array([*numbers_of(cells[4:7], place), 0.0, 0.0, 0.0][:3]))
    if any(cells[7:10]):
        refuse(place, "*NGEN, LINE=C with a normal, for arcs of half a turn and more, is not read")
    one, other = a - centre, b - centre
    r, s = numpy.linalg.norm(one), numpy.linalg.norm(other)
    normal = numpy.cross(one, other)
    if abs(r - s) > 1e-3 * max(r, s) or numpy.linalg.norm(normal) <= 1e-9 * r * s:
        refuse(place, "the ends of an arc must be at one distance from its centre, and not opposite to each other")
    normal = normal / numpy.linalg.norm(normal)
    angle = numpy.arctan2(numpy.cross(one, other) @ normal, one @ other)

    def at(part):
        turned = one * numpy.cos(angle * part) + numpy.cross(normal, one) * numpy.sin(angle * part)
        return centre + turned * (r + (s - r) * part) / r

    return at


def _fill_nodes(reader, block):
    """Rows of nodes from those of one set to those of another, in the order of their numbers."""
    for name in ("BIAS", "SINGULAR", "TWO STEP"):
        if block.has(name) and block.get(name) not in ("0", "1", "1."):
            refuse(block.place, f"*NFILL with {name} is not read")
    made = []
    for place, cells in block.lines:
        if len(cells) < 3:
            refuse(place, "expected two sets of nodes and the number of intervals between them")
        first, last = (sorted(set(reader.find_nodes(cell, place)), key=lambda key: key[1] if isinstance(key, tuple) else key) for cell in cells[:2])
        count = integer(cells[2], place, "the number of intervals")
        step = integer(cells[3], place) if len(cells) > 3 and cells[3] else 1
        if len(first) != len(last) or not 1 <= count <= 10**6 or step == 0:
            refuse(place, f"{len(first)} nodes cannot be joined to {len(last)} in {count} intervals, numbered by {step}")
        for one, other in zip(first, last):
            a, b = reader.model.nodes[one], reader.model.nodes[other]
            start = one[1] if isinstance(one, tuple) else one
            made += [one, *(_make_node(reader, start + i * step, a + (b - a) * (i / count)) for i in range(1, count)), other]
    add_to_set(reader.model.node_sets, reader, block.get("NSET"), made)


BLOCKS = {
    "NODE": _nodes,
    "NGEN": _generate_nodes,
    "NFILL": _fill_nodes,
    "TRANSFORM": _transform,
}
