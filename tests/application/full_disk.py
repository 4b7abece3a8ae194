#!/usr/bin/env python3
"""Runs on a disk that gets full: they must say so with exit code 6 and the file, leave files that can be
read, and go on to the results of a run that nobody disturbed once there is room again.

usage: unshare --user --map-root-user --mount full_disk.py --culm PROGRAM [--mpiexec PROGRAM --ranks N]

The disk is a small tmpfs, which only a mount namespace of its own lets an ordinary user have.
"""

import argparse
import contextlib
import functools
import subprocess
import sys

from resume import EVERY_STEP, MANY_NODES, SHELL, TORSION, check_killed, demand, demand_same, run_each, settings

# a run, and for which parts of its results there is room
RUNS = [("torsion", TORSION, 0.4), ("torsion", TORSION, 0.7), ("shell", SHELL, 0.4), ("shell", SHELL, 0.7)]
# mpiexec takes its time; of the last one all ranks write
ON_SEVERAL_RANKS = [RUNS[-1], ("many nodes", MANY_NODES + settings("Analyses/motion/End Time=0.2"), 0.6)]
FULL = "No space left on device"


@contextlib.contextmanager
def small_disk(path, size):
    path.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "none", path], check=True)
    try:
        yield
    finally:
        subprocess.run(["umount", path], check=True)


def size_of(folder):
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())


def fill(program, folder, words, part):
    """A disk with room for a part of the results, then for more, until all is there."""
    program("run", *words, *EVERY_STEP, "--output", "whole")
    whole = size_of(folder / "whole")
    disk = folder / "disk"
    with small_disk(disk, int(part * whole)):
        _, _, err = program("run", *words, *EVERY_STEP, "--output", "disk/out", expect=(6,))
        demand(FULL in err and "disk/out/" in err, f"stderr is {err}")
        demand(check_killed(disk / "out") > 0, "the disk had no room for a step")
        _, _, err = program("resume", "disk/out", "--quiet", expect=(6,))
        demand(FULL in err and "disk/out/" in err, f"stderr of resume is {err}")
        subprocess.run(["mount", "-o", f"remount,size={4 * whole}", disk], check=True)
        program("resume", "disk/out", "--quiet")
        demand_same(folder / "whole", disk / "out")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--ranks", type=int, default=1)
    options = parser.parse_args()
    return run_each(options, [
        (f"{name}, room for {part} of it", functools.partial(fill, words=words, part=part))
        for name, words, part in (RUNS if options.ranks == 1 else ON_SEVERAL_RANKS)
    ])


if __name__ == "__main__":
    sys.exit(main())
