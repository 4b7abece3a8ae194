#!/usr/bin/env python3
"""Files of SubDyn, HydroDyn and MoorDyn as decks, beside what follows from their numbers without culm.

usage: offshore.py --culm PROGRAM
"""

import argparse
import csv
import pathlib
import re
import sys
import tempfile

import numpy as np
import scipy.integrate
import scipy.linalg
import scipy.optimize
from reading import made_of_text  # noqa: F401  (puts culm's Python on the path)
from culm.program import Program

ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLES = (ROOT / "packages/openfast/test/offshore_files.hpp").read_text(encoding="utf-8")


def sample(name):
    """A file of the unit tests."""
    return re.search(name + r'_file = R"~\((.*?)\)~"', SAMPLES, re.S)[1]


def change(text, old, new):
    if text.count(old) != 1:
        sys.exit(f"'{old}' stands {text.count(old)} times in a sample")
    return text.replace(old, new)


class Imports:
    """Imports texts and runs the decks, in a folder that vanishes."""

    def __init__(self, program):
        self.program = program
        self.folder = tempfile.TemporaryDirectory(prefix="culm")
        self.complaints = []

    def run(self, files, settings=()):
        """The report of the import of the first of the files, the history and the table of modes of its deck."""
        folder = pathlib.Path(self.folder.name)
        for name, text in files.items():
            (folder / name).write_text(text)
        deck = folder / "deck.xml"
        for old in (deck, deck.with_suffix(".report.txt")):
            old.unlink(missing_ok=True)
        done = self.program.call("import", "openfast", folder / next(iter(files)), "--output", deck)
        if done.returncode != 0:
            sys.exit(done.stderr)
        run = self.program.run(deck, folder / "out", list(settings))
        if not run.succeeded:
            sys.exit(run.errors)
        with open(run.folder / "history.csv") as file:
            rows = list(csv.reader(file))
        history = dict(zip(rows[0], (float(value) if value else np.nan for value in rows[-1])))
        modes = run.folder / "analyses/modes/modes.csv"
        frequencies = [float(row[1]) for row in list(csv.reader(open(modes)))[1:]] if modes.exists() else []
        return done.stdout, history, frequencies

    def check(self, what, found, wanted, tolerance):
        found, wanted = np.atleast_1d(found).astype(float), np.atleast_1d(wanted).astype(float)
        error = np.linalg.norm(found - wanted) / np.linalg.norm(wanted)
        print(f"{what}: {np.array2string(found, precision=6)}, reference {np.array2string(wanted, precision=6)}, relative error {error:.1e}")
        if not error <= tolerance:
            self.complaints.append(f"{what}: {found}, not {wanted}")


# The frame of the samples, with rigid joints instead of a ball and without its cable: joints, members with their sections.
JOINTS = {11: (-5, 0, -20), 12: (5, 0, -20), 13: (-5, 0, 10), 14: (5, 0, 10), 15: (5, 8, 10)}
TUBES = {1: (2.1e11, 8.08e10, 7850, 2.0, 0.04), 2: (2.1e11, 8.08e10, 7850, 1.0, 0.02)}
MEMBERS = [(11, 13, 1, 2), (12, 14, 1, 1), (13, 14, 7, 7), (14, 15, 1, 1), (15, 12, 2, 2)]


def values(section):
    """EA, GA along x and y, EI about x and y, GJ, mass and its moments about x and y, per length."""
    if section == 7:
        E, G, rho, A, Ax, Ay, Jx, Jy, J0 = 2e11, 8e10, 8000, 0.1, 0.05, 0.06, 0.01, 0.02, 0.03
        return np.array([E * A, G * Ax, G * Ay, E * Jx, E * Jy, G * J0, rho * A, rho * Jx, rho * Jy])
    E, G, rho, d, t = TUBES[section]
    inner = d - 2 * t
    A, I = np.pi / 4 * (d**2 - inner**2), np.pi / 64 * (d**4 - inner**4)
    nu, m = E / (2 * G) - 1, (inner / d) ** 2
    k = 6 * (1 + nu) ** 2 * (1 + m) ** 2 / ((1 + m) ** 2 * (7 + 14 * nu + 8 * nu**2) + 4 * m * (5 + 10 * nu + 4 * nu**2))
    return np.array([E * A, k * G * A, k * G * A, E * I, E * I, 2 * G * I, rho * A, rho * I, rho * I])


