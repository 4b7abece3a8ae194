"""Bodies of HAWC2: the sections of a st file, along z or along the axis that a htc file gives.

d1 is x of the section, d2 is y, d3 along z. Sections of a st file are given about their elastic centre
in principal axes, turned by `pitch` from x; here they are brought to the axis.
"""

import numpy

from .findings import Findings, Place, did_you_mean, refuse
from .hawc2_files import find_file, read_htc, read_stations
from .keyword_file import integer, number
from .line_deck import LineDeck, stations_in_order
from .ready_deck import ReadyDeck

FILE = "st file with sections, or .htc"
UPPER = numpy.triu_indices(6)
FARTHEST = 1e100  # m, and degrees; squares of more would leave the range of numbers
HARMLESS = ("name", "type", "nbodies", "node_distribution", "damping", "damping_posdef", "damping_aniso", "damping_file")


def declare(parser):
    parser.add_argument("--body", help="main body of a htc file")
    parser.add_argument("--set", default="1 1", help="set and subset of a st file; '1 1' if not given")


def read(path, arguments):
    """@return the ReadyDeck of one body, clamped at its foot"""
    findings = Findings()
    findings.look_at_end(path)
    if path.suffix.lower() == ".htc":
        name, stations, points, twist = _body(path, getattr(arguments, "body", None), findings)
    else:
        words = str(getattr(arguments, "set", "1 1")).split()
        numbers = [integer(word, Place("--set", 1)) for word in words]
        if len(numbers) != 2:
            refuse(Place("--set", 1), "expected two numbers, set and subset")
        name, points, twist = "beam", None, None
        stations = read_stations(path, *numbers)
        findings.assume("without a htc file the axis is straight along z and not twisted", stations.place)
    return _deck(path, name, stations, points, twist, findings)


def _deck(path, name, stations, points, twist, findings):
    r = [row["r"] for row in stations.rows]
    stations_in_order(r, lambda text: refuse(stations.place, text))
    if points is None:
        points = numpy.array([(0.0, 0.0, r[0]), (0.0, 0.0, r[-1])])
    lengths = numpy.concatenate([[0.0], numpy.cumsum(numpy.linalg.norm(numpy.diff(points, axis=0), axis=1))])
    # HAWC2 stretches the stations over the length of the axis
    share = (numpy.array(r) - r[0]) / (r[-1] - r[0])
    ratio = (r[-1] - r[0]) / lengths[-1]
    if abs(ratio - 1.0) > 1e-3:
        findings.assume(f"the stations span {r[-1] - r[0]:.6g} m and are stretched over the axis of {lengths[-1]:.6g} m", stations.place)
    table = [(at, "Stiffness Matrix", _section(row), row["m"]) for at, row in zip(share, stations.rows)]
    deck = LineDeck(f"{path.stem}: {name}")
    turns = None if twist is None else (lengths / lengths[-1], numpy.radians(twist))
    mass = deck.add_beam(name, points, table, turns, place=stations.place)
    deck.clamp(f"{name}/first")
    kind = "full matrices" if stations.is_full else "values of Timoshenko's beam"
    findings.read[name] = f"{len(r)} stations, {kind}, {lengths[-1]:.6g} m, {mass:.6g} kg"
    findings.leave_out("damping, and what the body is joined to: it is clamped at its first end")
    # z of the system that HAWC2 has in space points down, and bodies that stand up go against it
    up = 1.0 if points[-1][2] > points[0][2] else -1.0
    if up < 0.0:
        findings.assume("weight acts along z, against which the body goes from its first end")
    return ReadyDeck(deck.finish((0.0, 0.0, -9.81 * up)), findings, deck.mass)


def _section(row):
    """Stiffness and mass about the axis, as the deck names them."""
    for name in ("m", "ri_x", "ri_y"):
        if row[name] < 0.0:
            refuse(row["place"], f"{name} must be >= 0, got {row[name]:g}")
    angle = numpy.radians(row["pitch"])
    if "K" in row:
        local = numpy.zeros((6, 6))
        local[UPPER] = row["K"]
        local = local + numpy.triu(local, 1).T
        T = _strains_at(row["x_e"], row["y_e"], angle)
        stiffness = T.T @ local @ T
    else:
        for name in ("E", "G", "I_x", "I_y", "I_p", "k_x", "k_y", "A"):
            if row[name] <= 0.0:
                refuse(row["place"], f"{name} must be > 0, got {row[name]:g}")
        E, G, A = row["E"], row["G"], row["A"]
        at_elastic = _strains_at(row["x_e"], row["y_e"], angle)
        at_shear = _strains_at(row["x_sh"], row["y_sh"], angle)
        values = (row["k_x"] * G * A, row["k_y"] * G * A, E * A, E * row["I_x"], E * row["I_y"], G * row["I_p"])
        rows = [at_shear[0], at_shear[1], *at_elastic[2:]]
        stiffness = sum(value * numpy.outer(one, one) for value, one in zip(values, rows))
    return {"Stiffness": stiffness[UPPER], **_mass(row, angle)}


