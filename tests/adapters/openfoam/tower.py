#!/usr/bin/env python3
"""The tower of inputs/coupling/openfoam_tower with OpenFOAM itself: a heavy one, which moves cleanly, and a light one,
whose instability is recognised. For nights; it takes three minutes, nearly all of them OpenFOAM's waiting.

usage: tower.py [--plot PICTURE]    with culm and _culm on PYTHONPATH, Debian's packages openfoam and openfoam-examples
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from culm.history import History
from culm.openfoam.dictionary import read_dictionary
from foam_files import Mesh, read_field

TOWER = pathlib.Path(__file__).resolve().parents[3] / "inputs/coupling/openfoam_tower"
DENSITY, SPEED = 1.2, 5.0  # of the air [kg/m3, m/s]
WIDTH, HEIGHT = 0.1, 0.5  # of the tower [m]
ENVIRONMENT = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ}


def prepare(folder):
    """The mesh, and a potential flow to begin with."""
    shutil.copytree(TOWER / "case", folder)
    for command in (["blockMesh"], ["potentialFoam", "-writep"]):
        subprocess.run(command, cwd=folder, env=ENVIRONMENT, stdout=subprocess.DEVNULL, check=True)


def couple(case, *settings):
    """Exit code, what was said, and the history of a coupled run."""
    results = case / "results"
    command = [sys.executable, "-m", "culm.openfoam", TOWER / "tower.xml", case, "--output", results]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr, History(results / "history.csv")


class Checks:
    def __init__(self):
        self.failures = 0

    def holds(self, what, value, least, most):
        sound = least <= value <= most
        self.failures += not sound
        print(f"  {what}: {value:.4g}, between {least:g} and {most:g}{'' if sound else '   <-- VIOLATED'}")


def number(text, what):
    return float(re.search(rf"{what} +(\S+)", text).group(1))


def check_heavy(checks, outcome, case):
    code, text, history = outcome
    print("a tower of 1 kg/m", text, sep="\n")
    tip, drag = (np.array(history.column(name)) for name in ("tip ux [m]", "stations fx [N]"))
    mean = drag[26:].mean()
    checks.holds("exit code", code, 0, 0)
    checks.holds("drag coefficient, mean from 0.1 s on", mean / (0.5 * DENSITY * SPEED**2 * WIDTH * HEIGHT), 1.0, 2.0)
    still = mean / HEIGHT * HEIGHT**4 / (8.0 * 20.0)  # of a uniform load, by Bernoulli
    checks.holds("mean of the tip over that under a uniform load", tip[1:51].mean() / still, 0.8, 1.2)
    checks.holds("energy balance of the certificate", number(text, "relative energy drift"), 0.0, 1e-9)
    check_wall(checks, case, tip[-1])


def check_wall(checks, case, tip):
    """The wall in the flow program is where culm's stations and their directors put it: linear between them."""
    start, end = Mesh(case).points, Mesh(case, "0.2").points
    wall = np.all(np.abs(start[:, :2]) <= WIDTH / 2 + 1e-9, axis=1) & (start[:, 2] <= HEIGHT + 1e-9)
    start, end = start[wall], end[wall]
    sent = read_dictionary(case / "comms/positions.in")
    points, angles = (np.array(sent[name], dtype=float) for name in ("points", "angles"))
    checks.holds("tip that was sent against the deck's", abs(points[-1, 0] - tip) / abs(tip), 0.0, 1e-12)
    columns = np.stack([rotation(*one)[:, :2] for one in angles])
    z = np.linspace(0.0, HEIGHT, len(points))
    middle, turned = (np.stack([np.interp(start[:, 2], z, values.reshape(len(z), -1)[:, i])
                                for i in range(values[0].size)], axis=1) for values in (points, columns))
    expected = middle + np.einsum("nij,nj->ni", turned.reshape(-1, 3, 2), start[:, :2])
    checks.holds("wall of the mesh against culm's linear map [m]", np.abs(end - expected).max(), 0.0, 1e-11)


def rotation(phi, theta, psi):
    """Z(phi) X(theta) Z(psi)."""

    def about(axis, angle):
        i, j = (0, 1) if axis == 2 else (1, 2)
        matrix = np.eye(3)
        matrix[[i, j], [i, j]] = np.cos(angle)
        matrix[i, j], matrix[j, i] = -np.sin(angle), np.sin(angle)
        return matrix

    return about(2, phi) @ about(0, theta) @ about(2, psi)


