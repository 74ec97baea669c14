# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""VTK's volume mappers of unstructured meshes beside ours: times and differences of pictures."""
from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkRenderingCore import vtkVolumeProperty, vtkWindowToImageFilter
from vtkmodules.vtkRenderingVolume import (
    vtkProjectedTetrahedraMapper, vtkUnstructuredGridVolumeRayCastMapper,
    vtkUnstructuredGridVolumeZSweepMapper)

from .data import with_array

OURS = "meniscus"
MAPPERS = {
    "projected tetrahedra": vtkProjectedTetrahedraMapper,
    "ray cast": vtkUnstructuredGridVolumeRayCastMapper,
    "z sweep": vtkUnstructuredGridVolumeZSweepMapper,
}
_ARRAY = "compared"
# Degrees between frames, so that no mapper can show its last image again.
_TURN = 1.0


class Comparison(NamedTuple):
    """A mapper's figures.

    name: "meniscus", "projected tetrahedra", "ray cast" or "z sweep". milliseconds: median time of
    a frame from a new view. first_milliseconds: time of the first frame, with the mapper's set-up.
    rms: root mean square difference of the picture from meniscus's, in levels of 0 to 255, in
    the pixels in which one of them shows the mesh.
    """

    name: str
    milliseconds: float
    first_milliseconds: float
    rms: float


def join_tetrahedra(leaves: Sequence[Any], values: Sequence[Any], in_points: bool) -> Any:
    """The cells of data sets as one grid of tetrahedra.

    values: of each data set, a value of each point or cell; in_points says which.
    """
    joined = vtkAppendFilter()
    for leaf, numbers in zip(leaves, values):
        tetrahedra = vtkDataSetTriangleFilter()
        tetrahedra.SetInputData(with_array(leaf, _ARRAY, in_points, numbers))
        tetrahedra.TetrahedraOnlyOn()
        tetrahedra.Update()
        joined.AddInputData(tetrahedra.GetOutput())
    joined.Update()
    return joined.GetOutput()


def _make_mapper(name: str, grid: Any, in_points: bool) -> Any:
    mapper = MAPPERS[name]()
    mapper.SetInputData(grid)
    if in_points:
        mapper.SetScalarModeToUsePointFieldData()
    else:
        mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectScalarArray(_ARRAY)
    return mapper


def _time_frame(window: Any) -> float:
    begin = time.perf_counter()
    window.Render()
    window.WaitForCompletion()
    return 1000.0 * (time.perf_counter() - begin)


def _grab(window: Any) -> Any:
    """The picture of a window as an array of rows from below, columns, and colours."""
    window.Render()
    grabbed = vtkWindowToImageFilter()
    grabbed.SetInput(window)
    grabbed.ReadFrontBufferOff()
    grabbed.ShouldRerenderOff()
    grabbed.Update()
    width, height, _ = grabbed.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(grabbed.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[:, :, :3].copy()


def _measure(window: Any, camera: Any, frames: int) -> tuple[float, float, Any]:
    """Times of the first frame and of further ones, and the picture of the first view."""
    first = _time_frame(window)
    times = []
    for _ in range(frames):
        camera.Azimuth(_TURN)
        times.append(_time_frame(window))
    camera.Azimuth(-_TURN * frames)
    return first, statistics.median(times), _grab(window)


def _limit_opacities(look: Any) -> Any:
    """A copy of a volume property with opacities of at most 1, where VTK's mappers cut them off.
    Opacities and unit distance are divided by the largest opacity: the medium stays the same."""
    limited = vtkVolumeProperty()
    limited.DeepCopy(look)
    opacity = limited.GetScalarOpacity()
    node, largest = [0.0] * 4, 1.0
    for index in range(opacity.GetSize()):
        opacity.GetNodeValue(index, node)
        largest = max(largest, node[1])
    for index in range(opacity.GetSize()):
        opacity.GetNodeValue(index, node)
        node[1] /= largest
        opacity.SetNodeValue(index, node)
    limited.SetScalarOpacityUnitDistance(limited.GetScalarOpacityUnitDistance() / largest)
    return limited


def difference(first: Any, second: Any) -> float:
    """Root mean square of the difference of two pictures on a black background."""
    first, second = first.astype(float), second.astype(float)
    shown = numpy.maximum(first, second).max(axis=2) > 0.0
    return float(numpy.sqrt(numpy.mean((first - second)[shown] ** 2))) if shown.any() else 0.0


def compare_mappers(
    window: Any, renderer: Any, volume: Any, make_grid: Callable[[], Any], in_points: bool,
    mappers: Sequence[str] = tuple(MAPPERS), frames: int = 3,
) -> Iterator[tuple[Comparison, Any]]:
    """Draws a volume with its own mapper, which is ours, and then with VTK's.

    window, renderer: show nothing else, on black. make_grid: makes the mesh for VTK's mappers, by
    join_tetrahedra() with the same in_points. mappers: names in MAPPERS. frames: number of frames,
    each from another view, of which the median time is taken.

    Yields pairs of a Comparison and its picture, ours first; the picture is an array of rows from
    below, columns, and colours as uint8. In the end the volume has its mapper and its property
    again.
    """
    ours, look, camera = volume.GetMapper(), volume.GetProperty(), renderer.GetActiveCamera()
    adjusts, distance = ours.GetAutoAdjustSampleDistances(), ours.GetImageSampleDistance()
    try:
        ours.AutoAdjustSampleDistancesOff()
        ours.SetImageSampleDistance(1.0)
        first, median, reference = _measure(window, camera, frames)
        yield Comparison(OURS, median, first, 0.0), reference
        grid = make_grid()
        volume.SetProperty(_limit_opacities(look))
        for name in mappers:
            mapper = _make_mapper(name, grid, in_points)
            if hasattr(mapper, "AutoAdjustSampleDistancesOff"):
                mapper.AutoAdjustSampleDistancesOff()
            volume.SetMapper(mapper)
            first, median, picture = _measure(window, camera, frames)
            yield Comparison(name, median, first, difference(picture, reference)), picture
    finally:
        ours.SetAutoAdjustSampleDistances(adjusts)
        ours.SetImageSampleDistance(distance)
        volume.SetMapper(ours)
        volume.SetProperty(look)
