#!/usr/bin/python3
"""Modes of machines whose rotor turns: closed forms, and the turning turbine. Page: doc/verification/rotors.md."""

import math

import numpy as np
from verify import figure, main, save

DISK = "modes/overhung_disk.xml"
RESONANCE = "modes/ground_resonance.xml"
TURBINE = "turbine/nrel5mw/turbine_campbell.xml"
STANDSTILL = "turbine/nrel5mw/turbine_modes.xml"
BLADE = "turbine/nrel5mw/blade_campbell.xml"
OPERATION = "turbine/nrel5mw/turbine_operation.xml"
TOP_SPEED = 400.0  # of the disk [rad/s]
LEVELS = [0.125 * i for i in range(9)]
RESONANCE_SPEED = 30.0  # [rad/s]
RPM = 12.1
PER_REVOLUTION = RPM / 60.0  # [Hz]


def eigenvalues(mass, damping, stiffness):
    """Those of lambda^2 M + lambda C + K above the real axis, by frequency."""
    n = len(mass)
    inverse = np.linalg.inv(mass)
    system = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ stiffness, -inverse @ damping]])
    values = np.linalg.eigvals(system)
    return sorted((v for v in values if v.imag > 1e-9), key=lambda v: v.imag)


def disk(speed):
    """Frequencies [Hz] of a rigid disk on the end of a massless shaft: w and w' of the end in two planes."""
    L, EI, GA = 0.8, 1e4, 1e7
    flexibility = np.array([[L**3 / (3 * EI) + L / GA, L**2 / (2 * EI)], [L**2 / (2 * EI), L / EI]])
    bend = np.linalg.inv(flexibility)
    inertia = np.diag([10.0, 0.32])  # with the bearing
    zero = np.zeros((2, 2))
    spin = np.diag([0.0, 0.6 * speed])
    mass = np.block([[inertia, zero], [zero, inertia]])
    stiffness = np.block([[bend, zero], [zero, bend]])
    return [v.imag / (2 * math.pi) for v in eigenvalues(mass, np.block([[zero, spin], [-spin, zero]]), stiffness)]


def coleman(speed, pad=0.0):
    """Ground resonance: unknowns x, y of the fuselage and lag angles, cosine, sine, collective.

    A pad is a mass on each blade, 1 m from the hinge, with a radius of inertia of 0.2 m."""
    total, moment, inertia, hinge = 150.0 + 3.0 * pad, 15.0 + pad, 2.0 + 10.0 * 1.5**2 + 1.04 * pad, 0.3
    lag = 500.0 + speed**2 * hinge * moment
    c, c_lag = 50.0, 5.0
    mass = np.diag([total, total, inertia, inertia, inertia])
    mass[0, 3] = -1.5 * moment
    mass[3, 0] = -moment
    mass[1, 2] = 1.5 * moment
    mass[2, 1] = moment
    damping = np.diag([c, c, c_lag, c_lag, c_lag])
    damping[2, 3] = 2 * speed * inertia
    damping[3, 2] = -2 * speed * inertia
    stiffness = np.diag([1.3e4, 1e4, lag - speed**2 * inertia, lag - speed**2 * inertia, lag])
    stiffness[2, 3] = speed * c_lag
    stiffness[3, 2] = -speed * c_lag
    return eigenvalues(mass, damping, stiffness)


