# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The filter on a sphere below a plane: the eye's rays obey Snell's law, and the result is drawn;
the eye follows a camera; composite inputs."""
import math

import PluginTesting
from paraview import servermanager, simple

EYE = (0.3, 0.2, 2.0)
INDICES = (1.0, 1.333)
# Linear interpolation over a facet has an error of the square of the facet's size over the
# distance: (4 / 32 / 2)^2 = 4e-3, times the second derivative of the sine, below 1.
RESOLUTION = 32
SNELL_TOLERANCE = 4e-3
# The points of the geometry are single precision, 2^-24 of coordinates of about 1.
EXACT_TOLERANCE = 1e-6


def sine(point, sight_point):
    """Sine of the angle between the ray and the plane's normal, the z axis."""
    dx, dy, dz = (a - b for a, b in zip(point, sight_point))
    return math.hypot(dx, dy) / math.sqrt(dx * dx + dy * dy + dz * dz)


def check_snell(source, virtual, tolerance=SNELL_TOLERANCE):
    points = virtual.GetPointData()
    worst = 0.0
    for i in range(virtual.GetNumberOfPoints()):
        sight_point = points.GetArray("SightPoint").GetTuple(i)
        true_point = source.GetPoint(int(points.GetArray("SourcePointId").GetTuple1(i)))
        assert abs(sight_point[2]) < 1e-6, "sight point %r is not on the membrane" % (sight_point,)
        error = INDICES[0] * sine(EYE, sight_point) - INDICES[1] * sine(true_point, sight_point)
        worst = max(worst, abs(error))
    print("%d points, worst error of Snell's law %.2e" % (virtual.GetNumberOfPoints(), worst))
    assert worst < tolerance


def follow_camera(refracted, view):
    """Links the filter's eye and view to the view's camera, as Tools > Manage Links does."""
    for name, name_there in [("CameraPosition", "EyePosition"),
                             ("CameraFocalPoint", "ViewFocalPoint"),
                             ("CameraViewUp", "ViewUp"), ("CameraViewAngle", "ViewAngle")]:
        link = servermanager.vtkSMPropertyLink()
        link.AddLinkedProperty(view.SMProxy, name, 1)
        link.AddLinkedProperty(refracted.SMProxy, name_there, 2)
        servermanager.ProxyManager().RegisterLink("Eye" + name, link)


def check_camera(refracted, view):
    """The eye follows the camera. With ViewCulling, geometry that the camera does not show is left
    out and the picture is the same."""
    follow_camera(refracted, view)
    for position in [(0.5, -0.4, 3.0), (1.5, 0.3, 1.5)]:
        view.CameraPosition = position
        refracted.ViewCulling = 0
        name = "RefractedFrom%g" % position[0]
        plain = PluginTesting.screenshot(view, name)
        assert tuple(refracted.EyePosition) == position, "the eye is at %s" % refracted.EyePosition
        refracted.ViewCulling = 1
        assert PluginTesting.screenshot(view, name + "Culled") == plain, "culled"
        count = servermanager.Fetch(refracted).GetNumberOfPoints()
        view.CameraFocalPoint = [100, 0, 0]
        simple.Render(view)
        aside = servermanager.Fetch(refracted).GetNumberOfPoints()
        assert aside < count, "%d of %d points though the camera looks aside" % (aside, count)
        view.CameraFocalPoint = [0, 0, -0.6]


def check_reflection(membrane):
    """A plane mirrors points in front of it to the same distance behind it."""
    above = simple.Sphere(Center=[0, 0, 0.6], Radius=0.3)
    mirrored = simple.RefractedGeometry(Geometry=above, Membrane=membrane, EyePosition=EYE,
                                        Mode="Reflection", Images="First image")
    source, virtual = servermanager.Fetch(above), servermanager.Fetch(mirrored)
    assert virtual.GetNumberOfPoints() == source.GetNumberOfPoints()
    worst = max(abs(a - b) for i in range(source.GetNumberOfPoints())
                for a, b in zip(virtual.GetPoint(i), source.GetPoint(i)[:2] +
                                (-source.GetPoint(i)[2],)))
    assert worst < EXACT_TOLERANCE, "the mirror image is off by %g" % worst


