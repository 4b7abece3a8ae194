#!/usr/bin/env python3
"""An archive of ANSYS: mass, sums of loads, layers and the section of its beams beside those counted here; its deflection
under its own weight and pressure carries all of it to the supports.

usage: ansys.py --culm PROGRAM
"""

import argparse
import csv
import pathlib
import re
import sys
import tempfile

import ansys_samples
import numpy
from reading import made_of_text
from culm.program import Program

BOX = 0.04 * 0.06 - (0.04 - 2 * 0.003) * (0.06 - 2 * 0.005)
MASS = 1600 * 0.008 + 7850 * BOX + 7.5


def is_whole(complaints):
    made = made_of_text("ansys", ansys_samples.model(), "model.cdb")
    if abs(made.mass / MASS - 1.0) > 1e-9:
        complaints.append(f"the mass is {made.mass}, not {MASS}")
    forces = sum(len(load.nodes) * load.vector for load in made.made.node_loads)
    if not numpy.allclose(forces, [0, 0, -100, 5, 0, 0]):
        complaints.append(f"the sum of forces is {forces}")
    loads = {load.kind: load for load in made.made.element_loads}
    if loads["pressure"].value != 250 or len(loads["pressure"].elements) != ansys_samples.N**2:
        complaints.append("the pressure is not that of the file")
    if not numpy.allclose(loads["gravity"].value, [0, 0, -9.81]):
        complaints.append(f"gravity is {loads['gravity'].value}: masses weigh against the acceleration of the ground")
    (part,) = made.deck.parts
    found = [(layer.thickness, layer.angle) for layer in part.wall.layers]
    if part.axis != (1.0, 0.0, 0.0) or found != [(0.002, 45.0), (0.004, 0.0), (0.002, -45.0)]:
        complaints.append(f"the layers are {found} from {part.axis}")
    (section,) = made.made.sections.values()
    names = ("Width", "Height", "Web Thickness", "Flange Thickness")
    if [section.values[name] for name in names] != [0.04, 0.06, 0.003, 0.005]:
        complaints.append(f"the box is {section.values}")
    # the beam lies along y; without a third node its own y is level, -x
    if not numpy.allclose(made.made.beams[0].up, [-1, 0, 0]):
        complaints.append(f"the section of the beam stands along {made.made.beams[0].up}")


def blocks_are_lines(complaints):
    """Files of releases from 2019 are the same deck, and nothing of them is left out."""
    lines, blocks = (made_of_text("ansys", text, "model.cdb") for text in (ansys_samples.model(), ansys_samples.model_in_blocks()))
    bare = [re.sub(r"<!--.*?-->", "", made.text) for made in (lines, blocks)]
    if bare[0] != bare[1] or blocks.findings.left_out:
        complaints.append(f"the archive with its loads in blocks is another deck, without {list(blocks.findings.left_out)}")


def carries(program, complaints):
    """The reactions of the clamped side, watched one by one, are all forces of the file."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "model.cdb").write_text(ansys_samples.model())
        done = program.call("import", "ansys", folder / "model.cdb", "--output", folder / "model.xml")
        if done.returncode != 0:
            sys.exit(done.stderr)
        text = (folder / "model.xml").read_text()
        made = made_of_text("ansys", ansys_samples.model(), "model.cdb")
        watched = ""
        for node in range(1, ansys_samples.N + 2):
            for i, spot in enumerate(made.deck.places.spots[node][:1]):
                name = f"{made.deck.parts[0].name}/{spot.structure.nodes[node][0].number}" if spot.is_shell else spot.structure.node_name(spot.index)
                watched += f'<ParameterList name="reaction {node} {i}"><Parameter name="Type" value="Reaction"/><Parameter name="Node" value="{name}"/></ParameterList>\n'
        text = text.replace('<ParameterList name="History">', '<ParameterList name="History">\n' + watched)
        (folder / "model.xml").write_text(text)
        run = program.run(folder / "model.xml", folder / "out")
        if not run.succeeded:
            sys.exit(run.errors)
        with open(run.folder / "history.csv") as file:
            rows = list(csv.reader(file))
    columns = [i for i, name in enumerate(rows[0]) if name.startswith("reaction") and " Fz" in name]
    total = sum(float(rows[-1][i]) for i in columns)
    # pressure follows the surface, which hardly tilts
    expected = 9.81 * MASS + 100 - 250
    print(f"reactions {total:.4f} N, weight, force and pressure {expected:.4f} N")
    if len(columns) != ansys_samples.N + 1 or abs(total - expected) > 5e-3 * (9.81 * MASS + 350):
        complaints.append(f"the supports carry {total} N of {expected} N, {rows[0]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    program = Program(parser.parse_args().culm)
    complaints = []
    is_whole(complaints)
    blocks_are_lines(complaints)
    carries(program, complaints)
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
