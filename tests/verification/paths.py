#!/usr/bin/python3
"""Equilibrium paths: SB-4, HY-6 to HY-8, SB-6, SB-7, SS-6, SS-8. Page: doc/verification/paths.md."""

import math
import re
from typing import NamedTuple

import numpy as np
from lee_frame import TABLE, mesh
from verify import figure, main, richardson, save

# force over 3000, deflection of the centre; Sze, Liu, Lo (2004), 3.8, by way of a test file
ROOF_THICK = [
    (0.0877, 0.693), (0.198, 1.638), (0.3473, 3.087), (0.4686, 4.477), (0.5647, 5.802),
    (0.6381, 7.057), (0.6908, 8.237), (0.7246, 9.339), (0.7412, 10.358), (0.7421, 11.293),
    (0.7286, 12.141), (0.7023, 12.903), (0.6649, 13.583), (0.6182, 14.188), (0.5643, 14.728),
    (0.5055, 15.217), (0.4442, 15.676), (0.383, 16.125), (0.3245, 16.59), (0.2717, 17.094),
    (0.2272, 17.657), (0.194, 18.299), (0.175, 19.028), (0.1729, 19.852), (0.1905, 20.771),
    (0.2303, 21.78), (0.295, 22.875), (0.3871, 24.049), (0.4443, 24.663), (0.5093, 25.293),
    (0.5826, 25.94), (0.6644, 26.601), (0.7551, 27.276), (0.8549, 27.964), (0.9643, 28.663),
    (1.0835, 29.374),
]
ROOF_THIN = [
    (0.0517, 1.846), (0.1182, 5.271), (0.1583, 8.257), (0.1837, 10.799), (0.1914, 11.904),
    (0.1953, 12.892), (0.195, 13.752), (0.1901, 14.472), (0.1806, 15.05), (0.1671, 15.501),
    (0.1323, 16.145), (0.0923, 16.602), (0.0504, 16.915), (0.0083, 17.008), (-0.0312, 16.697),
    (-0.0622, 15.78), (-0.0739, 15.206), (-0.0861, 14.767), (-0.1001, 14.52), (-0.1142, 14.451),
    (-0.1247, 14.862), (-0.1288, 15.778), (-0.1271, 16.961), (-0.1196, 18.32),
    (-0.1055, 19.817), (-0.0825, 21.42), (-0.0484, 23.1), (-0.0006, 24.824), (0.0626, 26.565),
    (0.1427, 28.302), (0.2403, 30.023), (0.3559, 31.72), (0.4898, 33.388), (0.6417, 35.024),
    (0.8114, 36.626), (1.0313, 38.45),
]
# the same of three plies, from where the collection has them; outer plies along the generators
ROOF_THICK_ALONG = [
    (0.3288, 12.227), (0.3057, 12.872), (0.2778, 13.458), (0.2461, 13.99), (0.2115, 14.477),
    (0.1749, 14.928), (0.0999, 15.774), (0.0638, 16.199), (0.0303, 16.648), (0.0007, 17.141),
    (-0.0236, 17.692), (-0.0411, 18.317), (-0.0504, 19.024), (-0.0503, 19.817), (-0.0394, 20.698),
    (-0.0165, 21.663), (0.0194, 22.707), (0.0697, 23.824), (0.1354, 25.005), (0.2178, 26.244),
    (0.3181, 27.533), (0.4374, 28.864), (0.5769, 30.229), (0.7374, 31.622), (1.0192, 33.748),
]
ROOF_THIN_ALONG = [
    (-0.065, 10.991), (-0.0442, 10.126), (-0.0189, 10.494), (0.0007, 11.931), (0.0142, 13.623),
    (0.0296, 14.751), (0.0499, 14.425), (0.0593, 11.86), (0.0428, 10.506), (0.021, 10.406),
    (-0.0006, 10.745), (-0.0215, 11.263), (-0.0419, 11.861), (-0.0607, 12.555), (-0.0742, 13.602),
    (-0.078, 15.332), (-0.0731, 17.712), (-0.0593, 20.694), (-0.0214, 24.23), (0.0556, 27.809),
    (0.17, 31.174), (0.3213, 34.362), (0.5085, 37.394), (0.7292, 40.274), (1.0243, 43.444),
]
# outer plies along the arch
ROOF_THICK_ACROSS = [
    (0.5716, 11.231), (0.5838, 12.024), (0.5919, 12.782), (0.5963, 13.505), (0.597, 14.192),
    (0.5945, 14.841), (0.5888, 15.45), (0.5801, 16.019), (0.5685, 16.545), (0.5542, 17.028),
    (0.5374, 17.465), (0.4971, 18.206), (0.4498, 18.785), (0.3991, 19.249), (0.3501, 19.682),
    (0.309, 20.191), (0.2834, 20.881), (0.2789, 21.318), (0.2812, 21.823), (0.3099, 23.03),
    (0.3755, 24.476), (0.4832, 26.12), (0.638, 27.921), (0.8444, 29.844), (1.0356, 31.349),
]
ROOF_THIN_ACROSS = [
    (0.1222, 19.416), (0.1019, 19.429), (0.0792, 19.167), (0.0331, 18.249), (0.0134, 17.555),
    (-0.0011, 16.641), (-0.0088, 15.532), (-0.0117, 14.369), (-0.0168, 13.519), (-0.0297, 13.456),
    (-0.0458, 13.873), (-0.0619, 14.469), (-0.0752, 15.258), (-0.0818, 16.461), (-0.0792, 18.129),
    (-0.0663, 20.157), (-0.0402, 22.448), (0.0036, 24.905), (0.0693, 27.427), (0.1598, 29.941),
    (0.2761, 32.401), (0.418, 34.786), (0.5847, 37.088), (0.7747, 39.301), (1.0234, 41.773),
]
# force over 12000, deflection under it, bulge of the side; the same, 3.6
CYLINDER = [
    (0.05, 9.561, -0.233), (0.075, 15.648, -0.922), (0.1, 23.164, -2.391),
    (0.125, 29.375, -3.872), (0.15, 36.208, -2.154), (0.175, 51.499, 6.792),
    (0.2, 56.373, 10.448), (0.25, 61.877, 14.905), (0.3, 65.498, 17.979),
    (0.35, 68.229, 20.365), (0.4, 70.424, 22.321), (0.45, 72.204, 23.916), (0.5, 73.79, 25.381),
    (0.55, 75.139, 26.631), (0.6, 76.331, 27.735), (0.65, 77.472, 28.843),
    (0.7, 78.451, 29.772), (0.75, 79.339, 30.604), (0.8, 80.218, 31.471),
    (0.85, 81.045, 32.299), (0.9, 81.766, 32.989), (0.95, 82.435, 33.619), (1.0, 83.102, 34.272),
]


