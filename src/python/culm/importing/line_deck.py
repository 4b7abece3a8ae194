"""A deck of beams whose sections are given at stations: clamped at the foot, its modes."""

import numpy

from .deck_text import List, unique_name

MODES = 10


class LineDeck:
    """@param title  of the deck"""

    def __init__(self, title):
        self.root = List("culm")
        self.root.add("Title", title)
        names = ("Sections", "Structures", "Masses", "Constraints", "Loads", "Analyses")
        self.lists = {name: self.root.list(name) for name in names}
        self.mass = 0.0
        self.lines = {}  # points of beams by name

    def add_beam(self, name, points, stations, twist=None, up=(1.0, 0.0, 0.0), elements=24, place=None):
        """@param points    (n, 3), places of a smooth axis, or the two ends of a straight one
        @param stations  (fraction of the length, type, values, mass per length) of sections
        @param twist     angles of d1 about d3 [rad] at fractions of the length, as two arrays"""
        points = numpy.array(points, float)
        names = []
        for i, (_, type, values, _) in enumerate(stations):
            section = self.lists["Sections"].list(unique_name(f"{name} {i + 1}", {s.name for s in self.lists["Sections"].lists()}))
            section.add("Type", type)
            for key, value in values.items():
                section.add(key, value)
            names.append(section.name)
        beam = self.lists["Structures"].list(name, f"{place}" if place else None, "Beam")
        places = numpy.array([station[0] for station in stations])
        beam.add("Sections", names).add("Section Positions", numpy.clip(places, 0.0, 1.0))
        curve = beam.list("Curve")
        if len(points) == 2:
            curve.add("Type", "Line").add("From", points[0]).add("To", points[1])
        else:
            curve.add("Type", "Spline").add("Points", points.ravel())
        curve.add("Up", numpy.array(up, float)).add("Elements", elements)
        if twist is not None and numpy.any(twist[1]):
            curve.add("Pre-Twist", numpy.array(twist[1])).add("Pre-Twist Positions", numpy.clip(twist[0], 0.0, 1.0))
        length = numpy.linalg.norm(numpy.diff(points, axis=0), axis=1).sum()
        per_length = numpy.array([station[3] for station in stations])
        mass = float(length * ((per_length[1:] + per_length[:-1]) / 2 * numpy.diff(places)).sum())
        self.mass += mass
        self.lines[name] = points
        return mass

    def clamp(self, node, comment=None):
        self.lists["Constraints"].list("clamp", comment, "Rigid Support").add("Node", node)

    def finish(self, gravity=None):
        """Gravity is named, and acts in nothing but what the user adds."""
        modes = self.lists["Analyses"].list("modes", type="Modal").add("Modes", MODES)
        if gravity is not None:
            load = self.lists["Loads"].list("gravity", "does not act in the modes", "Gravity")
            load.add("Acceleration", numpy.array(gravity, float))
            modes.add("Inactive", ["gravity"])
        return self.root


def stations_in_order(places, refuse_at):
    """Refuses places that do not rise from the first to the last; equal ones are steps."""
    for i in range(1, len(places)):
        if places[i] < places[i - 1]:
            refuse_at(f"stations must rise, but {places[i]:g} follows {places[i - 1]:g}")
    if len(places) < 2 or places[-1] <= places[0]:
        refuse_at("at least two stations are needed, and the last must lie beyond the first")
