#!/usr/bin/python3
"""Rigid rotors of many kinds beside blade element and momentum written anew. Page: doc/verification/rotor.md."""

import math
import pathlib
import tempfile
import xml.etree.ElementTree as tree

import numpy as np
from scipy.optimize import brentq
from verify import main

RADIUS, ROOT, CHORD, DENSITY, STATIONS, STEPS = 40.0, 2.0, 2.0, 1.225, 12, 40
X = np.array([1.0, 0.0, 0.0])
ANGLES = np.radians(np.r_[-180:-30:5, -30:30:1, 30:181:5].astype(float))
LIFT, DRAG, MOMENT = 1.6 * np.sin(2 * ANGLES), 0.01 + 1.3 * np.sin(ANGLES) ** 2, -0.1 * np.sin(ANGLES)


def coefficients(angle):
    return (float(np.interp(angle, ANGLES, values)) for values in (LIFT, DRAG, MOMENT))


class Rotor:
    """About x through the origin; `sense` is that of its rotation, a positive pitch turns the noses into a wind along x."""

    def __init__(self, wind=(9.0, 0.0, 0.0), blades=3, sense=1, rpm=12.0, pitch=5.0, cone=0.0, induction="Steady",
                 losses=("Tip", "Hub"), drag_induces=True, axis=(1, 0, 0), hub="hub", named=None, yaw="None", moving=(0.0, 0.0, 0.0)):
        self.wind, self.blades, self.sense, self.pitch, self.cone = np.array(wind), blades, sense, math.radians(pitch), cone
        self.induction, self.losses, self.drag_induces, self.axis = induction, losses, drag_induces, axis
        self.hub, self.named, self.yaw, self.moving = hub, named, yaw, np.array(moving)
        self.mean_induction = 0.0
        self.omega = sense * rpm * math.pi / 30.0
        self.step = 2.0 * math.pi / 3.0 / abs(self.omega) / STEPS

    def directors(self, blade):
        """Along the span, and downwind across it, at the start."""
        azimuth = 2.0 * math.pi * blade / self.blades
        outwards = np.array([0.0, -math.sin(azimuth), math.cos(azimuth)])
        c, s = math.cos(self.cone), math.sin(self.cone)
        return c * outwards - s * X, c * X + s * outwards

    # --- the deck

    def deck(self):
        blades = [f"blade {k + 1}" for k in range(self.blades)]
        spin = {"Velocity": array(self.moving), "Angular Velocity": array((self.omega, 0, 0)), "About": "{0, 0, 0}"}
        body = {"Type": "Rigid Body", "Position": "{0, 0, 0}", "Mass": 5e4, "Inertia": "{1e6, 1e6, 1e6}"}
        structures, air, joints = {"nacelle": body, "hub": body}, {}, {}
        speeds = {"hub": {"Type": "Velocity", "Node": "hub", **spin},
                  "nacelle": {"Type": "Velocity", "Node": "nacelle", "Velocity": array(self.moving)}}
        for k, name in enumerate(blades):
            span, up = self.directors(k)
            line = {"Type": "Line", "From": array(ROOT * span), "To": array(RADIUS * span), "Up": array(up), "Elements": 6}
            structures[name] = {"Type": "Beam", "Section": "rigid", "Fidelity": "Rigid", "Curve": line}
            air[f"air on {name}"] = {
                "Type": "Strip", "Structure": name, "Flow": "wind", "Chord": CHORD, "Nose": array((0, -self.sense)), "Suction": "{1, 0}",
                "Twist": -self.pitch, "Airfoil": "section", "Lag": "None", "Apparent Mass": "false", "Stations": STATIONS}
            joints[name] = {"Type": "Rigid Connection", "Node": f"{name}/first", "Master": "hub"}
            speeds[name] = {"Type": "Velocity", "Node": name, **spin}
        rotor = {"Type": "Rotor", "Hub": self.hub, "Axis": array(self.axis), "Yaw": self.yaw,
                 "Blades": "{" + ", ".join(list(air)[:self.named]) + "}",
                 "Induction": self.induction, "Losses": "{" + ", ".join(self.losses) + "}",
                 "Drag Induces": str(self.drag_induces).lower()}
        turning = {"First": "nacelle", "Second": "hub", "Axis": "{1, 0, 0}"}
        stiff = {"EA": 1e10, "GA1": 1e9, "GA2": 1e9, "EI1": 1e10, "EI2": 1e10, "GIp": 1e10, "rhoA": 288, "rhoI1": 100, "rhoI2": 100}
        return {
            "Title": "Rotor",
            "Sections": {"rigid": {"Type": "Stiffness Values", **stiff}},
            "Functions": {"angle": {"Type": "Expression", "Expression": f"{self.omega!r}*t"},
                          "time": {"Type": "Expression", "Expression": "t"}},
            "Structures": structures,
            "Flows": {"wind": {"Type": "Uniform", "Density": DENSITY, "Velocity": array(self.wind + self.moving)}},
            "Airfoils": {"section": {"Type": "Polar", "Angles": array(ANGLES), "Lift": array(LIFT), "Drag": array(DRAG),
                                     "Moment": array(MOMENT)}},
            "Loads": {**air, "rotor": rotor},
            "Constraints": {"nacelle": {"Type": "Rigid Support", "Node": "nacelle", "Translation": array(self.moving),
                                        "Function": "time"},
                            "bearing": {"Type": "Revolute Joint", **turning},
                            "speed": {"Type": "Joint Angle", **turning, "Angle": 1, "Function": "angle"}, **joints},
            "Initial Conditions": speeds,
            "Analyses": {"motion": {"Type": "Dynamic", "End Time": STEPS * self.step, "Step": self.step}},
            "Output": {"History": {"rotor": {"Type": "Rotor", "Load": "rotor"},
                                   **{name: {"Type": "Fluid Force", "Load": name} for name in air}}},
        }

    def run(self, culm):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rotor.xml"
            path.write_bytes(tree.tostring(element("culm", self.deck())))
            return culm.run(path, quiet=False)

    # --- the same by hand

    def loads(self, azimuth):
        """Force and moment about the centre of all blades at a turn from the start."""
        c, s = math.cos(azimuth), math.sin(azimuth)
        turn = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
        width = (RADIUS - ROOT) / STATIONS
        total, self.inductions = np.zeros(6), []
        for blade in range(self.blades):
            span, up = (turn @ vector for vector in self.directors(blade))
            behind = self.sense * np.cross(span, up)
            tail = math.cos(self.pitch) * behind + math.sin(self.pitch) * up
            suction = math.cos(self.pitch) * up - math.sin(self.pitch) * behind
            for i in range(STATIONS):
                place = (ROOT + (i + 0.5) * width) * span
                force, moment = self.section(place, span, tail, suction)
                total += width * np.r_[force, np.cross(place, force) + moment]
        return total

    def skew(self, place, ratio):
        """Factor on the axial induction by Pitt and Peters, with the mean induction of the rotor."""
        sideways = self.wind - (self.wind @ X) * X
        size = np.linalg.norm(sideways)
        if self.yaw == "None" or size == 0.0:
            return 1.0
        half = 0.5 * (1.0 + 0.6 * self.mean_induction) * math.atan2(size, abs(self.wind @ X))
        outwards = np.array([0.0, *place[1:]]) / math.hypot(*place[1:])
        return 1.0 + 15.0 * math.pi / 32.0 * ratio * min(math.tan(half), 1.0) * (outwards @ sideways) / size

    def find_mean_induction(self):
        """Over the stations, by the areas of their annuli."""
        self.loads(0.0)
        radii, inductions = np.array(self.inductions).T
        self.mean_induction = float(radii @ inductions / radii.sum())

    def section(self, place, span, tail, suction):
        """Force and moment per length at a quarter chord. The angle of attack is that of the three-quarter chord."""
        relative = self.wind - self.omega * np.cross(X, place)
        lever = self.omega * np.cross(X, 0.5 * CHORD * tail)

        def at(wind):
            there = wind - lever
            angle = math.atan2(there @ suction, there @ tail)
            return (*coefficients(angle), (there @ suction) ** 2 + (there @ tail) ** 2)

        if self.induction != "None":
            relative = self.slowed(relative, place, span, at)
        lift, drag, moment, square = at(relative)
        along, across = relative @ tail, relative @ suction
        size = math.hypot(along, across)
        pressure = 0.5 * DENSITY * square * CHORD
        force = pressure / size * ((drag * along - lift * across) * tail + (lift * along + drag * across) * suction)
        return force, pressure * CHORD * moment * np.cross(suction, tail)

    def slowed(self, relative, place, span, at):
        """The wind with what is induced, by Ning's residual and Buhl's parabola."""
        normal = X - (X @ span) * span
        normal /= np.linalg.norm(normal)
        motion = math.copysign(1.0, self.omega) * np.cross(X, place)
        against = motion - (motion @ span) * span - (motion @ normal) * normal
        against /= -np.linalg.norm(against)
        through, along = relative @ normal, relative @ against
        side = -1.0 if through < 0.0 else 1.0  # wind from behind is the mirror image
        radius = math.hypot(place[1], place[2])
        tip, root = (end * math.cos(self.cone) for end in (RADIUS, ROOT))
        solidity = self.blades * CHORD / (2.0 * math.pi * radius)
        speed = np.linalg.norm(relative)

        def parts(phi):
            sine, cosine = math.sin(phi), math.cos(phi)
            lift, drag, _, _ = at(speed * (side * sine * normal + cosine * against))
            lift, drag = side * lift, drag * self.drag_induces
            loss = 1.0
            for end, distance, size in (("Tip", tip - radius, radius), ("Hub", radius - root, root)):
                if end in self.losses:
                    loss *= 2.0 / math.pi * math.acos(math.exp(-0.5 * self.blades * distance / (size * abs(sine))))
            loss = max(loss, 1e-4)
            k = solidity * (lift * cosine + drag * sine) / (4.0 * loss * sine**2)
            k_along = solidity * (lift * sine - drag * cosine) / (4.0 * loss * sine * cosine)
            if phi < 0.0:
                a = k / (k - 1.0) if k > 1.0 else 0.0
            elif k <= 2.0 / 3.0:
                a = k / (1.0 + k)
            else:
                root_of = math.sqrt(2.0 * loss * k - loss * (4.0 / 3.0 - loss))
                a = (2.0 * loss * k - (10.0 / 9.0 - loss) - root_of) / (2.0 * loss * k - (25.0 / 9.0 - 2.0 * loss))
            return a, k_along / (1.0 - k_along), k, k_along

        def residual(phi):
            a, _, k, k_along = parts(phi)
            slowing = 1.0 / (1.0 - a) if phi > 0.0 else 1.0 - k
            return math.sin(phi) * slowing - abs(through) / along * math.cos(phi) * (1.0 - k_along)

        for low, high in ((1e-6, math.pi / 2), (-math.pi / 4, -1e-6), (math.pi / 2, math.pi - 1e-6)):
            if residual(low) * residual(high) > 0.0:
                continue
            phi = brentq(residual, low, high, xtol=1e-13)
            a, a_along, _, _ = parts(phi)
            if abs(through) * (1.0 - a) * math.sin(phi) + along * (1.0 + a_along) * math.cos(phi) > 0.0:
                self.inductions.append((radius, a))
                return relative - self.skew(place, radius / tip) * a * through * normal + a_along * along * against
        raise ArithmeticError("no balance")


