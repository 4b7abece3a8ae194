#!/usr/bin/python3
"""NREL 5 MW: the blade by BeamDyn's examples, the turbine. Page: doc/verification/nrel5mw.md."""

import functools
import math
import pathlib
import re
import time
import xml.etree.ElementTree as ElementTree

import numpy as np
from rod import Rod
from verify import figure, main, richardson, save

INPUTS = pathlib.Path(__file__).resolve().parents[2] / "inputs/turbine/nrel5mw"
STATIC, DYNAMIC = "turbine/nrel5mw/blade_static.xml", "turbine/nrel5mw/blade_dynamic.xml"
STANDSTILL = "turbine/nrel5mw/turbine_modes.xml"
CAMPBELL = "turbine/nrel5mw/blade_campbell.xml"
OPERATION = "turbine/nrel5mw/turbine_operation.xml"
LENGTH, ROOT, SPEED = 61.5, 1.0, 1.0006
# BeamDyn at 0.01 s: r-test of OpenFAST, bd_5MW_dynamic_gravity_Az90; blade horizontal, at rest,
# gravity along -y, mu = 1e-3. Tip displacement x, y, z in the axes of the root.
BEAMDYN = {
    0.10: (1.73450881e-3, -4.61099292e-2, -4.55473125e-5),
    0.20: (-1.40464547e-2, -3.26605134e-1, -1.01107682e-3),
    0.30: (-1.44682959e-2, -6.51135948e-1, -4.49145935e-3),
    0.40: (3.92736638e-2, -8.03169376e-1, -6.42171223e-3),
    0.47: (7.90453386e-2, -8.74622779e-1, -7.91327186e-3),
}
BRAKE = 28116.2 * 97.0  # N m
# About the shaft: blades by mass and moments about their roots (report, table 2-1), 1.5 m outside, coned
# by 2.5 degrees; hub; generator times ratio squared [kg m^2]
INERTIA = (3.0 * math.cos(math.radians(2.5)) ** 2 * (11776047.0 + 2.0 * 1.5 * 363231.0 + 1.5**2 * 17740.0)
           + 115926.0 + 534.116 * 97.0**2)
# Sections that kink between nodes make the error fall with the square of the mesh width, unevenly.
MESHES = [(24, 1, 6e-3), (48, 1, 1.5e-3), (96, 1, 4e-4), (24, 2, 4e-4), (48, 2, 2e-4), (96, 2, 5e-5),
          (192, 2, 1e-5), (24, 3, 4e-4), (96, 3, 5e-5), (192, 3, 1e-5)]
AT_REST = [
    "Constraints/root/Angle=0",
    "Initial Conditions/spin/Angular Velocity={0, 0, 0}",
    "Structures/blade/Damping=0.001",
]

# Name, FAST, ADAMS (NREL/TP-500-38060, table 9-1), DeSiO (workshop of May 2021, slide 54) [Hz]
MODES = [
    ("tower fore-aft 1", 0.3240, 0.3195, 0.310),
    ("tower side-to-side 1", 0.3120, 0.3164, 0.314),
    ("drive-train torsion", 0.6205, 0.6094, 0.620),
    ("flap 1, yaw", 0.6664, 0.6296, 0.673),
    ("flap 1, pitch", 0.6675, 0.6686, 0.681),
    ("flap 1, collective", 0.6993, 0.7019, 0.918),
    ("edge 1, pitch", 1.0793, 1.0740, 1.047),
    ("edge 1, yaw", 1.0898, 1.0877, 1.081),
    ("flap 2, yaw", 1.9337, 1.6507, 1.925),
    ("flap 2, pitch", 1.9223, 1.8558, 1.926),
    ("flap 2, collective", 2.0205, 1.9601, None),
    ("tower fore-aft 2", 2.9003, 2.8590, None),
    ("tower side-to-side 2", 2.9361, 2.9408, None),
]
MASSES = {"tower": 347460.0, "nacelle": 239999.0, "generator": 1.0, "hub": 56780.0,
          "blade 1": 17740.0, "blade 2": 17740.0, "blade 3": 17740.0}


def mesh(elements, order=2):
    return [f"Structures/blade/Curve/Elements={elements}", f"Structures/blade/Order={order}"]


def numbers(element, name):
    for parameter in element.iter("Parameter"):
        if parameter.get("name") == name:
            return np.array([float(v) for v in parameter.get("value").strip("{}\n ").split(",")])
    raise KeyError(name)


