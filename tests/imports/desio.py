#!/usr/bin/env python3
"""Models of DeSiO: the cantilever of its workshop against the law of the discrete element, a rotor against
masses and inertia counted here, the same section in both forms.

usage: desio.py --culm PROGRAM
"""

import argparse
import csv
import pathlib
import sys
import tempfile

import desio_samples
import numpy
from reading import made_of_text
from culm.program import Program

DIGITS = 1e-9  # relative; of numbers with sixteen digits


def imported(program, folder, model):
    for name, text in model.items():
        (folder / name).write_text(text)
    done = program.call("import", "desio", folder, "--output", folder / "model.xml")
    if done.returncode != 0:
        sys.exit(done.stderr)
    return done.stdout


def rolls_up(program, complaints, backwards=False):
    """Two-node elements with one Gauss point: an element turned by Delta has M h/EI = sin(Delta) cos(Delta)
    and the length h/cos(Delta/2), so the tip is at h/sin(Delta) (sin(N Delta), 1 - cos(N Delta))."""
    n, h = desio_samples.ELEMENTS, 1.0 / desio_samples.ELEMENTS
    delta = 0.5 * numpy.arcsin(2.0 * desio_samples.MOMENT * h / (desio_samples.E * desio_samples.INERTIA))
    tip = h / numpy.sin(delta) * numpy.array([numpy.sin(n * delta), 1.0 - numpy.cos(n * delta)])
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        imported(program, folder, desio_samples.cantilever(backwards))
        deck = folder / "model.xml"
        history = '<ParameterList name="Output"><ParameterList name="History"><ParameterList name="tip">'
        node = "bar/first" if backwards else "bar/last"
        history += f'<Parameter name="Type" value="Position"/><Parameter name="Node" value="{node}"/>'
        history += "</ParameterList></ParameterList></ParameterList>\n</ParameterList>\n"
        text = deck.read_text().rstrip()
        deck.write_text(text.removesuffix("</ParameterList>") + history)
        run = program.run(deck, folder / "out")
        if not run.succeeded:
            sys.exit(run.errors)
        with open(run.folder / "history.csv") as file:
            found = numpy.array([float(x) for x in list(csv.reader(file))[-1][1:4]])
    print(f"roll-up: tip at {found[0]:.8f}, {found[2]:.8f}; by the law {tip[0]:.8f}, {tip[1]:.8f}")
    if not numpy.allclose(found[[0, 2]], tip, atol=1e-8):
        complaints.append(f"the tip is at {found}, by the law of the element at {tip}")


def entry(made, name, one):
    (found,) = [x for part in made.root.lists() if part.name == name for x in part.lists() if x.name == one]
    return {item[0]: item[1] for item in found.items if isinstance(item, tuple)}


def values(text):
    return numpy.array([float(x) for x in text.strip("{}").split(",")])


def weighs(complaints):
    """Mass of all; centre and inertia of the hub from points of mass that make its Euler tensor."""
    made = made_of_text("desio", desio_samples.rotor())
    tube, soft = desio_samples.TUBE[1][0], desio_samples.SOFT[1][0]
    expected = 200 + 30 + 10 * tube + (2 * tube + 2 * soft) + 4 * soft
    if abs(made.mass / expected - 1.0) > DIGITS:
        complaints.append(f"the mass is {made.mass}, not {expected}")
    hub = entry(made, "Structures", "hub")
    J = numpy.array([[30, 3, -2], [3, 20, 1], [-2, 1, 25]], float)
    centre = numpy.array([10, 0, 20]) / 200
    about_centre = J - 200 * numpy.outer(centre, centre)
    # eigenvectors as six points in pairs, with the same second moments
    sizes, axes = numpy.linalg.eigh(about_centre)
    points = [sign * numpy.sqrt(3 * s) * axis for s, axis in zip(sizes, axes.T) for sign in (1, -1)]
    inertia = sum((p @ p * numpy.eye(3) - numpy.outer(p, p)) / 6 for p in points)
    given = values(hub["Inertia"])
    found = numpy.array([[given[0], given[5], given[4]], [given[5], given[1], given[3]], [given[4], given[3], given[2]]])
    if not numpy.allclose(found, inertia, rtol=DIGITS, atol=1e-9) or not numpy.allclose(values(hub["Centre"]), centre):
        complaints.append(f"the inertia of the hub is {found}, not {inertia}")


def sections_agree(complaints):
    """21 values mean what 11 values mean: the matrix of the theory, (1.9)."""
    made = made_of_text("desio", desio_samples.rotor())
    upper = values(entry(made, "Sections", "section 2")["Stiffness"])
    matrix = numpy.zeros((6, 6))
    matrix[numpy.triu_indices(6)] = upper
    EA, GA1, GA2, EI1, EI2, GIp, ES1, ES2, GS1, GS2, EI12 = desio_samples.SOFT[0]
    expected = numpy.diag([GA1, GA2, EA, EI1, EI2, GIp])
    expected[0, 5], expected[1, 5], expected[2, 3], expected[2, 4], expected[3, 4] = -GS1, GS2, ES1, -ES2, -EI12
    if not numpy.allclose(matrix, expected, rtol=DIGITS):
        complaints.append(f"the section is\n{matrix}\nnot\n{expected}")


