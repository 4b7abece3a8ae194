#!/usr/bin/python3
"""Flutter and divergence by eigenvalues with the lag of strips. Page: doc/verification/strips.md."""

import math
import pathlib
import tempfile

import numpy as np
from verify import INPUTS, figure, main, save

PARKED = "turbine/nrel5mw/turbine_parked.xml"
# Jones' states; divergence is exact
SECTION = (25.379599, 16.695289, 36.084392)  # m/s, rad/s, m/s
GOLAND = (137.335, 69.346, 252.28)
DECKS = (("Typical section", "air/flutter.xml", SECTION, 2e-6),
         ("Goland's wing, 8 elements, 24 stations", "air/goland_flutter.xml", GOLAND, 1e-3))


def section_eigenvalues(speed, lag=True):
    """Of the typical section with Jones' states or without, from its equations: plunge, pitch, their rates, two states."""
    rho, b, a = 1.225, 0.5, -0.2
    m = 20.0 * math.pi * rho * b**2
    mass = np.array([[m, 0.2 * m * b], [0.2 * m * b, 0.25 * m * b**2]])
    stiffness = np.diag([m * 10.0**2, 0.25 * m * b**2 * 25.0**2])
    air = math.pi * rho * b**2
    mass += air * np.array([[1.0, -b * a], [-b * a, b**2 * (1.0 / 8.0 + a**2)]])
    damping = air * speed * np.array([[0.0, 1.0], [0.0, b * (0.5 - a)]])
    # circulation: plunge down and pitch nose up; w = U alpha + h' + b (1/2 - a) alpha'
    lift = 2.0 * math.pi * rho * speed * b
    pull = np.array([1.0, -b * (0.5 + a)])
    by_place, by_speed = np.array([0.0, speed]), np.array([1.0, b * (0.5 - a)])
    amplitude, rate = np.array([0.165, 0.335]) * lag, np.array([0.0455, 0.3]) * speed / b
    left = 1.0 - amplitude.sum()
    stiffness = stiffness + lift * left * np.outer(pull, by_place)
    damping = damping + lift * left * np.outer(pull, by_speed)
    system = np.zeros((6, 6))
    system[:2, 2:4] = np.eye(2)
    inverse = np.linalg.inv(mass)
    system[2:4, :2] = -inverse @ stiffness
    system[2:4, 2:4] = -inverse @ damping
    system[2:4, 4:] = -inverse @ (lift * np.outer(pull, np.ones(2)))
    for i in range(2):
        system[4 + i, :2] = rate[i] * amplitude[i] * by_place
        system[4 + i, 2:4] = rate[i] * amplitude[i] * by_speed
        system[4 + i, 4 + i] = -rate[i]
    return np.linalg.eigvals(system)


def verify(culm, report):
    for title, deck, (speed, omega, divergence), tolerance in DECKS:
        report.title(title)
        onset = culm.table("flutter/onset", deck)
        report.relative("speed of flutter [m/s]", onset.at(1, "level"), speed, tolerance)
        report.relative("frequency [rad/s]", 2.0 * math.pi * onset.at(1, "frequency [Hz]"), omega, tolerance)
        report.relative("speed of divergence [m/s]", onset.at(2, "level"), divergence, tolerance)
    report.title("Typical section below flutter and above, against its equations with six states")
    table = culm.table("flutter/flutter", "air/flutter.xml")
    for row, speed in enumerate(table.column("level"), 1):
        exact = sorted((s for s in section_eigenvalues(speed) if s.imag > 1e-6), key=abs)
        below = speed < SECTION[0]  # above, the mode that grows
        for mode, s in enumerate(exact, 1) if below else [(2, max(exact, key=lambda s: s.real))]:
            what = f"mode {mode} at {speed:g} m/s"
            report.relative(f"{what}: frequency [Hz]", table.at(row, f"frequency {mode} [Hz]"),
                            s.imag / (2.0 * math.pi), 1e-6)
            report.relative(f"{what}: damping", table.at(row, f"damping ratio {mode}"), -s.real / abs(s), 1e-6)
    report.title("The same without lag, in 5 m/s: it flutters in any wind")
    quick = culm.table("flutter/flutter", "air/flutter.xml", ["Loads/air on the section/Lag=None"])
    row = table.column("level").index(5.0) + 1
    pairs = [(quick.at(row, f"damping ratio {mode}"), quick.at(row, f"frequency {mode} [Hz]")) for mode in (1, 2)]
    damping, frequency = min(pairs)
    growth = -damping * 2.0 * math.pi * frequency / math.sqrt(1.0 - damping**2)
    exact = max(section_eigenvalues(5.0, lag=False), key=lambda s: s.real)
    report.relative("growth [1/s]", growth, exact.real, 1e-5)
    report.check("growth of the table [1/s]", growth, 0.05, 0.005)
    verify_hale(culm, report)
    verify_parked(culm, report)


