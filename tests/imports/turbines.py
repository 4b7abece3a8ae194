#!/usr/bin/env python3
"""Sections at stations, of windIO, HAWC2 and tables, beside what they are by definition.

usage: turbines.py --culm PROGRAM
"""

import argparse
import csv
import pathlib
import re
import sys
import tempfile

import numpy
import turbine_samples as samples
import yaml
from reading import made_of_text
from culm.errors import CulmError
from culm.importing import windio
from culm.program import Program


def values(text):
    return numpy.array([float(x) for x in text.strip("{}").split(",")])


def entries(made, name):
    (found,) = [one for one in made.root.lists() if one.name == name]
    return {one.name: {item[0]: item[1] for item in one.items if isinstance(item, tuple)} for one in found.lists()}


def symmetric(text):
    matrix = numpy.zeros((6, 6))
    matrix[samples.UPPER] = values(text)
    return matrix + numpy.triu(matrix, 1).T


def curve_of(made, name):
    (structures,) = [one for one in made.root.lists() if one.name == "Structures"]
    (beam,) = [one for one in structures.lists() if one.name == name]
    (curve,) = beam.lists()
    return {item[0]: item[1] for item in curve.items}


def windio_is_whole(complaints):
    made = made_of_text("windio", samples.windio(), "turbine.yaml")
    sections = list(entries(made, "Sections").values())
    for section, stiffness, m in zip(sections, samples.STIFF, samples.MASSES):
        if not numpy.allclose(symmetric(section["Stiffness"]), stiffness, rtol=1e-9):
            complaints.append("a stiffness of windIO is not that of the file")
        if not numpy.allclose(symmetric(section["Mass"]), samples.mass_matrix(m), rtol=1e-9):
            complaints.append("a mass of windIO is not that of the file")
    axis = numpy.array([[0, 0, 0], [0.1, 0, 12], [-1, 0, 40]], float)
    pieces = numpy.linalg.norm(numpy.diff(axis, axis=0), axis=1)
    mass = (pieces * (numpy.array(samples.MASSES[1:]) + samples.MASSES[:-1]) / 2).sum()
    if abs(made.mass / mass - 1.0) > 1e-9:
        complaints.append(f"the blade weighs {made.mass}, not {mass}")
    if not numpy.allclose(values(curve_of(made, "blade")["Pre-Twist"]), [-0.25, -0.1, 0.02]):
        complaints.append("the twist turns about -z")


def windio_tells_its_masses(complaints):
    """Those at one place that are not read."""
    root = yaml.safe_load(samples.windio())
    root["components"]["blade"]["joint"] = {"position": 0.5, "mass": 3000.0}
    told = made_of_text("windio", yaml.safe_dump(root, sort_keys=False), "turbine.yaml").findings.left_out
    if "joint of the blade: 3000.0 kg" not in told:
        complaints.append(f"the mass of a joint is not told: {list(told)}")
    root = yaml.safe_load(samples.windio_2())
    root["components"]["blade"]["structure"]["elastic_properties"]["point_mass"] = {"grid": [0.5], "mass": [1000.0]}
    told = made_of_text("windio", yaml.safe_dump(root, sort_keys=False), "turbine.yaml").findings.left_out
    if "point_mass of the blade's elastic properties" not in told:
        complaints.append(f"masses of elastic properties are not told: {list(told)}")


def both_forms_of_windio_are_alike(complaints):
    first, second = (made_of_text("windio", text, "turbine.yaml") for text in (samples.windio(), samples.windio_2()))
    for one, other in zip(entries(first, "Sections").values(), entries(second, "Sections").values()):
        if not all(numpy.allclose(values(one[name]), values(other[name]), rtol=1e-12) for name in ("Stiffness", "Mass")):
            complaints.append("sections of windIO 2 are not those of the first form")
    twists = [values(curve_of(made, "blade")["Pre-Twist"]) for made in (first, second)]
    if not numpy.allclose(*twists) or abs(second.mass / first.mass - 1.0) > 1e-12:
        complaints.append(f"the blade of windIO 2 is another one: {twists}, {second.mass} kg")


