"""What moves in a mode, in a few words: the structure, and along which of its axes it bends, or that it twists. Where
structures are called blades and tower, also the words that engineers of wind turbines have for that."""

import dataclasses

import numpy

ALONG = 0.7  # cosine from which two directions are one


@dataclasses.dataclass
class Motion:
    """@param axis       d1, x, …, or torsion
    @param share      of the squares
    @param direction  of the axis in space at the last node; None for torsion"""

    axis: str
    share: float
    direction: object = None

    def __str__(self):
        return f"{self.axis}, {100.0 * self.share:.0f} %" if self.axis == "torsion" else f"along {self.axis}, {100.0 * self.share:.0f} %"


def describe(mesh, shape):
    """The motion of a structure in a mode in words; empty if it does not move."""
    motion = motion_of(mesh, shape)
    return "" if motion is None else str(motion)


def motion_of(mesh, shape):
    """The motion of a structure in a mode, without that of its first node.

    @param mesh   in the reference
    @param shape  (nodes, 6), displacement and rotation; complex for complex modes
    @return such as along d1, of a body along x, of a beam that twists more than it bends torsion, with the share of
        the squared rotations; None if it does not move
    """
    displacement = shape[:, :3]
    axes, names = numpy.eye(3), "xyz"
    if len(shape) > 1:
        arm = mesh.position - mesh.position[0]
        displacement = displacement - shape[0, :3] - numpy.cross(shape[0, 3:], arm)
        if mesh.directors is not None:
            axes, names = mesh.directors, ("d1", "d2", "d3")
            twist = _share_of_twist(mesh, shape, displacement)
            if twist > 0.5:
                return Motion("torsion", twist)
    along = numpy.einsum("...i,...ij->...j", displacement, axes)
    shares = numpy.sum(numpy.abs(along) ** 2, axis=0)
    total = shares.sum()
    if total <= 1e-12 * numpy.sum(numpy.abs(shape[:, :3]) ** 2) or total == 0.0:
        return None
    largest = int(numpy.argmax(shares))
    direction = axes[largest] if axes.ndim == 2 else axes[-1, :, largest]
    return Motion(names[largest], shares[largest] / total, direction)


def _share_of_twist(mesh, shape, displacement):
    """Of the squared rotations against the first node those about d3; 0 where rotations are small beside displacements,
    as in a mode along the axis."""
    turns = numpy.einsum("...i,...ij->...j", shape[:, 3:] - shape[0, 3:], mesh.directors)
    squares = numpy.sum(numpy.abs(turns) ** 2, axis=0)
    length = numpy.linalg.norm(mesh.position - mesh.position[0], axis=1).max()
    whole = numpy.sum(numpy.abs(shape[:, :3]) ** 2) + length**2 * numpy.sum(numpy.abs(shape[:, 3:]) ** 2)
    noticeable = max(1e-6 * numpy.sum(numpy.abs(displacement) ** 2), 1e-12 * whole)
    if squares.sum() * length**2 <= noticeable:
        return 0.0
    return squares[2] / squares.sum()


def name_modes(meshes, shapes, remarks):
    """A name for each mode: the structure with the largest share of the kinetic energy, and how it moves.

    @param meshes   by structure
    @param shapes   (modes, nodes, 6) by structure, by rising frequency
    @param remarks  by mode the shares of structures, as 'blade 1 55 %, tower 12 %'
    """
    found = []
    for mode, remark in enumerate(remarks):
        structure = remark.split(", ")[0].rsplit(" ", 2)[0]
        known = structure in shapes and structure in meshes
        found.append((structure if known else "", motion_of(meshes[structure], shapes[structure][mode]) if known else None))
    flap, downwind = _flap(found, meshes)
    return [_name(structure, motion, flap, downwind) for structure, motion in found]


def _flap(found, meshes):
    """The axis along which blades flap, which is that of the first mode in which one bends, and its direction in space at
    the root; None without one."""
    for structure, motion in found:
        if structure.lower().startswith("blade") and motion is not None and motion.axis in ("d1", "d2"):
            return motion.axis, meshes[structure].directors[0, :, int(motion.axis[1]) - 1]
    return None, None


def _name(structure, motion, flap, downwind):
    if motion is None:
        return structure
    word = ""
    if structure.lower().startswith("blade") and motion.axis in ("d1", "d2") and flap is not None:
        word = "flap, " if motion.axis == flap else "edge, "
    elif structure.lower().startswith("tower") and downwind is not None and motion.axis != "d3" and motion.direction is not None:
        word = "fore-aft, " if abs(motion.direction @ downwind) > ALONG else "side to side, "
    return f"{structure} {word}{motion}"
