#!/usr/bin/env python3
"""Air of OpenFAST's files: what of it stands in the deck, and thrust and torque beside those of a deck that was not imported.

usage: openfast.py --culm PROGRAM
"""

import argparse
import pathlib
import re
import sys
import tempfile

import numpy
from reading import ROOT
from culm.program import Program

FOLDER = ROOT / "inputs/turbine/nrel5mw"
FILES = FOLDER / "openfast"
DECK = FOLDER / "turbine_gust.xml"

# imported, the deck by hand has rotors with wakes that follow, no lags and no yaw; its tower is stiff in torsion
ALIKE = ["torsion=100", "end=4", "Flows/wind/Exponent=0.2", "Loads/induction/Induction=Dynamic", "Loads/yaw spring/Stiffness=1e13"]
ALIKE += [f"Loads/air on blade {i}/Lag=None" for i in (1, 2, 3)]
# the deck by hand has the axes of its beams at the quarter chord, and the twist of its beams
QUARTER = ", ".join(["0.25"] * 19)
PLAIN = [f"Loads/air on blade {i}/Axes At={{{QUARTER}}}" for i in (1, 2, 3)]
PLAIN += [f"Loads/air on blade {i}/Twists={{{', '.join(['0'] * 19)}}}" for i in (1, 2, 3)]
STEADY = ["start=1000", "end=4", "stations=30"]


def rows_of(path, columns):
    """Lines that hold so many numbers."""
    found = []
    for line in path.read_text().splitlines():
        try:
            found.append([float(word) for word in line.split()[:columns]])
        except ValueError:
            continue
    return numpy.array([row for row in found if len(row) == columns])


def sums_agree(report, complaints):
    """Area of a blade and its centre, by sums on a fine grid."""
    blade = rows_of(FILES / "aerodyn_blade.dat", 7)
    r = numpy.linspace(0.0, blade[-1, 0], 200001)
    chord = numpy.interp(r, blade[:, 0], blade[:, 5])
    share = numpy.gradient(r) * numpy.where((r == 0) | (r == r[-1]), 0.5, 1.0)  # of the trapezoidal rule
    area, moment = (chord * share).sum(), (chord * r * share).sum()
    told = re.search(r"area (\S+) m\^2, its centre (\S+) m", report)
    for name, found, expected in (("area", told[1], area), ("centre of the area", told[2], moment / area)):
        if abs(float(found) / expected - 1.0) > 1e-5:
            complaints.append(f"the {name} is told as {found}, the file has {expected:.6g}")


def lists_of(deck, name):
    """Numbers of the parameters of this name."""
    found = re.findall(rf'<Parameter name="{name}" value="{{([^}}]*)}}"', deck)
    return [numpy.array([float(word) for word in one.split(",")]) for one in found]


def deck_has_the_files(deck, complaints):
    """Chords, and places of the axis by the offsets of the quarter chord: 0.375 where the blade is an airfoil."""
    blade = rows_of(FILES / "aerodyn_blade.dat", 7)
    chords, axes = lists_of(deck, "Chords"), lists_of(deck, "Axes At")
    if not numpy.allclose(chords[0], blade[:, 5]):
        complaints.append("the chords are not those of the file")
    offset = numpy.hypot(blade[:, 1], blade[:, 2])
    if not numpy.allclose(axes[0], 0.25 + offset / blade[:, 5], atol=1e-6):
        complaints.append("the quarter chords do not lie in front of the axis as in the file")
    polars = [rows_of(FILES / f"airfoils/{name}.dat", 4) for name in ("du21_a17", "naca64_a17")]
    for number, polar in zip((6, 7), polars):
        for column, name in enumerate(("Angles", "Lift", "Drag", "Moment")):
            text = re.findall(rf'name="{name}" value="{{([^}}]*)}}"', deck)[number]
            if not numpy.allclose([float(word) for word in text.split(",")], polar[:, column]):
                complaints.append(f"{name} of airfoil {number + 1} are not those of the file")


def thrust_and_torque(program, deck, folder, overrides, name):
    run = program.run(deck, folder, overrides)
    if not run.succeeded:
        sys.exit(run.errors)
    history = run.history
    late = numpy.array(history.levels) > 2.0
    return [numpy.array(history.column(f"{name} {what}"))[late] for what in ("thrust [N]", "torque [N m]")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    program = Program(parser.parse_args().culm)
    complaints = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = folder / "turbine.xml"
        done = program.call("import", "openfast", FILES / "nrel5mw.fst", "--blade-mass", "17740", "--output", deck)
        if done.returncode != 0:
            sys.exit(done.stderr)
        sums_agree(done.stdout, complaints)
        deck_has_the_files(deck.read_text(), complaints)
        for wind, speed in ((8.0, 9.156), (11.4, 12.1)):
            where = [f"V={wind}", f"W={speed}"]
            by_hand = thrust_and_torque(program, DECK, folder / f"{wind} by hand", [*where, *STEADY], "rotor")
            for kind, settings, tolerance in (("imported", [], 0.01), ("axes at the quarter chord", PLAIN, 2e-3)):
                found = thrust_and_torque(
                    program, deck, folder / f"{wind} {kind}", [*where, *ALIKE, *settings], "aerodynamics"
                )
                for what, one, expected in zip(("thrust", "torque"), found, by_hand):
                    worst, mean = numpy.abs(one / expected - 1.0).max(), (one / expected - 1.0).mean()
                    print(f"{wind} m/s, {kind}: {what} {one[-1]:.6g}, off by {worst:.2e} at most, {mean:.2e} in the mean")
                    if not worst < tolerance:
                        complaints.append(f"{wind} m/s, {kind}: {what} is off by {worst:.2e}, allowed {tolerance:g}")
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
