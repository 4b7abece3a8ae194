#!/usr/bin/env python3
"""Models of Nastran: masses, sums of loads and frequencies beside those counted here.

usage: nastran.py --culm PROGRAM
"""

import argparse
import csv
import pathlib
import sys
import tempfile

import frame_modes
import nastran_samples
import numpy
from reading import made_of_text
from culm.program import Program


def panel_is_whole(complaints):
    """Mass, forces of both cases, directions of layers and the section of the bar."""
    made = made_of_text("nastran", nastran_samples.panel(), "panel.bdf")
    box = 0.04 * 0.06 - (0.04 - 2 * 0.004) * (0.06 - 2 * 0.003)
    mass = 1600 * (2 * 0.002 + 2 * 0.003) + 7850 * box + 12.5
    if abs(made.mass / mass - 1.0) > 1e-9:
        complaints.append(f"the mass of the panel is {made.mass}, not {mass}")
    forces = sum(len(load.nodes) * load.vector for load in made.made.node_loads)
    if not numpy.allclose(forces, [300, 600, 0, 15, 0, 0]):
        complaints.append(f"the sum of forces is {forces}")
    (pressure,) = [load for load in made.made.element_loads if load.kind == "pressure"]
    (gravity,) = [load for load in made.made.element_loads if load.kind == "gravity"]
    if pressure.value != 250 or pressure.steps != {0} or not numpy.allclose(gravity.value, [0, 0, -9.81]):
        complaints.append("pressure or gravity are not those of the file")
    (part,) = made.deck.parts
    # THETA = 30 degrees from the sides, which lie along x
    if part.axis != (1.0, 0.0, 0.0) or [layer.angle for layer in part.wall.layers] != [30.0, -60.0, -60.0, 30.0]:
        complaints.append(f"the layers are {part.wall.layers} from {part.axis}")
    # of a BOX the first dimension is along z of the element, the second along y, the direction of the bar
    values = made.made.sections["beam 5"].values
    found = [values[name] for name in ("Width", "Height", "Flange Thickness", "Web Thickness")]
    if found != [0.06, 0.04, 0.004, 0.003]:
        complaints.append(f"the box is {found}")


def frame_vibrates(program, complaints):
    """Four elements to a member: those of culm are of second order, those of the textbook of third."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "frame.bdf").write_text(nastran_samples.frame())
        done = program.call("import", "nastran", folder / "frame.bdf", "--output", folder / "frame.xml")
        if done.returncode != 0:
            sys.exit(done.stderr)
        run = program.run(folder / "frame.xml", folder / "out")
        if not run.succeeded:
            sys.exit(run.errors)
        with open(run.folder / "analyses/case_1/modes.csv") as file:
            found = [float(row[1]) for row in list(csv.reader(file))[1:]]
    E, G, density = 2.1e11, 2.1e11 / 2.6, 7850.0

    def values(A, I1, I2, J):
        # I1 is the integral over the distance along the direction vector
        return E * A, G * A * 5 / 6, G * A * 5 / 6, E * I2, E * I1, G * J, density * A, density * (I1 + I2)

    girder, column = values(2e-2, 1.67e-5, 6.67e-5, 4.58e-5), values(1.5e-2, 1.25e-5, 2.81e-5, 2.94e-5)
    y = (0, 1, 0)
    points = [(0, 0, 0), (0, 0, 3), (4, 0, 3), (4, 0, 0)]
    expected = frame_modes.frequencies(points, [(0, 1, y, column), (1, 2, y, girder), (2, 3, y, column)], {0, 3})
    print(f"frame: culm {numpy.round(found, 4)}, textbook {numpy.round(expected, 4)} Hz")
    if not numpy.allclose(found, expected, rtol=0.01):
        complaints.append(f"the frequencies are {found}, by the textbook {expected}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    program = Program(parser.parse_args().culm)
    complaints = []
    panel_is_whole(complaints)
    frame_vibrates(program, complaints)
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
