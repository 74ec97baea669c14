# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A picture through two lenses of graded index: Luneburg's lens and Maxwell's fish-eye."""
import colorsys
import math

import numpy
from meniscus import vtkTetrahedraMirage
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkCamera

from .mirage import make_image, mix

WALL = 1.35  # distance of the wall behind the middle of the ball, whose radius is 1
EYE = 9.0
HALF = math.tan(math.radians(8.6))
TURN = numpy.linalg.qr(numpy.array([[2.0, 1.0, 0.4], [-0.7, 2.0, 0.9], [0.3, -0.8, 1.7]]))[0]


def make_ball(cells):
    """Hexahedra in a ball: a cube whose shells are pushed to spheres. Returns points and mesh."""
    axis = numpy.linspace(-1.0, 1.0, cells + 1)
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij")
    cube = numpy.stack([x, y, z], axis=-1)
    squares = cube ** 2
    # A smooth map of the cube to the ball.
    ball = cube * numpy.sqrt(
        1.0 - 0.5 * (numpy.roll(squares, 1, -1) + numpy.roll(squares, 2, -1))
        + numpy.roll(squares, 1, -1) * numpy.roll(squares, 2, -1) / 3.0)
    # Turned, so that no row of cells lies along the rays.
    ball = ball.reshape(-1, 3) @ TURN
    places = vtkPoints()
    places.SetDataTypeToDouble()
    places.SetData(numpy_to_vtk(ball, deep=True))
    mesh = vtkUnstructuredGrid()
    mesh.SetPoints(places)
    mesh.Allocate(cells ** 3)
    side = cells + 1
    for k in range(cells):
        for j in range(cells):
            for i in range(cells):
                low = (k * side + j) * side + i
                face = [low, low + 1, low + side + 1, low + side]
                mesh.InsertNextCell(VTK_HEXAHEDRON, 8, face + [p + side * side for p in face])
    return ball, mesh


def see_through(mesh, index, size):
    """Places x, y on the wall that the pixels see; rays beside the mesh are straight."""
    values = numpy_to_vtk(numpy.maximum(index, 1.0), deep=True)  # rounding
    values.SetName("n")
    mesh.GetPointData().SetScalars(values)
    camera = vtkCamera()
    camera.SetPosition(0.0, 0.0, EYE)
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    camera.SetViewAngle(math.degrees(2.0 * math.atan(HALF)))
    wall = vtkPlaneSource()
    wall.SetOrigin(-1000.0, -1000.0, -WALL)
    wall.SetPoint1(1000.0, -1000.0, -WALL)
    wall.SetPoint2(-1000.0, 1000.0, -WALL)
    picture = vtkTetrahedraMirage()
    picture.SetInputData(mesh)
    picture.SetQuantityToRefractiveIndex()
    picture.SetObjectConnection(wall.GetOutputPort())
    picture.SetCamera(camera)
    picture.SetImageSize(*size)
    picture.Update()
    places = vtk_to_numpy(picture.GetOutput().GetPointData().GetArray("Position"))
    # Some rays of the fish-eye turn back and see no wall.
    return numpy.nan_to_num(places.reshape(size[1], size[0], 3)[..., :2], nan=1000.0)


def paint_wall(places):
    """A chart of coloured sectors and rings, in tiles, which fade where they are far away."""
    x, y = places[..., 0], places[..., 1]
    radius = numpy.hypot(x, y)
    turn = numpy.arctan2(y, x) / (2.0 * math.pi) % 1.0
    hues = numpy.array([colorsys.hsv_to_rgb(k / 12.0, 0.62, 0.92) for k in range(12)])
    picture = hues[numpy.clip((12.0 * turn).astype(int), 0, 11)]
    dark = (numpy.floor(24.0 * turn) + numpy.floor(radius / 0.22)) % 2.0 == 1.0
    picture = numpy.where(dark[..., None], 0.42 * picture, picture)
    tiles = (numpy.floor(x / 0.3) + numpy.floor(y / 0.3)) % 2.0
    near = numpy.clip(2.0 - radius / 3.0, 0.0, 1.0)
    tiles = mix(numpy.full(x.shape + (3,), 0.86), (0.95, 0.95, 0.94), 0.5 + near * (tiles - 0.5))
    return numpy.where((radius > 1.32)[..., None], tiles, picture)


def draw_luneburg(_, size):
    """One chart through both lenses. Their index is 1 at the surface, which reflects nothing."""
    panel = (size[0] // 2, size[0] // 2)
    rays = (2 * panel[0], 2 * panel[1])
    places, mesh = make_ball(10 if size[1] < 240 else 32)
    squares = (places ** 2).sum(axis=1)
    panels = []
    for index in (numpy.sqrt(2.0 - squares), 2.0 / (1.0 + squares)):
        picture = paint_wall(see_through(mesh, index, rays))
        axis = (numpy.arange(rays[0]) + 0.5) / rays[0] * 2.0 - 1.0
        # The outline of the ball is where rays touch it.
        rim = numpy.hypot(*numpy.meshgrid(axis, axis)) * HALF * math.sqrt(EYE ** 2 - 1.0)
        shade = 1.0 - 0.35 * numpy.clip(1.0 - abs(rim - 1.0) / 0.02, 0.0, 1.0)
        picture = picture * shade[..., None]
        panels.append(picture.reshape(panel[1], 2, panel[0], 2, 3).mean(axis=(1, 3)))
    return make_image(numpy.concatenate(panels, axis=1))
