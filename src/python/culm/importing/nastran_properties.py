"""Materials and properties of shells and beams of Nastran."""

import numpy

from .findings import refuse
from .model import Layer, Material, Section, Wall

NO_SHEAR = 1e3  # areas of shear by the area, of beams that do not shear


def read_materials(reader):
    for card in reader.cards("MAT1"):
        number = reader.unique(reader.model.materials, card, "material")
        E, G, nu = (card.real(i) if card.text(i) else None for i in (2, 3, 4))
        if [E, G, nu].count(None) > 1:
            refuse(card.place, "MAT1 needs two of E, G and nu")
        if None not in (E, G, nu) and abs(G - E / (2.0 * (1.0 + nu))) > 0.01 * abs(G):
            reader.findings.leave_out("G of a MAT1 that is not E / (2 (1 + nu)), which is taken", card.place)
        E = 2.0 * G * (1.0 + nu) if E is None else E
        nu = E / (2.0 * G) - 1.0 if nu is None else nu
        values = {"Young Modulus": E, "Poisson Ratio": nu, "Density": card.real(5, default=0.0) * reader.masses_by}
        reader.model.materials[number] = Material("Isotropic", values, card.place)
    for card in reader.cards("MAT8"):
        number = reader.unique(reader.model.materials, card, "material")
        E1, E2, nu12, G12 = (card.real(i) for i in (2, 3, 4, 5))
        G13, G23 = card.real(6, default=G12), card.real(7, default=G12)
        if not card.text(6) or not card.text(7):
            reader.findings.assume("MAT8 without G1Z or G2Z: they are G12", card.place)
        values = {"E1": E1, "E2": E2, "E3": E2, "nu12": nu12, "nu13": nu12, "nu23": 0.3, "G12": G12, "G13": G13,
                  "G23": G23, "Density": card.real(8, default=0.0) * reader.masses_by}  # fmt: skip
        reader.model.materials[number] = Material("Orthotropic", values, card.place)
        reader.findings.assume("MAT8 has E3 = E2, nu13 = nu12, nu23 = 0.3 through the thickness", card.place)
    reader.model.materials = {f"material {n}": m for n, m in reader.model.materials.items()}


def _material(reader, card, i):
    name = f"material {card.integer(i, 'the number of a material')}"
    reader.find(reader.model.materials, name, card, "card")
    return name


def read_properties(reader):
    reader.properties = {}
    for card in reader.cards("PSHELL"):
        number = reader.unique(reader.properties, card, "property")
        name = _material(reader, card, 2)
        thickness = _thickness(reader, card, 3)
        _tell_bending(reader, card)
        for i, usual, what in ((5, 1.0, "12 I/T^3"), (7, 0.8333, "TS/T")):
            if abs(card.real(i, default=usual) - usual) > 0.01 * usual:
                reader.findings.leave_out(f"{what} of PSHELL", card.place)
        _wall(reader, number, _loaded(reader, [Layer(thickness, name)], card.real(8, default=0.0)), card)
    for card in reader.cards("PCOMP"):
        number = reader.unique(reader.properties, card, "property")
        layers = []
        for i in range(9, len(card.fields) + 1, 4):
            if any(card.text(k) for k in range(i, i + 4)):
                before = layers[-1] if layers else None
                name = _material(reader, card, i) if card.text(i) else before and before.material
                thickness = _thickness(reader, card, i + 1) if card.text(i + 1) else before and before.thickness
                if name is None or thickness is None:
                    refuse(card.place, "the first layer of PCOMP needs material and thickness")
                layers.append(Layer(thickness, name, card.real(i + 2, default=0.0)))
        if not layers:
            refuse(card.place, "PCOMP without layers")
        if card.text(8).upper() == "SYM":
            layers += layers[::-1]
        elif card.text(8):
            refuse(card.place, f"PCOMP with LAM = {card.text(8)[:10]} is not read; SYM and none are")
        total = sum(layer.thickness for layer in layers)
        if card.text(2) and abs(card.real(2) + 0.5 * total) > 1e-6 * total:
            reader.findings.leave_out("Z0 of PCOMP: the nodes are in the middle of the layers", card.place)
        _wall(reader, number, _loaded(reader, layers, card.real(3, default=0.0)), card)
    for card in reader.cards("PBAR"):
        _bar(reader, card, *(card.real(i, default=0.0) for i in (3, 4, 5, 6, 19)), card.real(7, default=0.0))
    for card in reader.cards("PBARL", "PBEAML"):
        _profile(reader, card)
    for card in reader.cards("PBEAM"):
        _constant_beam(reader, card)


def _tell_bending(reader, card):
    """A shell of culm bends, by the material of its membrane, and shears."""
    bending = card.text(4)
    if not bending or bending.startswith("-"):
        reader.findings.leave_out("PSHELL without bending or in plane strain (MID2): shells of culm bend", card.place)
    elif bending != card.text(2):
        refuse(card.place, "PSHELL with another material for bending (MID2) is not read")
    if not card.text(6):
        reader.findings.assume("PSHELL without MID3 does not shear across; culm's shells do", card.place)
    elif card.text(6) != card.text(2):
        reader.findings.leave_out("another material for shear across (MID3 of PSHELL)", card.place)


def _loaded(reader, layers, per_area):
    """Layers with what is not structural, spread over their thickness."""
    if not per_area:
        return layers
    denser = per_area * reader.masses_by / sum(layer.thickness for layer in layers)
    found = []
    for layer in layers:
        bare = reader.model.materials[layer.material]
        name = f"{layer.material} with {denser:.6g} kg per m3"
        values = {**bare.values, "Density": bare.values["Density"] + denser}
        reader.model.materials.setdefault(name, Material(bare.type, values, bare.place))
        found.append(Layer(layer.thickness, name, layer.angle))
    return found


