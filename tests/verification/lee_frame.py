#!/usr/bin/python3
"""SB-4: Lee's frame up to and through its limit point. Page: doc/verification/lee_frame.md."""

import math
import re

import numpy as np
from verify import figure, main, save

LIMIT = 1.85568
# -v: P, u before the turning point of v; planar rod, shooting, EA = 4320, no shear. They agree with
# `shoot` below to the accuracy of an interpolation between points of the path.
TABLE = {
    10: (0.9635, 1.710),
    20: (1.3458, 5.256),
    30: (1.5953, 10.336),
    40: (1.7807, 17.562),
    50: (1.8530, 28.631),
    60: (1.4818, 52.272),
}


def integrate_bar(state, force, length, steps):
    """x, y, angle, moment along a bar; the force carried is constant. No shear, EA = 4320."""

    def rate(q):
        c, s = math.cos(q[2]), math.sin(q[2])
        stretch = 1.0 + (force[0] * c + force[1] * s) / 4320.0
        dx, dy = stretch * c, stretch * s
        return np.array([dx, dy, q[3] / 1440.0, dy * force[0] - dx * force[1]])

    h = length / steps
    for _ in range(steps):
        k1 = rate(state)
        k2 = rate(state + 0.5 * h * k1)
        k3 = rate(state + 0.5 * h * k2)
        k4 = rate(state + h * k3)
        state = state + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return state


def shoot(places):
    """-v: P, u of the frame as a boundary value problem, for rising -v from 0.

    Unknown: angle and force at the foot, load; wanted: the far hinge in its place, free of moment,
    and the load point at its height.
    """

    def miss(unknown, down):
        angle, fx, fy, load = unknown
        force = np.array([fx, fy])
        corner = integrate_bar(np.array([0.0, 0.0, angle, 0.0]), force, 120.0, 120)
        corner[2] -= 0.5 * math.pi
        point = integrate_bar(corner, force, 24.0, 24)
        end = integrate_bar(point, force + [0.0, load], 96.0, 96)
        error = np.array([end[0] - 120.0, end[1] - 120.0, end[3], point[1] - 120.0 + down])
        return error, point[0] - 24.0

    unknown = np.array([0.5 * math.pi, 0.0, 0.0, 0.0])
    path = {}
    for down in places:
        for _ in range(20):
            error, side = miss(unknown, down)
            if np.abs(error).max() < 1e-9:
                break
            columns = [
                (miss(unknown + h, down)[0] - miss(unknown - h, down)[0]) / 2e-6
                for h in 1e-6 * np.eye(4)
            ]
            unknown = unknown - np.linalg.solve(np.column_stack(columns), error)
        else:
            raise ArithmeticError(f"no frame found at {down}")
        path[down] = (float(unknown[3]), float(side))
    return path


def mesh(per_bar, kind="Director", order=1):
    """Elements per bar, a multiple of 5; the load is a fifth along the second one."""
    node = per_bar * order + 1 + per_bar // 5 * order
    return [
        f"Structures/frame/Curve/Elements={{{per_bar}, {per_bar}}}",
        f"Node Sets/load point/Nodes={{frame/{node}}}",
        f"Structures/frame/Element={kind}",
        f"Structures/frame/Order={order}",
    ]


def push(culm, per_bar, kind="Director", order=1):
    """-v, P, u along the path, by displacement control in steps of 1."""
    settings = [*mesh(per_bar, kind, order), "Analyses/pushing/Steps=60"]
    history = culm.history("beam/lee_frame_displacement.xml", settings)
    down = [-v for v in history.column("load point uy [m]")]
    load = [-f for f in history.column("push Fy [N]")]
    return down, load, history.column("load point ux [m]")


def at(path, down):
    i = min(range(len(path[0])), key=lambda k: abs(path[0][k] - down))
    return path[1][i], path[2][i]


def limit(path):
    """The largest load and its place, from the parabola through the three largest."""
    down, load, _ = path
    i = max(range(len(load)), key=load.__getitem__)
    slope = 0.5 * (load[i + 1] - load[i - 1])
    bend = load[i + 1] - 2.0 * load[i] + load[i - 1]
    return load[i] - 0.5 * slope**2 / bend, down[i] - slope / bend * (down[i + 1] - down[i])


