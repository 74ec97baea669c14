# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The error volume from Python: for a bowl compared with its sphere, halving the facets divides the
error by four."""
import math
import unittest

from meniscus import vtkRefractionErrorVolume
from vtkmodules.vtkCommonDataModel import vtkSphere
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkFiltersCore import vtkTriangleFilter

EYE = (0.3, 0.2, 6.0)
RADIUS = 4.0
# Second order: a quarter of the error; a factor of 3 allows for the positions of the samples.
LEAST_GAIN = 3


class TestRefractionErrorVolume(unittest.TestCase):
    def setUp(self):
        self.plane = vtkPlaneSource()
        self.plane.SetOrigin(-2, -2, 0)
        self.plane.SetPoint1(2, -2, 0)
        self.plane.SetPoint2(-2, 2, 0)
        self.triangles = vtkTriangleFilter()
        self.triangles.SetInputConnection(self.plane.GetOutputPort())
        self.sphere = vtkSphere()
        self.sphere.SetCenter(0, 0, RADIUS)
        self.sphere.SetRadius(RADIUS)
        self.volume = vtkRefractionErrorVolume()
        self.volume.SetEyePosition(*EYE)
        self.volume.SetModelBounds(-1, 1, -1, 1, -3, -0.2)
        self.volume.SetSampleDimensions(15, 15, 15)
        self.volume.SetExactMembrane(self.sphere)

    def measure(self, resolution, model):
        self.plane.SetResolution(resolution, resolution)
        self.triangles.Update()
        membrane = self.triangles.GetOutput()
        points = membrane.GetPoints()
        for i in range(points.GetNumberOfPoints()):
            x, y, _ = points.GetPoint(i)
            points.SetPoint(i, x, y, RADIUS - math.sqrt(RADIUS**2 - x**2 - y**2))
        membrane.GetPointData().SetNormals(None)
        self.volume.SetInputData(0, membrane)
        self.volume.SetMembraneModel(model)
        self.volume.Update()
        return self.volume.GetMeanError()

    def test_second_order(self):
        coarse = self.measure(16, self.volume.FLAT_FACETS)
        fine = self.measure(32, self.volume.FLAT_FACETS)
        print("mean errors %.2e, %.2e" % (coarse, fine))
        self.assertGreater(fine, 0)
        self.assertLess(fine, coarse / LEAST_GAIN)
        self.assertLess(self.measure(32, self.volume.CURVED), fine)

    def test_output(self):
        self.measure(16, self.volume.FLAT_FACETS)
        output = self.volume.GetOutput()
        self.assertEqual(output.GetDimensions(), (15, 15, 15))
        for bound, expected in zip(output.GetBounds(), (-1, 1, -1, 1, -3, -0.2)):
            self.assertAlmostEqual(bound, expected)
        self.assertEqual(output.GetPointData().GetScalars().GetName(), "RefractionError")
        states = output.GetPointData().GetArray("SampleState")
        measured = sum(states.GetValue(i) == self.volume.MEASURED for i in range(15**3))
        self.assertEqual(measured, self.volume.GetNumberOfMeasuredSamples())
        self.assertGreater(measured, 1000)
        self.assertGreater(self.volume.GetLargestError(), self.volume.GetMeanError())
        self.assertGreater(self.volume.GetStandardDeviation(), 0)


if __name__ == "__main__":
    unittest.main()
