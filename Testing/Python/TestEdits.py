# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Edits of the input in place are detected, whichever object receives Modified()."""
import unittest

from meniscus import vtkRefractedGeometryFilter, vtkTetrahedraRayCastMapper
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkVolume

SIZE = 100


class TestEdits(unittest.TestCase):
    def make_volume(self):
        field = vtkRTAnalyticSource()
        field.SetWholeExtent(-2, 2, -2, 2, -2, 2)
        tetrahedra = vtkDataSetTriangleFilter()
        tetrahedra.SetInputConnection(field.GetOutputPort())
        tetrahedra.Update()
        self.grid = vtkUnstructuredGrid()
        self.grid.DeepCopy(tetrahedra.GetOutput())
        self.mapper = vtkTetrahedraRayCastMapper()
        self.mapper.SetInputData(self.grid)
        volume = vtkVolume()
        volume.SetMapper(self.mapper)
        volume.GetProperty().GetRGBTransferFunction().AddRGBSegment(0, 0, 0.2, 1, 300, 1, 0.4, 0)
        opacity = volume.GetProperty().GetScalarOpacity()
        opacity.RemoveAllPoints()
        opacity.AddSegment(0, 0, 300, 1)
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(volume)
        self.window = vtkRenderWindow()
        self.window.SetSize(SIZE, SIZE)
        self.window.AddRenderer(self.renderer)
        self.window.Render()

    def work(self):
        return (self.mapper.GetNumberOfMeshBuilds(),
                self.mapper.GetStatistic("NumberOfPointUpdates"),
                self.mapper.GetNumberOfScalarUpdates())

    def draw(self):
        """The image, and the work done for it."""
        before = self.work()
        self.window.Render()
        pixels = vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, SIZE - 1, SIZE - 1, 0, pixels, 0)
        return bytes(memoryview(pixels)), tuple(b - a for a, b in zip(before, self.work()))

    def test_volume(self):
        self.make_volume()
        scalars = self.grid.GetPointData().GetScalars()
        last, _ = self.draw()
        for step, told in enumerate((scalars, self.grid.GetPointData(), self.grid)):
            scalars.SetValue(62, 40.0 * step)
            told.Modified()
            picture, work = self.draw()
            self.assertEqual(work, (0, 0, 1))
            self.assertNotEqual(picture, last)
            last = picture
            told.Modified()
            self.assertEqual(self.draw(), (last, (0, 0, 0)))
        points = self.grid.GetPoints()
        for step, told in enumerate((points, points.GetData(), self.grid)):
            points.SetPoint(62, 0.1 + 0.1 * step, 0, 0)
            told.Modified()
            picture, work = self.draw()
            self.assertEqual(work, (0, 1, 0))
            self.assertNotEqual(picture, last)
            last = picture
            told.Modified()
            self.assertEqual(self.draw(), (last, (0, 0, 0)))

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


if __name__ == "__main__":
    unittest.main()
