#!/usr/bin/python3
"""Studies of cost and accuracy: orders, references, advice. Page: doc/verification/studies.md.

--plot doc/verification makes the studies of the page and puts their pictures and pages there.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile

from verify import main  # finds the next one, too

from culm_runs import MPI_ENVIRONMENT, ROOT

ROLL_UP = "inputs/beam/roll_up.xml --set Structures/beam/Curve/Elements=8"
FLIGHT = "inputs/flight/spaghetti_3d.xml --set Structures/beam/Curve/Elements=10"
TURBINE = "inputs/turbine/nrel5mw/turbine_operation.xml --set T=4 --set stop=6 --set end=12"

# As they stand on the page: name, command, targets one after the other.
PAGES = {
    "roll_up": (
        f"{ROLL_UP} --vary mesh=2:64*2 element=Director-1,Director-2,Director-3,Helical --watch tip",
        [],
    ),
    "spaghetti": (
        f"{FLIGHT} --vary step=0.1:0.00625/2 mesh=1:16*2 scheme=Conserving,Generalised-Alpha "
        "--watch 'other end' --hold-out 'loaded end'",
        [1e-2, 3e-3, 3e-4, 1e-3],
    ),
    "hemisphere": (
        "inputs/shell/pinched_hemisphere.xml --vary mesh=1:8*2 membrane=None,4,7 "
        "--watch outward --hold-out inward",
        [3e-2, 1e-2, 3e-3],
    ),
    "turbine": (
        f"{TURBINE} --vary step=0.04:0.005/2 mesh=1:4*2 order=1,2 "
        "--watch 'tower top' 'blade 1 tip' --hold-out 'blade 2 tip' 'tower base'",
        [3e-3, 3e-4, 1e-3],
    ),
    "turbine_fidelity": (
        f"{TURBINE} --vary step=0.04:0.005/2 fidelity=Full,Kirchhoff,Linear,Rigid "
        "--watch 'tower top' 'blade 1 tip' --hold-out 'blade 2 tip'",
        [],
    ),
}


class Studies:
    """Runs `culm study` in a folder of its own, with inputs/ in it."""

    def __init__(self, program, folder):
        self.program = os.path.abspath(program)
        self.folder = pathlib.Path(folder)
        (self.folder / "inputs").symlink_to(ROOT / "inputs")

    def run(self, name, words, target=None):
        """What it prints; its files are in studies/<name>."""
        command = [self.program, "study", *shlex.split(words)]
        if target:
            command += ["--target", f"{target:g}"]
        done = subprocess.run(
            [*command, "--output", f"studies/{name}"],
            cwd=self.folder,
            capture_output=True,
            text=True,
            env={**os.environ, **MPI_ENVIRONMENT},
        )
        if done.returncode != 0:
            raise RuntimeError(f"{words}: {done.stderr}")
        return done.stdout

    def file(self, name, file):
        return self.folder / "studies" / name / file


def order(output, of, *values):
    """The observed order of the line that has these values."""
    for line in output.splitlines():
        if line.startswith(f"order in {of}: ") and all(value in line for value in values):
            return float(line.split(": ")[1].split()[0].rstrip(","))
    raise RuntimeError(f"no order in {of} of {values} in\n{output}")


def promise(output):
    """Promised and measured error, and those that were held out by name."""
    line = next(one for one in output.splitlines() if "target.xml, error at most" in one)
    found = re.search(r"promised error (\S+) at .*; measured (\S+) at", line)
    held_out = re.findall(r"([^,;:]+?) (\d\S*)(?=,|$)", line.partition("held out:")[2])
    return float(found[1]), float(found[2]), {name.strip(): float(value) for name, value in held_out}


def verify(culm, report):
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        studies = Studies(culm.program, folder)
        verify_roll_up(studies, report)
        verify_flight(studies, report)
        verify_shells(studies, report)
        verify_hemisphere(studies, report)


def fine(culm, report):
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        verify_turbine(Studies(culm.program, folder), report)
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        verify_hemisphere(Studies(culm.program, folder), report, (3e-2, 1e-2), finer=1)


def verify_roll_up(studies, report):
    report.title("Roll-up: orders in mesh, and the reference beside the exact circle")
    output = studies.run(
        "roll_up", f"{ROLL_UP} --vary mesh=4:32*2 element=Director-1,Director-2,Director-3 --watch tip --repeat 1"
    )
    for element, expected in (("Director 1", 2.0), ("Director 2", 4.0), ("Director 3", 4.0)):
        report.check(f"order of {element}", order(output, "mesh", element), expected, 0.1)
    uncertainty = float(re.search(r"its own uncertainty is (\S+)\.", output)[1])
    rows = studies.file("roll_up", "reference.csv").read_text().splitlines()
    tip = [float(number) for number in rows[-1].split(",")[1:]]
    report.relative("tip of the reference [m]", tip, [-10.0, 0.0, 0.0], max(uncertainty, 1e-9))
    report.holds("uncertainty", uncertainty, 1e-7)

    # in the same folder: its runs are there already
    output = studies.run("roll_up", f"{ROLL_UP} --vary mesh=4:32*2 element=Director-1 --watch tip --repeat 1")
    uncertainty = float(re.search(r"its own uncertainty is (\S+)\.", output)[1])
    rows = studies.file("roll_up", "reference.csv").read_text().splitlines()
    tip = [float(number) for number in rows[-1].split(",")[1:]]
    report.relative("tip of the reference by order 1 alone [m]", tip, [-10.0, 0.0, 0.0], uncertainty)
    report.holds("uncertainty", uncertainty, 1e-3)


def verify_flight(studies, report):
    report.title("Flying spaghetti: orders in step, and what the advice is worth")
    words = (
        f"{FLIGHT} --vary step=0.1:0.0125/2 mesh=1:4*2 scheme=Conserving,Generalised-Alpha "
        "--watch 'other end' --hold-out 'loaded end' --repeat 1"
    )
    for target in (1e-2, 3e-3):
        output = studies.run("flight", words, target)
        check_promise(report, output, target)
    for scheme in ("Conserving", "Generalised Alpha"):
        report.check(f"order of {scheme}", order(output, "step", scheme), 2.0, 0.1)


def verify_shells(studies, report):
    report.title("Shells: order in mesh of a strip that is rolled up, for two sets of enhanced strains")
    output = studies.run(
        "strip",
        "inputs/shell/strip_rolled_up.xml --vary mesh=1:4*2 membrane=None,4 --watch tip --repeat 1 --finer 0",
    )
    for membrane in ("None", "4"):
        report.check(f"order with membrane={membrane}", order(output, "mesh", membrane), 2.0, 0.1)


def verify_hemisphere(studies, report, targets=(1e-2,), finer=0):
    report.title("Pinched hemisphere: what the advice is worth")
    words = (
        "inputs/shell/pinched_hemisphere.xml --vary mesh=1:4*2 membrane=4,7 "
        f"--watch outward --hold-out inward --repeat 1 --finer {finer}"
    )
    for target in targets:
        check_promise(report, studies.run("hemisphere", words, target), target)


def verify_turbine(studies, report):
    report.title("Turbine, emergency stop: order in step, and what the advice is worth")
    words = (
        f"{TURBINE} --vary step=0.04:0.01/2 --watch 'blade 1 tip' --hold-out 'blade 2 tip' --repeat 1"
    )
    output = studies.run("turbine", words)
    report.check("order", order(output, "step"), 2.0, 0.1)
    for target in (3e-4, 1e-4):
        check_promise(report, studies.run("turbine", words, target), target)


def check_promise(report, output, target):
    """The deck keeps its promise within a factor of two, also in what no choice depended on."""
    promised, measured, held_out = promise(output)
    report.holds(f"target {target:g}: promised {promised:.2e}, measured {measured:.2e}: the larger", max(promised, measured), target)
    for name, error in held_out.items():
        report.holds(f"{name}, held out, {error:.2e}: factor off the promise", max(error / promised, promised / error), 2.0)


def plot(culm, path):
    """Makes what the page shows."""
    pages = pathlib.Path(path)
    (pages / "studies").mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        studies = Studies(culm.program, folder)
        for name, (words, targets) in PAGES.items():
            for target in targets or [None]:
                print(f"\n{name}, target {target}\n{studies.run(name, words, target)}", flush=True)
            shutil.copy(studies.file(name, "study.png"), pages / f"plots/study_{name}.png")
            shutil.copy(studies.file(name, "study.html"), pages / f"studies/{name}.html")


main(verify, plot, fine)
