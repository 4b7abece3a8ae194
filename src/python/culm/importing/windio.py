"""Turbines in the windIO ontology: the blade by its 6x6 matrices, tower and monopile by their walls.

The matrices, the reference axis and the twist are those of BeamDyn's conventions.
"""

import numpy
import yaml

from .findings import Findings, Place, did_you_mean, refuse
from .keyword_file import read_text
from .line_deck import LineDeck, stations_in_order
from .ready_deck import ReadyDeck

FILE = "ontology, .yaml"
DEEPEST = 100
SYMMETRY = 21  # values of an upper triangle
# of elastic properties, in the first form and the second
READ = (("reference_axis", "twist", "stiff_matrix", "inertia_matrix"), ("stiffness_matrix", "inertia_matrix"))


def declare(parser):
    parser.add_argument(
        "--component", choices=("blade", "tower"), default="blade", help="blade, or tower with what is below; blade if not given"
    )


def read(path, arguments):
    """@return the ReadyDeck of a blade or a tower"""
    root = _load(path)
    findings = Findings()
    findings.look_at_end(path)
    component = getattr(arguments, "component", "blade")
    parts = _mapping(root, "components", path)
    findings.read["turbine"] = str(root.get("name", path.stem))
    if component == "blade":
        return _blade(root, parts, path, findings)
    return _tower(root, parts, path, findings)


class _Loader(yaml.SafeLoader):
    """Aliases would make copies without end; depth is that of any real file."""


