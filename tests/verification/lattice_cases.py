#!/usr/bin/python3
"""Rigid wings by vortex rings that must agree with each other. Page: doc/verification/lattice.md."""

import math
import pathlib
import subprocess
import tempfile
import xml.etree.ElementTree as tree

import numpy as np
from rotor_cases import array, element
from verify import INPUTS, main

SPEED, CHORD, ASPECT, PANELS, STEPS = 20.0, 1.0, 4.0, (4, 8), 20


class Wing:
    """A rectangle at an angle in a wind of 20 m/s: half of it, with a mirror or without, or the whole."""

    def __init__(self, degrees=5.0, wind=(SPEED, 0.0, 0.0), moving=(0.0, 0.0, 0.0), whole=False, in_time=True, wake="Prescribed",
                 panels=PANELS, aspect=ASPECT, camber=0.0, twin_at=None):
        self.angle, self.wind, self.moving = math.radians(degrees), wind, moving
        self.whole, self.in_time, self.wake, self.panels = whole, in_time, wake, panels
        self.aspect, self.camber, self.twin_at = aspect, camber, twin_at

    def deck(self):
        half = 0.5 * self.aspect * CHORD
        up = array((math.cos(self.angle), 0.0, -math.sin(self.angle)))
        heights = {"wing": 0.0} | ({"twin": self.twin_at} if self.twin_at else {})
        beams = {name: {"Type": "Beam", "Section": "rigid", "Fidelity": "Rigid",
                        "Curve": {"Type": "Line", "From": array((0.0, -half * self.whole, z)), "To": array((0.0, half, z)),
                                  "Up": up, "Elements": 8}} for name, z in heights.items()}
        surface = {"Chord": CHORD, "Axis At": 0.25, "Camber": self.camber,
                   "Panels": f"{{{self.panels[0]}, {self.panels[1] * (1 + self.whole)}}}",
                   "Tips": "{first, last}" if self.whole else "{last}"}
        step = CHORD / self.panels[0] / SPEED
        motion = {"Type": "Dynamic", "End Time": STEPS * step, "Step": step} if self.in_time else {"Type": "Static", "Steps": 1}
        stiff = {"EA": 1e12, "GA1": 1e12, "GA2": 1e12, "EI1": 1e12, "EI2": 1e12, "GIp": 1e12, "rhoA": 10, "rhoI1": 1, "rhoI2": 1}
        held = {name: {"Type": "Rigid Support", "Node": name} for name in beams}
        speeds = {}
        if any(self.moving):
            for name in beams:
                held[name] |= {"Translation": array(self.moving), "Function": "time"}
                speeds[name] = {"Type": "Velocity", "Node": name, "Velocity": array(self.moving)}
        return {
            "Title": "Wing",
            "Sections": {"rigid": {"Type": "Stiffness Values", **stiff}},
            "Functions": {"time": {"Type": "Expression", "Expression": "t"}},
            "Structures": beams,
            "Flows": {"air": {"Type": "Uniform", "Density": 1.0, "Velocity": array(self.wind)}},
            "Loads": {"air": {"Type": "Vortex Lattice", "Flow": "air", **({} if self.whole else {"Mirror": "{0, 1, 0}"}),
                              "Surfaces": {name: {"Structure": name, **surface} for name in beams},
                              "Wake": {"Rows": 40, "Motion": self.wake}}},
            "Constraints": held,
            **({"Initial Conditions": speeds} if speeds else {}),
            "Analyses": {"flow": motion},
            "Output": {"History": {"air": {"Type": "Fluid Force", "Load": "air"}}},
        }

    def run(self, culm):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "wing.xml"
            path.write_bytes(tree.tostring(element("culm", self.deck())))
            return culm.run(path, quiet=False)

    def force(self, culm):
        history = self.run(culm).history
        return np.array([history.column(f"air {name}")[-1] for name in ("Fx [N]", "Fy [N]", "Fz [N]", "My [N m]")])


