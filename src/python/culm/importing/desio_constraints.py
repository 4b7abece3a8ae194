"""Constraints, springs and dampers of DeSiO-Structure."""

import numpy

from .findings import refuse


def has_two(row):
    """Whether a constraint names two nodes."""
    return row.kind.lower() in ("rigidconnection", "sphericaljoint", "revolutejoint")


def _point(node, offset):
    return node.position + offset @ node.directors


def _simple(kind):
    def make(nodes, vectors, place, findings):
        direction = vectors[2]
        if kind.endswith("Local"):
            direction = direction @ nodes[0].directors
        _require(direction, place)
        return kind, {"Node": nodes[0].name, "Direction": direction}, "Translation"

    return make


def _turning(kind, amount):
    def make(nodes, vectors, place, findings):
        axis = vectors[2] @ nodes[0].directors if kind.endswith("Local") else vectors[2]
        _require(axis, place)
        return kind, {"Node": nodes[0].name, "Axis": axis}, amount

    return make


def _require(direction, place):
    if not direction.any():
        refuse(place, "this constraint needs a direction")


def _rigid_support(nodes, vectors, place, findings):
    return "Rigid Support", {"Node": nodes[0].name}, None


def _spherical_support(nodes, vectors, place, findings):
    values = {"Node": nodes[0].name}
    if vectors[0].any():
        values["Offset"] = vectors[0]
    return "Spherical Support", values, None


def _rigid_connection(nodes, vectors, place, findings):
    """Some versions of DeSiO turn the arms that the file gives, so that without them the second node only moves along."""
    gap = _point(nodes[1], vectors[1]) - _point(nodes[0], vectors[0])
    if numpy.linalg.norm(gap) > max(1e-6, 1e-3 * numpy.linalg.norm(nodes[1].position - nodes[0].position)):
        findings.assume("a rigid connection turns the arm between its nodes, which is not that of its offsets", place)
    return "Rigid Connection", {"Node": nodes[1].name, "Master": nodes[0].name}, None


def _spherical_joint(nodes, vectors, place, findings):
    values = {"First": nodes[0].name, "Second": nodes[1].name, "Position": _point(nodes[1], vectors[1])}
    return "Spherical Joint", values, None


def _revolute_joint(nodes, vectors, place, findings):
    """Without a direction the axis is the line between the two points, and the joint at the second."""
    first, second = _point(nodes[0], vectors[0]), _point(nodes[1], vectors[1])
    axis = vectors[2] @ nodes[0].directors
    line = second - first
    if numpy.linalg.norm(numpy.cross(axis, line)) > 1e-6 * numpy.linalg.norm(axis) * numpy.linalg.norm(line) > 0.0:
        findings.assume("a revolute joint with a direction turns about that, not about the line between its points", place)
    if not axis.any():
        axis = line
        if not axis.any():
            findings.assume("a revolute joint without an axis, its points at one place, is a spherical one, as its equations are", place)
            return "Spherical Joint", {"First": nodes[0].name, "Second": nodes[1].name, "Position": second}, None
        axis = axis / numpy.linalg.norm(axis)
        findings.assume("the axis of a revolute joint without a direction is the line between its points", place)
    values = {"First": nodes[0].name, "Second": nodes[1].name, "Position": second, "Axis": axis}
    return "Revolute Joint", values, None


# kind -> (nodes, vectors, place, findings) -> type, values and the name of an amount that is prescribed, of a deck
CONSTRAINTS = {
    "rigidsupport": _rigid_support,
    "sphericalsupport": _spherical_support,
    "simplesupport_global": _simple("Simple Support"),
    "simplesupport_local": _simple("Simple Support Local"),
    "rotation_global": _turning("Rotation", "Angle"),
    "rotation_local": _turning("Rotation Local", "Angle"),
    "angularvelocity_global": _turning("Angular Velocity", "Angular Velocity"),
    "angularvelocity_local": _turning("Angular Velocity Local", "Angular Velocity"),
    "rigidconnection": _rigid_connection,
    "sphericaljoint": _spherical_joint,
    "revolutejoint": _revolute_joint,
}
SPRINGS = {
    "translatory_global": ("Directed Ground Spring", "Direction", "Space"),
    "translatory_local": ("Directed Ground Spring", "Direction", "Node"),
    "translatory_inplane": ("Plane Ground Spring", "Normal", "Space"),
    "translatory_corotational": ("Ground Spring", None, None),
}
DAMPERS = {
    "angularvelocity_global": ("Rotation Damper", "Axis", "Space"),
    "angularvelocity_local": ("Rotation Damper Local", "Axis", "Node"),
}
