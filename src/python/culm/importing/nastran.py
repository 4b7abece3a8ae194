"""Models of Nastran: bulk data with case control, SOL 101, 103, 105 and 106."""

import collections
import re

import numpy

from .findings import did_you_mean, refuse
from .model import (
    BeamElement,
    Coupling,
    ElementLoad,
    Layer,
    Material,
    Model,
    NodeLoad,
    PointMass,
    Section,
    ShellElement,
    Step,
    Support,
    Wall,
    cylinder_axes,
    supports_along,
)
from .nastran_file import read_deck

FILE = "input file, .bdf, .dat or .nas"

SHELLS = {"CQUAD4": 4, "CQUADR": 4, "CTRIA3": 3, "CTRIAR": 3, "CQUAD8": 8, "CTRIA6": 6}
SILENT = {
    "PARAM", "EIGR", "EIGRL", "EIGB", "NLPARM", "TSTEPNL", "SET1", "ASET1", "ECHOON", "ECHOOFF", "DEBUG", "OMIT1",
    "CORD2R", "CORD2C", "CORD2S", "LOAD", "SPCADD", "MDLPRM",
}  # fmt: skip
# Without these the deck would be another structure.
STRUCTURE = {
    "CROD", "CONROD", "CTUBE", "CBEND", "CHEXA", "CPENTA", "CTETRA", "CPYRAM", "CSHEAR", "CBUSH", "CELAS1", "CELAS2",
    "CELAS3", "CELAS4", "RBAR", "RBE1", "MPC", "CQUADX", "CTRIAX", "CTRIAX6", "CBAR3", "CBEAM3", "GRDSET", "CQUAD", "CGAP",
    "CBUSH1D", "CORD1R", "CORD1C", "CORD1S", "MAT2", "MAT9", "PCOMPG", "SPOINT", "CWELD", "CFAST",
}  # fmt: skip
STATIC, MODAL, BUCKLING, NONLINEAR = "101", "103", "105", "106"
SOLUTIONS = {"SESTATIC": STATIC, "STATIC": STATIC, "STATICS": STATIC, "MODES": MODAL, "SEMODES": MODAL,
             "BUCKLING": BUCKLING, "SEBUCKL": BUCKLING, "NLSTATIC": NONLINEAR}  # fmt: skip


def read(path, arguments):
    """@return the Model of an input file"""
    del arguments
    return Reader(path).read()