def check_exact(sphere, membrane):
    """With a formula for the membrane, its mesh counts by its extent alone: waves on a plane are
    gone, and Snell's law holds as exactly as for a plane; without it they are there again."""
    waves = simple.Calculator(Input=membrane, CoordinateResults=1,
                              Function="coords+kHat*0.05*sin(3*coordsX)*cos(3*coordsY)")
    refracted = simple.RefractedGeometry(Geometry=sphere, Membrane=waves, EyePosition=EYE)
    assert refracted.GetProperty("ExactMembrane").Available[0] == "None"

    def heights():
        points = servermanager.Fetch(refracted).GetPointData().GetArray("SightPoint")
        return [points.GetTuple(i)[2] for i in range(points.GetNumberOfTuples())]

    assert max(map(abs, heights())) > 0.01, "the waves are flat"
    refracted.ExactMembrane = "Plane"
    refracted.ExactMembrane.Normal = [0, 0, 1]
    refracted.ExactMembrane.Origin = [0, 0, 0]
    check_snell(servermanager.Fetch(sphere), servermanager.Fetch(refracted), EXACT_TOLERANCE)
    refracted.ExactMembrane.Origin = [0, 0, 0.125]
    assert set(heights()) == {0.125}, "a change of the function changes nothing"
    refracted.ExactMembrane = "None"
    assert max(map(abs, heights())) > 0.01, "the plane is still there"


def check_blocks(sphere, membrane):
    """Composite inputs: the blocks of the geometry are kept, those of the membrane become one."""
    other = simple.Sphere(Center=[0.5, 0, -1], Radius=0.2)
    halves = [simple.Plane(Origin=[x, -2, 0], Point1=[x + 2, -2, 0], Point2=[x, 2, 0],
                           XResolution=RESOLUTION // 2, YResolution=RESOLUTION) for x in (-2, 0)]
    both = simple.GroupDatasets(Input=[sphere, other])
    refracted = simple.RefractedGeometry(
        Geometry=both, Membrane=simple.GroupDatasets(Input=halves), EyePosition=EYE)
    whole = simple.RefractedGeometry(Geometry=sphere, Membrane=membrane, EyePosition=EYE)
    blocks = servermanager.Fetch(refracted)
    expected = servermanager.Fetch(whole)
    assert blocks.GetNumberOfBlocks() == 2
    block = blocks.GetBlock(0)
    assert block.GetNumberOfPoints() == expected.GetNumberOfPoints()
    worst = max(abs(a - b) for i in range(block.GetNumberOfPoints())
                for a, b in zip(block.GetPoint(i), expected.GetPoint(i)))
    assert worst < 1e-6, "blocks of the membrane change the picture by %g" % worst
    assert blocks.GetBlock(1).GetNumberOfPoints() > 0


def test():
    PluginTesting.load_plugin()
    sphere = simple.Sphere(
        Center=[0, 0, -0.6], Radius=0.3, ThetaResolution=24, PhiResolution=24)
    membrane = simple.Plane(
        Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0], XResolution=RESOLUTION,
        YResolution=RESOLUTION)
    refracted = simple.RefractedGeometry(Geometry=sphere, Membrane=membrane)
    refracted.EyePosition = EYE
    refracted.ExteriorIndexOfRefraction, refracted.InteriorIndexOfRefraction = INDICES

    for model in ["Flat facets (first image only)", "Curved"]:
        refracted.MembraneModel = model
        refracted.Images = "First image"
        source = servermanager.Fetch(sphere)
        virtual = servermanager.Fetch(refracted)
        assert virtual.GetNumberOfPoints() == source.GetNumberOfPoints()
        assert virtual.GetNumberOfCells() == source.GetNumberOfCells()
        check_snell(source, virtual)

    view = PluginTesting.make_view()
    simple.Show(refracted, view)
    simple.ResetCamera(view)
    drawn = PluginTesting.covered(PluginTesting.screenshot(view, "RefractedGeometry"))
    assert len(drawn) > 0.05 * PluginTesting.SIZE**2, "the picture is all but empty"
    refracted.Images = "All images"
    check_camera(refracted, view)
    check_exact(sphere, membrane)
    check_reflection(membrane)
    check_blocks(sphere, membrane)


if __name__ == "__main__":
    PluginTesting.run(test)
