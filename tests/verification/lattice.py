#!/usr/bin/python3
"""Vortex lattice: steady wings, a wing that rests, flutter in time. Page: doc/verification/lattice.md."""

import functools
import math
import pathlib
import tempfile

import numpy as np
from verify import INPUTS, figure, main, poles, richardson, save

CHORD = 1.8288
BY_EIGENVALUES = "air/lattice_flutter.xml"
WHOLE = "Loads/flow about the wing/Tangent=Whole"  # fewer iterations, and residuals at round-off
# lattice in the frequency domain with a flat wake of 12 chords, the tip inset, 8 x 12 panels
FLUTTER = {8: 161.67, 16: 160.65, 24: 160.27}


def oscillation(culm, speed, overrides=(), periods=8.0):
    """Growth [1/s] and circular frequency [rad/s] of the mode that flutters."""
    history = culm.history("air/goland.xml", [f"U={speed}", "Analyses/motion/End Time="
                                              f"{0.02 + periods * 0.09}", WHOLE, *overrides])
    times = np.array(history.levels)
    values = np.array(history.column("tip uz [m]"))
    free = times > 0.06  # after the pulse and what decays at once
    found = [p for p in poles(times[free], values[free]) if 55.0 < p.imag < 85.0]
    best = max(found, key=lambda p: p.real)
    return best.real, best.imag


def flutter(culm, low, high, overrides=()):
    """Speed and frequency at which the growth is zero, linear between two speeds 1 m/s apart: over
    9 m/s that is 0.1 % off."""
    (g0, w0), (g1, w1) = (oscillation(culm, u, overrides) for u in (low, high))
    share = -g0 / (g1 - g0)
    return low + share * (high - low), w0 + share * (w1 - w0)


@functools.cache
def by_eigenvalues(culm):
    """Speeds of flutter and of divergence."""
    return culm.table("sweep/onset", BY_EIGENVALUES)


def verify_flutter(culm, report):
    report.title("Goland's wing: flutter in time, 8 x 12 panels, wake of 12 chords")
    speed, omega = flutter(culm, 161.0, 162.0)
    report.relative("speed of flutter [m/s]", speed, FLUTTER[8], 0.005)
    report.relative("frequency [rad/s]", omega, 68.8, 0.01)
    report.title("The same by eigenvalues, whose wake has no end, against time and against 3 + 3 modes")
    onset = by_eigenvalues(culm)
    report.relative("speed of flutter [m/s]", onset.at(1, "level"), speed, 2e-4)
    report.relative("the same [m/s]", onset.at(1, "level"), FLUTTER[8], 1e-3)
    report.relative("frequency [rad/s]", 2.0 * math.pi * onset.at(1, "frequency [Hz]"), omega, 1.5e-3)


def verify_growth(culm, report):
    report.title("Growth and frequency on both sides, in time and by eigenvalues")
    text = (INPUTS / BY_EIGENVALUES).read_text().replace(SWEEP, MODES)
    with tempfile.TemporaryDirectory() as folder:
        deck = pathlib.Path(folder) / "modes.xml"
        deck.write_text(text)
        for speed in (150.0, 170.0):
            growth, omega = oscillation(culm, speed)
            table = culm.table("modes/modes", deck, [f"Functions/speed/Expression={speed}"])
            row = min(range(1, 4), key=lambda i: table.at(i, "damping ratio"))
            report.check(f"{speed:g} m/s: growth [1/s]", table.at(row, "eigenvalue real [1/s]"), growth, 0.05)
            report.relative("frequency [rad/s]", table.at(row, "eigenvalue imaginary [1/s]"), omega, 1.5e-3)


MOTION = """    <ParameterList name="motion">
      <Parameter name="Type" value="Dynamic"/>
"""
FROM_EQUILIBRIUM = """    <ParameterList name="equilibrium">
      <Parameter name="Type" value="Static"/>
      <Parameter name="Inactive" value="{push}"/>
    </ParameterList>
    <ParameterList name="motion">
      <Parameter name="Type" value="Dynamic"/>
      <Parameter name="Start Time" value="0"/>
"""


