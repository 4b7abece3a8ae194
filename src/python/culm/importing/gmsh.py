"""Meshes of Gmsh: one shell with the physical surfaces, curves and points as its sets."""

import collections

from ..option_types import positive
from .findings import Place, refuse
from .gmsh_file import LINES, POINT, SURFACES, read_mesh
from .model import Layer, Material, Model, ShellElement, Step, Wall

FILE = "mesh, .msh"


def declare(parser):
    parser.add_argument("--thickness", type=positive, default=0.01, help="of the shell [m]; 0.01 if not given")


def read(path, arguments):
    """@return the Model of a mesh; its material is steel, to be changed in the deck"""
    mesh = read_mesh(path)
    model = Model(title=path.stem, nodes=mesh.nodes)
    here = Place(str(path), 1)
    findings = model.findings
    findings.count("nodes", len(mesh.nodes))
    findings.read["format"] = f"MSH {mesh.version}"
    thickness = getattr(arguments, "thickness", 0.01)
    model.materials["steel"] = Material(
        "Isotropic", {"Young Modulus": 2.1e11, "Poisson Ratio": 0.3, "Density": 7850.0}, here
    )
    model.walls["shell"] = Wall([Layer(thickness, "steel")], here)
    findings.assume(f"a mesh has neither material nor wall: it is steel, {thickness:g} m thick")
    findings.leave_out("a mesh has no supports, loads and steps: the deck finds the modes of the free shell")
    _add_elements(model, mesh)
    model.steps.append(Step("modes", "modal", here))
    return model


def _add_elements(model, mesh):
    edges = _edges(mesh)
    loose = 0
    same = {}  # a surface element -> its number: files have one in several groups once for each
    surfaces, curves, points = (collections.defaultdict(list) for _ in range(3))
    for element in mesh.elements:
        if element.type in SURFACES:
            number = same.setdefault(frozenset(element.nodes), len(model.shells))
            if number == len(model.shells):
                model.shells.append(ShellElement(number + 1, element.nodes, "shell", element.place))
            else:
                model.findings.assume("elements of the same nodes, as those in several groups, are one", element.place)
            for _, name in element.groups:
                surfaces[name].append(number)
        elif element.type in LINES:
            if frozenset(element.nodes[:2]) not in edges:
                loose += 1
            for _, name in element.groups:
                curves[name].append(element.nodes)
        elif element.type == POINT:
            for _, name in element.groups:
                points[name].append(element.nodes[0])
        model.findings.count(f"elements of type {element.type}")
    if not model.shells:
        refuse(mesh.elements[0].place, "there are no quadrilaterals or triangles in the mesh")
    if loose:
        model.findings.leave_out(f"{loose} lines that are no edges of the surface")
    model.surface_sets, model.edge_sets, model.point_sets = dict(surfaces), dict(curves), dict(points)
    for dimension, name in mesh.groups:
        if dimension == 3:
            model.findings.leave_out(f"the physical volume '{name}'")
    for kind, sets in (("surfaces", surfaces), ("curves", curves), ("points", points)):
        if sets:
            model.findings.read[f"physical {kind}"] = ", ".join(sets)


def _edges(mesh):
    """Both ends of all edges of the surface."""
    found = set()
    for element in mesh.elements:
        if element.type in SURFACES:
            n = 3 if len(element.nodes) in (3, 6) else 4
            for i in range(n):
                found.add(frozenset((element.nodes[i], element.nodes[(i + 1) % n])))
    return found
