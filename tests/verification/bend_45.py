#!/usr/bin/python3
"""SB-3: 45 degree bend with an out-of-plane load. Page: doc/verification/bend_45.md."""

import math

from rod import Rod, stiffness
from verify import figure, main, mesh_axis, romberg, save

DECK = "beam/bend_45.xml"
TIP = (100.0 * math.sin(math.pi / 4), 100.0 * (1.0 - math.cos(math.pi / 4)), 0.0)
LEVELS = {300: 0.5, 450: 0.75, 600: 1.0}
# exact arc, J = 1/6, GA = 5e6; the digits of the benchmark collection
EXACT = {
    300: (-11.93156, -7.04454, 40.19189),
    450: (-18.47212, -10.78114, 48.50293),
    600: (-23.56024, -13.60452, 53.47486),
}
# tip positions, 8 elements
SIMO_VU_QUOC = {300: (58.84, 22.33, 40.08), 450: (52.32, 18.62, 48.39), 600: (47.23, 15.79, 53.37)}


def run(culm, elements=32, kind="Director", order=1, settings=()):
    return culm.history(
        DECK,
        [
            f"Structures/bend/Curve/Elements={elements}",
            f"Structures/bend/Element={kind}",
            f"Structures/bend/Order={order}",
            *settings,
        ],
    )


def integrate(load, steps=200):
    """The tip displacement by integration of the rod; at the root d1 = z, about which it curves."""
    root = [[0, 0, 1], [0, -1, 0], [1, 0, 0]]
    rod = Rod(
        100.0 * math.pi / 4,
        stiffness(EA=1e7, GA1=5e6, GA2=5e6, EI1=1e7 / 12, EI2=1e7 / 12, GIp=5e6 / 6),
        root,
        curvature=lambda s: [0.01, 0.0, 0.0],
        steps=steps,
    )
    position = rod.solve((0.0, 0.0, load), levels=4)[-1][0]
    return [float(a - b) for a, b in zip(position, TIP)]


def verify_loads(culm, report):
    report.title("32 elements against the exact arc, 0.2 %")
    for label, kind, order in [
        ("order 1", "Director", 1),
        ("order 2", "Director", 2),
        ("order 3", "Director", 3),
        ("helical", "Helical", 1),
    ]:
        history = run(culm, 32, kind, order)
        for load, level in LEVELS.items():
            report.relative(f"{label}, P = {load}", history.vector("tip", level), EXACT[load], 2e-3)
    report.title("Order 1 extrapolated from 16, 32, 64 elements, 1e-5")
    meshes = [run(culm, n) for n in (16, 32, 64)]
    for load, level in LEVELS.items():
        found = romberg([mesh.vector("tip", level) for mesh in meshes])
        report.relative(f"P = {load}, collection", found, EXACT[load], 1e-5)
    report.relative("P = 600, rod.py", found, integrate(600.0), 1e-5)
    report.title("Simo and Vu-Quoc (1986), 8 elements; the literature scatters by 0.5 %")
    history = run(culm)
    for load, level in LEVELS.items():
        position = [a + b for a, b in zip(TIP, history.vector("tip", level))]
        report.relative(f"P = {load}, tip position", position, SIMO_VU_QUOC[load], 5e-3)


def verify_slenderness(culm, report):
    report.title("No locking: u/R for R/size = 100, 1000, 10000 with P ~ size^4 coincide")
    tips = {}
    for slenderness in (1e1, 1e2, 1e3, 1e4):
        size = 100.0 / slenderness
        history = run(culm, settings=[f"size={size}", f"load={600.0 * size**4}"])
        tips[slenderness] = [u / 100.0 for u in history.vector("tip")]
        values = ", ".join(f"{u:.6f}" for u in tips[slenderness])
        report.note(f"R/size = {slenderness:g}: u/R = {values}")
    # stretch and shear, which fall with 1/slenderness^2, are all that is left of a difference
    report.relative("1e2 and 1e4", tips[1e2], tips[1e4], 1e-3)
    report.relative("1e3 and 1e4", tips[1e3], tips[1e4], 1e-5)


def verify_path(culm, report):
    report.title("Path independence: 6, 8, 10 and 60 steps")
    tight = ["Analyses/bending/Newton/Force Tolerance=1e-13"]
    tips = {}
    for n in (6, 8, 10, 60):
        tips[n] = run(culm, settings=[f"Analyses/bending/Steps={n}", *tight]).vector("tip")
    for n in (8, 10, 60):
        report.relative(f"{n} steps and 6", tips[n], tips[6], 1e-10)
    report.title("Loading and unloading returns to zero")
    triangle = [
        "Functions/path/Type=Triangle",
        "Functions/path/Duration=2",
        "Loads/tip load/Function=path",
        "Analyses/bending/Final Level=2",
        "Analyses/bending/Steps=16",
    ]
    history = run(culm, settings=triangle)
    report.relative("at level 1", history.vector("tip", 1.0), tips[6], 1e-9)
    for kind, order in [("Director", 1), ("Director", 3), ("Helical", 1)]:
        left = run(culm, 32, kind, order, triangle).vector("tip", 2.0)
        report.holds(f"{kind}, order {order}: |u|/R at level 2", math.hypot(*left) / 100.0, 1e-12)


def verify(culm, report):
    verify_loads(culm, report)
    verify_slenderness(culm, report)
    verify_path(culm, report)


def plot(culm, path):
    fig, (load_axes, error_axes) = figure(2)
    history = run(culm, settings=["Analyses/bending/Steps=40"])
    loads = [600.0 * level for level in history.levels]
    for name, sign, colour in [("x", -1, "C0"), ("y", -1, "C1"), ("z", 1, "C2")]:
        i = "xyz".index(name)
        values = [sign * v for v in history.column(f"tip u{name} [m]")]
        label = f"{'-' if sign < 0 else ''}u{name}"
        load_axes.plot(values, loads, colour, label=f"culm, {label}")
        exact = [sign * EXACT[p][i] for p in EXACT]
        load_axes.plot(exact, list(EXACT), "o", color=colour, mfc="none")
        simo = [sign * (SIMO_VU_QUOC[p][i] - TIP[i]) for p in SIMO_VU_QUOC]
        load_axes.plot(simo, list(SIMO_VU_QUOC), "x", color=colour)
    load_axes.plot([], [], "ko", mfc="none", label="exact arc, rod integration")
    load_axes.plot([], [], "kx", label="Simo, Vu-Quoc (1986)")
    load_axes.set(xlabel="tip displacement [m]", ylabel="load P [N]")
    load_axes.set_title("32 elements of order 1")
    load_axes.legend(fontsize=7)
    exact = integrate(600.0)
    for label, kind, order, counts in [
        ("order 1", "Director", 1, (4, 8, 16, 32, 64)),
        ("helical", "Helical", 1, (4, 8, 16, 32, 64)),
        ("order 2", "Director", 2, (2, 4, 8, 16, 32)),
        ("order 3", "Director", 3, (2, 4, 8, 16)),
    ]:
        tips = [run(culm, n, kind, order).vector("tip") for n in counts]
        errors = [math.dist(tip, exact) / math.hypot(*exact) for tip in tips]
        error_axes.loglog(counts, errors, ".-", label=label)
    error_axes.axhline(2e-3, color="k", ls=":", label="tolerance at 32 elements")
    error_axes.set(xlabel="elements", ylabel="relative error of the tip, P = 600 N [-]")
    error_axes.set_title("Convergence")
    mesh_axis(error_axes, (2, 4, 8, 16, 32, 64))
    error_axes.legend(fontsize=7)
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