def _thickness(reader, card, i):
    value = card.real(i, "a thickness")
    if value <= 0.0:
        refuse(card.place, f"a thickness must be > 0, got {value:g}")
    return value


def _wall(reader, number, layers, card):
    reader.properties[number] = f"shell {number}"
    reader.model.walls[f"shell {number}"] = Wall(layers, card.place)


def _solid(reader, card):
    material = reader.model.materials[_material(reader, card, 2)]
    if material.type != "Isotropic":
        refuse(card.place, "beams need an isotropic material, MAT1")
    return material.values


def _bar(reader, card, A, I1, I2, J, I12, per_length, factors=None):
    """Plane 1 is that of the orientation vector, along d1: I1 is the integral of E xi1^2."""
    number = reader.unique(reader.properties, card, "property")
    solid = _solid(reader, card)
    E, density = solid["Young Modulus"], solid["Density"]
    G = E / (2.0 * (1.0 + solid["Poisson Ratio"]))
    if A <= 0.0 or I1 <= 0.0 or I2 <= 0.0 or J <= 0.0:
        refuse(card.place, "a beam needs A, I1, I2 and J > 0")
    K1, K2 = factors or (card.real(17, default=0.0), card.real(18, default=0.0))
    if K1 == 0.0 or K2 == 0.0:
        words = "K1 or K2 blank or 0: the beam does not shear there, as in Nastran"
        reader.findings.assume(f"{words}; GA is {NO_SHEAR:g} G A", card.place)
        K1, K2 = K1 or NO_SHEAR, K2 or NO_SHEAR
    mass = density * A + per_length * reader.masses_by
    values = {
        "EA": E * A, "GA1": K1 * G * A, "GA2": K2 * G * A, "EI1": E * I2, "EI2": E * I1, "GIp": G * J, "EI12": E * I12,
        "rhoA": mass, "rhoI1": density * I2, "rhoI2": density * I1, "rhoI12": density * I12,
    }  # fmt: skip
    _section(reader, number, "Stiffness Values", values, mass, card)


def _section(reader, number, type, values, mass, card):
    reader.properties[number] = f"beam {number}"
    reader.model.sections[f"beam {number}"] = Section(type, values, mass, card.place)


def _profile(reader, card):
    """Dimensions across are along z of the element, d2; dimensions up are along y, d1."""
    number = reader.unique(reader.properties, card, "property")
    solid = _solid(reader, card)
    shape = card.text(4).upper()
    needed = {"ROD": 1, "TUBE": 2, "BAR": 2, "BOX": 4}
    if shape not in needed:
        refuse(card.place, f"{card.name} of type {shape or 'none'} is not read; {', '.join(needed)} are")
    sizes = [card.real(9 + i, "a dimension") for i in range(needed[shape])]
    if min(sizes) <= 0.0:
        refuse(card.place, "dimensions must be > 0")
    rest = [card.text(i) for i in range(9 + needed[shape], len(card.fields) + 1)]
    if card.name == "PBEAML" and any(rest[1:]):
        reader.findings.leave_out("stations of PBEAML: the section of its first end is taken all along", card.place)
    if shape == "ROD":
        type, values, area = "Circle", {"Radius": sizes[0]}, numpy.pi * sizes[0] ** 2
    elif shape == "TUBE":
        outer, inner = sizes
        type, values = "Tube", {"Outer Radius": outer, "Wall Thickness": outer - inner}
        area = numpy.pi * (outer**2 - inner**2)
    elif shape == "BAR":
        type, values, area = "Rectangle", {"Width": sizes[1], "Height": sizes[0]}, sizes[0] * sizes[1]
    else:
        across, up, flange, web = sizes
        type = "Box"
        values = {"Width": up, "Height": across, "Flange Thickness": web, "Web Thickness": flange}
        area = across * up - (across - 2 * web) * (up - 2 * flange)
    if card.real(9 + needed[shape], default=0.0):  # what is not structural, spread over the section
        solid = {**solid, "Density": solid["Density"] + card.real(9 + needed[shape]) * reader.masses_by / area}
    _section(reader, number, type, {**solid, **values}, solid["Density"] * area, card)


def _constant_beam(reader, card):
    i = 17
    while card.text(i).upper() in ("YES", "YESA", "NO"):
        reader.findings.leave_out("stations of PBEAM: the section of its first end is taken all along", card.place)
        i += 16 if card.text(i).upper() == "YES" else 8
    factors = (card.real(i, default=1.0), card.real(i + 1, default=1.0))
    if any(card.real(k, default=0.0) for k in range(i + 8, i + 16)):
        reader.findings.leave_out("centres of mass and neutral axes beside the axis (PBEAM)", card.place)
    A, I1, I2, I12, J, mass = (card.real(i, default=0.0) for i in (3, 4, 5, 6, 7, 8))
    _bar(reader, card, A, I1, I2, J or I1 + I2, I12, mass, factors)
    if not J:
        reader.findings.assume("PBEAM without J: J = I1 + I2", card.place)


def find_property(reader, card, kind):
    number = card.integer(2, "the number of a property", default=card.integer(1))
    name = reader.find(reader.properties, number, card, "property")
    if not name.startswith(kind):
        refuse(card.place, f"property {number} is none of a {kind}")
    return name
