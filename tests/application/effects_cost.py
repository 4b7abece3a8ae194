"""An effect that is off has no object, no unknown, no matrix entry and no call: counted in the tables of effects
of runs with it and without it."""

import argparse
import functools
import pathlib
import re
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "src/python"))
from culm.program import Program  # noqa: E402

SPAGHETTI = "flight/spaghetti_3d"
FIDELITY = "Structures/beam/Fidelity"
MAST = "drag of the mast, drag of the box"
BRIEF = "Analyses/motion/End Time=0.2"
LINES = "line 1, line 2, line 3"
# A spar that needs no line, for a second.
HELD = ["Analyses/decay/End Time=1", *(f"Loads/hold/{one}" for one in ("Type=Ground Spring", "Node=spar", "Stiffness=1e5")),
        *(f"Constraints/yaw/{one}" for one in ("Type=Rotation", "Node=spar", "Axis={0, 0, 1}"))]


def without(analysis, loads):
    return [f"Analyses/{analysis}/Inactive={{{loads}}}"]


# How the line of an effect begins, a deck that has it, the settings of that run, and those that switch it off.
ADDED = [
    ("Gravity", "beam/pendulum", [], ["Analyses/motion/Inactive={weight}"]),
    ("Force", SPAGHETTI, [], ["Analyses/motion/Inactive={force}"]),
    ("Moment", SPAGHETTI, [], ["Analyses/motion/Inactive={moment}"]),
    ("Rotating Frame", "modes/rotating_beam", [], ["Analyses/spin/Inactive={rotation}", "Analyses/modes/Inactive={rotation}"]),
    ("Pressure", "shell/falling_tube", [], ["Analyses/fall/Inactive={pressure}"]),
    ("Spring", "joint/oscillators", [], ["Analyses/motion/Inactive={pair}"]),
    ("Directed Ground Damper", "joint/oscillators", [], ["Analyses/motion/Inactive={damper}"]),
    ("Torsion Drive", "joint/torsion", [], ["Analyses/motion/Inactive={motor}"]),
    ("Strip", "air/goland_flutter", ["Analyses/flutter/Levels={20, 60}"],
     ["Analyses/flutter/Levels={20, 60}", "Analyses/flutter/Inactive={air on the wing}"]),
    ("Vortex Lattice", "air/goland", ["Analyses/motion/End Time=0.01"],
     ["Analyses/motion/End Time=0.01", "Analyses/motion/Inactive={flow about the wing}"]),
    ("Strip Drag", "air/mast_in_wind", [BRIEF], [BRIEF, *without("wind", MAST), *without("motion", MAST)]),
    ("Rotor", "turbine/nrel5mw/rotor", [BRIEF], [BRIEF, *without("motion", "rotor")]),
    ("Morison", "water/floating_pipe", [BRIEF], [BRIEF, *without("motion", "waves")]),
    ("Potential Flow", "water/potential_cylinder", [BRIEF], [BRIEF, *without("motion", "water")]),
    ("Soil", "soil/swaying_pile", [], [*without("sway", "soil")]),
    ("Temperature", "heat/flying_bar", [], without("motion", "sun")),
    ("Beam Contact", "contact/rolling_rod", [BRIEF], [BRIEF, *without("motion", "left, right")]),
    ("Cylinder Contact", "contact/struck_beam", [BRIEF], [BRIEF, *without("motion", "blow")]),
    ("Catenary", "offshore/moored_spar", HELD, [*HELD, *without("rest", f"pull, {LINES}"), *without("pulled", LINES),
                                                *without("decay", f"pull, {LINES}")]),
    ("Plane Contact", "contact/sliding_ball", [BRIEF], [BRIEF, *without("motion", "ground")]),
    ("Kirchhoff", SPAGHETTI, [f"{FIDELITY}=Kirchhoff"], [f"{FIDELITY}=Full"]),
    ("Torsion held", SPAGHETTI, ["Structures/beam/Torsion=false"], []),
    ("Checkpoints", SPAGHETTI, [], ["Output/Checkpoints=false"]),
]

