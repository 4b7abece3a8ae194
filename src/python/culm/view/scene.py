"""What the page shows of a run, as plain data."""

import math

import numpy

from . import packing
from .bodies import shape_of
from .recording import NodeField
from .thinning import thinned
from .units import describe

MOST_CELLS = 120_000
MOST_BYTES = 64e6  # of all states
EXACT_BYTES = 16e6  # up to here numbers have 32 bits, beyond 16


def scene_of(run, most_states, up=None, with_fields=True):
    """The scene of a Recording.

    @param most_states  how many states at most
    @param up           axis that points up; from gravity, or left to the page, if None
    @param with_fields  whether colours are wanted
    """
    notes = _notes_on_the_end(run)
    structures = run.structures()
    shown = _select(structures, notes)
    states, is_exact = _choose_states(run, shown, most_states, with_fields, notes)
    pack = packing.floats if is_exact else packing.halves
    times, indices = run.times, run.indices
    return {
        "title": run.title,
        "version": run.version,
        "folder": run.folder.resolve().name,
        "notes": notes,
        "broken": run.broken,
        "level": _level(run.deck),
        "times": [times[state] for state in states] or [0.0],
        "indices": [indices[state] for state in states] or [0],
        "up": _up(run.deck, up),
        "structures": [_structure(run, one, part, states, with_fields, pack) for one, part in shown],
        "links": [{"type": type, "name": name, "ends": packing.floats(ends)} for type, name, ends in run.links()],
        "analyses": [_shapes(one, shown, indices, states) for one in run.shapes()],
    }


def _notes_on_the_end(run):
    ending = run.ending
    if not ending:
        notes = [f"The run has not come to its end; {len(run.times)} states are recorded."]
    elif not ending.startswith("done"):
        notes = [f"The run ended early: {ending}"]
    else:
        notes = []
    if not run.times:
        notes.append("No state is recorded; what is shown is the reference.")
    return notes


def _select(structures, notes):
    """Structures with the nodes and cells to show."""
    total = sum(len(one.ends) for one in structures)
    share = min(1.0, MOST_CELLS / max(total, 1))
    shown = [(one, thinned(one, max(1, math.ceil(share * len(one.ends))))) for one in structures]
    left = sum(len(part.cells) for _, part in shown)
    if left < total:
        notes.append(f"Of {total} elements {left} are shown, chosen evenly; they join nodes of the model.")
    return shown


def _bytes_per_state(shown, with_fields):
    count = 0
    for one, part in shown:
        count += len(part.nodes) * (3 + 3 * len(one.directors))
        for field in one.fields if with_fields else ():
            rows = part.nodes if isinstance(field, NodeField) else part.cells
            count += len(rows) * len(field.columns)
    return 4.0 * max(count, 1)


def _choose_states(run, shown, most, with_fields, notes):
    """Numbers of states, evenly chosen, and whether their numbers need not be rounded."""
    count = len(run.times)
    size = _bytes_per_state(shown, with_fields)
    is_exact = size * min(count, most) <= EXACT_BYTES
    fit = max(1, int(MOST_BYTES / (size if is_exact else size / 2)))
    left = min(count, most, fit)
    if left < count:
        notes.append(f"Of {count} states {left} are shown.")
    if not is_exact:
        notes.append("Numbers are rounded to 1/65535 of the range that they have in the run.")
    return sorted({round(i) for i in numpy.linspace(0, count - 1, left)}) if count else [], is_exact


def _level(deck):
    """What the time of a state is."""
    types = {value for path, value in deck.parameters.items() if _is_type_of_analysis(path)}
    if types <= {"Static", "Path", "Buckling", "Modal", "Campbell", "Flutter"}:
        return {"name": "level", "unit": "", "moves": False}
    if types <= {"Dynamic", "Modal", "Campbell", "Flutter"}:
        return {"name": "time", "unit": "s", "moves": True}
    return {"name": "time or level", "unit": "", "moves": False}


def _is_type_of_analysis(path):
    words = path.split("/")
    return words[0] == "Analyses" and words[-1] == "Type" and len(words) == 3


def _up(deck, axis):
    """The axis asked for, or against gravity; None where nothing says so."""
    if axis is not None:
        return [float(name == axis) for name in "xyz"]
    for path, value in deck.parameters.items():
        if path.startswith("Loads/") and path.endswith("/Type") and value == "Gravity":
            text = deck.parameters[path.removesuffix("Type") + "Acceleration"]
            down = numpy.array([float(word) for word in text.strip("{} ").split(",")])
            if down.any():
                return (-down / numpy.linalg.norm(down)).tolist()
    return None


