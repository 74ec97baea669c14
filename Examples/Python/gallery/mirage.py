# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Opaque objects through a medium that bends light: a car on a hot road."""
import numpy
from meniscus import vtkTetrahedraMirage
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkStructuredGrid
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkRenderingCore import vtkCamera

from .car import Model, make_car, paint_car
from .desert import HAZE, light, make_noise, mix, paint_far, paint_ground

EYE = 1.1  # height above the road, in metres
CAR = 400.0  # distance
END = 3000.0  # distance at which the data end
FAR = 30000.0  # distance at which the ground ends
HALF = 6.6e-3  # half of the picture's height, in radians
DOWN = 2.45e-3  # angle by which the camera looks down
ROAD = 3.6  # half of its width


def get_excess(x, y, z):
    """Temperature above that of the air at the eye, in K, at heights z."""
    far = 90.0 * numpy.log(x / 100.0)  # waves that look equally long at each distance
    wave = (numpy.sin(0.21 * far + 0.55 * y) + numpy.sin(0.13 * far - 1.4 * y + 1.0)
            + 0.7 * numpy.sin(0.52 * far + 2.3 * y + 2.0) + 0.5 * numpy.sin(0.8 * far - 3.7 * y))
    depth = z / (1.0 + 0.075 * wave)
    return 24.0 * numpy.exp(-depth / 0.030) + 9.0 * numpy.exp(-depth / 0.25)


def make_air(steps, across):
    """The air above the road, with its index of refraction; cells grow with the distance."""
    up = numpy.expm1(numpy.linspace(0.0, 4.6, 31)) / numpy.expm1(4.6) * 2.5
    along = 4.0 * (END / 4.0) ** numpy.linspace(0.0, 1.0, steps + 1)
    z, y, x = numpy.meshgrid(up, numpy.linspace(-1.0, 1.0, across + 1), along, indexing="ij")
    y = y * (6.0 + 0.011 * x)
    grid = vtkStructuredGrid()
    grid.SetDimensions(x.shape[::-1])
    places = vtkPoints()
    places.SetDataTypeToDouble()
    places.SetData(numpy_to_vtk(numpy.stack([x, y, z], axis=-1).reshape(-1, 3), deep=True))
    grid.SetPoints(places)
    index = 1.0 + 2.72e-4 * 300.0 / (300.0 + get_excess(x, y, z))
    index = numpy_to_vtk(index.ravel(), deep=True)
    index.SetName("n")
    grid.GetPointData().SetScalars(index)
    return grid


def make_camera():
    camera = vtkCamera()
    camera.SetPosition(0.0, 0.0, EYE)
    camera.SetFocalPoint(1.0, 0.0, EYE - DOWN)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetViewAngle(numpy.degrees(2.0 * numpy.arctan(HALF)))
    return camera


SHRUB, POST = 0, 1


def make_roadside():
    """Shrubs in the sand, and white posts along the road."""
    roadside = Model()
    random = numpy.random.default_rng(12)
    a, b = numpy.meshgrid(numpy.linspace(0.0, 2.0 * numpy.pi, 41),
                          numpy.linspace(-0.1, 0.5, 21) * numpy.pi, indexing="ij")
    ball = numpy.stack([numpy.cos(b) * numpy.cos(a), numpy.cos(b) * numpy.sin(a), numpy.sin(b)],
                       axis=-1)
    for number in range(70):
        x = 260.0 * (2200.0 / 260.0) ** random.random()
        y = (ROAD + 1.6 + 9e-3 * x * random.random()) * (-1.0) ** number
        size = (0.18 + 0.00035 * x) * numpy.exp(0.5 * random.standard_normal())
        rough = make_noise(3.0 * a / numpy.pi + 7 * number, 4.0 * b, seed=14, octaves=4)
        rough[-1] = rough[0]
        shape = ball * (0.55 + 0.8 * rough)[..., None] * [1.0, 1.9, 0.8]
        roadside.add(size * shape + [x, y, 0.0], SHRUB)
    for x in numpy.arange(300.0, 1100.0, 100.0):
        for side in (-1.0, 1.0):
            y, z = numpy.meshgrid([-0.06, 0.06], [0.0, 0.4, 0.8], indexing="ij")
            y = y + side * (ROAD + 0.75)
            roadside.add(numpy.stack([numpy.full(y.shape, x), y, z], axis=-1), POST)
    return roadside


