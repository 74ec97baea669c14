# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""One mesh and one transfer function, drawn by three mappers."""
import math
import time

import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkResampleToImage
from vtkmodules.vtkRenderingCore import (
    vtkActor2D, vtkImageMapper, vtkRenderWindow, vtkTextActor, vtkVolume, vtkWindowToImageFilter)
from vtkmodules.vtkRenderingVolume import vtkProjectedTetrahedraMapper
from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkSmartVolumeMapper

import meniscus

from . import common

SAMPLES = 128  # of the image, along a side; fewer for small pictures
ZOOM = 4
# Middle of the part that is enlarged, and its width, in shares of a panel's width and height.
PART = (0.37, 0.19, 0.13)


def make_property(mesh, for_images):
    """Colours and opacities of the density. Mappers of images take an opacity a per unit of length
    as 1 - (1 - a)^length, mappers of meshes as 1 - exp(-a length)."""
    low, high = common.get_range(mesh)
    colors = common.make_colors(common.VIRIDIS, low, 0.75 * high)
    points = ((low, 0.0), (1.05, 0.0), (1.2, 0.5), (1.35, 0.05), (1.7, 0.1), (1.95, 1.0),
              (2.2, 0.15), (3.0, 0.6), (3.3, 1.0), (high, 1.0))
    if for_images:
        # Between two points 1 - exp(-a) is not linear.
        fine = [(a[0] + (b[0] - a[0]) * i / 16, a[1] + (b[1] - a[1]) * i / 16)
                for a, b in zip(points, points[1:]) for i in range(16)]
        points = [(value, 1.0 - math.exp(-alpha)) for value, alpha in (*fine, points[-1])]
    look = common.make_look(colors, common.make_opacity(points), 0.5, lit=False)
    return look


def resample(mesh, samples):
    """The mesh as an image, and the seconds of processor time that this takes."""
    begin = time.process_time()
    resampled = vtkResampleToImage()
    resampled.SetInputDataObject(mesh)
    resampled.SetSamplingDimensions(samples, samples, samples)
    resampled.Update()
    image = vtkImageData()
    image.ShallowCopy(resampled.GetOutput())
    image.GetPointData().SetActiveScalars(mesh.GetPointData().GetScalars().GetName())
    return image, time.process_time() - begin


def draw(mapper, data, look, size):
    """The picture of a volume as vtkImageData, the milliseconds of processor time of a frame, and
    the marked part, drawn ZOOM times as large."""
    mapper.SetInputDataObject(data)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(look)
    renderer = common.make_renderer(common.PAPER)
    renderer.AddVolume(volume)
    common.look_from(renderer, (-9.5, -10.0, 7.0), (3.0, 2.0, 3.2), (0, 0, 1), 31.0)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetMultiSamples(0)
    window.SetSize(*size)
    window.AddRenderer(renderer)
    window.Render()
    frames = []
    for angle in (1.0, -2.0, 1.0):  # a frame of a view that turns, and back to the first view
        begin = time.process_time()
        renderer.GetActiveCamera().Azimuth(angle)
        picture = grab(window)
        frames.append(1000 * (time.process_time() - begin))
    camera = renderer.GetActiveCamera()
    camera.Zoom(ZOOM)
    camera.SetWindowCenter(*(ZOOM * (2.0 * PART[i] - 1.0) for i in (0, 1)))
    larger = cut_middle(grab(window), ZOOM * int(PART[2] * size[0]))
    window.Finalize()
    return picture, min(frames), larger


def grab(window):
    """The next frame."""
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.ShouldRerenderOff()
    picture.Update()
    return picture.GetOutput()


def measure_difference(picture, exact):
    """Root of the mean square of the differences over the pixels that the mesh covers, of 255."""
    a, b = (vtk_to_numpy(each.GetPointData().GetScalars()).astype(float)
            for each in (picture, exact))
    covered = (abs(b - b[0]).max(axis=1) > 16) | (abs(a - a[0]).max(axis=1) > 16)
    return math.sqrt(((a - b)[covered] ** 2).mean())


def cut_middle(picture, width):
    """The square of this width in the middle of a picture."""
    columns, rows, _ = picture.GetDimensions()
    pixels = vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(rows, columns, 3)
    left, bottom = (columns - width) // 2, (rows - width) // 2
    part = pixels[bottom:bottom + width, left:left + width]
    image = vtkImageData()
    image.SetDimensions(width, width, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(part.reshape(-1, 3), deep=True))
    return image


def add_image(renderer, image, x, y):
    mapper = vtkImageMapper()
    mapper.SetInputData(image)
    mapper.SetColorWindow(255)
    mapper.SetColorLevel(127.5)
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    actor.SetPosition(x, y)
    renderer.AddViewProp(actor)


def make_panel(picture, larger, size, lines):
    """A renderer with a picture, its enlarged part and lines of text."""
    renderer = common.make_renderer((common.PAPER[0], common.PAPER[0]))
    add_image(renderer, picture, 0, 0)
    add_image(renderer, larger, size[0] - larger.GetDimensions()[0] - 8, 8)
    for index, line in enumerate(lines):
        text = vtkTextActor()
        text.SetInput(line)
        text.SetPosition(14, size[1] - 32 - 25 * index)
        text.GetTextProperty().SetFontSize(22 if index == 0 else 18)
        text.GetTextProperty().SetBold(index == 0)
        text.GetTextProperty().SetColor(*common.INK)
        renderer.AddViewProp(text)
    return renderer


def draw_rivals(data, size):
    """The density around the blunt fin, resampled to an image, as projected tetrahedra, and by
    vtkTetrahedraRayCastMapper, with times and differences from the last."""
    panel = (2 * size[0] // 3, size[1])
    samples = min(SAMPLES, size[1] // 3)
    image, seconds = resample(data.fin, samples)
    meshes = make_property(data.fin, False)
    drawn = [draw(mapper, mesh, look, panel) for mapper, mesh, look in (
        (vtkSmartVolumeMapper(), image, make_property(data.fin, True)),
        (vtkProjectedTetrahedraMapper(), data.fin, meshes),
        (meniscus.vtkTetrahedraRayCastMapper(), data.fin, meshes))]
    sampled, projected, exact = drawn
    difference = "off by %.1f of 255 (RMS)"
    texts = (
        ("Resampled to an image", "%d cubed points in %.1f s, %.0f ms a frame" % (
            samples, seconds, sampled[1]), difference % measure_difference(sampled[0], exact[0])),
        ("Projected tetrahedra", "%.0f ms a frame" % projected[1],
         difference % measure_difference(projected[0], exact[0])),
        ("Meniscus", "%.0f ms a frame" % exact[1], "exact to rounding"))
    return common.take_beside([make_panel(picture, part, panel, lines)
                               for (picture, _, part), lines in zip(drawn, texts)], panel)
