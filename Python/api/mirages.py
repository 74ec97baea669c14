# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Objects seen through a mesh that bends light; needs no PyVista."""
from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkPointSet

from ..arguments import check_dataset, check_name, check_names, check_numbers
from ..data import run
from ..media import cast, connect_medium
from ..names import set_properties
from ..vtkMeniscus import vtkApparentGeometryFilter, vtkTetrahedraMirage
from .surfaces import surface_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from vtkmodules.vtkRenderingCore import vtkTexture, vtkVolumeProperty

    from .types import Mesh, Surface

_IMAGES = {
    "color": "Color",
    "seen": "Seen",
    "cell_id": "CellId",
    "position": "Position",
    "depth": "Depth",
    "direction": "Direction",
    "rgba": "RGBA",
}


def mirage(
    mesh: Mesh, /, objects: Surface | None, scalars: str | None = None,
    image: str | Sequence[str] = "color", *, quantity: str = "density",
    texture: vtkTexture | None = None, volume: vtkVolumeProperty | None = None,
    volume_scalars: str | None = None,
    size: Sequence[int] = (256, 256), direction: Sequence[float] = (0.0, 0.0, -1.0),
    up: Sequence[float] = (0.0, 1.0, 0.0), camera: Any = None, **properties: Any,
) -> Any:
    """Picture of opaque objects in or behind a mesh that bends light, one ray per pixel.

    mesh: a dataset or all blocks of a pyvista.MultiBlock.
    objects: a dataset, whose active scalars are its colours; all blocks of a pyvista.MultiBlock; or
        a pair of arrays (points, triangles), of the shapes (n, 3) and (m, 3). None, with a volume,
        for no objects.
    scalars: name of an array of the mesh's points; default: the active scalars.
    image: "color" (default; red, green, blue), "seen" (0 background, 1 object, 2 a ray that stayed
        in the mesh), "cell_id" of the objects (-1 for none), "position" of the seen place (NaN for
        none), "depth" (its distance, NaN for none), "direction" of the ray at its end and, with a
        volume, "rgba", its premultiplied colour and opacity; or a list of them.
    quantity: meaning of the scalars, "density" of a gas or "refractive_index".
    texture: picture on the objects, at the texture coordinates of their points; its colours are
        multiplied by those of the scalars. pyvista.Texture is one.
    volume: property by which the mesh itself is seen along the bent rays, such as smoke or flames.
    volume_scalars: name of the array of points or cells that it maps; default: that of scalars.
    size: width and height of the image in pixels.
    direction, up: of parallel rays through the mesh's bounds, and the direction that is upward in
        the image; any lengths.
    camera: a camera whose rays are used instead; perspective or parallel.
    properties: properties of vtkTetrahedraMirage, such as LightDirection=(0, 0, -1).

    Returns an array of the shape (height, width), for color, position and direction (height,
    width, 3), with rows from below: matplotlib's imshow(origin="lower"). Colours are numpy.uint8.
    For several images, a dictionary by name. Lengths are in the mesh's unit. Raises ValueError for
    names that do not exist and input that cannot be used.
    """
    check_name("volume_scalars", volume_scalars)
    if volume is None and (volume_scalars or "rgba" in check_names("image", image)):
        raise ValueError('volume_scalars and the image "rgba" need a volume')
    rays = vtkTetrahedraMirage()
    connect_medium(rays, 0, "mesh", mesh, scalars, quantity)
    rays.SetTexture(texture)
    rays.SetVolumeProperty(volume)
    rays.SetVolumeArrayName(volume_scalars)
    if hasattr(objects, "GetOutputPort"):
        rays.SetObjectConnection(objects.GetOutputPort())
    elif objects is not None:
        rays.SetObjectData(objects if isinstance(objects, vtkDataSet) else surface_of(objects))
    return cast(rays, image, _IMAGES, size, direction, up, camera, properties)


def apparent(
    mesh: Mesh, /, medium: Mesh, eye: Any, scalars: str | None = None, *,
    quantity: str = "density", **properties: Any,
) -> Any:
    """Geometry that looks like a mesh seen through a medium that bends light.

    mesh: a dataset, or a filter whose output is one, such as a surface. Points without an image
        stay where they are.
    medium: a dataset or all blocks of a pyvista.MultiBlock, in which the index varies.
    eye: position, three coordinates in the mesh's unit, or a camera. The geometry is right for this
        position only.
    scalars: name of an array of the medium's points; default: the active scalars.
    quantity: meaning of the scalars, "density" of a gas or "refractive_index".
    properties: properties of vtkApparentGeometryFilter, such as SearchAngle=1.

    Returns a dataset with the cells and arrays of the mesh, and the point arrays NumberOfImages and
    ImageOrientation (-1 for a mirrored image); of PyVista if the mesh is. A RuntimeWarning counts
    the points with several images or none. Raises ValueError for input that cannot be used.
    """
    check_dataset("mesh", mesh)
    position = getattr(eye, "GetPosition", lambda: eye)()
    check_numbers("eye", position, 3)
    geometry = vtkApparentGeometryFilter()
    if hasattr(mesh, "GetOutputPort"):
        geometry.SetInputConnection(mesh.GetOutputPort())
    else:
        # Image data and composite data have no points of their own.
        geometry.SetInputDataObject(
            mesh if isinstance(mesh, vtkPointSet) else surface_of(mesh))
    connect_medium(geometry, 1, "medium", medium, scalars, quantity)
    geometry.SetEyePosition(*position)
    set_properties(geometry, properties)
    run(geometry)
    output = geometry.GetOutput()
    pyvista = sys.modules.get("pyvista")
    return pyvista.wrap(output) if pyvista and isinstance(
        mesh, (pyvista.DataSet, pyvista.MultiBlock)) else output
