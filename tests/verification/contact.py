#!/usr/bin/python3
"""C22: contact with planes, bars and other beams: impacts, friction, a chain, a line on the seabed. Page: doc/verification/contact.md."""

import math
import re

from verify import main

BEAM, BALL, CHAIN, LINE = (f"contact/{name}.xml" for name in ("dropped_beam", "sliding_ball", "laid_chain", "catenary_of_beams"))
FORMS = ("Null Space", "Multipliers")


def last(history, column):
    return history.column(column)[-1]


def taken(run):
    """What dampers, with them friction, took [J]."""
    line = next(line for line in run.output.splitlines() if "taken by dampers" in line)
    return float(line.split()[-2])


def verify_impacts(culm, report):
    report.title("A tube that bounces on a plane for 0.8 s")
    for form in FORMS:
        run = culm.run(BEAM, [f"Solver/Form={form}"], quiet=False)
        report.holds(f"{form}: energy balance", run.drift("energy balance"), 1e-10)
        report.holds(f"{form}: horizontal momentum", run.drift("linear momentum"), 1e-9)
    sudden = culm.run(BEAM, ["Loads/ground/Smoothing=0"], quiet=False)
    report.holds("without smoothing: energy balance", sudden.drift("energy balance"), 1e-10)
    rough = culm.run(BEAM, ["Loads/ground/Friction=0.3", "Loads/ground/Slip Speed=0.01", "Loads/ground/Damping=0.5"], quiet=False)
    report.holds("friction and damping: energy balance", rough.drift("energy balance"), 1e-10)
    report.note(f"they took {taken(rough):.3f} J; iterations per step {rough.iterations() / 1600:.1f}, at most {rough.most_iterations()}")
    report.holds("they take energy", 0.0 if taken(rough) > 0.0 else 1.0, 0.0)


def restitution(damping, speed):
    """Of Hunt and Crossley's law: d v0 - ln(1 + d v0) = -d v1 - ln(1 - d v1)."""
    wanted = damping * speed - math.log1p(damping * speed)
    low, high = 0.0, min(speed, (1.0 - 1e-12) / damping)
    for _ in range(200):
        v = 0.5 * (low + high)
        low, high = (v, high) if -damping * v - math.log1p(-damping * v) < wanted else (low, v)
    return v


def verify_restitution(culm, report):
    report.title("A ball of 1 kg that meets the plane with 1 m/s, without weight: speed after the impact")
    for damping in (0.1, 0.5):
        settings = [f"Loads/ground/Damping={damping}", "Loads/ground/Friction=0", "Loads/ground/Smoothing=0",
                    "Loads/weight/Acceleration={0, 0, -1e-9}", "Structures/ball/Position={0, 0, 0.15}",
                    "Initial Conditions/throw/Velocity={0, 0, -1}", "Analyses/motion/Step=2e-4"]
        found = last(culm.history(BALL, settings), "ball vz [m/s]")
        report.relative(f"d = {damping} s/m", found, restitution(damping, 1.0), 1e-4)


def verify_friction(culm, report):
    report.title("A ball that slides until it rolls")
    run = culm.run(BALL, quiet=False)
    report.relative("speed [m/s]", last(run.history, "ball vx [m/s]"), 5.0 / 7.0, 2e-4)
    report.relative("spin [rad/s]", last(run.history, "spin wy [rad/s]"), 50.0 / 7.0, 2e-4)
    report.relative("taken by friction [J]", taken(run), 1.0 / 7.0, 2e-4)
    report.holds("energy balance", run.drift("energy balance"), 1e-10)
    # x = v t - mu g t^2 / 2 until it rolls, then 5/7 v
    rolls = 2.0 / (7.0 * 0.2 * 9.81)
    way = rolls - 0.981 * rolls**2 + 5.0 / 7.0 * (0.3 - rolls)
    report.relative("way [m]", last(run.history, "place x [m]"), way, 2e-4)


