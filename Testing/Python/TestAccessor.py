# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""mesh.meniscus and the functions behind it, in PyVista's plotters; skipped without PyVista.

The exit status is then 125, which CTest counts as skipped.
"""
import importlib.metadata
import inspect
import os
import subprocess
import sys
import tempfile
import unittest

try:
    import pyvista
except ImportError:
    print("skipped: no pyvista")
    sys.exit(125)

import meniscus
import numpy
from meniscus.api import accessor
from meniscus.api.functions import make_functions
from meniscus.names import BLEND_MODES
from meniscus.pyvista import add_volume
from meniscus.rivals import difference
from vtkmodules.vtkCommonCore import vtkLookupTable

CELLS = 8
SIZE = (120, 90)
VIEW = [(2.5, -1.8, 1.7), (0.5, 0.5, 0.5), (0.0, 0.0, 1.0)]
METHODS = ("plot", "add_to", "radiograph", "integral", "pick", "compare", "refracted",
           "schlieren", "mirage", "apparent")


def make_cube():
    """Hexahedra in a unit cube."""
    image = pyvista.ImageData(dimensions=(CELLS + 1,) * 3, spacing=(1 / CELLS,) * 3)
    image["x"], image["y"] = image.points[:, 0].astype(float), image.points[:, 1].astype(float)
    image["U"] = numpy.stack([image["x"], 2 * image["y"], -image["y"]], axis=1)
    image.cell_data["c"] = numpy.arange(CELLS ** 3, dtype=float)
    image.set_active_scalars("y")
    return image.cast_to_unstructured_grid()


def halves_of(cube):
    centers = cube.cell_centers().points[:, 1]
    return pyvista.MultiBlock([cube.extract_cells(centers < 0.5), None,
                               cube.extract_cells(centers > 0.5)])


def make_plotter():
    plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
    plotter.set_background("black")
    plotter.camera_position = VIEW
    return plotter


def picture_of(mesh, *arguments, **named):
    plotter = make_plotter()
    meniscus.add_to(mesh, plotter, *arguments, **{"show_scalar_bar": False, **named})
    picture = plotter.screenshot(return_img=True)[:, :, :3].astype(int)
    plotter.close()
    return picture


class TestAccessor(unittest.TestCase):
    def test_registered(self):
        """PyVista's own registry from 0.48 on; a stand-in for it before."""
        if not hasattr(pyvista, "register_dataset_accessor"):
            kinds = []

            def register(name, kind):
                kinds.append((name, kind))
                return lambda method: method

            pyvista.register_dataset_accessor = register
            try:
                accessor.register()
            finally:
                del pyvista.register_dataset_accessor
            self.assertEqual(kinds, [("meniscus", pyvista.DataSet),
                                     ("meniscus", pyvista.MultiBlock)])
            return
        cube = make_cube()
        for mesh in (cube, halves_of(cube), pyvista.Sphere()):
            self.assertIsInstance(mesh.meniscus, accessor.MeniscusAccessor)
            self.assertIs(mesh.meniscus.mesh, mesh)

    def test_entry_point(self):
        """An installed package needs no import: PyVista finds the accessor, and in either order."""
        if not hasattr(pyvista, "register_dataset_accessor"):
            self.skipTest("PyVista 0.48 has accessors")
        installed = any(entry.name == "meniscus" for entry in importlib.metadata.entry_points(
            group="pyvista.accessors"))
        for imports in ["import pyvista, meniscus"] + installed * [
                "import pyvista", "import meniscus, pyvista"]:
            code = imports + "; print(type(pyvista.MultiBlock().meniscus), pyvista.Cube().meniscus)"
            done = subprocess.run([sys.executable, "-B", "-W", "ignore", "-c", code], text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertIn("MeniscusAccessor", done.stdout)

    def test_methods_are_the_functions(self):
        methods = accessor.MeniscusAccessor(make_cube())
        for name in METHODS:
            function, method = getattr(meniscus, name), getattr(methods, name)
            self.assertIs(getattr(accessor.MeniscusAccessor, name), function)
            self.assertEqual(method.__doc__, function.__doc__)
            expected = list(inspect.signature(function).parameters)
            self.assertEqual(["mesh", *inspect.signature(method).parameters], expected)
            for parameter in expected[:-1] + ["[Rr]eturns|Radiograph"]:
                self.assertRegex(function.__doc__, r"\b(%s)\b" % parameter, name)
            self.assertEqual({*expected, "return"}, set(function.__annotations__), name)

    def test_numbers(self):
        methods = accessor.MeniscusAccessor(make_cube())
        numpy.testing.assert_allclose(
            methods.integral("y", size=(4, 4))[1:3, 1:3].mean(axis=1), [0.375, 0.625], rtol=1e-5)
        self.assertEqual(methods.radiograph("y", [0.1, 1.0], size=(4, 3)).shape, (3, 4, 2))

    def test_mirage(self):
        """Blocks, and a dataset of the kind of the mesh; 1 + 1e-6 y bends next to nothing."""
        cube, ball = make_cube(), pyvista.Sphere(radius=0.4, center=(0.5, 0.5, 0.5))
        named = {"GladstoneDale": 1e-6}
        for objects in (ball, pyvista.MultiBlock([ball, None])):
            found = accessor.MeniscusAccessor(cube).mirage(
                objects, "y", "position", size=(9, 9), **named)
            self.assertAlmostEqual(found[4, 4, 2], 0.9, delta=1e-3)
        seen = accessor.MeniscusAccessor(ball).apparent(
            halves_of(cube), (0.5, 0.5, 3.0), "y", SearchResolution=8, **named)
        self.assertIs(type(seen), type(ball))
        numpy.testing.assert_allclose(seen.points, ball.points, atol=1e-5)
        self.assertEqual(set(seen["NumberOfImages"]), {1})

    def test_plot(self):
        methods = accessor.MeniscusAccessor(make_cube())
        named = {"off_screen": True, "window_size": SIZE, "background": "white", "cpos": VIEW}
        picture = numpy.asarray(methods.plot("y", cmap="inferno", screenshot=True, **named))
        self.assertEqual(picture.shape[:2], SIZE[::-1])
        self.assertGreater(int(picture.max()) - int(picture.min()), 100)
        for name in ("client", "html"):
            with self.assertRaisesRegex(ValueError, "draws in the browser"):
                methods.plot("y", jupyter_backend=name, **named)


class TestBlending(unittest.TestCase):
    def test_names(self):
        cube = make_cube()
        plotter = make_plotter()
        for name, number in (*BLEND_MODES.items(), ("isosurfaces", 5)):
            volume = meniscus.add_to(cube, plotter, "y", blending=name, show_scalar_bar=False)
            self.assertEqual(volume.mapper.GetBlendMode(), number)
            self.assertEqual(volume.mapper.blend_mode, name[:10])
        with self.assertRaisesRegex(ValueError, "composite, maximum, minimum, average, additive, "
                                    "isosurface"):
            meniscus.add_to(cube, plotter, "y", blending="sideways")
        with self.assertRaisesRegex(ValueError, "automatic, opengl, compute, native"):
            meniscus.add_to(cube, plotter, "y", backend="quick")
        plotter.close()

    def test_isovalues(self):
        plotter = make_plotter()
        for named, expected in (
                ({"isovalues": [0.3, 0.4]}, [0.3, 0.4]), ({"isovalues": 1}, [0.5]),
                ({"blending": "isosurface"}, [0.25, 0.5, 0.75]),
                ({"isovalues": 3, "clim": (0.0, 4.0)}, [1.0, 2.0, 3.0])):
            look = meniscus.add_to(make_cube(), plotter, "y", **named).prop
            contours = look.GetIsoSurfaceValues()
            numpy.testing.assert_allclose(
                [contours.GetValue(i) for i in range(contours.GetNumberOfContours())], expected)
        for named in ({"isovalues": 0}, {"isovalues": 1, "blending": "maximum"}):
            with self.assertRaisesRegex(ValueError, "isovalues"):
                meniscus.add_to(make_cube(), plotter, "y", **named)
        plotter.close()

    def test_one_surface_is_where_its_value_is(self):
        plotter = make_plotter()
        cube = make_cube()
        meniscus.add_to(cube, plotter, "y", isovalues=[0.3], opacity=[1.0, 1.0])
        plotter.render()
        found = meniscus.pick(cube, plotter, SIZE[0] // 2, SIZE[1] // 2)
        self.assertAlmostEqual(found.position[1], 0.3, 6)
        self.assertEqual(found.surface, 0)
        plotter.close()

    def test_light(self):
        plotter = make_plotter()
        for named, shade, ambient in (
                ({}, False, None), ({"light": True}, True, 0.35), ({"shade": True}, True, None),
                ({"isovalues": 2}, True, 0.35), ({"isovalues": 2, "light": False}, False, None),
                ({"light": True, "ambient": 0.1}, True, 0.1)):
            look = meniscus.add_to(make_cube(), plotter, "y", **named).prop
            self.assertEqual(look.shade, shade, named)
            if ambient is not None:
                self.assertEqual(look.ambient, ambient, named)
        plotter.close()

    def test_views(self):
        """plot() takes pyvista.plot()'s arguments of the view."""
        methods = accessor.MeniscusAccessor(make_cube())
        named = {"off_screen": True, "window_size": SIZE, "screenshot": True, "opacity": [1, 1],
                 "background": "black", "show_scalar_bar": False, "show_axes": False}

        def seen_with(**view):
            return numpy.asarray(methods.plot("y", **view, **named)).sum(2) > 0

        flat = {"cpos": "xy", "parallel_projection": True}
        self.assertAlmostEqual(
            seen_with(zoom=0.5, **flat).sum() / seen_with(**flat).sum(), 0.25, delta=0.02)
        plain = seen_with()
        self.assertGreater(seen_with(zoom=1.5).sum(), 1.8 * plain.sum())
        for view in ({"text": "A cube"}, {"show_bounds": True}, {"show_grid": True}):
            self.assertTrue((seen_with(**view) != plain).any(), view)
        camera = methods.plot("y", off_screen=True, cpos="xy", return_cpos=True)
        numpy.testing.assert_allclose(tuple(camera)[2], (0, 1, 0))
        closed = []
        self.assertTrue((seen_with(border=True, border_color="red", before_close_callback=(
            closed.append), auto_close=True) != plain).any())
        self.assertEqual(len(closed), 1)

    def test_smooth_edges(self):
        """Pixels at the edge of a surface are between its colour and the background's, unless
        that is refused."""
        methods = accessor.MeniscusAccessor(make_cube())
        named = {"off_screen": True, "window_size": SIZE, "screenshot": True, "opacity": [1, 1],
                 "background": "black", "show_scalar_bar": False, "show_axes": False,
                 "isovalues": [0.52], "light": False, "cmap": ["white", "white"]}

        def count_mixed(**more):
            picture = numpy.asarray(methods.plot("y", **more, **named))[..., 0]
            return ((picture > 5) & (picture < 250)).sum()

        self.assertEqual(count_mixed(anti_aliasing=False), 0)
        for more in ({}, {"anti_aliasing": "msaa"}, {"anti_aliasing": "ssaa"},
                     {"anti_aliasing": True}):
            self.assertGreater(count_mixed(**more), 50, more)
        self.assertEqual(count_mixed(ImageSampleDistance=1.0), 0)

    def test_arguments_of_surfaces(self):
        """Those of pyvista.plot() that mean nothing here are refused with a hint."""
        methods = accessor.MeniscusAccessor(make_cube())
        for named, message in (({"volume": False}, "pyvista.plot"), ({"ssao": True}, "shadows"),
                               ({"eye_dome_lighting": True}, "shadows")):
            with self.assertRaisesRegex(ValueError, message):
                methods.plot("y", off_screen=True, **named)
        with self.assertRaisesRegex(TypeError, r"2 whole numbers, not \(400,\)"):
            methods.plot("y", off_screen=True, window_size=(400,))
        methods.plot("y", off_screen=True, volume=True)

    def test_shadows(self):
        """A lamp above a cube of one dense medium lights its top, and less of it with a shorter
        reach."""
        cube = make_cube()
        cube["one"] = numpy.ones(cube.n_points)
        cube["one"][0] = 0.99  # a constant array has no range

        def rows_of(**named):
            plotter = pyvista.Plotter(off_screen=True, window_size=SIZE, lighting="none")
            plotter.add_light(pyvista.Light(position=(0.5, 0.5, 9), focal_point=(0.5, 0.5, 0)))
            plotter.set_background("black")
            volume = meniscus.add_to(cube, plotter, "one", cmap="gray", clim=[0, 1],
                                     opacity=[1.0, 1.0], opacity_unit_distance=0.2,
                                     show_scalar_bar=False, **named)
            plotter.view_xz()
            picture = plotter.screenshot(return_img=True)[..., 0].astype(float)
            plotter.close()
            return volume, picture[picture.sum(1) > 0].mean(1)

        volume, rows = rows_of(shadows=True)
        self.assertTrue(volume.prop.shade)
        self.assertEqual(volume.mapper.GetGlobalIlluminationReach(), 1.0)
        self.assertEqual(volume.mapper.GetVolumetricScatteringBlending(), 1.0)
        top, bottom = rows[len(rows) // 8], rows[-len(rows) // 8]
        self.assertGreater(top, 1.3 * bottom)
        volume, near = rows_of(shadows=0.1, VolumetricScatteringBlending=0.5)
        self.assertEqual(volume.mapper.GetVolumetricScatteringBlending(), 0.5)
        self.assertGreater(near[-len(near) // 8], 1.1 * bottom)
        for wrong, kind in ((1.5, ValueError), (-1, ValueError), (float("nan"), ValueError),
                            ("yes", TypeError)):
            with self.assertRaisesRegex(kind, "shadows"):
                meniscus.add_to(cube, make_plotter(), "one", shadows=wrong)


class TestSeveralArrays(unittest.TestCase):
    def test_opacity_of_the_same_array(self):
        """is that without opacity_array."""
        cube = make_cube()
        named = {"opacity": [0.0, 0.2, 0.9], "cmap": "coolwarm"}
        for mesh in (cube, halves_of(cube)):
            difference = abs(picture_of(cube, "y", **named)
                             - picture_of(mesh, "y", opacity_array="y", **named))
            # Media of one component are integrated in closed form, those of two by Gauss' rule.
            self.assertLessEqual(difference.max(), 1)

    def test_opacity_of_another_array(self):
        """Where it is 0 nothing is seen, whatever the colours are."""
        cube = make_cube()
        cube["some"] = (cube["x"] > 0.5).astype(float)
        visible = picture_of(cube.extract_points(cube["x"] >= 0.5), "y", clim=(0, 1),
                             opacity=[0, 1], opacity_array="some", opacity_unit_distance=0.1)
        whole = picture_of(cube, "y", opacity=[0, 1], opacity_array="some",
                           opacity_unit_distance=0.1)
        self.assertGreater(whole.max(), 100)
        self.assertLessEqual(abs(visible - whole).max(), 1)
        # A range beyond the values halves the opacities.
        plotter = make_plotter()
        volume = meniscus.add_to(cube, plotter, "y", opacity_array="some", opacity=[0, 1],
                                 opacity_clim=(0, 2))
        self.assertAlmostEqual(volume.prop.GetScalarOpacity().GetValue(1.0), 0.5, delta=0.01)
        self.assertEqual(tuple(volume.mapper.scalar_range), (0.0, 1.0))
        table = volume.mapper.lookup_table
        self.assertEqual({table.GetTableValue(entry)[3] for entry in range(256)}, {1.0})
        plotter.update_scalar_bar_range((0.2, 0.4))
        self.assertAlmostEqual(volume.prop.GetScalarOpacity().GetValue(1.0), 0.5, delta=0.01)
        plotter.close()

    def test_changed_arrays(self):
        """The picture follows the mesh, as with one array."""
        cube = make_cube()
        cube["colors"] = (255 * numpy.stack([cube["x"], cube["y"], cube["x"]], 1)).astype("uint8")
        for scalars, changed, named in (("y", "x", {"opacity_array": "x", "clim": (0, 1)}),
                                        ("colors", "colors", {"rgba": True}),
                                        ("y", "y", {"clim": (0, 1)})):
            named = {"show_scalar_bar": False, "opacity_unit_distance": 0.2, **named}
            for mesh in (cube.copy(), halves_of(cube)):
                plotter = make_plotter()
                meniscus.add_to(mesh, plotter, scalars, **named)
                before = plotter.screenshot(return_img=True)[:, :, :3].astype(int)
                blocks = [mesh] if isinstance(mesh, pyvista.UnstructuredGrid) else [*mesh][::2]
                for block in blocks:
                    block[changed] = cube[changed].max() - block[changed]
                plotter.render()
                after = plotter.screenshot(return_img=True)[:, :, :3].astype(int)
                plotter.close()
                self.assertGreater(abs(after - before).max(), 20)
                self.assertLessEqual(abs(after - picture_of(mesh, scalars, **named)).max(), 1)

    def test_component_for_opacity(self):
        plotter = make_plotter()
        volume = meniscus.add_to(make_cube(), plotter, "y", opacity_array="U",
                                 opacity_component=2)
        self.assertEqual(tuple(volume.prop.GetScalarOpacity().GetRange()), (-1.0, 0.0))
        plotter.close()

    def test_colors(self):
        """Opaque colours are those of the array, of any type and with or without opacity."""
        cube = make_cube()
        color = (200, 100, 50)
        for array in (numpy.uint8([color]), numpy.uint8([(*color, 255)]),
                      numpy.array([color]) / 255, numpy.float32([(*color, 255)]) / 255):
            cube["colors"] = numpy.repeat(array, cube.n_points, axis=0)
            for mesh in (cube, halves_of(cube)):
                picture = picture_of(mesh, "colors", rgba=True, opacity_unit_distance=1e-4)
                numpy.testing.assert_allclose(picture[SIZE[1] // 2, SIZE[0] // 2], color, atol=1)
        cube["clear"] = numpy.repeat(numpy.uint8([(*color, 0)]), cube.n_points, axis=0)
        self.assertEqual(picture_of(cube, "clear", rgba=True).max(), 0)
        plotter = make_plotter()
        volume = meniscus.add_to(cube, plotter, "colors", rgba=True)
        self.assertEqual(len(plotter.scalar_bars), 0)
        self.assertEqual(volume.prop.GetIndependentComponents(), 0)
        plotter.close()

    def test_bad_arrays(self):
        cube = make_cube()
        cube["ints"] = numpy.zeros((cube.n_points, 4), int)
        cube.cell_data["cells"] = numpy.zeros((cube.n_cells, 4), numpy.uint8)
        plotter = make_plotter()
        for scalars, named, message in (
                ("y", {"rgba": True}, "has 1 components; colours have 3 or 4"),
                ("ints", {"rgba": True}, "must be uint8"),
                ("cells", {"rgba": True}, "cell_data_to_point_data"),
                ("U", {"rgba": True, "component": 1}, "leave component out"),
                ("U", {"rgba": True, "blending": "maximum"}, "need blending=\"composite\""),
                ("U", {"rgba": True, "opacity_array": "y"}, "leave opacity_array out"),
                ("U", {}, "or draw colours with rgba=True"),
                ("y", {"opacity_array": "c"}, "must both belong to points"),
                ("c", {"opacity_array": "c"}, "cell_data_to_point_data"),
                ("y", {"opacity_array": "y", "isovalues": 2}, "need blending=\"composite\""),
                ("y", {"opacity_array": "y", "opacity_clim": (1, 0)}, "lower end"),
                ("y", {"opacity_array": "U"}, "has 3 components")):
            with self.assertRaisesRegex(ValueError, message):
                meniscus.add_to(cube, plotter, scalars, **named)
        for mesh in (cube, halves_of(cube)):
            for named in ({"scalars": "w"}, {"scalars": "y", "opacity_array": "w"}):
                with self.assertRaisesRegex(KeyError, "'w'.* U, "):
                    meniscus.add_to(mesh, plotter, **named)
        self.assertEqual(len(plotter.actors), 0)
        plotter.close()


class TestColors(unittest.TestCase):
    def test_color_maps(self):
        """Names of PyVista, and of packages if they are installed."""
        plotter = make_plotter()
        for package, name in ((None, "viridis"), ("cmocean", "thermal"), ("colorcet", "fire")):
            try:
                if package:
                    __import__(package)
            except ImportError:
                continue
            volume = meniscus.add_to(make_cube(), plotter, "y", cmap=name)
            numpy.testing.assert_allclose(
                volume.prop.GetRGBTransferFunction().GetColor(1.0),
                pyvista.get_cmap_safe(name)(1.0)[:3], atol=1.5 / 255)
        with self.assertRaisesRegex(ValueError, "There is no colour map 'viridus'.* viridis, "):
            meniscus.add_to(make_cube(), plotter, "y", cmap="viridus")
        plotter.close()

    def test_functions_of_a_table(self):
        """Tables are read at once: none of the calls for single entries."""
        class Table(vtkLookupTable):
            def GetTableValue(self, *arguments):
                raise AssertionError("an entry was asked for")

        table = Table()
        table.SetNumberOfTableValues(4)
        table.SetTableRange(0, 3)
        for entry in range(4):
            table.SetTableValue(entry, entry / 3, 0.0, 1.0, 1 - entry / 3)
        colors, opacity = make_functions(table)
        for entry in range(4):
            self.assertAlmostEqual(colors.GetRedValue(entry), entry / 3, 6)
            self.assertAlmostEqual(opacity.GetValue(entry), 1 - entry / 3, 6)


class TestPick(unittest.TestCase):
    def test_pick(self):
        cube = make_cube()
        for mesh in (cube, halves_of(cube)):
            for named in ({}, {"opacity_array": "x"}):
                plotter = make_plotter()
                meniscus.add_to(mesh, plotter, "y", opacity=[0, 0.5], **named)
                plotter.render()
                found = meniscus.pick(mesh, plotter, SIZE[0] // 2, SIZE[1] // 2)
                shown = 0 if named else 1
                self.assertAlmostEqual(found.value, found.position[shown], 5)
                self.assertEqual(found.block >= 0, mesh is not cube)
                self.assertGreaterEqual(found.cell_id, 0)
                self.assertAlmostEqual(
                    found.depth, numpy.linalg.norm(numpy.subtract(found.position, VIEW[0])), 5)
                self.assertIsNone(meniscus.pick(mesh, plotter, 0, 0))
                with self.assertRaisesRegex(ValueError, "does not show this mesh"):
                    meniscus.pick(make_cube(), plotter, 0, 0)
                with self.assertRaisesRegex(TypeError, "mesh must be a dataset, not NoneType"):
                    meniscus.pick(None, plotter, 0, 0)
                with self.assertRaisesRegex(TypeError, "must be a pyvista.Plotter, not NoneType"):
                    meniscus.pick(mesh, None, 0, 0)
                with self.assertRaisesRegex(ValueError, "known are first_visible"):
                    meniscus.pick(mesh, plotter, 0, 0, place="last")
                plotter.close()


class TestCompare(unittest.TestCase):
    def test_compare(self):
        cube = make_cube()
        # The same functions of the same field: VTK's mappers sample, and one of them leaves rays
        # out. Reversed opacities are a yardstick for unlike pictures.
        named = {"opacity": [0, 0.5]}
        yardstick = difference(picture_of(cube, "y", **named),
                               picture_of(cube, "y", opacity=[0.5, 0]))
        for mesh, scalars in ((cube, "y"), (halves_of(cube), "y"), (cube, "c")):
            found = meniscus.compare(mesh, scalars, mappers=["projected tetrahedra", "z sweep"],
                                     size=SIZE, frames=1, cpos=VIEW, **named)
            self.assertEqual([each.name for each in found],
                             ["meniscus", "projected tetrahedra", "z sweep"])
            self.assertEqual(found[0].rms, 0.0)
            for each in found:
                self.assertGreater(each.milliseconds, 0.0)
                self.assertGreater(each.first_milliseconds, 0.0)
                self.assertLess(each.rms, yardstick / 4, (scalars, each))

    def test_difference(self):
        """Pixels that are black in both pictures do not count."""
        first, second = numpy.zeros((4, 4, 3)), numpy.zeros((4, 4, 3))
        self.assertEqual(difference(first, second), 0.0)
        first[0, 0] = 3.0
        second[1, 1] = 1.0
        self.assertAlmostEqual(difference(first, second), 5.0 ** 0.5)

    def test_bad_arguments(self):
        cube = make_cube()
        for named in ({"mappers": ["smart"]}, {"frames": 0}, {"blending": "maximum"}):
            with self.assertRaises(ValueError):
                meniscus.compare(cube, "y", size=SIZE, **named)


class TestRefracted(unittest.TestCase):
    EYES = ((0, -6, 4), (4, -5, 3), (-1, 2, 6))

    def setUp(self):
        self.pool = pyvista.Plane(center=(0, 0, -2), i_size=4, j_size=4, i_resolution=4,
                                  j_resolution=4)
        self.pool["tile"] = numpy.arange(16) % 3
        self.water = pyvista.Plane(i_size=12, j_size=12)

    def show(self, plotter, eye):
        plotter.camera_position = [eye, (0, 0, -1), (0, 0, 1)]
        plotter.render()
        return plotter.screenshot(return_img=True)[:, :, :3].astype(int)

    def test_follows_the_camera(self):
        """In every view the picture is that of the geometry for this eye."""
        moving = make_plotter()
        actor = meniscus.refracted(self.pool, self.water, moving, scalars="tile", cmap="gray",
                                   show_scalar_bar=False)
        self.assertIsInstance(actor, pyvista.Actor)
        for eye in self.EYES:
            fixed = make_plotter()
            fixed.add_mesh(meniscus.refracted(self.pool, self.water, eye), scalars="tile",
                           cmap="gray", show_scalar_bar=False)
            expected = self.show(fixed, eye)
            self.assertGreater(expected.max(), 200)
            numpy.testing.assert_array_equal(self.show(moving, eye), expected)
            fixed.close()
        moving.camera = pyvista.Camera()
        numpy.testing.assert_array_equal(self.show(moving, eye), expected)
        moving.close()

    def test_first_frame(self):
        """A plotter whose camera was never set frames the geometry."""
        plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
        plotter.set_background("black")
        meniscus.refracted(self.pool, self.water, plotter, color="white")
        plotter.show(auto_close=False)
        self.assertGreater((plotter.screenshot(return_img=True).max(axis=2) > 100).mean(), 0.1)
        plotter.close()

    def test_positions_and_cameras(self):
        plotter = make_plotter()
        plotter.camera_position = [self.EYES[0], (0, 0, -1), (0, 0, 1)]
        expected = meniscus.refracted(self.pool, self.water, self.EYES[0])
        with self.assertWarnsRegex(RuntimeWarning, "give the plotter as eye"):
            found = meniscus.refracted(self.pool, self.water, plotter.camera)
        numpy.testing.assert_array_equal(found.points, expected.points)
        with self.assertRaisesRegex(TypeError, "color"):
            meniscus.refracted(self.pool, self.water, self.EYES[0], color="red")
        with self.assertRaisesRegex(ValueError, "all, first"):
            meniscus.refracted(self.pool, self.water, self.EYES[0], images="some")
        plotter.close()

    def test_volumes_under_water(self):
        """surfaces= of add_to() is the mapper's membrane."""
        plotter = make_plotter()
        volume = meniscus.add_to(make_cube(), plotter, "y", surfaces=self.water, indices=1.5)
        self.assertEqual(volume.mapper.GetNumberOfMembranes(), 1)
        self.assertEqual(volume.mapper.GetInteriorIndexOfRefraction(), 1.5)
        plotter.close()


# Runs the examples of a page, with mesh.meniscus also before PyVista 0.48, and without windows.
RUN_PAGE = """
import sys
sys.path.insert(0, %r)
import pyvista
import RunBlocks
from meniscus.api import accessor
if not hasattr(pyvista, "register_dataset_accessor"):
    pyvista.DataSet.meniscus = property(accessor.MeniscusAccessor)
pyvista.OFF_SCREEN = True
sys.argv[1:] = %r
RunBlocks.main()
"""


class TestPage(unittest.TestCase):
    def test_examples(self):
        """Each example of the guide runs, and its pictures show something."""
        root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
        for language, pictures in (
                ("accessor", ["pyvista-volume.png"]),
                ("pyvista", ["pyvista-kinds.png", "pyvista-refraction.png"])):
            with tempfile.TemporaryDirectory() as folder:
                code = RUN_PAGE % (
                    os.path.join(root, "Testing", "Documentation"),
                    [os.path.join(root, "Documentation", "python.md"), language,
                     os.path.join(folder, "page"), *pictures])
                done = subprocess.run([sys.executable, "-B", "-W", "ignore", "-c", code],
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
                self.assertEqual(done.returncode, 0, done.stdout)
                self.assertIn("FINISHED", done.stdout)


class TestOldNames(unittest.TestCase):
    def test_add_volume(self):
        plotter = make_plotter()
        volume = add_volume(plotter, make_cube(), "y", blending="maximum", BlendMode=2)
        self.assertEqual(volume.mapper.blend_mode, "minimum")
        plotter.close()


if __name__ == "__main__":
    unittest.main()
