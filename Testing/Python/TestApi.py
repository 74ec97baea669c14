# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Functions of the package that need no PyVista: true positions, ray integrals, threads, errors."""
import importlib.util
import os
import pathlib
import subprocess
import sys
import unittest
import warnings
from unittest import mock

import meniscus
import numpy
from meniscus.viewer.colors import COLOR_MAPS, fill_colors, find_colors, list_colors, make_table
from TestRayIntegral import make_block
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import (
    vtkImageData, vtkMultiBlockDataSet, vtkPiecewiseFunction)
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkPointSource
from vtkmodules.vtkRenderingCore import (
    vtkCamera, vtkColorTransferFunction, vtkTexture, vtkVolumeProperty)

INDEX = 1.333
# Water in the plane z = 0, wound towards positive z.
SQUARE = (numpy.array([[-9.0, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]]),
          numpy.array([[0, 1, 2], [0, 2, 3]]))
# Far from rounding in a scene of 20.
TOLERANCE = 1e-11


def make_plane():
    source = vtkPlaneSource()
    source.SetOrigin(-9, -9, 0)
    source.SetPoint1(9, -9, 0)
    source.SetPoint2(-9, 9, 0)
    source.Update()
    return source.GetOutput()


def refract(directions, index):
    """Refracted unit vectors of unit vectors that go down through z = 0 (Snell's law)."""
    sideways = directions[:, :2] / index
    return numpy.column_stack([sideways, -numpy.sqrt(1 - (sideways ** 2).sum(axis=1))])


def see(eye, points):
    """Sight points in z = 0 of points below it, by bisection of Snell's law in the plane of each
    ray."""
    offsets = points[:, :2] - eye[:2]
    far = numpy.hypot(*offsets.T)
    low, high = numpy.zeros(len(points)), far.copy()
    for _ in range(200):
        middle = (low + high) / 2
        incoming = middle / numpy.hypot(middle, eye[2])
        refracted = (far - middle) / numpy.hypot(far - middle, points[:, 2])
        low = numpy.where(incoming < INDEX * refracted, middle, low)
        high = numpy.where(incoming < INDEX * refracted, high, middle)
    places = eye[:2] + offsets * (low / far)[:, None]
    return numpy.column_stack([places, numpy.zeros(len(points))])