def _load(path):
    text = read_text(path)
    try:
        root = yaml.load(text, Loader=_Loader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = mark.line + 1 if mark is not None else 1
        refuse(Place(str(path), line), f"is no YAML: {getattr(error, 'problem', None) or error}")
    except (RecursionError, ValueError) as error:
        refuse(Place(str(path), 1), f"is no YAML: {error}")
    if not isinstance(root, dict):
        refuse(Place(str(path), 1), "expected names with values, as a turbine has them")
    return root


def _at(path, *names):
    return Place(str(path), 1), " / ".join(map(str, names))


def _mapping(parent, name, path, *before):
    if name not in parent:
        place, where = _at(path, *before)
        refuse(place, f"{where or 'the file'} has no '{name}'{did_you_mean(name, parent)}")
    if not isinstance(parent[name], dict):
        refuse(_at(path)[0], f"{' / '.join([*map(str, before), name])} must hold names with values")
    return parent[name]


def _table(parent, name, path, *before):
    """grid and values, of equal length."""
    table = _mapping(parent, name, path, *before)
    where = " / ".join([*map(str, before), name])
    place = Place(str(path), 1)
    found = []
    for key in ("grid", "values"):
        if not isinstance(table.get(key), list):
            refuse(place, f"{where} has no list '{key}'")
        try:
            array = numpy.array(table[key], dtype=float)
        except (TypeError, ValueError, OverflowError):
            refuse(place, f"{where} / {key} holds something that is no number, or rows of different length")
        if not numpy.isfinite(array).all():
            refuse(place, f"{where} / {key} holds a number that is not finite")
        found.append(array)
    grid, values = found
    if grid.ndim != 1 or len(grid) != len(values):
        refuse(place, f"{where}: {len(grid)} places and {len(values)} values")
    stations_in_order(grid, lambda text: refuse(place, f"{where} / grid: {text}"))
    if grid[0] < -1e-9 or grid[-1] > 1.0 + 1e-9:
        refuse(place, f"{where} / grid must lie between 0 and 1")
    return grid, values


def _axis(parent, path, *before):
    """Points of the reference axis, and where they lie on it."""
    axis = _mapping(parent, "reference_axis", path, *before)
    tables = [_table(axis, name, path, *before, "reference_axis") for name in "xyz"]
    grid = numpy.unique(numpy.concatenate([table[0] for table in tables]))
    return grid, numpy.stack([numpy.interp(grid, *table) for table in tables], axis=1)


def _beside(places, grid, values):
    """Values of a table below and above places: they differ where it has two of one place, a step."""
    both = []
    for side, rest in (("left", 0), ("right", -1)):
        found = numpy.stack([numpy.interp(places, grid, column) for column in values.reshape(len(grid), -1).T], axis=1)
        at = numpy.searchsorted(grid, places, side) + rest
        is_met = (at >= 0) & (at < len(grid)) & (grid[numpy.clip(at, 0, len(grid) - 1)] == places)
        found[is_met] = values.reshape(len(grid), -1)[at[is_met]]
        both.append(found)
    return both


def _stepped(*tables):
    """Places of several tables together, twice where one of them steps, and the values of each there."""
    places = numpy.unique(numpy.concatenate([grid for grid, _ in tables]))
    below, above = (numpy.hstack(side) for side in zip(*(_beside(places, *table) for table in tables)))
    steps = (below != above).any(axis=1)
    order = numpy.argsort(numpy.concatenate([numpy.arange(len(places)), numpy.flatnonzero(steps)]), kind="stable")
    rows = numpy.concatenate([below, above[steps]])[order]
    widths = numpy.cumsum([values.reshape(len(values), -1).shape[1] for _, values in tables])[:-1]
    return numpy.concatenate([places, places[steps]])[order], numpy.split(rows, widths, axis=1)


def _arc(points):
    """Share of the length up to each point."""
    lengths = numpy.concatenate([[0.0], numpy.cumsum(numpy.linalg.norm(numpy.diff(points, axis=0), axis=1))])
    return lengths / lengths[-1], lengths[-1]


def _distinct(grid, points, path):
    """Points of the axis without those that lie on their neighbour."""
    keep = [0] + [i for i in range(1, len(points)) if numpy.linalg.norm(points[i] - points[i - 1]) > 1e-9]
    if len(keep) < 2:
        refuse(Place(str(path), 1), "the reference axis has no length")
    return grid[keep], points[keep]


def _tables_1(blade, path):
    """Axis, stiffness, inertia and twist [rad], each as places and values, in the first form of the ontology."""
    where = ("components", "blade", "elastic_properties_mb", "six_x_six")
    six = _mapping(_mapping(blade, where[2], path, *where[:2]), where[3], path, *where[:3])
    return _axis(six, path, *where), *(_table(six, name, path, *where) for name in ("stiff_matrix", "inertia_matrix", "twist"))


def _tables_2(blade, path):
    """The same in the second form: entries of the stiffness one by one, mass by its centre and moments, twist in degrees."""
    where = ("components", "blade", "structure", "elastic_properties")
    elastic = _mapping(_mapping(blade, where[2], path, *where[:2]), where[3], path, *where[:3])
    pairs = [(i, j) for i in range(1, 7) for j in range(i, 7)]
    grid, entries = _columns(elastic, "stiffness_matrix", [f"K{i}{j}" for i, j in pairs], path, *where)
    mass_grid, columns = _columns(elastic, "inertia_matrix", ["mass", "cm_x", "cm_y", "i_edge", "i_flap", "i_plr", "i_cp"], path, *where)
    m, x, y, edge, flap, polar, product = columns.T
    matrix = {(1, 1): m, (2, 2): m, (3, 3): m, (1, 6): -m * y, (2, 6): m * x, (3, 4): m * y, (3, 5): -m * x}
    matrix |= {(4, 4): edge, (5, 5): flap, (6, 6): polar, (4, 5): -product}
    mass = numpy.stack([matrix.get(pair, 0.0 * m) for pair in pairs], axis=1)
    shape = _mapping(blade, "outer_shape", path, *where[:2])
    twist_grid, twist = _table(shape, "twist", path, *where[:2], "outer_shape")
    return _axis(blade, path, *where[:2]), (grid, entries), (mass_grid, mass), (twist_grid, numpy.radians(twist))


def _columns(parent, name, columns, path, *before):
    """A grid and the values of each column on it: (n), (n, columns)."""
    table = _mapping(parent, name, path, *before)
    found = [_table({key: {"grid": table.get("grid"), "values": table.get(key)}}, key, path, *before, name) for key in columns]
    return found[0][0], numpy.stack([values for _, values in found], axis=1)


def _blade(root, parts, path, findings):
    blade = _mapping(parts, "blade", path, "components")
    is_new = "structure" in blade and "elastic_properties_mb" not in blade
    tables = _tables_2(blade, path) if is_new else _tables_1(blade, path)
    (axis_grid, axis), (stiff_grid, stiffness), (mass_grid, mass), (twist_grid, twist) = tables
    grid, points = _distinct(axis_grid, axis, path)
    share, length = _arc(points)
    place = Place(str(path), 1)
    for name, values in (("stiff_matrix", stiffness), ("inertia_matrix", mass)):
        if values.ndim != 2 or values.shape[1] != SYMMETRY:
            refuse(place, f"{name} must have {SYMMETRY} values at each place: the upper triangle of 6x6 by rows")
    if len(stiff_grid) != len(mass_grid) or abs(stiff_grid - mass_grid).max() > 1e-9:
        stiff_grid, (stiffness, mass) = _stepped((stiff_grid, stiffness), (mass_grid, mass))
        findings.assume("stiffness and inertia have places of their own and are interpolated to those of both")
    # places of the grid are fractions of the arc length of the axis in the ontology
    stations = [
        (at, "Stiffness Matrix", {"Stiffness": k, "Mass": m}, m[0])
        for at, k, m in zip(numpy.interp(stiff_grid, grid, share), stiffness, mass)
    ]
    deck = LineDeck(f"{root.get('name', path.stem)}: blade")
    weight = deck.add_beam("blade", points, stations, (numpy.interp(twist_grid, grid, share), -twist), place=place)
    deck.clamp("blade/first", "the root; hub and pitch are not in the deck")
    findings.read["form"] = "windIO 2" if is_new else "windIO 1"
    findings.read["blade"] = f"{len(stations)} stations, {length:.6g} m, {weight:.6g} kg"
    findings.assume("axes and twist are those of BeamDyn: x to the suction side, z to the tip, twist about -z")
    for part in (blade, blade.get("structure"), blade.get("internal_structure_2d_fem")):
        if isinstance(part, dict):
            _tell_masses(part, "blade", ("joint",), findings)
    for key, value in _elastic(blade, is_new).items():
        if key not in READ[is_new] and value:
            findings.leave_out(f"{key} of the blade's elastic properties")
    findings.leave_out("everything of the turbine but the blade")
    return ReadyDeck(deck.finish((0.0, 0.0, -9.81)), findings, deck.mass)


def _elastic(blade, is_new):
    return blade["structure"]["elastic_properties"] if is_new else blade["elastic_properties_mb"]["six_x_six"]


def _tell_masses(part, name, keys, findings):
    """What weighs at one place and is not read."""
    for key in keys:
        value = part.get(key)
        mass = value.get("mass") if isinstance(value, dict) else value
        if mass:
            findings.leave_out(f"{key} of the {name}: {str(mass)[:20]} kg")


def _material(root, name, path):
    for one in root.get("materials") or []:
        if isinstance(one, dict) and one.get("name") == name:
            found = []
            for key in ("E", "G", "rho"):
                value = one.get(key)
                if key == "G" and value is None and isinstance(one.get("nu"), float):
                    value = found[0] / (2.0 * (1.0 + one["nu"]))  # as older files have it
                if not isinstance(value, (int, float)) or isinstance(value, bool) or not 0.0 < value < 1e30:
                    refuse(Place(str(path), 1), f"materials / {name} / {key} must be a number > 0, got {value!r}")
                found.append(float(value))
            return found
    names = [one.get("name") for one in root.get("materials") or [] if isinstance(one, dict)]
    refuse(Place(str(path), 1), f"there is no material '{name}'{did_you_mean(name, names)}")


def _tower(root, parts, path, findings):
    deck = LineDeck(f"{root.get('name', path.stem)}: tower")
    below = "monopile" if "monopile" in parts else None
    for name in [one for one in (below, "tower") if one]:
        _tube(root, parts, name, path, deck, findings)
    if below:
        ends = deck.lines["monopile"][-1], deck.lines["tower"][0]
        gap = numpy.linalg.norm(ends[1] - ends[0])
        if gap > 1e-3:
            findings.assume(f"tower and monopile are joined rigidly over a gap of {gap:.3g} m")
        joint = deck.lists["Constraints"].list("transition", type="Rigid Connection")
        joint.add("Node", "tower/first").add("Master", "monopile/last")
        extra = parts["monopile"].get("transition_piece_mass", 0.0)
        if isinstance(extra, (int, float)) and 0.0 < extra < 1e12:
            deck.lists["Masses"].list("transition piece", type="Point Mass").add("Node", "tower/first").add("Mass", float(extra))
            deck.mass += extra
        elif extra:
            _tell_masses(parts["monopile"], "monopile", ("transition_piece_mass",), findings)
        _tell_masses(parts["monopile"], "monopile", ("gravity_foundation_mass",), findings)
    deck.clamp(f"{below or 'tower'}/first", "the foot: put springs of the soil in its place")
    for name in ("jacket", "floating_platform"):
        if name in parts:
            findings.leave_out(f"the {name} below the tower, with its masses: the tower is clamped at its foot")
            if isinstance(parts[name], dict):
                _tell_masses(parts[name], name, ("transition_piece_mass",), findings)
    findings.leave_out("nacelle and rotor, the soil and the water")
    return ReadyDeck(deck.finish((0.0, 0.0, -9.81)), findings, deck.mass)


def _tube(root, parts, name, path, deck, findings):
    part = _mapping(parts, name, path, "components")
    where = ("components", name)
    is_new = "structure" in part and "internal_structure_2d_fem" not in part
    shape = _mapping(part, "outer_shape" if is_new else "outer_shape_bem", path, *where)
    inside = _mapping(part, "structure" if is_new else "internal_structure_2d_fem", path, *where)
    grid, points = _distinct(*_axis(part if is_new else shape, path, *where), path)
    share, length = _arc(points)
    if numpy.linalg.norm(points[-1] - points[0]) < length * (1.0 - 1e-9):
        refuse(Place(str(path), 1), f"{name}: the reference axis must be straight")
    layers = inside.get("layers")
    if not isinstance(layers, list) or len(layers) != 1 or not isinstance(layers[0], dict):
        refuse(Place(str(path), 1), f"{name}: one layer is read, there are {len(layers) if isinstance(layers, list) else 0}")
    E, G, rho = _material(root, layers[0].get("material"), path)
    factor = inside.get("outfitting_factor", 1.0)
    if not isinstance(factor, (int, float)) or not 0.0 < factor < 100.0:
        refuse(Place(str(path), 1), f"{name} / outfitting_factor must be a number > 0, got {factor!r}")
    if inside.get("elastic_properties"):
        findings.leave_out(f"elastic_properties of the {name}, with their damping: its sections follow from diameter and wall")
    diameters = _table(shape, "outer_diameter", path, *where)
    walls = _table(layers[0], "thickness", path, *where, "layers")
    places, values = _stepped(diameters, walls)
    stations = []
    for at, diameter, wall in zip(places, *(column.ravel() for column in values)):
        radius = diameter / 2
        if not 0.0 < wall < radius:
            refuse(Place(str(path), 1), f"{name}: at {at:g} of its length the wall is {wall:g} m, the radius {radius:g} m")
        solid = {"Young Modulus": E, "Shear Modulus": G, "Density": rho * factor}
        area = numpy.pi * (radius**2 - (radius - wall) ** 2)
        values = {**solid, "Outer Radius": float(radius), "Wall Thickness": float(wall)}
        stations.append((numpy.interp(at, grid, share), "Tube", values, rho * factor * area))
    mass = deck.add_beam(name, points[[0, -1]], stations, elements=20, place=Place(str(path), 1))
    findings.read[name] = f"{len(stations)} stations, {length:.6g} m, {mass:.6g} kg"
