#!/usr/bin/python3
"""DY-15: pendula and mass ratios. Page: doc/verification/pendula.md."""

import math

import numpy as np
from verify import figure, main, save

# first roots of the frequency equation of a cantilever with a tip mass, by mass ratio
ROOTS = {0.1: 1.722741521, 1.0: 1.24791741, 10.0: 0.7357819194, 1e3: 0.2340209425,
         1e6: 0.04161791205}
GRAVITY = 9.81
STEPS_PER_PERIOD = 40


def frequency_equation(root, ratio):
    """Zero for a root b of: 1 + cos b cosh b + ratio b (cos b sinh b - sin b cosh b) = 0."""
    c, s, ch, sh = math.cos(root), math.sin(root), math.cosh(root), math.sinh(root)
    return 1.0 + c * ch + ratio * root * (c * sh - s * ch)


def slowest(times, values):
    """Circular frequency of the slowest oscillation: peak of the spectrum, refined.

    The spectrum is taken through a Hann window and its peak found by golden section.
    """
    window = np.hanning(len(times))
    rough = np.abs(np.fft.rfft(window * values))
    width = 2.0 * math.pi / (times[-1] - times[0])

    def height(omega):
        return abs(np.sum(window * values * np.exp(-1j * omega * times)))

    low, high = (np.argmax(rough) - 1) * width, (np.argmax(rough) + 1) * width
    golden = 0.5 * (math.sqrt(5.0) - 1.0)
    while high - low > 1e-9 * high:
        a, b = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, b) if height(a) > height(b) else (a, high)
    return 0.5 * (low + high)


def verify_tip_mass(culm, report):
    report.title("Cantilever with a tip mass: frequency over that of the frequency equation")
    for ratio, root in ROOTS.items():
        # the root is where the equation changes sign
        below, above = (frequency_equation(root * (1.0 + d), ratio) for d in (-1e-8, 1e-8))
        report.holds(f"mass ratio {ratio:g}: the root is one", float(below * above > 0.0), 0.0)
        history = culm.history("beam/tip_mass.xml",
                               [f"mu={ratio}", f"b={root}", "Analyses/motion/End Time=30*T"])
        times = np.array(history.levels)
        found = slowest(times, np.array(history.column("tip uy [m]")))
        # the conserving scheme turns omega into 2/h atan(omega h / 2), exactly
        h = times[1] - times[0]
        report.relative(f"mass ratio {ratio:g}: omega [rad/s]", 2.0 / h * math.tan(0.5 * found * h),
                        root**2, 1e-4)


def rigid_pendulum(times, inertia, steps=20):
    """Angle from the horizontal of a rigid bar of 1 m and 10 kg, released at rest; Runge-Kutta."""
    pull = 10.0 * GRAVITY * 0.5 / inertia

    def rates(state):
        return np.array([state[1], pull * math.cos(state[0])])

    state, angles = np.zeros(2), [0.0]
    for start, end in zip(times, times[1:]):
        h = (end - start) / steps
        for _ in range(steps):
            k1 = rates(state)
            k2 = rates(state + 0.5 * h * k1)
            k3 = rates(state + 0.5 * h * k2)
            k4 = rates(state + h * k3)
            state = state + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        angles.append(state[0])
    return np.array(angles)


def stiff_pendulum(culm, modulus, step):
    return culm.history("beam/stiff_pendulum.xml",
                        [f"E={modulus}", "Analyses/motion/End Time=3", f"Analyses/motion/Step={step}"])



def paths(history):
    return np.array([history.column(f"tip {c} [m]") for c in "xyz"]).T


def farthest(one, other):
    return float(np.max(np.linalg.norm(one - other, axis=1)))


