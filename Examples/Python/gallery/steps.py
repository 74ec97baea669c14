# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Time steps on one mesh."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from . import common


class Waves:
    """The wave equation u'' = div grad u with linear finite elements on tetrahedra."""

    def __init__(self, mesh):
        self.places = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
        cells = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 4)
        sides = self.places[cells[:, 1:]] - self.places[cells[:, :1]]
        volumes = numpy.linalg.det(sides) / 6.0
        # Cells of no volume have no gradient.
        solid = abs(volumes) > 1e-6 * abs(volumes).mean()
        self.cells = cells[solid]
        volumes = abs(volumes[solid])
        slopes = numpy.linalg.inv(sides[solid]).transpose(0, 2, 1)
        slopes = numpy.concatenate([-slopes.sum(axis=1, keepdims=True), slopes], axis=1)
        self.stiffness = volumes[:, None, None] * numpy.einsum("cik,cjk->cij", slopes, slopes)
        self.mass = self.gather(numpy.repeat(volumes[:, None] / 4.0, 4, axis=1))
        self.mass[self.mass == 0.0] = 1.0

    def gather(self, parts):
        return numpy.bincount(self.cells.ravel(), parts.ravel(), len(self.places))

    def multiply(self, values):
        return self.gather(numpy.einsum("cij,cj->ci", self.stiffness, values[self.cells]))

    def solve(self, right, share):
        """Solves (mass + share * stiffness) x = right by conjugate gradients."""
        scale = self.mass + share * self.gather(numpy.einsum("cii->ci", self.stiffness))
        found = numpy.zeros_like(right)
        rest = right.copy()
        along = ahead = rest / scale
        size = rest @ ahead
        limit = 1e-12 * size
        while size > limit:
            image = self.mass * along + share * self.multiply(along)
            step = size / (along @ image)
            found += step * along
            rest -= step * image
            ahead = rest / scale
            size, last = rest @ ahead, size
            along = ahead + size / last * along
        return found

    def run(self, values, step, count):
        """Yields the values after each step of the trapezoidal rule, from rest."""
        speeds = numpy.zeros_like(values)
        for _ in range(count):
            forces = self.multiply(values + 0.25 * step * speeds)
            new = self.solve(self.mass * speeds - step * forces, 0.25 * step * step)
            values = values + 0.5 * step * (speeds + new)
            speeds = new
            yield values


def make_metal(mesh, colors):
    """A dense medium, grey where nothing moves."""
    opacity = common.make_opacity(((-0.3, 1.0), (-0.05, 0.8), (0.0, 0.6), (0.05, 0.8), (0.3, 1.0)))
    look = common.make_look(colors, opacity, 0.04)
    return common.make_dense(mesh, look, (0.7, 0.8), 0.3, 2.0)


def add_legend(renderer, colors, height):
    """The scale of the displacement, in a corner of a panel of that height."""
    bar = common.make_bar(colors, "displacement (the blow: 1)", common.INK)
    bar.SetOrientationToHorizontal()
    bar.SetNumberOfLabels(2)
    bar.SetPosition(0.06, 0.03)
    bar.SetWidth(0.32)
    bar.SetHeight(0.2)
    bar.GetTitleTextProperty().SetFontSize(height // 30)
    bar.GetLabelTextProperty().SetFontSize(height // 30)
    renderer.AddViewProp(bar)


def draw_blow(data, size):
    """Waves in the metal of the crushed can after a blow at one end, at four times."""
    waves = Waves(data.can)
    far = waves.places[:, 0].max() - waves.places[:, 0]
    mesh = data.can.NewInstance()
    mesh.ShallowCopy(data.can)
    colors = common.make_colors(common.SIGNED, -0.15, 0.15)
    volume = make_metal(mesh, colors)
    pictures = []
    panel = (size[0] // 2, size[1] * 3 // 8)
    step = 0.2
    for number, now in enumerate(waves.run(numpy.exp(-(far / 1.2) ** 2), step, 80)):
        if number % 20 != 9:
            continue
        displacement = numpy_to_vtk(now, deep=True)
        displacement.SetName("Displacement")
        mesh.GetPointData().SetScalars(displacement)
        renderer = common.make_renderer(common.PAPER)
        renderer.AddVolume(volume)
        common.add_lights(renderer, ((-0.5, 0.9, 0.9), (1.0, 0.98, 0.94), 1.1),
                          ((1.0, 0.1, 0.6), (0.6, 0.75, 1.0), 0.6))
        common.look_from(renderer, (-6.5, -8.5, 14.5), (-3.1, 0.7, -15.9), (0, 1, 0), 19.6)
        common.add_label(renderer, f"t = {step * (number + 1):.0f}", 2 * panel[1], common.INK)
        if not pictures:
            add_legend(renderer, colors, 2 * panel[1])
        renderer.ResetCameraClippingRange()
        pictures.append(common.take(renderer, panel))
        renderer.RemoveVolume(volume)
    return common.stack(pictures, 2)
