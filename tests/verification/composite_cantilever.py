#!/usr/bin/python3
"""SB-8: cantilever with a coupled section. Page: doc/verification/composite_cantilever.md."""

import math

from rod import Rod
from verify import figure, main, mesh_axis, romberg, save

DECK = "beam/composite_cantilever.xml"
REFERENCE = (-9.02726627566e-2, -6.47488486259e-2, 1.22973648292371)  # kynema-fmb = BeamDyn
# order: shear 1, shear 2, stretch, curvature 1, curvature 2, twist; d1 = y, d2 = z, d3 = x
STIFFNESS = [
    [88.56e3, 0, 0, 0, 0, 0],
    [0, 38.78e3, 0, 0, 0, 0],
    [0, 0, 1368.17e3, 0, 0, 0],
    [0, 0, 0, 59.12e3, -0.37e3, 17.61e3],
    [0, 0, 0, -0.37e3, 141.47e3, -0.351e3],
    [0, 0, 0, 17.61e3, -0.351e3, 16.96e3],
]


def run(culm, elements=40, kind="Director", order=1):
    settings = [
        f"Structures/beam/Curve/Elements={elements}",
        f"Structures/beam/Element={kind}",
        f"Structures/beam/Order={order}",
    ]
    return culm.history(DECK, settings)


def integrate():
    """Displacements along the beam by integration of the rod."""
    rod = Rod(10.0, STIFFNESS, [[0, 0, 1], [1, 0, 0], [0, 1, 0]], steps=100)
    states = rod.solve((0.0, 0.0, 150.0), levels=2)
    return [[float(v) for v in x] for x, _, _, _ in states]


def verify(culm, report):
    report.title("Tip under 150 N, 40 elements, 1e-3")
    for label, kind, order in [
        ("order 1", "Director", 1),
        ("order 2", "Director", 2),
        ("order 3", "Director", 3),
        ("helical", "Helical", 1),
    ]:
        tip = run(culm, 40, kind, order).vector("tip")
        for name, found, wanted in zip(("ux", "uy", "uz"), tip, REFERENCE):
            report.relative(f"{label}, {name}", found, wanted, 1e-3)
    report.title("Order 1, extrapolated from 20, 40, 80 elements, 1e-6")
    meshes = [run(culm, n).vector("tip") for n in (20, 40, 80)]
    report.relative("tip", romberg(meshes), REFERENCE, 1e-6)
    for name, found, wanted in zip(("ux", "uy", "uz"), romberg(meshes), REFERENCE):
        report.relative(name, found, wanted, 1e-5)
    report.title("The reference itself, by integration of the rod (rod.py)")
    tip = integrate()[-1]
    report.relative("tip", [tip[0] - 10.0, tip[1], tip[2]], REFERENCE, 1e-8)


def plot(culm, path):
    fig, axes = figure()
    counts = {1: (5, 10, 20, 40, 80), 2: (2, 5, 10, 20, 40), 3: (2, 5, 10, 20)}
    for label, kind, order in [
        ("order 1", "Director", 1),
        ("helical", "Helical", 1),
        ("order 2", "Director", 2),
        ("order 3", "Director", 3),
    ]:
        errors = [
            math.dist(run(culm, n, kind, order).vector("tip"), REFERENCE) / math.hypot(*REFERENCE)
            for n in counts[order]
        ]
        axes.loglog([n * order + 1 for n in counts[order]], errors, ".-", label=f"culm, {label}")
    # u3 of one spectral element against the converged value, kynema-fmb
    spectral = [abs(u / REFERENCE[2] - 1) for u in (0.911237, 1.2297361)]
    axes.loglog([3, 6], spectral, "ks", mfc="none", label="kynema-fmb, one spectral element (uz)")
    axes.axhline(1e-3, color="k", ls=":", label="tolerance for 41 nodes")
    axes.set(xlabel="nodes", ylabel="relative error of the tip displacement [-]")
    axes.set_title("Composite cantilever, 150 N")
    mesh_axis(axes, (3, 6, 11, 21, 41, 81))
    axes.set_ylim(top=30.0)  # room for the legend
    axes.legend(fontsize=7, loc="upper right")
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
