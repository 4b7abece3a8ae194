"""Meshes of Gmsh as it writes them: MSH 2.2 and 4.1, text and binary, elements of first and second order."""

import dataclasses
import pathlib
import re

import numpy

from ..errors import CulmError
from .findings import FILE_ERROR, Place, refuse
from .keyword_file import MOST_BYTES, NUMBER, is_integer

# type of an element -> its number of nodes; others are refused where they are on surfaces
NODES = {1: 2, 2: 3, 3: 4, 8: 3, 9: 6, 10: 9, 15: 1, 16: 8, 4: 4, 5: 8, 6: 6, 7: 5, 11: 10, 12: 27, 17: 20}
POINT, LINES, SURFACES = 15, (1, 8), (2, 3, 9, 10, 16)
MOST = 10**8  # of anything counted


@dataclasses.dataclass
class Element:
    type: int
    nodes: tuple
    groups: list  # (dimension, name) of the physical groups it is in
    place: Place


@dataclasses.dataclass
class Mesh:
    nodes: dict
    elements: list
    version: str
    groups: list  # (dimension, name) in the order of the file


def read_mesh(path):
    return _Reader(pathlib.Path(path)).read()


class _Reader:
    def __init__(self, path):
        if not path.is_file():
            raise CulmError(f"{path}: is not there, or no regular file", FILE_ERROR)
        if path.stat().st_size > MOST_BYTES:
            raise CulmError(f"{path}: is larger than 1 GB", FILE_ERROR)
        self.path = path
        self.data = path.read_bytes()
        self.at = self.counted = self.lines = 0
        self.binary = False
        self.order = "<"
        self.names = {}
        self.physical = {}  # (dimension, entity) -> groups, in version 4
        self.mesh = Mesh({}, [], "", [])

    # words and numbers

    def place(self):
        """Where reading is: the line; counted on from the last call."""
        self.lines += self.data.count(b"\n", self.counted, self.at)
        self.counted = self.at
        return Place(str(self.path), self.lines + 1)

    def fail(self, text):
        refuse(self.place(), text)

    def line(self):
        end = self.data.find(b"\n", self.at)
        if end < 0:
            self.fail("the file ends too early")
        text = self.data[self.at : end].decode("utf-8", "replace").strip()
        self.at = end + 1
        return text

    def word(self):
        while self.at < len(self.data) and self.data[self.at : self.at + 1].isspace():
            self.at += 1
        start = self.at
        while self.at < len(self.data) and not self.data[self.at : self.at + 1].isspace():
            self.at += 1
        if start == self.at:
            self.fail("the file ends too early")
        return self.data[start : self.at].decode("ascii", "replace")

    def numbers(self, count, kind):
        """So many numbers. @param kind  i4, u8 or f8 in binary files"""
        if not 0 <= count <= MOST:
            self.fail(f"{count} numbers cannot be")
        if self.binary:
            size = count * int(kind[1])
            if self.at + size > len(self.data):
                self.fail("the file ends too early")
            found = numpy.frombuffer(self.data, self.order + kind, count, self.at)
            self.at += size
            return found.tolist()
        return [self._number(kind) for _ in range(count)]

    def _number(self, kind):
        word = self.word()
        good = re.fullmatch(NUMBER, word.upper()) if kind == "f8" else re.fullmatch(r"-?[0-9]{1,18}", word)
        if not good:
            self.fail(f"expected a number, found '{word[:40]}'")
        return float(word) if kind == "f8" else int(word)

    # sections

    def read(self):
        if self.line() != "$MeshFormat":
            refuse(Place(str(self.path), 1), "expected $MeshFormat: this is no mesh of Gmsh")
        words = self.line().split()
        if len(words) != 3 or words[0] not in ("2.2", "4.1"):
            self.fail(f"is in the format MSH {' '.join(words)}; 2.2 and 4.1 are read")
        self.mesh.version = words[0] + (" binary" if words[1] == "1" else " text")
        self.binary = words[1] == "1"
        if words[1] not in ("0", "1") or words[2] != "8":
            self.fail(f"expected file type 0 or 1 and data size 8, found {words[1]} and {words[2]}")
        if self.binary:
            one = self.data[self.at : self.at + 4]
            if one not in (b"\1\0\0\0", b"\0\0\0\1"):
                self.fail("the mark of the byte order is missing")
            self.order = "<" if one == b"\1\0\0\0" else ">"
            self.at += 4
        self.end("MeshFormat")
        old = words[0] == "2.2"
        actions = {
            "PhysicalNames": self.physical_names,
            "Entities": self.entities,
            "PartitionedEntities": self.partitioned_entities,
            "Nodes": self.nodes_2 if old else self.nodes_4,
            "Elements": self.elements_2 if old else self.elements_4,
        }
        while self.data[self.at :].strip():
            section = self.line()
            if not section:
                continue
            if not section.startswith("$"):
                self.fail(f"expected the start of a section, found '{section[:40]}'")
            action = actions.get(section[1:])
            if action is None:
                self.skip(section[1:])
            else:
                action()
                self.end(section[1:])
        if not self.mesh.elements:
            self.fail("there are no elements in the mesh")
        for element in self.mesh.elements:
            for node in element.nodes:
                if node not in self.mesh.nodes:
                    refuse(element.place, f"there is no node {node}")
        return self.mesh

    def end(self, section):
        found = self.line() or self.line()
        if found != f"$End{section}":
            self.fail(f"expected $End{section}, found '{found[:40]}'")

    def skip(self, section):
        mark = f"$End{section}".encode()
        end = self.data.find(mark, self.at)
        if end < 0:
            self.fail(f"${section} has no end")
        self.at = end
        self.line()

    def physical_names(self):
        for _ in range(self._count(self.line())):
            words = self.line().split(None, 2)
            if len(words) != 3 or not is_integer(words[0]) or not is_integer(words[1]) or words[2][:1] != '"':
                self.fail("expected dimension, number and name of a physical group")
            self.names[(int(words[0]), int(words[1]))] = words[2].strip('"')
        self.mesh.groups = [(dimension, name) for (dimension, _), name in self.names.items()]

    def _count(self, text):
        if not is_integer(text) or not 0 <= int(text) <= MOST:
            self.fail(f"expected a count, found '{text[:40]}'")
        return int(text)

    def group(self, dimension, number):
        name = self.names.get((dimension, number), str(number))
        if (dimension, name) not in self.mesh.groups:
            self.mesh.groups.append((dimension, name))
        return dimension, name

    def entities(self):
        self._entities(is_partitioned=False)

    def partitioned_entities(self):
        self.numbers(1, "u8")
        ghosts = self.numbers(1, "u8")[0]
        self.numbers(2 * ghosts, "i4")
        self._entities(is_partitioned=True)

    def _entities(self, is_partitioned):
        """Of a mesh in parts each with the entity and the parts that it belongs to."""
        counts = self.numbers(4, "u8")
        for dimension, count in enumerate(counts):
            for _ in range(count):
                (tag,) = self.numbers(1, "i4")
                if is_partitioned:
                    self.numbers(2, "i4")
                    self.numbers(self.numbers(1, "u8")[0], "i4")
                self.numbers(3 if dimension == 0 else 6, "f8")
                numbers = self.numbers(self.numbers(1, "u8")[0], "i4")
                self.physical[(dimension, tag)] = [self.group(dimension, abs(number)) for number in numbers]
                if dimension:
                    self.numbers(self.numbers(1, "u8")[0], "i4")
        self._line_end()

    def _line_end(self):
        """What follows the last number of a section."""
        if not self.binary:
            self.line()

    def add_node(self, number, place):
        if number in self.mesh.nodes:
            self.fail(f"node {number} is there twice")
        position = numpy.array(place)
        if not numpy.isfinite(position).all():
            self.fail(f"the place of node {number} is not finite")
        self.mesh.nodes[number] = position

    def nodes_2(self):
        for _ in range(self._count(self.line())):
            (number,) = self.numbers(1, "i4")
            self.add_node(number, self.numbers(3, "f8"))
        self._line_end()

    def nodes_4(self):
        blocks, total, _, _ = self.numbers(4, "u8")
        for _ in range(blocks):
            dimension, _, parametric = self.numbers(3, "i4")
            (count,) = self.numbers(1, "u8")
            if not 0 <= dimension <= 3 or parametric not in (0, 1):
                self.fail("the head of a block of nodes is wrong")
            tags = self.numbers(count, "u8")
            for tag in tags:
                self.add_node(tag, self.numbers(3 + (dimension if parametric else 0), "f8")[:3])
        if len(self.mesh.nodes) != total:
            self.fail(f"{total} nodes are announced, {len(self.mesh.nodes)} are there")
        self._line_end()

    def add_element(self, type, nodes, groups, place):
        if type in LINES or type in SURFACES or type == POINT:
            self.mesh.elements.append(Element(type, tuple(nodes), groups, place))
        else:
            refuse(place, f"elements of type {type} are solids, which culm does not have")

    def size(self, type):
        if type not in NODES:
            self.fail(f"elements of type {type} are not read; those of first and second order are")
        return NODES[type]

    def elements_2(self):
        total = self._count(self.line())
        done = 0
        while done < total:
            if self.binary:
                type, count, tags = self.numbers(3, "i4")
                if count < 1 or done + count > total:
                    self.fail(f"a block of {count} elements does not fit")
            else:
                count = 1
            for _ in range(count):
                place = self.place() if not self.binary else Place(str(self.path), done + 1)
                (number,) = self.numbers(1, "i4")
                if not self.binary:
                    type, tags = self.numbers(2, "i4")
                if not 0 <= tags <= 1000:
                    self.fail(f"element {number} has {tags} tags")
                found = self.numbers(tags, "i4")
                dimension = 0 if type == POINT else 1 if type in LINES else 2
                groups = [self.group(dimension, abs(found[0]))] if found and found[0] else []
                self.add_element(type, self.numbers(self.size(type), "i4"), groups, place)
                done += 1
        self._line_end()

    def elements_4(self):
        blocks, total, _, _ = self.numbers(4, "u8")
        done = 0
        for _ in range(blocks):
            dimension, entity, type = self.numbers(3, "i4")
            (count,) = self.numbers(1, "u8")
            groups = self.physical.get((dimension, entity), [])
            size = self.size(type)
            for _ in range(count):
                place = self.place() if not self.binary else Place(str(self.path), done + 1)
                self.add_element(type, self.numbers(1 + size, "u8")[1:], groups, place)
                done += 1
        if done != total:
            self.fail(f"{total} elements are announced, {done} are there")
        self._line_end()
