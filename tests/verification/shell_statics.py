#!/usr/bin/python3
"""SS-1, SS-2, SS-4, SS-6, SS-8 to SS-11: shells in statics. Page: doc/verification/shells.md."""

import math
import tempfile

import numpy as np
from verify import figure, main, mesh_axis, romberg, save  # puts culm_runs on the path

import culm_runs

SHELL = "Structures/shell"
PLAIN = [f"{SHELL}/Assumed Strains=false", f"{SHELL}/Enhanced Membrane=None",
         f"{SHELL}/Enhanced Thickness=None"]

# Sze, Liu, Lo (2004): share of the full load, displacements
SHEAR = [(0.1, 0.103, 1.309), (0.2, 0.381, 2.493), (0.3, 0.763, 3.488), (0.4, 1.184, 4.292),
         (0.5, 1.604, 4.933), (0.6, 2.002, 5.444), (0.7, 2.370, 5.855), (0.8, 2.705, 6.190),
         (0.9, 3.010, 6.467), (1.0, 3.286, 6.698)]
ROOF_THICK = [(0.0877, 0.693), (0.1980, 1.638), (0.3473, 3.087), (0.4686, 4.477), (0.5647, 5.802),
              (0.6381, 7.057), (0.6908, 8.237), (0.7246, 9.339), (0.7412, 10.358),
              (0.7421, 11.293)]
ROOF_THIN = [(0.0517, 1.846), (0.1182, 5.271), (0.1583, 8.257), (0.1837, 10.799),
             (0.1914, 11.904), (0.1953, 12.892)]
HEMISPHERE = [(0.1, 1.499, 1.840), (0.2, 2.321, 3.261), (0.3, 2.819, 4.339), (0.4, 3.158, 5.196),
              (0.5, 3.406, 5.902), (0.6, 3.598, 6.497), (0.7, 3.750, 7.006), (0.8, 3.875, 7.448),
              (0.9, 3.979, 7.835), (1.0, 4.067, 8.178)]
CYLINDER = [(0.05, 9.561, -0.233), (0.075, 15.648, -0.922), (0.1, 23.164, -2.391),
            (0.125, 29.375, -3.872)]


def grid_node(columns, i, j):
    """Number of the node in column i, row j of a patch; from row 2 on they follow the rows."""
    assert j >= 2
    return f"shell/{j * (columns + 1) + i}"


class Linear:
    """A small load on meshes of n; a displacement over its reference."""

    def __init__(self, name, deck, settings, value, reference, good, thick=False):
        self.name, self.deck, self.settings, self.value = name, deck, settings, value
        self.reference = reference
        self.good = good  # ratio of MITC4+ on 16 x 16 elements, or 1
        self.thick = thick

    def ratio(self, culm, n, more=()):
        return self.value(culm.history(self.deck, self.settings(n) + list(more))) / self.reference


