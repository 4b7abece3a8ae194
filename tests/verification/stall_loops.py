#!/usr/bin/python3
"""Loops of dynamic stall and of lag beside an integration of their equations. Page: doc/verification/strips.md."""

import math
import pathlib
import tempfile
import xml.etree.ElementTree as tree

import numpy as np
from rotor_cases import array, element
from scipy.integrate import solve_ivp
from verify import main

DENSITY, SPEED, CHORD, AXIS_AT = 1.225, 40.0, 1.5, 0.3
MEAN, AMPLITUDE, OMEGA = math.radians(12.0), math.radians(6.0), 2.0 * SPEED * 0.08 / CHORD  # k = 0.08
PERIODS = 1.2
# An airfoil that stalls at 12 degrees.
ANGLES = np.radians([-180, -90, -40, -20, -12, -6, 0, 6, 10, 12, 14, 16, 18, 20, 25, 30, 40, 90, 180.0])
LIFT = np.array([0, -0.1, -0.9, -0.8, -1.0, -0.45, 0.2, 0.85, 1.2, 1.3, 1.25, 1.15, 1.05, 1.0, 0.95, 0.95, 0.95, 0.05, 0])
DRAG = np.array([0.02, 1.3, 0.6, 0.2, 0.03, 0.01, 0.008, 0.01, 0.015, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 1.3, 0.02])
MOMENT = np.array([0, 0.3, 0.1, 0.05, 0, -0.05, -0.06, -0.06, -0.06, -0.06, -0.07, -0.08, -0.09, -0.1, -0.12, -0.15, -0.2, -0.35, 0])
LAGS = {"Oye": ((), ()), "Four States": ((0.3, 0.7), (0.14, 0.53)), "Airfoil": ((0.3, 0.7), (0.14, 0.53)),
        "Jones": ((0.165, 0.335), (0.0455, 0.3))}


def lift(angle):
    return float(np.interp(angle, ANGLES, LIFT))


def find_separation():
    """Angle of no lift, steepest line from it, and the first angles on both sides at which nothing is attached."""
    k = next(k for k in range(1, len(ANGLES)) if LIFT[k - 1] <= 0.0 < LIFT[k] and abs(ANGLES[k]) < math.pi / 6)
    zero = ANGLES[k - 1] - LIFT[k - 1] * (ANGLES[k] - ANGLES[k - 1]) / (LIFT[k] - LIFT[k - 1])
    slope = max(c / (a - zero) for a, c in zip(ANGLES, LIFT) if 1e-12 < abs(a - zero) <= math.pi / 6)
    gone = [a for a, c in zip(ANGLES, LIFT) if c / (slope * (a - zero)) <= 0.25]
    return zero, slope, max(a for a in gone if a < zero), min(a for a in gone if a > zero)


ZERO, SLOPE, FIRST, LAST = find_separation()


def attached(angle):
    """Share of the chord by Kirchhoff, in a steady flow."""
    potential = SLOPE * (angle - ZERO)
    if abs(potential) < 1e-9:
        return 1.0
    quotient = lift(angle) / potential
    if quotient <= 0.25 or not FIRST < angle < LAST:
        return 0.0
    return min(1.0, (2.0 * math.sqrt(quotient) - 1.0) ** 2)


def separated(angle):
    """Lift when nothing is attached."""
    share = attached(angle)
    if share >= 1.0 - 1e-12:
        return 0.5 * lift(angle)
    if share == 0.0:
        return lift(angle)
    root = math.sqrt(share)
    return SLOPE * (angle - ZERO) * (1.0 + 3.0 * root) / (4.0 * (1.0 + root))


