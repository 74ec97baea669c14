# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A closed surface filled with tetrahedra, and drawn as a volume."""
import PluginTesting
from paraview import servermanager, simple


def test():
    PluginTesting.load_plugin()
    octahedron = simple.Sphere(Radius=1, PhiResolution=3, ThetaResolution=4)
    stretched = simple.Calculator(Input=octahedron, CoordinateResults=1,
                                  Function="iHat*coordsX+jHat*1.3*coordsY+kHat*0.8*coordsZ")
    field = simple.Calculator(Input=stretched, ResultArrayName="height", Function="coordsZ")
    # The plugin's build has no TetGen.
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


if __name__ == "__main__":
    PluginTesting.run(test)
