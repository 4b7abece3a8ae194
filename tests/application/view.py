"""Pages of runs: what is embedded is what the run recorded, and what cannot be shown is refused with one line."""

import argparse
import json
import pathlib
import re
import shutil
import sys
import tempfile

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "src/python"))
from culm.program import Program  # noqa: E402
from culm.state_tables import read_field  # noqa: E402
from culm.view.packing import unpacked  # noqa: E402

INPUTS = ROOT / "inputs"
SINGLE = 1e-6  # relative, of 32 bits


def data_of(page):
    """What is embedded in a page."""
    text = re.search(r'<script type="application/json" id="data">(.*?)</script>', page.read_text(), re.DOTALL)[1]
    return json.loads(text)


class Check:
    def __init__(self, program):
        self.program = program
        self.complaints = []

    def run(self, deck, folder, settings=()):
        done = self.program.run(INPUTS / deck, folder, settings)
        if not done.succeeded:
            sys.exit(done.errors)
        return done.folder

    def view(self, *arguments):
        return self.program.call("view", *arguments)

    def expect(self, holds, complaint):
        if not holds:
            self.complaints.append(complaint)

    def refused(self, words, *arguments, code=6):
        """One line that names the place, and no page."""
        done = self.view(*arguments)
        lines = done.stderr.splitlines()
        good = done.returncode == code and done.stdout == "" and len(lines) == 1 and words in done.stderr
        self.expect(good, f"{arguments}: exit {done.returncode}, {done.stdout}{done.stderr}")

    def numbers(self, scene, path):
        """All numbers of all states against the file."""
        with h5py.File(path) as file:
            for structure in scene["structures"]:
                name = structure["name"]
                for state, index in enumerate(scene["indices"]):
                    step = file[f"steps/{index:06}"]
                    mesh = next(group for group in file["mesh"].values() if group.attrs["name"] == name)
                    shown = unpacked(structure["displacement"])[state]
                    scale = numpy.abs(unpacked(structure["displacement"])).max() or 1.0
                    self.expect(
                        numpy.abs(shown - read_field(step, mesh, "displacement")).max() <= SINGLE * scale, f"{name}, displacement {index}"
                    )
                    for column, field in enumerate(structure["fields"]):
                        values = unpacked(field["values"])
                        error = numpy.abs(values[state, :, 0] - read_field(step, mesh, "resultants")[:, column]).max()
                        self.expect(error <= SINGLE * (numpy.abs(values).max() or 1.0), f"{name}, {field['name']} {index}")


def check_a_run(check, folder):
    run = check.run("shell/hinged_roof_path.xml", folder / "roof")
    done = check.view(run)
    check.expect(done.stdout == f"{run / 'view.html'}\n" and done.stderr == "", f"prints {done.stdout}{done.stderr}")
    scene = data_of(run / "view.html")["run"]
    check.expect(scene["notes"] == [] and len(scene["times"]) == 79, f"{scene['notes']}, {len(scene['times'])} states")
    held = {one["name"]: one for one in scene["structures"][0]["held"]}
    check.expect(
        set(held) == {"hinge", "plane x", "plane z"} and len(held["hinge"]["nodes"]) == 9, f"the roof is held by {held}"
    )
    check.numbers(scene, run / "run.h5")
    text = (run / "view.html").read_text()
    check.expect("http://" not in text.split('id="data"')[0], "the head of the page names an address")
    # fewer states, first and last among them
    check.view(run, "--states", 5, "--output", folder / "few.html")
    few = data_of(folder / "few.html")["run"]
    check.expect(few["indices"][0] == 0 and few["indices"][-1] == 78 and len(few["indices"]) == 5, f"{few['indices']}")
    check.expect(few["notes"] == ["Of 79 states 5 are shown."], f"{few['notes']}")
    return run


def check_outlines(check, folder):
    run = check.run("beam/three_point_bending.xml", folder / "bending")
    check.view(run)
    for structure in data_of(run / "view.html")["run"]["structures"]:
        outlines = structure["outlines"]
        count = unpacked(structure["reference"]).shape[0]
        check.expect(
            outlines is not None and unpacked(outlines["ofNode"]).tolist() == [0] * count, f"outlines {outlines}"
        )


def check_shapes(check, folder):
    """They are about the state before their analysis."""
    run = check.run("modes/rotating_beam.xml", folder / "modes")
    check.view(run)
    scene = data_of(run / "view.html")["run"]
    with h5py.File(run / "run.h5") as file:
        for analysis in scene["analyses"]:
            group = file["analyses"][analysis["name"]]
            check.expect(scene["indices"][analysis["base"]] == group.attrs["state"], f"{analysis['name']} is elsewhere")
            check.expect(analysis["shapes"] == list(group["shapes"].attrs["names"]), f"{analysis['shapes']}")
            for name, shape in analysis["real"].items():
                check.expect(numpy.allclose(unpacked(shape), group["shapes"][name], atol=SINGLE), f"{name} differs")
    check.expect(len(scene["analyses"]) > 0, "there are no shapes")


def check_runs_that_lack_something(check, folder, run):
    cut = folder / "unfinished"
    shutil.copytree(run, cut)
    with h5py.File(cut / "run.h5", "a") as file:
        del file["report"]
    done = check.view(cut)
    note = "The run has not come to its end; 79 states are recorded."
    check.expect(f"note: {note}" in done.stdout, done.stdout)
    check.expect(data_of(cut / "view.html")["run"]["notes"] == [note], "the page does not say so")
    failed = ["Structures/beam/Curve/Elements=12"]  # beyond which there is no equilibrium
    stopped = check.program.run(INPUTS / "beam/roll_up.xml", folder / "failed", failed)
    done = check.view(folder / "failed")
    check.expect(stopped.exit == 4 and done.returncode == 0, f"exit {stopped.exit}, {done.stderr}")
    check.expect("note: The run ended early: " in done.stdout, done.stdout)
    short = check.program.run(INPUTS / "shell/hinged_roof_path.xml", folder / "short", ["Analyses/snap/Steps=5"])
    done = check.view(folder / "short")
    check.expect(short.exit == 8 and "broken: path (snap, at " in done.stdout, f"exit {short.exit}, {done.stdout}")


