#!/usr/bin/env python3
"""The adapter for preCICE: masses behind a port are masses in the deck, energy that crosses it is the same on both
sides, and mistakes end it with one clear message.

usage: identity.py --adapter PROGRAM    with culm and _culm on PYTHONPATH; the program is the adapter built with the
                                        stand-in of this folder
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

import culm
import numpy as np
from culm.history import History

ROOT = pathlib.Path(__file__).resolve().parents[3]
WINDOW, WINDOWS = 0.02, 50
PUSH = ["Loads/push/Type=Line Force", "Loads/push/Structure=mast", "Loads/push/Force={57, 10, 0}",
        "Loads/push/Function=Constant"]


def masses(mass):
    """The same masses in the deck as behind its port: at the ends of its five elements of order 2."""
    words = []
    for i in range(1, 6):
        words += [f"Masses/m{i}/{name}={value}" for name, value in (
            ("Type", "Point Mass"), ("Node", f"mast/{2 * i}"), ("Mass", mass), ("Offset", "{0.1, 0, 0}"))]
    return words


def write_mast(folder):
    """The deck of the guide, in a file."""
    deck = folder / "mast.xml"
    deck.write_text(re.search(r"```xml\n(.*?)```", (ROOT / "doc/guide/coupling.md").read_text(), re.S).group(1))
    return deck


def together(deck, mass):
    """Displacements of the port with the masses in the deck."""
    mast = culm.Simulation(str(deck), [*PUSH, *masses(mass)])
    mast.begin().run()
    return mast.port("skin").position - mast.port("skin").reference


class Coupled:
    """A run of the adapter, and what the stand-in and the adapter wrote."""

    def __init__(self, adapter, folder, mass=5.0, settings=(), options=(), port="skin", table="table", **configuration):
        deck = write_mast(folder)
        words = {"mass": mass, "window": WINDOW, "windows": WINDOWS, "waveform": 0, "ends-at": 0, "dimensions": 3,
                 "record": folder / "record", **configuration}
        (folder / "precice.txt").write_text("\n".join(f"{name} {value}" for name, value in words.items()))
        command = [adapter, deck, "--port", port, "--config", folder / "precice.txt", "--table", folder / table,
                   *options]
        for setting in (*PUSH, *settings):
            command += ["--set", setting]
        (folder / "table").unlink(missing_ok=True)
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
        self.exit, self.errors = done.returncode, done.stderr
        self.table = History(folder / "table") if (folder / "table").exists() else None
        if self.exit == 0:
            numbers = [float(word) for word in (folder / "record").read_text().split()]
            self.energy, self.displacement = numbers[0], np.array(numbers[1:]).reshape(-1, 3)
            self.work = self.table.column("work [J]")[-1]


def holds(what, error, allowed):
    print(f"{what}: {error:.1e}, allowed {allowed:.0e}")
    assert error <= allowed, what  # false for a nan


def same_as_masses_in_the_deck(adapter, folder):
    for mass in (0.5, 5.0, 50.0):
        for waveform in (0, 1):
            run = Coupled(adapter, folder, mass, waveform=waveform)
            assert run.exit == 0, run.errors
            assert len(run.table.levels) == WINDOWS and abs(run.table.levels[-1] - WINDOW * WINDOWS) < 1e-12
            expected = together(folder / "mast.xml", mass)
            largest = np.abs(expected).max()
            assert largest > 0.01
            holds(f"displacement with {mass} kg, waveform {waveform}",
                  np.abs(run.displacement - expected).max() / largest, 1e-10)
            if waveform == 0:
                holds(f"energy that crosses the port with {mass} kg", abs(run.work + run.energy) / run.energy, 1e-10)


def energy_with_steps_in_windows(adapter, folder):
    """A load that is constant in a window works on its motion, however many steps the deck makes in it."""
    run = Coupled(adapter, folder, settings=["Analyses/gust/Step=0.006"])
    assert run.exit == 0, run.errors
    holds("energy with four steps in a window", abs(run.work + run.energy) / run.energy, 1e-10)


def failures(adapter, folder):
    def expect(exit_code, words, rows=None, **options):
        run = Coupled(adapter, folder, **options)
        assert run.exit == exit_code and words in run.errors, (run.exit, run.errors)
        assert rows is None or len(run.table.levels) == rows, run.table.levels

    expect(9, "'Fluid' has left", 6, **{"ends-at": 7})
    expect(3, "the analysis ends at 0.5 s", 25, settings=["Analyses/gust/End Time=0.5"])
    expect(3, "mesh 'Structure-Mesh' of preCICE has 2 dimensions", dimensions=2)
    expect(9, "there is no mesh 'Wall'", options=["--mesh", "Wall"])
    expect(9, "there is no data 'Forces'", options=["--force", "Forces"])
    expect(2, "did you mean 'skin'?", port="skim")
    expect(6, "no/table", table="no/table")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--adapter", required=True)
    adapter = parser.parse_args().adapter
    for test in (same_as_masses_in_the_deck, energy_with_steps_in_windows, failures):
        with tempfile.TemporaryDirectory(prefix="culm-precice-") as folder:
            test(adapter, pathlib.Path(folder))


if __name__ == "__main__":
    sys.exit(main())
