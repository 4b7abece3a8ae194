"""Materials and sections of Abaqus and CalculiX."""

import re

import numpy

from .findings import did_you_mean, refuse
from .keyword_file import NUMBER, number, numbers_of
from .model import Layer, Material, Section, Wall
from .abaqus_elements import BEAMS, POINTS, SHELLS, element_of, point_mass
from .abaqus_nodes import is_turned, turned
from .abaqus_orientations import Orientation, read_orientation
from .profiles import i_section

DEFAULT_UP = (0.0, 0.0, -1.0)  # the first axis of beam sections where the file has none
DEFAULT_AXIS = (1.0, 0.0, 0.0)  # axis 1 of shells without orientation,
FALLBACK_AXIS = (0.0, 0.0, 1.0)  # and where it is normal to the surface
CELLS = 8  # of a line of data
SHELL_SECTIONS = ("SHELL SECTION", "SHELL GENERAL SECTION")


def read_property_block(reader, block):
    """@return whether the block is one of these"""
    action = {
        "MATERIAL": _material,
        "ELASTIC": _elastic,
        "DENSITY": _density,
        "ORIENTATION": read_orientation,
        "SHELL SECTION": _assignment,
        "SHELL GENERAL SECTION": _assignment,
        "BEAM SECTION": _assignment,
        "BEAM GENERAL SECTION": _assignment,
        "MASS": _assignment,
        "ROTARY INERTIA": _assignment,
    }.get(block.keyword)
    if action is None:
        return False
    action(reader, block)
    return True


def _material(reader, block):
    reader.material = block.required("NAME")
    reader.described = set()  # keywords of its properties
    if reader.material in reader.model.materials:
        refuse(block.place, f"material {reader.material} is there twice")
    reader.model.materials[reader.material] = Material("", {}, block.place)
    reader.findings.count("materials")


def _property(reader, block):
    if reader.material is None:
        refuse(block.place, f"*{block.keyword} without *MATERIAL before it")
    if not block.lines:
        refuse(block.place, f"*{block.keyword} without values")
    if block.keyword in reader.described:
        refuse(block.place, f"*{block.keyword} of material {reader.material} is there twice")
    reader.described.add(block.keyword)
    return reader.model.materials[reader.material]


