#!/usr/bin/python3
"""Orders of convergence of the beam elements. Page: doc/verification/convergence.md."""

import math

import bend_45
import composite_cantilever
from verify import figure, main, mesh_axis, romberg, save

# kind, order, meshes, expected order in the displacements, how far the measured one may be off
ELEMENTS = {
    "order 1": ("Director", 1, (16, 32, 64), 2.0, 0.05),
    "helical": ("Helical", 1, (16, 32, 64), 2.0, 0.05),
    "order 2": ("Director", 2, (8, 16, 32), 4.0, 0.1),
    # not 6: the cubic interpolation of a turning director is off by the fourth power of the angle
    "order 3": ("Director", 3, (8, 16, 32), 4.0, 0.1),
}
PROBLEMS = {
    "composite cantilever, straight": composite_cantilever.run,
    "45 degree bend, curved": bend_45.run,
}


def tips(culm, run, kind, order, meshes):
    return [run(culm, n, kind, order).vector("tip") for n in meshes]


def observed(tips):
    """log2 of the ratio of successive differences on meshes that are halved each time."""
    return math.log2(math.dist(tips[0], tips[1]) / math.dist(tips[1], tips[2]))


def verify(culm, report):
    for problem, run in PROBLEMS.items():
        report.title(f"{problem}: order from three meshes")
        limits = {}
        for label, (kind, order, meshes, expected, slack) in ELEMENTS.items():
            found = tips(culm, run, kind, order, meshes)
            report.check(f"{label}, {meshes} elements", observed(found), expected, slack)
            limits[label] = romberg(found, (expected, expected + 2.0))
        for label, limit in limits.items():
            reference = limits["order 3"]
            report.relative(f"{label}, limit against that of order 3", limit, reference, 1e-6)


def plot(culm, path):
    fig, both = figure(2)
    for axes, (problem, run) in zip(both, PROBLEMS.items()):
        fine = romberg(tips(culm, run, "Director", 3, (16, 32, 64)), (4, 6))
        for label, (kind, order, _, expected, _) in ELEMENTS.items():
            meshes = {1: (4, 8, 16, 32, 64), 2: (4, 8, 16, 32), 3: (2, 4, 8, 16)}[order]
            found = tips(culm, run, kind, order, meshes)
            errors = [math.dist(tip, fine) / math.hypot(*fine) for tip in found]
            line = axes.loglog(meshes, errors, "-", label=f"culm, {label}")[0]
            # the expected slope, through the last but one point
            slope = [errors[-2] * (meshes[-2] / n) ** expected for n in meshes]
            axes.loglog(meshes, slope, "o", mfc="none", ms=4, color=line.get_color())
        axes.plot([], [], "ko", mfc="none", ms=4, label="slopes 2, 2, 4, 4")
        axes.set(xlabel="elements", ylabel="relative error of the tip displacement [-]")
        axes.set_title(problem)
        mesh_axis(axes, (2, 4, 8, 16, 32, 64))
        axes.legend(fontsize=7)
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
