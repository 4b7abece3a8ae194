#!/usr/bin/python3
"""The NREL 5 MW turbine on the OC3 monopile, clamped and in sand. Page: doc/verification/oc3_monopile.md."""

import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np
import scipy.linalg
from verify import INPUTS, main

FOLDER = "offshore/oc3_monopile"
MODES, SOIL, OPERATION = (f"{FOLDER}/{name}.xml" for name in ("modes", "soil", "operation"))

# Load case 1.2 of OC3, phase I: medians of the participants and their standard deviations [Hz], as listed by Ashes
# (simis.io/docs/oc3-phase-i-load-case-12) from Jonkman et al. (2010), figure 6; the mode of culm that is compared.
PUBLISHED = [("tower fore-aft", 2, 0.2785, 0.004854), ("tower side-to-side", 1, 0.2773, 0.004582),
             ("flap, yaw", 4, 0.6288, 0.02937), ("flap, pitch", 5, 0.6643, 0.01431), ("flap, collective", 6, 0.6955, 0.01434)]

# Stiffness of the ground at the bed by which OC3 replaced the pile below, horizontal and rocking [N/m, N, N m]: from memory.
GROUND = np.array([[2.57481e9, -2.25325e10], [-2.25325e10, 2.62912e11]])
PUSH = np.array([3.91e6, 124.385e6])

E, G, RHO, GRAVITY = 210e9, 80.8e9, 8500.0, 9.80665
FOOT, JOINT, TOP = -20.0, 10.0, 87.6


def section(z):
    """Radius and wall of the support at a height [m]."""
    if z < JOINT:
        return 3.0, 0.06
    share = (z - JOINT) / (TOP - JOINT)
    return 0.5 * (6.0 + share * (3.87 - 6.0)), 0.027 + share * (0.019 - 0.027)


def head(culm):
    """Mass of what stands on the tower, its first moments and its inertia about the y-axis, about the top of the tower."""
    by_mass, by_inertia = culm.check(MODES).split("inertia about the centre")

    def numbers(text):
        found = [re.match(r"(nacelle|generator|hub|blade \d) +(.*)", line) for line in text.splitlines()]
        return {one[1]: [float(x) for x in one[2].split()] for one in found if one}

    masses = {name: row[2:] for name, row in numbers(by_mass).items()}
    inertias = {name: row[1] for name, row in numbers(by_inertia).items()}
    m = sum(one[0] for one in masses.values())
    x = sum(one[0] * one[1] for one in masses.values())
    z = sum(one[0] * (one[3] - TOP) for one in masses.values())
    inertia = sum(inertias[name] + one[0] * (one[1] ** 2 + (one[3] - TOP) ** 2) for name, one in masses.items())
    return m, x, z, inertia


