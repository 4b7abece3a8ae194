#!/usr/bin/python3
"""Speed of the time loop: flexible pendulum, flying spaghetti, rigid chain; on one core.

    tests/benchmark/dynamics.py --culm build/release/src/culm [--sizes 10 100] [--repeat 3]
        [--set "Analyses/motion/Newton/…=…"]

Prints the tables of doc/verification/speed.md. CPU seconds of the loop are those of the whole
process less those of the same deck stopped after its first step, the least of all repeats. The parts
are from the ledger of the run, in wall time.
"""

import argparse
import math
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "kit"))
from culm_runs import INPUTS, MPI_ENVIRONMENT, History  # noqa: E402

STEPS = 1000
END = "Analyses/motion/End Time"
STEP = "Analyses/motion/Step"


def write_list(name, *content):
    return f'<ParameterList name="{name}">{"".join(content)}</ParameterList>\n'


def parameters(**values):
    return "".join(f'<Parameter name="{name.replace("_", " ")}" value="{value}"/>'
                   for name, value in values.items())


def rigid_chain(links):
    """The deck of a chain of links of 1 m and 1 kg, horizontal at rest, on a pin."""
    bodies = [write_list(f"link {i}", parameters(
        Type="Rigid Body", Position=f"{{{i + 0.5}, 0, 0}}", Mass=1, Inertia="{0.01, 1/12, 1/12}"))
        for i in range(links)]
    joints = [write_list(f"joint {i}", parameters(
        Type="Spherical Joint", First=f"link {i - 1}", Second=f"link {i}",
        Position=f"{{{i}, 0, 0}}")) for i in range(1, links)]
    pin = write_list("pin", parameters(Type="Spherical Support", Node="link 0",
                                       Offset="{-0.5, 0, 0}"))
    weight = write_list("weight", parameters(Type="Gravity", Acceleration="{0, -9.81, 0}"))
    motion = write_list("motion", parameters(Type="Dynamic", End_Time=1, Step=1e-3))
    end = write_list("end", parameters(Type="Position", Node=f"link {links - 1}"))
    return write_list(
        "culm", write_list("Structures", *bodies), write_list("Constraints", pin, *joints),
        write_list("Loads", weight), write_list("Analyses", motion),
        write_list("Output", write_list("History", end)))


class Problem:
    """A deck for any number of elements, its reference, and what is asked of it."""

    def __init__(self, name, step, watched, reference, goals, peers):
        self.name = name
        self.step = step
        self.watched = watched
        self.reference = reference  # a position, or one by size
        self.goals = goals  # CPU seconds by size
        self.peers = peers

    def error(self, history, size):
        reference = self.reference
        if isinstance(reference, dict):
            if size not in reference:
                return math.nan
            reference = reference[size]
        return math.dist(history.vector(self.watched)[: len(reference)], reference)


# converged in mesh and step; a second-order scheme with this step ends 1.1e-3 m away
PENDULUM = Problem("flexible pendulum", 5e-3, "tip", (6.5239, -7.5077), {100: 0.5, 1000: 5.0},
                   {100: "0.73–2.0", 1000: "6.8–23"})
SPAGHETTI = Problem("flying spaghetti", 1e-2, "other end", (38.312, 5.196, 4.252),
                    {100: 0.5, 1000: 5.0}, {100: "1–1.4", 1000: "10–15"})
CHAIN = Problem("rigid chain", 1e-3, "end",
                {10: (7.0272, -4.9056), 100: (98.5375, -4.9050), 1000: (999.0648, -4.9050)},
                {10: 0.04, 100: 0.4, 1000: 4.0},
                {10: "0.042–0.17", 100: "0.44–2.5", 1000: "6.8–23"})


def deck_of(problem, size, folder):
    """The path of the deck and the settings that make it of this size."""
    if problem is PENDULUM:
        return INPUTS / "beam/pendulum.xml", [f"N={size}"]
    if problem is SPAGHETTI:
        return INPUTS / "flight/spaghetti_3d.xml", [f"Structures/beam/Curve/Elements={size}"]
    path = pathlib.Path(folder) / "chain.xml"
    path.write_text(rigid_chain(size))
    return path, []


def seconds(text):
    value, unit = text.split()
    return float(value) * {"s": 1.0, "ms": 1e-3, "µs": 1e-6}[unit]


class Measurement:
    """One run: CPU seconds, closing words, ledger, and where the watched point ends."""

    def __init__(self, program, deck, settings, folder):
        command = [program, "run", str(deck), "--output", folder]
        for setting in [*settings, "Output/Pictures=false", f"Output/Every={STEPS}"]:
            command += ["--set", setting]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run = subprocess.run(command, capture_output=True, text=True,
                             env={**os.environ, **MPI_ENVIRONMENT})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if run.returncode != 0:
            sys.exit(f"{command}: exit code {run.returncode}\n{run.stderr}")
        self.cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.output = run.stdout
        self.history = History(pathlib.Path(folder) / "history.csv")

    def number(self, pattern):
        return float(re.search(pattern, self.output).group(1))

    def ledger(self):
        """Rows of the table of effects: name, unknowns, entries per iteration, seconds."""
        table = self.output[self.output.index("\neffect") + 1 :].split("\n\n")[0].splitlines()[1:]
        rows = []
        for line in table:
            name, _, unknowns, entries, time, _ = re.split(r" {3,}", line.strip())
            count = [0 if x == "–" else int(x) for x in (unknowns, entries)]
            rows.append((name, *count, seconds(time)))
        return rows


