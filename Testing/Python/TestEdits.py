# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Edits of the input in place are detected, whichever object receives Modified()."""
import unittest

from meniscus import vtkRefractedGeometryFilter
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkMaskPoints
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource


class TestEdits(unittest.TestCase):
    def test_refracted_geometry(self):
        surfaces = []
        for height in (0.0, -1.0):
            plane = vtkPlaneSource()
            plane.SetResolution(4, 4)
            plane.Update()
            surface = vtkPolyData()
            surface.DeepCopy(plane.GetOutput())
            for i in range(25):
                x, y, _ = surface.GetPoint(i)
                surface.GetPoints().SetPoint(i, 4 * x, 4 * y, height)
            surfaces.append(surface)
        water, floor = surfaces
        refraction = vtkRefractedGeometryFilter()
        refraction.SetInputData(0, floor)
        refraction.SetMembraneData(water)
        refraction.SetEyePosition(0.2, 0.1, 5)
        refraction.Update()

        def output():
            refraction.Update()
            out = refraction.GetOutput()
            return [out.GetPoint(i) for i in range(out.GetNumberOfPoints())]

        last = output()
        for surface in surfaces:
            points = surface.GetPoints()
            changed = (points, points.GetData(), surface.GetPointData(), surface)
            for step, told in enumerate(changed):
                x, y, z = surface.GetPoint(12)
                points.SetPoint(12, x, y, z + 0.05 * (step + 1))
                told.Modified()
                patches = refraction.GetNumberOfPatchBuilds()
                now = output()
                self.assertNotEqual(now, last)
                self.assertEqual(
                    refraction.GetNumberOfPatchBuilds() - patches, int(surface is water))
                last = now
                solved = refraction.GetNumberOfSolvedVertices()
                told.Modified()
                self.assertEqual(output(), last)
                self.assertEqual(refraction.GetNumberOfSolvedVertices(), solved)

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
        refraction = vtkRefractedGeometryFilter()
        refraction.SetInputConnection(vertices.GetOutputPort())
        refraction.SetMembraneConnection(surface.GetOutputPort())
        refraction.SetEyePosition(0, 0, 12)
        refraction.SetImagesToFirstImage()
        refraction.Update()
        self.assertGreater(refraction.GetOutput().GetNumberOfPoints(), 100)
        self.assertEqual(objects.GetOutput().GetExtent(), (-4, 4, -4, 4, -5, -1))
        self.assertEqual(field.GetOutput().GetExtent(), (-8, 8, -8, 8, 0, 1))


if __name__ == "__main__":
    unittest.main()
