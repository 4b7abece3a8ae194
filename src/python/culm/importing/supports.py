"""Degrees of freedom of a file, held one by one, as supports of the deck."""

import collections

import numpy

from .model import Support
from .places import directors, is_smooth

UNIT = numpy.eye(3)
TRANSLATIONS, ROTATIONS = {1, 2, 3}, {4, 5, 6}
DRILLING = 0.05  # sine of axis and director, below which a rotation is one about the director


def add_supports(model, places, quads, constraints):
    """Supports of the model to the list Constraints. @return names by step: {name: steps or None}"""
    steps_of = {}
    for support in [*model.supports, *_between(model, quads)]:
        for name in _add_support(support, model, places, quads, constraints):
            steps_of[name] = support.steps
    return steps_of


def _between(model, quads):
    """Supports of nodes that were added between those of several supports, as files have them that hold node by
    node: of each degree of freedom that both ends have alike."""
    if not quads.is_split:
        return []
    holders, all_holders = collections.defaultdict(list), collections.defaultdict(list)
    has, places = collections.defaultdict(set), {}
    for support in model.supports:
        when = None if support.steps is None else frozenset(support.steps)
        axes = None if support.axes is None else tuple(_rounded(support.axes.ravel()))
        for i, value in support.held.items():
            holders[(i, value, axes, when)] += support.nodes
            all_holders[(i, when)] += support.nodes
            places.setdefault((i, value, axes, when), support.place)
            places.setdefault((i, when), support.place)
        if len(support.nodes) > 1:
            for node in _added(quads, support.nodes):
                has[node] |= {(i, when) for i in support.held}
    found = collections.defaultdict(dict)
    for (i, value, axes, when), nodes in holders.items():
        for node in _added(quads, nodes):
            if (i, when) not in has[node]:
                found[(node, axes, when)][i] = value
    for (node, axes, when), held in found.items():
        has[node] |= {(i, when) for i in held}
    for (i, when), nodes in all_holders.items():
        if any((i, when) not in has[node] for node in _added(quads, nodes)):
            text = "nodes that were added between supported ones are free where those are held along other axes"
            model.findings.assume(f"{text}, or moved otherwise", places[(i, when)])
    groups = collections.defaultdict(list)
    for (node, axes, when), held in found.items():
        groups[(tuple(sorted(held.items())), axes, when)].append(node)
    made = []
    for (held, axes, when), nodes in groups.items():
        rows = None if axes is None else numpy.reshape(axes, (3, 3))
        steps = None if when is None else set(when)
        made.append(Support(nodes, dict(held), places[(*held[0], axes, when)], "between", steps, rows))
    return made


def _added(quads, nodes):
    known = set(nodes)
    return [node for node in quads.with_added(nodes) if node not in known]


def _add_support(support, model, places, quads, constraints):
    nodes = [node for node in quads.with_added(support.nodes) if places.spots.get(node)]
    lost = [node for node in support.nodes if not places.spots.get(node)]
    if lost:
        model.findings.leave_out(f"supports of nodes that belong to no element, as {lost[0]}", support.place)
    shells = [node for node in nodes if places.leader(node).is_shell]
    others = [node for node in nodes if not places.leader(node).is_shell]
    made = []
    if others:
        made += _hold(others, _of_triads(support.held, _axes(support)), support, places, constraints)
    groups = collections.defaultdict(list)
    for node in shells:
        groups[_of_shell(support, node, places, model)].append(node)
    for kinds, members in groups.items():
        made += _hold(members, [_entry(kind) for kind in kinds], support, places, constraints)
    return made


def _hold(nodes, entries, support, places, constraints):
    """One constraint for each entry (type, values, numbers): on all nodes, or on single nodes of
    shells by number, where a point has several."""
    made = []
    for type, values, only in entries:
        if only is None:
            target = places.one_name(nodes, support.name)
        else:
            target = places.set_of([f"{part}/{number}" for part, number in only], support.name)
        name = _free_name(support.name, constraints)
        entry = constraints.list(name, f"{support.place}", type).add("Node", target)
        for key, value in values.items():
            entry.add(key, value)
        made.append(name)
    return made


def _free_name(name, constraints):
    taken = {one.name for one in constraints.lists()}
    number = 1
    while f"{name} {number}" in taken:
        number += 1
    return f"{name} {number}"


def _axes(support):
    return UNIT if support.axes is None else support.axes


def _entry(kind):
    type, values, only = kind
    return type, dict(values), only


