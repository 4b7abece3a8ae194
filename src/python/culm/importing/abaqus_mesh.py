"""Nodes, elements, sets, surfaces and couplings of Abaqus and CalculiX."""

import numpy

from .findings import refuse
from .keyword_file import integer, numbers_of
from .model import BeamElement, Coupling, PointMass, ShellElement, Support, cylinder_axes

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


def read_mesh_block(reader, block):
    """@return whether the block is one of these"""
    action = {
        "NODE": _nodes,
        "NGEN": _generate_nodes,
        "NFILL": _fill_nodes,
        "ELEMENT": _elements,
        "ELGEN": _generate_elements,
        "TRANSFORM": _transform,
        "NSET": _node_set,
        "ELSET": _element_set,
        "SURFACE": _surface,
        "RIGID BODY": _rigid_body,
        "COUPLING": _coupling,
        "KINEMATIC": _kinematic,
        "DISTRIBUTING": _distributing,
        "MPC": _multi_point,
    }.get(block.keyword)
    if action is None:
        return False
    action(reader, block)
    return True


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
    _add_to_set(reader.model.node_sets, reader, block.get("NSET"), found)


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
        _add_to_set(reader.model.node_sets, reader, block.get("NSET"), made)


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
    _add_to_set(reader.model.node_sets, reader, block.get("NSET"), made)


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
    _add_to_set(reader.element_sets, reader, block.get("ELSET"), found)


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
        _add_to_set(reader.element_sets, reader, block.get("ELSET"), made)


def _add_to_set(sets, reader, name, numbers):
    """What is in it already, or given twice, is there once."""
    if name:
        members = sets.setdefault(reader.prefix + name, [])
        known = set(members)
        members += [one for one in dict.fromkeys(numbers) if one not in known]


def _node_set(reader, block):
    _set(reader, block, block.required("NSET"), reader.model.node_sets, reader.find_nodes, reader.model.nodes)


def _element_set(reader, block):
    _set(reader, block, block.required("ELSET"), reader.element_sets, reader.find_elements, reader.elements)


def _set(reader, block, name, sets, find, existing):
    instance = block.get("INSTANCE")
    before, prefix = reader.prefix, (f"{instance}." if instance else reader.prefix)
    found = []
    reader.prefix = prefix
    for place, cells in block.lines:
        cells = [cell for cell in cells if cell]
        if block.has("GENERATE"):
            values = [integer(cell, place) for cell in cells]
            if len(values) not in (2, 3) or (len(values) == 3 and values[2] <= 0):
                refuse(place, "expected first, last and step of the numbers")
            step = values[2] if len(values) == 3 else 1
            if (values[1] - values[0]) // step > 10**7:
                refuse(place, "more than 1e7 numbers")
            keys = [reader.key(i) for i in range(values[0], values[1] + 1, step)]
            found += [key for key in keys if key in existing]
        else:
            for cell in cells:
                found += find(cell, place)
    if block.keyword == "NSET" and block.get("ELSET"):
        members = reader.find_elements(block.get("ELSET"), block.place)
        found += [node for key in members for node in reader.elements[key][1]]
    reader.prefix = before  # a set of an instance that the assembly names is one of the assembly
    _add_to_set(sets, reader, name, found)
    if not found:
        reader.findings.assume(f"the set {name} is empty", block.place)


def _surface(reader, block):
    name = block.required("NAME")
    faces = []
    for place, cells in block.lines:
        if block.get("TYPE") == "NODE":
            faces.append((reader.find_nodes(cells[0], place), "NODE", place))
        else:
            face = cells[1].upper() if len(cells) > 1 else ""
            faces.append((reader.find_elements(cells[0], place), face, place))
    reader.surfaces[reader.prefix + name] = faces