def verify_incidence(culm, report):
    report.title("The same at 155 m/s with incidence: what moved rings induce by the circulation at rest is not in the eigenvalues")
    in_time = (INPUTS / "air/goland.xml").read_text().replace(MOTION, FROM_EQUILIBRIUM)
    modes = (INPUTS / BY_EIGENVALUES).read_text().replace(SWEEP, MODES)
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("time", in_time), ("modes", modes)):
            pathlib.Path(folder, f"{name}.xml").write_text(text)
        for degrees, of_growth, of_frequency in ((0.0, 0.01, 1.5e-3), (2.0, 0.02, 2e-3), (5.0, 0.12, 4e-3)):
            angle = math.radians(degrees)
            wind = f"Flows/air/Velocity={{U*{math.cos(angle)}, 0, U*{math.sin(angle)}}}"
            history = culm.history(pathlib.Path(folder, "time.xml"), [
                wind, "U=155", "Loads/push/Force={0, 0, 1e4}", "Analyses/motion/End Time=0.74", WHOLE])
            levels = np.array(history.levels)
            begin = int(np.argmin(np.diff(levels))) + 1  # of the motion, whose time starts anew
            times, values = levels[begin:], np.array(history.column("tip uz [m]"))[begin:]
            free = times > 0.06
            found = [p for p in poles(times[free], values[free] - values[-1], 10) if 55.0 < p.imag < 85.0]
            best = max(found, key=lambda p: p.real)
            table = culm.table("modes/modes", pathlib.Path(folder, "modes.xml"),
                               [f"angle={angle}", "Functions/speed/Expression=155"])
            row = min(range(1, 4), key=lambda i: table.at(i, "damping ratio"))
            report.check(f"{degrees:g} degrees: growth [1/s]", table.at(row, "eigenvalue real [1/s]"), best.real, of_growth)
            report.relative("frequency [rad/s]", table.at(row, "eigenvalue imaginary [1/s]"), best.imag, of_frequency)


def verify_panels(culm, report):
    report.title("Flutter by eigenvalues with more panels, against 3 + 3 modes; density 1.225, then 1.02")
    for density, references in ((1.225, {16: 160.65, 24: 160.27}), (1.02, {8: 173.57, 16: 172.59, 24: 172.23})):
        for m, reference in references.items():
            onset = culm.table("sweep/onset", BY_EIGENVALUES,
                               [f"m={m}", f"Flows/air/Density={density}", "Analyses/sweep/Levels={150, 180}"])
            report.relative(f"density {density}, {m} x 12: speed [m/s]", onset.at(1, "level"), reference, 1e-3)


def verify_rest(culm, report):
    report.title("A wing in equilibrium goes on resting when time begins")
    history = culm.history("air/wing_at_rest.xml")
    uz = history.column("tip uz [m]")
    at_rest = next(i for i, level in enumerate(history.levels) if level >= 1.0)
    report.relative("deflection of the tip in time [m]", uz[-1], uz[at_rest], 1e-3)


def verify_steady(culm, report):
    report.title("Rectangular wings, 8 x 26 panels with the tip inset")
    for aspect, slope in ((4.0, 3.6108), (8.0, 4.5843), (20.0, 5.4296)):
        history = culm.history("air/rigid_wing.xml", [f"ratio={aspect}"])
        lift = history.column("wing CL [1]")[-1]
        report.relative(f"aspect ratio {aspect:g}: lift slope [1/rad]",
                        history.column("wing Fz [N]")[-1]
                        / (0.5 * 1.225 * 10.0**2 * 0.5 * aspect * math.radians(1.0)), slope, 5e-4)
        # the ellipse has the least, a rectangle by lifting lines 1 to 12 % more
        excess = history.column("wing CD [1]")[-1] / (lift**2 / (math.pi * aspect)) - 1.0
        report.check(f"aspect ratio {aspect:g}: induced drag above the least", excess, 0.06, 0.06)
        drag, lift = (history.column(f"wing {c} [N]")[-1] for c in ("Fx", "Fz"))
        report.check("reaction and force of the air [N]",
                     [history.column(f"wall {c} [N]")[-1] for c in ("Fx", "Fz")], [-drag, -lift],
                     1e-12 * lift)


