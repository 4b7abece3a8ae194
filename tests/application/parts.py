#!/usr/bin/env python3
"""Models that are large enough for all ranks to factor them together: results agree with those of one rank, and a
run of a slender one, where each rank factors its own part, goes on after a stop, bit by bit on as many ranks, within
rounding on others. The memory of the machine decides how, and whether.

usage: parts.py --culm PROGRAM --mpiexec PROGRAM
"""

import argparse
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

INPUTS = pathlib.Path(__file__).resolve().parent.parent.parent / "inputs"
ELEMENTS = 4000  # 24 000 unknowns
ACROSS = 60  # of a shell, 22 000 unknowns
# The tangent of so many elements has a condition of 1e14; steps are converged to rounding of the forces.
CLOSE = 1e-8


def history(folder):
    with open(folder / "history.csv", newline="") as file:
        return [[float(cell) for cell in row] for row in list(csv.reader(file))[1:] if row]


def difference(one, other):
    """Largest difference over the largest number of a column; infinite where the rows do not match."""
    if [len(row) for row in one] != [len(row) for row in other]:
        return float("inf")
    scale = [max(abs(row[c]) for row in one) or 1.0 for c in range(len(one[0]))]
    return max(abs(a - b) / s for x, y in zip(one, other) for a, b, s in zip(x, y, scale))


class Runs:
    def __init__(self, options, folder):
        self.culm = os.path.abspath(options.culm)
        self.mpiexec = options.mpiexec
        self.folder = folder

    def __call__(self, ranks, *words, expect=0):
        run = subprocess.run([self.mpiexec, "-n", str(ranks), self.culm, *words], cwd=self.folder,
                             capture_output=True, text=True, timeout=600)
        if run.returncode != expect:
            sys.exit(f"{words} on {ranks} ranks: exit code {run.returncode}, expected {expect}\n{run.stdout}{run.stderr}")
        return run.stdout

    def deck(self, ranks, output, *more, expect=0):
        return self(ranks, "run", str(INPUTS / "beam/pendulum.xml"), "--output", output, "--set", f"N={ELEMENTS}",
                    "--set", "Analyses/motion/End Time=0.03", *more, expect=expect)

    def shell(self, ranks, output):
        return self(ranks, "run", str(INPUTS / "shell/hypar.xml"), "--output", output, "--set", f"N={ACROSS}")


def check(runs):
    folder = runs.folder
    runs.deck(1, "1")
    alone = history(folder / "1")
    for ranks in (2, 3):
        text = runs.deck(ranks, str(ranks))
        if f"factors on {ranks} ranks, {6 * (ranks - 1)} unknowns between them" not in text:
            yield f"{ranks} ranks do not factor their own parts:\n{text}"
        found = difference(alone, history(folder / str(ranks)))
        print(f"{ranks} ranks differ from one by {found:.1e}")
        if found > CLOSE:
            yield f"{ranks} ranks differ from one by {found:.2e}, allowed {CLOSE}"

    runs.deck(2, "stopped", "--walltime", "1 us", expect=7)
    shutil.copytree(folder / "stopped", folder / "on one")
    runs(2, "resume", "stopped")
    if (folder / "stopped/history.csv").read_bytes() != (folder / "2/history.csv").read_bytes():
        yield "the resumed run differs from the undisturbed one"
    runs(1, "resume", "on one")
    found = difference(alone, history(folder / "on one"))
    print(f"stopped on two ranks and resumed on one, it differs from one by {found:.1e}")
    if found > CLOSE:
        yield f"the run resumed on one rank differs by {found:.2e}, allowed {CLOSE}"


def check_shell(runs):
    alone, together = (runs.shell(ranks, f"shell {ranks}") for ranks in (1, 2))
    for text in (alone, together):
        if "linear solver: MUMPS, automatic" not in text:
            yield f"the shell is not for MUMPS:\n{text}"
    found = difference(*(history(runs.folder / f"shell {ranks}") for ranks in (1, 2)))
    print(f"a shell on two ranks differs from one by {found:.1e}")
    if found > CLOSE:
        yield f"a shell on two ranks differs from one by {found:.2e}, allowed {CLOSE}"


def check_memory(runs):
    """Factors that do not fit make way for an iteration; what fits in no way is refused, once."""
    def look(ranks, memory, expect=0):
        return runs(ranks, "check", str(INPUTS / "shell/hypar.xml"), "--set", "N=100", "--max-memory", memory, expect=expect)

    for ranks in (1, 2):
        text = look(ranks, "300 MB")
        if "linear solver: Iterative, automatic: factors of" not in text:
            yield f"factors that do not fit on {ranks} ranks are taken all the same:\n{text}"
        if (" on a machine with 2 of 2 processes, up to 0.1" in text) != (ranks == 2):
            yield f"what one of {ranks} processes needs is not said:\n{text}"
        look(ranks, "150 MB", expect=3)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--culm", required=True)
    parser.add_argument("--mpiexec", default="mpiexec")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(options, pathlib.Path(folder))
        complaints = [*check(runs), *check_shell(runs), *check_memory(runs)]
    for complaint in complaints:
        print(complaint)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
