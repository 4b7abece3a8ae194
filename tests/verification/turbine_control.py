#!/usr/bin/python3
"""The NREL 5 MW turbine at variable speed in winds. Page: doc/verification/turbine_control.md."""

import math

import numpy as np
from scipy.integrate import trapezoid
from verify import figure, gain, main, save

STEP = "turbine/nrel5mw/turbine_step.xml"
STOP = "turbine/nrel5mw/turbine_stop.xml"
TURBULENCE = "turbine/nrel5mw/turbine_turbulence.xml"
RPM, DEG = math.pi / 30.0, math.pi / 180.0
RATED_POWER, RATED_SPEED = 5.29661e6, 12.1

# Jonkman et al., NREL/TP-500-38060 (2009), by wind: rpm and pitch [deg] of the steady turbine, thrust without weight [kN],
# power of the rotor [MW], where the report has them; the pitch also of its table 7-1.
PUBLISHED = {5: (7.506, 0.0, 174.9, 0.4279), 6: (7.942, 0.0, 236.3, 0.7813), 8: (9.156, 0.0, 384.0, 1.8762),
             10: (11.431, 0.0, 597.5, 3.6530), 11: (11.890, 0.0, 696.6, 4.8332), 12: (12.1, 3.823, 596.0, 5.2966),
             13: (12.1, 6.60, None, 5.2966), 14: (12.1, 8.70, None, 5.2966), 15: (12.1, 10.450, 426.5, 5.2966),
             16: (12.1, 12.06, None, 5.2966), 17: (12.1, 13.54, None, 5.2966), 18: (12.1, 14.92, None, 5.2966),
             19: (12.1, 16.23, None, 5.2966), 20: (12.1, 17.473, 324.8, 5.2967), 21: (12.1, 18.70, None, 5.2966),
             22: (12.1, 19.94, None, 5.2966), 23: (12.1, 21.18, None, 5.2966), 24: (12.1, 22.35, None, 5.2966),
             25: (12.1, 23.469, 275.3, 5.2967)}
STARTS = sorted((wind, rpm, pitch) for wind, (rpm, pitch, *_) in PUBLISHED.items())


def torque_of(rpm):
    """Of the generator in region 2 and beyond, at its own shaft [N m]."""
    speed = 97.0 * rpm
    return np.interp(speed, [670.0, 871.0], [0.0, 19403.0]) if speed < 871 else min(0.0255764 * speed**2, 43093.55)


def start(wind):
    """Settings of the steady step deck that begin near its operating point."""
    winds, rpms, pitches = zip((3.0, 6.97, 0.0), (4.0, 7.18, 0.0), *STARTS)
    rpm, pitch = np.interp(wind, winds, rpms), np.interp(wind, winds, pitches)
    return [f"V={wind}", f"V2={wind}", f"W={rpm}", f"pitch={pitch}*deg", f"torque={torque_of(rpm)}*N"]


def steady(culm, wind, end, window):
    """Means over the last seconds: rpm, pitch [deg], thrust [kN], power [MW], bending of blade and tower [m]; and how far the
    speed moves in them [rpm]."""
    history = culm.history(STEP, [*start(wind), f"end={end}"])
    late = np.array(history.levels) > end - window
    values = [np.array(history.column(name))[late] for name in (
        "rotor speed [rad/s]", "pitch [1]", "rotor thrust [N]", "rotor power [W]", "blade 1 deflection uz [m]",
        "tower top ux [m]")]
    means = [float(value.mean()) for value in values]
    scales = (1 / RPM, 1 / DEG, 1e-3, 1e-6, 1.0, 1.0)
    return [mean * scale for mean, scale in zip(means, scales)], float(np.ptp(values[0])) / RPM


def sweep(culm, winds, end=80.0, window=25.0):
    return {wind: steady(culm, wind, end, window) for wind in winds}


def print_row(report, wind, found, moved):
    published = PUBLISHED.get(wind, (None, None, None, None))
    texts = [f"{value:.{digits}f}" + (f" ({wanted:.{digits}f})" if wanted is not None else "")
             for value, digits, wanted in zip(found, (3, 2, 1, 4, 2, 3), (*published, None, None))]
    report.note(f"| {wind} | " + " | ".join(texts) + f" | {moved:.3f} |")