class Frame(NamedTuple):
    """Two bars of one length at a right angle, hinged at both ends, a force on the second one."""

    length: float
    place: float
    EA: float
    GA: float
    EI: float


LEE = Frame(120.0, 24.0, 4320.0, math.inf, 1440.0)
HALF = Frame(120.0, 20.0, 7.2e6 * 6, 2.77e6 * 6, 7.2e6 * 4.5)
WALLS = Frame(60.0, 1.0, 7.2e6 * 4, 7.2e6 / 2.6, 7.2e6 * 3.396)  # of the hybrid, as rods


def integrate_bar(frame, state, force, length, steps):
    """x, y, angle, moment along a bar; the force carried is constant."""
    fx, fy = map(float, force)

    def rate(angle, moment):
        c, s = math.cos(angle), math.sin(angle)
        stretch = 1.0 + (fx * c + fy * s) / frame.EA
        shear = (fy * c - fx * s) / frame.GA
        dx, dy = stretch * c - shear * s, stretch * s + shear * c
        return dx, dy, moment / frame.EI, dy * fx - dx * fy

    h = length / steps
    x, y, angle, moment = map(float, state)
    for _ in range(steps):
        k1 = rate(angle, moment)
        k2 = rate(angle + 0.5 * h * k1[2], moment + 0.5 * h * k1[3])
        k3 = rate(angle + 0.5 * h * k2[2], moment + 0.5 * h * k2[3])
        k4 = rate(angle + h * k3[2], moment + h * k3[3])
        change = [h / 6.0 * (a + 2.0 * b + 2.0 * c + d) for a, b, c, d in zip(k1, k2, k3, k4)]
        x, y, angle, moment = x + change[0], y + change[1], angle + change[2], moment + change[3]
    return [x, y, angle, moment]


