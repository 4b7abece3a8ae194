#!/usr/bin/python3
"""Bars and beams that yield, plates that collapse, the heat of flow. Page: doc/verification/plasticity.md."""

import math

from verify import main

E, YIELD, HEIGHT, WIDTH = 200e9, 250e6, 0.04, 0.02
FIRST_MOMENT = YIELD * WIDTH * HEIGHT**2 / 6.0
FIRST_CURVATURE = 2.0 * YIELD / (E * HEIGHT)
BENT, CLAMPED, STRUCK, PLATE = (f"plasticity/{name}.xml" for name in ("bent_bar", "clamped_beam", "struck_bar", "square_plate"))


def curvature(sinks):
    """Of an arc of length 1 whose end sinks by this much, by Newton's method."""
    kappa = 2.0 * sinks
    for _ in range(20):
        value = (1.0 - math.cos(kappa)) / kappa - sinks
        kappa -= value / (math.sin(kappa) / kappa - (1.0 - math.cos(kappa)) / kappa**2)
    return kappa


def bent(culm, ratio, cells):
    """Curvatures under ratio times the moment of first yield, and without it afterwards, over that of first yield."""
    history = culm.history(BENT, [f"M={ratio * FIRST_MOMENT}", f"Sections/steel/Plasticity/Cells={{{cells}, 1}}"])
    column = history.column("tip uz [m]")
    return [curvature(abs(column[i])) / FIRST_CURVATURE for i in (len(column) // 2, -1)]


def loaded(culm, ratios, cells):
    """Curvatures under so many moments of first yield, rising, on the way to the last one, over that of first yield."""
    levels = [0.5 * ratio / ratios[-1] for ratio in ratios]
    history = culm.history(BENT, [f"M={ratios[-1] * FIRST_MOMENT}", f"Sections/steel/Plasticity/Cells={{{cells}, 1}}",
                                  "Analyses/bending/Final Level=0.5",
                                  f"Analyses/bending/Levels={{{', '.join(map(repr, levels))}}}"])
    return [curvature(abs(history.vector("tip", level)[2])) / FIRST_CURVATURE for level in levels]


def verify_bending(culm, report):
    report.title("Bending beyond yield, 200 cells: M / M_y = 3/2 - (kappa_y / kappa)^2 / 2, and what remains")
    for ratio in (1.1, 1.3, 1.45):
        wanted = 1.0 / math.sqrt(3.0 - 2.0 * ratio)
        found = bent(culm, ratio, 200)
        report.relative(f"M = {ratio} M_y", found[0], wanted, 2e-4)
        report.relative(f"M = {ratio} M_y, remains", found[1], wanted - ratio, 1e-3)
    report.title("Order in the number of cells: root mean square of relative errors over M / M_y = 1.05 ... 1.35")
    ratios = [1.05 + 0.03 * i for i in range(11)]
    errors = []
    for cells in (8, 16, 32, 64):
        found = loaded(culm, ratios, cells)
        squares = [(one * math.sqrt(3.0 - 2.0 * ratio) - 1.0) ** 2 for one, ratio in zip(found, ratios)]
        errors.append(math.sqrt(sum(squares) / len(squares)))
        report.note(f"{cells} cells: {errors[-1]:.2e}")
    order = math.log2(errors[0] / errors[-1]) / 3.0
    report.holds(f"order {order:.2f}, below 1.7 by", max(0.0, 1.7 - order), 0.0)


def verify_cycles(culm, report):
    report.title("Tension and compression to 1.2 s_y, kinematic hardening: one loop")
    hardening, area = 10e9, WIDTH * HEIGHT
    settings = ["M=1e-9", "Loads/pull/Type=Force", "Loads/pull/Node=bar/last",
                f"Loads/pull/Force={{{1.2 * YIELD * area}, 0, 0}}", "Loads/pull/Function=cycle",
                "Functions/cycle/Type=Table", "Functions/cycle/Times={0, 0.2, 0.6, 1}",
                "Functions/cycle/Values={0, 1, -1, 1}", f"Sections/steel/Plasticity/Kinematic Hardening={hardening}",
                "Analyses/bending/Steps=10"]
    history = culm.history(BENT, settings)
    strain = 1.2 * YIELD / E + 0.2 * YIELD / hardening
    column = history.column("tip ux [m]")
    for step, sign in ((2, 1.0), (6, -1.0), (10, 1.0)):
        report.relative(f"after step {step}, strain", column[step], sign * strain, 1e-9)


def verify_collapse(culm, report):
    report.title("Clamped beam: 8 M_p / (L - 4 g), hinges at the Gauss points; M_p = 2000 N m")
    loads = []
    for elements in (16, 32, 64):
        history = culm.history(CLAMPED, [f"Structures/bar/Curve/Elements={elements}"])
        loads.append(8000.0 * history.levels[-1])
        g = 0.5 * (1.0 - 1.0 / math.sqrt(3.0)) * 2.0 / elements
        report.relative(f"{elements} elements [N]", loads[-1], 16000.0 / (2.0 - 4.0 * g), 2e-3)
    report.relative("extrapolated [N]", 2.0 * loads[2] - loads[1], 8000.0, 5e-3)


def verify_plate(culm, report):
    report.title("Square plate: q L^2 / M_p between 24.86 and 26.54 (Hodge and Belytschko 1968)")
    for elements in (4, 8):
        history = culm.history(PLATE, [f"Structures/plate/Mesh/Elements={{{elements}, {elements}}}"])
        found = 25.0 * history.levels[-1]
        report.check(f"{elements} x {elements} in a quarter", found, 0.5 * (24.86 + 26.54), 0.5 * (26.54 - 24.86))


def verify_heat(culm, report):
    report.title("Struck bar: balance of energy with the heat of flow")
    for form in ("Null Space", "Multipliers"):
        run = culm.run(STRUCK, [f"Solver/Form={form}"], quiet=False)
        report.holds(f"{form}: energy balance", run.drift("energy balance"), 1e-10)


def verify(culm, report):
    verify_bending(culm, report)
    verify_cycles(culm, report)
    verify_collapse(culm, report)
    verify_plate(culm, report)
    verify_heat(culm, report)


main(verify)
