"""Sums of forces and moments about the origin, by step, from the numbers of input files of Abaqus, CalculiX, Nastran and
ANSYS: readers of their own, which know what these sums need and refuse the rest."""

import collections
import pathlib
import re

import numpy

GAUSS = [(-(0.6**0.5), 5 / 9), (0.0, 8 / 9), (0.6**0.5, 5 / 9)]
TRIANGLE = [(1 / 6, 1 / 6, 1 / 6), (2 / 3, 1 / 6, 1 / 6), (1 / 6, 2 / 3, 1 / 6)]


class NotCounted(Exception):
    """What these readers do not know."""


def shapes(count, x, y):
    """Values and slopes of shape functions of elements with 3, 4, 6, 8 nodes, corners first: (count, 3)."""
    if count in (3, 6):
        a = numpy.array([[1 - x - y, -1, -1], [x, 1, 0], [y, 0, 1]], float)
        if count == 3:
            return a
        edges = [4 * numpy.array([a[i, 0] * a[j, 0], *(a[i, 1:] * a[j, 0] + a[i, 0] * a[j, 1:])]) for i, j in ((0, 1), (1, 2), (2, 0))]
        corners = [numpy.array([a[i, 0] * (2 * a[i, 0] - 1), *(a[i, 1:] * (4 * a[i, 0] - 1))]) for i in range(3)]
        return numpy.array(corners + edges)
    found = []
    for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        u, v = 1 + i * x, 1 + j * y
        if count == 4:
            found.append([u * v / 4, i * v / 4, j * u / 4])
        else:
            w = i * x + j * y - 1
            found.append([u * v * w / 4, i * v * (w + u) / 4, j * u * (w + v) / 4])
    if count == 4:
        return numpy.array(found)
    for i, j in ((0, -1), (1, 0), (0, 1), (-1, 0)):
        if i == 0:
            found.append([(1 - x * x) * (1 + j * y) / 2, -x * (1 + j * y), j * (1 - x * x) / 2])
        else:
            found.append([(1 + i * x) * (1 - y * y) / 2, i * (1 - y * y) / 2, -y * (1 + i * x)])
    return numpy.array(found)


def surface_points(corners):
    """(place, area times normal) of points whose sum is the integral over a shell element."""
    rule = TRIANGLE if len(corners) in (3, 6) else [(x, y, a * b) for x, a in GAUSS for y, b in GAUSS]
    for x, y, weight in rule:
        N = shapes(len(corners), x, y)
        yield N[:, 0] @ corners, numpy.cross(N[:, 1] @ corners, N[:, 2] @ corners) * weight


def line_points(nodes):
    """(place, length) of points along a beam element; of three nodes the one between is the second."""
    for x, weight in GAUSS:
        if len(nodes) == 2:
            yield nodes[0] * (1 - x) / 2 + nodes[1] * (1 + x) / 2, numpy.linalg.norm(nodes[1] - nodes[0]) / 2 * weight
        else:
            a, b, c = nodes
            along = a * (x - 0.5) - 2 * x * b + c * (x + 0.5)
            yield a * x * (x - 1) / 2 + b * (1 - x * x) + c * x * (x + 1) / 2, numpy.linalg.norm(along) * weight


class Sum:
    def __init__(self):
        self.force, self.moment = numpy.zeros(3), numpy.zeros(3)

    def add(self, place, force, moment=(0, 0, 0)):
        self.force += force
        self.moment += numpy.cross(place, force) + numpy.array(moment)

    def press(self, corners, pressure):
        """Along the normal. @param pressure  or those at the corners, of which the mean acts all over"""
        count = 3 if len(corners) in (3, 6) else 4
        for place, area in surface_points(corners):
            self.add(place, numpy.mean(pressure[:count] if numpy.ndim(pressure) else pressure) * area)

    def pull(self, corners, per_area):
        for place, area in surface_points(corners):
            self.add(place, per_area * numpy.linalg.norm(area))

    def pull_line(self, nodes, per_length):
        for place, length in line_points(nodes):
            self.add(place, per_length * length)

    @property
    def vector(self):
        return numpy.concatenate([self.force, self.moment])