def _of_triads(held, axes):
    """Entries for nodes with a triad: beams and bodies."""
    moving = any(held.values())
    at = set(held)
    if not moving:
        if at >= TRANSLATIONS | ROTATIONS:
            return [("Rigid Support", {}, None)]
        if at >= TRANSLATIONS and len(at & ROTATIONS) == 2:
            (free,) = ROTATIONS - at
            return [("Revolute Support", {"Axis": axes[free - 4]}, None)]
    entries = []
    left = dict(held)
    for i in (1, 2, 3):
        across = ROTATIONS - {i + 3}
        if not moving and i in left and across <= set(left) and not TRANSLATIONS <= at:
            entries.append(("Symmetry", {"Normal": axes[i - 1]}, None))
            for one in (i, *across):
                del left[one]
    entries += _translations(left, axes)
    for i in sorted(ROTATIONS & set(left)):
        values = {"Axis": axes[i - 4]}
        if left[i]:
            values["Angle"] = left[i]
        entries.append(("Rotation", values, None))
    return entries


def _translations(held, axes):
    at = TRANSLATIONS & set(held)
    if at == TRANSLATIONS:
        motion = numpy.array([held[i] for i in (1, 2, 3)]) @ axes
        return [("Spherical Support", {"Translation": motion} if motion.any() else {}, None)]
    entries = []
    for i in sorted(at):
        values = {"Direction": axes[i - 1]}
        if held[i]:
            values["Translation"] = held[i]
        entries.append(("Simple Support", values, None))
    return entries


def _of_shell(support, node, places, model):
    """Entries for a point of a shell, as a hashable tuple. A rotation about an axis a moves the
    director d by a × d, so to hold it is to hold the director along that."""
    held = support.held
    turned = [i for i in ROTATIONS if held.get(i)]
    if turned:
        model.findings.leave_out("prescribed rotations of shell nodes", support.place)
    spot = places.leader(node)
    at = directors(spot, node)
    rotations = sorted(ROTATIONS & set(held) - set(turned))
    of_others = _of_other_shells(rotations, node, places, _axes(support))
    if set(held) >= TRANSLATIONS and rotations == [4, 5, 6] and not any(held.values()):
        return _frozen([("Rigid Support", {}, None), *of_others])
    entries = _translations(held, _axes(support)) + of_others
    kept = [_held_directions(rotations, director, _axes(support)) for director in at]
    if rotations and not of_others and not any(len(one) for one in kept):
        model.findings.assume(
            "supports against turning about the normal of a shell hold nothing: its nodes have no such rotation",
            support.place,
        )
    if all(numpy.allclose(one, kept[0]) if len(one) == len(kept[0]) else False for one in kept):
        entries += [("Director Support", {"Direction": along}, None) for along in kept[0]]
    else:  # sides of a fold, each with its own directions
        for one, shell_node in zip(kept, spot.structure.nodes[node]):
            only = ((spot.structure.name, shell_node.number),)
            entries += [("Director Support", {"Direction": along}, only) for along in one]
    return _frozen(entries)


def _of_other_shells(rotations, node, places, axes):
    """Entries for the directors of further shells at a node that a fold joins to the first: of a rotation the fold hands on
    that about itself alone."""
    entries = []
    for spot in places.spots[node][1:]:
        if not spot.is_shell or is_smooth(places.leader(node), spot, node):
            continue
        for director, shell_node in zip(directors(spot, node), spot.structure.nodes[node]):
            only = ((spot.structure.name, shell_node.number),)
            along = _held_directions(rotations, director, axes)
            entries += [("Director Support", {"Direction": one}, only) for one in along]
    return entries


def _held_directions(rotations, director, axes):
    """An orthonormal basis of all a × d, with axes of space where they fit."""
    moves = numpy.array([numpy.cross(axes[i - 4], director) for i in rotations]).reshape(-1, 3)
    moves = moves[numpy.linalg.norm(moves, axis=1) > DRILLING]
    if not len(moves):
        return []
    _, sizes, rows = numpy.linalg.svd(moves)
    basis = rows[: int((sizes > DRILLING).sum())]
    found = []
    for axis in UNIT:
        if numpy.linalg.norm(basis @ axis) > 1.0 - 1e-9:
            found.append(axis)
    for row in basis:
        rest = row - sum((row @ one) * one for one in found)
        if len(found) < len(basis) and numpy.linalg.norm(rest) > 1e-6:
            found.append(rest / numpy.linalg.norm(rest))
    return found


def _frozen(entries):
    return tuple(
        (type, tuple((key, _rounded(value)) for key, value in values.items()), only) for type, values, only in entries
    )


def _rounded(value):
    """The same for directions that differ by rounding."""
    if isinstance(value, numpy.ndarray):
        return tuple(float(x) + 0.0 for x in numpy.round(value, 12))
    return value
