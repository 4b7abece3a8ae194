"""One mesh in the forms that Gmsh writes: a floor and a wall with a fold between them."""

import struct

QUAD, TRIANGLE = "quadrilaterals", "triangles"


def mesh(kind, order, n=3):
    """Points and elements (type, group, nodes) over n by n squares of each side; groups are 'floor', 'wall' of
    dimension 2, 'left', 'fold' of dimension 1, 'corner' of dimension 0."""
    points, numbers = [], {}

    def at(i, j):
        """The point at (i, j)/2n of the unrolled sheet, which folds up at i = 2n."""
        if (i, j) not in numbers:
            x, y = i / (2 * n), j / (2 * n)
            points.append((min(x, 1.0), y, max(x - 1.0, 0.0)))
            numbers[(i, j)] = len(points)
        return numbers[(i, j)]

    elements = []
    for i in range(0, 4 * n, 2):
        for j in range(0, 2 * n, 2):
            group = (2, 1 if i < 2 * n else 2)
            square = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)]
            for corners in [square] if kind == QUAD else [square[:3], [square[0], square[2], square[3]]]:
                ring = [*corners, corners[0]]
                between = [((a[0] + b[0]) // 2, (a[1] + b[1]) // 2) for a, b in zip(ring, ring[1:])]
                nodes = [at(*c) for c in corners] + ([at(*c) for c in between] if order == 2 else [])
                elements.append(({3: 2, 4: 3, 6: 9, 8: 16}[len(nodes)], group, nodes))
    for i, group in ((0, (1, 3)), (2 * n, (1, 5))):
        for j in range(0, 2 * n, 2):
            nodes = [at(i, j), at(i, j + 2)] + ([at(i, j + 1)] if order == 2 else [])
            elements.append((8 if order == 2 else 1, group, nodes))
    elements.append((15, (0, 4), [at(4 * n, 0)]))
    return points, elements


NAMES = {(0, 4): "corner", (1, 3): "left", (1, 5): "fold", (2, 1): "floor", (2, 2): "wall of it"}


def written(points, elements, version, binary):
    """The bytes of a file."""
    text = f"$MeshFormat\n{version} {int(binary)} 8\n".encode()
    text += (struct.pack("<i", 1) + b"\n" if binary else b"") + b"$EndMeshFormat\n"
    text += f"$PhysicalNames\n{len(NAMES)}\n".encode()
    text += "".join(f'{dimension} {tag} "{name}"\n' for (dimension, tag), name in NAMES.items()).encode()
    text += b"$EndPhysicalNames\n"
    return text + (_old if version == "2.2" else _new)(points, elements, binary)


def _record(binary, form, *values):
    """Numbers in one line, or packed."""
    if binary:
        return struct.pack("<" + form, *values)
    return (" ".join(repr(value) if isinstance(value, float) else str(value) for value in values) + "\n").encode()


def _old(points, elements, binary):
    text = f"$Nodes\n{len(points)}\n".encode()
    text += b"".join(_record(binary, "i3d", i, *map(float, p)) for i, p in enumerate(points, 1))
    text += b"\n$EndNodes\n" if binary else b"$EndNodes\n"
    text += f"$Elements\n{len(elements)}\n".encode()
    for i, (type, (_, group), nodes) in enumerate(elements, 1):
        if binary:
            text += struct.pack("<3i", type, 1, 2) + struct.pack(f"<{3 + len(nodes)}i", i, group, group, *nodes)
        else:
            text += _record(False, "", i, type, 2, group, group, *nodes)
    return text + (b"\n" if binary else b"") + b"$EndElements\n"


def _new(points, elements, binary):
    groups = sorted(NAMES)
    text = b"$Entities\n" + _record(binary, "4Q", *(sum(g[0] == d for g in groups) for d in range(4)))
    for dimension, tag in groups:
        box = [0.0] * (3 if dimension == 0 else 6)
        if binary:
            text += struct.pack(f"<i{len(box)}dQi", tag, *box, 1, tag) + (struct.pack("<Q", 0) if dimension else b"")
        else:
            text += _record(False, "", tag, *box, 1, tag, *([0] if dimension else []))
    text += (b"\n" if binary else b"") + b"$EndEntities\n$Nodes\n"
    text += _record(binary, "4Q", 1, len(points), 1, len(points)) + _record(binary, "3iQ", 2, 1, 0, len(points))
    text += b"".join(_record(binary, "Q", i) for i in range(1, len(points) + 1))
    text += b"".join(_record(binary, "3d", *map(float, p)) for p in points)
    text += (b"\n" if binary else b"") + b"$EndNodes\n$Elements\n"
    blocks = {}
    for i, (type, group, nodes) in enumerate(elements, 1):
        blocks.setdefault((group, type), []).append((i, *nodes))
    text += _record(binary, "4Q", len(blocks), len(elements), 1, len(elements))
    for ((dimension, tag), type), rows in blocks.items():
        text += _record(binary, "3iQ", dimension, tag, type, len(rows))
        text += b"".join(_record(binary, f"{len(row)}Q", *row) for row in rows)
    return text + (b"\n" if binary else b"") + b"$EndElements\n"


def all_forms():
    """(name, bytes, kind, order) of each."""
    for kind in (QUAD, TRIANGLE):
        for order in (1, 2):
            points, elements = mesh(kind, order)
            for version in ("2.2", "4.1"):
                for binary in (False, True):
                    form = "binary" if binary else "text"
                    yield f"{kind} {order} {version} {form}", written(points, elements, version, binary), kind, order
