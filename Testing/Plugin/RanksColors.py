# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures for RunRanks.py with random colour maps, most of whose colours are saturated:
premultiplied, such a colour equals the opacity, which is where compositing in 8 bits wraps around
first. Meshes: those of MENISCUS_DATA_DIR that are there, one of 519,115 cells and one of 8,640. The
number of scenes of each mesh is MENISCUS_RANKS_INTENSITY, 1 by default; scenes have fixed seeds, so
that all numbers of ranks draw the same."""
import math
import os
import random

import PluginTesting
import RanksScene
from paraview import simple

DATA_MESHES = ["blunt_fin", "combustor", "crushed_can"]
# On rank 0 only, so that the tetrahedra are the same on any number of ranks.
WAVELET = """
from paraview.modules.vtkRemotingCore import vtkProcessModule
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
if vtkProcessModule.GetProcessModule().GetPartitionId() == 0:
    wavelet = vtkRTAnalyticSource()
    wavelet.SetWholeExtent(*([0, %d] * 3))
    wavelet.SetCenter(*([%g] * 3))
    split = vtkDataSetTriangleFilter()
    split.SetInputConnection(wavelet.GetOutputPort())
    split.Update()
    self.GetOutputDataObject(0).ShallowCopy(split.GetOutput())
"""


def intensity():
    return int(os.environ.get("MENISCUS_RANKS_INTENSITY", "1"))


def wavelet(cubes):
    """Five tetrahedra for each cube."""
    return simple.ProgrammableSource(
        Script=WAVELET % (cubes, 0.5 * cubes), OutputDataSetType="vtkUnstructuredGrid")


def meshes():
    folder = os.environ.get("MENISCUS_DATA_DIR", "")
    there = [name for name in DATA_MESHES if os.path.exists(os.path.join(folder, name + ".vtu"))]
    yield from RanksScene.data_meshes(there)
    for cubes in (12, 47):
        mesh = wavelet(cubes)
        mesh.UpdatePipeline()
        yield "wavelet%d" % cubes, mesh, "RTData"


def random_color(source):
    """Each component is 1 in half of the cases, 0 in a quarter."""
    kinds = [source.random() for _ in range(3)]
    return [1 if kind < 0.5 else 0 if kind < 0.75 else source.random() for kind in kinds]


def set_functions(source, array, low, high):
    scalars = [low + (high - low) * i / 4 for i in range(5)]
    colors = simple.GetColorTransferFunction(array)
    colors.ColorSpace = "RGB"
    colors.RGBPoints = [x for s in scalars for x in [s] + random_color(source)]
    opacities = [source.random() for _ in scalars]
    opacity = simple.GetOpacityTransferFunction(array)
    opacity.Points = [x for s, o in zip(scalars, opacities)
                      for x in (s, o if o > 0.3 else 0, 0.5, 0)]


def set_view(source, view, center, size):
    """From a random side, with the mesh filling the view or extending beyond it."""
    z = source.uniform(-0.8, 0.8)
    angle = source.uniform(0, 2 * math.pi)
    across = math.sqrt(1 - z * z)
    direction = (across * math.cos(angle), z, across * math.sin(angle))
    distance = size * source.uniform(0.9, 1.7)
    view.CameraFocalPoint = center
    view.CameraPosition = [c + distance * x for c, x in zip(center, direction)]
    view.CameraViewUp = [0, 1, 0]


def draw_mesh(prefix, name, mesh, array):
    bounds = mesh.GetDataInformation().GetBounds()
    low, high = mesh.PointData[array].GetRange(0)
    center = [0.5 * (bounds[2 * i] + bounds[2 * i + 1]) for i in range(3)]
    size = sum((bounds[2 * i + 1] - bounds[2 * i])**2 for i in range(3))**0.5
    view = PluginTesting.make_view()
    view.UseFXAA = 0
    display = RanksScene.show_ray_cast(mesh, view, array)
    display.BlendMode = "Composite"
    ball = simple.Sphere(Center=center, Radius=size / 8, ThetaResolution=40, PhiResolution=40)
    shown = simple.Show(ball, view)
    for i in range(intensity()):
        source = random.Random("%s %d" % (name, i))
        set_functions(source, array, low, high)
        set_view(source, view, center, size)
        # From thin to nearly opaque.
        display.ScalarOpacityUnitDistance = size * 10**source.uniform(-2.5, -0.5)
        shown.Visibility = i % 2 == 0
        RanksScene.write_picture(view, "%sColors%s%d" % (prefix, name, i))
    simple.Delete(view)


def main(prefix):
    for name, mesh, array in meshes():
        draw_mesh(prefix, name, mesh, array)