def hypar(thickness, load, reference, good):
    def settings(n):
        node = grid_node(n, n, n // 2)
        return [f"N={n}", f"t={thickness}", f"p={load[0]}", f"Output/History/tip/Node={node}"]

    return Linear(f"hypar, t/L = {thickness}", "shell/hypar.xml", settings,
                  lambda history: -history.vector("tip")[2] * load[1], reference, good)


def twisted(thickness, force, direction, reference, name):
    names = {"y": 1, "z": 2}

    def settings(n):
        forces = {"y": 0.0, "z": 0.0, direction: force}
        return [f"t={thickness}", f"N={3 * n // 2}", f"M={n // 4}",
                *(f"F{axis}={value}" for axis, value in forces.items())]

    def value(history):
        k = names[direction]
        return 0.5 * (history.vector("tip")[k] + history.vector("other")[k])

    return Linear(f"twisted beam, t = {thickness}, {name}", "shell/twisted_beam.xml", settings,
                  value, reference, 0.9975, thick=thickness > 0.1)


def plate():
    def settings(n):
        return [f"N={n}", f"Output/History/centre/Node={grid_node(n, n // 2, n // 2)}"]

    rigidity = 1e7 * 1e-9 / (12.0 * (1.0 - 0.3**2))
    return Linear("clamped plate", "shell/clamped_plate.xml", settings,
                  lambda history: -history.vector("centre")[2], 1.26532e-3 * 1e-6 / rigidity, 1.0)


def pinched_cylinder():
    # 1.82488e-5 for a unit force, thickness 3 and modulus 3e6
    return Linear("pinched cylinder", "shell/pinched_cylinder.xml", 
                  lambda n: [f"N={n}", "F=0.1", "Analyses/loading/Steps=1"],
                  lambda history: -history.vector("load")[1], 1.82488e-5 * 9e6 * 0.1 / 30e3, 0.931)


def scordelis_lo():
    return Linear("Scordelis-Lo roof", "shell/scordelis_lo.xml", lambda n: [f"N={n}"],
                  lambda history: -history.vector("edge")[1], 0.3024e-3, 0.997)


def pinched_hemisphere(thickness=0.04, reference=0.093):
    force = 0.02 * (thickness / 0.04) ** 3

    def value(history):
        return history.vector("outward")[0] / force * 2.0

    return Linear(f"hemisphere with hole, R/t = {10.0 / thickness:g}",
                  "shell/pinched_hemisphere.xml",
                  lambda n: [f"N={n}", f"t={thickness!r}", f"F={force!r}",
                             "Analyses/loading/Steps=1"], value, reference, 1.003)


# SS-9, references as on the page
CASES = [
    pinched_cylinder(),
    scordelis_lo(),
    pinched_hemisphere(),
    twisted(0.32, 1.0, "z", 5.424e-3, "in its plane"),
    twisted(0.32, 1.0, "y", 1.754e-3, "out of it"),
    twisted(0.0032, 1e-6, "z", 5.256e-3, "in its plane"),
    twisted(0.0032, 1e-6, "y", 1.294e-3, "out of it"),
    hypar(1e-2, (8, 10.0), 9.3355e-5, 0.976),
    hypar(1e-3, (8e-4, 1e4), 6.3941e-3, 0.978),
    hypar(1e-4, (8e-5, 1e4), 0.52988, 0.978),
    plate(),
]


def verify_linear(culm, report, n=16):
    report.title("SS-9: linear cases on 16 x 16 elements, as good as MITC4+")
    for case in CASES:
        report.check(f"{case.name}: ratio to the reference", case.ratio(culm, n), case.good,
                     0.02 * case.good)


def verify_fine(culm, report):
    report.title("SS-9: linear cases on 64 x 64 elements")
    for case in CASES:
        report.check(f"{case.name}: ratio to the reference", case.ratio(culm, 64), 1.0, 0.012)
    verify_thickness(culm, report, SWEEP[:-1])
    verify_folds(culm, report, 20)


def verify_locking(culm, report):
    report.title("Without assumed and enhanced strains, 16 x 16: the thin cases must lock")
    for case in CASES:
        if case.thick:
            continue
        report.holds(f"{case.name}: ratio", case.ratio(culm, 16, PLAIN), 0.5)


def verify_shear(culm, report):
    levels = ", ".join(str(row[0]) for row in SHEAR)
    for elements, tolerance in ((16, 0.02), (32, 0.01)):
        report.title(f"SS-1: cantilever under end shear, {elements} elements; Sze et al.")
        history = culm.history("shell/cantilever_shear.xml", [
            f"Structures/strip/Mesh/Elements={{{elements}, 1}}",
            f"Analyses/bending/Levels={{{levels}}}"])
        for level, along, across in SHEAR:
            tip = history.vector("tip", level)
            # digits of the table end at 5e-4
            report.holds(f"level {level}, -U {-tip[0]:.4f}, {along}",
                         max(0.0, abs(-tip[0] - along) - 5e-4) / along, tolerance)
            report.holds(f"level {level},  W {tip[2]:.4f}, {across}",
                         max(0.0, abs(tip[2] - across) - 5e-4) / across, tolerance)


def circle(level, length=12.0):
    """Tip of a straight strip that the share `level` of 2 pi E I / L bends to an arc."""
    angle = 2.0 * math.pi * level
    return [length * (math.sin(angle) / angle - 1.0), 0.0, length * (1.0 - math.cos(angle)) / angle]


def verify_moment(culm, report):
    report.title("SS-2: strip under end moment; distance of the tip from the exact arc over 12")
    levels = [0.25, 0.5, 0.75, 1.0]
    meshes = (16, 32, 64)
    runs = [culm.history("shell/strip_rolled_up.xml", [
        f"Structures/strip/Mesh/Elements={{{n}, 1}}",
        f"Analyses/bending/Levels={{{', '.join(map(str, levels))}}}"]) for n in meshes]
    for level in levels:
        tips = [run.vector("tip", level) for run in runs]
        for n, tip, tolerance in zip(meshes, tips, (0.03, 0.01, 0.003)):
            error = math.dist(tip, circle(level)) / 12.0
            report.holds(f"level {level}, {n} elements", error, tolerance)
        limit = [romberg([tip[k] for tip in tips]) for k in range(3)]
        # the arc is that of a line; a wall of St. Venant-Kirchhoff differs by (curvature * thickness)^2
        allowed = (2.0 * math.pi * level / 12.0 * 0.1) ** 2
        report.holds(f"level {level}, extrapolated", math.dist(limit, circle(level)) / 12.0, allowed)


def path_at(culm, deck, levels, settings):
    """History of a run that meets these levels."""
    return culm.history(deck, [*settings, f"Analyses/loading/Final Level={max(levels)}",
                               f"Analyses/loading/Levels={{{', '.join(map(str, levels))}}}"])


def verify_hemisphere(culm, report):
    for n, enhanced, tolerance in ((16, 4, 0.02), (16, 7, 0.02), (32, 4, 0.01)):
        report.title(f"SS-4: pinched hemisphere, {n} x {n} elements, {enhanced} enhanced membrane strains; Sze et al.")
        history = path_at(culm, "shell/pinched_hemisphere.xml", [row[0] for row in HEMISPHERE],
                          [f"N={n}", f"{SHELL}/Enhanced Membrane={enhanced}"])
        for level, outward, inward in HEMISPHERE:
            found = [history.vector("outward", level)[0], -history.vector("inward", level)[1]]
            for name, one, wanted in zip(("outward", "inward"), found, (outward, inward)):
                report.relative(f"level {level}, {name}", one, wanted, tolerance)


def verify_cylinder(culm, report):
    report.title("SS-6: pinched cylinder before its snap, 32 x 32 elements; Sze et al.")
    history = path_at(culm, "shell/pinched_cylinder.xml", [row[0] for row in CYLINDER],
                      ["N=32", "F=12000", "Analyses/loading/Steps=5"])
    for level, load, side in CYLINDER:
        report.relative(f"level {level}, -W", -history.vector("load", level)[1], load, 0.02)
        # small beside W: compared with it
        report.check(f"level {level}, U", history.vector("side", level)[0], side, 0.02 * load)


ROOF = "shell/hinged_roof.xml"
ROOFS = (("SS-8a, 12.7 thick", 12.7, ROOF_THICK, 0.8), ("SS-8d, 6.35 thick", 6.35, ROOF_THIN, 0.25))


def roof(culm, thickness, n, highest):
    """Loads over 3000 and deflections of the centre up to the highest load that holds."""
    run = culm.run(ROOF, [f"N={n}", f"t={thickness}", f"Analyses/loading/Final Level={highest}"])
    return run.history.levels, [-u for u in run.history.column("centre uy [m]")]


def verify_roof(culm, report):
    for name, thickness, path, highest in ROOFS:
        report.title(f"{name}: hinged roof up to its limit point, load over 3000; Sze et al.")
        report.relative("limit load, 8 x 8", max(roof(culm, thickness, 8, highest)[0]),
                        path[-1][0], 0.02)
        below = [row for row in path if row[0] < 0.95 * path[-1][0]]
        history = path_at(culm, ROOF, [load for load, _ in below],
                          ["N=16", f"t={thickness}", "Analyses/loading/Steps=5"])
        for load, deflection in below:
            report.relative(f"deflection at {load}, 16 x 16", -history.vector("centre", load)[1],
                            deflection, 0.02)


def verify_thickness(culm, report, sweep=None):
    report.title("Thickness: 16 x 16 over 32 x 32 elements must not fall; hemisphere, hypar")
    for thickness in sweep or SWEEP[::2]:
        report.check(f"hemisphere, R/t = {10.0 / thickness:g}", hemisphere_loss(culm, thickness),
                     1.0, 0.02)
    for thickness in sweep or SWEEP[1:-1:2]:
        report.check(f"hypar, L/t = {10.0 / thickness:g}", hypar_loss(culm, thickness), 1.0, 0.05)


SWEEP = (1.0, 0.1, 1e-2, 1e-3, 1e-4)  # for radius and side 10


def hemisphere_loss(culm, thickness):
    case = pinched_hemisphere(thickness)
    return case.ratio(culm, 16) / case.ratio(culm, 32)


def hypar_loss(culm, thickness):
    t = 0.1 * thickness
    case = hypar(t, (80.0 * (t / 1e-2) ** 2.5, 1.0), 1.0, 1.0)
    return case.ratio(culm, 16) / case.ratio(culm, 32)


def raasch_hook(across):
    """Gmsh file of the hook: 60 degrees of radius 14, then 150 of 46 to the other side, 20 wide."""
    points, heading = [(0.0, 0.0)], 0.0
    for radius, angle, side in ((14.0, math.pi / 3.0, 1.0), (46.0, -5.0 * math.pi / 6.0, -1.0)):
        x, y = points[-1]
        along = round(across * radius * abs(angle) / 20.0)
        turns = [heading + angle * (i + 1) / along for i in range(along)]
        points += [(x + side * radius * (math.sin(h) - math.sin(heading)),
                    y - side * radius * (math.cos(h) - math.cos(heading))) for h in turns]
        heading = turns[-1]
    row, last = across + 1, len(points) - 1
    number = lambda i, j: i * row + j + 1
    nodes = [f"{number(i, j)} {x:.12g} {y:.12g} {20.0 * j / across:.12g}"
             for i, (x, y) in enumerate(points) for j in range(row)]
    cells = [f"15 2 1 1 {number(last, 0)}"]
    for i, group in ((0, 2), (last, 3)):
        cells += [f"1 2 {group} {group} {number(i, j)} {number(i, j + 1)}" for j in range(across)]
    cells += [f"3 2 4 4 {number(i, j)} {number(i + 1, j)} {number(i + 1, j + 1)} {number(i, j + 1)}"
              for i in range(last) for j in range(across)]
    return "\n".join([
        "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "4", '0 1 "corner"',
        '1 2 "clamp"', '1 3 "tip"', '2 4 "hook"', "$EndPhysicalNames", "$Nodes", str(len(nodes)),
        *nodes, "$EndNodes", "$Elements", str(len(cells)),
        *(f"{k + 1} {cell}" for k, cell in enumerate(cells)), "$EndElements", ""])


def hook_ratio(culm, across):
    """Deflection of the tip under a unit force over the reference."""
    with tempfile.NamedTemporaryFile("w", suffix=".msh") as file:
        file.write(raasch_hook(across))
        file.flush()
        history = culm.history("shell/raasch_hook.xml",
                               [f"Structures/shell/Mesh/File Name={file.name}"])
    return history.vector("tip")[2] / 1e-3 / 5.022


def verify_hook(culm, report):
    report.title("SS-9: Raasch's hook, ratio to 5.022 (MITC9: 0.961)")
    for across, tolerance in ((4, 0.05), (16, 0.02)):
        report.check(f"{across} elements across", hook_ratio(culm, across), 1.0, tolerance)


def full_hemisphere(n, radius=10.0):
    """Gmsh file of a quarter hemisphere: three patches of n x n that meet in its middle."""

    def unit(v):
        return tuple(c / math.hypot(*v) for c in v)

    def between(a, b, s):  # on the great circle
        angle = math.acos(sum(p * q for p, q in zip(a, b)))
        return unit([math.sin((1.0 - s) * angle) * p + math.sin(s * angle) * q
                     for p, q in zip(a, b)])

    numbers, points = {}, []

    def node(p):
        key = tuple(round(c, 9) + 0.0 for c in p)
        if key not in numbers:
            points.append(p)
            numbers[key] = len(points)
        return numbers[key]

    X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    middle, quads = unit((1.0, 1.0, 1.0)), []
    for a, b, c in ((X, Y, Z), (Y, Z, X), (Z, X, Y)):
        right, left = between(a, b, 0.5), between(c, a, 0.5)
        grid = [[node(between(between(a, right, i / n), between(left, middle, i / n), j / n))
                 for j in range(n + 1)] for i in range(n + 1)]
        quads += [(grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1])
                  for i in range(n) for j in range(n)]
    cells = [f"15 2 {group} {group} {node(p)}" for group, p in enumerate((X, Y, Z), 1)]
    for group, axis in ((4, 1), (5, 0)):
        side = sorted((k for k, p in enumerate(points, 1) if abs(p[axis]) < 1e-9),
                      key=lambda k: points[k - 1][2])
        cells += [f"1 2 {group} {group} {p} {q}" for p, q in zip(side, side[1:])]
    cells += [f"3 2 6 6 {' '.join(map(str, quad))}" for quad in quads]
    nodes = [f"{k} " + " ".join(f"{radius * c:.12g}" for c in p) for k, p in enumerate(points, 1)]
    return "\n".join([
        "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "6", '0 1 "x"', '0 2 "y"',
        '0 3 "pole"', '1 4 "plane y"', '1 5 "plane x"', '2 6 "shell"', "$EndPhysicalNames",
        "$Nodes", str(len(nodes)), *nodes, "$EndNodes", "$Elements", str(len(cells)),
        *(f"{k + 1} {cell}" for k, cell in enumerate(cells)), "$EndElements", ""])


