# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The part of a volume that is seen in a pixel."""
from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ..arguments import check_dataset, check_plotter, take_number
from ..names import choose
from ..vtkMeniscus import vtkTetrahedraVolumePicker
from .mapper import TetrahedraRayCastMapper

if TYPE_CHECKING:
    import pyvista

    from .types import Mesh

_PLACES = {"first_visible": vtkTetrahedraVolumePicker.FIRST_VISIBLE,
           "opacity_reached": vtkTetrahedraVolumePicker.OPACITY_REACHED,
           "largest_contribution": vtkTetrahedraVolumePicker.LARGEST_CONTRIBUTION}


class Pick(NamedTuple):
    """A place in a volume.

    value: the scalar; of several arrays, the array that gives the opacity. position: in world
    coordinates; behind refracting surfaces the true place. cell_id: cell of the dataset. block:
    flat index of the dataset in a MultiBlock, otherwise -1. surface: index of the isosurface,
    otherwise -1. depth: distance from the camera along the ray.
    """

    value: float
    position: tuple[float, float, float]
    cell_id: int
    block: int
    surface: int
    depth: float


def _volumes_of(mesh, plotter):
    """Volumes that add_to() has made of a mesh in a plotter's active renderer."""
    return [actor for actor in plotter.renderer.actors.values()
            if isinstance(getattr(actor, "mapper", None), TetrahedraRayCastMapper)
            and actor.mapper.source is mesh]


def pick(
    mesh: Mesh, /, plotter: pyvista.Plotter, x: float, y: float, *,
    place: str = "largest_contribution", opacity: float = 0.5,
) -> Pick | None:
    """The part of a mesh that is seen in a pixel, or None where the mesh is not seen.

    mesh: a mesh that add_to() has added to the plotter.
    plotter: pyvista.Plotter; of several subplots, the active one.
    x, y: pixel of the window, from its lower left corner: plotter.mouse_position.
    place: "largest_contribution" to the pixel (default), "first_visible", or "opacity_reached",
        where the accumulated opacity reaches `opacity`, from 0 to 1.

    Returns a Pick. Raises ValueError if the plotter does not show the mesh as a volume, and for
    another name of a place.
    """
    check_dataset("mesh", mesh)
    check_plotter(plotter)
    x, y = take_number("x", x), take_number("y", y)
    opacity = take_number("opacity", opacity, least=0.0, most=1.0)
    volumes = _volumes_of(mesh, plotter)
    if not volumes:
        raise ValueError("The plotter does not show this mesh as a volume: mesh.meniscus.add_to("
                         "plotter) adds it")
    picker = vtkTetrahedraVolumePicker()
    picker.SetPlace(choose("place", place, _PLACES))
    picker.SetOpacityThreshold(opacity)
    picker.PickFromListOn()
    for volume in volumes:
        picker.AddPickList(volume)
    if not picker.Pick(x, y, 0.0, plotter.renderer):
        return None
    return Pick(picker.GetValue(), tuple(picker.GetPickPosition()), picker.GetCellId(),
                picker.GetFlatBlockIndex(), picker.GetSurfaceIndex(), picker.GetDepth())
