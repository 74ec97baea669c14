# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Cells divided adaptively: in the representation and in the ray integrals, by their counters and
by the closed form of a trilinear field."""
import re

import PluginTesting
from paraview import servermanager, simple

TOLERANCE = 1e-3


def value(algorithm, name):
    return int(re.search(r"^ *%s: (\d+)$" % name, str(algorithm), re.MULTILINE).group(1))


def count(mapper, name):
    return value(mapper, "NumberOf" + name)


def test():
    PluginTesting.load_plugin()
    # One voxel [0, 1]^3 with the scalar x y z.
    voxel = simple.FastUniformGrid(WholeExtent=[0, 1, 0, 1, 0, 1])
    field = simple.Calculator(Input=simple.AppendDatasets(Input=voxel), ResultArrayName="product",
                              Function="coordsX*coordsY*coordsZ")
    check_frames(field)
    check_integrals(field)


def check_frames(field):
    view = PluginTesting.make_view()
    display = simple.Show(field, view)
    display.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(display, ("POINTS", "product"))
    fixed = PluginTesting.screenshot(view, "true-cells-fixed")
    mapper = PluginTesting.mapper_of(display)
    assert count(mapper, "CellDivisions") == 0, "fixed"
    display.DivisionTolerance = TOLERANCE
    display.CellDivision = "Adaptive"
    assert PluginTesting.screenshot(view, "true-cells-adaptive") != fixed
    assert count(mapper, "CellDivisions") == 1, "adaptive"
    view.CameraPosition = [3, 4, 5]
    display.MaximumNumberOfPieces = 1000000
    simple.Render(view)
    assert count(mapper, "CellDivisions") == 1, "camera"
    assert value(mapper, "MaximumNumberOfPieces") == 1000000


def check_integrals(field):
    rays = simple.TetrahedraRayIntegral(Input=field, ImageSize=[32, 32], FrameMode="Parallel",
                                        FrameOrigin=[0, 0, 2], FrameAxis1=[1, 0, 0],
                                        FrameAxis2=[0, 1, 0])
    rays.ScalarArray = ["POINTS", "product"]
    rays.DivisionTolerance = TOLERANCE
    rays.MaximumNumberOfPieces = 1000000
    worst = {}
    for division in "Fixed", "Adaptive":
        rays.CellDivision = division
        integral = servermanager.Fetch(rays).GetPointData().GetArray("Integral")
        # Along z the integral is x y / 2.
        worst[division] = max(
            abs(integral.GetValue(32 * row + column) - 0.5 * (column + 0.5) * (row + 0.5) / 32**2)
            for row in range(32) for column in range(32))
    # 1.5 times the tolerance of the scalar along a way of 1, doubled for the cubic part.
    assert worst["Adaptive"] <= 2 * 1.5 * TOLERANCE, worst
    assert worst["Fixed"] > 0.01, worst
    assert value(rays.GetClientSideObject(), "MaximumNumberOfPieces") == 1000000


if __name__ == "__main__":
    PluginTesting.run(test)