def pads(mass):
    """Each as a structure of its own, joined by equations, so that a blade is a node set."""
    settings = ["Analyses/diagram/Rotor/Blades={a, b, c}",
                "Loads/rotation/Structures={hub, blade 1, blade 2, blade 3, pad 1, pad 2, pad 3}"]
    for k, name in zip((1, 2, 3), "abc"):
        angle = 2 * math.pi * (k - 1) / 3
        place = f"{{{1.3 * math.cos(angle)!r}, {1.3 * math.sin(angle)!r}, 0}}"
        settings += [f"Structures/pad {k}/{entry}" for entry in (
            "Type=Rigid Body", f"Position={place}", f"Mass={mass}", f"Inertia={{0.1, 0.1, {0.04 * mass}}}",
            f"Directors={{{math.cos(angle)!r}, {math.sin(angle)!r}, 0, {-math.sin(angle)!r}, {math.cos(angle)!r}, 0, 0, 0, 1}}")]
        for joint, kind in (("seat", "Revolute Joint"), ("grip", "Joint Angle")):
            settings += [f"Constraints/{joint} {k}/{entry}" for entry in (
                f"Type={kind}", f"First=blade {k}", f"Second=pad {k}", "Axis={0, 0, 1}")]
        settings.append(f"Node Sets/{name}/Nodes={{blade {k}, pad {k}}}")
    return settings


def resonance(culm, level, settings=()):
    """Frequencies [Hz] and damping ratios, by frequency."""
    table = culm.table("diagram/campbell", RESONANCE, [f"Analyses/diagram/Levels={{{level}}}", *settings])
    pairs = [(table.at(1, f"frequency {i} [Hz]"), table.at(1, f"damping ratio {i}")) for i in range(1, 6)]
    return sorted(pairs)


def verify_disk(culm, report):
    report.title("Disk on the end of a shaft: gyroscopic splitting")
    table = culm.table("diagram/campbell", DISK)
    columns = [table.column(f"frequency {i} [Hz]") for i in range(1, 5)]
    for row, level in enumerate(LEVELS):
        found = sorted(column[row] for column in columns)
        report.relative(f"{level * TOP_SPEED:g} rad/s [Hz]", found, disk(level * TOP_SPEED), 1e-5)


def verify_resonance(culm, report):
    report.title("Ground resonance: Coleman's equations")
    grows = 0
    for level in (0.0, 0.1, 0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0):
        found = resonance(culm, level)
        wanted = coleman(level * RESONANCE_SPEED)
        grows += found[0][1] < 0.0 or found[1][1] < 0.0
        speed = f"{level * RESONANCE_SPEED:g} rad/s"
        report.relative(f"{speed} [Hz]", [f for f, _ in found], [v.imag / (2 * math.pi) for v in wanted], 1e-7)
        report.check(f"{speed}, damping ratios", [d for _, d in found], [-v.real / abs(v) for v in wanted], 1e-7)
    report.check("some speeds are unstable", grows > 0, True, 0)
    found = [f for f, _ in resonance(culm, 0.5, pads(2.0))]
    wanted = [v.imag / (2 * math.pi) for v in coleman(0.5 * RESONANCE_SPEED, 2.0)]
    report.relative("15 rad/s, blades of two structures [Hz]", found, wanted, 1e-7)


def turbine(culm, settings=()):
    return culm.table("modes/modes", TURBINE, settings).column("frequency [Hz]")


def verify_standstill(culm, report):
    report.title("Turbine at speed 0: the modes of the model that does not turn")
    turned = turbine(culm, ["Loads/rotation/Speed=0"])
    plain = culm.table("modes/modes", STANDSTILL, ["Loads/weight/Acceleration={0, 0, 0}"]).column("frequency [Hz]")
    report.relative("frequencies [Hz]", turned, plain[: len(turned)], 1e-8)


def verify_blades(culm, report):
    report.title("Turbine with its hub held: each mode of the blade as backward whirl, collective, forward whirl")
    blade = culm.table("campbell/campbell", BLADE, [
        "Analyses/Campbell/Levels={1}", "Analyses/Campbell/Damping=true", "Structures/blade/Damping=0"])
    held = ["Constraints/held/Type=Rigid Support", "Constraints/held/Node=hub", "Analyses/modes/Modes=24"]
    table = culm.table("modes/modes", TURBINE, held)
    shares = {name: table.column(name) for name in ("backward whirl", "collective", "forward whirl")}
    frequencies = table.column("frequency [Hz]")
    for mode in range(1, 7):
        alone = blade.at(1, f"frequency {mode} [Hz]")
        for name, shift in zip(shares, (-PER_REVOLUTION, 0.0, PER_REVOLUTION)):
            row = min(range(len(frequencies)), key=lambda i: abs(frequencies[i] - alone - shift))
            report.relative(f"mode {mode}, {name} [Hz]", frequencies[row], alone + shift, 1e-6)
            report.check(f"mode {mode}, share of {name}", shares[name][row], 1.0, 1e-6)


