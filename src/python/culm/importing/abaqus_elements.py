"""Elements of Abaqus and CalculiX."""

import numpy

from .abaqus_sets import add_to_set
from .findings import refuse
from .keyword_file import integer
from .model import BeamElement, PointMass, ShellElement, Support

SHELLS = {
    "S3": 3, "S3R": 3, "S3RS": 3, "STRI3": 3, "S4": 4, "S4R": 4, "S4RS": 4, "S4RSW": 4, "S4R5": 4, "S6": 6,
    "STRI65": 6, "S8": 8, "S8R": 8, "S8R5": 8, "S9R5": 9,
}  # fmt: skip
BEAMS = {
    "B31": 2, "B31R": 2, "B31H": 2, "B31OS": 2, "B33": 2, "B33H": 2, "B32": 3, "B32R": 3, "B32H": 3, "B32OS": 3,
    "PIPE31": 2, "PIPE32": 3, "B21": 2, "B21H": 2, "B23": 2, "B23H": 2, "B22": 3, "B22H": 3, "PIPE21": 2, "PIPE22": 3,
}  # fmt: skip
IN_PLANE = {type for type in BEAMS if type.lstrip("BPIE")[0] == "2"}
POINTS = {"MASS": 1, "ROTARYI": 1, "DCOUP3D": 1}


def _elements(reader, block):
    type = block.required("TYPE")
    size = SHELLS.get(type) or BEAMS.get(type) or POINTS.get(type)
    if size is None:
        refuse(block.place, f"elements of type {type} have no counterpart in culm: it has shells, beams, point masses")
    found = []
    for place, numbers in _records(block, size + 1, 1 if type in BEAMS else 0):
        key = reader.key(numbers[0])
        if key in reader.elements:
            refuse(place, f"element {numbers[0]} is there twice")
        nodes = [reader.key(node) for node in numbers[1:]]
        _add_element(reader, type, key, nodes[:size], place)
        for node in nodes[size:]:
            if node not in reader.model.nodes:
                refuse(place, f"there is no node {numbers[-1]}")
            reader.direction_nodes[key] = node
        found.append(key)
    reader.findings.count(f"elements {type}", len(found))
    add_to_set(reader.element_sets, reader, block.get("ELSET"), found)


def _records(block, size, more=0):
    """Elements may go over several lines.

    @param more  numbers that may follow on the last of these"""
    numbers, start = [], None
    for place, cells in block.lines:
        start = start or place
        numbers += [integer(cell, place, "the number of a node") for cell in cells if cell]
        if len(numbers) >= size:
            if len(numbers) > size + more and size != 2:
                refuse(start, f"expected {size} numbers for an element, found {len(numbers)}")
            yield start, numbers[: size + more]
            numbers, start = [], None
    if numbers:
        refuse(start, f"expected {size} numbers for an element, found {len(numbers)}")


def hold_in_plane(reader):
    """Beams in the plane of x and y: their nodes stay in it."""
    nodes, place, used = {}, None, set()
    for type, members, where in reader.elements.values():
        if type in IN_PLANE:
            nodes.update(dict.fromkeys(members))
            place = place or where
            used.add(type)
    for node in nodes:
        if reader.model.nodes[node][2] != 0.0:
            refuse(place, f"elements of type {used.pop()} lie in the plane z = 0, but a node of theirs is at z = {reader.model.nodes[node][2]:g}")
    if nodes:
        reader.findings.assume(f"nodes of {', '.join(sorted(used))} stay in the plane of x and y and turn about z alone", place)
        reader.model.supports.append(Support(list(nodes), {3: 0.0, 4: 0.0, 5: 0.0}, place, "plane"))


def _add_element(reader, type, key, nodes, place):
    for node in nodes:
        if node not in reader.model.nodes:
            number_ = node[1] if isinstance(node, tuple) else node
            refuse(place, f"there is no node {number_}")
    corners = 4 if SHELLS.get(type, 4) in (4, 8, 9) else 3
    if type in SHELLS and len(set(nodes[:corners])) < 3 or type in BEAMS and len(set(nodes)) < len(nodes):
        refuse(place, "an element has the same node twice")
    reader.elements[key] = (type, tuple(nodes), place)


def _generate_elements(reader, block):
    """A row of elements from a first one, and rows of rows."""
    for place, cells in block.lines:
        values = [integer(cell or "1", place) for cell in cells]
        key = reader.key(values[0])
        if key not in reader.elements:
            refuse(place, f"there is no element {values[0]}")
        type, nodes, _ = reader.elements[key]
        if key in reader.direction_nodes:
            refuse(place, f"*ELGEN from element {values[0]}, which has a node for its direction, is not read")
        counts = [values[1], *values[4:5], *values[7:8]]
        steps = [(values[i] if len(values) > i else 1, values[i + 1] if len(values) > i + 1 else 1) for i in (2, 5, 8)]
        made = []
        total = int(numpy.prod([max(count, 1) for count in counts]))
        if total > 10**6:
            refuse(place, f"{total} elements are more than 1e6")
        for index in numpy.ndindex(*counts):
            to_node = sum(i * step[0] for i, step in zip(index, steps))
            to_element = sum(i * step[1] for i, step in zip(index, steps))
            copy = reader.key(values[0] + to_element)
            moved = [reader.key((n[1] if isinstance(n, tuple) else n) + to_node) for n in nodes]
            if any(index):
                if copy in reader.elements:
                    refuse(place, f"element {values[0] + to_element} is there twice")
                _add_element(reader, type, copy, moved, place)
                reader.findings.count(f"elements {type}")
            made.append(copy)
        add_to_set(reader.element_sets, reader, block.get("ELSET"), made)


def element_of(reader, key, wall, section, up):
    """The record of an element, when its properties are known."""
    type, nodes, place = reader.elements[key]
    if type in SHELLS:
        return ShellElement(key, nodes, wall, place)
    if SHELLS.get(type) is None and BEAMS[type] == 3:
        nodes = (nodes[0], nodes[2], nodes[1])  # the node between comes second in the file
    return BeamElement(key, nodes, section, up, place)


def point_mass(reader, key, mass, inertia):
    type, nodes, place = reader.elements[key]
    return PointMass(nodes[0], mass, place, inertia)


BLOCKS = {
    "ELEMENT": _elements,
    "ELGEN": _generate_elements,
}
