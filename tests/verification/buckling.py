#!/usr/bin/python3
"""BU-1, BU-2, BU-4: columns, plates, a cantilever that tips. Page: doc/verification/buckling.md."""

import math
import re

import numpy as np
from laminate import Laminate, Ply, buckling_force
from verify import figure, main, mesh_axis, richardson, romberg, save

COLUMN = "buckling/column.xml"
TIPPLING = "buckling/tippling.xml"
TIPPLING_PATH = "buckling/tippling_path.xml"
PLATE = "buckling/plate.xml"
CROSS_PLY = "buckling/cross_ply.xml"
ISOTROPIC = Ply(E1=1.0, E2=1.0, nu12=0.3, G12=1.0 / 2.6, G13=1.0 / 2.6, G23=1.0 / 2.6)
PLY = Ply(E1=40.0, E2=1.0, nu12=0.25, G12=0.6, G13=0.6, G23=0.5)
# k = N b^2 / (pi^2 D) over a/h, simply supported, first-order shear theory, kappa = 5/6
NAVIER = {5: 3.26373, 10: 3.78645, 20: 3.94439, 50: 3.99100, 100: 3.99775}
# N a^2 / (E2 h^3), a/h = 10; of a thin plate 36.1597
CROSS_PLIES = {(0, 90, 0): 22.3151, (0, 90, 90, 0): 23.4529}
THIN = 36.1597
TIPS = 226.278  # with the deflection before buckling
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


# A film in the middle surface, so thin that it does not bend and so stiff that it carries 99.99 % of the force
FILM_THICKNESS, FILM_STIFFNESS = 1e-5, 1e9


