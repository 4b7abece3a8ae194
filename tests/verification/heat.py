#!/usr/bin/python3
"""C23 to C25: heated bars and columns, bimetals, the work of heat. Page: doc/verification/heat.md."""

import math

from verify import main

E, DENSITY, ALPHA, SIDE, LENGTH = 210e9, 7850.0, 1.2e-5, 0.02, 2.0
AREA, INERTIA = SIDE**2, SIDE**4 / 12.0
# P / GA per kelvin: k E / G, Cowper's k of a rectangle
SOFTNESS = ALPHA * 2.6 * (12.0 + 11.0 * 0.3) / (10.0 * 1.3)
# curvature of Timoshenko (1925) for 1 and 1.5 mm, 200 and 100 GPa, 12e-6 and 23e-6 1/K, 100 K
BIMETAL = 0.65945046
MIDDLE = [f"Output/History/middle/{one}" for one in ("Type=Stress Resultants", "Structure=plate", "Element=27")]
BENT = "heat/bent_bar.xml"


def constraint(name, kind, node, key, direction):
    entry = f"Constraints/{name}"
    return [f"{entry}/Type={kind}", f"{entry}/Node=bar/{node}", f"{entry}/{key}={direction}"]


def rotation(name, node, axis):
    return constraint(name, "Rotation", node, "Axis", axis)


# the head of the column may not move sideways, nor turn; a foot that may turn must not twist
SIDEWAYS = [*constraint("y", "Simple Support", "last", "Direction", "{0, 1, 0}"),
            *constraint("z", "Simple Support", "last", "Direction", "{0, 0, 1}")]
UPRIGHT = [*rotation("about y", "last", "{0, 1, 0}"), *rotation("about z", "last", "{0, 0, 1}")]
HINGE = ["Constraints/foot/Type=Spherical Support", *rotation("twist", "first", "{1, 0, 0}")]
BETWEEN_HINGES = [*HINGE, "Constraints/head/Type=Spherical Support", "Structures/bar/Curve/Elements=16"]
# c of Euler's load c pi^2 EI / L^2; clamped and hinged: the smallest root of tan x = x
COLUMNS = {"clamped and free": ([], 0.25),
           "hinges": ([*HINGE, *SIDEWAYS], 1.0),
           "clamped and hinged": (SIDEWAYS, 20.190728557 / math.pi**2),
           "clamped": ([*SIDEWAYS, *UPRIGHT], 4.0)}


def last(history, column):
    return history.column(column)[-1]


def verify_bar(culm, report):
    report.title("C23: bar, 50 K")
    force = E * AREA * ALPHA * 50.0
    history = culm.history("heat/held_bar.xml")
    report.relative("held, N [N]", last(history, "middle N3 [N]"), -force, 1e-9)
    report.relative("held, reaction [N]", last(history, "head Fx [N]"), -force, 1e-9)
    history = culm.history(BENT, ["Loads/sun/Value=50", 'Loads/sun/Gradient={0, 0}'])
    report.relative("free, growth [m]", last(history, "tip ux [m]"), ALPHA * 50.0 * LENGTH, 1e-9)
    report.check("free, N / (E A alpha T)", last(history, "middle N3 [N]") / force, 0.0, 1e-9)


def verify_columns(culm, report):
    report.title("C23: buckling by heat, c pi^2 I / (alpha A L^2)")
    for name, (settings, c) in COLUMNS.items():
        table = culm.table("buckling/buckling", "heat/column.xml", settings)
        wanted = c * math.pi**2 * INERTIA / (ALPHA * AREA * LENGTH**2)
        found = min(factor for factor in table.column("factor") if factor > 0.0)
        report.relative(f"{name} [K]", found, wanted, 1e-3)
        if name != "clamped and hinged":  # with shear, P (1 + P / GA) = Euler's load
            sheared = (math.sqrt(1.0 + 4.0 * wanted * SOFTNESS) - 1.0) / (2.0 * SOFTNESS)
            report.relative(f"{name}, with shear [K]", found, sheared, 2e-4)


def frequency(culm, temperature):
    """The lowest one of the bar between hinges [Hz]."""
    settings = [f"Loads/sun/Value={temperature}", *BETWEEN_HINGES, "Analyses/modes/Type=Modal"]
    return culm.table("modes/modes", "heat/held_bar.xml", settings).at(1, "frequency [Hz]")