def rod_path(frame, points=260):
    """Load, u and v of the loaded point along the path, by shooting and pseudo-arc length.

    Unknown: angle and force at the foot, load; wanted: the far hinge in its place, free of moment.
    """
    unit = frame.EI / frame.length**2
    scale = np.array([1.0, unit, unit, unit])

    def miss(x):
        angle, fx, fy, load = x * scale
        force = np.array([fx, fy])
        corner = integrate_bar(frame, [0.0, 0.0, angle, 0.0], force, frame.length, 30)
        corner[2] -= 0.5 * math.pi
        point = integrate_bar(frame, corner, force, frame.place, 6)
        end = integrate_bar(frame, point, force + [0.0, load], frame.length - frame.place, 24)
        error = [end[0] / frame.length - 1.0, end[1] / frame.length - 1.0]
        error.append(end[3] / (unit * frame.length))
        return np.array(error), (load, point[0] - frame.place, point[1] - frame.length)

    def jacobian(x):
        columns = [(miss(x + h)[0] - miss(x - h)[0]) / 2e-6 for h in 1e-6 * np.eye(4)]
        return np.column_stack(columns)

    x, step, path = np.array([0.5 * math.pi, 0.0, 0.0, 0.0]), 0.25, []
    direction = np.array([0.0, 0.0, 0.0, 1.0])
    for _ in range(points):
        before = jacobian(x)
        tangent = np.linalg.svd(before)[2][-1]
        tangent *= math.copysign(1.0, tangent @ direction)
        slope, change = np.vstack([before, tangent]), step * tangent
        y = x + change
        for _ in range(20):
            rest = np.append(miss(y)[0], tangent @ (y - x) - step)
            if np.abs(rest).max() < 1e-11:
                break
            slope += np.outer(rest, change) / (change @ change)  # Broyden: costs no derivatives
            change = -np.linalg.solve(slope, rest)
            y = y + change
        else:
            raise ArithmeticError(f"no frame found after {len(path)} points")
        direction, x = y - x, y
        path.append(miss(x)[1])
    return np.array(path)


def peak(values):
    """The largest inner maximum, from the parabola through three points."""
    inner = [k for k in range(1, len(values) - 1) if values[k] >= max(values[k - 1], values[k + 1])]
    i = max(inner, key=lambda k: values[k])
    slope = 0.5 * (values[i + 1] - values[i - 1])
    return values[i] - 0.5 * slope**2 / (values[i + 1] - 2.0 * values[i] + values[i - 1])


def follow(culm, deck, settings=()):
    """History and events of a path; events as kind, level, displacement."""
    run = culm.run(deck, list(settings), quiet=False)
    if run.exit != 0:
        raise ArithmeticError(run.errors)
    pattern = r"^  (limit point|turning point|bifurcation) at level ([^ ,]+), .* (\S+) m$"
    found = re.findall(pattern, run.output, re.MULTILINE)
    return run.history, [(kind, float(level), float(u)) for kind, level, u in found]


def levels_of(events, kind):
    return [level for what, level, _ in events if what == kind]


def curve_of(history, *columns, sign=1):
    """Levels and columns as points."""
    return np.column_stack([history.levels, *(sign * np.array(history.column(c)) for c in columns)])


def distance(points, curve, size=None):
    """Largest distance of points (n, 2) from a polyline; over the ranges of the points."""
    size = np.ptp(points, axis=0) if size is None else np.array(size)
    p, c = points / size, curve / size
    a, d = c[:-1], np.diff(c, axis=0)
    worst = 0.0
    for one in p:
        t = np.clip(((one - a) * d).sum(1) / np.maximum((d * d).sum(1), 1e-300), 0.0, 1.0)
        worst = max(worst, np.linalg.norm(a + t[:, None] * d - one, axis=1).min())
    return worst


LEE_DECK, HALF_DECK = "beam/lee_frame_path.xml", "beam/half_frame.xml"
CONTROLS = ("Linearised Sphere", "Normal Plane", "Sphere")


def frame_path(culm, deck, settings=(), largest=2):
    """P, u, v of the loaded point, and the events."""
    steps = [f"Analyses/loading/Largest Length={largest}", "Analyses/loading/Steps=2000"]
    history, events = follow(culm, deck, [*steps, *settings])
    return curve_of(history, "load point ux [m]", "load point uy [m]"), events


def verify_lee(culm, report):
    report.title("SB-4: Lee's frame, order 2, 2 x 20 elements; collection 0.2 %, own shooting 1e-4")
    path, events = frame_path(culm, LEE_DECK, mesh(20, order=2))
    own = rod_path(LEE)
    high, low = levels_of(events, "limit point")
    report.relative("limit load", high, 1.85568, 2e-3)
    report.relative("lowest load", low, -0.94139, 2e-3)
    report.relative("limit load, shooting", high, peak(own[:, 0]), 1e-4)
    report.relative("lowest load, shooting", low, -peak(-own[:, 0]), 1e-4)
    turns = [v for what, _, v in events if what == "turning point"]
    report.relative("v at its turning points", turns, [-61.003, -50.746], 2e-3)
    for down, (load, side) in TABLE.items():
        gap = distance(np.array([[load, side]]), path[:, :2], (1.85, 90.0))
        report.holds(f"-v = {down}: distance of ({load}, {side}) from the path", gap, 2e-3)
    gap = distance(own[own[:, 1] < 90.0][:, :2], path[:, :2])
    report.holds("distance of the shot path, P and u, over the ranges", gap, 1e-3)


