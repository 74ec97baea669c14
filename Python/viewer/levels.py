# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Isosurface areas of a scalar, and an opacity function that makes rare values visible."""
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter

from .reading import leaves_of

BINS = 64
# Share of the largest area that is added to each level's. It limits the opacity of values that
# hardly occur to 50 times that of the most frequent one.
FLOOR = 0.02
# Mean optical depth of a ray through the middle of a cube of the mesh's size.
OPTICAL_DEPTH = 1.5


def _as_grid(data):
    if isinstance(data, vtkUnstructuredGrid):
        return data
    append = vtkAppendFilter()
    append.SetInputDataObject(data)
    append.Update()
    return append.GetOutput()


def _measure_cells(grid):
    size = vtkCellSizeFilter()
    size.SetInputDataObject(grid)
    size.ComputeVertexCountOff()
    size.ComputeLengthOff()
    size.ComputeAreaOff()
    size.Update()
    volumes = vtk_to_numpy(size.GetOutput().GetCellData().GetArray("Volume"))
    return numpy.abs(numpy.nan_to_num(volumes.astype(float)))


def _values_of(array, component):
    values = vtk_to_numpy(array).astype(float)
    if values.ndim == 1:
        return values
    return numpy.linalg.norm(values, axis=1) if component is None else values[:, component]


def _ranges_of_cells(grid, name, association, component):
    """Least and largest scalar of each cell."""
    if association == "cells":
        values = _values_of(grid.GetCellData().GetArray(name), component)
        return values, values
    values = _values_of(grid.GetPointData().GetArray(name), component)
    cells = grid.GetCells()
    ids = values[vtk_to_numpy(cells.GetConnectivityArray())]
    starts = vtk_to_numpy(cells.GetOffsetsArray())[:-1]
    return numpy.minimum.reduceat(ids, starts), numpy.maximum.reduceat(ids, starts)


class Levels:
    """Isosurface areas and volumes of a scalar field, by level.

    A cell counts for every level between the least and the largest value of its points, by its
    volume to the power 2/3: the number of cells that a surface crosses estimates its area (Carr,
    Duffy and Denby, "On histograms and isosurface statistics", 2006). Values that are not finite
    are left out.

    low, high: range of the scalar. areas, volumes: by bin, BINS of them.
    """

    def __init__(self, data, name, association, component=None):
        lows, highs, volumes = [], [], []
        for leaf in leaves_of(data):
            grid = _as_grid(leaf)
            attributes = grid.GetPointData() if association == "points" else grid.GetCellData()
            if grid.GetNumberOfCells() and attributes.HasArray(name):
                least, largest = _ranges_of_cells(grid, name, association, component)
                lows.append(least)
                highs.append(largest)
                volumes.append(_measure_cells(grid))
        joined = [numpy.concatenate(parts) if parts else numpy.empty(0)
                  for parts in (lows, highs, volumes)]
        finite = numpy.isfinite(joined[0]) & numpy.isfinite(joined[1])
        self._collect(*(part[finite] for part in joined))

    def _collect(self, lows, highs, volumes):
        self.low = float(lows.min()) if lows.size else 0.0
        self.high = float(highs.max()) if highs.size else 1.0
        width = (self.high - self.low) / BINS
        self.areas = numpy.zeros(BINS)
        self.volumes = numpy.zeros(BINS)
        if not lows.size or width <= 0.0:
            return
        first = numpy.clip((lows - self.low) / width, 0, BINS - 1).astype(int)
        last = numpy.clip((highs - self.low) / width, 0, BINS - 1).astype(int)
        changes = numpy.zeros(BINS + 1)
        numpy.add.at(changes, first, volumes ** (2.0 / 3.0))
        numpy.add.at(changes, last + 1, -(volumes ** (2.0 / 3.0)))
        self.areas = numpy.maximum(numpy.cumsum(changes)[:-1], 0.0)
        numpy.add.at(self.volumes, (first + last) // 2, volumes)

    def get_opacity(self):
        """Attenuation coefficients as pairs (scalar, coefficient), per diagonal of the mesh.

        Coefficients are inversely proportional to the area of a level, so that rare values show as
        much as frequent ones. They are scaled so that their mean over the volume makes a ray
        through a cube (1 / sqrt(3) of the diagonal) OPTICAL_DEPTH deep.
        """
        if self.areas.max() <= 0.0 or self.volumes.sum() <= 0.0:
            middle = OPTICAL_DEPTH * 3 ** 0.5
            return [(self.low, middle), (max(self.high, self.low + 1e-6), middle)]
        shares = self.areas / self.areas.max()
        weights = 1.0 / (shares + FLOOR)
        weights -= weights.min()  # the most frequent value is transparent
        mean = (weights * self.volumes).sum() / self.volumes.sum()
        if mean > 0.0:
            weights *= OPTICAL_DEPTH * 3 ** 0.5 / mean
        else:
            weights[:] = OPTICAL_DEPTH * 3 ** 0.5
        width = (self.high - self.low) / BINS
        return [(self.low + (bin + 0.5) * width, float(weight))
                for bin, weight in enumerate(weights)]

    def get_isovalues(self, count=3):
        """Values between which the volume of the mesh has equal shares."""
        total = self.volumes.sum()
        if total <= 0.0:
            return [0.5 * (self.low + self.high)]
        shares = numpy.cumsum(self.volumes) / total
        width = (self.high - self.low) / BINS
        wanted = numpy.arange(1, count + 1) / (count + 1.0)
        return sorted({float(self.low + (numpy.searchsorted(shares, share) + 0.5) * width)
                       for share in wanted})