class TestTruePositions(unittest.TestCase):
    def setUp(self):
        random = numpy.random.default_rng(1)
        self.seen = random.uniform((-4, -4, -3), (4, 4, -0.1), (50, 3))
        self.eyes = random.uniform((-2, -2, 1), (2, 2, 4), (50, 3))

    def expected(self, eyes, depth):
        directions = self.seen - eyes
        lengths = numpy.linalg.norm(directions, axis=1)
        directions /= lengths[:, None]
        before = eyes[:, 2] / -directions[:, 2]
        factor = {"apparent": INDEX, "optical": 1 / INDEX, "geometric": 1.0}[depth]
        return (eyes + directions * before[:, None]
                + refract(directions, INDEX) * ((lengths - before) * factor)[:, None])

    def test_flat_water(self):
        for surface in (make_plane(), SQUARE, [SQUARE]):
            for depth in ("apparent", "optical", "geometric"):
                found = meniscus.true_positions(self.seen, self.eyes, surface, INDEX, depth=depth)
                numpy.testing.assert_allclose(
                    found, self.expected(self.eyes, depth), atol=TOLERANCE)
        eye = (1, 2, 3)
        numpy.testing.assert_allclose(
            meniscus.true_positions(self.seen, eye, SQUARE),
            self.expected(numpy.broadcast_to(eye, self.seen.shape), "apparent"), atol=TOLERANCE)

    def test_indices(self):
        """A number, the list of media and pairs mean the same; several surfaces add up."""
        found = [meniscus.true_positions(self.seen, self.eyes, SQUARE, indices) for indices in (
            INDEX, [INDEX], [1.0, INDEX], [(1.0, INDEX)])]
        for other in found[1:]:
            numpy.testing.assert_array_equal(other, found[0])
        lower = (SQUARE[0] - [0, 0, 0.1], SQUARE[1])
        below = numpy.array([[0, 0, -0.1 / 1.5 - 1 / INDEX]])
        for indices in ([1.5, INDEX], [1.0, 1.5, INDEX], [(1.0, 1.5), (1.5, INDEX)]):
            found = meniscus.true_positions(below, (0, 0, 2), [SQUARE, lower], indices)
            numpy.testing.assert_allclose(found, [[0, 0, -1.1]], atol=TOLERANCE)

    def test_states(self):
        points = [[0, 0, 1], [0, 0, -1], [numpy.nan, 0, 0]]
        found, states = meniscus.true_positions(points, (0, 0, 2), SQUARE, return_states=True)
        self.assertEqual(states.tolist(), [0, 1, 3])
        numpy.testing.assert_array_equal(found[0], [0, 0, 1])
        self.assertTrue(numpy.isnan(found[2]).all())
        found, states = meniscus.true_positions(
            [[5.0, 0, 1.0]], (0, 0, -1), (SQUARE[0], SQUARE[1][:, ::-1]), [INDEX, 1.0],
            return_states=True)
        self.assertEqual(states.tolist(), [2])
        self.assertTrue(numpy.isnan(found).all())

    def test_shapes(self):
        self.assertEqual(meniscus.true_positions([0, 0, -1], (0, 0, 2), SQUARE).shape, (3,))
        self.assertEqual(meniscus.true_positions(
            numpy.empty((0, 3)), (0, 0, 2), SQUARE).shape, (0, 3))
        for points, eyes, surfaces, indices, message in (
                ([[0, 1]], (0, 0, 1), SQUARE, INDEX, r"shape \(n, 3\)"),
                (self.seen, self.eyes[:3], SQUARE, INDEX, r"eyes .* \(3,\) or \(50, 3\)"),
                (self.seen, self.eyes, [SQUARE, SQUARE], INDEX, "2 surfaces need"),
                (self.seen, self.eyes, SQUARE, [1, 2, 3], "1 surfaces need"),
                (self.seen, self.eyes, SQUARE, -1, "above 0"),
                (self.seen, self.eyes, [], [], "at least one surface"),
                (self.seen, self.eyes, (SQUARE[0], SQUARE[1] + 1), 1.3, "does not exist; there"),
                (self.seen, self.eyes, (SQUARE[0], SQUARE[0][:, :2]), 1.3, r"\(m, 3\)")):
            with self.assertRaisesRegex(ValueError, message):
                meniscus.true_positions(points, eyes, surfaces, indices)
        with self.assertRaisesRegex(ValueError, "apparent, optical, geometric"):
            meniscus.true_positions(self.seen, self.eyes, SQUARE, depth="true")
        with self.assertRaisesRegex(TypeError, "pair of arrays"):
            meniscus.true_positions(self.seen, self.eyes, 3.0)

    def test_surface_upside_down(self):
        with self.assertWarnsRegex(RuntimeWarning, "faces an eye"):
            meniscus.true_positions(self.seen, (0, 0, 2), (SQUARE[0], SQUARE[1][:, ::-1]))