def verify_controls(culm, report):
    for deck in (LEE_DECK, HALF_DECK):
        report.title(f"{deck}: the three arc lengths, with two lengths, trace one path")
        fine_path, _ = frame_path(culm, deck, largest=0.5)
        for control in CONTROLS:
            for largest in (5, 10):
                path, _ = frame_path(culm, deck, [f"Analyses/loading/Control={control}"], largest)
                for k, name in ((1, "u"), (2, "v")):
                    gap = distance(path[:, (0, k)], fine_path[:, (0, k)])
                    report.holds(f"{control}, {largest}: P and {name}", gap, 1e-4)


def verify_half(culm, report):
    report.title("HY-8: half frame, 2 x 12 elements of order 2; shooting, 0.2 %")
    _, events = frame_path(culm, HALF_DECK)
    own = rod_path(HALF)
    wanted = (42705.6, -18912.9)
    shot = (peak(own[:, 0]), -peak(-own[:, 0]))
    for k, name in enumerate(("limit load", "lowest load")):
        report.relative(name, 1e5 * levels_of(events, "limit point")[k], wanted[k], 2e-3)
        report.relative(f"{name}, own shooting", shot[k], wanted[k], 1e-4)


HYBRID_DECK = "hybrid/half_frame.xml"


def hybrid(culm, n):
    """Level, u, v of the loaded point, and the events."""
    settings = [f"n={n}", "Analyses/snap/Largest Length=60", "Analyses/snap/Limit Points=2"]
    settings += ["Analyses/snap/Steps=90"]
    history, events = follow(culm, HYBRID_DECK, settings)
    return curve_of(history, "load point uz [m]", "load point uy [m]"), events


def verify_hybrid(culm, report, n=1):
    report.title(f"HY-7: half frame of beams and walls, refinement {n}; load over 175 kN")
    path, events = hybrid(culm, n)
    limit, lowest = levels_of(events, "limit point")[:2]
    shot = peak(rod_path(WALLS, 180)[:, 0]) / 175e3
    report.relative("limit, planar rod by shooting", limit, shot, 0.02)
    report.check("limit, read off the slide", limit, 0.85, 0.05)
    report.check("lowest, read off the slide", lowest, -0.2, 0.05)
    bottom = path[:, 0].argmin()
    top, low = path[path[:bottom, 0].argmax()], path[bottom]
    report.check("u, v at the limit, slide", [top[1], -top[2]], [12.0, 23.0], 2.0)
    report.check("u, v at the lowest load, slide", [low[1], -low[2]], [47.0, 31.0], 4.0)


BLADE_DECK = "shell/blade_path.xml"
BLADE_SLIDE = (3.2, 0.17), (8.5, 0.145)  # deflection and level at the limit, at the end of the plateau
BLADE_LIMIT, BLADE_BUCKLES = 0.4961, 0.4440  # MN, extrapolated from refinements 1.5 and 2
PLY = {"E1": 40e9, "E2": 10e9, "nu12": 0.3, "G12": 4e9}
PLIES = ((0.02, 0.0), (0.03, 90.0))  # thickness, angle


def blade(culm, n, *settings):
    """Level and deflection of the tip, and the events; long steps beyond the buckling."""
    history, events = follow(culm, BLADE_DECK, [f"n={n}", *settings])
    return curve_of(history, "tip uy [m]"), events


def blade_buckles(culm, n):
    """The same in short steps, to where the load grows again after the skin has buckled."""
    return blade(culm, n, "Analyses/bending/Desired Iterations=3",
                 "Analyses/bending/Watch/Final Displacement=1.75")


def blade_whole(culm, n):
    longer = ["Analyses/bending/Desired Iterations=6"] if n == 1 else []  # the coarse mesh takes them all the same
    return blade(culm, n, "Analyses/bending/Largest Length=2", *longer)


