"""Results of a simulation whose steps this program makes, with detours: those of culm run."""

import pathlib
import subprocess
import sys

import culm

deck, program, folder, inputs = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])
overrides = [
    "Loads/push/Type=Line Force", "Loads/push/Structure=mast", "Loads/push/Force={57, 10, 0}",
    "Loads/push/Function=Constant", "Output/Every=5", "Output/Velocities=true", "Output/History/top/Type=Displacement",
    "Output/History/top/Node=mast/last", "Output/History/energy/Type=Energy",
    "Output/History/shake/Type=Acceleration", "Output/History/shake/Node=mast/last",
]


def make(name):
    mast = culm.Simulation(deck, overrides)
    if name == "detours":  # a port without loads changes nothing
        mast.add_port("net", [[0.2, 0.0, 3.0]], ["mast"], 1.0)
    mast.write_results(str(folder / name))
    return mast, mast.begin()


def rows(name):
    return len((folder / name / "history.csv").read_text().splitlines()) - 1


mast, stepper = make("straight")
stepper.run()
words = mast.close_results()
assert "50 steps accepted" in words and str(folder / "straight/run.h5") in words, words
assert mast.broken_promises == ""

mast, stepper = make("detours")
while not stepper.is_at_end:
    if stepper.steps == 17:
        here = stepper.save()
        for _ in range(9):
            assert stepper.attempt(stepper.time + 0.003)
            stepper.accept()
        assert rows("detours") == 27
        stepper.restore(here)
        assert rows("detours") == 18
    stepper.attempt(stepper.proposal + 0.01)
    mast.quantities()  # to ask for what is watched leaves no trace in what is written
    stepper.discard()
    assert stepper.attempt()
    seen = mast.quantities()
    stepper.accept()
    assert all(abs(seen[name] - value) < 1e-9 for name, value in mast.quantities().items()), name
mast.close_results()
assert (folder / "detours/port_skin.vtu").exists() and (folder / "detours/port_net.vtu").exists()

words = [word for one in overrides for word in ("--set", one)]
subprocess.run([program, "run", deck, *words, "--output", folder / "run", "--quiet"], check=True)
run = culm.read(folder / "run")
for name in ("straight", "detours"):
    assert (folder / name / "history.csv").read_bytes() == (folder / "run/history.csv").read_bytes(), name
    mine = culm.read(folder / name)
    assert len(mine.states) == len(run.states) == 11, (name, len(mine.states))

mast, stepper = make("early")
stepper.attempt()
stepper.accept()
mast.close_results()
assert rows("early") == 2
for call, words in ((stepper.attempt, "has ended"), (mast.close_results, "no results are written"),
                    (lambda: mast.write_results(str(folder / "late")), "before the first 'begin'")):
    try:
        call()
    except culm.UsageError as error:
        assert words in str(error), error
    else:
        raise AssertionError(words)
assert not (folder / "late").exists()
print("results step by step: as of culm run")

# of an open attempt as it would be accepted, also where parts of the model remember
for path, steps in (("plasticity/bent_bar.xml", 8), ("water/spar.xml", 25), ("contact/dragged_bar.xml", 8)):
    simulation = culm.Simulation(str(inputs / path))
    stepper = simulation.begin()
    changes = 0.0
    for _ in range(steps):
        before = simulation.quantities()
        stepper.attempt(stepper.proposal)
        seen, again = simulation.quantities(), simulation.quantities()
        stepper.accept()
        accepted = simulation.quantities()
        assert seen == again, (path, seen, again)
        for name, value in accepted.items():
            assert value is None or abs(seen[name] - value) <= 1e-7 * (1.0 + abs(value)), (path, stepper.time, name, seen[name], value)
        changes = max(changes, max(abs(value - before[name]) for name, value in accepted.items() if value is not None and before[name] is not None))
    assert changes > 0.0, path
