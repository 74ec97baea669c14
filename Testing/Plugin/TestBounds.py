# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Bounds of the representation, and with them Reset Camera, are those of what is drawn: of cells
with a volume, without unused points, with the refracting surface."""
import PluginTesting
from paraview import simple
from PluginTesting import SIZE, covered, screenshot
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

ORIGIN = (500000.0, 5400000.0, 200.0)  # coordinates of a map
SIDE = 100.0
HEXAHEDRON, TRIANGLE = 12, 5


def make_cube():
    """A cube, a point at the origin that no cell uses, and a triangle above the cube."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1),
               (0, 1, 1), (0, 0, 9), (1, 0, 9), (1, 1, 9)]
    for corner in corners:
        points.InsertNextPoint([o + SIDE * c for o, c in zip(ORIGIN, corner)])
    points.InsertNextPoint(0, 0, 0)
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.InsertNextCell(HEXAHEDRON, 8, list(range(8)))
    grid.InsertNextCell(TRIANGLE, 3, [8, 9, 10])
    values = vtkDoubleArray()
    values.SetName("height")
    for i in range(points.GetNumberOfPoints()):
        values.InsertNextValue(points.GetPoint(i)[2])
    grid.GetPointData().AddArray(values)
    return grid


def box(top):
    return [bound for i, upper in enumerate((1, 1, top))
            for bound in (ORIGIN[i], ORIGIN[i] + SIDE * upper)]


def check_camera(view, wanted):
    simple.Render(view)
    simple.ResetCamera(view)
    center = [(wanted[2 * i] + wanted[2 * i + 1]) / 2 for i in range(3)]
    size = sum((wanted[2 * i + 1] - wanted[2 * i]) ** 2 for i in range(3)) ** 0.5
    focus = list(view.CameraFocalPoint)
    assert max(abs(a - b) for a, b in zip(focus, center)) < 1e-3 * size, (focus, center)
    # Half the diagonal, the parallel scale that shows all of the box.
    assert abs(view.CameraParallelScale / (size / 2) - 1) < 1e-3, view.CameraParallelScale


def test():
    PluginTesting.load_plugin()
    view = PluginTesting.make_view()
    mesh = simple.TrivialProducer()
    mesh.SMProxy.GetClientSideObject().SetOutput(make_cube())
    display = simple.Show(mesh, view)
    display.SetRepresentationType("Volume (Exact)")
    display.ScalarOpacityUnitDistance = SIDE / 100
    check_camera(view, box(1))
    pixels = len(covered(screenshot(view, "Bounds")))
    assert pixels > 0.1 * SIZE**2, pixels

    low, high = box(3), box(3)
    water = simple.Plane(Origin=[low[0], low[2], high[5]], Point1=[high[1], low[2], high[5]],
                         Point2=[low[0], high[3], high[5]])
    display.Membrane = water
    check_camera(view, box(3))
    display.Membrane = None
    # Of the volume, as Transforming has it; ParaView 5.13 has another name for it.
    move = "Translation" if "Translation" in display.ListProperties() else "Position"
    display.SetPropertyWithName(move, [0, 0, SIDE])
    moved = box(1)
    moved[4] += SIDE
    moved[5] += SIDE
    check_camera(view, moved)
    display.SetPropertyWithName(move, [0, 0, 0])
    # Another representation is measured as before.
    display.SetRepresentationType("Outline")
    simple.Render(view)
    simple.ResetCamera(view)
    assert view.CameraParallelScale > 1e6


if __name__ == "__main__":
    PluginTesting.run(test)
