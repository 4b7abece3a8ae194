#!/usr/bin/python3
"""Modes with the states of dynamic stall, against differences of the equations in time. Page: doc/verification/strips.md."""

import math

import numpy as np
from scipy.optimize import brentq, fsolve
from verify import INPUTS, figure, main, save

DECK = "air/stall_modes.xml"
MODELS = ("Oye", "Four States")
RHO, CHORD, AXIS, MASS = 1.225, 1.0, 0.33, 20.0
ANGLE = math.radians(22.4)
TABLE = np.loadtxt(INPUTS / "turbine/nrel5mw/include/airfoils/naca64_a17.csv", delimiter=",", comments="#")
ALPHA = np.radians(TABLE[:, 0])


def steady(alpha):
    """Lift, drag and moment of the polar."""
    return [np.interp(alpha, ALPHA, TABLE[:, k]) for k in (1, 2, 3)]


def separation():
    """Angle of no lift, and the steepest line from there to the lift within 30 degrees."""
    lift = TABLE[:, 1]
    zeros = [a - u * (b - a) / (v - u) for a, b, u, v in zip(ALPHA, ALPHA[1:], lift, lift[1:]) if u <= 0 < v]
    zero = min(zeros, key=abs)
    near = np.abs(ALPHA - zero) < math.pi / 6
    return zero, np.max(lift[near] / (ALPHA[near] - zero))


ZERO, SLOPE = separation()


def attached(alpha):
    """Kirchhoff's share of the chord in a steady flow."""
    root = 2.0 * math.sqrt(max(0.0, steady(alpha)[0] / (SLOPE * (alpha - ZERO)))) - 1.0
    return min(1.0, max(0.0, root))**2


def detached(alpha):
    """Lift of the flow that has left."""
    share = attached(alpha)
    return (steady(alpha)[0] - SLOPE * (alpha - ZERO) * share) / (1.0 - share)


def rates(y, speed, model):
    """Of x, y, pitch nose up, their rates and the states of stall."""
    (place, motion), states = y[:6].reshape(2, 3), y[6:]
    pitch, turning = place[2], motion[2]
    c = np.array([math.cos(pitch), -math.sin(pitch)])
    n = np.array([math.sin(pitch), math.cos(pitch)])

    def wind(at):
        w = speed * np.array([math.cos(ANGLE), math.sin(ANGLE)]) - motion[:2] + (at - AXIS) * CHORD * turning * n
        return w @ c, w @ n

    along, across = wind(0.75)
    V = math.hypot(along, across)
    alpha = math.atan2(across, along)
    half = CHORD / (2.0 * V)
    if model == "Oye":
        share, = states
        by_state = [(attached(alpha) - share) / (6.0 * half)]
        lift = share * SLOPE * (alpha - ZERO) + (1.0 - share) * detached(alpha)
        _, drag, moment = steady(alpha)
    else:
        amplitude, rate = np.array([0.3, 0.7]), np.array([0.14, 0.53]) / half
        lag, pressure, share = states[:2], states[2], states[3]
        effective = math.atan2(lag.sum(), along)  # the amplitudes sum up to one
        potential = SLOPE * (effective - ZERO)
        by_state = [*(rate * (amplitude * across - lag)),
                    (potential + math.pi * half * turning - pressure) / (1.7 * half),
                    (attached(pressure / SLOPE + ZERO) - share) / (3.0 * half)]
        circulatory = share * potential + (1.0 - share) * detached(effective)
        _, drag, moment = steady(effective)
        here = attached(effective)
        missing = 0.5 * (math.sqrt(here) - math.sqrt(share)) - 0.25 * (here - share)
        drag += (alpha - effective + half * turning) * circulatory + (drag - steady(ZERO)[1]) * missing
        lift = circulatory + math.pi * half * turning
        moment -= 0.5 * math.pi * half * turning
    wc, wn = np.array(wind(0.25)) / math.hypot(*wind(0.25))
    pressure = 0.5 * RHO * CHORD * V**2
    normal, tangential = pressure * (lift * wc + drag * wn), pressure * (drag * wc - lift * wn)
    force = np.zeros(3)
    force[:2] = tangential * c + normal * n - [1280.0 * place[0] + 1.6 * motion[0], 320.0 * place[1]]
    force[2] = (AXIS - 0.25) * CHORD * normal + pressure * CHORD * moment - 320.0 * 1.25**2 * math.sin(pitch) * math.cos(pitch)
    arm = 0.1  # of the centre of mass behind the axis
    mass = np.array([[MASS, 0.0, -MASS * arm * n[0]], [0.0, MASS, -MASS * arm * n[1]],
                     [-MASS * arm * n[0], -MASS * arm * n[1], 1.0 + MASS * arm**2]])
    force[:2] += MASS * arm * turning**2 * c
    return np.concatenate([motion, np.linalg.solve(mass, force), by_state])


