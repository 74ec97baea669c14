# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A red car that comes along the x axis, its polygons and its colours.

Its own coordinates are x from the front bumper backwards, y to the left, z from the road.
"""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from .desert import light, make_noise, mix, rise

BODY, GLASS, TYRE, UNDER, MIRROR = range(5)
PAINT = numpy.array([0.66, 0.030, 0.028])


class Model:
    """Patches of quadrangles with a kind of material each, normals and a vtkPolyData."""

    def __init__(self):
        self.points, self.quads, self.kinds, self.count = [], [], [], 0

    def add(self, grid, kind):
        """A grid of places, rows by columns by 3."""
        rows, columns = grid.shape[:2]
        numbers = self.count + numpy.arange(rows * columns).reshape(rows, columns)
        corners = [numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, 1:], numbers[1:, :-1]]
        self.quads.append(numpy.stack(corners, axis=-1).reshape(-1, 4))
        self.kinds.append(numpy.full(len(self.quads[-1]), kind))
        self.points.append(grid.reshape(-1, 3))
        self.count += rows * columns

    def build(self, shift):
        """Polygons, with the car's origin at a distance; also their kinds and normals."""
        places, quads = numpy.concatenate(self.points), numpy.concatenate(self.quads)
        corners = places[quads]
        normals = numpy.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-12)[:, None]
        data, points, polygons = vtkPolyData(), vtkPoints(), vtkCellArray()
        points.SetDataTypeToDouble()
        points.SetData(numpy_to_vtk(places + [shift, 0.0, 0.0], deep=True))
        polygons.SetData(4, numpy_to_vtkIdTypeArray(quads.ravel().astype(numpy.int64), deep=True))
        data.SetPoints(points)
        data.SetPolys(polygons)
        return data, numpy.concatenate(self.kinds), normals


def bend(turns, power):
    """A rounded rectangle: cosine and sine with their sizes to a power below 1."""
    c, s = numpy.cos(turns), numpy.sin(turns)
    return numpy.sign(c) * abs(c) ** power, numpy.sign(s) * abs(s) ** power


def make_loft(stations, turns, power):
    """Rounded rectangles across x: stations of x, half the width, bottom and top."""
    table = numpy.array(stations)
    fine = numpy.linspace(0.0, 1.0, 8 * len(table)) * (len(table) - 1)
    x, width, low, high = (numpy.interp(fine, range(len(table)), table[:, k]) for k in range(4))
    c, s = bend(turns, power)
    y = width[:, None] * c
    z = (0.5 * (low + high))[:, None] + (0.5 * (high - low))[:, None] * s
    # The flanks are widest above the middle, and the bonnet is vaulted.
    y = y * (1.0 - 0.05 * numpy.clip((z - 0.62) / 0.3, -1.0, 1.0) ** 2)
    return numpy.stack([numpy.broadcast_to(x[:, None], y.shape), y, z], axis=-1)


def make_cabin(turns):
    """Rounded rectangles in planes of constant z: z, front, rear and half the width."""
    table = numpy.array([(0.86, 1.02, 3.95, 0.80), (1.00, 1.28, 3.85, 0.775),
                         (1.15, 1.55, 3.70, 0.725), (1.28, 1.80, 3.55, 0.675),
                         (1.37, 2.02, 3.42, 0.625), (1.415, 2.22, 3.25, 0.55),
                         (1.435, 2.45, 3.05, 0.40), (1.44, 2.70, 2.75, 0.02)])
    fine = numpy.linspace(0.0, len(table) - 1.0, 6 * len(table))
    z, front, rear, width = (numpy.interp(fine, range(len(table)), table[:, k]) for k in range(4))
    c, s = bend(turns, 0.36)
    x = (0.5 * (front + rear))[:, None] + (0.5 * (rear - front))[:, None] * c
    y = width[:, None] * s
    x = x + 0.22 * (y / 0.8) ** 2 * (c < 0.0)
    return numpy.stack([x, y, numpy.broadcast_to(z[:, None], x.shape)], axis=-1)


