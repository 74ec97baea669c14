# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The filter whose output is images of instruments: a block in which the index of refraction rises
along an axis deflects all rays alike, and a background is shifted by that."""
import PluginTesting
from paraview import servermanager, simple

DEPTH = 20.0  # of the block along the rays
SLOPE = 1e-6  # of the index


def component(data, name, index=0):
    array = data.GetPointData().GetArray(name)
    assert array, "no array " + name
    return [array.GetComponent(i, index) for i in range(array.GetNumberOfTuples())]


def test():
    PluginTesting.load_plugin()
    block = simple.Wavelet()
    index = simple.Calculator(Input=block, ResultArrayName="index",
                              Function="1+%g*coordsX" % SLOPE)
    filled = simple.TetrahedraSchlieren(Input=index, ImageSize=[12, 10])
    filled.ScalarArray = ["POINTS", "index"]
    filled.Quantity = "Index of refraction"
    filled.BackgroundPicture = simple.Wavelet(WholeExtent=[0, 11, 0, 9, 0, 0])
    filled.BackgroundDistance = 1000
    image = servermanager.Fetch(filled)
    assert image.GetDimensions() == (12, 10, 1), image.GetDimensions()

    # The corners of the index are rounded to single precision.
    rounding = 2 * DEPTH * 2.0**-23
    met = [one for one in component(image, "Deflection") if one != 0]
    assert len(met) > 50, len(met)
    assert all(abs(one - DEPTH * SLOPE) < rounding for one in met), (min(met), max(met))
    width = image.GetSpacing()[0]
    shifts = [one for one in component(image, "Displacement") if one != 0]
    # Half of the block, its mean distance, is before the background's distance.
    shift = DEPTH * SLOPE * (1000 + DEPTH / 2) / width
    assert all(abs(abs(one) / shift - 1) < 0.02 for one in shifts), (shifts[0], shift)
    for name in ("OpticalPathDifference", "Shadowgraph", "Schlieren", "Interferogram",
                 "Background"):
        assert image.GetPointData().GetArray(name), name

    filled.Quantity = "Density"
    filled.GladstoneDale = 0.5
    halved = [one for one in component(servermanager.Fetch(filled), "Deflection") if one != 0]
    # n = 1 + (1 + SLOPE x) / 2
    assert all(abs(one - DEPTH * SLOPE / 3) < rounding for one in halved), halved[0]


if __name__ == "__main__":
    PluginTesting.run(test)
