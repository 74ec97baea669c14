# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of the box [0, 2] x [0, 1] x [0, 1] by cells of all kinds, with linear fields."""
import itertools

import numpy

# Numbers of VTK's cell types.
VERTEX, LINE, TRIANGLE, QUAD = 1, 3, 5, 9
TETRA, VOXEL, HEXAHEDRON, WEDGE, PYRAMID, CONVEX_SET, POLYHEDRON = 10, 11, 12, 13, 14, 41, 42
QUADRATIC_TETRA, QUADRATIC_HEXAHEDRON, QUADRATIC_WEDGE, QUADRATIC_PYRAMID = 24, 25, 26, 27
TRIQUADRATIC_HEXAHEDRON = 29
LAGRANGE_TETRAHEDRON, LAGRANGE_HEXAHEDRON, LAGRANGE_WEDGE = 71, 72, 73

# Parts of a hexahedron in VTK's order of its corners.
HEXAHEDRON_CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                      (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
TETRAHEDRA = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))
WEDGES = ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))
# Edges in the order of the points of quadratic cells.
EDGES = {
    TETRA: ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)),
    HEXAHEDRON: ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5),
                 (2, 6), (3, 7)),
    WEDGE: ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    PYRAMID: ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)),
}
FACES = ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7))


class Mesh:
    """Points, cells as lists of indices, types, and arrays by name.

    faces: of polyhedra, a list of faces per cell.
    """

    def __init__(self, points, cells, types, faces=None):
        self.points = numpy.array(points, float).reshape(-1, 3)
        self.cells = [list(cell) for cell in cells]
        self.types = list(types)
        self.faces = faces
        x, y, z = self.points.T
        self.point_data = {"T": x + 2 * y + 3 * z, "U": numpy.stack([x, y, 0 * x + 1], axis=1)}
        self.cell_data = {"p": numpy.arange(float(len(self.cells)))}

    def moved(self, offset):
        """The mesh at another place, with the same values."""
        other = Mesh(self.points + numpy.array(offset), self.cells, self.types, self.faces)
        other.point_data, other.cell_data = dict(self.point_data), dict(self.cell_data)
        return other

    def with_cells(self, cells, kind):
        """The mesh with further cells of a type."""
        return Mesh(self.points, self.cells + list(cells),
                    self.types + [kind] * len(cells), self.faces)

    def with_points(self, points):
        """The mesh with further points, which no cell uses."""
        return Mesh(numpy.concatenate([self.points, points]), self.cells, self.types, self.faces)

    def with_arrays(self, point_data=None, cell_data=None):
        """The mesh with other arrays."""
        other = self.moved((0, 0, 0))
        other.point_data, other.cell_data = point_data or {}, cell_data or {}
        return other

    def part(self, chosen):
        """Some cells with their own points."""
        used = sorted({point for cell in chosen for point in self.cells[cell]})
        number = {point: i for i, point in enumerate(used)}
        part = Mesh(self.points[used], [[number[point] for point in self.cells[cell]]
                                        for cell in chosen], [self.types[cell] for cell in chosen])
        part.cell_data = {name: values[list(chosen)] for name, values in self.cell_data.items()}
        return part


class _Points:
    """Points by their place, each once."""

    def __init__(self):
        self.points, self._numbers = [], {}

    def number(self, place):
        key = tuple(round(float(x), 12) for x in place)
        if key not in self._numbers:
            self._numbers[key] = len(self.points)
            self.points.append(key)
        return self._numbers[key]


def _corners_of_boxes():
    return [[(x + i, j, k) for i, j, k in HEXAHEDRON_CORNERS] for x in range(2)]


def _make(kind, cells_of_box, extend=lambda corners: corners):
    """A mesh of one type, from the cells of each unit cube as lists of places."""
    points, cells = _Points(), []
    for box in _corners_of_boxes():
        for cell in cells_of_box(box):
            cells.append([points.number(place) for place in extend(cell)])
    return Mesh(points.points, cells, [kind] * len(cells))


def _split(parts):
    return lambda box: [[box[corner] for corner in part] for part in parts]


def _pyramids(box):
    center = tuple(numpy.mean(box, axis=0))
    return [[*(box[corner] for corner in face), center] for face in FACES]


