#!/usr/bin/env python3
"""The adapter for OpenFOAM against a process that speaks the flow's side of its file protocol: turns, loads and
motions, ends, mistakes of the inputs, and flow programs that die.

usage: protocol.py    with culm and _culm on PYTHONPATH
"""

import concurrent.futures
import dataclasses
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import culm
import numpy as np
from culm.history import History
from culm.openfoam.rotation import euler_angles

HERE = pathlib.Path(__file__).resolve().parent
TOWER = HERE.parents[2] / "inputs/coupling/openfoam_tower"
STEPS = 8


@dataclasses.dataclass
class Outcome:
    exit: int
    errors: str
    history: History


def make_case(folder, changes):
    """The case of the tower with other entries in its dictionaries, and what an earlier run left."""
    shutil.copytree(TOWER / "case/system", folder / "system")
    for name, value in {"endTime": f"{0.004 * STEPS:g}", **changes}.items():
        for path in (folder / "system/controlDict", folder / "system/lumpedPointMovement"):
            path.write_text(re.sub(rf"^(\s*){name}(\s[^;]*);", rf"\g<1>{name} {value};", path.read_text(), flags=re.M))
    (folder / "comms").mkdir()
    (folder / "comms/forces.out").write_text("points 1 ((0 0 0)); forces 1 ((9e9 0 0)); moments 1 ((0 0 0));")


def start(case, flow, settings=(), options=()):
    command = [sys.executable, "-m", "culm.openfoam", TOWER / "tower.xml", case, "--output", case / "results",
               "--command", f"{sys.executable} {HERE / 'flow.py'} {flow}", *options]
    for setting in (f"end={0.004 * STEPS:g}", *settings):
        command += ["--set", setting]
    return subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def finish(adapter, case):
    _, errors = adapter.communicate()
    check_no_orphans(case / "processes")
    table = case / "results/history.csv"
    return Outcome(adapter.returncode, errors, History(table) if table.exists() else None)


def run(flow, changes=None, settings=(), options=()):
    """The adapter with a flow program, in a folder of its own."""
    with tempfile.TemporaryDirectory(prefix="culm-openfoam-") as path:
        case = pathlib.Path(path)
        make_case(case, changes or {})
        return finish(start(case, flow, settings, options), case)


def check_no_orphans(path):
    if not path.exists():
        return
    for process in path.read_text().split():
        end = time.monotonic() + 30.0  # killed is not gone yet; against what never goes
        while is_alive(process):
            assert time.monotonic() < end, f"process {process} of the flow program outlived the adapter"
            time.sleep(0.01)


def is_alive(process):
    try:
        return "zombie" not in pathlib.Path(f"/proc/{process}/status").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False


def expect(outcome, exit_code, words, rows=None):
    assert outcome.exit == exit_code, f"exit code {outcome.exit} instead of {exit_code}: {outcome.errors}"
    assert words in outcome.errors, f"'{words}' is not in: {outcome.errors}"
    assert "Traceback" not in outcome.errors, outcome.errors
    if rows is not None:
        assert len(outcome.history.levels) == rows, f"{len(outcome.history.levels)} rows instead of {rows}"


def drive_by_hand():
    """The same coupling in one process, without files: place of the tip, and work."""
    tower = culm.Simulation(str(TOWER / "tower.xml"), [f"end={0.004 * STEPS:g}"])
    stepper, port, work = tower.begin(), tower.port("stations"), 0.0
    for step in range(1, STEPS + 1):
        force = np.array([0.2, 0.1, 0.0]) - 40.0 * (port.position - port.reference)
        port.set(force, 0.3 * np.cross(port.rotation[:, :, 2], [0.0, 0.0, 1.0]))
        assert stepper.attempt(0.004 * step)
        work += port.exchange()["work"]
        stepper.accept()
    return tower.quantities()["tip ux [m]"], work


def files_change_nothing():
    """Loads and motions that went through files make the run that they make without."""
    outcome = run("springs")
    expect(outcome, 0, "", STEPS + 1)
    tip, work = drive_by_hand()
    assert abs(tip) > 1e-4 and abs(work) > 1e-5
    assert abs(outcome.history.column("tip ux [m]")[-1] - tip) <= 1e-12 * abs(tip)
    assert abs(outcome.history.column("stations work [J]")[-1] - work) <= 1e-12 * abs(work)


def first_turn_without_loads():
    outcome = run("springs --first-turn-empty")
    expect(outcome, 0, "", STEPS + 1)
    tip = outcome.history.column("tip ux [m]")
    assert tip[1] == 0.0 and tip[2] > 0.0


