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


SQUARE = "{}$Nodes\n{}$EndNodes\n$Elements\n{}$EndElements\n"
OLD = '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 "a"\n2 2 "b"\n$EndPhysicalNames\n'
NEW = '$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 "a"\n$EndPhysicalNames\n'
PARTS = "$PartitionedEntities\n2\n1\n9 1\n0 0 1 0\n2 2 1 1 1 0 0 0 1 1 0 1 1 0\n$EndPartitionedEntities\n"


def repeats(complaints):
    """Elements in two groups, which the old format has twice; groups of the parts of a mesh that is in parts."""
    old = SQUARE.format(OLD, "4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n", "2\n1 3 2 1 1 1 2 3 4\n2 3 2 2 1 1 2 3 4\n")
    twice = made_of_text("gmsh", old, "sheet.msh")
    if abs(twice.mass - MASS / 2) > 1e-9 or twice.made.surface_sets != {"a": [0], "b": [0]}:
        complaints.append(f"an element in two groups: {twice.mass} kg, {twice.made.surface_sets}")
    nodes = "1 4 1 4\n2 2 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
    parts = made_of_text("gmsh", SQUARE.format(NEW + PARTS, nodes, "1 1 1 1\n2 2 3 1\n1 1 2 3 4\n"), "sheet.msh")
    if parts.made.surface_sets != {"a": [0]}:
        complaints.append(f"a mesh in parts has the surfaces {parts.made.surface_sets}")


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
    repeats(complaints)
    built(program, complaints)
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
