#!/usr/bin/python3
"""DY-3: right-angle cantilever. Page: doc/verification/right_angle_cantilever.md."""

import math

import numpy as np
from verify import figure, main, save

DECK = "beam/right_angle_cantilever.xml"
# out-of-plane displacement over time in Simo and Vu-Quoc's figure, digitised by the authors of
# AeroBeams.jl (test/referenceData/elbowFrame)
ELBOW = [
    (0.60, 0.29), (1.53, 2.86), (2.21, 4.71), (3.05, 5.50), (3.82, 4.78), (4.63, 3.36),
    (5.71, 2.57), (6.91, 2.69), (7.90, 1.96), (8.69, 0.04), (9.61, -2.34), (10.82, -3.87),
    (11.81, -2.43), (12.63, -0.09), (13.69, 1.16), (15.14, 0.30), (16.19, -0.96),
    (17.61, -1.27), (19.09, -1.37), (20.37, -2.64), (21.69, -1.99), (22.55, 0.31),
    (23.47, 3.21), (24.71, 5.95), (26.16, 5.24), (27.74, 3.81), (29.36, 1.27)
]
TIP = [
    (0.81, 0.03), (2.14, 0.13), (2.92, 1.37), (3.90, 3.37), (5.20, 5.78), (6.29, 7.38),
    (7.19, 8.23), (8.21, 8.16), (9.25, 6.47), (9.91, 5.01), (10.53, 3.23), (11.22, 0.76),
    (11.73, -2.13), (12.53, -5.49), (13.30, -7.46), (14.64, -8.62), (15.99, -9.67),
    (17.16, -8.51), (18.11, -6.24), (19.05, -3.44), (19.93, -0.47), (20.59, 2.36),
    (21.52, 5.19), (23.07, 6.59), (24.35, 6.02), (26.08, 6.98), (27.52, 5.59), (28.27, 3.08),
    (29.67, 1.27)
]
# a list of FinEtoolsFlexStructures.jl (simo_vuquoc_examples.jl), there compared with the elbow
LIST = [
    (0.95, 0.03), (2.33, 2.39), (3.86, 5.09), (5.16, 7.24), (6.58, 8.32), (8.28, 6.78),
    (9.26, 4.42), (10.33, 1.15), (11.28, -3.47), (12.26, -7.07), (13.76, -8.54),
    (15.06, -9.21), (16.87, -6.66), (18.57, -1.89), (19.63, 2.58), (20.89, 5.51),
    (22.75, 6.78), (24.48, 6.15), (25.82, 7.50), (26.96, 5.47), (27.79, 2.84), (29.41, 0.81)
]
# EXUDYN's test model, 40 elements per leg, 0.005 s, generalised-alpha without dissipation: peaks
PEAKS = {"tip uz [m]": [(7.44, 8.25), (15.87, -9.73)], "elbow uz [m]": [(10.87, -4.06)]}
END = "Analyses/motion/End Time"
STEP = "Analyses/motion/Step"


def linear_frame(elements, length=10.0, bending=1e3, torsion=1e3, shear=1e6, inertia=10.0):
    """Stiffness and mass of the frame's small motion out of its plane, root removed.

    Timoshenko beams with linear shape functions; (w, rotation x, rotation y) per node, first leg
    along x, second one along y.
    """
    size = 3 * (2 * elements + 1)
    stiffness, mass = np.zeros((size, size)), np.zeros((size, size))
    h = length / elements
    slope, mean = np.array([-1.0, 1.0]) / h, np.array([0.5, 0.5])
    for e in range(2 * elements):
        bend, twist, sign = (2, 1, 1.0) if e < elements else (1, 2, -1.0)
        at = {dof: [3 * e + dof, 3 * e + 3 + dof] for dof in range(3)}
        for dof, modulus in ((bend, bending), (twist, torsion)):
            stiffness[np.ix_(at[dof], at[dof])] += modulus * h * np.outer(slope, slope)
        angle = np.concatenate([slope, sign * mean])
        both = at[0] + at[bend]
        stiffness[np.ix_(both, both)] += shear * h * np.outer(angle, angle)
        consistent = h / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])
        for dof, density in ((0, 1.0), (bend, inertia), (twist, 2.0 * inertia)):
            mass[np.ix_(at[dof], at[dof])] += density * consistent
    return stiffness[3:, 3:], mass[3:, 3:]


def linear_response(times, force, elements=100):
    """Displacements of elbow and tip under the triangular pulse, mode by mode, exact in time."""
    stiffness, mass = linear_frame(elements)
    factor = np.linalg.cholesky(mass)
    values, vectors = np.linalg.eigh(
        np.linalg.solve(factor, np.linalg.solve(factor, stiffness).T))
    modes = np.linalg.solve(factor.T, vectors)
    omega = np.sqrt(values)

    def after_ramp(start):  # of a load that grows by 1 per second from `start` on
        t = np.maximum(times - start, 0.0)[:, None]
        return (t - np.sin(omega * t) / omega) / values

    elbow, tip = modes[3 * (elements - 1)], modes[3 * (2 * elements - 1)]
    amplitudes = force * elbow * (after_ramp(0.0) - 2.0 * after_ramp(1.0) + after_ramp(2.0))
    return amplitudes @ elbow, amplitudes @ tip


def fine(culm):
    return culm.history(DECK, ["N=40", f"{STEP}=0.005"])


