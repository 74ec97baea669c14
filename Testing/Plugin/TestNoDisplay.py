# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Without a display, and so without OpenGL, the plugin loads, its filter runs and its
representation can be chosen and updated. Drawing, in a separate process, reports the missing
display and ends as it does for ParaView's surfaces: ParaView 5.11 and 5.13 abort, 6 draws."""
import os
import subprocess
import sys

import PluginTesting
from paraview import servermanager, simple

SHOWN = "the representation is shown"
DRAWN = "the view is drawn"
MESSAGE = "bad X server connection"


def check_filter():
    ball = simple.Sphere(Center=[0, 0, -1])
    water = simple.Plane(Origin=[-3, -3, 0], Point1=[3, -3, 0], Point2=[-3, 3, 0])
    refracted = simple.RefractedGeometry(Geometry=ball, Membrane=water, EyePosition=[0, -2, 1.5])
    points = servermanager.Fetch(refracted).GetNumberOfPoints()
    print("%d points" % points)
    assert points >= servermanager.Fetch(ball).GetNumberOfPoints()


def tell(line):
    """Writes past buffers that are lost when ParaView 5.13 aborts, even if they were flushed."""
    os.write(1, (line + "\n").encode())


def show(representation):
    grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-2, 2] * 3))
    view = simple.CreateRenderView()
    display = simple.Show(grid, view)
    display.SetRepresentationType(representation)
    simple.ColorBy(display, ("POINTS", "RTData"))
    view.SMProxy.Update()
    tell(SHOWN)
    return view


def check_drawing(representation):
    run = subprocess.run(
        [os.readlink("/proc/self/exe"), os.path.abspath(__file__), representation],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, check=False)
    print("%s: status %d" % (representation, run.returncode))
    assert SHOWN in run.stdout, run.stdout
    if run.returncode == 0:
        assert DRAWN in run.stdout, run.stdout
    else:
        assert MESSAGE in run.stdout, run.stdout
    return run.returncode


def test():
    PluginTesting.load_plugin()
    if len(sys.argv) > 1:
        simple.Render(show(sys.argv[1]))
        tell(DRAWN)
        return
    check_filter()
    assert check_drawing("Volume (Exact)") == check_drawing("Surface")


if __name__ == "__main__":
    PluginTesting.run(test)
