# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A volume seen through a lens."""
import math

import meniscus
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkSphere
from vtkmodules.vtkFiltersCore import vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkSphereSource

from . import common, volumes


# Of the lens: glass between two caps of spheres, in the unit of the combustor's mesh.
CURVATURE = 16.0
APERTURE = 2.9  # radius
TARGET = (8.6, 0.7, 27.8)  # point under the middle of the lens
DISTANCE = 13.0  # from the lens to the target


def draw_lens(data, size):
    """Jets in the combustor under a magnifying glass."""
    volume, colors = volumes.make_medium(data)
    renderer = common.make_renderer()
    renderer.AddVolume(volume)
    common.light_flames(renderer)
    renderer.GetActiveCamera().Zoom(0.95)
    axis = [e - t for e, t in zip(renderer.GetActiveCamera().GetPosition(), TARGET)]
    length = math.sqrt(sum(a * a for a in axis))
    axis = [a / length for a in axis]
    middle = [t + DISTANCE * a for t, a in zip(TARGET, axis)]
    depth = math.sqrt(CURVATURE ** 2 - APERTURE ** 2)
    glasses = meniscus.vtkRefractingInterfaceCollection()
    for side in (1, -1):
        exact = vtkSphere()
        exact.SetRadius(CURVATURE)
        exact.SetCenter(*(m - side * depth * a for m, a in zip(middle, axis)))
        volume.GetMapper().AddMembraneData(make_cap(
            exact, [side * a for a in axis], math.degrees(math.asin(APERTURE / CURVATURE))))
        glasses.AddInterface(1.0, 1.5).SetExactSurface(exact)
    volume.GetMapper().SetInterfaces(glasses)
    ring = common.make_actor(make_ring(middle, axis, 1.02 * APERTURE, 0.09), (0.75, 0.62, 0.38))
    ring.GetProperty().SetSpecular(0.6)
    renderer.AddActor(ring)
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
