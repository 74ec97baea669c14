# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The window of the command `meniscus`: the curve of opacity under the mouse, outline, axes, edges,
files that change."""
import os
import unittest

from meniscus.viewer import curves
from meniscus.viewer.command import make_parser, make_scene
from meniscus.viewer.reading import ReadingError
from meniscus.viewer.watching import Watch
from meniscus.viewer.pictures import grab_picture
from meniscus.viewer.window import Window
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkChartsCore import vtkAxis
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from TestViewer import FolderCase, make_block, radius, write

SIZE = (400, 300)


def pixels_of(window):
    picture = grab_picture(window.window)
    return vtk_to_numpy(picture.GetPointData().GetScalars()).astype(int)


class TestCurves(unittest.TestCase):
    def test_coefficients_of_a_curve(self):
        """At each point, and between two of them, the opacity over a tenth of the diagonal is the
        curve's; from one of 8 pieces to the next it is off by less than a step of 8 bits here."""
        function = vtkPiecewiseFunction()
        curves.fill_function(function, [(0.0, 0.2), (0.5, 0.6), (1.0, 0.0)], (10.0, 20.0), True)
        for value, opacity in ((10, 0.2), (12.5, 0.4), (13.1, 0.448), (15, 0.6), (20, 0.0)):
            exponent = -function.GetValue(value) * curves.OPACITY_SHARE
            self.assertAlmostEqual(1 - 2.718281828 ** exponent, opacity, delta=1 / 256)

    def test_simplified(self):
        points = [(x, 3.0 * x * x) for x in (0.0, 0.25, 0.5, 0.75, 1.0)]
        curve = curves.simplify(points, (0.0, 1.0))
        self.assertLessEqual(len(curve), 12)
        self.assertEqual([curve[0][0], curve[-1][0]], [0.0, 1.0])
        self.assertAlmostEqual(curve[-1][1], 1 - 2.718281828 ** -0.3)

    def test_wrong_points(self):
        for points in ([(0, 1)], [(0, 1), (float("nan"), 1)], [(0, 1), (1, float("inf"))]):
            with self.assertRaises(ReadingError):
                curves.check_curve(points)
        self.assertEqual(curves.check_curve([(2, -1), (0, 0.5)]), [(0.0, 0.5), (1.0, 0.0)])


