"""Tetrahedra inside of surfaces: volumes, arrays, errors as they reach Python."""
import math
import sys

import meniscus
from vtkmodules.vtkCommonDataModel import vtkTetra
from vtkmodules.vtkFiltersCore import vtkElevationFilter, vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource


def sum_volumes(mesh):
    total = 0.0
    for cell in range(mesh.GetNumberOfCells()):
        points = mesh.GetCell(cell).GetPoints()
        volume = vtkTetra.ComputeVolume(*(points.GetPoint(i) for i in range(4)))
        assert volume > 0.0
        total += volume
    return total


def check(mesher):
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(17)
    sphere.SetPhiResolution(13)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(sphere.GetOutputPort())
    height = vtkElevationFilter()
    height.SetInputConnection(triangles.GetOutputPort())
    height.SetLowPoint(0, 0, -0.5)
    height.SetHighPoint(0, 0, 0.5)
    filler = meniscus.vtkTetrahedralizeSurface()
    filler.SetInputConnection(height.GetOutputPort())
    filler.SetMesher(mesher)
    filler.Update()
    mesh = filler.GetOutput()
    assert filler.GetUsedMesher() == mesher
    truth = vtkMassProperties()
    truth.SetInputConnection(triangles.GetOutputPort())
    truth.Update()
    assert math.isclose(sum_volumes(mesh), truth.GetVolume(), rel_tol=1e-5)
    values = mesh.GetPointData().GetArray("Elevation")
    for point in range(mesh.GetNumberOfPoints()):
        assert abs(values.GetValue(point) - mesh.GetPoint(point)[2] - 0.5) < 1e-5


def check_error():
    texts = []

    def note(_caller, _event, text):
        texts.append(text)

    note.CallDataType = "string0"
    plane = vtkPlaneSource()
    filler = meniscus.vtkTetrahedralizeSurface()
    filler.SetInputConnection(plane.GetOutputPort())
    filler.AddObserver("ErrorEvent", note)
    filler.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)  # its own message
    filler.Update()
    assert len(texts) == 1 and "The surface is open: 4 edges" in texts[0], texts
    assert filler.GetOutput().GetNumberOfCells() == 0


def main():
    filler = meniscus.vtkTetrahedralizeSurface()
    if filler.HasTetGen():
        check(filler.TETGEN)
    check_error()
    return 0


if __name__ == "__main__":
    sys.exit(main())
