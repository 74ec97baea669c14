# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Cells of flat water: their edges obey Snell's law and have the length that was asked for."""
import math

import PluginTesting
from paraview import servermanager, simple

EYE = [0.2, 0.1, 2]
WATER = 1.333
LENGTH = 1.5


def sine_to_vertical(start, end):
    return math.hypot(end[0] - start[0], end[1] - start[1]) / math.dist(start, end)


def test():
    PluginTesting.load_plugin()
    water = simple.Plane(Origin=[-1, -1, 0], Point1=[1, -1, 0], Point2=[-1, 1, 0],
                         XResolution=4, YResolution=4)
    cells = simple.MembraneCells(Membrane=simple.Triangulate(Input=water), EyePosition=EYE)
    cells.CellLength = LENGTH
    grid = servermanager.Fetch(cells)
    assert grid.GetNumberOfCells() == 32, grid.GetNumberOfCells()
    for number in range(grid.GetNumberOfCells()):
        ids = grid.GetCell(number).GetPointIds()
        for corner in range(3):
            near = grid.GetPoint(ids.GetId(corner))
            far = grid.GetPoint(ids.GetId(corner + 3))
            assert abs(math.dist(near, far) - LENGTH) < 1e-9
            sine = WATER * sine_to_vertical(near, far)
            assert abs(sine - sine_to_vertical(EYE, near)) < 1e-9, number
            path = grid.GetPointData().GetArray("OpticalPath").GetValue(ids.GetId(corner + 3))
            assert abs(path - math.dist(EYE, near) - WATER * LENGTH) < 1e-9
    assert cells.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")
    view = PluginTesting.make_view()
    simple.Show(cells, view)
    simple.ResetCamera(view)
    drawn = PluginTesting.covered(PluginTesting.screenshot(view, "MembraneCells"))
    assert len(drawn) > 0.05 * PluginTesting.SIZE**2, "the picture is all but empty"


if __name__ == "__main__":
    PluginTesting.run(test)
