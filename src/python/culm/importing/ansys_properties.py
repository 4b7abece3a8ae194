"""Materials, walls and sections of beams from the tables of ANSYS."""

import numpy

from .ansys_file import whole
from .findings import refuse
from .keyword_file import number
from .model import Layer, Material, Section, Wall
from .profiles import i_section

BY_CONSTANTS = (43, 63, 93)  # shells that have no sections, whatever number of one they carry


def make_materials(reader):
    for material, values in reader.materials.items():
        if "EX" not in values:
            continue
        place = reader.material_places[material]
        density = values.get("DENS", 0.0)
        name = f"material {material}"
        if "EY" not in values:
            nu = values.get("PRXY", values.get("NUXY", 0.3))
            if "PRXY" not in values and "NUXY" not in values:
                reader.findings.assume("a material without Poisson's ratio has 0.3", place)
            shear = values["EX"] / (2.0 * (1.0 + nu))
            if abs(values.get("GXY", shear) - shear) > 0.01 * abs(shear):
                text = "GXY of an isotropic material that is not EX / (2 (1 + PRXY)), which is taken"
                reader.findings.leave_out(text, place)
            reader.model.materials[name] = Material(
                "Isotropic", {"Young Modulus": values["EX"], "Poisson Ratio": nu, "Density": density}, place
            )
            continue
        reader.model.materials[name] = Material("Orthotropic", _orthotropic(reader, values, density, place), place)


def _orthotropic(reader, values, density, place):
    """PR.. are ratios under tension along the first axis; NU.. under tension along the second."""
    E = [values[label] if label in values else values["EX"] for label in ("EX", "EY", "EZ")]
    ratios = []
    for axes, i, j in (("XY", 0, 1), ("XZ", 0, 2), ("YZ", 1, 2)):
        if "PR" + axes in values:
            ratios.append(values["PR" + axes])
        elif "NU" + axes in values:
            ratios.append(values["NU" + axes] * E[i] / E[j])
        else:
            ratios.append(0.3)
            reader.findings.assume(f"an orthotropic material without PR{axes} has 0.3", place)
    for label in ("GXY", "GXZ", "GYZ"):
        if label not in values:
            refuse(place, f"an orthotropic material needs {label}")
    names = ("E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23", "Density")
    return dict(zip(names, (*E, *ratios, values["GXY"], values["GXZ"], values["GYZ"], density)))


def find_material(reader, number_, place):
    name = f"material {number_}"
    if name not in reader.model.materials:
        refuse(place, f"there is no material {number_} with EX")
    return name


def make_wall(reader, kind, material, real, section, place):
    if kind not in BY_CONSTANTS and section in reader.sections and reader.sections[section][0] == "SHELL":
        name = f"section {section}" if _has_materials(reader, section) else f"section {section} material {material}"
        if name not in reader.model.walls:
            _, _, rows, where = reader.sections[section]
            layers = [_layer(reader, at, cells, material) for at, cells in rows if any(cells)]
            if not layers:
                refuse(where, f"section {section} has no layers")
            reader.model.walls[name] = Wall(layers, where)
        return name
    if real not in reader.constants or not reader.constants[real]:
        refuse(place, f"neither section {section} nor constants {real} give this shell a thickness")
    name = f"real {real} material {material}"
    values = reader.constants[real]
    _refuse_constants(reader, real, values, range(4, len(values)), f"SHELL{kind}", place)
    if any(value not in (0.0, values[0]) for value in values[1:4]):
        reader.findings.assume("a thickness that varies over an element is that of its first node", place)
    if values[0] <= 0.0:
        refuse(place, f"a thickness must be > 0, got {values[0]:g}")
    reader.model.walls.setdefault(name, Wall([Layer(values[0], find_material(reader, material, place))], place))
    return name


def _refuse_constants(reader, real, values, places, what, place):
    """Angles, foundations, masses and strains among real constants; 1 and more count from the first."""
    for i in places:
        if i < len(values) and values[i]:
            refuse(place, f"constant {i + 1} of the set {real} is {values[i]:g}: of {what} it is not read")


def _has_materials(reader, section):
    return all(len(cells) > 1 and cells[1].strip() for _, cells in reader.sections[section][2])


def _layer(reader, place, cells, material):
    cells = [cell.strip() for cell in cells]
    thickness = number(cells[0], place, "a thickness")
    if thickness <= 0.0:
        refuse(place, f"a thickness must be > 0, got {thickness:g}")
    own = whole(cells[1], place, "a material") if len(cells) > 1 and cells[1] else material
    angle = number(cells[2], place, "an angle") if len(cells) > 2 and cells[2] else 0.0
    return Layer(thickness, find_material(reader, own, place), angle)


