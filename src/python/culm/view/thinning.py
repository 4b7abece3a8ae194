"""Coarser meshes to look at: what a browser can turn without stuttering.

Nodes in one box of a grid become the one next to their mean, so what is shown are nodes and cells of
the model, only fewer. Cells that collapse go.
"""

import dataclasses

import numpy


@dataclasses.dataclass
class Selection:
    """What of a structure is shown."""

    nodes: numpy.ndarray  # numbers in the structure
    cells: numpy.ndarray
    connectivity: numpy.ndarray  # by places in `nodes`
    ends: numpy.ndarray  # of the cells in it


def everything(structure):
    cells = numpy.arange(len(structure.ends))
    nodes = numpy.arange(len(structure.position))
    return Selection(nodes, cells, structure.connectivity, structure.ends)


def thinned(structure, most):
    """At most about so many cells of a structure."""
    count = len(structure.ends)
    if count <= most:
        return everything(structure)
    dimensions = 1 if structure.kind == "Beam" else 2
    # surfaces and lines fill few boxes of a grid, so this begins too fine
    boxes = (2.0 * most) ** (1.0 / dimensions)
    while True:
        selection = _clustered(structure, max(1, int(boxes)))
        if len(selection.cells) <= most or boxes <= 2.0:
            return selection
        boxes *= 0.8


def _clustered(structure, boxes):
    position = structure.position
    low = position.min(axis=0)
    width = (position.max(axis=0) - low).max() / boxes
    box = numpy.floor((position - low) / max(width, 1e-300)).astype(int)
    _, cluster = numpy.unique(box, axis=0, return_inverse=True)
    chosen = _nearest_to_means(position, cluster.reshape(-1))
    place = cluster.reshape(-1)
    starts = numpy.concatenate([[0], structure.ends[:-1]])
    least = 2 if structure.kind == "Beam" else 3
    cells, connectivity, ends, seen = [], [], [], set()
    for cell, (start, end) in enumerate(zip(starts, structure.ends)):
        nodes = list(dict.fromkeys(place[structure.connectivity[start:end]].tolist()))
        key = tuple(sorted(nodes))
        if len(nodes) < least or key in seen:
            continue
        seen.add(key)
        cells.append(cell)
        connectivity += nodes
        ends.append(len(connectivity))
    return Selection(chosen, numpy.array(cells), numpy.array(connectivity), numpy.array(ends))


def _nearest_to_means(position, cluster):
    """Per cluster the node that is next to the mean of its nodes."""
    count = cluster.max() + 1
    sizes = numpy.bincount(cluster, minlength=count)
    means = numpy.stack(
        [numpy.bincount(cluster, weights=position[:, i], minlength=count) / sizes for i in range(3)], axis=1
    )
    distance = ((position - means[cluster]) ** 2).sum(axis=1)
    order = numpy.lexsort((distance, cluster))
    first = numpy.concatenate([[0], numpy.cumsum(sizes)[:-1]])
    return order[first]
