# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Refracting surfaces and indices of refraction as arguments; needs no PyVista."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkCompositeDataSet, vtkDataObject, vtkPolyData)
from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter, vtkDataSetSurfaceFilter

from ..arguments import check_numbers
from ..vtkMeniscus import vtkRefractingInterface, vtkRefractingInterfaceCollection


def _make_triangles(points, triangles):
    """vtkPolyData of points, (n, 3), and triangles, (m, 3) indices of points."""
    points = numpy.ascontiguousarray(points, float)
    triangles = numpy.asarray(triangles)
    if points.ndim != 2 or points.shape[1] != 3 or triangles.ndim != 2 or triangles.shape[1] != 3:
        raise ValueError("A surface as arrays has points of the shape (n, 3) and triangles of the "
                         "shape (m, 3), not %s and %s" % (points.shape, triangles.shape))
    if triangles.size and not (0 <= triangles.min() and triangles.max() < len(points)):
        raise ValueError("A triangle of the surface uses a point that does not exist; there are %d"
                         % len(points))
    places = vtkPoints()
    places.SetData(numpy_to_vtk(points, deep=True))
    cells = vtkCellArray()
    offsets = numpy.arange(0, 3 * len(triangles) + 1, 3, dtype=numpy.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True), numpy_to_vtkIdTypeArray(
        numpy.ascontiguousarray(triangles, numpy.int64).ravel(), deep=True))
    surface = vtkPolyData()
    surface.SetPoints(places)
    surface.SetPolys(cells)
    return surface


def surface_of(data):
    """vtkPolyData of a dataset, of all blocks of one, or of arrays (points, triangles)."""
    if isinstance(data, vtkPolyData):
        return data
    if isinstance(data, vtkDataObject):
        composite = isinstance(data, vtkCompositeDataSet)
        surface = vtkCompositeDataGeometryFilter() if composite else vtkDataSetSurfaceFilter()
        surface.SetInputDataObject(data)
        surface.Update()
        return surface.GetOutput()
    if isinstance(data, tuple) and len(data) == 2:
        return _make_triangles(*data)
    raise TypeError("A surface is a dataset or a pair of arrays (points, triangles), not "
                    + type(data).__name__)


def _is_pair_of_arrays(surfaces):
    """Whether a tuple is one surface as arrays, and not two surfaces."""
    return (isinstance(surfaces, tuple) and len(surfaces) == 2
            and not any(isinstance(each, (vtkDataObject, tuple)) for each in surfaces))


def list_surfaces(surfaces):
    """List of the vtkPolyData of one surface or of several."""
    if isinstance(surfaces, (list, tuple)) and not _is_pair_of_arrays(surfaces):
        return [surface_of(each) for each in surfaces]
    return [surface_of(surfaces)]


def pair_indices(indices, count, before=1.0):
    """Pairs of the indices of refraction on the side of a surface's normals and behind it.

    indices: one number for one surface; or a number per surface, that behind it; or one more, all
    media, the eye's first; or a pair per surface. before: index of the eye's medium, if it is not
    among them.
    """
    is_list = hasattr(indices, "__len__") and not isinstance(indices, (str, bytes))
    indices = list(indices) if is_list else [indices]
    for each in indices:
        check_numbers("indices", each if hasattr(each, "__len__") else [each],
                      len(each) if hasattr(each, "__len__") else 1)
    if all(hasattr(each, "__len__") for each in indices):
        pairs = [tuple(map(float, each)) for each in indices]
    else:
        if len(indices) == count + 1:
            before, *indices = indices
        pairs = list(zip([before, *indices], indices))
    if len(pairs) != count or any(len(pair) != 2 for pair in pairs):
        raise ValueError("%d surfaces need %d indices of refraction (behind each), %d (all media, "
                         "the eye's first) or %d pairs" % (count, count, count + 1, count))
    for pair in pairs:
        for index in pair:
            if not 0.0 < index < float("inf"):
                raise ValueError("Indices of refraction must be above 0, not %g" % index)
    return pairs


def connect(target, surfaces, indices, before=1.0):
    """Sets the refracting surfaces of a filter or mapper."""
    surfaces = list_surfaces(surfaces)
    if not surfaces:
        raise ValueError("There must be at least one surface")
    pairs = pair_indices(indices, len(surfaces), before)
    target.RemoveAllMembranes()
    for surface in surfaces:
        target.AddMembraneData(surface)
    if len(pairs) == 1:
        target.SetExteriorIndexOfRefraction(pairs[0][0])
        target.SetInteriorIndexOfRefraction(pairs[0][1])
        return
    interfaces = vtkRefractingInterfaceCollection()
    for exterior, interior in pairs:
        interface = vtkRefractingInterface()
        interface.SetExteriorIndexOfRefraction(exterior)
        interface.SetInteriorIndexOfRefraction(interior)
        interfaces.AddItem(interface)
    target.SetInterfaces(interfaces)
