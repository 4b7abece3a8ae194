#!/usr/bin/env python3
"""What is known to the rank that owns an element only, such as stress resultants and stresses of layers, is shown as one
process shows it: in histories, which watch elements of several ranks, and in all states of run.h5.

usage: owners.py --culm PROGRAM --mpiexec PROGRAM
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy

INPUTS = pathlib.Path(__file__).resolve().parent.parent.parent / "inputs"
DECKS = {
    "beam/composite_cantilever.xml": [],
    "beam/section_stress.xml": [],
    "heat/bimetal_strip.xml": [],
    "plasticity/bent_bar.xml": [],
    "beam/pendulum.xml": ["--set", "Analyses/motion/End Time=0.05", "--set", "Output/Every=2"],
    "shell/layered_strip.xml": ["--set", "Output/Shell/Stresses=true", "--set", "Output/Shell/Strains=true"],
}
CLOSE = 1e-9  # of the largest number of a table


def tables(path):
    """The tables of the history and of all states, by name."""
    found = {}
    with h5py.File(path, "r") as file:
        def add(name, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
                found[name] = item[()]
        for group in ("history", "steps"):
            file[group].visititems(lambda name, item, group=group: add(f"{group}/{name}", item))
    return found


def differences(alone, shared):
    if alone.keys() != shared.keys():
        yield f"other tables: {sorted(alone.keys() ^ shared.keys())}"
        return
    for name, expected in alone.items():
        if expected.shape != shared[name].shape:
            yield f"{name} has shape {shared[name].shape}, expected {expected.shape}"
        elif expected.size:
            scale = max(numpy.abs(expected).max(), 1e-300)
            worst = numpy.abs(shared[name] - expected).max() / scale
            if not worst <= CLOSE:
                yield f"{name} differs by {worst:.1e}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--culm", required=True)
    parser.add_argument("--mpiexec", required=True)
    options = parser.parse_args()
    culm = os.path.abspath(options.culm)
    failures = []
    for deck, words in DECKS.items():
        with tempfile.TemporaryDirectory() as folder:
            results = {}
            for ranks in (1, 2, 3):
                out = pathlib.Path(folder) / str(ranks)
                run = subprocess.run([options.mpiexec, "-n", str(ranks), culm, "run", str(INPUTS / deck), "--quiet",
                                      "--output", str(out), *words], capture_output=True, text=True, timeout=600)
                if run.returncode != 0:
                    sys.exit(f"{deck} on {ranks} ranks: exit code {run.returncode}\n{run.stdout}{run.stderr}")
                results[ranks] = tables(out / "run.h5")
            if not any("resultants" in name for name in results[1]):
                failures.append(f"{deck} shows no stress resultants")
            for ranks in (2, 3):
                failures += [f"{deck} on {ranks} ranks: {text}" for text in differences(results[1], results[ranks])]
            print(f"{deck}: {len(results[1])} tables compared")
    print("\n".join(failures), file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
