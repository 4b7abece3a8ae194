#!/usr/bin/python3
"""Blade element and momentum of the NREL 5 MW rotor written anew, in variants. Page: doc/verification/rotor.md."""

import dataclasses
import math

import numpy as np
from rotor import RIGID, SWEEP, mean, published
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq
from verify import INPUTS, main

HUB, TIP, BLADES, DENSITY, TILT, CONE = 1.5, 63.0, 3, 1.225, math.radians(5.0), math.radians(2.5)
# Stations of the blade by the public files, from its root: place [m], twist [deg], chord [m], airfoil.
STATIONS = [(0, 13.308, 3.542, 0), (1.3667, 13.308, 3.542, 0), (4.1, 13.308, 3.854, 0), (6.8333, 13.308, 4.167, 1),
            (10.25, 13.308, 4.557, 2), (14.35, 11.48, 4.652, 3), (18.45, 10.162, 4.458, 3), (22.55, 9.011, 4.249, 4),
            (26.65, 7.795, 4.007, 5), (30.75, 6.544, 3.748, 5), (34.85, 5.361, 3.502, 6), (38.95, 4.188, 3.256, 6),
            (43.05, 3.125, 3.01, 7), (47.15, 2.319, 2.764, 7), (51.25, 1.526, 2.518, 7), (54.6667, 0.863, 2.313, 7),
            (57.4, 0.37, 2.086, 7), (60.1333, 0.106, 1.419, 7), (61.5, 0.106, 1.419, 7)]
SPANS, TWISTS, CHORDS = (np.array([row[k] for row in STATIONS]) for k in range(3))
AIRFOILS = [row[3] for row in STATIONS]
POLARS = [np.loadtxt(INPUTS / f"turbine/nrel5mw/include/airfoils/{name}.csv", delimiter=",", comments="#")
          for name in ("cylinder1", "cylinder2", "du40_a17", "du35_a17", "du30_a17", "du25_a17", "du21_a17", "naca64_a17")]
SPLINES = [CubicSpline(polar[:, 0], polar[:, 1:]) for polar in POLARS]


@dataclasses.dataclass
class Kind:
    """What programs do differently; the default is what the deck asks of culm."""

    sums: str = "equal"  # 30 equal stations; "elements": the 17 of the report by their lengths; "trapezoids": to no load at the ends
    drag_induces: bool = True
    hub_loss: bool = True
    heavy: str = "Buhl"  # or Glauert's parabola, where momentum ends
    spline: bool = False  # polars by cubic splines
    moment: bool = True  # that of the airfoil turns a coned rotor as well
    three_quarters: bool = False  # where the angle of attack counts


def coefficients(kind, shares, alpha):
    """Lift, drag and moment of the airfoils that a station blends."""
    degrees = math.degrees(math.remainder(alpha, 2.0 * math.pi))

    def one(airfoil):
        if kind.spline:
            return SPLINES[airfoil](degrees)
        polar = POLARS[airfoil]
        return np.array([np.interp(degrees, polar[:, 0], polar[:, k]) for k in (1, 2, 3)])

    return sum(share * one(airfoil) for airfoil, share in shares if share > 0.0)


def stations(kind):
    """Place from the root [m], twist [rad], chord [m], airfoils with shares, length [m]."""
    if kind.sums == "equal":
        count = 30
        for s in (np.arange(count) + 0.5) / count * SPANS[-1]:
            k = int(np.searchsorted(SPANS, s)) - 1
            share = (s - SPANS[k]) / (SPANS[k + 1] - SPANS[k])
            yield (s, math.radians(np.interp(s, SPANS, TWISTS)), np.interp(s, SPANS, CHORDS),
                   [(AIRFOILS[k], 1.0 - share), (AIRFOILS[k + 1], share)], SPANS[-1] / count)
    else:
        edges = np.r_[HUB, [HUB + s for s in SPANS[1:-1]], TIP]
        for k in range(1, len(SPANS) - 1):
            length = 4.1 if 3 < k < 15 else 2.7333
            if kind.sums == "trapezoids":
                length = 0.5 * (edges[k + 1] - edges[k - 1])
            yield SPANS[k], math.radians(TWISTS[k]), CHORDS[k], [(AIRFOILS[k], 1.0)], length


def balance(kind, place, chord, shares, twist, axial, tangential, lever):
    """Angle of the inflow and inductions, by the sign of what momentum leaves (Ning's form). `lever` is the velocity by which
    the three-quarter chord moves towards the suction side [m/s]."""
    solidity = BLADES * chord / (2.0 * math.pi * place)
    speed = math.hypot(axial, tangential)

    def parts(phi):
        sine, cosine = math.sin(phi), math.cos(phi)
        lift, drag, _ = coefficients(kind, shares, phi - twist - lever / speed)
        drag *= kind.drag_induces
        loss = 2.0 / math.pi * math.acos(math.exp(-0.5 * BLADES * (TIP * math.cos(CONE) - place) / (place * sine)))
        if kind.hub_loss:
            root = HUB * math.cos(CONE)
            loss *= 2.0 / math.pi * math.acos(math.exp(-0.5 * BLADES * (place - root) / (root * sine)))
        loss = max(loss, 1e-4)
        kappa = solidity * (lift * cosine + drag * sine) / (4.0 * loss * sine**2)
        swirl = solidity * (lift * sine - drag * cosine) / (4.0 * loss * sine * cosine)
        return heavy(kind, kappa, loss), swirl

    def residual(phi):
        a, swirl = parts(phi)
        return math.sin(phi) / (1.0 - a) - axial / tangential * math.cos(phi) * (1.0 - swirl)

    grid = np.r_[1e-6, np.linspace(0.01, 1.55, 80)]
    signs = [residual(phi) for phi in grid]
    low = next(k for k in range(len(grid) - 1) if signs[k] < 0.0 <= signs[k + 1])
    phi = brentq(residual, grid[low], grid[low + 1], xtol=1e-13)
    a, swirl = parts(phi)
    return phi, a, swirl / (1.0 - swirl)