def verify_shell(culm, report):
    report.title("The same lattice on a stiff shell, whose mesh it does not match, and on a rigid beam")
    # what bends, 1e-3, falls with the stiffness: two of them give the rigid shell but for its square
    soft, stiff = (culm.history("air/plate_wing.xml", [f"E={E}", "steps=1"]) for E in (1e12, 2e12))
    beam = culm.history("air/rigid_wing.xml", ["ratio=6", "m=4", "n=10", "U=40", "angle=3*pi/180"])
    static = next(i for i, level in enumerate(stiff.levels) if level >= 1.0)
    for component in ("Fx [N]", "Fz [N]", "Mx [N m]"):
        rigid = richardson(*(shell.column(f"air {component}")[static] for shell in (soft, stiff)),
                           order=1)
        report.relative(component, rigid, beam.column(f"wing {component}")[-1], 5e-5)


SWEEP = """    <ParameterList name="sweep">
      <Parameter name="Type" value="Flutter"/>
      <Parameter name="Levels" value="{60, 110, 150, 180, 220, 260, 300, 340}"/>
      <Parameter name="Modes" value="3"/>
    </ParameterList>
"""
AT_ONCE = """    <ParameterList name="twist">
      <Parameter name="Type" value="Static"/>
      <Parameter name="Steps" value="1"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Output">
    <ParameterList name="History">
      <ParameterList name="wing">
        <Parameter name="Type" value="Displacement"/>
        <Parameter name="Node" value="wing/last"/>
      </ParameterList>
    </ParameterList>
"""

MODES = """    <ParameterList name="steady">
      <Parameter name="Type" value="Static"/>
      <Parameter name="Steps" value="1"/>
    </ParameterList>
    <ParameterList name="modes">
      <Parameter name="Type" value="Modal"/>
      <Parameter name="Modes" value="3"/>
      <Parameter name="Damping" value="true"/>
    </ParameterList>
"""


def verify_divergence(culm, report):
    report.title("Divergence of Goland's wing by its lattice, and statics on both sides of it at 1e-7 rad")
    speed = by_eigenvalues(culm).at(2, "level")
    report.note(f"diverges at {speed:.4f} m/s")
    text = (INPUTS / BY_EIGENVALUES).read_text().replace(SWEEP, AT_ONCE)
    with tempfile.TemporaryDirectory() as folder:
        deck = pathlib.Path(folder) / "twist.xml"
        deck.write_text(text)
        for share, sign in ((0.999, 1.0), (1.001, -1.0)):
            history = culm.history(deck, ["angle=1e-7", f"Functions/speed/Expression={share * speed!r}"])
            uz = history.column("wing uz [m]")[-1]
            report.check(f"{share} of it: sign of the deflection ({uz:.2e} m)", math.copysign(1.0, uz), sign, 0.0)


def verify_tangents(culm, report):
    report.title("Iterations per step of Goland's wing at 150 m/s, 20 steps, by density and tangent")
    for density, most in ((1.225, 6.0), (10.0, 8.0), (20.0, 10.0)):
        steps = [f"Flows/air/Density={density}", "U=150", "Analyses/motion/End Time=20*c/(m*150)"]
        whole = culm.run("air/goland.xml", [*steps, WHOLE], quiet=False)
        mean = whole.iterations() / 20
        report.holds(f"density {density:g}: {mean:.2f} with the whole tangent; cut back", whole.cut_back(), 0)
        report.holds(f"density {density:g}: iterations", mean, most)


def verify(culm, report):
    verify_divergence(culm, report)
    verify_tangents(culm, report)
    verify_steady(culm, report)
    verify_shell(culm, report)
    verify_rest(culm, report)
    verify_flutter(culm, report)
    verify_growth(culm, report)


def fine(culm, report):
    verify_panels(culm, report)
    verify_incidence(culm, report)
    report.title("Goland's wing: the same with more panels along the chord")
    for m, low in ((16, 160.0), (24, 159.6)):
        speed, _ = flutter(culm, low, low + 1.0, [f"m={m}"])
        report.relative(f"{m} x 12: speed of flutter [m/s]", speed, FLUTTER[m], 0.01)


def plot(culm, path):
    fig, axes = figure()
    axes = np.atleast_1d(axes)[0]
    for speed in (150.0, 161.0, 170.0):
        history = culm.history("air/goland.xml", [f"U={speed}", "Analyses/motion/End Time=0.75"])
        axes.plot(history.levels, [1e3 * u for u in history.column("tip uz [m]")],
                  label=f"{speed:g} m/s")
    axes.set(title="Goland's wing", xlabel="time [s]", ylabel="deflection of the tip [mm]")
    axes.legend()
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot, fine)
