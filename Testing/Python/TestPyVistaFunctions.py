# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Calls of PyVista by meniscus.pyvista and the volume that results, with a stand-in for the little
of PyVista that it uses.

Real pictures are those of TestPyVista.py and TestPyVistaPlotters.py, which need PyVista."""
import sys
import types
import unittest

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkLookupTable
from vtkmodules.vtkCommonDataModel import (
    vtkImageData, vtkMultiBlockDataSet, vtkPolyData, vtkRectilinearGrid)
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkVolume

ENTRIES = 4
OPACITIES = [0.0, 0.5, 0.25, 1.0]


def make_table(limits):
    """Grey levels with opacities."""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(ENTRIES)
    table.SetTableRange(limits)
    for entry, alpha in enumerate(OPACITIES):
        table.SetTableValue(entry, *[entry / (ENTRIES - 1)] * 3, alpha)
    return table


class Mesh(vtkImageData):
    active_scalars_name = "height"
    length = 8.0
    dimensions = (3, 4, 5)
    n_cells = 24
    bounds = (0.0, 2.0, 0.0, 3.0, 0.0, 4.0)

    def __init__(self):
        self.SetDimensions(*self.dimensions)
        values = vtkDoubleArray()
        values.SetName("height")
        for value in range(60):
            values.InsertNextValue(2.0 + value / 59 * 3.0)
        self.GetPointData().SetScalars(values)

    def get_array_association(self, name, preference):
        return "point"

    def get_data_range(self, name, preference):
        return 2.0, 5.0


class Volume(vtkVolume):
    """As plotter.add_volume() returns it."""

    @property
    def mapper(self):
        return self.made

    @mapper.setter
    def mapper(self, mapper):
        self.made = mapper
        self.SetMapper(mapper)

    @property
    def prop(self):
        return self.GetProperty()


class Plotter:
    theme = types.SimpleNamespace(show_scalar_bar=True)

    def __init__(self):
        self.bars = []

    def add_volume(self, stand_in, scalars, **arguments):
        self.stand_in, self.scalars, self.arguments = stand_in, scalars, arguments
        limits = arguments.get("clim", stand_in.GetPointData().GetArray(scalars).GetRange())
        volume = Volume()
        volume.made = types.SimpleNamespace(lookup_table=make_table(limits), scalar_range=limits)
        return volume

    def add_scalar_bar(self, **arguments):
        self.bars.append((arguments, self.mapper))

    def render(self):
        pass


pyvista = types.SimpleNamespace(
    version_info=(0, 44, 2), wrap=lambda mesh: mesh, PolyData=vtkPolyData, ImageData=vtkImageData,
    RectilinearGrid=vtkRectilinearGrid, MultiBlock=vtkMultiBlockDataSet,
    FieldAssociation=types.SimpleNamespace(POINT="point"), get_cmap_safe=lambda name: None)
sys.modules["pyvista"] = pyvista
from meniscus.pyvista import add_volume, refracted  # noqa: E402


class TestPyVistaFunctions(unittest.TestCase):
    def check_functions(self, look, limits):
        opacity = look.GetScalarOpacity()
        colors = look.GetRGBTransferFunction()
        self.assertEqual(opacity.GetSize(), ENTRIES)
        self.assertEqual(colors.GetSize(), ENTRIES)
        self.assertEqual(opacity.GetRange(), limits)
        self.assertEqual(colors.GetRange(), limits)
        for entry, alpha in enumerate(OPACITIES):
            share = entry / (ENTRIES - 1)
            scalar = limits[0] + share * (limits[1] - limits[0])
            # Bytes in the table.
            self.assertAlmostEqual(opacity.GetValue(scalar), alpha, delta=0.5 / 255 + 1e-12)
            self.assertAlmostEqual(colors.GetRedValue(scalar), share, delta=0.5 / 255 + 1e-12)

    def test_functions_lie_on_the_range(self):
        """Up to PyVista 0.44, also when the range changes later."""
        plotter = Plotter()
        volume = add_volume(plotter, Mesh(), clim=(-3.0, 6.0))
        self.check_functions(volume.GetProperty(), (-3.0, 6.0))
        volume.mapper.scalar_range = (1.0, 2.0)
        self.check_functions(volume.GetProperty(), (1.0, 2.0))

    def test_functions_of_pyvista_stay(self):
        pyvista.version_info = (0, 45, 0)
        try:
            volume = add_volume(Plotter(), Mesh())
        finally:
            pyvista.version_info = (0, 44, 2)
        self.assertEqual(volume.GetProperty().GetScalarOpacity().GetSize(), 2) # vtkVolumeProperty's

    def test_logarithmic_functions(self):
        """Colour and opacity depend on the logarithm of the value, for all versions of PyVista."""
        table = make_table((1.0, 1000.0))
        table.SetScaleToLog10()
        plotter = Plotter()
        plotter.add_volume = lambda *_, **__: self.make_volume(table)
        for pyvista.version_info in ((0, 49, 1), (0, 44, 2)):
            look = add_volume(plotter, Mesh()).GetProperty()
            for decades in (0.0, 0.3, 1.0, 1.7, 2.5, 3.0):
                # Two nodes are a factor of 1000^(1/258) apart: linear in the value between them,
                # the functions are off by 0.4 % of the step between two nodes.
                place = 10.0 ** decades
                self.assertAlmostEqual(look.GetRGBTransferFunction().GetRedValue(place),
                                       decades / 3, delta=0.5 / 255 + 1e-4)
                entry = min(int(decades), ENTRIES - 2)
                expected = OPACITIES[entry] + (decades - entry) * (
                    OPACITIES[entry + 1] - OPACITIES[entry])
                self.assertAlmostEqual(look.GetScalarOpacity().GetValue(place), expected,
                                       delta=0.5 / 255 + 1e-4)

    @staticmethod
    def make_volume(table):
        volume = Volume()
        volume.made = types.SimpleNamespace(lookup_table=table, scalar_range=(1.0, 1000.0))
        return volume

    def test_stand_in(self):
        """PyVista gets the bounds and the extremes, and all arguments that are its own."""
        plotter, mesh = Plotter(), Mesh()
        volume = add_volume(plotter, mesh, cmap="bone", BlendMode=1, name="v")
        self.assertIs(volume.GetMapper(), plotter.mapper)
        self.assertIs(plotter.mapper.GetInputDataObject(0, 0), mesh)
        self.assertEqual(plotter.mapper.GetBlendMode(), 1)
        self.assertEqual(plotter.stand_in.GetBounds(), mesh.bounds)
        self.assertEqual(plotter.stand_in.GetPointData().GetArray("height").GetRange(), (2.0, 5.0))
        self.assertEqual(plotter.arguments, {
            "cmap": "bone", "name": "v", "categories": False, "show_scalar_bar": False,
            "render": False, "opacity_unit_distance": 8.0 / (4 - 1)})
        self.assertEqual(plotter.bars, [({"title": "height"}, plotter.mapper)])

    def test_names_differ(self):
        plotter = Plotter()
        names, volumes = set(), []
        for _ in range(20):
            volumes.append(add_volume(plotter, Mesh(), show_scalar_bar=False))
            names.add(plotter.arguments["name"])
        self.assertEqual(len(names), 20)
        self.assertEqual(plotter.bars, [])


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
        with self.assertRaisesRegex(ValueError, "2 surfaces need 2 indices"):
            refracted(ball(0.1, -1), [plane(0), plane(-0.25)], (0, 0, 2), [1.5])


if __name__ == "__main__":
    unittest.main()
