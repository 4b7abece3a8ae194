#!/usr/bin/python3
"""Flutter and divergence by eigenvalues with the lag of strips. Page: doc/verification/strips.md."""

import io
import math
import pathlib
import tempfile

import numpy as np
from scipy.io import mmread
from verify import INPUTS, figure, main, save

PARKED = "turbine/nrel5mw/turbine_parked.xml"
MATRICES = """  <ParameterList name="Analyses">
    <ParameterList name="rest">
      <Parameter name="Type" value="Static"/>
      <Parameter name="Steps" value="1"/>
    </ParameterList>
    <ParameterList name="matrices">
      <Parameter name="Type" value="Matrices"/>
    </ParameterList>
  </ParameterList>
"""
# Jones' states; divergence is exact
SECTION = (25.379599, 16.695289, 36.084392)  # m/s, rad/s, m/s
GOLAND = (137.335, 69.346, 252.27796)
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


def swept_divergence(sweep, count=60):
    """Speed at which Goland's wing, swept by an angle, diverges [m/s]: cubic beam, linear twist, strips across the axis."""
    bending, torsion, length, chord, arm = 9.77e6, 0.987e6, 6.096, 1.8288, 0.08
    h, size = length / count, 3 * count + 3  # deflection, slope and twist of each node
    K, A = np.zeros((size, size)), np.zeros((size, size))
    cubic = bending / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                                       [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
    for k in range(count):
        bent, twisted = [3 * k, 3 * k + 1, 3 * k + 3, 3 * k + 4], [3 * k + 2, 3 * k + 5]
        K[np.ix_(bent, bent)] += cubic
        K[np.ix_(twisted, twisted)] += torsion / h * np.array([[1, -1], [-1, 1]])
        for point, weight in zip(*np.polynomial.legendre.leggauss(3)):
            s = 0.5 * (point + 1.0)
            up, slope, twist = np.zeros(size), np.zeros(size), np.zeros(size)
            up[bent] = [1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, h * (s**3 - s**2)]
            slope[bent] = [6 * (s**2 - s) / h, 1 - 4 * s + 3 * s**2, 6 * (s - s**2) / h, 3 * s**2 - 2 * s]
            twist[twisted] = [1 - s, s]
            force = 0.5 * h * weight * 2.0 * math.pi * chord
            A += force * np.outer(up + arm * chord * twist, twist - math.tan(sweep) * slope)
    quotients = np.linalg.eigvals(np.linalg.solve(K[3:, 3:], A[3:, 3:]))
    largest = max(q.real for q in quotients if abs(q.imag) < 1e-6 * abs(q))
    return math.sqrt(2.0 / (1.225 * largest)) / math.cos(sweep)


def verify_sweep(culm, report):
    report.title("Divergence of Goland's wing swept forwards and a little aft, beside a beam of 60 elements [m/s]")
    text = (INPUTS / "air/goland_flutter.xml").read_text()
    for degrees in (-30.0, -20.0, -10.0, 1.5):
        sweep = math.radians(degrees)
        c, s = math.cos(sweep), math.sin(sweep)
        swept = text.replace('value="{0, 6.096, 0}"', f'value="{{{6.096 * s!r}, {6.096 * c!r}, 0}}"')
        swept = swept.replace('"Up" value="{1, 0, 0}"', f'"Up" value="{{{c!r}, {-s!r}, 0}}"')
        with tempfile.TemporaryDirectory() as folder:
            deck = pathlib.Path(folder) / "swept.xml"
            deck.write_text(swept)
            onset = culm.table("flutter/onset", deck, ["Analyses/flutter/Levels={100, 170, 190, 220, 270}"])
        report.relative(f"{degrees:g} degrees", onset.at(2, "level"), swept_divergence(sweep), 2e-4)


def verify_matrices(culm, report, speed=20.0):
    report.title("Matrices of the typical section, with its lag: the stiffness at its eigenvalues is singular")
    text = (INPUTS / "air/flutter.xml").read_text()
    begin = text.index('  <ParameterList name="Analyses">')
    end = text.index("\n  </ParameterList>\n", begin) + len("\n  </ParameterList>\n")
    with tempfile.TemporaryDirectory() as folder:
        deck = pathlib.Path(folder) / "matrices.xml"
        deck.write_text(text[:begin] + MATRICES + text[end:])
        run = culm.run(deck, [f"Functions/speed/Expression={speed}"], quiet=False)
    read = {name: mmread(io.StringIO(matrix)).toarray() for name, matrix in run.matrices.items()}
    times = [float(line.split()[-2]) for line in run.output.splitlines() if ": relaxation time" in line]
    report.check("lags", len(times), 2, 0)
    for value in section_eigenvalues(speed):
        if value.imag <= 0.0:
            continue
        total = read["stiffness"] + value * read["damping"] + value**2 * read["mass"]
        for k, time in enumerate(times, 1):
            total = total + value * time / (1.0 + value * time) * (
                read[f"relaxation_{k}"] + value * read[f"relaxation_{k}_damping"])
        sizes = np.linalg.svd(total, compute_uv=False)
        report.holds(f"at {value:.5g} 1/s: least over next singular value", sizes[-1] / sizes[-2], 1e-6)


def verify(culm, report):
    for title, deck, (speed, omega, divergence), tolerance in DECKS:
        report.title(title)
        onset = culm.table("flutter/onset", deck)
        report.relative("speed of flutter [m/s]", onset.at(1, "level"), speed, tolerance)
        report.relative("frequency [rad/s]", 2.0 * math.pi * onset.at(1, "frequency [Hz]"), omega, tolerance)
        report.relative("speed of divergence [m/s]", onset.at(2, "level"), divergence, tolerance)
    verify_sweep(culm, report)
    verify_matrices(culm, report)
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