FORMS = {
    "null space": ["Solver/Form=Null Space"],
    "null space, old factors": ["Solver/Form=Null Space",
                                "Analyses/motion/Newton/Refresh=On Slow Convergence"],
    "multipliers": ["Solver/Form=Multipliers"],
}


def measure(arguments, problem, size, form):
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        deck, settings = deck_of(problem, size, folder)
        settings = [*settings, *FORMS[form], *arguments.set]
        whole = [f"{END}={problem.step * STEPS}", f"{STEP}={problem.step}"]
        first = [f"{END}={problem.step}", f"{STEP}={problem.step}"]
        best = start = None
        for _ in range(arguments.repeat):
            run = Measurement(arguments.culm, deck, [*settings, *whole], folder)
            best = run if best is None or run.cpu < best.cpu else best
            one = Measurement(arguments.culm, deck, [*settings, *first], folder)
            start = one if start is None or one.cpu < start.cpu else start
    best.cpu -= start.cpu
    return best


def text_of(value, form):
    return "–" if value is None or math.isnan(value) else f"{value:{form}}"


def print_times(results):
    print("| problem | N | form | CPU of the loop [s] | goal | peers | iterations | per element "
          "and iteration [µs] | energy | error of the end [m] |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for problem, size, form, run in results:
        iterations = run.number(r"cut back; (\d+) iterations")
        print(f"| {problem.name} | {size} | {form} | {run.cpu:.3g} | "
              f"{text_of(problem.goals.get(size), 'g')} | {problem.peers.get(size, '–')} | "
              f"{iterations:.0f} | {1e6 * run.cpu / iterations / size:.2f} | "
              f"{run.number(r'energy balance +([^ ]+)'):.0e} | "
              f"{text_of(problem.error(run.history, size), '.1e')} |")


GROUPS = (("elements, bodies", r"Beam|Rigid bod"), ("joints, supports", r"Joint|Support|Connection"),
          ("factorisation", "Factorisation"), ("solution", "Solution"),
          ("update, loads", "Update|Gravity|Force|Moment"), ("certificate", "Certificate"),
          ("quantities", "Quantities"),
          ("output", "Output"))


def print_parts(results):
    print("\n| problem | N | form | unknowns | matrix entries per iteration | "
          + " | ".join(f"{name} [s]" for name, _ in GROUPS) + " |")
    print("|---|---|---|---|---|" + "---|" * len(GROUPS))
    for problem, size, form, run in results:
        rows = run.ledger()
        unknowns = next(row[1] for row in rows if row[0].startswith("Factorisation"))
        parts = [sum(row[3] for row in rows if re.match(f".*({pattern})", row[0]))
                 for _, pattern in GROUPS]
        print(f"| {problem.name} | {size} | {form} | {unknowns} | "
              f"{sum(row[2] for row in rows)} | " + " | ".join(f"{p:.3g}" for p in parts) + " |")


def trajectory_difference(one, other):
    """Largest difference of a coordinate of the watched point over the first 500 steps, over the
    largest coordinate."""
    pairs = [(a, b) for name in one.names if name in other.names and "[m]" in name
             for a, b in zip(one.column(name)[:501], other.column(name)[:501])]
    return max(abs(a - b) for a, b in pairs) / max(abs(a) for a, _ in pairs)


def print_ratios(results):
    print("\n| problem | N | CPU, multipliers over null space | factorisation | "
          "unknowns | entries | paths over 500 steps differ by |")
    print("|---|---|---|---|---|---|---|")
    runs = {(problem.name, size, form): run for problem, size, form, run in results}
    for (name, size, form), run in runs.items():
        other = runs.get((name, size, "multipliers"))
        if form != "null space" or other is None:
            continue
        totals = []
        for one in (run, other):
            rows = one.ledger()
            factor = next(row for row in rows if row[0].startswith("Factorisation"))
            totals.append((one.cpu, factor[3], factor[1], sum(row[2] for row in rows)))
        print(f"| {name} | {size} | " + " | ".join(
            f"{b / a:.2f}" for a, b in zip(*totals))
              + f" | {trajectory_difference(run.history, other.history):.0e} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True, help="the program")
    parser.add_argument("--sizes", nargs="*", type=int, default=[10, 100, 1000])
    parser.add_argument("--forms", nargs="*", choices=FORMS, default=list(FORMS))
    parser.add_argument("--problems", nargs="*", default=["pendulum", "spaghetti", "chain"])
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--set", action="append", default=[], help="of the deck, as for culm run")
    arguments = parser.parse_args()
    known = subprocess.run([arguments.culm, "reference"], capture_output=True, text=True,
                           env={**os.environ, **MPI_ENVIRONMENT}).stdout
    forms = [form for form in arguments.forms if "old factors" not in form or "`Refresh`" in known]
    results = []
    for problem in (PENDULUM, SPAGHETTI, CHAIN):
        if not any(word in problem.name for word in arguments.problems):
            continue
        for size in arguments.sizes:
            for form in forms:
                results.append((problem, size, form, measure(arguments, problem, size, form)))
                print(f"{problem.name}, {size}, {form}: done", file=sys.stderr)
    print_times(results)
    print_parts(results)
    print_ratios(results)


if __name__ == "__main__":
    main()
