# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A ball of glass on a table of wood, and the light that it focuses there."""
import math

import meniscus
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkSphere
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkTexture

from . import common
from .pools import make_sky, mix

SUN = (-0.72, 0.40, 0.58)
RADIUS = 1.0
INDEX = 1.5
HALF = 7  # of the table's width
LIT = (-0.6, 3.6, -2.6, 1.6)  # part of the table with the ball's light: x0, x1, y0, y1


def noise(x, y, seed):
    """Smooth noise of [-1, 1] with details of length 1."""
    i, j = numpy.floor(x), numpy.floor(y)
    s, t = x - i, y - j
    s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)

    def corner(a, b):
        return 2.0 * numpy.modf(numpy.abs(
            numpy.sin((i + a) * 12.9898 + (j + b) * 78.233 + seed) * 43758.5453))[0] - 1.0

    return ((1 - s) * (1 - t) * corner(0, 0) + s * (1 - t) * corner(1, 0) +
            (1 - s) * t * corner(0, 1) + s * t * corner(1, 1))


def get_wood(x, y):
    """Colours of light planks along x."""
    plank = numpy.floor(y / 1.4)
    shift = 37.0 * numpy.modf(numpy.abs(numpy.sin(plank * 91.7) * 4375.85))[0]
    bend = 0.35 * noise(0.35 * x + shift, 0.8 * y, 3.0)
    rings = numpy.sin(17.0 * (y + bend) + 4.0 * noise(0.5 * x + shift, 2.2 * y, 5.0))
    grain = noise(2.5 * x + shift, 60.0 * y, 7.0) + 0.6 * noise(7.0 * x, 150.0 * y, 9.0)
    shade = 1.0 + 0.03 * rings + 0.03 * grain + 0.05 * noise(plank, plank * 0 + 0.5, 11.0)
    gap = numpy.abs(numpy.modf(numpy.abs(y) / 1.4 + (y < 0) * 0.0)[0] - 0.5) > 0.493
    shade = numpy.where(gap, 0.6 * shade, shade)
    tint = numpy.stack(
        [numpy.full_like(x, 0.84), 0.58 + 0.02 * rings, 0.33 + 0.03 * rings], axis=-1)
    return tint * shade[..., None]


def make_ball():
    ball = vtkSphereSource()
    ball.SetRadius(RADIUS)
    ball.SetCenter(0.0, 0.0, RADIUS)
    ball.SetThetaResolution(120)
    ball.SetPhiResolution(60)
    ball.Update()
    return ball.GetOutput()


def list_interfaces():
    """Into the ball and out of it again."""
    exact = vtkSphere()
    exact.SetRadius(RADIUS)
    exact.SetCenter(0.0, 0.0, RADIUS)
    glasses = meniscus.vtkRefractingInterfaceCollection()
    for _ in range(2):
        glasses.AddInterface(1.0, INDEX).SetExactSurface(exact)
    return glasses


def get_direct(x, y):
    """The sun's light on the table beside the ball: 0 in its shadow."""
    sun = numpy.asarray(SUN) / numpy.linalg.norm(SUN)
    center = numpy.array((0.0, 0.0, RADIUS))
    to_center = center - numpy.stack([x, y, 0.0 * x], axis=-1)
    along = to_center @ sun
    distance = numpy.sqrt(numpy.maximum((to_center ** 2).sum(axis=-1) - along ** 2, 0.0))
    return sun[2] * numpy.clip((distance - RADIUS) / 0.02 + 0.5, 0.0, 1.0)


def get_focused(cells):
    """The light that the ball sends to the part LIT of the table, as an array of cells."""
    x0, x1, y0, y1 = LIT
    light = meniscus.vtkRefractedLightFilter()
    light.SetInputData(common.make_plane((x0, y0, 0), (x1, y0, 0), (x0, y1, 0), (cells, cells)))
    light.SetLightPosition(*SUN)
    light.SetInterfaces(list_interfaces())
    ball = make_ball()
    for _ in range(2):
        light.AddMembraneData(ball)
    light.Update()
    array = light.GetOutput().GetCellData().GetArray("RefractionIrradiance")
    return vtk_to_numpy(array).reshape(cells, cells)