def verify_heated_states(culm, report):
    report.title("C23: about a heated state, hinges: f^2 / f0^2 = 1 - T / T_E; level of buckling")
    critical = math.pi**2 * INERTIA / (ALPHA * AREA * LENGTH**2)
    cold = frequency(culm, 1e-9)
    report.relative("cold [Hz]", cold, 0.5 * math.pi / LENGTH**2 * math.sqrt(E * INERTIA / (DENSITY * AREA)), 1e-3)
    for share in (0.5, 0.9):
        found = (frequency(culm, share * critical) / cold) ** 2
        report.check(f"T / T_E = {share}", found, 1.0 - share, 1e-3)
    settings = [f"Loads/sun/Value={critical}", *BETWEEN_HINGES, "Analyses/heating/Final Level=0.9",
                "Analyses/buckling/Type=Buckling"]
    table = culm.table("buckling/buckling", "heat/held_bar.xml", settings)
    report.relative("buckling about 90 %, level", min(table.column("critical level"), key=lambda x: abs(x - 1.0)), 1.0, 1e-3)


def verify_gradient(culm, report):
    report.title("C24: 30 K over the height")
    curvature = ALPHA * 30.0 / SIDE
    history = culm.history(BENT)
    arc = (1.0 - math.cos(curvature * LENGTH)) / curvature
    report.relative("tip sinks [m]", -last(history, "tip uz [m]"), arc, 1e-7)
    report.check("M / (E I kappa)", last(history, "middle M2 [N m]") / 50.4, 0.0, 1e-7)
    head = [f"Constraints/head/{one}" for one in ("Type=Rigid Support", "Node=bar/last")]
    history = culm.history(BENT, head)
    report.relative("clamped, M [N m]", abs(last(history, "middle M2 [N m]")), E * INERTIA * curvature, 1e-9)
    report.check("clamped, tip [m]", last(history, "tip uz [m]"), 0.0, 1e-12)


def verify_places(culm, report):
    report.title("A gradient that grows along the bar, and heat on a part of it")
    field = ["Fields/along/Type=Formula", "Loads/sun/Gradient={}", "Loads/sun/Field=along"]
    bar = culm.history(BENT, [*field, "Fields/along/Y=1000*x", "Structures/bar/Curve/Elements=16"])
    # turn = alpha c x^2 / 2: the tip is at its sine and cosine integrals
    turn = [0.5 * ALPHA * 1000.0 * (LENGTH * (i + 0.5) / 20000) ** 2 for i in range(20000)]
    sinks = sum(math.sin(t) for t in turn) * LENGTH / 20000
    report.relative("gradient 1000 x K/m, tip sinks [m]", -last(bar, "tip uz [m]"), sinks, 1e-6)
    part = culm.history(BENT, [*field, "Fields/along/X=(x < 1.5) ? 40 : 0"])
    report.relative("40 K on 1.5 of 2 m, growth [m]", last(part, "tip ux [m]"), ALPHA * 40.0 * 1.5, 1e-9)


def verify_work(culm, report):
    report.title("Work of heat, conserving scheme: of what the beam holds and heat puts in")
    for form in ("Null Space", "Multipliers"):
        run = culm.run("heat/flying_bar.xml", [f"Solver/Form={form}"], quiet=False)
        report.holds(f"{form}: energy balance", run.drift("energy balance"), 1e-11)
        report.holds(f"{form}: angular momentum", run.drift("angular momentum"), 1e-11)


def verify_bimetal(culm, report):
    report.title("C25: bimetal, 100 K")
    strip = culm.history("heat/bimetal_strip.xml")
    report.relative("tip sinks [m]", -last(strip, "tip uz [m]"), 3.296058e-3, 1e-5)
    report.title("C25: a little warmer, per 100 K")
    strip = culm.history("heat/bimetal_strip.xml", ["Loads/heat/Value=0.01"])
    linear = 0.5 * BIMETAL * 0.1**2
    report.relative("strip, tip sinks [m]", -1e4 * last(strip, "tip uz [m]"), linear, 1e-6)
    for nu in (0, 0.3):
        plate = culm.history("heat/bimetal_plate.xml", [f"nu={nu}", *MIDDLE])
        rise = 1e5 * last(plate, "centre uz [m]")
        report.relative(f"plate, nu = {nu}, centre rises [m]", rise, 0.25 * BIMETAL * 0.1**2, 1e-6)
        force = 1e5 * last(plate, "middle N11 [N/m]") / (200e9 * 1e-3 * 11e-4)
        report.check(f"plate, nu = {nu}, N / (E t (alpha2 - alpha1) T)", force, 0.0, 1e-5)


def verify(culm, report):
    verify_bar(culm, report)
    verify_columns(culm, report)
    verify_heated_states(culm, report)
    verify_gradient(culm, report)
    verify_bimetal(culm, report)
    verify_places(culm, report)
    verify_work(culm, report)


main(verify)