def array(values):
    return "{" + ", ".join(f"{value:.15g}" for value in values) + "}"


def element(name, content):
    """A list of a deck from dictionaries."""
    parent = tree.Element("ParameterList", name=name)
    for key, value in content.items():
        if isinstance(value, dict):
            parent.append(element(key, value))
        else:
            tree.SubElement(parent, "Parameter", name=key, value=str(value))
    return parent


CASES = {
    "three blades": {},
    "one blade": {"blades": 1},
    "two blades": {"blades": 2},
    "five blades": {"blades": 5},
    "turns the other way": {"sense": -1},
    "coned by 5 deg": {"cone": 0.087},
    "coned the other way, wind from below": {"cone": -0.05, "wind": (8.96, 0.0, 0.9)},
    "wind from 29 deg, two blades, the other way": {"wind": (7.9, 4.3, 0.0), "blades": 2, "sense": -1},
    "wind from behind": {"wind": (-9.0, 0.0, 0.0)},
    "wind from behind, axis named with it": {"wind": (-9.0, 0.0, 0.0), "axis": (-1, 0, 0)},
    "axis named against the wind": {"axis": (-1, 0, 0)},
    "heavily loaded": {"rpm": 25.0, "wind": (5.0, 0.0, 0.0), "pitch": -3.0},
    "25 m/s": {"wind": (25.0, 0.0, 0.0), "pitch": 20.0},
    "0.5 m/s, driven": {"wind": (0.5, 0.0, 0.0)},
    "driven as a propeller": {"pitch": -5.0},
    "without drag in the balance": {"drag_induces": False},
    "without loss at the hub": {"losses": ("Tip",)},
    "without induction": {"induction": "None"},
    "wakes that follow, at rest": {"induction": "Dynamic"},
    "wind from 20 deg, skewed wake": {"wind": (8.5, 3.0, 0.5), "yaw": "Pitt Peters"},
    "wind from 40 deg, skewed wake, two blades, the other way": {"wind": (6.0, 5.0, 0.0), "blades": 2, "sense": -1,
                                                                 "yaw": "Pitt Peters"},
    "wind from behind and below, skewed wake, coned": {"wind": (-8.0, 2.0, 1.0), "cone": 0.05, "yaw": "Pitt Peters"},
    "moves through still air, against the wind that it feels": {"moving": (-9.0, 0.0, 0.0)},
    "moves in a wind, skewed wake": {"wind": (8.5, 3.0, 0.5), "moving": (-4.0, -1.0, 0.5), "yaw": "Pitt Peters"},
    "feathered, idling in a storm": {"rpm": 1.0, "pitch": 88.0, "wind": (50.0, 10.0, 0.0), "induction": "None"},
}


