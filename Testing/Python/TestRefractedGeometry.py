# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The filter from Python: a point under a plane is where Snell's law puts its sight point."""
import math
import unittest

from meniscus import vtkRefractedGeometryFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource

EYE = (0.3, 0.2, 2.0)
INDICES = (1.0, 1.333)
# The solver works to about 1e-6 of the scene; sines take that over.
SNELL_TOLERANCE = 1e-4
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
        membrane = vtkPlaneSource()
        membrane.SetOrigin(-2, -2, 0)
        membrane.SetPoint1(2, -2, 0)
        membrane.SetPoint2(-2, 2, 0)
        membrane.SetResolution(8, 8)
        self.filter = vtkRefractedGeometryFilter()
        self.filter.SetInputConnection(0, self.sphere.GetOutputPort())
        self.filter.SetInputConnection(1, membrane.GetOutputPort())
        self.filter.SetEyePosition(*EYE)
        self.filter.SetExteriorIndexOfRefraction(INDICES[0])
        self.filter.SetInteriorIndexOfRefraction(INDICES[1])
        self.filter.SetImages(self.filter.FIRST_IMAGE)

    def test_snell(self):
        for model in [self.filter.FLAT_FACETS, self.filter.CURVED]:
            self.filter.SetMembraneModel(model)
            self.filter.Update()
            source = self.sphere.GetOutput()
            virtual = self.filter.GetOutput()
            self.assertEqual(virtual.GetNumberOfPoints(), source.GetNumberOfPoints())
            self.assertEqual(virtual.GetNumberOfCells(), source.GetNumberOfCells())
            self.check_arrays(virtual)
            self.check_points(source, virtual)

    def check_arrays(self, virtual):
        for name in POINT_ARRAYS:
            self.assertIsNotNone(virtual.GetPointData().GetArray(name), name)
        for name in CELL_ARRAYS:
            self.assertIsNotNone(virtual.GetCellData().GetArray(name), name)

    def check_points(self, source, virtual):
        points = virtual.GetPointData()
        for i in range(virtual.GetNumberOfPoints()):
            sight_point = points.GetArray("SightPoint").GetTuple(i)
            true_point = source.GetPoint(int(points.GetArray("SourcePointId").GetTuple1(i)))
            self.assertAlmostEqual(sight_point[2], 0, places=6)
            outside = INDICES[0] * sine(EYE, sight_point)
            inside = INDICES[1] * sine(true_point, sight_point)
            self.assertLess(abs(outside - inside), SNELL_TOLERANCE)
            depth = points.GetArray("RefractionDepth").GetTuple1(i)
            self.assertAlmostEqual(depth, math.dist(true_point, sight_point), places=5)


if __name__ == "__main__":
    unittest.main()