def blade_flexibility(chord=2.0, thickness=0.35, length=14.0, at=0.6, pieces=4000):
    """Deflection by a unit force at the tip of a thin-walled beam: bending and shear flow [m/N]."""
    e1, e2, nu, g = PLY.values()
    q11, q22, q12 = np.array([e1, e2, nu * e2]) / (1.0 - nu**2 * e2 / e1)
    wall = sum(t for t, _ in PLIES)
    along = sum(t * (q11 if a == 0.0 else q22) for t, a in PLIES)
    around = sum(t * (q22 if a == 0.0 else q11) for t, a in PLIES)
    tension = along - (wall * q12) ** 2 / around  # of a wall that is free to become narrower
    root = 1.0 - 2.0 * np.linspace(0.0, 1.0, pieces + 1)
    x = root**2
    rest = x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1036 * x)))
    y = 5.0 * thickness * (0.2969 * root + np.where(root < 0.0, -rest, rest))
    points = chord * np.column_stack([x, y])
    d, middle = np.diff(points, axis=0), 0.5 * (points[1:] + points[:-1])
    ds = np.linalg.norm(d, axis=1)
    inertia = (ds * (middle[:, 1] ** 2 + d[:, 1] ** 2 / 12.0)).sum()
    first = ds * middle[:, 1]
    flow = -(np.cumsum(first) - 0.5 * first) / inertia
    flow /= (flow * d[:, 1]).sum()
    arm = middle[:, 0] * d[:, 1] - middle[:, 1] * d[:, 0]
    flow += (at - (flow * arm).sum()) / arm.sum()  # the force at its place
    shear = (flow**2 * ds).sum() / (g * wall)
    return length**3 / (3.0 * tension * inertia) + length * shear


def verify_blade(culm, report, n=1):
    """Against what finer meshes tend to (verify_fine_blade); errors fall with the square of n."""
    report.title(f"HY-6: blade bent by a force at its tip, refinement {n}; level in MN")
    buckled, events = blade_buckles(culm, n)
    peak_load, valley = levels_of(events, "limit point")[:2]
    path, events = blade_whole(culm, n)
    limit, deflection = max((level, u) for kind, level, u in events if kind == "limit point")
    report.note(f"skin buckles at {peak_load:.4f}, then {valley:.4f}, limit {limit:.4f} at "
                f"{deflection:.2f} m, end {path[-1, 0]:.4f}")
    report.relative("deflection of the first step, thin-walled beam", path[1, 1],
                    1e6 * path[1, 0] * blade_flexibility(), 0.02)
    report.relative("limit, of a mesh without end", limit, BLADE_LIMIT, 0.05 / n**2)
    report.relative("buckling, of a mesh without end", peak_load, BLADE_BUCKLES, 0.09 / n**2)
    report.holds("the load drops when the skin buckles: valley over peak", valley / peak_load, 0.99)
    before = buckled[: buckled[:, 0].argmax()]
    secant = before[1:, 1] / before[1:, 0]
    report.holds("deflection over load grows before that", secant[-3] / secant[0] - 1.0, 0.1)
    (at_limit, high), (at_end, low) = BLADE_SLIDE
    report.check("plateau over limit, slide", path[-1, 0] / limit, low / high, 0.05)
    report.check("it reaches so many deflections at the limit, slide", path[-1, 1] / deflection,
                 at_end / at_limit, 0.5)
    beyond = path[path[:, 1] > buckled[-1, 1], 0]
    report.holds("from the buckling to the end, load below limit", 1.0 - beyond.min() / limit, 0.2)


FRAME_DECK = "beam/right_angle_frame.xml"
BUCKLING = ((1, 1.08752), (-1, 0.68043))


def buckling(culm, force):
    settings = [f"F={force}", "Analyses/loading/Bifurcation=Stop"]
    settings += ["Analyses/loading/First Increment=0.02", "Analyses/loading/Largest Length=1"]
    return levels_of(follow(culm, FRAME_DECK, settings)[1], "bifurcation")[0]


def sideways(culm, force, skew):
    """Levels and displacement across; a skew load pushes to the side that is watched."""
    history, _ = follow(culm, FRAME_DECK, [f"F={force}", f"skew={skew * force}"])
    return curve_of(history, "tip uz [m]")


def verify_lateral(culm, report):
    report.title("SB-6: right-angle frame, order 2, 10 elements per leg; 1 %")
    for force, wanted in BUCKLING:
        name = f"F = {force}"
        report.relative(f"{name}: bifurcation", buckling(culm, force), wanted, 1e-4)
        branch, skew = sideways(culm, force, 0.0), sideways(culm, force, 1e-3)
        first = next(level for level, z in branch if z > 1e-4)
        report.relative(f"{name}: where the crossing path is entered", first, wanted, 0.01)
        report.holds(f"{name}: way to the end", abs(branch[-1, 1] - 0.06), 1e-9)
        at = [np.interp(0.04, path[:, 1], path[:, 0]) for path in (skew, branch)]
        report.relative(f"{name}: load at 40 mm, with a skew load and without", at[0], at[1], 0.01)
    for increment in (0.05, 0.15, 0.3):  # steps that end far beyond, where another direction may be weaker
        increments = [f"Analyses/loading/First Increment={increment}"]
        history, events = follow(culm, FRAME_DECK, increments)
        name = f"first increment {increment}"
        found = levels_of(events, "bifurcation")[0]
        report.relative(f"{name}: bifurcation", found, BUCKLING[0][1], 1e-4)
        first = next(level for level, z in curve_of(history, "tip uz [m]") if z > 1e-4)
        report.relative(f"{name}: where the crossing path is entered", first, found, 1e-3)


