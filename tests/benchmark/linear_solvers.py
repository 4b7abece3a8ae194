#!/usr/bin/python3
"""What the linear solver costs in whole motions: Block LU and KLU2 in turn, on one core.

    tests/benchmark/linear_solvers.py --culm build/release/src/culm [--sizes 10 100] [--repeat 3]

Prints the table of doc/verification/speed.md: CPU seconds of the time loop as in dynamics.py, the
least of all repeats, and how far the paths are apart. The parts are from the ledger of the run.
"""

import argparse
import tempfile

from dynamics import (CHAIN, END, INPUTS, PENDULUM, SPAGHETTI, STEP, STEPS, Measurement, deck_of,
                      trajectory_difference)

SOLVERS = ("KLU2", "Block LU")
TURBINE = "turbine/nrel5mw/turbine_operation.xml"


def cases(sizes, folder):
    """Name, deck, settings, and what makes the run long or short."""
    for problem in (PENDULUM, SPAGHETTI, CHAIN):
        for size in sizes:
            deck, settings = deck_of(problem, size, folder)
            step = f"{STEP}={problem.step}"
            yield (f"{problem.name}, N = {size}", deck, settings,
                   [f"{END}={problem.step * STEPS}", step], [f"{END}={problem.step}", step])
    yield ("NREL 5 MW turbine, 11 s", INPUTS / TURBINE, [], ["stop=10", "end=11"],
           ["stop=0.01", "end=0.02"])


def part(run, name):
    """Seconds of a part of the ledger, in wall time."""
    return sum(row[3] for row in run.ledger() if row[0].startswith(name))


def measure(arguments, deck, settings, long, short, folder):
    """By solver: the best run, with the CPU seconds of its loop."""
    best, start = {}, {}
    for _ in range(arguments.repeat):
        for solver in SOLVERS:
            chosen = [*settings, f"Solver/Linear Solver={solver}"]
            for runs, length in ((best, long), (start, short)):
                run = Measurement(arguments.culm, deck, [*chosen, *length], folder)
                if solver not in runs or run.cpu < runs[solver].cpu:
                    runs[solver] = run
    for solver in SOLVERS:
        best[solver].cpu -= start[solver].cpu
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True, help="the program")
    parser.add_argument("--sizes", nargs="*", type=int, default=[10, 100, 1000])
    parser.add_argument("--repeat", type=int, default=1)
    arguments = parser.parse_args()
    print("| problem | CPU of the loop, KLU2 / Block LU [s] | ratio | factorisation, ratio | "
          "solution, ratio | paths differ by |")
    print("|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        for name, *case in cases(arguments.sizes, folder):
            runs = measure(arguments, *case, folder)
            klu2, blocks = (runs[solver] for solver in SOLVERS)
            ratios = [part(klu2, effect) / part(blocks, effect)
                      for effect in ("Factorisation", "Solution")]
            print(f"| {name} | {klu2.cpu:.3g} / {blocks.cpu:.3g} | {klu2.cpu / blocks.cpu:.2f} | "
                  f"{ratios[0]:.1f} | {ratios[1]:.1f} | "
                  f"{trajectory_difference(klu2.history, blocks.history):.0e} |", flush=True)


if __name__ == "__main__":
    main()
