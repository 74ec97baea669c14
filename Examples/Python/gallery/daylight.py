# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Light of a sun and a sky on planes and boxes: soft shadows and occlusion, as vertex colours."""
import math

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkAppendPolyData

from . import common

GOLDEN = math.pi * (3.0 - math.sqrt(5.0))
AXES = "xyz"


def sample_sky(count):
    """Unit vectors of a Fibonacci sphere."""
    index = numpy.arange(count) + 0.5
    z = 1.0 - 2.0 * index / count
    radius = numpy.sqrt(1.0 - z * z)
    return numpy.stack([radius * numpy.cos(GOLDEN * index), radius * numpy.sin(GOLDEN * index), z],
                       axis=1)


def sample_sun(direction, width, count):
    """Unit vectors to a disc of this radius around a direction."""
    direction = numpy.asarray(direction) / numpy.linalg.norm(direction)
    across = numpy.cross(direction, (0.31, 0.52, 0.79))
    across /= numpy.linalg.norm(across)
    other = numpy.cross(direction, across)
    index = numpy.arange(count) + 0.5
    radius = width * numpy.sqrt(index / count)[:, None]
    angle = (GOLDEN * index)[:, None]
    rays = direction + radius * (numpy.cos(angle) * across + numpy.sin(angle) * other)
    return rays / numpy.linalg.norm(rays, axis=1)[:, None]


def is_hidden(points, ray, boxes, reach=numpy.inf):
    """Whether the ray from each point meets a box (x0, x1, y0, y1, z0, z1) within its reach."""
    hidden = numpy.zeros(len(points), bool)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        for box in boxes:
            low = (numpy.asarray(box[0::2]) - points) / ray
            high = (numpy.asarray(box[1::2]) - points) / ray
            near = numpy.minimum(low, high).max(axis=1)
            far = numpy.maximum(low, high).min(axis=1)
            hidden |= (near < far) & (far > 0) & (near < reach)
    return hidden


def get_light(points, normals, boxes, sun, reach, rays=128):
    """Shares of the sun's light, with the cosine, and of the sky's light that reach points."""
    points = points + 1e-3 * normals  # off the surface; boxes are metres wide
    bright, open_sky, all_sky = (numpy.zeros(len(points)) for _ in range(3))
    suns = sample_sun(sun, 0.06, rays // 2)
    for ray in suns:
        cosine = numpy.maximum(normals @ ray, 0.0)
        bright += cosine * ~is_hidden(points, ray, boxes) / len(suns)
    for ray in sample_sky(2 * rays):
        cosine = numpy.maximum(normals @ ray, 0.0)
        all_sky += cosine
        open_sky += cosine * ~is_hidden(points, ray, boxes, reach)
    return bright, open_sky / all_sky


def refine(light, plane):
    """Values of a coarse grid over a plane, interpolated to the points of the plane."""
    rows, columns = light.shape
    place = vtk_to_numpy(plane.GetPointData().GetTCoords()).astype(float)
    x, y = place[:, 0] * (columns - 1), place[:, 1] * (rows - 1)
    i, j = (numpy.minimum(v.astype(int), n - 2) for v, n in ((x, columns), (y, rows)))
    s, t = x - i, y - j
    return ((1 - t) * ((1 - s) * light[j, i] + s * light[j, i + 1]) +
            t * ((1 - s) * light[j + 1, i] + s * light[j + 1, i + 1]))


class Studio:
    """Planes and boxes whose points have the colour of their material times the light there."""

    def __init__(self, sun, boxes=(), sun_share=0.6, reach=2.0, step=0.03, exposure=1.0):
        self.sun, self.boxes, self.sun_share, self.reach = sun, list(boxes), sun_share, reach
        self.step, self.coarse, self.exposure = step, max(step, 0.03), exposure
        self.parts = vtkAppendPolyData()

    def add_plane(self, origin, first, second, color):
        """Adds a parallelogram whose light falls on the side of (first - origin) x (second -
        origin)."""
        sides = [numpy.subtract(end, origin) for end in (first, second)]
        normal = numpy.cross(*sides)
        normal /= numpy.linalg.norm(normal)
        lengths = [float(numpy.linalg.norm(side)) for side in sides]
        sun, sky = self.get_light(origin, sides, lengths, normal)
        plane = common.make_plane(
            origin, first, second, [max(1, round(length / self.step)) for length in lengths])
        points = vtk_to_numpy(plane.GetPoints().GetData()).astype(float)
        sun, sky = (refine(light, plane) for light in (sun, sky))
        light = self.sun_share * sun[:, None] * (1.0, 0.97, 0.92)
        light = light + 1.6 * (1.0 - self.sun_share) * sky[:, None] * (0.96, 0.98, 1.0)
        if callable(color):
            colors = color(points)
        else:
            colors = numpy.broadcast_to(color, points.shape)
        rgb = numpy.clip(255.0 * self.exposure * colors * light, 0, 255).astype(numpy.uint8)
        array = numpy_to_vtk(rgb, deep=True)
        array.SetName("Light")
        plane.GetPointData().Initialize()
        plane.GetPointData().SetScalars(array)
        self.parts.AddInputData(plane)

    def get_light(self, origin, sides, lengths, normal):
        """Light of the sun and of the sky at a coarse grid of points, as arrays (rows, columns)."""
        columns, rows = (max(2, math.ceil(length / self.coarse)) + 1 for length in lengths)
        along = numpy.linspace(0.0, 1.0, columns)[None, :, None] * sides[0]
        up = numpy.linspace(0.0, 1.0, rows)[:, None, None] * sides[1]
        points = (numpy.asarray(origin) + along + up).reshape(-1, 3)
        normals = numpy.broadcast_to(normal, points.shape)
        return [light.reshape(rows, columns) for light in
                get_light(points, normals, self.boxes, self.sun, self.reach)]

    def add_box(self, box, color, faces="xXyYzZ"):
        """Adds faces of a box of `boxes`: x is the face with the lowest x, X with the highest."""
        corners = numpy.asarray(box).reshape(3, 2)
        for face in faces:
            axis, high = AXES.index(face.lower()), int(face.isupper())
            u, v = (axis + 1) % 3, (axis + 2) % 3
            if not high:
                u, v = v, u
            origin = corners[:, 0].copy()
            origin[axis] = corners[axis, high]
            first, second = origin.copy(), origin.copy()
            first[u], second[v] = corners[u, 1], corners[v, 1]
            self.add_plane(origin, first, second, color)

    def make_actor(self):
        self.parts.Update()
        actor = common.make_actor(self.parts.GetOutput())
        actor.GetMapper().ScalarVisibilityOn()
        actor.GetProperty().LightingOff()
        return actor
