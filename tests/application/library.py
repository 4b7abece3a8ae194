#!/usr/bin/env python3
"""Motions with a controller in a shared object: what it does, against the same controller in blocks and in Python, and
what is said where it is missing, fails, or would have to go back.

usage: library.py --culm PROGRAM --library SHARED_OBJECT
"""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/kit"))
from culm_runs import INPUTS, MPI_ENVIRONMENT  # noqa: E402
from culm.history import History  # noqa: E402

DECK = INPUTS / "control/speed_control.xml"
J, T, P, I, SET_POINT = 2.0, 0.2, 3.0, 4.0, 1.5
CULM = LIBRARY = None


def sampled(step, end, gust=1.0):
    """Speeds in the steps: a rigid rotor and a lag by the mid-point rule, a controller that holds its demand from one
    step to the next."""
    speed = moment = demand = total = 0.0
    speeds = []
    for n in range(round(end / step)):
        before = moment
        moment = ((1 - step / (2 * T)) * moment + step / T * demand) / (1 + step / (2 * T))
        change = step / J * (0.5 * (before + moment) + gust * np.sin((n + 0.5) * step) ** 2)
        speeds.append(speed + 0.5 * change)
        speed += change
        error = SET_POINT - speeds[-1]
        total += error * step
        demand = P * error + I * total
    return np.array(speeds)


class LibraryTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="culm"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_culm(self, *words, exit_code=0):
        process = subprocess.run([CULM, *map(str, words)], capture_output=True, text=True,
                                 env={**os.environ, **MPI_ENVIRONMENT}, timeout=300)
        self.assertEqual(process.returncode, exit_code, process.stdout + process.stderr)
        return process.stderr

    def settings(self, gains=(SET_POINT, P, I, 100.0, 100.0)):
        (self.folder / "gains.in").write_text(" ".join(map(str, gains)))
        values = {
            "Signals/controller library/Type": "Library",
            "Signals/controller library/File Name": LIBRARY,
            "Signals/controller library/Input File": self.folder / "gains.in",
            "Signals/controller library/Records": "{rotor speed, pitch 1}",
            "Signals/controller library/Signals": "{speed, Constant}",
            "Signals/demand/Type": "Library Output",
            "Signals/demand/Library": "controller library",
            "Signals/demand/Record": "generator torque",
            "Signals/motor/Signal": "demand",
            "Analyses/motion/End Time": "4",
        }
        return [word for path, value in values.items() for word in ("--set", f"{path}={value}")]

    def speeds(self, step, settings, exit_code=0, name="run"):
        self.run_culm("run", DECK, "--quiet", "--output", self.folder / name, "--set", f"Analyses/motion/Step={step}",
                      *settings, exit_code=exit_code)
        history = History(self.folder / name / "history.csv")
        times = np.array(history.levels)
        return np.array(history.column("speed [1]"))[times > 0.0]

    def test_it_is_the_controller_of_the_library(self):
        errors = [np.abs(self.speeds(step, self.settings()) - sampled(step, 4.0)).max() for step in (0.02, 0.01)]
        self.assertLess(errors[1], 2e-4)
        self.assertAlmostEqual(np.log2(errors[0] / errors[1]), 2.0, delta=0.1)

    def test_it_starts_what_is_at_rest(self):
        speeds = self.speeds(0.01, [*self.settings(), "--set", "Analyses/motion/Inactive={gust}"])
        self.assertLess(np.abs(speeds - sampled(0.01, 4.0, gust=0.0)).max(), 2e-4)

    def test_it_is_one_step_late_against_blocks(self):
        apart = []
        for step in (0.02, 0.01):
            blocks = self.speeds(step, ["--set", "Analyses/motion/End Time=4"])
            library = self.speeds(step, self.settings())
            apart.append(np.abs(library - blocks).max())
        self.assertGreater(apart[1], 1e-3)
        self.assertAlmostEqual(np.log2(apart[0] / apart[1]), 1.0, delta=0.1)

    def test_calls_keep_to_their_interval(self):
        settings = [
            *self.settings(), "--set", "Signals/controller library/Interval=0.05",
            "--set", "Signals/calls/Type=Library Output", "--set", "Signals/calls/Library=controller library",
            "--set", "Signals/calls/Record=120", "--set", "Output/History/calls/Type=Signal",
            "--set", "Output/History/calls/Signal=calls", "--set", "Analyses/motion/End Time=1"]
        self.speeds(0.01, settings)
        history = History(self.folder / "run/history.csv")
        motion = [row for row, number in enumerate(history.analyses) if number == history.analyses[-1]]
        calls = np.array(history.column("calls [1]"))[motion]
        # the first at 0.01 s, then every fifth step; a call is seen in the step behind it
        steps = np.array(history.steps)[motion]
        self.assertTrue((calls == np.where(steps < 2, 0, (steps - 2) // 5 + 1)).all(), calls)

    def test_it_cannot_be_resumed(self):
        self.speeds(0.01, [*self.settings(), "--set", "Analyses/motion/End Time=1"])
        errors = self.run_culm("resume", self.folder / "run", "--set", "Analyses/motion/End Time=2", exit_code=2)
        self.assertIn("library 'controller library' has states of its own after 0 calls, which cannot become those "
                      "after 100", errors)

    def test_its_failure_ends_the_run_with_its_message(self):
        errors = self.run_culm("run", DECK, "--quiet", "--output", self.folder / "run",
                               *self.settings((SET_POINT, P, I, 0.5, 1.0)), exit_code=4)
        self.assertIn("aviFAIL = -2: the rotor runs away at 1.0", errors)

    def test_its_warnings_are_findings(self):
        errors = self.run_culm("run", DECK, "--output", self.folder / "run",
                               *self.settings((SET_POINT, P, I, 1.0, 100.0)))
        self.assertIn("library 'controller library' warned", errors)
        self.assertIn("first 'the rotor is fast' at", errors)

    def refused(self, text, *changes):
        words = [word for change in changes for word in ("--set", change)]
        self.assertIn(text, self.run_culm("check", DECK, *self.settings(), *words, exit_code=3))

    def test_mistakes_are_named(self):
        entry = "Signals/controller library"
        self.refused("there is no library 'controler library' – did you mean 'controller library'?",
                     "Signals/demand/Library=controler library")
        self.refused("got 'generator torqe' – did you mean 'generator torque'?", "Signals/demand/Record=generator torqe")
        self.refused("a number from 4 to 4096, got '5000'", "Signals/demand/Record=5000")
        self.refused("got 'rotor sped' – did you mean 'rotor speed'?", f"{entry}/Records={{rotor sped, pitch 1}}")
        self.refused("must be as many as 'Records', which are 2; got 1", f"{entry}/Signals={{speed}}")
        self.refused("none.so: cannot be loaded: ", f"{entry}/File Name={self.folder / 'none.so'}")
        self.refused("has no procedure 'DISCONNECT'", f"{entry}/Procedure=DISCONNECT")
        self.refused("nothing.in: there is no such file", f"{entry}/Input File={self.folder / 'nothing.in'}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--culm", required=True)
    parser.add_argument("--library", required=True)
    arguments, rest = parser.parse_known_args()
    CULM, LIBRARY = arguments.culm, arguments.library
    unittest.main(argv=[sys.argv[0], *rest])
