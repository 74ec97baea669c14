# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A volume seen through a membrane: an isosurface is where the filter Refracted Geometry puts its
contour; a medium fades it; the membrane follows its pipeline, animated or read per time step, may
have blocks, and can be taken away again."""
import os

import PluginTesting
from PluginTesting import covered, screenshot
from paraview import simple

EYE = [6, -9, 40]
VALUE = 200.0
HEIGHT = "sin(0.5*coordsX)*cos(0.4*coordsY)"
WAVES = "coords+kHat*%g*" + HEIGHT
SERIES = """<VTKFile type="Collection"><Collection>
<DataSet timestep="0" file="waves0.vtp"/><DataSet timestep="1" file="waves1.vtp"/>
</Collection></VTKFile>
"""
FOLDER = os.environ["MENISCUS_OUTPUT_DIR"]
# Share of the covered pixels along the outlines, where one picture shows points and the other
# triangles: a length of about 4 diameters, two pixels wide.
SHARE_OF_OUTLINES = 0.05


def make_plane():
    return simple.Plane(Origin=[-14, -14, 16], Point1=[14, -14, 16], Point2=[-14, 14, 16],
                        XResolution=60, YResolution=60)


def make_waves():
    return simple.Calculator(Input=make_plane(), CoordinateResults=1, Function=WAVES % 0.3)


def show(view, grid):
    display = simple.Show(grid, view)
    display.SetRepresentationType("Volume (Exact)")
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
    refracted = screenshot(view, "MembraneRefracted")
    assert refracted != straight
    display.InteriorIndexOfRefraction = 1.0
    assert screenshot(view, "MembraneEqual") == straight, "equal indices"
    display.InteriorIndexOfRefraction = 1.333

    waves.Function = WAVES % 0.6
    higher = screenshot(view, "MembraneHigher")
    assert higher != refracted, "the membrane does not follow its pipeline"
    waves.Function = WAVES % 0.3
    assert screenshot(view, "MembraneAgain") == refracted

    view.SMProxy.InteractiveRender()
    display.Membrane = simple.GroupDatasets(Input=[waves])
    assert screenshot(view, "MembraneBlocks") == refracted, "blocks"
    display.Membrane = None
    assert screenshot(view, "MembraneNone") == straight, "the membrane is still there"


def check_medium(view, display, waves):
    """An opaque isosurface far inside a medium has the medium's colour, a clear one its own."""
    opacity = simple.GetOpacityTransferFunction("RTData")
    kept = list(opacity.Points)
    opacity.Points = [kept[0], 1.0, 0.5, 0.0, kept[-4], 1.0, 0.5, 0.0]
    display.BlendMode = "Isosurface"
    display.IsosurfaceValues = [VALUE]
    display.Membrane = waves
    clear = screenshot(view, "MembraneClear")
    display.MediumColor = [0.2, 0.4, 0.8]
    display.MediumAttenuationCoefficients = [0.1, 0.2, 0.3]
    faded = screenshot(view, "MembraneExponential")
    display.MediumAttenuationCoefficients = [1e3, 1e3, 1e3]
    hidden = screenshot(view, "MembraneDense")
    display.MediumModel = "Linear"
    display.MediumRange = [0, 1e-3]
    assert screenshot(view, "MembraneLinear") == hidden
    seen = covered(clear)
    assert faded != clear and len(seen) > 1000
    colors = {hidden[i] for i in seen}
    assert all(abs(color[k] - value) <= 1 for color in colors
               for k, value in enumerate([51, 102, 204])), colors
    display.MediumModel = "Exponential"
    display.MediumAttenuationCoefficients = [0, 0, 0]
    assert screenshot(view, "MembraneClearAgain") == clear
    opacity.Points = kept
    display.Membrane = None
    display.BlendMode = "Composite"


def check_empty(view, display, straight):
    """A membrane without cells, as a clip may produce, causes a warning; rays are straight."""
    nothing = simple.Contour(Input=simple.Wavelet(WholeExtent=[0, 1] * 3),
                             ContourBy=["POINTS", "RTData"], Isosurfaces=[1e9])
    told, stop = PluginTesting.listen(display, "WarningEvent")
    display.Membrane = nothing
    assert screenshot(view, "MembraneEmpty") == straight
    assert len(told) == 1 and "The membrane has no cells; rays are straight." in told[0], told
    display.Membrane = None
    assert screenshot(view, "MembraneEmptyNone") == straight and len(told) == 1, told
    stop()


def check_keyframes(view, display, plane, straight):
    """Waves with an animated height: at each time the image is that of the height set by hand."""
    heights = simple.Calculator(Input=plane, ResultArrayName="Height", Function=HEIGHT)
    waves = simple.GenerateSurfaceNormals(
        Input=simple.WarpByScalar(Input=heights, Scalars=["POINTS", "Height"], ScaleFactor=0.2))
    warp = waves.Input
    display.Membrane = waves
    pictures = []
    for name, warp.ScaleFactor in [("Low", 0.2), ("High", 0.6)]:
        pictures.append(screenshot(view, "Membrane" + name))
    assert pictures[0] != pictures[1] and straight not in pictures
    track = simple.GetAnimationTrack("ScaleFactor", proxy=warp)
    track.KeyFrames = [simple.CompositeKeyFrame(KeyTime=time, KeyValues=[value])
                       for time, value in [(0, 0.2), (1, 0.6)]]
    scene = simple.GetAnimationScene()
    for round_trip in range(2):
        for time, expected in [(scene.StartTime, pictures[0]), (scene.EndTime, pictures[1])]:
            scene.AnimationTime = time
            picture = screenshot(view, "MembraneAtTime%g" % time)
            assert picture == expected, "time %g, round %d" % (time, round_trip)
    simple.Delete(track)
    display.Membrane = None


def check_time_steps(view, display, straight):
    """A membrane that is read from a file per time step."""
    pictures = []
    for i, height in enumerate(["0.2", "0.6"]):
        waves = simple.Calculator(Input=make_plane(), CoordinateResults=1,
                                  Function="coords+kHat*%s*%s" % (height, HEIGHT))
        normals = simple.GenerateSurfaceNormals(Input=waves)
        path = os.path.join(FOLDER, "waves%d.vtp" % i)
        simple.SaveData(path, normals, DataMode="Ascii")
        display.Membrane = simple.XMLPolyDataReader(FileName=[path])
        pictures.append(screenshot(view, "MembraneFile%d" % i))
    assert pictures[0] != pictures[1] and straight not in pictures
    series = os.path.join(FOLDER, "waves.pvd")
    with open(series, "w") as file:
        file.write(SERIES)
    display.Membrane = simple.PVDReader(FileName=series)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    for step in [0, 1, 0]:
        scene.AnimationTime = step
        picture = screenshot(view, "MembraneStep%d" % step)
        assert picture == pictures[step], "time step %d" % step
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
    check_medium(view, display, waves)
    check_empty(view, display, straight)
    check_keyframes(view, display, make_plane(), straight)
    check_time_steps(view, display, straight)


if __name__ == "__main__":
    PluginTesting.run(test)
