#!/usr/bin/env python3
"""What going back costs: discard, save and restore beside an attempt of a step.

usage: PYTHONPATH=BUILD/share/culm/python:BUILD/share/culm/module rollback.py [repeats]
"""

import pathlib
import sys
import time

import culm

INPUTS = pathlib.Path(__file__).resolve().parents[2] / "inputs"
CASES = [
    ("flight/chain.xml", "", []),
    ("flight/spaghetti_3d.xml", "", ["Structures/beam/Curve/Elements=100"]),
    ("turbine/nrel5mw/turbine_operation.xml", "start-up", ["T=2", "stop=3", "end=5"]),
    ("shell/tumbling_cylinder.xml", "", []),
]


def measure(deck, analysis, overrides, repeats):
    """The shortest time of each verb [s]."""
    simulation = culm.Simulation(str(INPUTS / deck), overrides)
    if analysis == "start-up":
        simulation.begin("weight").run()
    stepper = simulation.begin(analysis)
    for _ in range(5):
        stepper.attempt()
        stepper.accept()
    best = dict.fromkeys(("attempt", "discard", "save", "restore"), float("inf"))

    def clock(verb, action, *arguments):
        start = time.perf_counter()
        result = action(*arguments)
        best[verb] = min(best[verb], time.perf_counter() - start)
        return result

    for _ in range(repeats):
        clock("attempt", stepper.attempt)
        clock("discard", stepper.discard)
        clock("restore", stepper.restore, clock("save", stepper.save))
    return len(simulation.coordinates), best


def main():
    repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    print(f"{'deck':40} {'nodes':>6} {'attempt':>11} {'discard':>9} {'save':>9} {'restore':>9}")
    for deck, analysis, overrides in CASES:
        nodes, best = measure(deck, analysis, overrides, repeats)
        shares = " ".join(f"{best[verb] / best['attempt']:8.2%} " for verb in ("discard", "save", "restore"))
        print(f"{deck:40} {nodes:6} {1e6 * best['attempt']:8.1f} us {shares}")


if __name__ == "__main__":
    main()
