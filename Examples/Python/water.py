# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Water that moves over a pool, in a window or as a series of pictures.

usage: water.py [--frames N] [--output DIR] [--size N] [--thesis]

Without --frames a window opens: the mouse moves the eye; space stops and starts the waves; i and I
change the index of refraction, h and H the height of the waves, a and A the attenuation; m switches
between curved patches and flat facets, o switches refraction off and on; q quits.
"""
import argparse
import math
import os
import sys

import meniscus
import vtkmodules.vtkInteractionStyle  # noqa: F401  the mouse
import vtkmodules.vtkRenderingFreeType  # noqa: F401  the text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  the pictures
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor,
    vtkTextActor, vtkWindowToImageFilter)

CELLS = 48
HALF = 1.2
WAVES = ((0.030, 5.0, 4.0, 2.0), (0.020, -3.0, 7.5, 3.0))  # amplitude, wave vector, speed


def make_water(time, height):
    """The water's surface about z = 0: triangles with exact normals."""
    plane = vtkPlaneSource()
    plane.SetOrigin(-HALF, -HALF, 0.0)
    plane.SetPoint1(HALF, -HALF, 0.0)
    plane.SetPoint2(-HALF, HALF, 0.0)
    plane.SetResolution(CELLS, CELLS)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(plane.GetOutputPort())
    triangles.Update()
    water = triangles.GetOutput()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    normals = vtkDoubleArray()
    normals.SetName("Normals")
    normals.SetNumberOfComponents(3)
    for i in range(water.GetNumberOfPoints()):
        x, y, _ = water.GetPoint(i)
        phases = [kx * x + ky * y + speed * time for _, kx, ky, speed in WAVES]
        z = height * sum(w[0] * math.sin(p) for w, p in zip(WAVES, phases))
        dx = height * sum(w[0] * w[1] * math.cos(p) for w, p in zip(WAVES, phases))
        dy = height * sum(w[0] * w[2] * math.cos(p) for w, p in zip(WAVES, phases))
        length = math.sqrt(1.0 + dx * dx + dy * dy)
        points.InsertNextPoint(x, y, z)
        normals.InsertNextTuple3(-dx / length, -dy / length, 1.0 / length)
    water.SetPoints(points)
    water.GetPointData().SetNormals(normals)
    return water


def make_pool():
    """A floor of tiles and two balls, with colours in the array Color."""
    pool = vtkAppendPolyData()
    floor = vtkPlaneSource()
    floor.SetOrigin(-1.0, -1.0, -1.2)
    floor.SetPoint1(1.0, -1.0, -1.2)
    floor.SetPoint2(-1.0, 1.0, -1.2)
    floor.SetResolution(32, 32)
    parts = [(floor, lambda x, y: (230, 225, 205) if (math.floor(4 * x) + math.floor(4 * y)) % 2
              else (45, 110, 160))]
    for center, radius, color in (((-0.35, 0.2, -0.8), 0.3, (225, 70, 40)),
                                  ((0.45, -0.3, -0.95), 0.22, (240, 190, 50))):
        ball = vtkSphereSource()
        ball.SetCenter(*center)
        ball.SetRadius(radius)
        ball.SetThetaResolution(40)
        ball.SetPhiResolution(24)
        parts.append((ball, lambda x, y, color=color: color))
    for source, rule in parts:
        source.Update()
        data = source.GetOutput()
        colors = make_colors(data, rule)
        data.GetPointData().Initialize()
        data.GetCellData().SetScalars(colors)
        pool.AddInputData(data)
    pool.Update()
    return pool.GetOutput()


def make_colors(data, rule):
    """A colour for each cell, by the centre of its bounds."""
    colors = vtkUnsignedCharArray()
    colors.SetName("Color")
    colors.SetNumberOfComponents(3)
    for i in range(data.GetNumberOfCells()):
        b = data.GetCell(i).GetBounds()
        colors.InsertNextTuple3(*rule(0.5 * (b[0] + b[1]), 0.5 * (b[2] + b[3])))
    return colors


def make_actor(mapper):
    mapper.SetScalarModeToUseCellData()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    return actor


