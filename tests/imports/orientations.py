#!/usr/bin/env python3
"""Orientations of Abaqus whose axes depend on the place: directions of layers in the deck beside those of the surface."""

import sys

import numpy
from reading import made_of_text, not_refused

MATERIAL = "*MATERIAL, NAME=PLY\n*ELASTIC, TYPE=LAMINA\n1.4E11, 1E10, 0.3, 5E9, 5E9, 3.5E9\n*DENSITY\n1600.\n"
N = 6


def cylinder(u, v):
    return numpy.array([2 * numpy.cos(1.5 * u), 2 * numpy.sin(1.5 * u), 3 * v])


def ring(u, v):
    return (1 + v) * numpy.array([numpy.cos(1.2 * u), numpy.sin(1.2 * u), 0])


def sphere(u, v):
    return numpy.array([numpy.cos(u) * numpy.cos(0.8 * v), numpy.sin(u) * numpy.cos(0.8 * v), numpy.sin(0.8 * v)])


def mesh(place):
    text = "*NODE, NSET=ALL\n"
    for i in range(N + 1):
        for j in range(N + 1):
            text += f"{100 * i + j + 1}, " + ", ".join(f"{x:.12g}" for x in place(i / N, j / N)) + "\n"
    text += "*ELEMENT, TYPE=S4, ELSET=E\n"
    for i in range(N):
        for j in range(N):
            a = 100 * i + j + 1
            text += f"{a}, {a}, {a + 100}, {a + 101}, {a + 1}\n"
    return text


def model(place, orientation, section, instance="*INSTANCE, NAME=I, PART=P\n"):
    part = f"*PART, NAME=P\n{mesh(place)}{orientation}{section}*END PART\n"
    return f"*HEADING\nLayers\n{part}*ASSEMBLY, NAME=A\n{instance}*END INSTANCE\n*END ASSEMBLY\n{MATERIAL}"


def about(axis, angle, vector):
    """Turned about a unit vector, in degrees."""
    angle = numpy.radians(angle)
    along = axis * (axis @ vector)
    return along + (vector - along) * numpy.cos(angle) + numpy.cross(axis, vector) * numpy.sin(angle)


def directions(made):
    """(centre, normal, directions of the layers) of each element."""
    for part in made.deck.parts:
        for corners in part.positions[part.corners]:
            normal = numpy.cross(corners[2] - corners[0], corners[3] - corners[1])
            normal /= numpy.linalg.norm(normal)
            first = numpy.array(part.axis) - normal * (normal @ part.axis)
            first /= numpy.linalg.norm(first)
            yield corners.mean(axis=0), normal, [about(normal, layer.angle, first) for layer in part.wall.layers]


def worst(made, expected):
    """Largest angle between a layer and where it should lie [degrees]; half a turn is none."""
    largest = 0.0
    for centre, normal, found in directions(made):
        wanted = expected(centre, normal)
        if len(found) != len(wanted):
            return numpy.inf
        for one, direction in zip(found, wanted):
            projected = direction - normal * (normal @ direction)
            sine = numpy.linalg.norm(numpy.cross(one, projected)) / numpy.linalg.norm(projected)
            largest = max(largest, float(numpy.degrees(numpy.arcsin(min(sine, 1.0)))))
    return largest


def polar(centre):
    """Radial and circumferential about z."""
    radial = numpy.array([*centre[:2], 0.0]) / numpy.hypot(*centre[:2])
    return radial, numpy.array([-radial[1], radial[0], 0.0])


def on_cylinder(centre, normal):
    radial, around = polar(centre)
    first = about(radial, 30, around)
    first -= normal * (normal @ first)
    return [about(normal, angle, first) for angle in (0, 45)]


def on_moved(centre, normal):
    """Back where the part was made: it is moved along x by 5, then turned by 90 degrees about x."""
    back = lambda x: numpy.array([x[0], x[2], -x[1]])  # noqa: E731
    forth = lambda x: numpy.array([x[0], -x[2], x[1]])  # noqa: E731
    wanted = on_cylinder(back(centre) - [5, 0, 0], back(normal))
    return [forth(one) for one in wanted]


def on_sphere(centre, normal):
    del normal
    radial = centre / numpy.linalg.norm(centre)
    return [about(radial, 20, polar(centre)[1])]


TWO = "*SHELL SECTION, ELSET=E, COMPOSITE, ORIENTATION=O\n0.01, , PLY, 0.\n0.02, , PLY, 45.\n"
ONE = "*SHELL SECTION, ELSET=E, MATERIAL=PLY, ORIENTATION=O\n0.01\n"
OWN = "*SHELL SECTION, ELSET=E, COMPOSITE\n0.01, , PLY, O\n"
CYLINDER = "*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL\n0, 0, 0, 0, 0, 1\n"
SPHERE = "*ORIENTATION, NAME=O, SYSTEM=SPHERICAL\n0, 0, 0, 0, 0, 1\n"
MOVED = "*INSTANCE, NAME=I, PART=P\n5, 0, 0\n0, 0, 0, 1, 0, 0, 90\n"
RECTANGULAR = "*ORIENTATION, NAME=O\n0, 0, 1, 1, 0, 0\n"
CASES = {
    "around a cylinder": (model(cylinder, CYLINDER + "1, 30\n", TWO), on_cylinder),
    "and moved with its part": (model(cylinder, CYLINDER + "1, 30\n", TWO, MOVED), on_moved),
    "along a cylinder": (model(cylinder, CYLINDER + "2, 0\n", ONE), lambda c, n: [numpy.array([0.0, 0.0, 1.0])]),
    "from the centre of a ring": (model(ring, CYLINDER + "3, 0\n", ONE), lambda c, n: [polar(c)[0]]),
    "without a second line": (model(ring, CYLINDER, ONE), lambda c, n: [polar(c)[0]]),
    "of a layer alone": (model(cylinder, CYLINDER + "1, 0\n", OWN), lambda c, n: [polar(c)[1]]),
    "on a sphere": (model(sphere, SPHERE + "1, 20\n", ONE), on_sphere),
    "rectangular, moved with its part": (model(cylinder, RECTANGULAR, ONE, MOVED), lambda c, n: [numpy.array([0.0, -1.0, 0.0])]),
}
REFUSED = {
    "a radius is normal": (model(cylinder, CYLINDER, ONE), "is normal to this element"),
    "a sphere without its axis": (model(sphere, SPHERE, ONE), "needs a second line"),
    "an axis without length": (model(ring, CYLINDER.replace("0, 0, 1", "0, 0, 0"), ONE), "the two points of the axis are one"),
    "a system of a user": (model(ring, CYLINDER.replace("CYLINDRICAL", "USER"), ONE), "SYSTEM=USER is not read"),
    "angles from a normal": (
        model(cylinder, CYLINDER, "*SHELL SECTION, ELSET=E, COMPOSITE, ORIENTATION=O\n0.01, , PLY, O\n0.01, , PLY, 0.\n"),
        "is normal to an element",
    ),
}


def main():
    complaints = []
    for name, (text, expected) in CASES.items():
        made = made_of_text("abaqus", text)
        error = worst(made, expected)
        print(f"layers {name}: {len(made.deck.parts)} shells, off by {error:.1e} degrees at most")
        if not error < 2e-3:
            complaints.append(f"layers {name}: off by {error:g} degrees")
    complaints += not_refused(REFUSED)
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
