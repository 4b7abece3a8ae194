#!/usr/bin/env python3
"""Runs the cases of a table: each is a deck and a command line, with exit code and text to expect.

usage: driver.py --culm PROGRAM [--mpiexec PROGRAM --ranks N] [--only NAME] TABLE.py

The table defines CASES, a list of Case. Every case runs in an empty folder of its own. With
--ranks the cases that ask for it run on so many processes, and must print the same text once.
--only shows what cases with NAME in their name print, too.
"""

import argparse
import base64
import concurrent.futures
import dataclasses
import importlib.util
import os
import pathlib
import re
import resource
import shlex
import struct
import subprocess
import sys
import tempfile
import typing
import xml.etree.ElementTree as ElementTree

HERE = pathlib.Path(__file__).resolve().parent
BASE = (HERE / "base.xml").read_text()
TIME_LIMIT = 300  # s; against runs that hang: one of base.xml takes a tenth of a second


@dataclasses.dataclass
class Case:
    name: str
    exit: int
    # The deck is base.xml with each (old, new) replaced; old must stand there exactly once. In the
    # expected text {line} is the line where the last of these begins in deck.xml, or that of the
    # mark @@ in it.
    change: list = dataclasses.field(default_factory=list)
    # Or the deck as a whole; None for no deck.
    deck: typing.Union[str, bytes, None] = BASE
    files: dict = dataclasses.field(default_factory=dict)  # further files: text by name
    args: str = "run deck.xml --output out"  # {folder} is the folder of the case
    cwd: typing.Optional[str] = None  # where it runs; by default the folder of the case
    errors: typing.Optional[list] = None  # all lines of stderr, one by one; ... is any end
    says: list = dataclasses.field(default_factory=list)  # each exactly once in stderr
    never: list = dataclasses.field(default_factory=list)  # neither in stderr nor in stdout
    prints: list = dataclasses.field(default_factory=list)  # each exactly once in stdout
    silent: typing.Optional[bool] = None  # whether stdout is empty; by default if exit is not 0
    results: typing.Optional[str] = None  # folder with sound results; without it nothing is written
    last_level: typing.Optional[float] = None  # of the results
    leaves: list = dataclasses.field(default_factory=list)  # folders that may have new files
    ranks: bool = False  # whether it runs on several processes, too
    times: int = 1  # how often it runs, one after the other
    file_size: typing.Optional[int] = None  # bytes after which writing a file fails
    prepare: typing.Optional[typing.Callable] = None  # gets the folder before the run
    check: typing.Optional[typing.Callable] = None  # gets folder and stdout; returns a complaint


def derive(case):
    """The text of the deck, and the line that the messages should name."""
    if not isinstance(case.deck, str):
        return case.deck, None
    text, place = case.deck, 0
    for old, new in case.change:
        if text.count(old) != 1:
            raise SystemExit(f"{case.name}: '{old}' is {text.count(old)} times in the deck")
        place = text.index(old) + len(new) - len(new.lstrip())
        text = text.replace(old, new)
    if "@@" in text:
        place = text.index("@@")
    return text.replace("@@", ""), text.count("\n", 0, place) + 1


def vtu_points(path):
    """The points of a VTU file: base64 with a header of 8 bytes, little endian."""
    raw = base64.b64decode(ElementTree.parse(path).getroot().find(".//Points/DataArray").text)
    return struct.unpack(f"<{(len(raw) - 8) // 8}d", raw[8:])


class Failure(Exception):
    pass


def demand(condition, complaint):
    if not condition:
        raise Failure(complaint)


def check_results(folder, case):
    """The history ends at the level expected, the last picture shows the same position of the last
    node, and the HDF5 file is closed properly: its superblock states its length."""
    demand((folder / "run.h5").is_file(), "there is no run.h5")
    h5 = (folder / "run.h5").read_bytes()
    demand(h5[:8] == b"\x89HDF\r\n\x1a\n", "run.h5 is no HDF5 file")
    end_of_file = struct.unpack("<Q", h5[28:36])[0]  # superblock version 2
    demand(end_of_file == len(h5), f"run.h5 has {len(h5)} bytes, but says {end_of_file}")
    leftovers = sorted(p.name for p in folder.iterdir() if re.search(r"journal|part$", p.name))
    demand(not leftovers, f"left over: {leftovers}")
    rows = (folder / "history.csv").read_text().splitlines()
    last = [float(number) for number in rows[-1].split(",")]
    if case.last_level is not None:
        demand(abs(last[0] - case.last_level) < 1e-9, f"the last level is {last[0]}")
    steps = ElementTree.parse(folder / "run.pvd").getroot().findall(".//DataSet")
    demand(steps, "run.pvd has no steps")
    demand(
        float(steps[-1].get("timestep")) == last[0],
        f"the last picture is at {steps[-1].get('timestep')}, the history ends at {last[0]}",
    )
    tip = vtu_points(folder / steps[-1].get("file"))[-3:]
    demand(max(abs(a - b) for a, b in zip(tip, last[1:4])) == 0.0, f"picture {tip}, history {last}")
    xdmf = ElementTree.parse(folder / "run.xdmf").getroot()
    times = [float(time.get("Value")) for time in xdmf.iter("Time")]
    demand(times and times[-1] == last[0], f"run.xdmf has the steps {times}")


