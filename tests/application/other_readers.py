#!/usr/bin/env python3
"""Pictures are files that VTK and meshio read alike: points, cells by their kind, and data.

usage: other_readers.py --culm PROGRAM     (77: skipped, neither is installed)
"""

import argparse
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "kit"))
from culm_runs import MPI_ENVIRONMENT  # noqa: E402

CURVES = {1: ("line", "vtkLine"), 2: ("line3", "vtkQuadraticEdge"), 3: ("line4", "vtkCubicLine")}


def read_by_meshio(path):
    import meshio

    mesh = meshio.read(path)
    return mesh.points, {block.type: len(block) for block in mesh.cells}, mesh.point_data["displacement"]


def read_by_vtk(path):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    kinds = [grid.GetCell(i).GetClassName() for i in range(grid.GetNumberOfCells())]
    points = vtk_to_numpy(grid.GetPoints().GetData())
    return points, {kind: kinds.count(kind) for kind in kinds}, vtk_to_numpy(grid.GetPointData().GetArray("displacement"))


READERS = {"meshio": read_by_meshio, "vtk": read_by_vtk}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--culm", required=True)
    culm = parser.parse_args().culm
    installed = [name for name in READERS if importlib.util.find_spec(name)]
    if not installed:
        print("neither meshio nor VTK is installed")
        return 77
    failures = 0
    with tempfile.TemporaryDirectory(prefix="culm") as name:
        for order, kinds in CURVES.items():
            folder = pathlib.Path(name) / str(order)
            command = [culm, "run", HERE / "base.xml", "--quiet", "--output", folder]
            command += ["--set", f"Structures/beam/Order={order}"]
            subprocess.run(command, check=True, env={**os.environ, **MPI_ENVIRONMENT})
            picture = sorted(folder.glob("run_vtu/beam_??????.vtu"))[-1]
            last = (folder / "history.csv").read_text().splitlines()[-1].split(",")
            tip = numpy.array([float(number) for number in last[1:4]])
            for reader in installed:
                points, cells, displacement = READERS[reader](picture)
                kind = kinds[reader == "vtk"]
                right = cells == {kind: 4} and numpy.abs(points[-1] - tip).max() == 0.0
                right = right and displacement.shape == points.shape and displacement[-1].any()
                failures += not right
                print(f"order {order} by {reader}: {cells}", "" if right else f"expected 4 of {kind}, the tip at {tip}")
    return 1 if failures else 0


sys.exit(main())
