#!/usr/bin/env python3
"""Sweeps of small decks: several runs at once, in parts, collected, gone on with after a kill.

usage: sweep.py --culm PROGRAM
"""

import argparse
import contextlib
import csv
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/kit"))
from culm_runs import INPUTS, MPI_ENVIRONMENT  # noqa: E402

FLIGHT = INPUTS / "flight/spaghetti_3d.xml"
SHORT = ["--set", "Analyses/motion/End Time=0.3"]
STIFFNESS = "Sections/bar/EI1"
TIME_LIMIT = 600  # s
CULM = None


class SweepTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="culm"))
        self.addCleanup(shutil.rmtree, self.folder)

    def start(self, *words, deck=FLIGHT):
        return subprocess.Popen(
            [CULM, "sweep", str(deck), "--output", str(self.folder / "sweep"), *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, **MPI_ENVIRONMENT},
            start_new_session=True,
        )

    def sweep(self, *words, exit_code=0, deck=FLIGHT):
        process = self.start(*words, deck=deck)
        output, errors = process.communicate(timeout=TIME_LIMIT)
        self.assertEqual(process.returncode, exit_code, output + errors)
        return output + errors

    def rows(self):
        with open(self.folder / "sweep/sweep.csv", newline="") as file:
            return list(csv.DictReader(file))

    def ended(self):
        return [one.name for one in self.folder.glob("sweep/runs/*") if not one.suffix]

    def cases(self, *lines):
        path = self.folder / "cases.csv"
        path.write_text("\n".join(lines) + "\n")
        return str(path)


