# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""meniscus.pyvista with MultiBlock datasets, arrays of several components, logarithmic scales and
the files of Testing/Data/Menagerie; skipped without PyVista.

The exit status is then 125, which CTest counts as skipped.
"""
import csv
import itertools
import os
import pathlib
import sys
import unittest
import warnings

try:
    import pyvista
except ImportError:
    print("skipped: no pyvista")
    sys.exit(125)

import numpy
from meniscus.pyvista import add_volume, refracted
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkAMRUtilities, vtkDataSetAttributes

from RefinedGrid import make_refined_grid

SIZE = 120
CELLS = 8
FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data", "Menagerie")


def make_cube():
    image = pyvista.ImageData(dimensions=(CELLS + 1,) * 3, spacing=(1 / CELLS,) * 3)
    image["y"] = image.points[:, 1].astype(float)
    image["decades"] = 10.0 ** (4 * image["y"] - 2)
    image["U"] = numpy.stack([image.points[:, 0], 2 * image["y"], -image["y"]], axis=1)
    return image.cast_to_unstructured_grid()


def picture_of(mesh, *arguments, **named):
    plotter = pyvista.Plotter(off_screen=True, window_size=(SIZE, SIZE))
    plotter.set_background("black")
    add_volume(plotter, mesh, *arguments, show_scalar_bar=False, opacity_unit_distance=0.5, **named)
    plotter.camera_position = [(2.5, -1.8, 1.7), (0.5, 0.5, 0.5), (0.0, 0.0, 1.0)]
    picture = plotter.screenshot(return_img=True)
    plotter.close()
    return picture[:, :, :3].astype(int)


class TestMultiBlocks(unittest.TestCase):
    def setUp(self):
        self.cube = make_cube()
        centers = self.cube.cell_centers().points[:, 1]
        self.halves = [self.cube.extract_cells(centers < 0.5),
                       self.cube.extract_cells(centers > 0.5)]

    def test_blocks_are_one_mesh(self):
        for limits, opacity in ((None, "linear"), ((0.0, 1.0), [0.1, 0.9])):
            whole = picture_of(self.cube, "y", clim=limits, opacity=opacity, cmap="coolwarm")
            self.assertGreater(whole.max(), 100)
            for order in itertools.permutations(self.halves):
                blocks = picture_of(pyvista.MultiBlock(list(order)), "y", clim=limits,
                                    opacity=opacity, cmap="coolwarm")
                # The same cells in another order: rounded to bytes.
                self.assertLessEqual(abs(blocks - whole).max(), 1, limits)

    def test_one_range(self):
        nested = pyvista.MultiBlock([self.halves[0], None, pyvista.MultiBlock([self.halves[1]])])
        plotter = pyvista.Plotter(off_screen=True)
        volume = add_volume(plotter, nested, "y", name="cube")
        self.assertIsInstance(volume, pyvista.plotting.volume.Volume)
        self.assertEqual(tuple(volume.mapper.scalar_range), (0.0, 1.0))
        self.assertEqual(tuple(volume.GetBounds()), (0, 1, 0, 1, 0, 1))
        self.assertEqual(list(plotter.scalar_bars.keys()), ["y"])
        self.assertIn("cube", plotter.actors)
        plotter.close()

    def test_active_scalars(self):
        for half in self.halves:
            half.set_active_scalars("y")
        plotter = pyvista.Plotter(off_screen=True)
        volume = add_volume(plotter, pyvista.MultiBlock(self.halves))
        self.assertEqual(tuple(volume.mapper.scalar_range), (0.0, 1.0))
        self.halves[0].set_active_scalars("decades")
        with self.assertRaisesRegex(ValueError, "decades, y; name an array"):
            add_volume(plotter, pyvista.MultiBlock(self.halves))
        self.cube.set_active_scalars(None)
        with self.assertRaisesRegex(ValueError, "one of: .*decades"):
            add_volume(plotter, self.cube)
        with self.assertRaisesRegex(ValueError, "has no arrays"):
            add_volume(plotter, pyvista.ImageData(dimensions=(3, 3, 3)))
        plotter.close()

    def test_blocks_that_are_not_drawn(self):
        """Surfaces and blocks without the array do not count."""
        surface = pyvista.Sphere(center=(50, 0, 0))
        surface["y"] = numpy.full(surface.n_points, 9.0)
        for half in self.halves:
            half.cell_data.clear()
        blocks = pyvista.MultiBlock([surface, *self.halves])
        self.assertLessEqual(
            abs(picture_of(blocks, "y") - picture_of(self.cube, "y")).max(), 1)
        plotter = pyvista.Plotter(off_screen=True)
        for mesh, scalars, error in (
                (blocks, "q", KeyError), (blocks, numpy.zeros(3), TypeError),
                (pyvista.MultiBlock([surface]), "y", ValueError),
                (pyvista.MultiBlock(), "y", ValueError), (surface, "y", ValueError)):
            with self.assertRaises(error):
                add_volume(plotter, mesh, scalars)
        self.assertEqual(len(plotter.actors), 0)
        plotter.close()

    def test_refracted(self):
        water = pyvista.Plane(center=(0.5, 0.5, 2), i_size=9, j_size=9)
        eye = (0.5, 0.5, 5.0)
        whole = refracted(self.cube, water, eye)
        parts = refracted(pyvista.MultiBlock(self.halves), water, eye)
        numpy.testing.assert_allclose(parts.bounds, whole.bounds, atol=1e-6)

    def test_refracted_and_smooth(self):
        """Also with PyVista 0.44, which refuses smooth shading of a filter."""
        water = pyvista.Plane(center=(0, 0, 0.6), i_size=9, j_size=9)
        plotter = pyvista.Plotter(off_screen=True)
        actor = refracted(pyvista.Sphere(), water, plotter, smooth_shading=True)
        self.assertIn(actor.prop.interpolation.name, ("PHONG", "GOURAUD"))
        with self.assertRaises(TypeError):
            refracted(pyvista.Sphere(), water, plotter, smooth_shading=True, no_argument=1)
        plotter.close()


class TestComponents(unittest.TestCase):
    def test_a_choice_is_needed(self):
        cube = make_cube()
        plotter = pyvista.Plotter(off_screen=True)
        colors = numpy.zeros((cube.n_points, 4))  # of uint8, they would be colours
        for scalars, count in (("U", 3), (cube["U"], 3), (colors, 4)):
            choices = 'component=%s or "magnitude"' % ", ".join(map(str, range(count)))
            with self.assertRaisesRegex(ValueError, choices):
                add_volume(plotter, cube, scalars)
        cube.set_active_scalars("U")
        with self.assertRaisesRegex(ValueError, "'U' has 3 components"):
            add_volume(plotter, cube)
        with self.assertRaisesRegex(ValueError, "'U' has 3 components"):
            add_volume(plotter, pyvista.MultiBlock([cube]))
        for component in (3, -1, "length"):
            with self.assertRaisesRegex(ValueError, "component=0, 1, 2"):
                add_volume(plotter, cube, "U", component=component)
        self.assertEqual(len(plotter.actors), 0)
        plotter.close()

    def test_components(self):
        cube = make_cube()
        cube["magnitude"] = numpy.linalg.norm(cube["U"], axis=1)
        for number in range(3):
            cube[str(number)] = cube["U"][:, number].copy()
        for component in (0, 1, 2, "magnitude"):
            for mesh in (cube, pyvista.MultiBlock([cube])):
                plotter = pyvista.Plotter(off_screen=True)
                volume = add_volume(plotter, mesh, "U", component=component)
                expected = cube.get_data_range(str(component))
                numpy.testing.assert_allclose(volume.mapper.scalar_range, expected)
                self.assertEqual(list(plotter.scalar_bars.keys()), ["U-%s" % component])
                plotter.close()
            numpy.testing.assert_array_equal(picture_of(cube, "U", component=component),
                                             picture_of(cube, str(component)))


    def test_blocks_with_other_components(self):
        vectors, numbers = make_cube(), make_cube()
        vectors["y"] = vectors["U"]
        colors = [make_cube(), make_cube()]
        colors[0]["c"] = numpy.full((colors[0].n_points, 4), 200, numpy.uint8)
        colors[1]["c"] = numpy.full((colors[1].n_points, 4), 0.8)
        plotter = pyvista.Plotter(off_screen=True)
        for order in ([vectors, numbers], [numbers, vectors]):
            for component in (None, 0, 2):
                with self.assertRaisesRegex(ValueError, "has 1 or 3 components"):
                    add_volume(plotter, pyvista.MultiBlock(order), "y", component=component)
        for order in (colors, colors[::-1]):
            with self.assertRaisesRegex(ValueError, "uint8 in some blocks"):
                add_volume(plotter, pyvista.MultiBlock(order), "c", rgba=True)
        plotter.close()


class TestTypes(unittest.TestCase):
    """Arrays of NumPy's types, and grids of VTK's."""

    def test_truths(self):
        """True is drawn as 1, not as one of 255."""
        cube = make_cube()
        cube["truth"], cube["number"] = cube["y"] > 0.4, (cube["y"] > 0.4) * 1.0
        for mesh in (cube, pyvista.MultiBlock([cube])):
            numpy.testing.assert_array_equal(picture_of(mesh, "truth"), picture_of(mesh, "number"))
        plotter = pyvista.Plotter(off_screen=True)
        volume = add_volume(plotter, cube, "truth")
        self.assertEqual(tuple(volume.mapper.scalar_range), (0.0, 1.0))
        plotter.close()

    def test_masks(self):
        """Values that are masked are not drawn."""
        cube = make_cube()
        holes = numpy.where(cube["y"] > 0.6, numpy.nan, cube["y"])
        expected = picture_of(cube, holes)
        for values in (cube["y"], (cube["y"] * CELLS).astype(int)):
            masked = numpy.ma.masked_array(values, cube["y"] > 0.6)
            picture = picture_of(cube, masked, clim=(0, values.max()))
            numpy.testing.assert_array_equal(picture, picture_of(
                cube, numpy.where(cube["y"] > 0.6, numpy.nan, values), clim=(0, values.max())))
        self.assertGreater(abs(expected - picture_of(cube, "y")).max(), 20)
        whole = numpy.ma.masked_array(cube["y"], numpy.zeros(cube.n_points, bool))
        numpy.testing.assert_array_equal(picture_of(cube, whole), picture_of(cube, "y"))
        image = make_cube()["y"].reshape((CELLS + 1,) * 3)
        numpy.testing.assert_array_equal(
            picture_of(numpy.ma.masked_greater(image, 0.6)),
            picture_of(numpy.where(image > 0.6, numpy.nan, image)))

    def test_arrays_with_three_dimensions(self):
        values = make_cube()["y"].reshape((CELLS + 1,) * 3)
        expected = picture_of(values)
        for kind in (numpy.float16, numpy.longdouble, ">f8"):
            numpy.testing.assert_array_equal(picture_of(values.astype(kind)), expected)
        for wrong, message in ((values + 1j, "complex"), (values[0], "2 dimensions"),
                               (values.astype(str), "dimensions of <U")):
            with self.assertRaisesRegex(ValueError, message):
                picture_of(wrong)

    def test_refined_grids(self):
        """A block of an AMR grid is drawn where no finer block is."""
        grid = make_refined_grid(((0, 3), (2, 5)))
        vtkAMRUtilities.BlankCells(grid)
        whole = pyvista.ImageData(dimensions=(9, 9, 9), spacing=(0.5,) * 3)
        inside = (abs(whole.cell_centers().points - 2.0) < 1.0).all(axis=1)
        whole.cell_data["level"] = numpy.where(inside, 2.0, 1.0)
        expected = picture_of(whole.cast_to_unstructured_grid(), "level", clim=(0, 2))
        self.assertLessEqual(abs(picture_of(grid, "level", clim=(0, 2)) - expected).max(), 1)
        coarse = grid.GetDataSet(0, 0)
        coarse.GetCellData().RemoveArray(vtkDataSetAttributes.GhostArrayName())
        self.assertGreater(picture_of(coarse, "level", clim=(0, 2)).max(), 20)


class TestThinMeshes(unittest.TestCase):
    def test_a_plate(self):
        """A plate that the default distance makes transparent causes a warning with the cure."""
        for height, distance, warns in (
                (1.0, None, False), (1e-3, None, True), (1e-3, 1e-3, False)):
            image = pyvista.ImageData(dimensions=(20, 20, 2), spacing=(1.0, 1.0, height))
            image["x"] = image.points[:, 0]
            for mesh in (image, image.cast_to_unstructured_grid()):
                plotter = pyvista.Plotter(off_screen=True)
                with warnings.catch_warnings(record=True) as told:
                    warnings.simplefilter("always")
                    add_volume(plotter, mesh, "x", opacity_unit_distance=distance)
                    add_volume(plotter, mesh, "x", blending="maximum", name="projection")
                found = [str(each.message) for each in told if "transparent" in str(each.message)]
                self.assertEqual(len(found), int(warns), (height, distance))
                self.assertTrue(not warns or "along its shortest side, of 0.001" in found[0])
                plotter.close()


class TestHiddenCells(unittest.TestCase):
    def test_values_of_hidden_points(self):
        """Fill values of hidden points and of refined cells have no part in range and bounds."""
        image = pyvista.ImageData(dimensions=(CELLS + 1,) * 3, spacing=(1 / CELLS,) * 3)
        x = image.points[:, 0].astype(float)
        image["x"] = numpy.where(x == 0, 1e20, x)
        by_points = image.cast_to_structured_grid()
        by_points.point_data["vtkGhostType"] = numpy.where(
            x == 0, vtkDataSetAttributes.HIDDENPOINT, 0).astype(numpy.uint8)
        centers = image.cell_centers().points[:, 0]
        refined = numpy.where(centers < 1 / CELLS, vtkDataSetAttributes.REFINEDCELL, 0)
        meshes = [by_points]
        for mesh in (image.cast_to_structured_grid(), image.cast_to_unstructured_grid()):
            mesh.cell_data["vtkGhostType"] = refined.astype(numpy.uint8)
            meshes.append(mesh)
        for mesh in meshes:
            plotter = pyvista.Plotter(off_screen=True)
            volume = add_volume(plotter, mesh, "x")
            self.assertEqual(tuple(volume.mapper.scalar_range), (1 / CELLS, 1.0))
            numpy.testing.assert_allclose(volume.GetBounds(), (1 / CELLS, 1, 0, 1, 0, 1))
            plotter.close()


class TestArguments(unittest.TestCase):
    """Arguments of a wrong type are TypeErrors that name them, not those of VTK or NumPy."""

    def test_volumes(self):
        cube = make_cube()
        name = cube.array_names[0]
        plotter = pyvista.Plotter(off_screen=True)
        self.addCleanup(plotter.close)
        for wrong in (name.encode(), pathlib.Path(name), 3, True, [name], {}, object()):
            for mesh in (cube, pyvista.MultiBlock([cube])):
                with self.assertRaisesRegex(TypeError, "^scalars must be the name of an array"):
                    add_volume(plotter, mesh, wrong)
            with self.assertRaisesRegex(TypeError, "^opacity_array must be the name of an array"):
                add_volume(plotter, cube, name, opacity_array=wrong)
        for wrong in (None, "mesh.vtu", b"mesh.vtu", pathlib.Path("mesh.vtu"), 3, []):
            with self.assertRaisesRegex(TypeError, "^mesh must be a dataset, not "):
                add_volume(plotter, wrong)
            with self.assertRaisesRegex(TypeError, "^plotter must be a pyvista.Plotter, not "):
                add_volume(wrong, cube, name)
            with self.assertRaisesRegex(TypeError, "^eye must be 3 numbers"):
                refracted(cube, cube, wrong)
        for argument, wrong in {"blending": (b"composite", ["composite"]),
                                "isovalues": (b"abc", "abc", 2.5, [b"a"]),
                                "cmap": (b"viridis", 3)}.items():
            for value in wrong:
                others = {"blending": "isosurface"} if argument == "isovalues" else {}
                with self.assertRaisesRegex(TypeError, "^%s must be " % argument):
                    add_volume(plotter, cube, name, **{argument: value}, **others)
        add_volume(plotter, cube, numpy.str_(name))

    def test_numbers_that_are_not_finite(self):
        cube = make_cube()
        plotter = pyvista.Plotter(off_screen=True)
        self.addCleanup(plotter.close)
        nan, infinity = float("nan"), float("inf")
        for argument, values in {"opacity_unit_distance": (0, -1.0, nan, infinity),
                                 "clim": ((0.0, nan), [-infinity, 1.0], nan, -1.0),
                                 "rng": ((nan, 1.0),),
                                 "opacity": ([0.0, nan, 1.0], numpy.array([0.1, infinity])),
                                 "user_matrix": (numpy.full((4, 4), nan),),
                                 "isovalues": ([0.5, nan],),
                                 **{name: (nan, -infinity, -0.1) for name in (
                                     "ambient", "diffuse", "specular", "specular_power")},
                                 }.items():
            for value in values:
                with self.assertRaisesRegex(ValueError, "^%s must be .*finite" % argument):
                    add_volume(plotter, cube, "y", **{argument: value})

    def test_numbers_out_of_range(self):
        """A range of which the upper end comes first leaves VTK's table as it was."""
        cube, nan = make_cube(), float("nan")
        plotter = pyvista.Plotter(off_screen=True)
        self.addCleanup(plotter.close)
        for named, message in (
                ({"clim": (1.0, 0.0)}, "^clim must have its lower end first"),
                ({"rng": [1, 0]}, "^rng must have its lower end first"),
                ({"clim": (1.0, 0.1), "log_scale": True}, "^clim must have its lower end first"),
                ({"clim": (-1.0, 0.0), "log_scale": True}, "^clim must have an upper end above 0"),
                ({"opacity_array": "y", "opacity_clim": (1.0, 0.0)}, "^opacity_clim must have "),
                ({"opacity": [-0.5, 1.0]}, "^opacity must be numbers of at least 0, not -0.5"),
                ({"n_colors": 0}, "^n_colors must be at least 1, not 0"),
                ({"categories": -1}, "^categories must be at least 1, not -1"),
                ({"isovalues": []}, "isovalues must be at least 1"),
                ({"EarlyTerminationOpacity": nan}, "^EarlyTerminationOpacity must not be NaN")):
            with self.assertRaisesRegex(ValueError, message):
                add_volume(plotter, cube, "y", **named)
        for named in ({"clim": "x"}, {"clim": (0.0,)}, {"clim": (0.0, "x")}, {"ambient": "x"},
                      {"ambient": [0.1, 0.2]}, {"opacity_unit_distance": "1"}, {"opacity": b"x"},
                      {"opacity": [[0, 1]]}, {"n_colors": 2.5}, {"categories": "x"},
                      {"opacity_array": "y", "opacity_clim": 1.0}):
            with self.assertRaisesRegex(TypeError, "^%s must be " % list(named)[-1]):
                add_volume(plotter, cube, "y", **named)
        self.assertEqual(len(plotter.actors), 0)
        look = add_volume(plotter, cube, "y", clim=2, ambient=numpy.float32(0.5),
                          diffuse=numpy.array(0.25), shade=True).prop
        self.assertEqual((look.ambient, look.diffuse), (0.5, 0.25))
        self.assertEqual(tuple(plotter.mapper.scalar_range), (-2.0, 2.0))

    def test_nothing_to_be_seen(self):
        """A warning says why."""
        cube = make_cube()
        low, high = cube["y"].min(), cube["y"].max()
        plotter = pyvista.Plotter(off_screen=True)
        self.addCleanup(plotter.close)
        inside = 0.75 * low + 0.25 * high
        for named, message in (
                ({"clim": (high + 1.0, high + 2.0)}, "the opacity is 0 for all of its values"),
                ({"opacity": 0.0}, "the opacity is 0"), ({"opacity": [0.0, 0.0]}, "opacity is 0"),
                ({"isovalues": [high + 1.0]}, "it has none of the isovalues"),
                ({"isovalues": 3, "clim": (low - 9.0, low - 1.0)}, "none of the isovalues")):
            with self.assertWarnsRegex(UserWarning, "^Nothing of 'y' can be seen: .*" + message):
                add_volume(plotter, cube, "y", **named)
        for named in ({}, {"clim": (low - 2.0, low - 1.0)}, {"opacity": [1.0, 0.0, 0.0]},
                      {"clim": (inside, inside + 1.0)}, {"clim": (low - 1.0, low + 0.01)},
                      {"isovalues": [high + 1.0, inside]}, {"blending": "maximum"},
                      {"opacity": [0.0] * 20 + [1.0] + [0.0] * 20}):
            with warnings.catch_warnings():
                warnings.simplefilter("error", UserWarning)
                add_volume(plotter, cube, "y", **named)

    def test_values_that_are_too_near(self):
        cube = make_cube()
        plotter = pyvista.Plotter(off_screen=True)
        self.addCleanup(plotter.close)
        for values, hint in ((1e15 + numpy.rint(16 * cube["y"]) / 8, "draw near - 1e\\+15 instead"),
                             (1e308 * (2 * cube["y"] - 1), "draw near / 1e\\+300 instead"),
                             (numpy.rint(9 * cube["y"]).astype(numpy.int64) + 2 ** 60,
                              "draw near - 1152921504606846980 instead")):
            cube["near"] = values
            with self.assertWarnsRegex(UserWarning, hint):
                add_volume(plotter, cube, "near")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            add_volume(plotter, cube, "y")


