# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a volume with the plugin that ParaView has loaded at its start, and prints the libraries of
Meniscus in this process. RunArchive.py runs it in pvbatch and in ParaView's window."""
import os
import traceback

import PluginTesting
from paraview import simple


def tell(line):
    """Writes past ParaView's streams: the window shows them itself, and _exit() empties none."""
    os.write(1, (line + "\n").encode())


def test():
    assert hasattr(simple, "RefractedGeometry"), "the plugin was not loaded at the start"
    grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-5, 5] * 3))
    view = simple.GetActiveViewOrCreate("RenderView")
    PluginTesting.prepare_view(view)
    display = simple.Show(grid, view)
    display.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(display, ("POINTS", "RTData"))
    simple.ResetCamera(view)
    name = os.environ["MENISCUS_PICTURE"]
    drawn = PluginTesting.covered(PluginTesting.screenshot(view, name))
    tell("%d pixels" % len(drawn))
    assert 0.1 < len(drawn) / PluginTesting.SIZE**2 < 0.9
    assert PluginTesting.mapper_of(display).IsA("vtkTetrahedraRayCastMapper")
    with open("/proc/self/maps") as file:
        libraries = {line.split(None, 5)[5].strip() for line in file if "Meniscus" in line}
    for library in sorted(libraries):
        tell("LIBRARY " + library)


# The window passes on neither exceptions nor an exit status, and has the script run as __main__.
if __name__ == "__main__":
    status = 1
    try:
        test()
        status = 0
    except BaseException:
        tell(traceback.format_exc())
    os._exit(status)