def verify_full_hemisphere(culm, report):
    report.title("SS-9: full hemisphere, ratio to 0.0924 (MITC4+ on 16 x 16: 0.996)")
    for n, wanted, tolerance in ((8, 0.996, 0.02), (16, 1.0, 0.01)):
        with tempfile.NamedTemporaryFile("w", suffix=".msh") as file:
            file.write(full_hemisphere(n))
            file.flush()
            history = culm.history("shell/full_hemisphere.xml",
                                   [f"{SHELL}/Mesh/File Name={file.name}"])
        report.check(f"{2 * n} elements along a quarter of the equator",
                     history.vector("outward")[0] / 0.01 / 0.0924, wanted, tolerance)


def sandwich_series(face_shear, side=254.0, face=0.7112, core=19.05, pressure=0.689476, terms=80):
    """Deflection [mm] of the plate's centre by first-order shear theory, Navier's double series."""
    e1, e2, g12, nu, soft = 68947.57, 27579.03, 12927.67, 0.3, 0.7
    inertia = 2.0 * (face**3 / 12.0 + face * (0.5 * (core + face)) ** 2)
    of_core = soft * core**3 / 12.0
    plane = inertia / (1.0 - nu**2 * e2 / e1)
    d11, d22, d12 = e1 * plane + of_core, e2 * plane + of_core, nu * e2 * plane
    d66 = g12 * inertia + of_core
    a55, a44 = (g * core + 2.0 * face * face_shear for g in (209.6, 82.737))
    total = 0.0
    for m in range(1, terms, 2):
        for n in range(1, terms, 2):
            a, b = m * math.pi / side, n * math.pi / side
            stiffness = np.array([
                [a55 * a**2 + a44 * b**2, a55 * a, a44 * b],
                [a55 * a, d11 * a**2 + d66 * b**2 + a55, (d12 + d66) * a * b],
                [a44 * b, (d12 + d66) * a * b, d66 * a**2 + d22 * b**2 + a44]])
            load = 16.0 * pressure / (math.pi**2 * m * n)
            amplitude = np.linalg.solve(stiffness, [load, 0.0, 0.0])[0]
            total += amplitude * math.sin(0.5 * m * math.pi) * math.sin(0.5 * n * math.pi)
    return total