def matrices(count=160):
    """Stiffness and mass of the support in bending, two-node beams with shear, clamped; and the weight carried."""
    nodes = np.concatenate([np.linspace(FOOT, JOINT, count // 4, endpoint=False), np.linspace(JOINT, TOP, count)])
    size = 2 * len(nodes)
    K, M, S = (np.zeros((size, size)) for _ in range(3))
    pieces = []
    for a, b in zip(nodes, nodes[1:]):
        radius, wall = section(0.5 * (a + b))
        inner = radius - wall
        area, second = math.pi * (radius**2 - inner**2), 0.25 * math.pi * (radius**4 - inner**4)
        pieces.append((a, b, area, second))
    weights = [RHO * area * (b - a) for a, b, area, _ in pieces]
    for i, (a, b, area, second) in enumerate(pieces):
        h = b - a
        shear = 12.0 * E * second / (0.53 * G * area * h**2)
        at = slice(2 * i, 2 * i + 4)
        K[at, at] += E * second / (h**3 * (1.0 + shear)) * np.array(
            [[12, 6 * h, -12, 6 * h], [6 * h, (4 + shear) * h**2, -6 * h, (2 - shear) * h**2],
             [-12, -6 * h, 12, -6 * h], [6 * h, (2 - shear) * h**2, -6 * h, (4 + shear) * h**2]])
        M[at, at] += RHO * area * h / 420.0 * np.array(
            [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2],
             [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]])
        M[at, at] += RHO * second / (30.0 * h) * np.array(
            [[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -h**2], [-36, -3 * h, 36, -3 * h], [3 * h, -h**2, -3 * h, 4 * h**2]])
        S[at, at] += 1.0 / (30.0 * h) * np.array(
            [[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -h**2], [-36, -3 * h, 36, -3 * h],
             [3 * h, -h**2, -3 * h, 4 * h**2]]) * (sum(weights[i + 1:]) + 0.5 * weights[i])
    # the part of S that the head adds has the same form in each piece
    L = np.zeros((size, size))
    for i, (a, b, *_) in enumerate(pieces):
        h, at = b - a, slice(2 * i, 2 * i + 4)
        L[at, at] += 1.0 / (30.0 * h) * np.array(
            [[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -h**2], [-36, -3 * h, 36, -3 * h], [3 * h, -h**2, -3 * h, 4 * h**2]])
    return K, M, GRAVITY * S, GRAVITY * L


def fore_aft(culm):
    """The first frequency with a rigid head, under its weight [Hz]."""
    m, _, z, inertia = head(culm)
    K, M, S, L = matrices()
    K = K - S - m * L
    K[-1, -1] -= GRAVITY * z  # the head leans over
    M[-2:, -2:] += np.array([[m, z], [z, 0.0]]) + np.array([[0.0, 0.0], [0.0, inertia]])
    values = scipy.linalg.eigh(K[2:, 2:], M[2:, 2:], eigvals_only=True, subset_by_index=[0, 0])
    return math.sqrt(values[0]) / (2.0 * math.pi)


def verify_clamped(culm, report):
    report.title("Clamped at the bed, at rest [Hz]")
    rigid = [f"Structures/blade {i}/Fidelity=Rigid" for i in (1, 2, 3)]
    found = culm.table("dry/modes", MODES, rigid).column("frequency [Hz]")
    wanted = fore_aft(culm)
    report.relative("fore-aft with rigid blades, an independent model of beams with shear", min(found[:2], key=lambda f: abs(f - wanted)),
                    wanted, 2e-3)
    tables = culm.succeed(MODES).tables
    dry, wet = (tables[f"{name}/modes"].column("frequency [Hz]") for name in ("dry", "wet"))
    for name, mode, median, deviation in PUBLISHED:
        report.check(f"{name}, median of OC3", wet[mode - 1], median, 2.0 * deviation)
        report.note(f"  {(wet[mode - 1] - median) / deviation:+.1f} standard deviations; dry {dry[mode - 1]:.4f}")


def verify_soil(culm, report):
    report.title("In sand")
    run = culm.succeed(SOIL)
    history = run.history
    at = history.levels.index(0.25)  # of the push
    head_ux, turn = (history.column(name) for name in ("head ux [m]", "turn ry [rad]"))
    found = [head_ux[-1] - head_ux[at - 1], turn[-1] - turn[at - 1]]
    wanted = np.linalg.solve(GROUND, PUSH)
    report.relative("bed under 3.91 MN and 124.385 MN m: displacement [m]", found[0], wanted[0], 0.05)
    report.relative("rotation [rad]", found[1], wanted[1], 0.05)
    at_rest, loaded = (run.tables[f"{name}/modes"].column("frequency [Hz]") for name in ("at_rest", "under_load"))
    report.check("fore-aft at rest, OC3 about [Hz]", at_rest[1], 0.25, 0.0125)
    report.note(f"under the load {loaded[1]:.4f} Hz")


def verify_operation(culm, report):
    report.title("In wind and waves, 5 s")
    run = culm.run(OPERATION, ["end=5"], quiet=False)
    report.holds("energy balance", run.drift("energy balance"), 1e-9)
    report.holds("steps repeated", run.cut_back(), 0)


def verify(culm, report):
    verify_clamped(culm, report)
    verify_soil(culm, report)
    verify_operation(culm, report)


def wave_force(height=6.0, period=10.0, depth=20.0, diameter=6.0, density=1025.0, inertia=2.0):
    """Standard deviation of the inertia of irregular waves on the pile up to still water [N], by JONSWAP."""
    ratio = period / math.sqrt(height)
    peak = 5.0 if ratio <= 3.6 else 1.0 if ratio >= 5.0 else math.exp(5.75 - 1.15 * ratio)
    f = np.linspace(0.5 / period, 4.0 / period, 20001)
    sigma = np.where(f <= 1.0 / period, 0.07, 0.09)
    S = f**-5.0 * np.exp(-1.25 * (f * period) ** -4.0) * peak ** np.exp(-0.5 * ((f * period - 1.0) / sigma) ** 2)
    S *= height**2 / 16.0 / np.trapz(S, f)
    w = 2.0 * math.pi * f
    k = w**2 / GRAVITY
    for _ in range(60):
        k = k - (GRAVITY * k * np.tanh(k * depth) - w**2) / (
            GRAVITY * np.tanh(k * depth) + GRAVITY * k * depth / np.cosh(k * depth) ** 2)
    area = 0.25 * math.pi * diameter**2
    return math.sqrt(np.trapz((density * area * inertia * w**2 / k) ** 2 * S, f))


def fine(culm, report):
    """A whole case of 600 s in turbulence of 12 m/s with a deviation of 2.04 m/s."""
    report.title("600 s in turbulence and waves: mean, deviation, smallest, largest after 60 s")
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        box = pathlib.Path(folder) / "wind.bts"
        subprocess.run([sys.executable, "-m", "culm.turbulence", box, *"--speed 12 --deviation 2.04 --height 90 --size 145 145 "
                        "--points 13 13 --duration 620 --step 0.2 --seed 1".split()], check=True,
                       env={**os.environ, "PYTHONPATH": str(INPUTS.parent / "src/python")})
        deck = (INPUTS / OPERATION).read_text()
        flow = re.search(r'<ParameterList name="wind">.*?</ParameterList>', deck, re.S)[0]
        turbulent = f'''<ParameterList name="wind">
      <Parameter name="Type" value="TurbSim Box"/>
      <Parameter name="Density" value="1.225"/>
      <Parameter name="File Name" value="{box}"/>
      <Parameter name="Centre" value="{{0, 0, 90}}"/>
    </ParameterList>'''
        deck = deck.replace(flow, turbulent).replace('href="', f'href="{(INPUTS / OPERATION).parent}/')
        path = pathlib.Path(folder) / "whole.xml"
        path.write_text(deck)
        run = culm.run(path, ["end=600", "Output/Every=4000"], quiet=False)
    history = run.history
    late = np.array(history.levels) > 60.0
    for name in ("rotor power [W]", "rotor thrust [N]", "rotor speed [rad/s]", "pitch [1]", "tower base My [N m]", "bed My [N m]",
                 "bed Fx [N]", "waves Fx [N]"):
        values = np.array(history.column(name))[late]
        report.note(f"{name}: {values.mean():.4g}, {values.std():.4g}, {values.min():.4g}, {values.max():.4g}")
    report.holds("energy balance", run.drift("energy balance"), 1e-9)
    waves = np.array(history.column("waves Fx [N]"))[late].std()
    report.relative("deviation of the waves on the pile, inertia by JONSWAP [N]", waves, wave_force(), 0.1)


if __name__ == "__main__":
    main(verify, fine=fine)