def make_car():
    car = Model()
    turns = numpy.linspace(0.0, 2.0 * numpy.pi, 161)
    body = [(0.00, 0.02, 0.44, 0.46), (0.01, 0.52, 0.34, 0.58), (0.05, 0.68, 0.27, 0.67),
            (0.14, 0.79, 0.22, 0.735), (0.30, 0.845, 0.20, 0.79), (0.60, 0.885, 0.19, 0.845),
            (1.00, 0.905, 0.19, 0.90), (1.40, 0.915, 0.19, 0.93), (4.00, 0.915, 0.20, 0.95),
            (4.30, 0.84, 0.26, 0.90)]
    car.add(make_loft(body, turns, 0.42), BODY)
    car.add(make_cabin(turns), GLASS)
    for side in (-1.0, 1.0):
        for x in (0.80, 3.35):
            around = numpy.linspace(0.0, 2.0 * numpy.pi, 61)
            across = numpy.array([0.665, 0.675, 0.70, 0.84, 0.865, 0.875])
            radius = numpy.array([0.20, 0.30, 0.322, 0.322, 0.30, 0.20])
            y, a = numpy.meshgrid(side * across, around, indexing="ij")
            r = radius[:, None]
            car.add(numpy.stack([x + r * numpy.cos(a), y, 0.322 + r * numpy.sin(a)], axis=-1),
                    TYRE)
        a, b = numpy.meshgrid(turns[::8], numpy.linspace(-0.5, 0.5, 13) * numpy.pi,
                              indexing="ij")
        car.add(numpy.stack([1.45 + 0.07 * numpy.cos(b) * numpy.sin(a),
                             side * (0.99 + 0.115 * numpy.sin(b)),
                             0.985 + 0.075 * numpy.cos(b) * numpy.cos(a)], axis=-1), MIRROR)
        arm = numpy.array([[[1.42, side * 0.78, 0.935], [1.42, side * 0.93, 0.955]],
                           [[1.42, side * 0.78, 0.965], [1.42, side * 0.93, 0.985]]])
        car.add(arm, UNDER)
    y, z = numpy.meshgrid([-0.70, 0.70], [0.08, 0.40], indexing="ij")
    car.add(numpy.stack([numpy.full(y.shape, 0.62), y, z], axis=-1), UNDER)
    return car


def inside(distance, soft=0.006):
    """Share of a pixel in a shape, from its distance to the shape's edge."""
    return rise(soft, -soft, distance)


def box(y, z, middle, half, round_):
    """Distance from a rectangle with round corners."""
    dy, dz = abs(y) - half[0] + round_, abs(z - middle) - half[1] + round_
    return numpy.hypot(numpy.maximum(dy, 0), numpy.maximum(dz, 0)) + numpy.minimum(
        numpy.maximum(dy, dz), 0.0) - round_


def paint_front(places, normals, ways):
    """The body: paint, and on its front the lamps, the grille and the number plate."""
    y, z = places[..., 1], places[..., 2]
    shape = light(numpy.broadcast_to(PAINT, places.shape), normals, ways, 0.75)
    front = numpy.where(places[..., 0] < 0.75, 1.0, 0.0)
    # Joints: bonnet, bumper.
    joint = numpy.minimum(abs(z - 0.700 - 0.05 * (1 - (y / 0.8) ** 2)) + (abs(y) > 0.80),
                          abs(abs(y) - 0.56 - 0.5 * (z - 0.74)) + (z < 0.74))
    shape = mix(shape, 0.35 * PAINT, 0.8 * front * inside(joint - 0.004, 0.004))
    # A wide grille with bars, and the intake below with a dark lip.
    grille = box(y, z, 0.585, (0.36 + 0.25 * (z - 0.585), 0.062), 0.035)
    bars = 0.5 + 0.5 * numpy.cos(2.0 * numpy.pi * z / 0.031)
    shape = mix(shape, [0.74, 0.75, 0.77], front * inside(grille - 0.012))
    shape = mix(shape, numpy.array([0.02, 0.02, 0.022]) + 0.13 * bars[..., None] ** 3,
                front * inside(grille))
    lower = box(y, z, 0.335, (0.52 - 0.5 * (z - 0.335), 0.055), 0.03)
    mesh = 0.5 + 0.5 * numpy.cos(2.0 * numpy.pi * y / 0.05) * numpy.cos(2.0 * numpy.pi * z / 0.04)
    shape = mix(shape, numpy.array([0.02, 0.02, 0.022]) + 0.05 * mesh[..., None],
                front * inside(lower))
    lip = z - 0.245
    shape = mix(shape, [0.055, 0.055, 0.06], front * inside(lip, 0.008))
    badge = numpy.hypot(y, z - 0.683) - 0.032
    shape = mix(shape, [0.86, 0.87, 0.89], front * inside(badge))
    shape = mix(shape, [0.10, 0.14, 0.30], front * inside(badge + 0.010))
    plate = box(y, z, 0.46, (0.26, 0.055), 0.01)
    shape = mix(shape, [0.90, 0.89, 0.84], front * inside(plate))
    letter = (y / 0.052 + 0.5) % 1.0
    marks = (abs(letter - 0.5) < 0.30) & (abs(z - 0.46) < 0.032) & (abs(y) < 0.21) & (
        make_noise(y / 0.012, z / 0.014, seed=4, octaves=1) > 0.36)
    shape = mix(shape, [0.10, 0.10, 0.14], 0.9 * marks * front)
    # Lamps: swept lenses with a bright projector each, and round fog lamps.
    u = abs(y) - 0.635
    lamp = box(u, z - 0.30 * u, 0.655, (0.155, 0.058), 0.05)
    lens = mix(numpy.array([0.34, 0.36, 0.39]), [0.88, 0.90, 0.93], rise(0.62, 0.72, z - 0.3 * u))
    shape = mix(shape, [0.06, 0.06, 0.065], front * inside(lamp - 0.010))
    shape = mix(shape, lens, front * inside(lamp))
    for middle, radius in ((0.02, 0.046), (-0.085, 0.036)):
        bulb = numpy.hypot(u - middle, z - 0.655 - 0.3 * middle) - radius
        shape = mix(shape, [0.20, 0.21, 0.23], front * inside(bulb - 0.008))
        shape = mix(shape, [1.0, 0.99, 0.93], front * inside(bulb, 0.014))
    fog = numpy.hypot(abs(y) - 0.64, z - 0.36) - 0.045
    shape = mix(shape, [0.07, 0.07, 0.075], front * inside(fog - 0.028))
    return mix(shape, [0.93, 0.93, 0.88], front * inside(fog))