def peak(history, column, near):
    """Time and value of the extremum within 0.5 s, by a parabola through three points."""
    values, times = history.column(column), history.levels
    around = [i for i, t in enumerate(times) if abs(t - near) < 0.5]
    i = max(around, key=lambda k: abs(values[k]))
    a, b, c = values[i - 1 : i + 2]
    shift = 0.5 * (a - c) / (a - 2.0 * b + c)
    return times[i] + shift * (times[i + 1] - times[i]), b - 0.25 * (a - c) * shift


def deviations(history, column, points):
    times, values = zip(*points)
    return np.abs(np.interp(times, history.levels, history.column(column)) - np.array(values))


def verify_linear(culm, report):
    report.title("Small force: modal solution of the linear frame, 10 s, relative to the largest")
    force = 1e-2
    history = culm.history(DECK, [f"F={force}", "N=40", f"{STEP}=0.0125", f"{END}=10"])
    exact = linear_response(np.array(history.levels), force)
    for column, reference in zip(("elbow uz [m]", "tip uz [m]"), exact):
        error = np.max(np.abs(history.column(column) - reference)) / np.max(np.abs(reference))
        report.holds(column, error, 2e-3)


def verify_peaks(report, history):
    report.title("Peaks: EXUDYN, same data, 40 elements per leg, 0.005 s")
    for column, peaks in PEAKS.items():
        for time, value in peaks:
            found = peak(history, column, time)
            report.check(f"{column}: time [s]", found[0], time, 0.02)
            report.check(f"{column}: value [m]", found[1], value, 0.02)


def verify_curves(report, history):
    report.title("Figure of Simo and Vu-Quoc, digitised, over 30 s: largest difference over 10 m")
    for column, points in (("elbow uz [m]", ELBOW), ("tip uz [m]", TIP)):
        found = deviations(history, column, points)
        report.holds(column, float(np.max(found)) / 10.0, 0.1)
        early = float(max(d for d, (t, _) in zip(found, points) if t <= 20.0))
        report.note(f"until 20 s {early:.2f} m, root mean square {np.sqrt(np.mean(found**2)):.2f} m")


def verify_energy(report, history):
    report.title("Energy after the pulse")
    energies = history.column("energy total [J]")[history.row(2.0) :]
    drift = max(abs(e - energies[0]) for e in energies) / energies[0]
    report.holds("drift over 28 s, relative", drift, 1e-9)


def verify_orders(culm, report):
    report.title("Order of convergence of the tip at 6 s")

    def order(settings):
        a, b, c = (culm.history(DECK, [*one, f"{END}=6"]).vector("tip") for one in settings)
        return math.log2(math.dist(a, b) / math.dist(b, c))

    meshes = [[f"N={n}", f"{STEP}=0.05"] for n in (10, 20, 40)]
    report.check("in the mesh, 10, 20, 40 elements", order(meshes), 2.0, 0.1)
    steps = [["N=10", f"{STEP}={h}"] for h in (0.02, 0.01, 0.005)]
    report.check("in the step, 0.02, 0.01, 0.005 s", order(steps), 2.0, 0.05)


def verify_list(report, history):
    report.title("A list that is not the elbow's; not asserted")
    times, values = (np.array(x) for x in zip(*LIST))

    def spread(column, shift):
        curve = np.interp(times + shift, history.levels, history.column(column))
        return math.sqrt(np.mean((curve - values) ** 2))

    shift = min(np.arange(0.0, 1.5, 0.01), key=lambda s: spread("tip uz [m]", s))
    for what, column, by in (("elbow", "elbow uz [m]", 0.0), ("tip", "tip uz [m]", 0.0),
                             (f"tip {shift:.2f} s later", "tip uz [m]", shift)):
        report.note(f"root mean square difference from the {what}: {spread(column, by):.2f} m")
    elbow, tip = linear_response(np.array([1.54]), 50.0)
    report.note(f"linear theory at 1.54 s: elbow {elbow[0]:.2f} m, tip {tip[0]:.2f} m; list 0.93 m")


def verify(culm, report):
    verify_linear(culm, report)
    history = fine(culm)
    verify_peaks(report, history)
    verify_curves(report, history)
    verify_energy(report, history)
    verify_orders(culm, report)
    verify_list(report, history)


def plot(culm, path):
    fig, (curves, early) = figure(2)
    history = fine(culm)
    for name, points, color in (("elbow", ELBOW, "C0"), ("tip", TIP, "C1")):
        column = history.column(f"{name} uz [m]")
        curves.plot(history.levels, column, color, label=name)
        curves.plot(*zip(*points), color + "o", markersize=3)
        first = [i for i, t in enumerate(history.levels) if t <= 2.0]
        early.plot([history.levels[i] for i in first], [column[i] for i in first], color, label=name)
    curves.plot(*zip(*LIST), "kx", markersize=3, label="list")
    curves.set(title="lines culm, dots Simo and Vu-Quoc", xlabel="t [s]", ylabel="u out of plane [m]")
    curves.legend()
    times = np.linspace(0.0, 2.0, 21)
    for values, color in zip(linear_response(times, 50.0), ("C0", "C1")):
        early.plot(times, values, color + ".", markersize=4)
    early.plot(*zip(*[p for p in LIST if p[0] < 2.0]), "kx", markersize=4, label="list")
    early.set(title="begin: dots linear theory", xlabel="t [s]", ylabel="u out of plane [m]")
    early.legend()
    save(fig, path)


main(verify, plot)
