#!/usr/bin/python3
"""Shells under compression: no buckling of elements by themselves. Page: doc/verification/hourglass.md."""

import math
import pathlib
import re
import tempfile

from verify import main

import culm_runs

PLATE = "buckling/plate.xml"
STRIP = "shell/cantilever_shear.xml"
MESH = "Structures/plate/Mesh"
# Fibres along x, forty times as stiff as across them
UNIDIRECTIONAL = {"E1": 40, "E2": 1, "E3": 1, "nu12": 0, "nu13": 0, "nu23": 0, "G12": 0.6, "G13": 0.6, "G23": 0.5}


def lowest(culm, settings):
    table = culm.table("buckling/buckling", PLATE, settings)
    return min(factor for factor in table.column("factor") if factor > 0.0)


def rectangle(length, width, along, across):
    return [f"{MESH}/Side 1={{{length}, 0, 0}}", f"{MESH}/Side 2={{0, {width}, 0}}",
            f"{MESH}/Elements={{{along}, {across}}}"]


def sheet_strain(culm, constants, along, across):
    """Critical strain of a sheet of 2 x 1 that is pressed along x, held at one end and kept in its plane."""
    everything = ["rim", "sides x", "sides y"]
    stiffness = constants["E1"]
    return lowest(culm, [
        *rectangle(2, 1, along, across), "h=0.2", f"Loads/pressure/Force={{-{stiffness}*h, 0, 0}}",
        *(f"Node Sets/{name}/Nodes={{plate}}" for name in everything),
        "Structures/plate/Material=ply", "Structures/plate/Reference Axis={1, 0, 0}",
        "Structures/plate/Shear Correction=None", "Materials/ply/Type=Orthotropic",
        *(f"Materials/ply/{name}={value}" for name, value in constants.items())])


def verify_sheets(culm, report):
    isotropic = {**{name: 1 for name in ("E1", "E2", "E3")}, **{name: 0 for name in ("nu12", "nu13", "nu23")},
                 **{name: 0.5 for name in ("G12", "G13", "G23")}}
    # between the value on 40 x 20 elements and what beam theory without shear allows
    for name, constants, fine, coarse in (("isotropic", isotropic, 0.0438, 0.047),
                                          ("unidirectional", UNIDIRECTIONAL, 0.01006, 0.0117)):
        report.title(f"Sheet of 2 x 1 pressed in its plane, {name}: critical strain, {fine} on 40 x 20 elements")
        for along, across in ((10, 1), (20, 1), (50, 1), (50, 4)):
            found = sheet_strain(culm, constants, along, across)
            report.check(f"{along} x {across}", found, 0.5 * (fine + coarse), 0.5 * (coarse - fine) + 1e-4)


def plate_coefficient(culm, along, across):
    """N b^2 / (pi^2 D) of a square plate on four supports; 3.998."""
    return lowest(culm, rectangle(1, 1, along, across))


def flange_coefficient(culm, along, across):
    """The same of a plate five times as long as wide, one long side free; 0.425 + (1/5)^2."""
    return lowest(culm, [*rectangle(5, 1, along, across), "Node Sets/rim/Nodes={plate/u0, plate/u1, plate/v0}",
                         "Node Sets/sides y/Nodes={plate/v0}"])


def verify_twist(culm, report):
    report.title("Elements that twist keep their geometric stiffness: plate on four supports, flange")
    for n, tolerance in ((4, 0.1), (8, 0.025), (16, 0.01)):
        report.relative(f"plate, {n} x {n}", plate_coefficient(culm, n, n), 3.998, tolerance)
    for along, across, tolerance in ((5, 1, 0.01), (10, 2, 0.01), (20, 4, 0.01)):
        report.relative(f"flange, {along} x {across}", flange_coefficient(culm, along, across), 0.465, tolerance)
    report.title("Elements short along the compression feel part of it: they converge from above")
    for along, across, tolerance in ((16, 4, 0.14), (32, 8, 0.035)):
        report.relative(f"plate, {along} x {across}", plate_coefficient(culm, along, across), 3.998, tolerance)
    for along, across, tolerance in ((20, 1, 0.3), (20, 2, 0.05), (40, 4, 0.012)):
        report.relative(f"flange, {along} x {across}", flange_coefficient(culm, along, across), 0.465, tolerance)


def skewed_strip(degrees, along, across):
    """Gmsh file of a strip of 10 x 1 whose lines across lean by an angle in its middle and stand upright at its ends."""
    lean = math.tan(math.radians(degrees))
    number = lambda i, j: i * (across + 1) + j + 1
    nodes, last = [], along
    for i in range(along + 1):
        s = i / along
        for j in range(across + 1):
            y = j / across
            # ends upright, the lean reached within the outer quarters
            share = min(1.0, 4.0 * s, 4.0 * (1.0 - s))
            nodes.append(f"{number(i, j)} {10.0 * s + share * lean * (y - 0.5):.12g} {y:.12g} 0")
    cells = [f"15 2 4 4 {number(last, 0)}"]
    for i, group in ((0, 1), (last, 2)):
        cells += [f"1 2 {group} {group} {number(i, j)} {number(i, j + 1)}" for j in range(across)]
    cells += [f"3 2 3 3 {number(i, j)} {number(i + 1, j)} {number(i + 1, j + 1)} {number(i, j + 1)}"
              for i in range(along) for j in range(across)]
    return "\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "4", '1 1 "u0"', '1 2 "u1"',
                      '2 3 "strip"', '0 4 "corner"', "$EndPhysicalNames", "$Nodes", str(len(nodes)), *nodes, "$EndNodes", "$Elements",
                      str(len(cells)), *(f"{k + 1} {cell}" for k, cell in enumerate(cells)), "$EndElements", ""])


def skewed_tip(culm, degrees, membrane, along=32, across=4):
    """Displacements of a corner at the end of the strip of SS-1 on a skewed mesh: -U and W."""
    with tempfile.TemporaryDirectory() as folder:
        mesh = pathlib.Path(folder) / "strip.msh"
        mesh.write_text(skewed_strip(degrees, along, across))
        text = (culm_runs.INPUTS / STRIP).read_text()
        text = re.sub(r'<ParameterList name="Mesh">.*?</ParameterList>',
                      f'<ParameterList name="Mesh"><Parameter name="Type" value="Gmsh"/>'
                      f'<Parameter name="File Name" value="{mesh}"/></ParameterList>', text, flags=re.DOTALL)
        text = text.replace('"strip/u1 v0"', '"strip/corner"').replace("{0, 0, 2}", "{0, 0, 4/" + f"{across + 1}}}")
        deck = pathlib.Path(folder) / "strip.xml"
        deck.write_text(text)
        history = culm.history(deck, [f"Structures/strip/Enhanced Membrane={membrane}"])
    tip = history.vector("tip")
    return [-tip[0], tip[2]]


def verify_skew(culm, report):
    report.title("SS-1 on skewed meshes of 32 x 4 elements, four and seven enhanced membrane strains; Sze et al.")
    for degrees in (0, 30, 65):
        for membrane in (4, 7):
            report.relative(f"{degrees} degrees, {membrane}: -U, W", skewed_tip(culm, degrees, membrane), [3.286, 6.698],
                            5e-3)


def verify(culm, report):
    verify_sheets(culm, report)
    verify_twist(culm, report)
    verify_skew(culm, report)


main(verify)
