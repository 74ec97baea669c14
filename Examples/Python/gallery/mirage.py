# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Opaque objects through a medium that bends light: a car on a hot road."""
import numpy
from meniscus import vtkTetrahedraMirage
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkImageData, vtkPolyData, vtkStructuredGrid)
from vtkmodules.vtkRenderingCore import vtkCamera

EYE = 1.35  # height above the road, in metres
CAR = 300.0  # distance
END = 1000.0  # distance at which the data end
FAR = 10000.0  # distance at which the ground ends
HALF = 9.5e-3  # half of the picture's height, in radians
ROAD = 3.6  # half of its width


def get_excess(x, y, z):
    """Temperature above that of the air at the eye, in K, at heights z."""
    wave = (numpy.sin(0.105 * x + 0.8 * y) + numpy.sin(0.061 * x - 1.9 * y + 1.0)
            + 0.6 * numpy.sin(0.29 * x + 0.4 * y + 2.0))
    depth = z / (1.0 + 0.1 * wave)
    return 19.0 * numpy.exp(-depth / 0.035) + 8.0 * numpy.exp(-depth / 0.3)


def make_air(begin, end, steps):
    """The air above the road from one distance to another, with its index of refraction."""
    up = numpy.expm1(numpy.linspace(0.0, 4.4, 29)) / numpy.expm1(4.4) * 2.5
    across = numpy.linspace(-15.0, 15.0, 25)
    z, y, x = numpy.meshgrid(up, across, numpy.linspace(begin, end, steps + 1), indexing="ij")
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
    camera.SetFocalPoint(1.0, 0.0, EYE)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetViewAngle(numpy.degrees(2.0 * numpy.arctan(HALF)))
    return camera


class Model:
    """Polygons with colours, in planes of their own."""

    def __init__(self):
        self.data = vtkPolyData()
        self.data.SetPoints(vtkPoints())
        self.data.SetPolys(vtkCellArray())
        self.colors = vtkUnsignedCharArray()
        self.colors.SetNumberOfComponents(3)

    def add(self, color, depth, corners):
        """Corners y, z in the plane x = CAR + depth; on both sides of the middle if y is from 0."""
        first = self.data.GetNumberOfPoints()
        for y, z in corners:
            self.data.GetPoints().InsertNextPoint(CAR + depth, y, z)
        ids = list(range(first, first + len(corners)))
        self.data.GetPolys().InsertNextCell(len(ids), ids)
        self.colors.InsertNextTuple3(*(255.0 * part for part in color))

    def add_ground(self):
        """A rectangle 0.1 mm below the air, so that no ray ends between the two."""
        points = self.data.GetPoints()
        corners = ((0.0, -FAR), (FAR, -FAR), (FAR, FAR), (0.0, FAR))
        ids = [points.InsertNextPoint(x, y, -1e-4) for x, y in corners]
        self.data.GetPolys().InsertNextCell(len(ids), ids)
        self.colors.InsertNextTuple3(255, 255, 255)

    def add_twice(self, color, depth, corners):
        self.add(color, depth, corners)
        self.add(color, depth, [(-y, z) for y, z in corners])


def make_ellipse(y, z, width, height, count=20):
    turns = numpy.linspace(0.0, 2.0 * numpy.pi, count, endpoint=False)
    return [(y + width * numpy.cos(t), z + height * numpy.sin(t)) for t in turns]


def make_car():
    """A red car from the front, and the ground as its last polygon."""
    car = Model()
    red, dark, black = (0.78, 0.08, 0.07), (0.50, 0.03, 0.04), (0.03, 0.03, 0.035)
    tyre = [(0.64, 0.0), (0.84, 0.0), (0.84, 0.6), (0.64, 0.6)]
    car.add_twice((0.11, 0.11, 0.12), 0.6, tyre)
    car.add(black, 0.9, [(-0.8, 0.0), (0.8, 0.0), (0.8, 0.5), (-0.8, 0.5)])
    car.add(red, 1.4, [(-0.80, 0.9), (0.80, 0.9), (0.60, 1.40), (0.45, 1.46), (-0.45, 1.46),
                       (-0.60, 1.40)])
    car.add((0.10, 0.14, 0.18), 1.3, [(-0.70, 0.9), (0.70, 0.9), (0.53, 1.36), (-0.53, 1.36)])
    car.add((0.42, 0.52, 0.60), 1.25, [(-0.60, 1.1), (0.1, 1.18), (0.0, 1.33), (-0.50, 1.33)])
    car.add_twice(dark, 1.0, [(0.80, 0.92), (0.97, 0.95), (0.97, 1.06), (0.82, 1.04)])
    car.add(red, 0.2, [(-0.86, 0.30), (0.86, 0.30), (0.89, 0.70), (0.80, 0.90), (0.6, 0.95),
                       (-0.6, 0.95), (-0.80, 0.90), (-0.89, 0.70)])
    car.add((0.93, 0.42, 0.36), 0.19, [(-0.70, 0.84), (0.70, 0.84), (0.6, 0.94), (-0.6, 0.94)])
    car.add((0.86, 0.16, 0.13), 0.18, [(-0.80, 0.74), (0.80, 0.74), (0.72, 0.84), (-0.72, 0.84)])
    car.add((0.62, 0.05, 0.05), 0.17, [(-0.87, 0.40), (0.87, 0.40), (0.89, 0.52), (-0.89, 0.52)])
    car.add((0.93, 0.42, 0.36), 1.35, [(-0.5, 1.40), (0.5, 1.40), (0.42, 1.45), (-0.42, 1.45)])
    car.add(dark, 0.15, [(-0.84, 0.15), (0.84, 0.15), (0.88, 0.42), (-0.88, 0.42)])
    car.add((0.16, 0.16, 0.17), 0.14, [(-0.6, 0.17), (0.6, 0.17), (0.66, 0.26), (-0.66, 0.26)])
    car.add(black, 0.1, [(-0.48, 0.44), (0.48, 0.44), (0.54, 0.62), (-0.54, 0.62)])
    car.add((0.92, 0.92, 0.88), 0.05, [(-0.26, 0.30), (0.26, 0.30), (0.26, 0.41), (-0.26, 0.41)])
    car.add_twice((0.86, 0.87, 0.88), 0.08, make_ellipse(0.69, 0.64, 0.15, 0.10))
    car.add_twice((1.0, 0.98, 0.86), 0.07, make_ellipse(0.69, 0.64, 0.095, 0.075))
    car.add_ground()
    car.data.GetCellData().SetScalars(car.colors)
    return car.data


