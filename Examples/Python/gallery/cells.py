# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Few cells with curved fields: a knot of two types, hexahedra cut and whole."""
import math

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON, VTK_QUADRATIC_HEXAHEDRON, VTK_QUADRATIC_WEDGE, vtkCellArray, vtkPolyData,
    vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkTubeFilter

from . import common

SLICES = 30  # along the knot
SECTORS = 5  # around it
EDGES = {
    VTK_QUADRATIC_WEDGE: ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    VTK_QUADRATIC_HEXAHEDRON: ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4),
                               (0, 4), (1, 5), (2, 6), (3, 7)),
}


def get_center(turn, radius=1.0):
    """A trefoil knot on a torus whose tube has this radius, for turns in [0, 1]."""
    long, short = 4.0 * math.pi * turn, 6.0 * math.pi * turn
    distance = 2.2 + radius * math.cos(short)
    return (distance * math.cos(long), distance * math.sin(long), radius * math.sin(short))


def normalize(vector):
    length = math.sqrt(sum(x * x for x in vector))
    return tuple(x / length for x in vector)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def get_place(turn, radius, angle):
    """The point at polar coordinates about the knot's center line."""
    center = get_center(turn)
    along = normalize([b - a for a, b in zip(center, get_center(turn + 1e-5))])
    outwards = [b - a for a, b in zip(center, get_center(turn, 2.0))]
    across = normalize(cross(along, outwards))
    up = cross(across, along)
    u, v = 0.68 * radius * math.cos(angle), 0.68 * radius * math.sin(angle)
    return tuple(c + u * x + v * y for c, x, y in zip(center, across, up))


