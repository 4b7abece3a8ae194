#!/usr/bin/python3
"""SS-1, SS-8 to SS-11: shells in statics. Page: doc/verification/shells.md."""

import math

from verify import figure, main, mesh_axis, save

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


# SS-9, references as on the page
CASES = [
    twisted(0.32, 1.0, "z", 5.424e-3, "in its plane"),
    twisted(0.32, 1.0, "y", 1.754e-3, "out of it"),
    twisted(0.0032, 1e-6, "z", 5.256e-3, "in its plane"),
    twisted(0.0032, 1e-6, "y", 1.294e-3, "out of it"),
    hypar(1e-2, (8, 10.0), 9.3355e-5, 0.976),
    hypar(1e-3, (8e-4, 1e4), 6.3941e-3, 0.978),
    hypar(1e-4, (8e-6, 1e5), 0.52988, 0.978),
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
        report.check(f"{case.name}: ratio to the reference", case.ratio(culm, 64), 1.0, 0.01)


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


def roof(culm, thickness, n, highest):
    """Loads over 3000 and deflections of the centre up to the highest load that holds."""
    node = grid_node(n, n // 2, n // 2)
    run = culm.run("shell/hinged_roof.xml", [
        f"N={n}", f"t={thickness}", f"Output/History/centre/Node={node}",
        f"Loads/centre/Node={node}", f"Analyses/loading/Final Level={highest}"])
    return run.history.levels, [-u for u in run.history.column("centre uy [m]")]


def at_load(levels, deflections, load):
    """Deflection at a load by linear interpolation of the path."""
    for (a, u), (b, v) in zip(zip(levels, deflections), zip(levels[1:], deflections[1:])):
        if a <= load <= b:
            return u + (v - u) * (load - a) / (b - a)
    raise ValueError(f"the path ends before {load}")


def verify_roof(culm, report):
    for name, thickness, path, highest in (("SS-8a, 12.7 thick", 12.7, ROOF_THICK, 0.8),
                                           ("SS-8d, 6.35 thick", 6.35, ROOF_THIN, 0.25)):
        report.title(f"{name}: hinged roof up to its limit point, load over 3000; Sze et al.")
        levels, deflections = roof(culm, thickness, 16, highest)
        report.relative("limit load", max(levels), path[-1][0], 0.02)
        for load, deflection in path:
            if load < 0.95 * path[-1][0] and thickness > 10.0:
                found = at_load(levels, deflections, load)
                report.relative(f"deflection at {load}", found, deflection, 0.02)


def verify_uniaxial(culm, report):
    report.title("SS-11: St. Venant-Kirchhoff patch in uniaxial stress, exact")
    for stretch in (0.6, 0.8, 0.9, 1.1, 1.25, 1.5, 2.0):
        strain = stretch**2 - 1.0
        history = culm.history("shell/uniaxial_stress.xml", [f"P={0.5 * stretch * strain!r}"])
        lateral = math.sqrt(1.0 - 0.3 * strain)
        exact = [stretch - 1.0, lateral - 1.0, 0.0]
        report.check(f"stretch {stretch}, corner", history.vector("corner"), exact, 1e-9)
        exact = [0.7 * (stretch - 1.0), 0.75 * (lateral - 1.0), 0.0]
        report.check(f"stretch {stretch}, inside", history.vector("inside"), exact, 1e-9)


def verify(culm, report):
    verify_linear(culm, report)
    verify_locking(culm, report)
    verify_shear(culm, report)
    verify_roof(culm, report)
    verify_uniaxial(culm, report)


def plot(culm, path):
    fig, (linear, paths) = figure(2, 4.2)
    meshes = [8, 16, 32]
    for case in CASES:
        line = linear.plot(meshes, [case.ratio(culm, n) for n in meshes], label=case.name)[0]
        if case.good < 1.0:
            linear.plot([16], [case.good], "o", color=line.get_color(), markersize=4)
    linear.set_xscale("log")
    mesh_axis(linear, meshes)
    linear.set(title="linear cases; dots MITC4+", xlabel="elements per side",
               ylabel="displacement / reference", ylim=(0.88, 1.02))
    linear.legend(fontsize=6, loc="lower right")
    for thickness, points, highest, color in ((12.7, ROOF_THICK, 0.8, "C0"),
                                              (6.35, ROOF_THIN, 0.25, "C1")):
        levels, deflections = roof(culm, thickness, 16, highest)
        paths.plot(deflections, levels, color, label=f"t = {thickness}")
        paths.plot([u for _, u in points], [p for p, _ in points], color + "o", markersize=3)
    paths.set(title="hinged roof; dots Sze et al.", xlabel="deflection of the centre [mm]",
              ylabel="load / 3000")
    paths.legend()
    save(fig, path)


main(verify, plot, verify_fine)
