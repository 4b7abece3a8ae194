#!/usr/bin/env python3
"""The same input files by CalculiX and by culm: deflection, frequencies, buckling.

usage: calculix.py --culm PROGRAM [--elements N] [--ccx PROGRAM]

Without --ccx the numbers of CalculiX 2.20 (Debian's calculix-ccx 2.20-1) stand below; with it they
are found again, by `samples.py FOLDER` and `ccx plate` and so on in the folder.
"""

import argparse
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy
import samples

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "src/python"))
from culm.program import Program  # noqa: E402

# deflection of the watched node [m], frequencies [Hz], factors, of ccx 2.20 on the files of samples.py
CALCULIX = {
    "plate": (2.133549e-05, [48.91502, 122.6319, 122.6319, 196.3561], [75.12489, 117.9326]),
    "panel": (3.425564e-05, [105.6998, 110.2508, 177.9731, 244.9959], [72.68649, 78.95344]),
    "corner": (1.785751e-03, [5.758807, 11.05724, 15.79517, 37.75198], [110.4728, 332.8957]),
    "frame": (2.332597e-04, [4.274676, 9.969504, 11.20765, 27.20820], [7.333303]),
}
# Both have errors of their meshes, culm's quadrilaterals of half the size more than the quadratic ones;
# of plates and panels they fall to less than half with twice the elements (doc/verification/imports.md). CalculiX makes
# solids of beams and holds their corners rigidly, which stiffens a frame.
AGREEMENT = {"plate": (0.02, 0.02, 0.025), "panel": (0.02, 0.02, 0.06), "corner": (0.01, 0.01, 0.02), "frame": (0.04, 0.05, 0.03)}


def calculix(program, name, text, folder):
    """What CalculiX finds, in the form of CALCULIX."""
    (folder / f"{name}.inp").write_text(text)
    subprocess.run([program, name], cwd=folder, check=True, capture_output=True)
    data = (folder / f"{name}.dat").read_text()
    row = re.search(r"for set WATCHED and time +0.1000000E\+01\s+\d+ +(.*)", data)[1]
    table = data.split("E I G E N V A L U E   O U T P U T")[1].split("P A R T I C I P A T I O N")[0]
    frequencies = [float(cells.split()[3]) for cells in re.findall(r"^ +\d+ +(.*\d.*)$", table, re.M) for cells in ["0 " + cells]]
    factors = [
        float(x) for x in re.findall(r"^ +\d+ +(\S+)$", data.split("B U C K L I N G   F A C T O R")[1], re.M)
    ]
    return float(numpy.linalg.norm([float(x) for x in row.split()])), frequencies, factors


def table_column(path, column):
    with open(path) as file:
        return [float(row[column]) for row in csv.reader(file) if re.match(r"\d", row[0])]


def culm(program, name, text, folder):
    """What culm makes of the file, in the form of CALCULIX, and the mass that it read."""
    (folder / f"{name}.inp").write_text(text)
    done = program.call("import", "calculix", folder / f"{name}.inp", "--output", folder / f"{name}.xml")
    if done.returncode != 0:
        sys.exit(done.stderr)
    mass = float(re.search(r"mass of what was read: (\S+) kg", done.stdout)[1])
    run = program.run(folder / f"{name}.xml", folder / name)
    if not run.succeeded:
        sys.exit(run.errors)
    with open(run.folder / "history.csv") as file:
        last = [float(x) for x in list(csv.reader(file))[2][1:4]]
    analyses = run.folder / "analyses"
    frequencies = table_column(analyses / "step_2/modes.csv", 1)
    return (float(numpy.linalg.norm(last)), frequencies, table_column(analyses / "step_3/buckling.csv", 1)), mass


def mass_of_file(text):
    """The mass of a sample by its own numbers: areas by triangles, lengths, sections as they stand."""
    nodes, rows, kind = {}, {}, None
    for line in text.splitlines():
        if line.startswith("*"):
            kind = line.split(",")[0]
        elif kind == "*NODE":
            cells = line.split(",")
            nodes[int(cells[0])] = numpy.array([float(x) for x in cells[1:]])
        elif kind == "*ELEMENT":
            cells = [int(x) for x in line.split(",")]
            rows[cells[0]] = cells[1:]
    if len(next(iter(rows.values()))) == 3:
        lengths = {e: numpy.linalg.norm(nodes[row[2]] - nodes[row[0]]) for e, row in rows.items()}
        third = len(rows) // 3
        return sum(7850 * l * (0.02 if third < e <= 2 * third else 0.015) for e, l in lengths.items())
    if len(next(iter(rows.values()))) == 4:
        diagonals = [(nodes[row[2]] - nodes[row[0]], nodes[row[3]] - nodes[row[1]]) for row in rows.values()]
        return 7850 * 0.02 * sum(0.5 * numpy.linalg.norm(numpy.cross(*pair)) for pair in diagonals)
    area = 0.0
    for row in rows.values():
        # the eight nodes on the rim, about their middle as the quadratic element has it
        rim = [nodes[row[i]] for i in (0, 4, 1, 5, 2, 6, 3, 7)]
        middle = sum(nodes[n] for n in row[4:]) / 2 - sum(nodes[n] for n in row[:4]) / 4
        area += sum(
            0.5 * numpy.linalg.norm(numpy.cross(rim[i] - middle, rim[(i + 1) % 8] - middle)) for i in range(8)
        )
    return area * (1600 * 0.012 if "PLY" in text else 7850 * 0.01)


def difference(one, other):
    return max(abs(a / b - 1.0) for a, b in zip(one, other))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    parser.add_argument("--elements", type=int, help="along each side, other than in the samples")
    parser.add_argument("--ccx", help="CalculiX, to find its numbers again")
    arguments = parser.parse_args()
    if arguments.elements and not arguments.ccx:
        parser.error("--elements needs --ccx")
    complaints = []
    for name, make in samples.SAMPLES.items():
        text = make(arguments.elements) if arguments.elements else make()
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            found, mass = culm(Program(arguments.culm), name, text, folder)
            reference = calculix(arguments.ccx, name, text, folder) if arguments.ccx else CALCULIX[name]
        expected_mass = mass_of_file(text)
        print(f"{name}: mass {mass:.6g} kg, of the file {expected_mass:.6g} kg")
        if abs(mass / expected_mass - 1.0) > 1e-8:
            complaints.append(f"{name}: the mass is {mass}, not {expected_mass}")
        pairs = [([found[0]], [reference[0]]), (found[1], reference[1]), (found[2], reference[2])]
        for what, (ours, theirs), allowed in zip(("deflection", "frequencies", "buckling"), pairs, AGREEMENT[name]):
            print(f"  {what}: culm {', '.join(f'{x:.5g}' for x in ours)}; CalculiX {', '.join(f'{x:.5g}' for x in theirs)}")
            if not difference(ours, theirs) <= allowed:
                complaints.append(f"{name}: {what} differ by {difference(ours, theirs):.2%}, more than {allowed:.2%}")
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
