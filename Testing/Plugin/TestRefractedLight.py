# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Light through flat water against its closed form, on geometry and on blocks; through waves it
gathers."""
import math

import PluginTesting
from paraview import servermanager, simple

WATER = 1.333
TOLERANCE = 2e-4


def plane(half, height, resolution):
    return simple.Plane(Origin=[-half, -half, height], Point1=[half, -half, height],
                        Point2=[-half, half, height], XResolution=resolution,
                        YResolution=resolution)


def transmittance(cosine):
    refracted = math.sqrt(1 - (1 - cosine * cosine) / WATER ** 2)
    s = (cosine - WATER * refracted) / (cosine + WATER * refracted)
    p = (WATER * cosine - refracted) / (WATER * cosine + refracted)
    return 1 - (s * s + p * p) / 2


def irradiance(data):
    return data.GetPointData().GetArray("RefractionIrradiance").GetRange()


def test():
    PluginTesting.load_plugin()
    floor = plane(1, -1, 20)
    light = simple.RefractedLight(Geometry=floor, Membrane=plane(5, 0, 2))
    for angle in 0, 0.8:
        light.LightPosition = [math.sin(angle), 0, math.cos(angle)]
        expected = math.cos(angle) * transmittance(math.cos(angle))
        low, high = irradiance(servermanager.Fetch(light))
        assert abs(low - expected) < TOLERANCE and abs(high - expected) < TOLERANCE, (low, high)

    blocks = simple.RefractedLight(
        Geometry=simple.GroupDatasets(Input=[floor, plane(0.5, -2, 4)]), Membrane=plane(5, 0, 2))
    found = servermanager.Fetch(blocks)
    assert found.GetNumberOfBlocks() == 2
    for block in range(2):
        low, high = irradiance(found.GetBlock(block))
        assert abs(low - transmittance(1)) < TOLERANCE and abs(high - transmittance(1)) < TOLERANCE

    waves = simple.Calculator(Input=plane(5, 0, 100), CoordinateResults=1,
                              Function="coords+kHat*0.05*sin(4*coordsX)*cos(4*coordsY)")
    light.Membrane = simple.GenerateSurfaceNormals(Input=waves)  # the plane's are still there
    light.LightPosition = [0, 0, 1]
    low, high = irradiance(servermanager.Fetch(light))
    print("through waves %.2f to %.2f" % (low, high))
    # Crests and troughs have a curvature of 0.8: a thin lens, T / (1 -+ 0.8 (1 - 1 / n) depth)^2 in
    # the middle, less in a cell.
    lens = 0.8 * (1 - 1 / WATER)
    assert transmittance(1) / (1 + lens) ** 2 - 0.02 < low < 0.75
    assert 1.4 < high < transmittance(1) / (1 - lens) ** 2 + 0.02


if __name__ == "__main__":
    PluginTesting.run(test)