def mix(first, second, share):
    return first + (numpy.asarray(second) - first) * share[..., None]


def paint_ground(x, y):
    """Sand, and a road with lines."""
    grain = 0.5 + 0.25 * (numpy.sin(0.11 * x + 0.9 * y) + numpy.sin(0.07 * x - 0.53 * y))
    sand = mix(numpy.array([0.70, 0.57, 0.40]), [0.80, 0.68, 0.50], grain)
    road = mix(numpy.array([0.25, 0.25, 0.27]), [0.31, 0.31, 0.33], grain)
    ground = numpy.where(abs(y)[..., None] < ROAD, road, sand)
    edge = abs(abs(y) - ROAD + 0.35) < 0.09
    dash = (abs(y) < 0.09) & (x % 24.0 < 12.0)
    return numpy.where((edge | dash)[..., None], (0.93, 0.91, 0.84), ground)


def paint_far(slopes):
    """Sky, and hills on the horizon."""
    side, up = slopes[..., 0], slopes[..., 1]
    sky = mix(numpy.array([0.86, 0.91, 0.95]), [0.36, 0.60, 0.88],
              numpy.clip(up / 0.012, 0.0, 1.0) ** 0.7)
    picture = sky
    hills = ((2.6e-3, (0.62, 0.68, 0.76), 0.3), (1.5e-3, (0.50, 0.53, 0.58), 2.0))
    for height, color, phase in hills:
        ridge = height * (0.62 + 0.24 * numpy.sin(310.0 * side + phase)
                          + 0.14 * numpy.sin(770.0 * side + 2.1 * phase)
                          + 0.05 * numpy.sin(2300.0 * side))
        edge = numpy.clip((ridge - up) / 2e-5 + 0.5, 0.0, 1.0)
        picture = mix(picture, color, edge)
    return picture


def draw_mirage(_, size):
    """The road, the car and the sky, each by the rays that reach it."""
    fine = (2 * size[0], 2 * size[1]) if size[1] >= 480 else size
    objects = make_car()
    mirage = vtkTetrahedraMirage()
    mirage.SetInputData(make_air(4.0, END, 20 if size[1] < 200 else 60))
    mirage.SetQuantityToRefractiveIndex()
    mirage.SetObjectData(objects)
    mirage.SetAmbient(1.0)
    mirage.SetCamera(make_camera())
    mirage.SetImageSize(*fine)
    mirage.Update()

    def read(name):
        values = vtk_to_numpy(mirage.GetOutput().GetPointData().GetArray(name))
        return values.reshape((fine[1], fine[0]) + values.shape[1:])

    ways, cells = read("Direction").astype(float), read("CellId")
    picture = paint_far(ways[..., 1:] / ways[..., :1])
    places = read("Position")
    x, y = (numpy.nan_to_num(places[..., axis]) for axis in (0, 1))
    haze = numpy.clip((x - 150.0) / 1500.0, 0.0, 0.6)
    ground = cells == objects.GetNumberOfCells() - 1
    picture = numpy.where(ground[..., None], mix(paint_ground(x, y), (0.80, 0.82, 0.84), haze),
                          picture)
    car = (cells >= 0) & ~ground
    picture = numpy.where(car[..., None], read("Color") / 255.0, picture)
    shares = picture.reshape(size[1], fine[1] // size[1], size[0], -1, 3)
    return make_image(shares.mean(axis=(1, 3)))


def make_image(picture):
    """A vtkImageData of colours from 0 to 1, with rows from below."""
    image = vtkImageData()
    image.SetDimensions(picture.shape[1], picture.shape[0], 1)
    tone = numpy.clip(255.0 * picture + 0.5, 0.0, 255.0).astype(numpy.uint8)
    image.GetPointData().SetScalars(numpy_to_vtk(tone.reshape(-1, 3), deep=True))
    return image