# Abaqus and CalculiX


def blocks_of(path):
    """(keyword, parameters, rows of cells), what is included as well."""
    found, waiting = [], ""
    for line in pathlib.Path(path).read_text(errors="replace").splitlines():
        line = line.strip()
        if not line or line.startswith("**"):
            continue
        line, waiting = waiting + line, ""
        if line.startswith("*") and line.endswith(","):
            waiting = line
        elif line.startswith("*"):
            words = [word.strip() for word in line[1:].split(",")]
            options = dict([part.strip().upper().strip('"') for part in word.partition("=")[::2]] for word in words[1:] if word)
            if words[0].upper() == "INCLUDE":
                found += blocks_of(pathlib.Path(path).parent / line.partition("=")[2].strip().strip('"'))
            else:
                found.append((words[0].upper(), options, []))
        else:
            found[-1][2].append([cell.strip().strip('"').upper() for cell in line.split(",")])
    return found


def real(cell):
    return float(cell.replace("D", "E")) if cell else 0.0


BOX_AREA = {"RECT": lambda s: s[0] * s[1], "PIPE": lambda s: numpy.pi * (s[0] ** 2 - (s[0] - s[1]) ** 2),
            "BOX": lambda s: s[0] * s[1] - (s[0] - 2 * s[2]) * (s[1] - 2 * s[3])}  # fmt: skip


