# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Light that a medium attenuates and scatters."""
from meniscus.viewer.sample import make_sample
from vtkmodules.vtkRenderingCore import vtkLight

from . import common

# Reach of shadows, share of scattered light, intensity of the lamp, label.
PANELS = ((0.0, 0.0, 1.0, "lit"), (1.0, 0.0, 2.2, "with shadows and occlusion"),
          (1.0, 2.0, 2.2, "scattering"))


def _make_panel(mesh, reach, scattering, intensity, label, size):
    low, high = common.get_range(mesh)
    colors = common.make_colors(common.INFERNO[2:], low, high)
    opacity = common.make_opacity(
        (low + (high - low) * share, value)
        for share, value in ((0.0, 0.0), (0.3, 0.0), (0.5, 0.35), (1.0, 1.0)))
    look = common.make_look(colors, opacity, 0.04 * mesh.GetLength())
    look.SetAmbient(0.35)
    volume = common.make_volume(mesh, look)
    volume.GetMapper().SetGlobalIlluminationReach(reach)
    volume.GetMapper().SetVolumetricScatteringBlending(scattering)
    renderer = common.make_renderer()
    renderer.AutomaticLightCreationOff()
    light = vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetPosition(-2.0, 3.0, 1.0)
    light.SetIntensity(intensity)
    renderer.AddLight(light)
    renderer.AddVolume(volume)
    common.look_from(renderer, (2.6, 1.6, 3.0), (0.0, 0.05, 0.0), (0, 1, 0), 25.0)
    renderer.ResetCameraClippingRange()
    common.add_label(renderer, label, size[1], (0.9, 0.9, 0.92))
    return renderer


def draw_shadows(_, size):
    """One medium lit, with shadows, and by the light that it scatters."""
    panel = (2 * size[0] // 3, size[1])
    mesh = make_sample()
    mesh.GetPointData().SetActiveScalars("plume")
    return common.take_beside([_make_panel(mesh, *look, panel) for look in PANELS], panel)
