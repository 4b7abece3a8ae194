#!/usr/bin/env python3
"""Studies of small decks: what they find, that one goes on after it was killed, what they say to nonsense.

usage: study.py --culm PROGRAM
"""

import argparse
import csv
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/kit"))
from culm_runs import INPUTS, MPI_ENVIRONMENT, Culm  # noqa: E402

FLIGHT = INPUTS / "flight/spaghetti_3d.xml"
ROLL_UP = INPUTS / "beam/roll_up.xml"
TIME_LIMIT = 600  # s
CULM = None


def start(folder, deck, *words):
    return subprocess.Popen(
        [CULM, "study", str(deck), "--output", str(folder), *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, **MPI_ENVIRONMENT},
        start_new_session=True,
    )


class StudyTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="culm"))
        self.addCleanup(shutil.rmtree, self.folder)

    def study(self, deck, *words, exit_code=0):
        process = start(self.folder, deck, *words)
        output, errors = process.communicate(timeout=TIME_LIMIT)
        self.assertEqual(process.returncode, exit_code, output + errors)
        return output if exit_code == 0 else errors

    def rows(self):
        with open(self.folder / "study.csv", newline="") as file:
            return list(csv.DictReader(file))

    def records(self):
        """Those of runs that came to their end; folders of unfinished ones may vanish at any time."""
        folders = [one for one in self.folder.glob("runs/*") if not one.suffix]
        return {one.name: json.loads((one / "record.json").read_text()) for one in folders}


class Findings(StudyTest):
    def test_order_files_and_target(self):
        output = self.study(
            FLIGHT, "--vary", "step=0.1:0.0125/2", "scheme=Conserving,Trapezoidal", "--watch", "other end",
            "--hold-out", "loaded end", "--repeat", "2", "--jobs", "2", "--target", "3e-3",
            "--set", "Analyses/motion/End Time=2",
        )
        for scheme in ("Conserving", "Trapezoidal"):
            line = next(one for one in output.splitlines() if one.startswith("order") and scheme in one)
            self.assertAlmostEqual(float(line.split()[3]), 2.0, delta=0.1, msg=line)
        self.assertIn("cent", output.split("\n\n")[-2])
        rows = self.rows()
        self.assertEqual(len(rows), 8)
        for row in rows:
            self.assertEqual(row["outcome"], "done")
            self.assertGreater(float(row["cpu median [s]"]), 0.0)
            self.assertLess(float(row["uncertainty of the reference"]), 1e-4)
        errors = [float(row["error of other end"]) for row in rows if row["scheme"] == "Conserving"]
        for coarse, fine in zip(errors, errors[1:]):
            self.assertAlmostEqual(coarse / fine, 4.0, delta=0.5)
        # all runs of the grid have two times, the reference none
        self.assertEqual(sorted({len(r["times"]) for r in self.records().values()}), [0, 2])
        self.assertEqual((self.folder / "study.png").read_bytes()[1:4], b"PNG")
        page = (self.folder / "study.html").read_text()
        self.assertIn("data:image/png;base64,", page)
        for outside in ("http:", "https:", "src=\"/", "<script", "<link"):
            self.assertNotIn(outside, page)
        self.check_target(errors)

    def check_target(self, errors):
        """The deck that was written is sound, and as good as it says."""
        deck = self.folder / "target.xml"
        step = float(ElementTree.parse(deck).find(".//Parameter[@name='Step']").get("value"))
        run = Culm(CULM).succeed(deck)
        fine = Culm(CULM).succeed(deck, ["Analyses/motion/Step=0.003125"])
        end, limit = run.history.vector("other end"), fine.history.vector("other end")
        error = max(abs(a - b) for a, b in zip(end, limit)) / max(map(abs, limit))
        self.assertLess(error, 6e-3)
        self.assertGreater(step, 0.0125)

    def test_variations_that_advance_together(self):
        output = self.study(
            FLIGHT, "--vary", "mesh=1:4*2", "step=0.1:0.025/2", "--paired", "mesh", "step", "--watch", "other end",
            "--repeat", "1", "--set", "Analyses/motion/End Time=1",
        )
        self.assertIn("order in mesh: ", output)
        self.assertEqual([row["mesh"] for row in self.rows()], ["1", "2", "4"])
        self.assertIn("mesh=4, step=0.025", (self.folder / "study.html").read_text())

    def test_reference_from_a_run(self):
        setting = "Analyses/motion/End Time=1"
        self.study(FLIGHT, "--vary", "step=0.05:0.0125/2", "--watch", "other end", "--set", setting, "--repeat", "1")
        finest = next(
            folder for folder, record in self.records().items() if "Analyses/motion/Step=0.0125" in record["settings"]
        )
        self.study(
            FLIGHT, "--vary", "step=0.05:0.0125/2", "--watch", "other end", "--set", setting, "--repeat", "1",
            "--reference", str(self.folder / "runs" / finest),
        )
        errors = [float(row["error of other end"]) for row in self.rows()]
        self.assertEqual(errors[-1], 0.0)
        self.assertAlmostEqual(errors[0] / errors[1], 15.0 / 3.0, delta=0.5)

    def test_reference_of_another_kind(self):
        """A history of a motion would go as one of levels."""
        run = self.folder / "statics"
        words = [CULM, "run", str(ROLL_UP), "--output", str(run), "--quiet"]
        subprocess.run(words, check=True, env={**os.environ, **MPI_ENVIRONMENT})
        errors = self.study(FLIGHT, "--vary", "step=0.05", "--watch", "other end", "--reference", str(run), exit_code=2)
        self.assertIn("it ends with an analysis of type Static or Path, that of the deck is of type Dynamic", errors)

    def test_target_that_was_not_reached(self):
        words = ["--vary", "step=0.1,0.05", "--watch", "other end", "--repeat", "1", "--set", "Analyses/motion/End Time=2"]
        self.study(FLIGHT, *words, "--target", "0.02")
        self.assertTrue((self.folder / "target.xml").exists())
        self.study(FLIGHT, *words, "--target", "1e-7", exit_code=4)
        self.assertFalse((self.folder / "target.xml").exists())

    def test_deck_that_reads_a_file(self):
        hook = INPUTS / "shell/raasch_hook.xml"
        self.study(hook, "--vary", "mesh=1,2", "--finer", "0", "--repeat", "1", "--target", "0.5")
        subprocess.run(
            [CULM, "check", str(self.folder / "target.xml"), "--quiet"],
            check=True,
            env={**os.environ, **MPI_ENVIRONMENT},
        )

    def test_quantity_that_ends_at_nothing(self):
        """A beam that closes to a circle has turned by 2 pi, which is none."""
        words = (ROLL_UP, "--vary", "Refinement=1,2", "--repeat", "1", "--watch", "tip rotation")
        said = "is next to nothing where runs are compared"
        self.assertIn(said, self.study(*words))
        shutil.rmtree(self.folder)
        self.assertNotIn(said, self.study(*words, "--norm", "max"))

    def test_nothing_refined(self):
        output = self.study(
            FLIGHT, "--vary", "form=Null-Space,Multipliers", "--watch", "other end", "--repeat", "1",
            "--set", "Analyses/motion/End Time=2",
        )
        self.assertIn("Nothing is refined: errors are differences from form=Null Space", output)
        self.assertLess(float(self.rows()[1]["error of other end"]), 1e-10)

    def test_the_least_tolerance_is_the_reference(self):
        output = self.study(INPUTS / "coupling/partners.xml", "--vary", "Coupling/Tolerance=1e-4,1e-9,1e-6", "--repeat", "1")
        self.assertIn("errors are differences from Tolerance=1e-9", output)

    def test_failed_runs_do_not_stop_it(self):
        # 8 elements of order 1 have no solution beyond 0.6366 of the load: doc/verification/roll_up.md
        output = self.study(
            ROLL_UP, "--vary", "Structures/beam/Curve/Elements=8:16*2", "element=Director-1,Director-2",
            "--watch", "tip", "--repeat", "1",
        )
        outcomes = {(row["Structures/beam/Curve/Elements"], row["element"]): row["outcome"] for row in self.rows()}
        self.assertTrue(outcomes["8", "Director 1"].startswith("did not converge: No equilibrium beyond level 0.6366"))
        self.assertIn("failed: did not converge", output)
        self.assertEqual([key for key, value in outcomes.items() if value != "done"], [("8", "Director 1")])
        self.assertIn("No equilibrium beyond level 0.6366", (self.folder / "study.html").read_text())