def same(report, what, found, wanted, tolerance):
    report.holds(f"{what}: lift {found[-1]:.8g} N", np.linalg.norm(found - wanted) / np.linalg.norm(wanted), tolerance)


def verify(culm, report):
    report.title("Half a wing with a mirror is half of the whole: drag and lift")
    both = [0, 2]
    for kind in ({"in_time": False}, {}, {"wake": "Free"}):
        half, whole = (Wing(whole=is_whole, **kind).force(culm)[both] for is_whole in (False, True))
        same(report, f"{kind or 'prescribed wake'}", half, 0.5 * whole, 1e-9)
    report.title("A wing that moves through still air is one that stands in the wind, after 20 steps: force")
    for wake in ("Prescribed", "Free"):
        standing = Wing(wake=wake).force(culm)[:3]
        same(report, f"{wake}, half", Wing(wake=wake, wind=(0, 0, 0), moving=(-SPEED, 0, 0)).force(culm)[:3], standing, 1e-8)
    standing = Wing(whole=True).force(culm)[both]
    moving = Wing(whole=True, wind=(30.0, 4.0, 0.0), moving=(10.0, 4.0, 0.0)).force(culm)[both]
    same(report, "with the wind and sideways", moving, standing, 1e-8)
    report.title("Two wings 1000 chords apart are two wings")
    same(report, "statics", Wing(in_time=False, twin_at=1000.0).force(culm)[both], 2.0 * Wing(in_time=False).force(culm)[both], 1e-5)
    report.title("Camber of 0.02 on a wing of aspect ratio 40, by panels along the chord: lift is that of an angle of 0.04")
    for chordwise in (1, 4, 8):
        kind = {"in_time": False, "panels": (chordwise, 10), "aspect": 40.0}
        cambered = Wing(degrees=0.0, camber=0.02, **kind).force(culm)
        flat = Wing(degrees=math.degrees(0.04), **kind).force(culm)
        # the rest is of the small angle and of the ends of the span
        report.relative(f"{chordwise}: lift [N]", cambered[2], flat[2], 4e-3)
    moment = cambered[3] / (0.5 * SPEED**2 * 20.0 * CHORD**2)
    report.check("moment about the quarter chord, pi times the camber but for panels and span", moment, -math.pi * 0.02, 4e-3)
    report.title("What is no half, or no wing, is told")
    for name, wing, words in (("wind through the mirror", Wing(wind=(SPEED, 4.0, 0.0)), "blows through its 'Mirror'"),
                              ("the same in statics", Wing(wind=(SPEED, 4.0, 0.0), in_time=False), "blows through its 'Mirror'"),
                              ("wind from behind", Wing(wind=(-SPEED, 0.0, 0.0), in_time=False), "comes from behind"),
                              ("at 20 degrees", Wing(degrees=20.0, in_time=False), "at angles up to 20 degrees")):
        run = wing.run(culm)
        report.check(f"{name}: warned", words in run.errors + run.output, True, 0)
    run = Wing(whole=True, wind=(SPEED, 4.0, 0.0)).run(culm)
    report.check("the whole wing in that wind: not", "warning" in run.errors + run.output, False, 0)
    report.title("Modes of many nodes that the air couples are refused before they take the memory")
    with tempfile.TemporaryDirectory() as folder:
        settings = ["Structures/wing/Curve/Elements=64", "n=60", "m=1", "Analyses/sweep/Levels={150}"]
        run = subprocess.run(
            [culm.program, "run", str(INPUTS / "air/lattice_flutter.xml"), "--max-memory", "200 MB", "--output", folder, "--quiet",
             *(word for setting in settings for word in ("--set", setting))], capture_output=True, text=True)
    report.check("exit code", run.returncode, 3, 0)
    report.check("says why", "couples 125 nodes with each other by lags of the air" in run.stderr, True, 0)


if __name__ == "__main__":
    main(verify)