def bending(h, EI, GA):
    """Stiffness against v1, r1, v2, r2 with v' = r, with shear."""
    s = 12 * EI / (GA * h**2)
    return EI / (h**3 * (1 + s)) * np.array(
        [[12, 6 * h, -12, 6 * h], [6 * h, (4 + s) * h**2, -6 * h, (2 - s) * h**2],
         [-12, -6 * h, 12, -6 * h], [6 * h, (2 - s) * h**2, -6 * h, (4 + s) * h**2]])


def inertia(h, m, J):
    return m * h / 420 * np.array(
        [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2],
         [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]]) + J / (30 * h) * np.array(
        [[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -h**2], [-36, -3 * h, 36, -3 * h], [3 * h, -h**2, -3 * h, 4 * h**2]])


def element(h, section):
    """Stiffness and mass in the axes of a member: displacements and rotations of both ends."""
    EA, GAx, GAy, EIx, EIy, GJ, m, Jx, Jy = section
    K, M = np.zeros((12, 12)), np.zeros((12, 12))
    line = np.array([[1, -1], [-1, 1]]) / h
    spread = np.array([[2, 1], [1, 2]]) * h / 6
    K[np.ix_([2, 8], [2, 8])] += EA * line
    M[np.ix_([2, 8], [2, 8])] += m * spread
    K[np.ix_([5, 11], [5, 11])] += GJ * line
    M[np.ix_([5, 11], [5, 11])] += (Jx + Jy) * spread
    across = [0, 4, 6, 10]  # x with the rotation about y
    K[np.ix_(across, across)] += bending(h, EIy, GAx)
    M[np.ix_(across, across)] += inertia(h, m, Jy)
    turn = np.diag([1, -1, 1, -1])  # y with minus the rotation about x
    other = [1, 3, 7, 9]
    K[np.ix_(other, other)] += turn @ bending(h, EIx, GAy) @ turn
    M[np.ix_(other, other)] += turn @ inertia(h, m, Jx) @ turn
    return K, M


def axes(way):
    """Of a member, as rows: x horizontal, to the right of its horizontal direction."""
    z = way / np.linalg.norm(way)
    across = np.hypot(way[0], way[1])
    x = np.array([1.0, 0, 0]) if across < 1e-9 else np.array([way[1], -way[0], 0]) / across
    return np.array([x, np.cross(z, x), z])


# Of the ground below joint 12: a pile by its head, which sways and turns at once, and the soil that goes with it.
GROUND_STIFFNESS = np.diag([4e8, 6e8, 3e9, 9e10, 7e10, 2e10])
GROUND_STIFFNESS[0, 4] = GROUND_STIFFNESS[4, 0] = -3e9
GROUND_STIFFNESS[1, 3] = GROUND_STIFFNESS[3, 1] = 4e9
GROUND_MASS, GROUND_CENTRE, GROUND_INERTIA = 3e5, np.array([0.5, 0, -3.0]), np.diag([2e6, 3e6, 1e6])


def body(mass, c, inertia):
    """Mass matrix about a point, with the centre at c from there."""
    skew = np.array([[0, -c[2], c[1]], [c[2], 0, -c[0]], [-c[1], c[0], 0]])
    return np.block([[mass * np.eye(3), -mass * skew], [mass * skew, inertia - mass * skew @ skew]])


def ground_file():
    """The upper triangles, column by column."""
    names = ["x", "y", "z", "tx", "ty", "tz"]
    text = "Ground below a pile\nValue Name\n"
    for letter, matrix in (("K", GROUND_STIFFNESS), ("M", body(GROUND_MASS, GROUND_CENTRE, GROUND_INERTIA))):
        for j in range(6):
            text += "".join(f"{matrix[i, j]:.12E}  {letter}{names[i]}{names[j]}\n" for i in range(j + 1))
    return text


def frame_frequencies(parts=48, soft=False):
    """@param soft  whether joint 12 stands on the ground alone"""
    place = {joint: i for i, joint in enumerate(JOINTS)}
    size = 6 * (len(JOINTS) + (parts - 1) * len(MEMBERS))
    K, M = np.zeros((size, size)), np.zeros((size, size))
    free = len(JOINTS)
    for first, second, a, b in MEMBERS:
        way = np.subtract(JOINTS[second], JOINTS[first]).astype(float)
        T = np.kron(np.eye(4), axes(way))
        nodes = [place[first], *range(free, free + parts - 1), place[second]]
        free += parts - 1
        for i in range(parts):
            share = (i + 0.5) / parts
            k, m = element(np.linalg.norm(way) / parts, (1 - share) * values(a) + share * values(b))
            at = [6 * node + j for node in nodes[i:i + 2] for j in range(6)]
            K[np.ix_(at, at)] += T.T @ k @ T
            M[np.ix_(at, at)] += T.T @ m @ T
    at = range(6 * place[14], 6 * place[14] + 6)
    M[np.ix_(at, at)] += body(5e4, np.array([0, 0, 2.0]), np.diag([1e5, 2e5, 3e5]))
    for j in range(3):
        M[6 * place[15] + j, 6 * place[15] + j] += 1e3
    held = [*range(6 * place[11], 6 * place[11] + 6), *range(6 * place[12], 6 * place[12] + (0 if soft else 3))]
    if soft:
        at = range(6 * place[12], 6 * place[12] + 6)
        K[np.ix_(at, at)] += GROUND_STIFFNESS
        M[np.ix_(at, at)] += body(GROUND_MASS, GROUND_CENTRE, GROUND_INERTIA)
    left = [i for i in range(size) if i not in held]
    squares = scipy.linalg.eigh(K[np.ix_(left, left)], M[np.ix_(left, left)], eigvals_only=True, subset_by_index=[0, 5])
    return np.sqrt(squares) / (2 * np.pi)


