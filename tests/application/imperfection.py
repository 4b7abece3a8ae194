"""Buckling shapes as imperfections of later runs: a column that is bent by a0 in its buckling shape bends further
by a0 l / (1 - l) under the share l of its buckling load (Southwell)."""

import argparse
import math
import pathlib
import sys
import tempfile

import h5py

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "src/python"))
from culm.program import Program  # noqa: E402

INPUTS = ROOT / "inputs/buckling"
AMPLITUDE = 1e-4  # of the length 1


def entry(run, analysis="buckling", amplitude=AMPLITUDE):
    given = {"Run": run, "Analysis": analysis, "Amplitude": amplitude}
    return [f"Imperfections/bow/{name}={value}" for name, value in given.items()]


def watch(node):
    return ["Output/History/tip/Type=Displacement", f"Output/History/tip/Node={node}"]


def displacements(program, folder):
    """Where imperfections of the same run bend later analyses, states and history count from the same geometry."""
    words = ["Analyses/straight/Final Level=0.2", "Analyses/bent/Final Level=0.2"]
    run = program.run(ROOT / "inputs/sequence/bent_column.xml", folder, words)
    if not run.succeeded:
        return [run.errors]
    complaints = []
    history = dict(zip(zip(run.history.analyses, run.history.steps), run.history.column("tip ux [m]")))
    sways = dict(zip(history, run.history.column("tip uy [m]")))
    with h5py.File(folder / "run.h5") as file:
        for state in file["steps"].values():
            key = int(state.attrs["analysis"]), int(state.attrs["step"])
            if key not in history:
                continue
            there = state["displacement"][-1]
            if abs(there[0] - history[key]) > 1e-12 or abs(there[1] - sways[key]) > 1e-12:
                complaints.append(f"displacement of the tip in {key}: history {history[key]}, {sways[key]}, state {there}")
    return complaints


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--culm", required=True)
    program = Program(parser.parse_args().culm)
    complaints = []
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        shapes, loaded = (pathlib.Path(folder) / name for name in ("shapes", "loaded"))
        found = program.run(INPUTS / "column.xml", shapes)
        if not found.succeeded:
            sys.exit(found.errors)
        deck = INPUTS / "column_loaded.xml"
        run = program.run(deck, loaded, [*entry(shapes), *watch("column/last")])
        if not run.succeeded:
            sys.exit(run.errors)
        # the column buckles in any direction
        sway = map(math.hypot, run.history.column("tip ux [m]"), run.history.column("tip uy [m]"))
        for level, bent in list(zip(run.history.levels, sway))[1:5]:
            expected = AMPLITUDE * level / (1.0 - level)
            print(f"level {level:.4g}: tip {bent:.6e} m, Southwell {expected:.6e} m")
            # errors of the mesh and of the axial strain, 1e-5, grow as the bending does
            if abs(bent - expected) > 1e-4 * expected / (1.0 - level):
                complaints.append(f"level {level}: {bent}")
        for settings, exit_code, words in (
            (entry(shapes, analysis="bukling"), 6, "no analysis 'bukling' with shapes; it has buckling"),
            ([*entry(shapes), "N=4"], 3, "the shape has 33 nodes for 'column', which has 9 here"),
        ):
            run = program.run(deck, loaded, settings)
            if run.exit != exit_code or words not in run.errors:
                complaints.append(f"{settings}: exit {run.exit}, {run.errors}")
        complaints += displacements(program, pathlib.Path(folder) / "both")
        file = shapes / "run.h5"
        whole = file.read_bytes()
        with h5py.File(file) as run:
            shape = run["analyses/buckling/shapes/column"]
            place = shape.id.get_offset() + shape.id.get_storage_size() // 2
        file.write_bytes(whole[:place] + bytes([whole[place] ^ 16]) + whole[place + 1 :])
        run = program.run(deck, loaded, entry(shapes))
        if run.exit != 6 or "the results of 'buckling' are not what was written" not in run.errors:
            complaints.append(f"a flipped bit: exit {run.exit}, {run.errors}")
    for complaint in complaints:
        print(f"FAILED: {complaint}")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
