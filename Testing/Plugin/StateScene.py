# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The scene of TestStateSave.py and TestStateLoad.py."""
import contextlib
import os

import PluginTesting
from paraview import simple, smtrace

EYE = [12, 9, 48]
FOLDER = os.environ["MENISCUS_OUTPUT_DIR"]
STATE = os.path.join(FOLDER, "scene.pvsm")
OLDER_STATE = os.path.join(FOLDER, "older.pvsm")
TRACE = os.path.join(FOLDER, "trace.py")
SCRIPT = os.path.join(FOLDER, "state.py")


@contextlib.contextmanager
def modified(proxy):
    """Applies changes of properties as ParaView's panels do, so that the trace contains them."""
    item = smtrace.PropertiesModified(proxy.SMProxy)
    yield proxy
    item.finalize()


def show_light(waves, view):
    """A floor below the waves with the light that it receives."""
    floor = simple.Plane(Origin=[-12, -12, -8], Point1=[12, -12, -8], Point2=[-12, 12, -8],
                         XResolution=60, YResolution=60)
    normals = simple.GenerateSurfaceNormals(Input=waves)
    light = simple.RefractedLight(Geometry=floor, Membrane=normals)
    with modified(light):
        light.LightPosition = [0.2, 0.1, 1]
        light.InteriorIndexOfRefraction = 1.4
    display = simple.Show(light, view)
    simple.ColorBy(display, ("POINTS", "RefractionIrradiance"))


def show_error(waves, view):
    """Error of flat facets of the waves, on a slice through a box below them."""
    error = simple.RefractionErrorVolume(Membrane=waves)
    with modified(error):
        error.EyePosition = [3, 4, 40]
        error.MembraneModel = "Flat facets"
        error.ModelBounds = [-12, -7, -12, 12, 4, 15]
        error.SampleDimensions = [4, 12, 12]
    display = simple.Show(error, view)
    display.SetRepresentationType("Slice")
    simple.ColorBy(display, ("POINTS", "RefractionError"))


def make_scene():
    """A volume with settings of its own, seen through waves; a ball behind a surface of a formula
    that these waves are put on, the eye at the camera, which it follows; light through the waves,
    and how far off their facets are."""
    grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-6, 6] * 3))
    view = simple.CreateRenderView()
    with modified(view):
        PluginTesting.prepare_view(view)
    display = simple.Show(grid, view)
    display.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(display, ("POINTS", "RTData"))
    with modified(display):
        display.BlendMode = "Isosurface"
        display.IsosurfaceValues = [130.0, 210.0]
        display.Shade = 1
        display.Gradients = "Per cell (flat)"
        display.ScalarOpacityUnitDistance = 2.5

    ball = simple.Sphere(Center=[0, 0, 9], Radius=5, ThetaResolution=32, PhiResolution=32)
    plane = simple.Plane(Origin=[-12, -12, 16], Point1=[12, -12, 16], Point2=[-12, 12, 16],
                         XResolution=40, YResolution=40)
    waves = simple.Calculator(
        Input=plane, CoordinateResults=1,
        Function="coords+kHat*0.4*sin(coordsX)*cos(coordsY)")
    with modified(view):
        view.CameraPosition = EYE
        view.CameraFocalPoint = [0, 0, 0]
        view.CameraViewUp = [0, 1, 0]
    refracted = simple.RefractedGeometry(Geometry=ball, Membrane=waves)
    with modified(refracted):
        refracted.InteriorIndexOfRefraction = 1.5
        refracted.AngularTolerance = 0.05
        refracted.ExactMembrane = "Sphere"
    with modified(refracted.ExactMembrane):
        refracted.ExactMembrane.Center = [0, 0, -44]
        refracted.ExactMembrane.Radius = 60
    simple.Show(refracted, view)
    simple.Hide(ball, view)
    with modified(display):
        display.Membrane = waves
        display.InteriorIndexOfRefraction = 1.4
    show_light(waves, view)
    show_error(waves, view)
    return view