def check_light(checks, outcome):
    code, text, history = outcome
    print("a tower of 0.005 kg/m", text, sep="\n")
    checks.holds("exit code", code, 8, 8)
    checks.holds("said to be the added mass", "added-mass instability" in text, 1, 1)
    checks.holds("steps before", len(history.levels) - 1, 5, 45)
    energy, work = (history.column(name)[-1] for name in ("energy total [J]", "stations work [J]"))
    checks.holds("energy of the deck against the work of its port", abs(energy - work) / work, 0.0, 1e-9)


def print_gaps(case):
    """How much of the work at faces gets lost where zones of faces push stations: a wall that bends like z^2, under the
    pressures of the flow."""
    mesh = Mesh(case)
    centres, areas, cells = mesh.patch("tower")
    forces = DENSITY * read_field(case / "0.2/p")[cells][:, None] * areas
    print("stations, work of zones over work at the faces - 1")
    for stations in (6, 11, 21):
        print(f"  {stations:3} {zone_work(stations, centres, forces) / face_work(stations, centres, forces) - 1.0:.2e}")


def bent(z):
    """Displacement along x and turn about y of a bent wall."""
    return (z / HEIGHT) ** 2, 2.0 * z / HEIGHT**2


def zone_work(stations, centres, forces):
    z = np.linspace(0.0, HEIGHT, stations)
    zone = np.searchsorted(0.5 * (z[1:] + z[:-1]), centres[:, 2], side="right")
    lever = centres - np.stack([0.0 * z[zone], 0.0 * z[zone], z[zone]], axis=1)
    moment = np.cross(lever, forces)[:, 1]
    u, turn = bent(z)
    return np.sum(forces[:, 0] * u[zone] + moment * turn[zone])


def face_work(stations, centres, forces):
    """By the motion that the flow program makes of that of stations: linear between them."""
    z = np.linspace(0.0, HEIGHT, stations)
    u, turn = (np.interp(centres[:, 2], z, values) for values in bent(z))
    return np.sum(forces[:, 0] * u - forces[:, 2] * turn * centres[:, 0])


def plot(path, heavy, light, case):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot

    fig, axes = pyplot.subplots(2, 2, figsize=(10.0, 6.6), layout="constrained")
    draw_motion(axes[0, 0], heavy[2], "1 kg/m")
    draw_motion(axes[0, 1], light[2], "0.005 kg/m: added-mass instability")
    mesh = Mesh(case, "0.2")
    centres = mesh.cell_centres()
    velocity, pressure = read_field(case / "0.2/U"), DENSITY * read_field(case / "0.2/p")
    heights = Mesh(case).cell_centres()[:, 2]
    level = heights[np.argmin(np.abs(heights - 0.3))]
    cut = np.abs(heights - level) < 1e-6
    draw_cut(fig, axes[1, 0], centres[cut], velocity[cut, 0], f"velocity along x at z = {level:.2f} m [m/s]")
    draw_cut(fig, axes[1, 1], centres[cut], pressure[cut], "pressure there [Pa]")
    fig.savefig(path, dpi=110)


def draw_motion(axes, history, title):
    axes.plot(history.levels, 1e3 * np.array(history.column("tip ux [m]")), "o-", ms=3, color="C0")
    axes.set(xlabel="time [s]", title=title)
    axes.set_ylabel("tip along the wind [mm]", color="C0")
    other = axes.twinx()
    other.plot(history.levels[1:], history.column("stations fx [N]")[1:], "-", color="C1")
    other.set_ylabel("force along the wind [N]", color="C1")


def draw_cut(fig, axes, centres, values, title):
    from matplotlib.patches import Rectangle

    fig.colorbar(axes.tricontourf(centres[:, 0], centres[:, 1], values, 24), ax=axes)
    axes.add_patch(Rectangle((-WIDTH / 2, -WIDTH / 2), WIDTH, WIDTH, color="0.3"))
    axes.set(aspect="equal", title=title, xlim=(-0.3, 0.8), ylim=(-0.35, 0.35), xlabel="x [m]", ylabel="y [m]")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plot", type=pathlib.Path)
    arguments = parser.parse_args()
    if shutil.which("pimpleFoam") is None:
        sys.exit("there is no pimpleFoam: install the package openfoam")
    checks = Checks()
    with tempfile.TemporaryDirectory(prefix="culm-tower-") as path:
        heavy_case, light_case = pathlib.Path(path) / "heavy", pathlib.Path(path) / "light"
        prepare(heavy_case)
        shutil.copytree(heavy_case, light_case)
        heavy = couple(heavy_case)
        check_heavy(checks, heavy, heavy_case)
        print_gaps(heavy_case)
        light = couple(light_case, "mass=0.005")
        check_light(checks, light)
        if arguments.plot:
            plot(arguments.plot, heavy, light, heavy_case)
    return bool(checks.failures)


if __name__ == "__main__":
    sys.exit(main())
