#!/usr/bin/env python3
"""Sums of all loads of files, forces and moments about the origin of each static step, by readers of their own: beside those
that the importers read, and beside what the supports of the imported model carry. For the samples here and the files with
which CalculiX is tested, as far as they have loads and become decks.

usage: load_sums.py [--culm PROGRAM] [--files FOLDER] [FORMAT FILE]…     (FORMAT FILE: those alone; without PROGRAM no supports)
"""

import argparse
import pathlib
import sys
import tempfile
import xml.etree.ElementTree

import ansys_samples
import load_readers
import nastran_samples
import numpy
import samples
from calculix_tests import FILES, text_of
from reading import Made
from culm import read
from culm.errors import CulmError
from culm.program import Program

EXACT = 1e-9
SUPPORTS = ("Support", "Rotation", "Symmetry")
# Of the sum of forces, or of what their largest one would give about the farthest point. Loads that follow and arms move
# with the structure.
ALLOWED = 1e-4
OTHERS = {"panel.bdf": 2e-3, "model.cdb": 2e-3, "simplebeampipe1.inp": 0.1, "simplebeampipe2.inp": 0.1}
TESTS = ("b31", "beamcom", "beamlin", "beamtor", "boxprofile", "section", "section4", "shell2", "shell3", "shellbeam", "shellnor",
         "simplebeam", "simplebeampipe1", "simplebeampipe2")  # fmt: skip


def sums_read(made):
    """Of what an importer has read."""
    model, found = made.made, []
    for number, step in enumerate(model.steps):
        if step.kind != "static":
            continue
        total = load_readers.Sum()
        for load in model.node_loads:
            for node in load.nodes if number in load.steps else []:
                total.add(model.nodes[node], load.vector[:3], load.vector[3:])
        for load in model.element_loads:
            if number in load.steps:
                act(model, load, total)
        found.append(total.vector)
    return found


def act(model, load, total):
    def corners(element):
        return numpy.array([model.nodes[node] for node in element.nodes])

    def line(element):
        """The node between comes last in the model, second here."""
        places = corners(element)
        return places[[0, 2, 1]] if len(places) == 3 else places

    if load.kind == "gravity":
        for shell in model.shells:
            layers = model.walls[shell.wall].layers
            mass = sum(layer.thickness * model.materials[layer.material].values.get("Density", 0.0) for layer in layers)
            total.pull(corners(shell), mass * load.value)
        for beam in model.beams:
            total.pull_line(line(beam), model.sections[beam.section].mass * load.value)
        for mass in model.masses:
            total.add(model.nodes[mass.node] + numpy.array(mass.offset), mass.mass * load.value)
    for i in load.elements:
        if load.kind == "pressure":
            total.press(corners(model.shells[i]), load.value)
        elif load.kind == "surface":
            total.pull(corners(model.shells[i]), numpy.array(load.value))
        else:
            total.pull_line(line(model.beams[i]), numpy.array(load.value))


def is_read(format, path, complaints):
    try:
        expected, found = load_readers.READERS[format](path), sums_read(Made(format, path))
    except (load_readers.NotCounted, CulmError) as error:
        complaints.append(f"{path.name}: {error}")
        return
    worst = max([numpy.abs(a - b).max() / (numpy.abs(a).max() or 1.0) for a, b in zip(expected, found)] or [0.0])
    sums = "; ".join(numpy.array2string(one, precision=6, suppress_small=True) for one in expected)
    print(f"{path.name}: {sums}, read with {worst:.0e}")
    if len(expected) != len(found) or not worst <= EXACT:
        complaints.append(f"{path.name}: of the file {expected}, read {found}")


def names_of(deck, of, words):
    """Entries of a list of the deck whose type has one of the words."""
    entries = xml.etree.ElementTree.parse(deck).getroot().findall(f"ParameterList[@name='{of}']/ParameterList")
    types = [(one.get("name"), one.find("Parameter[@name='Type']").get("value")) for one in entries]
    return [name for name, type in types if any(word in type for word in words)]


def reactions(run, names, analysis):
    """Force and moment about the origin of all supports at the end of an analysis. Supports that hold one node together
    show their sum, each the same."""
    state = [one for one in run.states if one.analysis == analysis][-1]
    rows = []
    for name in names:
        try:
            rows += state.constraint_forces(name).to_numpy().tolist()
        except KeyError:  # inactive
            continue
    rows = numpy.unique(numpy.round(rows, 15), axis=0) if rows else numpy.zeros((0, 9))
    force = rows[:, 3:6].sum(axis=0)
    return numpy.concatenate([force, rows[:, 6:9].sum(axis=0) + numpy.cross(rows[:, :3], rows[:, 3:6]).sum(axis=0)])


def is_carried(program, format, path, folder, complaints):
    expected = load_readers.READERS[format](path)
    deck = folder / f"{path.stem}.xml"
    done = program.call("import", format, path, "--output", deck)
    if done.returncode != 0:
        complaints.append(f"{path.name}: {done.stderr[:300]}")
        return
    names = names_of(deck, "Constraints", SUPPORTS)
    done = program.run(deck, folder / path.stem, settings=["Output/Constraint Forces=true"])
    if not done.succeeded:
        complaints.append(f"{path.name}: {done.errors[:300]}")
        return
    run = read(done.folder)
    static = names_of(deck, "Analyses", ("Static",))
    if len(static) != len(expected):
        complaints.append(f"{path.name}: {len(static)} static analyses, {len(expected)} in the file")
    size = max(numpy.abs(run.states[0].position(name)).max() for name in run.structures())
    for name, loads in zip(static, expected):
        found = reactions(run, names, name)
        scale = max(numpy.linalg.norm(loads[:3]), numpy.linalg.norm(loads[3:]) / size) or 1.0
        worst = max(numpy.linalg.norm(found[:3] + loads[:3]), numpy.linalg.norm(found[3:] + loads[3:]) / size) / scale
        print(f"{path.name}, {name}: loads {numpy.array2string(loads, precision=5)}, supports {numpy.array2string(found, precision=5)}: {worst:.1e}")
        if not worst <= OTHERS.get(path.name, ALLOWED):
            complaints.append(f"{path.name}: {name}: supports and loads differ by {worst:.2e}")


def own_files(folder, tests):
    texts = {f"{name}.inp": ("calculix", make()) for name, make in samples.SAMPLES.items()}
    texts["parts.inp"] = "abaqus", samples.parts()
    texts["plane.inp"] = "abaqus", samples.plane()
    texts["panel.bdf"] = "nastran", nastran_samples.panel()
    texts["model.cdb"] = "ansys", ansys_samples.model()
    texts |= {f"{name}.inp": ("calculix", text_of(tests, f"{name}.inp")) for name in TESTS}
    for name, (format, text) in texts.items():
        (folder / name).write_text(text)
        yield format, folder / name


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm")
    parser.add_argument("--files", type=pathlib.Path, default=pathlib.Path(FILES))
    parser.add_argument("others", nargs="*")
    arguments = parser.parse_args()
    complaints = []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        pairs = zip(arguments.others[::2], map(pathlib.Path, arguments.others[1::2]))
        for format, path in list(pairs) or own_files(folder, arguments.files):
            is_read(format, path, complaints)
            if arguments.culm:
                is_carried(Program(arguments.culm), format, path, folder, complaints)
    sys.exit("\n".join(complaints) or 0)


if __name__ == "__main__":
    main()