def verify_friction_on_a_bar(culm, report):
    report.title("The same along a round bar without ends, which is harder")
    hard = ["Loads/ground/Stiffness=1e9", "Loads/ground/Smoothing=1e-6", "Structures/ball/Position={0, 0, 0.1 - 9.81e-6}"]
    bar = ["Loads/ground/Type=Cylinder Contact", "Loads/ground/From={0, 0, -0.5}", "Loads/ground/To={1, 0, -0.5}",
           "Loads/ground/Bar Radius=0.5", "Loads/ground/Ends=false"]
    run = culm.run(BALL, [*bar, *hard], quiet=False)
    report.relative("speed [m/s]", last(run.history, "ball vx [m/s]"), 5.0 / 7.0, 2e-4)
    report.relative("spin [rad/s]", last(run.history, "spin wy [rad/s]"), 50.0 / 7.0, 2e-4)
    report.relative("taken by friction [J]", taken(run), 1.0 / 7.0, 2e-4)
    report.holds("energy balance", run.drift("energy balance"), 1e-10)
    report.title("A bar that strikes a free tube, with friction and damping")
    run = culm.run("contact/struck_beam.xml", ["Loads/blow/Friction=0.3", "Loads/blow/Slip Speed=0.1", "Loads/blow/Damping=0.05"], quiet=False)
    for what in ("energy balance", "linear momentum", "angular momentum"):
        report.holds(what, run.drift(what), 1e-10)
    report.holds("they take energy", 0.0 if taken(run) > 0.0 else 1.0, 0.0)
    report.title("A ball of 100 m/s, which would pass a bar in one step, bounces")
    bar = [*bar[:3], "Loads/ground/From={-1, 0, -0.05}", "Loads/ground/To={1, 0, -0.05}", "Loads/ground/Bar Radius=0.05", "Loads/ground/Friction=0",
           "Structures/ball/Position={0, 0, 0.8}", "Initial Conditions/throw/Velocity={0, 0, -100}", "Analyses/motion/Step=0.03",
           "Loads/ground/Smoothing=0", "Loads/ground/Stiffness=1e10"]
    run = culm.run(BALL, bar, quiet=False)
    flown = math.sqrt(100.0**2 - 2.0 * 9.81 * (last(run.history, "place z [m]") - 0.8))
    report.relative("speed upwards [m/s]", last(run.history, "ball vz [m/s]"), flown, 1e-6)
    report.holds("energy balance", run.drift("energy balance"), 1e-10)
    report.note(f"{run.cut_back()} steps cut back")


def verify_friction_at_rest(culm, report):
    report.title("Friction in statics: a bar dragged over rough ground, let go, and dragged again")
    run = culm.run("contact/dragged_bar.xml", quiet=False)
    whole = 300.0**2 / (2.0 * 1e6 * 50.0)
    for level, share in ((0.6, 0.36), (1.0, 1.0), (2.0, 0.5), (3.0, 1.0)):
        row = next(i for i, one in enumerate(run.history.levels) if abs(one - level) < 1e-9)
        report.relative(f"its end at {level} [mm]", 1e3 * run.history.column("end ux [m]")[row], 1e3 * share * whole, 2e-3)
    report.note(f"iterations per step {run.iterations() / 15:.1f}, at most {run.most_iterations()}; {run.cut_back()} steps cut back")
    report.title("A rope around a bar: Euler and Eytelwein, with the lever of the rope's own radius")
    radius, axis, tension, stiffness = 0.5, 0.501, 100.0, 1e5
    mu = 0.3 * radius / axis
    # a radius that gives way adds to what stretches
    per_force = axis / stiffness + 1.0 / (axis * 5e8 * 0.02)

    def end(ratio):
        """How far the end comes that is pulled with the ratio times the force at the other: it slips up to an angle."""
        slips = 0.5 * math.pi + math.log(ratio) / (2.0 * mu)
        slid = ratio * (1.0 - math.exp(-mu * slips))
        before = math.exp(-mu * (math.pi - slips)) - math.exp(-0.5 * mu * math.pi)
        return per_force * tension / mu * (slid - before)

    run = culm.run("contact/capstan.xml", quiet=False)
    come = [-z for z in run.history.column("right uz [m]")]
    report.relative("end pulled with 1.75 times the force, less with 1 [mm]", 1e3 * (come[15] - come[10]), 1e3 * (end(1.75) - end(1.0)), 1.5e-2)
    report.relative("with 2.5 times the force [mm]", 1e3 * come[20], 1e3 * end(2.5), 1e-2)
    report.relative("with the same force at both [mm]", 1e3 * come[10], 1e3 * end(1.0), 1e-4)
    report.note(f"iterations per step {run.iterations() / 20:.1f}, at most {run.most_iterations()}; {run.cut_back()} steps cut back")
    brake = culm.run("contact/band_brake.xml", quiet=False).history
    for level, sign in ((2.0, 1.0), (3.0, -1.0)):
        row = max(i for i, one in enumerate(brake.levels) if abs(one - level) < 1e-9)
        wanted = tension * math.exp(sign * mu * math.pi)
        report.relative(f"band brake at {level}, end that is held [N]", -brake.column("hold Fz [N]")[row], wanted, 5e-4)
        report.relative("moment on the drum [N m]", brake.column("drum My [N m]")[row], (wanted - tension) * axis, 5e-4)
    run = culm.run("contact/capstan.xml", ["most=2.6"], quiet=False)
    report.holds("beyond the limit it fails", 0.0 if run.exit == 4 else 1.0, 0.0)
    level = float(re.search(r"No equilibrium beyond level (\S+)", run.output + run.errors)[1])
    report.relative("the last ratio", 1.0 + 1.6 * (level - 1.0), math.exp(mu * math.pi), 2e-3)


