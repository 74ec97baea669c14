# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Isosurface areas of a scalar, and an opacity function that makes rare values visible."""
import math
from functools import reduce

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules import vtkCommonDataModel as model
from vtkmodules.vtkCommonDataModel import (
    VTK_EMPTY_CELL, VTK_POLYHEDRON, vtkImageData, vtkRectilinearGrid, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkAppendFilter

from ..data import leaves_of
from ..threads import run_blocks
from .cells import drawn_cells_of, kinds_in, types_of

BINS = 64
# Share of the largest area that is added to each level's. It limits the opacity of values that
# hardly occur to 50 times the opacity of the most frequent value.
FLOOR = 0.02
# If areas differ by a smaller share of the largest one, no value is that of the surroundings, and
# the least opacity is above 0: with equal areas all values have the same.
_EVEN = 0.1
# Mean optical depth of a ray through the middle of a cube of the mesh's size.
OPTICAL_DEPTH = 1.5
# It is reached after as many mean lengths of rays in the mesh at most: in a plate or a shell, whose
# size says nothing about its thickness. In a cube, a ball or a rod of four cubes it is the size.
_MEAN_LENGTHS = 3.0


def find_reach(bounds, volume):
    """Length after which a ray in a mesh is to be OPTICAL_DEPTH deep, as a share of the diagonal of
    its bounds: the width of a cube with this diagonal, or less where the mesh is thin."""
    x, y, z = (float(bounds[2 * axis + 1]) - bounds[2 * axis] for axis in range(3))
    diagonal = math.hypot(x, y, z)
    surface = 2.0 * (x * y + y * z + z * x)
    if not (0.0 < surface < math.inf and volume > 0.0):
        return 1.0 / 3 ** 0.5
    # By Cauchy, a convex body has a mean silhouette of a quarter of its surface.
    return min(1.0 / 3 ** 0.5, _MEAN_LENGTHS * 4.0 * (volume / surface / diagonal))


def _as_grid(data):
    if isinstance(data, vtkUnstructuredGrid):
        return data
    append = vtkAppendFilter()
    append.SetInputDataObject(data)
    append.Update()
    return append.GetOutput()


# Cells that are measured at once, whose intermediate results stay in a processor's cache.
_BLOCK_SIZE = 1 << 14
# Tetrahedra of a shape, by the corners of the cell.
_TETRAHEDRON = [(0, 1, 2, 3)]
_PYRAMID = [(0, 1, 2, 4), (0, 2, 3, 4)]
_WEDGE = [(0, 1, 2, 5), (0, 1, 5, 4), (0, 4, 5, 3)]
_HEXAHEDRON = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
_VOXEL = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]
_SHAPES = (
    (_TETRAHEDRON, "TETRA QUADRATIC_TETRA HIGHER_ORDER_TETRAHEDRON LAGRANGE_TETRAHEDRON "
                   "BEZIER_TETRAHEDRON"),
    (_PYRAMID, "PYRAMID QUADRATIC_PYRAMID TRIQUADRATIC_PYRAMID HIGHER_ORDER_PYRAMID "
               "LAGRANGE_PYRAMID BEZIER_PYRAMID"),
    (_WEDGE, "WEDGE QUADRATIC_WEDGE QUADRATIC_LINEAR_WEDGE BIQUADRATIC_QUADRATIC_WEDGE "
             "HIGHER_ORDER_WEDGE LAGRANGE_WEDGE BEZIER_WEDGE"),
    (_HEXAHEDRON, "HEXAHEDRON QUADRATIC_HEXAHEDRON TRIQUADRATIC_HEXAHEDRON "
                  "BIQUADRATIC_QUADRATIC_HEXAHEDRON HIGHER_ORDER_HEXAHEDRON LAGRANGE_HEXAHEDRON "
                  "BEZIER_HEXAHEDRON"),
    (_VOXEL, "VOXEL"))
