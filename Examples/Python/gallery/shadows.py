# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Light that a medium attenuates and scatters."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid
from vtkmodules.vtkRenderingCore import vtkLight

from . import common

# Reach of shadows, share of scattered light, lit at all, ambient coefficient, intensity of the sun,
# label. Without occlusion, so much ambient light would leave no shade.
PANELS = ((0.0, 0.0, False, 1.0, 1.0, "colour and opacity alone"),
          (0.0, 0.0, True, 0.5, 1.0, "lit at the gradient"),
          (1.0, 2.0, True, 0.9, 1.1, "shadows and scattering"))
SKY = ((0.90, 0.94, 0.98), (0.55, 0.70, 0.88))
SUN = (-3.0, 2.6, 2.2)


def list_puffs():
    """Balls (x, y, z, radius) of four sizes: small ones sit on the upper sides of larger ones."""
    random = numpy.random.default_rng(4)
    puffs = [(-0.42, -0.16, 0.0, 0.24), (0.0, -0.02, 0.05, 0.33), (0.42, -0.17, -0.05, 0.24),
             (0.17, 0.17, 0.0, 0.20), (-0.2, 0.12, -0.05, 0.18), (-0.7, -0.26, 0.05, 0.13),
             (0.7, -0.26, 0.0, 0.13), (0.15, -0.2, 0.2, 0.2)]
    parents = puffs
    for children, share in ((16, 0.42), (9, 0.42), (6, 0.5)):
        born = []
        for x, y, z, radius in parents:
            for _ in range(children):
                side = random.normal(size=3)
                side /= numpy.linalg.norm(side)
                side[1] = abs(side[1]) if random.random() < 0.8 else side[1]
                size = radius * share * random.uniform(0.6, 1.25)
                born.append((*(numpy.array((x, y, z)) + 0.92 * radius * side), size))
        puffs = puffs + born
        parents = born
    return puffs


def make_cloud(points):
    """A cloud of fair weather on a curvilinear grid with this number of points along its width:
    puffs above a flat base."""
    halves = (0.5, 0.6, 1.0)
    shape = (points // 2, points * 3 // 5, points)
    axes = [numpy.linspace(-half, half, n) for half, n in zip(halves, shape)]
    field = numpy.full(shape, -1.0)
    for px, py, pz, radius in list_puffs():
        part = tuple(slice(*numpy.searchsorted(axis, (p - 1.5 * radius, p + 1.5 * radius)))
                     for axis, p in zip(axes, (pz, py, px)))
        z, y, x = numpy.meshgrid(*(axis[piece] for axis, piece in zip(axes, part)), indexing="ij")
        distance = numpy.sqrt((x - px) ** 2 + (y - py) ** 2 + (z - pz) ** 2)
        field[part] = numpy.maximum(field[part], radius - distance)
    z, y, x = numpy.meshgrid(*axes, indexing="ij")
    density = numpy.clip(0.5 + field / 0.05, 0.0, 1.0) * numpy.clip((y + 0.3) / 0.08, 0.0, 1.0)
    grid = vtkStructuredGrid()
    grid.SetDimensions(shape[2], shape[1], shape[0])
    places = vtkPoints()
    sheared = numpy.stack([x + 0.1 * y, y, z], axis=-1)  # by the wind
    places.SetData(numpy_to_vtk(sheared.reshape(-1, 3), deep=True))
    grid.SetPoints(places)
    array = numpy_to_vtk(density.ravel(), deep=True)
    array.SetName("water")
    grid.GetPointData().SetScalars(array)
    return grid


def make_scene(mesh, reach, scattering, lit, ambient, intensity):
    colors = common.make_colors(((1.0, 1.0, 1.0), (0.97, 0.97, 0.98)), 0.0, 1.0)
    opacity = common.make_opacity(((0.0, 0.0), (0.1, 0.05), (0.5, 0.75), (1.0, 0.98)))
    look = common.make_look(colors, opacity, 0.09, lit)
    look.SetAmbient(ambient)
    look.SetDiffuse(0.75)
    look.SetSpecular(0.0)
    volume = common.make_volume(mesh, look)
    volume.GetMapper().SetGlobalIlluminationReach(reach)
    volume.GetMapper().SetVolumetricScatteringBlending(scattering)
    renderer = common.make_renderer(SKY)
    renderer.AutomaticLightCreationOff()
    light = vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetPosition(*SUN)
    light.SetColor(1.0, 0.97, 0.90)
    light.SetIntensity(intensity)
    renderer.AddLight(light)
    sky = vtkLight()
    sky.SetLightTypeToSceneLight()
    sky.SetPosition(2.0, 3.0, 4.0)
    sky.SetColor(0.55, 0.72, 1.0)
    sky.SetIntensity(0.5)
    renderer.AddLight(sky)
    renderer.AddVolume(volume)
    return renderer


def get_points(size):
    return 30 if size[1] < 200 else 150


def draw_shadows(_, size):
    """One cloud: unlit, lit at its gradient, and with shadows and the light that it scatters."""
    panel = (size[0] // 3, size[1] * 4 // 15)
    mesh = make_cloud(get_points(size))
    renderers = []
    for *light, label in PANELS:
        renderer = make_scene(mesh, *light)
        common.look_from(renderer, (0.35, 0.0, 4.4), (0.02, 0.01, 0.0), (0, 1, 0), 16.0)
        common.add_label(renderer, label, 2 * panel[1], common.INK)
        renderer.ResetCameraClippingRange()
        renderers.append(renderer)
    return common.take_beside(renderers, panel, 2)


def draw_cloud(_, size):
    """The cloud under the sun, nearer."""
    renderer = make_scene(make_cloud(get_points(size)), *PANELS[2][:-1])
    common.look_from(renderer, (0.35, -0.25, 4.4), (0.02, -0.01, 0.0), (0, 1, 0), 21.0)
    renderer.ResetCameraClippingRange()
    return common.take(renderer, size)
