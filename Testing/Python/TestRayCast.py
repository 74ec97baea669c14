# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The mapper draws a tetrahedral mesh from Python and counts its work."""
import unittest

from meniscus import vtkTetrahedraRayCastMapper
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkVolume

SIZE = 200


class TestRayCast(unittest.TestCase):
    def setUp(self):
        field = vtkRTAnalyticSource()
        field.SetWholeExtent(-5, 5, -5, 5, -5, 5)
        tetrahedra = vtkDataSetTriangleFilter()
        tetrahedra.SetInputConnection(field.GetOutputPort())
        self.mapper = vtkTetrahedraRayCastMapper()
        self.mapper.SetInputConnection(tetrahedra.GetOutputPort())
        self.volume = vtkVolume()
        self.volume.SetMapper(self.mapper)
        colors = self.volume.GetProperty().GetRGBTransferFunction()
        colors.AddRGBSegment(37, 0, 0.3, 1, 277, 1, 0.4, 0)
        opacity = self.volume.GetProperty().GetScalarOpacity()
        opacity.RemoveAllPoints()
        opacity.AddSegment(37, 0, 277, 0.5)
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(self.volume)
        self.window = vtkRenderWindow()
        self.window.SetSize(SIZE, SIZE)
        self.window.AddRenderer(self.renderer)

    def count_drawn(self):
        self.window.Render()
        pixels = vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, SIZE - 1, SIZE - 1, 0, pixels, 0)
        return sum(max(pixels.GetTuple3(i)) > 2 for i in range(SIZE * SIZE))

    def test_draws(self):
        self.assertGreater(self.count_drawn(), 0.1 * SIZE * SIZE)
        self.assertIn(self.mapper.GetActiveBackend(), (self.mapper.OPENGL, self.mapper.NATIVE))
        self.assertEqual(self.mapper.GetNumberOfLostRays(), 0)
        self.volume.VisibilityOff()
        self.assertEqual(self.count_drawn(), 0)

    def test_camera_move_rebuilds_nothing(self):
        self.window.Render()
        builds = self.mapper.GetNumberOfMeshBuilds()
        uploaded = self.mapper.GetUploadedBytes()
        self.assertEqual(builds, 1)
        self.assertGreater(uploaded, 0)
        self.renderer.GetActiveCamera().Azimuth(20)
        self.window.Render()
        self.assertEqual(self.mapper.GetNumberOfMeshBuilds(), builds)
        self.assertEqual(self.mapper.GetUploadedBytes(), uploaded)


if __name__ == "__main__":
    unittest.main()
