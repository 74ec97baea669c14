# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Cells divided adaptively: in the representation and in the ray integrals, by their counters and
by the closed form of a trilinear field."""
import re

import PluginTesting
from paraview import servermanager, simple


def count(mapper, name):
    return int(re.search(r"^ *NumberOf%s: (\d+)$" % name, str(mapper), re.MULTILINE).group(1))


# One voxel [0, 1]^3 with the scalar x y z.
simple.LoadPalette("WhiteBackground")
voxel = simple.FastUniformGrid(WholeExtent=[0, 1, 0, 1, 0, 1])
field = simple.Calculator(Input=voxel, ResultArrayName="product",
                          Function="coordsX*coordsY*coordsZ")

view = PluginTesting.make_view()
display = simple.Show(field, view)
display.SetRepresentationType("Tetrahedra Ray Cast")
simple.ColorBy(display, ("POINTS", "product"))
simple.Render(view)
mapper = PluginTesting.mapper_of(display)
assert count(mapper, "CellDivisions") == 0, "fixed"
fixed = PluginTesting.screenshot(view, "true-cells-fixed")
display.CellDivision = "Adaptive"
simple.Render(view)
assert count(mapper, "CellDivisions") == 1, "adaptive"
assert PluginTesting.screenshot(view, "true-cells-adaptive") != fixed
view.CameraPosition = [3, 4, 5]
simple.Render(view)
assert count(mapper, "CellDivisions") == 1, "camera"

rays = simple.TetrahedraRayIntegral(Input=field, ImageSize=[32, 32], FrameMode="Parallel",
                                    FrameOrigin=[0, 0, 2], FrameAxis1=[1, 0, 0],
                                    FrameAxis2=[0, 1, 0])
rays.ScalarArray = ["POINTS", "product"]
worst = {}
for division in "Fixed", "Adaptive":
    rays.CellDivision = division
    image = servermanager.Fetch(rays)
    integral = image.GetPointData().GetArray("Integral")
    # Along z the integral is x y / 2.
    worst[division] = max(
        abs(integral.GetValue(32 * row + column) - 0.5 * (column + 0.5) * (row + 0.5) / 32**2)
        for row in range(32) for column in range(32))
# 1.5 times the tolerance of the scalar along a way of 1, doubled for the cubic part.
assert worst["Adaptive"] <= 2 * 1.5 * 5e-5, worst
assert worst["Fixed"] > 0.01, worst
print("FINISHED")
