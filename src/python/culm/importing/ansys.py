"""Models of ANSYS, archives of CDWRITE (.cdb): shells, beams, point masses, supports and loads."""

import collections

import numpy

from .ansys_file import read_commands, whole
from .findings import did_you_mean, refuse
from .keyword_file import is_integer, number
from .model import (
    BeamElement,
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
    supports_along,
)
from .profiles import i_section

FILE = "archive, .cdb"

SHELLS = {181: 4, 281: 8, 63: 4, 43: 4, 93: 8}
BEAMS = {188: 2, 189: 3, 4: 2}
MASS = 21
# do nothing by themselves, or act on surfaces and contacts
LEFT_OUT = {154: "surface elements", **{i: "contact elements" for i in range(169, 178)}, 200: "elements of a mesh alone"}
FREEDOMS = {"UX": [1], "UY": [2], "UZ": [3], "ROTX": [4], "ROTY": [5], "ROTZ": [6], "ALL": [1, 2, 3, 4, 5, 6]}
FORCES = {"FX": 0, "FY": 1, "FZ": 2, "MX": 3, "MY": 4, "MZ": 5}
# What says nothing about the model: output, numbers of the solution, names, views, parameters.
SILENT = {
    "*DIM", "*ELSE", "*ENDIF", "*GET", "*IF", "*PREAD", "*SET", "END PREAD", "/BATCH", "/COM", "/CONFIG", "/EOF", "/GO", "/GOLIST",
    "/GOPR", "/GST", "/NOLIST", "/NOPR", "/POST1", "/PREP7", "/SOLU", "/UNITS", "/WB", "/XML", "/NERR", "/VIEW", "/ANG", "/CLEAR",
    "AUTOTS", "CDWRITE", "CEWRITE", "CM", "CNTR", "CNVTOL", "CSYS", "DMPOPT", "DMPOPTION", "DOF", "EMUNIT", "EQSL", "EQSLV", "ERESX",
    "ETCON", "EXTOPT", "FINI", "FINISH", "IRLF", "KBC", "KUSE", "LUMPM", "MAT", "MODCONTROL", "MPTEMP", "MXPAND", "NCNV", "NEQIT",
    "NLDIAG", "NSUB", "NSUBST", "NUMOFF", "OUTRES", "PSTRES", "QRDOPT", "REAL", "RESCONTROL", "SECNUM", "SHPP", "STEF",
    "TBDATA", "TBTEMP", "THOPT", "TIME", "TIMINT", "TINTP", "TOFFST", "TREF", "TSHAPE", "TYPE", "XMLO", "BFUNIF", "MPDELE", "TBDELE",
    "SECFUNCTION", "RESUME", "SAVE", "ESYS", "LSCLEAR", "PRED", "ARCLEN", "MPAMOD", "CHECK", "WAVES", "NLIST",
    "CRPLIM", "TRNOPT", "RATE", "UIMP", "BUCOPT",
}  # fmt: skip
# What does nothing with zeros.
ZERO = {
    "OMEGA", "DOMEGA", "CGLOC", "CGOMEGA", "CGOMG", "DCGOMG", "ALPHAD", "BETAD", "DMPRAT", "DMPSTR", "SECCONTROL", "SECCONTROLS",
    "STABILIZE",
}  # fmt: skip
TABLES = {"BISO", "MISO", "BKIN", "KINH", "MKIN", "NLISO", "CHAB", "HYPE", "ANEL", "PLAS", "CREE", "PRON", "VISC", "AHYPER"}
KINDS = {"0": "static", "STATIC": "static", "STAT": "static", "1": "buckling", "BUCKLE": "buckling", "2": "modal", "MODAL": "modal"}

# Commands whose values are told if they are not read.
BY_VALUE = {"MP", "ET", "SECOFFSET", "SECOFF", "ANTYPE"}


def read(path, arguments):
    """@return the Model of an archive"""
    del arguments
    return Reader(path).read()


