"""What moves in a mode, in a few words: the structure, and along which of its axes it bends, or that it twists."""

import numpy


def describe(mesh, shape):
    """The motion of a structure in a mode, without that of its first node.

    @param mesh   in the reference
    @param shape  (nodes, 6), displacement and rotation; complex for complex modes
    @return such as 'along d1, 93 %', of a body 'along x, 98 %', of a beam that twists more than it bends
        'torsion, 97 %', the share of the squared rotations; empty if it does not move
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
                return f"torsion, {100.0 * twist:.0f} %"
    along = numpy.einsum("...i,...ij->...j", displacement, axes)
    shares = numpy.sum(numpy.abs(along) ** 2, axis=0)
    total = shares.sum()
    if total <= 1e-12 * numpy.sum(numpy.abs(shape[:, :3]) ** 2) or total == 0.0:
        return ""
    largest = int(numpy.argmax(shares))
    return f"along {names[largest]}, {100.0 * shares[largest] / total:.0f} %"


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
    @param shapes   (modes, nodes, 6) by structure
    @param remarks  by mode the shares of structures, as 'blade 1 55 %, tower 12 %'
    """
    names = []
    for mode, remark in enumerate(remarks):
        structure = remark.split(", ")[0].rsplit(" ", 2)[0]
        if structure not in shapes or structure not in meshes:
            names.append("")
            continue
        names.append(f"{structure} {describe(meshes[structure], shapes[structure][mode])}".strip())
    return names
