# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the pvbatch tests share."""
import os
import sys
import traceback

from paraview import simple
from vtkmodules.vtkIOImage import vtkPNGReader

SKIP = 125
BACKGROUND = (0.0, 0.0, 0.0)
SIZE = 300


def run(test):
    """Calls the test and ends the process: pvbatch passes on an exit status, but no exception."""
    status = 0
    try:
        test()
    except SystemExit as stop:
        status = stop.code
    except BaseException:
        traceback.print_exc()
        status = 1
    # ParaView crashes if the process exits while a view has a window.
    for view in simple.GetRenderViews():
        simple.Delete(view)
    sys.stdout.flush()
    sys.stderr.flush()
    sys.exit(status)


def skip(reason):
    print("SKIPPED:", reason)
    sys.exit(SKIP)


def load_plugin():
    simple.LoadPlugin(os.environ["MENISCUS_PLUGIN"], remote=False, ns=vars(simple))


def make_view():
    view = simple.CreateRenderView()
    view.ViewSize = [SIZE, SIZE]
    view.UseColorPaletteForBackground = 0
    view.Background = BACKGROUND
    view.OrientationAxesVisibility = 0
    return view


def screenshot(view, name):
    """Saves the view as NAME.png and returns its pixels as a list of (r, g, b)."""
    path = os.path.join(os.environ["MENISCUS_OUTPUT_DIR"], name + ".png")
    if os.path.exists(path):
        os.remove(path)
    simple.SaveScreenshot(path, view, ImageResolution=[SIZE, SIZE])
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    pixels = [scalars.GetTuple(i)[:3] for i in range(scalars.GetNumberOfTuples())]
    if len(pixels) != SIZE * SIZE:
        raise AssertionError("%s has %d pixels" % (path, len(pixels)))
    print("wrote", path)
    return pixels


def covered(pixels, threshold=2):
    """The set of pixels that differ from the black background by more than the threshold."""
    return {i for i, pixel in enumerate(pixels) if max(pixel) > threshold}