class Reader:
    def __init__(self, path):
        self.path = path
        self.model = Model(title=path.stem)
        self.findings = self.model.findings
        self.commands, is_closed = read_commands(path)
        if not is_closed:
            self.findings.assume("the file has no FINISH: it is taken as whole")
            self.findings.look_at_end(path)
        self.types, self.keys = {}, {}
        self.constants = {}
        self.materials = collections.defaultdict(dict)
        self.material_places = {}
        self.sections = {}
        self.systems = {0: numpy.eye(3)}
        self.curved = set()  # systems that are not Cartesian
        self.axes = {}  # rows of the systems of nodes that are turned
        self.current = None  # the section that SECDATA adds to
        self.components = {}  # name -> nodes or elements
        self.selected = None  # nodes that ALL means; None for all
        self.beam_places = {}  # number of a beam element -> its place in the model
        self.elements = []  # [number, material, type, real, section, system, nodes, place]
        self.supports = collections.defaultdict(dict)
        self.forces = collections.defaultdict(lambda: numpy.zeros(6))
        self.places = {}
        self.pressures = {}  # (element, face) -> the command that stands
        self.gravity = numpy.zeros(3)
        self.kind, self.modes, self.nonlinear = None, 10, False
        self.solutions = 0  # SOLVE, or LSWRITE
        self.kind_place = self.commands[0].place if self.commands else None

    def read(self):
        actions = {
            "NBLOCK": self._nodes, "N": self._node, "EBLOCK": self._elements, "ET": self._type, "ETBLOCK": self._type_block,
            "KEYOPT": self._key, "KEYOP": self._key, "KEYO": self._key, "R": self._real, "RLBLOCK": self._reals, "MP": self._property,
            "MPDATA": self._property_data, "SECTYPE": self._section_type, "SECDATA": self._section_data,
            "SECBLOCK": self._section_block, "SECOFFSET": self._section_offset, "SECOFF": self._section_offset,
            "LOCAL": self._local, "D": self._support, "F": self._force, "SFE": self._pressure, "ACEL": self._gravity,
            "ANTYPE": self._analysis, "NLGEOM": self._large, "MODOPT": self._count, "BUCOPT": self._count,
            "/TITLE": self._title, "TB": self._table, "CMBLOCK": self._component, "CMSEL": self._select,
            "SOLVE": self._solve, "LSWRITE": self._solve,
            "NSEL": self._select_nodes, "ALLSEL": self._select_nodes, "EMOD": self._modify, "EMODIF": self._modify,
        }  # fmt: skip
        for command in self.commands:
            if command.name in actions:
                actions[command.name](command)
                self._tell_unread(command)
            elif not self._is_silent(command):
                self.findings.leave_out(f"the command {command.name[:20]}", command.place)
        self._make_materials()
        self._make_elements()
        self._make_loads()
        return self.model

    def _tell_unread(self, command):
        """Values that nobody asked for, of commands that are read value by value."""
        if command.name in BY_VALUE:
            for i in command.unread():
                if command.text(i).strip("0.+-"):
                    self.findings.leave_out(f"field {i} of {command.name}", command.place)

    def _solve(self, command):
        self.solutions += 1
        if self.solutions == 2:
            self.findings.leave_out("load steps before the last one: one analysis is read, with what acts at the end", command.place)

    def _is_silent(self, command):
        """Whether a command says nothing about the model, or nothing but zeros."""
        if command.name in ZERO or command.name == "ESEL":
            return not any(cell.strip("0.+- ") for cell in command.fields if cell.upper() not in ("ALL", "NONE"))
        return command.name in SILENT or "=" in command.name

    # blocks and commands

    def _nodes(self, command):
        # coordinates follow three numbers, or one where NBLOCK has three fields, and angles of the system of the node follow them
        first = 1 if command.text(1) == "3" else 3
        for place, cells in command.rows:
            self._add_node(whole(cells[0], place, "the number of a node"), cells[first:], place)

    def _node(self, command):
        if command.text(1).upper().startswith("R"):
            return  # the end of a block
        self._add_node(command.integer(1), [command.text(i) for i in range(2, 8)], command.place)

    def _add_node(self, number_, cells, place):
        values = [number(cell, place, "a coordinate") if cell else 0.0 for cell in cells[:6]]
        if number_ in self.model.nodes:
            refuse(place, f"node {number_} is there twice")
        self.model.nodes[number_] = numpy.array([*values, 0.0, 0.0, 0.0][:3])
        if any(values[3:]):
            self.axes[number_] = self._turned([*values[3:], 0.0, 0.0][:3])
        self.findings.count("nodes")

    def _elements(self, command):
        if command.text(2).upper() != "SOLID":
            self.findings.leave_out("EBLOCK without SOLID", command.place)
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
            self.elements.append([values[10], values[0], values[1], values[2], values[3], values[4], nodes[:count], place])

    def _type(self, command):
        text = command.text(2).upper()
        digits = "".join(c for c in text if c in "0123456789")
        self.types[command.integer(1)] = whole(digits, command.place, "the type of elements")
        for i in range(3, 9):
            if is_integer(command.text(i)):
                self.keys[(command.integer(1), i - 2)] = command.integer(i)

    def _type_block(self, command):
        for place, cells in command.rows:
            if len(cells) < 2:
                refuse(place, "expected number and type of elements")
            self.types[whole(cells[0], place, "a number")] = whole(cells[1], place, "the type of elements")

    def _key(self, command):
        if is_integer(command.text(1)) and is_integer(command.text(3)):
            self.keys[(command.integer(1), command.integer(2))] = command.integer(3)

    def _real(self, command):
        self.constants[command.integer(1)] = [command.real(i, default=0.0) for i in range(2, len(command.fields) + 1)]

    def _reals(self, command):
        for place, cells in command.rows:
            self.constants[whole(cells[0], place, "a number")] = [number(cell, place) for cell in cells[2:] if cell]

    def _property(self, command):
        self._add_property(command.text(1), command.integer(2), command.real(3), command)

    def _property_data(self, command):
        """MPDATA,R5.0,count,label,material,place,value"""
        first = 1 if command.text(1).upper().startswith("R") else 0
        if command.integer(first + 1) > 1 or command.integer(first + 4) > 1:
            self.findings.assume("of properties by temperature the first stand", command.place)
        if command.integer(first + 4) == 1:
            self._add_property(command.text(first + 2), command.integer(first + 3), command.real(first + 5), command)

    def _add_property(self, label, material, value, command):
        self.materials[material][label.upper()] = value
        self.material_places.setdefault(material, command.place)

    def _table(self, command):
        if command.text(1).upper()[:4] in TABLES:
            self.findings.leave_out(f"TB,{command.text(1).upper()}: materials are linear", command.place)

    def _section_type(self, command):
        self.current = command.integer(1)
        self.sections[self.current] = (command.text(2).upper(), command.text(3).upper(), [], command.place)

    def _section_data(self, command):
        if self.current is None:
            refuse(command.place, "SECDATA without SECTYPE before it")
        self.sections[self.current][2].append((command.place, command.fields))

    def _section_block(self, command):
        if self.current is None:
            refuse(command.place, "SECBLOCK without SECTYPE before it")
        self.sections[self.current][2].extend(command.rows)

    def _section_offset(self, command):
        if command.text(1).upper() not in ("MID", "CENT", "ORIG", ""):
            self.findings.leave_out(f"SECOFFSET,{command.text(1).upper()}: the nodes are in the middle", command.place)

    def _local(self, command):
        """LOCAL,R5.0,LOC,number,kind,x,y,z and LOCAL,R5.0,ANG,number,angles; or all in one line."""
        fields = [cell.upper() for cell in command.fields]
        if fields and fields[0].startswith("R"):
            if len(fields) > 1 and fields[1] == "ANG":
                self.systems[command.integer(3)] = self._turned([command.real(i, default=0.0) for i in (4, 5, 6)])
            elif len(fields) > 3 and fields[3].strip("0"):
                self.curved.add(command.integer(3))
        else:
            self.systems[command.integer(1)] = self._turned([command.real(i, default=0.0) for i in (6, 7, 8)])
            if command.text(2).strip("0"):
                self.curved.add(command.integer(1))

    def _turned(self, degrees):
        """Rows of axes, turned about z, then the new x, then the new y."""
        about_z, about_x, about_y = numpy.radians(degrees)
        c, s = numpy.cos, numpy.sin
        z = numpy.array([[c(about_z), s(about_z), 0], [-s(about_z), c(about_z), 0], [0, 0, 1]])
        x = numpy.array([[1, 0, 0], [0, c(about_x), s(about_x)], [0, -s(about_x), c(about_x)]])
        y = numpy.array([[c(about_y), 0, -s(about_y)], [0, 1, 0], [s(about_y), 0, c(about_y)]])
        return y @ x @ z

    def _component(self, command):
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
        self.components[command.text(1).upper()] = (command.text(2).upper(), members)

    def _select(self, command):
        if command.text(1).upper() == "ALL":
            self.selected = None
        elif command.text(1).upper() == "S":
            kind, members = self._named(command, command.text(2))
            self.selected = members if kind.startswith("NODE") else self.selected
        else:
            refuse(command.place, f"CMSEL,{command.text(1)} is not read; CMSEL,S is")

    def _select_nodes(self, command):
        if command.name == "NSEL" and command.text(1).upper() not in ("ALL", ""):
            refuse(command.place, f"NSEL,{command.text(1)} is not read: nodes are selected by components")
        self.selected = None

    def _named(self, command, name):
        if name.upper() not in self.components:
            refuse(command.place, f"there is no component '{name}'{did_you_mean(name.upper(), self.components)}")
        return self.components[name.upper()]

    def _modify(self, command):
        """Gives elements another material, type, constants, section or system."""
        at = {"MAT": 1, "TYPE": 2, "REAL": 3, "SECN": 4, "ESYS": 5}.get(command.text(2).upper()[:4])
        if at is None:
            refuse(command.place, f"EMODIF of {command.text(2)} is not read")
        name = command.text(1)
        chosen = {int(name)} if is_integer(name) else set(self._named(command, name)[1])
        for element in self.elements:
            if element[0] in chosen:
                element[at] = command.integer(3)

    def _nodes_of(self, command):
        """A number, ALL that are selected, or a component."""
        name = command.text(1)
        if is_integer(name):
            nodes = [int(name)]
        elif name.upper() == "ALL":
            nodes = list(self.model.nodes) if self.selected is None else self.selected
        else:
            nodes = self._named(command, name)[1]
        for node in nodes:
            if node not in self.model.nodes:
                refuse(command.place, f"there is no node {node}")
            self.places.setdefault((command.name, node), command.place)
        return nodes

    def _refuse_ranges(self, command):
        """D and F: node, label, value, imaginary value; no nodes from here to there."""
        command.real(4, default=0.0)
        if any(command.text(i) for i in range(5, len(command.fields) + 1)):
            refuse(command.place, f"{command.name} with '{','.join(command.fields[4:])[:40]}': one label and no ranges are read")

    def _support(self, command):
        self._refuse_ranges(command)
        label = command.text(2).upper()
        if label not in FREEDOMS:
            self.findings.leave_out(f"D of {label}", command.place)
            return
        for node in self._nodes_of(command):
            for freedom in FREEDOMS[label]:
                self.supports[node][freedom] = command.real(3, default=0.0)
        self.findings.count("lines of supports")

    def _force(self, command):
        self._refuse_ranges(command)
        label = command.text(2).upper()
        if label not in FORCES:
            self.findings.leave_out(f"F of {label}", command.place)
            return
        for node in self._nodes_of(command):
            self.forces[node][FORCES[label]] = command.real(3, default=0.0)
        self.findings.count("lines of forces")

    def _pressure(self, command):
        if command.text(3).upper() != "PRES" or command.text(4) not in ("0", "", "1"):
            self.findings.leave_out(f"SFE of {command.text(3)}", command.place)
            return
        self.pressures[(command.integer(1), command.integer(2))] = command
        self.findings.count("lines of pressure")

    def _gravity(self, command):
        """ACEL is the acceleration of the ground, against which masses weigh."""
        self.gravity = -numpy.array([command.real(i, default=0.0) for i in (1, 2, 3)])
        self.gravity_place = command.place

    def _analysis(self, command):
        kind = command.text(1).upper()
        if kind not in KINDS:
            self.findings.leave_out(f"ANTYPE,{kind}", command.place)
        elif self.kind not in (None, KINDS[kind]):
            self.findings.leave_out(f"the {self.kind} analysis before: one is read, the last", self.kind_place)
        self.kind, self.kind_place = KINDS.get(kind), command.place

    def _large(self, command):
        self.nonlinear = command.text(1).upper() in ("ON", "1")

    def _count(self, command):
        if command.text(2):
            self.modes = min(max(command.integer(2, "the number of modes"), 1), 100000)

    def _title(self, command):
        self.model.title = ",".join(command.fields).strip() or self.model.title

    # the model

    def _make_materials(self):
        for material, values in self.materials.items():
            if "EX" not in values:
                continue
            place = self.material_places[material]
            density = values.get("DENS", 0.0)
            name = f"material {material}"
            if "EY" not in values:
                nu = values.get("PRXY", values.get("NUXY", 0.3))
                if "PRXY" not in values and "NUXY" not in values:
                    self.findings.assume("a material without Poisson's ratio has 0.3", place)
                self.model.materials[name] = Material(
                    "Isotropic", {"Young Modulus": values["EX"], "Poisson Ratio": nu, "Density": density}, place
                )
                continue
            self.model.materials[name] = Material("Orthotropic", self._orthotropic(values, density, place), place)

    def _orthotropic(self, values, density, place):
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
                self.findings.assume(f"an orthotropic material without PR{axes} has 0.3", place)
        for label in ("GXY", "GXZ", "GYZ"):
            if label not in values:
                refuse(place, f"an orthotropic material needs {label}")
        names = ("E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23", "Density")
        return dict(zip(names, (*E, *ratios, values["GXY"], values["GXZ"], values["GYZ"], density)))

    def _make_elements(self):
        seen = {}
        for number_, material, type, real, section, system, nodes, place in self.elements:
            if type not in self.types:
                refuse(place, f"there is no element type {type}{did_you_mean(type, self.types)}")
            kind = self.types[type]
            if kind in LEFT_OUT:
                self.findings.leave_out(LEFT_OUT[kind], place)
                continue
            for node in nodes:
                if node and node not in self.model.nodes:
                    refuse(place, f"there is no node {node}")
            if number_ in seen:
                refuse(place, f"element {number_} is there twice")
            least = SHELLS.get(kind) or BEAMS.get(kind) or 1
            if len(nodes) < least or 0 in nodes[:least]:
                refuse(place, f"element {number_} of type {kind} has fewer than {least} nodes")
            if kind in SHELLS:
                if self.keys.get((type, 1), 0) not in (0, 2) and kind in (181, 281):
                    refuse(place, f"elements SHELL{kind} with KEYOPT(1) = {self.keys[(type, 1)]} have no bending or no membrane")
                if self.keys.get((type, 1), 0) != 0 and kind == 63:
                    refuse(place, f"elements SHELL63 with KEYOPT(1) = {self.keys[(type, 1)]} have no bending or no membrane")
                seen[number_] = len(self.model.shells)
                wall = self._wall(kind, material, real, section, place)
                axis = self._axis(nodes, system, place)
                self.model.shells.append(ShellElement(number_, tuple(nodes[: SHELLS[kind]]), wall, place, axis))
            elif kind in BEAMS:
                seen[number_] = None
                self._beam(number_, kind, material, real, section, nodes, place)
            elif kind == MASS:
                seen[number_] = None
                self._point_mass(nodes[0], real, self.keys.get((type, 3), 0), place)
            else:
                refuse(place, f"elements of type {kind} have no counterpart in culm: it has shells, beams, point masses")
            self.findings.count(f"elements of type {kind}")
        self.numbers = seen
        if not self.model.shells and not self.model.beams:
            refuse(self.kind_place or self.path, "the file has no shells and no beams")

    def _axis(self, nodes, system, place):
        """Axis 1: x of the system of the element, or from side to side."""
        if system:
            if system in self.curved:
                refuse(place, f"directions in the system {system}, which is not Cartesian, are not read")
            if system not in self.systems:
                refuse(place, f"there is no system of coordinates {system}")
            return tuple(self.systems[system][0])
        p = [self.model.nodes[node] for node in nodes[:4]]
        return tuple(p[1] + p[2] - p[0] - p[3])

    def _material(self, number_, place):
        name = f"material {number_}"
        if name not in self.model.materials:
            refuse(place, f"there is no material {number_} with EX")
        return name

    def _wall(self, kind, material, real, section, place):
        if section in self.sections and self.sections[section][0] == "SHELL":
            name = f"section {section}" if self._has_materials(section) else f"section {section} material {material}"
            if name not in self.model.walls:
                _, _, rows, where = self.sections[section]
                layers = [self._layer(at, cells, material) for at, cells in rows if any(cells)]
                if not layers:
                    refuse(where, f"section {section} has no layers")
                self.model.walls[name] = Wall(layers, where)
            return name
        if real not in self.constants or not self.constants[real]:
            refuse(place, f"neither section {section} nor constants {real} give this shell a thickness")
        name = f"real {real} material {material}"
        values = self.constants[real]
        if any(value not in (0.0, values[0]) for value in values[1:4]):
            self.findings.assume("a thickness that varies over an element is that of its first node", place)
        if values[0] <= 0.0:
            refuse(place, f"a thickness must be > 0, got {values[0]:g}")
        self.model.walls.setdefault(name, Wall([Layer(values[0], self._material(material, place))], place))
        return name

    def _has_materials(self, section):
        return all(len(cells) > 1 and cells[1].strip() for _, cells in self.sections[section][2])

    def _layer(self, place, cells, material):
        cells = [cell.strip() for cell in cells]
        thickness = number(cells[0], place, "a thickness")
        if thickness <= 0.0:
            refuse(place, f"a thickness must be > 0, got {thickness:g}")
        own = whole(cells[1], place, "a material") if len(cells) > 1 and cells[1] else material
        angle = number(cells[2], place, "an angle") if len(cells) > 2 and cells[2] else 0.0
        return Layer(thickness, self._material(own, place), angle)

    def _beam(self, number_, kind, material, real, section, nodes, place):
        """Axes y, z of the section are d1, d2; the third node lies in the plane of x and z."""
        size = BEAMS[kind]
        start, end = (self.model.nodes[node] for node in nodes[:2])
        x = end - start
        if numpy.linalg.norm(x) == 0.0:
            refuse(place, f"beam element {number_} has no length")
        if len(nodes) > size and nodes[size]:
            up = numpy.cross(self.model.nodes[nodes[size]] - start, x)
        else:
            up = numpy.cross([0.0, 0.0, 1.0], x)
            if numpy.linalg.norm(up) <= 1e-4 * numpy.linalg.norm(x):
                up = numpy.array([0.0, 1.0, 0.0])
        up = tuple(numpy.round(up / (numpy.linalg.norm(up) or 1.0), 12))
        name = self._profile(kind, material, real, section, place)
        self.beam_places[number_] = len(self.model.beams)
        self.model.beams.append(BeamElement(number_, tuple(nodes[:size]), name, up, place))

    def _profile(self, kind, material, real, section, place):
        name = f"section {section} material {material}" if kind != 4 else f"real {real} material {material}"
        if name in self.model.sections:
            return name
        solid = self.model.materials[self._material(material, place)]
        if solid.type != "Isotropic":
            refuse(place, "beams need an isotropic material")
        if kind == 4:
            type, values, mass = self._by_constants(real, solid.values, place)
        else:
            if section not in self.sections or self.sections[section][0] != "BEAM":
                refuse(place, f"there is no beam section {section}")
            type, values, mass = self._by_section(section, solid.values)
        self.model.sections[name] = Section(type, values, mass, place)
        return name

    def _by_constants(self, real, solid, place):
        """BEAM4: area, Izz, Iyy, thickness along z and y, angle, strain, torsion."""
        values = [*self.constants.get(real, []), *[0.0] * 8]
        A, Izz, Iyy, angle, J = values[0], values[1], values[2], values[5], values[7]
        if angle:
            refuse(place, "BEAM4 with THETA is not read")
        return self._values(A, Iyy, Izz, 0.0, J or Iyy + Izz, solid, place)

    def _values(self, A, Iyy, Izz, Iyz, J, solid, place):
        if min(A, Iyy, Izz, J) <= 0.0:
            refuse(place, "a beam needs area, inertias and torsion > 0")
        E, density = solid["Young Modulus"], solid["Density"]
        G = E / (2.0 * (1.0 + solid["Poisson Ratio"]))
        self.findings.assume("sections by values have shear areas of 5/6 of the area", place)
        values = {
            "EA": E * A, "GA1": G * A * 5 / 6, "GA2": G * A * 5 / 6, "EI1": E * Iyy, "EI2": E * Izz, "GIp": G * J, "EI12": E * Iyz,
            "rhoA": density * A, "rhoI1": density * Iyy, "rhoI2": density * Izz, "rhoI12": density * Iyz,
        }  # fmt: skip
        return "Stiffness Values", values, density * A

    def _by_section(self, section, solid):
        _, shape, rows, place = self.sections[section]
        needed = {"RECT": 2, "CSOLID": 1, "CTUBE": 2, "HREC": 6, "I": 6, "ASEC": 6}
        if shape not in needed:
            refuse(place, f"beam sections of shape {shape or 'none'} are not read; {', '.join(needed)} are")
        cells = [(at, cell.strip()) for at, row in rows for cell in row if cell.strip()]
        if len(cells) < needed[shape]:
            refuse(place, f"a section of shape {shape} needs {needed[shape]} dimensions")
        sizes = [number(cell, at, "a dimension") for at, cell in cells]
        if shape == "ASEC":
            A, Iyy, Iyz, Izz, _, J = sizes[:6]
            return self._values(A, Iyy, Izz, Iyz, J, solid, place)
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

    def _point_mass(self, node, real, key, place):
        values = [*self.constants.get(real, []), *[0.0] * 6]
        if key == 2:
            inertia = None
        else:
            inertia = (values[3], values[4], values[5], 0.0, 0.0, 0.0)
            if key == 0 and not (values[0] == values[1] == values[2] or values[1] == values[2] == 0.0):
                self.findings.assume("a point mass is the same in all directions: that along x", place)
        if values[0] <= 0.0:
            refuse(place, f"the constants {real} give no mass")
        self.model.masses.append(PointMass(node, values[0], place, inertia if inertia and any(inertia) else None))

    def _make_loads(self):
        groups = collections.defaultdict(list)
        for node, held in self.supports.items():
            groups[tuple(sorted(held.items()))].append(node)
        for held, nodes in groups.items():
            self.model.supports += supports_along(self.axes, Support(nodes, dict(held), self.places[("D", nodes[0])], "support"))
        name = self.kind or "modal"
        if self.kind is None:
            self.findings.leave_out("the file has no ANTYPE that is read: the deck finds modes")
        self.model.steps.append(Step(name, name, self.kind_place, self.modes, self.nonlinear))
        if name == "static" and not self.nonlinear:
            self.findings.assume("a linear static step becomes a nonlinear one, which agrees where displacements are small")
        if name == "modal":
            if self.forces or self.pressures or self.gravity.any():
                self.findings.leave_out("loads: modes are those of the unloaded structure")
            return
        by_force = collections.defaultdict(list)
        for node, vector in self.forces.items():
            if node in self.axes:
                vector = numpy.concatenate([vector[:3] @ self.axes[node], vector[3:] @ self.axes[node]])
            if vector.any():
                by_force[tuple(vector)].append(node)
        for vector, nodes in by_force.items():
            self.model.node_loads.append(NodeLoad(nodes, numpy.array(vector), self.places[("F", nodes[0])], "force", {0}))
        self._make_pressures()
        if self.gravity.any():
            self.model.element_loads.append(ElementLoad("gravity", [], self.gravity, self.gravity_place, "gravity", {0}))

    def _make_pressures(self):
        """On face 1, the lower one, pressure is along the normal; on face 2 against it."""
        groups = collections.defaultdict(list)
        places = {}
        for (element, face), command in self.pressures.items():
            if element not in self.numbers:
                refuse(command.place, f"there is no element {element}")
            values = [command.real(i) for i in range(5, len(command.fields) + 1) if command.text(i)]
            if element in self.beam_places and values:
                self._add_line_load(self.beam_places[element], face, values, command)
                continue
            if face not in (1, 2) or self.numbers[element] is None or not values:
                self.findings.leave_out("SFE on edges", command.place)
                continue
            if any(value not in (0.0, values[0]) for value in values[1:]):
                self.findings.assume("pressure that varies over an element is that of its first node", command.place)
            value = values[0] if face == 1 else -values[0]
            groups[value].append(self.numbers[element])
            places.setdefault(value, command.place)
        for value, elements in groups.items():
            self.model.element_loads.append(ElementLoad("pressure", elements, value, places[value], "pressure", {0}))

    def _add_line_load(self, beam, face, values, command):
        """Force per length: face 1 pushes against z of the section, face 2 against y, face 3 along the axis."""
        if face not in (1, 2, 3) or any(value != values[0] for value in values[1:]) or len(values) > 2:
            self.findings.leave_out("SFE on beams that varies, or on their ends", command.place)
            return
        element = self.model.beams[beam]
        x = self.model.nodes[element.nodes[1]] - self.model.nodes[element.nodes[0]]
        x = x / numpy.linalg.norm(x)
        z = numpy.cross(x, element.up) / numpy.linalg.norm(numpy.cross(x, element.up))
        force = values[0] * {1: -z, 2: -numpy.cross(z, x), 3: x}[face]
        self.model.element_loads.append(ElementLoad("line", [beam], force, command.place, "line load", {0}))
