#!/usr/bin/env python3
"""A turbine whose blades have a file of BeamDyn each: masses and centres beside sums over these files.

usage: blades.py --culm PROGRAM
"""

import argparse
import pathlib
import re
import shutil
import sys
import tempfile

import numpy
from reading import ROOT
from culm.program import Program

TURBINE = ROOT / "inputs/turbine/nrel5mw/openfast"
BLADE = ROOT / "inputs/turbine/generic_blade"
SHARES = {1: (1.0, 1.0), 2: (1.3, 1.0), 3: (1.0, 0.9)}  # of the mass per length, of the lengths along the span
TOLERANCE = 2e-3  # the deck has 17 straight elements to a blade


def write_files(folder):
    """The turbine of the decks, with three blades that differ in their masses and lengths."""
    shutil.copytree(TURBINE, folder, dirs_exist_ok=True)
    axis, sections = (BLADE / "beamdyn.inp").read_text(), (BLADE / "blade.inp").read_text()
    for number, (heavy, long) in SHARES.items():
        own = axis.replace('"blade.inp"', f'"sections{number}.inp"')
        (folder / f"axis{number}.inp").write_text(with_key_points(own, key_points(axis) * [1, 1, long, 1]))
        given = sections if number < 3 else sections.replace(" 1   damp_type", " 0   damp_type")
        (folder / f"sections{number}.inp").write_text(with_masses(given, heavy))
    scene = (folder / "nrel5mw.fst").read_text()
    scene = scene.replace("1   CompElast", "2   CompElast").replace("2   CompAero", "0   CompAero")
    scene += "".join(f'"axis{number}.inp"   BDBldFile({number}) - (quoted string)\n' for number in SHARES)
    (folder / "blades.fst").write_text(scene)


def number_rows(text, columns):
    """Places of the lines that hold exactly so many numbers."""
    found = []
    for i, line in enumerate(text.splitlines()):
        try:
            words = [float(word) for word in line.split()]
        except ValueError:
            continue
        if len(words) == columns:
            found.append((i, words))
    return found


def key_points(text):
    return numpy.array([words for _, words in number_rows(text, 4)])


def with_key_points(text, points):
    lines = text.splitlines()
    for (i, _), point in zip(number_rows(text, 4), points):
        lines[i] = " ".join(f"{value:.8g}" for value in point)
    return "\n".join(lines) + "\n"


def with_masses(text, factor):
    """Of the matrices, which follow each other, every second one has masses; factors of damping stand before them."""
    lines = text.splitlines()
    for at, (i, words) in enumerate(number_rows(text, 6)[1:]):
        if at // 6 % 2 == 1:
            lines[i] = " ".join(f"{factor * value:.8g}" for value in words)
    return "\n".join(lines) + "\n"


def expected(folder, number):
    """Mass, and distance of its centre from the root, by sums over the files; densities linear over the arc length."""
    points = key_points((folder / f"axis{number}.inp").read_text())[:, :3]
    text = (folder / f"sections{number}.inp").read_text()
    spans = [words[0] for _, words in number_rows(text, 1)]
    rows = [words for _, words in number_rows(text, 6)[1:]]
    densities = [rows[12 * i + 6][0] for i in range(len(spans))]
    pieces = numpy.concatenate([[0], numpy.cumsum(numpy.linalg.norm(numpy.diff(points, axis=0), axis=1))])
    s = numpy.linspace(0, 1, 100001)
    m = numpy.interp(s, spans, densities) * pieces[-1]
    axis = numpy.array([numpy.interp(s, pieces / pieces[-1], points[:, i]) for i in range(3)]).T
    step = numpy.full(len(s), 1 / (len(s) - 1))
    step[[0, -1]] /= 2
    mass = (m * step).sum()
    return mass, numpy.linalg.norm((m * step) @ axis / mass)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    program = Program(parser.parse_args().culm)
    complaints = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_files(folder)
        done = program.call("import", "openfast", folder / "blades.fst", "--output", folder / "deck.xml")
        if done.returncode != 0:
            sys.exit(done.stderr)
        if "axis3.inp: without damping by mu it has that of ElastoDyn's blade" not in done.stdout:
            complaints.append("that a blade has the damping of the other file is not told")
        model = program.call("check", folder / "deck.xml").stdout
        deck = (folder / "deck.xml").read_text()
        for number in SHARES:
            found = [float(word) for word in re.search(rf"^blade {number} +\d+ +\d+ +(.*)$", model, re.M)[1].split()]
            points = re.search(rf'<ParameterList name="blade {number}">.*?name="Points" value="{{(.*?)}}"', deck, re.S)[1]
            root = numpy.array([float(word) for word in points.split(",")[:3]])
            values = found[0], numpy.linalg.norm(found[1:4] - root)
            for what, value, reference in zip(("mass", "centre from the root"), values, expected(folder, number)):
                error = value / reference - 1.0
                print(f"blade {number}: {what} {value:.6g}, by its own file {reference:.6g}, off by {error:.1e}")
                if not abs(error) < TOLERANCE:
                    complaints.append(f"blade {number}: {what} is {value:g}, its file has {reference:g}")
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