class TestWindow(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = cls.write_block("mesh.vtu", radius)

    @classmethod
    def write_block(cls, name, field):
        return cls.write(name, make_block({"r": field, "z": lambda x, y, z: z}))

    @classmethod
    def write(cls, name, mesh):
        return write(vtkXMLUnstructuredGridWriter(), mesh, cls.name(name))

    @staticmethod
    def read(name):
        with open(name, "rb") as file:
            return file.read()

    def open(self, *arguments):
        window = Window(make_scene(make_parser().parse_args([self.mesh, *arguments])), SIZE,
                        offscreen=True)
        window.window.Render()
        self.addCleanup(window.close)
        return window

    def act(self, window, name, place):
        window.interactor.SetEventInformation(*place, 0, 0)
        window.interactor.InvokeEvent(name)

    def press(self, window, key):
        window.interactor.SetKeySym(key)
        window.interactor.InvokeEvent("KeyPressEvent")

    @staticmethod
    def place_of(window, value, opacity):
        """The pixel of a point of the chart."""
        place = []
        for number, coordinate in ((vtkAxis.BOTTOM, value), (vtkAxis.LEFT, opacity)):
            axis = window.chart.chart.GetAxis(number)
            side = 0 if number == vtkAxis.BOTTOM else 1
            first, last = axis.GetPoint1()[side], axis.GetPoint2()[side]
            share = (coordinate - axis.GetMinimum()) / (axis.GetMaximum() - axis.GetMinimum())
            place.append(round(first + share * (last - first)))
        return place

    def drag(self, window, start, end, button="Left"):
        self.act(window, "MouseMoveEvent", start)
        self.act(window, button + "ButtonPressEvent", start)
        self.act(window, "MouseMoveEvent", end)
        self.act(window, button + "ButtonReleaseEvent", end)

    def test_a_still_picture_is_given_up_for_an_event(self):
        window = self.open()
        for pending in (0, 1):
            # Windows without a screen have no events.
            window.window.GetEventPending = lambda pending=pending: pending
            window.window.InvokeEvent("AbortCheckEvent")
            self.assertEqual(window.window.GetAbortRender(), pending)

    def test_the_curve_is_dragged(self):
        window = self.open("--opacity", "0", "0.2", "0", "--range", "0", "2")
        scene = window.scene
        before = pixels_of(window)
        self.drag(window, self.place_of(window, 1.0, 0.2), self.place_of(window, 1.5, 0.8))
        (_, ends), (place, opacity), _ = scene.get_curve()
        self.assertEqual(ends, 0.0)
        # A pixel of the chart is 1 / 170 of its width, and 1 / 30 of its height.
        self.assertAlmostEqual(place, 0.75, delta=2 / 170)
        self.assertAlmostEqual(opacity, 0.8, delta=2 / 30)
        self.assertAlmostEqual(scene.volume.GetProperty().GetScalarOpacity().GetValue(2 * place),
                               curves.coefficient_of(opacity), places=6)
        self.assertGreater(abs(pixels_of(window) - before).max(), 20)
        self.press(window, "d")
        self.assertGreater(len(scene.get_curve()), 3)

    def test_points_are_added_and_removed(self):
        window = self.open("--opacity", "0", "0.2", "0")
        low, high = window.scene.get_range()
        place = self.place_of(window, 0.3 * high, 0.7)
        self.drag(window, place, place)
        self.assertEqual(len(window.scene.get_curve()), 4)
        self.assertAlmostEqual(window.scene.get_curve()[1][0], 0.3, delta=2 / 170)
        self.drag(window, place, place, "Middle")
        self.assertEqual(len(window.scene.get_curve()), 3)

    def test_the_strip_does_not_turn_the_mesh(self):
        window = self.open("--opacity", "0", "0.2", "0")
        camera = window.scene.renderer.GetActiveCamera()
        before = camera.GetPosition()
        self.drag(window, (200, 30), (260, 50))
        self.assertEqual(camera.GetPosition(), before)
        curve = window.scene.get_curve()
        # A drag that begins on the mesh and ends on the strip belongs to the mesh.
        self.drag(window, (200, 200), (230, 20))
        self.assertNotEqual(camera.GetPosition(), before)
        self.assertEqual(window.scene.get_curve(), curve)
        self.press(window, "t")
        before = camera.GetPosition()
        self.drag(window, (200, 30), (260, 50))
        self.assertNotEqual(camera.GetPosition(), before)

    def test_the_slider_of_density(self):
        """It stands above the strip, and at the bottom without it."""
        window = self.open("--density", "2")
        for bottom in (round(0.24 * SIZE[1]), 0):
            y = bottom + round(0.09 * SIZE[1])
            left, right = 0.1 * SIZE[0], 0.35 * SIZE[0]
            # Its middle is the factor 1 and its ends 1/100 and 100.
            place = left + (0.5 + 0.25 * window._density.GetValue()) * (right - left)
            self.drag(window, (round(place), y), (round(right), y))
            self.assertGreater(window.scene.density, 30)
            window.scene.set_density(1.0)
            window._density.SetValue(0.0)
            self.press(window, "t")

    def test_each_kind_of_mode_has_its_curve(self):
        window = self.open()
        scene = window.scene
        scene.set_curve([(0.0, 0.0), (0.5, 1.0), (1.0, 0.0)])
        scene.set_blend("maximum")
        self.assertEqual(scene.get_curve(), [(0.0, 0.0), (1.0, 1.0)])
        scene.set_curve([(0.0, 1.0), (1.0, 0.25)])
        low, high = scene.get_range()
        self.assertAlmostEqual(scene.volume.GetProperty().GetScalarOpacity().GetValue(high), 0.25)
        scene.set_blend("composite")
        self.assertEqual(len(scene.get_curve()), 3)

    def test_the_histogram_is_the_volume(self):
        scene = self.open("--array", "z").scene
        volumes = scene.get_histogram()
        self.assertAlmostEqual(volumes.sum(), 8.0)
        # The part of the cube below a quarter of its height.
        self.assertAlmostEqual(volumes[:volumes.size // 4].sum(), 2.0, delta=0.1)

    def test_outline_axes_edges(self):
        window = self.open()
        plain = pixels_of(window)
        for key in "oge":
            self.press(window, key)
            shown = pixels_of(window)
            self.assertGreater(abs(shown - plain).max(), 20, key)
            self.press(window, key)
            self.assertEqual(abs(pixels_of(window) - plain).max(), 0, key)

    def test_edges_are_cut(self):
        window = self.open("--edges", "--opacity", "0", "0", "0")
        whole = pixels_of(window)
        window.scene.set_clip("x", 0.9)
        self.assertLess((abs(pixels_of(window) - whole).max(axis=1) > 20).sum(), whole.shape[0])
        edges = window.scene.furniture._props["edges"].GetMapper()
        self.assertEqual(edges.GetClippingPlanes().GetNumberOfItems(), 1)
        window.scene.set_clip(None)
        self.assertEqual(abs(pixels_of(window) - whole).max(), 0)

    def test_files_that_change(self):
        """They are read again when they are complete; view, array and curve stay."""
        name = self.write_block("changing.vtu", radius)
        scene = make_scene(make_parser().parse_args([name, "--array", "r", "--clip", "x"]))
        window = Window(scene, SIZE, offscreen=True, watch=Watch(scene, period=0.0))
        self.addCleanup(window.close)
        scene.renderer.GetActiveCamera().Azimuth(20)
        place = scene.renderer.GetActiveCamera().GetPosition()
        window.window.Render()
        before = pixels_of(window)
        window.look()
        self.assertEqual(abs(pixels_of(window) - before).max(), 0)

        points = vtkUnstructuredGrid()
        points.SetPoints(scene.data.GetPoints())
        data = scene.data
        content = self.read(self.write_block("moved.vtu", lambda x, y, z: radius(x - 0.7, y, z)))
        for unusable, message in (
                (content[:len(content) // 2], "changing.vtu"), (b"", "changing.vtu"),
                (b"\0\xff<VTKFile" * 1000, "changing.vtu"),
                (self.read(self.write("points.vtu", points)), "no cells"),
                (self.read(self.write("other.vtu", make_block({"q": radius}))),
                 "no array 'r'; it has q")):
            with open(name, "wb") as file:
                file.write(unusable)
            window.look()
            self.assertRegex(window.message.GetInput(), message + ".*read again when it changes")
            self.assertIs(scene.data, data)
        os.remove(name)
        window.look()
        self.assertIs(scene.data, data)
        with open(name, "wb") as file:
            file.write(content)
        window.look()
        self.assertIsNot(scene.data, data)
        self.assertIn("(h: help)", window.message.GetInput())
        self.assertGreater(abs(pixels_of(window) - before).max(), 20)
        self.assertEqual(scene.renderer.GetActiveCamera().GetPosition(), place)
        self.assertEqual((scene.array, scene.clip_axis), ("r", "x"))

    def test_a_file_that_is_being_written(self):
        name = self.write_block("growing.vtu", radius)
        scene = make_scene(make_parser().parse_args([name]))
        watch = Watch(scene, period=60.0)
        os.utime(name, (1, 1))
        self.assertIsNone(watch.reload())


if __name__ == "__main__":
    unittest.main()