# Two branches: of all strains alike, and by strain.
RESIN = (("resin", 0.05, "{0.3}"), ("slow", 1.0, "{0.1, 0.2, 0.1, 0.2, 0.1, 0.4}"))


def resin(blade):
    settings = [f"Structures/{blade}/Damping=0"]
    for name, time, ratios in RESIN:
        entry = f"Structures/{blade}/Relaxation/{name}"
        settings += [f"{entry}/Time={time}", f"{entry}/Ratios={ratios}"]
    return settings


def verify_relaxing_blades(culm, report):
    report.title("The same with viscoelastic blades: eigenvalues alone, shifted by i Omega and -i Omega in whirls")
    blade = culm.table("campbell/campbell", BLADE, [
        "Analyses/Campbell/Levels={1}", "Analyses/Campbell/Damping=true", *resin("blade")])
    held = ["Constraints/held/Type=Rigid Support", "Constraints/held/Node=hub",
            "Analyses/modes/Modes=24", "Analyses/modes/Damping=true"]
    table = culm.table("modes/modes", TURBINE, [*held, *(s for k in (1, 2, 3) for s in resin(f"blade {k}"))])
    parts = [table.column(f"eigenvalue {part} [1/s]") for part in ("real", "imaginary")]
    found = [complex(real, imaginary) for real, imaginary in zip(*parts)]
    for mode in range(1, 7):
        omega = 2.0 * math.pi * blade.at(1, f"frequency {mode} [Hz]")
        ratio = blade.at(1, f"damping ratio {mode}")
        alone = complex(-ratio / math.sqrt(1.0 - ratio**2) * omega, omega)
        for name, m in (("backward whirl", -1), ("collective", 0), ("forward whirl", 1)):
            wanted = alone + 2j * math.pi * m * PER_REVOLUTION
            apart = min(abs(one - wanted) for one in found) / abs(wanted)
            report.holds(f"mode {mode}, {name}, relative,", apart, 1e-6)


# The turbine is brought to its speed without weight, and at 72 s its nacelle gets a knock.
KNOCK = [
    "Loads/weight/Acceleration={0, 0, 0}", "stop=230", "end=230.01", "Output/Every=10000",
    "Functions/pulse/Type=Expression", "Functions/pulse/Expression=exp(-((t - 72)/0.12)^2)",
    "Loads/knock/Type=Force", "Loads/knock/Node=nacelle", "Loads/knock/Force={4e5, 4e5, 0}", "Loads/knock/Function=pulse",
    "Loads/twist/Type=Moment", "Loads/twist/Node=nacelle", "Loads/twist/Moment={0, 0, 8e6}", "Loads/twist/Function=pulse",
    "Output/History/nacelle/Type=Rotation", "Output/History/nacelle/Node=nacelle",
]
# which signal shows which mode of the turbine at 12.1 rpm
SEEN = {"tower top uy [m]": (1, 4, 6, 8), "tower top ux [m]": (2, 5), "nacelle rz [rad]": (3, 7)}


class Spectrum:
    """Of a signal in motion that has died down a little, with peaks between its lines."""

    def __init__(self, times, values):
        n = len(values)
        self.size = np.abs(np.fft.rfft((values - values.mean()) * np.hanning(n), 8 * n))
        self.frequency = np.fft.rfftfreq(8 * n, times[1] - times[0])

    def peak(self, near):
        """Frequency of the highest line within 2 %, by the parabola through the logarithms of three lines."""
        window = np.abs(self.frequency / near - 1.0) < 0.02
        i = int(np.flatnonzero(window)[np.argmax(self.size[window])])
        a, b, c = np.log(self.size[i - 1 : i + 2])
        return self.frequency[i] + 0.5 * (a - c) / (a - 2 * b + c) * self.frequency[1]


