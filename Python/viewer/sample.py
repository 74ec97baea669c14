# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The mesh of `meniscus demo`."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, vtkCellArray, vtkUnstructuredGrid

CELLS = 40  # along an axis


def make_sample():
    """A ball of hexahedra with two point arrays: `wave`, periodic along the axes, and `plume`,
    which rises along y and spreads."""
    axis = numpy.linspace(-1.0, 1.0, CELLS + 1)
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij")
    cube = numpy.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
    # Shells of the cube become shells of the ball.
    largest = abs(cube).max(axis=1)
    length = numpy.linalg.norm(cube, axis=1)
    points = cube * (largest / numpy.maximum(length, 1e-300))[:, None]

    number = numpy.arange((CELLS + 1) ** 3).reshape((CELLS + 1,) * 3)
    corner = number[:-1, :-1, :-1].ravel()
    row, layer = CELLS + 1, (CELLS + 1) ** 2
    ids = corner[:, None] + numpy.array(
        [0, 1, row + 1, row, layer, layer + 1, layer + row + 1, layer + row])
    cells = vtkCellArray()
    cells.SetData(8, numpy_to_vtkIdTypeArray(ids.ravel().astype(numpy.int64), deep=True))

    places = vtkPoints()
    places.SetData(numpy_to_vtk(points, deep=True))
    grid = vtkUnstructuredGrid()
    grid.SetPoints(places)
    grid.SetCells(VTK_HEXAHEDRON, cells)
    x, y, z = points.T
    radius = numpy.hypot(x, z)
    stem = numpy.exp(-(radius / 0.15) ** 2) / (1.0 + numpy.exp((y - 0.3) / 0.06))
    ring = numpy.exp(-((radius - 0.5) ** 2 + (y - 0.35) ** 2) / 0.03)
    sheet = numpy.exp(-((y - 0.55 + 0.8 * radius ** 2) / 0.1) ** 2 - (radius / 0.5) ** 4)
    angles = [5.0 * coordinate for coordinate in (x, y, z)]
    wave = sum(numpy.sin(angles[i]) * numpy.cos(angles[i - 1]) for i in range(3))
    for name, values in (("wave", wave), ("plume", stem + ring + 0.6 * sheet)):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        grid.GetPointData().AddArray(array)
    return grid