def subdyn(imports):
    text = change(sample("subdyn"), "2            NDiv", "24            NDiv")
    text = change(text, " 15        5.0       8.0       10.0       4 ", " 15        5.0       8.0       10.0       1 ")
    text = change(text, "6            NMembers", "5            NMembers")
    text = change(text, " 5          13        15         9           9         2     -1\n", "")
    text = change(text, "2            NInterf", "1            NInterf")
    text = change(text, " 14        1        1        1        1        1        1\n----", "----")
    out, history, frequencies = imports.run({"sub.dat": text}, ["Analyses/modes/Start From=Reference", "Analyses/modes/Inactive={weight}"])
    lengths = [np.linalg.norm(np.subtract(JOINTS[b], JOINTS[a])) for a, b, *_ in MEMBERS]
    beams = sum(0.5 * h * (values(a)[6] + values(b)[6]) for h, (*_, a, b) in zip(lengths, MEMBERS))
    imports.check("SubDyn, mass [kg]", float(re.search(r"\n *total +\d+ +\d+ +(\S+)", out)[1]), beams + 51000, 1e-5)
    weight = sum(history[f"joint {joint} Fz [N]"] for joint in (11, 12))
    imports.check("SubDyn, weight on its supports [N]", weight, 9.80665 * (beams + 51000), 1e-6)
    imports.check("SubDyn, frequencies [Hz]", frequencies[:6], frame_frequencies(), 5e-4)
    soft = change(text, " 12        1        1        1        0        0        0       \"\"",
                  " 12        0        0        0        0        0        0       \"ground.dat\"")
    _, _, frequencies = imports.run({"sub.dat": soft, "ground.dat": ground_file()},
                                    ["Analyses/modes/Start From=Reference", "Analyses/modes/Inactive={weight}"])
    imports.check("SubDyn on soft ground, frequencies [Hz]", frequencies[:6], frame_frequencies(soft=True), 5e-4)


def coefficient(table, depth):
    return np.interp(depth, [0.0, 10.0], table)


def hydrodyn(imports):
    """Pressure and drag in still water with a current, by the numbers of the file."""
    sea = change(sample("seastate"), "2         WaveMod", "0         WaveMod")
    _, history, _ = imports.run({"hydro.dat": sample("hydrodyn"), "sea.dat": sea})
    rho, g = 1025.0, 9.80665

    def leg(z):
        """Diameter with growth, drag coefficient of the first member."""
        grown = -15.0 < z < -2.0
        bare = 6.0 - 3.0 * (z + 20.0001) / 30.0001
        drag = coefficient([1.0, 1.4] if grown else [0.7, 0.9], -z)
        return bare + (0.2 if grown else 0.0), drag

    def along(function):
        return sum(scipy.integrate.quad(function, a, b, epsrel=1e-11)[0]
                   for a, b in ((-20.0, -15.0), (-15.0, -10.0), (-10.0, -2.0), (-2.0, 0.0)))

    speed = lambda z: 0.5 * (1.0 + z / 20.0) ** (1.0 / 7.0)  # noqa: E731
    volume = along(lambda z: np.pi / 4 * leg(z)[0] ** 2) - np.pi / 4 * leg(-20.0)[0] ** 2 * 20.0
    brace = np.linalg.norm([6.0, 8.0])
    volume += np.pi / 4 * (3.2**2 - 2.9**2) * brace
    growth = along(lambda z: np.pi / 4 * (leg(z)[0] ** 2 - (leg(z)[0] - 0.2) ** 2) * (-15.0 < z < -2.0))
    growth += np.pi / 4 * (3.2**2 - 3.0**2) * brace
    lift = rho * g * volume - 1325.0 * g * growth + brace_drag(rho, brace, speed)[2]
    imports.check("HydroDyn, pressure of still water less weight of growth [N]", -history["force of the sea Fz [N]"], lift, 2e-4)
    drag = along(lambda z: 0.5 * rho * leg(z)[1] * leg(z)[0] * speed(z) ** 2)
    wanted = drag * np.array([np.cos(np.pi / 6), np.sin(np.pi / 6)]) + brace_drag(rho, brace, speed)[:2]
    found = -np.array([history["force of the sea Fx [N]"], history["force of the sea Fy [N]"]])
    imports.check("HydroDyn, drag of a current [N]", found, wanted, 2e-3)


