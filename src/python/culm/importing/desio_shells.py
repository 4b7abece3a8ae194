"""Shells of DeSiO: nodes with a director, laminates, and what acts on them. Nodes are numbered through all shells from 1."""

import dataclasses

import numpy

from .desio_files import Values, read_loads, read_masses, read_motions, read_table
from .findings import did_you_mean, refuse
from .quads import area, corner_normals

FILES = ("shellinput.txt", "constraint6input.txt", "constraint6to12input.txt", "load6input.txt", "pointmass6input.txt", "boundary6input.txt")  # fmt: skip
ANYWHERE = 3.1  # fold angle beyond which nodes are split: a node of the file has one director
TILTED = 0.02  # rad, of a director of the file from the mean normal of its elements
SAME_PLACE = 1e-6  # of the shortest edge
CONSTANTS = ("E1", "E2", "E3", "G23", "G13", "G12", "nu23", "nu13", "nu12")


@dataclasses.dataclass
class Shell:
    """@param nodes   places and directors, (n, 6)
    @param quads   four places in nodes each, (m, 4)
    @param layers  number of the laminate of each element"""

    name: str
    nodes: numpy.ndarray
    quads: numpy.ndarray
    layers: list
    place: object


def read_shells(path):
    """@return shells; materials as (constants, density, dissipation, place); laminates as rows (material, thickness, angle)"""
    values = Values(path)
    _, (shells, materials, laminates) = values.counts(3, "the number of shells, of materials and of sequences of layers")
    found = []
    for i in range(shells):
        place, (nodes, elements) = values.counts(2, "the number of nodes and elements")
        points = numpy.array([values.numbers(6, "place and director of a node")[1] for _ in range(nodes)]).reshape(-1, 6)
        quads, layers = [], []
        for _ in range(elements):
            where, (*corners, sequence) = values.counts(5, "four nodes and a sequence of layers")
            if not 1 <= min(corners) <= max(corners) <= nodes:
                refuse(where, f"there is no node {max(corners)}: those of this shell are numbered 1 to {nodes}")
            if len(set(corners)) < 4:
                refuse(where, "the nodes of an element must differ")
            if not 1 <= sequence <= laminates:
                refuse(where, f"there is no sequence of layers {sequence}: they are numbered 1 to {laminates}")
            quads.append([corner - 1 for corner in corners])
            layers.append(sequence)
        if not elements:
            refuse(place, "a shell needs elements")
        found.append(Shell(f"shell {i + 1}", points, numpy.array(quads), layers, place))
    table = []
    for _ in range(materials):
        place, constants = values.numbers(9, "E1 E2 E3 G23 G13 G12 nu23 nu13 nu12")
        _, (density,) = values.numbers(1, "the density of a material")
        _, dissipation = values.numbers(2, "two factors of dissipation")
        table.append((constants, float(density), dissipation, place))
    return found, table, [_laminate(values, materials) for _ in range(laminates)]


def _laminate(values, materials):
    place, (count,) = values.counts(1, "the number of layers")
    rows = [values.numbers(count, what)[1] for what in ("materials of layers", "thicknesses of layers", "angles of layers")]
    for material, thickness, _ in zip(*rows):
        if material != round(material) or not 1 <= material <= materials:
            refuse(place, f"there is no material {material:g}: they are numbered 1 to {materials}")
        if thickness <= 0.0:
            refuse(place, f"a thickness must be > 0, got {thickness:g}")
    return [(int(m), float(t), float(a)) for m, t, a in zip(*rows)]