# Tetrahedra by the type of the cell; VTK 9.1 lacks some types.
_TETRAHEDRA = {getattr(model, "VTK_" + name): numpy.array(shape)
               for shape, names in _SHAPES for name in names.split()
               if hasattr(model, "VTK_" + name)}


def _measure_corners(points, ids, starts, tetrahedra):
    """Volumes of cells of one shape, of the tetrahedra between their corners.

    points: coordinates as three arrays. ids: point indices of all cells. starts: place of the first
    index of each cell to be measured.
    """
    volumes = numpy.zeros(starts.size)
    corners = {}
    for corner in numpy.unique(tetrahedra):
        chosen = ids[starts + corner]
        corners[corner] = [axis[chosen] for axis in points]
    with numpy.errstate(invalid="ignore", over="ignore"):  # points that are not finite
        for tetrahedron in tetrahedra:
            first, *others = (corners[corner] for corner in tetrahedron)
            (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (
                [there - here for there, here in zip(other, first)] for other in others)
            volumes += abs(ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz)
                           + az * (bx * cy - by * cx)) / 6
    return volumes


def _measure_others(grid, cells):
    """Volumes of polyhedra and prisms."""
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
    chosen, ids = vtkUnstructuredGrid(), vtkIdList()
    chosen.SetPoints(grid.GetPoints())
    for cell in map(int, cells):
        kind = grid.GetCellType(cell)
        if kind == VTK_POLYHEDRON:
            grid.GetFaceStream(cell, ids)
            if ids.GetNumberOfIds() == 0 or ids.GetId(0) == 0:  # no faces, which VTK 9.7 needs
                kind = VTK_EMPTY_CELL
                ids.Reset()
        else:
            grid.GetCellPoints(cell, ids)
        chosen.InsertNextCell(kind, ids)
    size = vtkCellSizeFilter()
    size.SetInputDataObject(chosen)
    size.ComputeVertexCountOff()
    size.ComputeLengthOff()
    size.ComputeAreaOff()
    size.Update()
    return abs(vtk_to_numpy(size.GetOutput().GetCellData().GetArray("Volume")).astype(float))


def _measure_cells(grid, drawn):
    """Volumes of the cells that are drawn, 0 for the others. A cell of higher order counts with the
    volume between its corners."""
    types = types_of(grid)
    volumes = numpy.zeros(types.size)
    others = drawn.copy()
    points = vtk_to_numpy(grid.GetPoints().GetData()).T.astype(float, order="C")
    ids = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    for kind in kinds_in(types[drawn]):
        if kind in _TETRAHEDRA:
            of_kind = drawn & (types == kind)
            others[of_kind] = False
            complete = numpy.diff(offsets) > _TETRAHEDRA[kind].max()
            cells = numpy.flatnonzero(of_kind & complete)

            def measure(begin, end, cells=cells, shape=_TETRAHEDRA[kind]):
                block = cells[begin:end]
                volumes[block] = _measure_corners(points, ids, offsets[block], shape)
            run_blocks(measure, cells.size, _BLOCK_SIZE)
    if others.any():
        volumes[others] = _measure_others(grid, numpy.flatnonzero(others))
    return numpy.where(numpy.isfinite(volumes), volumes, 0.0)


def values_of(array, component):
    """The numbers of a component of an array; None: its magnitude."""
    values = vtk_to_numpy(array).astype(float)
    if values.ndim == 1:
        return values
    return numpy.linalg.norm(values, axis=1) if component is None else values[:, component]