class Section:
    """A section in a wind along x that is turned nose up by MEAN and swings about its axis."""

    def __init__(self, lag):
        self.lag, (self.amplitudes, self.rates) = lag, LAGS[lag]

    def swing(self, time):
        """Angle nose up, its rate and acceleration."""
        return (MEAN + AMPLITUDE * math.sin(OMEGA * time), AMPLITUDE * OMEGA * math.cos(OMEGA * time),
                -AMPLITUDE * OMEGA**2 * math.sin(OMEGA * time))

    def wind(self, time, place):
        """Along and across the chord at a place on it, relative."""
        angle, rate, _ = self.swing(time)
        return SPEED * math.cos(angle), SPEED * math.sin(angle) + (place - AXIS_AT) * CHORD * rate

    def effective(self, time, states):
        along, across = self.wind(time, 0.75)
        behind = across * (1.0 - sum(self.amplitudes)) + sum(states[: len(self.amplitudes)])
        return math.atan2(across, along), math.atan2(behind, along), math.hypot(along, across)

    def change(self, time, states):
        angle, behind, speed = self.effective(time, states)
        across, late = self.wind(time, 0.75)[1], 0.5 * CHORD / speed
        lags = [b / late * (a * across - x) for a, b, x in zip(self.amplitudes, self.rates, states)]
        if self.lag == "Oye":
            return [(attached(angle) - states[0]) / (6.0 * late)]
        if self.lag != "Four States":
            return lags
        pressure, share = states[2:]
        built = SLOPE * (behind - ZERO) + math.pi * late * self.swing(time)[1]
        return [*lags, (built - pressure) / (1.7 * late), (attached(pressure / SLOPE + ZERO) - share) / (3.0 * late)]

    def coefficients(self, time, states):
        angle, behind, speed = self.effective(time, states)
        rate, late = self.swing(time)[1], 0.5 * CHORD / speed
        if self.lag == "Oye":
            share = states[0]
            return (share * SLOPE * (angle - ZERO) + (1.0 - share) * separated(angle), np.interp(angle, ANGLES, DRAG),
                    np.interp(angle, ANGLES, MOMENT))
        drag, moment = np.interp(behind, ANGLES, DRAG), np.interp(behind, ANGLES, MOMENT)
        if self.lag != "Four States":
            return lift(behind), drag + (angle - behind) * lift(behind), moment
        share, steady = states[3], attached(behind)
        circulatory = share * SLOPE * (behind - ZERO) + (1.0 - share) * separated(behind)
        gone = 0.5 * (math.sqrt(steady) - math.sqrt(max(share, 0.0))) - 0.25 * (steady - share)
        return (circulatory + math.pi * late * rate,
                drag + (angle - behind + late * rate) * circulatory + (drag - np.interp(ZERO, ANGLES, DRAG)) * gone,
                moment - 0.5 * math.pi * late * rate)

    def load(self, time, states):
        """Force along x and y, moment about z at the axis; the suction side is towards y."""
        c_lift, c_drag, c_moment = self.coefficients(time, states)
        along, across = np.array(self.wind(time, 0.25)) / math.hypot(*self.wind(time, 0.25))
        speed = math.hypot(*self.wind(time, 0.75))
        pressure = 0.5 * DENSITY * speed**2 * CHORD
        normal, chordwise = (pressure * (c_lift * along + c_drag * across), pressure * (c_drag * along - c_lift * across))
        nose_up = pressure * CHORD * c_moment + normal * (AXIS_AT - 0.25) * CHORD
        angle, rate, acceleration = self.swing(time)
        if self.lag == "Jones":  # with the apparent mass
            half = 0.5 * CHORD
            mass, arm = math.pi * DENSITY * half**2, (0.5 - AXIS_AT) * CHORD
            at_middle, at_back = mass * arm * acceleration, mass * speed * rate
            normal += at_middle + at_back
            nose_up -= at_middle * arm + at_back * (0.75 - AXIS_AT) * CHORD + mass * half**2 / 8.0 * acceleration
        tail, suction = np.array([math.cos(angle), -math.sin(angle)]), np.array([math.sin(angle), math.cos(angle)])
        return np.r_[chordwise * tail + normal * suction, -nose_up]

    def loop(self, times):
        """From a flow that is attached and has no lag yet."""
        start = {"Oye": [1.0], "Four States": [0.0, 0.0, 0.0, 1.0]}.get(self.lag, [0.0, 0.0])
        states = solve_ivp(self.change, (0.0, times[-1]), start, rtol=1e-8, atol=1e-10, max_step=5e-3, dense_output=True).sol
        return np.array([self.load(time, states(time)) for time in times])

    def deck(self, step, steps):
        strip = {"Type": "Strip", "Node": "body", "Length": 1, "Flow": "air", "Chord": CHORD, "Axis At": AXIS_AT, "Twist": MEAN,
                 "Airfoil": "stalling", "Lag": self.lag, "Apparent Mass": str(self.lag == "Jones").lower()}
        return {
            "Title": "Section that swings",
            "Structures": {"body": {"Type": "Rigid Body", "Position": "{0, 0, 0}", "Mass": 10, "Inertia": "{1, 1, 1}"}},
            "Functions": {"swing": {"Type": "Expression", "Expression": f"{AMPLITUDE!r}*sin({OMEGA!r}*t)"}},
            "Flows": {"air": {"Type": "Uniform", "Density": DENSITY, "Velocity": array((SPEED, 0, 0))}},
            "Airfoils": {"stalling": {"Type": "Polar", "Angles": array(ANGLES), "Lift": array(LIFT), "Drag": array(DRAG),
                                      "Moment": array(MOMENT)}},
            "Loads": {"air": strip},
            "Constraints": {"axis": {"Type": "Rigid Support", "Node": "body", "Axis": "{0, 0, -1}", "Angle": 1,
                                     "Angle Function": "swing"}},
            "Analyses": {"motion": {"Type": "Dynamic", "End Time": steps * step, "Step": step}},
            "Output": {"History": {"air": {"Type": "Fluid Force", "Load": "air"}}},
        }

    def run(self, culm, step):
        steps = round(PERIODS * 2.0 * math.pi / OMEGA / step)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "swing.xml"
            path.write_bytes(tree.tostring(element("culm", self.deck(step, steps))))
            history = culm.history(path)
        columns = [np.array(history.column(f"air {name}")[1:]) for name in ("Fx [N]", "Fy [N]", "Mz [N m]")]
        return np.array(history.levels[1:]) - 0.5 * step, np.array(columns).T


def verify(culm, report):
    report.title("Swings of 6 degrees about 12 at k = 0.08: forces and moment beside the equations by Runge-Kutta, of the largest")
    for lag in LAGS:
        section, errors = Section(lag), []
        for step in (0.02, 0.01):
            times, found = section.run(culm, step)
            late = times > 0.3  # the first steps resolve no sudden start
            wanted = section.loop(times)[late]
            errors.append(np.abs((found[late] - wanted) / np.abs(wanted).max(axis=0)).max())
        report.holds(f"{lag}: steps of 20 ms {errors[0]:.1e}, of 10 ms", errors[1], 4e-3)
        report.holds(f"{lag}: of second order, the half step leaves", errors[1] / errors[0], 0.32)


if __name__ == "__main__":
    main(verify)