def verify_sandwich(culm, report):
    report.title("SS-10: sandwich plate, 16 x 16 elements, deflection of the centre [mm]")
    found = {}
    for name, shear in (("core carries the shear", 1.0), ("faces carry it as well", 12927.67)):
        history = culm.history("shell/sandwich_plate.xml", ["N=16", f"G={shear}"])
        found[shear] = -1e3 * history.vector("centre")[2]
        report.relative(f"{name}: series", found[shear], sandwich_series(shear), 0.01)
    report.relative("core carries the shear: NAFEMS R0031(3)", found[1.0], 3.1242, 0.02)
    history = culm.history("shell/sandwich_plate.xml",
                           ["N=16", "G=12927.67", f"{SHELL}/Shear Correction=Equilibrium"])
    report.relative("true data with shear correction: NAFEMS", -1e3 * history.vector("centre")[2],
                    3.1242, 0.02)


# Kim, Thai, Lee (2009), first-order shear theory: aspect b/a, slenderness a/h, 100 w E2 h^3 / (q a^4)
ANGLE_PLY = [(1, 4, 1.1576), (1, 10, 0.5773), (1, 100, 0.4678), (3, 4, 3.3814), (3, 10, 2.2784),
             (3, 100, 2.0674)]


def angle_ply_deflection(culm, aspect, slenderness, n=16):
    """Centre of a [45/-45] plate of n x n elements under q sin(pi x / a) sin(pi y / b)."""
    h, q = 1.0 / slenderness, 1e-6 / slenderness**3

    def lumped(i, side):  # what a node of linear elements gets of a sine
        width = math.pi / n
        return math.sin(i * width) * side / n * (math.sin(0.5 * width) / (0.5 * width))**2

    nodes = first_rows(n) | {(i, j): grid_node(n, i, j) for i in range(n) for j in range(2, n)}
    loads = "".join(
        f"""
    <ParameterList name="load {i} {j}">
      <Parameter name="Type" value="Force"/>
      <Parameter name="Node" value="{nodes[i, j]}"/>
      <Parameter name="Force" value="{{0, 0, {q * lumped(i, 1.0) * lumped(j, aspect)!r}}}"/>
    </ParameterList>"""
        for i in range(1, n) for j in range(1, n))
    deck = (culm_runs.INPUTS / "shell/angle_ply.xml").read_text()
    start = deck.index('<ParameterList name="Loads">')
    end = deck.index("</ParameterList>\n  <ParameterList name=\"Analyses\"")
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
        file.write(deck[:start] + '<ParameterList name="Loads">' + loads + "\n  " + deck[end:])
        file.flush()
        history = culm.history(file.name, [f"N={n}", f"b={aspect}", f"h={h!r}",
                                           f"Output/History/centre/Node={grid_node(n, n // 2, n // 2)}"])
    return history.vector("centre")[2] * 100.0 * h**3 / q


