#!/usr/bin/python3
"""The iterative linear solver against MUMPS: statics, paths, motions, joints, one and two ranks.

Page: doc/verification/speed.md.
"""

import re

from verify import main  # puts culm_runs on the path

# name: deck, what shortens it, largest difference of the last line of the history
DECKS = {
    "statics": ("shell/pinched_cylinder.xml", ["Analyses/loading/Steps=2"], 1e-7),
    "bodies and soft transitions": ("shell/rings_on_bodies.xml", [], 1e-7),
    "constraints as equations": ("turbine/nrel5mw/blade_static.xml", ["Solver/Form=Multipliers"], 1e-7),
    "a motion": ("shell/tumbling_cylinder.xml", ["Analyses/fly/End Time=0.2"], 1e-7),
}
PATH = "shell/hinged_roof_path.xml"
PATH_SETTINGS = ["Analyses/snap/Limit Points=2"]
THIN = "shell/plate_under_weight.xml"
THIN_SETTINGS = ["Structures/plate/Mesh/Elements={100,100}", "Structures/plate/Thickness=5e-4",
                 "Loads/weight/Force={0,0,-1e-7}"]
REMARK = re.compile(r"([0-9.]+) iterations per solution, at most (\d+)")


def run(culm, deck, settings, solver, ranks=1):
    result = culm.run(deck, [*settings, f"Solver/Linear Solver={solver}"], ranks, quiet=False)
    if result.exit != 0:
        raise ArithmeticError(f"{deck}, {solver}, {ranks} ranks: {result.errors}")
    return result


def ends(history):
    """Last values of all columns, each over the largest of its column."""
    return {name: (values[-1], max(map(abs, values))) for name, values in history.columns.items()}


def difference(found, wanted):
    """The largest of all columns; what is nothing but rounding has no share."""
    sizes = [size for _, size in wanted.values()]
    least = max(1e-6 * max(sizes), 1e-300)
    return max(abs(found[name][0] - end) / max(size, least) for name, (end, size) in wanted.items())


def verify_deck(culm, report, name):
    deck, settings, tolerance = DECKS[name]
    report.title(f"{name}: {deck}")
    direct = run(culm, deck, settings, "MUMPS")
    for ranks in (1, 2):
        found = run(culm, deck, settings, "Iterative", ranks)
        gap = difference(ends(found.history), ends(direct.history))
        report.holds(f"ends on {ranks} ranks", gap, tolerance)
        mean, most = REMARK.search(found.output).groups()
        report.note(f"{mean} iterations per solution, at most {most}; "
                    f"{found.iterations()} of Newton's, MUMPS {direct.iterations()}")
        report.note("what it says: " + next(line for line in found.output.splitlines() if line.startswith("linear solver:")))


def verify_thin_plate(culm, report):
    """Elements ten times as long as thick: 44 iterations without soft modes of patches."""
    report.title(f"elements longer than thick: {THIN}")
    direct = run(culm, THIN, THIN_SETTINGS, "MUMPS")
    found = run(culm, THIN, THIN_SETTINGS, "Iterative")
    report.holds("ends", difference(ends(found.history), ends(direct.history)), 1e-7)
    report.holds("iterations at most", int(REMARK.search(found.output).group(2)), 25)


def limit_points(output):
    return [float(x) for x in re.findall(r"limit point at level ([^ ,]+),", output)]


def verify_path(culm, report):
    report.title(f"a path beyond its limit points: {PATH}")
    direct = limit_points(run(culm, PATH, PATH_SETTINGS, "MUMPS").output)
    found = run(culm, PATH, PATH_SETTINGS, "Iterative")
    report.check("levels of the limit points", limit_points(found.output), direct, 1e-4)
    report.check("a word on bifurcations", found.output.count("bifurcations are not looked for"), 1, 0)


def verify(culm, report):
    for name in DECKS:
        verify_deck(culm, report, name)
    verify_thin_plate(culm, report)
    verify_path(culm, report)


if __name__ == "__main__":
    main(verify)
