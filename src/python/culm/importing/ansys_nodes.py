"""Nodes, elements and components of ANSYS, as commands give them."""

import numpy

from .ansys_file import is_tag, whole
from .findings import did_you_mean, refuse
from .keyword_file import is_integer, number


def read_nodes(reader, command):
    # coordinates follow three numbers, or one where NBLOCK has three fields, and angles of the system of the node follow them
    first = 1 if command.text(1) == "3" else 3
    for place, cells in command.rows:
        _add_node(reader, whole(cells[0], place, "the number of a node"), cells[first:], place)


def read_node(reader, command):
    if _ends_block(command):
        return
    if reader.active != "0":
        refuse(command.place, f"N in the coordinate system {reader.active} is not read: only 0 is")
    _add_node(reader, command.integer(1), [command.text(i) for i in range(2, 8)], command.place)


def read_element(reader, command):
    if not _ends_block(command):
        refuse(command.place, "EN is not read: elements stand in EBLOCK")


def _ends_block(command):
    """N,R5.3,LOC,-1 and EN,UNBL,ATTR,-1"""
    if is_tag(command.text(1)) and command.integer(3) >= 0:
        refuse(command.place, f"{command.name} of an archive without blocks is not read: CDWRITE writes blocks unless it is told not to")
    return is_tag(command.text(1))


def read_active(reader, command):
    reader.active = command.text(1) or "0"


def _add_node(reader, number_, cells, place):
    values = [number(cell, place, "a coordinate") if cell else 0.0 for cell in cells[:6]]
    if number_ in reader.model.nodes:
        refuse(place, f"node {number_} is there twice")
    reader.model.nodes[number_] = numpy.array([*values, 0.0, 0.0, 0.0][:3])
    if any(values[3:]):
        reader.axes[number_] = _turned(reader, [*values[3:], 0.0, 0.0][:3])
    reader.findings.count("nodes")


def read_elements(reader, command):
    if command.text(2).upper() != "SOLID":
        reader.findings.leave_out("EBLOCK without SOLID", command.place)
        return
    rows = iter(command.rows)
    for place, cells in rows:
        if len(cells) < 11:
            refuse(place, f"expected 11 numbers and nodes of an element, found {len(cells)}")
        values = [whole(cell, place, "a number of an element") for cell in cells]
        nodes = values[11:]
        count = values[8]
        if not 1 <= count <= 100:
            refuse(place, f"an element has {count} nodes")
        if len(nodes) != min(count, 8):
            refuse(place, f"element {values[10]} has {len(nodes)} of {count} nodes")
        while len(nodes) < count:
            place_, more = next(rows, (place, None))
            if more is None:
                refuse(place, f"element {values[10]} has {len(nodes)} of {count} nodes")
            nodes += [whole(cell, place_, "the number of a node") for cell in more]
        reader.elements.append([values[10], values[0], values[1], values[2], values[3], values[4], nodes[:count], place])


def read_system(reader, command):
    """LOCAL,R5.0,LOC,number,kind,x,y,z and LOCAL,R5.0,ANG,number,angles; or all in one line."""
    fields = [cell.upper() for cell in command.fields]
    if fields and is_tag(fields[0]):
        if len(fields) > 1 and fields[1] == "ANG":
            reader.systems[command.integer(3)] = _turned(reader, [command.real(i, default=0.0) for i in (4, 5, 6)])
        elif len(fields) > 3 and fields[3].strip("0"):
            reader.curved.add(command.integer(3))
    else:
        reader.systems[command.integer(1)] = _turned(reader, [command.real(i, default=0.0) for i in (6, 7, 8)])
        if command.text(2).strip("0"):
            reader.curved.add(command.integer(1))


def _turned(reader, degrees):
    """Rows of axes, turned about z, then the new x, then the new y."""
    about_z, about_x, about_y = numpy.radians(degrees)
    c, s = numpy.cos, numpy.sin
    z = numpy.array([[c(about_z), s(about_z), 0], [-s(about_z), c(about_z), 0], [0, 0, 1]])
    x = numpy.array([[1, 0, 0], [0, c(about_x), s(about_x)], [0, -s(about_x), c(about_x)]])
    y = numpy.array([[c(about_y), 0, -s(about_y)], [0, 1, 0], [s(about_y), 0, c(about_y)]])
    return y @ x @ z


def read_component(reader, command):
    """Numbers, a negative one ends the range that the one before begins."""
    members = []
    for place, cells in command.rows:
        for cell in cells:
            value = whole(cell, place, "a number")
            if value >= 0:
                members.append(value)
            elif not members or not members[-1] < -value <= members[-1] + 10**7:
                refuse(place, f"{value} ends no range")
            else:
                members += range(members[-1] + 1, -value + 1)
    reader.components[command.text(1).upper()] = (command.text(2).upper(), members)


def select_component(reader, command):
    if command.text(1).upper() == "ALL":
        reader.selected = None
    elif command.text(1).upper() == "S":
        kind, members = _named(reader, command, command.text(2))
        reader.selected = members if kind.startswith("NODE") else reader.selected
    else:
        refuse(command.place, f"CMSEL,{command.text(1)} is not read; CMSEL,S is")


def select_nodes(reader, command):
    if command.name == "NSEL" and command.text(1).upper() not in ("ALL", ""):
        refuse(command.place, f"NSEL,{command.text(1)} is not read: nodes are selected by components")
    reader.selected = None


def select_others(reader, command):
    """Nodes of elements, lines, areas: not known, which counts where ALL of them are meant."""
    reader.selected = command


def _named(reader, command, name):
    if name.upper() not in reader.components:
        refuse(command.place, f"there is no component '{name}'{did_you_mean(name.upper(), reader.components)}")
    return reader.components[name.upper()]


def modify_element(reader, command):
    """Gives elements another material, type, constants, section or system."""
    at = {"MAT": 1, "TYPE": 2, "REAL": 3, "SECN": 4, "ESYS": 5}.get(command.text(2).upper()[:4])
    if at is None:
        refuse(command.place, f"EMODIF of {command.text(2)} is not read")
    name = command.text(1)
    chosen = {int(name)} if is_integer(name) else set(_named(reader, command, name)[1])
    for element in reader.elements:
        if element[0] in chosen:
            element[at] = command.integer(3)


def nodes_of(reader, command):
    """A number, ALL that are selected, or a component."""
    name = command.text(1)
    if is_integer(name):
        nodes = [int(name)]
    elif name.upper() == "ALL" and hasattr(reader.selected, "fields"):
        refuse(command.place, f"{command.name} of ALL after {reader.selected.name}: nodes are selected by components")
    elif name.upper() == "ALL":
        nodes = list(reader.model.nodes) if reader.selected is None else reader.selected
    else:
        nodes = _named(reader, command, name)[1]
    for node in nodes:
        if node not in reader.model.nodes:
            refuse(command.place, f"there is no node {node}")
        reader.places.setdefault((command.name, node), command.place)
    return nodes


def refuse_ranges(reader, command):
    """D and F: read_node, label, value, imaginary value; no nodes from here to there."""
    command.real(4, default=0.0)
    if any(command.text(i) for i in range(5, len(command.fields) + 1)):
        refuse(command.place, f"{command.name} with '{','.join(command.fields[4:])[:40]}': one label and no ranges are read")
