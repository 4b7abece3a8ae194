#!/usr/bin/python3
"""DY-1, 2, 5, 6, 8: motion without drift. Page: doc/verification/dynamics.md."""

import math

import numpy as np
from scipy.spatial.transform import Rotation
from verify import figure, main, save

TOP = "body/heavy_top.xml"
# centre of mass of the heavy top, Runge-Kutta on quaternion and body rates, 8 digits
TOP_REFERENCE = {0.2: (0.605550561, 0.598957682, -0.523983028),
                 0.5: (-0.702468297, -0.021165184, -0.711400257),
                 1.0: (0.173343964, 0.640088591, -0.748490792),
                 1.5: (-0.968165715, 0.250306064, -0.001422084),
                 2.0: (-0.150416824, -0.724165592, -0.673022268)}
# Jacobi functions: the spin about the intermediate axis changes its sign
FLIPS = (2.74106806, 7.76699719)
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


def verify_top(culm, report):
    report.title("DY-5: heavy top over 2 s in steps of 1e-4 s")
    history = culm.history(TOP, ["Analyses/motion/Step=1e-4", "Analyses/motion/End Time=2"])
    for time, reference in TOP_REFERENCE.items():
        report.check(f"centre at {time} s", history.vector("centre", time), list(reference), 1e-3)


def verify_flips(culm, report):
    report.title("DY-6: torque-free body in steps of 1e-3 s: where it turns over, half a period apart")
    settings = ["Analyses/motion/Step=1e-3", "Analyses/motion/End Time=8", "Output/Every=1"]
    settings += ["Output/History/turn/Type=Rotation", "Output/History/turn/Node=body"]
    history = culm.history("body/torque_free.xml", settings)
    names = [name for name in history.names if name.startswith("turn ")]
    turned = Rotation.from_rotvec(np.column_stack([history.column(name) for name in names]))
    spin = (turned[:-1].inv() * turned[1:]).as_rotvec()[:, 1]
    times = np.array(history.levels)
    middle = 0.5 * (times[1:] + times[:-1])
    at = np.flatnonzero(spin[1:] * spin[:-1] < 0.0)
    found = middle[at] + (middle[at + 1] - middle[at]) * spin[at] / (spin[at] - spin[at + 1])
    report.check("number of flips", len(found), 2, 0)
    report.relative("period [s]", 2.0 * (found[1] - found[0]), 2.0 * (FLIPS[1] - FLIPS[0]), 1e-4)
    report.check("flips at [s]", list(found), list(FLIPS), 1e-3)


def centres_of_mass(culm, deck, elements):
    """Times and centres of mass of equal elements of order 1 with uniform mass."""
    settings = ["Output/Every=1", "Structures/beam/Order=1", f"Structures/beam/Curve/Elements={elements}"]
    for node in range(elements + 1):
        settings += [f"Output/History/n{node}/Type=Position", f"Output/History/n{node}/Node=beam/{node}"]
    history = culm.history(deck, settings)
    weights = np.full(elements + 1, 1.0 / elements)
    weights[[0, -1]] *= 0.5
    positions = [[history.column(f"n{node} {axis} [m]") for node in range(elements + 1)] for axis in "xyz"]
    return np.array(history.levels), np.einsum("n,ant->at", weights, np.array(positions))


def verify_centres(culm, report):
    report.title("DY-1: spaghetti in the plane, centre of mass over 10 s; exact for steps that meet 2.5 s")
    times, centre = centres_of_mass(culm, "flight/spaghetti_2d.xml", 40)
    exact = np.where(times <= 2.5, 3.0 + 0.4 * times**2, 5.5 + 2.0 * (times - 2.5))
    report.holds("x, largest over 10 m", np.abs(centre[0] - exact).max() / 10.0, 1e-10)
    report.holds("y, z, largest over 10 m", np.abs(centre[1:] - [[4.0], [0.0]]).max() / 10.0, 1e-10)
    report.title("DY-2: spaghetti in space, centre of mass")
    times, centre = centres_of_mass(culm, "flight/spaghetti_3d.xml", 20)
    late = times >= 5.0 - 1e-9
    # the scheme integrates the two ramps of the triangle with opposite errors
    error = np.abs(centre[0] - (15.5 + 5.0 * (times - 5.0)))[late].max()
    report.holds("x from 5 s on, largest over 10 m", error / 10.0, 1e-10)
    report.holds("y, z, largest over 10 m", np.abs(centre[1:] - [[4.0], [0.0]]).max() / 10.0, 1e-10)


def verify_long_spin(culm, report, end=100):
    report.title(f"DY-6: torque-free body over {1000 * end} steps of 1e-3 s; 1e-12")
    settings = ["Analyses/motion/Step=1e-3", f"Analyses/motion/End Time={end}"]
    run = culm.run("body/torque_free.xml", [*settings, "Output/Every=100000"], quiet=False)
    for what in ("energy balance", "angular momentum"):
        report.holds(what, run.drift(what), 1e-12)


def fine(culm, report):
    verify_long_spin(culm, report, 1000)


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
    verify_top(culm, report)
    verify_flips(culm, report)
    verify_long_spin(culm, report)
    verify_centres(culm, report)
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


main(verify, plot, fine)
