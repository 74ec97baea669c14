# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Typical use of the representation: choose arrays and components, edit the opacity, step
through time, animate a property, change the blend mode, light it, move the view, select; each
changes the picture, and back again gives the first picture, bit for bit."""
import os

import PluginTesting
from PluginTesting import screenshot
from paraview import simple
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

PVD = """<VTKFile type="Collection"><Collection>
<DataSet timestep="0" file="step0.vtu"/><DataSet timestep="1" file="step1.vtu"/>
</Collection></VTKFile>
"""
STEPS = ["RTData", "200 - RTData"]


def show(view, source):
    display = simple.Show(source, view)
    display.SetRepresentationType("Volume (Exact)")
    view.CameraPosition = [25, 18, 40]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    return display


def color(display, name, association="POINTS"):
    simple.ColorBy(display, (association,) + (name if isinstance(name, tuple) else (name,)))
    display.RescaleTransferFunctionToDataRange(False)


def check_arrays(view, grid):
    """Cell data, components and length look like an array with only these values."""
    calculator = simple.Calculator(
        Input=grid, ResultArrayName="Vectors", Function="iHat*coordsX+jHat*RTData/20+kHat*coordsZ")
    lengths = simple.Calculator(
        Input=calculator, ResultArrayName="Lengths", Function="mag(Vectors)")
    heights = simple.Calculator(Input=lengths, ResultArrayName="Heights", Function="RTData/20")
    cells = simple.PointDatatoCellData(Input=heights, PassPointData=1)
    display = show(view, cells)
    pictures = {}
    for name, choice in [("length", ("Vectors", "Magnitude")), ("y", ("Vectors", "Y"))]:
        color(display, choice)
        scalar = "Lengths" if name == "length" else "Heights"
        colors = simple.GetColorTransferFunction("Vectors")
        opacity = simple.GetOpacityTransferFunction("Vectors")
        low, high = cells.PointData[scalar].GetRange(0)
        colors.RescaleTransferFunction(low, high)
        opacity.RescaleTransferFunction(low, high)
        pictures[name] = screenshot(view, "Vectors" + name)
        color(display, scalar)
        simple.GetColorTransferFunction(scalar).RescaleTransferFunction(low, high)
        simple.GetOpacityTransferFunction(scalar).RescaleTransferFunction(low, high)
        assert screenshot(view, scalar) == pictures[name], "%s is not that of the array" % name
    assert pictures["length"] != pictures["y"]
    color(display, "Heights", "CELLS")
    of_cells = screenshot(view, "CellHeights")
    assert of_cells != pictures["y"] and PluginTesting.covered(of_cells)
    simple.Hide(cells, view)


def check_edits(view, display):
    first = screenshot(view, "Scene")
    assert len(PluginTesting.covered(first)) > 0.05 * PluginTesting.SIZE**2

    opacity = simple.GetOpacityTransferFunction("RTData")
    points = list(opacity.Points)
    opacity.Points = [points[0], 0.0, 0.5, 0.0, points[-4], 0.2, 0.5, 0.0]
    assert screenshot(view, "SceneOpacity") != first, "opacity"
    opacity.Points = points
    assert screenshot(view, "SceneOpacityBack") == first, "opacity, back"

    for name, value in [("BlendMode", "Maximum intensity"), ("OpacityModel", 1),
                        ("Shade", 1), ("ScalarOpacityUnitDistance", 9.0)]:
        before = PluginTesting.value_of(display, name)
        setattr(display, name, value)
        assert screenshot(view, "Scene" + name) != first, name
        setattr(display, name, before)
        assert screenshot(view, "SceneBack") == first, name + ", back"

    display.BlendMode = "Isosurface"
    display.IsosurfaceValues = [130.0, 200.0]
    assert PluginTesting.covered(screenshot(view, "SceneIsosurfaces"))
    display.BlendMode = "Composite"



def window_pixels(view):
    """Pixels of the window as it is, without drawing it again."""
    grab = vtkWindowToImageFilter()
    grab.SetInput(view.SMProxy.GetClientSideObject().GetRenderWindow())
    grab.ShouldRerenderOff()
    grab.ReadFrontBufferOff()
    grab.Update()
    scalars = grab.GetOutput().GetPointData().GetScalars()
    return [scalars.GetTuple(i) for i in range(scalars.GetNumberOfTuples())]


def mean_difference(some, others):
    return sum(max(abs(a - b) for a, b in zip(*pair)) for pair in zip(some, others)) / len(some)


def check_interaction(view):
    """While the view is moved the volume is drawn below ParaView's threshold and a surface above
    it; afterwards the volume is back."""
    first = screenshot(view, "InteractionNone")
    threshold = view.LODThreshold
    simple.Render(view)
    still = window_pixels(view)
    differences = []
    for view.LODThreshold in [1e9, 0.0]:
        view.SMProxy.InteractiveRender()
        differences.append(mean_difference(window_pixels(view), still))
        assert screenshot(view, "InteractionStill") == first, "after interaction"
    print("mean differences %.2f of fewer rays, %.2f of the surface" % tuple(differences))
    assert differences[0] < 5 and differences[1] > 20
    view.LODThreshold = threshold


def check_selection(view, grid):
    """Selected cells are shown over the volume; a rectangle in the view selects none of it."""
    first = screenshot(view, "SelectionNone")
    simple.QuerySelect(QueryString="id < 500", FieldType="CELL", Source=grid)
    assert screenshot(view, "Selection") != first, "the selection is not shown"
    simple.ClearSelection(grid)
    assert screenshot(view, "SelectionCleared") == first, "the selection is still shown"
    middle = PluginTesting.SIZE // 2
    simple.SelectSurfaceCells(
        Rectangle=[middle - 50, middle - 50, middle + 50, middle + 50], View=view)
    assert screenshot(view, "SelectionByView") == first, "a rectangle selects"


def check_screenshots(view):
    """A larger one, and one without background, over which the volume's opacity is kept."""
    first = screenshot(view, "Screenshot")
    folder = os.environ["MENISCUS_OUTPUT_DIR"]
    for name, options, shape in [
            ("Large", {"ImageResolution": [700, 700]}, (700 * 700, 3)),
            ("Transparent",
             {"ImageResolution": [PluginTesting.SIZE] * 2, "TransparentBackground": 1},
             (PluginTesting.SIZE**2, 4))]:
        reader = vtkPNGReader()
        reader.SetFileName(os.path.join(folder, "Screenshot%s.png" % name))
        simple.SaveScreenshot(reader.GetFileName(), view, **options)
        reader.Update()
        scalars = reader.GetOutput().GetPointData().GetScalars()
        assert (scalars.GetNumberOfTuples(), scalars.GetNumberOfComponents()) == shape
        if shape[1] == 3:
            drawn = sum(max(scalars.GetTuple(i)) > 2 for i in range(shape[0])) / shape[0]
            expected = len(PluginTesting.covered(first)) / len(first)
            assert abs(drawn - expected) < 0.01 * expected, (drawn, expected)
        else:
            opacities = {scalars.GetComponent(i, 3) for i in range(shape[0])}
            assert min(opacities) == 0 and len(opacities) > 100, len(opacities)
    assert screenshot(view, "ScreenshotAgain") == first