HALE = ["c=1", "Sections/wing/EI1=2e4", "Sections/wing/EI2=4e6", "Sections/wing/GIp=1e4", "Sections/wing/rhoA=0.75",
        "Sections/wing/rhoI2=0.1", "Sections/wing/rhoS2=0", "Structures/wing/Curve/To={0, 16, 0}",
        "Loads/air on the wing/Axis At=0.5", "Flows/air/Density=0.0889", "Analyses/flutter/Levels={10, 20, 30, 36, 40}"]


def verify_hale(culm, report):
    report.title("Patil's wing of high aspect ratio, straight: (pi / 2 L)^2 GJ / (2 pi e c)")
    pressure = (math.pi / 32.0) ** 2 * 1e4 / (2.0 * math.pi * 0.25)
    onset = culm.table("flutter/onset", "air/goland_flutter.xml", HALE)
    report.relative("speed of divergence [m/s]", onset.at(2, "level"), math.sqrt(2.0 * pressure / 0.0889), 1e-3)


SWEEP = """    <ParameterList name="flutter">
      <Parameter name="Type" value="Flutter"/>
      <Parameter name="Levels" value="{10, 20, 30, 40, 50}"/>
      <Parameter name="Modes" value="10"/>
    </ParameterList>
"""
AT_ONCE = """    <ParameterList name="storm">
      <Parameter name="Type" value="Static"/>
      <Parameter name="Steps" value="4"/>
    </ParameterList>
    <ParameterList name="modes">
      <Parameter name="Type" value="Modal"/>
      <Parameter name="Modes" value="10"/>
      <Parameter name="Damping" value="true"/>
    </ParameterList>
"""


def least_damped(table, row, modes):
    """Frequency [Hz] and damping ratio of the mode of a row that is damped least."""
    found = [(table.at(row, f"damping ratio {i}"), table.at(row, f"frequency {i} [Hz]")) for i in range(1, modes + 1)]
    return min(found)[::-1]


def verify_parked(culm, report):
    report.title("Parked NREL 5 MW turbine in a storm from 60 degrees: the sweep against equilibrium and modes in one wind")
    sweep = culm.table("flutter/flutter", PARKED)
    onset = culm.table("flutter/onset", PARKED)
    speed = onset.at(1, "level")
    report.note(f"grows from {speed:.3f} m/s on, with {onset.at(1, 'frequency [Hz]'):.4f} Hz")
    path = INPUTS / PARKED
    with tempfile.TemporaryDirectory() as folder:
        deck = pathlib.Path(folder) / "parked.xml"
        text = path.read_text().replace(SWEEP, AT_ONCE).replace('href="', f'href="{path.parent}/')
        deck.write_text(text)
        for level, row in ((30, 3), (50, 5)):
            table = culm.table("modes/modes", deck, [f"Functions/speed/Expression={level}"])
            dampings, frequencies = table.column("damping ratio"), table.column("frequency [Hz]")
            least = dampings.index(min(dampings))
            frequency, damping = least_damped(sweep, row, 10)
            report.relative(f"{level} m/s: frequency of the mode damped least [Hz]", frequency, frequencies[least], 1e-6)
            report.check("its damping ratio", damping, dampings[least], 1e-7)
        for side, wanted in ((0.999 * speed, 1.0), (1.001 * speed, -1.0)):
            table = culm.table("modes/modes", deck, [f"Functions/speed/Expression={side}"])
            least = min(table.column("damping ratio"))
            report.check(f"sign of the least damping at {side:.3f} m/s ({least:.1e})", math.copysign(1.0, least), wanted, 0.0)


def plot(culm, path):
    fig, axes = figure(2)
    table = culm.table("flutter/flutter", "air/goland_flutter.xml")
    levels = table.column("level")
    for i in range(1, 3):
        axes[0].plot(levels, table.column(f"frequency {i} [Hz]"), ".-", label=f"mode {i}")
        axes[1].plot(levels, [100.0 * d for d in table.column(f"damping ratio {i}")], ".-")
    axes[1].axhline(0.0, color="0.5", linewidth=0.8)
    axes[1].axvline(GOLAND[0], color="0.5", linestyle=":")
    axes[1].set(ylim=(-30, 60), xlabel="wind [m/s]", ylabel="damping [%]")
    axes[0].set(xlabel="wind [m/s]", ylabel="frequency [Hz]")
    axes[0].legend()
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