def smaller_steps_of_the_deck():
    outcome = run("springs", settings=["step=0.001"])
    expect(outcome, 0, "", STEPS + 1)


def added_mass():
    """Light against what moves with it: 1.05 kg/m with a deck of 0.05 kg/m; and heavy."""
    expect(run("added-mass", settings=["mass=0.05"]), 8, "added-mass instability")
    expect(run("added-mass", settings=["mass=20"]), 0, "", STEPS + 1)


def flows_that_fail():
    failed = run("springs --fails exit 4")
    expect(failed, 9, f"step 4 of {STEPS}, from 0.012 s", 4)
    expect(failed, 9, "Maximum number of iterations exceeded")
    expect(run("springs --fails killed 4"), 9, "SIGKILL", 4)
    expect(run("springs --fails silent 4", options=["--patience", "0.5"]), 9, "has not answered for 0.5 s")
    expect(run("springs --fails nan 4"), 5, "point 5", 4)
    expect(run("springs --fails half 4"), 6, "forces.out' ends within", 4)
    expect(run("springs --stations 20"), 9, "forces of 20 stations, of 21", 1)


def adapter_that_is_stopped():
    with tempfile.TemporaryDirectory(prefix="culm-openfoam-") as path:
        case = pathlib.Path(path)
        make_case(case, {})
        adapter = start(case, "springs --fails silent 4")
        while not (case / "results/history.csv").exists() or "0.012" not in (case / "results/history.csv").read_text():
            assert adapter.poll() is None, adapter.stderr.read()
            time.sleep(0.05)
        adapter.send_signal(signal.SIGTERM)
        expect(finish(adapter, case), 7, "stopped", 4)


def ends_that_differ():
    expect(run("springs --steps 5"), 9, "ended at 0.02 s", 6)
    expect(run("springs --steps 9"), 9, "after its 'endTime'", STEPS + 1)
    expect(run("springs", settings=["end=0.02"]), 3, "the analysis ends at 0.02 s", 6)
    expect(run("springs", settings=["end=0.06"]), 3, "the analysis goes on after 0.032 s", STEPS + 1)


def inputs_that_do_not_fit():
    expect(run("springs", settings=["Ports/stations/Number=20"]), 3, "has 20 points", None)
    expect(run("springs", settings=["Ports/stations/Offset={0.01, 0, 0}"]), 3, "point 0 of port 'stations'")
    expect(run("springs", {"relax": "0.9"}), 3, "'relax' is 0.9 and must be 1")
    expect(run("springs", {"startTime": "0.004"}), 3, "starts at 0 s")
    expect(run("springs", {"adjustTimeStep": "yes"}), 3, "'adjustTimeStep' is yes")
    expect(run("springs", {"outputFormat": "plain"}), 3, "'communication/outputFormat' is plain")
    expect(run("springs", {"deltaT": "$step"}), 3, "'deltaT' must be numbers")
    expect(run("springs", options=["--port", "station"]), 2, "did you mean 'stations'?")
    expect(run("springs", options=["--command", "pimpelFoam"]), 6, "cannot start 'pimpelFoam'")


def angles_make_the_rotation():
    """Also where two of three angles are undetermined, and upside down."""
    random = np.random.default_rng(7)
    for size in (0.0, 1e-12, 1e-6, 0.1, 2.0, np.pi):
        axis = random.normal(size=(50, 3))
        turned = np.array([rodrigues(size * a / np.linalg.norm(a)) for a in axis])
        made = np.array([about(2, phi) @ about(0, theta) @ about(2, psi) for phi, theta, psi in euler_angles(turned)])
        assert np.abs(made - turned).max() < 4e-15, (size, np.abs(made - turned).max())


def rodrigues(vector):
    angle = np.linalg.norm(vector)
    x, y, z = vector / angle if angle else (0.0, 0.0, 1.0)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def about(axis, angle):
    return rodrigues(angle * np.eye(3)[axis])


TESTS = (files_change_nothing, first_turn_without_loads, smaller_steps_of_the_deck, added_mass, flows_that_fail,
         adapter_that_is_stopped, ends_that_differ, inputs_that_do_not_fit, angles_make_the_rotation)


def attempt(test):
    try:
        test()
    except AssertionError as error:
        return f"{test.__name__}: {error}"
    return None


def main():
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failed = [text for text in pool.map(attempt, TESTS) if text]
    print(*failed, sep="\n")
    print(f"{len(TESTS) - len(failed)} of {len(TESTS)} hold")
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