def eigenvalues(speed, model):
    """Of the three oscillations, by central differences about the equilibrium."""
    across, along = speed * math.sin(ANGLE), speed * math.cos(ANGLE)
    start = np.zeros(7 if model == "Oye" else 10)
    start[6:] = attached(ANGLE) if model == "Oye" else (0.3 * across, 0.7 * across, SLOPE * (ANGLE - ZERO), attached(ANGLE))
    y, _, found, text = fsolve(rates, start, (speed, model), xtol=1e-13, full_output=True)
    if found != 1 and np.abs(rates(y, speed, model)).max() > 1e-9:
        raise RuntimeError(text)
    h = np.diag(1e-6 * np.maximum(1.0, np.abs(y)))
    columns = [(rates(y + e, speed, model) - rates(y - e, speed, model)) / (2 * e.sum()) for e in h]
    # the lag has motions of its own, which are damped by more than half of the critical value
    return sorted((s for s in np.linalg.eigvals(np.array(columns).T) if s.imag > -s.real * math.sqrt(3)), key=abs)


def growth(speed, model):
    """The largest rate over its size, less what counts as none in a sweep."""
    return max(s.real / abs(s) for s in eigenvalues(speed, model)) - 1e-6


def chosen(model):
    return [f"Loads/air on the section/Lag={model}"]


def verify(culm, report):
    for model in MODELS:
        report.title(f"{model}: modes of a stalled section, against differences of its equations in time")
        table = culm.table("flutter/flutter", DECK, chosen(model))
        for row, speed in enumerate(table.column("level"), 1):
            exact = eigenvalues(speed, model)
            modes = range(1, len(exact) + 1)
            report.relative(f"{speed:g} m/s: frequencies [Hz]", [table.at(row, f"frequency {k} [Hz]") for k in modes],
                            [s.imag / (2.0 * math.pi) for s in exact], 1e-8)
            report.check("damping ratios", [table.at(row, f"damping ratio {k}") for k in modes],
                         [-s.real / abs(s) for s in exact], 1e-8)
        onset = culm.table("flutter/onset", DECK, chosen(model))
        wanted = brentq(growth, 2.0, 16.0, (model,), xtol=1e-10)
        report.relative("grows from [m/s]", onset.at(1, "level"), wanted, 1e-5)
        report.relative("frequency [Hz]", onset.at(1, "frequency [Hz]"),
                        max(eigenvalues(wanted, model), key=lambda s: s.real).imag / (2.0 * math.pi), 1e-5)
    report.title("Separation that follows at once: the motion across the chord grows in all winds of the deck")
    at_once = culm.table("flutter/flutter", DECK, chosen("None"))
    late = culm.table("flutter/flutter", DECK, chosen("Oye"))
    for row in (1, 5):
        dampings = [table.at(row, "damping ratio 1") for table in (at_once, late)]
        what = f"{at_once.column('level')[row - 1]:g} m/s: signs of damping, at once {dampings[0]:.4f} and late {dampings[1]:.4f}"
        report.check(what, [math.copysign(1.0, d) for d in dampings], [-1.0, 1.0], 0.0)


def plot(culm, path):
    fig, axes = figure(2)
    for model, style in (*zip(MODELS, ("-", "--")), ("None", ":")):
        table = culm.table("flutter/flutter", DECK, chosen(model))
        levels = table.column("level")
        for axis, (mode, what) in zip(axes, ((1, "across the chord"), (2, "along the chord"))):
            axis.plot(levels, [100.0 * d for d in table.column(f"damping ratio {mode}")], style, label=model)
            axis.set(title=what, ylabel="damping [%]")
            axis.axhline(0.0, color="0.5", linewidth=0.8)
    axes[0].legend()
    axes[1].set(xlabel="wind [m/s]")
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
