# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A volume seen through several interfaces: an isosurface behind a pane, and behind a ball, is
where the filter Refracted Geometry puts its contour; rows that do not fit are an error."""
import PluginTesting
import TestRayCastMembrane
from PluginTesting import covered, screenshot
from paraview import simple
from TestRayCastMembrane import EYE, SHARE_OF_OUTLINES, VALUE

PANE = [0, 1.0, 1.5, 1, 1.5, 1.333]
BALL = [0, 1.0, 1.1, 0, 1.0, 1.1]


def sheet(height, slope):
    """A square across the view, flat or with waves."""
    plane = simple.Plane(Origin=[-14, -14, height], Point1=[14, -14, height],
                         Point2=[-14, 14, height], XResolution=40, YResolution=40)
    waves = "coords+kHat*%g*sin(0.5*coordsX)*cos(0.4*coordsY)" % slope
    return simple.Calculator(Input=plane, CoordinateResults=1, Function=waves)


def show(view, grid):
    display = TestRayCastMembrane.show(view, grid)
    display.BlendMode = "Isosurface"
    display.IsosurfaceValues = [VALUE]
    opacity = simple.GetOpacityTransferFunction("RTData")
    points = list(opacity.Points)
    opacity.Points = [points[0], 1.0, 0.5, 0.0, points[-4], 1.0, 0.5, 0.0]
    return display


def check_contour(view, grid, name, seen, surfaces, rows, images):
    """The picture `seen` against that of the contour's virtual geometry."""
    simple.Hide(grid, view)
    contour = simple.Contour(Input=grid, ContourBy=["POINTS", "RTData"], Isosurfaces=[VALUE])
    refracted = simple.RefractedGeometry(Geometry=contour, Membrane=surfaces, EyePosition=EYE,
                                         Interfaces=rows, Images=images,
                                         AngularTolerance=0.05)
    virtual = simple.Show(refracted, view)
    simple.ColorBy(virtual, None)
    expected = covered(screenshot(view, name + "Contour"))
    assert len(expected) > 500, len(expected)
    simple.Delete(refracted)
    simple.Delete(contour)
    simple.Show(grid, view)
    share = len(covered(seen) ^ expected) / len(covered(seen) | expected)
    print("%s: %.1f%% of the pixels differ from the contour's" % (name, 100 * share))
    assert share < SHARE_OF_OUTLINES, share


def check_pane(view, display, grid, straight):
    surfaces = [sheet(16, 0.3), sheet(13, 0.0)]
    display.Membrane = surfaces[0]
    display.InteriorIndexOfRefraction = 1.5
    one = screenshot(view, "StacksOne")
    display.Interfaces = [0, 1.0, 1.5]
    assert screenshot(view, "StacksOneRow") == one, "one row"
    display.SecondMembrane = surfaces[1]
    display.Interfaces = PANE
    pane = screenshot(view, "StacksPane")
    assert pane not in (one, straight)
    check_contour(view, grid, "StacksPane", pane, surfaces, PANE, "All images")

    assert screenshot(view, "StacksAgain") == pane
    display.Interfaces = [0, 1.0, 1.0, 1, 1.0, 1.0]
    assert screenshot(view, "StacksEqual") == straight, "equal indices"
    surfaces[1].Function = "coords"
    display.Interfaces = PANE
    assert screenshot(view, "StacksPaneAgain") == pane
    display.SecondMembrane = None
    display.Interfaces = []
    assert screenshot(view, "StacksNoRows") == one, "without rows"


def check_ball(view, display, grid):
    """A closed body is one surface in two rows."""
    ball = simple.Sphere(Center=[0, 0, 24], Radius=14, ThetaResolution=32, PhiResolution=17)
    display.Membrane = ball
    display.Interfaces = BALL
    seen = screenshot(view, "StacksBall")
    check_contour(view, grid, "StacksBall", seen, [ball], BALL, "All images")


def check_faults(view, display, straight):
    """Rows that name another surface: an error, and straight rays."""
    told, stop = PluginTesting.listen(display, "ErrorEvent")
    display.Interfaces = [0, 1.0, 1.5, 4, 1.5, 1.333]
    assert screenshot(view, "StacksFault") == straight
    assert told and "names surface 4; there are 1" in told[0], told
    del told[:]
    display.Membrane = None
    display.Interfaces = PANE
    assert screenshot(view, "StacksNone") == straight and not told, told
    stop()


def test():
    PluginTesting.load_plugin()
    grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-6, 6] * 3))
    view = PluginTesting.make_view()
    display = show(view, grid)
    straight = screenshot(view, "StacksStraight")
    check_pane(view, display, grid, straight)
    check_ball(view, display, grid)
    check_faults(view, display, straight)


if __name__ == "__main__":
    PluginTesting.run(test)