class TestTriangulate(unittest.TestCase):
    def setUp(self):
        random = numpy.random.default_rng(2)
        self.truth = random.uniform((-3, -3, -4), (3, 3, -1), (20, 3))
        self.eyes = numpy.array([[-2.0, 0, 3], [2, 0, 3], [0, 2.5, 4]])
        self.seen = numpy.stack([see(eye, self.truth) for eye in self.eyes])

    def test_cameras(self):
        found = meniscus.triangulate(self.seen, self.eyes, SQUARE, INDEX)
        numpy.testing.assert_allclose(found, self.truth, atol=1e-10)
        details = meniscus.triangulate(self.seen, self.eyes, SQUARE, INDEX, details=True)
        numpy.testing.assert_array_equal(details.positions, found)
        self.assertEqual(details.rays.tolist(), [3] * 20)
        self.assertEqual(details.states.tolist(), [0] * 20)
        self.assertLess(details.residuals.max(), 1e-10)
        self.assertGreater(details.angles.min(), 5.0)

    def test_points_that_cameras_miss(self):
        self.seen[:2, 4] = numpy.nan
        self.seen[0, 5] = numpy.nan
        found = meniscus.triangulate(self.seen, self.eyes, SQUARE, INDEX)
        self.assertTrue(numpy.isnan(found[4]).all())
        numpy.testing.assert_allclose(found[5], self.truth[5], atol=1e-9)

    def test_observations(self):
        ids = numpy.repeat([[7], [3]], 3, axis=1).T.ravel()
        points = self.seen[:, :2].reshape(-1, 3)
        found = meniscus.triangulate(
            points, numpy.repeat(self.eyes, 2, axis=0), SQUARE, ids=ids, details=True)
        self.assertEqual(found.ids.tolist(), [3, 7])
        numpy.testing.assert_allclose(found.positions, self.truth[[1, 0]], atol=1e-10)

    def test_shapes(self):
        for eyes, named, message in (
                (self.eyes[:2], {}, r"\(cameras, n, 3\)"),
                (self.eyes, {"ids": [0, 1, 2]}, r"shape \(n, 3\)")):
            with self.assertRaisesRegex(ValueError, message):
                meniscus.triangulate(self.seen, eyes, SQUARE, **named)
        with self.assertRaisesRegex(ValueError, "whole numbers"):
            meniscus.triangulate(self.seen[0], self.seen[0] + 1, SQUARE, ids=numpy.zeros(20))
        for details in (False, True):
            found = meniscus.triangulate(
                numpy.empty((3, 0, 3)), self.eyes, SQUARE, details=details)
            self.assertEqual((found.positions if details else found).shape, (0, 3))