class Shells:
    """@param reader  of desio.py"""

    def __init__(self, reader):
        self.reader = reader
        self.nodes = []  # names in the deck, in the order of the file
        self.places = []

    def read(self):
        found = self.reader.if_there("shellinput.txt", read_shells)
        if found is None:
            for name in FILES[1:]:
                if (self.reader.folder / name).exists():
                    self.reader.findings.leave_out(f"the file {name}, without a shellinput.txt")
            return
        shells, materials, laminates = found
        used = {m for shell in shells for n in shell.layers for m, _, _ in laminates[n - 1]}
        for number_ in sorted(used):
            self._material(number_, *materials[number_ - 1])
        for shell in shells:
            self._shell(shell, materials, laminates)
        self.reader.findings.count("shells", len(shells))

    def _material(self, number_, constants, density, dissipation, place):
        entry = self.reader.lists["Materials"].list(f"material {number_}", f"{place}", "Orthotropic")
        for key, value in zip(CONSTANTS, constants):
            entry.add(key, float(value))
        entry.add("Density", density)
        if dissipation[0]:
            entry.add("Dissipation", float(dissipation[0]))
        if dissipation[1]:
            self.reader.findings.leave_out("dissipation of velocities in shells, the second factor of a material", place)

    def _shell(self, shell, materials, laminates):
        if len(set(shell.layers)) > 1:
            refuse(shell.place, "a shell with several sequences of layers is not read: each needs a shell of its own")
        layers = laminates[shell.layers[0] - 1]
        corners = shell.nodes[shell.quads, :3]
        normals = corner_normals(corners)
        against = (normals * shell.nodes[shell.quads, 3:]).sum(axis=2) < 0.0
        if against.any() and not against.all():
            refuse(shell.place, "some directors point to the other side than the normals of their elements")
        quads = shell.quads[:, [1, 0, 3, 2]] if against.all() else shell.quads  # the first line stays where it is
        angles = [0.0 - a if against.all() else a for _, _, a in layers]
        order = list(dict.fromkeys(quads.ravel().tolist()))  # in which culm numbers nodes
        if len(order) < len(shell.nodes):
            refuse(shell.place, f"node {min(set(range(len(shell.nodes))) - set(order)) + 1} of the shell belongs to no element")
        self._check(shell, quads, layers, materials, corners)
        entry = self.reader.lists["Structures"].list(shell.name, f"{shell.place}", "Shell")
        entry.add("Materials", [f"material {m}" for m, _, _ in layers]).add("Thicknesses", [t for _, t, _ in layers])
        entry.add("Angles", angles, "deg").add("Fold Angle", ANYWHERE)
        mesh = entry.list("Mesh", type="Quads").add("Points", shell.nodes[:, :3].ravel())
        mesh.add("Quads", quads.ravel().tolist())
        numbers = {node: i for i, node in enumerate(order)}
        self.nodes += [f"{shell.name}/{numbers[i]}" for i in range(len(shell.nodes))]
        self.places += [shell.place] * len(shell.nodes)
        per_area = sum(t * materials[m - 1][1] for m, t, _ in layers)
        self.reader.mass += float(per_area * area(corners).sum())

    def _check(self, shell, quads, layers, materials, corners):
        """Directors, which culm finds by the normals, and directions of layers, which culm counts from the first line."""
        from scipy.spatial import cKDTree

        findings = self.reader.findings
        edges = numpy.linalg.norm(numpy.roll(corners, -1, axis=1) - corners, axis=2)
        pairs = cKDTree(shell.nodes[:, :3]).query_pairs(SAME_PLACE * edges.min())
        if pairs:
            a, b = min(pairs)
            refuse(shell.place, f"nodes {a + 1} and {b + 1} of the shell are at one place: join two shells there")
        means = numpy.zeros((len(shell.nodes), 3))
        numpy.add.at(means, quads, corner_normals(shell.nodes[quads, :3]))
        given = shell.nodes[:, 3:]
        lengths = numpy.linalg.norm(given, axis=1)
        worst = abs(lengths - 1.0).argmax()
        if abs(lengths[worst] - 1.0) > 1e-3:
            refuse(shell.place, f"directors must have length 1, but that of node {worst + 1} has {lengths[worst]:g}")
        tilt = numpy.linalg.norm(numpy.cross(means, given), axis=1) / numpy.linalg.norm(means, axis=1) / lengths
        if tilt.max() > TILTED:
            text = "directors are the mean normals of their elements, from which those of the file differ by up to"
            findings.assume(f"{text} {tilt.max():.2g} rad", shell.place)
        constants = [materials[m - 1][0] for m, _, _ in layers]
        if any(numpy.ptp(c[:3]) > 1e-9 * c[0] or numpy.ptp(c[3:6]) > 1e-9 * c[3] or numpy.ptp(c[6:]) > 0.0 for c in constants):
            diagonals = [corners[:, i] - corners[:, i + 2] for i in (0, 1)]
            first = numpy.subtract(*(d / numpy.linalg.norm(d, axis=1, keepdims=True) for d in diagonals))
            line = corners[:, 1] - corners[:, 0]
            turn = numpy.linalg.norm(numpy.cross(first, line), axis=1) / numpy.linalg.norm(first, axis=1) / numpy.linalg.norm(line, axis=1)
            if turn.max() > 1e-3:
                text = "layers count from the first line of their elements, from which the bisector of the diagonals, as DeSiO has it, is up to"
                findings.assume(f"{text} {turn.max():.2g} rad away", shell.place)

    def node(self, number_, place):
        if not 1 <= number_ <= len(self.nodes):
            refuse(place, f"there is no node {number_} of a shell: they are numbered 1 to {len(self.nodes)}")
        return self.nodes[number_ - 1]

    def act(self):
        """Constraints, masses and loads, when all structures are known."""
        if not self.nodes:
            return
        reader = self.reader
        moved = {row.numbers[0]: row for row in reader.if_there("boundary6input.txt", read_motions) or []}
        rows = reader.if_there("constraint6input.txt", lambda path: read_table(path, 2, 9, 0)) or []
        for i, row in enumerate(rows, 1):
            self._constraint(row, moved.pop(i, None))
        for number_, row in moved.items():
            refuse(row.place, f"there is no constraint {number_} of shells: they are numbered 1 to {len(rows)}")
        transitions = reader.if_there("constraint6to12input.txt", lambda path: read_table(path, 2, 0, 0)) or []
        for row in transitions:
            self._transition(row)
        reader.findings.count("constraints", len(rows) + len(transitions))
        for row in reader.if_there("pointmass6input.txt", read_masses) or []:
            reader.add_mass(self.node(row.numbers[0], row.place), row)
        for row in reader.if_there("load6input.txt", lambda path: read_loads(path, 4)) or []:
            node = self.node(row.numbers[0], row.place)
            *force, along = row.values[2:]
            if along:
                refuse(row.place, "a force along the director, the last value of a load on a shell, is not read")
            function = reader.function(row.kind, row.values[0], row.values[1], row.place)
            reader.add_load("Force", node, row.place).add("Force", numpy.array(force)).add("Function", function)
            reader.findings.count("loads")

    def _constraint(self, row, motion):
        kind = row.kind.lower()
        if kind not in ALONE and kind not in PAIRS:
            refuse(row.place, f"unknown constraint of shells '{row.kind}'{did_you_mean(kind, [*ALONE, *PAIRS])}")
        node = self.node(row.numbers[0], row.place)
        direction = numpy.concatenate([row.values, numpy.zeros(9)])[6:9]
        entry = self.reader.add_constraint(kind, row.place)
        if kind in PAIRS:
            type, values = PAIRS[kind]
            entry.add("Type", type).add("First", node).add("Second", self.node(row.numbers[1], row.place)).add("Tolerance", 1e12)
        else:
            type, key = ALONE[kind]
            values = {} if key is None else {key: direction}
            if key is not None and not direction.any():
                refuse(row.place, "this constraint needs a direction")
            entry.add("Type", type).add("Node", node)
        for key, value in values.items():
            entry.add(key, value)
        if motion is not None:
            if kind != "simplesupport":
                refuse(motion.place, f"a constraint '{row.kind}' of shells has no motion that can be prescribed")
            entry.add("Translation", 1).add("Function", self.reader.function(motion.kind, *motion.values, motion.place, motion.word))

    def _transition(self, row):
        kind = row.kind.lower()
        type = {"rigidtransition": "Rigid Connection", "softtransition": "Soft Transition"}.get(kind)
        if type is None:
            refuse(row.place, f"unknown transition '{row.kind}': rigidtransition and softtransition are read")
        how = "" if type == "Rigid Connection" else " against tilting"
        self.reader.findings.assume(f"a {kind} holds the director of the shell{how}, too, as culm has it", row.place)
        master = self.reader.node(row.numbers[0], row.place)
        entry = self.reader.add_constraint(kind, row.place).add("Type", type)
        entry.add("Node", self.node(row.numbers[1], row.place)).add("Master", master.name)


# of one node: type, and what its direction is called
ALONE = {
    "simplesupport": ("Simple Support", "Direction"),
    "sphericalsupport": ("Spherical Support", None),
    "revolutesupport": ("Rigid Support", None),
    "symmetry": ("Symmetry", "Normal"),
    "internal": ("Inextensible Director", None),
}
# of two nodes: type, and what else it has
PAIRS = {
    "sphericaljoint": ("Hinge Connection", {}),
    "revolutejoint": ("Smooth Connection", {}),
    "inextensiblerevolutejoint": ("Fold Connection", {"Inextensible": True}),
    "layerconnection": ("Layer Connection", {}),
}