def check_what_is_refused(check, folder, run):
    check.refused("there is no", folder / "nowhere")
    (folder / "empty").mkdir()
    check.refused("there is no run.h5 in", folder / "empty")
    damaged = folder / "damaged"
    damaged.mkdir()
    whole = (run / "run.h5").read_bytes()
    for content in (whole[: len(whole) // 2], b"no HDF5 at all", b""):
        (damaged / "run.h5").write_bytes(content)
        check.refused(f"cannot read '{damaged / 'run.h5'}'", damaged)
    with h5py.File(folder / "other.h5", "w") as file:
        file["x"] = 1
    check.refused("is not the result file of a run", folder / "other.h5")
    check.refused("cannot write", run, "--output", folder / "no folder" / "view.html")
    check.refused("is a deck, no run; 'culm check ", INPUTS / "beam/pendulum.xml")
    check.refused("argument --states: needs a whole number from 1 on, got '0'", run, "--states", 0, code=2)
    check.refused("there is no", run, folder / "nowhere")
    check.expect(list(damaged.iterdir()) == [damaged / "run.h5"], f"left over: {list(damaged.iterdir())}")


def total_of(scene, load):
    """Sum of the forces and moments of a load of a model that is not solved."""
    return sum(
        unpacked(one["actions"]).astype(float).sum(axis=0)
        for structure in scene["structures"]
        for one in structure["loaded"]
        if one["name"] == load
    )


def check_models(check, folder):
    """Loads of models that are not solved: their sums are those of their decks."""
    page = folder / "model.html"
    for deck, load, expected in (
        ("beam/three_point_bending.xml", "punch", [0, 0, -10, 0, 0, 0]),
        ("beam/roll_up.xml", "end moment", [0, 0, 0, 0, 2 * numpy.pi * 86.9e3 / 10, 0]),
        ("shell/plate_under_weight.xml", "weight", [0, 0, -0.01 * 0.25, 0, 0, 0]),
        # a pressure on what it projects to, 1 by 0.5 both ways
        ("shell/ring_under_pressure.xml", "inside", [5, 5, 0, 0, 0, 0]),
    ):
        for form in ("Null Space", "Multipliers"):
            settings = ["--set", f"Solver/Form={form}"]
            done = check.program.call("check", INPUTS / deck, "--quiet", "--view", page, *settings)
            check.expect(done.returncode == 0 and done.stdout == "", f"{deck}: {done.stdout}{done.stderr}")
            scene = data_of(page)["run"]
            check.expect(scene["notes"] == ["This is the model of a deck; nothing is solved."], f"{scene['notes']}")
            check.expect(scene["folder"] == pathlib.Path(deck).stem, scene["folder"])
            found = total_of(scene, load)
            error = numpy.abs(found - expected).max()
            check.expect(error <= 10 * SINGLE * numpy.abs(expected).max(), f"{deck}, {form}: {found}, expected {expected}")
            page.unlink()
    done = check.program.call("check", INPUTS / "beam/roll_up.xml", "--view", page, "--set", "Sections/bar/Type=Tub")
    check.expect(done.returncode == 3 and not page.exists(), f"a wrong deck: exit {done.returncode}")


def check_links(check, folder):
    """Springs and mooring lines of models that are not solved: their ends are the points that their decks name."""
    page = folder / "links.html"
    for deck, type, name, expected in (
        # anchor and fairlead of the spar of OC3
        ("offshore/moored_spar.xml", "Catenary", "line 1", [[853.87, 0, -320], [5.2, 0, -70]]),
        # points beside the nodes of two bodies
        ("joint/free_springs.xml", "Spring", "gap", None),
    ):
        done = check.program.call("check", INPUTS / deck, "--quiet", "--view", page)
        check.expect(done.returncode == 0, f"{deck}: {done.stderr}")
        scene = data_of(page)["run"]
        found = {(one["type"], one["name"]): unpacked(one["ends"]) for one in scene["links"]}
        check.expect((type, name) in found, f"{deck} shows {sorted(found)}")
        if expected is None:
            places = {one["name"]: (unpacked(one["reference"])[0], unpacked(one["referenceTriads"])[0]) for one in scene["structures"]}
            offsets = {"a": [0.3, 0.1, 0.0], "b": [-0.2, 0.1, 0.1]}
            expected = [places[body][0] + places[body][1] @ offsets[body] for body in "ab"]
        check.expect(numpy.allclose(found[(type, name)], [expected], rtol=1e-5, atol=1e-5), f"{deck}: {found[(type, name)]}, {expected}")
        page.unlink()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--culm", required=True)
    check = Check(Program(parser.parse_args().culm))
    with tempfile.TemporaryDirectory(prefix="culm") as name:
        folder = pathlib.Path(name)
        run = check_a_run(check, folder)
        check_outlines(check, folder)
        check_shapes(check, folder)
        check_runs_that_lack_something(check, folder, run)
        check_what_is_refused(check, folder, run)
        check_models(check, folder)
        check_links(check, folder)
    for complaint in check.complaints:
        print(f"FAILED: {complaint}")
    sys.exit(1 if check.complaints else 0)


if __name__ == "__main__":
    main()