def knocked(culm):
    history = culm.history(OPERATION, KNOCK)
    times = np.array(history.levels)
    free = (times > 76.0) & (times < 229.995)
    return {name: Spectrum(times[free], np.array(history.column(name))[free]) for name in SEEN}


def verify_knock(culm, report):
    report.title("Turbine at 12.1 rpm: peaks of its motion in time after a knock [Hz]")
    table = culm.table("modes/modes", TURBINE)
    modes = table.column("frequency [Hz]")
    report.holds("largest damping ratio without dampers", max(map(abs, table.column("damping ratio"))), 1e-9)
    for name, spectrum in knocked(culm).items():
        for mode in SEEN[name]:
            report.relative(f"mode {mode}, {name}", spectrum.peak(modes[mode - 1]), modes[mode - 1], 2e-3)


def verify(culm, report):
    verify_disk(culm, report)
    verify_resonance(culm, report)
    verify_standstill(culm, report)
    verify_blades(culm, report)
    verify_relaxing_blades(culm, report)
    verify_knock(culm, report)


def plot_disk(culm, axes):
    table = culm.table("diagram/campbell", DISK, [f"Analyses/diagram/Levels={{{', '.join(map(str, LEVELS))}}}"])
    speeds = np.array(LEVELS) * TOP_SPEED
    for i in range(1, 5):
        axes.plot(speeds, table.column(f"frequency {i} [Hz]"), label="culm" if i == 1 else None, color="C0")
    points = [(speed, f) for speed in speeds for f in disk(speed)]
    axes.plot(*zip(*points), "k.", label="closed form")
    axes.set(xlabel="speed [rad/s]", ylabel="frequency [Hz]", title="Disk on a shaft")
    axes.legend()


def plot_resonance(culm, axes):
    levels = np.linspace(0.2, 1.0, 41)
    found = [resonance(culm, float(level)) for level in levels]
    growth = [[-2 * math.pi * f * d / math.sqrt(1.0 - d * d) for f, d in row] for row in found]
    for i in range(5):
        axes.plot(levels * RESONANCE_SPEED, [sorted(row)[i] for row in growth], color="C0", label=None if i else "culm")
    points = [(level * RESONANCE_SPEED, v.real) for level in levels[::2] for v in coleman(level * RESONANCE_SPEED)]
    axes.plot(*zip(*points), "k.", label="Coleman")
    axes.axhline(0.0, color="0.5", lw=0.8)
    axes.set(xlabel="speed [rad/s]", ylabel="rate of growth [1/s]", title="Ground resonance")
    axes.legend()


def plot_turbine(culm, axes):
    table = culm.table("campbell/campbell", TURBINE)
    rpm = [RPM * level for level in table.column("level")]
    for i in range(1, 12):
        axes.plot(rpm, table.column(f"frequency {i} [Hz]"))
    for n in (1, 3, 6):
        axes.plot(rpm, [n * speed / 60.0 for speed in rpm], ":", color="0.5")
        axes.annotate(f"{n}P", (rpm[-1], n * rpm[-1] / 60.0), fontsize=8)
    spectra = knocked(culm)
    modes = turbine(culm)
    peaks = [spectra[name].peak(modes[mode - 1]) for name, seen in SEEN.items() for mode in seen]
    axes.plot([RPM] * len(peaks), peaks, "k.", label="peaks in time")
    axes.set(xlabel="speed [rpm]", ylabel="frequency [Hz]", title="NREL 5 MW, seen at rest", ylim=(0, 2.3))
    axes.legend(loc="upper left")


def plot(culm, path):
    fig, panels = figure(3)
    for draw, axes in zip((plot_disk, plot_resonance, plot_turbine), panels):
        draw(culm, axes)
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