def hawc2_finds_its_files(complaints):
    """From the folder that HAWC2 is started in, which is above that of the htc file."""
    files = samples.hawc2()
    htc = files["blade.htc"].replace("./blade.st", "./data/blade.st").replace("type timo", "concentrated_mass 1 0 0 0 50 1 1 1 ;\n    type timo")
    made = made_of_text("hawc2", {"model/htc/blade.htc": htc, "model/data/blade.st": files["blade.st"]})
    if made.mass != made_of_text("hawc2", files).mass or "concentrated_mass of the body" not in made.findings.left_out:
        complaints.append("a body of HAWC2 with files beside the folder of its htc file is another one, or its mass is lost in silence")


def hawc2_keeps_its_order(complaints):
    """Places of the axis are numbered; blocks that are not read are told, and a set that is not named."""
    files = samples.hawc2()
    other = files["blade.htc"].replace("set 1 1 ;", "").replace("begin c2_def", "begin other;\n end other;\n begin c2_def")
    made = made_of_text("hawc2", {**files, "blade.htc": other})
    if "the block other of the body" not in made.findings.left_out or not any("names no set" in x for x in made.findings.assumed):
        complaints.append(f"a block of HAWC2, or a set that is not named, is not told: {made.messages()}")
    swapped = files["blade.htc"].replace("sec 2", "sec 4")
    try:
        made_of_text("hawc2", {**files, "blade.htc": swapped})
        complaints.append("places of c2_def out of order are not refused")
    except CulmError as error:
        if "numbered in their order" not in str(error):
            complaints.append(f"places of c2_def out of order: {error}")