class TestRays(unittest.TestCase):
    def setUp(self):
        self.block = make_block()  # 1 + z over [0, 2] x [0, 1] x [0, 3]

    def test_integral(self):
        numpy.testing.assert_allclose(
            meniscus.integral(self.block, "density", size=(4, 2)), numpy.full((2, 4), 7.5),
            rtol=1e-6)
        found = meniscus.integral(self.block, "density", ["path_length", "maximum_depth"],
                                  size=(4, 2), direction=(0, -1, 0), up=(1, 0, 0))
        self.assertAlmostEqual(found["path_length"][0, 1], 1.0, 6)
        self.assertEqual(sorted(found), ["maximum_depth", "path_length"])
        with self.assertRaisesRegex(ValueError, "known are integral, path_length, optical_depth"):
            meniscus.integral(self.block, "density", "sum")

    def test_refracted_rays(self):
        """Rays straight down are not refracted, and rays through a pane keep their direction."""
        water = (SQUARE[0] + [0, 0, 5], SQUARE[1])
        numpy.testing.assert_allclose(
            meniscus.integral(self.block, "density", size=(4, 2), surfaces=water), 7.5, rtol=1e-6)

    def test_schlieren(self):
        """Along z, the gradient does not deflect; across it, by (dn/dz) / n times the length."""
        options = {"GladstoneDale": 1e-4, "size": (6, 4)}
        along = meniscus.schlieren(self.block, "density", "deflection", **options)
        self.assertEqual(along.shape, (4, 6, 2))
        numpy.testing.assert_allclose(along, 0.0, atol=1e-7)
        found = meniscus.schlieren(self.block, "density", ["deflection", "schlieren"],
                                   direction=(0, -1, 0), up=(0, 0, 1), **options)
        numpy.testing.assert_allclose(
            found["deflection"][1, 3], [0, 1e-4], rtol=1e-3, atol=1e-7)
        self.assertGreater(found["schlieren"][1, 3], 0.9)
        vectors = numpy_to_vtk(numpy.ones((self.block.GetNumberOfPoints(), 3)), deep=True)
        vectors.SetName("U")
        self.block.GetPointData().AddArray(vectors)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, self.block)
        for mesh in (self.block, blocks):
            with self.assertRaisesRegex(ValueError, "'U' has 3 components; a density is one"):
                meniscus.schlieren(mesh, "U", **options)
        background = numpy.arange(24.0).reshape(4, 6)
        seen = meniscus.schlieren(self.block, "density", "background", background=background,
                                  **options)
        numpy.testing.assert_allclose(seen, background, atol=1e-3)
        for wrong in ({"image": "photo"}, {"quantity": "mass"}, {"image": "background"},
                      {"Wavelength": 0.0}):
            with self.assertRaises(ValueError):
                meniscus.schlieren(self.block, "density", **wrong)

    def test_mirage(self):
        """Along -y, (dn/dz) / n bends a ray over the length 1 of the block, and as far again
        behind it, where a wall is; second order is below the tolerance."""
        constant = 1e-3
        wall = vtkPlaneSource()
        wall.SetOrigin(-1, -1, -1)
        wall.SetPoint1(3, -1, -1)
        wall.SetPoint2(-1, -1, 4)
        options = {"GladstoneDale": constant, "size": (6, 4), "direction": (0, -1, 0),
                   "up": (0, 0, 1)}
        found = meniscus.mirage(self.block, wall, "density",
                                ["color", "seen", "cell_id", "position", "depth", "direction"],
                                LightDirection=(0, 1, 0), Ambient=0.25, **options)
        straight = meniscus.mirage(self.block, wall, "density", "position", BendRays=False,
                                   **options)
        index = 1 + constant * (1 + straight[1, 3, 2])
        numpy.testing.assert_allclose((found["position"] - straight)[1, 3],
                                      [0, 0, 1.5 * constant / index], atol=3 * constant ** 2)
        numpy.testing.assert_allclose(found["direction"][1, 3], [0, -1, constant / index],
                                      atol=3 * constant ** 2)
        self.assertEqual(found["color"].dtype, numpy.uint8)
        # The light falls onto the other side of the wall.
        numpy.testing.assert_array_equal(found["color"], numpy.full((4, 6, 3), 64))
        numpy.testing.assert_array_equal(found["seen"], numpy.ones((4, 6)))
        numpy.testing.assert_array_equal(found["cell_id"], numpy.zeros((4, 6)))
        self.assertEqual(found["depth"].shape, (4, 6))
        arrays = (numpy.array([[0.0, -1, 0], [2, -1, 0], [2, -1, 3]]), numpy.array([[0, 1, 2]]))
        seen = meniscus.mirage(self.block, arrays, "density", "seen", **options)
        self.assertTrue(0 < seen.sum() < seen.size)
        for wrong in ({"image": "photo"}, {"quantity": "mass"}, {"size": (0, 3)}):
            with self.assertRaises(ValueError):
                meniscus.mirage(self.block, wall, "density", **wrong)
        with self.assertRaisesRegex(TypeError, "A surface is a dataset"):
            meniscus.mirage(self.block, 3, "density")

    def test_mirage_of_a_texture(self):
        """A wall of the texture's four texels, upright in the picture."""
        wall = vtkPlaneSource()
        wall.SetOrigin(0, 0, -1)
        wall.SetPoint1(2, 0, -1)
        wall.SetPoint2(0, 1, -1)
        texels = numpy.array([[[9, 8, 7], [255, 0, 0]], [[0, 255, 0], [0, 0, 255]]], numpy.uint8)
        image = vtkImageData()
        image.SetDimensions(2, 2, 1)
        image.GetPointData().SetScalars(numpy_to_vtk(texels.reshape(-1, 3), deep=True))
        texture = vtkTexture()
        texture.SetInputData(image)
        seen = meniscus.mirage(self.block, wall, "density", texture=texture, GladstoneDale=0.0,
                               Ambient=1, size=(4, 2))
        numpy.testing.assert_array_equal(seen, numpy.repeat(texels, 2, axis=1))
        with self.assertRaisesRegex(ValueError, "no image"):
            meniscus.mirage(self.block, wall, "density", texture=vtkTexture())

    def test_mirage_of_a_volume(self):
        """A block that attenuates by its density, 1 + z over [0, 3], and emits white light."""
        look = vtkVolumeProperty()
        opacity = vtkPiecewiseFunction()
        opacity.AddPoint(0.0, 0.0)
        opacity.AddPoint(10.0, 1.0)
        look.SetScalarOpacity(opacity)
        colors = vtkColorTransferFunction()
        colors.AddRGBPoint(0.0, 1.0, 1.0, 1.0)
        look.SetColor(colors)
        options = {"size": (6, 3), "volume": look, "GladstoneDale": 0.0}
        found = meniscus.mirage(self.block, None, "density", ["rgba", "color"],
                                volume_scalars="density", BackgroundColor=(1, 1, 0), **options)
        share = 1 - numpy.exp(-0.75)
        numpy.testing.assert_allclose(found["rgba"], numpy.full((3, 6, 4), share), atol=2e-5)
        self.assertEqual(found["rgba"].dtype, numpy.float32)
        numpy.testing.assert_array_equal(found["color"][1, 3], [255, 255, round(255 * share)])
        # A wall at half of the way.
        wall = vtkPlaneSource()
        wall.SetOrigin(-1, -1, 1.5)
        wall.SetPoint1(3, -1, 1.5)
        wall.SetPoint2(-1, 4, 1.5)
        half = meniscus.mirage(self.block, wall, "density", "rgba", **options)
        numpy.testing.assert_allclose(half, 1 - numpy.exp(-0.4875), atol=2e-5)
        for wrong in ({"volume_scalars": "soot"}, {"volume": None}):
            with self.assertRaises(ValueError):
                meniscus.mirage(self.block, wall, "density", "rgba", **{**options, **wrong})
        with self.assertRaises(ValueError):
            meniscus.mirage(self.block, None, "density")

    def test_apparent(self):
        """An eye 1 before the block and a point 1 behind it: the direction in which it is seen
        takes half of the deflection back."""
        constant = 1e-3
        point = vtkPointSource()
        point.SetNumberOfPoints(1)
        point.SetRadius(0)
        point.SetCenter(1, -1, 1.5)
        eye = (1, 2, 1.5)
        seen = meniscus.apparent(point, self.block, eye, "density", GladstoneDale=constant)
        self.assertEqual(seen.GetPointData().GetArray("NumberOfImages").GetValue(0), 1)
        place = numpy.array(seen.GetPoint(0))
        numpy.testing.assert_allclose(
            place, [1, -1, 1.5 - 1.5 * constant / (1 + 2.5 * constant)], atol=3 * constant ** 2)
        camera = vtkCamera()
        camera.SetPosition(eye)
        camera.SetFocalPoint(place)
        camera.SetViewUp(0, 0, 1)
        arrays = (numpy.array([[0.0, -1, 0], [2, -1, 0], [2, -1, 3], [0, -1, 3]]),
                  numpy.array([[0, 1, 2], [0, 2, 3]]))
        # The ray of a picture in that direction ends at the point.
        position = meniscus.mirage(self.block, arrays, "density", "position", camera=camera,
                                   size=(1, 1), GladstoneDale=constant)
        numpy.testing.assert_allclose(position[0, 0], [1, -1, 1.5], atol=1e-7)
        for wrong in ({"quantity": "mass"}, {"SearchAngle": 90}):
            with self.assertRaises(ValueError):
                meniscus.apparent(point, self.block, eye, "density", **wrong)
        with self.assertRaisesRegex(TypeError, "^eye must be 3 numbers"):
            meniscus.apparent(point, self.block, (1, 2), "density")
        with self.assertRaisesRegex(TypeError, "^medium must be a dataset"):
            meniscus.apparent(point, 5, eye, "density")
        with self.assertWarnsRegex(RuntimeWarning, "1 points have no image"):
            meniscus.apparent(point, self.block, (1, -1, 1.5), "density")

    def test_zernike(self):
        """A wave front of known terms, by their formulas in Cartesian coordinates."""
        y, x = numpy.mgrid[:60, :80]
        x, y = (x - 41.0) / 25.0, (y - 29.5) / 25.0
        squares = x * x + y * y
        wave = (0.3 + 0.5 * 2 * x - 0.2 * 2 * y + 0.7 * 3 ** 0.5 * (2 * squares - 1)
                + 0.4 * 6 ** 0.5 * 2 * x * y - 0.6 * 6 ** 0.5 * (x * x - y * y)
                + 0.25 * 8 ** 0.5 * (3 * squares - 2) * y
                - 0.35 * 8 ** 0.5 * (3 * squares - 2) * x
                + 0.15 * 5 ** 0.5 * (6 * squares ** 2 - 6 * squares + 1))
        wave[squares > 1.0] = 1e6
        wave[29, 41] = numpy.nan
        found = meniscus.zernike(wave, 15, pupil=(41.0, 29.5, 25.0))
        expected = [0.3, 0.5, -0.2, 0.7, 0.4, -0.6, 0.25, -0.35, 0, 0, 0.15, 0, 0, 0, 0]
        numpy.testing.assert_allclose(found, expected, atol=1e-12)
        # The norm: without piston, the mean square in the circle, up to the size of pixels.
        inside = (squares <= 1.0) & numpy.isfinite(wave)
        self.assertAlmostEqual(numpy.var(wave[inside]), (found[1:] ** 2).sum(), delta=0.02)
        # In a mesh with a linear index: a tilt.
        path = meniscus.schlieren(self.block, "density", "optical_path_difference", size=(40, 40),
                                  direction=(0, -1, 0), up=(0, 0, 1), GladstoneDale=1e-4)
        path[path == 0.0] = numpy.nan  # rays that miss the mesh
        tilt = meniscus.zernike(path, 6)
        self.assertGreater(abs(tilt[2]), 1e-6)
        self.assertLess(abs(tilt[3:]).max(), 1e-3 * abs(tilt[2]))
        for wrong in ({"terms": 0}, {"pupil": (5, 5, 1.0)}, {"pupil": (5, 5, 0.0)}):
            with self.assertRaises(ValueError):
                meniscus.zernike(wave, **wrong)
        for name, wrong in (("terms", 2.5), ("terms", "x"), ("pupil", 0), ("pupil", (5, 5))):
            with self.assertRaisesRegex(TypeError, "^%s must be " % name):
                meniscus.zernike(wave, **{name: wrong})
        with self.assertRaisesRegex(ValueError, "^pupil must be finite"):
            meniscus.zernike(wave, pupil=(5.0, float("nan"), 4.0))
        with self.assertRaisesRegex(ValueError, "two dimensions"):
            meniscus.zernike(wave[0])

    def test_radiograph(self):
        one = meniscus.radiograph(self.block, "density", 0.1, intensity=2.0, size=(4, 2))
        numpy.testing.assert_allclose(one, numpy.full((2, 4), 2 * numpy.exp(-0.75)), rtol=1e-6)
        several = meniscus.radiograph(self.block, "density", [0.1, 0.2], size=(4, 2))
        self.assertEqual(several.shape, (2, 4, 2))
        numpy.testing.assert_allclose(several[0, 0], numpy.exp([-0.75, -1.5]), rtol=1e-6)
        self.assertEqual(meniscus.radiograph(
            self.block, "density", [0.1], size=(4, 2)).shape, (2, 4, 1))
        for attenuation, intensity in (([], 1.0), ([0.1, 0.2], [1.0])):
            with self.assertRaisesRegex(ValueError, "as many intensities or one"):
                meniscus.radiograph(self.block, "density", attenuation, intensity=intensity)
        for name, wrong in (("attenuation", float("nan")), ("attenuation", [0.1, float("inf")]),
                            ("attenuation", -0.1), ("intensity", float("nan")),
                            ("intensity", -1.0)):
            with self.assertRaisesRegex(ValueError, "^%s must be a finite number" % name):
                meniscus.radiograph(self.block, "density", **{name: wrong})
        for name, wrong in (("attenuation", "x"), ("intensity", b"x"), ("intensity", ["x"])):
            with self.assertRaisesRegex(TypeError, "^%s must be a number" % name):
                meniscus.radiograph(self.block, "density", **{name: wrong})


