# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""VTK's volume mappers of unstructured meshes and ours, on one mesh."""
from __future__ import annotations

import statistics
import time
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy
import pyvista
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkRenderingVolume import (
    vtkProjectedTetrahedraMapper, vtkUnstructuredGridVolumeRayCastMapper,
    vtkUnstructuredGridVolumeZSweepMapper)

from ..data import leaves_of
from ..names import choose
from .scalars import Scalars, copy_with
from .volumes import add_to

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .types import Array, Mesh

OURS = "meniscus"
_MAPPERS = {
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
    rms: root mean square difference of the picture from that of meniscus, in levels of 0 to 255, in
    the pixels in which one of them shows the mesh.
    """

    name: str
    milliseconds: float
    first_milliseconds: float
    rms: float


def _make_tetrahedra(scalars):
    """The mesh as one grid of tetrahedra with the array that is drawn."""
    copy = copy_with(scalars.mesh, _ARRAY, scalars.in_points, scalars.leaves,
                     [scalars.get_values_of(index) for index in range(len(scalars.leaves))])
    joined = vtkAppendFilter()
    for leaf in leaves_of(copy):
        tetrahedra = vtkDataSetTriangleFilter()
        tetrahedra.SetInputData(leaf)
        tetrahedra.TetrahedraOnlyOn()
        tetrahedra.Update()
        joined.AddInputData(tetrahedra.GetOutput())
    joined.Update()
    return joined.GetOutput()


def _make_mapper(name, grid, in_points):
    mapper = _MAPPERS[name]()
    mapper.SetInputData(grid)
    if in_points:
        mapper.SetScalarModeToUsePointFieldData()
    else:
        mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectScalarArray(_ARRAY)
    return mapper


def _time_frame(window):
    begin = time.perf_counter()
    window.Render()
    window.WaitForCompletion()
    return 1000.0 * (time.perf_counter() - begin)


def _measure(plotter, frames):
    """Times of the first frame and of further ones, and the picture of the first view."""
    window = plotter.render_window
    first = _time_frame(window)
    times = []
    for _ in range(frames):
        plotter.camera.Azimuth(_TURN)
        times.append(_time_frame(window))
    plotter.camera.Azimuth(-_TURN * frames)
    picture = plotter.screenshot(return_img=True)[:, :, :3].astype(float)
    return first, statistics.median(times), picture


def _difference(first, second):
    """Root mean square of the difference of two pictures on a black background."""
    shown = numpy.maximum(first, second).max(axis=2) > 0.0
    return float(numpy.sqrt(numpy.mean((first - second)[shown] ** 2))) if shown.any() else 0.0


def compare(
    mesh: Mesh, /, scalars: str | Array | None = None, *, component: int | str | None = None,
    mappers: Sequence[str] = tuple(_MAPPERS), size: Sequence[int] = (512, 512), frames: int = 3,
    cpos: Any = None, **arguments: Any,
) -> list[Comparison]:
    """Draws a mesh with VTK's volume mappers and with ours and compares times and pictures.

    mesh, scalars, component: as in meniscus.add_to(). VTK's mappers get the cells as tetrahedra.
    mappers: names of VTK's mappers: "projected tetrahedra", "ray cast" (Bunyk), "z sweep"; default:
        all. The last two can take minutes for a mesh of a million cells.
    size: width and height of the picture in pixels; every mapper has one ray or sample per pixel.
    frames: number of frames, each from another view, of which the median time is taken.
    cpos: camera position as pyvista.plot() takes it; default: PyVista's.
    arguments: arguments of meniscus.add_to() for composite blending, such as cmap, opacity, clim.

    Returns a list of Comparison, ours first. Nothing is shown and nothing is cached between calls.
    Raises ValueError for unknown names, and for what add_to() raises it.
    """
    for name in mappers:
        choose("mapper", name, _MAPPERS)
    if frames < 1:
        raise ValueError("There must be at least one frame")
    plotter = pyvista.Plotter(off_screen=True, window_size=list(size))
    try:
        plotter.set_background("black")
        volume = add_to(mesh, plotter, scalars, component=component, show_scalar_bar=False,
                        render=False, **arguments)
        if volume.mapper.blend_mode != "composite":
            raise ValueError("Only composite blending is compared: VTK's mappers have no other")
        ours = volume.mapper
        ours.AutoAdjustSampleDistancesOff()
        plotter.camera_position = cpos or plotter.get_default_cam_pos()
        plotter.reset_camera()
        first, median, reference = _measure(plotter, frames)
        found = [Comparison(OURS, median, first, 0.0)]
        chosen = Scalars(pyvista.wrap(mesh), scalars, arguments.get("preference", "point"),
                         component)
        grid = _make_tetrahedra(chosen)
        for name in mappers:
            mapper = _make_mapper(name, grid, chosen.in_points)
            if hasattr(mapper, "AutoAdjustSampleDistancesOff"):
                mapper.AutoAdjustSampleDistancesOff()
            volume.SetMapper(mapper)
            first, median, picture = _measure(plotter, frames)
            found.append(Comparison(name, median, first, _difference(picture, reference)))
        volume.SetMapper(ours)
    finally:
        plotter.close()
    return found
