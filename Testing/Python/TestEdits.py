# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Edits of the input in place are detected, whichever object receives Modified()."""
import unittest

from meniscus import vtkRefractedGeometryFilter
from VolumeWindow import make_wavelet, VolumeWindow
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkPlaneSource


class TestEdits(unittest.TestCase):
    def make_volume(self):
        wavelet = make_wavelet(2)
        wavelet.Update()
        self.grid = vtkUnstructuredGrid()
        self.grid.DeepCopy(wavelet.GetOutput())
        self.window = VolumeWindow(100, 0, 300)
        self.window.mapper.SetInputData(self.grid)
        self.window.draw()

    def draw(self):
        """The image, and the work done for it."""
        before = self.window.work()
        return self.window.draw(), tuple(b - a for a, b in zip(before, self.window.work()))

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