def paint_roadside(kinds, places, normals, ways):
    """Leaves and twigs; posts with a black band and a reflector."""
    x, y, z = (places[..., axis] for axis in range(3))
    leaves = make_noise(7.0 * y + x, 9.0 * z, seed=15, octaves=5, gain=0.8)
    shrub = light(mix(numpy.array([0.13, 0.14, 0.07]), [0.46, 0.45, 0.27], leaves), normals, ways,
                  0.0)
    band = (abs(z - 0.64) < 0.10)[..., None]
    lamp = (abs(z - 0.64) < 0.05)[..., None]
    post = light(numpy.where(band, (0.09, 0.09, 0.09), (0.80, 0.80, 0.78)), normals, ways, 0.0)
    post = numpy.where(lamp, (0.86, 0.62, 0.30), post)
    return numpy.where((kinds == SHRUB)[..., None], shrub, post)


def make_ground():
    """A rectangle 0.1 mm below the air, so that no ray ends between the two."""
    ground = Model()
    x, y = numpy.meshgrid([0.0, FAR], [-FAR, FAR], indexing="ij")
    ground.add(numpy.stack([x, y, numpy.full(x.shape, -1e-4)], axis=-1), 0)
    return ground


def draw_mirage(_, size):
    """The road, the car and the sky, each by the rays that reach it."""
    fine = (2 * size[0], 2 * size[1]) if size[1] >= 480 else size
    car, kinds, normals = make_car().build(CAR)
    roadside, roadside_kinds, roadside_normals = make_roadside().build(0.0)
    objects = vtkAppendPolyData()
    for data in (car, roadside, make_ground().build(0.0)[0]):
        objects.AddInputData(data)
    mirage = vtkTetrahedraMirage()
    mirage.SetInputData(make_air(30, 20) if size[1] < 200 else make_air(110, 64))
    mirage.SetQuantityToRefractiveIndex()
    mirage.SetObjectConnection(objects.GetOutputPort())
    mirage.SetCamera(make_camera())
    mirage.SetImageSize(*fine)
    mirage.Update()

    def read(name):
        return vtk_to_numpy(mirage.GetOutput().GetPointData().GetArray(name))

    ways, cells, places = read("Direction").astype(float), read("CellId"), read("Position")
    picture = numpy.empty(ways.shape)
    is_car = (cells >= 0) & (cells < len(kinds))
    is_side = (cells >= len(kinds)) & (cells < len(kinds) + len(roadside_kinds))
    is_ground = cells == len(kinds) + len(roadside_kinds)
    is_far = cells < 0
    picture[is_far] = paint_far(ways[is_far, 1:] / ways[is_far, :1])
    picture[is_ground] = paint_ground(places[is_ground, 0], places[is_ground, 1], ROAD)
    of = cells[is_car]
    picture[is_car] = paint_car(kinds[of], places[is_car] - [CAR, 0, 0], normals[of], ways[is_car])
    of = cells[is_side] - len(kinds)
    picture[is_side] = paint_roadside(roadside_kinds[of], places[is_side], roadside_normals[of],
                                      ways[is_side])
    things = is_car | is_side
    air = 1.0 - numpy.exp(-numpy.where(things, places[:, 0], 0.0) / 5000.0)
    picture[things] = mix(picture[things], HAZE, air[things])
    shares = picture.reshape(size[1], fine[1] // size[1], size[0], -1, 3)
    return make_image(shares.mean(axis=(1, 3)))


def make_image(picture):
    """A vtkImageData of colours from 0 to 1, with rows from below."""
    image = vtkImageData()
    image.SetDimensions(picture.shape[1], picture.shape[0], 1)
    tone = numpy.clip(255.0 * picture + 0.5, 0.0, 255.0).astype(numpy.uint8)
    image.GetPointData().SetScalars(numpy_to_vtk(tone.reshape(-1, 3), deep=True))
    return image