def plate_force(culm, ply, angles, ratio, elements, film=False):
    """Force per length over E2 h^3 / a^2 on one mesh; the shear correction is the deck's, 5/6."""
    layers = [("ply", angle, 1.0 / len(angles)) for angle in angles]
    if film:
        if len(layers) % 2 == 1:  # the middle ply in two halves
            layers = [(name, angle, 0.5 * share) for name, angle, share in layers for _ in range(2)]
        layers = [(name, angle, (1.0 - FILM_THICKNESS) * share) for name, angle, share in layers]
        layers.insert(len(layers) // 2, ("film", 0, FILM_THICKNESS))
    settings = [f"N={elements}", f"h={1.0 / ratio}"]
    for key, value in ply._asdict().items():
        settings.append(f"Materials/ply/{key}={'correction*' if key in ('G13', 'G23') else ''}{value}")
    settings += [f"Materials/ply/{key}={ply.nu12 if ply == ISOTROPIC else 0.0}" for key in ("nu13", "nu23")]
    stiff = FILM_STIFFNESS * ply.E1
    values = {"Type": "Orthotropic", "E1": stiff, "E2": stiff, "E3": 1, "nu12": 0, "nu13": 0, "nu23": 0,
              "G12": 0.5 * stiff, "G13": 0.5, "G23": 0.5}
    settings += [f"Materials/film/{key}={value}" for key, value in values.items()] if film else []
    settings += [f"Structures/plate/{key}={{{', '.join(str(part) for part in parts)}}}" for key, parts in (
        ("Materials", [name for name, _, _ in layers]),
        ("Angles", [f"{angle}*pi/180" for _, angle, _ in layers]),
        ("Thicknesses", [f"{share!r}*h" for _, _, share in layers]))]
    return critical(culm, CROSS_PLY, settings)


def plate_limit(culm, ply, angles, ratio, film=False):
    return richardson(*(plate_force(culm, ply, angles, ratio, n, film) for n in (8, 16)))


def theory(ply, angles, ratio, solid):
    return buckling_force(Laminate(ply, angles, 1.0 / ratio), 1.0, 1.0, solid) * ratio**3


FACTOR = 12.0 * (1.0 - 0.3**2) / math.pi**2  # k over N a^2 / (E h^3)


def verify_plate(culm, report, ratios=(5, 10, 100)):
    report.title("BU-2: plate pressed in one direction, limit of 8 x 8 and 16 x 16")
    for ratio, reference in NAVIER.items():
        if ratio not in ratios:
            continue
        what = f"k, a/h = {ratio}"
        own = FACTOR * theory(ISOTROPIC, (0,), ratio, False)
        report.relative(f"{what}: Navier, own and collection", own, reference, 1e-5)
        found = FACTOR * plate_limit(culm, ISOTROPIC, (0,), ratio)
        report.relative(f"{what}: solid", found, FACTOR * theory(ISOTROPIC, (0,), ratio, True), 5e-4)
        found = FACTOR * plate_limit(culm, ISOTROPIC, (0,), ratio, film=True)
        report.relative(f"{what}: the force in the middle surface", found, reference, 5e-4)
    found = critical(culm, PLATE)
    report.relative("plate.xml, a/h = 100, 16 x 16", found, NAVIER[100], 0.01)


def verify_cross_ply(culm, report):
    report.title("BU-2: cross-ply plates, a/h = 10, limit of 8 x 8 and 16 x 16")
    for angles, reference in CROSS_PLIES.items():
        what = f"[{'/'.join(str(angle) for angle in angles)}]"
        report.relative(f"{what}: Navier, own and collection", theory(PLY, angles, 10, False), reference, 1e-5)
        report.relative(f"{what}: the same, thin", theory(PLY, angles, 1e5, False), THIN, 1e-5)
        report.relative(f"{what}: solid", plate_limit(culm, PLY, angles, 10), theory(PLY, angles, 10, True), 5e-4)
        found = plate_limit(culm, PLY, angles, 10, film=True)
        report.relative(f"{what}: the force in the middle surface", found, reference, 5e-4)
        report.relative(f"{what}: thin, a/h = 1000", plate_limit(culm, PLY, angles, 1000), THIN, 1e-3)


def wall_warning(culm, settings):
    """What a run says of the wall's own limit: mode and factor, that factor; nothing if it is silent."""
    found = re.search(r"mode (\d+), factor (\S+), lies at .* no stiffness in shear, (\S+) \(",
                      culm.run(CROSS_PLY, settings).errors)
    return (int(found.group(1)), float(found.group(2)), float(found.group(3))) if found else None


def verify_wall(culm, report):
    report.title("BU-2: a wall without stiffness in shear is told by a warning")
    for ratio, elements, mode in ((5, 8, 1), (5, 16, 1), (10, 16, 2)):
        found = wall_warning(culm, [f"h={1.0 / ratio}", f"N={elements}"])
        what = f"a/h = {ratio}, {elements} x {elements}"
        report.check(f"{what}: mode that is warned of", found[0] if found else 0, mode, 0)
        if found:
            limit = Laminate(PLY, (0, 90, 90, 0), 1.0 / ratio).short_wave_force() * ratio**3
            report.relative(f"{what}, mode {mode} at {found[1]}: limit of the wall", found[2], limit, 1e-3)
    for ratio in (20, 100):
        report.check(f"a/h = {ratio}: warnings", int(wall_warning(culm, [f"h={1.0 / ratio}", "N=8"]) is not None), 0, 0)


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


def fine(culm, report):
    verify_plate(culm, report, (20, 50))
    report.title("BU-2: plates, a/h = 10, three meshes up to 32 x 32")
    for ply, angles in ((ISOTROPIC, (0,)), *((PLY, angles) for angles in CROSS_PLIES)):
        for film in (False, True):
            values = [plate_force(culm, ply, angles, 10, n, film) for n in (8, 16, 32)]
            what = f"{angles}{', the force in the middle surface' if film else ''}"
            report.relative(what, romberg(values), theory(ply, angles, 10, not film), 2e-5)


SHORT = ["Analyses/loading/First Increment=0.02", "Analyses/loading/Largest Length=1"]


def tippling_bifurcation(culm, settings=()):
    """The load at which the path of the perfect beam is crossed, and the first one on the crossing path."""
    run = culm.run(TIPPLING_PATH, [*SHORT, "Analyses/loading/Watch/Final Displacement=0.1", *settings], quiet=False)
    patterns = (r"^  bifurcation at level ([^ ,]+),", r"^on the crossing path from level (\S+)$")
    return [100.0 * float(re.search(pattern, run.output, re.MULTILINE).group(1)) for pattern in patterns]


def sideways(history):
    """Load and displacement across of a beam that is pushed or bent sideways."""
    return 100.0 * np.array(history.levels), np.array(history.column("tip uy [m]"))


NEAR = ["skew={}", "Analyses/loading/First Increment=0.02", "Analyses/loading/Largest Length=2",
        "Analyses/loading/Watch/Final Displacement=1"]


def pushed(culm, skew):
    return sideways(culm.history(TIPPLING_PATH, [setting.format(skew) for setting in NEAR]))


def bent(culm, amplitude):
    """The same of a beam that is bent in its buckling shape, without a force across."""
    entry = ["Imperfections/bow/Analysis=buckling", f"Imperfections/bow/Amplitude={amplitude}"]
    load, across = sideways(culm.history(TIPPLING_PATH, [*entry, *(setting.format(0) for setting in NEAR)]))
    return load, across * np.sign(across[-1])


def southwell(load, across, power):
    """The critical load from displacements a = c load^power / (1 - (load / critical)^2), where the square counts both
    signs of the load: from the slope of a / load^power over a load^(2 - power)."""
    near = (load > 0.95 * TIPS) & (load < 0.995 * TIPS)
    assert near.sum() >= 3
    slope = np.polyfit(across[near] * load[near] ** (2 - power), across[near] / load[near] ** power, 1)[0]
    return slope**-0.5


def verify_tippling_path(culm, report):
    report.title("BU-4: path of the cantilever that tips")
    crossing, branch = tippling_bifurcation(culm)
    report.relative("bifurcation of the perfect beam", crossing, TIPS, 1e-4)
    report.relative("first point on the crossing path", branch, TIPS, 1e-4)
    # what is neglected, the square of the displacement, grows with the imperfection
    for skew, allowed in ((1e-3, 5e-3), (1e-4, 1e-3)):
        report.relative(f"Southwell, force across {skew:g}", southwell(*pushed(culm, skew), 1), TIPS, allowed)
    report.relative("Southwell, bent by 3 mm of 30 m", southwell(*bent(culm, 3e-3), 2), TIPS, 1e-3)


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
    verify_cross_ply(culm, report)
    verify_wall(culm, report)
    verify_tippling(culm, report)
    verify_tippling_path(culm, report)
    verify_rounding(culm, report)


def plot_column(culm, axes):
    counts = (4, 8, 16, 32)
    for order, mark in ((1, "o-"), (2, "s-"), (3, "^-")):
        settings = [f"Structures/column/Order={order}", *stiffness(1e4)]
        errors = [
            abs(critical(culm, COLUMN, [*settings, f"Structures/column/Curve/Elements={n}"]) / shear_flexible(1e4) - 1)
            for n in counts
        ]
        axes.loglog(counts, errors, mark, ms=4, label=f"order {order}")
    axes.set_xlabel("elements")
    axes.set_ylabel("relative error of the Euler load")
    mesh_axis(axes, counts)
    axes.legend()


def plot_shear(culm, axes):
    values = [10 ** (k / 4) for k in range(4, 17)]
    found = [critical(culm, COLUMN, stiffness(v)) for v in values]
    axes.semilogx(values, [f / EULER for f in found], label="culm")
    axes.semilogx(values, [shear_flexible(v) / EULER for v in values], "k.", label="P (1 + P/GA) = Euler's load")
    axes.set_xlabel("GA L²/EI")
    axes.set_ylabel("critical load over Euler's")
    axes.legend()


def plot_plates(culm, axes):
    ratios = (5, 6, 7, 10, 15, 20, 50, 100)
    for film, label in ((True, "culm, force in the middle surface"), (False, "culm, uniform stress")):
        values = [FACTOR * plate_limit(culm, ISOTROPIC, (0,), ratio, film) for ratio in ratios]
        axes.semilogx(ratios, values, label=label)
    axes.plot(ratios, [FACTOR * theory(ISOTROPIC, (0,), r, False) for r in ratios], "k.", label="first-order theory")
    solid = [FACTOR * theory(ISOTROPIC, (0,), r, True) for r in ratios]
    axes.plot(ratios, solid, "kx", ms=5, label="the same, stress on the director too")
    mesh_axis(axes, ratios)
    axes.set_xlabel("a/h")
    axes.set_ylabel(r"$k=N b^2/(\pi^2 D)$, limit of 8 and 16 elements")
    axes.legend(loc="lower right", fontsize=7)


def plot_tippling(culm, axes):
    branch = culm.history(TIPPLING_PATH, ["Analyses/loading/Watch/Final Displacement=2"])
    load, across = sideways(branch)
    followed = across > 0.0
    points = (np.append(value, values) for value, values in ((0.0, across[followed]), (load[followed][0], load[followed])))
    axes.plot(*points, label="perfect, crossing path")
    for skew in (1e-4, 1e-3, 1e-2):
        settings = ["Analyses/loading/Watch/Final Displacement=2", "Analyses/loading/Largest Length=2"]
        load, across = sideways(culm.history(TIPPLING_PATH, [f"skew={skew}", *settings]))
        axes.plot(across, load, lw=1, label=f"force across {skew:g}")
    axes.plot(0.0, TIPS, "ko", ms=5, label="226.278, exact")
    axes.axhline(221.159, color="0.5", ls=":", label="221.159, about the straight beam")
    axes.set_ylim(150, 235)
    axes.set_xlabel("displacement of the tip across")
    axes.set_ylabel("tip force")
    axes.legend(loc="lower right", fontsize=7)


def plot(culm, path):
    fig, panels = figure(2, 7.0, rows=2)
    for draw, axes in zip((plot_column, plot_shear, plot_plates, plot_tippling), panels.ravel()):
        draw(culm, axes)
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot, fine)