def verify_coefficients(culm, report):
    report.title("A rotor that moves through still air has the coefficients of one that stands in the wind")
    standing, moving = (Rotor(**kind).run(culm).history for kind in ({}, {"moving": (-9.0, 0.0, 0.0)}))
    for name in ("CT [1]", "CP [1]", "TSR [1]", "wind [m/s]", "a [1]"):
        report.relative(name, moving.column(f"rotor {name}")[-1], standing.column(f"rotor {name}")[-1], 1e-9)


class RotorInGust(Rotor):
    """In a wind along the axis that rises from 9 to 12 m/s between 1 and 3 s, with wakes that follow (Oye)."""

    EXPRESSION = "9 + (t < 1 ? 0 : (t < 3 ? 1.5*(1 - cos(pi*(t - 1)/2)) : 3))"

    def __init__(self, step, end):
        super().__init__(induction="Dynamic", rpm=14.0, pitch=2.0)
        self.step, self.end = step, end

    @staticmethod
    def speed(time):
        return 9.0 + 1.5 * (1.0 - math.cos(0.5 * math.pi * min(max(time - 1.0, 0.0), 2.0)))

    def deck(self):
        deck = super().deck()
        deck["Functions"]["gust"] = {"Type": "Expression", "Expression": self.EXPRESSION}
        deck["Flows"]["wind"].update({"Velocity": "{1, 0, 0}", "Function": "gust"})
        deck["Analyses"]["motion"].update({"End Time": self.end, "Step": self.step})
        return deck

    def thrusts(self, step):
        """By times, with steps in which what the balance asks for stands still."""
        width = (RADIUS - ROOT) / STATIONS
        radii = ROOT + (np.arange(STATIONS) + 0.5) * width
        span, up = self.directors(0)
        behind = np.cross(span, up)
        tail = math.cos(self.pitch) * behind + math.sin(self.pitch) * up
        suction = math.cos(self.pitch) * up - math.sin(self.pitch) * behind

        def asked(speed):
            """Induced velocities, and a at the stations."""
            self.wind, self.inductions = speed * X, []
            induced = []
            for radius in radii:
                place = radius * span
                relative = self.wind - self.omega * np.cross(X, place)
                lever = self.omega * np.cross(X, 0.5 * CHORD * tail)

                def at(wind):
                    there = wind - lever
                    return (*coefficients(math.atan2(there @ suction, there @ tail)),
                            (there @ suction) ** 2 + (there @ tail) ** 2)

                induced.append(self.slowed(relative, place, span, at) - relative)
            return np.array(induced), np.array(self.inductions)[:, 1]

        def thrust(speed, induced):
            self.wind, total = speed * X, 0.0
            for radius, velocity in zip(radii, induced):
                self.given = velocity
                total += 3.0 * width * self.section(radius * span, span, tail, suction)[0][0]
            self.given = None
            return total

        now, _ = asked(self.speed(0.0))
        reduced, times, found = 0.4 * now, [], []
        for k in range(round(self.end / step)):
            time = (k + 0.5) * step
            target, inductions = asked(self.speed(time))
            mean = float(radii @ inductions / radii.sum())
            slow = 1.1 / (1.0 - 1.3 * min(mean, 0.5)) * RADIUS / self.speed(time)
            fast = ((0.39 - 0.26 * (radii / RADIUS) ** 2) * slow)[:, None]
            part = (reduced - 0.4 * target) * slow / (slow - fast)
            after = target + part * math.exp(-step / slow) + (now - target - part) * np.exp(-step / fast)
            found.append(thrust(self.speed(time), 0.5 * (now + after)))
            reduced = 0.4 * target + (reduced - 0.4 * target) * math.exp(-step / slow)
            now = after
            times.append(time)
        return times, found

    given = None

    def slowed(self, relative, place, span, at):
        return relative + self.given if self.given is not None else super().slowed(relative, place, span, at)


