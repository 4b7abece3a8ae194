"""Where nodes of the file are in the deck: the nodes of structures that stand for each."""

import collections
import dataclasses
import typing

import numpy

from .beam_chains import BeamChain
from .deck_text import safe_name, unique_name
from .shell_parts import ShellPart

SMOOTH = 1e-6  # directors of two shells that go on into each other differ by less


@dataclasses.dataclass
class Spot:
    """A node of the file in one structure of the deck.

    @param structure  a BeamChain, a ShellPart, or the name of a rigid body
    @param index      of the node in a beam"""

    structure: typing.Union[BeamChain, ShellPart, str]
    index: int = 0

    @property
    def is_shell(self):
        return isinstance(self.structure, ShellPart)


class Places:
    """Nodes of the file by the structures of the deck, and names for several of them."""

    def __init__(self, chains, parts):
        self.spots = collections.defaultdict(list)  # of each node, the leading one first
        self.sets = {}  # entries of Node Sets
        self._names = {}  # of nodes that have been named
        for chain in chains:
            for index, node in enumerate(chain.nodes):
                self.spots[node].append(Spot(chain, index))
        for part in parts:
            for node in part.points:
                self.spots[node].append(Spot(part))
        self._structures = {chain.name for chain in chains} | {part.name for part in parts}

    def add_body(self, node, name):
        """A rigid body at a node of the file; it leads what else is there."""
        self.spots[node].insert(0, Spot(name))
        self._structures.add(name)

    def unique_structure(self, name):
        return unique_name(name, self._structures)

    def leader(self, node):
        return self.spots[node][0]

    def copies(self, node):
        """How many nodes of the deck a force on the node is shared by."""
        spot = self.leader(node)
        return len(spot.structure.nodes[node]) if spot.is_shell else 1

    def names(self, nodes, name, spot_of=None):
        """Names that stand for the nodes, one for each structure and as few as possible.

        @param name     for sets that are made
        @param spot_of  the structure that is meant for a node; the leading one if None"""
        spot_of = spot_of or self.leader
        in_parts, names = collections.defaultdict(list), []
        for node in nodes:
            spot = spot_of(node)
            if spot.is_shell:
                in_parts[spot.structure.name].append((spot.structure, node))
            elif isinstance(spot.structure, BeamChain):
                names.append(spot.structure.node_name(spot.index))
            else:
                names.append(spot.structure)
        for members in in_parts.values():
            part = members[0][0]
            points = sorted(part.points[node] for _, node in members)
            names.append(f"{part.name}/{self._point_set(part, points, name)}")
        return names

    def one_name(self, nodes, name, spot_of=None):
        """One name that stands for all the nodes: of a node, a set of a shell, or an entry of Node
        Sets, which is made."""
        names = self.names(nodes, name, spot_of)
        return names[0] if len(names) == 1 else self.set_of(names, name)

    def set_of(self, names, name):
        """An entry of Node Sets with these names."""
        key = tuple(names)
        if key not in self._names:
            taken = self._structures | set(self.sets)
            self._names[key] = unique_name(name, taken)
            self.sets[self._names[key]] = list(names)
        return self._names[key]

    def _point_set(self, part, points, name):
        key = (part.name, tuple(points))
        if key not in self._names:
            self._names[key] = unique_name(safe_name(name), set(part.point_sets) | {"all", "first", "last"})
            part.point_sets[self._names[key]] = points
        return self._names[key]


def directors(spot, node):
    """Directors of the shell nodes at a node of the file: (n, 3)."""
    return numpy.array([one.director for one in spot.structure.nodes[node]])


def is_smooth(one, other, node):
    """Whether two shells go on into each other at a node of the file."""
    a, b = directors(one, node), directors(other, node)
    return len(a) == len(b) == 1 and numpy.linalg.norm(a[0] - b[0]) < SMOOTH
