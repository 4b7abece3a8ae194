#!/usr/bin/python3
"""Rotor in the wind: the rigid NREL 5 MW rotor, the turbine in a gust. Page: doc/verification/rotor.md."""

import math
import pathlib
import tempfile

import numpy as np
from scipy.integrate import trapezoid
from verify import INPUTS, figure, gain, main, richardson, save

RIGID = "turbine/nrel5mw/rotor.xml"
GUST = "turbine/nrel5mw/turbine_gust.xml"

# A prototype of the same balance: 8 m/s, 9.1552 rpm, without tilt and cone: station of 45, its twist [deg],
# angle of the inflow [deg], force normal to the rotor and against its motion [N/m].
STATIONS = [(7, 13.308, 26.5121, 718.82, 290.87), (16, 9.011, 14.3392, 1471.80, 360.64),
            (25, 5.361, 8.8811, 2561.27, 381.95), (34, 2.319, 6.5469, 3468.77, 377.22)]

# Jonkman et al., NREL/TP-500-38060 (2009): wind, rpm, pitch, thrust without weight along the shaft at 5 degrees [kN], torque
# [kN m]; and by how much the bent tower turns the shaft in culm's elastic turbine [mrad].
SWEEP = [(5, 7.506, 0, 174.9, 544.3, 1.58), (6, 7.942, 0, 236.3, 939.5, 2.33), (8, 9.156, 0, 384.0, 1956.9, 4.16),
         (10, 11.431, 0, 597.5, 3051.1, 6.74), (11, 11.890, 0, 696.6, 3881.3, 7.94),
         (12, 12.1, 3.823, 596.0, 4180.1, 6.63), (15, 12.1, 10.450, 426.5, 4180.1, 4.58),
         (20, 12.1, 17.473, 324.8, 4180.1, 3.39), (25, 12.1, 23.469, 275.3, 4180.1, 2.92)]
ROTOR_WEIGHT = 110e3 * 9.80665 / 1e3  # [kN]


def published(row):
    """Thrust of the air by the report [kN]: weight taken off along a shaft at 5 degrees, and along that which the tower turned."""
    return row[3], row[3] - ROTOR_WEIGHT * math.cos(math.radians(5.0)) * 1e-3 * row[5]


def mean(history, name):
    return float(np.mean(history.column(name)[1:]))


def station(culm, number, twist):
    """Angle of the inflow [deg], forces normal to the rotor and along its motion [N/m]."""
    history = culm.history(RIGID, ["V=8", "W=9.1552", "tilt=0", "cone=0", "stations=45", "turn=pi/90",
                                   f"Output/History/tip/Station={number}"])
    alpha, across, along = (history.column(f"tip {name}")[-1]
                            for name in ("alpha [rad]", "Fn [N/m]", "Ft [N/m]"))
    c, s = math.cos(math.radians(twist)), math.sin(math.radians(twist))
    return math.degrees(alpha) + twist, c * across + s * along, s * across - c * along


def sweep(culm, angle_at, rows=SWEEP):
    """Mean thrust [kN] and torque [kN m] by wind, with the angle of attack of a place on the chord."""
    found = []
    for wind, rpm, pitch, *_ in rows:
        history = culm.history(RIGID, [f"V={wind}", f"W={rpm}", f"pitch={pitch}", f"angle_at={angle_at}"])
        found.append((mean(history, "rotor thrust [N]") / 1e3, mean(history, "rotor torque [N m]") / 1e3))
    return found


MOTION = """    <ParameterList name="motion">
      <Parameter name="Type" value="Dynamic"/>
      <Parameter name="End Time" value="turn/W"/>
      <Parameter name="Step" value="step/W"/>
    </ParameterList>
"""
AT_REST = """    <ParameterList name="rest">
      <Parameter name="Type" value="Static"/>
      <Parameter name="Steps" value="1"/>
    </ParameterList>
"""
FRAME = """    <ParameterList name="rotation">
      <Parameter name="Type" value="Rotating Frame"/>
      <Parameter name="Structures" value="{hub, blade 1, blade 2, blade 3}"/>
      <Parameter name="Axis" value="{1, 0, 0}"/>
      <Parameter name="Speed" value="W"/>
    </ParameterList>
"""