def verify_inflow(culm, report):
    report.title("Thrust in a wind that rises from 9 to 12 m/s in 2 s, wakes that follow: beside Oye's equations at all stations")
    errors = []
    for step in (0.1, 0.05):
        rotor = RotorInGust(step, 8.0)
        history = rotor.run(culm).history
        found = np.array(history.column("rotor thrust [N]")[1:])
        wanted = np.interp(np.array(history.levels[1:]) - 0.5 * step, *rotor.thrusts(0.025))
        errors.append(np.abs(found - wanted).max() / wanted.max())
    report.holds(f"steps of 0.1 s {errors[0]:.1e}, of 0.05 s", errors[1], 5e-4)
    report.holds("of second order, the half step leaves", errors[1] / errors[0], 0.32)


def verify(culm, report):
    report.title("Force and moment about the centre, beside the same equations written anew; steps of 3 degrees")
    for name, kind in CASES.items():
        rotor = Rotor(**kind)
        if rotor.yaw != "None":
            rotor.find_mean_induction()
        run = rotor.run(culm)
        if run.exit != 0:
            report.check(f"{name}: exit code\n{run.errors}", run.exit, 0, 0)
            continue
        worst = 0.0
        # the skew of a wake is by the mean induction of the step before, so the first has none
        for row in (1, STEPS // 2, STEPS) if rotor.yaw == "None" else (STEPS // 2, STEPS):
            time = (row - 0.5) * rotor.step
            wanted = rotor.loads(rotor.omega * time)
            wanted[3:] += np.cross(rotor.moving * time, wanted[:3])  # about a point that stands
            found = sum(np.array([run.history.column(f"air on blade {k + 1} {c}")[row] for c in (
                "Fx [N]", "Fy [N]", "Fz [N]", "Mx [N m]", "My [N m]", "Mz [N m]")]) for k in range(rotor.blades))
            scale = np.repeat([np.linalg.norm(wanted[:3]), np.linalg.norm(wanted[3:])], 3)
            worst = max(worst, np.abs((found - wanted) / scale).max())
        # chords of arcs are shorter by (3 deg)^2 / 24, and loads go with their square; small thrusts are differences
        report.holds(f"{name}: thrust {found[0]:.6g} N, torque {found[3]:.6g} N m", worst, 2e-3)
    verify_coefficients(culm, report)
    verify_inflow(culm, report)
    report.title("What has no balance, or is no rotor, is told")
    for name, kind, words in (("still air", {"wind": (0.0, 0.0, 0.0)}, "have no balance"),
                              ("wind across the axis", {"wind": (0.0, 5.0, 0.0)}, "have no balance"),
                              ("wrong axis", {"axis": (0, 1, 0)}, "do not turn with the node of 'Hub'"),
                              ("oblique axis", {"axis": (1, 0.3, 0)}, "do not turn with the node of 'Hub'"),
                              ("wrong hub", {"hub": "nacelle"}, "do not turn with the node of 'Hub'"),
                              ("two of three blades", {"named": 2}, "are not evenly spaced")):
        output = Rotor(**kind).run(culm)
        report.check(f"{name}: warned", words in output.errors + output.output, True, 0)


if __name__ == "__main__":
    main(verify)
