#!/usr/bin/python3
"""Decks in other units, another pose, another order: results must change as these do, and no more.

usage: metamorphic.py --culm PROGRAM [--all | DECK.xml ...]

Runs each deck as `culm check --resolved` writes it and after each change of transformations.py, and compares histories,
frequencies, buckling factors, exit codes and the number of warnings. Without decks those of DECKS, which cover the kinds of
structures, joints, loads and analyses; with --all every deck of inputs/ that runs within seconds, to look at what differs:
models that are chaotic, have repeated modes or laws with numbers of a unit of their own do.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "kit"))
from culm_runs import INPUTS, Culm  # noqa: E402
from transformations import InTurn, Reference, Reorder, Scale, Turn, Unsuitable, find, numbers, parameters, value  # noqa: E402

# Powers of two change no digit, so another unit of mass gives the same digits but for logarithms of determinants; that of
# time moves shifts of eigenvalues; lengths weigh forces against moments, where Newton's method judges residuals.
SMALL = Scale(1.0, 2.0**-14)
LARGE = Scale(1.0, 2.0**10)
# Of changes in a row the first that suits the deck, with the difference allowed.
CHANGES = (
    ((Scale(2.0**10, 1.0),), 1e-12),
    ((Scale(1.0, 2.0**10, 2.0**-7), LARGE), 2e-8),
    ((SMALL,), 1e-6),
    ((InTurn(Turn(), Reorder()), Turn(), Reorder()), 2e-8),
)
DECKS = (
    "beam/alternate_masses", "beam/coil_spring", "beam/composite_cantilever", "beam/elastica_shear", "beam/fidelity", "beam/foldable_ring",
    "beam/follower_line_loads", "beam/portal_frame", "beam/right_angle_frame", "beam/roll_up_helical", "beam/tapered_tower",
    "buckling/column", "contact/pressed_rod", "control/variable_speed", "flight/spaghetti_3d",
    "heat/bimetal_plate", "hybrid/tube_transition", "joint/four_bar_2", "joint/initial_displacements",
    "joint/moving_supports", "joint/points_along_beams", "joint/spring_statics", "joint/torsion", "modes/damped_frame",
    "modes/overhung_disk", "plasticity/bent_bar", "sequence/release", "shell/angle_ply", "shell/hypar", "shell/linear_strips",
)  # fmt: skip
# In models of tenths of a millimetre moments weigh so little beside forces that steps end before they are balanced as well as
# at full size: a path takes other steps, an energy balance misses its promise and says so.
LEFT_OUT = {("beam/right_angle_frame", SMALL), ("joint/initial_displacements", SMALL)}
TABLE_COLUMNS = ("frequency [Hz]", "damping ratio", "factor", "critical level")


def is_compared(name):
    return name.startswith(TABLE_COLUMNS)


class Results:
    """Of one run: columns of the history and of tables by their names."""

    def __init__(self, run):
        self.exit = run.exit
        self.errors = run.errors
        self.warnings = run.errors.count("warning:")
        self.tables = {}
        if run.history:
            columns = {name: np.array(column) for name, column in run.history.columns.items()}
            self.tables["history"] = {"time": np.array(run.history.levels), **columns}
        for name, table in run.tables.items():
            self.tables[name] = {n: np.array(table.column(n)) for n in table.names if is_compared(n)}


def unit_of(column):
    return column[column.rindex("[") + 1 : -1] if column.endswith("]") else column


def sizes(columns):
    """What differences of each unit are compared with: the largest of it; of forces and moments, of moments and energies
    that of a force at the length of the largest displacement."""
    size = {}
    for name, column in columns.items():
        largest = np.nanmax(np.abs(column), initial=0.0)
        size[unit_of(name)] = max(largest, size.get(unit_of(name), 0.0))
    arm = size.get("m") or 1.0
    force = max(size.get("N", 0.0), size.get("N m", 0.0) / arm)
    for unit, least in (("N", force), ("N m", force * arm), ("J", force * arm), ("rad", 1.0), ("damping ratio", 1.0)):
        if unit in size or unit.startswith("damping"):
            size[unit] = max(size.get(unit, 0.0), least)
    return size


def differences(one, other, change):
    """What differs, as (relative difference, words), the worst first."""
    found = []
    if one.exit != other.exit or one.warnings != other.warnings:
        words = f"exit code {one.exit} with {one.warnings} warnings, then {other.exit} with {other.warnings}"
        return [(np.inf, f"{words}: {other.errors[:300]}")]
    for table, columns in one.tables.items():
        size = sizes(columns)
        for name, column in columns.items():
            changed = change.column(name, other.tables[table])
            if len(changed) != len(column) or (np.isnan(changed) != np.isnan(column)).any():
                found.append((np.inf, f"{table}, {name}: {len(column)} rows, then {len(changed)}, or other cells are empty"))
                continue
            by = size.get("damping ratio" if name.startswith("damping") else unit_of(name)) or 1.0
            difference = np.nanmax(np.abs(changed - column), initial=0.0)
            found.append((difference / by, f"{table}, {name}: {difference:.2e} of {by:.3g}"))
    return sorted(found, reverse=True)


def with_axes(root):
    """Names what a default takes from the axes of space."""
    for structure in find(root, "Structures"):
        curve = find(structure, "Curve")
        if curve is None or value(curve, "Type") not in ("Line", "Spline") or value(curve, "Up"):
            continue
        points = {p.get("name"): numbers(p)[0] for p in curve if p.get("name") in ("From", "To", "Points")}
        start, end = points.get("From") or points["Points"][:3], points.get("To") or points["Points"][-3:]
        up = np.eye(3)[np.argmin(np.abs(np.subtract(end, start)))]
        text = "{" + ", ".join(map(str, up)) + "}"
        ElementTree.SubElement(curve, "Parameter", name="Up", value=text)
    for _, _, element, _ in parameters(root):
        element.attrib.pop("type", None)
    return root


class Trial:
    def __init__(self, culm, folder):
        self.culm = culm
        self.folder = pathlib.Path(folder)
        reference = subprocess.run([culm.program, "reference"], capture_output=True, text=True, check=True)
        self.reference = Reference(reference.stdout)
        self.failures = 0

    def resolve(self, deck):
        path = self.folder / "resolved.xml"
        path.unlink(missing_ok=True)
        subprocess.run(
            [self.culm.program, "check", str(INPUTS / deck), "--resolved", str(path)], capture_output=True, check=True
        )
        return with_axes(ElementTree.parse(path).getroot())

    def run(self, root):
        path = self.folder / "changed.xml"
        ElementTree.ElementTree(root).write(path)
        return Results(self.culm.run(path))

    def change(self, root, changes):
        """The first of them that suits the deck, and what it makes of it."""
        for change in changes:
            try:
                return change, change.deck(root, self.reference)
            except Unsuitable as reason:
                print(f"  {change.name}: not for this deck ({reason})")
        return None, None

    def judge(self, deck):
        root = self.resolve(deck)
        if any(name in ("File Name", "File", "Run") for _, _, _, name in parameters(root)):
            return
        one = self.run(root)
        print(deck)
        for changes, tolerance in CHANGES:
            if (deck.removesuffix(".xml"), changes[0]) in LEFT_OUT:
                continue
            change, changed = self.change(root, changes)
            if change is None:
                continue
            try:
                found = differences(one, self.run(changed), change)
            except Unsuitable as reason:
                print(f"  {change.name}: not for this deck ({reason})")
                continue
            worst, words = found[0] if found else (0.0, "nothing to compare")
            is_good = worst <= tolerance
            self.failures += not is_good
            print(f"  {change.name}: {worst:.1e} (allowed {tolerance:.0e})" + ("" if is_good else f" <-- {words}"), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("decks", nargs="*")
    arguments = parser.parse_args()
    decks = arguments.decks or [f"{deck}.xml" for deck in DECKS]
    if arguments.all:
        found = (path.relative_to(INPUTS) for path in sorted(INPUTS.rglob("*.xml")))
        decks = [str(path) for path in found if "include" not in path.parts]
    with tempfile.TemporaryDirectory(prefix="metamorphic") as folder:
        trial = Trial(Culm(arguments.culm), folder)
        for deck in decks:
            try:
                trial.judge(deck)
            except (subprocess.SubprocessError, OSError) as error:
                if not arguments.all:
                    raise
                print(f"{deck}: {error}")
    return 1 if trial.failures else 0


sys.exit(main())
