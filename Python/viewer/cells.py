# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Cells of a mesh: those that are drawn, and damaged ones."""
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules import vtkCommonDataModel as model
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    VTK_POLYHEDRON, vtkDataSetAttributes, vtkGenericCell, vtkImageData, vtkPolyData,
    vtkRectilinearGrid, vtkStructuredGrid, vtkUnstructuredGrid)

from ..data import leaves_of
from .files import ReadingError

_STRUCTURED = (vtkImageData, vtkRectilinearGrid, vtkStructuredGrid)
# Cells with one of these bits in the array vtkGhostType are not drawn.
_LEFT_OUT = (vtkDataSetAttributes.DUPLICATECELL | vtkDataSetAttributes.HIDDENCELL
             | vtkDataSetAttributes.REFINEDCELL)
_FACE = "a face of a polyhedron"


# VTK 9.6 has new names for these; the old ones warn there.
_CellNames = getattr(model, "vtkCellTypeUtilities", model.vtkCellTypes)


def _read_types(grid):
    """Array of the types of a grid's cells; None if there are no cells."""
    if not hasattr(model, "vtkCellTypeUtilities"):
        return grid.GetCellTypesArray()
    if grid.GetCellTypes() is None:
        return None
    types = vtkUnsignedCharArray()  # a grid of one type may have a constant instead of an array
    types.DeepCopy(grid.GetCellTypes())
    return types


def types_of(leaf):
    """Type of each cell, as an array."""
    if isinstance(leaf, vtkUnstructuredGrid):
        types = _read_types(leaf)
        return vtk_to_numpy(types) if types else numpy.empty(0, numpy.uint8)
    if isinstance(leaf, vtkPolyData):
        return numpy.array([leaf.GetCellType(cell) for cell in range(leaf.GetNumberOfCells())],
                           numpy.uint8)
    # All cells of structured data have one type.
    first = leaf.GetCell(0).GetCellType() if leaf.GetNumberOfCells() else 0
    return numpy.full(leaf.GetNumberOfCells(), first, numpy.uint8)


def kinds_in(types):
    """The different types of cells."""
    if types.size and (types == types[0]).all():
        return types[:1]
    return numpy.flatnonzero(numpy.bincount(types, minlength=256))


def _is_solid(kind):
    cell = vtkGenericCell()
    cell.SetCellType(int(kind))
    return cell.GetCellDimension() == 3


def solid_cells_of(leaf):
    """True for each cell with a volume."""
    if isinstance(leaf, _STRUCTURED):
        return numpy.full(leaf.GetNumberOfCells(), has_solid_cells(leaf))
    types = types_of(leaf)
    solid = numpy.zeros(256, bool)
    for kind in kinds_in(types):
        solid[kind] = _is_solid(kind)
    return solid[types]


def has_solid_cells(leaf):
    """Whether a data set has cells with a volume."""
    if isinstance(leaf, _STRUCTURED):
        return leaf.GetDataDimension() == 3 and leaf.GetNumberOfCells() > 0
    return any(_is_solid(kind) for kind in kinds_in(types_of(leaf)))


def _corners_in(grid, values):
    """Values of the points of structured data with solid cells at the 8 corners of each cell: an
    iterable of arrays with the shape of the cells."""
    extent = grid.GetExtent()  # VTK 9.7's structured grids return no dimensions
    across, along, up = (extent[2 * axis + 1] - extent[2 * axis] + 1 for axis in range(3))
    values = values.reshape(up, along, across)
    return (values[z:up - 1 + z, y:along - 1 + y, x:across - 1 + x]
            for z in (0, 1) for y in (0, 1) for x in (0, 1))


def _has_flags(leaf):
    """Whether cells may be left out by flags of theirs, or by those of points of structured
    data."""
    return bool(leaf.GetCellGhostArray() or (
        isinstance(leaf, _STRUCTURED) and leaf.GetPointGhostArray()))


