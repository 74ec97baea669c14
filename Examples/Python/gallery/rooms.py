# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Air in a kitchen: a plume above a stove, below a hood."""
import numpy
from vtkmodules.vtkRenderingCore import vtkLight

from . import common, daylight

SUN = (-0.2, 0.62, 0.9)
EXPOSURE = 0.72  # a room in which smoke is brighter than the walls
SMOKE = ((0.99, 0.93, 0.80), (0.98, 0.74, 0.42), (0.90, 0.42, 0.18), (0.62, 0.13, 0.10))


def get_tiles(points):
    """Colours of a floor of tiles, half a metre wide."""
    joint = (numpy.abs((points[:, :2] / 0.5) % 1.0 - 0.5) > 0.47).any(axis=1)
    return numpy.where(joint[:, None], (0.66, 0.63, 0.58), (0.82, 0.79, 0.74))


def make_room(step):
    """The furniture of kitchen.vts, by its extents: counter, hood, hot plate, door."""
    counter = (4.7, 5.5, 0.01, 2.9, 0.01, 0.96)
    top = (4.67, 5.53, 0.01, 2.93, 0.94, 1.0)
    hood = (4.7, 5.5, 0.01, 2.9, 2.0, 2.5)
    walls = [(-0.2, 7.2, -0.2, 0.01, 0, 2.5), (7.0, 7.2, 0.0, 5.0, 0, 2.5)]
    studio = daylight.Studio(
        SUN, [counter, top, hood, *walls], reach=1.6, step=step, exposure=EXPOSURE)
    studio.add_plane((1.2, 0.01, 0.01), (7.0, 0.01, 0.01), (1.2, 5.0, 0.01), get_tiles)
    studio.add_plane((7.0, 0.01, 0.01), (1.2, 0.01, 0.01), (7.0, 0.01, 2.5), (0.97, 0.97, 0.96))
    studio.add_plane((7.0, 5.0, 0.01), (7.0, 0.01, 0.01), (7.0, 5.0, 2.5), (0.93, 0.95, 0.97))
    studio.add_plane((6.99, 4.7, 0.01), (6.99, 3.8, 0.01), (6.99, 4.7, 2.0), (0.60, 0.44, 0.30))
    studio.add_box(counter, (0.72, 0.56, 0.42), "xYX")
    studio.add_box(top, (0.93, 0.92, 0.90), "xYXZ")
    studio.add_box((4.7, 5.5, 1.7, 2.1, 1.0, 1.006), (0.20, 0.20, 0.22), "Z")
    studio.add_box(hood, (0.80, 0.83, 0.86), "xXYz")
    studio.add_box(hood, (0.92, 0.94, 0.96), "Z")
    return studio.make_actor()


def draw_kitchen(data, size):
    """The contaminant in the kitchen as smoke that throws shadows into itself."""
    mesh = data.kitchen
    mesh.GetPointData().SetActiveScalars("c1")
    colors = common.make_colors(SMOKE, 0.11, 0.2)
    opacity = common.make_opacity(((0.0, 0.0), (0.112, 0.0), (0.125, 0.08), (0.14, 0.5),
                                   (0.17, 0.9), (0.21, 0.98)))
    look = common.make_look(colors, opacity, 0.28)
    look.SetAmbient(0.55)
    look.SetDiffuse(0.9)
    look.SetSpecular(0.0)
    volume = common.make_volume(mesh, look)
    mapper = volume.GetMapper()
    mapper.SetCellDivisionToAdaptive()
    mapper.SetDivisionTolerance(5e-3)
    mapper.SetMaximumNumberOfPieces(10000000)
    mapper.SetGlobalIlluminationReach(0.6)
    mapper.SetVolumetricScatteringBlending(1.0)
    renderer = common.make_renderer(common.NIGHT)
    renderer.AutomaticLightCreationOff()
    light = vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetPosition(*(10 * c for c in SUN))
    light.SetIntensity(1.6)
    renderer.AddLight(light)
    renderer.AddActor(make_room(0.012 if size[1] > 300 else 0.06))
    renderer.AddVolume(volume)
    common.look_from(renderer, (1.3, 7.8, 2.8), (5.0, 1.5, 1.28), (0, 0, 1), 27.0)
    renderer.ResetCameraClippingRange()
    return common.take(renderer, size, common.make_bar(colors, "Contaminant"), 8)
