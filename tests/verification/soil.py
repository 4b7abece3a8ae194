#!/usr/bin/python3
"""C21: piles in soil. Page: doc/verification/soil.md."""

import math

from verify import main

LONG, MONOPILE, SWAYING = "soil/long_pile.xml", "soil/monopile.xml", "soil/swaying_pile.xml"
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


# --- the published formulas, written anew ------------------------------------------------------

DIAMETER, TOP, CLAY, SAND = 6.0, 8.0, (40e3, 2e3, 8e3, 0.01, 0.5), (math.radians(35.0), 10e3, 22e6)


def sand(X, y, cyclic):
    """API RP 2A: p by A p_u tanh [N/m]."""
    phi, weight, modulus = SAND
    weight = (CLAY[2] * TOP + weight * (X - TOP)) / X  # of all that lies above
    a, b, K0 = phi / 2, math.pi / 4 + phi / 2, 0.4
    Ka = math.tan(math.pi / 4 - phi / 2) ** 2
    C1 = math.tan(b) ** 2 * math.tan(a) / math.tan(b - phi) + K0 * (
        math.tan(phi) * math.sin(b) / (math.cos(a) * math.tan(b - phi)) + math.tan(b) * (math.tan(phi) * math.sin(b) - math.tan(a)))
    C2 = math.tan(b) / math.tan(b - phi) - Ka
    C3 = Ka * (math.tan(b) ** 8 - 1) + K0 * math.tan(phi) * math.tan(b) ** 4
    limit = (0.9 if cyclic else max(0.9, 3 - 0.8 * X / DIAMETER)) * min(C1 * X + C2 * DIAMETER, C3 * DIAMETER) * weight * X
    return limit * math.tanh(modulus * X * y / limit)


def clay(X, y, cyclic):
    """Matlock (1970) [N/m]."""
    c0, growth, weight, strain, J = CLAY
    c = c0 + growth * X
    ultimate = min(3 * c + weight * X + J * c * X / DIAMETER, 9 * c) * DIAMETER
    yc = 2.5 * strain * DIAMETER
    cubic = max(0.5 * ultimate * (y / yc) ** (1 / 3), 0.0)
    if y < 0.1 * yc:
        return 0.5 * ultimate * 0.1 ** (1 / 3) * y / (0.1 * yc)
    if not cyclic:
        return min(cubic, ultimate)
    peak = yc * 1.44**3
    if y < peak:
        return cubic
    deep = 6 * DIAMETER / (weight * DIAMETER / c + J)
    if X >= deep:
        return 0.72 * ultimate
    return 0.72 * ultimate * (1 + (X / deep - 1) * min(1.0, (y - peak) / (15 * yc - peak)))


def table(points, z):
    """Linear between points, constant beyond."""
    for (z0, f0), (z1, f1) in zip(points, points[1:]):
        if z <= z1:
            return f0 + (f1 - f0) * (z - z0) / (z1 - z0)
    return points[-1][1]


def shaft(X, z):
    """t-z of API RP 2A [N/m]."""
    if X > TOP:
        return math.pi * DIAMETER * 80e3 * table([(0, 0), (0.00254, 1)], z)
    points = [(0, 0), (0.0016, 0.3), (0.0031, 0.5), (0.0057, 0.75), (0.008, 0.9), (0.01, 1), (0.02, 0.9)]
    return math.pi * DIAMETER * 40e3 * table([(a * DIAMETER, b) for a, b in points], z)


def tip(z):
    """Q-z of API RP 2A [N]."""
    points = [(0, 0), (0.002, 0.25), (0.013, 0.5), (0.042, 0.75), (0.073, 0.9), (0.1, 1)]
    return 30e6 * table([(a * DIAMETER, b) for a, b in points], z)


def pushed(culm, direction, moves, cyclic, component):
    """What holds the pile of 35 m in the ground when all of it is moved, so far one after the other: the reaction of its head,
    without other supports."""
    move = ", ".join(repr(moves[-1] * share) for share in direction)
    levels = [one / moves[-1] for one in moves]
    settings = ["Structures/pile/Fidelity=Rigid", "Loads/push/Force={0, 0, 0}", "Analyses/modes/Inactive={head}",
                f"Analyses/push/Levels={{{', '.join(map(repr, levels))}}}",
                "Constraints/head/Type=Rigid Support", "Constraints/head/Node=pile/first", f"Constraints/head/Translation={{{move}}}",
                "Output/History/head force/Type=Reaction", "Output/History/head force/Node=pile/first",
                f"Loads/soil/Cyclic={str(cyclic).lower()}"]
    history = culm.history(MONOPILE, settings)
    return [history.at(level, f"head force {component} [N]") for level in levels]


def verify_laws(culm, report):
    report.title("Laws of API RP 2A and Matlock, 60 stations on a rigid pile")
    depths = [(i + 0.5) * 35.0 / 60 for i in range(60)]
    moves = (0.005, 0.03, 0.3, 1.5, 2.5)
    for cyclic in (False, True):
        for y, force in zip(moves, pushed(culm, (0.6, 0.8, 0.0), moves, cyclic, "Fx")):
            wanted = sum((sand if X > TOP else clay)(X, y, cyclic) * 35.0 / 60 for X in depths)
            report.relative(f"{'cyclic, ' if cyclic else ''}{y} m across [N]", abs(force) / 0.6, wanted, 1e-9)
    moves = (0.001, 0.01, 0.05, 0.3, 1.0)
    for z, force in zip(moves, pushed(culm, (0.0, 0.0, -1.0), moves, False, "Fz")):
        wanted = sum(shaft(X, z) * 35.0 / 60 for X in depths) + tip(z)
        report.relative(f"{z} m down [N]", abs(force), wanted, 1e-9)


def verify_widths(culm, report):
    report.title("A radius in place of the diameter is told, also of the water; half as much again is not")
    wave = "water/wave_on_pile.xml"
    for deck, load, diameter, says in ((MONOPILE, "soil", 3.0, True), (MONOPILE, "soil", 12.0, True), (MONOPILE, "soil", 5.0, False),
                                       (wave, "waves", 3.0, True), (wave, "waves", 7.0, False)):
        run = culm.run(deck, [f"Loads/{load}/Diameter={diameter}"], quiet=False)
        report.holds(f"{load}, {diameter} m", 0.0 if says == ("is one of them a radius" in run.errors) else 1.0, 0.0)


def verify_hysteresis(culm, report):
    report.title("Swaying pile in soil that remembers")
    for form in ("Null Space", "Multipliers"):
        run = culm.run("soil/hysteresis.xml", [f"Solver/Form={form}"], quiet=False)
        report.holds(f"{form}: energy balance", run.drift("energy balance"), 1e-10)
        taken = run.books()["energy taken by dampers"]
        report.holds("soil takes energy", 0.0 if taken > 0.0 else 1.0, 0.0)
        report.note(f"it took {taken:.0f} J; iterations per step {run.iterations() / 100:.1f}, at most {run.most_iterations()}")


def verify(culm, report):
    verify_laws(culm, report)
    verify_widths(culm, report)
    verify_hysteresis(culm, report)
    verify_long_pile(culm, report)
    verify_stations(culm, report)
    verify_energy(culm, report)


main(verify)