class Resuming(StudyTest):
    def test_goes_on_after_it_was_killed(self):
        words = ["--vary", "step=0.01:0.00125/2", "--watch", "other end", "--repeat", "1", "--set", "Analyses/motion/End Time=3"]
        process = start(self.folder, FLIGHT, *words)
        end = time.monotonic() + TIME_LIMIT
        while len(self.records()) < 2 and time.monotonic() < end:
            time.sleep(0.005)
        os.killpg(process.pid, signal.SIGKILL)  # the run that is going on, too
        process.communicate()
        before = self.records()
        self.assertGreaterEqual(len(before), 2)
        self.assertLess(len(before), 5)
        self.study(FLIGHT, *words)
        after = self.records()
        self.assertEqual({key: after[key] for key in before}, before)
        self.assertEqual(len(after), 5)
        self.assertEqual(list(self.folder.glob("runs/*.part")), [])
        # with everything there, nothing is run
        self.study(FLIGHT, *words)
        self.assertEqual(self.records(), after)


class Errors(StudyTest):
    def says(self, text, *words):
        errors = self.study(FLIGHT, *words, exit_code=2)
        self.assertIn(text, errors)
        self.assertEqual(len(errors.strip().splitlines()), 1, errors)

    def test_of_names(self):
        self.says("did you mean 'step'", "--vary", "stepp=1,2")
        self.says("did you mean 'other end'", "--vary", "step=1", "--watch", "other edn")
        self.says("--hold-out nix: no quantity of the history", "--vary", "step=1", "--hold-out", "nix")
        self.says("no component 'q' (x, y, z)", "--vary", "step=1,0.5", "--watch", "other end/q", "--repeat", "1")

    def test_of_values(self):
        self.says("--target 2: must be between 0 and 1", "--vary", "step=1,2", "--target", "2")
        self.says("argument --repeat: needs a whole number from 1 on, got '0'", "--vary", "step=1,2", "--repeat", "0")

    def test_of_values_that_the_deck_refuses(self):
        errors = self.study(FLIGHT, "--vary", "scheme=Conserving,Verlet", exit_code=3)
        self.assertIn("Analyses / motion / Scheme: unknown choice 'Verlet'", errors)
        self.assertEqual(self.records(), {})


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    options, rest = parser.parse_known_args()
    CULM = os.path.abspath(options.culm)
    unittest.main(argv=[sys.argv[0], *rest])