def tower_weighs(program, complaints):
    """culm's mass of the imported tower, by its own integration of the deck."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "turbine.yaml").write_text(samples.windio())
        done = program.call(
            "import", "windio", folder / "turbine.yaml", "--component", "tower", "--output", folder / "tower.xml"
        )
    if done.returncode != 0:
        sys.exit(done.stderr)
    # a tube whose radius and wall are linear between its two stations, linear in the area as the deck has it
    area = lambda d, t: numpy.pi * t * (d - t)  # noqa: E731
    expected = 7800 * 1.1 * (25 * (area(6, 0.05) + area(6, 0.03)) / 2 + 55 * (area(6, 0.05) + area(4, 0.03)) / 2) + 5000
    total = float(re.search(r"total +\d+ +\d+ +(\S+)", done.stdout)[1])
    if abs(total / expected - 1.0) > 1e-4:
        complaints.append(f"the tower weighs {total}, not {expected}")


def windio_keeps_steps(complaints):
    """Walls and masses that jump at a place, where a table names it twice."""
    root = yaml.safe_load(samples.windio())
    tower = root["components"]["tower"]
    tower["internal_structure_2d_fem"]["layers"][0]["thickness"] = {"grid": [0.0, 0.5, 0.5, 1.0], "values": [0.1, 0.1, 0.02, 0.02]}
    tower["outer_shape_bem"]["outer_diameter"]["values"] = [6.0, 6.0]
    six = root["components"]["blade"]["elastic_properties_mb"]["six_x_six"]
    first, *_, last = six["inertia_matrix"]["values"]
    six["inertia_matrix"] = {"grid": [0.0, 0.25, 0.25, 1.0], "values": [first, first, last, last]}
    text = yaml.safe_dump(root, sort_keys=False)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "turbine.yaml"
        path.write_text(text)
        made = windio.read(path, argparse.Namespace(component="tower"))
    walls = [float(entry["Wall Thickness"]) for name, entry in entries(made, "Sections").items() if name.startswith("tower")]
    if walls != [0.1, 0.1, 0.02, 0.02]:
        complaints.append(f"walls of windIO that step are {walls}")
    made = made_of_text("windio", text, "turbine.yaml")
    axis = numpy.stack([six["reference_axis"][k]["values"] for k in "xyz"], axis=1)
    lengths = numpy.concatenate([[0.0], numpy.cumsum(numpy.linalg.norm(numpy.diff(axis, axis=0), axis=1))])
    jump = numpy.interp(0.25, samples.GRID, lengths)
    expected = jump * first[0] + (lengths[-1] - jump) * last[0]
    if abs(made.mass / expected - 1.0) > 1e-9:
        complaints.append(f"a blade of windIO whose mass steps weighs {made.mass}, not {expected}")


def hawc2_has_its_centres(complaints):
    """Forces through the elastic centre do not bend, forces through the shear centre do not twist, a moment about
    a principal axis curves about it alone; radii of gyration are those of masses about the elastic centre."""
    made = made_of_text("hawc2", samples.hawc2())
    section = list(entries(made, "Sections").values())[0]
    flexibility = numpy.linalg.inv(symmetric(section["Stiffness"]))
    r, m, xg, yg, rx, ry, xs, ys, E, G, Ix, Iy, Ip, kx, ky, A, pitch, xe, ye = samples.CLASSIC
    stretch = flexibility @ [0, 0, 1, ye, -xe, 0]
    if not numpy.allclose(stretch[3:5], 0.0, atol=1e-22) or not numpy.isclose(stretch @ [0, 0, 1, ye, -xe, 0], 1 / (E * A)):
        complaints.append("a force through the elastic centre bends the section of HAWC2")
    for force in ([1, 0, 0, 0, 0, -ys], [0, 1, 0, 0, 0, xs]):
        if abs((flexibility @ force)[5]) > 1e-20:
            complaints.append("a force through the shear centre twists the section of HAWC2")
    c, s = numpy.cos(numpy.radians(pitch)), numpy.sin(numpy.radians(pitch))
    for axis, I in (((c, s), Ix), ((-s, c), Iy)):
        curvature = (flexibility @ [0, 0, 0, *axis, 0])[3:5]
        if not numpy.allclose(curvature, numpy.array(axis) / (E * I), rtol=1e-9):
            complaints.append("a moment about a principal axis of HAWC2 curves about another one")
    # masses at the elastic centre's principal axes with these radii, and the rest that moves the centre
    second = {name: float(section[name]) for name in ("rhoI1", "rhoI2", "rhoI12", "rhoS1", "rhoS2", "rhoA")}
    about = numpy.array([[second["rhoI2"], second["rhoI12"]], [second["rhoI12"], second["rhoI1"]]])
    first = numpy.array([second["rhoS2"], second["rhoS1"]])
    e = numpy.array([xe, ye])
    at_elastic = about - numpy.outer(e, first) - numpy.outer(first, e) + m * numpy.outer(e, e)
    axes = numpy.array([[c, s], [-s, c]])
    if not numpy.allclose(axes @ at_elastic @ axes.T, numpy.diag([m * ry**2, m * rx**2]), atol=1e-9):
        complaints.append("the radii of gyration are not those of the file")
    if not numpy.allclose(first, [m * xg, m * yg]):
        complaints.append("the centre of mass is not that of the file")


def bar_vibrates(program, complaints):
    """The first frequencies of a slender cantilever, by Euler and Bernoulli; its shear takes less than 0.5 %."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "bar.csv").write_text(samples.table())
        done = program.call("import", "csv", folder / "bar.csv", "--output", folder / "bar.xml")
        if done.returncode != 0:
            sys.exit(done.stderr)
        run = program.run(folder / "bar.xml", folder / "out")
        if not run.succeeded:
            sys.exit(run.errors)
        with open(run.folder / "analyses/modes/modes.csv") as file:
            found = [float(line[1]) for line in list(csv.reader(file))[1:3]]
    factor = 1.8751040687**2 / (2 * numpy.pi * samples.LENGTH**2)
    expected = [factor * numpy.sqrt(samples.BAR[name] / samples.BAR["rhoA"]) for name in ("EI1", "EI2")]
    print(f"bar: culm {numpy.round(found, 4)}, theory {numpy.round(expected, 4)} Hz")
    if not numpy.allclose(found, expected, rtol=5e-3):
        complaints.append(f"the bar vibrates with {found}, by theory {expected}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    program = Program(parser.parse_args().culm)
    complaints = []
    windio_is_whole(complaints)
    windio_keeps_steps(complaints)
    both_forms_of_windio_are_alike(complaints)
    windio_tells_its_masses(complaints)
    hawc2_finds_its_files(complaints)
    hawc2_keeps_its_order(complaints)
    tower_weighs(program, complaints)
    hawc2_has_its_centres(complaints)
    bar_vibrates(program, complaints)
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