class TestArguments(unittest.TestCase):
    """Arguments of a wrong type are TypeErrors that name them; those of numpy are right."""

    def test_rays(self):
        block = make_block()
        for scalars in (b"density", numpy.bytes_(b"density"), pathlib.Path("density"), 0, True,
                        1.5, ["density"], {}):
            for function in (meniscus.integral, meniscus.schlieren):
                with self.assertRaisesRegex(TypeError, "^scalars must be the name of an array"):
                    function(block, scalars, size=(2, 2))
        for mesh in (None, b"mesh.vtu", "mesh.vtu", pathlib.Path("mesh.vtu"), 3, [block]):
            for function in (meniscus.integral, meniscus.schlieren):
                with self.assertRaisesRegex(TypeError, "^mesh must be a dataset, not "):
                    function(mesh, "density", size=(2, 2))
        with self.assertRaisesRegex(TypeError, r"not str \(pyvista.read\(\) reads a file\)"):
            meniscus.integral("mesh.vtu")
        for name, wrong in {"size": (None, 3, (2,), (2.5, 2), b"ab", "ab", (2, 2, 2)),
                            "direction": (None, 3, (0, 1), "abc", b"abc", (0, 1, "z")),
                            "up": (None, 3, (0, 1), "abc", b"abc", (0, 1, None))}.items():
            for value in wrong:
                for function in (meniscus.integral, meniscus.schlieren):
                    with self.assertRaisesRegex(TypeError, "^%s must be [23] " % name):
                        function(block, "density", **{name: value})
        for quantity in (None, 3, b"integral", [b"integral"], {"integral"}):
            with self.assertRaisesRegex(TypeError, "^quantity must be a name or a list of names"):
                meniscus.integral(block, "density", quantity)
        for component in (1.0, True, b"magnitude", [0], -1):
            with self.assertRaisesRegex(ValueError, "has no component"):
                meniscus.integral(block, "density", component=component)
        numpy.testing.assert_allclose(
            meniscus.integral(block, numpy.str_("density"), size=numpy.array([4, 2]),
                              direction=numpy.array([0, 0, -1], numpy.float32),
                              component=numpy.int64(0)), numpy.full((2, 4), 7.5), rtol=1e-6)

    def test_points(self):
        points = numpy.array([[0.0, 0.0, -1.0]])
        for wrong in (b"abc", "abc", pathlib.Path("abc"), object()):
            with self.assertRaisesRegex(TypeError, "^points must be an array of numbers"):
                meniscus.true_positions(wrong, (0, 0, 2), SQUARE)
            with self.assertRaisesRegex(TypeError, "^eyes must be an array of numbers"):
                meniscus.true_positions(points, wrong, SQUARE)
            with self.assertRaisesRegex(TypeError, "^indices must be "):
                meniscus.true_positions(points, (0, 0, 2), SQUARE, wrong)
            with self.assertRaisesRegex(TypeError, "^A surface is a dataset or a pair of arrays"):
                meniscus.true_positions(points, (0, 0, 2), wrong)


