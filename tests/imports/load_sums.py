#!/usr/bin/env python3
"""Sums of all loads of files, forces and moments about the origin of each static step, by readers of their own: beside those
that the importers read. For the samples here and the files with which CalculiX is tested, as far as they have loads and become
decks.

usage: load_sums.py [--files FOLDER] [FORMAT FILE]…     (FORMAT FILE: those alone)
"""

import argparse
import pathlib
import sys
import tempfile

import ansys_samples
import load_readers
import nastran_samples
import numpy
import samples
from calculix_tests import FILES, text_of
from reading import Made
from culm.errors import CulmError

EXACT = 1e-9
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


def own_files(folder, tests):
    texts = {f"{name}.inp": ("calculix", make()) for name, make in samples.SAMPLES.items()}
    texts["parts.inp"] = "abaqus", samples.parts()
    texts["plane.inp"] = "abaqus", samples.plane()
    texts["panel.bdf"] = "nastran", nastran_samples.panel()
    texts["model.cdb"] = "ansys", ansys_samples.model()
    texts["blocks.cdb"] = "ansys", ansys_samples.model_in_blocks()
    texts |= {f"{name}.inp": ("calculix", text_of(tests, f"{name}.inp")) for name in TESTS}
    for name, (format, text) in texts.items():
        (folder / name).write_text(text)
        yield format, folder / name


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--files", type=pathlib.Path, default=pathlib.Path(FILES))
    parser.add_argument("others", nargs="*")
    arguments = parser.parse_args()
    complaints = []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        pairs = zip(arguments.others[::2], map(pathlib.Path, arguments.others[1::2]))
        for format, path in list(pairs) or own_files(folder, arguments.files):
            is_read(format, path, complaints)
    sys.exit("\n".join(complaints) or 0)


if __name__ == "__main__":
    main()