class Sweeps(SweepTest):
    def test_all_combinations_in_order_with_what_is_watched(self):
        self.sweep("--vary", f"{STIFFNESS}=400,500", "step=0.1,0.05", *SHORT, "--watch", "other end", "--jobs", "2")
        rows = self.rows()
        self.assertEqual(
            [(row[STIFFNESS], row["step"]) for row in rows],
            [("400", "0.1"), ("400", "0.05"), ("500", "0.1"), ("500", "0.05")],
        )
        for row in rows:
            self.assertEqual(row["outcome"], "done")
            last, least, largest = (float(row[f"other end x [m] {which}"]) for which in ("last", "least", "largest"))
            self.assertLessEqual(least, last)
            self.assertLessEqual(last, largest)
        self.assertNotEqual(rows[0]["other end x [m] last"], rows[1]["other end x [m] last"])
        self.assertFalse([name for name in rows[0] if name.startswith("loaded end")])

    def test_variations_that_advance_together(self):
        self.sweep("--vary", "mesh=1,2", "step=0.1,0.05", "--paired", "mesh", "step", *SHORT)
        both = self.rows()
        self.assertEqual([(row["mesh"], row["outcome"]) for row in both], [("1", "done"), ("2", "done")])
        shutil.rmtree(self.folder / "sweep")
        self.sweep("--vary", "mesh=1,2", "step=0.1,0.05", *SHORT)
        each = self.rows()
        end = "other end x [m] last"
        self.assertEqual([row[end] for row in both], [each[0][end], each[3][end]])

    def test_a_deck_whose_name_is_not_utf_8(self):
        deck = self.folder / os.fsdecode(b"d\xe9ck.xml")
        shutil.copy(FLIGHT, deck)
        self.sweep("--vary", f"{STIFFNESS}=400,500", *SHORT, deck=deck)
        self.assertEqual([row["outcome"] for row in self.rows()], ["done", "done"])
        self.assertIn("must be a number", self.sweep("--vary", f"{STIFFNESS}=none", *SHORT, deck=deck, exit_code=3))

    def test_a_variable_comes_before_a_short_name(self):
        deck = self.folder / "named.xml"
        variable = '<Variable name="tolerance" value="500"/>'
        deck.write_text(FLIGHT.read_text().replace('<ParameterList name="culm">', '<ParameterList name="culm">' + variable)
                        .replace('name="EI1" value="500"', 'name="EI1" value="tolerance"'))
        output = self.sweep("--vary", "tolerance=300,500", *SHORT, "--watch", "other end", deck=deck)
        self.assertIn("note: 'tolerance' is the variable of the deck, not short for Analyses/*/Newton/Force Tolerance", output)
        by_name = [row["other end x [m] last"] for row in self.rows()]
        shutil.rmtree(self.folder / "sweep")
        self.sweep("--vary", f"{STIFFNESS}=300,500", *SHORT, "--watch", "other end")
        self.assertEqual(by_name, [row["other end x [m] last"] for row in self.rows()])

    def test_parts_are_disjoint_and_collected(self):
        values = ["--vary", f"{STIFFNESS}=300,400,500", *SHORT]
        self.sweep(*values, "--part", "1/2")
        self.assertEqual(len(self.ended()), 2)
        self.sweep(*values, "--collect", exit_code=4)
        self.assertEqual([row["outcome"] for row in self.rows()], ["done", "not run", "done"])
        before = set(self.ended())
        self.sweep(*values, "--part", "2/2")
        self.assertEqual(len(set(self.ended()) - before), 1)
        output = self.sweep(*values, "--collect")
        self.assertIn("3 runs: 3 done", output)

    def test_a_failure_is_a_line_with_its_reason(self):
        cases = self.cases(f"{STIFFNESS},Analyses/motion/Newton/Maximum Iterations", "500,20", "500,1")
        output = self.sweep("--cases", cases, *SHORT, "--set", "Analyses/motion/Smallest Step=0.04", exit_code=4)
        self.assertIn("1 done, 1 failed", output)
        good, bad = self.rows()
        self.assertEqual((good["outcome"], good["reason"]), ("done", ""))
        self.assertEqual(bad["outcome"], "did not converge")
        self.assertIn("iteration limit", bad["reason"])

    def test_a_parameter_that_varies_twice_is_refused(self):
        cases = self.cases(f"{STIFFNESS},{STIFFNESS}", "400,500")
        output = self.sweep("--cases", cases, *SHORT, exit_code=2)
        self.assertIn(f"both '{STIFFNESS}' and '{STIFFNESS}' set {STIFFNESS}: only the last one would count", output)

    def test_what_is_set_and_varies_is_refused(self):
        words = ["--set", f"{STIFFNESS}=300", *SHORT]
        said = f"--set {STIFFNESS}=300: '{STIFFNESS}' varies {STIFFNESS}, so that this counts for nothing"
        self.assertIn(said, self.sweep("--vary", f"{STIFFNESS}=400,500", *words, exit_code=2))
        self.assertIn(said, self.sweep("--cases", self.cases(STIFFNESS, "400", "500"), *words, exit_code=2))

    def test_a_case_that_is_listed_twice_is_run_once(self):
        self.sweep("--cases", self.cases(STIFFNESS, "400", "500", "400", "400"), *SHORT, "--jobs", "4")
        self.assertEqual([row["outcome"] for row in self.rows()], ["done"] * 4)
        self.assertEqual(len(self.ended()), 2)

    def test_cases_of_a_spreadsheet_begin_with_a_mark(self):
        cases = self.cases(f"\ufeff{STIFFNESS}", "400")
        self.sweep("--cases", cases, *SHORT)
        self.assertEqual([row[STIFFNESS] for row in self.rows()], ["400"])

    def test_files_that_cases_name_belong_to_them(self):
        shutil.copytree(INPUTS / "beam", self.folder / "decks")
        table = self.folder / "decks/mine.csv"
        cases = self.cases("Functions/file/File Name", str(table), str(self.folder / "decks/include/load.csv"))
        results = []
        for last in (1, 1, 2):
            table.write_text(f"0,0\n2,{last}\n")
            self.sweep("--cases", cases, deck=self.folder / "decks/load_functions.xml")
            results.append([row for row in self.rows()])
        self.assertEqual(results[0], results[1])
        self.assertNotEqual(results[0][0], results[2][0])
        self.assertEqual(results[0][1], results[2][1])
        self.assertEqual(len(self.ended()), 3)

    def test_frequencies_are_collected(self):
        self.sweep("--vary", "Refinement=1,2", deck=INPUTS / "modes/free_beam.xml")
        columns = [name for name in self.rows()[0] if name.endswith("frequency [Hz]")]
        self.assertTrue(columns)
        self.assertTrue(all(float(row[columns[-1]]) > 0.0 for row in self.rows()))

    def test_two_at_once_in_one_folder_make_each_run_once(self):
        words = ["--vary", f"{STIFFNESS}=300,350,400,450,500", *SHORT]
        both = [self.start(*words), self.start(*words)]
        told = [process.communicate(timeout=TIME_LIMIT) for process in both]
        for process, (output, errors) in zip(both, told):
            self.assertEqual(process.returncode, 0, output + errors)
            self.assertIn("5 runs: 5 done", output)
        self.assertEqual(sum(output.count(f" s  {STIFFNESS}=") for output, _ in told), 5, told)

    def test_a_signal_to_it_alone_ends_it(self):
        cases = self.cases(STIFFNESS, *(f"{300 + i}" for i in range(40)))
        process = self.start("--cases", cases, *SHORT)
        end = time.monotonic() + TIME_LIMIT
        while len(self.ended()) < 2 and time.monotonic() < end:
            time.sleep(0.01)
        process.terminate()
        process.communicate()
        self.assertEqual(process.returncode, -signal.SIGTERM)
        with contextlib.suppress(ProcessLookupError):
            while time.monotonic() < end:  # the run that it had begun comes to its end
                os.killpg(process.pid, 0)
                time.sleep(0.01)
        self.assertLess(len(self.ended()), 40)
        self.assertFalse((self.folder / "sweep/sweep.csv").exists())

    def test_goes_on_after_a_kill(self):
        lines = [f"{300 + i}" for i in range(8)]
        cases = self.cases(STIFFNESS, *lines)
        process = self.start("--cases", cases, *SHORT, "--jobs", "2")
        end = time.monotonic() + TIME_LIMIT
        while len(self.ended()) < 3 and time.monotonic() < end:
            time.sleep(0.01)
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        kept = {name: (self.folder / "sweep/runs" / name).stat().st_mtime_ns for name in self.ended()}
        self.assertGreaterEqual(len(kept), 3)
        self.assertLess(len(kept), len(lines))
        output = self.sweep("--cases", cases, *SHORT, "--jobs", "2")
        self.assertIn("8 runs: 8 done", output)
        for name, made in kept.items():
            self.assertEqual((self.folder / "sweep/runs" / name).stat().st_mtime_ns, made)


