#!/usr/bin/python3
"""BU-1, BU-2, BU-4: columns, plates, a cantilever that tips. Page: doc/verification/buckling.md."""

import math

from verify import figure, main, mesh_axis, richardson, save

COLUMN = "buckling/column.xml"
TIPPLING = "buckling/tippling.xml"
PLATE = "buckling/plate.xml"
# k = N b^2 / (pi^2 D), simply supported, kappa = 5/6
NAVIER = {20: 3.94439, 50: 3.99100, 100: 3.99775}
EULER = math.pi**2 / 4.0  # clamped-free, EI = L = 1


def critical(culm, deck, settings=()):
    """The smallest positive load."""
    table = culm.table("buckling/buckling", deck, settings)
    return min(level for level in table.column("critical level") if level > 0.0)


def stiffness(value):
    return [f"Sections/bar/{name}={value}" for name in ("EA", "GA1", "GA2")]


def shear_flexible(value):
    """P (1 + P / GA) = Euler's load."""
    return value * (math.sqrt(1.0 + 4.0 * EULER / value) - 1.0) / 2.0


def verify_column(culm, report):
    report.title("BU-1: Euler column, clamped and free")
    for form in ("Null Space", "Multipliers"):
        for solver in ("Dense", "Spectra"):
            settings = [f"Solver/Form={form}", f"Analyses/buckling/Solver={solver}"]
            report.relative(f"{form}, {solver}", critical(culm, COLUMN, settings), EULER, 1e-3)
    table = culm.table("buckling/buckling", COLUMN)
    report.relative("double values", table.column("factor"), [EULER, EULER, 9 * EULER, 9 * EULER], 1e-3)
    report.title("BU-1: shear-flexible column about the straight state, P (1 + P / GA) = Euler")
    for value in (1e5, 1e3, 1e2):
        wanted = shear_flexible(value)
        found = critical(culm, COLUMN, stiffness(value))
        report.relative(f"GA = {value:g}", found, wanted, 1e-4)


def constraint(name, kind, node, key, direction):
    entry = f"Constraints/{name}"
    return [f"{entry}/Type={kind}", f"{entry}/Node=column/{node}", f"{entry}/{key}={direction}"]


# the head may not move sideways; nor turn; a foot that may turn must not twist
HEAD = constraint("x", "Simple Support", "last", "Direction", "{1, 0, 0}")
HEAD += constraint("y", "Simple Support", "last", "Direction", "{0, 1, 0}")
UPRIGHT = constraint("about x", "Rotation", "last", "Axis", "{1, 0, 0}")
UPRIGHT += constraint("about y", "Rotation", "last", "Axis", "{0, 1, 0}")
HINGE = ["Constraints/foot/Type=Spherical Support", *constraint("z", "Rotation", "first", "Axis", "{0, 0, 1}")]


def verify_supports(culm, report):
    report.title("BU-1: other supports, pi^2 EI / (K L)^2")
    clamped_pinned = 20.190728557  # smallest root of tan x = x, squared
    cases = (("K = 1, hinges", [*HINGE, *HEAD], math.pi**2), ("K = 0.699", HEAD, clamped_pinned),
             ("K = 0.5, clamps", [*HEAD, *UPRIGHT], 4.0 * math.pi**2))
    for name, settings, wanted in cases:
        report.relative(name, critical(culm, COLUMN, settings), wanted, 1e-3)


def reissner(ea, ga):
    """P (1 - P / EA + P / GA) = Euler's load: shear and compression before buckling, over it."""
    a = 1.0 / ga - 1.0 / ea
    return (math.sqrt(1.0 + 4.0 * a * EULER) - 1.0) / (2.0 * a) / EULER


