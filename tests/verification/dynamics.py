#!/usr/bin/python3
"""DY-1, 2, 5, 6, 8: motion without drift. Page: doc/verification/dynamics.md."""

import math

from verify import figure, main, save

TOP = "body/heavy_top.xml"
# centre of mass of the heavy top, Runge-Kutta on quaternion and body rates, 8 digits
TOP_REFERENCE = {0.2: (0.605550561, 0.598957682, -0.523983028),
                 0.5: (-0.702468297, -0.021165184, -0.711400257)}
# other end of the spatial spaghetti at 10 s on a converged mesh
SPAGHETTI_END = (38.312, 5.196, 4.252)


def top_error(culm, step, time=0.5):
    history = culm.history(TOP, [f"Analyses/motion/Step={step}"])
    return math.dist(history.vector("centre", time), TOP_REFERENCE[time])


def verify_order(culm, report):
    report.title("Heavy top: order in the time step")
    steps = (1e-3, 5e-4, 2.5e-4)
    errors = [top_error(culm, step) for step in steps]
    # the same scheme in an independent implementation: 2.18e-4 at 1e-3 s
    report.check("error at 0.5 s with 1e-3 s", errors[0], 2.18e-4, 0.01e-4)
    for i in (0, 1):
        order = math.log2(errors[i] / errors[i + 1])
        report.check(f"order from {steps[i]} to {steps[i + 1]}", order, 2.0, 0.05)


def verify_adaptive(culm, report):
    report.title("Heavy top: adaptive steps")
    errors = []
    for tolerance in (1e-4, 1e-5, 1e-6):
        run = culm.run("body/heavy_top_adaptive.xml",
                       [f"Analyses/motion/Adaptive/Tolerance={tolerance}", "Output/Every=1"],
                       quiet=False)
        error = math.dist(run.history.vector("centre", 0.5), TOP_REFERENCE[0.5])
        steps = len(run.history.levels) - 1
        report.holds(f"tolerance {tolerance}: all {steps} steps together", error, steps * tolerance)
        report.holds("energy balance, relative", run.drift("energy balance"), 1e-9)
        errors.append(error)
    for coarse, fine in zip(errors, errors[1:]):
        # step ~ tol^(1/3), error ~ step^2
        report.relative("error for a tenth of the tolerance falls by", coarse / fine, 10 ** (2 / 3),
                        0.1)


def verify_balance(culm, report, deck, settings=(), free=True):
    run = culm.run(deck, settings, quiet=False)
    report.check(f"{deck} {list(settings)}: exit code", run.exit, 0, 0)
    report.holds("energy balance, relative", run.drift("energy balance"), 1e-9)
    report.holds("constraints, relative", run.drift("constraints"), 1e-10)
    if free:
        report.holds("linear momentum, relative", run.drift("linear momentum"), 1e-11)
        report.holds("angular momentum, relative", run.drift("angular momentum"), 1e-10)


def verify_balances(culm, report):
    report.title("Balances, from the certificates of the runs")
    verify_balance(culm, report, "flight/spaghetti_2d.xml")
    verify_balance(culm, report, "flight/spaghetti_3d.xml")
    verify_balance(culm, report, "flight/spaghetti_3d.xml", ["Structures/beam/Element=Helical"])
    verify_balance(culm, report, "flight/spaghetti_3d.xml", ["Structures/beam/Order=2"])
    verify_balance(culm, report, "flight/spaghetti_3d.xml", ["Structures/beam/Dissipation=0.3"])
    verify_balance(culm, report, "body/torque_free.xml")
    verify_balance(culm, report, "joint/four_bar_2.xml", free=False)


def verify_spaghetti(culm, report):
    report.title("Spatial spaghetti: other end at 10 s, 40 elements of order 2, 0.01 s")
    history = culm.history("flight/spaghetti_3d.xml",
                           ["Structures/beam/Curve/Elements=40", "Structures/beam/Order=2",
                            "Analyses/motion/Step=0.01"])
    report.relative("other end [m]", history.vector("other end"), list(SPAGHETTI_END), 1e-3)


def verify_forms(culm, report):
    report.title("Null space against multipliers over 500 steps")
    one, other = (culm.history("flight/spaghetti_3d.xml", [f"Solver/Form={form}"])
                  for form in ("Null Space", "Multipliers"))
    difference = max(abs(a - b) for name in one.names if "[m]" in name
                     for a, b in zip(one.column(name), other.column(name)))
    report.holds("largest difference of a position over 10 m", difference / 10.0, 1e-9)


def verify_loops(culm, report):
    report.title("Four-bar loops through singular positions")
    history = culm.history("joint/four_bar_2.xml")
    for time, reference in ((1.0, (-0.195020302, -0.980799206)), (2.0, (0.057815796, 0.998327268))):
        report.check(f"B at {time} s, 2 loops", history.vector("B", time)[:2], list(reference), 1e-3)
    history = culm.history("joint/four_bar_40.xml")
    report.check("B at 1 s, 40 loops", history.vector("B", 1.0)[:2], [-0.115356881, -0.993324111],
                 1e-3)


def verify(culm, report):
    verify_order(culm, report)
    verify_adaptive(culm, report)
    verify_balances(culm, report)
    verify_spaghetti(culm, report)
    verify_forms(culm, report)
    verify_loops(culm, report)


def plot(culm, path):
    fig, (order, energy) = figure(2)
    steps = [2e-3, 1e-3, 5e-4, 2.5e-4]
    order.loglog(steps, [top_error(culm, step) for step in steps], "o-", label="culm")
    order.loglog(steps, [218.0 * step**2 for step in steps], "k--", label="second order")
    order.set(title="heavy top", xlabel="time step [s]", ylabel="error of the centre at 0.5 s [m]")
    order.legend()
    history = culm.history("flight/spaghetti_3d.xml")
    for end in ("loaded end", "other end"):
        energy.plot(history.column(f"{end} x [m]"), history.column(f"{end} y [m]"), label=end)
    energy.set(title="spatial spaghetti, 10 s", xlabel="x [m]", ylabel="y [m]", aspect="equal")
    energy.legend()
    save(fig, path)


main(verify, plot)