RING_DECK = "beam/foldable_ring.xml"


def verify_ring(culm, report):
    report.title("SB-7: foldable ring, 48 elements of order 2; exact at 2 pi and 4 pi, 1 %")
    once, events = follow(culm, RING_DECK)
    twice, _ = follow(culm, RING_DECK, ["Analyses/folding/Final Level=2"])
    moment = max(map(abs, once.column("drive Mx [N m]")))
    report.relative("2 pi: displacement of B", once.vector("B")[0], -0.16, 0.01)
    report.holds("2 pi: moment over its peak", abs(once.vector("drive")[3]) / moment, 1e-8)
    report.holds("4 pi: displacement over R", abs(twice.vector("B")[0]) / 0.12, 1e-8)
    report.holds("4 pi: moment over its peak", abs(twice.vector("drive")[3]) / moment, 1e-8)
    report.relative("largest displacement, read off a slide", events[0][2], 0.041, 0.03)
    path = curve_of(once, "B ux [m]", "drive Mx [N m]")
    at_peak = path[path[:, 2].argmax(), 1]
    falls = path[path[:, 2].argmax() : path[:, 2].argmin()]
    crossing = np.interp(0.0, -falls[:, 2], falls[:, 1])
    report.check("displacement at the largest moment, slide, mm", 1e3 * at_peak, 27.0, 3.0)
    report.check("displacement where the moment is zero, slide, mm", 1e3 * crossing, -130.0, 4.0)


class Roof(NamedTuple):
    """A roof of the source: what differs between the decks, the mesh that meets 1 %, its path."""

    name: str
    deck: str
    settings: tuple
    n: int
    limits: int  # limit points
    limit: float | None  # the first one's load, where the points begin before it
    lowest: float  # the last one's
    points: list
    largest: float = 4.0  # length of steps


ISOTROPIC, LAMINATE = "shell/hinged_roof_path.xml", "shell/hinged_laminate_path.xml"
THICK, THIN, ALONG, ACROSS = "t=12.7", "t=6.35", "outer=0", "outer=pi/2"
ROOFS = {
    "a": Roof("12.7 thick", ISOTROPIC, (THICK,), 16, 2, 0.7421, 0.1729, ROOF_THICK),
    "b": Roof("12.7 thick [0/90/0]", LAMINATE, (THICK, ALONG), 16, 2, None, -0.0504,
              ROOF_THICK_ALONG),
    "c": Roof("12.7 thick [90/0/90]", LAMINATE, (THICK, ACROSS), 16, 2, 0.597, 0.2789,
              ROOF_THICK_ACROSS),
    "d": Roof("6.35 thick", ISOTROPIC, (THIN,), 16, 2, 0.1953, -0.1288, ROOF_THIN),
    "e": Roof("6.35 thick [0/90/0]", LAMINATE, (THIN, ALONG), 24, 4, None, -0.078, ROOF_THIN_ALONG, 3.0),
    "f": Roof("6.35 thick [90/0/90]", LAMINATE, (THIN, ACROSS), 24, 2, None, -0.0818,
              ROOF_THIN_ACROSS, 3.0),
}


def follow_roof(culm, roof, n, largest=2, control="Linearised Sphere"):
    settings = [f"N={n}", *roof.settings, f"Analyses/snap/Control={control}"]
    settings += ["Analyses/snap/Final Level=1.1", "Analyses/snap/Steps=3000"]
    history, events = follow(culm, roof.deck, [*settings, f"Analyses/snap/Largest Length={largest}"])
    return curve_of(history, "centre uy [m]", sign=-1), events


def verify_roofs(culm, report, largest=None):
    for key, roof in ROOFS.items():
        n = roof.n
        report.title(f"SS-8{key}, {roof.name}: hinged roof, whole path, {n} x {n}; Sze et al., 1 %")
        path, events = follow_roof(culm, roof, n, largest or roof.largest)
        gap = distance(np.array(roof.points), path)
        report.holds("distance of the points from the path, over the ranges", gap, 0.01)
        levels = levels_of(events, "limit point")
        report.check("number of limit points", len(levels), roof.limits, 0)
        if roof.limit:
            report.relative("limit load", levels[0], roof.limit, 0.01)
        report.check("load at the last limit point", levels[-1], roof.lowest, 0.01 * levels[0])


