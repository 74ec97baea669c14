# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Without a display, and so without OpenGL, the plugin loads and its filter runs."""
import PluginTesting
from paraview import servermanager, simple


def test():
    PluginTesting.load_plugin()
    ball = simple.Sphere(Center=[0, 0, -1])
    water = simple.Plane(Origin=[-3, -3, 0], Point1=[3, -3, 0], Point2=[-3, 3, 0])
    refracted = simple.RefractedGeometry(Geometry=ball, Membrane=water, EyePosition=[0, -2, 1.5])
    points = servermanager.Fetch(refracted).GetNumberOfPoints()
    print("%d points" % points)
    assert points >= servermanager.Fetch(ball).GetNumberOfPoints()


if __name__ == "__main__":
    PluginTesting.run(test)