class TestTables(unittest.TestCase):
    def test_tables_are_those_of_the_function(self):
        """make_table() asks for all entries at once; each is the function's colour in bytes."""
        for name in COLOR_MAPS:
            function = vtkColorTransferFunction()
            fill_colors(function, name, -2.0, 6.0)
            table = make_table(function, -2.0, 6.0, 17)
            for entry in range(17):
                numpy.testing.assert_allclose(
                    table.GetTableValue(entry), [*function.GetColor(-2.0 + entry / 2), 1.0],
                    atol=0.5 / 255 + 1e-9)

    def test_without_presets(self):
        with mock.patch.dict(sys.modules, {"trame_colormaps.core.presets": None}):
            self.assertEqual(list_colors(), list(COLOR_MAPS))
            self.assertIsNone(find_colors("Cool to Warm"))

    @unittest.skipUnless(importlib.util.find_spec("trame_colormaps"), "needs trame-colormaps")
    def test_presets(self):
        from trame_colormaps.core.presets import get_preset_ctf
        for name in ("Cool to Warm", "batlow"):
            preset, colors = get_preset_ctf(name), find_colors(name)
            places = numpy.linspace(*preset.GetRange(), len(colors))
            for index in (0, 100, len(colors) - 1):
                numpy.testing.assert_allclose(colors[index], preset.GetColor(places[index]),
                                              atol=1e-12)
        names = list_colors()
        self.assertEqual(names[:len(COLOR_MAPS)], list(COLOR_MAPS))
        self.assertEqual(len(names), len(set(names)))
        self.assertIn("Cool to Warm", names)
        self.assertIsNone(find_colors("cold to lukewarm"))

    def test_slow_functions(self):
        """In CIEDE2000 space a single colour costs as much as all of a table: about 0.1 s."""
        function = vtkColorTransferFunction()
        function.SetColorSpaceToLabCIEDE2000()
        calls = []

        class Counted:
            def GetTable(self, *arguments):
                calls.append(arguments[2])
                return function.GetTable(*arguments)

        make_table(Counted(), 0.0, 1.0, 33)
        self.assertEqual(calls, [33])


