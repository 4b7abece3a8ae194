"""Shell elements of one wall as one shell of the deck, with its mesh in a Gmsh file.

culm gives a point on a fold one node for each side. How many nodes a point gets and with which
director is found here in the same way (packages/shell/src/shell_mesh.cpp), because forces are
shared by the nodes of a point, and rotations of the file are directions of a director.
"""

import collections
import dataclasses

import numpy

from .findings import refuse
from .model import Layer, Wall
from .quads import area, corner_normals

FOLD_ANGLE = numpy.radians(20.0)
FOLD_RANGE = numpy.radians([12.0, 35.0])  # where another angle is taken if a mesh has this one
SAME_PLACE = 1e-6  # of the shortest edge; nearer points are one for culm
PARALLEL = numpy.sin(numpy.radians(0.1))  # axis and normal of a wall
CLEAR = 0.2  # sine of axis and normal, for an axis that is to serve many elements
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
ANGLE_STEP = 1e-3  # degrees; layers whose angles differ by less are one wall
MOST_WALLS = 1000


@dataclasses.dataclass
class ShellNode:
    number: int  # in the structure
    director: numpy.ndarray


class ShellPart:
    """@param nodes  ShellNodes of each point, by its number in the file"""

    def __init__(self, name, wall, quads, elements, positions, axis):
        self.name = name
        self.wall = wall
        self.axis = axis
        self.quads = quads
        self.elements = elements  # places in model.shells
        points = list(dict.fromkeys(node for quad in quads for node in quad))
        self.points = {node: i for i, node in enumerate(points)}
        self.positions = numpy.array([positions[node] for node in points])
        self.corners = numpy.array([[self.points[node] for node in quad] for quad in quads])
        self.point_sets = {}  # name -> numbers of points
        self.line_sets = {}  # name -> pairs of them
        self.quad_sets = {}  # name -> numbers of quadrilaterals
        self._join_points()
        self._number_nodes()
        self.nodes = {node: self._at[self._first[i]] for node, i in self.points.items()}

    def area(self):
        return area(self.positions[self.corners]).sum()

    def shared_places(self):
        """Pairs of nodes of the file that lie at one place."""
        points = list(self.points)
        return [(points[i], points[first]) for i, first in enumerate(self._first) if first != i]

    def _join_points(self):
        corners = self.positions[self.corners]
        edges = numpy.linalg.norm(numpy.roll(corners, -1, axis=1) - corners, axis=2)
        self.shortest_edge = edges.min()
        self._first = numpy.arange(len(self.positions))
        tolerance = SAME_PLACE * self.shortest_edge
        if tolerance > 0.0:
            from scipy.spatial import cKDTree  # a third of a second, and models of beams do without

            for i, j in sorted(cKDTree(self.positions).query_pairs(tolerance)):
                self._first[j] = min(self._first[j], self._first[i])

    def _number_nodes(self):
        at = self._first[self.corners]
        normals = corner_normals(self.positions[self.corners])
        parent = list(range(4 * len(at)))

        def find(i):
            while parent[i] != i:
                parent[i] = parent[parent[i]]
                i = parent[i]
            return i

        pairs = _neighbours(at)
        angles = numpy.array([_angle(normals[a // 4, a % 4], normals[b // 4, b % 4]) for a, b in pairs])
        self.fold_angle = _clear_angle(angles)
        for (a, b), angle in zip(pairs, angles):
            if angle <= self.fold_angle:
                a, b = find(a), find(b)
                parent[max(a, b)] = min(a, b)
        numbers, directors = {}, []
        self._at = collections.defaultdict(list)
        for q, quad in enumerate(at):
            for c, point in enumerate(quad):
                root = find(4 * q + c)
                if root not in numbers:
                    numbers[root] = len(directors)
                    directors.append(numpy.zeros(3))
                    self._at[point].append(ShellNode(numbers[root], directors[-1]))
                directors[numbers[root]] += normals[q, c]
        for director in directors:
            length = numpy.linalg.norm(director)
            director /= length if length > 0.0 else 1.0
        self.size = len(directors)

    def _draw_rims(self):
        """Sets of points that lie along the rim become its lines, so that a finer mesh is held between them."""
        users = collections.Counter()
        for quad in self.corners.tolist():
            users.update(frozenset((quad[c], quad[(c + 1) % 4])) for c in range(4))
        rim = [tuple(sorted(edge)) for edge, count in users.items() if count == 1 and len(edge) == 2]
        alone = {self.points[node] for node, copies in self.nodes.items() if len(copies) == 1}
        for name, points in list(self.point_sets.items()):
            chosen = set(points)
            lines = sorted(edge for edge in rim if chosen >= set(edge))
            if name not in self.line_sets and chosen <= alone and {end for line in lines for end in line} == chosen:
                self.line_sets[name] = lines
                del self.point_sets[name]

    def mesh_text(self, comment):
        """The mesh as a Gmsh file (MSH 2.2), with physical points and surfaces for sets."""
        # an element has one physical group, so one that is in several sets stands for each
        self._draw_rims()
        points, lines, quads = sorted(self.point_sets), sorted(self.line_sets), sorted(self.quad_sets)
        text = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Comments", comment, "$EndComments"]
        names = [(0, points), (1, lines), (2, quads)]
        text += ["$PhysicalNames", str(sum(len(sets) for _, sets in names))]
        text += [f'{dimension} {i + 1} "{name}"' for dimension, sets in names for i, name in enumerate(sets)]
        text += ["$EndPhysicalNames", "$Nodes", str(len(self.positions))]
        text += [f"{i + 1} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(self.positions.tolist())]
        elements = [
            f"15 2 {group + 1} {group + 1} {point + 1}"
            for group, name in enumerate(points)
            for point in self.point_sets[name]
        ]
        elements += [
            f"1 2 {group + 1} {group + 1} {a + 1} {b + 1}"
            for group, name in enumerate(lines)
            for a, b in self.line_sets[name]
        ]
        group_of = {q: i + 1 for i, name in enumerate(quads) for q in self.quad_sets[name]}
        for q, quad in enumerate(self.corners.tolist()):
            group = group_of.get(q, 0)
            elements.append(f"3 2 {group} {group} " + " ".join(str(point + 1) for point in quad))
        text += ["$EndNodes", "$Elements", str(len(elements))]
        text += [f"{i + 1} {element}" for i, element in enumerate(elements)]
        return "\n".join([*text, "$EndElements"]) + "\n"


def shell_parts(model, quads):
    """One part for each wall of isotropic layers. Of other walls, elements with the same layers at
    the same angles from one axis make a part, whichever sections of the file they have."""
    groups = collections.defaultdict(list)
    for q, element in enumerate(quads.elements):
        groups[model.shells[element].wall].append(q)
    parts, directed = [], []
    for name, members in groups.items():
        if is_isotropic(model.walls[name], model):
            parts.append(_part(model, quads, name, model.walls[name], None, members))
        else:
            directed += members
    for axis, layers, members in _by_layers(model, quads, directed):
        name = model.shells[quads.elements[members[0]]].wall
        wall = Wall(layers, model.walls[name].place)
        parts.append(_part(model, quads, name, wall, axis, members))
    return parts


def _part(model, quads, name, wall, axis, members):
    chosen, elements = [quads.quads[q] for q in members], [quads.elements[q] for q in members]
    return ShellPart(name, wall, chosen, elements, quads.positions, axis)


def is_isotropic(wall, model):
    return all(model.materials[layer.material].type == "Isotropic" for layer in wall.layers)


def _by_layers(model, quads, members):
    """(axis, layers, quadrilaterals) with as few groups as one axis for all can have."""
    if not members:
        return []
    points = numpy.array([[quads.positions[node] for node in quads.quads[q]] for q in members])
    normals = numpy.cross(points[:, 2] - points[:, 0], points[:, 3] - points[:, 1])
    lengths = numpy.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / numpy.where(lengths > 0.0, lengths, 1.0)
    walls = [model.walls[model.shells[quads.elements[q]].wall] for q in members]
    axes = [_axis_on(wall, normal, model, quads, q) for wall, normal, q in zip(walls, normals, members)]
    best = None
    for candidate in dict.fromkeys([*AXES, *(tuple(map(float, wall.axis)) for wall in walls if wall.axis)]):
        along = _projected(numpy.array(candidate), normals)
        if numpy.linalg.norm(along, axis=1).min() < CLEAR:
            continue
        # from the candidate to the axis of the wall, about the normal
        turns = _degrees(along, _projected(numpy.array(axes), normals), normals)
        groups = collections.defaultdict(list)
        for q, wall, turn in zip(members, walls, turns):
            groups[_turned_layers(wall, turn)].append(q)
        if best is None or len(groups) < len(best[1]):
            best = candidate, groups
    if best is None:  # a closed surface: no axis serves all, so each half has its own
        steep = abs(normals[:, 2]) > 0.8
        halves = ([q for q, s in zip(members, steep) if s], [q for q, s in zip(members, steep) if not s])
        return [group for half in halves for group in _by_layers(model, quads, half)]
    axis, groups = best
    if len(groups) > MOST_WALLS:
        place = model.shells[quads.elements[members[0]]].place
        refuse(place, f"the layers have more than {MOST_WALLS} different angles on the surface")
    return [(axis, [Layer(*layer) for layer in layers], quads_) for layers, quads_ in groups.items()]


def _axis_on(wall, normal, model, quads, q):
    """The axis of the wall, or the one that stands in its place where it is normal to the surface."""
    element = model.shells[quads.elements[q]]
    given = element.axis or wall.axis
    if given is None:
        refuse(element.place, "layers with directions need an axis that their angles count from")
    axis = numpy.array(given, float)
    if numpy.linalg.norm(numpy.cross(axis, normal)) > PARALLEL * numpy.linalg.norm(axis):
        return axis
    if wall.fallback is None:
        refuse(element.place, f"the axis of the material, {given}, is normal to this element")
    return numpy.array(wall.fallback, float)


def _projected(vectors, normals):
    vectors = numpy.broadcast_to(vectors, normals.shape)
    return vectors - (vectors * normals).sum(axis=1, keepdims=True) * normals


def _degrees(a, b, normals):
    """From a to b about the normals."""
    return numpy.degrees(numpy.arctan2((numpy.cross(a, b) * normals).sum(axis=1), (a * b).sum(axis=1)))


def _turned_layers(wall, turn):
    """Layers with angles from another axis, of which half a turn means nothing."""

    def angle(layer):
        steps = round((layer.angle + turn) / ANGLE_STEP)
        half = round(180.0 / ANGLE_STEP)
        steps = (steps + half // 2 - 1) % half - half // 2 + 1
        return round(steps * ANGLE_STEP, 9)

    return tuple((layer.thickness, layer.material, angle(layer)) for layer in wall.layers)


def _neighbours(at):
    """Pairs of corners, as 4 quad + corner, at both ends of each common edge."""
    sides = collections.defaultdict(list)
    for q, quad in enumerate(at.tolist()):
        for c in range(4):
            a, b = quad[c], quad[(c + 1) % 4]
            sides[(min(a, b), max(a, b))].append((q, c))
    pairs = []
    for ends, users in sides.items():
        for i in range(len(users)):
            for j in range(i):
                for end in ends:
                    pairs.append(tuple(_corner_at(at, *users[k], end) for k in (i, j)))
    return pairs


def _corner_at(at, quad, side, end):
    return 4 * quad + (side if at[quad, side] == end else (side + 1) % 4)


def _angle(a, b):
    return numpy.arctan2(numpy.linalg.norm(numpy.cross(a, b)), a @ b)


def _clear_angle(angles):
    """The usual fold angle, or one near it that is far from any angle of the mesh."""
    near = angles[(angles > FOLD_RANGE[0]) & (angles < FOLD_RANGE[1])]
    if not near.size or abs(near - FOLD_ANGLE).min() > 1e-3:
        return FOLD_ANGLE
    ends = numpy.unique(numpy.concatenate([FOLD_RANGE, near]))
    widest = numpy.diff(ends).argmax()
    return 0.5 * (ends[widest] + ends[widest + 1])
