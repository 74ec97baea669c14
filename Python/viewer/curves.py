# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Curves of opacity: few points that can be dragged, and the functions that mappers take.

A curve is a list of points (place, opacity), linear between them. Places go from 0 at the lower to
1 at the upper end of the range of the colour map.
"""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, List, Tuple

import numpy

from .files import ReadingError

Curve = List[Tuple[float, float]]

# Length over which the opacities of a volume are given, as a share of the mesh's diagonal. An
# opacity of 1 would need an infinite attenuation coefficient; the largest one lets less than one
# step of 8 bits pass.
OPACITY_SHARE = 0.1
LARGEST_OPACITY = 1.0 - 1.0 / 512.0
# Coefficients are not linear between the points of a curve; so many pieces follow it.
_PIECES = 8
# A simplified curve has at most so many points, or so small an error, whichever comes first: more
# points would be too close for the mouse.
_POINTS = 12
_ERROR = 0.02


def check_curve(points: Sequence[Sequence[float]]) -> Curve:
    """The points in the order of their places, all within [0, 1]; fewer than two are a
    ReadingError, and so is a number that is not finite."""
    curve = sorted((min(1.0, max(0.0, float(place))), min(1.0, max(0.0, float(opacity))))
                   for place, opacity in points if math.isfinite(place) and math.isfinite(opacity))
    if len(curve) < 2 or len(curve) != len(points):
        raise ReadingError("A curve of opacity needs at least two points of finite numbers")
    return curve


def coefficient_of(opacity: float) -> float:
    """Attenuation coefficient per diagonal of the mesh with an opacity over a tenth of it."""
    return -math.log1p(-min(opacity, LARGEST_OPACITY)) / OPACITY_SHARE


def fill_function(function: Any, curve: Curve, limits: tuple[float, float], volume: bool) -> None:
    """Sets a vtkPiecewiseFunction of scalars to a curve over a range.

    volume: the function's values are attenuation coefficients; otherwise they are opacities.
    """
    low, high = limits
    places, opacities = zip(*curve)
    samples = {place for left, right in zip(places, places[1:])
               for place in numpy.linspace(left, right, _PIECES + 1 if volume else 2)}
    function.RemoveAllPoints()
    for place in sorted(samples):
        opacity = float(numpy.interp(place, places, opacities))
        value = coefficient_of(opacity) if volume else opacity
        function.AddPoint(low + place * (high - low), value)


def simplify(coefficients: Curve, limits: tuple[float, float]) -> Curve:
    """The curve of few points that is nearest to coefficients by scalar: from the ends on, the
    point with the largest error is added."""
    low, high = limits
    places = numpy.linspace(0.0, 1.0, 129)
    scalars, given = (numpy.array(column) for column in zip(*coefficients))
    values = numpy.interp(low + places * (high - low), scalars, given)
    opacities = -numpy.expm1(-values * OPACITY_SHARE)
    chosen = [0, places.size - 1]
    while len(chosen) < _POINTS:
        errors = abs(numpy.interp(places, places[chosen], opacities[chosen]) - opacities)
        if errors.max() < _ERROR:
            break
        chosen = sorted([*chosen, int(errors.argmax())])
    return [(float(places[index]), float(opacities[index])) for index in chosen]
