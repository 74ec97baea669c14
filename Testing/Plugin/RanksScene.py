# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The part of RunRanks.py that runs in ParaView on each number of ranks: pictures of volumes, and
the filters' output by RanksRefraction.py. Arguments: the prefix of the files to write, the number
of ranks, then the names of meshes in MENISCUS_DATA_DIR, or a scene, Colors, Waves, Large or Facets;
without names, scenes made here."""
import math
import os
import sys
import traceback

import PluginTesting
import RanksColors
import RanksMemory
import RanksRefraction
from paraview import servermanager, simple
from vtkmodules.vtkFiltersParallelDIY2 import vtkRedistributeDataSetFilter

FOLDER = os.environ["MENISCUS_OUTPUT_DIR"]


def write_mesh(name, source):
    """Writes a mesh that is the same on any number of ranks; ASCII: see TestReadAppendedMesh.py."""
    path = os.path.join(FOLDER, name + ".vtu")
    if not os.path.exists(path):
        simple.SaveData(path, source, DataMode="Ascii")
    return simple.XMLUnstructuredGridReader(FileName=[path])


def made_meshes():
    """Name, source, array. The last source is distributed from the start; its field is linear, so
    that the result does not depend on how each rank splits its cubes."""
    wavelet = simple.Wavelet(WholeExtent=[-6, 6] * 3)
    one = simple.Wavelet(WholeExtent=[0, 1] * 3)
    slope = simple.Calculator(
        Input=simple.Wavelet(WholeExtent=[-6, 6] * 3), ResultArrayName="Slope",
        Function="coordsX+0.5*coordsY-0.7*coordsZ")
    return [
        ("Wavelet", write_mesh("RanksWavelet", simple.Tetrahedralize(Input=wavelet)), "RTData"),
        ("Five", write_mesh("RanksFive", simple.Tetrahedralize(Input=one)), "RTData"),
        ("Slope", simple.Tetrahedralize(Input=slope), "Slope"),
    ]


def loses_cells():
    """True if ParaView's filter that divides cells among ranks loses the lower part of a cell whose
    centre is exactly on the side of a box, as that of 5.13 and 6.1 does. RunRanks.LOST_CELLS names
    the pictures with such a cell."""
    five = next(mesh for name, mesh, _ in made_meshes() if name == "Five")
    split = vtkRedistributeDataSetFilter()
    split.SetInputData(servermanager.Fetch(five))
    split.SetBoundaryModeToSplitBoundaryCells()
    split.SetUseExplicitCuts(True)
    split.AddExplicitCut([-1, 0.5, -1, 2, -1, 2])
    split.AddExplicitCut([0.5, 2, -1, 2, -1, 2])
    split.Update()
    # All five cells extend across the middle.
    return split.GetOutputDataObject(0).GetNumberOfCells() != 10


def data_meshes(names):
    folder = os.environ["MENISCUS_DATA_DIR"]
    for name in names:
        mesh = simple.XMLUnstructuredGridReader(FileName=[os.path.join(folder, name + ".vtu")])
        mesh.UpdatePipeline()
        yield name, mesh, mesh.PointData.keys()[0]


def set_functions(array, low, high, isosurfaces):
    colors = simple.GetColorTransferFunction(array)
    colors.RescaleTransferFunction(low, high)
    opacity = simple.GetOpacityTransferFunction(array)
    if isosurfaces:
        opacity.Points = [low, 0.4, 0.5, 0, high, 0.7, 0.5, 0]
    else:
        middle = 0.5 * (low + high)
        opacity.Points = [low, 0, 0.5, 0, 0.5 * (low + middle), 0.05, 0.5, 0, middle, 0, 0.5, 0,
                          high, 0.6, 0.5, 0]


def show_ray_cast(mesh, view, array):
    display = simple.Show(mesh, view)
    display.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(display, ("POINTS", array))
    return display


def write_picture(view, name):
    """An image for inspection, NAME.png, and its bytes for the comparison, NAME.rgb."""
    PluginTesting.screenshot(view, name)
    with open(os.path.join(FOLDER, name + ".rgb"), "wb") as file:
        file.write(bytes(memoryview(PluginTesting.read_picture(name))))


def draw_volume(prefix, name, mesh, array, balls):
    """Both blend modes, without and with an opaque ball inside, as `balls` selects."""
    mesh.UpdatePipeline()
    bounds = mesh.GetDataInformation().GetBounds()
    low, high = mesh.PointData[array].GetRange(0)
    center = [0.5 * (bounds[2 * i] + bounds[2 * i + 1]) for i in range(3)]
    size = sum((bounds[2 * i + 1] - bounds[2 * i])**2 for i in range(3))**0.5
    view = PluginTesting.make_view()
    view.UseFXAA = 0  # it smooths edges on one rank only
    view.CameraFocalPoint = center
    view.CameraPosition = [c + size * x for c, x in zip(center, (0.8, 0.6, 1.1))]
    view.CameraViewUp = [0, 1, 0]
    display = show_ray_cast(mesh, view, array)
    display.ScalarOpacityUnitDistance = size / 30
    display.IsosurfaceValues = [low + x * (high - low) for x in (0.3, 0.6)]
    ball = simple.Sphere(Center=center, Radius=size / 8, ThetaResolution=40, PhiResolution=40)
    for mode in ["Composite", "Isosurface"]:
        set_functions(array, low, high, mode == "Isosurface")
        display.BlendMode = mode
        for inside in balls:
            if inside:
                simple.Show(ball, view)
            else:
                simple.Hide(ball, view)
            write_picture(view, prefix + name + mode + inside)
    simple.Delete(view)


WITHOUT_ARRAY = """
from paraview.modules.vtkRemotingCore import vtkProcessModule
output = self.GetOutputDataObject(0)
output.ShallowCopy(self.GetInputDataObject(0, 0))
if vtkProcessModule.GetProcessModule().GetPartitionId() == 1:
    output.GetPointData().RemoveArray("RTData")
