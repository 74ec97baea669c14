# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Integrals along rays and radiographs of a mesh, as arrays; needs no PyVista."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..arguments import check_names, take_number
from ..integrals import ARRAYS, ray_integral
from ..names import choose

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .types import Array, Indices, Mesh, Surfaces

# Quantities by name: integral, path_length, ..., rgba. Bins are radiograph()'s.
_QUANTITIES = {"".join("_" + letter.lower() if letter.isupper() and not name.isupper()
                       else letter.lower() for letter in name).lstrip("_"): name
               for name in ARRAYS if name != "EnergyBins"}


def _measure(mesh, arrays, scalars, component, size, direction, up, camera, surfaces, indices,
             **named):
    if camera is None:
        named.update(Direction=direction, ViewUp=up)
    return ray_integral(mesh, arrays, scalars=scalars, component=component, size=size,
                        camera=camera, surfaces=surfaces, indices=indices, **named)


def _is_list(value):
    return hasattr(value, "__len__") and not isinstance(value, (bytes, str))


def integral(
    mesh: Mesh, /, scalars: str | None = None, quantity: str | Sequence[str] = "integral", *,
    component: int | str | None = None, size: Sequence[int] = (256, 256),
    direction: Sequence[float] = (0.0, 0.0, -1.0), up: Sequence[float] = (0.0, 1.0, 0.0),
    camera: Any = None, surfaces: Surfaces | None = None, indices: Indices = 1.333,
    **properties: Any,
) -> Any:
    """Numbers that rays through a mesh measure, one ray per pixel, without a window.

    mesh: a dataset or all blocks of a pyvista.MultiBlock.
    scalars: name of an array of points or cells; default: the active scalars.
    quantity: "integral" of the scalar (default; scalar times length), "path_length" in cells,
        "minimum", "maximum", "minimum_depth", "maximum_depth" (distance at which it is reached),
        "first_depth", "last_depth" (distances of the mesh), "optical_depth", "rgba" (these two need
        VolumeProperty=); or a list of them.
    component: number of a component from 0, or "magnitude"; needed for an array with several.
    size: width and height of the image in pixels.
    direction, up: of parallel rays through the mesh's bounds, and the direction that is upward in
        the image; any lengths.
    camera: a camera whose rays are used instead; perspective or parallel.
    surfaces, indices: refracting surfaces on the way of the rays; see meniscus.refracted().
    properties: properties of vtkTetrahedraRayIntegral, such as CellDivision=1.

    Returns numpy.float32 of the shape (height, width), for rgba (height, width, 4), with rows from
    below: matplotlib's imshow(origin="lower"). For several quantities, a dictionary by name. Rays
    that miss the mesh have 0, or NaN for depths, minimum and maximum. Lengths are in the mesh's
    unit. Raises ValueError for names that do not exist and input that cannot be used.
    """
    names = check_names("quantity", quantity)
    arrays = [choose("quantity", name, _QUANTITIES) for name in names]
    found = _measure(mesh, arrays, scalars, component, size, direction, up, camera, surfaces,
                     indices, **properties)
    if isinstance(quantity, str):
        return found[arrays[0]]
    return {name: found[array] for name, array in zip(names, arrays)}


def radiograph(
    mesh: Mesh, /, scalars: str | None = None, attenuation: float | Sequence[float] = 1.0, *,
    intensity: float | Sequence[float] = 1.0, component: int | str | None = None,
    size: Sequence[int] = (256, 256), direction: Sequence[float] = (0.0, 0.0, -1.0),
    up: Sequence[float] = (0.0, 1.0, 0.0), camera: Any = None, **properties: Any,
) -> Array:
    """Radiograph of a mesh: the intensity of the rays behind it, I0 exp(-attenuation * integral).

    scalars: name of an array of points or cells, such as a density; default: the active scalars.
    attenuation: coefficient per unit of the scalar and of length, at least 0; default: 1. Several
        coefficients are energies of X-rays.
    intensity: I0, in front of the mesh, in any unit; default: 1. One number, or one per energy.
    mesh, component, size, direction, up, camera, properties: as in meniscus.integral(). A camera
        is the X-ray source and its view the detector.

    Returns numpy.float32 of the shape (height, width), or (height, width, energies) for several
    coefficients, with rows from below. Raises ValueError for input that cannot be used. A
    RuntimeWarning tells of coefficients so large that hardly any ray passes the mesh, and of
    negative scalars, which amplify rays.
    """
    several = _is_list(attenuation)
    coefficients: Any = attenuation if several else [attenuation]
    intensities: Any = intensity if _is_list(intensity) else [intensity] * len(coefficients)
    coefficients = [take_number("attenuation", each, least=0.0) for each in coefficients]
    intensities = [take_number("intensity", each, least=0.0) for each in intensities]
    if not len(coefficients) or len(intensities) != len(coefficients):
        raise ValueError("There must be one attenuation coefficient or more, and as many "
                         "intensities or one")
    bins = [(mu, 0.0, each) for mu, each in zip(coefficients, intensities)]
    found = _measure(mesh, ["EnergyBins"], scalars, component, size, direction, up, camera, None,
                     1.333, bins=bins, **properties)["EnergyBins"]
    return found.reshape(*found.shape[:2], len(bins)) if several else found