def verify_chain(culm, report):
    report.title("C22: a chain that lays itself on the seabed, 2 s")
    run = culm.run(CHAIN, quiet=False)
    report.holds("energy balance", run.drift("energy balance"), 1e-10)
    report.relative("depth of its end [mm]", -1e3 * last(run.history, "end z [m]"), 98.1 / 300.0, 2e-2)
    report.note(f"damping and friction took {taken(run):.1f} J; iterations per step {run.iterations() / 2000:.1f}, "
                f"at most {run.most_iterations()}; {run.cut_back()} steps cut back")


def verify_line(culm, report):
    report.title("C22: the catenary of C20 made of 50 beams")
    bed = [f"Output/History/bed/{one}" for one in ("Type=Position", "Node=line/20")]
    run = culm.run(LINE, bed, quiet=False)
    report.relative("H [N]", last(run.history, "fairlead Fx [N]"), 96643.4804, 5e-3)
    report.relative("V [N]", last(run.history, "fairlead Fz [N]"), 237751.7901, 5e-3)
    report.relative("on the ground [m]", last(run.history, "seabed area [m^2]") / 0.1, 202.81026, 2e-2)
    report.relative("depth on the ground, w / (k D) [mm]", -1e3 * last(run.history, "bed z [m]"), 800.0 / 300.0, 1e-3)
    report.note(f"iterations per step {run.iterations() / 10:.1f}, at most {run.most_iterations()}")


def verify_kinks(culm, report):
    report.title("The same with a tenth of the bending stiffness: kinks beyond T = 24 EI / L^2 are told, and finer elements have none")
    soft = ["Sections/chain/EI1=1e5", "Sections/chain/EI2=1e5"]
    coarse = culm.run(LINE, soft, quiet=False)
    report.holds("50 elements: fails", 0.0 if coarse.exit == 4 else 1.0, 0.0)
    report.holds("and says why", 0.0 if "kinks may grow" in coarse.output + coarse.errors else 1.0, 0.0)
    fine = culm.run(LINE, [*soft, "Structures/line/Curve/Elements=170"], quiet=False)
    report.relative("170 elements: H [N]", last(fine.history, "fairlead Fx [N]"), 96643.4804, 5e-3)
    report.holds("no such warning", 1.0 if "kinks may grow" in fine.output + fine.errors else 0.0, 0.0)


