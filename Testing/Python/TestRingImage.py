# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A regression image as VTK's Python tests have them: a ring of voxels, lit."""
import meniscus
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.test import Testing
from vtkmodules.vtkCommonDataModel import vtkSuperquadric
from vtkmodules.vtkImagingHybrid import vtkSampleFunction
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkVolume


class TestRingImage(Testing.vtkTest):
    def testRing(self):
        torus = vtkSuperquadric()  # negative inside of a ring
        torus.ToroidalOn()
        torus.SetSize(0.9)
        field = vtkSampleFunction()
        field.SetImplicitFunction(torus)
        field.SetSampleDimensions(24, 24, 24)
        mapper = meniscus.vtkTetrahedraRayCastMapper()
        mapper.SetInputConnection(field.GetOutputPort())
        volume = vtkVolume()
        volume.SetMapper(mapper)
        look = volume.GetProperty()
        look.GetRGBTransferFunction().AddRGBSegment(-1, 1, 0.4, 0, 1, 0, 0.3, 1)
        look.GetScalarOpacity().RemoveAllPoints()
        look.GetScalarOpacity().AddSegment(-1, 1, 1, 0)
        look.SetScalarOpacityUnitDistance(0.2)
        look.ShadeOn()
        renderer = vtkRenderer()
        renderer.AddVolume(volume)
        renderer.SetBackground(1, 1, 1)
        renderer.GetActiveCamera().SetPosition(1, 3, 2)
        renderer.ResetCamera()
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(0)
        window.SetSize(300, 300)
        window.AddRenderer(renderer)
        window.Render()
        self.assertImageMatch(window, "TestRingImage.png")


if __name__ == "__main__":
    Testing.main([(TestRingImage, "test")])