def drawn_cells_of(leaf):
    """True for each cell with a volume that is neither hidden, by itself or a point of structured
    data, nor shown by a cell of another data set."""
    drawn = solid_cells_of(leaf)
    if not drawn.any() or not _has_flags(leaf):
        return drawn
    ghosts = leaf.GetCellGhostArray()
    if ghosts:
        drawn &= vtk_to_numpy(ghosts) & _LEFT_OUT == 0
    ghosts = leaf.GetPointGhostArray()
    if ghosts and isinstance(leaf, _STRUCTURED):
        for flags in _corners_in(leaf, vtk_to_numpy(ghosts)):
            drawn &= flags.ravel() & vtkDataSetAttributes.HIDDENPOINT == 0
    return drawn


def drawn_points_of(leaf):
    """True for each point of a cell that is drawn."""
    points = leaf.GetNumberOfPoints()
    if isinstance(leaf, _STRUCTURED) and has_solid_cells(leaf) and _has_flags(leaf):
        drawn = numpy.full(points, False)
        cells = drawn_cells_of(leaf)
        for corners in _corners_in(leaf, drawn):
            corners |= cells.reshape(corners.shape)
        return drawn
    if not isinstance(leaf, vtkUnstructuredGrid):
        return numpy.full(points, True)
    ids = vtk_to_numpy(leaf.GetCells().GetConnectivityArray())
    sizes = numpy.diff(vtk_to_numpy(leaf.GetCells().GetOffsetsArray()))
    ids = ids[numpy.repeat(drawn_cells_of(leaf), sizes)]
    drawn = numpy.full(points, False)
    drawn[ids[(ids >= 0) & (ids < points)]] = True
    return drawn


def drawn_leaves_of(data):
    """The data sets with at least one cell that is drawn."""
    return [leaf for leaf in leaves_of(data)
            if (drawn_cells_of(leaf).any() if _has_flags(leaf) else has_solid_cells(leaf))]


def _count_types(leaves):
    """Text such as '12 Triangle, 3 Line'."""
    counts = {}
    for leaf in leaves:
        for kind, count in zip(*numpy.unique(types_of(leaf), return_counts=True)):
            counts[int(kind)] = counts.get(int(kind), 0) + int(count)
    return ", ".join(f"{count} {_CellNames.GetClassNameFromTypeId(kind).replace('vtk', '', 1)}"
                     for kind, count in sorted(counts.items()))


def _check_ids(ids, points, what, of="point"):
    if ids.size and (ids.min() < 0 or ids.max() >= points):
        wrong = (ids < 0) | (ids >= points)
        raise ReadingError(f"The mesh is damaged: {what} uses {of} {ids[wrong][0]}, but there "
                           f"are {points} {of}s")


def _check_cells(cells, points, what="a cell", of="point"):
    """Checks a vtkCellArray of a mesh with a number of points, or of what `of` names; None has no
    cells."""
    if cells is None:
        return
    ids = vtk_to_numpy(cells.GetConnectivityArray())
    offsets = vtk_to_numpy(cells.GetOffsetsArray())
    if offsets.size and (offsets[0] != 0 or (offsets[1:] < offsets[:-1]).any()
                         or offsets[-1] > ids.size):
        raise ReadingError("The mesh is damaged: the offsets of the cells are not ascending "
                           f"numbers up to {ids.size}, the number of point indices")
    _check_ids(ids, points, what, of)


def _check_faces(grid):
    """Checks the faces of polyhedra."""
    has_arrays = hasattr(grid, "GetPolyhedronFaces")  # VTK 9.4
    faces, places = ((grid.GetPolyhedronFaces(), grid.GetPolyhedronFaceLocations()) if has_arrays
                     else (grid.GetFaces(), grid.GetFaceLocations()))
    polyhedra = numpy.flatnonzero(types_of(grid) == VTK_POLYHEDRON)
    if polyhedra.size and not (faces and places):
        raise ReadingError(f"The mesh is damaged: its {polyhedra.size} polyhedra have no faces")
    if has_arrays:
        if polyhedra.size:
            _check_cells(faces, grid.GetNumberOfPoints(), _FACE)
            _check_cells(places, faces.GetNumberOfCells(), "a polyhedron", "face")
            if places.GetNumberOfCells() != grid.GetNumberOfCells():
                raise ReadingError("The mesh is damaged: it has the faces of "
                                   f"{places.GetNumberOfCells()} cells, but there are "
                                   f"{grid.GetNumberOfCells()}")
        return
    stream, points = vtk_to_numpy(faces) if polyhedra.size else None, grid.GetNumberOfPoints()
    for cell in polyhedra:
        place = places.GetValue(int(cell)) + 1
        for _ in range(stream[place - 1] if 0 < place <= stream.size else 0):
            size = stream[place] if place < stream.size else stream.size
            if not 0 <= size < stream.size - place:
                raise ReadingError(f"The mesh is damaged: the faces of cell {cell} are incomplete")
            _check_ids(stream[place + 1:place + 1 + size], points, _FACE)
            place += size + 1