# The same where another effect takes its place: one kind of element, and of mass, instead of another.
REPLACED = [
    ("Beam, director", SPAGHETTI, [], [f"{FIDELITY}=Rigid"]),
    ("Rigid beams", SPAGHETTI, [f"{FIDELITY}=Rigid"], [f"{FIDELITY}=Full"]),
    ("Beam, linear", SPAGHETTI, [f"{FIDELITY}=Linear"], [f"{FIDELITY}=Full"]),
    ("Shell", "shell/tumbling_cylinder", [], ["Structures/tube/Fidelity=Rigid"]),
    ("Shell, linear", "shell/cantilever_shear", ["Structures/strip/Fidelity=Linear"], ["Structures/strip/Fidelity=Full"]),
    ("Beam, Kirchhoff", SPAGHETTI, [f"{FIDELITY}=Kirchhoff"], [f"{FIDELITY}=Full"]),
    ("Beam, director without torsion", SPAGHETTI, ["Structures/beam/Torsion=false"], []),
]


# Entries of the history of these decks that watch the effect, so that they need it.
WATCHING = {
    "air/mast_in_wind": ["mast", "box"],
    "turbine/nrel5mw/rotor": ["rotor"],
    "water/floating_pipe": ["sea"],
    "water/potential_cylinder": ["water"],
    "contact/rolling_rod": ["left", "right"],
    "contact/sliding_ball": ["ground"],
    "contact/struck_beam": ["blow"],
    "offshore/moored_spar": ["line 1", "line 2"],
}


def unwatched(deck, folder):
    """A deck without what watches the effect, beside copies of the files that it reads."""
    source = ROOT / "inputs" / f"{deck}.xml"
    if deck not in WATCHING:
        return source
    copied = pathlib.Path(shutil.copytree(source.parent, pathlib.Path(folder) / "deck")) / source.name
    before, history = copied.read_text().split('<ParameterList name="History">')
    for name in WATCHING[deck]:
        history = re.sub(rf'<ParameterList name="{name}">.*?</ParameterList>', "", history, count=1, flags=re.DOTALL)
    copied.write_text(before + '<ParameterList name="History">' + history)
    return copied


@functools.cache
def effects(program, deck, *settings):
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        run = program.run(unwatched(deck, folder), pathlib.Path(folder) / "run", settings)
        if not run.succeeded:
            sys.exit(f"{deck} {settings}: {run.outcome}\n{run.errors}")
        return run.results.effects()


def unknowns(table):
    return next(e.unknowns for e in table if e.name.startswith("Factorisation"))


def entries(table):
    return sum(e.entries or 0 for e in table)


def complaints(program, name, deck, on, off, is_replaced):
    whole, without = effects(program, deck, *on), effects(program, deck, *off)
    lines = [e for e in whole if e.name.startswith(name)]
    if not lines or not all(e.calls > 0 for e in lines):
        yield "it is not there when it is on"
    if any(e.name.startswith(name) for e in without):
        yield "it has an object, or calls, when it is off"
    if is_replaced:
        return
    owned = sum(e.unknowns or 0 for e in lines)
    if unknowns(without) != unknowns(whole) - owned:
        yield f"unknowns: {unknowns(without)} without it, {unknowns(whole)} with it, {owned} are its own"
    added = sum(e.entries or 0 for e in lines)
    if entries(without) != entries(whole) - added:
        yield f"entries: {entries(without)} without it, {entries(whole)} with it, {added} are its own"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--culm", required=True)
    program = Program(parser.parse_args().culm)
    failures = 0
    for cases, is_replaced in ((ADDED, False), (REPLACED, True)):
        for name, deck, on, off in cases:
            found = list(complaints(program, name, deck, on, off, is_replaced))
            print(f"{name}, {deck}: {'; '.join(found) or 'costs nothing when it is off'}")
            failures += bool(found)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
