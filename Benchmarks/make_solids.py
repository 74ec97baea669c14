#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes like those of Weiler et al. (2003), Table 2, which are not public: a finned block, a tube
and a ball, filled by TetGen with about as many tetrahedra, and a smooth scalar.

usage: make_solids.py FOLDER
"""
import math
import os
import sys

import meniscus
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

# Tetrahedra of the paper's meshes.
CELLS = {"heat-sink": 124152, "cylinder": 203460, "sphere": 148955}
CLOSE = 0.02  # relative difference of the number of cells; after eight tries the last one counts


def extrude(outline, hole, height):
    """The prism over a polygon, or between two polygons of as many corners."""
    data, points, polys = vtkPolyData(), vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    walls = [outline] + ([hole] if hole else [])
    rings = [[[points.InsertNextPoint(x, y, z) for x, y in wall] for wall in walls]
             for z in (0.0, height)]
    for low, high in zip(*rings):
        for k in range(len(low)):
            n = (k + 1) % len(low)
            polys.InsertNextCell(4, (low[k], low[n], high[n], high[k]))
    for level in rings:
        if not hole:
            polys.InsertNextCell(len(level[0]), level[0])
            continue
        for k in range(len(outline)):
            n = (k + 1) % len(outline)
            polys.InsertNextCell(4, (level[0][k], level[0][n], level[1][n], level[1][k]))
    data.SetPoints(points)
    data.SetPolys(polys)
    return data


def make_heat_sink():
    """A base with eight fins."""
    outline = [(0.0, 0.0), (15.0, 0.0)]
    for fin in range(7, -1, -1):
        outline += [(2.0 * fin + 1.0, 2.0), (2.0 * fin + 1.0, 8.0), (2.0 * fin, 8.0),
                    (2.0 * fin, 2.0)]
    outline[2] = (15.0, 8.0)  # the outer walls have no step
    del outline[3]
    outline.pop()
    return extrude(outline, None, 12.0)


def make_cylinder():
    def ring(radius):
        return [(radius * math.cos(a), radius * math.sin(a))
                for a in (2.0 * math.pi * k / 64 for k in range(64))]
    return extrude(ring(4.0), ring(2.0), 12.0)


def make_sphere():
    ball = vtkSphereSource()
    ball.SetRadius(4.0)
    ball.SetThetaResolution(64)
    ball.SetPhiResolution(33)
    ball.Update()
    return ball.GetOutput()


def fill(surface, cells):
    """Tetrahedra inside of a surface, with the volume of cells that gives their number."""
    triangles = vtkTriangleFilter()
    triangles.SetInputData(surface)
    oriented = vtkPolyDataNormals()
    oriented.SetInputConnection(triangles.GetOutputPort())
    oriented.SplittingOff()
    oriented.ConsistencyOn()
    oriented.AutoOrientNormalsOn()
    filler = meniscus.vtkTetrahedralizeSurface()
    filler.SetInputConnection(oriented.GetOutputPort())
    filler.SetMesherToTetGen()
    volume = 0.01
    for _ in range(8):
        filler.SetMaximumVolume(volume)
        filler.Update()
        found = filler.GetOutput().GetNumberOfCells()
        if abs(found - cells) <= CLOSE * cells:
            break
        volume *= found / cells
    mesh = filler.GetOutput()
    scalar = vtkDoubleArray()
    scalar.SetName("scalar")
    for p in range(mesh.GetNumberOfPoints()):
        x, y, z = mesh.GetPoint(p)
        scalar.InsertNextValue(math.sin(0.6 * x) * math.cos(0.5 * y) + math.sin(0.4 * z))
    mesh.GetPointData().Initialize()
    mesh.GetPointData().SetScalars(scalar)
    return mesh


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    makers = {"heat-sink": make_heat_sink, "cylinder": make_cylinder, "sphere": make_sphere}
    for name, cells in CELLS.items():
        mesh = fill(makers[name](), cells)
        print(f"{name}: {mesh.GetNumberOfCells()} tetrahedra (the paper: {cells})")
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(os.path.join(sys.argv[1], name + ".vtu"))
        writer.SetInputData(mesh)
        writer.Write()


if __name__ == "__main__":
    main()