def verify_bars(culm, report):
    report.title("A rod between three bars, 100 N")
    run = culm.run("contact/pressed_rod.xml", quiet=False)
    sinks = 0.5 * sum(last(run.history, f"{end} end z [m]") for end in ("left", "right")) - last(run.history, "middle z [m]")
    report.relative("the middle sinks [mm]", 1e3 * sinks, 1e3 * (100.0 / (48.0 * 1649.3) + 100.0 / (4.0 * 2.2e7)), 5e-3)
    # pressures on a round bar are a little aslant, so their sum is larger than their resultant
    for name, force in (("left", 50.0), ("right", 50.0), ("top", 100.0)):
        report.relative(f"{name} [N]", last(run.history, f"{name} F [N]"), force, 2e-3)
    report.note(f"iterations per step {run.iterations() / 4:.1f}, at most {run.most_iterations()}")
    report.title("A bar that strikes a free tube")
    for settings in (*([f"Solver/Form={form}"] for form in FORMS), ["Loads/blow/Smoothing=0"]):
        run = culm.run("contact/struck_beam.xml", settings, quiet=False)
        for what in ("energy balance", "linear momentum", "angular momentum"):
            report.holds(f"{settings[0].split('/')[-1]}: {what}", run.drift(what), 1e-10)
    report.note(f"iterations per step {run.iterations() / 500:.1f}, at most {run.most_iterations()}")


class Lines:
    """The law of `Beam Contact`: forces of straight lines at a depth."""

    def __init__(self, reach, line_force, depth):
        self.reach = reach
        self.strength = 3.0 * line_force / (16.0 * (reach - depth) * (reach**2 - (reach - depth) ** 2) ** 1.5)

    def inside(self, depth):
        return self.reach**2 - (self.reach - max(depth, 0.0)) ** 2

    def along(self, depth):
        return 16.0 / 3.0 * self.strength * (self.reach - depth) * self.inside(depth) ** 1.5

    def across(self, depth):
        return 2.0 * math.pi * self.strength * (self.reach - depth) * self.inside(depth) ** 2


EI, GA = 2.4e4, 2e7


def verify_crossing(culm, report):
    report.title("Crossed cantilevers, 200 N at the end of one")
    length, at = 1.2, 1.0
    law = Lines(0.06, 2e4, 5e-4)
    own = at**3 / (3 * EI) + at / GA
    end = at**2 * (3 * length - at) / (6 * EI) + at / GA
    low, high = 0.0, 0.01
    for _ in range(200):  # depth = deflection of the one there less that of the other
        depth = 0.5 * (low + high)
        low, high = (low, depth) if depth > 200.0 * end - 2.0 * law.across(depth) * own else (depth, high)
    run = culm.run("contact/crossed_cantilevers.xml", quiet=False)
    force = law.across(depth)
    report.relative("force [N]", last(run.history, "touch F [N]"), force, 1e-3)
    report.relative("end of the lower [mm]", 1e3 * last(run.history, "lower end z [m]"),
                    1e3 * (200.0 * (length**3 / (3 * EI) + length / GA) - force * end), 1e-3)
    report.relative("end of the upper [mm]", 1e3 * (last(run.history, "upper end z [m]") - 0.06), 1e3 * force * end, 1e-3)
    rough = culm.run("contact/crossed_cantilevers.xml", ["Loads/touch/Friction=0.3"], quiet=False)
    report.holds("friction between beams at rest is said to be missing", 0.0 if "rubs in dynamics only" in rough.errors else 1.0, 0.0)
    report.note(f"depth {1e3 * depth:.3f} mm; iterations per step {run.iterations() / 4:.1f}, at most {run.most_iterations()}")


