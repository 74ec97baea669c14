# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The memory of each rank, for RunRanks.py: of a mesh of millions of tetrahedra that is drawn, and
of a membrane of a million facets. Each stage is a line: its name, cells of the rank, memory that is
resident now and was at most, in MiB."""
import os

import PluginTesting
import RanksScene
from paraview import simple

FOLDER = os.environ["MENISCUS_OUTPUT_DIR"]
# 80 cubes each way, 5 tetrahedra each.
EXTENT = [-40, 40] * 3
FACETS = 700

# Run by each rank.
WRITE_STAGE = """
import os
from paraview.modules.vtkRemotingCore import vtkProcessModule
rank = vtkProcessModule.GetProcessModule().GetPartitionId()
cells = self.GetInputDataObject(0, 0).GetNumberOfCells()
with open("/proc/self/status") as file:
    status = dict(line.split(":", 1) for line in file)
with open(os.path.join(%r, "%s-%%d.memory" %% rank), "a") as file:
    resident = [int(status[name].split()[0]) // 1024 for name in ("VmRSS", "VmHWM")]
    file.write("%s %%d %%d %%d\\n" %% (cells, *resident))
"""


def write_stage(name, stage, source):
    write = simple.ProgrammableFilter(Input=source, Script=WRITE_STAGE % (FOLDER, name, stage))
    write.UpdatePipeline()
    simple.Delete(write)


def start(name):
    """Includes everything that the first image loads."""
    ball = simple.Sphere()
    view = PluginTesting.make_view()
    view.UseFXAA = 0
    simple.Show(ball, view)
    simple.Render(view)
    simple.Hide(ball, view)
    write_stage(name, "start", ball)
    return view


def draw_large(name):
    view = start(name)
    mesh = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=EXTENT))
    mesh.UpdatePipeline()
    write_stage(name, "data", mesh)
    view.CameraPosition = [90, 70, 130]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    display = RanksScene.show_ray_cast(mesh, view, "RTData")
    display.ScalarOpacityUnitDistance = 5
    RanksScene.set_functions("RTData", -20, 260, False)
    RanksScene.write_picture(view, name)
    write_stage(name, "drawn", mesh)


def refract(name):
    """A few points behind a large membrane."""
    start(name)
    plane = simple.Plane(XResolution=FACETS, YResolution=FACETS)
    membrane = simple.Triangulate(Input=plane)
    membrane.UpdatePipeline()
    write_stage(name, "membrane", membrane)
    ball = simple.Sphere(Center=[0, 0, -1], Radius=0.2)
    refracted = simple.RefractedGeometry(Geometry=ball, Membrane=membrane, EyePosition=[0, 0, 3])
    refracted.UpdatePipeline()
    write_stage(name, "refracted", membrane)
