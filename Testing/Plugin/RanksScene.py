# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""What RunRanks.py has ParaView do on each number of ranks: pictures of volumes and the points of
refracted geometry. Arguments: the prefix of the files that are written, then the names of meshes in
MENISCUS_DATA_DIR; without any, meshes made here."""
import os
import sys
import traceback

import PluginTesting
from paraview import servermanager, simple

FOLDER = os.environ["MENISCUS_OUTPUT_DIR"]
WAVES = "coords+kHat*(0.3*sin(coordsX)*cos(coordsY))"


def write_mesh(name, source):
    """Writes a mesh that is the same on any number of ranks; ASCII: see TestReadAppendedMesh.py."""
    path = os.path.join(FOLDER, name + ".vtu")
    if not os.path.exists(path):
        simple.SaveData(path, source, DataMode="Ascii")
    return simple.XMLUnstructuredGridReader(FileName=[path])


def made_meshes():
    """Name, source, array. The last is distributed from the start; its field is linear, so that it
    does not matter how each rank splits its cubes."""
    wavelet = simple.Wavelet(WholeExtent=[-6, 6] * 3)
    one = simple.Wavelet(WholeExtent=[0, 1] * 3)
    slope = simple.Calculator(
        Input=simple.Wavelet(WholeExtent=[-6, 6] * 3), ResultArrayName="Slope",
        Function="coordsX+0.5*coordsY-0.7*coordsZ")
    return [
        ("Wavelet", write_mesh("RanksWavelet", simple.Tetrahedralize(Input=wavelet)), "RTData"),
        ("Six", write_mesh("RanksSix", simple.Tetrahedralize(Input=one)), "RTData"),
        ("Slope", simple.Tetrahedralize(Input=slope), "Slope"),
    ]


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


def write_picture(view, name):
    """A picture for people, NAME.png, and its bytes for the comparison, NAME.rgb."""
    PluginTesting.screenshot(view, name)
    with open(os.path.join(FOLDER, name + ".rgb"), "wb") as file:
        file.write(bytes(memoryview(PluginTesting.read_picture(name))))


def draw_volume(prefix, name, mesh, array, balls):
    """Both blend modes, without and with an opaque ball inside, as `balls` says."""
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
    display = simple.Show(mesh, view)
    display.SetRepresentationType("Tetrahedra Ray Cast")
    simple.ColorBy(display, ("POINTS", array))
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


def draw_without_array(prefix):
    """One rank does not have the array: the others' cells are drawn, its own left out with a
    warning."""
    grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-6, 6] * 3))
    mesh = simple.ProgrammableFilter(Input=grid, Script=WITHOUT_ARRAY)
    view = PluginTesting.make_view()
    display = simple.Show(mesh, view)
    display.SetRepresentationType("Tetrahedra Ray Cast")
    simple.ColorBy(display, ("POINTS", "RTData"))
    simple.ResetCamera(view)
    drawn = len(PluginTesting.covered(PluginTesting.screenshot(view, prefix + "WithoutArray")))
    assert drawn > 0.1 * PluginTesting.SIZE**2, "%d pixels drawn" % drawn
    simple.Delete(view)


def write_points(prefix, name, source):
    """The points of all ranks, with the depth behind the membrane."""
    data = servermanager.Fetch(source)
    depths = data.GetPointData().GetArray("RefractionDepth")
    with open(os.path.join(FOLDER, prefix + name + ".txt"), "w") as file:
        for i in range(data.GetNumberOfPoints()):
            file.write("%.9g %.9g %.9g %.9g\n" % (data.GetPoint(i) + (depths.GetValue(i),)))


def refract(prefix):
    """Distributed vertices behind a membrane that one rank has, and one of which each has a part."""
    block = simple.Wavelet(WholeExtent=[-4, 4, -4, 4, -5, -1])
    vertices = simple.MaskPoints(
        Input=block, OnRatio=1, MaximumNumberofPoints=100000, GenerateVertices=1,
        SingleVertexPerCell=1, ProportionallyDistributeMaximumNumberOfPoints=0)
    plane = simple.Plane(Origin=[-8, -8, 0.5], Point1=[8, -8, 0.5], Point2=[-8, 8, 0.5],
                         XResolution=24, YResolution=24)
    height = simple.Calculator(
        Input=simple.Wavelet(WholeExtent=[-8, 8, -8, 8, 0, 1]), ResultArrayName="Height",
        Function="coordsZ")
    sheet = simple.Contour(Input=height, ContourBy=["POINTS", "Height"], Isosurfaces=[0.5],
                           ComputeNormals=0)
    for name, surface in [("OneRank", plane), ("AllRanks", sheet)]:
        waves = simple.Calculator(Input=surface, CoordinateResults=1, Function=WAVES)
        refracted = simple.RefractedGeometry(Geometry=vertices, Membrane=waves)
        refracted.EyePosition = [1, -3, 12]
        write_points(prefix, name, refracted)


def main(prefix, names):
    PluginTesting.load_plugin()
    for mesh in data_meshes(names) if names else made_meshes():
        draw_volume(prefix, *mesh, ["Ball"] if names else ["", "Ball"])
    if not names:
        draw_without_array(prefix)
        refract(prefix)


if __name__ == "__main__":
    try:
        main(sys.argv[1], sys.argv[2:])
    except Exception:  # the process must end by itself, or the other ranks are killed
        traceback.print_exc()
    else:
        print("FINISHED")
