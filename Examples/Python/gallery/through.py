# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A volume seen through a lens."""
import math

import meniscus
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkSphere
from vtkmodules.vtkFiltersCore import vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkSphereSource

from . import common


def draw_lens(data, size):
    """A part of the blunt fin's shock under a magnifying glass."""
    mesh = data.fin
    colors = common.make_colors(common.VIRIDIS, 0.4, 3.4)
    opacity = common.make_opacity(
        ((0.4, 0.5), (0.8, 0.08), (1.05, 0.0), (1.25, 0.35), (1.8, 0.2), (2.4, 0.7), (3.4, 1.0)))
    renderer = common.make_renderer()
    glasses = meniscus.vtkRefractingInterfaceCollection()
    look = common.make_look(colors, opacity, 0.9, False)
    whole = common.make_volume(mesh, look)
    mapper = whole.GetMapper()
    focus, eye, target = (2.2, 2.4, 2.4), (-1.5, 4.5, 27.0), (-0.2, 1.4, 2.4)
    axis = [e - f for e, f in zip(eye, target)]
    length = math.sqrt(sum(a * a for a in axis))
    axis = [a / length for a in axis]
    # Two caps of spheres of radius 8 around points of the axis: a lens of 4.6 across.
    middle = [f + 7.5 * a for f, a in zip(target, axis)]
    for side in (1, -1):
        exact = vtkSphere()
        exact.SetRadius(8.0)
        exact.SetCenter(*(m - side * 7.6 * a for m, a in zip(middle, axis)))
        mapper.AddMembraneData(make_cap(exact, [side * a for a in axis], 18.2))
        glasses.AddInterface(1.0, 1.5).SetExactSurface(exact)
    mapper.SetInterfaces(glasses)
    renderer.AddVolume(whole)
    ring = common.make_actor(make_ring(middle, axis, 2.54, 0.09), (0.75, 0.62, 0.38))
    ring.GetProperty().SetSpecular(0.6)
    renderer.AddActor(ring)
    common.add_lights(renderer, ((-0.7, 0.9, 1.0), (1.0, 0.98, 0.94), 1.1))
    common.look_from(renderer, eye, focus, (0, 1, 0), 27.0)
    renderer.ResetCameraClippingRange()
    return common.take(renderer, size, common.make_bar(colors, "Density"))


def make_axes(axis):
    """Two unit vectors that make a right-handed frame with an axis."""
    norm = math.hypot(axis[1], axis[2])
    x = (0.0, axis[2] / norm, -axis[1] / norm)
    y = (axis[1] * x[2] - axis[2] * x[1], axis[2] * x[0] - axis[0] * x[2],
         axis[0] * x[1] - axis[1] * x[0])
    return x, y


def make_ring(center, axis, radius, thickness):
    """The frame of a lens."""
    x, y = make_axes(axis)
    line = vtkLineSource()
    points = vtkPoints()
    for i in range(98):  # one piece twice, so that no seam is seen
        angle = 2.0 * math.pi * i / 96
        points.InsertNextPoint(*(center[k] + radius * (math.cos(angle) * x[k] +
                                                       math.sin(angle) * y[k]) for k in range(3)))
    line.SetPoints(points)
    tube = vtkTubeFilter()
    tube.SetInputConnection(line.GetOutputPort())
    tube.SetRadius(thickness)
    tube.SetNumberOfSides(16)
    tube.Update()
    return tube.GetOutput()


def make_cap(sphere, axis, degrees):
    """The part of a sphere within an angle of an axis."""
    source = vtkSphereSource()
    source.SetRadius(sphere.GetRadius())
    source.SetThetaResolution(72)
    source.SetPhiResolution(24)
    source.SetEndPhi(degrees)
    source.Update()
    cap = source.GetOutput()
    x, y = make_axes(axis)

    def turn(vector):
        return [vector[0] * x[i] + vector[1] * y[i] + vector[2] * axis[i] for i in range(3)]

    normals = cap.GetPointData().GetNormals()
    for i in range(cap.GetNumberOfPoints()):
        point = turn(cap.GetPoint(i))
        cap.GetPoints().SetPoint(i, *(c + p for c, p in zip(sphere.GetCenter(), point)))
        normals.SetTuple3(i, *turn(normals.GetTuple3(i)))
    return cap
