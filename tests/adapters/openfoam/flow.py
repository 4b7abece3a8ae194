#!/usr/bin/env python3
"""The flow's side of the file protocol of lumpedPointDisplacement, for the tests: a process of its own that
makes time steps, writes the loads of stations by a simple law, gives the turn away by removing the lock, and
waits for it to come back.

usage: flow.py LAW [--steps N] [--stations N] [--first-turn-empty] [--fails HOW AT]
"""

import argparse
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

COMMS = pathlib.Path("comms")
LOCK = COMMS / "OpenFOAM.lock"
POLL = 0.1  # [s]; OpenFOAM itself looks once per second
HEIGHT, STEP = 0.5, 0.004


def springs(history):
    """Forces towards the start, moments towards the vertical, and a constant wind [N, N m]."""
    start, (points, directions) = history[0][0], history[-1]
    forces = [(0.2 - 40.0 * (x - a), 0.1 - 40.0 * (y - b), -40.0 * (z - c))
              for (x, y, z), (a, b, c) in zip(points, start)]
    moments = [(0.3 * dy, -0.3 * dx, 0.0) for dx, dy, _ in directions]  # 0.3 direction x vertical
    return forces, moments


def added_mass(history):
    """Forces of 0.05 kg of water at each station, and a wind that starts it."""
    last = [points for points, _ in history[-3:]]
    last = [last[0]] * (3 - len(last)) + last
    forces = [(0.1 - 0.05 * (a[0] - 2.0 * b[0] + c[0]) / STEP**2, 0.0, 0.0) for a, b, c in zip(*last)]
    return forces, [(0.0, 0.0, 0.0)] * len(forces)


LAWS = {"springs": springs, "added-mass": added_mass}


def stations(number):
    return [(0.0, 0.0, HEIGHT * i / (number - 1)) for i in range(number)], [(0.0, 0.0, 1.0)] * number


def write_forces(forces, moments, ends_early=False):
    text = "////////\n// Time index=1 value=0\n\n"
    for name, rows in (("points", forces), ("forces", forces), ("moments", moments)):
        text += f"{name}\n{len(rows)}\n(\n" + "".join("({!r} {!r} {!r})\n".format(*row) for row in rows) + ");\n\n"
    (COMMS / "forces.out").write_text(text[: len(text) // 2] if ends_early else text)


def read_motion():
    """Points, and where the vertical points at them."""
    text = (COMMS / "positions.in").read_text()
    rows = [tuple(map(float, row.split())) for row in re.findall(r"\(([^()]+)\)", text)]
    points, angles = rows[: len(rows) // 2], rows[len(rows) // 2 :]
    return points, [(math.sin(a) * math.sin(b), -math.cos(a) * math.sin(b), math.cos(b)) for a, b, _ in angles]


def fail(how):
    if how == "exit":
        print("FOAM FATAL ERROR: Maximum number of iterations exceeded")
        sys.exit(1)
    if how == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    if how == "silent":
        time.sleep(600)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("law", choices=LAWS)
    parser.add_argument("--steps", type=int, default=8)
    parser.add_argument("--stations", type=int, default=21)
    parser.add_argument("--first-turn-empty", action="store_true")
    parser.add_argument("--fails", nargs=2, default=("never", "0"))
    arguments = parser.parse_args()
    ranks = subprocess.Popen(["sleep", "600"])  # what mpirun would have started
    pathlib.Path("processes").write_text(f"{os.getpid()} {ranks.pid}")
    how, at = arguments.fails[0], int(arguments.fails[1])
    history = [stations(arguments.stations)]
    for step in range(1, arguments.steps + 1):
        if step == at:
            fail(how)
        if step > 1 or not arguments.first_turn_empty:
            forces, moments = LAWS[arguments.law](history)
            if step == at and how == "nan":
                forces[5] = (math.nan, 0.0, 0.0)
            write_forces(forces, moments, ends_early=step == at and how == "half")
        LOCK.unlink(missing_ok=True)
        while not LOCK.exists():
            time.sleep(POLL)
        history.append(read_motion())
    ranks.kill()


if __name__ == "__main__":
    main()