def command(case, folder, options):
    words = shlex.split(case.args.replace("{folder}", str(folder)))
    if options.ranks > 1:
        return [options.mpiexec, "-n", str(options.ranks), options.culm] + words
    return [options.culm] + words


def limit_files(size):
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def run_once(case, folder, options):
    try:
        return subprocess.run(
            command(case, folder, options),
            cwd=case.cwd or folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=TIME_LIMIT,
            # Python ignores SIGXFSZ and leaves it so: writing fails with an error, as on a full disk
            restore_signals=False,
            preexec_fn=(lambda: limit_files(case.file_size)) if case.file_size else None,
        )
    except subprocess.TimeoutExpired:
        raise Failure(f"still running after {TIME_LIMIT} s") from None


def own_lines(stderr, options):
    """Without what mpiexec says about processes that return an error: blocks between rules, and lines of its event
    loop about pipes that are closed already, which depend on who is first."""
    text = stderr.decode(errors="replace")
    if options.ranks > 1:
        text = re.sub(r"^-{20,}\n.*?^-{20,}\n", "", text, flags=re.DOTALL | re.MULTILINE)
        text = re.sub(r"^\[warn\] Epoll .*\n", "", text, flags=re.MULTILINE)
    return text


def is_line(line, expected):
    if expected.endswith("..."):
        return line.startswith(expected[:-3])
    return line == expected


def check_text(case, line, stdout, stderr):
    # str.replace, because braces are part of many messages
    here = [text.replace("{line}", str(line)) for text in case.says]
    if case.errors is not None:
        expected = [text.replace("{line}", str(line)) for text in case.errors]
        lines = stderr.splitlines()
        same = len(lines) == len(expected) and all(map(is_line, lines, expected))
        demand(same, "stderr is not\n  " + "\n  ".join(expected))
    for text in here:
        demand(stderr.count(text) == 1, f"stderr has {stderr.count(text)} times: {text}")
    for text in case.never:
        demand(text not in stderr + stdout, f"there must not be: {text}")
    for text in case.prints:
        demand(stdout.count(text) == 1, f"stdout has {stdout.count(text)} times: {text}")
    silent = case.exit != 0 if case.silent is None else case.silent
    demand(not silent or stdout == "", "stdout is not empty")
    demand(case.exit != 0 or stderr == "" or case.says, "stderr is not empty")


def check_case(case, folder, options):
    deck, line = derive(case)
    if deck is not None:
        (folder / "deck.xml").write_bytes(deck.encode() if isinstance(deck, str) else deck)
    for name, text in case.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    if case.prepare:
        case.prepare(folder)
    before = {path.relative_to(folder) for path in folder.rglob("*")}
    for _ in range(case.times):
        done = run_once(case, folder, options)
    stdout, stderr = done.stdout.decode(errors="replace"), own_lines(done.stderr, options)
    try:
        demand(done.returncode == case.exit, f"exit code {done.returncode}, expected {case.exit}")
        check_text(case, line, stdout, stderr)
        if case.results:
            check_results(folder / case.results, case)
        else:
            new = {path.relative_to(folder) for path in folder.rglob("*")} - before
            new = {path for path in new if path.parts[0] not in case.leaves}
            demand(not new, f"left behind: {sorted(map(str, new))}")
        if case.check:
            complaint = case.check(folder, stdout)
            demand(not complaint, complaint)
        if options.only:
            print(f"=== {case.name}\n{stdout}{stderr}")
    except Failure as failure:
        raise Failure(f"{failure}\n--- stdout\n{stdout}--- stderr\n{stderr}---") from None


def run_case(case, options):
    with tempfile.TemporaryDirectory(prefix="culm-case-") as outer:
        folder = pathlib.Path(outer) / "case"
        folder.mkdir()
        try:
            check_case(case, folder, options)
            return case.name, None
        except Failure as failure:
            return case.name, str(failure)


def load_cases(path):
    sys.dont_write_bytecode = True
    sys.modules["driver"] = sys.modules[__name__]  # where tables find Case
    spec = importlib.util.spec_from_file_location("table", path)
    table = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(table)
    return table.CASES


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--only", default="", help="run cases whose name has this in it")
    parser.add_argument("table")
    options = parser.parse_args()
    options.culm = os.path.abspath(options.culm)

    cases = [case for case in load_cases(options.table) if options.only in case.name]
    names = [case.name for case in cases]
    repeated = {name for name in names if names.count(name) > 1}
    if repeated:
        raise SystemExit(f"several cases are named {sorted(repeated)}")
    if options.ranks > 1:
        cases = [case for case in cases if case.ranks]
    if not cases:
        raise SystemExit("there is no such case")
    # one core is enough for a case on one process; several processes fill the machine
    workers = 2 if options.ranks == 1 else 1
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        outcomes = list(pool.map(lambda case: run_case(case, options), cases))
    failed = [(name, failure) for name, failure in outcomes if failure]
    for name, failure in failed:
        print(f"FAILED {name}: {failure}\n")
    print(f"{len(outcomes) - len(failed)} of {len(outcomes)} cases passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