def first_rows(n):
    """Nodes of rows 0 and 1 of a patch, numbered element by element."""
    nodes = {}
    for i in range(n):
        for corner in ((i, 0), (i + 1, 0), (i + 1, 1), (i, 1)):
            nodes.setdefault(corner, len(nodes))
    return {place: f"shell/{number}" for place, number in nodes.items()}


def verify_angle_ply(culm, report):
    report.title("SS-10: angle-ply plate [45/-45] under a sine, 16 x 16, 100 w E2 h^3 / (q a^4)")
    for aspect, slenderness, reference in ANGLE_PLY:
        report.relative(f"b/a = {aspect}, a/h = {slenderness}",
                        angle_ply_deflection(culm, aspect, slenderness), reference, 0.01)


def verify_transition(culm, report):
    report.title("Tube bent by an end force: half shell, half beam against shells all along")
    history = culm.history("hybrid/tube_transition.xml", ["N=24", "M=32"])
    deflection = history.vector("full")[0]
    for name, across in (("rigid", 0.3), ("soft", 0.1)):
        report.relative(f"{name} transition: deflection of the tip", history.vector(name)[0],
                        deflection, 1e-2)
        for place in ("clamp", "middle", "last row"):
            axial = history.vector(f"full {place}")[0]
            report.relative(f"axial stress, {place}", history.vector(f"{name} {place}")[0], axial,
                            2e-3)
        # how far the transition holds the width of the tube: at most nu times the axial stress
        report.check("stress around in the last row over the axial one",
                     history.vector(f"{name} last row")[1] / axial,
                     history.vector("full last row")[1] / axial, across)