def _middle(places):
    return tuple(numpy.mean(places, axis=0))


def _with_edges(linear):
    return lambda corners: [*corners, *(_middle([corners[a], corners[b]])
                                        for a, b in EDGES[linear])]


def _with_all(corners):
    """The 27 points of a hexahedron with nodes in its faces and its middle."""
    return [*_with_edges(HEXAHEDRON)(corners), *(_middle([corners[i] for i in face])
                                                 for face in FACES), _middle(corners)]


def _third_order(corners):
    """The 20 points of a tetrahedron of third order: two for each edge, one for each face."""
    points = list(corners)
    for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)):
        points += [tuple(numpy.average([corners[a], corners[b]], axis=0, weights=weights))
                   for weights in ((2, 1), (1, 2))]
    return points + [_middle([corners[i] for i in face])
                     for face in ((0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1))]


TETRAHEDRAL = _make(TETRA, _split(TETRAHEDRA))
HEXAHEDRAL = _make(HEXAHEDRON, lambda box: [box])
MESHES = {
    "tetrahedra": TETRAHEDRAL,
    "hexahedra": HEXAHEDRAL,
    "voxels": _make(VOXEL, lambda box: [[box[i] for i in (0, 1, 3, 2, 4, 5, 7, 6)]]),
    "wedges": _make(WEDGE, _split(WEDGES)),
    "pyramids": _make(PYRAMID, _pyramids),
    "convex-point-sets": _make(CONVEX_SET, lambda box: [box]),
    "quadratic-tetrahedra": _make(QUADRATIC_TETRA, _split(TETRAHEDRA), _with_edges(TETRA)),
    "quadratic-hexahedra": _make(QUADRATIC_HEXAHEDRON, lambda box: [box],
                                 _with_edges(HEXAHEDRON)),
    "quadratic-wedges": _make(QUADRATIC_WEDGE, _split(WEDGES), _with_edges(WEDGE)),
    "quadratic-pyramids": _make(QUADRATIC_PYRAMID, _pyramids, _with_edges(PYRAMID)),
    "triquadratic-hexahedra": _make(TRIQUADRATIC_HEXAHEDRON, lambda box: [box], _with_all),
    "lagrange-tetrahedra-1": _make(LAGRANGE_TETRAHEDRON, _split(TETRAHEDRA)),
    "lagrange-tetrahedra-2": _make(LAGRANGE_TETRAHEDRON, _split(TETRAHEDRA), _with_edges(TETRA)),
    "lagrange-tetrahedra-3": _make(LAGRANGE_TETRAHEDRON, _split(TETRAHEDRA), _third_order),
    "lagrange-hexahedra-1": _make(LAGRANGE_HEXAHEDRON, lambda box: [box]),
    "lagrange-hexahedra-2": _make(LAGRANGE_HEXAHEDRON, lambda box: [box], _with_all),
    "lagrange-wedges-1": _make(LAGRANGE_WEDGE, _split(WEDGES)),
}
MESHES["polyhedra"] = Mesh(
    HEXAHEDRAL.points, HEXAHEDRAL.cells, [POLYHEDRON] * 2,
    [[[cell[i] for i in face] for face in FACES] for cell in HEXAHEDRAL.cells])
SURFACE = Mesh(HEXAHEDRAL.points, [[cell[i] for i in face] for cell in HEXAHEDRAL.cells
                                   for face in FACES], [QUAD] * 12)


def join(meshes):
    """Several meshes as one, without merging points."""
    points = numpy.concatenate([mesh.points for mesh in meshes])
    starts = itertools.accumulate([0, *(len(mesh.points) for mesh in meshes)])
    cells = [[start + point for point in cell]
             for start, mesh in zip(starts, meshes) for cell in mesh.cells]
    return Mesh(points, cells, [kind for mesh in meshes for kind in mesh.types])


# Half of the box by a hexahedron, the other half by wedges, with a quadrilateral, lines and a
# vertex as mesh generators write them for borders.
MIXED = join([HEXAHEDRAL.part([0]), MESHES["wedges"].part([2, 3])]).with_cells(
    [[0, 1, 2, 3]], QUAD).with_cells([[0, 1], [1, 2]], LINE).with_cells([[0]], VERTEX)
