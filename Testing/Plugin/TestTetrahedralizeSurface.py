# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A closed surface filled with tetrahedra, and drawn as a volume; with a program for TetGen also by
TetGen, and the space around a mesh filled with hidden cells."""
import os

import PluginTesting
from paraview import servermanager, simple


def test():
    PluginTesting.load_plugin()
    octahedron = simple.Sphere(Radius=1, PhiResolution=3, ThetaResolution=4)
    stretched = simple.Calculator(Input=octahedron, CoordinateResults=1,
                                  Function="iHat*coordsX+jHat*1.3*coordsY+kHat*0.8*coordsZ")
    field = simple.Calculator(Input=stretched, ResultArrayName="height", Function="coordsZ")
    # The plugin has no TetGen of its own.
    solid = simple.TetrahedralizeSurface(Input=field, Mesher="Delaunay")
    volume = servermanager.Fetch(simple.IntegrateVariables(Input=solid))
    assert servermanager.Fetch(solid).GetNumberOfCells() == 4
    size = volume.GetCellData().GetArray("Volume").GetValue(0)
    # Points are rounded to floats.
    assert abs(size - 4 / 3 * 1.3 * 0.8) < 1e-6, size

    view = PluginTesting.make_view()
    display = simple.Show(solid, view)
    display.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(display, ("POINTS", "height"))
    simple.ResetCamera(view)
    drawn = PluginTesting.covered(PluginTesting.screenshot(view, "TetrahedralizeSurface"))
    assert len(drawn) > 0.1 * PluginTesting.SIZE**2, len(drawn)
    assert solid.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")
    program = os.environ.get("MENISCUS_TETGEN")
    if program:
        test_tetgen(field, size, program)


def test_tetgen(field, size, program):
    solid = simple.TetrahedralizeSurface(Input=field, Mesher="TetGen", MesherProgram=program,
                                         MaximumVolume=0.01)
    cells = servermanager.Fetch(solid).GetNumberOfCells()
    assert cells > size / 0.01, cells
    part = simple.Threshold(Input=solid, Scalars=("POINTS", "height"))
    part.ThresholdMethod, part.UpperThreshold = "Above Upper Threshold", 0.0
    convex = simple.ImaginaryCells(Input=part, MesherProgram=program)
    kept, filled = servermanager.Fetch(part), servermanager.Fetch(convex)
    added = filled.GetNumberOfCells() - kept.GetNumberOfCells()
    ghosts = filled.GetCellData().GetArray("vtkGhostType")
    hidden = sum(ghosts.GetValue(i) == 32 for i in range(filled.GetNumberOfCells()))  # HIDDENCELL
    assert hidden == added > 0, (hidden, added)


if __name__ == "__main__":
    PluginTesting.run(test)