def _strains_at(x, y, angle):
    """Strains (shear along the turned axes, stretch, curvatures about them, twist) at a point of the section,
    from those at the axis: stretch is G3 + K1 y - K2 x, shear G1 - K3 y and G2 + K3 x."""
    move = numpy.eye(6)
    move[0, 5], move[1, 5], move[2, 3], move[2, 4] = -y, x, y, -x
    c, s = numpy.cos(angle), numpy.sin(angle)
    turn = numpy.eye(6)
    turn[numpy.ix_([0, 1], [0, 1])] = turn[numpy.ix_([3, 4], [3, 4])] = [[c, s], [-s, c]]
    return turn @ move


def _mass(row, angle):
    """Radii of gyration are about the elastic centre and the turned axes: ri_x that about x."""
    m = row["m"]
    c, s = numpy.cos(angle), numpy.sin(angle)
    axes = numpy.array([[c, s], [-s, c]])
    elastic, centre = numpy.array([row["x_e"], row["y_e"]]), numpy.array([row["x_cg"], row["y_cg"]])
    second = axes.T @ numpy.diag([m * row["ri_y"] ** 2, m * row["ri_x"] ** 2]) @ axes
    arm = centre - elastic
    second = second + m * (numpy.outer(elastic, arm) + numpy.outer(arm, elastic) + numpy.outer(elastic, elastic))
    return {
        "rhoA": m, "rhoI1": second[1, 1], "rhoI2": second[0, 0], "rhoI12": second[0, 1], "rhoS1": m * centre[1],
        "rhoS2": m * centre[0],
    }  # fmt: skip


def _body(path, name, findings):
    """(name, stations, points of the axis, twist in degrees) of a main body."""
    root = read_htc(path)
    bodies = {}
    for structure in root.all("new_htc_structure"):
        for body in structure.all("main_body"):
            line = body.first("name")
            if line is None or len(line[1]) < 2:
                refuse(body.place, "a main body without a name")
            bodies[line[1][1].lower()] = body
    if not bodies:
        refuse(root.place, "the file has no main body in new_htc_structure")
    if name is None:
        name = next((one for one in bodies if one.startswith("blade") and bodies[one].all("c2_def")), next(iter(bodies)))
        findings.assume(f"of the bodies {', '.join(bodies)} the deck has {name}; --body names another one")
    if name.lower() not in bodies:
        refuse(root.place, f"there is no main body '{name}'{did_you_mean(name, bodies)}")
    body = bodies[name.lower()]
    for place, words in body.lines:
        if words[0] not in HARMLESS:
            findings.leave_out(f"{words[0]} of the body", place)
    for block in body.blocks:
        if block.name not in ("timoschenko_input", "c2_def"):
            findings.leave_out(f"the block {block.name} of the body", block.place)
    sections, axis = body.all("timoschenko_input"), body.all("c2_def")
    if len(sections) != 1 or len(axis) != 1:
        refuse(body.place, f"the body {name} needs one timoschenko_input and one c2_def")
    file, chosen = sections[0].first("filename"), sections[0].first("set")
    if file is None or len(file[1]) < 2:
        refuse(sections[0].place, "timoschenko_input names no file")
    numbers = [integer(word, chosen[0]) for word in chosen[1][1:3]] if chosen is not None else [1, 1]
    if len(numbers) != 2:
        refuse(chosen[0], "set needs two numbers")
    if chosen is None:
        findings.assume("a timoschenko_input that names no set has set 1 1", sections[0].place)
    table = []
    for place, words in axis[0].lines:
        if words[0] == "sec":
            if len(words) < 6:
                refuse(place, "expected number, x, y, z and twist")
            if integer(words[1], place) != len(table) + 1:
                expected = f"expected {len(table) + 1}, found {words[1]}"
                refuse(place, f"the places of c2_def must be numbered in their order: {expected}")
            table.append([number(word, place) for word in words[2:6]])
    count = axis[0].first("nsec")
    if count is not None and (len(count[1]) < 2 or integer(count[1][1], count[0]) != len(table)):
        refuse(count[0], f"nsec does not fit: {len(table)} places are there")
    table = numpy.array(table).reshape(-1, 4)
    if (numpy.abs(table) > FARTHEST).any():
        refuse(axis[0].place, f"c2_def has a place or a twist beyond {FARTHEST:g}")
    if len(table) < 2 or (numpy.diff(table[:, :3], axis=0) == 0.0).all(axis=1).any():
        refuse(axis[0].place, "c2_def needs at least two places, each elsewhere than the one before")
    st_path = find_file(path, file[1][1], file[0])
    stations = read_stations(st_path, *numbers)
    findings.look_at_end(st_path)
    return name, stations, table[:, :3], table[:, 3]
