# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""meniscus.pyvista.add_volume compared with PyVista's own add_volume on the same image data:
legends, names, removal and pictures. Skipped without PyVista.

The exit status is then 125, which CTest counts as skipped.
"""
import sys
import unittest

try:
    import pyvista
except ImportError:
    print("skipped: no pyvista")
    sys.exit(125)

import meniscus
import numpy
from meniscus.pyvista import add_volume

SIZE = (300, 200)
CELLS = 12


def make_image(shift=0.0):
    image = pyvista.ImageData(dimensions=(CELLS + 1,) * 3, origin=(shift, 0.0, 0.0))
    height = image.points[:, 2].astype(float)
    image["height"] = height
    image["depth"] = 20.0 - 2.0 * height
    image["decades"] = 10.0 ** (height / 4.0)
    return image


FIRST, SECOND = make_image(), make_image(1.5 * CELLS)


def add_own(plotter, mesh, scalars=None, **named):
    return plotter.add_volume(mesh, scalars=scalars, opacity_unit_distance=1.0, **named)


def add_ours(plotter, mesh, scalars=None, **named):
    return add_volume(plotter, mesh, scalars, opacity_unit_distance=1.0, **named)


# Scenes, as functions of a plotter and a function that adds a volume.

def one_volume(plotter, add):
    add(plotter, FIRST, "height", opacity=[0.0, 0.3])


def limits(plotter, add):
    add(plotter, FIRST, "height", clim=(3.0, 8.0), cmap="coolwarm", opacity=[0.0, 0.3])


def symmetric_limits(plotter, add):
    add(plotter, FIRST, "height", clim=9, opacity=[0.0, 0.3])


def shared_bar(plotter, add):
    add(plotter, FIRST, "height", clim=(3.0, 8.0), cmap="coolwarm", opacity=[0.0, 0.3])
    add(plotter, SECOND, "height", clim=(0.0, 5.0), cmap="viridis", opacity=[0.3, 0.0])


def two_arrays(plotter, add):
    add(plotter, FIRST, "height", opacity=[0.0, 0.3])
    add(plotter, SECOND, "depth", cmap="bone", opacity=[0.3, 0.0])


def log_scale(plotter, add):
    add(plotter, FIRST, "decades", log_scale=True, opacity=[0.1, 0.3])


def log_scale_from_zero(plotter, add):
    add(plotter, FIRST, "height", log_scale=True, clim=(0.0, 8.0), opacity=[0.1, 0.3])


def four_components(plotter, add):
    """Four components of uint8 are colours without being asked for."""
    image = FIRST.copy()
    heights = 20 * image["height"].astype(numpy.uint8)
    opacities = numpy.full_like(heights, 60)
    image["colors"] = numpy.stack([heights, 255 - heights, heights // 2, opacities], 1)
    add(plotter, image, "colors")


def table_of_the_user(plotter, add):
    table = pyvista.LookupTable("plasma", scalar_range=(2.0, 9.0), nan_color="red")
    table.apply_opacity([0.0, 0.2])
    add(plotter, FIRST, "height", cmap=table)


def bar_of_the_user(plotter, add):
    add(plotter, FIRST, "height", opacity=[0.4, 0.6], n_colors=5, flip_scalars=True,
        annotations={6.0: "half"},
        scalar_bar_args={"title": "m", "nan_annotation": True, "n_labels": 3, "vertical": True})


def no_bar(plotter, add):
    add(plotter, FIRST, "height", opacity=[0.0, 0.3], show_scalar_bar=False)


def same_name(plotter, add):
    add(plotter, FIRST, "height", name="volume", opacity=[0.0, 0.3])
    add(plotter, SECOND, "depth", name="volume", opacity=[0.0, 0.3])


def with_a_surface(plotter, add):
    """A surface and a volume of one array share a bar, too."""
    plotter.add_mesh(FIRST.slice(normal="x"), scalars="height", clim=(-4.0, 2.0))
    add(plotter, SECOND, "height", opacity=[0.0, 0.3])


def values_without_a_name(plotter, add):
    add(plotter, FIRST, FIRST["height"] * 2.0, opacity=[0.0, 0.3])


def subplots(plotter, add):
    plotter.subplot(0, 0)
    add(plotter, FIRST, "height", clim=(3.0, 8.0), opacity=[0.0, 0.3])
    plotter.subplot(0, 1)
    add(plotter, FIRST, "height", opacity=[0.0, 0.3])


# PyVista's functions have nodes at equal distances of the value, so that most of the logarithm's
# range lies between two of them; see test_logarithmic_functions of TestPyVistaFunctions.py.
LOGARITHMIC = (log_scale, log_scale_from_zero)
SCENES = (
    one_volume, limits, symmetric_limits, shared_bar, two_arrays, log_scale, log_scale_from_zero,
    table_of_the_user, bar_of_the_user, no_bar, same_name, with_a_surface, values_without_a_name,
    subplots, four_components)


def make_plotter(scene, add):
    plotter = pyvista.Plotter(
        off_screen=True, window_size=SIZE, shape=(1, 2) if scene is subplots else (1, 1))
    plotter.set_background("black")
    scene(plotter, add)
    return plotter


def bars_of(plotter):
    """All that a scalar bar shows, by title."""
    found = {}
    for title, bar in plotter.scalar_bars.items():
        table = bar.GetLookupTable()
        found[title] = {
            "title": bar.GetTitle(), "range": tuple(table.GetRange()), "log": table.GetScale(),
            "colors": [table.GetTableValue(entry)
                       for entry in range(table.GetNumberOfTableValues())],
            "nan": (table.GetNanColor(), bar.GetDrawNanAnnotation()),
            "annotations": [table.GetAnnotation(entry)
                            for entry in range(table.GetNumberOfAnnotatedValues())],
            "place": (bar.GetPosition(), bar.GetPosition2(), bar.GetOrientation()),
            "labels": bar.GetNumberOfLabels()}
    return found


def volumes_of(plotter):
    return [actor for renderer in plotter.renderers for actor in renderer.actors.values()
            if isinstance(actor, pyvista.plotting.volume.Volume)]


def picture_of(plotter):
    plotter.render()
    return plotter.screenshot(return_img=True)[:, :, :3].astype(int)


class TestPyVistaPlotters(unittest.TestCase):
    def each_scene(self, check):
        """Calls check(scene, own, ours) with the plotters of PyVista's own volumes and of ours."""
        for scene in SCENES:
            with self.subTest(scene=scene.__name__):
                own, ours = make_plotter(scene, add_own), make_plotter(scene, add_ours)
                check(scene, own, ours)
                own.close()
                ours.close()

    def test_legends(self):
        def check(scene, own, ours):
            expected = bars_of(own)
            self.assertEqual(bool(expected), scene not in (no_bar, four_components))
            self.assertEqual(bars_of(ours), expected)

        self.each_scene(check)

    def test_functions(self):
        if pyvista.version_info < (0, 45):
            self.skipTest("PyVista's functions run over the indices of table entries")

        def check(scene, own, ours):
            self.assertEqual(len(volumes_of(ours)), len(volumes_of(own)))
            if scene in LOGARITHMIC:
                return
            for expected, volume in zip(volumes_of(own), volumes_of(ours)):
                for name in ("GetRGBTransferFunction", "GetScalarOpacity"):
                    functions = [getattr(each.GetProperty(), name)()
                                 for each in (expected, volume)]
                    self.assertEqual(functions[0].GetRange(), functions[1].GetRange())
                    tables = [[], []]
                    for function, table in zip(functions, tables):
                        for node in range(function.GetSize()):
                            values = [0.0] * (4 if name == "GetScalarOpacity" else 6)
                            function.GetNodeValue(node, values)
                            table.append(values)
                    self.assertEqual(tables[0], tables[1])

        self.each_scene(check)

    def test_names(self):
        def check(scene, own, ours):
            self.assertEqual(len(ours.actors), len(own.actors))
            self.assertEqual("volume" in ours.actors, scene is same_name)

        self.each_scene(check)

    def test_pictures(self):
        def check(scene, own, ours):
            for plotter in (own, ours):
                for renderer in range(len(plotter.renderers)):
                    plotter.renderers[renderer].camera_position = [
                        (15.0, -50.0, 30.0), (15.0, 6.0, 6.0), (0.0, 0.0, 1.0)]
            pictures = [picture_of(plotter) for plotter in (own, ours)]
            inside = (pictures[0].max(axis=2) > 30) & (pictures[1].max(axis=2) > 30)
            self.assertGreater(inside.sum(), 500)
            # Up to version 0.44 PyVista maps the scalars to [0, 255].
            if pyvista.version_info >= (0, 45) and scene not in LOGARITHMIC:
                # See TestPyVista.py: PyVista samples, and its silhouette is of another extent.
                difference = abs(pictures[0] - pictures[1])[inside]
                self.assertLessEqual(numpy.percentile(difference, 75), 4)
            # Legends remain without the volumes, drawn by the same code.
            for plotter in (own, ours):
                for volume in volumes_of(plotter):
                    volume.SetVisibility(False)
            numpy.testing.assert_array_equal(*[picture_of(plotter) for plotter in (own, ours)])

        self.each_scene(check)

    def test_removal(self):
        def check(_, own, ours):
            while volumes_of(own):
                for plotter in (own, ours):
                    plotter.remove_actor(volumes_of(plotter)[0])
                self.assertEqual(bars_of(ours), bars_of(own))
                self.assertEqual(len(ours.actors), len(own.actors))
            self.assertEqual(len(volumes_of(ours)), 0)

        self.each_scene(check)

    def test_a_bar_that_changes(self):
        """plotter.update_scalar_bar_range() and changes of the table reach the volume."""
        for add in (add_own, add_ours):
            plotter = make_plotter(one_volume, add)
            volume = volumes_of(plotter)[0]
            plotter.update_scalar_bar_range((2.0, 4.0), "height")
            self.assertEqual(bars_of(plotter)["height"]["range"], (2.0, 4.0))
            look = volume.GetProperty()
            if add is add_ours or pyvista.version_info >= (0, 45):
                self.assertEqual(look.GetRGBTransferFunction().GetRange(), (2.0, 4.0))
                self.assertEqual(look.GetScalarOpacity().GetRange(), (2.0, 4.0))
            plotter.update_scalar_bar_range((1.0, 3.0))
            self.assertEqual(volume.mapper.scalar_range, (1.0, 3.0))
            volume.mapper.lookup_table.apply_opacity(0.5)
            if pyvista.version_info >= (0, 45):
                self.assertAlmostEqual(look.GetScalarOpacity().GetValue(2.0), 127 / 255, 6)
            plotter.close()

    def test_looks(self):
        for add in (add_own, add_ours):
            plotter = pyvista.Plotter(off_screen=True)
            volume = add(plotter, FIRST, "height", shade=True, ambient=0.25, diffuse=0.5,
                         specular=0.125, specular_power=3.0, blending="maximum", pickable=False,
                         user_matrix=numpy.diag([2.0, 2.0, 2.0, 1.0]))
            look = volume.prop
            self.assertEqual(
                (look.shade, look.ambient, look.diffuse, look.specular, look.specular_power,
                 volume.mapper.blend_mode, volume.GetPickable(), volume.GetUserMatrix().
                 GetElement(0, 0)), (True, 0.25, 0.5, 0.125, 3.0, "maximum", 0, 2.0))
            plotter.close()

    def test_blocks(self):
        blocks = pyvista.MultiBlock([FIRST, None, SECOND])
        for block in (FIRST, SECOND):
            block.set_active_scalars("height")
        plotters = [pyvista.Plotter(off_screen=True) for _ in range(2)]
        for plotter, add in zip(plotters, (add_own, add_ours)):
            volumes = add(plotter, blocks, name="parts", multi_colors=True)
            self.assertEqual(len(volumes), 2)
        self.assertEqual(bars_of(plotters[1]), bars_of(plotters[0]))
        self.assertEqual(len(plotters[1].actors), len(plotters[0].actors))

    def test_bad_arguments(self):
        plotter = pyvista.Plotter(off_screen=True)
        for add in (add_own, add_ours):
            with self.assertRaises(TypeError):
                add(plotter, FIRST, "height", colour="red")
            with self.assertRaises(ValueError):
                add(plotter, FIRST, "height", blending="sideways")
            with self.assertRaises(KeyError):
                add(plotter, FIRST, "width")
            self.assertEqual(len(plotter.actors), 0)
        for named, message in (({"mapper": "smart"}, "backend"),
                               ({"resolution": (1, 1, 2)}, "a mesh has its own")):
            with self.assertRaisesRegex(ValueError, message):
                add_ours(plotter, FIRST, "height", **named)
        for named, message in (({"opacitty": 0.5}, "did you mean opacity"),
                               ({"windowsize": (9, 9)}, "did you mean window_size"),
                               ({"color": "red"}, "cmap=.* draws all values in one colour$"),
                               ({"show_edges": True}, "adds the edges$"),
                               ({"xyzzy": 1}, "`$")):
            with self.assertRaisesRegex(TypeError, message):
                add_ours(plotter, FIRST, "height", **named)

    def test_properties_by_the_names_of_their_choices(self):
        mapper = add_ours(pyvista.Plotter(off_screen=True), FIRST, "height", Backend="opengl",
                          CellDivision="adaptive", Gradients="cell_gradients").mapper
        self.assertEqual(mapper.GetCellDivision(), mapper.ADAPTIVE_DIVISION)
        self.assertEqual(mapper.GetGradients(), mapper.CELL_GRADIENTS)
        self.assertEqual(mapper.GetBackend(), mapper.OPENGL)
        with self.assertRaisesRegex(ValueError, "CellDivision 'q'; known are adaptive, fixed$"):
            add_ours(pyvista.Plotter(off_screen=True), FIRST, "height", CellDivision="q")

    def test_a_warning_is_at_the_line_of_the_program(self):
        for call in (lambda: meniscus.plot(FIRST, "height", opacity=0, off_screen=True),
                     lambda: add_ours(pyvista.Plotter(off_screen=True), FIRST, "height",
                                      opacity=0)):
            with self.assertWarnsRegex(UserWarning, "can be seen") as caught:
                call()
            self.assertEqual(caught.filename, __file__)

    def test_arrays(self):
        """An array with three dimensions is a volume, with distances between its values."""
        values = numpy.random.default_rng(1).random((4, 5, 6))
        plotter = pyvista.Plotter(off_screen=True)
        own, ours = (add(plotter, values, resolution=(1, 2, 0.5)) for add in (add_own, add_ours))
        self.assertEqual(ours.bounds, own.bounds)
        for wrong, kind in (((1, 2), TypeError), ((1, 2, 0), ValueError)):
            with self.assertRaisesRegex(kind, "resolution"):
                add_ours(plotter, values, resolution=wrong)


if __name__ == "__main__":
    unittest.main()
