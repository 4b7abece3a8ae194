"""Figures of runs: the model in space, and histories."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as pyplot  # noqa: E402
import matplotlib.ticker  # noqa: E402
import numpy  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection  # noqa: E402

# no text is math: names of a deck may have a $
STYLE = {"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.2, "text.parse_math": False}
pyplot.rcParams.update(STYLE)

REFERENCE = "0.65"
DEFORMED = "tab:blue"


def plot(columns=1, rows=1, width=4.6, height=3.4):
    """A figure and its axes."""
    size = (width * columns, height * rows)
    return pyplot.subplots(rows, columns, figsize=size, layout="constrained", squeeze=False)


def model(meshes, state):
    """The reference in grey and a state in colour.

    @param meshes  structures of Results.meshes()
    @param state   positions of their nodes, by the same names
    """
    figure = pyplot.figure(figsize=(6.4, 5.2), layout="constrained")
    axes = figure.add_subplot(projection="3d", proj_type="ortho")
    _draw(axes, [(mesh, mesh.position) for mesh in meshes.values()], REFERENCE, 0.15)
    _draw(axes, [(mesh, state[name]) for name, mesh in meshes.items() if name in state], DEFORMED, 0.5)
    places = [mesh.position for mesh in meshes.values()] + list(state.values())
    _frame(axes, numpy.vstack(places))
    return figure


def _draw(axes, structures, colour, alpha):
    """Structures in one colour, (mesh, position) of each. All at once: what matplotlib is handed one by one takes it
    milliseconds each."""
    surfaces, lines, points = [], [], []
    for mesh, position in structures:
        cells = [position[list(cell)] for cell in mesh.cells]
        surfaces += [c for c in cells if len(c) > 2 and mesh.is_surface]
        lines += [c for c in cells if len(c) > 1 and not mesh.is_surface]
        points += [c[0] for c in cells if len(c) == 1]
    if surfaces:
        axes.add_collection3d(
            Poly3DCollection(surfaces, facecolor=colour, edgecolor=colour, lw=0.3, alpha=alpha)
        )
    if lines:
        axes.add_collection3d(Line3DCollection(lines, colors=colour, lw=1.6))
    if points:
        axes.scatter(*numpy.array(points).T, color=colour, s=14)


def coloured(meshes, state, pictures):
    """A state several times, its elements in the colours of numbers.

    @param state     positions by structure
    @param pictures  of stresses.of_state()"""
    columns = min(2, len(pictures))
    rows = (len(pictures) + columns - 1) // columns
    figure = pyplot.figure(figsize=(4.8 * columns, 3.4 * rows))
    figure.subplots_adjust(left=0.0, right=0.94, bottom=0.02, top=0.94, wspace=0.12, hspace=0.12)
    everything = numpy.vstack([state.get(name, mesh.position) for name, mesh in meshes.items()])
    for number, picture in enumerate(pictures):
        axes = figure.add_subplot(rows, columns, number + 1, projection="3d", proj_type="ortho")
        numbers = numpy.concatenate([values for values in picture.values.values()])
        low, high = float(numbers.min()), float(numbers.max())
        signed = low < 0.0 < high
        if signed:
            low, high = -max(-low, high), max(-low, high)
        colours = matplotlib.cm.ScalarMappable(
            matplotlib.colors.Normalize(low, high if high > low else low + 1e-30), "coolwarm" if signed else "viridis"
        )
        places = {name: (mesh, state.get(name, mesh.position)) for name, mesh in meshes.items()}
        _draw(axes, [place for name, place in places.items() if name not in picture.values], REFERENCE, 0.15)
        _colour(axes, [(*places[name], colours.to_rgba(values)) for name, values in picture.values.items()])
        _frame(axes, everything)
        axes.set_axis_off()  # as in the picture of the model
        axes.set_title(f"{picture.title} [{picture.unit}]", fontsize=9)
        figure.colorbar(colours, ax=axes, shrink=0.7, pad=0.06)
    return figure


def _colour(axes, structures):
    """Structures in the colours of their cells: (mesh, position, colours) of each."""
    for is_surface in (True, False):
        some = [one for one in structures if one[0].is_surface == is_surface]
        if not some:
            continue
        cells = [position[list(cell)] for mesh, position, _ in some for cell in mesh.cells]
        colours = numpy.vstack([each for *_, each in some])
        if is_surface:
            axes.add_collection3d(Poly3DCollection(cells, facecolor=colours, edgecolor=colours, lw=0.3))
        else:
            axes.add_collection3d(Line3DCollection(cells, colors=colours, lw=3.0))


def _frame(axes, points):
    """A box of the model's own shape, but flat in no direction, with one scale for all."""
    low, high = points.min(axis=0), points.max(axis=0)
    largest = max(float((high - low).max()), 1e-9)
    centre, half = (low + high) / 2, numpy.maximum((high - low) / 2, 0.2 * largest) * 1.05
    for i, limits in enumerate((axes.set_xlim, axes.set_ylim, axes.set_zlim)):
        limits(centre[i] - half[i], centre[i] + half[i])
    axes.set_box_aspect(half / half.max())
    for axis, share in zip((axes.xaxis, axes.yaxis, axes.zaxis), half / half.max()):
        axis.set_major_locator(matplotlib.ticker.MaxNLocator(3 if share < 0.5 else 6))
    axes.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")