def verify_roof_controls(culm, report):
    for key in "ade":
        roof = ROOFS[key]
        report.title(f"SS-8{key}, {roof.name}, 8 x 8: distances from the path in short steps")
        fine_path, _ = follow_roof(culm, roof, 8, largest=0.5)
        for control in CONTROLS:
            path, _ = follow_roof(culm, roof, 8, largest=4, control=control)
            report.holds(control, distance(path, fine_path), 1e-3)


CYLINDER_DECK = "shell/pinched_cylinder_path.xml"
CYLINDER_COLUMNS = (("load uy [m]", 1, -1), ("side ux [m]", 2, 1))


def cylinder(culm):
    settings = ["N=40", "Analyses/pinch/Final Level=1", "Analyses/pinch/Largest Length=6"]
    return follow(culm, CYLINDER_DECK, settings)[0]


def verify_cylinder(culm, report):
    report.title("SS-6: pinched cylinder, whole path, 40 x 40 as in the source; Sze et al., 2 %")
    history = cylinder(culm)
    size = np.ptp(np.array(CYLINDER)[:, :2], axis=0)  # U is small beside W: compared with it
    for column, k, sign in CYLINDER_COLUMNS:
        points = np.array([(row[0], row[k]) for row in CYLINDER])
        gap = distance(points, curve_of(history, column, sign=sign), size)
        report.holds(f"{column}: distance of the points from the path", gap, 0.02)


def verify(culm, report):
    verify_lee(culm, report)
    verify_controls(culm, report)
    verify_half(culm, report)
    verify_hybrid(culm, report)
    verify_blade(culm, report)
    verify_lateral(culm, report)
    verify_ring(culm, report)
    verify_roofs(culm, report)
    verify_roof_controls(culm, report)


def verify_fine_blade(culm, report):
    report.title("HY-6: blade, extrapolated from refinements 1.5 and 2 against 1 and 1.5; 0.5 %")

    def levels(n):
        first = levels_of(blade_buckles(culm, n)[1], "limit point")[0]
        return [first, max(levels_of(blade_whole(culm, n)[1], "limit point"))]

    coarse, middle, finest = (levels(n) for n in (1, 1.5, 2))
    report.note(f"refinement 2: skin buckles at {finest[0]:.4f}, limit {finest[1]:.4f}")
    before = richardson(coarse, middle, ratio=3 / 2)
    after = richardson(middle, finest, ratio=4 / 3)
    for k, name in enumerate(("buckling of the skin", "limit")):
        report.relative(name, before[k], after[k], 5e-3)
    report.relative("buckling of the skin, as verify_blade has it", after[0], BLADE_BUCKLES, 1e-3)
    report.relative("limit, as verify_blade has it", after[1], BLADE_LIMIT, 1e-3)


def fine(culm, report):
    verify_cylinder(culm, report)
    verify_roofs(culm, report, 2.0)
    verify_hybrid(culm, report, 2)
    verify_blade(culm, report, 1.5)
    verify_fine_blade(culm, report)


def plot_frames(culm, axes, deck, frame, unit):
    path, _ = frame_path(culm, deck)
    own = rod_path(frame) / [unit, 1.0, 1.0]
    for k, sign, name in ((1, 1, "u"), (2, -1, "–v")):
        line = axes.plot(sign * path[:, k], path[:, 0], label=name)[0]
        dots = own[own[:, 0] < path[-1, 0]][::6]
        axes.plot(sign * dots[:, k], dots[:, 0], "o", color=line.get_color(), markersize=3)
    title = "SB-4 Lee's frame" if frame == LEE else "HY-8 half frame"
    axes.set(title=f"{title}; dots shooting", xlabel="displacement", ylabel=f"force / {unit:g}")
    axes.legend()


def plot_hybrid(culm, axes):
    shot = rod_path(WALLS, 240)
    for k, sign, name in ((1, 1, "u"), (2, -1, "–v")):
        for n, style in ((1, ":"), (2, "-")):
            path, _ = hybrid(culm, n)
            axes.plot(sign * path[:, k], path[:, 0], style, color=f"C{k - 1}", label=f"{name}, {n}")
        axes.plot(sign * shot[::12, k], shot[::12, 0] / 175e3, "o", color=f"C{k - 1}", markersize=3)
    axes.set(title="HY-7 beams and walls; dots rods", xlabel="displacement",
             ylabel="force / 175 kN", ylim=(-0.3, 1.2), xlim=(0, 60))
    axes.legend(fontsize=7)