class Reader:
    def __init__(self, path):
        self.path = path
        self.model = Model(title=path.stem)
        self.findings = self.model.findings
        self.deck = read_deck(path)
        if not self.deck.is_closed:
            self.findings.assume("the file has no ENDDATA: it is taken as whole")
            self.findings.look_at_end(path)
        self.by_name = collections.defaultdict(list)
        for card in self.deck.cards:
            self.by_name[card.name].append(card)
        self.masses_by = 1.0  # PARAM WTMASS
        self.offset_nodes = {}  # (node, offset) -> the end of a beam beside it

    def read(self):
        for name in self.by_name:
            if name in STRUCTURE:
                refuse(self.by_name[name][0].place, f"{name} is not read, and without it the model would be another one")
        self._parameters()
        self._systems()
        self._nodes()
        self._materials()
        self._properties()
        self._shells()
        self._beams()
        self._masses()
        self._couplings()
        if not self.model.shells and not self.model.beams:
            refuse(self.deck.cards[0].place if self.deck.cards else self.path, "the file has no shells and no beams")
        self._steps()
        for name in set(self.by_name) - READ - SILENT:
            for card in self.by_name[name]:
                self.findings.leave_out(name, card.place)
        self._tell_unread()
        return self.model

    def _tell_unread(self):
        """Fields that hold something and that nobody asked for, of cards that were read beyond their number."""
        for name in READ:
            harmless = HARMLESS.get(name, ())
            for card in self.by_name[name]:
                for i in card.unread() if card.asked - {1} else ():
                    if i != 1 and i not in harmless:
                        self.findings.leave_out(f"field {i} of {name}", card.place)

    def _cards(self, *names):
        for name in names:
            if self.by_name[name]:
                self.findings.count(name, len(self.by_name[name]))
            yield from self.by_name[name]

    def _unique(self, table, card, what):
        number = card.integer(1, f"the number of {what}")
        if number in table:
            refuse(card.place, f"{what} {number} is there twice")
        return number

    def _find(self, table, number, card, what):
        if number not in table:
            refuse(card.place, f"there is no {what} {number}{did_you_mean(number, table)}")
        return table[number]

    def _node(self, card, i):
        number = card.integer(i, "the number of a node")
        self._find(self.model.nodes, number, card, "node")
        return number

    def _parameters(self):
        for card in self.by_name["PARAM"]:
            if card.text(1).upper() == "WTMASS":
                self.masses_by = card.real(2, "a factor")
                self.findings.assume(f"masses are those of the file times WTMASS = {self.masses_by:g}", card.place)

    def _systems(self):
        """Systems by three points: (origin, rows of axes)."""
        self.systems = {0: (numpy.zeros(3), numpy.eye(3))}
        self.curved = {}  # their cards: of these places are read, and directions refused
        for card in self._cards("CORD2R", "CORD2C", "CORD2S"):
            number = self._unique(self.systems, card, "coordinate system")
            origin, axes = self._find(self.systems, card.integer(2, default=0), card, "coordinate system")
            a, b, c = (numpy.array([card.real(i + k, default=0.0) for k in range(3)]) for i in (3, 6, 9))
            z, x = b - a, c - a
            if numpy.linalg.norm(numpy.cross(z, x)) <= 1e-9 * numpy.linalg.norm(z) * numpy.linalg.norm(x):
                refuse(card.place, "the three points of the system are on one line")
            z = z / numpy.linalg.norm(z)
            y = numpy.cross(z, x) / numpy.linalg.norm(numpy.cross(z, x))
            local = numpy.array([numpy.cross(y, z), y, z])
            self.systems[number] = (origin + a @ axes, local @ axes)
            if card.name != "CORD2R":
                self.curved[number] = card

    def _system(self, card, i):
        number = card.integer(i, default=0)
        if number in self.curved:
            refuse(card.place, f"directions in the system {number}, {self.curved[number].name}, are not read")
        return self._find(self.systems, number, card, "coordinate system")

    def _position(self, card, i):
        """A place in any system: x, y, z, or r, theta, z."""
        number = card.integer(i, default=0)
        origin, axes = self._find(self.systems, number, card, "coordinate system")
        place = numpy.array([card.real(i + k, default=0.0) for k in (1, 2, 3)])
        if number in self.curved:
            if self.curved[number].name == "CORD2S":
                refuse(card.place, f"places in the system {number}, CORD2S, are not read")
            angle = numpy.radians(place[1])
            place = numpy.array([place[0] * numpy.cos(angle), place[0] * numpy.sin(angle), place[2]])
        return origin + place @ axes

    def _vector(self, card, system, first):
        """A direction in a system of coordinates, in space."""
        _, axes = self._system(card, system)
        return numpy.array([card.real(first + k, default=0.0) for k in range(3)]) @ axes

    def _nodes(self):
        self.axes = {}  # rows of the system of a node's degrees of freedom
        self.held = {}  # by the cards of the nodes
        for card in self._cards("GRID"):
            number = self._unique(self.model.nodes, card, "node")
            self.model.nodes[number] = self._position(card, 2)
            if card.integer(6, default=0) > 0:
                self.axes[number] = self._axes_at(self.model.nodes[number], card, 6)
            if card.text(7).strip("0"):
                self.held[number] = (card.text(7), card)
        if not self.model.nodes:
            refuse(self.deck.cards[0].place if self.deck.cards else self.path, "the file has no GRID")

    def _axes_at(self, position, card, i):
        number = card.integer(i)
        origin, axes = self._find(self.systems, number, card, "coordinate system")
        if number not in self.curved:
            return axes
        if self.curved[number].name == "CORD2S":
            refuse(card.place, f"directions in the system {number}, CORD2S, are not read")
        return cylinder_axes(origin, axes[2], position, card.place)

    def _materials(self):
        for card in self._cards("MAT1"):
            number = self._unique(self.model.materials, card, "material")
            E, G, nu = (card.real(i) if card.text(i) else None for i in (2, 3, 4))
            if [E, G, nu].count(None) > 1:
                refuse(card.place, "MAT1 needs two of E, G and nu")
            E = 2.0 * G * (1.0 + nu) if E is None else E
            nu = E / (2.0 * G) - 1.0 if nu is None else nu
            values = {"Young Modulus": E, "Poisson Ratio": nu, "Density": card.real(5, default=0.0) * self.masses_by}
            self.model.materials[number] = Material("Isotropic", values, card.place)
        for card in self._cards("MAT8"):
            number = self._unique(self.model.materials, card, "material")
            E1, E2, nu12, G12 = (card.real(i) for i in (2, 3, 4, 5))
            G13, G23 = card.real(6, default=G12), card.real(7, default=G12)
            if not card.text(6) or not card.text(7):
                self.findings.assume("MAT8 without G1Z or G2Z: they are G12", card.place)
            values = {"E1": E1, "E2": E2, "E3": E2, "nu12": nu12, "nu13": nu12, "nu23": 0.3, "G12": G12, "G13": G13,
                      "G23": G23, "Density": card.real(8, default=0.0) * self.masses_by}  # fmt: skip
            self.model.materials[number] = Material("Orthotropic", values, card.place)
            self.findings.assume("MAT8 has E3 = E2, nu13 = nu12, nu23 = 0.3 through the thickness", card.place)
        self.model.materials = {f"material {n}": m for n, m in self.model.materials.items()}

    def _material(self, card, i):
        name = f"material {card.integer(i, 'the number of a material')}"
        self._find(self.model.materials, name, card, "card")
        return name

    def _properties(self):
        self.properties = {}
        for card in self._cards("PSHELL"):
            number = self._unique(self.properties, card, "property")
            name = self._material(card, 2)
            thickness = self._thickness(card, 3)
            self._tell_bending(card)
            for i, usual, what in ((5, 1.0, "12 I/T^3"), (7, 0.8333, "TS/T")):
                if abs(card.real(i, default=usual) - usual) > 0.01 * usual:
                    self.findings.leave_out(f"{what} of PSHELL", card.place)
            self._wall(number, self._loaded([Layer(thickness, name)], card.real(8, default=0.0)), card)
        for card in self._cards("PCOMP"):
            number = self._unique(self.properties, card, "property")
            layers = []
            for i in range(9, len(card.fields) + 1, 4):
                if any(card.text(k) for k in range(i, i + 4)):
                    before = layers[-1] if layers else None
                    name = self._material(card, i) if card.text(i) else before and before.material
                    thickness = self._thickness(card, i + 1) if card.text(i + 1) else before and before.thickness
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
                self.findings.leave_out("Z0 of PCOMP: the nodes are in the middle of the layers", card.place)
            self._wall(number, self._loaded(layers, card.real(3, default=0.0)), card)
        for card in self._cards("PBAR"):
            self._bar(card, *(card.real(i, default=0.0) for i in (3, 4, 5, 6, 19)), card.real(7, default=0.0))
            if not any(card.text(i) for i in (17, 18)):
                self.findings.assume("PBAR without K1 and K2: shear areas are 5/6 of the area", card.place)
        for card in self._cards("PBARL", "PBEAML"):
            self._profile(card)
        for card in self._cards("PBEAM"):
            self._constant_beam(card)

    def _tell_bending(self, card):
        """A shell of culm bends, by the material of its membrane, and shears."""
        bending = card.text(4)
        if not bending or bending.startswith("-"):
            self.findings.leave_out("PSHELL without bending or in plane strain (MID2): shells of culm bend", card.place)
        elif bending != card.text(2):
            refuse(card.place, "PSHELL with another material for bending (MID2) is not read")
        if not card.text(6):
            self.findings.assume("PSHELL without MID3 does not shear across; culm's shells do", card.place)
        elif card.text(6) != card.text(2):
            self.findings.leave_out("another material for shear across (MID3 of PSHELL)", card.place)

    def _loaded(self, layers, per_area):
        """Layers with what is not structural, spread over their thickness."""
        if not per_area:
            return layers
        denser = per_area * self.masses_by / sum(layer.thickness for layer in layers)
        found = []
        for layer in layers:
            bare = self.model.materials[layer.material]
            name = f"{layer.material} with {denser:.6g} kg per m3"
            values = {**bare.values, "Density": bare.values["Density"] + denser}
            self.model.materials.setdefault(name, Material(bare.type, values, bare.place))
            found.append(Layer(layer.thickness, name, layer.angle))
        return found

    def _thickness(self, card, i):
        value = card.real(i, "a thickness")
        if value <= 0.0:
            refuse(card.place, f"a thickness must be > 0, got {value:g}")
        return value

    def _wall(self, number, layers, card):
        self.properties[number] = f"shell {number}"
        self.model.walls[f"shell {number}"] = Wall(layers, card.place)

    def _solid(self, card):
        material = self.model.materials[self._material(card, 2)]
        if material.type != "Isotropic":
            refuse(card.place, "beams need an isotropic material, MAT1")
        return material.values

    def _bar(self, card, A, I1, I2, J, I12, per_length, factors=None):
        """Plane 1 is that of the orientation vector, along d1: I1 is the integral of E xi1^2."""
        number = self._unique(self.properties, card, "property")
        solid = self._solid(card)
        E, density = solid["Young Modulus"], solid["Density"]
        G = E / (2.0 * (1.0 + solid["Poisson Ratio"]))
        if A <= 0.0 or I1 <= 0.0 or I2 <= 0.0 or J <= 0.0:
            refuse(card.place, "a beam needs A, I1, I2 and J > 0")
        K1, K2 = factors or (card.real(17, default=5 / 6), card.real(18, default=5 / 6))
        mass = density * A + per_length * self.masses_by
        values = {
            "EA": E * A, "GA1": K1 * G * A, "GA2": K2 * G * A, "EI1": E * I2, "EI2": E * I1, "GIp": G * J, "EI12": E * I12,
            "rhoA": mass, "rhoI1": density * I2, "rhoI2": density * I1, "rhoI12": density * I12,
        }  # fmt: skip
        self._section(number, "Stiffness Values", values, mass, card)

    def _section(self, number, type, values, mass, card):
        self.properties[number] = f"beam {number}"
        self.model.sections[f"beam {number}"] = Section(type, values, mass, card.place)

    def _profile(self, card):
        """Dimensions across are along z of the element, d2; dimensions up are along y, d1."""
        number = self._unique(self.properties, card, "property")
        solid = self._solid(card)
        shape = card.text(4).upper()
        needed = {"ROD": 1, "TUBE": 2, "BAR": 2, "BOX": 4}
        if shape not in needed:
            refuse(card.place, f"{card.name} of type {shape or 'none'} is not read; {', '.join(needed)} are")
        sizes = [card.real(9 + i, "a dimension") for i in range(needed[shape])]
        if min(sizes) <= 0.0:
            refuse(card.place, "dimensions must be > 0")
        rest = [card.text(i) for i in range(9 + needed[shape], len(card.fields) + 1)]
        if card.name == "PBEAML" and any(rest[1:]):
            self.findings.leave_out("stations of PBEAML: the section of its first end is taken all along", card.place)
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
            solid = {**solid, "Density": solid["Density"] + card.real(9 + needed[shape]) * self.masses_by / area}
        self._section(number, type, {**solid, **values}, solid["Density"] * area, card)

    def _constant_beam(self, card):
        i = 17
        while card.text(i).upper() in ("YES", "YESA", "NO"):
            self.findings.leave_out("stations of PBEAM: the section of its first end is taken all along", card.place)
            i += 16 if card.text(i).upper() == "YES" else 8
        factors = (card.real(i, default=1.0), card.real(i + 1, default=1.0))
        if any(card.real(k, default=0.0) for k in range(i + 8, i + 16)):
            self.findings.leave_out("centres of mass and neutral axes beside the axis (PBEAM)", card.place)
        A, I1, I2, I12, J, mass = (card.real(i, default=0.0) for i in (3, 4, 5, 6, 7, 8))
        self._bar(card, A, I1, I2, J or I1 + I2, I12, mass, factors)
        if not J:
            self.findings.assume("PBEAM without J: J = I1 + I2", card.place)

    def _property(self, card, kind):
        number = card.integer(2, "the number of a property", default=card.integer(1))
        name = self._find(self.properties, number, card, "property")
        if not name.startswith(kind):
            refuse(card.place, f"property {number} is none of a {kind}")
        return name

    def _shells(self):
        self.places = {}
        for card in self._cards(*SHELLS):
            number = self._unique(self.places, card, "element")
            size = SHELLS[card.name]
            nodes = tuple(self._node(card, 3 + i) for i in range(size))
            wall = self._property(card, "shell")
            angle = {3: 6, 4: 7, 6: 9, 8: 15}[size]
            offset = {3: 7, 4: 8, 6: 10, 8: 16}[size]
            if card.real(offset, default=0.0):
                self.findings.leave_out("ZOFFS of shells: the nodes are in the middle of the wall", card.place)
            axis = self._axis(card, nodes, angle, wall)
            self.places[number] = ("shell", len(self.model.shells))
            self.model.shells.append(ShellElement(number, nodes, wall, card.place, axis))

    def _axis(self, card, nodes, field, wall):
        """Axis 1 of the material: from the first side by an angle, or the x axis of a system."""
        text = card.text(field)
        layers = self.model.walls[wall].layers
        if all(self.model.materials[layer.material].type == "Isotropic" for layer in layers):
            return None
        if text and "." not in text and not re.search("[EeDd]", text):
            _, axes = self._system(card, field)
            return tuple(axes[0])
        side = self.model.nodes[nodes[1]] - self.model.nodes[nodes[0]]
        last = nodes[3] if SHELLS[card.name] in (4, 8) else nodes[2]
        normal = numpy.cross(side, self.model.nodes[last] - self.model.nodes[nodes[0]])
        if numpy.linalg.norm(normal) == 0.0:
            refuse(card.place, "an element has no area")
        normal = normal / numpy.linalg.norm(normal)
        turn = numpy.radians(card.real(field, default=0.0))
        return tuple(side * numpy.cos(turn) + numpy.cross(normal, side) * numpy.sin(turn))

    def _beams(self):
        for card in self._cards("CBAR", "CBEAM"):
            number = self._unique(self.places, card, "element")
            a, b = self._node(card, 3), self._node(card, 4)
            systems = card.text(8).upper() or "GGG"
            if not re.fullmatch("[BG][GEO]{2}", systems):
                refuse(card.place, f"{card.name} with OFFT = {systems[:8]} is not read")
            if card.text(6) or card.text(7) or not re.fullmatch("[0-9]+", card.text(5)):
                up = numpy.array([card.real(5 + i, default=0.0) for i in range(3)])
                up = up @ self.axes[a] if a in self.axes and systems[0] == "G" else up
            else:
                up = self.model.nodes[self._node(card, 5)] - self.model.nodes[a]
            if any(card.text(i).strip("0") for i in (9, 10)):
                self.findings.leave_out("pins of beams: their ends are held fast", card.place)
            ends = tuple(self._beside(node, card, 11 + 3 * i, systems[1 + i]) for i, node in enumerate((a, b)))
            self.places[number] = ("beam", len(self.model.beams))
            self.model.beams.append(BeamElement(number, ends, self._property(card, "beam"), tuple(up), card.place))

    def _beside(self, node, card, field, system):
        """The end of a beam: the node, or one that an arm holds beside it."""
        offset = numpy.array([card.real(field + i, default=0.0) for i in range(3)])
        if not offset.any():
            return node
        if system != "G":
            refuse(card.place, f"offsets in the axes of the element (OFFT {card.text(8)}) are not read")
        offset = offset @ self.axes[node] if node in self.axes else offset
        key = (node, tuple(numpy.round(offset, 9)))
        if key not in self.offset_nodes:
            end = f"{node} offset {len(self.offset_nodes) + 1}"
            self.offset_nodes[key] = end
            self.model.nodes[end] = self.model.nodes[node] + offset
            self.model.couplings.append(Coupling(node, [end], card.place, "offset"))
            self.findings.assume("offsets of beams are rigid arms", card.place)
        return self.offset_nodes[key]

    def _masses(self):
        for card in self._cards("CONM2"):
            self._unique(self.places, card, "element")
            if card.integer(3, default=0) not in (0,):
                refuse(card.place, "CONM2 in a system of coordinates of its own is not read")
            offset = tuple(card.real(i, default=0.0) for i in (5, 6, 7))
            I11, I21, I22, I31, I32, I33 = (card.real(i, default=0.0) for i in range(9, 15))
            inertia = numpy.array([I11, I22, I33, -I32, -I31, -I21]) * self.masses_by
            self.model.masses.append(
                PointMass(
                    self._node(card, 2),
                    card.real(4, default=0.0) * self.masses_by,
                    card.place,
                    tuple(inertia) if inertia.any() else None,
                    offset,
                )
            )

    def _couplings(self):
        for card in self._cards("RBE2"):
            followers = [card.text(i) for i in range(4, len(card.fields) + 1)]
            if followers and "." in (last := next((f for f in reversed(followers) if f), "")):
                card.fields[3 + len(followers) - 1 - followers[::-1].index(last)] = ""  # thermal expansion
            freedoms = set(card.text(3))
            if not freedoms >= set("123"):
                refuse(card.place, f"RBE2 that couples {card.text(3) or 'nothing'} is not read; 123 and 123456 are")
            if not freedoms >= set("123456"):
                self.findings.assume("RBE2 of translations only holds rotations, too", card.place)
            self._couple(self._node(card, 2), card.numbers(4), card, "rbe2")
        for card in self._cards("RBE3"):
            nodes = []
            words = [card.text(i) for i in range(5, len(card.fields) + 1)]
            for i, word in enumerate(words):
                if word.upper() in ("UM", "ALPHA"):
                    break
                # weights are reals; the number after a weight is what is coupled
                if re.fullmatch("[0-9]+", word) and not (i and "." in words[i - 1]):
                    nodes.append(int(word))
            self.findings.assume("RBE3 is a rigid coupling, which is stiffer", card.place)
            self._couple(self._node(card, 3), nodes, card, "rbe3")

    def _couple(self, reference, followers, card, name):
        for node in followers:
            self._find(self.model.nodes, node, card, "node")
        self.model.couplings.append(Coupling(reference, [n for n in followers if n != reference], card.place, name))

    # supports, loads and steps

    def _steps(self):
        solution, cases = self._case_control()
        if not cases:
            self.findings.leave_out("the file has no case that is read: the deck finds modes")
            self.model.steps.append(Step("modes", "modal", self.deck.cards[0].place))
            cases = [{}]
        else:
            self._add_steps(solution, cases)
        self._supports(cases)
        self._read_loads()
        for number, case in enumerate(cases):
            if "LOAD" in case and self.model.steps[number].kind != "modal":
                self._add_load_set(case["LOAD"], 1.0, number, set())
        used = {int(case["LOAD"]) for case in cases if "LOAD" in case}
        unused = {number for number, _ in self.loads} - self.reached - used
        for number in sorted(unused):
            self.findings.assume(f"the load set {number} is in no case")

    def _case_control(self):
        """The number of the solution, and the cases that are done, with what all have in common."""
        solution, common, cases = None, {}, []
        for place, text in self.deck.control:
            if found := re.match(r"SOL\s+(\w+)", text, re.I):
                solution = SOLUTIONS.get(found[1].upper(), found[1])
                if solution not in (STATIC, MODAL, BUCKLING, NONLINEAR):
                    self.findings.leave_out(f"SOL {found[1]}", place)
            elif found := re.match(r"SUBCASE\s+(\d+)", text, re.I):
                cases.append({**common, "NUMBER": found[1], "PLACE": place})
            elif found := re.match(r"(LOAD|SPC|METHOD|STATSUB|MPC|TEMPERATURE)(\(\w+\))?\s*=\s*(\d+)", text, re.I):
                (cases[-1] if cases else common)[found[1].upper()] = found[3]
                if found[1].upper() in ("MPC", "TEMPERATURE"):
                    self.findings.leave_out(found[1].upper(), place)
            elif found := re.match(r"TITLE\s*=\s*(.*)", text, re.I):
                self.model.title = found[1] or self.model.title
        if not cases and self.deck.control and common:
            cases = [{**common, "NUMBER": "1", "PLACE": self.deck.control[0][0]}]
        if solution not in (STATIC, MODAL, BUCKLING, NONLINEAR):
            return solution, []
        return solution, [case for case in cases if "LOAD" in case or "METHOD" in case or solution == MODAL]

    def _add_steps(self, solution, cases):
        for case in cases:
            name, place = f"case {case['NUMBER']}", case["PLACE"]
            if solution == MODAL or (solution == BUCKLING and "METHOD" in case):
                kind = "modal" if solution == MODAL else "buckling"
                self.model.steps.append(Step(name, kind, place, self._modes(case)))
                if kind == "buckling" and "LOAD" not in case:
                    before = [one for one in cases if "LOAD" in one and "METHOD" not in one]
                    chosen = [one for one in before if one["NUMBER"] == case.get("STATSUB", one["NUMBER"])]
                    if not chosen:
                        refuse(place, "buckling needs a static case before it")
                    case["LOAD"] = chosen[0]["LOAD"]
            else:
                self.model.steps.append(Step(name, "static", place, nonlinear=solution == NONLINEAR))
        if solution in (STATIC, BUCKLING) and any(step.kind == "static" for step in self.model.steps):
            self.findings.assume("linear static cases become nonlinear ones, which agree where displacements are small")

    def _modes(self, case):
        for name, field in (("EIGRL", 4), ("EIGR", 6), ("EIGB", 5)):
            for card in self.by_name[name]:
                if card.text(1) == case.get("METHOD"):
                    return min(max(card.integer(field, default=10), 1), 100000)
        return 10

    def _supports(self, cases):
        sets = {}
        for number, case in enumerate(cases):
            if "SPC" in case:
                for one in self._spc_sets(int(case["SPC"]), set()):
                    sets.setdefault(one, set()).add(number)
        if not any("SPC" in case for case in cases):
            everything = {card.integer(1) for name in ("SPC", "SPC1") for card in self.by_name[name]}
            if everything and not self.deck.control:
                self.findings.assume("without case control all SPC hold")
                sets = {one: None for one in everything}
        for node, (freedoms, card) in self.held.items():
            self._support([node], freedoms, 0.0, card, "grid", None)
        known = set()
        for card in self._cards("SPC1"):
            known.add(card.integer(1))
            if card.integer(1) in sets:
                nodes = card.numbers(3)
                if card.has_thru(3):
                    nodes = [node for node in nodes if node in self.model.nodes]
                for node in nodes:
                    self._find(self.model.nodes, node, card, "node")
                self._support(nodes, card.text(2), 0.0, card, f"spc {card.integer(1)}", sets[card.integer(1)])
        for card in self._cards("SPC"):
            known.add(card.integer(1))
            if card.integer(1) in sets:
                for i in (2, 5):
                    if card.text(i):
                        value = card.real(i + 2, default=0.0)
                        name = f"spc {card.integer(1)}"
                        self._support([self._node(card, i)], card.text(i + 1), value, card, name, sets[card.integer(1)])
        for one in set(sets) - known:
            refuse(self.deck.cards[0].place, f"there is no SPC or SPC1 of the set {one} that a case names")

    def _spc_sets(self, number, seen):
        if number in seen:
            refuse(self.deck.cards[0].place, f"SPCADD {number} contains itself")
        for card in self.by_name["SPCADD"]:
            if card.integer(1) == number:
                return [one for part in card.numbers(2) for one in self._spc_sets(part, seen | {number})]
        return [number]

    def _support(self, nodes, freedoms, value, card, name, steps):
        if not re.fullmatch("[1-6]+", freedoms):
            refuse(card.place, f"expected degrees of freedom, digits 1 to 6, found '{freedoms}'")
        held = {int(one): value for one in freedoms}
        self.model.supports += supports_along(self.axes, Support(list(nodes), held, card.place, name, steps))

    def _read_loads(self):
        """Load cards by the number of their set."""
        self.loads = []
        self.reached = set()
        for name in ("FORCE", "MOMENT", "PLOAD4", "PLOAD2", "PLOAD1", "GRAV"):
            for card in self._cards(name):
                self.loads.append((card.integer(1, "the number of a load set"), card))

    def _add_load_set(self, text, factor, step, seen):
        number = int(text)
        if number in seen:
            refuse(self.deck.cards[0].place, f"LOAD {number} contains itself")
        self.reached.add(number)
        cards = [card for one, card in self.loads if one == number]
        combined = [card for card in self.by_name["LOAD"] if card.integer(1) == number]
        if not cards and not combined:
            refuse(self.deck.cards[0].place, f"there is no load of the set {number} that a case names")
        for card in combined:
            overall = card.real(2, default=1.0)
            for i in range(3, len(card.fields), 2):
                if card.text(i):
                    part = str(card.integer(i + 1))
                    self._add_load_set(part, factor * overall * card.real(i), step, seen | {number})
        nodal = collections.defaultdict(lambda: numpy.zeros(6))
        places = {}
        for card in cards:
            if card.name in ("FORCE", "MOMENT"):
                node = self._node(card, 2)
                first = 0 if card.name == "FORCE" else 3
                nodal[node][first : first + 3] += factor * card.real(4) * self._vector(card, 3, 5)
                places.setdefault(node, card.place)
            else:
                self._add_element_load(card, factor, step)
        groups = collections.defaultdict(list)
        for node, vector in nodal.items():
            groups[tuple(vector)].append(node)
        for vector, nodes in groups.items():
            name = f"load {number}"
            self.model.node_loads.append(NodeLoad(nodes, numpy.array(vector), places[nodes[0]], name, {step}))

    def _add_element_load(self, card, factor, step):
        name = f"{card.name.lower()} {card.integer(1)}"
        if card.name == "GRAV":
            value = factor * card.real(3) * self._vector(card, 2, 4)
            self.model.element_loads.append(ElementLoad("gravity", [], value, card.place, name, {step}))
            return
        if card.name == "PLOAD1":
            self._add_line_load(card, factor, step, name)
            return
        if card.name == "PLOAD4":
            values = [card.real(3)] + [card.real(i) for i in (4, 5, 6) if card.text(i)]
            if max(values) != min(values):
                self.findings.assume("pressure that varies over an element is its mean", card.place)
            if any(card.real(i, default=0.0) for i in (10, 11, 12)):
                self.findings.leave_out("PLOAD4 with a direction", card.place)
                return
            value = sum(values) / len(values)
            thru = card.text(7).upper() == "THRU"
            elements = range(card.integer(2), card.integer(8) + 1) if thru else [card.integer(2)]
        else:
            thru, value, elements = card.has_thru(3), card.real(2), card.numbers(3)
        if not thru:
            for element in elements:
                self._find(self.places, element, card, "element")
        chosen = [self.places[e][1] for e in elements if self.places.get(e, ("",))[0] == "shell"]
        self.model.element_loads.append(ElementLoad("pressure", chosen, factor * value, card.place, name, {step}))

    def _add_line_load(self, card, factor, step, name):
        """A force per length that is the same all along an element."""
        kind, element = self._find(self.places, card.integer(2), card, "element")
        direction, scale = card.text(3).upper(), card.text(4).upper()
        first, last = card.real(5, default=0.0), card.real(7, default=-1.0)
        if kind != "beam" or direction not in LINE_LOADS or scale not in ("LE", "FR"):
            self.findings.leave_out(f"PLOAD1 of {direction or 'no direction'}, {scale or 'no scale'}", card.place)
            return
        beam = self.model.beams[element]
        axis = self.model.nodes[beam.nodes[1]] - self.model.nodes[beam.nodes[0]]
        length = float(numpy.linalg.norm(axis))
        values = (card.real(6), card.real(8, default=card.real(6)))
        whole = 1.0 if scale == "FR" else length
        if first != 0.0 or abs(last - whole) > 1e-6 * whole or values[0] != values[1]:
            self.findings.leave_out("PLOAD1 on a part of an element, at a point of it, or that varies", card.place)
            return
        x = axis / length
        z = numpy.cross(x, beam.up)
        z = z / (numpy.linalg.norm(z) or 1.0)
        of_element = numpy.array([x, numpy.cross(z, x), z])
        axes = of_element if direction.endswith("E") else numpy.eye(3)
        force = factor * values[0] * axes["XYZ".index(direction[1])]
        self.model.element_loads.append(ElementLoad("line", [element], force, card.place, name, {step}))


LINE_LOADS = ("FX", "FY", "FZ", "FXE", "FYE", "FZE")
# Fields that say nothing about the mechanics: names, points for stresses, temperatures, strengths.
HARMLESS = {
    "GRID": (8,),
    "MAT1": range(6, 13),
    "MAT8": range(9, 20),
    "PBAR": range(9, 17),
    "PBARL": (3,),
    "PBEAML": (3,),
    "PBEAM": range(9, 17),
    "PSHELL": (9, 10),
    "PCOMP": (4, 5, 6, 7, *range(12, 1000, 4)),
}
READ = {
    "GRID", "MAT1", "MAT8", "PSHELL", "PCOMP", "PBAR", "PBARL", "PBEAML", "PBEAM", "CBAR", "CBEAM", "CONM2", "RBE2", "RBE3",
    "SPC", "SPC1", "FORCE", "MOMENT", "PLOAD4", "PLOAD2", "PLOAD1", "GRAV", *SHELLS,
}  # fmt: skip