def read_blade():
    """Places, stiffness matrices and twist of the deck, read without culm."""
    beam = ElementTree.parse(INPUTS / "blade_static.xml").getroot()
    sections = ElementTree.parse(INPUTS / "include/blade_sections.xml").getroot()
    matrices = []
    for section in sections:
        upper = np.zeros((6, 6))
        upper[np.triu_indices(6)] = numbers(section, "Stiffness")
        matrices.append(upper + np.triu(upper, 1).T)
    twist = np.radians(numbers(beam, "Pre-Twist"))
    return (numbers(beam, "Section Positions"), np.array(matrices),
            numbers(beam, "Pre-Twist Positions"), twist)


def integrate(parts):
    """Tip displacement by integration of the rod, in equal parts between stations and key points."""
    places, matrices, twist_places, twist = read_blade()
    slopes = np.diff(twist) / np.diff(twist_places) / LENGTH

    @functools.lru_cache(maxsize=None)
    def stiffness(s):
        span = min(max(s / LENGTH, 0.0), 1.0)
        i = min(int(np.searchsorted(places, span, side="right")), len(places) - 1)
        t = (span - places[i - 1]) / (places[i] - places[i - 1])
        return (1.0 - t) * matrices[i - 1] + t * matrices[i]

    @functools.lru_cache(maxsize=None)
    def compliance(s):
        return np.linalg.inv(stiffness(s))

    @functools.lru_cache(maxsize=None)
    def curvature(s):
        i = int(np.searchsorted(twist_places, s / LENGTH, side="right"))
        return np.array([0.0, 0.0, slopes[min(max(i - 1, 0), len(slopes) - 1)]])

    c, s = math.cos(twist[0]), math.sin(twist[0])
    breaks = LENGTH * np.unique(np.round(np.concatenate((places, twist_places)), 9))
    ends = [np.linspace(a, b, parts, endpoint=False) for a, b in zip(breaks, breaks[1:])]
    rod = Rod(LENGTH, stiffness, [[c, -s, 0], [s, c, 0], [0, 0, 1]], curvature=curvature,
              steps=np.append(np.concatenate(ends), LENGTH))
    rod.compliance = compliance
    states = rod.solve(load=lambda s, r: (np.array([1e4, 0.0, 0.0]), np.zeros(3)), levels=3)
    return [float(v) for v in states[-1][0] - np.array([0.0, 0.0, LENGTH])]


def turned(history):
    """Tip displacements at tenths of a second in the axes that turn with the root."""
    tips = []
    for i in range(0, 51):
        u = np.array(history.vector("tip", i / 10)) + np.array([0.0, 0.0, ROOT + LENGTH])
        c, s = math.cos(SPEED * i / 10), math.sin(SPEED * i / 10)
        tips.append([u[0], c * u[1] + s * u[2], -s * u[1] + c * u[2] - ROOT - LENGTH])
    return np.array(tips)


def difference(found, wanted):
    """The largest over time, over the largest displacement."""
    return float(np.max(np.linalg.norm(found - wanted, axis=1))
                 / np.max(np.linalg.norm(wanted, axis=1)))


def verify_static(culm, report):
    report.title("Blade under 10 kN/m in x: displacement of the tip [m]")
    coarse, fine = integrate(2), integrate(4)
    report.relative("integration of the rod, 2 and 4 steps per station", coarse, fine, 5e-6)
    for elements, order, tolerance in MESHES:
        tip = culm.history(STATIC, mesh(elements, order)).vector("tip")
        report.relative(f"{elements} elements of order {order}", tip, fine, tolerance)


