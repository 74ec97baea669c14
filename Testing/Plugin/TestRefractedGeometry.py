# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The filter on a sphere below a plane: the eye's rays obey Snell's law, and the result is drawn."""
import math

import PluginTesting
from paraview import servermanager, simple

EYE = (0.3, 0.2, 2.0)
INDICES = (1.0, 1.333)
# As in Testing/Python/TestRefractedGeometry.py, for facets of the same size.
RESOLUTION = 32
SNELL_TOLERANCE = 4e-3


def sine(point, sight_point):
    """Sine of the angle between the ray and the plane's normal, the z axis."""
    dx, dy, dz = (a - b for a, b in zip(point, sight_point))
    return math.hypot(dx, dy) / math.sqrt(dx * dx + dy * dy + dz * dz)


def check_snell(source, virtual):
    points = virtual.GetPointData()
    worst = 0.0
    for i in range(virtual.GetNumberOfPoints()):
        sight_point = points.GetArray("SightPoint").GetTuple(i)
        true_point = source.GetPoint(int(points.GetArray("SourcePointId").GetTuple1(i)))
        assert abs(sight_point[2]) < 1e-6, "sight point %r is not on the membrane" % (sight_point,)
        error = INDICES[0] * sine(EYE, sight_point) - INDICES[1] * sine(true_point, sight_point)
        worst = max(worst, abs(error))
    print("%d points, worst error of Snell's law %.2e" % (virtual.GetNumberOfPoints(), worst))
    assert worst < SNELL_TOLERANCE


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

    for model in ["Flat facets", "Curved"]:
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


if __name__ == "__main__":
    PluginTesting.run(test)