def verify_stiff(culm, report):
    report.title("Flexible pendulum over 3 s: to the rigid one as 1/E")
    history = stiff_pendulum(culm, 2.1e13, 1e-3)
    stiffest = paths(history)
    angles = rigid_pendulum(np.array(history.levels), 10.0 * (1.0 / 3.0 + 0.05**2 / 12.0))
    rigid = np.array([np.cos(angles), -np.sin(angles), 0.0 * angles]).T
    # the time step: (omega h)^2 / 12 of the phase per radian, omega h = 5.4e-3, 12 rad, 1 m
    report.holds("E = 2.1e13 from the rigid tip [m]", farthest(stiffest, rigid), 5e-5)
    gaps = [farthest(paths(stiff_pendulum(culm, modulus, 1e-3)), stiffest)
            for modulus in (2.1e9, 2.1e10, 2.1e11)]
    report.note("E = 2.1e9, 2.1e10, 2.1e11 from E = 2.1e13: "
                + ", ".join(f"{gap:.2e} m" for gap in gaps))
    for i in (0, 1):
        report.check("power of 1/E over a decade", math.log10(gaps[i] / gaps[i + 1]), 1.0, 0.1)


def verify_rubber(culm, report):
    report.title("Rubber rod over 1 s")
    deck = "beam/rubber_rod.xml"
    run = culm.run(deck, quiet=False)
    report.holds("energy balance, relative", run.drift("energy balance"), 1e-9)

    # root mean square over 50 instants: one instant alone shows the phase of fast oscillations
    times = [0.02 * i for i in range(1, 51)]

    def distance(one, other):
        return math.sqrt(sum(math.dist(one.vector("tip", t), other.vector("tip", t)) ** 2
                             for t in times) / len(times))

    steps = (1e-3, 5e-4, 2.5e-4, 1.25e-4)
    runs = [culm.history(deck, ["N=10", f"Analyses/motion/Step={h}"]) for h in steps]
    gaps = [distance(a, b) for a, b in zip(runs, runs[1:])]
    report.check("order in the step over three halvings", math.log2(gaps[0] / gaps[2]) / 2.0, 2.0, 0.1)
    meshes = [culm.history(deck, [f"N={n}"]) for n in (10, 20, 40)]
    gaps = [distance(a, b) for a, b in zip(meshes, meshes[1:])]
    report.note("10, 20, 40 elements of order 2 differ by "
                + ", ".join(f"{gap:.1e} m" for gap in gaps))
    report.holds("40 elements against 20 [m]", gaps[1], 1e-4)


def verify_masses(culm, report):
    report.title("Masses of 1 and 1e6 on alternate nodes")
    run = culm.run("beam/alternate_masses.xml", quiet=False)
    report.check("exit code", run.exit, 0, 0)
    report.check("steps cut back", run.cut_back(), 0, 0)
    report.holds("iterations of a step, at most 8:", run.most_iterations(), 8)
    report.holds("energy balance, relative", run.drift("energy balance"), 1e-9)


def verify_pendulum(culm, report):
    report.title("Flexible pendulum of the speed benchmark: tip at 5 s")
    history = culm.history("beam/pendulum.xml", ["N=100"])
    report.check("100 elements, 5e-3 s [m]", history.vector("tip")[:2], [6.5232, -7.5085], 5e-4)
    history = culm.history("beam/pendulum.xml", ["N=100", "Analyses/motion/Step=1.25e-3"])
    report.check("100 elements, 1.25e-3 s [m]", history.vector("tip")[:2], [6.5239, -7.5077], 5e-4)


def verify(culm, report):
    verify_tip_mass(culm, report)
    verify_stiff(culm, report)
    verify_rubber(culm, report)
    verify_masses(culm, report)
    verify_pendulum(culm, report)


def plot(culm, path):
    fig, (swing, gap) = figure(2)
    history = culm.history("beam/rubber_rod.xml", ["Analyses/motion/Step=1e-3"])
    for what in ("middle", "tip"):
        swing.plot(history.column(f"{what} x [m]"), history.column(f"{what} y [m]"), label=what)
    swing.set(title="rubber rod, 1 s", xlabel="x [m]", ylabel="y [m]", aspect="equal")
    swing.legend()
    history = stiff_pendulum(culm, 2.1e10, 1e-3)
    inertia = 10.0 * (1.0 / 3.0 + 0.05**2 / 12.0)
    angles = rigid_pendulum(np.array(history.levels), inertia)
    gap.plot(history.levels, history.column("tip y [m]"), label="culm, E = 2.1e10")
    gap.plot(history.levels[::60], -np.sin(angles[::60]), "k.", markersize=4, label="rigid")
    gap.set(title="stiff pendulum", xlabel="t [s]", ylabel="tip y [m]")
    gap.legend(loc="upper right")
    save(fig, path)


main(verify, plot)
