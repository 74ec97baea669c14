# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tables of interfaces that cannot be used give an error and an empty output, in every filter."""
import math

import PluginTesting
from paraview import servermanager, simple
from TestStacks import EYE, PANE, ROWS, plane

BAD = {
    "names surface 2": [0, 1, 1.5, 2, 1.5, 1.333],
    "names surface 0.5": [0, 1, 1.5, 0.5, 1.5, 1.333],
    "names surface -1": [0, 1, 1.5, -1, 1.5, 1.333],
    "names surface nan": [0, 1, 1.5, math.nan, 1.5, 1.333],
    "No row of the interfaces names surface 1": [0, 1, 1.5],
    "do not match along the list": [0, 1, 1.5, 1, 1.4, 1.333],
    "not 1.5 and -1.333": [0, 1, 1.5, 1, 1.5, -1.333],
    "not 1 and nan": [0, 1, math.nan, 1, 1.5, 1.333],
    "1 refracting interfaces, and port": [],
}


def test():
    PluginTesting.load_plugin()
    surfaces = [plane(5, z, 8) for z in PANE]
    floor = plane(0.5, -1, 4)
    filters = [
        simple.RefractedGeometry(Geometry=floor, Membrane=surfaces, EyePosition=EYE,
                                 Images="First image"),
        simple.RefractedLight(Geometry=floor, Membrane=surfaces),
        simple.TruePosition(Input=floor, Membrane=surfaces, EyePosition=EYE),
        simple.SightRays(Input=floor, Membrane=surfaces, EyePosition=EYE),
        simple.MembraneCells(Membrane=surfaces, EyePosition=EYE),
        simple.RefractionErrorVolume(Membrane=surfaces, EyePosition=EYE,
                                     SampleDimensions=[2, 2, 2])]
    for each in filters:
        for text, rows in BAD.items():
            print("EXPECTED", text)
            each.Interfaces = rows
            assert servermanager.Fetch(each).GetNumberOfPoints() == 0, (each, rows)
        each.Interfaces = ROWS
        assert servermanager.Fetch(each).GetNumberOfPoints() > 0, each
    print("FINISHED")


if __name__ == "__main__":
    PluginTesting.run(test)
