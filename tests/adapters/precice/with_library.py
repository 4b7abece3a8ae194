#!/usr/bin/env python3
"""The adapter with preCICE itself and a participant with masses: the masses in the deck make the same motion.

usage: with_library.py --adapter PROGRAM --fluid PROGRAM    with culm and _culm on PYTHONPATH
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from culm.history import History
from identity import PUSH, WINDOWS, holds, together, write_mast

MASS = 5.0
CONFIGURATION = pathlib.Path(__file__).resolve().with_name("precice.xml")


def couple(adapter, fluid, folder):
    """Both participants in a folder, where they find each other."""
    partner = subprocess.Popen([fluid, CONFIGURATION, str(MASS), "record"], cwd=folder, stdout=subprocess.DEVNULL)
    command = [adapter, write_mast(folder), "--port", "skin", "--config", CONFIGURATION, "--table", "table"]
    for setting in PUSH:
        command += ["--set", setting]
    try:
        done = subprocess.run(list(map(str, command)), cwd=folder, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        assert partner.wait(60) == 0
    finally:
        partner.kill()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--adapter", required=True)
    parser.add_argument("--fluid", required=True)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="culm-precice-") as path:
        folder = pathlib.Path(path)
        couple(arguments.adapter, arguments.fluid, folder)
        table = History(folder / "table")
        energy, *displacement = map(float, (folder / "record").read_text().split())
        expected = together(folder / "mast.xml", MASS)
    assert len(table.levels) == WINDOWS
    difference = np.abs(np.reshape(displacement, (-1, 3)) - expected).max()
    holds("displacement", difference / np.abs(expected).max(), 1e-9)  # preCICE stops at 1e-10 of the forces
    holds("energy that crosses the port", abs(table.column("work [J]")[-1] + energy) / energy, 1e-9)


if __name__ == "__main__":
    sys.exit(main())