def verify_reissner(culm, report):
    report.title("BU-1: shear-flexible and compressible column, about a state near the load")
    for ea, ga, level in ((100.0, 50.0, 0.97), (100.0, 1000.0, 0.99)):
        settings = [f"Sections/bar/EA={ea}", f"Sections/bar/GA1={ga}", f"Sections/bar/GA2={ga}",
                    f"Analyses/loading/Final Level={level}"]
        found = critical(culm, "buckling/column_loaded.xml", settings)
        report.relative(f"EA = {ea:g}, GA = {ga:g}, level {level}", found, reissner(ea, ga), 1e-3)


def verify_plate(culm, report):
    report.title("BU-2: plate pressed in one direction, first-order shear theory, limit of 16 and 32")
    for ratio, reference in NAVIER.items():
        h = 1.0 / ratio
        force = math.pi**2 * 1e9 * h**3 / (12.0 * (1.0 - 0.09))
        values = []
        for n in (16, 32):
            settings = [
                f"Structures/plate/Mesh/Elements={{{n}, {n}}}",
                f"Structures/plate/Thickness={h}",
                f"Loads/pressure/Force={{{-force}, 0, 0}}",
            ]
            values.append(critical(culm, PLATE, settings))
        report.relative(f"k, a/h = {ratio}", richardson(*values), reference, 5e-3)


def verify_tippling(culm, report):
    report.title("BU-4: cantilever that tips")
    table = culm.table("buckling/buckling", TIPPLING)
    loads = sorted(table.column("critical level"), key=abs)[:2]
    report.relative("about the straight beam", 100 * max(loads), 221.159, 5e-3)
    report.relative("load reversed", 100 * min(loads), -221.159, 5e-3)


def verify_loaded(culm, report):
    report.title("About a state under most of the load")
    report.relative("BU-1: column at 90 %", critical(culm, "buckling/column_loaded.xml"), 1.0, 1e-3)
    found = 230 * critical(culm, "buckling/tippling_loaded.xml")
    report.relative("BU-4: exact with the deflection before", found, 226.278, 5e-3)


def verify_rounding(culm, report):
    report.title("Stiffness ratios beyond rounding: told by a warning")
    for ratio, told in ((1e9, False), (1e12, True), (1e15, True)):
        stiff = [f"Sections/bar/{name}={ratio}" for name in ("EA", "GA1", "GA2")]
        run = culm.run("buckling/column.xml", stiff)
        error = run.tables["buckling/buckling"].at(1, "factor") / EULER - 1.0
        report.check(f"EA/EI = {ratio:.0e}: off by {error:.1e}, warnings",
                     run.errors.count("rounding leaves the factor"), int(told), 0)


def verify(culm, report):
    verify_loaded(culm, report)
    verify_column(culm, report)
    verify_supports(culm, report)
    verify_reissner(culm, report)
    verify_plate(culm, report)
    verify_tippling(culm, report)
    verify_rounding(culm, report)


def plot(culm, path):
    fig, (left, right) = figure(columns=2)
    counts = (4, 8, 16, 32)
    for order, mark in ((1, "o-"), (2, "s-"), (3, "^-")):
        settings = [f"Structures/column/Order={order}", *stiffness(1e4)]
        errors = [
            abs(critical(culm, COLUMN, [*settings, f"Structures/column/Curve/Elements={n}"]) / shear_flexible(1e4) - 1)
            for n in counts
        ]
        left.loglog(counts, errors, mark, ms=4, label=f"order {order}")
    left.set_xlabel("elements")
    left.set_ylabel("relative error of the Euler load")
    mesh_axis(left, counts)
    left.legend()
    values = [10 ** (k / 4) for k in range(4, 17)]
    found = [critical(culm, COLUMN, stiffness(v)) for v in values]
    right.semilogx(values, [f / EULER for f in found], label="culm")
    wanted = [shear_flexible(v) / EULER for v in values]
    right.semilogx(values, wanted, "k.", label="P (1 + P/GA) = Euler's load")
    right.set_xlabel("GA L²/EI")
    right.set_ylabel("critical load over Euler's")
    right.legend()
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