class AbaqusFile:
    def __init__(self, path, calculix):
        self.calculix = calculix
        self.nodes, self.elements, self.sets, self.surfaces, self.axes = {}, {}, {}, {}, {}
        self.density, self.sections, self.masses = {}, [], {}
        self.prefix, self.move = "", lambda place: place
        self.steps, self.step, self.forces, self.spread = [], None, {}, []
        parts, part = {}, None
        for block in blocks_of(path):
            keyword, options, rows = block
            if keyword == "PART":
                part = parts.setdefault(options["NAME"], [])
            elif keyword == "END PART":
                part = None
            elif part is not None:
                part.append(block)
            elif keyword == "INSTANCE":
                self.prefix, self.move = options["NAME"] + ".", movement(rows)
                for one in parts[options["PART"]]:
                    self.read(*one)
            elif keyword == "END INSTANCE":
                self.prefix, self.move = "", lambda place: place
            else:
                self.read(*block)

    def read(self, keyword, options, rows):
        action = getattr(self, "read_" + keyword.lower().replace(" ", "_"), None)
        if action is not None:
            action(options, rows)
        elif keyword in ("NGEN", "ELGEN", "NFILL", "RIGID BODY", "SYSTEM") and rows and keyword != "RIGID BODY":
            raise NotCounted(keyword)

    def find(self, kind, name):
        for one in (self.prefix + name, name):
            if one in (self.nodes if kind == "N" else self.elements):
                return [one]
            if (kind, one) in self.sets:
                return list(dict.fromkeys(self.sets[kind, one]))
        raise NotCounted(f"the set {name}")

    def add(self, kind, name, members):
        if name:
            self.sets.setdefault((kind, self.prefix + name), []).extend(members)

    def read_node(self, options, rows):
        names = [self.prefix + row[0] for row in rows]
        for name, row in zip(names, rows):
            self.nodes[name] = self.move(numpy.array([*map(real, row[1:4]), 0, 0, 0][:3], float))
        self.add("N", options.get("NSET"), names)

    def read_element(self, options, rows):
        type, cells = options["TYPE"], []
        match = re.match(r"(STRI|SC|S|B|PIPE)(\d+)|MASS", type)
        if match is None or match[1] == "SC":
            raise NotCounted(f"elements {type}")
        size = 1 if match[2] is None else int(match[2]) if match[1] in ("S", "STRI") else int(match[2][1]) + 1 if match[2][1] != "3" else 2
        size = {"STRI65": 6, "STRI3": 3}.get(type, min(size, 8))
        names = []
        for row in rows:
            cells += [cell for cell in row if cell]
            if len(cells) > size:
                name = self.prefix + cells[0]
                self.elements[name] = type[0], [self.prefix + node for node in cells[1 : size + 1]]
                names.append(name)
                cells = []
        self.add("E", options.get("ELSET"), names)

    def read_set(self, kind, name, options, rows):
        before = self.prefix
        if "INSTANCE" in options:
            self.prefix = options["INSTANCE"] + "."
        found = []
        for row in rows:
            if "GENERATE" in options:
                first, last, *step = map(int, filter(None, row))
                known = self.nodes if kind == "N" else self.elements
                found += [self.prefix + str(i) for i in range(first, last + 1, *step) if self.prefix + str(i) in known]
            else:
                found += [one for cell in row if cell for one in self.find(kind, cell)]
        self.prefix = before
        self.add(kind, name, found)

    def read_nset(self, options, rows):
        self.read_set("N", options["NSET"], options, rows)

    def read_elset(self, options, rows):
        self.read_set("E", options["ELSET"], options, rows)

    def read_surface(self, options, rows):
        if options.get("TYPE", "ELEMENT") == "ELEMENT":
            self.surfaces[self.prefix + options["NAME"]] = [(self.find("E", row[0]), row[1] if len(row) > 1 else "") for row in rows]

    def read_transform(self, options, rows):
        values = numpy.array([real(cell) for cell in rows[0]])
        for node in self.find("N", options["NSET"]):
            if options.get("TYPE", "R") == "R":
                x, z = values[:3], numpy.cross(values[:3], values[3:])
            else:
                z = values[3:] - values[:3]
                arm = self.nodes[node] - values[:3]
                x = arm - (arm @ z) * z / (z @ z)
                x = x if numpy.linalg.norm(x) > 1e-9 else numpy.eye(3)[abs(z).argmin()]
            x, z = x / numpy.linalg.norm(x), z / numpy.linalg.norm(z)
            self.axes[node] = numpy.array([x, numpy.cross(z, x), z])

    def read_material(self, options, rows):
        self.material = options["NAME"]

    def read_density(self, options, rows):
        self.density[self.material] = real(rows[0][0])

    def read_shell_section(self, options, rows):
        twice = 2 if "SYMMETRIC" in options else 1
        layers = [(real(row[0]), row[2]) for row in rows] * twice if "COMPOSITE" in options else [(real(rows[0][0]), options["MATERIAL"])]
        for name in self.find("E", options["ELSET"]):
            self.sections.append((name, sum(t for t, _ in layers), layers))

    read_shell_general_section = read_shell_section

    def read_beam_section(self, options, rows):
        shape = options["SECTION"][:4] if options["SECTION"][:4] in ("RECT", "CIRC") else options["SECTION"]
        sizes = [real(cell) for cell in rows[0] if cell]
        area = BOX_AREA[shape](sizes) if shape in BOX_AREA else None
        if shape == "CIRC":
            area = numpy.pi * (sizes[0] / 2 if self.calculix else sizes[0]) ** 2
        if area is None:
            raise NotCounted(f"the section {shape}")
        self.beams_of(options, rows, [(area, options["MATERIAL"])])

    def read_beam_general_section(self, options, rows):
        self.density["of " + options["ELSET"]] = real(options.get("DENSITY", ""))
        self.beams_of(options, rows, [(real(rows[0][0]), "of " + options["ELSET"])])

    def beams_of(self, options, rows, layers):
        self.up = getattr(self, "up", {})
        for name in self.find("E", options["ELSET"]):
            self.sections.append((name, None, layers))
            given = len(rows) > 1 and any(rows[1])
            self.up[name] = numpy.array([real(cell) for cell in rows[1][:3]]) if given else numpy.array([0, 0, -1.0])

    def read_mass(self, options, rows):
        self.masses.update({name: real(rows[0][0]) for name in self.find("E", options["ELSET"])})

    # steps

    def read_step(self, options, rows):
        self.step, self.renewed, self.before = "?", set(), None

    def procedure(self, kind):
        self.step = kind
        if kind != "STATIC" and not self.calculix:
            self.before = dict(self.forces), list(self.spread)
            if kind == "BUCKLE":
                self.forces, self.spread = {}, []

    def read_static(self, options, rows):
        self.procedure("STATIC")

    def read_frequency(self, options, rows):
        self.procedure("FREQUENCY")

    def read_buckle(self, options, rows):
        self.procedure("BUCKLE")

    def read_end_step(self, options, rows):
        self.steps.append((self.step, dict(self.forces), list(self.spread)))
        if self.before is not None:
            self.forces, self.spread = self.before

    def renews(self, keyword, options):
        first = options.get("OP") == "NEW" and keyword not in self.renewed
        self.renewed |= {keyword} if first else set()
        return first

    def read_cload(self, options, rows):
        if self.renews("CLOAD", options):
            self.forces = {}
        now = len(self.steps)
        for row in rows:
            for node in self.find("N", row[0]):
                key = node, int(row[1]) - 1
                value, step = self.forces.get(key, (0.0, now))
                self.forces[key] = (value if step == now else 0.0) + real(row[2]), now

    def distribute(self, keyword, options, entries):
        if self.renews(keyword, options):
            self.spread = [one for one in self.spread if one[0] != keyword]
        now = len(self.steps)
        for label, members, values in entries:
            taken = set(members)
            self.spread = [
                (k, l, m if k != keyword or l != label or s == now else [e for e in m if e not in taken], v, s) for k, l, m, v, s in self.spread
            ]
            self.spread.append((keyword, label, members, values, now))

    def read_dload(self, options, rows):
        entries = [(row[1], self.find("E", row[0]) if row[0] else list(self.elements), [real(c) for c in row[2:]]) for row in rows]
        self.distribute("DLOAD", options, entries)

    def read_dsload(self, options, rows):
        entries = []
        for row in rows:
            name = self.prefix + row[0]
            entries += [(f"{row[1]} {face}", members, [real(row[2])]) for members, face in self.surfaces[name]]
        self.distribute("DSLOAD", options, entries)

    def sums(self):
        """Of each static step."""
        self.layers = {name: layers for name, _, layers in self.sections}
        found = []
        for kind, forces, spread in self.steps:
            if kind != "STATIC":
                continue
            total = Sum()
            for (node, i), (value, _) in forces.items():
                along = self.axes.get(node, numpy.eye(3))[i % 3] * value
                total.add(self.nodes[node], along if i < 3 else numpy.zeros(3), along if i >= 3 else numpy.zeros(3))
            for _, label, members, values, _ in spread:
                for name in members:
                    self.act(total, label, name, values)
            found.append(total.vector)
        return found

    def act(self, total, label, name, values):
        family, nodes = self.elements[name]
        corners = numpy.array([self.nodes[node] for node in nodes])
        layers = self.layers.get(name, [])
        if label == "GRAV":
            direction = numpy.array(values[1:4]) / numpy.linalg.norm(values[1:4])
            mass = sum(size * self.density.get(material, 0.0) for size, material in layers)
            if family == "S":
                total.pull(corners, mass * values[0] * direction)
            elif family in "BP":
                total.pull_line(corners, mass * values[0] * direction)
            else:
                total.add(corners[0], self.masses.get(name, 0.0) * values[0] * direction)
        elif label in ("BX", "BY", "BZ") and family == "S":
            total.pull(corners, sum(size for size, _ in layers) * values[0] * numpy.eye(3)["XYZ".index(label[1])])
        elif label == "P" and family == "S":
            total.press(corners, values[0])
        elif label in ("P SPOS", "P SNEG"):
            total.press(corners, values[0] if label == "P SNEG" else -values[0])
        elif label in ("PX", "PY", "PZ") and family in "BP":
            total.pull_line(corners, values[0] * numpy.eye(3)["XYZ".index(label[1])])
        elif label in ("P1", "P2") and family in "BP":
            t = corners[-1] - corners[0]
            t, first = t / numpy.linalg.norm(t), self.up[name]
            first = first - (first @ t) * t
            first = first / numpy.linalg.norm(first)
            total.pull_line(corners, values[0] * (first if label == "P1" else numpy.cross(t, first)))
        else:
            raise NotCounted(f"the load {label}")


