"""Loads of a model from those that act in the steps of a file of Abaqus or CalculiX."""

import collections

import numpy

from .abaqus_elements import BEAMS, SHELLS
from .abaqus_nodes import refuse_directions
from .findings import refuse
from .model import ElementLoad, NodeLoad

ON_SURFACE = "P "  # begins the label of a load on a surface


def collect_node_loads(reader, nodes, number_, found):
    """One load for all nodes with the same force."""
    vectors, places = collections.defaultdict(lambda: numpy.zeros(6)), {}
    for (node, direction), (value, place, _) in nodes.items():
        vectors[node][direction - 1] += value
        places.setdefault(node, place)
    groups = collections.defaultdict(list)
    for node, vector in vectors.items():
        axes = reader.axes.get(node)
        refuse_directions(reader, node, {i + 1: value for i, value in enumerate(vector) if value})
        if axes is not None:
            vector = numpy.concatenate([vector[:3] @ axes, vector[3:] @ axes])
        if vector.any():
            groups[tuple(vector)].append(node)
    for vector, members in groups.items():
        key = (vector, tuple(members))
        if key not in found:
            found[key] = NodeLoad(members, numpy.array(vector), places[members[0]], "force", set())
        found[key].steps.add(number_)


def collect_element_loads(reader, elements, number_, found):
    for entry in elements:
        if entry.label != "GRAV":
            found.setdefault(entry, set()).add(number_)
    _collect_gravity(reader, [entry for entry in elements if entry.label == "GRAV"], number_)


def _collect_gravity(reader, entries, number_):
    """culm's gravity acts on everything that has mass, so what the file says of sets must come to that."""
    if not entries:
        return
    on_each = {key: numpy.zeros(3) for key, (type, _, _) in reader.elements.items() if type in SHELLS or type in BEAMS}
    on_points = {key: numpy.zeros(3) for key, (type, _, _) in reader.elements.items() if type == "MASS"}
    for entry in entries:
        for key in entry.members:
            (on_each if key in on_each else on_points).setdefault(key, numpy.zeros(3))[:] += _acceleration(reader, entry)
    last = entries[-1].place
    values = {tuple(numpy.round(value, 9)): value for value in (*on_each.values(), *on_points.values())}
    pulling = [value for value in values.values() if value.any()]
    if len(pulling) > 1:
        refuse(last, "gravity that is another one on other elements is not read: culm has one for everything")
    if not pulling:
        return
    if len(values) > 1:
        reader.findings.assume("gravity acts on everything, not only on the elements named", last)
    value = pulling[0]
    for load in reader.model.element_loads:
        if load.kind == "gravity" and numpy.allclose(load.value, value, rtol=1e-12, atol=0.0):
            load.steps.add(number_)
            return
    reader.model.element_loads.append(ElementLoad("gravity", [], value, entries[0].place, "gravity", {number_}))


def _acceleration(reader, entry):
    direction = numpy.array([*entry.values[1:4], 0.0, 0.0, 0.0][:3])
    length = numpy.linalg.norm(direction)
    if entry.values[0] and not length:
        refuse(entry.place, "GRAV needs a direction")
    if abs(length - 1.0) > 1e-6 and length:
        reader.findings.assume("of the direction of GRAV the length does not count, as in CalculiX", entry.place)
    return entry.values[0] * direction / (length or 1.0)


def make_element_load(reader, entry, steps):
    model, members, label, values, place = reader.model, entry.members, entry.label, entry.values, entry.place
    if not any(values):
        return
    shells = [key for key in members if reader.elements[key][0] in SHELLS]
    beams = [key for key in members if reader.elements[key][0] in BEAMS]
    if label == "P" and shells and beams or label in ("PX", "PY", "PZ", "P1", "P2") and beams and shells:
        reader.findings.leave_out(f"element loads of kind {label} on {'beams' if label == 'P' else 'shells'}", place)
    places = {element.number: i for i, element in enumerate(model.shells)}
    beam_places = {element.number: i for i, element in enumerate(model.beams)}
    if label.startswith(ON_SURFACE) or (label == "P" and shells):
        model.element_loads.append(
            ElementLoad("pressure", [places[k] for k in shells], values[0], place, "pressure", steps)
        )
    elif label in ("BX", "BY", "BZ"):
        _body_force(model, shells, beams, places, beam_places, numpy.eye(3)["XYZ".index(label[1])] * values[0], place, steps)
    elif label in ("PX", "PY", "PZ") and beams:
        force = numpy.eye(3)["XYZ".index(label[1])] * values[0]
        model.element_loads.append(ElementLoad("line", [beam_places[k] for k in beams], force, place, "line load", steps))
    elif label in ("P1", "P2") and beams:
        _line_in_section(reader, beams, beam_places, int(label[1]), values[0], place, steps)
    else:
        reader.findings.leave_out(f"element loads of kind {label}", place)


def _body_force(model, shells, beams, places, beam_places, force, place, steps):
    """Force per volume, as force per area of each wall; beams know no area here."""
    walls = collections.defaultdict(list)
    for key in shells:
        walls[model.shells[places[key]].wall].append(places[key])
    for wall, members in walls.items():
        thickness = sum(layer.thickness for layer in model.walls[wall].layers)
        model.element_loads.append(ElementLoad("surface", members, force * thickness, place, "body force", steps))
    if beams:
        model.findings.leave_out("body forces on beams", place)


def _line_in_section(reader, beams, beam_places, axis, value, place, steps):
    """Along an axis of the section. CalculiX has it as a pressure on a face of the solid beam."""
    model = reader.model
    if reader.program == "CalculiX":
        _pressure_on_face(reader, beams, beam_places, axis, value, place, steps)
        return
    text = "P1 and P2 on beams are forces per length, as in Abaqus; CalculiX has pressures: culm import calculix"
    reader.findings.assume(text, place)
    _line_along(model, beams, beam_places, axis, value, place, steps)


def _pressure_on_face(reader, beams, beam_places, axis, value, place, steps):
    """On the face that is normal to the axis: its width makes it a force per length."""
    model = reader.model
    by_section = collections.defaultdict(list)
    for key in beams:
        by_section[model.beams[beam_places[key]].section].append(key)
    for name, members in by_section.items():
        section = model.sections[name]
        if section.type != "Rectangle":
            text = "P1 and P2 on beams whose section is no rectangle, pressures on a face in CalculiX"
            reader.findings.leave_out(text, place)
            continue
        width = section.values[("Height", "Width")[axis - 1]]
        _line_along(model, members, beam_places, axis, value * width, place, steps)


def _line_along(model, beams, beam_places, axis, value, place, steps):
    groups = collections.defaultdict(list)
    for key in beams:
        element = model.beams[beam_places[key]]
        tangent = model.nodes[element.nodes[1]] - model.nodes[element.nodes[0]]
        tangent = tangent / numpy.linalg.norm(tangent)
        first = numpy.array(element.up, float) - (numpy.array(element.up) @ tangent) * tangent
        first = first / (numpy.linalg.norm(first) or 1.0)
        direction = first if axis == 1 else numpy.cross(tangent, first)
        groups[tuple(numpy.round(direction * value, 12))].append(beam_places[key])
    for force, members in groups.items():
        model.element_loads.append(ElementLoad("line", members, numpy.array(force), place, "line load", steps))