def last_level(culm, per_bar, kind="Director", order=1):
    """Where load control ends, if it ends by naming the limit point."""
    settings = [*mesh(per_bar, kind, order), "Analyses/loading/Final Level=2"]
    run = culm.run("beam/lee_frame.xml", settings)
    found = re.search(r"beyond level (\S+) of", run.errors)
    if run.exit != 4 or found is None or "limit point" not in run.errors:
        return math.nan
    return float(found.group(1))


def verify_path(culm, report):
    for order in (2, 3):
        report.title(f"Displacement control, order {order}, 2 x 20 elements: P and u at -v, 0.2 %")
        path = push(culm, 20, order=order)
        for down, reference in TABLE.items():
            for name, found, wanted in zip(("P", "u"), at(path, down), reference):
                report.relative(f"-v = {down}, {name}", found, wanted, 2e-3)
    report.title("The same against our own shooting, order 3, 2 x 20 elements")
    shot = shoot([*range(2, 46, 2), *range(46, 53), *range(54, 61, 2)])
    for down in TABLE:
        for name, found, wanted in zip(("P", "u"), at(path, down), shot[down]):
            report.relative(f"-v = {down}, {name}", found, wanted, 2e-5)
    near = [down for down in shot if 46 <= down <= 52]
    own = limit((near, [shot[down][0] for down in near], None))
    report.relative("limit by shooting, P", own[0], LIMIT, 2e-5)
    report.note(f"   at -v = {own[1]:.3f}; the collection names 48.367, a point of its path")


def verify_limit(culm, report):
    report.title("Limit load 1.85568, 0.2 %, by displacement control")
    for label, per_bar, kind, order in [
        ("order 2, 2 x 10 elements", 10, "Director", 2),
        ("order 2, 2 x 20 elements", 20, "Director", 2),
        ("order 3, 2 x 20 elements", 20, "Director", 3),
        ("helical, 2 x 20 elements", 20, "Helical", 1),
        ("order 1, 2 x 80 elements", 80, "Director", 1),
    ]:
        load, down = limit(push(culm, per_bar, kind, order))
        report.relative(f"{label}, P", load, LIMIT, 2e-3)
        report.note(f"   at -v = {down:.3f}")
    report.title("Order 1: 2 x 20 elements turn too much, second order")
    loads = [limit(push(culm, n))[0] for n in (20, 40, 80)]
    for n, load in zip((20, 40, 80), loads):
        report.note(f"2 x {n}: {load:.6f}, {100 * (load / LIMIT - 1):+.2f} %")
    order = math.log2((loads[1] - loads[0]) / (loads[2] - loads[1]))
    report.check("order of convergence", order, 2.0, 0.1)
    report.relative("extrapolated", loads[2] + (loads[2] - loads[1]) / 3.0, LIMIT, 2e-4)
    report.title("Load control ends just below, with exit code 4, and names the limit point")
    for label, per_bar, kind, order in [
        ("order 2, 2 x 10 elements", 10, "Director", 2),
        ("order 2, 2 x 20 elements", 20, "Director", 2),
    ]:
        level = last_level(culm, per_bar, kind, order)
        bound = limit(push(culm, per_bar, kind, order))[0]
        report.relative(f"{label}, last level", level, LIMIT, 2e-3)
        excess = max(0.0, level - bound)
        report.holds(f"{label}, excess over the limit load of the mesh", excess, 1e-4)


def verify(culm, report):
    verify_path(culm, report)
    verify_limit(culm, report)


def plot(culm, path):
    fig, axes = figure()
    for label, per_bar, order, style in [
        ("culm, order 2, 2 x 20 elements", 20, 2, "C0-"),
        ("culm, order 1, 2 x 20 elements", 20, 1, "C1--"),
    ]:
        down, load, side = push(culm, per_bar, order=order)
        axes.plot(down, load, style, label=f"{label}, -v")
        axes.plot(side, load, style, alpha=0.5, label=f"{label}, u")
    loads, sides = zip(*TABLE.values())
    axes.plot(list(TABLE), loads, "ko", mfc="none", label="planar rod, shooting, -v")
    axes.plot(sides, loads, "ks", mfc="none", label="planar rod, shooting, u")
    axes.axhline(LIMIT, color="k", ls=":", label="limit load 1.85568")
    axes.set(xlabel="displacement of the load point [m]", ylabel="load P [N]", title="Lee's frame")
    axes.legend(fontsize=6, loc="lower right")
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