def verify_dynamic(culm, report):
    report.title("Turning blade: tip in the axes of the root, largest difference over 5 s")
    short = ["Analyses/motion/End Time=5"]
    runs = {}
    for step in (0.02, 0.01, 0.005, 0.0025):
        run = culm.run(DYNAMIC, [*short, f"Analyses/motion/Step={step}"], quiet=False)
        report.holds(f"step {step} s: energy balance", run.drift("energy balance"), 1e-9)
        runs[step] = turned(run.history)
    limit = richardson(runs[0.005], runs[0.0025])
    for step, tolerance in [(0.02, 8e-2), (0.01, 2e-2), (0.005, 5e-3)]:
        report.holds(f"step {step} s against the limit", difference(runs[step], limit), tolerance)
    fine = turned(culm.history(DYNAMIC, [*short, *mesh(96)]))
    report.holds("24 elements against 96", difference(runs[0.01], fine), 1e-2)
    at_end = ", ".join(f"{v:.4f}" for v in limit[-1])
    report.note(f"limit after 5 s: {at_end} m")

    report.title("Blade at rest, horizontal, released under its weight: tip [m]")
    history = culm.history(DYNAMIC, AT_REST + ["Analyses/motion/End Time=0.5"])
    for time, wanted in BEAMDYN.items():
        tip = history.vector("tip", time)
        report.check(f"BeamDyn at {time} s", tip, list(wanted), 0.02)


def find_modes(culm, settings=()):
    """Frequencies in the order of MODES, told apart by effective masses and inertias."""
    table = culm.run(STANDSTILL, settings).tables["modes/modes"]
    frequency = table.column("frequency [Hz]")
    mass = {axis: table.column(f"effective mass {axis} [kg]") for axis in "xy"}
    yaw = table.column("effective inertia z [kg m^2]")
    fore_aft, side = sorted((0, 1), key=lambda i: -mass["x"][i])
    pitch_1, yaw_1 = sorted((3, 4), key=lambda i: yaw[i])
    pitch_2, yaw_2 = sorted((8, 9), key=lambda i: yaw[i])
    high = range(11, 15)
    fore_aft_2 = max(high, key=lambda i: mass["x"][i])
    side_2 = max(i for i in high if mass["y"][i] > 0.02 * sum(MASSES.values()))
    rows = [fore_aft, side, 2, yaw_1, pitch_1, 5, 6, 7, yaw_2, pitch_2, 10, fore_aft_2, side_2]
    return [frequency[i] for i in rows]


def verify_modes(culm, report):
    report.title("Masses [kg]")
    masses = culm.check(STANDSTILL).split("inertia about the centre")[0]
    found = dict(re.findall(r"^(\w+(?: \d)?) +\d+ +\d+ +([\d.e+]+)", masses, re.M))
    for name, wanted in MASSES.items():
        report.relative(name, float(found[name]), wanted, 1e-3)
    report.title("Modes at standstill [Hz] (MO-1); tower rigid in torsion as in FAST, and not, as in ADAMS")
    rigid, soft = find_modes(culm), find_modes(culm, ["torsion=1"])
    report.note(f"{'':22} {'FAST':>8} {'ADAMS':>8} {'DeSiO':>8} {'culm':>8} {'torsion':>8}")
    for (name, *printed), a, b in zip(MODES, rigid, soft):
        cells = [f"{v:8.4f}" if v else f"{'-':>8}" for v in (*printed, a, b)]
        report.note(f"{name:22} " + " ".join(cells))
    for (name, fast, adams, _), a, b in zip(MODES, rigid, soft):
        report.relative(f"{name}, FAST", a, fast, 5e-2)
        report.relative(f"{name}, ADAMS", b, adams, 5e-2)


def verify_rotating(culm, report):
    report.title("Modes of the blade at 12.1 rpm [Hz]; 3 %")
    table = culm.run(CAMPBELL).tables["campbell/campbell"]
    still, turning = ([table.at(row, f"frequency {i} [Hz]") for i in (1, 2, 3)] for row in (1, 5))
    report.note("at rest: " + ", ".join(f"{f:.4f}" for f in still))
    for name, found, wanted in zip(("flap 1", "edge 1", "flap 2"), turning, (0.7343, 1.1083, 2.0177)):
        report.relative(name, found, wanted, 3e-2)