def heavy(kind, kappa, loss):
    """Axial induction; where momentum ends Buhl's parabola or Glauert's, of the thrust 4 F kappa (1 - a)^2."""
    if kappa <= 2.0 / 3.0:
        return kappa / (1.0 + kappa)
    if kind.heavy == "Glauert":
        return brentq(lambda a: 0.889 - (0.0203 - (a * loss - 0.143) ** 2) / 0.6427 - 4.0 * loss * kappa * (1.0 - a) ** 2,
                      0.0, 1.0)
    a, b, c = (50.0 / 9.0 - 4.0 * loss - 4.0 * loss * kappa, 4.0 * loss - 40.0 / 9.0 + 8.0 * loss * kappa,
               8.0 / 9.0 - 4.0 * loss * kappa)
    if abs(a) < 1e-9:
        return -c / b
    return (-b + math.sqrt(b * b - 4.0 * a * c)) / (2.0 * a)


def rotor(kind, wind, rpm, pitch, azimuths=8):
    """Thrust [kN] and torque [kN m] in a mean over azimuths."""
    omega, thrust, torque = rpm * math.pi / 30.0, 0.0, 0.0
    for azimuth in 2.0 * math.pi * np.arange(azimuths) / azimuths:
        upwards = wind * math.sin(TILT)
        axial = wind * math.cos(TILT) * math.cos(CONE) + upwards * math.cos(azimuth) * math.sin(CONE)
        for span, twist, chord, shares, length in stations(kind):
            place = (HUB + span) * math.cos(CONE)
            tangential = omega * place - upwards * math.sin(azimuth)
            lever = 0.5 * chord * omega * math.sin(CONE) * kind.three_quarters
            turn = twist + math.radians(pitch)
            phi, a, swirl = balance(kind, place, chord, shares, turn, axial, tangential, lever)
            square = (axial * (1.0 - a)) ** 2 + (tangential * (1.0 + swirl)) ** 2
            lift, drag, moment = coefficients(kind, shares, phi - turn - lever / math.sqrt(square))
            force = 0.5 * DENSITY * square * chord * length * BLADES / azimuths
            thrust += force * (lift * math.cos(phi) + drag * math.sin(phi)) * math.cos(CONE)
            torque += force * (lift * math.sin(phi) - drag * math.cos(phi)) * place
            torque -= force * chord * moment * math.sin(CONE) * kind.moment
    return thrust / 1e3, torque / 1e3


VARIANTS = {"as culm, angle at the quarter chord": {}, "angle at the three-quarter chord": {"three_quarters": True},
            "17 elements of the report": {"sums": "elements"}, "trapezoids between these, no load at the ends": {"sums": "trapezoids"},
            "drag does not induce": {"drag_induces": False}, "no loss at the hub": {"hub_loss": False},
            "Glauert's parabola": {"heavy": "Glauert"}, "polars by splines": {"spline": True},
            "without the moment of the airfoils": {"moment": False}}


def verify(culm, report):
    report.title("Rigid rotor, tilt 5, cone 2.5 degrees, angle of attack at the quarter chord: beside the same equations written anew")
    for wind, rpm, pitch, *_ in SWEEP:
        if wind not in (5, 11, 20):
            continue
        history = culm.history(RIGID, ["angle_at=0.25", f"V={wind}", f"W={rpm}", f"pitch={pitch}"])
        found = [mean(history, f"rotor {name}") / 1e3 for name in ("thrust [N]", "torque [N m]")]
        report.relative(f"{wind} m/s: thrust [kN], torque [kN m]", found, list(rotor(Kind(), wind, rpm, pitch)), 5e-4)


def fine(culm, report):
    report.title("Variants beside the report, in per cent: thrust (with the weight on the shaft that the tower turned), torque")
    for name, variant in VARIANTS.items():
        texts = []
        for row in SWEEP:
            thrust, torque = rotor(Kind(**variant), *row[:3], azimuths=4)
            straight, turned = published(row)
            texts.append(f"{100 * (thrust / straight - 1):+.1f} ({100 * (thrust / turned - 1):+.1f}), {100 * (torque / row[4] - 1):+.1f}")
        report.note(f"| {name} | " + " | ".join(texts) + " |")


if __name__ == "__main__":
    main(verify, fine=fine)
