#!/usr/bin/python3
"""A cylinder down to the bed by potential flow: surge and pitch. Page: doc/verification/water.md.

--write FOLDER writes the files cylinder.1, .3 and .hst that the deck reads.
"""

import math
import pathlib
import re
import sys

import numpy as np
import scipy.optimize
import scipy.special as special
from verify import main

DECK = "water/potential_cylinder.xml"
RHO, G, DEPTH, RADIUS = 1025.0, 9.81, 20.0, 5.0
MASS, INERTIA, SPRING, RESTORING = 1.2e6, 2e8, 4e5, 1.5e8  # of the deck; the last one of the .hst
FREQUENCIES = np.linspace(0.1, 4.0, 79)


def number(w):
    """Of waves of a frequency [1/m]."""
    return scipy.optimize.brentq(lambda k: G * k * math.tanh(k * DEPTH) - w**2, 1e-9, w**2 / G + 2.0 * w / math.sqrt(G * DEPTH))


def evanescent(w, count):
    """Numbers of what decays away from the body: w^2 = -g k tan kd."""
    ends = [((n - 0.5) * math.pi / DEPTH, n * math.pi / DEPTH) for n in range(1, count + 1)]
    return np.array([scipy.optimize.brentq(lambda k: w**2 * math.cos(k * DEPTH) + G * k * math.sin(k * DEPTH), a, b) for a, b in ends])


def spread(ratio, first, square):
    """Forces in surge and pitch by velocities there, of one profile with R / R' at the body."""
    return np.outer(first, first) / square * ratio


def coefficients(w, count=400):
    """Added mass and damping in surge and pitch [kg, kg m, kg m^2; per second]."""
    k = number(w)
    h, slope = special.hankel2(1, k * RADIUS), special.h2vp(1, k * RADIUS)
    total = spread(h / (k * slope), *propagating(k))
    for q in evanescent(w, count):
        total = total + spread(decay_ratio(q), *decaying(q))
    total = -RHO * math.pi * RADIUS * total
    return total.real, -w * total.imag


def decay_ratio(q):
    return special.kve(1, q * RADIUS) / (q * (-special.kve(0, q * RADIUS) - special.kve(1, q * RADIUS) / (q * RADIUS)))


def propagating(k):
    """Integrals of f cosh k(z + d) / cosh kd for f = 1, z, and of its square."""
    kd = k * DEPTH
    at_bed = 2.0 * math.exp(-kd) / (1.0 + math.exp(-2.0 * kd))  # 1 / cosh kd
    return np.array([math.tanh(kd) / k, (at_bed - 1.0) / k**2]), 0.5 * math.tanh(kd) / k + 0.5 * DEPTH * at_bed**2


def decaying(q):
    """The same of cos q(z + d)."""
    qd = q * DEPTH
    return np.array([math.sin(qd) / q, (math.cos(qd) - 1.0) / q**2]), 0.5 * DEPTH + 0.25 * math.sin(2.0 * qd) / q


def infinite_mass(count=4000):
    total = np.zeros((2, 2))
    for n in range(1, count + 1):
        q = (n - 0.5) * math.pi / DEPTH
        total += spread(decay_ratio(q), *decaying(q))
    return -RHO * math.pi * RADIUS * total


def excitation(w):
    """Forces in surge and pitch per amplitude, of cos wt at the axis, after MacCamy and Fuchs."""
    k = number(w)
    return 4.0 * RHO * G / (k * special.h2vp(1, k * RADIUS)) * propagating(k)[0]


def write(folder):
    """WAMIT's files with ULEN = 1."""
    kinds = ((0, 0, 1, 1), (0, 1, 1, 5), (1, 0, 5, 1), (1, 1, 5, 5))
    A = infinite_mass()
    lines = [f"0.0 {i} {j} {A[a, b] / RHO:.12e}" for a, b, i, j in kinds]
    waves = []
    for w in FREQUENCIES[::-1]:
        A, B = coefficients(w)
        period = 2.0 * math.pi / w
        lines += [f"{period:.12e} {i} {j} {A[a, b] / RHO:.12e} {B[a, b] / (RHO * w):.12e}" for a, b, i, j in kinds]
        X = excitation(w) / (RHO * G)
        waves += [f"{period:.12e} 0.0 {i} {abs(x):.12e} {np.degrees(np.angle(x)):.9e} {x.real:.12e} {x.imag:.12e}" for i, x in ((1, X[0]), (5, X[1]))]
    folder = pathlib.Path(folder)
    (folder / "cylinder.1").write_text("\n".join(lines) + "\n")
    (folder / "cylinder.3").write_text("\n".join(waves) + "\n")
    (folder / "cylinder.hst").write_text(f"5 5 {RESTORING / (RHO * G):.12e}\n")


