#!/usr/bin/python3
"""Strips: flutter of the typical section and of Goland's wing in time, stall flutter, drag, rotating frames.

Page: doc/verification/strips.md."""

import math

import numpy as np
from scipy.integrate import quad, solve_ivp
from verify import INPUTS, figure, main, poles, save

# eigenvalues of the same models with Jones' states
SECTION = (25.379599, 16.695289)  # m/s, rad/s
GOLAND = (137.335, 69.346)


def oscillation(culm, deck, column, speed, begin, end, step, among):
    """Growth [1/s] and circular frequency [rad/s] of the mode that flutters."""
    name = "V" if "section" in deck else "U"
    gentle = ["Loads/disturbance/Force={0, 0.1, 0}"] if "section" in deck else []
    history = culm.history(deck, [f"{name}={speed}", f"Analyses/motion/End Time={end}",
                                  f"Analyses/motion/Step={step}", *gentle])
    times = np.array(history.levels)
    free = times > begin
    found = poles(times[free], np.array(history.column(column))[free], 6)
    best = max((p for p in found if among[0] < p.imag < among[1]), key=lambda p: p.real)
    return best.real, best.imag


def flutter(culm, low, high, *arguments, deck, column):
    """Speed and frequency without growth, linear between two speeds near it."""
    (g0, w0), (g1, w1) = (oscillation(culm, deck, column, u, *arguments) for u in (low, high))
    share = -g0 / (g1 - g0)
    return low + share * (high - low), w0 + share * (w1 - w0)


def section(culm, step):
    return flutter(culm, 25.2, 25.6, 1.0, 8.0, step, (10.0, 25.0), deck="air/typical_section.xml",
                   column="axis uy [m]")


def goland(culm, step):
    return flutter(culm, 135.0, 140.0, 0.1, 1.5, step, (50.0, 90.0), deck="air/goland_strips.xml",
                   column="tip uz [m]")


def stall_flutter(speed, end):
    """Displacements of the section of the deck whose separation follows at once, by an integrator of its own, in the last third."""
    table = np.loadtxt(INPUTS / "turbine/nrel5mw/include/airfoils/naca64_a17.csv", delimiter=",", comments="#")
    angle, mass, stiffness = math.radians(23.5), 20.0, 80.0

    def rates(t, y):
        across, along = speed * math.sin(angle) - y[1], speed * math.cos(angle)
        square = across**2 + along**2
        lift, drag = (np.interp(math.degrees(math.atan2(across, along)), table[:, 0], table[:, k]) for k in (1, 2))
        force = 0.5 * 1.225 * math.sqrt(square) * (lift * along + drag * across)
        return [y[1], (force - stiffness * y[0]) / mass]

    times = np.linspace(2 * end / 3, end, 2001)
    return solve_ivp(rates, (0.0, end), [0.0, 0.1], t_eval=times, rtol=1e-8, atol=1e-10, max_step=0.05).y[0]


def verify_stall_flutter(culm, report):
    report.title("Stall flutter: half of the range of the limit cycle [m], step 0.02 s: 157 in a period")
    late = {}
    for lag in ("None", "Oye"):
        history = culm.history("air/stall_flutter.xml", [f"Loads/air on the section/Lag={lag}"])
        late[lag] = np.array(history.column("section uy [m]"))[np.array(history.levels) > 40.0]
    wanted = stall_flutter(20.0, 60.0)
    report.relative("separation at once", np.ptp(late["None"]) / 2, np.ptp(wanted) / 2, 2e-3)
    report.relative("its mean", late["None"].mean(), wanted.mean(), 2e-3)
    report.note(f"separation that follows late (Oye): {np.ptp(late['Oye']) / 2:.4f}")


