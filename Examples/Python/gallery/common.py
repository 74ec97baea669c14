# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes, colour maps, scalar bars, surfaces and files that the pictures share."""
import meniscus
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkFiltersCore import vtkImageAppend
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkImagingCore import vtkImageShrink3D
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLStructuredGridReader, vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkColorTransferFunction, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
    vtkTextActor, vtkVolume, vtkVolumeProperty, vtkWindowToImageFilter)
from vtkmodules.vtkRenderingVolume import vtkVolumeMapper

try:
    from vtkmodules.vtkFiltersCore import vtkExtractEdges
except ImportError:  # VTK 9.1
    from vtkmodules.vtkFiltersExtraction import vtkExtractEdges  # noqa: F401

# Perceptually uniform maps, sampled from matplotlib's.
INFERNO = ((0.00, 0.00, 0.01), (0.16, 0.04, 0.36), (0.39, 0.09, 0.43), (0.62, 0.16, 0.39),
           (0.83, 0.28, 0.26), (0.96, 0.49, 0.08), (0.98, 0.76, 0.15), (0.99, 1.00, 0.64))
VIRIDIS = ((0.27, 0.00, 0.33), (0.28, 0.20, 0.49), (0.21, 0.36, 0.55), (0.15, 0.50, 0.56),
           (0.12, 0.63, 0.53), (0.36, 0.77, 0.39), (0.70, 0.87, 0.17), (0.99, 0.91, 0.14))
BONE = ((0.00, 0.00, 0.01), (0.12, 0.12, 0.17), (0.25, 0.25, 0.35), (0.37, 0.40, 0.48),
        (0.50, 0.56, 0.60), (0.63, 0.72, 0.72), (0.80, 0.86, 0.86), (1.00, 1.00, 1.00))
# Blue below zero, red above.
SIGNED = ((0.10, 0.25, 0.70), (0.35, 0.60, 0.95), (0.85, 0.85, 0.85), (0.97, 0.60, 0.35),
          (0.75, 0.10, 0.15))
NIGHT = ((0.015, 0.02, 0.04), (0.07, 0.09, 0.14))
PAPER = ((1.0, 1.0, 1.0), (0.93, 0.94, 0.96))
INK = (0.12, 0.14, 0.18)
MARGIN = 0.13  # of a picture's width, for its scalar bar


def read(name):
    """The mesh of a .vtu or .vts file, with its first point array as scalars."""
    structured = name.endswith(".vts")
    reader = vtkXMLStructuredGridReader() if structured else vtkXMLUnstructuredGridReader()
    reader.SetFileName(name)
    reader.Update()
    mesh = reader.GetOutput()
    mesh.GetPointData().SetActiveScalars(mesh.GetPointData().GetArrayName(0))
    return mesh


def get_range(mesh):
    return mesh.GetPointData().GetScalars().GetRange()


def make_colors(palette, low, high):
    colors = vtkColorTransferFunction()
    colors.SetColorSpaceToLab()
    for index, color in enumerate(palette):
        colors.AddRGBPoint(low + (high - low) * index / (len(palette) - 1), *color)
    return colors


def make_opacity(points):
    opacity = vtkPiecewiseFunction()
    for value, alpha in points:
        opacity.AddPoint(value, alpha)
    return opacity


def make_look(colors, opacity, unit, lit=True):
    """Properties of a volume whose opacity is per `unit` of length."""
    look = vtkVolumeProperty()
    look.SetColor(colors)
    look.SetScalarOpacity(opacity)
    look.SetScalarOpacityUnitDistance(unit)
    look.SetInterpolationTypeToLinear()
    look.SetShade(lit)
    look.SetAmbient(0.25)
    look.SetDiffuse(0.85)
    look.SetSpecular(0.35)
    look.SetSpecularPower(40)
    return look


def make_volume(mesh, look, isosurfaces=()):
    """A volume, or some of its isosurfaces."""
    mapper = meniscus.vtkTetrahedraRayCastMapper()
    mapper.SetInputData(mesh)
    if isosurfaces:
        mapper.SetBlendMode(vtkVolumeMapper.ISOSURFACE_BLEND)
        for index, value in enumerate(isosurfaces):
            look.GetIsoSurfaceValues().SetValue(index, value)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(look)
    return volume


def make_actor(data, color=(1.0, 1.0, 1.0)):
    actor = vtkActor()
    actor.SetMapper(vtkPolyDataMapper())
    actor.GetMapper().SetInputData(data)
    actor.GetMapper().ScalarVisibilityOff()
    actor.GetProperty().SetColor(*color)
    return actor


def make_flames(mesh, unit):
    """Colours and look of the combustor's density as a dense lit medium."""
    low, high = get_range(mesh)
    colors = make_colors(INFERNO[1:], low, high)
    at = [low + share * (high - low) for share in (0.0, 0.22, 0.34, 0.46, 0.62, 0.8, 1.0)]
    opacity = make_opacity(zip(at, (0.0, 0.0, 0.35, 0.03, 0.25, 0.9, 0.98)))
    return colors, make_look(colors, opacity, unit)


def light_flames(renderer):
    """Camera and lights for the combustor."""
    add_lights(renderer, ((-0.8, 0.8, 1.0), (1.0, 0.97, 0.9), 1.1),
               ((1.0, -0.3, 0.6), (0.5, 0.65, 1.0), 0.5))
    look_from(renderer, (-15.0, 14.5, 48.0), (9.0, -0.7, 29.0), (0, 1, 0), 28.0)
    renderer.ResetCameraClippingRange()