def _nodes_of_surface(reader, name, place):
    for candidate in (reader.prefix + name, name):
        if candidate in reader.surfaces:
            nodes = []
            for members, face, _ in reader.surfaces[candidate]:
                nodes += members if face == "NODE" else [n for key in members for n in _face(reader, key, face, place)]
            return list(dict.fromkeys(nodes))
    if name in reader.model.node_sets or reader.prefix + name in reader.model.node_sets:
        return reader.find_nodes(name, place)
    refuse(place, f"there is no surface '{name}'")


def _face(reader, key, face, place):
    """Nodes of an element, or of one of its edges."""
    type, nodes, _ = reader.elements[key]
    if not face.startswith("E"):
        return nodes
    corners = 3 if SHELLS.get(type) in (3, 6) else 4
    i = integer(face[1:], place, "an edge, E1 to E4") - 1
    if not 0 <= i < corners:
        refuse(place, f"an element of type {type} has no edge {face}")
    return (nodes[i], nodes[(i + 1) % corners], *nodes[corners + i : corners + i + 1])


def _rigid_body(reader, block):
    reference = reader.find_nodes(block.required("REF NODE"), block.place)[0]
    followers = []
    for name in ("NSET", "TIE NSET"):
        if block.get(name):
            followers += reader.find_nodes(block.get(name), block.place)
    for name in ("PIN NSET",):
        if block.get(name):
            refuse(block.place, f"*RIGID BODY with {name} is not read")
    if block.get("ELSET"):
        for key in reader.find_elements(block.get("ELSET"), block.place):
            followers += reader.elements[key][1]
    if block.get("ROT NODE"):
        # the node whose displacement is the rotation of the body in CalculiX
        turning = reader.find_nodes(block.get("ROT NODE"), block.place)[0]
        reader.rotation_nodes = {**getattr(reader, "rotation_nodes", {}), turning: reference}
    _couple(reader, reference, followers, block, "rigid body")


def _couple(reader, reference, followers, block, name):
    followers = [node for node in dict.fromkeys(followers) if node != reference]
    reader.model.couplings.append(Coupling(reference, followers, block.place, name))
    reader.findings.count("rigid couplings")


def _coupling(reader, block):
    reference = reader.find_nodes(block.required("REF NODE"), block.place)[0]
    nodes = _nodes_of_surface(reader, block.required("SURFACE"), block.place)
    reader.coupling = (reference, nodes, (block.get("CONSTRAINT NAME") or "coupling").lower())


def _kinematic(reader, block):
    if reader.coupling is None:
        refuse(block.place, "*KINEMATIC without *COUPLING before it")
    reference, nodes, name = reader.coupling
    held = set()
    for place, cells in block.lines:
        first = integer(cells[0], place)
        last = integer(cells[1], place) if len(cells) > 1 and cells[1] else first
        held |= set(range(first, last + 1))
    if held and not held >= {1, 2, 3, 4, 5, 6}:
        if not held >= {1, 2, 3}:
            refuse(block.place, "*KINEMATIC that couples some translations only is not read")
        reader.findings.assume("a kinematic coupling of translations only holds rotations, too", block.place)
    _couple(reader, reference, nodes, block, name)


def _distributing(reader, block):
    if reader.coupling is None:
        refuse(block.place, "*DISTRIBUTING without *COUPLING before it")
    reference, nodes, name = reader.coupling
    reader.findings.assume("a distributing coupling is a rigid one, which is stiffer", block.place)
    _couple(reader, reference, nodes, block, name)


def _multi_point(reader, block):
    for place, cells in block.lines:
        kind = cells[0].upper()
        if kind not in ("BEAM", "TIE"):
            refuse(place, f"*MPC of type {kind} is not read; BEAM and TIE are")
        follower = reader.find_nodes(cells[1], place)
        reference = reader.find_nodes(cells[2], place)
        if len(reference) == 1:
            _couple(reader, reference[0], follower, block, f"mpc {kind.lower()}")
        elif len(reference) == len(follower):
            for one, other in zip(reference, follower):
                _couple(reader, one, [other], block, f"mpc {kind.lower()}")
        else:
            refuse(place, f"{len(follower)} nodes cannot follow {len(reference)}")


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
