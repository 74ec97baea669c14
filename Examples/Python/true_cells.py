# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Hexahedra as six tetrahedra each, and divided adaptively, next to each other.

usage: true_cells.py [--output DIR] [--size N] [--cells N]

Writes true-cells.png: a field on N x N x N displaced hexahedra, twice.
"""
import argparse
import math
import os

from meniscus import vtkTetrahedraRayCastMapper
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON, vtkPiecewiseFunction, vtkUnstructuredGrid)
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction, vtkRenderer, vtkRenderWindow, vtkVolume, vtkWindowToImageFilter)

BANDS = (0.15, 0.35, 0.55, 0.75)
COLORS = ((0.15, 0.35, 0.75), (0.2, 0.65, 0.6), (0.95, 0.7, 0.25), (0.75, 0.1, 0.1))


def field(x, y, z):
    return 0.5 + 0.5 * math.cos(2.2 * math.pi * math.sqrt(x * x + y * y + z * z) / math.sqrt(3))


def make_mesh(cells):
    """Hexahedra in [-1, 1]^3, twisted a little about the z axis."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    scalars = vtkDoubleArray()
    scalars.SetName("s")
    side = cells + 1
    for i in range(side ** 3):
        x, y, z = (2.0 * index / cells - 1.0
                   for index in (i % side, i // side % side, i // side // side))
        angle = 0.35 * z
        scalars.InsertNextValue(field(x, y, z))
        points.InsertNextPoint(x * math.cos(angle) - y * math.sin(angle),
                               x * math.sin(angle) + y * math.cos(angle), z)
    mesh = vtkUnstructuredGrid()
    mesh.SetPoints(points)
    for cell in range(cells ** 3):
        base = (cell // cells // cells * side + cell // cells % cells) * side + cell % cells
        bottom = [base, base + 1, base + side + 1, base + side]
        mesh.InsertNextCell(VTK_HEXAHEDRON, 8, bottom + [i + side * side for i in bottom])
    mesh.GetPointData().SetScalars(scalars)
    return mesh


def make_volume(mesh, adaptive):
    mapper = vtkTetrahedraRayCastMapper()
    mapper.SetInputData(mesh)
    mapper.SetBackend(mapper.NATIVE)
    if adaptive:
        mapper.SetCellDivisionToAdaptive()
        mapper.SetDivisionTolerance(2e-3)
        mapper.SetMaximumNumberOfPieces(10000000)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    opacity = vtkPiecewiseFunction()
    color = vtkColorTransferFunction()
    for band, rgb in zip(BANDS, COLORS):
        for offset, value in (-0.02, 0.0), (-0.01, 25.0), (0.01, 25.0), (0.02, 0.0):
            opacity.AddPoint(band + offset, value)
        color.AddRGBPoint(band, *rgb)
    volume.GetProperty().SetScalarOpacity(opacity)
    volume.GetProperty().SetColor(color)
    volume.GetProperty().ShadeOn()
    volume.GetProperty().SetSpecular(0.2)
    return volume


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--output", default=".")
    parser.add_argument("--size", type=int, default=480, help="of one picture of the pair")
    parser.add_argument("--cells", type=int, default=5)
    arguments = parser.parse_args()
    mesh = make_mesh(arguments.cells)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(2 * arguments.size, arguments.size)
    for side in 0, 1:
        renderer = vtkRenderer()
        renderer.SetViewport(0.5 * side, 0.0, 0.5 + 0.5 * side, 1.0)
        renderer.SetBackground(1.0, 1.0, 1.0)
        volume = make_volume(mesh, side == 1)
        renderer.AddVolume(volume)
        window.AddRenderer(renderer)
        camera = renderer.GetActiveCamera()
        camera.SetPosition(3.0, 2.0, 4.0)
        renderer.ResetCamera()
        camera.Zoom(1.35)
        window.Render()
        print("%s: %d tetrahedra" % (("fixed", "adaptive")[side],
                                     volume.GetMapper().GetStatistic("NumberOfTetrahedra")))
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    grabber.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(grabber.GetOutputPort())
    writer.SetFileName(os.path.join(arguments.output, "true-cells.png"))
    writer.Write()


if __name__ == "__main__":
    main()
