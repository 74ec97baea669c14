# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Time steps of a series of files, by the counters of the mapper and of the filter: the mesh is
built once, also if its cells are no tetrahedra or its points move."""
import os
import re

import PluginTesting
import vtkmodules.vtkRenderingVolume  # noqa: F401  the mapper's base class
from paraview import servermanager, simple

STEPS = 20


def write_series(name, mesh, motion):
    """Writes a series of the mesh with another field in each step; returns the .pvd file's path."""
    folder = os.environ["MENISCUS_OUTPUT_DIR"]
    path = os.path.join(folder, name + ".pvd")
    lines = []
    for step in range(STEPS):
        wave = simple.Calculator(
            Input=mesh, ResultArrayName="wave",
            Function="sin(0.5*coordsX+%g)*cos(0.4*coordsY)" % (0.3 * step))
        moved = simple.Calculator(
            Input=wave, CoordinateResults=1,
            Function=motion % (0.01 * step) if motion else "coords")
        file = "%s-%02d.vtu" % (name, step)
        # Appended data cannot be read with every libexpat: see TestReadAppendedMesh.py.
        simple.SaveData(os.path.join(folder, file), proxy=moved, DataMode="Binary")
        lines.append('<DataSet timestep="%d" file="%s"/>' % (step, file))
    with open(path, "w") as pvd:
        pvd.write('<VTKFile type="Collection"><Collection>%s</Collection></VTKFile>'
                  % "".join(lines))
    return path


def count(mapper, name):
    return int(re.search(r"^ *NumberOf%s: (\d+)$" % name, str(mapper), re.MULTILINE).group(1))


def work_of(mapper):
    return tuple(count(mapper, name) for name in ("MeshBuilds", "PointUpdates", "ScalarUpdates"))


def check(name, mesh, motion=None, is_static=False):
    series = simple.PVDReader(FileName=write_series(name, mesh, motion))
    times = series.TimestepValues
    assert len(times) == STEPS
    if is_static:
        series = simple.ForceStaticMesh(Input=series)
    moves = motion and not is_static
    view = PluginTesting.make_view()
    display = simple.Show(series, view)
    display.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(display, ("POINTS", "wave"))
    rays = simple.TetrahedraRayIntegral(Input=series, ImageSize=[20, 20])
    rays.ScalarArray = ["POINTS", "wave"]
    for step, time in enumerate(times):
        view.ViewTime = time
        simple.Render(view)
        work = work_of(PluginTesting.mapper_of(display))
        assert work == (1, step if moves else 0, step + 1), "%s, step %d: %r" % (name, step, work)
        rays.UpdatePipeline(time)
        rays.SMProxy.UpdatePropertyInformation()
        assert rays.GetPropertyValue("NumberOfMeshBuilds") == 1, name
        assert rays.GetPropertyValue("NumberOfScalarUpdates") == step + 1, name
    # The mapper has the cells of the file.
    drawn = PluginTesting.mapper_of(display).GetInputDataObject(0, 0)
    read = servermanager.Fetch(series)
    assert drawn.GetNumberOfCells() == read.GetNumberOfCells(), drawn.GetNumberOfCells()
    assert drawn.GetCellType(0) == read.GetCellType(0), drawn.GetCellType(0)
    last = PluginTesting.screenshot(view, name)
    assert len(PluginTesting.covered(last)) > 1000, name
    if not is_static:  # whose mesh is that of the first step
        # Moved points are rounded in another order: by one in 8 bits.
        check_last(name, series, view, last, times[-1], 1 if moves else 0)


def check_last(name, series, view, last, time, worst):
    """Compares with the picture of a representation that draws the last step first."""
    other = PluginTesting.make_view()
    again = simple.Show(series, other)
    again.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(again, ("POINTS", "wave"))
    other.ViewTime = time
    other.CameraPosition = view.CameraPosition
    other.CameraFocalPoint = view.CameraFocalPoint
    other.CameraViewUp = view.CameraViewUp
    other.CameraViewAngle = view.CameraViewAngle
    fresh = PluginTesting.screenshot(other, name + "-fresh")
    most = max(abs(a - b) for p, q in zip(last, fresh) for a, b in zip(p, q))
    assert most <= worst, "%s differs by %d" % (name, most)


def check_blocks(mesh):
    """Whole cells of all blocks, and of chosen ones."""
    moved = simple.Transform(Input=mesh)
    moved.Transform.Translate = [10, 0, 0]
    both = simple.GroupDatasets(Input=[mesh, moved], BlockNames=["first", "second"])
    view = PluginTesting.make_view()
    display = simple.Show(both, view)
    display.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(display, ("POINTS", "RTData"))
    cells = mesh.GetDataInformation().GetNumberOfCells()
    for selectors, blocks in ((["/"], 2), (["/Root/second"], 1)):
        display.BlockSelectors = selectors
        simple.Render(view)
        drawn = PluginTesting.mapper_of(display).GetInputDataObject(0, 0)
        assert drawn.GetNumberOfCells() == blocks * cells, (selectors, drawn.GetNumberOfCells())
        assert drawn.GetBounds()[0] == (-5 if blocks == 2 else 5), drawn.GetBounds()


def test():
    PluginTesting.load_plugin()
    voxels = simple.Wavelet(WholeExtent=[-5, 5] * 3)
    hexahedra = simple.AppendDatasets(Input=voxels)
    tetrahedra = simple.Tetrahedralize(Input=voxels)
    check_blocks(hexahedra)
    check("tetrahedra", tetrahedra)
    check("hexahedra", hexahedra)
    motion = "coords+%g*(coordsZ*coordsZ*iHat+coordsX*kHat)"
    check("moving-tetrahedra", tetrahedra, motion)
    check("moving-hexahedra", hexahedra, motion)
    if hasattr(simple, "ForceStaticMesh"):  # since ParaView 5.13
        check("static-mesh", tetrahedra, motion, is_static=True)


if __name__ == "__main__":
    PluginTesting.run(test)
