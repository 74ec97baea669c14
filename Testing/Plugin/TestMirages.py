# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A wall behind a block in which the index of refraction rises along an axis: the picture shows
another place of it than a straight ray, and a point of it is seen in another direction."""
import math

import PluginTesting
from paraview import servermanager, simple

HALF = 10.0  # of the block
SLOPE = 1e-4  # of the index, which is 1 in the middle
EYE, WALL = 40.0, -30.0
# A deflection of SLOPE per length bends the middle ray in the block, and moves it behind that.
SHIFT = SLOPE * (2 * HALF) * (HALF + (-HALF - WALL))
# The corners of the index are rounded to single precision; the wall is WALL - EYE away.
ROUNDING = 2 * (2 * HALF) * 2.0**-23 * (EYE - WALL)


def check_mirage(index, wall):
    picture = simple.TetrahedraMirage(
        Input=index, Objects=wall, EyePosition=[0, 0, EYE], ViewFocalPoint=[0, 0, 0],
        ViewUp=[0, 1, 0], ViewAngle=20, ImageSize=[11, 9], Ambient=1)
    picture.ScalarArray = ["POINTS", "index"]
    picture.Quantity = "Index of refraction"
    image = servermanager.Fetch(picture)
    assert image.GetDimensions() == (11, 9, 1), image.GetDimensions()
    middle = 4 * 11 + 5
    points = image.GetPointData()
    place = points.GetArray("Position").GetTuple(middle)
    assert math.dist(place, (SHIFT, 0, WALL)) < ROUNDING, place
    assert points.GetArray("Color").GetTuple(middle) == (255, 255, 255)
    assert points.GetArray("Seen").GetTuple(middle) == (1,)
    picture.BendRays = 0
    place = servermanager.Fetch(picture).GetPointData().GetArray("Position").GetTuple(middle)
    assert math.dist(place, (0, 0, WALL)) < 1e-9, place


def check_cameras(index, wall):
    """Without settings, the camera is that of the active view; it can follow it."""
    view = PluginTesting.make_view()
    view.CameraPosition, view.CameraFocalPoint = [1, 2, EYE], [1, 2, 0]
    view.CameraViewAngle = 12
    picture = simple.TetrahedraMirage(Input=index, Objects=wall, ImageSize=[3, 3])
    picture.ScalarArray = ["POINTS", "index"]
    picture.UpdatePipeline()
    assert list(picture.EyePosition) == [1, 2, EYE] and picture.ViewAngle == 12
    assert list(picture.ViewFocalPoint) == [1, 2, 0], picture.ViewFocalPoint
    picture.FollowCamera = 1
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 3
    view.CameraPosition, view.CameraFocalPoint = [2, 2, EYE], [2, 2, 0]
    picture.UpdatePipeline()
    image = servermanager.Fetch(picture)
    # Three parallel rays across a height of 6, bent by the density 1: n = 1.0002 + 2e-8 x.
    places = [image.GetPointData().GetArray("Position").GetTuple(i) for i in range(9)]
    for i, place in enumerate(places):
        expected = (2 * (i % 3), 2 * (i // 3), WALL)
        assert math.dist(place, expected) < 1e-4, (place, expected)


def check_volume(index):
    """The medium as fog of one colour: the opacity on the straight middle ray is Beer's law."""
    density, color = 0.05, (1.0, 0.4, 0.2)  # whole steps of 1 / 255
    picture = simple.TetrahedraMirage(
        Input=index, EyePosition=[0, 0, EYE], ViewFocalPoint=[0, 0, 0], ViewUp=[0, 1, 0],
        ViewAngle=20, ImageSize=[11, 9], BendRays=0)
    picture.ScalarArray = ["POINTS", "index"]
    picture.Quantity = "Index of refraction"
    picture.ShowVolume = 1
    picture.VolumeArrayName = "RTData"
    picture.VolumeColors = simple.GetColorTransferFunction("RTData")
    picture.VolumeColors.RGBPoints = [0, *color, 300, *color]
    picture.VolumeOpacity = simple.GetOpacityTransferFunction("RTData")
    picture.VolumeOpacity.Points = [0, density, 0.5, 0, 300, density, 0.5, 0]
    middle = 4 * 11 + 5

    def expect(attenuation, shades=color):
        rgba = servermanager.Fetch(picture).GetPointData().GetArray("RGBA").GetTuple(middle)
        alpha = 1 - math.exp(-attenuation * 2 * HALF)
        for value, share in zip(rgba, (*shades, 1)):
            assert abs(value - share * alpha) < 1e-5, (rgba, alpha)
    expect(density)
    picture.ScalarOpacityUnitDistance = 2
    expect(density / 2)
    # A change of the functions is seen, too.
    picture.VolumeOpacity.Points = [0, 2 * density, 0.5, 0, 300, 2 * density, 0.5, 0]
    expect(density)
    picture.VolumeColors.RGBPoints = [0, 0, 0, 1, 300, 0, 0, 1]
    expect(density, (0, 0, 1))
    picture.OpacityModel = "Opacity per unit distance"
    expect(-math.log(1 - 2 * density) / 2, (0, 0, 1))
    # The functions that the panel begins with.
    other = simple.TetrahedraMirage(Input=index, ShowVolume=1, ImageSize=[3, 3])
    other.ScalarArray = ["POINTS", "index"]
    assert other.VolumeColors is not None and other.VolumeOpacity is not None