def verify_coefficients(report):
    report.title("Coefficients of the cylinder")
    w = 1.1
    k = number(w)
    _, B = coefficients(w)
    speed = 0.5 * w / k * (1.0 + 2.0 * k * DEPTH / math.sinh(2.0 * k * DEPTH))
    X = excitation(w)
    haskind = k / (8.0 * RHO * G * speed) * np.real(np.outer(X, np.conj(X)))
    report.relative("damping by Haskind's relation", list(B.ravel()), list(haskind.ravel()), 1e-10)


def kernel(times):
    """Cummins' kernel, from the damping up to 40 rad/s."""
    w = np.concatenate([np.linspace(1e-3, 6.0, 1200), np.linspace(6.0, 40.0, 800)[1:]])
    B = np.array([coefficients(one, 1)[1] for one in w])  # what decays has no part in it
    return np.array([2.0 / math.pi * np.trapz(B * np.cos(w * t)[:, None, None], w, axis=0) for t in times])


def free_decay(start, end, step):
    """Motions of the body after it is let go, by convolution, with steps of the second order."""
    M = np.diag([MASS, INERTIA]) + infinite_mass()
    K = np.diag([SPRING, RESTORING])
    count = int(round(end / step))
    memory = kernel(step * np.arange(count + 1))
    x, v = np.zeros((count + 1, 2)), np.zeros((count + 1, 2))
    x[0] = start
    # (v1 - v0) M / h = -(K x + radiated) in the middle; the radiated force by the trapezoidal rule at both ends
    past = np.zeros(2)
    left = M / step + 0.25 * step * K + 0.25 * step * memory[0]
    for n in range(count):
        known = 0.5 * step * memory[n + 1] @ v[0]
        if n > 0:
            known = known + step * np.einsum("kij,kj->i", memory[n:0:-1], v[1:n + 1])
        right = (M / step - 0.25 * step * K) @ v[n] - K @ x[n] - 0.5 * (past + known)
        v[n + 1] = np.linalg.solve(left, right)
        x[n + 1] = x[n] + 0.5 * step * (v[n] + v[n + 1])
        past = known + 0.5 * step * memory[0] @ v[n + 1]
    return x


def verify_decay(culm, report):
    report.title("Let go: 0.05 m and 0.001 rad, against convolution, over the start")
    history = culm.history(DECK, ["Flows/sea/Height=0", "push=0.05", "step=0.025", "end=40", "Loads/water/Poles=8"])
    surge, pitch = (np.array(history.column(name)) / 0.05 for name in ("body ux [m]", "turn ry [rad]"))
    coarse, fine = (free_decay([1.0, 0.02], 40.0, step) for step in (0.05, 0.025))
    wanted = fine[::2] + (fine[::2] - coarse) / 3.0
    report.holds("surge, largest difference", np.max(np.abs(surge[::2] - wanted[:, 0])), 1e-3)
    report.holds("pitch, largest difference", np.max(np.abs(pitch[::2] - wanted[:, 1])) / 0.02, 3e-3)
    run = culm.run(DECK, ["Flows/sea/Height=0", "push=0.05", "end=40"], quiet=False)
    report.holds("energy balance", run.drift("energy balance"), 1e-12)
    radiated = -float(re.search(r"work of loads +(\S+) J", run.output)[1])
    report.holds("energy radiated, below zero [J]", max(0.0, -radiated), 0.0)


def verify_waves(culm, report):
    report.title("In waves of 2 cm: motion of their frequency, in phase and a quarter behind")
    for period in (6.0, 9.0):
        w = 2.0 * math.pi / period
        A, B = coefficients(w)
        Z = -w**2 * (np.diag([MASS, INERTIA]) + A) + 1j * w * B + np.diag([SPRING, RESTORING])
        wanted = np.linalg.solve(Z, 0.01 * excitation(w))
        history = culm.history(DECK, ["Flows/sea/Height=0.02", f"Flows/sea/Period={period}", f"Flows/sea/Rise={40 * period}", "push=0",
                                      f"step={period / 120!r}", f"end={60 * period}", "Loads/water/Poles=8", "Output/Every=1000"])
        phase = np.exp(-1j * w * np.array(history.levels))[-1200:]
        for name, one in (("body ux [m]", wanted[0]), ("turn ry [rad]", wanted[1])):
            found = 2.0 * np.mean(np.array(history.column(name))[-1200:] * phase)
            report.relative(f"{period:g} s, {name}", [found.real, found.imag], [one.real, one.imag], 1e-2)


def verify(culm, report):
    verify_coefficients(report)
    verify_decay(culm, report)
    verify_waves(culm, report)


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "--write":
        write(sys.argv[2])
    else:
        main(verify)
