# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Sight rays to points under flat water: their legs obey Snell's law, and their ends are the true
positions."""
import math

import PluginTesting
from paraview import servermanager, simple

EYE = [0.2, 0.1, 2]
WATER = 1.333


def sine_to_vertical(start, end):
    along = [b - a for a, b in zip(start, end)]
    return math.hypot(along[0], along[1]) / math.hypot(*along)


def check_depths(water):
    """A point seen straight down, one unit behind the surface: how deep it is by each meaning."""
    seen = simple.PointSource(Center=[EYE[0], EYE[1], -1], NumberOfPoints=1, Radius=0)
    truth = simple.TruePosition(Input=seen, Membrane=water, EyePosition=EYE)
    for depth, length in (("Apparent", WATER), ("Optical", 1 / WATER), ("Geometric", 1)):
        truth.Depth = depth
        place = servermanager.Fetch(truth).GetPoint(0)
        assert abs(place[2] + length) < 1e-6, (depth, place)


def test():
    PluginTesting.load_plugin()
    water = simple.Plane(Origin=[-4, -4, 0], Point1=[4, -4, 0], Point2=[-4, 4, 0])
    seen = simple.Plane(Origin=[-1, -1, -0.7], Point1=[1, -1, -0.7], Point2=[-1, 1, -0.7],
                        XResolution=4, YResolution=4)
    rays = simple.SightRays(Input=seen, Membrane=water, EyePosition=EYE)
    lines = servermanager.Fetch(rays)
    assert lines.GetNumberOfCells() == 2 * 25, lines.GetNumberOfCells()
    truth = servermanager.Fetch(simple.TruePosition(Input=seen, Membrane=water, EyePosition=EYE))
    legs = lines.GetCellData()
    for cell in range(lines.GetNumberOfCells()):
        ids = lines.GetCell(cell).GetPointIds()
        ends = [lines.GetPoint(ids.GetId(i)) for i in range(2)]
        index = legs.GetArray("IndexOfRefraction").GetValue(cell)
        if legs.GetArray("Leg").GetValue(cell) == 0:
            assert index == 1 and math.dist(ends[0], EYE) < 1e-12, ends
            surface, before = ends[1], sine_to_vertical(*ends)
        else:
            assert index == WATER and ends[0] == surface, ends
            assert abs(WATER * sine_to_vertical(*ends) - before) < 1e-9, cell
            point = legs.GetArray("PointId").GetValue(cell)
            assert math.dist(ends[1], truth.GetPoint(point)) < 1e-9, cell
    check_depths(water)
    assert rays.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")


if __name__ == "__main__":
    PluginTesting.run(test)