def verify_operation(culm, report):
    report.title("Start-up and emergency stop, 200 s in steps of 0.01 s")
    start = time.perf_counter()
    run = culm.run(OPERATION, quiet=False)
    wall = time.perf_counter() - start
    report.check("exit code", run.exit, 0, 0)
    report.note(f"{wall:.1f} s for 200 s, output included: {200.0 / wall:.0f} times real time")
    cuts = re.findall(r"steps accepted, (\d+) cut back", run.output)
    report.check("steps cut back", [int(n) for n in cuts], [0] * len(cuts), 0)
    for name, drift in zip(("start-up", "stop"), re.findall(r"energy balance +(\S+)", run.output)):
        report.holds(f"{name}: energy balance", float(drift), 1e-8)
    levels = run.history.levels
    first = next(i for i in range(1, len(levels)) if levels[i] < levels[i - 1])  # after the weight
    times = np.array(run.history.levels[first:])
    angle = np.array(run.history.column("rotor [rad]")[first:])
    speed = np.diff(angle) / np.diff(times)
    operating = float(np.mean(speed[(times[1:] > 80.0) & (times[1:] < 100.0)]))
    report.relative("speed from 80 to 100 s [rpm]", operating * 30.0 / math.pi, 12.1, 1e-3)
    report.holds("largest speed over the last 50 s [rad/s]", float(np.max(np.abs(speed[-5000:]))), 1e-2)
    # the brake takes the angular momentum at a constant rate until it creeps
    below = float(times[1:][(times[1:] > 100.0) & (speed < 0.05)][0]) - 100.0
    inertia = BRAKE * below / (operating - 0.05)
    report.relative("inertia about the shaft from the time of braking [kg m^2]", inertia, INERTIA, 1e-2)


def verify(culm, report):
    verify_static(culm, report)
    verify_dynamic(culm, report)
    verify_modes(culm, report)
    verify_rotating(culm, report)
    verify_operation(culm, report)


def plot(culm, path):
    fig, (left, right, modes) = figure(3)
    limit = integrate(2)
    for order, counts in [(1, (12, 24, 48, 96, 192)), (2, (6, 12, 24, 48, 96)), (3, (4, 8, 16, 32, 64))]:
        errors = [math.dist(culm.history(STATIC, mesh(n, order)).vector("tip"), limit)
                  / math.hypot(*limit) for n in counts]
        left.loglog([n * order + 1 for n in counts], errors, ".-", label=f"culm, order {order}")
    left.set(xlabel="nodes", ylabel="relative error of the tip [-]", title="Static, 10 kN/m")
    left.legend(fontsize=7)
    history = culm.history(DYNAMIC, AT_REST + ["Analyses/motion/End Time=0.5"])
    for c, name in enumerate("xy"):
        right.plot(history.levels, history.column(f"tip u{name} [m]"), label=f"culm, u{name}")
        right.plot(list(BEAMDYN), [u[c] for u in BEAMDYN.values()], "ks", mfc="none",
                   label="BeamDyn" if c == 0 else None)
    right.set(xlabel="time [s]", ylabel="tip [m]", title="Released horizontally")
    right.legend(fontsize=7)
    rigid, soft = find_modes(culm), find_modes(culm, ["torsion=1"])
    places = np.arange(len(MODES))
    for i, (label, marker) in enumerate((("FAST", "ks"), ("ADAMS", "kD"), ("DeSiO", "k^"))):
        modes.plot(places, [m[i + 1] or np.nan for m in MODES], marker, mfc="none", ms=5, label=label)
    modes.plot(places, rigid, "_", ms=11, mew=2, label="culm")
    modes.plot(places, soft, "_", ms=11, mew=2, label="culm, tower twists")
    modes.set_xticks(places, [m[0] for m in MODES], rotation=60, ha="right", fontsize=6)
    modes.set(ylabel="frequency [Hz]", title="Modes at standstill")
    modes.legend(fontsize=7)
    save(fig, path)
    plot_operation(culm, path.replace(".png", "_operation.png"))


def plot_operation(culm, path):
    history = culm.history(OPERATION)
    first = next(i for i in range(1, len(history.levels))
                 if history.levels[i] < history.levels[i - 1])
    times = np.array(history.levels[first:])
    angle = np.array(history.column("rotor [rad]")[first:])
    fig, (left, middle, right) = figure(3)
    left.plot(times[1:], np.diff(angle) / np.diff(times) * 30.0 / np.pi)
    left.set(xlabel="time [s]", ylabel="speed of the rotor [rpm]", title="Start-up and emergency stop")
    middle.plot(times, np.array(history.column("shaft M [N m]")[first:]) / 1e6)
    middle.set(xlabel="time [s]", ylabel="moment in the shaft [MN m]")
    for name in ("x", "y"):
        right.plot(times, history.column(f"tower top u{name} [m]")[first:], lw=0.8, label=f"u{name}")
    right.set(xlabel="time [s]", ylabel="top of the tower [m]")
    right.legend(fontsize=7)
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
