# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Fields on meshes: lit dense media, radiographs."""
import meniscus
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkImageMapToColors
from vtkmodules.vtkRenderingCore import vtkTexture

from . import common


def make_medium(data):
    """The combustor as a dense medium that scatters light, and its colours."""
    colors, look = common.make_flames(data.combustor, 0.5)
    low, high = common.get_range(data.combustor)
    # Sheets at two densities, and the densest jets.
    look.SetScalarOpacity(common.make_opacity(
        (low + share * (high - low), alpha) for share, alpha in (
            (0.0, 0.0), (0.2, 0.0), (0.26, 0.12), (0.32, 0.0), (0.5, 0.0), (0.56, 0.7),
            (0.62, 0.05), (0.8, 0.3), (1.0, 0.9))))
    look.SetAmbient(0.7)
    volume = common.make_volume(data.combustor, look)
    volume.GetMapper().SetGlobalIlluminationReach(0.5)
    volume.GetMapper().SetVolumetricScatteringBlending(2.0)
    return volume, colors


def draw_flames(data, size):
    """The density in the combustor."""
    volume, colors = make_medium(data)
    renderer = common.make_renderer()
    renderer.AddVolume(volume)
    common.light_flames(renderer)
    renderer.GetActiveCamera().Zoom(0.95)
    return common.take(renderer, size, common.make_bar(colors, "Density"))


def draw_radiograph(data, size):
    """Lengths of parallel rays in the metal of the crushed can."""
    rays = meniscus.vtkTetrahedraRayIntegral()
    rays.SetInputData(data.can)
    rays.SetDirection(0.15, 0.3, -1.0)
    rays.SetViewUp(0.0, 1.0, 0.0)
    rays.GetArraySelection().DisableArray("Integral")
    rays.GetArraySelection().EnableArray("PathLength")
    rays.SetImageSize(2 * size[0], 2 * size[1])
    rays.Update()
    image = vtkImageData()
    image.DeepCopy(rays.GetOutput())
    image.GetPointData().SetActiveScalars("PathLength")
    high = 0.6 * image.GetPointData().GetArray("PathLength").GetRange()[1]
    colors = common.make_colors(common.BONE, 0.0, high)
    mapped = vtkImageMapToColors()
    mapped.SetInputData(image)
    mapped.SetLookupTable(colors)
    mapped.SetOutputFormatToRGB()
    texture = vtkTexture()
    texture.SetInputConnection(mapped.GetOutputPort())
    page = common.make_actor(common.make_plane((0, 0, 0), (4, 0, 0), (0, 3, 0), (1, 1)))
    page.SetTexture(texture)
    page.GetProperty().LightingOff()
    renderer = common.make_renderer((common.BONE[0], common.BONE[0]))
    renderer.AddActor(page)
    common.look_from(renderer, (2.0, 1.5, 5), (2.0, 1.5, 0), (0, 1, 0))
    renderer.GetActiveCamera().ParallelProjectionOn()
    renderer.GetActiveCamera().SetParallelScale(1.8)
    renderer.ResetCameraClippingRange()
    return common.take(renderer, size, common.make_bar(colors, "Length"))