def _structure(run, one, part, states, with_fields, pack):
    def over_states(name, fallback, rows):
        if not states:
            return fallback[rows][None]
        return numpy.array([run.values(state, one, name)[rows] for state in states])

    is_thinned = len(part.cells) < len(one.ends)
    displacement = over_states("displacement", numpy.zeros_like(one.position), part.nodes)
    bend = _bend(over_states("position", one.position, part.nodes), one.position[part.nodes], displacement)
    numbers = sorted(one.directors)
    directors = [over_states(f"director{k}", one.directors[k], part.nodes) for k in numbers]
    reference = [one.directors[k][part.nodes] for k in numbers]
    return {
        "name": one.name,
        "kind": one.kind,
        "reference": packing.floats(one.position[part.nodes]),
        "connectivity": packing.integers(part.connectivity),
        "ends": packing.integers(part.ends),
        "nodes": packing.integers(part.nodes) if is_thinned else None,
        "cells": packing.integers(part.cells) if is_thinned else None,
        "displacement": pack(displacement),
        "bend": pack(bend) if bend is not None else None,
        "directors": numbers,
        "triads": pack(numpy.stack(directors, axis=3)) if numbers else None,
        "referenceTriads": packing.floats(numpy.stack(reference, axis=2)) if numbers else None,
        "outlines": _outlines(one.outlines, part.nodes),
        "body": shape_of(run.deck, one.name) if one.kind == "Body" else None,
        "held": _held(one, part.nodes),
        "loaded": _loaded(one, part.nodes),
        "fields": [f for field in one.fields for f in _field(run, one, part, field, states, pack)]
        if with_fields and states
        else [],
    }


def _bend(positions, reference, displacement):
    """How far imperfections bend the reference of each state against the mesh; None where they bend none."""
    bend = positions - displacement - reference
    rounding = 1e-12 * max(numpy.abs(positions).max(initial=0.0), numpy.abs(reference).max(initial=0.0))
    return bend if numpy.abs(bend).max(initial=0.0) > rounding else None


def _outlines(outlines, nodes):
    if outlines is None:
        return None
    return {
        "ofNode": packing.integers(outlines.of_node[nodes]),
        "ends": packing.integers(outlines.ends),
        "points": packing.floats(outlines.points),
    }


def _held(one, nodes):
    place = {int(node): i for i, node in enumerate(nodes)}
    return [
        {"name": held.name, "type": held.type, "nodes": sorted({place[n] for n in held.nodes.tolist() if n in place})}
        for held in one.held
    ]


def _loaded(one, nodes):
    place = {int(node): i for i, node in enumerate(nodes)}
    found = []
    for load in one.loaded:
        rows = [row for row, node in enumerate(load.nodes.tolist()) if node in place]
        found.append(
            {
                "name": load.name,
                "type": load.type,
                "nodes": [place[node] for node in load.nodes[rows].tolist()],
                "actions": packing.floats(load.actions[rows]),
            }
        )
    return found


def _field(run, one, part, field, states, pack):
    is_nodal = isinstance(field, NodeField)
    rows = part.nodes if is_nodal else part.cells
    values = numpy.array([run.values(state, one, field.name)[rows] for state in states])
    values = values.reshape(len(states), len(rows), -1)
    for column, name in enumerate(field.columns):
        label, words, unit = describe(one.kind, field.name, name)
        yield {
            "name": label,
            "words": words,
            "unit": unit,
            "on": "nodes" if is_nodal else "cells",
            "values": pack(values[:, :, column, None]),
        }


def _shapes(shapes, shown, indices, states):
    """With the place of the state that they are about; the last one where that is not told."""
    base = len(states) - 1
    if shapes.state in indices:
        state = indices.index(shapes.state)
        base = min(range(len(states)), key=lambda i: abs(states[i] - state))
    parts = {one.name: part.nodes for one, part in shown}

    def packed(values):
        return {name: packing.floats(data[:, parts[name]]) for name, data in values.items()}

    return {
        "name": shapes.analysis,
        "base": max(base, 0),
        "shapes": shapes.names,
        "real": packed(shapes.real),
        "imaginary": packed(shapes.imaginary),
    }