def make_profile(reader, kind, material, real, section, place):
    name = f"section {section} material {material}" if kind != 4 else f"real {real} material {material}"
    if name in reader.model.sections:
        return name
    solid = reader.model.materials[find_material(reader, material, place)]
    if solid.type != "Isotropic":
        refuse(place, "beams need an isotropic material")
    if kind == 4:
        type, values, mass = _by_constants(reader, real, solid.values, place)
    else:
        if section not in reader.sections or reader.sections[section][0] != "BEAM":
            refuse(place, f"there is no beam section {section}")
        type, values, mass = _by_section(reader, section, solid.values)
    reader.model.sections[name] = Section(type, values, mass, place)
    return name


def _by_constants(reader, real, solid, place):
    """BEAM4: area, Izz, Iyy, thickness along z and y, angle, strain, torsion."""
    values = [*reader.constants.get(real, []), *[0.0] * 8]
    A, Izz, Iyy, angle, J = values[0], values[1], values[2], values[5], values[7]
    if angle:
        refuse(place, "BEAM4 with THETA is not read")
    _refuse_constants(reader, real, values, (6, 11), "BEAM4", place)
    return _values(reader, A, Iyy, Izz, 0.0, J or Iyy + Izz, solid, place)


def _values(reader, A, Iyy, Izz, Iyz, J, solid, place):
    if min(A, Iyy, Izz, J) <= 0.0:
        refuse(place, "a beam needs area, inertias and torsion > 0")
    E, density = solid["Young Modulus"], solid["Density"]
    G = E / (2.0 * (1.0 + solid["Poisson Ratio"]))
    reader.findings.assume("sections by values have shear areas of 5/6 of the area", place)
    values = {
        "EA": E * A, "GA1": G * A * 5 / 6, "GA2": G * A * 5 / 6, "EI1": E * Iyy, "EI2": E * Izz, "GIp": G * J, "EI12": E * Iyz,
        "rhoA": density * A, "rhoI1": density * Iyy, "rhoI2": density * Izz, "rhoI12": density * Iyz,
    }  # fmt: skip
    return "Stiffness Values", values, density * A


def _by_section(reader, section, solid):
    _, shape, rows, place = reader.sections[section]
    needed = {"RECT": 2, "CSOLID": 1, "CTUBE": 2, "HREC": 6, "I": 6, "ASEC": 6}
    if shape not in needed:
        refuse(place, f"beam sections of shape {shape or 'none'} are not read; {', '.join(needed)} are")
    cells = [(at, cell.strip()) for at, row in rows for cell in row]
    cells = cells[: max((i + 1 for i, (_, cell) in enumerate(cells) if cell), default=0)]
    if len(cells) < needed[shape]:
        refuse(place, f"a section of shape {shape} needs {needed[shape]} dimensions")
    sizes = [number(cell or "0", at, "a dimension") for at, cell in cells]
    if shape == "ASEC":
        if any(sizes[6:10]):
            refuse(place, "a section ASEC with its centroid or shear centre beside the node is not read")
        A, Iyy, Iyz, Izz, _, J = sizes[:6]
        return _values(reader, A, Iyy, Izz, Iyz, J, solid, place)
    if min(sizes[: needed[shape]]) <= 0.0:
        refuse(place, "dimensions must be > 0")
    density = solid["Density"]
    if shape == "RECT":
        values, area, type = {"Width": sizes[0], "Height": sizes[1]}, sizes[0] * sizes[1], "Rectangle"
    elif shape == "CSOLID":
        values, area, type = {"Radius": sizes[0]}, numpy.pi * sizes[0] ** 2, "Circle"
    elif shape == "CTUBE":
        inner, outer = sizes[:2]
        values, type = {"Outer Radius": outer, "Wall Thickness": outer - inner}, "Tube"
        area = numpy.pi * (outer**2 - inner**2)
    elif shape == "HREC":
        width, height, t1, t2, t3, t4 = sizes[:6]
        if t1 != t2 or t3 != t4:
            refuse(place, "a box with walls of different thickness on opposite sides is not read")
        values = {"Width": width, "Height": height, "Web Thickness": t1, "Flange Thickness": t3}
        type, area = "Box", width * height - (width - 2 * t1) * (height - 2 * t3)
    else:
        bottom, top, height, t_bottom, t_top, t_web = sizes[:6]
        areas = numpy.array([bottom * t_bottom, t_web * (height - t_bottom - t_top), top * t_top])
        centres = numpy.array([t_bottom / 2, t_bottom + (height - t_bottom - t_top) / 2, height - t_top / 2])
        values = i_section((areas @ centres) / areas.sum(), height, bottom, top, t_bottom, t_top, t_web, solid)
        return "Stiffness Values", values, values["rhoA"]
    return type, {**solid, **values}, density * area
