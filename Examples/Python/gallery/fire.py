# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A wall behind a fire: its flames glow, and the hot gas above them bends the rays."""
import meniscus
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction, vtkStructuredGrid
from vtkmodules.vtkRenderingCore import vtkCamera, vtkColorTransferFunction, vtkVolumeProperty

from .desert import make_noise, mix, rise
from .mirage import make_image

BED = (0.17, 0.55)  # half of the width and of the depth of the burning bed, in metres
TOP = 0.86  # height of the data
AWAY = 20.0  # distance of the eye from the fire
WALL = 25.0  # distance of the wall behind it
HALF = 0.37  # half of the height of the picture, at the fire
MIDDLE = 0.31  # height of the eye and of the picture's middle
COLD, HOT = 293.0, 2000.0  # temperatures in K
STOICHIOMETRIC = 0.3  # fuel's share where the flame is hottest


def make_waves(places, seed, longest, count=80):
    """Three smooth random fields, of the size 1, as sums of waves from a length downwards."""
    random = numpy.random.default_rng(seed)
    total = numpy.zeros((3,) + places[0].shape)
    for _ in range(count):
        length = longest * 2.0 ** -random.uniform(0.0, 1.7)
        way = random.standard_normal(3) * [1.0, 1.0, 0.55]
        way *= 2.0 * numpy.pi / length / numpy.linalg.norm(way)
        phase = sum(k * p for k, p in zip(way, places)) + random.uniform(0.0, 2.0 * numpy.pi)
        size = (length / longest) ** 0.9 * random.standard_normal(3)
        total += size[:, None, None, None] * numpy.cos(phase)
    return total / total.std()


def get_fuel(x, y, z):
    """Share of burnt and unburnt fuel in the gas, from 0 to 1."""
    wide = make_waves((x, y, z), 5, 0.42)
    fine = make_waves((x, y, 0.8 * z), 8, 0.13)
    growth = 0.25 + 0.75 * rise(0.0, 0.5, z)
    x = x + growth * (0.030 * wide[0] + 0.012 * fine[0])
    y = y + growth * (0.040 * wide[1] + 0.012 * fine[1])
    z = numpy.maximum(z, 0.0)
    width = BED[0] * (0.80 + 0.2 * numpy.exp(-z / 0.06)) - 0.06 * rise(0.0, 0.3, z) + 0.16 * z
    across = numpy.abs(x) / width
    along = numpy.maximum(numpy.abs(y) - BED[1] + 0.12, 0.0) / 0.12
    tongues = 1.0 + 0.33 * wide[2] + 0.12 * fine[2]
    height = 0.30 * numpy.clip(tongues, 0.45, 2.0)
    return numpy.exp(-1.6 * across ** 2.2 - along ** 2 - (z / height) ** 1.15)


def get_temperature(fuel):
    share = fuel / STOICHIOMETRIC
    return COLD + (HOT - COLD) * share * numpy.exp(1.0 - share)


def make_gas(cells):
    """The gas, with its index of refraction and the fuel."""
    across = numpy.linspace(-0.46, 0.46, cells + 1)
    along = numpy.linspace(-BED[1] - 0.12, BED[1] + 0.12, 3 * cells // 4 + 1)
    up = numpy.linspace(0.0, TOP, cells + 1)
    z, y, x = numpy.meshgrid(up, along, across, indexing="ij")
    fuel = get_fuel(x, y, z)
    # A slanted grid: rays do not stay in its planes.
    places = numpy.stack([x + 0.07 * y, y, z + 0.04 * y * rise(0.0, 0.2, z)], axis=-1)
    grid = vtkStructuredGrid()
    grid.SetDimensions(x.shape[::-1])
    points = vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(places.reshape(-1, 3), deep=True))
    grid.SetPoints(points)
    for name, values in (("n", 1.0 + 2.72e-4 * COLD / get_temperature(fuel)), ("fuel", fuel)):
        array = numpy_to_vtk(values.ravel(), deep=True)
        array.SetName(name)
        grid.GetPointData().AddArray(array)
    return grid


