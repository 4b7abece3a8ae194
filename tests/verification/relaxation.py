#!/usr/bin/python3
"""Viscoelastic beams and shells: relaxation, creep, loss per cycle in closed form. Page: doc/verification/dynamics.md."""

import math

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.linalg import expm

from verify import main, romberg

ROD, SHEET = "beam/relaxing_rod.xml", "shell/relaxing_sheet.xml"
G, T = 0.5, 1.0  # ratio and time of the branch, of both decks
# lasting stiffness, moved nodes, what is watched
STIFFNESS = {ROD: 1.0, SHEET: 0.5}
END = {ROD: "rod/last", SHEET: "right"}
HELD = {ROD: ["rod/first"], SHEET: ["shell/0", "shell/6"]}
WATCHED = {ROD: "tip ux [m]", SHEET: "corner ux [m]"}
TAKEN = "energy taken by dampers"


def runs(culm, deck, length, h, settings):
    """With steps h, h/2, h/4, h/8."""
    always = [f"Analyses/motion/End Time={length}", "Analyses/motion/Newton/Force Tolerance=1e-13", *settings]
    return [culm.run(deck, [*always, f"Analyses/motion/Step={h / 2**k}"], quiet=False) for k in range(4)]


def check(report, what, values, exact, tolerance=1e-8):
    order = math.log2(abs(values[1] - exact) / abs(values[2] - exact))
    report.check(f"{what}: order", order, 2.0, 0.05)
    report.holds(f"{what}: limit of the steps, of {exact:.9g},", abs(romberg(values, (2, 4, 6)) - exact), tolerance)


def check_balance(report, what, run):
    report.holds(f"{what}: energy balance,", run.drift("energy balance"), 1e-11)


def verify_motions(culm, report):
    report.title("m u'' + k (u + g d) = F, d' = u' - d/T: pushed, and creep under a force")
    rates = np.array([[0.0, 1.0, 0.0, 0.0], [-1.0, 0.0, -G, 1.0], [0.0, 1.0, -1.0 / T, 0.0], [0.0, 0.0, 0.0, 0.0]])
    force = ["Loads/pull/Type=Force", "Loads/pull/Node=rod/last", "Loads/pull/Force={0.2, 0, 0}",
             "Loads/pull/Function=Constant", "Initial Conditions/push/Velocity={0, 0, 0}"]
    for what, settings, start in (("pushed rod", [], [0.0, 0.3, 0.0, 0.0]), ("creeping rod", force, [0.0, 0.0, 0.0, 0.2])):
        found = runs(culm, ROD, 5.0, 0.05, settings)
        values = [run.history.column(WATCHED[ROD])[-1] for run in found]
        check(report, what, values, (expm(5.0 * rates) @ start)[0])
        check_balance(report, what, found[-1])

    def sheet(t, y):
        u, v, d = y
        return [v, -(1.0 + u) * (u + 0.5 * u * u + G * d), (1.0 + u) * v - d / T]

    exact = solve_ivp(sheet, (0.0, 5.0), [0.0, 0.3, 0.0], method="DOP853", rtol=1e-13, atol=1e-15).y[0][-1]
    found = runs(culm, SHEET, 5.0, 0.05, [])
    check(report, "pushed sheet", [run.history.column(WATCHED[SHEET])[-1] for run in found], exact)
    check_balance(report, "pushed sheet", found[-1])


def moved(deck, strain, velocity):
    """Settings that give the deck a strain, a formula of t; Green's strain in the sheet."""
    motion = strain if deck == ROD else f"sqrt(1 + 2*({strain})) - 1"
    support = {"Type": "Simple Support", "Node": END[deck], "Direction": "{1, 0, 0}", "Translation": 1,
               "Function": "motion"}
    return ["Functions/motion/Type=Expression", f"Functions/motion/Expression={motion}",
            f"Initial Conditions/push/Velocity={{{velocity}, 0, 0}}",
            *(f"Constraints/drive/{name}={value}" for name, value in support.items())]


def verify_relaxation(culm, report):
    report.title("Relaxation: a strain of 0.01 in 0.1 s, then held; the force of a step is the mean of the step")
    strain, ramp, h = 0.01, 0.1, 0.05
    for deck in (ROD, SHEET):
        reactions = [f"Output/History/{k}/{what}" for k, node in enumerate(HELD[deck])
                     for what in ("Type=Reaction", f"Node={node}")]
        run = culm.succeed(deck, [*moved(deck, f"t < {ramp} ? {strain / ramp}*t : {strain}", strain / ramp),
                                  "Analyses/motion/End Time=3", f"Analyses/motion/Step={h}", "Output/Every=1",
                                  *reactions, *([] if deck == ROD else ["Materials/elastic/Density=1e-13"])])
        times = run.history.levels
        forces = [sum(one) for one in zip(*(run.history.column(f"{k} Fx [N]") for k in range(len(HELD[deck]))))]
        stretch = 1.0 if deck == ROD else math.sqrt(1.0 + 2.0 * strain)
        wanted = []
        for time in times:
            d = strain * T / ramp * (1.0 - math.exp(-ramp / T)) * math.exp(-(time - h - ramp) / T)
            mean = d * T / h * (1.0 - math.exp(-h / T))
            wanted.append(-STIFFNESS[deck] * stretch * (strain + G * mean))
        held = [k for k, time in enumerate(times) if time > ramp + 0.5 * h]
        report.relative(f"{deck}, force at 3 s", forces[held[-1]], wanted[held[-1]], 1e-8)
        report.holds(f"{deck}, all steps, relative,",
                     max(abs(forces[k] / wanted[k] - 1.0) for k in held), 1e-8)


def verify_loss(culm, report):
    report.title("Strain A sin(w t): what a cycle takes is pi k A^2 g w T / (1 + w^2 T^2)")
    size, omega = 0.1, 2.0
    period = 2.0 * math.pi / omega
    share = omega * T / (1.0 + (omega * T) ** 2)

    def branch(t):  # d' = w A cos(w t) - d/T from rest
        return size * share * (math.cos(omega * t) + omega * T * math.sin(omega * t) - math.exp(-t / T))

    for deck in (ROD, SHEET):
        k = STIFFNESS[deck]
        exact = k * G / T * quad(lambda t: branch(t) ** 2, 0.0, 2.0 * period, epsabs=1e-14, epsrel=1e-13, limit=200)[0]
        settings = [*moved(deck, f"{size}*sin({omega}*t)", size * omega), "Output/Every=10"]
        found = runs(culm, deck, 2.0 * period, period / 40.0, settings)
        check(report, f"{deck}, two cycles [J]", [run.books()[TAKEN] for run in found], exact, 1e-8 * exact)
        check_balance(report, deck, found[-1])
        # the start has died away after 7 cycles: exp(-22)
        books = [[run.books()[TAKEN] for run in runs(culm, deck, cycles * period, period / 40.0, settings)]
                 for cycles in (7, 8)]
        cycle = romberg([b - a for a, b in zip(*books)], (2, 4, 6))
        stored = 0.5 * k * size**2 * (1.0 + G * omega * T * share)
        report.relative(f"{deck}, loss factor", cycle / (2.0 * math.pi * stored),
                        G * share / (1.0 + G * omega * T * share), 1e-7)


def verify(culm, report):
    verify_motions(culm, report)
    verify_relaxation(culm, report)
    verify_loss(culm, report)


if __name__ == "__main__":
    main(verify)
