#!/usr/bin/env python3
"""Stops and kills runs, goes on with them, and compares the results with those of a run that nobody
disturbed: all bits must be the same.

usage: resume.py --culm PROGRAM [--kind single|parts] [--mpiexec PROGRAM --ranks N] [--kills N] [--flips N] [--seed N] [--only NAME]
"""

import argparse
import contextlib
import functools
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

import h5py
import numpy

HERE = pathlib.Path(__file__).resolve().parent
INPUTS = HERE.parent.parent / "inputs"
TIME_LIMIT = 600  # s
ABSENT = 9.9692099683868690e+36  # the mark in run.h5 of what is an empty cell in CSV
TIMED = {"report/text", "report/effects"}  # what has times in it, in run.h5


class Failure(Exception):
    pass


def demand(condition, complaint):
    if not condition:
        raise Failure(complaint)


class Program:
    """culm on some ranks, in a folder."""

    def __init__(self, options, folder):
        self.folder = folder
        self.culm = os.path.abspath(options.culm)
        self.mpiexec = [options.mpiexec, "-n", str(options.ranks)] if options.ranks > 1 else []

    def start(self, *words):
        return subprocess.Popen(
            self.mpiexec + [self.culm] + [str(word) for word in words],
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def finish(self, process):
        try:
            out, err = process.communicate(timeout=TIME_LIMIT)
        except subprocess.TimeoutExpired:
            kill_tree(process)
            raise Failure(f"still running after {TIME_LIMIT} s") from None
        return process.returncode, out, err

    def __call__(self, *words, expect=(0,)):
        code, out, err = self.finish(self.start(*words))
        demand(code in expect, f"{words}: exit code {code}, expected {expect}\n{out}{err}")
        return code, out, err


def children(pid):
    """All processes below one."""
    found = []
    for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children"):
        with contextlib.suppress(OSError):
            for child in task.read_text().split():
                found += [int(child)] + children(int(child))
    return found


def kill_tree(process):
    for pid in [process.pid] + children(process.pid):
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)