class TestLogarithms(unittest.TestCase):
    def test_functions_of_the_logarithm(self):
        """At 10 of 0.01 to 100 the opacity is 0.75, at 0.1 the colour is that at a quarter of the
        map."""
        plotter = pyvista.Plotter(off_screen=True)
        look = add_volume(plotter, make_cube(), "decades", log_scale=True, opacity="linear",
                          cmap="viridis").GetProperty()
        self.assertAlmostEqual(look.GetScalarOpacity().GetValue(10.0), 0.75, delta=0.005)
        # Entries of the table are bytes.
        numpy.testing.assert_allclose(look.GetRGBTransferFunction().GetColor(0.1),
                                      (0.2297, 0.3224, 0.5457), atol=1.5 / 255)
        plotter.close()

    def test_isosurfaces(self):
        """A number of isosurfaces has values at equal distances on the scale."""
        plotter = pyvista.Plotter(off_screen=True)
        for name, named, expected in (("decades", {"log_scale": True}, (0.1, 1.0, 10.0)),
                                      ("y", {}, (0.25, 0.5, 0.75))):
            contours = add_volume(plotter, make_cube(), name, isovalues=3, **named
                                  ).GetProperty().GetIsoSurfaceValues()
            numpy.testing.assert_allclose(
                [contours.GetValue(index) for index in range(3)], expected)
        plotter.close()

    def test_values_at_and_below_zero(self):
        cube = make_cube()
        plotter = pyvista.Plotter(off_screen=True)
        volume = add_volume(plotter, cube, "y", log_scale=True)
        self.assertEqual(tuple(volume.mapper.scalar_range), (1 / CELLS, 1.0))
        cube["none"] = -cube["y"]
        with self.assertRaisesRegex(ValueError, "no value above 0"):
            add_volume(plotter, cube, "none", log_scale=True)
        plotter.close()

    def test_a_bar_that_changes(self):
        plotter = pyvista.Plotter(off_screen=True)
        volume = add_volume(plotter, make_cube(), "decades", log_scale=True, opacity="linear")
        for limits in ((3.0, 5.0), (1.0, 10000.0)):
            plotter.update_scalar_bar_range(limits)
        look = volume.GetProperty()
        self.assertAlmostEqual(look.GetScalarOpacity().GetValue(100.0), 0.5, delta=0.005)
        plotter.close()


