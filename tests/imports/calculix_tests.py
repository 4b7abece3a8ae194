#!/usr/bin/env python3
"""Files of others: those with which CalculiX itself is tested, from Debian's package calculix-ccx-test, and the results
that stand beside them.

usage: calculix_tests.py --culm PROGRAM [--files FOLDER]
"""

import argparse
import gzip
import pathlib
import re
import sys
import tempfile

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "src/python"))
from culm import read  # noqa: E402
from culm.program import Program  # noqa: E402

FILES = "/usr/share/doc/calculix-ccx-test/examples/test"
# Name, and by how much displacements of nodes may differ, beside the largest. CalculiX makes one brick of each element.
DISPLACEMENTS = {
    "section": 0.01,
    "beamlin": 0.015,  # four elements; 0.0750 by theory, which culm has
    "simplebeampipe1": 0.06,  # 0.9 on a length of 10: a linear step, which is nonlinear in culm
    "simplebeampipe2": 0.06,
    "shell3": 0.1,  # layers; four elements along a strip
}
# Of the first pair of frequencies.
FREQUENCIES = {"simplebeampipe3": 0.015, "boxprofile": 0.03}
# What would be another structure is refused.
REFUSED = {
    "solidshell1": "C3D20 have no counterpart",
    "shell1": "*NODAL THICKNESS is not read",
    "beammix": "an ellipse has no counterpart",
    "pret3": "C3D20R have no counterpart",
    "leifer2": "is not elastic",
}


def text_of(files, name):
    """A file of the package, where Debian has packed the larger ones."""
    path = files / name
    return gzip.open(f"{path}.gz", "rt").read() if not path.exists() else path.read_text()


def places(text):
    """Nodes of an input file, read anew: number -> place."""
    nodes, is_node = {}, False
    for line in text.splitlines():
        if line.startswith("*"):
            is_node = re.match(r"\*node *(,|$)", line, re.I) is not None or (line.startswith("**") and is_node)
        elif is_node and line.strip():
            cells = [float(cell) for cell in line.split(",") if cell.strip()]
            nodes[int(cells[0])] = numpy.array([*cells[1:], 0.0, 0.0, 0.0][:3])
    return nodes


def displacements(results):
    """The last table of displacements in the results of CalculiX."""
    table = results.split("displacements (vx,vy,vz)")[-1].split("\n\n")[1]
    rows = [line.split() for line in table.splitlines() if line.strip()]
    return {int(row[0]): numpy.array([float(x) for x in row[1:4]]) for row in rows}


def frequencies(results):
    table = results.split("E I G E N V A L U E   O U T P U T")[1].split("P A R T")[0]
    return [float(line.split()[3]) for line in table.splitlines() if re.match(r" +\d+ +\S+ +\S+ +\S+", line)]


def largest_difference(run, nodes, expected):
    """Of the displacements of the first analysis at all nodes that CalculiX has written, beside the largest of these."""
    state = [state for state in run.states if state.analysis == run.analyses[0]][-1]
    pairs = [(state.position(name) - state.displacement(name), state.displacement(name)) for name in run.structures()]
    points, found = (numpy.concatenate(parts) for parts in zip(*pairs))
    size = max(numpy.linalg.norm(u) for u in expected.values())
    worst = 0.0
    for number, u in expected.items():
        distances = numpy.linalg.norm(points - nodes[number], axis=1)
        if distances.min() > 1e-6 * numpy.ptp(points, axis=0).max():
            raise ValueError(f"node {number} is not in the deck")
        worst = max(worst, numpy.linalg.norm(found[distances.argmin()] - u) / size)
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    parser.add_argument("--files", type=pathlib.Path, default=FILES)
    arguments = parser.parse_args()
    if not pathlib.Path(arguments.files).is_dir():
        sys.exit(f"there is no {arguments.files}: install calculix-ccx-test")
    program, complaints = Program(arguments.culm), []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)

        def imported(name):
            path = folder / f"{name}.inp"
            path.write_text(text_of(arguments.files, path.name))
            return program.call("import", "calculix", path, "--output", path.with_suffix(".xml"))

        for name, words in REFUSED.items():
            done = imported(name)
            if done.returncode != 3 or words not in done.stderr or (folder / f"{name}.xml").exists():
                complaints.append(f"{name}: must be refused because {words}; {done.returncode}, {done.stderr[:200]}")
        for name in sorted({*DISPLACEMENTS, *FREQUENCIES}):
            done = imported(name)
            if done.returncode != 0:
                complaints.append(f"{name}: {done.stderr[:300]}")
                continue
            done = program.run(folder / f"{name}.xml", folder / name)
            if not done.succeeded:
                complaints.append(f"{name}: {done.errors}")
                continue
            run, results = read(done.folder), text_of(arguments.files, f"{name}.dat.ref")
            if name in DISPLACEMENTS:
                worst = largest_difference(run, places((folder / f"{name}.inp").read_text()), displacements(results))
                print(f"{name}: displacements differ by {worst:.2%}")
                if not worst <= DISPLACEMENTS[name]:
                    complaints.append(f"{name}: displacements differ by {worst:.2%}, more than {DISPLACEMENTS[name]:.2%}")
            if name in FREQUENCIES:
                ours = [float(x) for x in next(table for key, table in run.tables.items() if "modes" in key).iloc[:2, 1]]
                theirs = frequencies(results)[:2]
                print(f"{name}: {', '.join(f'{x:.5g}' for x in ours)} Hz; CalculiX {', '.join(f'{x:.5g}' for x in theirs)} Hz")
                if not max(abs(a / b - 1.0) for a, b in zip(ours, theirs)) <= FREQUENCIES[name]:
                    complaints.append(f"{name}: frequencies {ours}, of CalculiX {theirs}")
    sys.exit("\n".join(complaints) or 0)


if __name__ == "__main__":
    main()
