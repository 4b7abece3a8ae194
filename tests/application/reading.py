#!/usr/bin/env python3
"""What `culm.read` makes of a run agrees with the files; the notebook of the guide runs as it stands.

usage: reading.py --culm PROGRAM
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "src/python"), str(ROOT / "tests/kit")]
import numpy  # noqa: E402
from culm_runs import MPI_ENVIRONMENT  # noqa: E402

import culm  # noqa: E402
from culm.history import History  # noqa: E402
from culm.view.recording import Recording  # noqa: E402


AXIS = numpy.array([0.996194698092, 0.0, -0.0871557427477])  # of the shaft


def run_notebook(path):
    """Executes the cells one after the other; what they defined."""
    names = {}
    for cell in json.loads(path.read_text())["cells"]:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), path.name, "exec"), names)
    return names


def check_history(run, history):
    assert run.analyses == ["weight", "modes", "start-up", "emergency stop"], run.analyses
    counts = run.history.groupby("analysis", sort=False).size().to_dict()
    assert counts == {"weight": 3, "start-up": 301, "emergency stop": 201}, counts
    assert list(run.history.index.get_level_values("step")[:6]) == [0, 1, 2, 0, 1, 2]
    for name in history.names:
        assert numpy.allclose(run.history[name], history.columns[name], rtol=0, atol=0, equal_nan=True), name


def check_states(run):
    """The history knows the position of the tip in every recorded state."""
    found = [state.analysis for state in run.states]
    # every hundredth step of all, and the last of each analysis
    assert found == ["weight"] * 2 + ["start-up"] * 4 + ["emergency stop"] * 3, found
    for state in run.states[1:]:
        row = run.history.loc[state.analysis].xs(state.time, level="time")
        moved = row[[f"blade 1 tip u{x} [m]" for x in "xyz"]].to_numpy()[-1]
        assert numpy.abs(state.displacement("blade 1")[-1] - moved).max() < 1e-12, state
        directors = state.directors("hub")[0]
        assert numpy.abs(directors.T @ directors - numpy.eye(3)).max() < 1e-9
        assert state.resultants("tower").shape == (10, 6)
        spin = state.angular_velocity("hub")[0] - state.angular_velocity("nacelle")[0]
        axis = AXIS @ run.states[0].directors("nacelle")[0] @ state.directors("nacelle")[0].T
        assert abs(axis @ spin - row["rotor speed [rad/s]"].iloc[-1]) < 1e-12
        arm = state.position("blade 1")[0] - state.position("hub")[0]
        carried = state.velocity("hub")[0] + numpy.cross(state.angular_velocity("hub")[0], arm)
        assert numpy.abs(state.velocity("blade 1")[0] - carried).max() < 1e-4, "the hub carries the root"


def check_columns(run):
    """Quantities whose names begin alike are told apart."""
    assert list(run.columns("rotor").columns) == ["rotor [rad]"]
    assert list(run.columns("rotor speed").columns) == ["rotor speed [rad/s]"]
    assert len(run.columns("blade 1 root").columns) == 6


def check_refusals(run):
    for ask, word in ((lambda: run.columns("blade"), "blade 1 tip"), (lambda: run.modes("stop"), "modes/modes"),
                      (lambda: run.states[0].position("mast"), "tower")):
        try:
            ask()
        except KeyError as error:
            assert word in str(error), error
        else:
            raise AssertionError("nothing was raised")


def check_constraint_forces(program, folder):
    """In the deformed place each part is in balance, and joints act on both sides with opposite signs."""
    deck = ROOT / "inputs/joint/forces_by_name.xml"
    for form in ("Null Space", "Multipliers"):
        form_of_deck = ["--set", f"Solver/Form={form}"]
        subprocess.run([program, "run", deck, "--quiet", "--output", folder, *form_of_deck], check=True)
        run = culm.read(folder)
        state = run.states[-1]
        clamp, hinge, roller = (state.constraint_forces(name).to_numpy() for name in ("clamp", "hinge", "roller"))
        load = numpy.hstack([state.position("hung")[2], [10, 20, -100], [0, 0, 0]])
        for part in ([clamp[0], hinge[0]], [hinge[1], roller[0], load]):
            place, force, moment = numpy.split(numpy.array(part), 3, axis=1)
            assert numpy.abs(force.sum(axis=0)).max() < 1e-6, (form, part)
            assert numpy.abs((moment + numpy.cross(place, force)).sum(axis=0)).max() < 1e-6, (form, part)
        row = run.history.iloc[-1]
        for name, forces in (("hinge", hinge[1]), ("hinge on held", hinge[0]), ("clamp", clamp[0])):
            assert numpy.abs(run.columns(name).iloc[-1].to_numpy() - forces[3:]).max() < 1e-9, (form, name, row)
        for ask, word in ((lambda: state.constraint_forces("hing"), "hinge"),
                          (lambda: run.states[0].constraint_forces("hinge"), "'hinge'")):
            try:
                ask()
            except KeyError as error:
                assert word in str(error), error
            else:
                raise AssertionError("nothing was raised")


def check_names(program, folder):
    """An analysis whose name is none of a file has its shapes in all readers, and its files where the report says."""
    analysis = "Modes: hot, 20 %"
    mode = ["--set", f"Analyses/{analysis}/Type=Modal", "--set", f"Analyses/{analysis}/Modes=3"]
    deck = ROOT / "inputs/beam/tapered_tower.xml"
    subprocess.run([program, "run", deck, "--quiet", "--report", "--output", folder, *mode], check=True)
    run = culm.read(folder)
    modes = run.modes(analysis)
    assert len(modes.table) == 3 and all(len(shape) == 3 for shape in modes.shapes.values()) and modes.shapes, modes
    page = (pathlib.Path(folder) / "report.html").read_text()
    assert f"shapes of the modes of {analysis}" in page and f">{analysis}: modes<" in page
    said = re.search(r"participations: (analyses/[^<]*?/modes.csv)", page)[1]
    assert (pathlib.Path(folder) / said).exists(), said
    with Recording(pathlib.Path(folder)) as recording:
        assert analysis in [shapes.analysis for shapes in recording.shapes()]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--culm", required=True, type=pathlib.Path)
    program = parser.parse_args().culm.resolve()
    os.environ.update(MPI_ENVIRONMENT, CULM_PROGRAM=str(program))
    with tempfile.TemporaryDirectory(prefix="culm") as name:
        os.chdir(name)
        pathlib.Path("inputs").symlink_to(ROOT / "inputs")
        names = run_notebook(ROOT / "doc/guide/reading_results.ipynb")
        run = names["run"]
        check_history(run, History("results/notebook/history.csv"))
        check_states(run)
        check_columns(run)
        check_refusals(run)
        check_constraint_forces(program, "results/forces")
        check_names(program, "results/names")
        assert len(names["axes"].lines) == 9, "three components in three analyses"
        assert names["modes"].shapes["tower"].shape == (15, 11, 6)
        assert isinstance(repr(culm.read("results/notebook")), str)
    print("the notebook runs, and what it read is right")


main()
