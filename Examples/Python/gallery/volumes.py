# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Fields on meshes: lit dense media, radiographs."""
import meniscus
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction, vtkPlane
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingCore import vtkImageMapToColors
from vtkmodules.vtkRenderingCore import vtkTexture
from vtkmodules.vtkRenderingVolume import vtkVolumeMapper

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


def set_medium(volume, at):
    volume.GetProperty().SetScalarOpacity(common.make_opacity(
        (at(share), alpha) for share, alpha in (
            (0.0, 0.0), (0.2, 0.0), (0.28, 0.15), (0.45, 0.1), (0.6, 0.6), (1.0, 0.95))))


def set_isosurfaces(volume, at):
    volume.GetMapper().SetBlendMode(vtkVolumeMapper.ISOSURFACE_BLEND)
    for index, (share, alpha) in enumerate(((0.28, 0.15), (0.42, 0.35), (0.62, 1.0))):
        volume.GetProperty().GetIsoSurfaceValues().SetValue(index, at(share))
        volume.GetProperty().GetScalarOpacity().AddPoint(at(share), alpha)


def set_projection(mode):
    def set_mode(volume, at):
        volume.GetMapper().SetBlendMode(mode)
        volume.GetProperty().ShadeOff()
        volume.GetProperty().GetScalarOpacity().AddSegment(at(0.1), 0.0, at(0.6), 1.0)
    return set_mode


def set_clip(volume, at):
    """The lower part of a dense medium."""
    volume.GetProperty().SetScalarOpacity(common.make_opacity(((at(0.0), 0.97), (at(1.0), 0.97))))
    for normal in ((0.0, -1.0, 0.0), (0.9, 0.0, -0.4)):
        plane = vtkPlane()
        plane.SetOrigin(*volume.GetCenter())
        plane.SetNormal(*normal)
        plane.Push(-2.5)
        volume.GetMapper().AddClippingPlane(plane)


MODES = (
    ("composite", set_medium),
    ("isosurfaces", set_isosurfaces),
    ("maximum intensity", set_projection(vtkVolumeMapper.MAXIMUM_INTENSITY_BLEND)),
    ("average intensity", set_projection(vtkVolumeMapper.AVERAGE_INTENSITY_BLEND)),
    ("clipping planes", set_clip),
    ("an opaque object inside", set_medium),
)


def draw_modes(data, size):
    """The density in the combustor in six ways."""
    panel = (size[0] // 3, size[1] // 3)
    low, high = common.get_range(data.combustor)
    pictures = []
    for label, set_look in MODES:
        colors = common.make_colors(common.INFERNO[1:], low, high)
        look = common.make_look(colors, vtkPiecewiseFunction(), 0.5)
        look.SetAmbient(0.5)
        volume = common.make_volume(data.combustor, look)
        set_look(volume, lambda share: low + share * (high - low))
        renderer = common.make_renderer()
        renderer.AddVolume(volume)
        if "object" in label:
            renderer.AddActor(make_ball(volume.GetCenter()))
        common.light_flames(renderer)
        renderer.GetActiveCamera().Zoom(0.9)
        common.add_label(renderer, label, 2 * panel[1], (0.92, 0.92, 0.92))
        pictures.append(common.take(renderer, panel))
    return common.stack(pictures, 3)


def make_ball(center):
    ball = vtkSphereSource()
    ball.SetCenter(*center)
    ball.SetRadius(1.2)
    ball.SetThetaResolution(80)
    ball.SetPhiResolution(80)
    ball.Update()
    return common.make_actor(ball.GetOutput(), (0.25, 0.75, 0.85))


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