def shells_are_whole(complaints):
    """Layers turn with the normal, so a director against it turns them back; masses, names of nodes, what acts on them."""
    made = made_of_text("desio", desio_samples.laminate())
    expected = 1600 * 0.2 * 0.006 + 7850 * 0.1 * 0.003 + desio_samples.TUBE[1][0] + 3.5
    if abs(made.mass / expected - 1.0) > DIGITS:
        complaints.append(f"the mass of the laminate is {made.mass}, not {expected}")
    strip, flap = entry(made, "Structures", "shell 1"), entry(made, "Structures", "shell 2")
    if strip["Angles"] != "{-30, 0}" or strip["Thicknesses"] != "{0.002, 0.004}" or flap["Materials"] != "{material 2}":
        complaints.append(f"layers are {strip['Angles']}, {strip['Thicknesses']}, {flap['Materials']}")
    (shells,) = [part for part in made.root.lists() if part.name == "Structures"]
    meshes = {x.name: {i[0]: i[1] for i in x.lists()[0].items if isinstance(i, tuple)} for x in shells.lists() if "shell" in x.name}

    def place(node):
        """Of a node, numbered as elements meet them."""
        name, number = node.split("/")
        points, quads = values(meshes[name]["Points"]).reshape(-1, 3), values(meshes[name]["Quads"]).astype(int)
        return points[list(dict.fromkeys(quads.tolist()))[int(number)]]

    corners = [place(f"shell 1/{i}") for i in range(3)]
    if numpy.cross(corners[1] - corners[0], corners[2] - corners[0])[2] >= 0.0:
        complaints.append("the normal is not on the side of the director")
    spots = [entry(made, "Loads", "force"), entry(made, "Masses", "mass"), entry(made, "Constraints", "softtransition 2")]
    if not numpy.allclose([place(one["Node"]) for one in spots], [[2, 0.2, -0.5], [2, 0.1, 0], [1, 0.1, 0]]):
        complaints.append(f"force, mass and transition are at {[place(one['Node']) for one in spots]}")
    found = [x for part in made.root.lists() if part.name == "Constraints" for x in part.lists()]
    types = {one.name: {i[0]: i[1] for i in one.items if isinstance(i, tuple)} for one in found}
    if types["simplesupport"]["Type"] != "Simple Support" or types["simplesupport"].get("Translation") != "1":
        complaints.append(f"the support that moves is {types['simplesupport']}")
    kinds = sorted({one["Type"] for one in types.values()})
    if kinds != ["Fold Connection", "Inextensible Director", "Rigid Support", "Simple Support", "Soft Transition"]:
        complaints.append(f"the constraints are {kinds}")


def joints_are_told(complaints):
    """Of the hub at (1, 0, 10), with d2 along -x, and the top of the post at (0, 0, 10)."""
    model = desio_samples.rotor()
    for vectors, type, words in (
        ([0, 1, 0] + [0] * 6, "Spherical Joint", "is a spherical one"),
        ([0] * 9, "Revolute Joint", "the line between its points"),
        ([0] * 6 + [1, 0, 0], "Revolute Joint", "turns about that"),
    ):
        rows = model["constraint12input.txt"].split("\n")
        i = next(i for i, row in enumerate(rows) if row.startswith("revolutejoint"))
        rows[i] = "revolutejoint 1.0 6 " + desio_samples.numbers(vectors)
        made = made_of_text("desio", {**model, "constraint12input.txt": "\n".join(rows)})
        joint = entry(made, "Constraints", "revolutejoint")
        if joint["Type"] != type or not any(words in text for text in made.findings.assumed):
            complaints.append(f"a joint with {vectors} is {joint}, {list(made.findings.assumed)}")


def arms_are_told(complaints):
    """Of blades beside the hub, whose file gives no arms, or those that are there; the hub has d1, d2, d3 along y, -x, z."""
    told = "a rigid connection turns the arm between its nodes"
    for offset, expected in (([0, 0, 0], 2), ([0, 0, 0.5], 1)):
        model = desio_samples.rotor()
        model["constraint12input.txt"] = model["constraint12input.txt"].replace(
            f"rigidconnection 1 7 {desio_samples.NO_VECTORS}", "rigidconnection 1 7 " + desio_samples.numbers(offset + [0] * 6)
        )
        places = [len(where) for text, where in made_of_text("desio", model).findings.assumed.items() if text.startswith(told)]
        if places != [expected]:
            complaints.append(f"arms of {offset} are told at {places} places, not {expected}")


def strip_vibrates(program, complaints):
    """Two shells as one: beams of Euler and Bernoulli, of which the wall is thin and nu is 0."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        imported(program, folder, desio_samples.strip())
        run = program.run(folder / "model.xml", folder / "out")
        if not run.succeeded:
            sys.exit(run.errors)
        with open(next(run.folder.glob("analyses/*/modes.csv"))) as file:
            found = float(list(csv.reader(file))[1][1])
    _, length, _ = desio_samples.STRIP
    bending = (desio_samples.E / desio_samples.RHO / 12.0) ** 0.5 * desio_samples.WALL
    expected = 1.87510407**2 / (2 * numpy.pi * length**2) * bending
    print(f"strip of two shells: {found:.4f} Hz, by Euler and Bernoulli {expected:.4f} Hz")
    if abs(found / expected - 1.0) > 0.01:
        complaints.append(f"the strip has {found} Hz, not {expected}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    program = Program(parser.parse_args().culm)
    complaints = []
    rolls_up(program, complaints)
    rolls_up(program, complaints, backwards=True)
    weighs(complaints)
    sections_agree(complaints)
    shells_are_whole(complaints)
    joints_are_told(complaints)
    arms_are_told(complaints)
    strip_vibrates(program, complaints)
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