class TestPackage(unittest.TestCase):
    def run_python(self, code, **variables):
        environment = {key: value for key, value in os.environ.items()
                       if key != "VTK_SMP_BACKEND_IN_USE"}
        done = subprocess.run([sys.executable, "-B", "-W", "ignore", "-c", code], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env={**environment, **variables})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def test_threads(self):
        tell = ("from vtkmodules.vtkCommonCore import vtkSMPTools; %s; import meniscus; "
                "print(vtkSMPTools.GetBackend())")
        self.assertNotEqual(self.run_python(tell % "pass"), "Sequential")
        self.assertEqual(self.run_python(tell % "vtkSMPTools.SetBackend('Sequential')"),
                         "STDThread")
        self.assertEqual(self.run_python(tell % "pass", VTK_SMP_BACKEND_IN_USE="Sequential"),
                         "Sequential")
        limit = ("from vtkmodules.vtkCommonCore import vtkSMPTools; vtkSMPTools.Initialize(1); "
                 "import meniscus; print(vtkSMPTools.GetEstimatedNumberOfThreads())")
        self.assertEqual(self.run_python(limit), "1")

    def test_missing_packages(self):
        """What needs a package says the command that installs it, and nothing else needs it."""
        code = """
import sys
sys.modules["pyvista"] = None
import meniscus
print(meniscus.true_positions.__name__, meniscus.radiograph.__name__)
for name in ("plot", "add_to", "compare", "refracted"):
    try:
        getattr(meniscus, name)
    except ImportError as error:
        print(error)
"""
        lines = self.run_python(code).splitlines()
        self.assertEqual(lines[0], "true_positions radiograph")
        self.assertEqual(lines[1:], ["meniscus.%s needs the package pyvista, which is not "
                                     "installed: pip install pyvista" % name
                                     for name in ("plot", "add_to", "compare", "refracted")])

    def test_help_without_packages(self):
        """dir() lists what can be used, so that help() does not stop at what cannot."""
        code = """
import sys
for missing in %r:
    sys.modules[missing] = None
import inspect, pydoc
import meniscus
from meniscus.api import MODULES
members = dict(inspect.getmembers(meniscus))
assert "Ray casting" in pydoc.render_doc(meniscus)
for name in MODULES:
    try:
        getattr(meniscus, name)
        usable = True
    except ImportError:
        usable = False
    assert usable == (name in members), name
print(sorted(name for name in MODULES if name not in members))
"""
        with_pyvista = ["add_to", "compare", "pick", "plot", "refracted"]
        self.assertEqual(self.run_python(code % ["pyvista"]), str(with_pyvista))
        with_numpy = ["apparent", "mirage", "schlieren", "triangulate", "true_positions", "zernike"]
        self.assertEqual(self.run_python(code % ["pyvista", "numpy"]),
                         str(sorted(with_pyvista + with_numpy)))

    def test_names(self):
        names = {"radiograph", "integral", "true_positions", "triangulate"}
        if importlib.util.find_spec("pyvista"):
            names |= {"plot", "add_to", "pick", "compare", "refracted"}
        self.assertLessEqual(names, set(dir(meniscus)))
        with self.assertRaisesRegex(AttributeError, "no attribute 'plots'.*add_to, .*plot, "):
            meniscus.plots

    def test_docstrings(self):
        for name in ("true_positions", "triangulate", "integral", "radiograph"):
            function = getattr(meniscus, name)
            for argument in function.__annotations__:
                if argument != "return":
                    self.assertRegex(function.__doc__, r"\b%s\b" % argument, name)


if __name__ == "__main__":
    warnings.simplefilter("default")
    unittest.main()