class Knot:
    """Wedges around the center line, hexahedra around these, all of second order."""

    def __init__(self):
        self.mesh = vtkUnstructuredGrid()
        self.mesh.SetPoints(vtkPoints())
        self.scalars = vtkDoubleArray()
        self.scalars.SetName("Field")
        self.known = {}
        for piece in range(SLICES):
            for sector in range(SECTORS):
                ends = [2 * piece, 2 * piece + 2]
                left, right = 2 * sector, 2 * sector + 2
                self.add(VTK_QUADRATIC_WEDGE,
                         [(end, r, a) for end in ends for r, a in ((0, 0), (2, left), (2, right))])
                self.add(VTK_QUADRATIC_HEXAHEDRON,
                         [(end, r, a) for end in ends
                          for r, a in ((2, left), (4, left), (4, right), (2, right))])
        self.mesh.GetPointData().SetScalars(self.scalars)

    def add(self, kind, corners):
        """Adds a cell by the steps of its corners along the knot, outwards and around."""
        middles = [self.get_middle(corners[a], corners[b]) for a, b in EDGES[kind]]
        ids = [self.get_point(key) for key in corners + middles]
        self.mesh.InsertNextCell(kind, len(ids), ids)

    @staticmethod
    def get_middle(a, b):
        # Points of the center line have no angle of their own.
        around = (b[2] if a[1] == 0 else a[2]) if 0 in (a[1], b[1]) else (a[2] + b[2]) // 2
        return ((a[0] + b[0]) // 2, (a[1] + b[1]) // 2, around)

    def get_point(self, key):
        piece, ring, around = key
        key = (piece % (2 * SLICES), ring, around % (2 * SECTORS) if ring else 0)
        if key not in self.known:
            turn, radius, angle = key[0] / (2 * SLICES), ring / 4, key[2] * math.pi / SECTORS
            self.known[key] = self.mesh.GetPoints().InsertNextPoint(get_place(turn, radius, angle))
            self.scalars.InsertNextValue(radius * math.cos(2.0 * angle - 12.0 * math.pi * turn))
        return self.known[key]


def draw_cells(_data, size):
    """Isosurfaces in the knot, and the edges of its cells."""
    mesh = Knot().mesh
    values = (-0.45, 0.0, 0.45)
    colors = common.make_colors(common.VIRIDIS, -0.7, 0.7)
    look = common.make_look(colors, common.make_opacity(zip(values, (0.9, 0.9, 0.9))), 1.0)
    volume = common.make_volume(mesh, look, values)
    volume.GetMapper().SetCellDivisionToAdaptive()
    volume.GetMapper().SetDivisionTolerance(1e-3)
    volume.GetMapper().SetMaximumNumberOfPieces(10000000)
    renderer = common.make_renderer(common.PAPER)
    renderer.AddVolume(volume)
    common.add_lights(renderer, ((-0.5, 0.9, 0.9), (1.0, 0.98, 0.94), 1.1),
                      ((1.0, 0.1, 0.6), (0.6, 0.75, 1.0), 0.6))
    common.look_from(renderer, (1.0, -7.5, 10.5), (0.0, -0.1, 0.0), (0, 1, 0), 32.0)
    renderer.ResetCameraClippingRange()
    return common.take(renderer, size)


CUBE = 6  # hexahedra along an axis
LEVEL = 0.12


def get_wave(x, y, z):
    """A standing wave with four cells of the cube per wavelength: extrema like balls."""
    return math.prod(math.cos(1.5 * math.pi * coordinate) for coordinate in (x, y, z))


def make_cube():
    """Hexahedra in [-1, 1]^3, twisted about the z axis, with a field at their corners."""
    mesh = vtkUnstructuredGrid()
    points, scalars = vtkPoints(), vtkDoubleArray()
    scalars.SetName("Field")
    side = CUBE + 1
    for i in range(side ** 3):
        x, y, z = (2.0 * k / CUBE - 1.0 for k in (i % side, i // side % side, i // side ** 2))
        scalars.InsertNextValue(get_wave(x, y, z))
        angle = 0.3 * z
        points.InsertNextPoint(x * math.cos(angle) - y * math.sin(angle),
                               x * math.sin(angle) + y * math.cos(angle), z)
    mesh.SetPoints(points)
    for cell in range(CUBE ** 3):
        i, j, k = cell % CUBE, cell // CUBE % CUBE, cell // CUBE ** 2
        low = (k * side + j) * side + i
        face = [low, low + 1, low + side + 1, low + side]
        mesh.InsertNextCell(VTK_HEXAHEDRON, 8, face + [p + side * side for p in face])
    mesh.GetPointData().SetScalars(scalars)
    return mesh


def make_edges(mesh):
    """The edges of cells on the three sides of the cube that turn away from the eye."""
    side = CUBE + 1
    walls = vtkPolyData()
    walls.SetPoints(mesh.GetPoints())
    faces = vtkCellArray()
    for u in range(CUBE):
        for v in range(CUBE):
            for place in (lambda a, b: (0, a, b), lambda a, b: (a, CUBE, b),
                          lambda a, b: (a, b, 0)):
                corners = (place(u + a, v + b) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)))
                faces.InsertNextCell(4, [(k * side + j) * side + i for i, j, k in corners])
    walls.SetPolys(faces)
    edges = common.vtkExtractEdges()
    edges.SetInputData(walls)
    tubes = vtkTubeFilter()
    tubes.SetInputConnection(edges.GetOutputPort())
    tubes.SetRadius(0.006)
    tubes.SetNumberOfSides(8)
    tubes.Update()
    actor = common.make_actor(tubes.GetOutput(), (0.5, 0.54, 0.6))
    actor.GetProperty().LightingOff()
    return actor


def draw_hexahedra(_data, size):
    """An isosurface in 216 hexahedra: cut into tetrahedra, and by their own shape functions."""
    mesh = make_cube()
    panel = (size[0] // 2, 2 * size[1] // 3)
    renderers = []
    for adaptive in (False, True):
        colors = common.make_colors(((0.93, 0.62, 0.30),) * 2, -1.0, 1.0)
        look = common.make_look(colors, common.make_opacity(((-2.0, 1.0), (2.0, 1.0))), 1.0)
        volume = common.make_volume(mesh, look, (LEVEL,))
        if adaptive:
            volume.GetMapper().SetCellDivisionToAdaptive()
            volume.GetMapper().SetDivisionTolerance(1e-3)
            volume.GetMapper().SetMaximumNumberOfPieces(10000000)
        renderer = common.make_renderer(common.PAPER)
        renderer.AddVolume(volume)
        renderer.AddActor(make_edges(mesh))
        common.add_lights(renderer, ((-0.7, 0.9, 0.9), (1.0, 0.98, 0.94), 1.0),
                          ((1.0, 0.1, 0.4), (0.6, 0.75, 1.0), 0.35))
        common.look_from(renderer, (3.6, -4.6, 3.2), (0.0, 0.0, -0.06), (0, 0, 1), 28.0)
        renderer.ResetCameraClippingRange()
        label = "own shape functions" if adaptive else "cut into tetrahedra"
        common.add_label(renderer, label, 2 * panel[1], common.INK)
        renderers.append(renderer)
    return common.take_beside(renderers, panel, 2)
