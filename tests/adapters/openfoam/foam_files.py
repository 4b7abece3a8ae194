"""Meshes and fields of OpenFOAM in its text format."""

import re

import numpy as np


def _body(path):
    """What stands between the outermost brackets after the header."""
    text = path.read_text()
    text = text[text.index("}", text.index("FoamFile")) + 1 :]
    return text[text.index("(") + 1 : text.rindex(")")]


def _numbers(text):
    return np.array(re.sub(r"[()]", " ", text).split(), dtype=float)


def read_field(path):
    """The values of all cells, shape (cells,) or (cells, 3)."""
    text = re.search(r"internalField\s+nonuniform List<(\w+)>\s*\d+\s*\((.*?)\n\)", path.read_text(), re.DOTALL)
    values = _numbers(text.group(2))
    return values.reshape(-1, 3) if text.group(1) == "vector" else values


class Mesh:
    """A mesh, with the points of a time if there are any.

    points  shape (points, 3) [m]
    faces   numbers of points, per face
    owner   cell of each face
    """

    def __init__(self, case, time="constant"):
        self._folder = case / "constant/polyMesh"
        self.points = _numbers(_body(case / time / "polyMesh/points")).reshape(-1, 3)
        faces = re.findall(r"\d+\(([\d ]+)\)", _body(self._folder / "faces"))
        self.faces = [np.array(face.split(), dtype=int) for face in faces]
        self.owner = _numbers(_body(self._folder / "owner")).astype(int)

    def patch(self, name):
        """Centres, areas with the normal out of the fluid, and cells of a patch of plane quadrilaterals."""
        entry = re.search(rf"\b{name}\s*\{{(.*?)\}}", (self._folder / "boundary").read_text(), re.DOTALL).group(1)
        first, count = (int(re.search(rf"{word}\s+(\d+)", entry).group(1)) for word in ("startFace", "nFaces"))
        corners = self.points[np.array(self.faces[first : first + count])]
        areas = 0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        return corners.mean(axis=1), areas, self.owner[first : first + count]

    def cell_centres(self):
        """Means of the points of each cell's own faces and their neighbours' [m]."""
        neighbour = _numbers(_body(self._folder / "neighbour")).astype(int)
        middles = np.array([self.points[face].mean(axis=0) for face in self.faces])
        sums, counts = np.zeros((self.owner.max() + 1, 3)), np.zeros(self.owner.max() + 1)
        for cells, of in ((self.owner, middles), (neighbour, middles[: len(neighbour)])):
            np.add.at(sums, cells, of)
            np.add.at(counts, cells, 1.0)
        return sums / counts[:, None]