def _check_arrays(leaf):
    """Checks that arrays have a value for each point or cell."""
    for kind, attributes, size in (("points", leaf.GetPointData(), leaf.GetNumberOfPoints()),
                                   ("cells", leaf.GetCellData(), leaf.GetNumberOfCells())):
        for index in range(attributes.GetNumberOfArrays()):
            array = attributes.GetArray(index)
            if array is not None and array.GetNumberOfTuples() != size:
                raise ReadingError(f"The mesh is damaged: the array '{array.GetName()}' has "
                                   f"{array.GetNumberOfTuples()} values for {size} {kind}")
        ghosts = attributes.GetArray(vtkDataSetAttributes.GhostArrayName())
        if ghosts is not None and ghosts.GetNumberOfComponents() != 1:
            raise ReadingError(f"The mesh is damaged: the array '{ghosts.GetName()}' of {kind} has "
                               f"{ghosts.GetNumberOfComponents()} components")


def _check_axes(grid):
    """Checks that a rectilinear grid has a coordinate for each point of an axis. Readers fill up
    missing ones with anything."""
    axes = (grid.GetXCoordinates(), grid.GetYCoordinates(), grid.GetZCoordinates())
    for axis, coordinates, size in zip("xyz", axes, grid.GetDimensions()):
        found = coordinates.GetNumberOfTuples() if coordinates else 0
        if found != size:
            raise ReadingError(f"The mesh is damaged: it has {found} coordinates for {size} points "
                               f"along {axis}")
        steps = numpy.diff(vtk_to_numpy(coordinates).astype(float))
        if not ((steps >= 0.0).all() or (steps <= 0.0).all()):
            raise ReadingError(f"The mesh is damaged: its coordinates along {axis} do not ascend: "
                               "some are missing or wrong")


def check_damage(data):
    """Raises a ReadingError for indices that are out of range and arrays of a wrong size."""
    for leaf in leaves_of(data):
        if isinstance(leaf, vtkUnstructuredGrid):
            if types_of(leaf).size != leaf.GetNumberOfCells():
                raise ReadingError(f"The mesh is damaged: it has {types_of(leaf).size} types for "
                                   f"{leaf.GetNumberOfCells()} cells")
            _check_cells(leaf.GetCells(), leaf.GetNumberOfPoints())
            _check_faces(leaf)
        elif isinstance(leaf, vtkPolyData):
            for cells in (leaf.GetVerts(), leaf.GetLines(), leaf.GetPolys(), leaf.GetStrips()):
                _check_cells(cells, leaf.GetNumberOfPoints())
        elif isinstance(leaf, vtkRectilinearGrid):
            _check_axes(leaf)
        _check_arrays(leaf)


def check_drawable(data):
    """Raises a ReadingError if nothing can be drawn as a volume."""
    leaves = leaves_of(data)
    if not any(leaf.GetNumberOfCells() for leaf in leaves):
        raise ReadingError("The mesh has no cells")
    if not any(has_solid_cells(leaf) for leaf in leaves):
        raise ReadingError("The mesh has no cells with a volume; its cells are: "
                           + _count_types(leaves))
    if not drawn_leaves_of(data):
        raise ReadingError("All cells with a volume are hidden, refined or duplicates, by the "
                           "array vtkGhostType")
