# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A schlieren photograph of the warm air above a candle."""
import math

import meniscus
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkStructuredGrid
from vtkmodules.vtkRenderingCore import vtkCamera

RADIUS = 0.09  # of the round window, in metres
WICK = -0.052  # height of the wick above the window's middle
CANDLE = 0.011  # radius
SINE, COSINE = math.sin(0.45), math.cos(0.45)
KNIFE = 9e-4  # deflection from none of the light to all of it, in radians


def get_warmth(x, y, z):
    """Temperature above the room's, in 300 K, at heights y above the wick: a laminar plume that
    becomes unstable and rolls up."""
    height = numpy.maximum(y, 0.0)
    growth = numpy.clip((height - 0.02) / 0.08, 0.0, 1.0) ** 1.5
    for scale, wave, phase in ((0.0070, 95.0, 0.4), (0.0035, 210.0, 1.9), (0.0018, 420.0, 4.1)):
        swirl = wave * y + 0.5 * wave * z + phase
        x, z = (x + scale * growth * numpy.sin(swirl + 0.8 * wave * x),
                z + scale * growth * numpy.cos(1.13 * swirl - 0.7 * wave * x))
    width = 0.0055 + 0.055 * height
    column = numpy.exp(-(x * x + z * z) / width ** 2) * 0.0055 / width
    return 3.0 * column / (1.0 + numpy.exp(-(y + 0.002) / 0.002))


def make_air(cells):
    """Densities in kg/m^3 on a curvilinear grid that widens upwards with the plume."""
    across = numpy.linspace(-1.0, 1.0, cells + 1)
    across = 0.6 * across + 0.4 * across ** 3
    up = numpy.linspace(-0.045, RADIUS - WICK + 0.005, 3 * cells + 1)
    z, y, x = numpy.meshgrid(across, up, across, indexing="ij")
    half = 0.024 + 0.22 * numpy.maximum(y, 0.0)
    # Turned, so that the rays pass the cells of a row at different places.
    x, z = half * (x * COSINE - z * SINE), half * (x * SINE + z * COSINE)
    grid = vtkStructuredGrid()
    grid.SetDimensions(x.shape[::-1])
    places = vtkPoints()
    places.SetData(numpy_to_vtk(numpy.stack([x, y + WICK, z], axis=-1).reshape(-1, 3), deep=True))
    grid.SetPoints(places)
    density = numpy_to_vtk((1.2 / (1.0 + get_warmth(x, y, z))).ravel(), deep=True)
    density.SetName("density")
    grid.GetPointData().SetScalars(density)
    return grid


def make_camera():
    """Parallel rays through the round window."""
    camera = vtkCamera()
    camera.ParallelProjectionOn()
    camera.SetPosition(0.0, 0.0, 1.0)
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    camera.SetParallelScale(RADIUS)
    return camera


def draw_schlieren(_, size):
    """The light that passes a vertical knife edge, with candle and flame, in a round window."""
    height = size[1]
    side = int(0.96 * height) // 2 * 2
    cells = 24 if height < 200 else 64
    image = meniscus.schlieren(make_air(cells), "density", size=(side, side),
                               camera=make_camera(), KnifeAngle=0.0, KnifeRange=KNIFE)
    axis = (numpy.arange(side) + 0.5) / side * 2.0 - 1.0
    radius = numpy.hypot(*numpy.meshgrid(axis, axis))
    x, y = numpy.meshgrid(RADIUS * axis, RADIUS * axis - WICK)
    pixel = 2.0 * RADIUS / side
    flame_width = 0.0042 * numpy.sqrt(numpy.clip((y + 0.001) / 0.006, 0.0, 1.0)) * numpy.clip(
        (0.021 - y) / 0.017, 0.0, 1.0) ** 0.8
    flame = numpy.clip((flame_width - abs(x)) / 0.0012, 0.0, 1.0)
    image = image + 0.7 * flame
    solid = numpy.maximum(numpy.where(y < -0.006, CANDLE, 0.0006 * (y < 0.002)) - abs(x), -pixel)
    image = image * numpy.clip(0.5 - solid / pixel, 0.03, 1.0)
    window = numpy.clip((1.0 - radius) * side / 2, 0.0, 1.0)
    image = image * (1.05 - 0.2 * radius ** 2) * window + (1.0 - window) * 0.02
    picture = numpy.full((height, size[0]), 0.02)
    bottom, left = (height - side) // 2, (size[0] - side) // 2
    picture[bottom:bottom + side, left:left + side] = image
    tone = numpy.clip(255.0 * picture[..., None] * (1.0, 0.985, 0.94), 0, 255)
    result = vtkImageData()
    result.SetDimensions(size[0], height, 1)
    result.GetPointData().SetScalars(
        numpy_to_vtk(tone.astype(numpy.uint8).reshape(-1, 3), deep=True))
    return result