def movement(rows):
    rows = [[real(cell) for cell in row if cell] for row in rows]

    def move(place):
        if rows:
            place = place + numpy.array(rows[0])
        if len(rows) > 1:
            a, axis, angle = numpy.array(rows[1][:3]), numpy.array(rows[1][3:6]) - numpy.array(rows[1][:3]), numpy.radians(rows[1][6])
            n = axis / numpy.linalg.norm(axis)
            K = numpy.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
            place = a + (numpy.eye(3) + numpy.sin(angle) * K + (1 - numpy.cos(angle)) * K @ K) @ (place - a)
        return place

    return move


def abaqus(path):
    return AbaqusFile(path, False).sums()


def calculix(path):
    return AbaqusFile(path, True).sums()


# Nastran


def field(text):
    """A number as Nastran writes it, 1.4+11 as well; other words as they stand."""
    text = text.strip()
    if re.fullmatch(r"[-+]?\d+", text):
        return int(text)
    if re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)([EeDd]?[-+]\d+|[Ee]\d+)?", text):
        return float(re.sub(r"(?<=[\d.])[Dd]?([-+]\d+)$", r"e\1", text))
    return text


def cards_of(lines):
    found = []
    for line in lines:
        line = line.split("$")[0].rstrip().expandtabs()
        if not line or line.upper().startswith("ENDDATA"):
            continue
        if "," in line:
            cells = line.split(",")
        else:
            width = 16 if "*" in line[:8] else 8
            cells = [line[:8], *(line[8 + width * i : 8 + width * (i + 1)] for i in range(64 // width))]
        name, cells = cells[0].strip().rstrip("*").upper(), [field(cell) for cell in cells[1:]]
        if name == "" or name[0] in "+*":
            found[-1] += cells
        else:
            found.append([name, *cells])
    return found


def included(path):
    text = path.read_text(errors="replace")
    return re.sub(r"(?im)^\s*INCLUDE\s+['\"]([^'\"]+)['\"]", lambda found: included(path.parent / found[1]), text)


def nastran(path):
    """Of each subcase of a static solution, or of the one case."""
    control, bulk = re.split(r"(?im)^\s*BEGIN\s+BULK.*$", included(pathlib.Path(path)), 1)
    cases, general = [], {}
    for line in control.splitlines():
        words = re.match(r"\s*(SUBCASE\s+\d+|LOAD\s*=\s*(\d+))", line.split("$")[0], re.I)
        if words and words[1].upper().startswith("SUBCASE"):
            cases.append(dict(general))
        elif words:
            (cases[-1] if cases else general)["LOAD"] = int(words[2])
    cases = cases or [general]
    nodes, elements, walls, density, cards = {}, {}, {}, {}, cards_of(bulk.splitlines())
    masses, bars, areas = [], {}, {}
    for name, *c in cards:
        c += [""] * 16
        if name == "GRID":
            if c[1] not in ("", 0):
                raise NotCounted("nodes in a system")
            nodes[c[0]] = numpy.array([float(x or 0) for x in c[2:5]])
        elif name in ("CQUAD4", "CQUADR", "CTRIA3", "CTRIAR", "CQUAD8", "CTRIA6"):
            elements[c[0]] = c[1], c[2 : 2 + int(name[-1]) if name[-1].isdigit() else 2 + {"CQUADR": 4, "CTRIAR": 3}[name]]
        elif name in ("CBAR", "CBEAM"):
            bars[c[0]] = c[1], c[2:4]
        elif name == "PSHELL":
            walls[c[0]] = [(c[2], c[1])], float(c[7] or 0)
        elif name == "PCOMP":
            rows = [c[i : i + 4] for i in range(8, len(c), 4) if any(x != "" for x in c[i : i + 4])]
            for i in range(1, len(rows)):
                rows[i] = [own if own != "" else above for own, above in zip(rows[i], rows[i - 1])]
            walls[c[0]] = [(row[1], row[0]) for row in rows] * (2 if c[7] == "SYM" else 1), float(c[2] or 0)
        elif name in ("PBAR", "PBARL"):
            sizes = [float(x or 0) for x in c[8:12]]
            shape = {"BOX": lambda: sizes[0] * sizes[1] - (sizes[0] - 2 * sizes[3]) * (sizes[1] - 2 * sizes[2]), "BAR": lambda: sizes[0] * sizes[1],
                     "ROD": lambda: numpy.pi * sizes[0] ** 2, "TUBE": lambda: numpy.pi * (sizes[0] ** 2 - sizes[1] ** 2)}  # fmt: skip
            areas[c[0]] = (float(c[2]) if name == "PBAR" else shape[c[3]]()), c[1]
        elif name == "MAT1":
            density[c[0]] = float(c[4] or 0)
        elif name == "MAT8":
            density[c[0]] = float(c[7] or 0)
        elif name == "CONM2":
            masses.append((c[1], float(c[3]), numpy.array([float(x or 0) for x in c[4:7]])))

    def add(total, load, factor):
        for name, *c in cards:
            c += [""] * 12
            if name == "LOAD" and c[0] == load:
                for scale, one in zip(c[2::2], c[3::2]):
                    if one != "":
                        add(total, one, factor * c[1] * scale)
            elif not c or c[0] != load:
                continue
            elif name in ("FORCE", "MOMENT"):
                if c[2] not in ("", 0):
                    raise NotCounted("a force in a system")
                vector = factor * c[3] * numpy.array([float(x or 0) for x in c[4:7]])
                total.add(nodes[c[1]], *((vector,) if name == "FORCE" else (numpy.zeros(3), vector)))
            elif name in ("PLOAD4", "PLOAD2"):
                first, value = (c[1], c[2]) if name == "PLOAD4" else (c[2], c[1])
                rest = c[6:9] if name == "PLOAD4" else c[3:5]
                members = [first, *(x for x in rest if isinstance(x, int))]
                if name == "PLOAD4" and c[6] == "THRU" or name == "PLOAD2" and c[3] == "THRU":
                    members = range(first, (c[7] if name == "PLOAD4" else c[4]) + 1)
                for one in members:
                    if one in elements:
                        given = [value if p == "" else p for p in c[2:6]] if name == "PLOAD4" else [value] * 4
                        total.press(numpy.array([nodes[n] for n in elements[one][1]]), factor * numpy.array(given))
            elif name == "GRAV":
                a = factor * c[2] * numpy.array([float(x or 0) for x in c[3:6]])
                for wall, members in elements.values():
                    layers, more = walls[wall]
                    total.pull(numpy.array([nodes[n] for n in members]), (sum(t * density[m] for t, m in layers) + more) * a)
                for section, members in bars.values():
                    area, material = areas[section]
                    total.pull_line(numpy.array([nodes[n] for n in members]), area * density[material] * a)
                for node, mass, arm in masses:
                    total.add(nodes[node] + arm, mass * a)
            elif name == "PLOAD1":
                ends = numpy.array([nodes[n] for n in bars[c[1]][1]])
                whole = numpy.linalg.norm(ends[1] - ends[0]) if c[3] == "LE" else 1.0
                if c[2] not in ("FX", "FY", "FZ") or c[3] not in ("LE", "FR") or c[7] != c[5] or (c[4] or 0, c[6]) != (0, whole):
                    raise NotCounted("PLOAD1 on a part of an element, or along its axes")
                total.pull_line(ends, factor * c[5] * numpy.eye(3)["XYZ".index(c[2][1])])
            elif name in ("TEMP", "PLOAD"):
                raise NotCounted(name)

    found = []
    for case in cases:
        total = Sum()
        if "LOAD" in case:
            add(total, case["LOAD"], 1.0)
        found.append(total.vector)
    return found


# ANSYS


def ansys(path):
    nodes, elements, density, walls, areas, masses = {}, [], collections.defaultdict(float), {}, {}, {}
    total, where, section, shape = Sum(), None, None, None
    forces, pressures, ground = [], [], numpy.zeros(3)
    for line in pathlib.Path(path).read_text(errors="replace").splitlines():
        words = [word.strip() for word in line.split(",")]
        head = words[0].upper()
        if head in ("NBLOCK", "EBLOCK", "RLBLOCK", "DBLOCK", "FBLOCK", "SFEBLOCK"):
            where = head
            continue
        if line.startswith("("):
            width = [int(x) for x in re.findall(r"(?:i|e)(\d+)", line)]
            continue
        if where == "NBLOCK" and not re.match(r"\s*\d", line):
            where = None
        if where in ("EBLOCK", "DBLOCK", "FBLOCK") and line.strip() == "-1" or where == "SFEBLOCK" and head == "SFE":
            where = None
            continue
        if where == "NBLOCK":
            start, size = 3 * width[0], width[1]
            place = [float(line[start + size * i : start + size * (i + 1)] or 0) for i in range(3)]
            nodes[int(line[: width[0]])] = numpy.array(place)
        elif where == "EBLOCK":
            cells = [int(line[i : i + width[0]]) for i in range(0, len(line.rstrip()), width[0])]
            elements.append((cells[10], cells[0], cells[2], cells[3], list(dict.fromkeys(cells[11:]))))
        elif where == "FBLOCK":
            forces.append((int(line[:9]), line[9:15].strip(), float(line[15:31])))
        elif where == "SFEBLOCK":
            if int(line[13:17]) == 1:
                pressures.append((int(line[:9]), int(line[9:13]), float(line[17:37])))
        elif where == "RLBLOCK":
            cells = line.split()
            masses[int(cells[0])], where = float(cells[2]), None
        elif head == "MPDATA" and words[3] == "DENS":
            density[int(words[4])] = float(words[6])
        elif head == "MP" and words[1] == "DENS":
            density[int(words[2])] = float(words[3])
        elif head == "SECTYPE":
            section, shape, rows = int(words[1]), (words[2], words[3] if len(words) > 3 else ""), 0
        elif head == "SECBLOCK":
            rows = int(words[1])
        elif rows_left(locals()) and re.match(r"\s*[\d.]", line):
            walls.setdefault(section, []).append((float(words[0]), int(words[1])))
            rows -= 1
        elif head == "SECDATA":
            s = [float(x) for x in words[1:] if x]
            if shape[0] == "SHELL":
                walls.setdefault(section, []).append((s[0], int(s[1])))
            else:
                areas[section] = {"RECT": lambda: s[0] * s[1], "HREC": lambda: s[0] * s[1] - (s[0] - s[2] - s[3]) * (s[1] - s[4] - s[5])}[shape[1]]()
        elif head == "F":
            forces.append((int(words[1]), words[2], float(words[3])))
        elif head == "SFE" and words[3] == "PRES" and float(words[4] or 0) == 0:
            pressures.append((int(words[1]), int(words[2]), float(words[5])))
        elif head == "ACEL":
            ground = numpy.array([float(x or 0) for x in words[1:4]])
    for node, label, value in forces:
        vector = value * numpy.eye(3)["XYZ".index(label[1])]
        total.add(nodes[node], *((vector,) if label[0] == "F" else (numpy.zeros(3), vector)))
    by_number = {one[0]: one for one in elements}
    for number, face, value in pressures:
        total.press(numpy.array([nodes[n] for n in by_number[number][4]]), value if face == 1 else -value)
    for _, material, constants, section, members in elements:
        places = numpy.array([nodes[n] for n in members])
        if len(members) == 1:
            total.add(places[0], -ground * masses[constants])
        elif len(members) == 2:
            total.pull_line(places, -ground * areas[section] * density[material])
        else:
            total.pull(places, -ground * sum(t * density[m] for t, m in walls[section]))
    return [total.vector]


def rows_left(names):
    return names.get("rows", 0) > 0


READERS = {"abaqus": abaqus, "calculix": calculix, "nastran": nastran, "ansys": ansys}
