"""Orientations of Abaqus and CalculiX: along which direction an element has axis 1 of its material."""

import numpy

from .abaqus_nodes import placed, triad
from .findings import refuse
from .keyword_file import number, numbers_of
from .model import cylinder_axes

SYSTEMS = {"R": "RECTANGULAR", "C": "CYLINDRICAL", "S": "SPHERICAL"}


class Orientation:
    """@param axes_at  rows of the system at a place
    @param selected  axis of the system that is the nearest to the normal: the one that follows it is
    turned about it, and then projected on the shell
    @param pole  the axis of a system whose directions depend on the place; None of others"""

    def __init__(self, axes_at, selected, turn, pole, place):
        self._axes_at = axes_at
        self._selected = selected
        self._turn = turn
        self.pole = pole
        self._place = place

    def axis(self, position):
        """Whose projection is axis 1 at a place; refused where the programs that read this differ."""
        if self.pole is None and self._selected != 3:
            text = f"orientations of SYSTEM RECTANGULAR about its axis {self._selected} on shells that are not isotropic are not read"
            refuse(self._place, f"{text}; RECTANGULAR about 3 is")
        axes = self._axes_at(position)
        return _turned(axes[self._selected % 3], axes[self._selected - 1], self._turn)


def read_orientation(reader, block):
    name = reader.prefix + block.required("NAME")
    system = block.get("SYSTEM") or "RECTANGULAR"
    kind = SYSTEMS.get(system[:1])
    if kind is None:
        refuse(block.place, f"*ORIENTATION with SYSTEM={system} is not read; {', '.join(SYSTEMS.values())} are")
    if block.get("DEFINITION") not in (None, "COORDINATES"):
        refuse(block.place, f"*ORIENTATION with DEFINITION={block.get('DEFINITION')} is not read; COORDINATES is")
    if not block.lines:
        refuse(block.place, "*ORIENTATION needs two points")
    place, cells = block.lines[0]
    if len([cell for cell in cells if cell]) == 1:
        refuse(place, f"*ORIENTATION by the distribution {cells[0]}, element by element, is not read")
    values = numbers_of(cells, place, "a coordinate")
    values += [0.0] * (-len(values) % 3)
    if len(values) != 6 and not (len(values) == 9 and kind == "RECTANGULAR"):
        refuse(place, f"expected two points, or three with the origin of a rectangular system, found {len(values)} numbers")
    points = [placed(reader, numpy.array(values[i : i + 3])) for i in range(0, len(values), 3)]
    selected, turn = _selection(block, kind)
    if kind == "RECTANGULAR":
        origin = points[2] if len(points) > 2 else placed(reader, numpy.zeros(3))
        axes = triad(points[0] - origin, points[1] - origin, block.place)
        reader.orientations[name] = Orientation(lambda position: axes, selected, turn, None, block.place)
        return
    pole = points[1] - points[0]
    if numpy.linalg.norm(pole) == 0.0:
        refuse(place, "the two points of the axis are one")
    system_at = cylinder_axes if kind == "CYLINDRICAL" else _sphere_axes

    def axes_at(position):
        return system_at(points[0], pole, position, block.place)

    pole = tuple(map(float, pole / numpy.linalg.norm(pole)))
    reader.orientations[name] = Orientation(axes_at, selected, turn, pole, block.place)


def _selection(block, kind):
    """The axis of the second line, and the angle about it. Without one axis 1 of the system is projected."""
    if len(block.lines) < 2:
        if kind == "SPHERICAL":
            refuse(block.place, "*ORIENTATION of SYSTEM SPHERICAL needs a second line with the axis that is normal to the shell")
        return 3, 0.0
    place, cells = block.lines[1]
    selected = number(cells[0], place) if cells and cells[0] else 1
    if selected not in (1, 2, 3):
        refuse(place, f"the axis of the rotation must be 1, 2 or 3, got {selected:g}")
    angle = number(cells[1], place) if len(cells) > 1 and cells[1] else 0.0
    return int(selected), numpy.radians(angle)


def _sphere_axes(centre, pole, position, place):
    """Rows radial, circumferential, meridional."""
    _, around, _ = cylinder_axes(centre, pole, position, place)
    radial = (position - centre) / numpy.linalg.norm(position - centre)
    return numpy.array([radial, around, numpy.cross(radial, around)])


def _turned(vector, axis, angle):
    """The vector is normal to the axis."""
    return vector * numpy.cos(angle) + numpy.cross(axis, vector) * numpy.sin(angle)
