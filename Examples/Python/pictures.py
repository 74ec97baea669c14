# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the README: a field on tetrahedra as a volume, and a mesh's surface in a pool.

usage: pictures.py FIELD.vtu OBJECT.vtu [--output DIR] [--size N]

Writes readme-volume.png and readme-refraction.png. The first array of points gives the colours. The
README's pictures are of the combustor and the crushed can, test data of VTK and ParaView.
"""
import argparse
import math
import os

import meniscus
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkColorTransferFunction, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
    vtkTexture, vtkVolume, vtkWindowToImageFilter)

COLORS = ((0.0, (0.05, 0.25, 0.55)), (0.35, (0.2, 0.65, 0.75)), (0.6, (0.98, 0.85, 0.45)),
          (0.8, (0.95, 0.5, 0.15)), (1.0, (0.7, 0.08, 0.05)))
WAVES = ((0.012, 9.0, 4.0), (0.010, -5.0, 11.0), (0.004, 15.0, 13.0))  # amplitude, wave vector

OPACITY = ((0.0, 0.0), (0.3, 0.03), (0.45, 0.25), (0.6, 0.2), (0.7, 0.5), (0.8, 2.5), (1.0, 6.0))
DEPTH = 0.8  # of the pool, which is 2 wide


def read(name):
    """The mesh, the name of its first array of points and the array's range."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(name)
    reader.Update()
    array = reader.GetOutput().GetPointData().GetArray(0)
    return reader.GetOutput(), array.GetName(), array.GetRange()


def fill_colors(function, low, high):
    for share, color in COLORS:
        function.AddRGBPoint(low + share * (high - low), *color)


def make_renderer():
    renderer = vtkRenderer()
    renderer.SetBackground(0.96, 0.97, 0.98)
    renderer.SetBackground2(0.74, 0.79, 0.86)
    renderer.GradientBackgroundOn()
    return renderer


