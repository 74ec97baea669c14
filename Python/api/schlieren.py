# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Schlieren images, shadowgraphs and interferograms of a mesh, as arrays; needs no PyVista."""
from __future__ import annotations

from math import factorial
from typing import TYPE_CHECKING, Any

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

from ..arguments import check_count, check_finite, check_names, check_numbers
from ..media import cast, connect_medium
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
    rays = vtkTetrahedraSchlieren()
    connect_medium(rays, 0, "mesh", mesh, scalars, quantity)
    if "background" in check_names("image", image) and background is None:
        raise ValueError("The image 'background' needs a background")
    if background is not None:
        rays.SetInputData(1, _make_picture(background))
    return cast(rays, image, _IMAGES, size, direction, up, camera, properties)


def _find_orders(term):
    """Radial and azimuthal order of one of Noll's terms, from 1; negative for a sine."""
    radial = 0
    while (radial + 1) * (radial + 2) // 2 < term:
        radial += 1
    place = term - radial * (radial + 1) // 2
    azimuthal = 2 * (place // 2) if radial % 2 == 0 else 2 * ((place - 1) // 2) + 1
    return radial, azimuthal if term % 2 == 0 else -azimuthal


def _evaluate_zernike(term, radius, angle):
    """One of Noll's polynomials, whose mean square in the unit circle is 1."""
    n, azimuthal = _find_orders(term)
    m = abs(azimuthal)
    values = sum(
        (-1) ** s * factorial(n - s)
        / (factorial(s) * factorial((n + m) // 2 - s) * factorial((n - m) // 2 - s))
        * radius ** (n - 2 * s) for s in range((n - m) // 2 + 1))
    if m == 0:
        return (n + 1) ** 0.5 * values
    wave = numpy.cos if azimuthal > 0 else numpy.sin
    return (2 * (n + 1)) ** 0.5 * values * wave(m * angle)


def zernike(path: Any, terms: int = 15, *, pupil: Sequence[float] | None = None) -> Any:
    """Zernike coefficients of a wave front: piston, tilts, defocus, astigmatism, coma and so on.

    path: optical path differences, an array of two dimensions such as schlieren(mesh,
        image="optical_path_difference"). Pixels that are NaN have no part.
    terms: number of coefficients.
    pupil: column and row of the centre of a circle and its radius, in pixels, whose centres are at
        whole numbers; default: the largest circle in the image.

    Returns an array of coefficients in the unit of the path, by least squares over the pixels in
    the circle. Numbering and norm follow R. J. Noll, "Zernike polynomials and atmospheric
    turbulence", J. Opt. Soc. Am. 66, 207-211 (1976); the first entry is term 1, the piston. The
    polynomials have a mean square of 1 in the circle: the root of the sum of squares of all
    coefficients but the first is the RMS wave front error. Raises ValueError for a circle with
    fewer pixels than terms.
    """
    path = numpy.asarray(path, dtype=float)
    if path.ndim != 2:
        raise ValueError("A wave front has two dimensions, not %d" % path.ndim)
    check_count("terms", terms)
    rows, columns = path.shape
    if pupil is None:
        pupil = (columns - 1) / 2, (rows - 1) / 2, min(columns, rows) / 2
    check_numbers("pupil", pupil, 3)
    check_finite("pupil", pupil)
    column, row, reach = pupil
    if not reach > 0:
        raise ValueError("The radius of the pupil must be positive, not %g" % reach)
    y, x = numpy.mgrid[:rows, :columns]
    radius = numpy.hypot(x - column, y - row) / reach
    inside = (radius <= 1.0) & numpy.isfinite(path)
    if numpy.count_nonzero(inside) < terms:
        raise ValueError("The pupil has %d pixels, fewer than %d terms"
                         % (numpy.count_nonzero(inside), terms))
    angle = numpy.arctan2(y - row, x - column)[inside]
    shapes = [_evaluate_zernike(term, radius[inside], angle) for term in range(1, terms + 1)]
    return numpy.linalg.lstsq(numpy.column_stack(shapes), path[inside], rcond=None)[0]
