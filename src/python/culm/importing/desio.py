"""Models of DeSiO-Structure: a folder with simulationinput_structure.txt, beaminput.txt, …

Beams keep their nodes and elements, which are those of culm with Order 1. The conventions – order of
21 stiffnesses and of masses, inertia as Euler tensor, axes of joints – are those of section 1 of the
theory (doc/theory/README.md) and of the program's public input writers.
"""

import numpy

from ..errors import CulmError
from .deck_text import List, unique_name
from .desio_analyses import ANALYSES
from .desio_constraints import CONSTRAINTS, DAMPERS, SPRINGS, has_two
from .desio_files import (
    read_beams,
    read_bodies,
    read_loads,
    read_masses,
    read_motions,
    read_simulation,
    read_springs,
    read_table,
)
from .desio_sections import section_steps, value_section, voigt_section
from .desio_shells import FILES, Shells
from .findings import FILE_ERROR, Findings, did_you_mean, refuse
from .ready_deck import ReadyDeck

FILE = "folder of the model, or its simulationinput file"

# sort of a load -> type of a function, and what its duration is called
FUNCTIONS = {
    "constant": ("Constant", None),
    "linear": ("Linear", "Duration"),
    "linear0": ("Linear Then Zero", "Duration"),
    "linearc": ("Linear Then Constant", "Duration"),
    "triangle": ("Triangle", "Duration"),
    "square": ("Square", "Duration"),
    "heaviside": ("Heaviside", "Start"),
    "sinusoidal": ("Sinusoidal", "Period"),
    "delta": ("Delta", "Time"),
    "random": ("Random", None),
}


def declare(parser):
    parser.add_argument(
        "--first-node",
        type=int,
        choices=(0, 1),
        help="how constraints count nodes; from 0 if one of them names a node 0, else from 1",
    )


def read(path, arguments):
    """@return the ReadyDeck of a model"""
    if not path.exists():
        raise CulmError(f"{path}: is not there", FILE_ERROR)
    folder = path if path.is_dir() else path.parent
    return Reader(folder, path, getattr(arguments, "first_node", None)).read()