def fold_ratio(culm, angle, thickness, n):
    """Deflection of a folded strip over that of a frame with a stiff corner."""
    history = culm.history("shell/folded_strip.xml",
                           [f"a={angle}", f"t={thickness}", f"N={n}"])
    cosine = math.cos(math.radians(angle))
    reach = 1.0 - cosine
    bending = cosine**2 / 3.0 + (reach**3 - (reach - 1.0) ** 3) / 3.0
    return history.vector("tip")[1] * 1e6 * thickness**3 / 12.0 / 1e-4 / bending


def verify_folds(culm, report, n=10):
    report.title(f"Folded strip against a frame with a stiff corner, {n} elements per wall; 0.5 %")
    for angle in (170, 90, 45, 20, 6):
        for thickness in (0.02, 0.05):
            report.relative(f"{angle} degrees, t = {thickness}", fold_ratio(culm, angle, thickness, n), 1.0, 5e-3)


def verify_z_section(culm, report):
    report.title("SS-9: Z-section under torque (NAFEMS LE5), axial stress at the edge of a flange [MPa]")
    for n in (2, 4, 8):
        report.relative(f"{n} elements over a flange", edge_stress(culm, n), -108.0, 0.03)


def edge_stress(culm, n):
    """At 2.5 m: mean of the elements before and behind, from two rows of centres to the edge."""
    history = culm.history("shell/z_section.xml", [f"n={n}"])
    edge, inner = (0.5 * sum(history.vector(f"{row} {side}")[0] for side in ("before", "behind"))
                   for row in ("edge", "inner"))
    return 1.5 * edge - 0.5 * inner