def cpu_seconds():
    """Of all children that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def wait_for(process, condition, complaint):
    end = time.monotonic() + TIME_LIMIT
    while not condition():
        demand(time.monotonic() < end and process.poll() is None, complaint)
        time.sleep(0.002)


def content(path):
    """Everything in run.h5 by name, as bytes; without what has times in it."""
    found = {}

    def add(name, item):
        if name in TIMED:
            return
        found[name + "@"] = {key: repr(value) for key, value in item.attrs.items()}
        if isinstance(item, h5py.Dataset):
            value = item[()]
            found[name] = value if isinstance(value, bytes) else numpy.asarray(value).tobytes()

    with h5py.File(path, "r") as file:
        file.visititems(add)
    return found


def files(folder):
    return {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}


def differences(expected, found):
    """What two folders of results do not have in common."""
    a, b = content(expected / "run.h5"), content(found / "run.h5")
    names = sorted(a.keys() | b.keys())
    complaints = [f"run.h5/{name}" for name in names if a.get(name) != b.get(name)]
    for name in sorted(files(expected) | files(found)):
        if name.name == "run.h5" or name.name.startswith("run.checkpoint"):
            continue
        both = (expected / name).is_file() and (found / name).is_file()
        if not both or (expected / name).read_bytes() != (found / name).read_bytes():
            complaints.append(str(name))
    return complaints


def demand_same(expected, found):
    complaints = differences(expected, found)
    demand(not complaints, f"{found.name} differs from {expected.name} in {complaints[:10]}")


def memory():
    """A folder in memory, if there is one: there no checkpoint waits for a busy disk."""
    return "/dev/shm" if os.path.isdir("/dev/shm") else None


def run_each(options, trials):
    """Runs each (name, trial) as trial(program, folder) in a folder of its own and prints how it ended.
    Returns the exit code."""
    failed = 0
    for name, trial in trials:
        with tempfile.TemporaryDirectory(prefix="culm-trial-", dir=memory()) as path:
            folder = pathlib.Path(path)
            start = time.monotonic()
            try:
                trial(Program(options, folder), folder)
                outcome = "passed"
            except Failure as failure:
                outcome = f"FAILED: {failure}"
                failed += 1
            print(f"{name}: {outcome} ({time.monotonic() - start:.1f} s)", flush=True)
    return 1 if failed else 0


def settings(*assignments):
    return [word for assignment in assignments for word in ("--set", assignment)]


TORSION = [INPUTS / "joint/torsion.xml", "--quiet"]
LONG = [INPUTS / "body/heavy_top.xml", "--quiet", *settings("Analyses/motion/End Time=600")]
EVERY_STEP = settings("Output/Checkpoint Interval=0")

SHELL = [INPUTS / "shell/tumbling_cylinder.xml", "--quiet"]
SHELL += settings("Analyses/fly/End Time=1.5", "Output/Every=3")

# Enough nodes that each of several ranks writes its own rows of states.
MANY_NODES = [INPUTS / "beam/pendulum.xml", "--quiet"]
MANY_NODES += settings("Structures/beam/Curve/Elements=3000", "Output/Every=3", "Output/Velocities=true")

BROKEN = "statics with a load that moves nothing"  # which is a promise that is broken

# Decks with all that a run remembers: counted turns, drives, multipliers, cut-backs and growth of
# load steps, memory of a scheme, errors of adaptive steps, factors that serve on, internal variables
# of shells, damped velocities, several analyses with other loads and constraints and earlier states.
PARTS = {
    "torsion": TORSION,
    "multipliers": TORSION + settings("Solver/Form=Multipliers"),
    "generalised alpha": TORSION + settings("Analyses/motion/Scheme=Generalised Alpha"),
    "four bars": [
        INPUTS / "joint/four_bar_2.xml",
        "--quiet",
        *settings("Analyses/motion/End Time=0.05"),
    ],
    BROKEN: [
        INPUTS / "beam/lee_frame.xml",
        "--quiet",
        *settings("Analyses/loading/Steps=4", "Loads/P/Node=feet"),
    ],
    "path": [INPUTS / "beam/lee_frame_path.xml", "--quiet", *settings("Analyses/loading/Steps=70")],
    "adaptive steps": TORSION + settings("Analyses/motion/Adaptive/Tolerance=1e-4"),
    "modified newton": TORSION + settings("Analyses/motion/Newton/Refresh=On Slow Convergence"),
    "modified newton in statics": [
        INPUTS / "beam/lee_frame.xml",
        "--quiet",
        *settings("Analyses/loading/Newton/Refresh=On Slow Convergence"),
    ],
    "damped velocities": [
        INPUTS / "flight/rotor_damped.xml",
        "--quiet",
        *settings("Analyses/motion/End Time=0.3"),
    ],
    "shell": SHELL + settings("Solver/Linear Solver=KLU2"),
    "many nodes": MANY_NODES + settings("Analyses/motion/End Time=0.4"),
    "mumps": SHELL + settings("Solver/Linear Solver=MUMPS"),
    "two analyses": TORSION
    + settings("Analyses/more/Type=Dynamic", "Analyses/more/Step=0.02")
    + settings("Analyses/more/End Time=3", "Output/Every=7"),
    "sequence": [
        INPUTS / "sequence/release.xml",
        "--quiet",
        *settings("Analyses/released/Step=10", "Analyses/let down/Steps=3", "Output/Every=3"),
    ],
    # where the mass is factored beside equations that are as large as stiffnesses before
    "motion after statics": [
        INPUTS / "sequence/release.xml",
        "--quiet",
        *settings("Analyses/released/Step=10", "Output/Every=3", "Solver/Form=Multipliers", "Solver/Linear Solver=MUMPS"),
    ],
    "imperfection": [INPUTS / "sequence/bent_column.xml", "--quiet", *settings("Analyses/bent/Final Level=0.7")],
}


# Each start of mpiexec takes its time, so on several ranks only what is shared out in different ways.
# Not MUMPS: there it is not the same itself from run to run.
ON_SEVERAL_RANKS = ("multipliers", "path", "adaptive steps", "shell", "many nodes", "sequence")


def run_in_parts(name, words):
    def test(program, folder, options):
        """Each part has one step, as the time allowed is always over; the last one all others."""
        end, *_ = program("run", *words, "--output", "whole", expect=(0, 8))
        demand((end == 8) == (name == BROKEN), f"exit code {end}")
        code, *_ = program("run", *words, "--output", "parts", "--walltime", "1e-6", expect=(7,))
        parts, most = 1, 8 if options.ranks == 1 else 3  # each start takes its time
        while code == 7:
            walltime = ["--walltime", "1 us"] if parts < most else []
            code, *_ = program("resume", "parts", "--quiet", *walltime, expect=(end, 7))
            parts += 1
        demand(parts > 3, f"only {parts} parts")
        demand_same(folder / "whole", folder / "parts")

    test.__name__ = f"run_in_parts: {name}"
    return test


def what_is_over_is_judged_alike(program, folder, options):
    """Nothing moves but rounding, of which the matrix of the last step tells, that nobody has made again."""
    program("run", INPUTS / "control/pitch_actuator.xml", "--quiet", *settings("Analyses/motion/End Time=0.08"), "--output", "over")
    program("resume", "over", "--quiet")


def signals_stop_within_a_step(program, folder, options):
    for number in (signal.SIGTERM, signal.SIGUSR1):
        process = program.start("run", *LONG, "--output", number.name)
        history = folder / number.name / "history.csv"
        wait_for(process, lambda: history.exists() and history.stat().st_size > 5000, "no steps")
        # the last rank: whoever sees the signal, all stop
        os.kill(([process.pid] + children(process.pid))[-1], number)
        code, _, err = program.finish(process)
        demand(code == 7, f"exit code {code} after {number.name}: {err}")
        demand(f"stopped: signal {number.name}\n" in err, f"stderr is {err}")
        demand(f"Go on with: culm resume {number.name}\n" in err, f"stderr is {err}")
        with h5py.File(folder / number.name / "run.h5") as file:
            demand(b"stopped: signal" in file["report/text"][()], "the report does not say so")


def signals_that_come_early_are_heard(program, folder, options):
    """While the program starts, and with several processes MPI, which has threads of its own by then: as with a signal that a
    batch system sends to all."""
    process = program.start("run", *LONG, "--output", "early")

    def threads(pid):
        with contextlib.suppress(OSError):
            return len(list(pathlib.Path(f"/proc/{pid}/task").iterdir()))
        return 0

    def heeds_signal(pid):
        caught = re.search(r"SigCgt:\s*(\w+)", pathlib.Path(f"/proc/{pid}/status").read_text()).group(1)
        return int(caught, 16) >> (signal.SIGUSR1 - 1) & 1 == 1

    def culm():
        return ([process.pid] + children(process.pid))[-1]

    def is_starting():
        with contextlib.suppress(OSError):
            is_culm = "culm" in os.readlink(f"/proc/{culm()}/exe")
            return is_culm and (heeds_signal(culm()) if options.ranks == 1 else threads(culm()) > 1)
        return False

    wait_for(process, is_starting, "no start")
    os.kill(culm(), signal.SIGUSR1)
    code, _, err = program.finish(process)
    demand(code == 7, f"exit code {code}: {err}")
    demand("stopped: signal SIGUSR1\n" in err, f"stderr is {err}")


def time_allowed_is_kept(program, folder, options):
    before = cpu_seconds()
    _, _, err = program("run", *LONG, "--output", "out", "--walltime", "00:01", expect=(7,))
    demand("stopped: the time allowed is over\n" in err, f"stderr is {err}")
    # time that is over on the wall cannot be more on the processors, however busy they are
    demand(cpu_seconds() - before < 4.0 * options.ranks, "it took too long")
    _, _, err = program("run", *LONG, "--output", "out", "--walltime", "soon", expect=(2,))
    demand("--walltime needs a time such as" in err, f"stderr is {err}")


def later_end(program, folder, options):
    """A finished run goes on to a later end, with other tolerances, and with an edited deck."""
    end = settings("Analyses/motion/End Time=3")
    program("run", *TORSION, *end, "--output", "whole")
    program("run", *TORSION, "--output", "parts")
    tolerance = settings("Analyses/motion/Newton/Maximum Iterations=30")
    program("resume", "parts", "--quiet", *end, *tolerance)
    complaints = differences(folder / "whole", folder / "parts")
    demand(complaints == ["run.h5/deck/xml"], f"the longer run differs in {complaints}")
    deck = (INPUTS / "joint/torsion.xml").read_text()
    longer = deck.replace('"End Time" value="2"', '"End Time" value="4"')
    demand(longer != deck, "the end time of torsion.xml is not 2")
    (folder / "longer.xml").write_text(longer)
    program("resume", "parts", "--quiet", "--deck", "longer.xml")
    last = (folder / "parts/history.csv").read_text().splitlines()[-1]
    demand(float(last.split(",")[0]) == 4.0, f"the last step is {last}")


def other_model_is_refused(program, folder, options):
    program("run", *TORSION, "--output", "out")
    before = {name: (folder / "out" / name).read_bytes() for name in files(folder / "out")}

    def refuse(assignments, *says):
        _, _, err = program("resume", "out", *settings(*assignments), expect=(3,))
        for text in says:
            demand(err.count(text) == 1, f"{assignments}: stderr has not '{text}':\n{err}")

    refuse(
        ["Structures/spun/Mass=2", "Constraints/spun/Axis={0, 1, 0}"],
        "Structures / spun / Mass: 'Mass' was 1 in the run and is 2 now\n",
        "Constraints / spun / Axis: 'Axis' was {0, 0, 1} in the run and is {0, 1, 0} now\n",
    )
    mass = ["Masses/more/Type=Point Mass", "Masses/more/Node=led", "Masses/more/Mass=1"]
    refuse(mass, "Masses / more: was not in the run\n")
    refuse(
        ["Analyses/motion/Scheme=Generalised Alpha"],
        "'Scheme' was Conserving in the run and is Generalised Alpha now\n",
    )
    refuse(["Analyses/motion/End Time=1"], "the run has reached 2, got 1\n")
    after = {name: (folder / "out" / name).read_bytes() for name in files(folder / "out")}
    demand(before == after, "a resume that was refused changed files")


def damaged_checkpoints(program, folder, options):
    program("run", *TORSION, *EVERY_STEP, "--output", "whole")
    newest, older = (folder / "whole" / name for name in ("run.checkpoint", "run.checkpoint.old"))
    demand(older.is_file(), "there is only one checkpoint")
    sound = newest.read_bytes()
    for complaint, content in {
        "is no checkpoint": b"",
        "was cut off": sound[:-1],
        "is damaged": sound[:-9] + bytes([sound[-9] ^ 1]) + sound[-8:],
    }.items():
        shutil.rmtree(folder / "parts", ignore_errors=True)
        shutil.copytree(folder / "whole", folder / "parts")
        (folder / "parts/run.checkpoint").write_bytes(content)
        _, _, err = program("resume", "parts", "--quiet")
        demand("warning: parts/run.checkpoint: " + complaint in err, f"no warning: {err}")
        demand("going on from parts/run.checkpoint.old" in err, f"no way out: {err}")
        demand_same(folder / "whole", folder / "parts")
    for name in ("run.checkpoint", "run.checkpoint.old"):
        (folder / "parts" / name).write_bytes(b"")
    _, _, err = program("resume", "parts", expect=(6,))
    demand("run.checkpoint.old: is no checkpoint" in err, f"stderr is {err}")
    (folder / "empty").mkdir()
    _, _, err = program("resume", "empty", expect=(6,))
    demand("empty: there is no checkpoint" in err, f"stderr is {err}")
    shutil.copy(newest, folder / "empty")
    _, _, err = program("resume", "empty", expect=(6,))
    demand("empty/run.h5" in err, f"stderr is {err}")


def bytes_of(folder):
    return {name: (folder / name).read_bytes() for name in files(folder)}


def refuse(program, folder, complaint):
    """A resume that says why not, and changes nothing."""
    before = bytes_of(folder)
    _, _, err = program("resume", folder.name, expect=(6,))
    demand(complaint in err, f"stderr is {err}")
    demand(bytes_of(folder) == before, f"a resume of {folder.name} that was refused changed files")


def foreign_checkpoints(program, folder, options):
    """What belongs to another run is refused, also if that had the same deck."""
    for name, more in {"own": [], "twin": [], "other": settings("Structures/spun/Mass=2")}.items():
        program("run", *TORSION, *more, "--output", name)
    for name in ("twin", "other"):
        (folder / "own/run.checkpoint.old").unlink(missing_ok=True)
        shutil.copy(folder / name / "run.checkpoint", folder / "own")
        refuse(program, folder / "own", "own/run.h5: is not the result file of this checkpoint: ")


def changed_table(program, folder, options):
    """A table that a deck reads belongs to its model."""
    deck = (INPUTS / "beam/load_functions.xml").read_text()
    shutil.copytree(INPUTS / "beam", folder / "decks")
    (folder / "decks/deck.xml").write_text(deck)
    tables = re.findall(r'"File Name" value="(.*?)"', deck)
    demand(tables, "the deck reads no table")
    program("run", "decks/deck.xml", "--output", "out")
    table = folder / "decks" / tables[0]
    lines = table.read_text().splitlines()
    lines[-1] = re.sub(r",.*", ",0.123", lines[-1])
    table.write_text("\n".join(lines) + "\n")
    refuse(program, folder / "out", "the checkpoint belongs to another model")


def changed_neighbour(program, folder, options):
    """So do files that potential flow reads beside the one that the deck names."""
    shutil.copytree(INPUTS / "water", folder / "decks")
    program("run", "decks/potential_cylinder.xml", *settings("end=0.2"), "--output", "out")
    waves = folder / "decks/cylinder.3"
    waves.write_text(waves.read_text().replace(" 1 5.386", " 1 6.386", 1))
    refuse(program, folder / "out", "the checkpoint belongs to another model")


def flip_bit(path, chance):
    raw = bytearray(path.read_bytes())
    bit = chance.randrange(8 * len(raw))
    raw[bit // 8] ^= 1 << bit % 8
    path.write_bytes(raw)
    return bit


def start_from_another_run(program, folder, options):
    """'Start From' takes the newest state of a run with the same structures, whole, or nothing."""
    # where the angle that is led has stopped
    start = settings("Analyses/motion/Start From=other", "Analyses/motion/Start Time=2", "Analyses/motion/End Time=4")

    def refuse_start(complaint, *more, expect=6):
        _, _, err = program("run", *TORSION, *start, *more, "--output", "out", expect=(expect,))
        demand(complaint in err, f"stderr is {err}")

    program("run", *TORSION, *EVERY_STEP, "--output", "other")
    shutil.copytree(folder / "other", folder / "sound")
    program("run", *TORSION, *start, "--output", "out")
    expected = (folder / "out/history.csv").read_bytes()
    refuse_start("other nodes in the reference", *settings("Structures/spun/Position={0, 0, 1.1}"), expect=3)
    renamed = (INPUTS / "joint/torsion.xml").read_text().replace("led", "let")
    (folder / "renamed.xml").write_text(renamed)
    _, _, err = program("run", "renamed.xml", "--quiet", *start, "--output", "out", expect=(3,))
    demand("no structure 'let'" in err, f"stderr is {err}")
    chance = random.Random(options.seed)
    for name in ["run.checkpoint"] + options.flips * ["run.h5"]:
        shutil.rmtree(folder / "other")
        shutil.copytree(folder / "sound", folder / "other")
        bit = flip_bit(folder / "other" / name, chance)
        code, _, err = program("run", *TORSION, *start, "--output", "out", expect=(0, 6))
        demand(name != "run.checkpoint" or code == 6, "a damaged checkpoint was taken, or an older one")
        if code == 0:
            demand((folder / "out/history.csv").read_bytes() == expected, f"bit {bit} of {name}: {err}")
    program("run", *TORSION, "--output", "twin")
    shutil.copy(folder / "twin/run.checkpoint", folder / "other")
    shutil.copy(folder / "sound/run.h5", folder / "other")
    refuse_start("other/run.h5: is not the result file of this checkpoint: ")
    (folder / "other/run.checkpoint").write_bytes(b"no checkpoint")
    refuse_start("'Start From' may name other/run.checkpoint.old")


def start_from_another_run_remembers(program, folder, options):
    """What flowed, or slid, goes on in another run; what has no counterpart there is told."""
    def last(name):
        return (folder / name / "history.csv").read_text().splitlines()[-1].split(",")[:4]

    for deck, analysis, half, end in (("contact/dragged_bar.xml", "pulling", 1, 2), ("plasticity/bent_bar.xml", "bending", 0.5, 1)):
        path, levels = INPUTS / deck, f"Analyses/{analysis}"
        program("run", path, *settings(f"{levels}/Final Level={half}", f"{levels}/Steps=5"), "--output", "half")
        split = settings(f"{levels}/Start From=half", f"{levels}/Start Level={half}", f"{levels}/Final Level={end}", f"{levels}/Steps=5")
        program("run", path, *split, "--output", "rest")
        program("run", path, *settings(f"{levels}/Final Level={end}", f"{levels}/Steps=10"), "--output", "whole")
        demand(last("rest") == last("whole"), f"{deck}: {last('rest')}, in one run {last('whole')}")
    _, _, err = program("run", path, *split, *settings("Sections/steel/Plasticity/Cells={10, 1}"), "--output", "rest")
    demand("'Start From' of 'bending' leaves out what Plasticity, bar remembers" in err, f"stderr is {err}")


def start_from_another_run_keeps_signals(program, folder, options):
    """Integrals, lags and controllers go on in another run; one that has no counterpart there is told."""
    path, end = INPUTS / "control/speed_control.xml", "Analyses/motion/End Time"
    times, later = settings(f"{end}=2"), settings("Analyses/motion/Start From=half", "Analyses/motion/Start Time=1")

    def numbers(name):
        return numpy.loadtxt(folder / name / "history.csv", delimiter=",", skiprows=1)[:, :-2]

    program("run", path, *settings(f"{end}=1"), "--output", "half")
    program("run", path, *times, *later, "--output", "rest")
    program("run", path, *times, "--output", "whole")
    rest = numbers("rest")
    whole = numbers("whole")[-len(rest):]
    # velocities begin anew from those of the state, which are right to second order in the step
    demand(numpy.abs(rest - whole).max() < 1e-5 * numpy.abs(whole).max(), f"{rest[:3]}, in one run {whole[:3]}")
    text = path.read_text().replace('"motor"', '"engine"')
    (folder / "renamed.xml").write_text(text)
    _, _, err = program("run", "renamed.xml", *times, *later, "--output", "rest")
    demand("'Start From' of 'motion' leaves out what Lag 'motor' remembers" in err, f"stderr is {err}")


def start_from_another_run_counts_turns(program, folder, options):
    """The quantity 'Joint Angle' goes on counting in another run; that nobody watched it there is told."""
    far = settings("Constraints/lead/Angle=9")
    start = far + settings("Analyses/motion/Start From=half", "Analyses/motion/Start Time=2", "Analyses/motion/End Time=4")
    program("run", *TORSION, *far, "--output", "half")
    _, _, err = program("run", *TORSION, *start, "--output", "rest")
    names, *_, last = (line.split(",") for line in (folder / "rest/history.csv").read_text().splitlines())
    angle = float(last[names.index("led angle [rad]")])
    demand(abs(angle - 9.0) < 1e-6 and "turns" not in err, f"turned by {angle} rad, not 9; stderr is {err}")
    text = (INPUTS / "joint/torsion.xml").read_text().replace('"led angle"', '"turn"')
    (folder / "renamed.xml").write_text(text)
    _, _, err = program("run", "renamed.xml", "--quiet", *start, "--output", "rest")
    demand("History 'turn' counts turns from here" in err, f"stderr is {err}")


def start_from_a_run_that_ends_with_modes(program, folder, options):
    """What looks at a state comes after the last step, whose end another run can start from."""
    path, levels = INPUTS / "modes/rotating_beam.xml", "Analyses/spin"
    program("run", path, *settings(f"{levels}/Final Level=0.5", f"{levels}/Steps=6"), "--output", "half")
    end = settings(f"{levels}/Start From=half", f"{levels}/Start Level=0.5", f"{levels}/Steps=6")
    program("run", path, *end, "--output", "rest")
    program("run", path, "--output", "whole")

    def numbers(name):
        return numpy.loadtxt(folder / name / "history.csv", delimiter=",", skiprows=1)[-1, :-2]

    rest, whole = numbers("rest"), numbers("whole")
    demand(numpy.abs(rest - whole).max() <= 1e-9 * numpy.abs(whole).max(), f"{rest}, in one run {whole}")


def partners_stay_where_they_are(program, folder, options):
    """'Start From' takes no partner of a coupling along, which is told, in a run and from another one."""
    path = INPUTS / "coupling/partners.xml"
    name, kind = "motion", '<Parameter name="Type" value="Dynamic"/>'
    program("run", path, *settings(f"Analyses/{name}/End Time=0.06"), "--output", "half")
    later = settings(f"Analyses/{name}/Start From=half", f"Analyses/{name}/Start Time=0.06", f"Analyses/{name}/End Time=0.08")
    _, _, err = program("run", path, *later, "--output", "rest")
    demand("does not take what the partners of that run remember: those of this one begin anew" in err, f"stderr is {err}")
    text = path.read_text()
    again = (f'<ParameterList name="again">{kind}<Parameter name="Start From" value="Reference"/><Parameter name="Start Time" value="0"/>'
             '<Parameter name="End Time" value="0.02"/><Parameter name="Step" value="0.001"/></ParameterList>')
    end = text.index("</ParameterList>", text.index(f'<ParameterList name="{name}">', text.index('name="Analyses"'))) + len("</ParameterList>")
    (folder / "again.xml").write_text(text[:end] + again + text[end:])
    _, _, err = program("run", "again.xml", *settings(f"Analyses/{name}/End Time=0.02"), "--output", "again")
    demand("'Start From' of 'again' takes the structure to another state and leaves the partners as they are" in err, f"stderr is {err}")


def flipped_bits(program, folder, options):
    """A bit that turned over in run.h5 or a checkpoint is found, or changes nothing."""
    program("run", *TORSION, "--output", "whole")
    program("run", *TORSION, "--output", "stopped", "--walltime", "1e-6", expect=(7,))
    refused = 0
    chance = random.Random(options.seed)
    for _ in range(options.flips):
        shutil.rmtree(folder / "parts", ignore_errors=True)
        shutil.copytree(folder / "stopped", folder / "parts")
        path = folder / "parts" / chance.choice(["run.h5", "run.h5", "run.checkpoint"])
        bit = flip_bit(path, chance)
        before = bytes_of(folder / "parts")
        code, _, err = program("resume", "parts", "--quiet", expect=(0, 6))
        if code == 0:
            demand_same(folder / "whole", folder / "parts")
        else:
            refused += 1
            demand(bytes_of(folder / "parts") == before, f"bit {bit} of {path.name}: {err}")
    print(f"{refused} of {options.flips} flipped bits refused, the others harmless")


def checkpoints_can_be_switched_off(program, folder, options):
    off = settings("Output/Checkpoints=false")
    program("run", *TORSION, "--output", "out")
    demand((folder / "out/run.checkpoint").exists(), "there is no checkpoint at the end")
    program("run", *TORSION, *off, "--output", "out")
    _, _, err = program("run", *LONG, *off, "--output", "out", "--walltime", "1e-6", expect=(7,))
    demand("There is no checkpoint" in err, f"stderr is {err}")
    left = list((folder / "out").glob("*checkpoint*"))
    demand(not left, f"left behind: {left}")


def other_number_of_processes(program, folder, options):
    """Goes on, and says that the last digits will differ."""
    program("run", *TORSION, "--output", "whole")
    program("run", *TORSION, "--output", "parts", "--walltime", "1e-6", expect=(7,))
    launcher = program.mpiexec
    program.mpiexec = [] if launcher else [options.mpiexec, "-n", "2"]
    _, _, err = program("resume", "parts", "--quiet")
    said = "the run had {} and goes on with {}".format(
        *(("2 processes", 1) if launcher else ("1 process", 2))
    )
    demand(said in err, f"stderr is {err}")
    whole, parts = (
        numpy.loadtxt(folder / name / "history.csv", delimiter=",", skiprows=1)
        for name in ("whole", "parts")
    )
    demand(whole.shape == parts.shape, "the numbers of steps differ")
    demand(numpy.abs(whole - parts).max() < 1e-9, "the results differ")


def living_run_is_left_alone(program, folder, options):
    process = program.start("run", *LONG, *EVERY_STEP, "--output", "out")
    try:
        wait_for(process, (folder / "out/run.checkpoint").exists, "no checkpoint")
        for words in (["resume", "out"], ["run", *TORSION, "--output", "out"]):
            _, _, err = program(*words, expect=(6,))
            demand("out: another run writes here: process " in err, f"stderr is {err}")
            demand("; wait for its end, or take another folder\n" in err, f"stderr is {err}")
        demand(process.poll() is None, "the run has ended")
    finally:
        kill_tree(process)
        process.communicate()


def journal_is_void(folder):
    journal = folder / "run.h5.journal"
    return not journal.exists() or journal.read_bytes()[:8] in (b"", bytes(8))


def check_killed(folder):
    """Files of a run that was ended: they can be read, and agree with each other as far as the last commit
    of run.h5. Returns the number of steps."""
    for name in ("run.checkpoint", "run.checkpoint.old"):
        path = folder / name
        if path.exists():
            # the header states the length; culm checks the rest
            raw = path.read_bytes()
            # length of the content, and count of the numbers behind it
            header = struct.unpack("<5Q", raw[:40]) if len(raw) >= 40 else (0,) * 5
            whole = header[0] != 0 and header[1] + 8 * header[3] == len(raw) - 40
            demand(whole, f"{name} is not whole")
    text = (folder / "history.csv").read_text()
    demand(text.endswith("\n"), "the last line of history.csv was cut off")
    lines = text.splitlines()
    demand(len({line.count(",") for line in lines}) == 1, "history.csv is no table")
    rows = len(lines) - 1
    if journal_is_void(folder):  # otherwise culm recovers the commit that was cut off
        with h5py.File(folder / "run.h5", "r") as file:
            table = file["history/values"][()]
            demand(len(table) <= rows + 1, f"{rows} rows in CSV, {len(table)} in run.h5")
            for line, row in zip(lines[1:], table):
                cells = [float(cell) if cell else ABSENT for cell in line.split(",")]
                demand(cells == row.tolist(), f"CSV and run.h5 differ: {line}")
            for step in file["steps"].values():
                for table in step.values():
                    table[()]
    return rows - 1


def interrupt(process):
    """As a terminal does: all processes in the foreground get it."""
    for pid in [process.pid] + children(process.pid):
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGINT)


def terminate(process):
    """One rank alone: it stops all others after the step, or at once where the run has not begun."""
    with contextlib.suppress(ProcessLookupError):
        os.kill(([process.pid] + children(process.pid))[-1], signal.SIGTERM)


ENDS = [kill_tree, terminate, interrupt]


def end_at_random(process, end, history, whole_size, generator):
    """Once in four times during the start or soon after it, otherwise when the history has grown by a
    random part of the whole: so runs get on and are killed in their midst at any speed."""
    if generator.random() < 0.25:
        time.sleep(generator.uniform(0.0, 0.4))
    else:

        def size():
            return history.stat().st_size if history.exists() else 0

        enough = size() + generator.uniform(0.0, 0.5) * whole_size
        limit = time.monotonic() + TIME_LIMIT
        while size() < enough and process.poll() is None and time.monotonic() < limit:
            time.sleep(0.001)
    end(process)


KILLED = {
    "torsion": [
        INPUTS / "joint/torsion.xml",
        *settings("Output/Every=10", "Analyses/motion/Step=4e-3"),
    ],
    "shell": [
        INPUTS / "shell/tumbling_cylinder.xml",
        *settings("Output/Every=3", "Analyses/fly/End Time=1.5", "Solver/Linear Solver=KLU2"),
    ],
    "many nodes": MANY_NODES + settings("Analyses/motion/End Time=1"),
}


def kills(name):
    def test(program, folder, options):
        """Ends a run at random moments, in turn by SIGKILL, SIGTERM and SIGINT. Each resume goes on
        where the one before was."""
        words = KILLED[name] + EVERY_STEP
        whole, parts = folder / "whole", folder / "parts"
        program("run", *words, "--output", "whole")
        generator = random.Random(options.seed)
        done = resumed = ends = 0
        steps = None  # on disk after the last kill
        while done < options.kills or parts.exists():
            last = done >= options.kills
            resumes = any((parts / f"run.checkpoint{old}").exists() for old in ("", ".old"))
            begin = ["run", *words, "--output", "parts"]
            process = program.start(*(["resume", "parts"] if resumes else begin))
            if not last:
                history = parts / "history.csv"
                whole_size = (whole / "history.csv").stat().st_size
                end_at_random(process, ENDS[done % len(ENDS)], history, whole_size, generator)
            code, out, err = program.finish(process)
            demand(code == 0 or not last, f"exit code {code}: {out}{err}")
            demand(code not in range(2, 7), f"exit code {code} of a run that was ended: {out}{err}")
            demand("damaged" not in err and "cut off" not in err and "holds" not in err, err)
            if "going on from" in out and steps is not None:
                taken = int(out.split("after ")[1].split()[0])
                demand(taken >= steps - 1, f"{steps} steps were done, it goes on after {taken}")
                resumed += 1
            if code == 0:
                demand_same(whole, parts)
                shutil.rmtree(parts)
                steps = None
                ends += 1
                if last:
                    break
                continue
            done += 1
            if (parts / "history.csv").exists():
                steps = check_killed(parts)
        demand(options.kills < 8 or resumed > 0, "no resume got as far as to be killed")
        print(f"{done} kills, {resumed} resumes, {ends} ends, all like the whole run")

    test.__name__ = f"kills: {name}"
    return test


def tests(options):
    """The trials of one kind; on several ranks those of PARTS and KILLED that differ there."""
    parts, killed = ([name for name in names if options.ranks == 1 or name in ON_SEVERAL_RANKS] for names in (PARTS, KILLED))
    if options.kind == "parts":
        return [run_in_parts(name, PARTS[name]) for name in parts] + [kills(name) for name in killed]
    return SINGLE + [run_in_parts(parts[0], PARTS[parts[0]])]


SINGLE = [
    what_is_over_is_judged_alike,
    signals_stop_within_a_step,
    signals_that_come_early_are_heard,
    time_allowed_is_kept,
    later_end,
    other_model_is_refused,
    damaged_checkpoints,
    foreign_checkpoints,
    changed_table,
    changed_neighbour,
    start_from_another_run,
    start_from_another_run_remembers,
    start_from_another_run_keeps_signals,
    start_from_another_run_counts_turns,
    start_from_a_run_that_ends_with_modes,
    partners_stay_where_they_are,
    flipped_bits,
    checkpoints_can_be_switched_off,
    other_number_of_processes,
    living_run_is_left_alone,
]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--kind", choices=["single", "parts"], default="single",
                        help="single trials, or runs of many models in parts and with kills")
    parser.add_argument("--kills", type=int, default=8)
    parser.add_argument("--flips", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="tests whose name has this in it")
    options = parser.parse_args()
    # a shell that starts this in the background lets it and its children ignore SIGINT
    signal.signal(signal.SIGINT, signal.default_int_handler)
    chosen = [test for test in tests(options) if options.only in test.__name__]
    return run_each(options, [(test.__name__, functools.partial(test, options=options)) for test in chosen])


if __name__ == "__main__":
    sys.exit(main())
