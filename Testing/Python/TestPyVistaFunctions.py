# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The functions that meniscus.pyvista gives a volume, with a stand-in for the little of PyVista
that it uses.

Real pictures are those of TestPyVista.py, which needs PyVista."""
import sys
import types
import unittest

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource

ENTRIES = 4


class LookupTable(vtkLookupTable):
    """Grey levels, and opacities as given; its own functions must not be called."""

    def __init__(self, cmap=None, scalar_range=(0.0, 1.0)):
        self.cmap = cmap
        self.SetNumberOfTableValues(ENTRIES)
        self.SetTableRange(scalar_range)
        for entry in range(ENTRIES):
            self.SetTableValue(entry, *[entry / (ENTRIES - 1)] * 3, 1.0)

    def apply_opacity(self, opacity):
        for entry, alpha in enumerate(opacity):
            self.SetTableValue(entry, *self.GetTableValue(entry)[:3], alpha)


class Values:
    dtype = "float64"


class Mesh(vtkImageData):
    active_scalars_name = "height"
    length = 8.0
    n_cells = 8

    def __init__(self):
        self.SetDimensions(3, 3, 3)
        values = vtkDoubleArray()
        values.SetName("height")
        values.SetNumberOfTuples(27)
        values.FillComponent(0, 1.0)
        self.GetPointData().SetScalars(values)

    def __getitem__(self, name):
        return Values()

    def get_array_association(self, name):
        return "point"

    def get_data_range(self, name):
        return 2.0, 5.0


class Plotter:
    theme = types.SimpleNamespace(cmap="the theme's")

    def __init__(self):
        self.bars = []

    def add_actor(self, actor, name=None):
        self.actor = actor

    def add_scalar_bar(self, title, mapper):
        self.bars.append(mapper)


sys.modules["pyvista"] = types.SimpleNamespace(
    LookupTable=LookupTable, DataSetMapper=types.SimpleNamespace, wrap=lambda mesh: mesh,
    PolyData=vtkPolyData,
    FieldAssociation=types.SimpleNamespace(POINT="point"))
from meniscus.pyvista import add_volume, refracted  # noqa: E402


class TestPyVistaFunctions(unittest.TestCase):
    def nodes(self, clim):
        plotter = Plotter()
        volume = add_volume(plotter, Mesh(), opacity=[0.0, 0.5, 0.25, 1.0], clim=clim)
        self.assertIs(plotter.actor, volume)
        self.assertEqual(plotter.bars[0].lookup_table.cmap, "the theme's")
        look = volume.GetProperty()
        opacity = look.GetScalarOpacity()
        colors = look.GetRGBTransferFunction()
        self.assertEqual(opacity.GetSize(), ENTRIES)
        self.assertEqual(colors.GetSize(), ENTRIES)
        limits = colors.GetRange()
        for entry, alpha in enumerate([0.0, 0.5, 0.25, 1.0]):
            share = entry / (ENTRIES - 1)
            scalar = limits[0] + share * (limits[1] - limits[0])
            # Bytes in the table.
            self.assertAlmostEqual(opacity.GetValue(scalar), alpha, delta=0.5 / 255 + 1e-12)
            self.assertAlmostEqual(colors.GetRedValue(scalar), share, delta=0.5 / 255 + 1e-12)
        self.assertEqual(opacity.GetRange(), limits)
        self.assertEqual(plotter.bars[0].scalar_range, limits)
        return limits

    def test_limits(self):
        self.assertEqual(self.nodes(None), (2.0, 5.0))
        self.assertEqual(self.nodes((-3.0, 6.0)), (-3.0, 6.0))
        self.assertEqual(self.nodes(4), (-4.0, 4.0))


def plane(height):
    source = vtkPlaneSource()
    source.SetOrigin(-5, -5, height)
    source.SetPoint1(5, -5, height)
    source.SetPoint2(-5, 5, height)
    source.Update()
    return source.GetOutput()


def ball(radius, height):
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetCenter(0, 0, height)
    source.SetThetaResolution(32)
    source.SetPhiResolution(32)
    source.Update()
    return source.GetOutput()


class TestRefracted(unittest.TestCase):
    """A tiny ball right below the eye appears at the sum of the layers over their indices."""

    def depth(self, membrane, index, **properties):
        seen = refracted(ball(1e-4, -1), membrane, (0, 0, 2), index, **properties)
        self.assertGreater(seen.GetNumberOfPoints(), 0)
        return -seen.GetCenter()[2]

    def test_one_membrane(self):
        self.assertAlmostEqual(self.depth(plane(0), 1.25, Images=0), 1 / 1.25, 5)

    def test_several_membranes(self):
        pane = [plane(0), plane(-0.25)]
        expected = 0.25 / 1.5 + 0.75 / 1.333
        self.assertAlmostEqual(self.depth(pane, [1.5, 1.333]), expected, 5)
        self.assertAlmostEqual(self.depth(pane, [(1.0, 1.5), (1.5, 1.333)]), expected, 5)
        self.assertAlmostEqual(
            self.depth(pane, [1.5, 1.333], ExteriorIndexOfRefraction=1.2), 1.2 * expected, 5)

    def test_too_few_indices(self):
        self.assertEqual(
            refracted(ball(0.1, -1), [plane(0), plane(-0.25)], (0, 0, 2), [1.5]).
            GetNumberOfPoints(), 0)


if __name__ == "__main__":
    unittest.main()
