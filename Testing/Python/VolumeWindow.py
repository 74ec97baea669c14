# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A window with one volume, for tests that draw in it."""
from meniscus import vtkTetrahedraRayCastMapper
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkVolume


def make_wavelet(reach):
    """A filter whose output is VTK's wavelet over [-reach, reach]^3, in tetrahedra."""
    field = vtkRTAnalyticSource()
    field.SetWholeExtent(-reach, reach, -reach, reach, -reach, reach)
    tetrahedra = vtkDataSetTriangleFilter()
    tetrahedra.SetInputConnection(field.GetOutputPort())
    return tetrahedra


class VolumeWindow:
    """Scalars from `low` to `high` are blue to orange, and as opaque as 0 to `opacity`."""

    def __init__(self, size, low, high, opacity=1.0):
        self.size = size
        self.mapper = vtkTetrahedraRayCastMapper()
        self.volume = vtkVolume()
        self.volume.SetMapper(self.mapper)
        volume_property = self.volume.GetProperty()
        volume_property.GetRGBTransferFunction().AddRGBSegment(low, 0, 0.2, 1, high, 1, 0.4, 0)
        volume_property.GetScalarOpacity().RemoveAllPoints()
        volume_property.GetScalarOpacity().AddSegment(low, 0, high, opacity)
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(self.volume)
        self.window = vtkRenderWindow()
        self.window.SetSize(size, size)
        self.window.AddRenderer(self.renderer)

    def draw(self):
        """The picture: three bytes per pixel."""
        self.window.Render()
        pixels = vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, self.size - 1, self.size - 1, 0, pixels, 0)
        return bytes(memoryview(pixels))

    def work(self):
        """Builds of the mesh, updates of its points and of its scalars so far."""
        return (self.mapper.GetNumberOfMeshBuilds(),
                self.mapper.GetStatistic("NumberOfPointUpdates"),
                self.mapper.GetNumberOfScalarUpdates())
