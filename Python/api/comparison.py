# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""VTK's volume mappers of unstructured meshes and ours, on one mesh."""
from __future__ import annotations

import numbers
from typing import TYPE_CHECKING, Any

import pyvista

from ..arguments import check_count, check_numbers
from ..names import choose
from ..rivals import MAPPERS, Comparison, compare_mappers, join_tetrahedra
from .scalars import Scalars
from .volumes import add_to

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .types import Array, Mesh


def compare(
    mesh: Mesh, /, scalars: str | Array | None = None, *, component: int | str | None = None,
    mappers: Sequence[str] = tuple(MAPPERS), size: Sequence[int] = (512, 512), frames: int = 3,
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
        choose("mapper", name, MAPPERS)
    check_count("frames", frames)
    check_numbers("size", size, 2, numbers.Integral)
    plotter = pyvista.Plotter(off_screen=True, window_size=list(size))
    try:
        plotter.set_background("black")
        volume = add_to(mesh, plotter, scalars, component=component, show_scalar_bar=False,
                        render=False, **arguments)
        if volume.mapper.blend_mode != "composite":
            raise ValueError("Only composite blending is compared: VTK's mappers have no other")
        plotter.camera_position = cpos or plotter.get_default_cam_pos()
        plotter.reset_camera()
        chosen = Scalars(pyvista.wrap(mesh), scalars, arguments.get("preference", "point"),
                         component)
        return [found for found, _ in compare_mappers(
            plotter.render_window, plotter.renderer, volume,
            lambda: join_tetrahedra(
                chosen.leaves, [chosen.get_values_of(index) for index in range(len(chosen.leaves))],
                chosen.in_points), chosen.in_points, mappers, frames)]
    finally:
        plotter.close()