class Reader:
    def __init__(self, folder, path, first_node):
        self.folder = folder
        self.path = path
        self.findings = Findings()
        self.root = List("culm")
        self.lists = {}
        self.nodes = []
        self.mass = 0.0
        self.first_node = first_node
        self.functions = {}
        self.constraint_names = []

    def read(self):
        self._tell_other_files()
        simulation = self.path if self.path.is_file() else self._simulation_file()
        names, analyses, gravity = read_simulation(simulation)
        self.findings.look_at_end(simulation)
        self.root.add("Title", names[0])
        for name in ("Materials", "Sections", "Structures", "Masses", "Functions", "Constraints", "Loads", "Analyses", "Output"):
            self.lists[name] = self.root.list(name)
        if len(names) > 1 and names[1].lower() != "none":
            self.findings.leave_out(f"the state of the job before, '{names[1]}'")
        shells = Shells(self)
        self._bodies()
        self._beams()
        shells.read()
        if not self.nodes and not shells.nodes:
            raise CulmError(f"{self.folder}: has none of beaminput.txt, rigidbodyinput.txt, shellinput.txt", FILE_ERROR)
        motions = self.if_there("boundary12input.txt", read_motions) or []
        self._constraints(motions)
        shells.act()
        self._masses()
        self._loads()
        self._springs()
        self._analyses(analyses, gravity)
        return ReadyDeck(self.root, self.findings, self.mass)

    def _simulation_file(self):
        for name in ("simulationinput_structure.txt", "simulationinput.txt"):
            if (self.folder / name).is_file():
                return self.folder / name
        raise CulmError(f"{self.folder}: has no simulationinput_structure.txt", FILE_ERROR)

    def _tell_other_files(self):
        known = {"rigidbody", "beam", "constraint12", "pointmass12", "load12", "boundary12", "spring12", "damping12"}
        for path in sorted(self.folder.glob("*input.txt")):
            if path.name not in FILES and path.name.removesuffix("input.txt") not in known | {"simulation"}:
                self.findings.leave_out(f"the file {path.name}")

    def if_there(self, name, read_file):
        path = self.folder / name
        if not path.exists():
            return None
        self.findings.look_at_end(path)
        return read_file(path)

    def _bodies(self):
        for body in self.if_there("rigidbodyinput.txt", read_bodies) or []:
            name = unique_name(body.node.name, {one.name for one in self.lists["Structures"].lists()})
            body.node.name = name
            self.nodes.append(body.node)
            mass, centre, inertia = mass_properties(body.values, body.place)
            entry = self.lists["Structures"].list(name, f"{body.node.place}; properties {body.place}", "Rigid Body")
            entry.add("Position", body.node.position).add("Directors", body.node.directors.ravel())
            entry.add("Mass", mass).add("Centre", centre).add("Inertia", inertia)
            self.mass += mass
            self.findings.count("rigid bodies")

    def _beams(self):
        found = self.if_there("beaminput.txt", read_beams)
        if found is None:
            return
        beams, table, voigt = found
        self.findings.count("beams", len(beams))
        self.findings.count("sections", len(table))
        used = dict.fromkeys(index for beam in beams for index in beam.properties)
        for index in used:
            stiffness, mass, _, place, title = table[index]
            entry = self.lists["Sections"].list(f"section {index + 1}", f"{place}: {title}")
            (voigt_section if voigt else value_section)(entry, stiffness, mass)
        for beam in beams:
            self._beam(beam, table)

    def _beam(self, beam, table):
        name = unique_name(beam.name, {one.name for one in self.lists["Structures"].lists()})
        nodes, properties = beam.nodes, beam.properties
        if _runs_backwards(nodes):
            # all strains change their sign with the direction, and so neither energy nor forces
            nodes, properties = nodes[::-1], properties[::-1]
            self.findings.assume("d3 points from the last node of a beam to its first: it begins at the last", beam.place)
        positions = numpy.array([node.position for node in nodes])
        lengths = numpy.linalg.norm(numpy.diff(positions, axis=0), axis=1)
        self.mass += float(sum(table[index][1][0] * length for index, length in zip(properties, lengths)))
        entry = self.lists["Structures"].list(name, f"{beam.place}", "Beam")
        entry.add("Order", 1, comment="the element of the original; 2 needs fewer nodes for the same accuracy")
        names, places = section_steps(properties, lengths)
        if len(set(names)) == 1:
            entry.add("Section", names[0])
        else:
            entry.add("Sections", names).add("Section Positions", places)
        factors = {tuple(table[index][2]) for index in properties}
        if len(factors) > 1:
            self.findings.assume("the dissipation of a beam is that of its first section", beam.place)
        for key, factor in zip(("Dissipation", "Velocity Dissipation"), table[beam.properties[0]][2]):
            if factor:
                entry.add(key, factor)
        curve = entry.list("Curve", type="Nodes").add("Positions", positions.ravel())
        curve.add("Directors", numpy.array([node.directors for node in nodes]).ravel())
        for i, node in enumerate(nodes):
            node.name = f"{name}/{i}"
        self.nodes.extend(beam.nodes)

    def _node(self, number_, place, first):
        if not first <= number_ < first + len(self.nodes):
            refuse(place, f"there is no node {number_}: they are numbered {first} to {first + len(self.nodes) - 1}")
        return self.nodes[number_ - first]

    def _constraints(self, motions):
        rows = self.if_there("constraint12input.txt", lambda path: read_table(path, 2, 9, 0)) or []
        first = self.first_node
        if first is None:
            named = [row for row in rows if row.numbers[0] == 0 or has_two(row) and row.numbers[1] == 0]
            first = 0 if named else 1
            if named:
                self.findings.assume("constraints count nodes from 0, because one names a node 0", named[0].place)
        self.findings.count("constraints", len(rows))
        moved = {row.numbers[0]: row for row in motions}
        for i, row in enumerate(rows, 1):
            self._constraint(row, first, moved.pop(i, None))
        for number_, row in moved.items():
            refuse(row.place, f"there is no constraint {number_}: they are numbered 1 to {len(rows)}")

    def _constraint(self, row, first, motion):
        kind = row.kind.lower()
        make = CONSTRAINTS.get(kind)
        if make is None and kind != "internal":
            refuse(row.place, f"unknown constraint '{row.kind}'{did_you_mean(kind, [*CONSTRAINTS, 'internal'])}")
        nodes = [self._node(row.numbers[0], row.place, first)]
        if has_two(row):
            nodes.append(self._node(row.numbers[1], row.place, first))
        if kind == "internal":
            return
        vectors = numpy.concatenate([row.values, numpy.zeros(9)])[:9].reshape(3, 3)
        constraints = self.lists["Constraints"]
        name = unique_name(kind, {one.name for one in constraints.lists()})
        type, values, amount = make(nodes, vectors, row.place, self.findings)
        entry = constraints.list(name, f"{row.place}", type)
        for key, value in values.items():
            entry.add(key, value)
        if motion is not None:
            if amount is None:
                refuse(motion.place, f"a constraint '{row.kind}' has no motion that can be prescribed")
            entry.add(amount, 1).add("Function", self.function(motion.kind, *motion.values, motion.place, motion.word))

    def function(self, sort, intensity, duration, place, word=""):
        """The name of an entry of Functions."""
        key = (sort.lower(), float(intensity), float(duration), word if sort.lower() == "file" else "")
        if key in self.functions:
            return self.functions[key]
        functions = self.lists["Functions"]
        name = f"{sort.lower()} {len(functions.lists()) + 1}"
        if sort.lower() == "file":
            if not (self.folder / word).is_file():
                refuse(place, f"the time series '{word}' is not there")
            entry = functions.list(name, f"{place}", "File")
            entry.add("Intensity", intensity).add("File Name", str((self.folder / word).resolve()))
        elif sort.lower() not in FUNCTIONS:
            refuse(place, f"unknown function '{sort}'{did_you_mean(sort.lower(), FUNCTIONS)}")
        else:
            type, parameter = FUNCTIONS[sort.lower()]
            entry = functions.list(name, f"{place}", type).add("Intensity", intensity)
            if parameter is not None:
                entry.add(parameter, duration)
        self.functions[key] = name
        return name

    def _masses(self):
        """Their numbers count from 1 even where those of constraints count from 0."""
        for row in self.if_there("pointmass12input.txt", read_masses) or []:
            self.add_mass(self.node(row.numbers[0], row.place).name, row)

    def add_mass(self, node, row):
        masses = self.lists["Masses"]
        entry = masses.list(unique_name("mass", {m.name for m in masses.lists()}), f"{row.place}", "Point Mass")
        entry.add("Node", node).add("Mass", float(row.values[0]))
        self.mass += float(row.values[0])
        self.findings.count("point masses")

    def node(self, number_, place):
        """A node of a body or beam by its number in files that count from 1."""
        return self._node(number_, place, 1)

    def add_constraint(self, name, place):
        constraints = self.lists["Constraints"]
        return constraints.list(unique_name(name, {one.name for one in constraints.lists()}), f"{place}")

    def _loads(self):
        for row in self.if_there("load12input.txt", lambda path: read_loads(path, 12)) or []:
            node = self.node(row.numbers[0], row.place)
            function = self.function(row.kind, row.values[0], row.values[1], row.place)
            kinds = ("Force", "Moment", "Follower Force", "Follower Moment")
            for kind, vector in zip(kinds, row.values[2:].reshape(4, 3)):
                if vector.any():
                    self.add_load(kind, node.name, row.place).add(kind.split()[-1], vector).add("Function", function)
            self.findings.count("loads")

    def add_load(self, type, node, place):
        loads = self.lists["Loads"]
        name = unique_name(type.lower(), {one.name for one in loads.lists()})
        return loads.list(name, f"{place}", type).add("Node", node)

    def _springs(self):
        for file, kinds, keys in (("spring12input.txt", SPRINGS, ("Elongations", "Forces")),
                                  ("damping12input.txt", DAMPERS, ("Rates", "Moments"))):  # fmt: skip
            rows, curves = self.if_there(file, read_springs) or ([], [])
            for row in rows:
                if row.kind.lower() not in kinds:
                    refuse(row.place, f"unknown element '{row.kind}'{did_you_mean(row.kind.lower(), kinds)}")
                node = self.node(row.numbers[0], row.place)
                type, name, frame = kinds[row.kind.lower()]
                entry = self.add_load(type, node.name, row.place)
                if name is not None:
                    entry.add(name, row.values @ node.directors if frame == "Node" else row.values)
                if type == "Directed Ground Spring":
                    entry.add("Frame", frame)
                curve = curves[row.numbers[1] - 1]
                entry.add(keys[0], curve[:, 0]).add(keys[1], curve[:, 1])
                self.findings.count("springs and dampers")

    def _analyses(self, rows, gravity):
        flags = {row.kind.lower(): int(row.values[4]) for row in rows if len(row.values) > 4}
        acts = any(flags.get(kind) == 1 for kind in ("static", "dynamic"))
        if gravity.any() and acts:
            entry = self.lists["Loads"].list("gravity", "as the flag of the simulation says", "Gravity")
            entry.add("Acceleration", gravity)
            if "dynamic" not in flags:
                entry.add("Function", "Ramp")
        elif gravity.any():
            self.findings.assume("gravity does not act: no simulation has its flag at 1")
        for row in rows:
            kind = row.kind.lower()
            if kind not in ANALYSES:
                refuse(row.place, f"unknown simulation '{row.kind}'{did_you_mean(kind, ANALYSES)}")
            analyses = self.lists["Analyses"]
            name = unique_name(kind.replace("_", " "), {one.name for one in analyses.lists()})
            ANALYSES[kind](analyses.list(name, f"{row.place}"), row, self.findings)
        self.findings.assume("tolerances of the solver are those of culm")


def mass_properties(values, place):
    """Mass, centre and inertia about it from m, J11, J22, J33, J23, J13, S3, S2, S1, J12, with the
    Euler tensor J = integral of rho x x^T about the node, from (1.2) and (1.3) of the formulation."""
    m, J11, J22, J33, J23, J13, S3, S2, S1, J12 = map(float, values)
    if m <= 0.0:
        refuse(place, f"the mass of a body must be > 0, got {m:g}")
    centre = numpy.array([S1, S2, S3]) / m
    J = numpy.array([[J11, J12, J13], [J12, J22, J23], [J13, J23, J33]]) - m * numpy.outer(centre, centre)
    tensor = numpy.trace(J) * numpy.eye(3) - J
    return m, centre, tensor[[0, 1, 2, 1, 0, 0], [0, 1, 2, 2, 2, 1]]


def _runs_backwards(nodes):
    """Whether d3 points against the axis everywhere."""
    steps = zip(nodes, nodes[1:])
    return all((b.position - a.position) @ (a.directors[2] + b.directors[2]) < 0.0 for a, b in steps)