def _ranges_of_cells(grid, name, association, component):
    """Least and largest scalar of each cell; of a cell without points, not a number."""
    if association == "cells":
        values = values_of(grid.GetCellData().GetArray(name), component)
        return values, values
    values = values_of(grid.GetPointData().GetArray(name), component)
    cells = grid.GetCells()
    ids = vtk_to_numpy(cells.GetConnectivityArray())
    offsets = vtk_to_numpy(cells.GetOffsetsArray())
    ranges = numpy.full((2, offsets.size - 1), numpy.nan)

    def find(begin, end):
        places = offsets[begin:end + 1] - offsets[begin]
        sizes = numpy.diff(places)
        scalars = values[ids[offsets[begin]:offsets[end]]]
        used = sizes > 0
        for side, extreme in enumerate((numpy.minimum, numpy.maximum)):
            if used[0] and (sizes == sizes[0]).all():  # several times as fast
                ranges[side, begin:end] = reduce(extreme, scalars.reshape(sizes.size, -1).T)
            elif used.any():
                ranges[side, begin:end][used] = extreme.reduceat(scalars, places[:-1][used])
    run_blocks(find, offsets.size - 1, _BLOCK_SIZE)
    return ranges


def _measure_boxes(leaf):
    """Volumes of the cells of an image or a rectilinear grid."""
    if isinstance(leaf, vtkImageData):
        sizes = [numpy.full(max(count - 1, 1), spacing)
                 for count, spacing in zip(leaf.GetDimensions(), leaf.GetSpacing())]
    else:
        sizes = [numpy.diff(vtk_to_numpy(axis).astype(float)) for axis in (
            leaf.GetXCoordinates(), leaf.GetYCoordinates(), leaf.GetZCoordinates())]
    x, y, z = sizes
    return abs(z[:, None, None] * y[:, None] * x).ravel()


def _ranges_of_boxes(leaf, name, association, component):
    """The same as _ranges_of_cells() for an image or a rectilinear grid, without its cells, which
    would take more memory than its values."""
    if association == "cells":
        values = values_of(leaf.GetCellData().GetArray(name), component)
        return values, values
    values = values_of(leaf.GetPointData().GetArray(name), component)
    ranges = []
    for find in (numpy.minimum, numpy.maximum):
        found = values.reshape(leaf.GetDimensions()[::-1])
        for axis in range(3):
            found = numpy.moveaxis(found, axis, 0)
            found = numpy.moveaxis(find(found[:-1], found[1:]), 0, axis)
        ranges.append(found.ravel())
    return ranges


def _measure(leaf, name, association, component, drawn):
    """Least and largest scalars, and volumes, of the cells of a data set."""
    if isinstance(leaf, (vtkImageData, vtkRectilinearGrid)):
        return (*_ranges_of_boxes(leaf, name, association, component), _measure_boxes(leaf))
    grid = _as_grid(leaf)
    return (*_ranges_of_cells(grid, name, association, component), _measure_cells(grid, drawn))


def _find_changes(begins, ends, weights):
    """Differences between neighbouring bins of the sum of weights, each of which counts in a bin by
    the share of it that its interval covers. begins, ends: of intervals, in bins from 0 to BINS."""
    changes = numpy.zeros(BINS + 2)
    for places, sign in (ends, 1.0), (begins, -1.0):
        bins = places.astype(int)
        beyond = (places - bins) * weights
        changes += sign * (numpy.bincount(bins, beyond - weights, BINS + 2)
                           - numpy.bincount(bins + 1, beyond, BINS + 2))
    return changes[:BINS]


