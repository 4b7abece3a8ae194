#!/usr/bin/env python3
"""Runs a deck and compares its history with the expected values.

usage: run_deck.py --culm PROGRAM [--mpiexec PROGRAM --ranks N] DECK.xml EXPECTED.xml

What an expected file holds, see README.md beside this file. One process runs the deck, both forms
of the equations and another linear solver where the file says so, and the variants that must fail. With --ranks the deck
runs on that many instead, compared with the same file, and with a run on one.
"""

import argparse
import math
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "kit"))
from culm_runs import Culm  # noqa: E402

RANKS_TOLERANCE = 1e-12
# other ways to solve the same equations: by element of an expected file, how to ask for them
VARIANTS = {
    "Forms": ("Solver/Form=Multipliers", "null space and multipliers"),
    "Solvers": ("Solver/Linear Solver=KLU2", "the linear solver that was taken and KLU2"),
}
VARIANTS_TOLERANCE = 1e-9
# of eigenvalues: rounding counts in proportion to the highest one of the model
TABLES_TOLERANCE = 1e-6
COMPARED_COLUMNS = ("frequency [Hz]", "factor")


def unit_of(column):
    return column[column.rindex("[") + 1 : -1]


def scales(history, size, force, stress):
    """What differences are divided by, for each unit: lengths by the size of the model, forces by
    the largest force, a moment or an energy counting as one at that distance, others, such as
    stresses, by the largest of their unit."""
    by_unit = {"N/m^2": stress}
    for name in history.names:
        arm = {"N": 1.0, "N m": size, "J": size}.get(unit_of(name))
        largest = max((abs(value) for value in history.column(name) if not math.isnan(value)), default=0.0)
        if arm:
            force = max(force, largest / arm)
        by_unit[unit_of(name)] = max(largest, by_unit.get(unit_of(name), 1e-300))
    return {**by_unit, "m": size, "rad": 1.0, "N": force, "N m": force * size, "J": force * size}


def is_path(history):
    return any(b < a for a, b in zip(history.levels, history.levels[1:]))


def row_like(one, other, j):
    """The row of one history that ends at the level of a row of another one, in the same analysis and both or none of them
    its start; None if there is none."""
    level = other.levels[j]
    for i, found in enumerate(one.levels):
        if abs(found - level) > 1e-9 * max(1.0, abs(level)):
            continue
        if one.analyses[i] == other.analyses[j] and (one.steps[i] == 0) == (other.steps[j] == 0):
            return i
    return None


def compare(one, other, scale, tolerance, what, part=False):
    """Complaints about differences between two histories at the levels they share; on a path, whose
    level goes up and down, between all rows, or those of the other one if that is a part of the first."""
    shared = 0
    worst = (0.0, "")
    if is_path(one) and len(one.levels) != len(other.levels) and not (part and len(other.levels) < len(one.levels)):
        return [f"{what}: {len(one.levels)} and {len(other.levels)} rows"]
    for j, level in enumerate(other.levels):
        i = j if is_path(one) else row_like(one, other, j)
        if i is None:
            continue
        shared += j > 0
        if is_path(one):
            difference = abs(one.levels[i] - level) / max(map(abs, one.levels))
            worst = max(worst, (difference, f"level {level:g}"))
        for name in one.names:
            a, b = one.column(name)[i], other.column(name)[j]
            if math.isnan(a) and math.isnan(b):  # of a load or constraint that does not act
                continue
            difference = abs(a - b) / scale[unit_of(name)]
            if math.isnan(difference):
                difference = math.inf
            worst = max(worst, (difference, f"'{name}' at level {level:g}"))
    print(f"{what}: largest relative difference {worst[0]:.1e} in {shared} steps")
    if shared == 0 and one.levels != [0.0]:  # analyses that make no steps
        return [f"{what}: no step in common"]
    if worst[0] > tolerance:
        return [f"{what}: {worst[1]} differs by {worst[0]:.2e}, allowed {tolerance:g}"]
    return []


def compare_tables(one, other, what):
    """Complaints about differences between eigenvalues of two runs."""
    complaints = []
    for name, table in one.items():
        for column in COMPARED_COLUMNS:
            if column not in table.names:
                continue
            pairs = list(zip(table.column(column), other[name].column(column), strict=True))
            pairs = [(a, b) for a, b in pairs if not (math.isnan(a) and math.isnan(b))]  # empty cells
            if not pairs:
                continue
            largest = max(max(abs(a), abs(b)) for a, b in pairs)
            worst = max(abs(a - b) for a, b in pairs) / max(largest, 1e-300)
            print(f"{what}: table {name}, {column}: largest relative difference {worst:.1e}")
            if not worst <= TABLES_TOLERANCE:
                complaints.append(f"{what}: '{column}' of {name} differs by {worst:.2e}")
    return complaints