def check_texture(index, wall):
    """A wall with texture coordinates shows a picture whose values are columns."""
    columns = simple.Calculator(
        Input=simple.Wavelet(WholeExtent=[0, 3, 0, 3, 0, 0]), ResultArrayName="columns",
        Function="60*coordsX")
    bytes_of = simple.ProgrammableFilter(Input=columns, Script="""
import numpy
output.PointData.append(
    inputs[0].PointData["columns"].astype(numpy.uint8), "bytes")
output.GetPointData().SetActiveScalars("bytes")
""")
    picture = simple.TetrahedraMirage(
        Input=index, Objects=wall, TexturePicture=bytes_of, EyePosition=[0, 0, EYE],
        ViewFocalPoint=[0, 0, 0], ViewUp=[0, 1, 0], ViewAngle=20, ImageSize=[11, 9], Ambient=1,
        BendRays=0)
    picture.ScalarArray = ["POINTS", "index"]
    points = servermanager.Fetch(picture).GetPointData()
    shades = {points.GetArray("Color").GetTuple(i) for i in range(11 * 9)}
    # The picture is 24.7 high and 30.2 wide in the middle of a wall of 60: the two inner columns.
    assert shades == {(60, 60, 60), (120, 120, 120)}, shades
    picture.TexturePicture = None
    points = servermanager.Fetch(picture).GetPointData()
    assert {points.GetArray("Color").GetTuple(i) for i in range(99)} == {(255, 255, 255)}


def check_apparent(index):
    point = simple.PointSource(Center=[0, 0, WALL], NumberOfPoints=1, Radius=0)
    seen = simple.ApparentGeometry(Input=point, Medium=index, EyePosition=[0, 0, EYE],
                                   SearchAngle=0.5)
    seen.ScalarArray = ["POINTS", "index"]
    seen.Quantity = "Index of refraction"
    geometry = servermanager.Fetch(seen)
    assert geometry.GetPointData().GetArray("NumberOfImages").GetTuple(0) == (1,)
    # The ray begins in a direction that takes the shift back.
    place = geometry.GetPoint(0)
    assert math.dist(place, (-SHIFT, 0, WALL)) < ROUNDING, place
    # Other values than the active scalars are chosen, here those that bend nothing.
    flat = simple.Calculator(Input=index, ResultArrayName="flat", Function="1.0001")
    seen.Medium = flat
    seen.ScalarArray = ["POINTS", "flat"]
    place = servermanager.Fetch(seen).GetPoint(0)
    assert math.dist(place, (0, 0, WALL)) < 1e-9, place
    seen.ScalarArray = ["POINTS", "index"]
    place = servermanager.Fetch(seen).GetPoint(0)
    assert math.dist(place, (-SHIFT, 0, WALL)) < ROUNDING, place


def test():
    PluginTesting.load_plugin()
    index = simple.Calculator(Input=simple.Wavelet(), ResultArrayName="index",
                              Function="1+%g*coordsX" % SLOPE)
    wall = simple.Plane(Origin=[-30, -30, WALL], Point1=[30, -30, WALL], Point2=[-30, 30, WALL])
    check_mirage(index, wall)
    check_volume(index)
    check_texture(index, wall)
    check_apparent(index)
    check_cameras(index, wall)


if __name__ == "__main__":
    PluginTesting.run(test)
