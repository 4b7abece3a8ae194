"""Shell elements of any kind as four-node quadrilaterals that meet node to node."""

import numpy

# Where the point in the middle of an element lies, as weights of corners and of nodes between.
MIDDLE_WEIGHTS = {3: (1 / 3, 0.0), 4: (1 / 4, 0.0), 6: (-1 / 9, 4 / 9), 8: (-1 / 4, 1 / 2)}


class Quads:
    """All quadrilaterals of a model.

    quads      four numbers of nodes each
    elements   the place of each in model.shells
    positions  of all nodes, of those that were added as well
    """

    def __init__(self, model):
        self.model = model
        self.positions = model.nodes
        self.quads = []
        self.elements = []
        self._shapes = [_shape(element) for element in model.shells]
        self.is_split = any(len(shape) != 4 for shape in self._shapes)
        if self.is_split:
            self.positions = dict(model.nodes)
            self._between = self._known_between()
            self._splits = [self._split(shape) for shape in self._shapes]
            self._boundary = _boundary(self._shapes)
            _say_what_was_split(self._shapes, model)
        else:
            self.quads = list(self._shapes)
            self.elements = list(range(len(self.quads)))

    def with_added(self, nodes):
        """Nodes of the file and those that were added between them: on free edges with both ends
        among the nodes, and within elements that are among them as a whole."""
        nodes = list(dict.fromkeys(nodes))
        if not self.is_split:
            return nodes
        known, added = set(nodes), {}
        for shape, (between, middle) in zip(self._shapes, self._splits):
            corners = shape[: _corners(shape)]
            inside = [corner in known for corner in corners]
            if sum(inside) < 2:
                continue
            whole = all(inside)
            for i, node in enumerate(between):
                ends = inside[i] and inside[(i + 1) % len(corners)]
                edge = frozenset((corners[i], corners[(i + 1) % len(corners)]))
                if ends and (whole or edge in self._boundary):
                    added[node] = None
            if whole:
                added[middle] = None
        return nodes + [node for node in added if node not in known and node not in self.model.nodes]

    def pieces(self, line):
        """A line of two or three nodes, the one between last, as edges of quadrilaterals."""
        a, b = line[:2]
        middle = self._between.get(frozenset((a, b))) if self.is_split else None
        return [(a, b)] if middle is None else [(a, middle), (middle, b)]

    def _known_between(self):
        """The node between two corners, where an element of second order has one."""
        known = {}
        for shape in self._shapes:
            n = _corners(shape)
            for i in range(n if len(shape) > 4 else 0):
                known[frozenset((shape[i], shape[(i + 1) % n]))] = shape[n + i]
        return known

    def _split(self, shape):
        n = _corners(shape)
        between = [self._node_between(shape[i], shape[(i + 1) % n]) for i in range(n)]
        if len(shape) == 9:
            middle = shape[8]
        else:
            middle = ("middle of", *map(str, shape[:n]), len(self.quads))
            corner, side = MIDDLE_WEIGHTS[len(shape)]
            place = corner * sum(self.positions[node] for node in shape[:n])
            if len(shape) > 4:
                place = place + side * sum(self.positions[node] for node in shape[n : 2 * n])
            self.positions[middle] = place
        number = 0 if not self.elements else self.elements[-1] + 1
        for i in range(n):
            self.quads.append((shape[i], between[i], middle, between[i - 1]))
            self.elements.append(number)
        return between, middle

    def _node_between(self, a, b):
        edge = frozenset((a, b))
        node = self._between.get(edge)
        if node is None:
            node = ("between", str(a), str(b))
            self.positions[node] = 0.5 * (self.positions[a] + self.positions[b])
            self._between[edge] = node
        return node


def corner_normals(points):
    """Normals at the corners of quadrilaterals, by their own edges: (n, 4, 3) from (n, 4, 3)."""
    ahead = numpy.roll(points, -1, axis=1) - points
    back = numpy.roll(points, 1, axis=1) - points
    normals = numpy.cross(ahead, back)
    lengths = numpy.linalg.norm(normals, axis=2, keepdims=True)
    return normals / numpy.where(lengths > 0.0, lengths, 1.0)


def area(points):
    """Of quadrilaterals, flat or warped a little: half the cross product of the diagonals."""
    diagonals = numpy.cross(points[:, 2] - points[:, 0], points[:, 3] - points[:, 1])
    return 0.5 * numpy.linalg.norm(diagonals, axis=1)


def _corners(shape):
    return 3 if len(shape) in (3, 6) else 4


def _shape(element):
    """The nodes of an element; a quadrilateral with two corners at one node is a triangle."""
    nodes = element.nodes
    if len(nodes) == 4 and len(set(nodes)) == 3:
        return tuple(dict.fromkeys(nodes))
    return tuple(nodes)


def _boundary(shapes):
    users = {}
    for shape in shapes:
        n = _corners(shape)
        for i in range(n):
            edge = frozenset((shape[i], shape[(i + 1) % n]))
            users[edge] = users.get(edge, 0) + 1
    return {edge for edge, count in users.items() if count == 1}


def _say_what_was_split(shapes, model):
    names = {
        3: "triangles of three nodes became three quadrilaterals each",
        6: "triangles of six nodes became three quadrilaterals each",
        4: "quadrilaterals of four nodes became four each, to fit their neighbours",
        8: "quadrilaterals of eight nodes became four each",
        9: "quadrilaterals of nine nodes became four each",
    }
    for size, sentence in names.items():
        places = [e.place for e, shape in zip(model.shells, shapes) if len(shape) == size]
        if places:
            model.findings.assume(f"{len(places)} {sentence}", places[0])
