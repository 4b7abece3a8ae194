"""The text files of a DeSiO model as numbers, in the order they stand: lines of values between lines
of comments, which begin with '!!'."""

import dataclasses
import pathlib
import re

import numpy

from .findings import Place, refuse
from .keyword_file import integer, number, read_text


class Values:
    """The lines of values of one file, one after the other."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.lines, self.comments, self._at = [], {}, 0
        comment = None  # above the next line; None without any
        for i, raw in enumerate(read_text(path).split("\n"), 1):
            line, _, after = raw.strip().partition("!!") if raw.strip()[:1] != "!" else (raw.strip(), "", "")
            if line.startswith("!"):
                comment = line.lstrip("!").strip() or comment or ""
            elif line:
                self.comments[len(self.lines)] = comment
                self.lines.append((Place(str(path), i), [word.rstrip(",") or word for word in line.split()]))
                comment = after.strip() or None

    def next(self, count, what):
        """The words of the next line, at least so many; they may go on in lines without a comment
        between, as Fortran reads them."""
        if self._at == len(self.lines):
            refuse(Place(str(self.path), self.lines[-1][0].line if self.lines else 1), f"the file ends before {what}")
        place, words = self.lines[self._at]
        self._at += 1
        while len(words) < count and self._at < len(self.lines) and self.comments[self._at] is None:
            words = words + self.lines[self._at][1]
            self._at += 1
        if len(words) < count:
            refuse(place, f"expected {count} values, {what}, found {len(words)}")
        return place, words

    def comment(self):
        """What stands above the next line."""
        return self.comments.get(self._at) or ""

    def numbers(self, count, what):
        place, words = self.next(count, what)
        return place, numpy.array([number(word, place, what) for word in words[:count]])

    def counts(self, count, what):
        place, words = self.next(count, what)
        found = [integer(word, place, what) for word in words[:count]]
        for one in found:
            if not 0 <= one <= 10**6:
                refuse(place, f"expected {what} between 0 and 1e6, found {one}")
        return place, found

    def end(self):
        if self._at < len(self.lines):
            place, words = self.lines[self._at]
            refuse(place, f"the file goes on where its counts say it ends: '{' '.join(words)[:40]}'")


@dataclasses.dataclass
class Node:
    """A node with 12 coordinates."""

    name: str  # in the deck
    position: numpy.ndarray
    directors: numpy.ndarray  # rows d1, d2, d3
    place: Place


@dataclasses.dataclass
class Body:
    node: Node
    values: numpy.ndarray  # m, J11, J22, J33, J23, J13, S3, S2, S1, J12
    place: Place


@dataclasses.dataclass
class Beam:
    name: str
    nodes: list
    properties: list  # number of the section of each element
    place: Place


@dataclasses.dataclass
class Row:
    """A line of a table: its word, its numbers of nodes, the vectors after them."""

    kind: str
    numbers: list
    values: numpy.ndarray
    place: Place
    word: str = ""


def read_node(values, name):
    place, found = values.numbers(12, "position and directors of a node")
    directors = found[3:].reshape(3, 3)
    if abs(directors @ directors.T - numpy.eye(3)).max() > 1e-5 or numpy.linalg.det(directors) < 0.0:
        refuse(place, "the directors must be orthonormal and right-handed")
    return Node(name, found[:3], _orthonormal(directors), place)


def _orthonormal(directors):
    """The nearest rotation: files round."""
    u, _, v = numpy.linalg.svd(directors)
    return u @ v


def read_bodies(path):
    values = Values(path)
    _, (bodies, properties) = values.counts(2, "the number of rigid bodies and of properties")
    nodes, indices = [], []
    for i in range(bodies):
        title = values.comment().split("phi")[0].split(",")[-1].strip()
        nodes.append(read_node(values, title or f"body {i + 1}"))
        indices.append(values.counts(1, "the property of a body"))
    table = [values.numbers(10, "mass and inertia") for _ in range(properties)]
    values.end()
    # some writers count from 0
    first = 0 if any(index == 0 for _, (index,) in indices) else 1
    found = []
    for node, (place, (index,)) in zip(nodes, indices):
        if not first <= index < first + properties:
            refuse(place, f"there is no property {index}: they are numbered {first} to {first + properties - 1}")
        where, mass = table[index - first]
        found.append(Body(node, mass, where))
    return found


def read_beams(path):
    """@return beams, and the sections as (stiffness, mass, dissipation, place, name)"""
    values = Values(path)
    place, words = values.next(2, "the number of beams and of sections")
    beams, sections = (integer(word, place) for word in words[:2])
    voigt = len(words) > 2 and integer(words[2], place) == 1
    if not 0 < beams <= 10**4 or not 0 < sections <= 10**6:
        refuse(place, f"expected numbers of beams and sections, found {beams} and {sections}")
    found = []
    for i in range(beams):
        title = values.comment().split(":")[0].removeprefix("beam").strip()
        name = title or f"beam {i + 1}"
        where, (nodes, elements) = values.counts(2, "the number of nodes and elements")
        at = [read_node(values, "") for _ in range(nodes)]
        properties, start = [], 1
        for k in range(elements):
            line, (first, last, section) = values.counts(3, "two nodes and a section")
            start = first if k == 0 and first == 0 else start  # some writers count from 0
            if (first, last) != (k + start, k + start + 1):
                refuse(line, f"elements must follow each other: {k + start} {k + start + 1}, found {first} {last}")
            properties.append((section, line))
        if nodes != elements + 1 or elements == 0:
            refuse(where, f"a beam of {elements} elements has {elements + 1} nodes, not {nodes}")
        found.append(Beam(name, at, properties, where))
    _count_sections_from_0(found, sections)
    table = []
    for _ in range(sections):
        title = values.comment()
        table.append((*_read_section(values, 21 if voigt else 11), title))
    values.end()
    return found, table, voigt


def _read_section(values, count):
    """Stiffness, mass, dissipation: three lines, or one with all."""
    place, words = values.next(count, "the stiffness of a section")
    if len(words) == count + 8:
        found = numpy.array([number(word, place) for word in words])
        return found[:count], found[count : count + 6], found[count + 6 :], place
    stiffness = numpy.array([number(word, place) for word in words[:count]])
    _, mass = values.numbers(6, "the mass of a section")
    _, dissipation = values.numbers(2, "two factors of dissipation")
    return stiffness, mass, dissipation, place


def _count_sections_from_0(beams, sections):
    """Numbers of sections from 0, whether the file counts from 1 or, where it names a 0, from 0."""
    first = 0 if any(section == 0 for beam in beams for section, _ in beam.properties) else 1
    for beam in beams:
        for section, line in beam.properties:
            if not first <= section < first + sections:
                refuse(line, f"there is no section {section}: they are numbered {first} to {first + sections - 1}")
        beam.properties = [section - first for section, _ in beam.properties]


def read_table(path, numbers_of_nodes, most, least):
    """A count, and so many lines: a word, numbers of nodes, at least and at most so many values."""
    values = Values(path)
    _, (count,) = values.counts(1, "a number of entries")
    rows = []
    for _ in range(count):
        place, words = values.next(1 + numbers_of_nodes + least, "an entry")
        at = [integer(_whole(word), place, "the number of a node") for word in words[1 : 1 + numbers_of_nodes]]
        rest = [number(word, place) for word in words[1 + numbers_of_nodes :][:most]]
        rows.append(Row(words[0], at, numpy.array(rest), place))
    values.end()
    return rows


def _whole(word):
    """0.00 as Fortran takes it where it wants a whole number."""
    return re.sub(r"\.0*([DdEe][-+]?0+)?$", "", word)


def read_loads(path, vectors):
    """Sort, intensity, duration, node and so many values."""
    values = Values(path)
    _, (count,) = values.counts(1, "a number of loads")
    rows = []
    for _ in range(count):
        place, words = values.next(4 + vectors, "sort, intensity, duration, node and the load")
        at = [number(words[1], place), number(words[2], place)]
        rest = [number(word, place) for word in words[4 : 4 + vectors]]
        rows.append(Row(words[0], [integer(words[3], place)], numpy.array([*at, *rest]), place))
    values.end()
    return rows


def read_motions(path):
    """Sort, intensity, duration, number of a constraint, name of a file."""
    values = Values(path)
    _, (count,) = values.counts(1, "a number of boundary conditions")
    rows = []
    for _ in range(count):
        place, words = values.next(4, "sort, intensity, duration, constraint")
        at = numpy.array([number(words[1], place), number(words[2], place)])
        rows.append(Row(words[0], [integer(words[3], place)], at, place, words[4] if len(words) > 4 else ""))
    values.end()
    return rows


def read_springs(path):
    """Springs or dampers: rows with a direction, and the curves as (n, 2) that they name."""
    values = Values(path)
    _, (count, curves) = values.counts(2, "the number of elements and of curves")
    rows = []
    for _ in range(count):
        place, words = values.next(6, "type, node, curve, direction")
        at = [integer(word, place) for word in words[1:3]]
        rows.append(Row(words[0], at, numpy.array([number(word, place) for word in words[3:6]]), place))
    table = []
    for _ in range(curves):
        _, (points,) = values.counts(1, "the number of points")
        table.append(numpy.array([values.numbers(2, "a point of the curve")[1] for _ in range(points)]))
    values.end()
    for row in rows:
        if not 1 <= row.numbers[1] <= curves:
            refuse(row.place, f"there is no curve {row.numbers[1]}: they are numbered 1 to {curves}")
    return rows, table


def read_masses(path):
    values = Values(path)
    _, (count,) = values.counts(1, "the number of point masses")
    rows = []
    for _ in range(count):
        place, words = values.next(2, "node and mass")
        rows.append(Row("mass", [integer(words[0], place)], numpy.array([number(words[1], place)]), place))
    values.end()
    return rows


def read_simulation(path):
    """@return analyses as rows, and gravity"""
    values = Values(path)
    _, names = values.next(1, "the name of the job")
    _, (count,) = values.counts(1, "the number of simulations")
    rows = []
    for _ in range(count):
        place, words = values.next(1, "the kind of a simulation")
        where, settings = values.next(2, "settings of a simulation")
        rows.append(Row(words[0], [], numpy.array([number(word, where) for word in settings]), place))
        values.next(1, "the flag for matrices")
    _, gravity = values.numbers(3, "the gravity vector")
    values.end()
    return names, rows, gravity