class Water:
    """The scene and its state, which keys change."""

    def __init__(self, size):
        self.time = 0.0
        self.height = 1.0
        self.index = 1.333
        self.attenuation = 0.3
        self.curved = True
        self.refracts = True
        self.moves = True
        pool = make_pool()

        self.renderer = vtkRenderer()
        self.renderer.SetBackground(0.43, 0.51, 0.59)
        self.filter = meniscus.vtkRefractedGeometryFilter()
        self.filter.SetInputData(pool)
        self.filter.SetCamera(self.renderer.GetActiveCamera())
        self.filter.SetAngularTolerance(18.0 / size)  # half a pixel
        self.surface = vtkPolyDataMapper()
        self.surface.SetInputData(make_water(0.0, 1.0))
        surface = vtkActor()
        surface.SetMapper(self.surface)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(self.filter.GetOutputPort())
        self.water = meniscus.vtkRefractionPass()
        self.water.AddRefraction(surface, make_actor(mapper), self.filter)

        mapper = vtkPolyDataMapper()
        mapper.SetInputData(pool)
        self.solid = make_actor(mapper)
        self.text = vtkTextActor()
        self.text.SetPosition(10, 10)
        self.renderer.AddActor(self.solid)
        self.renderer.AddActor(self.text)
        self.window = vtkRenderWindow()
        self.window.SetMultiSamples(0)
        self.window.SetSize(size, size)
        self.window.SetWindowName("Meniscus: water")
        self.window.AddRenderer(self.renderer)
        camera = self.renderer.GetActiveCamera()
        camera.SetFocalPoint(0.0, 0.0, -0.4)
        camera.SetViewUp(0.0, 0.0, 1.0)
        camera.SetViewAngle(36.0)
        camera.SetClippingRange(0.5, 20.0)
        self.turn_eye(0.0)

    def turn_eye(self, degrees):
        a = math.radians(degrees)
        self.renderer.GetActiveCamera().SetPosition(1.8 * math.sin(a), -1.8 * math.cos(a), 3.0)

    def show(self):
        surface = make_water(self.time, self.height)
        self.surface.SetInputData(surface)
        self.filter.SetMembraneData(surface)
        self.filter.SetInteriorIndexOfRefraction(self.index)
        if self.curved:
            self.filter.SetMembraneModelToCurved()
            self.filter.SetImagesToAllImages()
        else:
            self.filter.SetMembraneModelToFlatFacets()
            self.filter.SetImagesToFirstImage()
        k = self.attenuation
        self.water.SetAttenuationCoefficients(k, 0.4 * k, 0.2 * k)
        self.renderer.SetPass(self.water if self.refracts else None)
        self.solid.SetVisibility(not self.refracts)
        method = ("curved" if self.curved else "flat facets") if self.refracts else "not refracted"
        self.text.SetInput(
            f"{method}  index {self.index:.3f}  waves {self.height:.2f}  attenuation {k:.2f}")
        self.window.Render()

    def write(self, file):
        image = vtkWindowToImageFilter()
        image.SetInput(self.window)
        image.ReadFrontBufferOff()
        writer = vtkPNGWriter()
        writer.SetInputConnection(image.GetOutputPort())
        writer.SetFileName(file)
        writer.Write()

    def press(self, key):
        def step(name, by, low, high):
            setattr(self, name, min(max(getattr(self, name) + by, low), high))

        if key in "iI":
            step("index", 0.05 if key == "i" else -0.05, 1.0, 2.5)
        elif key in "hH":
            step("height", 0.1 if key == "h" else -0.1, 0.0, 2.0)
        elif key in "aA":
            step("attenuation", 0.05 if key == "a" else -0.05, 0.0, 3.0)
        elif key == "m":
            self.curved = not self.curved
        elif key == "o":
            self.refracts = not self.refracts
        elif key == " ":
            self.moves = not self.moves
        else:
            return
        self.show()

    def tick(self):
        if self.moves:
            self.time += 0.04
            self.show()


def write_frames(water, count, folder):
    water.window.SetOffScreenRendering(1)
    for i in range(count):
        water.time = 0.08 * i
        water.turn_eye(1.5 * i)
        water.show()
        water.write(os.path.join(folder, f"water-{i:03d}.png"))


def run_window(water):
    interactor = vtkRenderWindowInteractor()
    interactor.SetRenderWindow(water.window)
    water.show()
    interactor.Initialize()
    interactor.AddObserver("KeyPressEvent", lambda o, e: water.press(o.GetKeyCode() or "?"), 1.0)
    interactor.AddObserver("TimerEvent", lambda o, e: water.tick())
    interactor.CreateRepeatingTimer(40)
    interactor.Start()


def main():
    parser = argparse.ArgumentParser(description="Water that moves over a pool")
    parser.add_argument("--frames", type=int, default=0, help="pictures instead of a window")
    parser.add_argument("--output", default=".", help="existing folder for the pictures")
    parser.add_argument("--size", type=int, default=512, help="pixels a side")
    parser.add_argument("--thesis", action="store_true", help="the thesis's flat facets")
    options = parser.parse_args()
    if not os.path.isdir(options.output):
        sys.exit(f"error: {options.output} is not a folder")
    water = Water(options.size)
    water.curved = not options.thesis
    if options.frames > 0:
        write_frames(water, options.frames, options.output)
    else:
        run_window(water)


if __name__ == "__main__":
    main()