def brace_drag(rho, length, speed):
    """Drag across the brace, from (10, 0, -12) to (10, 6, -4), coefficient 0.5 to 0.8, and along on its faces."""
    t = np.array([0.0, 6.0, 8.0]) / length
    heading = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6), 0.0])
    total = np.zeros(3)
    for s, weight in zip(*np.polynomial.legendre.leggauss(40)):
        share = 0.5 * (1 + s)
        u = speed(-12.0 + 8.0 * share) * heading
        across = u - (u @ t) * t
        total += 0.5 * weight * length * 0.5 * rho * (0.5 + 0.3 * share) * 3.2 * np.linalg.norm(across) * across
    for z in (-12.0, -4.0):
        w = speed(z) * heading @ t
        total += 0.5 * rho * 0.6 * np.pi / 4 * 3.2**2 * abs(w) * w * t
    return total


def moordyn(imports):
    """The elastic catenary of the first line."""
    _, history, _ = imports.run({"lines.dat": sample("moordyn")})
    w = (120.0 - 1025.0 * np.pi / 4 * 0.08**2) * 9.81
    L, EA, x, z = 435.0, 7.5e8, 380.0, 186.0

    def misses(force):
        H, V = np.exp(force)
        if V < w * L:  # a part lies on the seabed
            lying = L - V / w
            return [lying + H / w * np.arcsinh(V / H) + H * L / EA - x, H / w * (np.hypot(1, V / H) - 1) + V**2 / (2 * EA * w) - z]
        a, b = V / H, (V - w * L) / H
        return [H / w * (np.arcsinh(a) - np.arcsinh(b)) + H * L / EA - x,
                H / w * (np.hypot(1, a) - np.hypot(1, b)) + (V * L - w * L**2 / 2) / EA - z]

    H, V = np.exp(scipy.optimize.fsolve(misses, np.log([4e5, 4.5e5]), xtol=1e-13))
    imports.check("MoorDyn, H and V of line 1 [N]", [history["line 1 H [N]"], history["line 1 V [N]"]], [H, V], 1e-8)


def monopile(imports):
    """All modules of a turbine on a pile as one deck, beside the deck of the same turbine that was made by hand."""
    folder = pathlib.Path(imports.folder.name)
    deck = folder / "monopile.xml"
    done = imports.program.call("import", "openfast", ROOT / "inputs/turbine/nrel5mw/openfast/oc3_monopile.fst",
                                "--output", deck)
    if done.returncode != 0:
        sys.exit(done.stderr)

    def modes(deck, settings, *analyses):
        run = imports.program.run(deck, folder / "modes", settings)
        if not run.succeeded:
            sys.exit(run.errors)
        tables = [csv.reader(open(run.folder / "analyses" / one / "modes.csv")) for one in analyses]
        return [[float(row[1]) for row in list(table)[1:7]] for table in tables]

    # the hand-made one has six elements of order 1 in the pile, other elements in the blades, and steps of the wall
    by_hand, by_hand_dry = modes(ROOT / "inputs/offshore/oc3_monopile/modes.xml", [], "wet", "dry")
    (found,) = modes(deck, ["end=step"], "modes")
    imports.check("OpenFAST with SubDyn and HydroDyn, bending of the tower [Hz]", found[:2], by_hand[:2], 1e-3)
    imports.check("and flap of the blades [Hz]", found[2:], by_hand[2:], 5e-3)
    (dry,) = modes(deck, ["end=step", "Flows/sea/Density=1e-3"], "modes")
    imports.check("and by what the water lowers them [Hz]", dry[1] - found[1], by_hand_dry[1] - by_hand[1], 0.05)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    imports = Imports(Program(parser.parse_args().culm))
    subdyn(imports)
    hydrodyn(imports)
    moordyn(imports)
    monopile(imports)
    sys.exit("\n".join(imports.complaints) if imports.complaints else 0)


if __name__ == "__main__":
    main()
