#!/usr/bin/env python3
"""Meshes of Gmsh in all forms: the same area, mass and sets, and a mesh that culm builds.

usage: gmsh.py --culm PROGRAM
"""

import argparse
import pathlib
import re
import sys
import tempfile

import gmsh_samples
from reading import made_of_text
from culm.program import Program

MASS = 2.0 * 0.01 * 7850.0  # two sheets of 1 m^2, 10 mm of steel
# quadrilaterals of the deck, nodes of the file on the sets: left and fold with those between
COUNTS = {("quadrilaterals", 1): 18, ("quadrilaterals", 2): 72, ("triangles", 1): 108, ("triangles", 2): 108}


def checked(name, data, kind, order, complaints):
    made = made_of_text("gmsh", data, "sheet.msh")
    (part,) = made.deck.parts
    found = {
        "mass": round(made.mass, 9),
        "quadrilaterals": len(part.quads),
        "surfaces": {key: len(value) for key, value in part.quad_sets.items()},
        "curves": {key: len(value) for key, value in part.line_sets.items()},
        "points": {key: len(value) for key, value in part.point_sets.items()},
    }
    pieces = 3 if (kind, order) == (gmsh_samples.QUAD, 1) else 6
    expected = {
        "mass": round(MASS, 9),
        "quadrilaterals": COUNTS[(kind, order)],
        "surfaces": {"floor": COUNTS[(kind, order)] // 2, "wall of it": COUNTS[(kind, order)] // 2},
        "curves": {"left": pieces, "fold": pieces},
        "points": {"corner": 1},
    }
    if found != expected:
        complaints.append(f"{name}: {found}, not {expected}")


def built(program, complaints):
    """culm finds the mass, the sets and both sides of the fold."""
    points, elements = gmsh_samples.mesh(gmsh_samples.TRIANGLE, 2)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "sheet.msh").write_bytes(gmsh_samples.written(points, elements, "4.1", True))
        done = program.call("import", "gmsh", folder / "sheet.msh", "--output", folder / "sheet.xml")
        if done.returncode != 0:
            sys.exit(done.stderr)
        made = made_of_text("gmsh", (folder / "sheet.msh").read_bytes(), "sheet.msh")
        total = re.search(r"total +(\d+) +(\d+) +(\S+)", done.stdout)
    size = made.deck.parts[0].size
    if (int(total[1]), int(total[2])) != (size, 108) or abs(float(total[3]) / MASS - 1.0) > 1e-5:
        complaints.append(f"culm has {total[0]}, expected {size} nodes, 108 elements, {MASS} kg")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    program = Program(parser.parse_args().culm)
    complaints = []
    for name, data, kind, order in gmsh_samples.all_forms():
        checked(name, data, kind, order, complaints)
    built(program, complaints)
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