def in_frame(culm, *overrides):
    """History of the rigid rotor at rest in a frame that turns with it."""
    path = INPUTS / RIGID
    text = path.read_text().replace('href="', f'href="{path.parent}/').replace(MOTION, AT_REST)
    loads = '    <xi:include href="' + f'{path.parent}/include/blade_air.xml"/>\n'
    with tempfile.TemporaryDirectory() as folder:
        deck = pathlib.Path(folder) / "frame.xml"
        deck.write_text(text.replace(loads, loads + FRAME))
        return culm.history(deck, ["tilt=0", "Functions/angle/Expression=0*t", *overrides])


def verify_frame(culm, report):
    report.title("The rigid rotor at rest in a frame that turns with it, beside its motion in space")
    for blades in ("cone=0", "cone=2.5*pi/180"):
        # steps of a motion turn by a chord
        small = [f"step={part}" for part in ("pi/90", "pi/180")]
        moving = [culm.history(RIGID, ["tilt=0", blades, "turn=pi/45", step]) for step in small]
        resting = in_frame(culm, blades)
        for name in ("thrust [N]", "torque [N m]", "a [1]"):
            limit = richardson(*(history.column(f"rotor {name}")[-1] for history in moving))
            report.relative(f"{blades}: {name}", resting.column(f"rotor {name}")[-1], limit, 1e-7)
    report.check("its speed [rad/s]", resting.column("rotor speed [rad/s]")[-1], 9.156 * math.pi / 30.0, 1e-12)


def gust(culm, induction, *overrides):
    return culm.history(GUST, [f"Loads/rotor/Induction={induction}", *overrides])


def peak(history):
    return 1e-3 * max(t for t, time in zip(history.column("rotor thrust [N]"), history.levels) if time > 10)


def faster(culm, induction):
    return culm.history(RIGID, ["tilt=0", "step=pi/60", "turn=22*W", f"Loads/rotor/Induction={induction}",
                                "Functions/angle/Expression=W*t + (t > 1 ? 0.1*W*(t - 1) : 0)"])


def response(time, induction, ratio=0.7):
    """Of the induced velocity at a share of the radius to a jump of what the balance asks for (Oye)."""
    slow = 1.1 / (1 - 1.3 * induction) * 63 / 8
    fast = (0.39 - 0.26 * ratio**2) * slow
    part = 0.4 * slow / (slow - fast)
    return 1 - part * math.exp(-time / slow) - (1 - part) * math.exp(-time / fast)


def at_power(culm, wind, pitch, wanted):
    """Pitch [deg] and thrust [kN] at which the torque at 12.1 rpm is as wanted [kN m], by secants."""

    def run(angle):
        history = culm.history(RIGID, [f"V={wind}", "W=12.1", f"pitch={angle!r}"])
        return mean(history, "rotor thrust [N]") / 1e3, mean(history, "rotor torque [N m]") / 1e3

    before, (_, off) = pitch - 0.3, run(pitch - 0.3)
    off -= wanted
    for _ in range(6):
        thrust, torque = run(pitch)
        if abs(torque - wanted) < 1e-4 * wanted:
            break
        before, pitch, off = pitch, pitch - (torque - wanted) * (pitch - before) / (torque - wanted - off), torque - wanted
    return pitch, thrust


def verify_power(culm, report):
    report.title("Rigid rotor above rated wind at the torque of the report, where the pitch makes it: thrust [kN]")
    for wind, _, pitch, wanted_thrust, wanted_torque, _ in SWEEP:
        if wind < 11.5:
            continue
        found, thrust = at_power(culm, wind, pitch, wanted_torque)
        report.relative(f"{wind} m/s, pitch {found:.2f} instead of {pitch:.2f} deg", thrust, wanted_thrust, 0.03)


def verify_sweep(culm, report):
    """The report's program takes the angle at the quarter chord, and its thrust is that along the shaft."""
    report.title("Rigid rotor by wind, tilt 5, cone 2.5 degrees, angle of attack at the quarter chord; thrust [kN], torque [kN m]")
    for row, (thrust, torque) in zip(SWEEP, sweep(culm, 0.25)):
        wind, (straight, turned), wanted_torque = row[0], published(row), row[4]
        if wind == 25:  # where half a degree of pitch is 13 % of the torque
            report.note(f"25 m/s: thrust {thrust:.1f} ({100 * (thrust / straight - 1):+.1f} %), "
                        f"torque {torque:.1f} ({100 * (torque / wanted_torque - 1):+.1f} %)")
            continue
        allowed = 0.015 if wind < 11.5 else 0.03
        # at 20 m/s the weight on the shaft that the tower turned counts, 1.1 % of the thrust
        report.relative(f"{wind} m/s: thrust", thrust, turned if wind == 20 else straight, allowed)
        report.relative(f"{wind} m/s: torque", torque, wanted_torque, allowed)
    report.title("The same with the angle at the three-quarter chord, beside the report and its weight on the turned shaft")
    below = [row for row in SWEEP if row[0] < 11.5]
    for row, (thrust, torque) in zip(below, sweep(culm, 0.75, below)):
        report.relative(f"{row[0]} m/s: thrust", thrust, published(row)[1], 0.015)
        report.relative(f"{row[0]} m/s: torque", torque, row[4], 0.015)