def verify_steady(culm, report):
    report.title("Steady winds, whole elastic turbine: beside the report of the reference turbine")
    for wind, (found, moved) in sweep(culm, (8, 15), 25.0, 7.0).items():
        print_row(report, wind, found, moved)
        rpm, pitch, thrust, power = PUBLISHED[wind]
        report.relative("speed [rpm]", found[0], rpm, 0.01)
        report.check("pitch [deg]", found[1], pitch, 0.2)
        report.relative("thrust [kN]", found[2], thrust, 0.02)
        report.relative("power [MW]", found[3], power, 0.02)


def verify_step(culm, report):
    report.title("The wind steps from 13 to 14 m/s")
    run = culm.run(STEP, quiet=False)
    history = run.history
    times = np.array(history.levels)
    speed = np.array(history.column("rotor speed [rad/s]")) / RPM
    pitch = np.array(history.column("pitch [1]")) / DEG
    report.note(f"largest speed {speed[times > 15].max():.3f} rpm, largest pitch {pitch[times > 15].max():.2f} deg")
    report.holds("speed 15 s later, off the rated one [rpm]", abs(speed[-1] - RATED_SPEED), 0.05)
    report.check("pitch of 14 m/s [deg]", pitch[times > 35].mean(), 8.70, 0.3)
    report.holds("overshoot of the speed, of the rated one", speed[times > 15].max() / RATED_SPEED - 1.0, 0.06)
    report.holds("energy balance", run.drift("energy balance"), 1e-10)


def verify_stop(culm, report):
    report.title("Emergency stop at 15 m/s")
    run = culm.run(STOP, quiet=False)
    history = run.history
    times = np.array(history.levels)
    speed = np.array(history.column("rotor speed [rad/s]")) / RPM
    pitch = np.array(history.column("pitch [1]")) / DEG
    rate = np.diff(pitch) / np.diff(times)
    report.holds("rate of the pitch beyond 8 deg/s", rate.max() - 8.0, 1e-9)
    report.check("pitch at the end [deg]", pitch[-1], 90.0, 1e-3)
    report.note(f"largest speed {speed[1:].max():.2f} rpm at {times[1:][speed[1:].argmax()]:.2f} s, "
                f"{speed[-1]:.2f} rpm at the end; least thrust {min(history.column('rotor thrust [N]')[1:]) / 1e3:.0f} kN")
    report.holds("speed at the end, of the rated one", speed[-1] / RATED_SPEED, 0.15)
    torque = np.array(history.column("counter torque [1]"))
    report.holds("counter-torque behind the loss", max(torque[times > 10.02]), 0.0)
    books = run.books()
    report.title("The same: what the air gave, what the generator took [J]")
    given, taken = (books[f"work of loads, {account}"] for account in ("air", "generator"))
    # the generator is stiff with the rotor up to the twist of the shaft
    power = torque * np.array(history.column("rotor speed [rad/s]"))
    report.relative("generator", -taken, float(trapezoid(power[1:], times[1:])), 2e-3)
    report.holds("gain less air, generator, drives and dampers as printed, of what the air gave",
                 abs(gain(books)) / given, 1e-7)
    report.holds("energy balance", run.drift("energy balance"), 1e-10)


def verify(culm, report):
    verify_steady(culm, report)
    verify_step(culm, report)
    verify_stop(culm, report)


def fine(culm, report):
    report.title("The whole range; in brackets the report: rpm, pitch, thrust, power, tip, tower top, speed moves by")
    for wind in range(3, 26):
        found, moved = steady(culm, wind, 80.0, 25.0)
        print_row(report, wind, found, moved)


def plot(culm, path):
    fig, axes = figure(3)
    for ax, deck, title in zip(axes, (STEP, STOP, TURBULENCE), ("13 to 14 m/s", "stop at 15 m/s", "turbulence, 12 m/s")):
        history = culm.history(deck)
        times = np.array(history.levels)
        late = times > 5.0
        for label, name, scale in (("speed [rpm]", "rotor speed [rad/s]", 1 / RPM), ("pitch [deg]", "pitch [1]", 1 / DEG),
                                   ("power [MW]", "rotor power [W]", 1e-6), ("thrust [100 kN]", "rotor thrust [N]", 1e-5)):
            ax.plot(times[late], np.array(history.column(name))[late] * scale, label=label)
        ax.set(title=title, xlabel="time [s]")
        ax.legend()
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot, fine)
