"""What moves in a mode, in a few words: the structure, and along which of its axes it bends."""

import numpy


def describe(mesh, shape):
    """The motion of a structure in a mode, without that of its first node.

    @param mesh   in the reference
    @param shape  (nodes, 6), displacement and rotation; complex for complex modes
    @return such as 'along d1, 93 %' or, of a body, 'along x, 98 %'; empty if it does not move
    """
    displacement = shape[:, :3]
    axes, names = numpy.eye(3), "xyz"
    if len(shape) > 1:
        arm = mesh.position - mesh.position[0]
        displacement = displacement - shape[0, :3] - numpy.cross(shape[0, 3:], arm)
        if mesh.directors is not None:
            axes, names = mesh.directors, ("d1", "d2", "d3")
    along = numpy.einsum("...i,...ij->...j", displacement, axes)
    shares = numpy.sum(numpy.abs(along) ** 2, axis=0)
    total = shares.sum()
    if total <= 1e-12 * numpy.sum(numpy.abs(shape[:, :3]) ** 2) or total == 0.0:
        return ""
    largest = int(numpy.argmax(shares))
    return f"along {names[largest]}, {100.0 * shares[largest] / total:.0f} %"


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