"""

# The cells of the same mesh on all ranks but the second.
OTHER_PIECES = """
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
append = vtkAppendFilter()
for piece in range(%d):
    wavelet = vtkRTAnalyticSource()
    wavelet.SetWholeExtent(-6, 6, -6, 6, -6, 6)
    wavelet.UpdatePiece(piece, %d, 0)
    split = vtkDataSetTriangleFilter()
    split.SetInputData(wavelet.GetOutput())
    split.Update()
    if piece != 1:
        append.AddInputData(split.GetOutput())
append.Update()
self.GetOutputDataObject(0).ShallowCopy(append.GetOutput())
"""


def draw_without_array(prefix, ranks, mesh):
    """One rank does not have the array: its cells are skipped with a warning, the others' are
    drawn. On one rank, draws the cells that the other ranks have with so many ranks."""
    view = PluginTesting.make_view()
    view.UseFXAA = 0
    view.CameraPosition = [17, 12, 23]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    display = show_ray_cast(mesh, view, "RTData")
    display.ScalarOpacityUnitDistance = 0.7
    set_functions("RTData", 60, 260, False)
    write_picture(view, prefix + "WithoutArrayOf%d" % ranks)
    simple.Delete(view)


def draw_without_arrays(prefix, ranks):
    if ranks > 1:
        grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-6, 6] * 3))
        mesh = simple.ProgrammableFilter(Input=grid, Script=WITHOUT_ARRAY)
        draw_without_array(prefix, ranks, mesh)
        return
    for several in (2, 4):
        mesh = simple.ProgrammableSource(Script=OTHER_PIECES % (several, several),
                                         OutputDataSetType="vtkUnstructuredGrid")
        draw_without_array(prefix, several, mesh)


def draw_maximum(prefix):
    """A blend mode that is not available on several ranks causes a warning."""
    mesh = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[0, 1] * 3))
    view = PluginTesting.make_view()
    display = show_ray_cast(mesh, view, "RTData")
    for mode in ["Isosurface", "Maximum intensity"]:
        display.BlendMode = mode
        PluginTesting.screenshot(view, prefix + mode.split()[0])
    simple.Delete(view)


def plane(slope=0):
    """A plane through which several parts of the volume are seen."""
    return simple.Plane(Origin=[-30, -30, 10 - 30 * slope], Point1=[30, -30, 10 + 30 * slope],
                        Point2=[-30, 30, 10 - 30 * slope], XResolution=120, YResolution=120)


def waves(amplitude):
    moved = simple.Calculator(Input=plane(), CoordinateResults=1, Function=(
        "coords+kHat*(%g*sin(coordsX)*cos(0.8*coordsY))" % amplitude))
    return simple.GenerateSurfaceNormals(Input=moved, Splitting=0)


def bumps():
    """A plane with the normals of waves."""
    return simple.Calculator(Input=plane(), ResultNormals=1, ResultArrayName="Bumps",
                             Function="norm(kHat-iHat*(0.1*cos(coordsX)))")


# Degrees above the membrane.
CAMERAS = {"Above": 80, "Aslant": 36}


def draw_membranes(prefix, membranes):
    """A linear field, distributed from the start, seen through membranes: name, function that
    creates it, directions of CAMERAS. Through the last one another field is also drawn."""
    slope = simple.Calculator(
        Input=simple.Wavelet(WholeExtent=[-6, 6] * 3), ResultArrayName="Slope",
        Function="coordsX+0.5*coordsY-0.7*coordsZ")
    mesh = simple.Tetrahedralize(Input=slope)
    view = PluginTesting.make_view()
    view.UseFXAA = 0
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    display = show_ray_cast(mesh, view, "Slope")
    display.ScalarOpacityUnitDistance = 0.7
    set_functions("Slope", -13, 13, False)
    for name, make, cameras in membranes:
        display.Membrane = make()
        for camera in cameras:
            angle = math.radians(CAMERAS[camera])
            view.CameraPosition = [3, -40 * math.cos(angle), 40 * math.sin(angle)]
            write_picture(view, prefix + "Membrane" + name + camera)
    slope.Function = "coordsX-0.5*coordsY-0.7*coordsZ"
    write_picture(view, prefix + "MembraneOtherField")
    simple.Delete(view)


BOTH = list(CAMERAS)
# All but the first cause a warning, once each.
MEMBRANES = [("Plane", plane, BOTH), ("Waves", lambda: waves(0.2), ["Above"]),
             ("Bumps", bumps, ["Above"]), ("Tilted", lambda: plane(0.1), BOTH)]
WAVES = [("Waves0.2", lambda: waves(0.2), BOTH), ("Waves0.5", lambda: waves(0.5), BOTH),
         ("Waves1", lambda: waves(1), BOTH), ("Tilted0.1", lambda: plane(0.1), BOTH),
         ("Tilted0.3", lambda: plane(0.3), BOTH), ("Tilted0.6", lambda: plane(0.6), BOTH)]


def draw_own(prefix, ranks):
    for mesh in made_meshes():
        draw_volume(prefix, *mesh, ["", "Ball"])
    draw_without_arrays(prefix, ranks)
    draw_maximum(prefix)
    draw_membranes(prefix, MEMBRANES)
    RanksRefraction.main(prefix)


def main(prefix, ranks, scenes):
    PluginTesting.load_plugin()
    if ranks == 1 and loses_cells():
        print("LOSES CELLS")
    if not scenes:
        draw_own(prefix, ranks)
    elif scenes == ["Colors"]:
        RanksColors.main(prefix)
    elif scenes == ["Waves"]:
        draw_membranes(prefix + "Waves", WAVES)
    elif scenes == ["Large"]:
        RanksMemory.draw_large(prefix + "Large")
    elif scenes == ["Facets"]:
        RanksMemory.refract(prefix + "Facets")
    else:
        for mesh in data_meshes(scenes):
            draw_volume(prefix, *mesh, ["Ball"])


if __name__ == "__main__":
    try:
        main(sys.argv[1], int(sys.argv[2]), sys.argv[3:])
    except Exception:  # the process must end by itself, or the other ranks are killed
        traceback.print_exc()
    else:
        print("FINISHED")