def make_look():
    """Soot glows where there is fuel left; the hot gas above is clear."""
    opacity = vtkPiecewiseFunction()
    colors = vtkColorTransferFunction()
    for fuel, attenuation, color in (
            (0.20, 0.0, (1.00, 0.30, 0.06)), (0.28, 1.5, (1.00, 0.36, 0.06)),
            (0.40, 9.0, (1.00, 0.55, 0.14)), (0.60, 13.0, (1.00, 0.80, 0.42)),
            (0.80, 5.0, (0.95, 0.62, 0.30)), (1.00, 1.0, (0.35, 0.35, 0.75))):
        opacity.AddPoint(fuel, attenuation)
        colors.AddRGBPoint(fuel, *color)
    look = vtkVolumeProperty()
    look.SetScalarOpacity(opacity)
    look.SetColor(colors)
    return look


def make_camera():
    camera = vtkCamera()
    camera.SetPosition(0.0, -AWAY, MIDDLE)
    camera.SetFocalPoint(0.0, 0.0, MIDDLE)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetViewAngle(numpy.degrees(2.0 * numpy.arctan(HALF / AWAY)))
    return camera


def make_objects():
    """Points and triangles of the wall, two of them, and of the tray that the fire burns in."""
    half, (width, depth) = 9.0, (BED[0] + 0.13, BED[1] + 0.1)
    corners = [(-half, WALL, -half), (half, WALL, -half), (half, WALL, half), (-half, WALL, half)]
    corners += [(x, y, z) for z in (-0.2, -0.001) for x, y in (
        (-width, -depth), (width, -depth), (width, depth), (-width, depth))]
    sides = [(0, 1, 2, 3), (4, 5, 9, 8), (8, 9, 10, 11)]
    return (numpy.array(corners, float),
            numpy.array([part for a, b, c, d in sides for part in ((a, b, c), (a, c, d))]))


def paint_wall(x, z):
    """Tiles in two colours, with joints, in the light of the fire."""
    size = 0.12
    column, row = numpy.floor(x / size), numpy.floor(z / size)
    u, v = x / size - column, z / size - row
    edge = numpy.minimum(numpy.minimum(u, 1.0 - u), numpy.minimum(v, 1.0 - v))
    joint = 1.0 - rise(0.015, 0.035, edge)
    dark = ((column + row) % 2)[..., None]
    tone = 0.9 + 0.2 * make_noise(9.0 * column, 7.0 * row, seed=3, octaves=2)
    tone = tone * (0.94 + 0.12 * make_noise(40.0 * x, 40.0 * z, seed=4, octaves=3))
    tiles = numpy.where(dark, (0.13, 0.20, 0.27), (0.80, 0.78, 0.72)) * tone[..., None]
    wall = mix(tiles, [0.33, 0.31, 0.29], joint)
    glow = numpy.exp(-((x / 1.1) ** 2 + ((z - 0.2) / 0.9) ** 2))
    return wall * (0.45 + glow[..., None] * [0.62, 0.46, 0.30])


def paint_tray(x, y, z):
    """Dark steel, red-hot at the fire."""
    metal = 0.05 + 0.05 * make_noise(80.0 * x, 30.0 * (y + z), seed=6, octaves=3)
    heat = rise(0.1, -0.05, numpy.hypot(numpy.maximum(abs(x) - BED[0], 0.0), 3.0 * z))
    return metal[..., None] + heat[..., None] * [0.30, 0.10, 0.03]


def draw_fire(_, size):
    """The tiles behind the fire, by the rays that reach them, and the flames in front."""
    fine = (2 * size[0], 2 * size[1]) if size[1] >= 480 else size
    seen = meniscus.mirage(
        make_gas(16 if size[1] < 200 else 96), make_objects(), "n", ["rgba", "position", "cell_id"],
        quantity="refractive_index", volume=make_look(), volume_scalars="fuel",
        camera=make_camera(), size=fine)
    x, y, z = (seen["position"][..., axis] for axis in range(3))
    is_wall = (seen["cell_id"] < 2)[..., None]
    behind = numpy.where(is_wall, paint_wall(x, z), paint_tray(x, y, z))
    light, opacity = seen["rgba"][..., :3], seen["rgba"][..., 3:]
    shares = (light + (1.0 - opacity) * behind).reshape(size[1], fine[1] // size[1], size[0], -1, 3)
    return make_image(shares.mean(axis=(1, 3)))