class Nonsense(SweepTest):
    def test_says_what_is_wrong(self):
        listed = self.cases(f"{STIFFNESS},step", "500")
        for words, code, text in (
            ([], 2, "nothing varies"),
            (["--vary", "step=0.1,0.05", "--cases", listed], 2, "exclude each other"),
            (["--cases", listed], 6, "line 2: 1 values for 2 names"),
            (["--cases", str(self.folder / "none.csv")], 6, "none.csv"),
            (["--vary", "Sections/bar/EII=1,2"], 3, "did you mean"),
            (["--vary", "step=0.1,0.05", "--part", "3/2"], 2, "needs K/N"),
            (["--vary", "step=0.1,0.05", "--part", "1/2", "--collect"], 2, "--collect and --part exclude each other"),
            (["--vary", "step=0.1,0.05", "--jobs", "0"], 2, "whole number"),
        ):
            with self.subTest(words=words):
                self.assertIn(text, self.sweep(*words, exit_code=code))
                self.assertEqual(self.ended(), [])


def main():
    global CULM
    parser = argparse.ArgumentParser()
    parser.add_argument("--culm", required=True)
    arguments, others = parser.parse_known_args()
    CULM = arguments.culm
    unittest.main(argv=[sys.argv[0], *others])


if __name__ == "__main__":
    main()
