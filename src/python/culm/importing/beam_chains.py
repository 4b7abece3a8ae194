"""Beam elements of one section that follow each other as one beam of the deck."""

import collections

import numpy

from .findings import refuse

SAME_TANGENT = 1e-9  # culm puts two nodes at a kink of more than this; see packages/beam/src/axis.cpp
UNSURE = (1e-10, 1e-8)  # kinks about which two programs may differ
PARALLEL = 1e-3


class BeamChain:
    """@param nodes     of the file, from start to end
    @param elements  places in model.beams of each segment"""

    def __init__(self, name, section, up, nodes, elements, positions):
        self.name = name
        self.section = section
        self.up = up
        self.nodes = nodes
        self.elements = elements
        self.positions = numpy.array([positions[node] for node in nodes])
        steps = numpy.diff(self.positions, axis=0)
        self.lengths = numpy.linalg.norm(steps, axis=1)
        self.tangents = steps / self.lengths[:, None]
        kinks = numpy.linalg.norm(numpy.diff(self.tangents, axis=0), axis=1) >= SAME_TANGENT
        # elements are of order 2, and a kink has a node on either side
        before = numpy.concatenate([[0, 0], numpy.cumsum(kinks)])
        self.numbers = [int(2 * i + before[i]) for i in range(len(nodes))]

    def node_name(self, index):
        if index == 0:
            return f"{self.name}/first"
        if index == len(self.nodes) - 1:
            return f"{self.name}/last"
        return f"{self.name}/{self.numbers[index]}"


def beam_chains(model):
    """All beam elements as chains, in the order of the file."""
    groups = collections.defaultdict(list)
    for i, element in enumerate(model.beams):
        groups[(element.section, tuple(element.up))].append(i)
    chains = []
    for (section, up), members in groups.items():
        for nodes, elements in _walks(model, members):
            name = f"{section} beam {len(chains) + 1}"
            chains.append(BeamChain(name, section, up, nodes, elements, model.nodes))
    return chains


def _segments(model, members):
    """(start, end, element) for each straight piece."""
    for i in members:
        element = model.beams[i]
        nodes = element.nodes if len(element.nodes) == 2 else (element.nodes[0], element.nodes[2], element.nodes[1])
        for a, b in zip(nodes, nodes[1:]):
            step = model.nodes[b] - model.nodes[a]
            length = numpy.linalg.norm(step)
            if length == 0.0:
                refuse(element.place, f"beam element {element.number} has no length")
            up = numpy.array(element.up, float)
            if numpy.linalg.norm(numpy.cross(step, up)) <= PARALLEL * length * numpy.linalg.norm(up):
                refuse(element.place, f"the direction of the section of beam element {element.number} is along its axis")
            yield a, b, i


def _walks(model, members):
    """Chains as long as they can be: through nodes where one piece ends and one begins."""
    leaving, arriving = collections.defaultdict(list), collections.defaultdict(list)
    pieces = list(_segments(model, members))
    for piece in pieces:
        leaving[piece[0]].append(piece)
        arriving[piece[1]].append(piece)

    def goes_through(node):
        if len(leaving[node]) != 1 or len(arriving[node]) != 1:
            return False
        (a, b, _), (_, c, _) = arriving[node][0], leaving[node][0]
        kink = _kink(model.nodes[a], model.nodes[b], model.nodes[c])
        return not UNSURE[0] < kink < UNSURE[1] and kink < 1.9

    done = set()
    starts = [piece for piece in pieces if not goes_through(piece[0])]
    for start in [*starts, *pieces]:  # what is left after the first are rings
        if start in done:
            continue
        nodes, elements, piece = [start[0]], [], start
        while True:
            done.add(piece)
            nodes.append(piece[1])
            elements.append(piece[2])
            if not goes_through(piece[1]) or leaving[piece[1]][0] in done:
                break
            piece = leaving[piece[1]][0]
        yield nodes, elements


def _kink(a, b, c):
    one, other = b - a, c - b
    return numpy.linalg.norm(one / numpy.linalg.norm(one) - other / numpy.linalg.norm(other))
