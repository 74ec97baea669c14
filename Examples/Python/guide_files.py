# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the files that the guides read to the current folder: mesh.vtu, the array "density" of two
linked rings on 69,120 tetrahedra; object.vtp, a torus; and water.vtp, waves that it intersects."""
import math

from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource, vtkPlaneSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

# Points of mesh.vtu along an axis, from -10 to 10.
POINTS = 25


def ring_density(x, y, z):
    """Two rings of radius 5 that are linked, each with a Gaussian profile."""
    first = (math.hypot(x + 2.5, y) - 5) ** 2 + z ** 2
    second = (math.hypot(x - 2.5, z) - 5) ** 2 + y ** 2
    return math.exp(-first / 3) + math.exp(-second / 3)


def make_field():
    """The image of ring_density()."""
    field, density = vtkImageData(), vtkFloatArray()
    field.SetDimensions(POINTS, POINTS, POINTS)
    field.SetOrigin(-10.0, -10.0, -10.0)
    field.SetSpacing(*[20.0 / (POINTS - 1)] * 3)
    density.SetName("density")
    for p in range(field.GetNumberOfPoints()):
        density.InsertNextValue(ring_density(*field.GetPoint(p)))
    field.GetPointData().SetScalars(density)
    return field


def make_waves(plane):
    """Adds waves to a plane, with their normals."""
    points, normals = plane.GetPoints(), plane.GetPointData().GetNormals()
    for p in range(points.GetNumberOfPoints()):
        x, y, z = points.GetPoint(p)
        points.SetPoint(p, x, y, z + 0.04 * math.sin(4 * x + y) + 0.03 * math.sin(2 * x - 5 * y))
        along = -0.16 * math.cos(4 * x + y) - 0.06 * math.cos(2 * x - 5 * y)
        across = -0.04 * math.cos(4 * x + y) + 0.15 * math.cos(2 * x - 5 * y)
        length = math.sqrt(along ** 2 + across ** 2 + 1)
        normals.SetTuple3(p, along / length, across / length, 1 / length)


def write_files():
    """In ASCII, for every reader."""
    tetrahedra = vtkDataSetTriangleFilter()
    tetrahedra.SetInputData(make_field())
    torus = vtkParametricFunctionSource()
    torus.SetParametricFunction(vtkParametricTorus())
    water = vtkPlaneSource()
    water.SetOrigin(-2.0, -2.0, 0.2)
    water.SetPoint1(2.0, -2.0, 0.2)
    water.SetPoint2(-2.0, 2.0, 0.2)
    water.SetResolution(80, 80)
    water.Update()
    make_waves(water.GetOutput())
    for name, writer, source in [("mesh.vtu", vtkXMLUnstructuredGridWriter(), tetrahedra),
                                 ("object.vtp", vtkXMLPolyDataWriter(), torus),
                                 ("water.vtp", vtkXMLPolyDataWriter(), water)]:
        writer.SetInputConnection(source.GetOutputPort())
        writer.SetDataModeToAscii()
        writer.SetFileName(name)
        writer.Write()


if __name__ == "__main__":
    write_files()
