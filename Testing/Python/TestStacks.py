# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Several refracting interfaces from Python, in every filter that takes a list: a pane of glass
above water in closed form."""
import math
import unittest

import meniscus
from vtkmodules.vtkFiltersSources import vtkPlaneSource

EYE = (0.3, 0.2, 2.0)
MEDIA = (1.0, 1.5, 1.333)
HEIGHTS = (0.0, -0.1)
TOLERANCE = 1e-6  # the sources' points are single precision


def plane(half, height, cells):
    source = vtkPlaneSource()
    source.SetOrigin(-half, -half, height)
    source.SetPoint1(half, -half, height)
    source.SetPoint2(-half, half, height)
    source.SetResolution(cells, cells)
    source.Update()
    return source.GetOutput()


def add_pane(target):
    interfaces = meniscus.vtkRefractingInterfaceCollection()
    for k, height in enumerate(HEIGHTS):
        interface = meniscus.vtkRefractingInterface()
        interface.SetExteriorIndexOfRefraction(MEDIA[k])
        interface.SetInteriorIndexOfRefraction(MEDIA[k + 1])
        interfaces.AddItem(interface)
        target.AddMembraneData(plane(5, height, 8))
    target.SetInterfaces(interfaces)
    return target


def sine(a, b):
    return math.hypot(a[0] - b[0], a[1] - b[1]) / math.dist(a, b)


def transmittance(cosine, before, behind):
    refracted = math.sqrt(1 - (before / behind) ** 2 * (1 - cosine * cosine))
    s = (before * cosine - behind * refracted) / (before * cosine + behind * refracted)
    p = (behind * cosine - before * refracted) / (behind * cosine + before * refracted)
    return 1 - (s * s + p * p) / 2


class TestStacks(unittest.TestCase):
    def make_geometry(self):
        refraction = add_pane(meniscus.vtkRefractedGeometryFilter())
        refraction.SetInputData(plane(0.5, -1, 4))
        refraction.SetEyePosition(*EYE)
        refraction.SetImagesToFirstImage()
        refraction.SetOutputPointsPrecision(refraction.DOUBLE_PRECISION)
        return refraction

    def test_geometry_there_and_back(self):
        refraction = self.make_geometry()
        self.assertEqual(refraction.GetNumberOfMembranes(), 2)
        refraction.Update()
        source, seen = refraction.GetInput(), refraction.GetOutput()
        self.assertEqual(seen.GetNumberOfPoints(), 25)
        arrays = seen.GetPointData()
        for i in range(25):
            path = [EYE, arrays.GetArray("SightPoint").GetTuple(i),
                    arrays.GetArray("LastSightPoint").GetTuple(i), source.GetPoint(i)]
            invariants = [n * sine(a, b) for n, a, b in zip(MEDIA, path, path[1:])]
            self.assertLess(max(invariants) - min(invariants), TOLERANCE)
        truth = add_pane(meniscus.vtkTruePositionFilter())
        truth.SetInputData(seen)
        truth.SetEyePosition(*EYE)
        truth.Update()
        for i in range(25):
            self.assertLess(math.dist(truth.GetOutput().GetPoint(i), source.GetPoint(i)),
                            TOLERANCE)

    def test_light(self):
        light = add_pane(meniscus.vtkRefractedLightFilter())
        light.SetInputData(plane(0.5, -1, 4))
        light.SetLightPosition(0, 0, 1)
        light.Update()
        expected = transmittance(1, *MEDIA[:2]) * transmittance(1, *MEDIA[1:])
        low, high = light.GetOutput().GetCellData().GetArray("RefractionIrradiance").GetRange()
        self.assertAlmostEqual(low, expected, delta=2e-4)
        self.assertAlmostEqual(high, expected, delta=2e-4)

    def test_error_volume(self):
        volume = add_pane(meniscus.vtkRefractionErrorVolume())
        volume.SetEyePosition(*EYE)
        volume.SetModelBounds(-1, 1, -1, 1, -2, -0.2)
        volume.SetSampleDimensions(3, 3, 3)
        for height in HEIGHTS:
            volume.AddReferenceData(plane(5, height, 16))
        volume.Update()
        self.assertEqual(volume.GetNumberOfMeasuredSamples(), 27)
        self.assertLess(volume.GetLargestError(), TOLERANCE)

    def test_remove(self):
        refraction = self.make_geometry()
        refraction.RemoveAllMembranes()
        self.assertEqual(refraction.GetNumberOfMembranes(), 0)
        refraction.SetInterfaces(None)
        refraction.SetMembraneData(plane(5, 0, 8))
        refraction.SetInteriorIndexOfRefraction(MEDIA[1])
        refraction.Update()
        self.assertEqual(refraction.GetOutput().GetNumberOfPoints(), 25)
        self.assertFalse(refraction.GetOutput().GetPointData().HasArray("LastSightPoint"))


if __name__ == "__main__":
    unittest.main()
