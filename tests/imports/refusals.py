#!/usr/bin/env python3
"""What an import refuses: one clear message with place and value, the exit code, nothing written."""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import samples
from reading import made_of_text
from culm.errors import CulmError

FRAME = samples.frame(2)
# (change of the frame's file, exit code, what stands in the message)
CASES = {
    "an element of another kind": (("TYPE=B32R", "TYPE=C3D20R"), 3, "sample.inp:17: elements of type C3D20R"),
    "a set that is not there": (("FEET, 1, 6", "FEAT, 1, 6"), 3, "no node or node set 'FEAT' – did you mean 'FEET'?"),
    "a number that is none": (("2.1E11, 0.3", "2.1E11, O.3"), 3, "expected a number, found 'O.3'"),
    "a material that is not there": (("MATERIAL=STEEL, SECTION", "MATERIAL=STELL, SECTION"), 3, "did you mean 'STEEL'?"),
    "a node that is not there": (("1, 1, 2, 3\n", "1, 1, 2, 333\n"), 3, "there is no node 333"),
    "a shape that is not read": (("SECTION=RECT\n0.1, 0.2", "SECTION=HEX\n0.1, 0.2"), 3, "shape HEX are not read"),
    "a step without end": (("-1e5\n*END STEP\n", "-1e5\n"), 3, "*END STEP is missing"),
    "an include that is not there": (("*MATERIAL", "*INCLUDE, INPUT=steel.inp\n*MATERIAL"), 6, "steel.inp"),
}


def imported(program, folder, *words):
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    command = [program, "import", *words]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, env=environment)


def changed(name, change):
    old, new = change
    if old not in FRAME:
        raise ValueError(f"{name}: the sample has no '{old}'")
    return FRAME.replace(old, new, 1)


def refused(name, change, code, words, complaints):
    """By the reader, in this process."""
    try:
        made_of_text("abaqus", changed(name, change))
        complaints.append(f"{name}: is not refused")
    except CulmError as error:
        if error.exit_code != code or words not in str(error):
            complaints.append(f"{name}: exit {error.exit_code}, {error}")


def leaves_nothing(program, complaints):
    """What culm refuses of a deck is told, and nothing is written."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "sample.inp").write_text(changed("Poisson", ("2.1E11, 0.3", "2.1E11, 0.7")))
        done = imported(program, folder, "abaqus", "sample.inp")
        left = sorted(path.name for path in pathlib.Path(folder).iterdir())
    if done.returncode != 3 or "Poisson Ratio" not in done.stderr or done.stdout or left != ["sample.inp"]:
        complaints.append(f"what culm refuses: exit {done.returncode}, {done.stdout}{done.stderr}, leaves {left}")


def replaces_nothing(program, complaints):
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "sample.inp").write_text(FRAME)
        first = imported(program, folder, "abaqus", "sample.inp")
        before = {path.name: path.read_text() for path in pathlib.Path(folder).iterdir()}
        second = imported(program, folder, "abaqus", "sample.inp")
        after = {path.name: path.read_text() for path in pathlib.Path(folder).iterdir()}
    if first.returncode != 0 or sorted(before) != ["sample.inp", "sample.report.txt", "sample.xml"]:
        complaints.append(f"the frame: exit {first.returncode}, {sorted(before)}, {first.stderr}")
    if second.returncode != 6 or "exists and may have been edited" not in second.stderr or before != after:
        complaints.append(f"a second import: exit {second.returncode}, {second.stderr}")


def stops_quietly(program, complaints):
    """Where nobody reads what it prints, as behind `| head`; the deck is there."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "sample.inp").write_text(FRAME)
        read, write = os.pipe()
        os.close(read)
        environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        command = [program, "import", "abaqus", "sample.inp"]
        done = subprocess.run(command, cwd=folder, stdout=write, stderr=subprocess.PIPE, text=True, env=environment)
        os.close(write)
        is_there = (pathlib.Path(folder) / "sample.xml").exists()
    if done.returncode != 0 or "Traceback" in done.stderr or not is_there:
        complaints.append(f"a closed pipe: exit {done.returncode}, deck {is_there}, {done.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--culm", required=True)
    program = parser.parse_args().culm
    complaints = []
    for name, (change, code, words) in CASES.items():
        refused(name, change, code, words, complaints)
    leaves_nothing(program, complaints)
    replaces_nothing(program, complaints)
    stops_quietly(program, complaints)
    unknown = imported(program, ".", "abacus", "x.inp")
    if unknown.returncode != 2 or "abaqus" not in unknown.stderr:
        complaints.append(f"an unknown format: exit {unknown.returncode}, {unknown.stderr}")
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