def plot_blade(culm, axes, skin):
    (at_limit, high), (at_end, low) = BLADE_SLIDE
    for n, style in ((1, ":"), (1.5, "--"), (2, "-")):
        whole, _ = blade_whole(culm, n)
        axes.plot(whole[:, 1], whole[:, 0], style, color="C0", label=f"{n}")
        path, _ = blade_buckles(culm, n)
        skin.plot(path[:, 1], path[:, 0], style, color="C0", label=f"{n}")
    limit, place = max((p, u) for p, u in whole if u > 2.0)
    axes.plot(np.array([at_limit, at_end]) / at_limit * place, np.array([high, low]) / high * limit,
              "o", color="C1")
    ends = np.array([0.0, 0.45])
    axes.plot(1e6 * blade_flexibility() * ends, ends, "C1--", linewidth=0.8)
    axes.set(title="HY-6 blade; dots slide, scaled; dashes beam", xlabel="deflection [m]",
             ylabel="force [MN]")
    skin.set(title="HY-6, where the skin buckles", xlabel="deflection [m]", ylabel="force [MN]",
             xlim=(1.2, 1.8), ylim=(0.36, 0.5))
    for panel in (axes, skin):
        panel.legend(fontsize=7)


def plot_lateral(culm, axes):
    for color, (force, wanted) in zip(("C0", "C1"), BUCKLING):
        for skew, style in ((0.0, "-"), (1e-3, "--")):
            path = sideways(culm, force, skew)
            label = f"F = {force}" + (", skew load" if skew else "")
            axes.plot(1e3 * path[:, 1], path[:, 0], style, color=color, label=label)
        axes.plot([0], [wanted], "o", color=color)
    axes.set(title="SB-6 right-angle frame; dots reference", xlabel="sideways [mm]",
             ylabel="force [N]")
    axes.legend(fontsize=7)


def plot_ring(culm, axes):
    path = curve_of(follow(culm, RING_DECK)[0], "B ux [m]", "drive Mx [N m]")
    axes.plot(1e3 * path[:, 1], path[:, 2])
    axes.plot([0, -160], [0, 0], "o")
    axes.set(title="SB-7 foldable ring, 0 to 2π; dots exact", xlabel="displacement of B [mm]",
             ylabel="moment [N m]")


def plot_roofs(culm, axes, keys):
    for color, dots, key in zip(("C0", "C2"), ("C1", "C3"), keys):
        roof = ROOFS[key]
        for n, style in ((8, ":"), (roof.n, "-")):
            path, _ = follow_roof(culm, roof, n)
            axes.plot(path[:, 1], path[:, 0], style, color=color, label=f"{key}, {n} x {n}")
        axes.plot([w for _, w in roof.points], [p for p, _ in roof.points], "o", color=dots,
                  markersize=3)
    thickness = ROOFS[keys[0]].name.split()[0]
    axes.set(title=f"SS-8{', '.join(keys)}, {thickness} thick; dots Sze et al.",
             xlabel="deflection of the centre", ylabel="force / 3000")
    axes.legend(fontsize=7)


def plot_cylinder(culm, axes):
    history = cylinder(culm)
    for column, k, sign in CYLINDER_COLUMNS:
        path = curve_of(history, column, sign=sign)
        line = axes.plot(path[:, 1], path[:, 0])[0]
        axes.plot([row[k] for row in CYLINDER], [row[0] for row in CYLINDER], "o",
                  color=line.get_color(), markersize=3)
    axes.set(title="SS-6 pinched cylinder; dots Sze et al.", ylabel="force / 12000",
             xlabel="–W under the force, U of the side")


def plot(culm, path):
    fig, _ = figure(2, 19.2)
    fig.clf()
    panels = fig.subplots(6, 2).ravel()
    plot_frames(culm, panels[0], LEE_DECK, LEE, 1.0)
    plot_frames(culm, panels[1], HALF_DECK, HALF, 1e5)
    plot_lateral(culm, panels[2])
    plot_hybrid(culm, panels[3])
    plot_ring(culm, panels[4])
    plot_cylinder(culm, panels[5])
    for axes, keys in zip(panels[6:], ("a", "d", "bc", "ef")):
        plot_roofs(culm, axes, keys)
    panels[9].set(xlim=(0, 36), ylim=(-0.12, 0.3))  # where e and f turn round
    plot_blade(culm, panels[10], panels[11])
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot, fine)