class Levels:
    """Isosurface areas and volumes of a scalar field, by level.

    A cell counts for every level between the least and the largest value of its points, by its
    volume to the power 2/3: the number of cells that a surface crosses estimates its area (Carr,
    Duffy and Denby, "On histograms and isosurface statistics", 2006). Its volume is spread evenly
    over these levels. Those of a cell of nearly one value are one bin wide. Values that are not
    finite are left out.

    low, high: range of the scalar in the cells that are drawn; 0 and 1 if is_empty, without any
    finite value. areas, volumes: by bin, BINS of them; all 0 if the scalar has one value. volume:
    of all these cells.
    """

    def __init__(self, data, name, association, component=None):
        lows, highs, volumes = [], [], []
        for leaf in leaves_of(data):
            attributes = leaf.GetPointData() if association == "points" else leaf.GetCellData()
            drawn = drawn_cells_of(leaf)
            if drawn.any() and attributes.HasArray(name):
                chosen = slice(None) if drawn.all() else drawn
                found = _measure(leaf, name, association, component, drawn)
                for column, part in zip((lows, highs, volumes), found):
                    column.append(part[chosen])
        joined = [parts[0] if len(parts) == 1 else numpy.concatenate([numpy.empty(0), *parts])
                  for parts in (lows, highs, volumes)]
        finite = numpy.isfinite(joined[0]) & numpy.isfinite(joined[1])
        self._collect(*(joined if finite.all() else [part[finite] for part in joined]))

    def _collect(self, lows, highs, volumes):
        self.is_empty = lows.size == 0
        self.low = float(lows.min()) if lows.size else 0.0
        self.high = float(highs.max()) if highs.size else 1.0
        self.volume = float(volumes.sum())
        width = (self.high - self.low) / BINS
        self.areas = numpy.zeros(BINS)
        self.volumes = numpy.zeros(BINS)
        if not lows.size or not 0.0 < width < numpy.inf:
            return
        # Changes of the areas and the volumes by bin, of each block.
        found = {}

        def count(begin, end):
            sizes = volumes[begin:end]
            first, last = ((values[begin:end] - self.low) / width for values in (lows, highs))
            length = numpy.clip(last - first, 1.0, BINS)
            first = numpy.clip(0.5 * (first + last - length), 0.0, BINS - length)
            last = numpy.minimum(first + length, BINS)  # which the sum may exceed by rounding
            found[begin] = (_find_changes(first, last, sizes ** (2.0 / 3.0)),
                            _find_changes(first, last, sizes / length))
        run_blocks(count, lows.size, _BLOCK_SIZE)
        self.areas, self.volumes = (
            numpy.maximum(numpy.cumsum(sum(parts)), 0.0)
            for parts in zip(*(found[begin] for begin in sorted(found))))

    def get_opacity(self, bounds=None):
        """Attenuation coefficients as pairs (scalar, coefficient), per diagonal of the mesh.

        Coefficients are inversely proportional to the area of a level, so that rare values show as
        much as frequent ones. They are scaled so that their mean over the volume makes a ray
        through a cube (1 / sqrt(3) of the diagonal) OPTICAL_DEPTH deep, and through a thin mesh
        one of find_reach(). bounds: of the mesh; default: those of a cube.
        """
        reach = 3 ** -0.5 if bounds is None else find_reach(bounds, self.volume)
        middle = OPTICAL_DEPTH / reach
        if self.areas.max() <= 0.0 or self.volumes.sum() <= 0.0:
            return [(self.low, middle), (max(self.high, self.low + 1e-6), middle)]
        shares = self.areas / self.areas.max()
        weights = 1.0 / (shares + FLOOR)
        # The most frequent value is transparent.
        weights -= weights.min() * min((1.0 - shares.min()) / _EVEN, 1.0)
        mean = (weights * self.volumes).sum() / self.volumes.sum()
        if mean > 0.0:
            weights *= middle / mean
        else:
            weights[:] = middle
        width = (self.high - self.low) / BINS
        return [(self.low + (bin + 0.5) * width, float(weight))
                for bin, weight in enumerate(weights)]

    def get_histogram(self, low, high):
        """Volumes of the mesh by value: BINS equal bins from low to high. The volume of a bin of
        this field is spread evenly over its values."""
        edges = numpy.linspace(self.low, self.high, BINS + 1)
        if not self.low < self.high:
            edges = edges + numpy.linspace(-0.5, 0.5, BINS + 1) * (high - low) / BINS
        below = numpy.concatenate([[0.0], numpy.cumsum(self.volumes)])
        if not below[-1] > 0.0:
            below = numpy.linspace(0.0, 1.0, BINS + 1)
        return numpy.diff(numpy.interp(numpy.linspace(low, high, BINS + 1), edges, below))

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