def find_value(run, value):
    """What was found, and where: in a row of a table, or at a level or a step of the history."""
    column = value.get("column")
    if value.get("table"):
        row = int(value.get("row"))
        return run.tables[value.get("table")].at(row, column), f"row {row} of {value.get('table')}"
    if value.get("step"):
        row = int(value.get("step"))
        values = run.history.levels if column == "level" else run.history.column(column)
        return values[row], f"step {row}"
    level = float(value.get("level", 1.0))
    return run.history.at(level, column), f"level {level:g}"


def check_values(run, expected, what):
    complaints = []
    for group in expected.findall("Values"):
        tolerance = float(group.get("tolerance"))
        for value in group.findall("Value"):
            found, place = find_value(run, value)
            wanted = float(value.get("is"))
            if not abs(found - wanted) <= tolerance:
                complaints.append(
                    f"{what}: '{value.get('column')}' at {place} is {found:.12g}, expected "
                    f"{wanted:.12g} within {tolerance:g} ({group.get('source')})"
                )
    return complaints


def overrides(element, attribute="set"):
    return [one.strip() for one in element.get(attribute, "").split(";") if one.strip()]


def check_failure(culm, deck, failure, ranks):
    """A variant of the deck that has no solution must say why."""
    run = culm.run(deck, overrides(failure), ranks)
    what = f"{ranks} ranks, {failure.get('set')}"
    complaints = []
    if run.exit != int(failure.get("exit")):
        complaints.append(f"{what}: exit code {run.exit}, expected {failure.get('exit')}")
    if failure.get("says") not in run.errors:
        complaints.append(f"{what}: does not say '{failure.get('says')}' but\n{run.errors}")
    return complaints


def is_as_expected(errors, warning, brief):
    """Silence, or warnings of all that the deck has to warn of, parted by semicolons, and no other; of some in a run that
    does not go so far."""
    wanted = [part.strip() for part in warning.split(";")] if warning else []
    lines = errors.splitlines()
    return (brief or all(any(part in line for line in lines) for part in wanted)) and all(
        line.startswith("warning: ") and any(part in line for part in wanted) for line in lines
    )


def check_run(culm, deck, expected, ranks, complaints, brief=False):
    """A run as the file expects it; None, with a complaint, if it failed. A brief one is as the file wants it on several
    ranks, and does not come to the values if that is shorter."""
    shorter = overrides(expected, "briefly") if brief else []
    other = overrides(expected, "ranks") if brief else []
    run = culm.run(deck, [*overrides(expected), *other, *shorter], ranks)
    if run.exit != 0 or not is_as_expected(run.errors, expected.get("warns"), bool(shorter)):
        complaints.append(f"{ranks} ranks: exit code {run.exit}\n{run.errors}")
        return None
    if not shorter:
        complaints += check_values(run, expected, f"{ranks} ranks")
    return run


def scale_of(expected, history):
    size, force = float(expected.get("size")), float(expected.get("force", 1e-300))
    return scales(history, size, force, float(expected.get("stress", 1e-300)))


def check_alone(culm, deck, expected):
    complaints = []
    run = check_run(culm, deck, expected, 1, complaints)
    for name, (setting, what) in VARIANTS.items():
        for variant in expected.findall(name) if run else []:
            other = culm.run(deck, [setting, *overrides(expected), *overrides(variant)])
            if other.exit != 0:
                complaints.append(f"{setting}: exit code {other.exit}\n{other.errors}")
                continue
            tolerance = float(variant.get("tolerance", VARIANTS_TOLERANCE))
            scale = scale_of(expected, run.history)
            complaints += compare(run.history, other.history, scale, tolerance, what, part="set" in variant.keys())
            complaints += compare_tables(run.tables, other.tables, what)
    for failure in expected.findall("Fails"):
        complaints += check_failure(culm, deck, failure, ranks=1)
    return complaints


def check_parallel(culm, deck, expected, ranks):
    complaints = []
    alone = check_run(culm, deck, expected, 1, complaints, brief=True)
    run = check_run(culm, deck, expected, ranks, complaints, brief=True) if alone else None
    if run:
        what = f"1 and {ranks} ranks"
        scale = scale_of(expected, alone.history)
        complaints += compare(alone.history, run.history, scale, RANKS_TOLERANCE, what)
        complaints += compare_tables(alone.tables, run.tables, what)
    for failure in expected.findall("Fails"):
        complaints += check_failure(culm, deck, failure, ranks)
    return complaints


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("deck", type=pathlib.Path)
    parser.add_argument("expected", type=pathlib.Path)
    arguments = parser.parse_args()
    if not arguments.expected.exists():
        sys.exit(f"{arguments.deck} has no expected values: write {arguments.expected}")
    expected = ElementTree.parse(arguments.expected).getroot()
    culm = Culm(arguments.culm, arguments.mpiexec)
    deck = arguments.deck.resolve()
    if arguments.ranks > 1:
        complaints = check_parallel(culm, deck, expected, arguments.ranks)
    else:
        complaints = check_alone(culm, deck, expected)
    for complaint in complaints:
        print(complaint)
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