class TestMenagerie(unittest.TestCase):
    """Each file that PyVista reads has the bounds of the table and is drawn by add_volume()."""

    # Readers of PyVista 0.44 leave these arrays or bases out, or have another name for the ending.
    OTHER = (".inp", ".series", ".pvd", ".0", ".nc", ".vtkhdf", ".msh", ".cgns", ".vtpd")

    def draw(self, row):
        mesh = pyvista.read(os.path.join(FOLDER, row["file"]))
        array = next(iter(row["arrays"].split(", "))).split(" ", 1)
        plotter = pyvista.Plotter(off_screen=True, window_size=(40, 30))
        plotter.set_background("black")
        volume = add_volume(plotter, mesh, array[1], preference=array[0], show_scalar_bar=False,
                            component="magnitude", render=False)
        numpy.testing.assert_allclose(volume.GetBounds(),
                                      [float(x) for x in row["bounds"].split()], atol=1e-9)
        self.assertGreater(plotter.screenshot(return_img=True).max(), 20)
        plotter.close()

    def test_files(self):
        with open(os.path.join(FOLDER, "expected.csv"), newline="") as file:
            rows = list(csv.DictReader(file, delimiter="|", quoting=csv.QUOTE_NONE))
        drawn = 0
        for row in rows:
            if (float(row["volume"]) and not row["needs"] and row["arrays"] != "cell uniform"
                    and not row["file"].endswith(self.OTHER)):
                with self.subTest(file=row["file"], vtk=vtkVersion.GetVTKVersion()):
                    self.draw(row)
                    drawn += 1
        self.assertGreater(drawn, 40)


if __name__ == "__main__":
    unittest.main()
