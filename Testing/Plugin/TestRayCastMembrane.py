# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A volume seen through a membrane: an isosurface is where the filter Refracted Geometry puts its
contour; the membrane follows its pipeline, may have blocks, and can be taken away again."""
import PluginTesting
from PluginTesting import covered, screenshot
from paraview import simple

EYE = [6, -9, 40]
VALUE = 200.0
WAVES = "coords+kHat*%g*sin(0.5*coordsX)*cos(0.4*coordsY)"
# Of the pixels covered by either, those along the outlines, where pixels of the one are of points and
# of the other of triangles: a length of about 4 diameters, two pixels wide.
SHARE_OF_OUTLINES = 0.05


def make_waves(height=16.0):
    plane = simple.Plane(Origin=[-14, -14, height], Point1=[14, -14, height],
                         Point2=[-14, 14, height], XResolution=60, YResolution=60)
    return simple.Calculator(Input=plane, CoordinateResults=1,
                             Function=WAVES % 0.3)


def show(view, grid):
    display = simple.Show(grid, view)
    display.SetRepresentationType("Tetrahedra Ray Cast")
    simple.ColorBy(display, ("POINTS", "RTData"))
    view.CameraPosition = EYE
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    return display


def check_place(view, display, grid, waves):
    """Opaque, so that pixels are covered or not."""
    display.BlendMode = "Isosurface"
    display.IsosurfaceValues = [VALUE]
    opacity = simple.GetOpacityTransferFunction("RTData")
    kept = list(opacity.Points)
    opacity.Points = [kept[0], 1.0, 0.5, 0.0, kept[-4], 1.0, 0.5, 0.0]
    straight = covered(screenshot(view, "MembraneIsosurfaceStraight"))
    display.Membrane = waves
    seen = covered(screenshot(view, "MembraneIsosurface"))
    simple.Hide(grid, view)

    contour = simple.Contour(Input=grid, ContourBy=["POINTS", "RTData"], Isosurfaces=[VALUE])
    refracted = simple.RefractedGeometry(Geometry=contour, Membrane=waves, EyePosition=EYE)
    virtual = simple.Show(refracted, view)
    simple.ColorBy(virtual, None)
    expected = covered(screenshot(view, "MembraneContour"))
    simple.Delete(refracted)
    simple.Show(grid, view)
    share = len(seen ^ expected) / len(seen | expected)
    moved = len(straight ^ expected) / len(straight | expected)
    print("%.1f%% of the pixels differ from the contour's; %.1f%% without membrane"
          % (100 * share, 100 * moved))
    assert share < SHARE_OF_OUTLINES < moved
    opacity.Points = kept
    display.BlendMode = "Composite"


def check_changes(view, display, waves, straight):
    bent = screenshot(view, "MembraneBent")
    assert bent != straight
    display.InteriorIndexOfRefraction = 1.0
    assert screenshot(view, "MembraneEqual") == straight, "equal indices"
    display.InteriorIndexOfRefraction = 1.333

    waves.Function = WAVES % 0.6
    assert screenshot(view, "MembraneHigher") != bent, "the membrane does not follow its pipeline"
    waves.Function = WAVES % 0.3
    assert screenshot(view, "MembraneAgain") == bent

    view.SMProxy.InteractiveRender()
    display.Membrane = simple.GroupDatasets(Input=[waves])
    assert screenshot(view, "MembraneOfBlocks") == bent, "blocks"
    display.Membrane = None
    assert screenshot(view, "MembraneNone") == straight, "the membrane is still there"


def check_empty(view, display, straight):
    """A membrane without cells, as a clip may leave, is told of; rays are straight."""
    nothing = simple.Contour(Input=simple.Wavelet(WholeExtent=[0, 1] * 3),
                             ContourBy=["POINTS", "RTData"], Isosurfaces=[1e9])
    display.Membrane = nothing
    assert screenshot(view, "MembraneEmpty") == straight
    display.Membrane = None


def test():
    PluginTesting.load_plugin()
    grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-6, 6] * 3))
    waves = make_waves()
    view = PluginTesting.make_view()
    display = show(view, grid)
    assert display.Membrane is None
    straight = screenshot(view, "MembraneStraight")
    check_place(view, display, grid, waves)
    check_changes(view, display, waves, straight)
    check_empty(view, display, straight)


if __name__ == "__main__":
    PluginTesting.run(test)
