# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Schlieren images, shadowgraphs and interferograms of a mesh, as arrays; needs no PyVista."""
from __future__ import annotations

import numbers
from typing import TYPE_CHECKING, Any

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData

from ..arguments import check_dataset, check_name, check_names, check_numbers
from ..data import run
from ..names import choose, set_properties
from ..vtkMeniscus import vtkTetrahedraSchlieren

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .types import Mesh

_IMAGES = {
    "schlieren": "Schlieren",
    "shadowgraph": "Shadowgraph",
    "interferogram": "Interferogram",
    "deflection": "Deflection",
    "optical_path_difference": "OpticalPathDifference",
    "displacement": "Displacement",
    "background": "Background",
}
_QUANTITIES = {"density": vtkTetrahedraSchlieren.DENSITY,
               "refractive_index": vtkTetrahedraSchlieren.REFRACTIVE_INDEX}


def _make_picture(values):
    """A vtkImageData of a two-dimensional array, with rows from below."""
    values = numpy.ascontiguousarray(values, dtype=numpy.float32)
    if values.ndim != 2:
        raise ValueError("A background has two dimensions, not %d" % values.ndim)
    picture = vtkImageData()
    picture.SetDimensions(values.shape[1], values.shape[0], 1)
    picture.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
    return picture


def schlieren(
    mesh: Mesh, /, scalars: str | None = None, image: str | Sequence[str] = "schlieren", *,
    quantity: str = "density", size: Sequence[int] = (256, 256),
    direction: Sequence[float] = (0.0, 0.0, -1.0), up: Sequence[float] = (0.0, 1.0, 0.0),
    camera: Any = None, background: Any = None, **properties: Any,
) -> Any:
    """Images that optical instruments make of light bent by a mesh, one ray per pixel.

    mesh: a dataset or all blocks of a pyvista.MultiBlock.
    scalars: name of an array of points; default: the active scalars.
    image: "schlieren" (default; light that passes a knife edge, from 0 to 1), "shadowgraph"
        (irradiance, 1 without a medium), "interferogram" (from 0 to 1), "deflection" (2 slopes),
        "optical_path_difference" (length), "displacement" (2, in pixels) and "background" (as seen
        through the mesh); or a list of them.
    quantity: meaning of the scalars, "density" of a gas or "refractive_index".
    size: width and height of the image in pixels.
    direction, up: of parallel rays through the mesh's bounds, and the direction that is upward in
        the image; any lengths.
    camera: a camera whose rays are used instead; perspective or parallel.
    background: grey values behind the mesh, an array of two dimensions with rows from below.
    properties: properties of vtkTetrahedraSchlieren, such as KnifeAngle=0 or ScreenDistance=2.

    Returns numpy.float32 of the shape (height, width), for deflection and displacement (height,
    width, 2), with rows from below: matplotlib's imshow(origin="lower"). For several images, a
    dictionary by name. Lengths are in the mesh's unit. Raises ValueError for names that do not
    exist and input that cannot be used.
    """
    check_dataset("mesh", mesh)
    check_name("scalars", scalars)
    check_numbers("size", size, 2, numbers.Integral)
    check_numbers("direction", direction, 3)
    check_numbers("up", up, 3)
    names = check_names("image", image)
    arrays = [choose("image", name, _IMAGES) for name in names]
    if "background" in names and background is None:
        raise ValueError("The image 'background' needs a background")
    rays = vtkTetrahedraSchlieren()
    if hasattr(mesh, "GetOutputPort"):
        rays.SetInputConnection(mesh.GetOutputPort())
    else:
        rays.SetInputData(mesh)
    if background is not None:
        rays.SetInputData(1, _make_picture(background))
    if scalars is not None:
        rays.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, scalars)
    rays.SetQuantity(choose("quantity", quantity, _QUANTITIES))
    rays.SetImageSize(*size)
    rays.SetDirection(*direction)
    rays.SetViewUp(*up)
    rays.SetCamera(camera)
    set_properties(rays, properties)
    run(rays)
    points = rays.GetOutput().GetPointData()
    found = {}
    for name, array in zip(names, arrays):
        values = vtk_to_numpy(points.GetArray(array))
        found[name] = values.reshape((size[1], size[0]) + values.shape[1:])
    return found[image] if isinstance(image, str) else found