def write(renderer, name, size):
    window = vtkRenderWindow()
    window.SetSize(4 * size // 3, size)
    window.SetMultiSamples(8)
    window.AddRenderer(renderer)
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(name)
    writer.Write()
    window.Finalize()


def draw_volume(file, name, size):
    mesh, array, (low, high) = read(file)
    mapper = meniscus.vtkTetrahedraRayCastMapper()
    mapper.SetInputData(mesh)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectScalarArray(array)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    look = volume.GetProperty()
    fill_colors(look.GetRGBTransferFunction(), low, high)
    opacity = look.GetScalarOpacity()
    opacity.RemoveAllPoints()
    for share, value in OPACITY:
        opacity.AddPoint(low + share * (high - low), value)
    look.SetScalarOpacityUnitDistance(0.02 * mesh.GetLength())
    look.ShadeOn()
    look.SetAmbient(0.35)
    look.SetDiffuse(0.7)
    look.SetSpecular(0.3)
    look.SetSpecularPower(30)
    renderer = make_renderer()
    renderer.AddVolume(volume)
    camera = renderer.GetActiveCamera()
    camera.SetViewUp(0, 1, 0)
    camera.SetPosition(-0.85, 0.5, 0.8)
    renderer.ResetCamera()
    camera.Zoom(1.5)
    renderer.ResetCameraClippingRange()
    write(renderer, name, size)


def make_tiles():
    """A texture of 8 x 8 tiles with light joints."""
    tiles = vtkImageData()
    pixels = 128
    tiles.SetDimensions(pixels, pixels, 1)
    tiles.AllocateScalars(VTK_UNSIGNED_CHAR, 3)
    for j in range(pixels):
        for i in range(pixels):
            joint = i % 16 < 1 or j % 16 < 1
            shade = (i // 16 + j // 16) % 2
            color = (225, 230, 232) if joint else (95, 165, 190) if shade else (140, 195, 210)
            for channel, value in enumerate(color):
                tiles.SetScalarComponentFromFloat(i, j, 0, channel, value)
    texture = vtkTexture()
    texture.SetInputData(tiles)
    texture.InterpolateOn()
    texture.MipmapOn()
    texture.RepeatOn()
    return texture


def make_sky():
    """A cube map, brighter above: six faces of 2 x 2 pixels; face 4 is +z."""
    sky = vtkTexture()
    sky.CubeMapOn()
    sky.InterpolateOn()
    for face in range(6):
        image = vtkImageData()
        image.SetDimensions(2, 2, 1)
        image.AllocateScalars(VTK_UNSIGNED_CHAR, 3)
        for pixel in range(4):
            for channel, value in enumerate((150, 190, 225) if face == 4 else (215, 225, 235)):
                image.SetScalarComponentFromFloat(pixel % 2, pixel // 2, 0, channel, value)
        sky.SetInputDataObject(face, image)
    return sky


def make_plane(origin, first, second, cells):
    plane = vtkPlaneSource()
    plane.SetOrigin(*origin)
    plane.SetPoint1(*first)
    plane.SetPoint2(*second)
    plane.SetResolution(cells, cells)
    plane.Update()
    return plane.GetOutput()


def make_water():
    """Waves over the pool [-1, 1]^2, at z = 0."""
    water = make_plane((-1, -1, 0), (1, -1, 0), (-1, 1, 0), 128)
    water.GetPointData().Initialize()  # the plane's normals
    for i in range(water.GetNumberOfPoints()):
        x, y, _ = water.GetPoint(i)
        z = sum(a * math.sin(kx * x + ky * y) for a, kx, ky in WAVES)
        water.GetPoints().SetPoint(i, x, y, z)
    return water


def place_object(mesh):
    """The surface of a mesh, smooth, 1.5 long, turned, in the pool."""
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(mesh)
    x0, x1, y0, y1, z0, z1 = mesh.GetBounds()
    scale = 1.5 / max(x1 - x0, y1 - y0, z1 - z0)
    place = vtkTransform()
    place.Translate(0.0, -0.1, -0.3)
    place.RotateZ(25)
    place.Scale(scale, scale, scale)
    place.Translate(-(x0 + x1) / 2, -(y0 + y1) / 2, -(z0 + z1) / 2)
    moved = vtkTransformPolyDataFilter()
    moved.SetInputConnection(surface.GetOutputPort())
    moved.SetTransform(place)
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(moved.GetOutputPort())
    normals.SetFeatureAngle(60)
    normals.Update()
    return normals.GetOutput()


def draw_refraction(file, name, size):
    mesh, array, (low, high) = read(file)
    water = make_water()
    surface = vtkActor()
    surface.SetMapper(vtkPolyDataMapper())
    surface.GetMapper().SetInputData(water)
    renderer = make_renderer()
    renderer.AutomaticLightCreationOff()
    light = vtkLight()
    light.SetPosition(-2, -3, 6)
    renderer.AddLight(light)
    refraction = meniscus.vtkRefractionPass()
    refraction.SetReflectionTexture(make_sky())
    refraction.SetAttenuationCoefficients(0.35, 0.08, 0.04)
    tiles = make_tiles()
    d = -DEPTH
    pool = [make_plane(*corners, 24) for corners in (
        ((-1, -1, d), (1, -1, d), (-1, 1, d)), ((-1, 1, d), (1, 1, d), (-1, 1, d + 2)),
        ((-1, -1, d), (-1, 1, d), (-1, -1, d + 2)), ((1, 1, d), (1, -1, d), (1, 1, d + 2)))]
    parts = [(side, tiles) for side in pool] + [(place_object(mesh), None)]
    for part, texture in parts:
        refracted = meniscus.vtkRefractedGeometryFilter()
        refracted.SetInputData(part)
        refracted.SetMembraneData(water)
        refracted.SetCamera(renderer.GetActiveCamera())
        refracted.SetAngularTolerance(0.03)  # half a pixel
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(refracted.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        if texture:
            mapper.ScalarVisibilityOff()
            actor.SetTexture(texture)
            actor.GetProperty().LightingOff()
        else:
            colors = vtkColorTransferFunction()
            fill_colors(colors, low, high)
            mapper.SetScalarModeToUsePointFieldData()
            mapper.SelectColorArray(array)
            mapper.SetLookupTable(colors)
            actor.GetProperty().SetAmbient(0.3)
            actor.GetProperty().SetDiffuse(0.8)
            actor.GetProperty().SetSpecular(0.4)
            actor.GetProperty().SetSpecularPower(30)
        refraction.AddRefraction(surface, actor, refracted)
    renderer.SetPass(refraction)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.4, -2.6, 2.4)
    camera.SetFocalPoint(0.0, 0.0, -0.35)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(33)
    renderer.ResetCameraClippingRange(-1.2, 1.2, -1.2, 1.2, -1.5, 0.5)
    write(renderer, name, size)


def main():
    parser = argparse.ArgumentParser(description="The pictures of the README")
    parser.add_argument("field", help="tetrahedra, a .vtu file")
    parser.add_argument("object", help="a mesh whose surface lies in the pool, a .vtu file")
    parser.add_argument("--output", default=".", help="existing folder for the pictures")
    parser.add_argument("--size", type=int, default=480, help="height in pixels")
    options = parser.parse_args()
    draw_volume(options.field, os.path.join(options.output, "readme-volume.png"), options.size)
    draw_refraction(
        options.object, os.path.join(options.output, "readme-refraction.png"), options.size)


if __name__ == "__main__":
    main()