def _first(reader, block, count, what):
    """As _values, where lines that go on are those of other temperatures."""
    if len(block.lines) > -(-count // CELLS):
        reader.findings.assume("of properties by temperature the first stand", block.place)
    return _values(block, count, what)


def _values(block, count, what):
    """The first `count` numbers of the data, over lines."""
    found = [value for place, cells in block.lines for value in numbers_of(cells, place)]
    if len(found) < count:
        refuse(block.place, f"expected {count} numbers, {what}, found {len(found)}")
    return found[:count]


def _elastic(reader, block):
    material = _property(reader, block)
    kind = (block.get("TYPE") or "ISOTROPIC").replace("ENGINEERINGCONSTANTS", "ENGINEERING CONSTANTS")  # as CalculiX reads it
    if kind.startswith("ISO"):
        # a ratio that is left out is 0
        alone = len(block.lines[0][1]) > 1 and not block.lines[0][1][1]
        E, nu = [*_first(reader, block, 1, "Young's modulus"), 0.0] if alone else _first(reader, block, 2, "Young's modulus and Poisson's ratio")
        material.type = "Isotropic"
        material.values.update({"Young Modulus": E, "Poisson Ratio": nu})
    elif kind == "ENGINEERING CONSTANTS":
        E1, E2, E3, n12, n13, n23, G12, G13, G23 = _first(reader, block, 9, "E1 E2 E3 nu12 nu13 nu23 G12 G13 G23")
        _orthotropic(material, E1, E2, E3, n12, n13, n23, G12, G13, G23)
    elif kind == "LAMINA":
        E1, E2, n12, G12, G13, G23 = _first(reader, block, 6, "E1 E2 nu12 G12 G13 G23")
        _orthotropic(material, E1, E2, E2, n12, n12, 0.3, G12, G13, G23)
        reader.findings.assume("a LAMINA has E3 = E2, nu13 = nu12, nu23 = 0.3 through the thickness", block.place)
    elif kind in ("ORTHO", "ORTHOTROPIC"):
        _orthotropic(material, *_constants(_first(reader, block, 9, "D1111 to D2323"), block.place))
    else:
        refuse(block.place, f"*ELASTIC of TYPE {kind} has no counterpart: ISOTROPIC, ENGINEERING CONSTANTS, LAMINA, ORTHO")


def _constants(values, place):
    """Engineering constants of D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323."""
    a, b, c, d, e, f, G12, G13, G23 = values
    stiffness = numpy.array([[a, b, d], [b, c, e], [d, e, f]])
    if numpy.linalg.eigvalsh(stiffness).min() <= 0.0:
        refuse(place, "the stiffness is not positive definite")
    S = numpy.linalg.inv(stiffness)
    E = 1.0 / numpy.diag(S)
    return (*map(float, E), float(-S[0, 1] * E[0]), float(-S[0, 2] * E[0]), float(-S[1, 2] * E[1]), G12, G13, G23)


def _orthotropic(material, E1, E2, E3, n12, n13, n23, G12, G13, G23):
    material.type = "Orthotropic"
    names = ("E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23")
    material.values.update(zip(names, (E1, E2, E3, n12, n13, n23, G12, G13, G23)))


def _density(reader, block):
    _property(reader, block).values["Density"] = _first(reader, block, 1, "the density")[0]


def _assignment(reader, block):
    reader.assignments.append((block, reader.prefix, reader.transform))


def resolve_sections(reader):
    """Gives every element what its section says, when the whole file is known."""
    given, blocks = {}, []
    for block, prefix, _ in reader.assignments:
        reader.prefix = prefix
        keys = list(dict.fromkeys(reader.find_elements(block.required("ELSET"), block.place)))
        for key in keys:
            type = reader.elements[key][0]
            fits = SHELLS if block.keyword in SHELL_SECTIONS else POINTS if block.keyword in ("MASS", "ROTARY INERTIA") else BEAMS
            if type not in fits:
                refuse(block.place, f"*{block.keyword} for an element of type {type}")
            if key in given:
                reader.findings.assume("elements that two sections name have the last one", block.place)
            given[key] = block
        blocks.append(keys)
    actions = {**dict.fromkeys(SHELL_SECTIONS, _shell_section), "MASS": _mass, "ROTARY INERTIA": _rotary}
    for (block, prefix, transform), keys in zip(reader.assignments, blocks):
        reader.prefix, reader.transform = prefix, transform
        keys = [key for key in keys if given[key] is block]
        actions.get(block.keyword, _beam_section)(reader, block, keys)
    reader.prefix, reader.transform = "", None
    for key, (type, _, place) in reader.elements.items():
        if key not in given and type != "DCOUP3D":
            number_ = key[1] if isinstance(key, tuple) else key
            refuse(place, f"element {number_} of type {type} has no section: none names a set that it is in")


def _find_material(reader, name, place):
    name = name.strip('"').upper()
    materials = reader.model.materials
    if name not in materials:
        refuse(place, f"there is no material '{name}'{did_you_mean(name, materials)}")
    if not materials[name].type:
        refuse(materials[name].place, f"material {name} is not elastic: it has no *ELASTIC")
    return name


def _find_orientation(reader, name, place):
    name = name.strip('"').upper()
    for candidate in (reader.prefix + name, name):
        if candidate in reader.orientations:
            return reader.orientations[candidate]
    refuse(place, f"there is no orientation '{name}'{did_you_mean(name, reader.orientations)}")


def _shell_section(reader, block, keys):
    if block.keyword == "SHELL GENERAL SECTION" and not (block.get("MATERIAL") or block.has("COMPOSITE")):
        refuse(block.place, "*SHELL GENERAL SECTION by stiffnesses has no counterpart: walls are of layers, by MATERIAL or COMPOSITE")
    if block.get("OFFSET") not in (None, "0", "0.", "0.0", "MIDDLE"):
        reader.findings.leave_out("OFFSET of a shell section: the nodes are in its middle", block.place)
    if block.has("NODAL THICKNESS"):
        refuse(block.place, f"*{block.keyword} with NODAL THICKNESS is not read: walls have one thickness")
    if not block.lines:
        refuse(block.place, f"*{block.keyword} without a thickness")
    composite = block.has("COMPOSITE")
    if composite:
        layers = [_layer(reader, place, cells) for place, cells in block.lines]
    else:
        if len(block.lines) > 1:
            refuse(block.lines[1][0], f"*{block.keyword} without COMPOSITE has one line of data, this is one more")
        place, cells = block.lines[0]
        material = _find_material(reader, block.required("MATERIAL"), block.place)
        layers = [(_thickness(cells[0], place), material, 0.0)]
    isotropic = all(reader.model.materials[m].type == "Isotropic" for _, m, _ in layers)
    orientation = None
    if block.get("ORIENTATION") and not isotropic:
        orientation = _find_orientation(reader, block.get("ORIENTATION"), block.place)
    elif not isotropic:
        _tell_default(reader, block, "axis of layers")
    if block.get("SYMMETRIC") is not None or block.has("SYMMETRIC"):
        layers += layers[::-1]
    name = (block.get("ELSET") or "wall").lower()
    if not isotropic and any(isinstance(angle, Orientation) for _, _, angle in layers):
        _walls_by_angle(reader, block, keys, layers, orientation, name)
        return
    wall = _free(f"{name}", reader.model.walls)
    layers = [Layer(t, m, 0.0 if isinstance(a, Orientation) else a) for t, m, a in layers]
    axis, fallback = DEFAULT_AXIS, FALLBACK_AXIS
    if orientation is not None:
        axis, fallback = orientation.pole, None
    if orientation is not None and orientation.pole is None:
        axis = tuple(map(float, orientation.axis(None)))
    reader.model.walls[wall] = Wall(layers, block.place, axis, fallback)
    for key in keys:
        element = element_of(reader, key, wall, None, None)
        if orientation is not None and orientation.pole is not None:
            element.axis = tuple(map(float, orientation.axis(_centre(reader, key))))
        reader.model.shells.append(element)


def _corners(reader, key):
    nodes = [reader.model.nodes[node] for node in reader.elements[key][1]]
    return nodes[:4] if len(nodes) in (4, 8, 9) else nodes[:3]


def _centre(reader, key):
    return numpy.mean(_corners(reader, key), axis=0)


def _thickness(cell, place):
    value = number(cell, place, "a thickness")
    if value <= 0.0:
        refuse(place, f"a thickness must be > 0, got {value:g}")
    return value


def _layer(reader, place, cells):
    """(thickness, material, angle or Orientation)"""
    if len(cells) < 3:
        refuse(place, "expected thickness, points, material, orientation of a layer")
    material = _find_material(reader, cells[2], place)
    angle = 0.0
    if len(cells) > 3 and cells[3]:
        if re.fullmatch(NUMBER, cells[3].upper()):
            angle = number(cells[3], place)
        else:
            angle = _find_orientation(reader, cells[3], place)
    return _thickness(cells[0], place), material, angle


def _walls_by_angle(reader, block, keys, layers, orientation, name):
    """Layers with axes of their own: their angles from the axis of the wall are those between the
    projections on each element."""
    walls = {}
    for key in keys:
        corners, centre = _corners(reader, key), _centre(reader, key)
        normal = numpy.cross(corners[1] - corners[0], corners[-1] - corners[0])
        normal = normal / (numpy.linalg.norm(normal) or 1.0)
        reference = numpy.array(DEFAULT_AXIS) if orientation is None else orientation.axis(centre)
        if numpy.linalg.norm(numpy.cross(reference, normal)) < 1e-3:
            if orientation is not None and not all(isinstance(a, Orientation) for _, _, a in layers):
                refuse(block.place, "the axis that angles of layers count from is normal to an element")
            reference = numpy.array(FALLBACK_AXIS if abs(normal[2]) < 0.9 else DEFAULT_AXIS)
        angles = tuple(
            round(_angle(reference, a.axis(centre), normal, block.place), 6) if isinstance(a, Orientation) else a
            for _, _, a in layers
        )
        if angles not in walls:
            walls[angles] = _free(name, reader.model.walls)
            of_layers = [Layer(t, m, a) for (t, m, _), a in zip(layers, angles)]
            pole = None if orientation is None else orientation.pole
            axis = pole or tuple(map(float, reference))
            reader.model.walls[walls[angles]] = Wall(of_layers, block.place, axis)
        element = element_of(reader, key, walls[angles], None, None)
        element.axis = tuple(map(float, reference))
        reader.model.shells.append(element)


def _angle(reference, direction, normal, place):
    """From one projection to the other about the normal [degrees]."""
    a = reference - (reference @ normal) * normal
    b = direction - (direction @ normal) * normal
    if numpy.linalg.norm(b) < 1e-3:
        refuse(place, "the axis of a layer is normal to an element")
    return float(numpy.degrees(numpy.arctan2(numpy.cross(a, b) @ normal, a @ b)))


def _free(name, taken):
    number_, free = 2, name
    while free in taken:
        free, number_ = f"{name} {number_}", number_ + 1
    return free


def _beam_section(reader, block, keys):
    # CalculiX has general sections of a material, with the shapes and lines of the others
    has_moduli = block.keyword == "BEAM GENERAL SECTION" and block.get("MATERIAL") is None
    shape = block.get("SECTION") or ("GENERAL" if has_moduli else "")
    shape = next((full for full in ("RECT", "CIRC") if shape.startswith(full)), shape)
    if has_moduli and shape == "GENERAL":
        type, values, mass = _general(block)
    elif has_moduli:
        E, G = _modulus_line(block)
        density = number(block.get("DENSITY"), block.place) if block.get("DENSITY") else 0.0
        solid = {"Young Modulus": E, "Shear Modulus": G, "Density": density}
        type, values, mass = _profile(reader, shape, block, solid)
    else:
        material = reader.model.materials[_find_material(reader, block.required("MATERIAL"), block.place)]
        if material.type != "Isotropic":
            refuse(block.place, "beams need an isotropic material")
        solid = {k: material.values[k] for k in ("Young Modulus", "Poisson Ratio")}
        solid["Density"] = material.values.get("Density", 0.0)
        type, values, mass = _profile(reader, shape, block, solid)
    most = 3 if has_moduli else 2
    if len(block.lines) > most:
        refuse(block.lines[most][0], f"*{block.keyword} has {most} lines of data, this is one more")
    name = _free((block.get("ELSET") or "section").lower(), reader.model.sections)
    reader.model.sections[name] = Section(type, values, mass, block.place)
    up = DEFAULT_UP
    if len(block.lines) > 1 and any(block.lines[1][1][:3]):
        place, cells = block.lines[1]
        up = [*numbers_of(cells[:3], place, "a direction"), 0.0, 0.0][:3]
        up = tuple(map(float, numpy.round(turned(reader, up), 12))) if is_turned(reader) else tuple(up)
    elif any(key not in reader.direction_nodes for key in keys):
        _tell_default(reader, block, "direction of a beam section")
    for key in keys:
        own = _direction_of(reader, key, block.place)
        reader.model.beams.append(element_of(reader, key, None, name, up if own is None else own))


def _tell_default(reader, block, what):
    if is_turned(reader):
        text = f"the {what} that the file does not give is that of space, not turned with the instance"
        reader.findings.assume(text, block.place)


def _direction_of(reader, key, place):
    """From the first node of a beam element to the one beyond its own, if there is one."""
    if key not in reader.direction_nodes:
        return None
    nodes, first = reader.model.nodes, reader.elements[key][1][0]
    direction = nodes[reader.direction_nodes[key]] - nodes[first]
    if numpy.linalg.norm(direction) == 0.0:
        refuse(place, "the node for the direction of a beam element is where its first one is")
    return tuple(map(float, direction))


def _modulus_line(block):
    if len(block.lines) < 3:
        refuse(block.place, "*BEAM GENERAL SECTION needs lines of dimensions, direction and moduli")
    place, cells = block.lines[2]
    return [number(cell, place, "a modulus") for cell in cells[:2]]


def _profile(reader, shape, block, solid):
    """(type of the deck, values, mass per length)"""
    place, cells = block.lines[0] if block.lines else (block.place, [])
    sizes = numbers_of(cells, place, "a dimension")
    needed = {"RECT": 2, "CIRC": 1, "PIPE": 2, "BOX": 6, "I": 7}
    if shape not in needed:
        refuse(block.place, f"beam sections of shape {shape or 'none'} are not read; {', '.join(needed)} and GENERAL are")
    if len(sizes) < needed[shape] or min(sizes[: needed[shape]]) <= 0.0:
        refuse(place, f"a section of shape {shape} needs {needed[shape]} positive dimensions")
    density = solid["Density"]
    if shape == "RECT":
        a, b = sizes[:2]
        return "Rectangle", {**solid, "Width": a, "Height": b}, density * a * b
    if shape == "CIRC":
        radius = _radius(reader, sizes, place)
        return "Circle", {**solid, "Radius": radius}, density * numpy.pi * radius**2
    if shape == "PIPE":
        r, t = sizes[:2]
        return "Tube", {**solid, "Outer Radius": r, "Wall Thickness": t}, density * numpy.pi * (r**2 - (r - t) ** 2)
    if shape == "BOX":
        a, b, t1, t2, t3, t4 = sizes[:6]
        if t1 != t3 or t2 != t4:
            refuse(place, "a box with walls of different thickness on opposite sides is not read")
        values = {**solid, "Width": a, "Height": b, "Web Thickness": t1, "Flange Thickness": t2}
        return "Box", values, density * (a * b - (a - 2 * t1) * (b - 2 * t2))
    reader.findings.assume("an I section has shear areas of its web and of 5/6 of its flanges", block.place)
    values = i_section(*sizes[:7], solid)
    return "Stiffness Values", values, values["rhoA"]


def _radius(reader, sizes, place):
    """Of CIRC: Abaqus gives the radius, CalculiX two diameters, the second of which may be absent."""
    if reader.program == "CalculiX":
        if len(sizes) > 1 and sizes[0] != sizes[1]:
            refuse(place, "an ellipse has no counterpart among the sections of culm")
        return sizes[0] / 2
    if len(sizes) > 1:
        refuse(place, "CIRC with two numbers, the diameters of an ellipse, is CalculiX's: culm import calculix")
    reader.findings.assume("the number of CIRC is the radius, as in Abaqus; CalculiX has the diameter: culm import calculix", place)
    return sizes[0]


def _general(block):
    """A, I11, I12, I22, J of a section of one material."""
    place, cells = block.lines[0] if block.lines else (block.place, [])
    sizes = numbers_of(cells, place, "a section value")
    if len(sizes) < 5:
        refuse(place, "a GENERAL section needs A, I11, I12, I22 and J")
    A, I11, I12, I22, J = sizes[:5]
    E, G = _modulus_line(block)
    density = number(block.get("DENSITY"), block.place) if block.get("DENSITY") else 0.0
    values = {
        "EA": E * A, "GA1": G * A, "GA2": G * A, "EI1": E * I11, "EI2": E * I22, "GIp": G * J, "EI12": E * I12,
        "rhoA": density * A, "rhoI1": density * I11, "rhoI2": density * I22, "rhoI12": density * I12,
    }  # fmt: skip
    return "Stiffness Values", values, density * A


def _mass(reader, block, keys):
    mass = _values(block, 1, "a mass")[0]
    for key in keys:
        reader.model.masses.append(point_mass(reader, key, mass, None))
        reader.findings.count("point masses")


def _rotary(reader, block, keys):
    values = _values(block, 1, "an inertia")
    cells = [cell for cell in block.lines[0][1]]
    values = [number(cell, block.place) if cell else 0.0 for cell in [*cells, *[""] * 6][:6]]
    I11, I22, I33, I12, I13, I23 = values
    if is_turned(reader):
        axes = numpy.array([turned(reader, one) for one in numpy.eye(3)])
        tensor = axes.T @ numpy.array([[I11, I12, I13], [I12, I22, I23], [I13, I23, I33]]) @ axes
        I11, I22, I33, I12, I13, I23 = map(float, tensor[(0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)])
        reader.findings.assume("a rotary inertia of a part turns with its instance", block.place)
    for key in keys:
        reader.model.masses.append(point_mass(reader, key, 0.0, (I11, I22, I33, I23, I13, I12)))
        reader.findings.count("rotary inertias")
