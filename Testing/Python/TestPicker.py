# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Picks by pixel from Python, without a frame: a block of voxels has closed forms."""
import math
import unittest

from meniscus import (vtkTetrahedraRayCastMapper, vtkTetrahedraRayIntegral,
                      vtkTetrahedraVolumePicker)
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIdTypeArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import (vtkAbstractPropPicker, vtkRenderer, vtkRenderWindow,
                                         vtkVolume, vtkVolumeProperty)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401

SIZE = 60


def make_block():
    """Voxels over [-1, 1]^3 with the point array `density` = (1 - z) / 2."""
    block = vtkImageData()
    block.SetDimensions(5, 5, 5)
    block.SetOrigin(-1, -1, -1)
    block.SetSpacing(0.5, 0.5, 0.5)
    density = vtkDoubleArray()
    density.SetName("density")
    for i in range(block.GetNumberOfPoints()):
        density.InsertNextValue(0.5 - 0.5 * block.GetPoint(i)[2])
    block.GetPointData().SetScalars(density)
    return block


class TestPicker(unittest.TestCase):
    def setUp(self):
        self.block = make_block()
        self.mapper = vtkTetrahedraRayCastMapper()
        self.mapper.SetInputData(self.block)
        opacity = vtkPiecewiseFunction()
        opacity.AddPoint(0, 0)
        opacity.AddPoint(1, 1)
        self.property = vtkVolumeProperty()
        self.property.SetScalarOpacity(opacity)
        self.property.SetScalarOpacityUnitDistance(0.5)
        volume = vtkVolume()
        volume.SetMapper(self.mapper)
        volume.SetProperty(self.property)
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(volume)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetSize(SIZE, SIZE)
        self.window.AddRenderer(self.renderer)
        camera = self.renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetPosition(0, 0, 5)
        camera.SetParallelScale(1.5)
        camera.SetClippingRange(0.1, 100)
        self.picker = vtkTetrahedraVolumePicker()

    def test_every_pixel(self):
        """Attenuation t, 0 at the front: opacity 1 - exp(-t^2 / 2); t exp(-t^2 / 2) has its
        largest value at 1."""
        self.assertIsInstance(self.picker, vtkAbstractPropPicker)
        picked = 0
        for row in range(0, SIZE, 7):
            for column in range(0, SIZE, 7):
                x = 3 * (column + 0.5) / SIZE - 1.5
                y = 3 * (row + 0.5) / SIZE - 1.5
                inside = max(abs(x), abs(y)) < 1
                self.assertEqual(self.picker.Pick(column, row, 0, self.renderer), int(inside))
                if not inside:
                    self.assertEqual(self.picker.GetCellId(), -1)
                    self.assertTrue(math.isnan(self.picker.GetValue()))
                    continue
                picked += 1
                for found, truth in zip(self.picker.GetPickPosition(), (x, y, 0)):
                    self.assertAlmostEqual(found, truth, delta=4e-6)
                self.assertAlmostEqual(self.picker.GetValue(), 0.5, delta=1e-6)
                self.assertAlmostEqual(
                    self.picker.GetDepthOf(self.picker.OPACITY_REACHED),
                    4 + math.sqrt(2 * math.log(2)), delta=4e-6)
                bounds = self.block.GetCell(self.picker.GetCellIdOf(1)).GetBounds()
                position = [0, 0, 0]
                self.assertTrue(self.picker.GetPositionOf(1, position))
                for axis in range(3):
                    self.assertLessEqual(bounds[2 * axis], position[axis] + 4e-6)
                    self.assertGreaterEqual(bounds[2 * axis + 1], position[axis] - 4e-6)
        self.assertGreater(picked, 20)
        self.assertEqual(self.mapper.GetStatistic("NumberOfCastImages"), 0)
        self.assertEqual(self.mapper.GetNumberOfMeshBuilds(), 1)
        self.assertEqual(self.mapper.GetStatistic("NumberOfCellSearches"), 1)

    def test_image(self):
        rays = vtkTetrahedraRayIntegral()
        rays.SetInputData(self.block)
        rays.SetImageSize(SIZE, SIZE)
        rays.SetCamera(self.renderer.GetActiveCamera())
        rays.SetVolumeProperty(self.property)
        rays.GetArraySelection().DisableArray("Integral")
        rays.GetArraySelection().EnableArray("LargestContribution")
        rays.Update()
        data = rays.GetOutput().GetPointData()
        cells = data.GetArray("LargestContributionCellId")
        self.assertIsInstance(cells, vtkIdTypeArray)
        depths = data.GetArray("LargestContributionDepth")
        found = 0
        for pixel in range(0, SIZE * SIZE, 13):
            if cells.GetValue(pixel) < 0:
                self.assertTrue(math.isnan(depths.GetValue(pixel)))
                continue
            found += 1
            self.assertAlmostEqual(depths.GetValue(pixel), 5, delta=4e-6)
            self.assertEqual(self.picker.Pick(pixel % SIZE, pixel // SIZE, 0, self.renderer), 1)
            self.assertEqual(self.picker.GetDataSet(), self.block)
        self.assertGreater(found, 100)

    def test_bad_input(self):
        self.assertEqual(self.picker.Pick(-5, 10, 0, self.renderer), 0)
        self.picker.SetOpacityThreshold(7)
        self.assertEqual(self.picker.GetOpacityThreshold(), 1)
        self.picker.SetPlace(-3)
        self.assertEqual(self.picker.GetPlace(), self.picker.FIRST_VISIBLE)
        self.assertFalse(self.picker.GetPositionOf(9, [0, 0, 0]))


if __name__ == "__main__":
    unittest.main()
