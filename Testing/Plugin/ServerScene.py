# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The part of RunServer.py that runs in a client of ParaView: pictures of a volume, also through
a membrane, and of refracted geometry. Arguments: the prefix of the files that are written,
the port of a server or 0 for none, and who draws, `server` or `client`."""
import os
import sys
import traceback

import PluginTesting
import RanksScene
from paraview import simple

PREFIX, PORT, DRAWS = sys.argv[1], int(sys.argv[2]), sys.argv[3]


def make_view():
    view = PluginTesting.make_view()
    view.UseFXAA = 0
    # In MiB of geometry above which the server draws.
    view.RemoteRenderThreshold = 0 if DRAWS == "server" else 1e6
    view.CameraPosition = [6, -9, 40]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    return view


def draw_volume(view, waves):
    """A linear field on cubes that the ranks split, with an opaque ball inside."""
    field = simple.Calculator(
        Input=simple.Wavelet(WholeExtent=[-6, 6] * 3), ResultArrayName="Slope",
        Function="coordsX+0.5*coordsY-0.7*coordsZ")
    mesh = simple.Tetrahedralize(Input=field)
    ball = simple.Sphere(Radius=2, ThetaResolution=40, PhiResolution=40)
    simple.Show(ball, view)
    display = simple.Show(mesh, view)
    display.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(display, ("POINTS", "Slope"))
    display.IsosurfaceValues = [-4.0, 5.0]
    for mode in ["Composite", "Isosurface"]:
        RanksScene.set_functions("Slope", -13, 13, mode == "Isosurface")
        display.BlendMode = mode
        RanksScene.write_picture(view, PREFIX + mode)
    simple.Hide(ball, view)
    display.Membrane = waves
    display.BlendMode = "Composite"
    RanksScene.set_functions("Slope", -13, 13, False)
    RanksScene.write_picture(view, PREFIX + "Membrane")
    waves.Function = "coords+kHat*0.1*sin(0.5*coordsX)"
    RanksScene.write_picture(view, PREFIX + "OtherMembrane")
    display.Membrane = None
    RanksScene.write_picture(view, PREFIX + "NoMembrane")
    simple.Hide(mesh, view)


def draw_refracted(view, waves):
    ball = simple.Sphere(Radius=5, ThetaResolution=64, PhiResolution=64)
    refracted = simple.RefractedGeometry(Geometry=ball, Membrane=waves)
    refracted.EyePosition = view.CameraPosition
    simple.Show(refracted, view)
    RanksScene.write_picture(view, PREFIX + "Refracted")
    refracted.ExactMembrane = "Plane"
    refracted.ExactMembrane.Origin = [0, 0, 14]
    refracted.ExactMembrane.Normal = [0, 0, 1]
    RanksScene.write_picture(view, PREFIX + "RefractedByPlane")


def main():
    if PORT:
        simple.Connect("localhost", PORT)
        simple.LoadPlugin(os.environ["MENISCUS_PLUGIN"], remote=True, ns=vars(simple))
    PluginTesting.load_again()  # in the client, which needs it as well
    plane = simple.Plane(Origin=[-14, -14, 14], Point1=[14, -14, 14], Point2=[-14, 14, 14],
                         XResolution=40, YResolution=40)
    waves = simple.Calculator(Input=plane, CoordinateResults=1,
                              Function="coords+kHat*0.2*sin(0.5*coordsX)*cos(0.4*coordsY)")
    view = make_view()
    draw_volume(view, waves)
    draw_refracted(view, waves)


try:
    main()
except Exception:
    traceback.print_exc()
else:
    print("FINISHED")
finally:
    # ParaView crashes if the process exits while a view has a window.
    for each in simple.GetRenderViews():
        simple.Delete(each)
    if PORT:
        simple.Disconnect()