def paint_cabin(places, normals, ways):
    """Windscreen between pillars, with people, seats and wipers behind and on it; the roof."""
    y, z = places[..., 1], places[..., 2]
    frame = light(numpy.broadcast_to(PAINT, places.shape), normals, ways, 0.75)
    dark = numpy.broadcast_to(numpy.array([0.035, 0.042, 0.048]), places.shape)
    seen = mix(dark, [0.11, 0.12, 0.13], rise(1.30, 0.95, z))
    for middle, shirt in ((-0.34, (0.16, 0.20, 0.27)), (0.34, (0.06, 0.06, 0.07))):
        head = numpy.hypot((y - middle) / 0.085, (z - 1.205) / 0.115) - 1.0
        chest = box(y - middle, z, 0.98, (0.20, 0.13), 0.09)
        rest = box(y - middle, z, 1.16, (0.12, 0.11), 0.05)
        seen = mix(seen, [0.05, 0.05, 0.055], inside(rest, 0.012))
        seen = mix(seen, shirt, inside(chest, 0.015))
        if middle < 0.0:
            seen = mix(seen, [0.34, 0.23, 0.17], inside(head, 0.15))
    wheel = abs(numpy.hypot((y + 0.34) / 0.18, (z - 0.955) / 0.13) - 1.0) - 0.08
    seen = mix(seen, [0.03, 0.03, 0.032], inside(wheel, 0.03))
    seen = mix(seen, [0.04, 0.04, 0.045], inside(box(y, z, 1.325, (0.12, 0.025), 0.012)))
    glass = light(seen, normals, ways, 0.62)
    glass = mix(glass, [0.70, 0.80, 0.90], 0.20 * rise(-0.9, 0.6, y + 1.2 * (z - 1.1)))
    half = 0.775 - 0.46 * numpy.clip(z - 0.95, 0.0, 1.0) ** 1.15
    screen = numpy.maximum(abs(y) - half + 0.05, numpy.maximum(0.935 - z, z - 1.355))
    painted = mix(frame, [0.03, 0.03, 0.035], inside(screen - 0.016))
    painted = mix(painted, glass, inside(screen))
    blade = numpy.minimum(abs(z - 0.955 - 0.10 * (y + 0.1)) + (abs(y + 0.35) > 0.30),
                          abs(z - 0.955 + 0.08 * (y - 0.55)) + (abs(y - 0.25) > 0.28))
    return mix(painted, [0.02, 0.02, 0.02], inside(blade - 0.006, 0.004))


def paint_car(kinds, places, normals, ways):
    """Colours of places of the car, each with the material's kind, normal and sight ray."""
    tyre = light(numpy.broadcast_to(numpy.array([0.055, 0.055, 0.058]), places.shape), normals,
                 ways, 0.12)
    groove = 0.5 + 0.5 * numpy.cos(2.0 * numpy.pi * places[..., 1] / 0.045)
    tyre = tyre * (0.7 + 0.3 * groove[..., None])
    under = numpy.broadcast_to(numpy.array([0.022, 0.021, 0.021]), places.shape)
    mirror = light(numpy.broadcast_to(PAINT, places.shape), normals, ways, 0.7)
    choices = (paint_front(places, normals, ways), paint_cabin(places, normals, ways), tyre, under,
               mirror)
    return numpy.choose(kinds[..., None], choices)
