# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The filter from Python: the sight point of a point under a plane is where Snell's law puts it."""
import math
import unittest

from meniscus import vtkRefractedGeometryFilter
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkMaskPoints
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

EYE = (0.3, 0.2, 2.0)
INDICES = (1.0, 1.333)
# Linear interpolation over a facet has an error of the square of the facet's size over the
# distance: (4 / 32 / 2)^2 = 4e-3, times the second derivative of the sine, below 1. Halving the
# facets must divide the error by 4; a factor of 3 allows for the positions of the sample points.
RESOLUTION = 32
SNELL_TOLERANCE = 4e-3
LEAST_GAIN = 3
EXACT = 1e-6
POINT_ARRAYS = ["SightPoint", "RefractionDepth", "Reflectance", "SightFacet", "SourcePointId"]
CELL_ARRAYS = ["SourceCellId", "ImageOrientation"]


def sine(point, sight_point):
    dx, dy, dz = (a - b for a, b in zip(point, sight_point))
    return math.hypot(dx, dy) / math.sqrt(dx * dx + dy * dy + dz * dz)


class TestRefractedGeometry(unittest.TestCase):
    def setUp(self):
        self.sphere = vtkSphereSource()
        self.sphere.SetCenter(0, 0, -0.6)
        self.sphere.SetRadius(0.3)
        self.membrane = vtkPlaneSource()
        self.membrane.SetOrigin(-2, -2, 0)
        self.membrane.SetPoint1(2, -2, 0)
        self.membrane.SetPoint2(-2, 2, 0)
        self.filter = vtkRefractedGeometryFilter()
        self.filter.SetInputConnection(0, self.sphere.GetOutputPort())
        self.filter.SetInputConnection(1, self.membrane.GetOutputPort())
        self.filter.SetEyePosition(*EYE)
        self.filter.SetExteriorIndexOfRefraction(INDICES[0])
        self.filter.SetInteriorIndexOfRefraction(INDICES[1])
        self.filter.SetImages(self.filter.FIRST_IMAGE)

    def test_arrays(self):
        self.filter.Update()
        virtual = self.filter.GetOutput()
        self.assertEqual(virtual.GetNumberOfCells(), self.sphere.GetOutput().GetNumberOfCells())
        self.check_arrays(virtual)

    def test_snell(self):
        for model in [self.filter.FLAT_FACETS, self.filter.CURVED]:
            self.filter.SetMembraneModel(model)
            coarse = self.worst_error(RESOLUTION // 2)
            fine = self.worst_error(RESOLUTION)
            print("model %d: worst error of Snell's law %.2e, %.2e" % (model, coarse, fine))
            self.assertLess(fine, SNELL_TOLERANCE)
            self.assertLess(fine, max(coarse / LEAST_GAIN, EXACT))

    def test_caching(self):
        self.filter.Update()
        builds = self.filter.GetNumberOfPatchBuilds()
        solved = self.filter.GetNumberOfSolvedVertices()
        self.assertGreater(solved, 0)
        self.filter.Update()
        self.assertEqual(self.filter.GetNumberOfSolvedVertices(), solved)
        self.sphere.SetCenter(0.1, 0, -0.6)
        self.filter.Update()
        self.assertGreater(self.filter.GetNumberOfSolvedVertices(), solved)
        self.assertEqual(self.filter.GetNumberOfPatchBuilds(), builds)

    def test_inputs_from_images(self):
        """No input requests its own extent from the other's source."""
        objects = vtkRTAnalyticSource()
        objects.SetWholeExtent(-4, 4, -4, 4, -5, -1)
        vertices = vtkMaskPoints()
        vertices.SetInputConnection(objects.GetOutputPort())
        vertices.SetOnRatio(1)
        vertices.GenerateVerticesOn()
        vertices.SingleVertexPerCellOn()
        field = vtkRTAnalyticSource()
        field.SetWholeExtent(-8, 8, -8, 8, 0, 1)
        surface = vtkContourFilter()
        surface.SetInputConnection(field.GetOutputPort())
        surface.SetValue(0, 150)
        self.filter.SetInputConnection(0, vertices.GetOutputPort())
        self.filter.SetInputConnection(1, surface.GetOutputPort())
        self.filter.SetEyePosition(0, 0, 12)
        self.filter.Update()
        self.assertGreater(self.filter.GetOutput().GetNumberOfPoints(), 100)
        self.assertEqual(objects.GetOutput().GetExtent(), (-4, 4, -4, 4, -5, -1))
        self.assertEqual(field.GetOutput().GetExtent(), (-8, 8, -8, 8, 0, 1))

    def check_arrays(self, virtual):
        for name in POINT_ARRAYS:
            self.assertIsNotNone(virtual.GetPointData().GetArray(name), name)
        for name in CELL_ARRAYS:
            self.assertIsNotNone(virtual.GetCellData().GetArray(name), name)

    def worst_error(self, resolution):
        """Largest error of Snell's law over the sphere's points."""
        self.membrane.SetResolution(resolution, resolution)
        self.filter.Update()
        source = self.sphere.GetOutput()
        virtual = self.filter.GetOutput()
        self.assertEqual(virtual.GetNumberOfPoints(), source.GetNumberOfPoints())
        points = virtual.GetPointData()
        worst = 0
        for i in range(virtual.GetNumberOfPoints()):
            sight_point = points.GetArray("SightPoint").GetTuple(i)
            true_point = source.GetPoint(int(points.GetArray("SourcePointId").GetTuple1(i)))
            self.assertAlmostEqual(sight_point[2], 0, places=6)
            depth = points.GetArray("RefractionDepth").GetTuple1(i)
            self.assertAlmostEqual(depth, math.dist(true_point, sight_point), places=5)
            outside = INDICES[0] * sine(EYE, sight_point)
            inside = INDICES[1] * sine(true_point, sight_point)
            worst = max(worst, abs(outside - inside))
        return worst


if __name__ == "__main__":
    unittest.main()