def make_texture(fineness):
    """The table's wood times its light, bright light compressed; `fineness` texels per unit."""
    texels = 2 * HALF * fineness
    x = (numpy.arange(texels) + 0.5) / fineness - HALF
    x, y = numpy.meshgrid(x, x)
    sky = 0.42 * numpy.clip(1.0 - 0.75 / (1.0 + (x * x + y * y) / 0.35), 0.0, 1.0)
    light = get_direct(x, y)
    column, end, row, top = (round(fineness * (HALF + place)) for place in LIT)
    light[row:top, column:end] += get_focused(end - column)
    color = get_wood(x, y) * (0.95 * light + sky)[..., None]
    color = 0.9 - 0.9 * numpy.exp(-1.9 * color) + 0.1 * numpy.log1p(color) / math.log(100.0)
    image = vtkImageData()
    image.SetDimensions(texels, texels, 1)
    values = numpy.clip(255.0 * color, 0, 255).astype(numpy.uint8).reshape(-1, 3)
    image.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))
    texture = vtkTexture()
    texture.SetInputData(image)
    texture.InterpolateOn()
    texture.EdgeClampOn()
    texture.MipmapOn()
    return texture


def get_studio(direction):
    """Colour of the surroundings: a white ceiling with a window, above a light horizon."""
    x, y, z = (c / math.sqrt(sum(v * v for v in direction)) for c in direction)
    color = mix((0.93, 0.93, 0.94), (0.70, 0.76, 0.84), min(max(z, 0.0) * 1.3, 1.0))
    sun = (x * SUN[0] + y * SUN[1] + z * SUN[2]) / math.sqrt(sum(c * c for c in SUN))
    if z < 0:
        return (0.62, 0.50, 0.36)
    return (1.0, 1.0, 1.0) if sun > 0.94 else color


def draw_glass(_data, size):
    """The ball, its caustic, and the table as seen through the ball."""
    texture = make_texture(25 if size[1] < 200 else 200)
    renderer = common.make_renderer(((0.93, 0.93, 0.94), (0.80, 0.84, 0.89)))
    refraction = meniscus.vtkRefractionPass()
    refraction.SetReflectionTexture(make_sky(64, get_studio))
    renderer.SetPass(refraction)
    surface = vtkActor()
    surface.SetMapper(vtkPolyDataMapper())
    ball = make_ball()
    surface.GetMapper().SetInputData(ball)
    table = common.make_plane((-HALF, -HALF, 0), (HALF, -HALF, 0), (-HALF, HALF, 0), (56, 56))
    seen = common.make_actor(table)
    refracted = meniscus.vtkRefractedGeometryFilter()
    refracted.SetInputData(table)
    refracted.SetInterfaces(list_interfaces())
    for _ in range(2):
        refracted.AddMembraneData(ball)
    refracted.SetCamera(renderer.GetActiveCamera())
    refracted.SetAngularTolerance(0.05)
    behind = vtkActor()
    behind.SetMapper(vtkPolyDataMapper())
    behind.GetMapper().SetInputConnection(refracted.GetOutputPort())
    behind.GetMapper().ScalarVisibilityOff()
    for actor in (seen, behind):
        actor.SetTexture(texture)
        actor.GetProperty().LightingOff()
    renderer.AddActor(seen)
    refraction.AddRefraction(surface, behind, refracted)
    common.look_from(renderer, (-0.9, -6.2, 3.3), (0.95, -0.25, 0.5), (0, 0, 1), 29.0)
    renderer.ResetCameraClippingRange(-HALF, HALF, -HALF, HALF, 0, 3)
    return common.take(renderer, size)
