#!/usr/bin/python3
"""C21: piles in soil. Page: doc/verification/soil.md."""

import math

from verify import main

LONG, SWAYING = "soil/long_pile.xml", "soil/swaying_pile.xml"
STIFFNESS, MODULUS, FORCE = 2e9, 1e7, 1e6


DECAY = (0.25 * MODULUS / STIFFNESS) ** 0.25


def push(culm, report, title, settings, tolerance):
    history = culm.history(LONG, settings)
    report.relative(f"{title}: head [m]", history.column("head ux [m]")[-1], 2.0 * FORCE * DECAY / MODULUS, tolerance)
    return abs(history.column("below M2 [N m]")[-1])


def moment_at(depth):
    return FORCE / DECAY * math.exp(-DECAY * depth) * math.sin(DECAY * depth)


def verify_long_pile(culm, report):
    report.title("Long pile in even soil: head 37.606031 mm, largest moment 1.714602 MN m")
    moment = push(culm, report, "60 elements, 600 stations", [], 2e-4)
    gauss = 0.5 / math.sqrt(3.0)
    mean = 0.5 * (moment_at(4.5 - gauss) + moment_at(4.5 + gauss))
    report.relative("moment at the Gauss points from 4 to 5 m, mean [N m]", moment, mean, 5e-4)
    push(culm, report, "60 elements, 77 stations", ["Loads/soil/Stations=77"], 1e-2)
    push(culm, report, "30 elements, 600 stations", ["Structures/pile/Curve/Elements=30"], 2e-4)


def verify_stations(culm, report):
    report.title("Order in the number of stations, 60 elements")
    errors = []
    for stations in (60, 120, 240):
        history = culm.history(LONG, [f"Loads/soil/Stations={stations}"])
        errors.append(abs(history.column("head ux [m]")[-1] / (2.0 * FORCE * DECAY / MODULUS) - 1.0))
        report.note(f"{stations} stations: {errors[-1]:.2e}")
    order = 0.5 * math.log2(errors[0] / errors[-1])
    report.holds(f"order {order:.2f}, below 1.8 by", max(0.0, 1.8 - order), 0.0)


def verify_energy(culm, report):
    report.title("Swaying pile in clay and sand: soil gives back what it takes")
    for form in ("Null Space", "Multipliers"):
        run = culm.run(SWAYING, [f"Solver/Form={form}"], quiet=False)
        report.holds(f"{form}: energy balance", run.drift("energy balance"), 1e-10)


def verify(culm, report):
    verify_long_pile(culm, report)
    verify_stations(culm, report)
    verify_energy(culm, report)


main(verify)
