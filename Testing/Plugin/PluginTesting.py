# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Functions that the pvbatch tests share."""
import os
import sys
import traceback

from paraview import simple
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkIOImage import vtkPNGReader

if not hasattr(simple, "GenerateSurfaceNormals"):
    simple.GenerateSurfaceNormals = simple.SurfaceNormals  # its name in ParaView 6

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


def load_again():
    simple.LoadPlugin(os.environ["MENISCUS_PLUGIN"], remote=False, ns=vars(simple))


def load_plugin():
    """Loads the plugin, unless an earlier test of this process has."""
    if not hasattr(simple, "RefractedGeometry"):
        load_again()


def value_of(proxy, name):
    """Current value of a property; ParaView returns some objects that follow later changes."""
    value = getattr(proxy, name)
    return value.GetData() if hasattr(value, "GetData") else value


def mapper_of(display):
    """The mapper behind the representation Volume (Exact)."""
    representation = display.SMProxy.GetClientSideObject().GetActiveRepresentation()
    return representation.GetActiveVolumeMapper()


def listen(display, event):
    """The texts of an event of the representation from now on, and a function that ends this."""
    told = []

    def note(caller, event, text):
        told.append(text)

    note.CallDataType = VTK_STRING
    representation = display.SMProxy.GetClientSideObject().GetActiveRepresentation()
    tag = representation.AddObserver(event, note)
    return told, lambda: representation.RemoveObserver(tag)


def make_view():
    view = simple.CreateRenderView()
    prepare_view(view)
    return view


def prepare_view(view):
    view.ViewSize = [SIZE, SIZE]
    view.UseColorPaletteForBackground = 0
    view.Background = BACKGROUND
    view.OrientationAxesVisibility = 0


def screenshot(view, name):
    """Saves the view as NAME.png and returns its pixels as a list of (r, g, b)."""
    path = os.path.join(os.environ["MENISCUS_OUTPUT_DIR"], name + ".png")
    if os.path.exists(path):
        os.remove(path)
    simple.SaveScreenshot(path, view, ImageResolution=[SIZE, SIZE])
    print("wrote", path)
    return read_pixels(name)


def read_picture(name):
    """The array of pixels of NAME.png, three unsigned characters each."""
    path = os.path.join(os.environ["MENISCUS_OUTPUT_DIR"], name + ".png")
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    shape = (scalars.GetNumberOfTuples(), scalars.GetNumberOfComponents())
    if shape != (SIZE * SIZE, 3):
        raise AssertionError("%s has %d pixels of %d components" % ((path,) + shape))
    return scalars


def read_pixels(name):
    """The pixels of NAME.png as a list of (r, g, b)."""
    scalars = read_picture(name)
    return [scalars.GetTuple(i) for i in range(scalars.GetNumberOfTuples())]


def covered(pixels, threshold=2):
    """The set of pixels that differ from the black background by more than the threshold."""
    return {i for i, pixel in enumerate(pixels) if max(pixel) > threshold}