def shapes(meshes, shapes, titles):
    """Shapes beside each other, the reference in grey; the largest displacement is a tenth of the model.

    @param shapes  (shapes, nodes, 6) by structure
    """
    everything = numpy.vstack([mesh.position for mesh in meshes.values()])
    size = float(numpy.linalg.norm(everything.max(axis=0) - everything.min(axis=0))) or 1.0
    columns = min(3, len(titles))
    rows = (len(titles) + columns - 1) // columns
    figure = pyplot.figure(figsize=(3.3 * columns, 3.4 * rows))
    figure.subplots_adjust(left=0.02, right=0.98, bottom=0.04, top=0.92, wspace=0.05, hspace=0.2)
    for number, title in enumerate(titles):
        axes = figure.add_subplot(rows, columns, number + 1, projection="3d", proj_type="ortho")
        moved = {name: shape[number, :, :3].real for name, shape in shapes.items() if name in meshes}
        largest = max(float(numpy.abs(one).max()) for one in moved.values()) or 1.0
        _draw(axes, [(mesh, mesh.position) for mesh in meshes.values()], REFERENCE, 0.15)
        _draw(axes, [(meshes[name], meshes[name].position + 0.1 * size / largest * way) for name, way in moved.items()],
              DEFORMED, 0.5)
        _frame(axes, everything)
        axes.set(xticklabels=[], yticklabels=[], zticklabels=[], xlabel="x", ylabel="y", zlabel="z")
        axes.set_title(title, fontsize=8)
    return figure


def histories(groups, label, is_path=False):
    """One plot per group of columns with the same unit.

    @param groups   (title, unit, levels, {component: values})
    @param is_path  whether the levels are drawn over the values, as paths are
    """
    columns = 2 if len(groups) > 1 else 1
    rows = (len(groups) + columns - 1) // columns
    figure, axes = plot(columns, rows, height=2.6)
    for ax, (title, unit, levels, curves) in zip(axes.flat, groups):
        for name, values in curves.items():
            ax.plot(*((values, levels) if is_path else (levels, values)), label=name)
        ax.set(title=title)
        ax.set(**dict(zip(("xlabel", "ylabel"), (f"[{unit}]", label) if is_path else (label, f"[{unit}]"))))
        if len(curves) > 1:
            ax.legend(fontsize=7)
    for ax in axes.flat[len(groups) :]:
        ax.set_visible(False)
    return figure


def scale_log(axes, *directions):
    """Makes directions logarithmic, with labels that are no math, as those of matplotlib are."""
    for direction in directions:
        axes.set(**{f"{direction}scale": "log"})
        axis = getattr(axes, f"{direction}axis")
        axis.set_major_formatter(matplotlib.ticker.LogFormatter())
        axis.set_minor_formatter(matplotlib.ticker.LogFormatter())


def close(figure):
    pyplot.close(figure)
