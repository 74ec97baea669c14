# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a user does with the representation: choose arrays and components, edit the opacity, step
through time, change the blend mode, light it, move the view; each changes the picture, and back
again gives the first picture, bit for bit."""
import os

import PluginTesting
from PluginTesting import screenshot
from paraview import simple

PVD = """<VTKFile type="Collection"><Collection>
<DataSet timestep="0" file="step0.vtu"/><DataSet timestep="1" file="step1.vtu"/>
</Collection></VTKFile>
"""
STEPS = ["RTData", "200 - RTData"]


def show(view, source):
    display = simple.Show(source, view)
    display.SetRepresentationType("Tetrahedra Ray Cast")
    view.CameraPosition = [25, 18, 40]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    return display


def color(display, name, association="POINTS"):
    simple.ColorBy(display, (association,) + (name if isinstance(name, tuple) else (name,)))
    display.RescaleTransferFunctionToDataRange(False)


def check_arrays(view, grid):
    """Cell data, components and length look as an array that holds just that."""
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

    view.SMProxy.InteractiveRender()
    assert screenshot(view, "SceneStill") == first, "after interaction"


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
    """The volume is drawn over a translucent surface, in front of it as behind; afterwards the view
    peels other volumes again."""
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
    # Behind all of it: what of the volume is over the surface adds light to it.
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
    display = show(view, grid)
    color(display, "RTData")
    check_edits(view, display)
    check_translucent(view, display, grid)
    simple.Hide(grid, view)
    check_arrays(view, grid)
    check_time(view, grid)


if __name__ == "__main__":
    PluginTesting.run(test)