def to_layer(angle):
    """Turns plane strains (engineering shear last) to the axes of a layer."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c * c, s * s, c * s], [s * s, c * c, -c * s],
                     [-2.0 * c * s, 2.0 * c * s, c * c - s * s]])


def plane_stiffness(e1, e2, nu12, g12):
    Q = np.zeros((3, 3))
    Q[:2, :2] = np.array([[e1, nu12 * e2], [nu12 * e2, e2]]) / (1.0 - nu12**2 * e2 / e1)
    Q[2, 2] = g12
    return Q


def bending_stiffness(Q, angles, thickness):
    """D of classical laminate theory, layers of one thickness."""
    z = [thickness * (k / len(angles) - 0.5) for k in range(len(angles) + 1)]
    return sum(to_layer(angle).T @ Q @ to_layer(angle) * (z[k + 1]**3 - z[k]**3) / 3.0
               for k, angle in enumerate(angles))


def verify_layers(culm, report):
    report.title("Symmetric angle-ply strip: stresses of layers from moments, classical laminate theory")
    angles = [math.pi / 6, -math.pi / 6, -math.pi / 6, math.pi / 6]
    shown = {"top": (3, 0.05), "bottom": (0, -0.05), "cross ply": (2, 0.025)}  # layer, height
    history = culm.history("shell/layered_strip.xml", [
        "Structures/strip/Angles={pi/6, -pi/6, -pi/6, pi/6}", "Structures/strip/Thickness=0.025",
        "Structures/strip/Mesh/Elements={40, 8}", "Materials/ply/nu12=0.25",
        *(f"Output/History/{name}/Element=140" for name in ("force", "strain", *shown)),
        *(f"Output/History/{name}/Layer={layer}" for name, (layer, _) in shown.items())])
    Q = plane_stiffness(25e6, 1e6, 0.25, 0.5e6)
    curvature = np.linalg.solve(bending_stiffness(Q, angles, 0.1), history.vector("force")[3:6])
    for name, (layer, z) in shown.items():
        wanted = Q @ to_layer(angles[layer]) @ curvature * z
        found = [history.vector(name)[k] for k in (0, 1, 5)]
        report.relative(f"{name}: S11, S22, S12", found, list(wanted), 1e-3)


def free_cylinder(culm, slenderness, n=32):
    """Deflection under two opposite forces, times E t^3 / (F R); the diaphragms hold nothing here."""
    radius, modulus, small = 4.953, 10.5e6, 1e-6
    thickness = radius / slenderness
    force = small * modulus * thickness**3 / radius
    mesh = f"{SHELL}/Mesh"
    history = culm.history("shell/pinched_cylinder.xml", [
        f"N={n}", f"t={thickness!r}", f"F={force!r}", f"{mesh}/Radius={radius}",
        f"{mesh}/Length={10.35 / 2.0}", f"Materials/elastic/Young Modulus={modulus!r}",
        "Materials/elastic/Poisson Ratio=0.3125", "Constraints/diaphragm x/Node=shell/u1",
        "Constraints/diaphragm y/Node=shell/u0", "Analyses/loading/Steps=1"])
    return -history.vector("load")[1] / small


def verify_free_cylinder(culm, report):
    report.title("SS-9: pinched cylinder with free ends, 32 x 32, w E t^3 / (F R); Briassoulis")
    for slenderness, reference in ((1e2, 1.997), (1e4, 1.912)):
        report.relative(f"R/t = {slenderness:g}", free_cylinder(culm, slenderness), reference, 0.02)


# stretch, first Piola stress over E, lateral stretch of a Neo-Hooke solid, nu = 0.3; exact
NEO_HOOKE = [(0.6, -0.62434857, 1.15498215), (0.8, -0.24000538, 1.06733837),
             (0.9, -0.10872219, 1.03170243), (1.1, 0.09307743, 0.97149295),
             (1.25, 0.21260478, 0.93356010), (1.5, 0.37828018, 0.88017459),
             (2.0, 0.64674466, 0.79807754)]


def verify_uniaxial(culm, report):
    def check(material, rows, tolerance):
        """Rows of one sign of the stress are levels of one run."""
        largest = max((stress for _, stress, _ in rows), key=abs)
        levels = sorted(stress / largest for _, stress, _ in rows)
        history = culm.history("shell/uniaxial_stress.xml",
                               [f"P={largest!r}", f"Materials/elastic/Type={material}",
                                f"Analyses/loading/Levels={{{', '.join(map(repr, levels))}}}"])
        for stretch, stress, lateral in rows:
            for point, x, y in (("corner", 1.0, 1.0), ("inside", 0.7, 0.75)):
                exact = [x * (stretch - 1.0), y * (lateral - 1.0), 0.0]
                found = history.vector(point, stress / largest)
                report.check(f"stretch {stretch}, {point}", found, exact, tolerance)

    def signs(rows):
        return [[row for row in rows if sign * row[1] > 0.0] for sign in (-1.0, 1.0)]

    report.title("SS-11: St. Venant-Kirchhoff patch in uniaxial stress, exact")
    for rows in signs([(s, 0.5 * s * (s**2 - 1.0), math.sqrt(1.0 - 0.3 * (s**2 - 1.0))) for s, _, _ in NEO_HOOKE]):
        check("Isotropic", rows, 1e-9)
    report.title("SS-11: Neo-Hooke patch in uniaxial stress, eight digits after the point")
    for rows in signs(NEO_HOOKE):
        check("Neo-Hooke", rows, 5e-8)


def verify(culm, report):
    verify_linear(culm, report)
    verify_locking(culm, report)
    verify_thickness(culm, report)
    verify_hook(culm, report)
    verify_full_hemisphere(culm, report)
    verify_free_cylinder(culm, report)
    verify_shear(culm, report)
    verify_moment(culm, report)
    verify_hemisphere(culm, report)
    verify_cylinder(culm, report)
    verify_roof(culm, report)
    verify_sandwich(culm, report)
    verify_angle_ply(culm, report)
    verify_transition(culm, report)
    verify_folds(culm, report)
    verify_z_section(culm, report)
    verify_layers(culm, report)
    verify_uniaxial(culm, report)


def plot(culm, path):
    fig, axes = figure(3, 4.2)
    linear, paths, thin = axes
    meshes = [8, 16, 32]
    for k, case in enumerate(CASES):
        line = linear.plot(meshes, [case.ratio(culm, n) for n in meshes], ("-", "--")[k // 10],
                           label=case.name)[0]
        if case.good != 1.0:
            linear.plot([16], [case.good], "o", color=line.get_color(), markersize=4)
    linear.set_xscale("log")
    mesh_axis(linear, meshes)
    linear.set(title="linear cases; dots MITC4+", xlabel="elements per side",
               ylabel="displacement / reference", ylim=(0.75, 1.03))
    linear.legend(fontsize=6, loc="lower right")
    for name, thickness, points, highest in ROOFS:
        levels, deflections = roof(culm, thickness, 8, highest)
        line = paths.plot([u / 30.0 for u in deflections], levels, label=name)[0]
        paths.plot([u / 30.0 for _, u in points], [p for p, _ in points], "o",
                   color=line.get_color(), markersize=3)
    history = path_at(culm, "shell/pinched_hemisphere.xml", [row[0] for row in HEMISPHERE], ["N=32"])
    for column, sign, k in (("outward ux [m]", 0.1, 1), ("inward uy [m]", -0.1, 2)):
        line = paths.plot([sign * u for u in history.column(column)], history.levels,
                          label="SS-4, " + column.split()[0])[0]
        paths.plot([0.1 * row[k] for row in HEMISPHERE], [row[0] for row in HEMISPHERE], "o",
                   color=line.get_color(), markersize=3)
    paths.set(title="large displacements; dots Sze et al.", ylabel="load / full load",
              xlabel="displacement / 10 (SS-4), / 30 (SS-8)")
    paths.legend(fontsize=7)
    slender = [10.0 / t for t in SWEEP]
    thin.semilogx(slender, [hemisphere_loss(culm, t) for t in SWEEP], "o-", label="hemisphere, R/t")
    thin.semilogx(slender[:-1], [hypar_loss(culm, t) for t in SWEEP[:-1]], "o-",
                  label="hypar, L/t")
    thin.set(title="16 x 16 over 32 x 32 elements", xlabel="slenderness",
             ylabel="ratio of displacements", ylim=(0.9, 1.05))
    thin.legend()
    save(fig, path)


main(verify, plot, verify_fine)
