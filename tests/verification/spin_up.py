#!/usr/bin/python3
"""DY-4: spin-up of a flexible beam. Page: doc/verification/spin_up.md."""

import math

import numpy as np
from verify import figure, main, save

DECK = "beam/spin_up.xml"
LENGTH, SPEED, DURATION = 10.0, 6.0, 15.0
BETA = SPEED * math.sqrt(1.2 / 2.8e7)
EXTENSION = math.tan(BETA * LENGTH) / BETA - LENGTH  # 5.14317455e-4 m


def tip(history):
    """Times, extension and deflection of the tip in the axes of the turning root."""
    times = np.array(history.levels)
    x, y = (np.array(history.column(f"tip {c} [m]")) for c in "xy")
    angle = np.where(
        times < DURATION,
        SPEED / DURATION * (times**2 / 2.0 + (DURATION / (2.0 * np.pi)) ** 2
                            * (np.cos(2.0 * np.pi * times / DURATION) - 1.0)),
        SPEED * (times - DURATION / 2.0))
    along, across = np.cos(angle), np.sin(angle)
    return times, x * along + y * across - LENGTH, y * along - x * across


def steady(history, start):
    times, out, aside = tip(history)
    late = times >= start
    radius = np.hypot(LENGTH + out[late], aside[late])
    return float(np.mean(radius)) - LENGTH, float(np.max(np.abs(aside[late])))


def verify(culm, report):
    report.title("Steady extension of the tip, mean from 16 to 20 s")
    meshes = (5, 10, 20)
    found = {}
    for elements in meshes:
        history = culm.history(DECK, [f"Structures/beam/Curve/Elements={elements}"])
        found[elements] = steady(history, 16.0)[0]
    report.relative("10 elements [m]", found[10], EXTENSION, 5e-3)
    halved = steady(culm.history(DECK, ["Analyses/motion/Step=0.005"]), 16.0)[0]
    report.note("relative error with 5, 10, 20 elements: "
                + ", ".join(f"{found[n] / EXTENSION - 1.0:.2e}" for n in meshes)
                + f"; with half the step: {halved / EXTENSION - 1.0:.2e}")

    report.title("100 s with 10 elements")
    run = culm.run(DECK, ["Analyses/motion/End Time=100"], quiet=False)
    report.check("exit code", run.exit, 0, 0)
    report.holds("energy balance, drive included, relative", run.drift("energy balance"), 1e-9)
    report.relative("extension from 95 to 100 s [m]", steady(run.history, 95.0)[0], EXTENSION, 5e-3)
    _, _, aside = tip(run.history)
    first, last = (float(np.max(np.abs(part))) for part in (aside[1600:2600], aside[-1000:]))
    # the same oscillation seen through a window of ten seconds: what beats in it may peak elsewhere
    report.holds(f"largest deflection, 90 to 100 s {last:.2e} m over 16 to 26 s {first:.2e} m: growth",
                 max(last / first - 1.0, 0.0), 0.05)


def plot(culm, path):
    fig, (aside, out) = figure(2)
    times, extension, deflection = tip(culm.history(DECK))
    aside.plot(times, deflection)
    aside.set(title="deflection in the turning axes", xlabel="t [s]", ylabel="tip [m]")
    out.plot(times, 1e3 * extension)
    late = times[times > DURATION][::60]
    out.plot(late, np.full(len(late), 1e3 * EXTENSION), "k.", markersize=4, label="exact, steady")
    out.set(title="extension", xlabel="t [s]", ylabel="tip [mm]")
    out.legend()
    save(fig, path)


main(verify, plot)