def verify_pitched(culm, report):
    report.title("The same above rated wind")
    above = [row for row in SWEEP if row[0] > 11.5]
    for row, (thrust, torque) in zip(above, sweep(culm, 0.75, above)):
        straight, turned = published(row)
        report.note(f"{row[0]} m/s: thrust {thrust:.1f} ({100 * (thrust / straight - 1):+.1f} %, "
                    f"{100 * (thrust / turned - 1):+.1f} %), torque {torque:.1f} ({100 * (torque / row[4] - 1):+.1f} %)")


def elastic_gust(culm, report, induction):
    report.title("Extreme operating gust on the whole elastic turbine, at constant speed: largest thrust [kN]")
    run = culm.run(GUST, [f"Loads/rotor/Induction={induction}", "start=6", "end=14"], quiet=False)
    report.note(f"{induction}: {peak(run.history):.1f}")
    return run


def fine(culm, report):
    verify_pitched(culm, report)
    for induction in ("Frozen", "Dynamic"):
        elastic_gust(culm, report, induction)


def verify(culm, report):
    report.title("Stations of the rigid rotor: balance, induced velocity and load of the strip")
    for number, twist, phi, normal, along in STATIONS:
        found = station(culm, number, twist)
        report.relative(f"station {number}: angle [deg], forces [N/m]", found, [phi, normal, along], 1e-4)
    verify_sweep(culm, report)
    verify_power(culm, report)
    verify_frame(culm, report)
    report.title("Wakes in a wind along the axis, which does not change: with and without lags")
    steady, lagging = (culm.history(RIGID, ["tilt=0", "turn=pi/18", f"Loads/rotor/Induction={induction}"])
                       for induction in ("Steady", "Dynamic"))
    report.relative("thrust [N]", lagging.column("rotor thrust [N]")[-1],
                    steady.column("rotor thrust [N]")[-1], 1e-9)
    report.title("The rotor turns 10 % faster from 1 s on: share of the wake that followed, by the thrust")
    frozen, lagging, steady = (faster(culm, induction) for induction in ("Frozen", "Dynamic", "Steady"))
    thrust = "rotor thrust [N]"
    for time in (1.0, 2.0, 5.0, 10.0, 20.0):
        row = int(np.argmin(np.abs(np.array(steady.levels) - 1.0 - time)))
        start, now, end = (history.column(thrust)[row] for history in (frozen, lagging, steady))
        wanted = response(steady.levels[row] - 1.0, steady.column("rotor a [1]")[row])
        # the rotor has all radii, and its thrust is not linear in what is induced
        report.check(f"{time:g} s later", (start - now) / (start - end), wanted, 0.05)
    run = elastic_gust(culm, report, "Steady")
    report.title("The same: what the air gave, what the generator, a prescribed angle, took [J]")
    books = run.books()
    air = books["work of loads, air"]
    report.check("the air does all work of loads", air, books["work of loads"], 0.0)
    power = np.array(run.history.column("rotor torque [N m]")) * np.array(run.history.column("rotor speed [rad/s]"))
    # the rotor's torque turns all of it but what bends, and the start lies before the first row
    report.relative("air, by the torque of the rotor", air, float(trapezoid(power[1:], run.history.levels[1:])), 0.03)
    report.holds("gain less air, drives and dampers as printed, of what the air gave", abs(gain(books)) / air, 1e-7)


def plot(culm, path):
    fig, axes = figure()
    axes = np.atleast_1d(axes)[0]
    for induction in ("Frozen", "Steady", "Dynamic"):
        history = gust(culm, induction)
        times = np.array(history.levels)
        axes.plot(times[times > 15], 1e-3 * np.array(history.column("rotor thrust [N]"))[times > 15],
                  label=induction)
    axes.set(title="Gust on the NREL 5 MW turbine", xlabel="time [s]", ylabel="thrust [kN]")
    axes.legend()
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot, fine)
