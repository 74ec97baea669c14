# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The filter whose output is an image of ray integrals: the path length of a block of voxels along
an axis is its depth, and another direction does not build the mesh again."""
import math

import PluginTesting
from paraview import servermanager, simple

# Depths of rays are rounded to single precision: 1e-6 of the longest ray.
TOLERANCE = 1e-6


def values(source, name):
    array = servermanager.Fetch(source).GetPointData().GetArray(name)
    assert array, "no array " + name
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def mesh_builds(source):
    source.SMProxy.UpdatePropertyInformation()
    return source.GetPropertyValue("NumberOfMeshBuilds")


def test():
    PluginTesting.load_plugin()
    # 20 voxels along each axis, and a coordinate as a linear field.
    block = simple.Wavelet()
    height = simple.Calculator(Input=block, ResultArrayName="height", Function="coordsX+30")
    rays = simple.TetrahedraRayIntegral(Input=height, ImageSize=[40, 30])
    rays.ScalarArray = ["POINTS", "height"]
    rays.ComputePathLength = 1
    rays.ComputeEnergyBins = 1
    rays.BinAttenuations = [0.0, 0.001]
    image = servermanager.Fetch(rays)
    assert image.GetDimensions() == (40, 30, 1), image.GetDimensions()
    width, height_of_pixel, _ = image.GetSpacing()
    lengths = values(rays, "PathLength")
    met = [length for (length,) in lengths if length > 0]
    assert all(abs(length - 20) < 20 * TOLERANCE for length in met), (min(met), max(met))
    # The edges of the block are edges of pixels here: 30 of the 40 columns meet it.
    assert len(met) == 30 * 30, len(met)
    integral = sum(value for (value,) in values(rays, "Integral")) * width * height_of_pixel
    assert abs(integral / (30 * 20**3) - 1) < TOLERANCE, integral
    for bins, (value,) in zip(values(rays, "EnergyBins"), values(rays, "Integral")):
        assert bins[0] == 1
        assert abs(bins[1] - math.exp(-0.001 * value)) < TOLERANCE
    assert mesh_builds(rays) == 1
    rays.Direction = [1, 0.2, 0.1]
    other = max(length for (length,) in values(rays, "PathLength"))
    longest = 20 * math.sqrt(1.05)
    assert abs(other - longest) < longest * TOLERANCE, other
    assert mesh_builds(rays) == 1, mesh_builds(rays)


if __name__ == "__main__":
    PluginTesting.run(test)
