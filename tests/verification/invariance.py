#!/usr/bin/python3
"""Objectivity, work and energy, equilibrium. Page: doc/verification/invariance.md."""

import math

import numpy as np
from rod import exp_rotation
from verify import main

KINDS = [
    ("order 1", "Director", 1),
    ("order 2", "Director", 2),
    ("order 3", "Director", 3),
    ("helical", "Helical", 1),
]
BEND_TIP = 100.0 * np.array([math.sin(math.pi / 4), 1.0 - math.cos(math.pi / 4), 0.0])
TIGHT = "Analyses/bending/Newton/Force Tolerance=1e-13"
ROTATION = exp_rotation(np.array([0.7, -1.9, 1.1]))  # any
SHIFT = np.array([0.31, -0.72, 0.53])


def text(vector):
    return "{" + ", ".join(f"{v:.17g}" for v in vector) + "}"


def turned(vector):
    return text(ROTATION @ vector)


def moved(point, size):
    return text(ROTATION @ point + size * SHIFT)


def kind_settings(structure, kind, order):
    return [f"Structures/{structure}/Element={kind}", f"Structures/{structure}/Order={order}"]


def composite(pose):
    place, turn = pose
    return [
        f"Structures/beam/Curve/From={place(np.zeros(3), 10.0)}",
        f"Structures/beam/Curve/To={place(np.array([10.0, 0, 0]), 10.0)}",
        f"Structures/beam/Curve/Up={turn(np.array([0, 1.0, 0]))}",
        f"Loads/tip load/Force={turn(np.array([0, 0, 150.0]))}",
        TIGHT,
    ]


def bend(pose):
    place, turn = pose
    return [
        f"Structures/bend/Curve/Centre={place(np.array([0, 100.0, 0]), 100.0)}",
        f"Structures/bend/Curve/From={place(np.zeros(3), 100.0)}",
        f"Structures/bend/Curve/Axis={turn(np.array([0, 0, 1.0]))}",
        f"Loads/tip load/Force={turn(np.array([0, 0, 600.0]))}",
        TIGHT,
    ]


def verify_objectivity(culm, report):
    report.title("Objectivity: the whole model turned and moved, displacements turn with it")
    here = (lambda point, size: text(point), text)
    there = (moved, turned)
    for deck, structure, settings in [
        ("composite_cantilever", "beam", composite),
        ("bend_45", "bend", bend),
    ]:
        for label, kind, order in KINDS:
            elements = kind_settings(structure, kind, order)
            one = culm.history(f"beam/{deck}.xml", [*settings(here), *elements])
            other = culm.history(f"beam/{deck}.xml", [*settings(there), *elements])
            # a strain of 1e-16 times EA is up to 1e-11 of these loads, so reactions are less exact
            for quantity, tolerance in (("tip", 1e-12), ("root", 1e-10)):
                vector = np.array(one.vector(quantity)).reshape(-1, 3)
                found = np.array(other.vector(quantity)).reshape(-1, 3)
                error = np.abs(found - vector @ ROTATION.T).max() / np.abs(vector).max()
                report.holds(f"{deck}, {label}, {quantity}", error, tolerance)


def work(history, levels, weights, column, load):
    """Work of a dead load that grows with the level: P u(1) - P int u dlevel (Gauss)."""
    inner = sum(w * history.at(level, column) for level, w in zip(levels, weights))
    return load * (history.at(1.0, column) - inner)


def verify_work(culm, report):
    report.title("Work of the loads = strain energy, on proportional paths (Gauss, 12 levels)")
    points, weights = np.polynomial.legendre.leggauss(12)
    levels, weights = 0.5 * (points + 1.0), 0.5 * weights
    at = "{" + ", ".join(f"{v:.17g}" for v in levels) + "}"
    for label, kind, order in KINDS:
        settings = [f"Analyses/bending/Levels={at}", TIGHT, *kind_settings("bend", kind, order)]
        history = culm.history("beam/bend_45.xml", settings)
        found = work(history, levels, weights, "tip uz [m]", 600.0)
        report.relative(f"bend_45, {label}", found, history.at(1.0, "energy [J]"), 1e-8)
    for label, kind, order in KINDS:
        settings = [
            "Analyses/bending/Final Level=1",
            f"Analyses/bending/Levels={at}",
            TIGHT,
            *kind_settings("beam", kind, order),
        ]
        history = culm.history("beam/elastica.xml", settings)
        found = work(history, levels, weights, "tip uy [m]", 1.0)
        report.relative(f"elastica, {label}", found, history.at(1.0, "energy [J]"), 1e-8)


def balance(report, what, forces, size, tolerance=1e-9):
    """forces: (point, force, moment), reactions among them; their sum and moment must vanish."""
    total = sum(np.array(f, dtype=float) for _, f, _ in forces)
    moment = sum(np.cross(p, f) + np.array(m, dtype=float) for p, f, m in forces)
    scale = max(np.abs(f).max() for _, f, _ in forces)
    report.holds(f"{what}, forces", np.abs(total).max() / scale, tolerance)
    report.holds(f"{what}, moments", np.abs(moment).max() / (scale * size), tolerance)


def reaction(history, name, point):
    r = history.vector(name)
    return point, r[:3], r[3:]


def dead(force, point):
    return point, force, [0, 0, 0]


def verify_balance(culm, report):
    report.title("Reactions balance the loads in the deformed state")
    origin = np.zeros(3)
    for label, kind, order in KINDS:
        history = culm.history("beam/bend_45.xml", kind_settings("bend", kind, order))
        load = dead([0, 0, 600], BEND_TIP + history.vector("tip"))
        balance(report, f"bend_45, {label}", [reaction(history, "root", origin), load], 100)
        settings = kind_settings("beam", kind, order)
        history = culm.history("beam/composite_cantilever.xml", settings)
        load = dead([0, 0, 150], np.array([10, 0, 0]) + history.vector("tip"))
        balance(report, f"composite, {label}", [reaction(history, "root", origin), load], 10)
    history = culm.history("beam/follower_loads.xml")
    turn = exp_rotation(np.array(history.vector("tip rotation")))
    triad = turn @ [[0, 0, 1], [1, 0, 0], [0, 1, 0]]  # d1 = y, d2 = z, d3 = x
    tip = np.array([2, 0, 0]) + history.vector("tip")
    load = (tip, triad @ [8, 12, -6], triad @ [4, -6, 5])
    balance(report, "follower_loads", [reaction(history, "root", origin), load], 2)
    history = culm.history("beam/lee_frame.xml")
    feet = [
        reaction(history, "foot", origin),
        reaction(history, "end", np.array([120, 120, 0])),
    ]
    load = dead([0, -1.85, 0], np.array([24, 120, 0]) + history.vector("load point"))
    # coordinates of 170 rounded to epsilon times the shear stiffness GA / h = 36000: 1.4e-9
    balance(report, "lee_frame", [*feet, load], 120, 1e-8)


def verify(culm, report):
    verify_objectivity(culm, report)
    verify_work(culm, report)
    verify_balance(culm, report)


if __name__ == "__main__":
    main(verify)
