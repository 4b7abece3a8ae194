#!/usr/bin/env python3
"""Takes files away from a living run: it must end with exit code 6 and name the file.

usage: vanishing.py --culm PROGRAM [--mpiexec PROGRAM --ranks N]
"""

import argparse
import functools
import shutil
import sys
import time

from resume import INPUTS, demand, kill_tree, run_each, settings, wait_for

LONG = [INPUTS / "body/heavy_top.xml", "--quiet", *settings("Output/Every=1", "Output/Checkpoints=false")]
ENDLESS = settings("Analyses/motion/End Time=600")
REMOVED = "was removed or renamed while the run was writing it\n"
REPLACED = "was replaced by another file while the run was writing it\n"


# An index that the run writes in this very moment comes back once.
def remove(path):
    while path.exists():
        path.unlink()
        time.sleep(0.02)


def replace(path):
    while path.read_bytes() != b"mine":
        other = path.with_suffix(".other")
        other.write_text("mine")
        other.replace(path)
        time.sleep(0.02)


def rename(path):
    path.rename(path.with_name("elsewhere"))  # unlike a removal at once, whatever the run writes into it


def remove_folder(path):
    shutil.rmtree(path.parent, ignore_errors=True)


def rename_folder(path):
    rename(path.parent)


# what is done to which file; what is said of it
CASES = [
    ("run.h5", remove, REMOVED),
    ("run.h5", replace, REPLACED),
    ("history.csv", remove, REMOVED),
    ("history.csv", replace, REPLACED),
    ("run.xdmf", remove, REMOVED),
    ("run.pvd", replace, REPLACED),
    ("run_vtu", rename, None),  # in this moment it may write one of its files, or open the next
    ("run.h5", remove_folder, None),
    ("run.h5", rename_folder, None),
]


def vanish(program, folder, name, action, says):
    """At some step of a run that has no end; at once for all but indices, which wait for their time."""
    process = program.start("run", *LONG, *ENDLESS, "--output", "out")
    history = folder / "out/history.csv"
    try:
        wait_for(process, lambda: history.exists() and history.stat().st_size > 3000, "no steps")
        action(folder / "out" / name)
        code, _, err = program.finish(process)
    finally:
        if process.poll() is None:
            kill_tree(process)
    demand(code == 6, f"exit code {code}: {err}")
    named = "out/" if action in (remove_folder, rename_folder) else f"out/{name}"  # any file may be the first
    demand(named in err and (not says or err.count(says) == 1), f"stderr is {err}")
    mine = folder / "out" / name
    demand(action is not replace or mine.read_text() == "mine", f"{name} was overwritten")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--ranks", type=int, default=1)
    options = parser.parse_args()
    return run_each(options, [
        (f"{action.__name__} {name}", functools.partial(vanish, name=name, action=action, says=says))
        for name, action, says in (CASES if options.ranks == 1 else CASES[:1])
    ])


if __name__ == "__main__":
    sys.exit(main())