def make_plane(origin, first, second, cells):
    plane = vtkPlaneSource()
    plane.SetOrigin(*origin)
    plane.SetPoint1(*first)
    plane.SetPoint2(*second)
    plane.SetResolution(*cells)
    plane.Update()
    return plane.GetOutput()


def make_height_field(origin, first, second, cells, height):
    """A rectangle at z = `height`(x, y), without normals."""
    surface = make_plane(origin, first, second, cells)
    surface.GetPointData().Initialize()
    for i in range(surface.GetNumberOfPoints()):
        x, y, z = surface.GetPoint(i)
        surface.GetPoints().SetPoint(i, x, y, z + height(x, y))
    return surface


def make_renderer(background=NIGHT):
    renderer = vtkRenderer()
    renderer.SetBackground(*background[0])
    renderer.SetBackground2(*background[1])
    renderer.GradientBackgroundOn()
    return renderer


def make_dense(mesh, look, light, reach, scattering):
    """A volume of a dense, dull medium that shadows itself; `light` is its ambient and diffuse
    share."""
    look.SetAmbient(light[0])
    look.SetDiffuse(light[1])
    look.SetSpecular(0.0)
    volume = make_volume(mesh, look)
    volume.GetMapper().SetGlobalIlluminationReach(reach)
    volume.GetMapper().SetVolumetricScatteringBlending(scattering)
    return volume


def add_lights(renderer, *places):
    """Lights at places relative to the camera: direction, colour and intensity."""
    renderer.AutomaticLightCreationOff()
    for position, color, intensity in places:
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*position)
        light.SetColor(*color)
        light.SetIntensity(intensity)
        renderer.AddLight(light)


def look_from(renderer, position, focus, up=(0, 0, 1), angle=30.0):
    camera = renderer.GetActiveCamera()
    camera.SetPosition(*position)
    camera.SetFocalPoint(*focus)
    camera.SetViewUp(*up)
    camera.SetViewAngle(angle)


def make_bar(colors, title, color=(0.92, 0.92, 0.92)):
    """A scalar bar for the margin that take() leaves for it."""
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colors)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(4)
    bar.SetLabelFormat("%.3g")
    bar.SetUnconstrainedFontSize(True)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(*color)
        text.BoldOff()
        text.ItalicOff()
        text.ShadowOff()
    bar.SetPosition(0.14, 0.26)
    bar.SetWidth(0.6)
    bar.SetHeight(0.48)
    bar.SetBarRatio(0.3)
    return bar


def make_margin(renderer, bar, height):
    """A renderer for a scalar bar over the right margin of a scene, in a picture of that height.
    The scene fills the picture; its middle is that of the part beside the margin."""
    margin = vtkRenderer()
    margin.SetLayer(1)
    bar.GetTitleTextProperty().SetFontSize(height // 50)
    bar.GetLabelTextProperty().SetFontSize(height // 52)
    bar.SetVerticalTitleSeparation(height // 80)
    margin.AddViewProp(bar)
    renderer.GetActiveCamera().SetWindowCenter(MARGIN, 0.0)
    margin.SetViewport(1.0 - MARGIN, 0.0, 1.0, 1.0)
    return margin


def add_label(renderer, text, height, color):
    """A line of text at the top of a panel of that height."""
    label = vtkTextActor()
    label.SetInput(text)
    size = max(height // 26, 32)
    label.SetPosition(0.7 * size, height - 1.8 * size)
    label.GetTextProperty().SetFontSize(size)
    label.GetTextProperty().SetColor(*color)
    renderer.AddViewProp(label)


def take(renderer, size, bar=None, samples=0):
    """The picture of a renderer as vtkImageData, drawn at twice the size in each direction, with
    this number of samples per pixel of polygons."""
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetMultiSamples(samples)
    window.SetSize(2 * size[0], 2 * size[1])
    window.AddRenderer(renderer)
    if bar:
        window.SetNumberOfLayers(2)
        window.AddRenderer(make_margin(renderer, bar, 2 * size[1]))
    return _grab(window, 2)


def take_beside(renderers, size, finer=1):
    """The picture of several renderers of one size, side by side, drawn at `finer` times the size
    in each direction."""
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetMultiSamples(0)
    whole = (len(renderers) * size[0], size[1])
    window.SetSize(*(finer * side for side in whole))
    for index, renderer in enumerate(renderers):
        renderer.SetViewport(index / len(renderers), 0, (index + 1) / len(renderers), 1)
        window.AddRenderer(renderer)
    return _grab(window, finer)


def stack(pictures, columns):
    """Pictures of one size in rows, from the upper left one."""
    rows = [_append(pictures[first:first + columns], 0)
            for first in range(0, len(pictures), columns)]
    return _append(rows[::-1], 1)


def _append(pictures, axis):
    strip = vtkImageAppend()
    strip.SetAppendAxis(axis)
    for picture in pictures:
        strip.AddInputData(picture)
    strip.Update()
    return strip.GetOutput()


def _grab(window, finer):
    """The window's picture, whose pixels are the means of `finer` x `finer` pixels of the window,
    and the end of the window."""
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    smaller = vtkImageShrink3D()
    smaller.SetInputConnection(picture.GetOutputPort())
    smaller.SetShrinkFactors(finer, finer, 1)
    smaller.MeanOn()
    smaller.Update()
    window.Finalize()
    return smaller.GetOutput()


def write(image, name):
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetFileName(name)
    writer.SetCompressionLevel(9)
    writer.Write()