def verify_along(culm, report):
    import numpy as np
    from scipy.integrate import solve_bvp

    report.title("Cantilevers along each other, 50 N/m on the upper one")
    law = Lines(0.06, 100.0, 5e-4)

    def slopes(_, y):
        w, turn, moment, shear, v, other_turn, other_moment, other_shear = y
        f = np.array([law.along(depth) for depth in v - w])
        return np.array([turn + shear / GA, moment / EI, -shear, 50.0 - f,
                         other_turn + other_shear / GA, other_moment / EI, -other_shear, f])

    def ends(a, b):
        return np.array([a[0], a[1], b[2], b[3], a[4], a[5], b[6], b[7]])

    x = np.linspace(0.0, 2.0, 401)
    guess = np.zeros((8, x.size))
    guess[0] = -1e-3 * x**2 - 3e-4
    guess[4] = -1e-3 * x**2
    found = solve_bvp(slopes, ends, x, guess, tol=1e-8, max_nodes=100000)
    run = culm.run("contact/cantilevers_along.xml", quiet=False)
    report.holds("equations of both beams", max(found.rms_residuals), 1e-7)
    report.relative("end of the upper [mm]", 1e3 * (last(run.history, "upper end z [m]") - 0.06), 1e3 * found.y[0][-1], 1e-3)
    report.relative("end of the lower [mm]", 1e3 * last(run.history, "lower end z [m]"), 1e3 * found.y[4][-1], 1e-3)
    report.note(f"iterations per step {run.iterations() / 4:.1f}, at most {run.most_iterations()}")


def verify_impact_of_beams(culm, report, impact=("Analyses/motion/End Time=0.015",)):
    report.title("A rod that falls on a free tube")
    # but for one the impact itself, from 0.0107 s to 0.0127 s, not the flight after it; equations of multipliers take
    # seven times as long
    for settings in (["Solver/Form=Null Space"], ["Solver/Form=Multipliers", *impact], ["Loads/impact/Line Force=3e7", *impact]):
        run = culm.run("contact/falling_rod.xml", settings, quiet=False)
        for what in ("energy balance", "linear momentum", "angular momentum"):
            report.holds(f"{settings[0].split('/')[-1]}: {what}", run.drift(what), 1e-10)
        report.note(f"largest force {max(run.history.column('impact F [N]')):.0f} N; iterations per step "
                    f"{run.iterations() / (len(run.history.column('impact F [N]')) - 1):.1f}, at most {run.most_iterations()}; "
                    f"{run.cut_back()} steps cut back")
    rough = culm.run("contact/falling_rod.xml", ["Loads/impact/Friction=0.3", "Loads/impact/Slip Speed=0.01", "Loads/impact/Damping=0.3",
                                                   *impact], quiet=False)
    for what in ("energy balance", "linear momentum", "angular momentum"):
        report.holds(f"friction and damping: {what}", rough.drift(what), 1e-10)
    report.holds("they take energy", 0.0 if taken(rough) > 0.0 else 1.0, 0.0)
    report.note(f"they took {taken(rough):.3f} J")


def verify_rolling(culm, report):
    report.title("A rod that slides on rails until it rolls")
    run = culm.run("contact/rolling_rod.xml", quiet=False)
    mass, inertia, radius = 2.2, 1.8e-3, 0.03
    speed = mass * radius**2 / (inertia + mass * radius**2)
    report.relative("speed [m/s]", last(run.history, "rod vx [m/s]"), speed, 2e-2)
    report.relative("spin [rad/s]", last(run.history, "spin wy [rad/s]"), speed / radius, 2e-2)
    report.holds("energy balance", run.drift("energy balance"), 1e-10)
    report.note(f"friction and damping took {taken(run):.4f} J; iterations per step {run.iterations() / 350:.1f}, "
                f"at most {run.most_iterations()}; {run.cut_back()} steps cut back")


def verify(culm, report):
    verify_crossing(culm, report)
    verify_along(culm, report)
    verify_impact_of_beams(culm, report)
    verify_rolling(culm, report)
    verify_impacts(culm, report)
    verify_restitution(culm, report)
    verify_friction(culm, report)
    verify_friction_on_a_bar(culm, report)
    verify_friction_at_rest(culm, report)
    verify_chain(culm, report)
    verify_bars(culm, report)
    verify_line(culm, report)
    verify_kinks(culm, report)


def fine(culm, report):
    verify_impact_of_beams(culm, report, impact=())


main(verify, fine=fine)
