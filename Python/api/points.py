# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""True positions of points that are seen through refracting surfaces, as arrays; needs no PyVista
and no renderer."""
from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ..arguments import refuse
from ..data import run
from ..names import choose
from ..vtkMeniscus import vtkTriangulatedPositionFilter, vtkTruePositionFilter
from .surfaces import connect

if TYPE_CHECKING:
    from .types import Array, ArrayLike, Floats, Indices, Surfaces

_DEPTHS = {"apparent": vtkTruePositionFilter.APPARENT, "optical": vtkTruePositionFilter.OPTICAL,
           "geometric": vtkTruePositionFilter.GEOMETRIC}


class Triangulation(NamedTuple):
    """Points that triangulate() found; n is their number.

    positions: (n, 3) float64; NaN for points that were not found. ids: (n,) int64, ascending.
    rays: (n,) number of rays that were used. residuals: (n,) root of the mean square distance of
    the rays from the point. angles: (n,) largest angle between two rays, in degrees. states: (n,)
    0 found, 1 fewer than two rays, 2 parallel rays, 3 no medium that all rays reach.
    """

    positions: Floats
    ids: Array
    rays: Array
    residuals: Floats
    angles: Floats
    states: Array


def _as_floats(values, name):
    try:
        return numpy.ascontiguousarray(values, float)
    except (TypeError, ValueError):
        refuse(name, "an array of numbers", values)


def _as_coordinates(values, name):
    array = _as_floats(values, name)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError("%s must have the shape (n, 3), not %s" % (name, array.shape))
    return array


def _make_input(points, eyes):
    """vtkPolyData with the array Eye if there is an eye per point."""
    places = vtkPoints()
    places.SetData(numpy_to_vtk(points, deep=True))
    data = vtkPolyData()
    data.SetPoints(places)
    if eyes.ndim == 2:
        array = numpy_to_vtk(eyes, deep=True)
        array.SetName("Eye")
        data.GetPointData().AddArray(array)
    return data


def _as_eyes(eyes, points):
    """One eye, (3,), or one per point."""
    eyes = _as_floats(eyes, "eyes")
    if eyes.shape not in ((3,), points.shape):
        raise ValueError("eyes must have the shape (3,) or %s, not %s" % (
            points.shape, eyes.shape))
    return eyes


def true_positions(
    points: ArrayLike, eyes: ArrayLike, surfaces: Surfaces, indices: Indices = 1.333, *,
    depth: str = "apparent", return_states: bool = False,
) -> Floats | tuple[Floats, Array]:
    """True positions of points that are seen through refracting surfaces, such as under water.

    points: (n, 3), or (3,) for one: where the points are seen, in world coordinates.
    eyes: (3,), or (n, 3) with the eye of each point.
    surfaces: a dataset, or a pair of arrays (points, triangles) of the shapes (n, 3) and (m, 3); or
        a list of them in the order in which the sight rays meet them. Their normals, or the
        triangles' winding, point to the eyes' side. Surfaces are curved between their points.
    indices: index of refraction behind the surface, default 1.333; for several surfaces see
        meniscus.refracted().
    depth: meaning of the distance between eye and point, for a length a of the ray in front of the
        surface and b behind it: "apparent" a + b n1 / n2 (default: as the eye sees it), "optical"
        a + b n2 / n1 (laser scanners), "geometric" a + b.
    return_states: also returns (n,) uint8: 0 in front of the surface, not moved; 1 moved; 2 totally
        reflected; 3 not finite; 4 the ray misses one of several surfaces.

    Returns (n, 3), or (3,), float64; NaN for points without a true position, of the states 2 to 4.
    Raises ValueError for wrong shapes, indices and surfaces; a surface that no eye sees from its
    front is a RuntimeWarning.
    """
    seen = _as_floats(points, "points")
    single = seen.shape == (3,)
    seen = _as_coordinates(seen[None] if single else seen, "points")
    eyes = _as_eyes(eyes, seen)
    truth = vtkTruePositionFilter()
    truth.SetDepth(choose("depth", depth, _DEPTHS))
    connect(truth, surfaces, indices)
    positions, states = numpy.empty((0, 3)), numpy.empty(0, numpy.uint8)
    if len(seen):
        truth.SetInputData(_make_input(seen, eyes))
        if eyes.ndim == 2:
            truth.SetEyeArrayName("Eye")
        else:
            truth.SetEyePosition(*eyes)
        run(truth)
        output = truth.GetOutput()
        positions = vtk_to_numpy(output.GetPoints().GetData()).astype(float)
        states = vtk_to_numpy(output.GetPointData().GetArray("SeenState")).copy()
        positions[states > truth.REFRACTED] = numpy.nan
    result = positions[0] if single else positions
    return (result, states) if return_states else result


def triangulate(
    points: ArrayLike, eyes: ArrayLike, surfaces: Surfaces, indices: Indices = 1.333, *,
    ids: ArrayLike | None = None, details: bool = False,
) -> Floats | Triangulation:
    """Positions of points that several eyes, such as cameras, see through refracting surfaces.

    points: (cameras, n, 3): any place on the ray on which each camera sees each point, such as that
        of a pixel on the image plane; its distance does not matter. NaN where a camera does not see
        a point. With ids: (m, 3), one row per observation.
    eyes: (cameras, 3); with ids (m, 3), the eye of each observation. Eyes may be on different sides
        of a surface.
    surfaces, indices: as in meniscus.true_positions().
    ids: (m,) whole numbers: which point each observation sees. Default: points are numbered.
    details: returns a Triangulation, with residuals and angles.

    Returns (n, 3) float64: the points nearest to their refracted rays, by least squares; NaN where
    fewer than two rays meet, or rays are parallel. With ids, in the order of numpy.unique(ids).
    Raises ValueError for wrong shapes, indices and surfaces.
    """
    if ids is None:
        rays, cameras = _as_floats(points, "points"), _as_floats(eyes, "eyes")
        if rays.ndim != 3 or rays.shape[2] != 3 or cameras.shape != (len(rays), 3):
            raise ValueError("Without ids, points must have the shape (cameras, n, 3) and eyes "
                             "(cameras, 3), not %s and %s" % (rays.shape, cameras.shape))
        numbers = numpy.tile(numpy.arange(rays.shape[1]), len(rays))
        observers = numpy.repeat(cameras, rays.shape[1], axis=0)
        rays = numpy.ascontiguousarray(rays.reshape(-1, 3))
    else:
        rays = _as_coordinates(points, "points")
        observers, numbers = _as_floats(eyes, "eyes"), numpy.asarray(ids)
        if observers.shape != rays.shape or numbers.shape != (len(rays),):
            raise ValueError("With ids, points and eyes must have the shape (m, 3) and ids (m,), "
                             "not %s, %s and %s" % (rays.shape, observers.shape, numbers.shape))
        if numbers.size and numbers.dtype.kind not in "iu":
            raise ValueError("ids must be whole numbers, not " + str(numbers.dtype))
    found = vtkTriangulatedPositionFilter()
    connect(found, surfaces, indices)
    if not len(rays):
        none = numpy.empty(0)
        empty = Triangulation(numpy.empty((0, 3)), numpy.empty(0, numpy.int64), none, none, none,
                              none)
        return empty if details else empty.positions
    observations = _make_input(rays, observers)
    array = numpy_to_vtkIdTypeArray(numpy.ascontiguousarray(numbers, numpy.int64), deep=True)
    array.SetName("PointId")
    observations.GetPointData().AddArray(array)
    found.SetInputData(observations)
    found.SetEyeArrayName("Eye")
    run(found)
    output = found.GetOutput()
    columns = [vtk_to_numpy(output.GetPointData().GetArray(name)).copy() for name in (
        "PointId", "NumberOfRays", "Residual", "RayAngle", "TriangulationState")]
    positions = vtk_to_numpy(output.GetPoints().GetData()).astype(float)
    return Triangulation(positions, *columns) if details else positions