def verify_drag(culm, report):
    report.title("Mast in a wind that it stands about: drag at once on the undeformed mast, by stations and by the integral [N]")
    speed, height, exponent, stations = 20.0, 40.0, 0.2, 40

    def per_length(z):
        return 0.5 * 1.225 * 0.7 * (0.8 - 0.4 * z / height) * (speed * (z / height) ** exponent) ** 2

    z = (np.arange(stations) + 0.5) * height / stations
    run = culm.run("air/mast_in_wind.xml", [f"stations={stations}", "Sections/tube/Young Modulus=2.1e15"], quiet=False)
    static = next(i for i, level in enumerate(run.history.levels) if level >= 1.0)
    force, moment, box = (run.history.column(name)[static] for name in ("mast Fx [N]", "mast My [N m]", "box Fx [N]"))
    report.relative("force on the mast", force, per_length(z).sum() * height / stations, 1e-5)
    report.relative("its moment", moment, (per_length(z) * z).sum() * height / stations, 1e-5)
    report.relative("force, integral", force, quad(per_length, 0.0, height)[0], 1e-3)
    report.relative("force on the box", box, 0.5 * 1.225 * 1.2 * 2.0 * 1.5 * speed**2, 1e-5)
    report.relative("reaction", run.history.column("ground Fx [N]")[static], -force - box, 1e-9)
    report.holds("balance of energy of the storm", run.drift("energy balance"), 1e-10)


def verify_frame(culm, report):
    report.title("Blade that turns and flaps about its hinge: eigenvalue [rad/s] by Lock's number")
    speed, radius, chord, inertia = 30.0, 5.0, 0.4, 9.4 * 5.0**3 / 3.0
    for count in (20, 40):
        run = culm.succeed("air/flapping_blade.xml", [f"stations={count}"])
        modes = run.tables["modes/modes"]
        r = (np.arange(count) + 0.5) * radius / count
        lift = 0.5 * 1.225 * 2.0 * math.pi * chord * speed * radius / count  # per speed across the chord, over r
        damping = lift * (r**3).sum() / inertia
        # flapped by b, the blade turns about its span with b times the speed, which the three-quarter chord feels
        square = speed**2 - lift * 0.5 * chord * speed * (r**2).sum() / inertia
        found = [modes.at(1, f"eigenvalue {part} [1/s]") for part in ("real", "imaginary")]
        report.relative(f"{count} stations", found, [-damping / 2.0, math.sqrt(square - damping**2 / 4.0)], 1e-6)
        lock = 1.225 * 2.0 * math.pi * chord * radius**4 / inertia
        report.relative("decay by Lock's number", -found[0], speed * lock / 16.0, 1.0 / count**2)
        report.relative("wind at the last station [m/s]", run.history.column("tip V [m/s]")[-1],
                        30.0 * 5.0 * (1.0 - 0.5 / count), 1e-9)


def verify(culm, report):
    verify_drag(culm, report)
    verify_frame(culm, report)
    verify_stall_flutter(culm, report)
    report.title("Typical section, step 0.01 s: 38 in a period")
    speed, omega = section(culm, 0.01)
    report.relative("speed of flutter [m/s]", speed, SECTION[0], 1e-3)
    report.relative("frequency [rad/s]", omega, SECTION[1], 5e-3)
    report.title("Goland's wing, 24 stations, step 1 ms: 91 in a period")
    speed, omega = goland(culm, 1e-3)
    report.relative("speed of flutter [m/s]", speed, GOLAND[0], 1e-3)
    report.relative("frequency [rad/s]", omega, GOLAND[1], 2e-3)


def plot(culm, path):
    fig, axes = figure()
    axes = np.atleast_1d(axes)[0]
    for speed in (24.0, 25.4, 26.0):
        history = culm.history("air/typical_section.xml", [f"V={speed}", "Analyses/motion/End Time=4"])
        axes.plot(history.levels, [1e3 * u for u in history.column("axis uy [m]")],
                  label=f"{speed:g} m/s")
    axes.set(title="Typical section", xlabel="time [s]", ylabel="plunge [mm]")
    axes.legend()
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