def check_animation(view, display):
    """Keyframes of a property of the representation."""
    first = screenshot(view, "Animation0")
    scene = simple.GetAnimationScene()
    track = simple.GetAnimationTrack("ScalarOpacityUnitDistance", proxy=display)
    low = display.ScalarOpacityUnitDistance
    track.KeyFrames = [simple.CompositeKeyFrame(KeyTime=0, KeyValues=[low]),
                       simple.CompositeKeyFrame(KeyTime=1, KeyValues=[9 * low])]
    scene.AnimationTime = scene.EndTime
    assert screenshot(view, "Animation1") != first, "the keyframes change nothing"
    scene.AnimationTime = scene.StartTime
    assert screenshot(view, "Animation0Again") == first
    simple.Delete(track)


def write_steps(grid):
    folder = os.environ["MENISCUS_OUTPUT_DIR"]
    for i, function in enumerate(STEPS):
        step = simple.Calculator(Input=grid, ResultArrayName="Step", Function=function)
        path = os.path.join(folder, "step%d.vtu" % i)
        simple.SaveData(path, step, DataMode="Ascii", ChooseArraysToWrite=1,
                        PointDataArrays=["Step"])
    path = os.path.join(folder, "steps.pvd")
    with open(path, "w") as file:
        file.write(PVD)
    return path


def check_time(view, grid):
    reader = simple.PVDReader(FileName=write_steps(grid))
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    display = show(view, reader)
    scene.AnimationTime = 0
    simple.ColorBy(display, ("POINTS", "Step"))
    simple.GetColorTransferFunction("Step").RescaleTransferFunction(-80, 280)
    simple.GetOpacityTransferFunction("Step").RescaleTransferFunction(-80, 280)
    first = screenshot(view, "Step0")
    scene.AnimationTime = 1
    assert screenshot(view, "Step1") != first, "the time step changes nothing"
    scene.AnimationTime = 0
    assert screenshot(view, "Step0Again") == first, "the first time step, again"
    simple.Hide(reader, view)


def check_translucent(view, display, grid):
    """The volume is drawn over a translucent surface, in front of it and behind it; afterwards the
    view peels other volumes again."""
    alone = screenshot(view, "TranslucentNone")
    plane = simple.Plane(Origin=[-60, -60, -20], Point1=[60, -60, -20], Point2=[-60, 60, -20])
    surface = simple.Show(plane, view)
    surface.Opacity = 0.5
    both = screenshot(view, "TranslucentBoth")
    renderer = view.SMProxy.GetClientSideObject().GetRenderer()
    assert renderer.GetUseDepthPeelingForVolumes() == 0
    simple.Hide(grid, view)
    surfaces = screenshot(view, "TranslucentSurface")
    assert renderer.GetUseDepthPeelingForVolumes() == 1
    # The surface is behind the volume: the part of the volume over it adds light.
    assert surfaces != both
    for of_both, of_volume, of_surface in zip(both, alone, surfaces):
        for channel in range(3):
            assert of_volume[channel] - 1 <= of_both[channel] <= (
                of_volume[channel] + of_surface[channel] + 1), (of_both, of_volume, of_surface)
    simple.Delete(plane)
    simple.Show(grid, view)
    assert screenshot(view, "TranslucentGone") == alone


def test():
    PluginTesting.load_plugin()
    grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-6, 6] * 3))
    view = PluginTesting.make_view()
    simple.Render(view)  # the first one resets the camera
    display = show(view, grid)
    color(display, "RTData")
    check_edits(view, display)
    check_interaction(view)
    check_screenshots(view)
    check_selection(view, grid)
    check_animation(view, display)
    check_translucent(view, display, grid)
    simple.Hide(grid, view)
    check_arrays(view, grid)
    check_time(view, grid)


if __name__ == "__main__":
    PluginTesting.run(test)
