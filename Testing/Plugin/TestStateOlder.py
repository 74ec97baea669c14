# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The state file OlderState.pvsm, as a version would have written it that had no membranes of
volumes, did not follow the camera and lacked much else, loads and gives the picture of the same
scene made now, bit for bit. ParaView saved that scene. Then all properties at their defaults were
removed from the file, including those that later versions added, and unknown properties were
added."""
import os

import PluginTesting
from PluginTesting import SIZE, covered, screenshot
from paraview import simple

EYE = [4, 6, 30]
STATE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "OlderState.pvsm")


def make_scene(points, space):
    """The scene with these colours, as the default ones depend on ParaView's version."""
    grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-4, 4] * 3))
    view = PluginTesting.make_view()
    view.UseFXAA = 0
    display = simple.Show(grid, view)
    display.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(display, ("POINTS", "RTData"))
    colors = simple.GetColorTransferFunction("RTData")
    colors.ColorSpace = space
    colors.RGBPoints = points
    display.SetScalarBarVisibility(view, False)
    display.BlendMode = "Isosurface"
    display.IsosurfaceValues = [150.0, 220.0]
    display.Shade = 1
    ball = simple.Sphere(Center=[6, 0, 0], Radius=2)
    water = simple.Plane(Origin=[-9, -9, 6], Point1=[9, -9, 6], Point2=[-9, 9, 6], XResolution=5,
                         YResolution=5)
    refracted = simple.RefractedGeometry(Geometry=ball, Membrane=water, EyePosition=EYE)
    refracted.InteriorIndexOfRefraction = 1.5
    simple.Show(refracted, view).ColorArrayName = [None, ""]
    simple.Render(view)
    view.CameraPosition = [8, 12, 40]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    return view


def check_properties(view):
    grid, = [proxy for proxy in simple.GetSources().values()
             if proxy.GetXMLName() == "DataSetTriangleFilter"]
    display = simple.GetDisplayProperties(grid, view)
    assert display.Membrane is None and display.Backend == "Automatic"
    refracted, = [proxy for proxy in simple.GetSources().values()
                  if proxy.GetXMLName() == "RefractedGeometry"]
    assert not refracted.FollowCamera and list(refracted.EyePosition) == EYE
    assert refracted.Images == "All images"


def test():
    PluginTesting.load_plugin()
    simple.LoadState(STATE)
    view = simple.GetActiveView()
    loaded = screenshot(view, "OlderLoaded")
    assert len(covered(loaded)) > 0.1 * SIZE**2
    check_properties(view)
    colors = simple.GetColorTransferFunction("RTData")
    points, space = list(colors.RGBPoints), colors.ColorSpace
    simple.ResetSession()
    expected = screenshot(make_scene(points, space), "OlderExpected")
    different = sum(a != b for a, b in zip(loaded, expected))
    assert not different, "%d pixels differ" % different


if __name__ == "__main__":
    PluginTesting.run(test)
