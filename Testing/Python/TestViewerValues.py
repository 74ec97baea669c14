# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Values of any size, names of any length, and time steps that differ, by the command's scene."""
import os
import struct
import tempfile
import unittest

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_LAGRANGE_TETRAHEDRON, vtkImageData, vtkMultiBlockDataSet, vtkUnstructuredGrid)
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataWriter, vtkXMLUniformGridAMRWriter, vtkXMLUnstructuredGridWriter)
from vtkmodules.vtkRenderingCore import vtkRenderer

from meniscus.viewer.command import make_parser, make_scene
from meniscus.viewer.levels import find_reach
from meniscus.viewer.pictures import draw_picture, make_window
from meniscus.viewer.reading import MeshSeries, ReadingError
from meniscus.viewer.scene import LONGEST_NAME, MeshScene
from meniscus.viewer.shown import Shown, choose_of_range

from RefinedGrid import make_refined_grid

SIDE = 4
# Whole numbers from 0 to 16 at the points, no two differences alike.
STEPS = numpy.array([(5 * x * x + 3 * y + 7 * x * z + 2 * z * z) % 17
                     for z in range(SIDE) for y in range(SIDE) for x in range(SIDE)])
# One step of 8 bits: functions and rays round in other places.
ROUNDING = 1


# An X server without a client starts anew, and refuses others meanwhile.
KEPT = []


def setUpModule():
    KEPT.append(make_window(vtkRenderer(), (8, 8), offscreen=True))
    KEPT[0].Render()


def make_image(values, name="T", cells=False, origin=0.0):
    image = vtkImageData()
    image.SetDimensions(SIDE, SIDE, SIDE)
    image.SetOrigin(origin, 0.0, 0.0)
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    (image.GetCellData() if cells else image.GetPointData()).AddArray(array)
    return image


class Steps:
    """Time steps in the memory, as a MeshSeries."""

    def __init__(self, *steps):
        self.steps = steps

    def get_times(self):
        return list(range(len(self.steps)))

    def read(self, step):
        return self.steps[step]


def write_netcdf(name, values, fill):
    """A netCDF file, of the classic format, with one variable T(z, y, x) and a fill value."""
    def text(string):
        return struct.pack(">i", len(string)) + string + b"\0" * (-len(string) % 4)

    sizes = values.shape
    start = b"CDF\x01" + struct.pack(">iii", 0, 10, 3)
    start += b"".join(text(axis) + struct.pack(">i", size) for axis, size in zip((
        b"z", b"y", b"x"), sizes))
    start += struct.pack(">iiii", 0, 0, 11, 1) + text(b"T") + struct.pack(">iiii", 3, 0, 1, 2)
    start += struct.pack(">ii", 12, 1) + text(b"_FillValue") + struct.pack(">iid", 6, 1, fill)
    start += struct.pack(">iii", 6, 8 * values.size, len(start) + 12)
    with open(name, "wb") as file:
        file.write(start + values.astype(">f8").tobytes())


def draw(scene):
    scene.bar.VisibilityOff()
    picture, warnings = draw_picture(scene, (96, 80))
    if warnings:
        raise AssertionError(warnings)
    return vtk_to_numpy(picture.GetPointData().GetScalars()).astype(int)


def make(*steps, **arguments):
    scene = MeshScene(Steps(*steps), **arguments)
    scene.reset_camera()
    return scene


class Values(unittest.TestCase):
    def expect_same(self, first, second):
        self.assertLessEqual(abs(draw(first) - draw(second)).max(), ROUNDING)

    def test_values_of_any_size(self):
        """Each field is a multiple of STEPS plus a number, without rounding; so is its picture."""
        smallest = numpy.nextafter(0.0, 1.0)
        for name, values in (
                ("1e15", 1e15 + 0.125 * STEPS),
                ("-1e15", -1e15 - 0.125 * (16 - STEPS)),
                ("1e300", 1e300 + numpy.spacing(1e300) * STEPS),
                ("denormal", 200 * smallest * STEPS),
                ("small", 1e-305 * STEPS),
                ("all numbers", (STEPS - 8) * 0.125 * 1.7e308),
                ("huge", 1e307 * STEPS),
                ("odd", 2 ** 53 + 1 + 2 * STEPS.astype(numpy.int64)),
                ("negative", -2 ** 63 + STEPS.astype(numpy.int64)),
                ("without a sign", numpy.uint64(2 ** 64 - 20) + STEPS.astype(numpy.uint64)),
                ("float", (16777216 + STEPS).astype(numpy.float64))):
            with self.subTest(name=name), numpy.errstate(over="raise", invalid="raise"):
                plain = make(make_image(STEPS.astype(float)))
                self.assertTrue(plain.shown.is_plain())
                self.expect_same(make(make_image(values)), plain)

    def test_cells_magnitudes_and_blocks(self):
        cells = STEPS[:(SIDE - 1) ** 3]
        self.expect_same(make(make_image(1e15 + 0.125 * cells, cells=True)),
                         make(make_image(0.125 * cells, cells=True)))
        vectors = numpy.zeros((STEPS.size, 3))
        vectors[:, 1] = 1e15 + 0.125 * STEPS
        self.expect_same(make(make_image(vectors)), make(make_image(0.125 * STEPS)))
        blocks = [vtkMultiBlockDataSet(), vtkMultiBlockDataSet()]
        for data, offset in zip(blocks, (1e15, 0.0)):
            for index in range(2):
                data.SetBlock(index, make_image(offset + 0.125 * (STEPS + index),
                                                origin=index * (SIDE - 1.0)))
        self.expect_same(*map(make, blocks))

    def test_blocks_with_other_components(self):
        """A number is shown beside vectors, whatever the order of the blocks."""
        vectors = numpy.zeros((STEPS.size, 3))
        vectors[:, 1] = STEPS
        parts = [make_image(-1.0 - STEPS, origin=SIDE - 1.0), make_image(vectors)]
        for order in (parts, parts[::-1]):
            blocks = vtkMultiBlockDataSet()
            for part in order:
                blocks.SetBlock(blocks.GetNumberOfBlocks(), part)
            scene = make(blocks)
            self.assertEqual(scene.get_range(), (-17.0, 16.0))
            self.assertEqual(scene.mapper.GetVectorMode(), scene.mapper.MAGNITUDE)

    def test_refined_grids(self):
        """A file of an AMR grid is read with all levels; finer cells take the place of coarse."""
        grid = make_refined_grid(((0, 3), (2, 5), (6, 9)))
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        writer = vtkXMLUniformGridAMRWriter()
        writer.SetFileName(os.path.join(folder.name, "grid.vthb"))
        writer.SetInputData(grid)
        writer.Write()
        scene = make_scene(make_parser().parse_args([writer.GetFileName()]))
        self.assertEqual(scene.get_range(), (1.0, 3.0))
        # 64 cells of the volume 1, of which finer ones replace 8, and these in turn.
        self.assertAlmostEqual(scene.levels.volume, 64.0)
        draw(scene)

    def test_isosurfaces_and_ranges_are_of_the_values(self):
        shifted = make(make_image(1e15 + 0.125 * STEPS), limits=(1e15 + 0.25, 1e15 + 1.0))
        plain = make(make_image(0.125 * STEPS), limits=(0.25, 1.0))
        self.assertEqual(shifted.get_range(), (0.25, 1.0))
        self.expect_same(shifted, plain)
        shifted.set_isovalues([1e15 + 0.5])
        plain.set_isovalues([0.5])
        self.expect_same(shifted, plain)

    def test_the_legend_says_what_is_shown(self):
        scene = make(make_image(1e15 + 0.125 * STEPS))
        scene.set_units("m", "K")
        self.assertEqual(scene.bar.GetTitle(), "T - 1e+15 (K)")
        self.assertEqual(scene.bar.GetLookupTable().GetRange(), (0.0, 2.0))
        scene = make(make_image(numpy.maximum(0.125 * STEPS, 2.4e-23)))
        self.assertEqual(scene.get_range(), (2.4e-23, 2.0))
        self.assertEqual(scene.bar.GetLookupTable().GetRange(), (0.0, 2.0))
        for low, high, whole, name in (
                (0.0, 1.0, False, "T"), (300.0, 300.001, False, "T"), (7.0, 7.0, False, "T"),
                (-1e308, 1e308, False, "T / 1e+300"), (0.0, 1e-320, False, "T / 1e-300"),
                (-1e15, -1e15 + 2, False, "T + 1e+15"), (2 ** 53, 2 ** 53 + 4, True,
                                                         "T - 9007199254740990"),
                (-2 ** 63, -2 ** 63 + 4, True, "T + 9223372036854775810")):
            with self.subTest(low=low, high=high):
                self.assertEqual(choose_of_range(low, high, whole).name_of("T"), name)
        self.assertEqual(Shown(3, 2.0).number_of(5.0), 4.0)

    def test_long_names(self):
        for name in ("T" * 5000, "a\nb" * 50, " " * 99 + "x" * 99):
            with self.subTest(name=name[:9]):
                scene = make(make_image(STEPS.astype(float), name))
                self.assertLessEqual(len(scene.bar.GetTitle()), LONGEST_NAME)
                self.assertIn("...", scene.bar.GetTitle())
                self.assertNotIn("\n", scene.bar.GetTitle())
                scene.set_array(name)  # it is not renamed


class Shapes(unittest.TestCase):
    """Meshes of which little or nothing is seen."""

    def test_reach(self):
        cube = 3 ** -0.5
        for size, volume, reach in (
                ((2, 2, 2), 8, cube), ((2, 2, 2), 4 * numpy.pi / 3, cube), ((1, 1, 4), 4, cube),
                ((1, 1, 1e-3), 1e-3, 6e-3 / 1.002 / 2 ** 0.5), ((1, 1, 1), 1e-3, 2e-3 * cube),
                ((1, 1, 0), 0, cube), ((1e200, 1e200, 1e200), numpy.inf, cube)):
            with self.subTest(size=size):
                bounds = [end for length in size for end in (5.0, 5.0 + length)]
                self.assertAlmostEqual(find_reach(bounds, volume), reach, delta=1e-5 * reach)

    def test_thin_plates(self):
        """A plate is seen from its front, however thin it is."""
        pictures = []
        for thickness in (1.0, 1e-2, 1e-3, 1e-4):
            image = make_image(STEPS.astype(float))
            image.SetSpacing(1.0, 1.0, thickness / (SIDE - 1))
            scene = make(image)
            scene.reset_camera((0.0, 0.0, 1.0))
            pictures.append(draw(scene))
        for picture in pictures[1:]:
            self.assertLess(abs(picture - pictures[1]).max(), 4)
        self.assertGreater(numpy.ptp(pictures[1]), 60)

    def test_reasons_of_empty_pictures(self):
        flat = make_image(STEPS.astype(float))
        flat.SetSpacing(1.0, 0.0, 1.0)
        wrong, points = vtkUnstructuredGrid(), vtkPoints()
        for place in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, 0, 1), (0, 1, 1)):
            points.InsertNextPoint(place)
        wrong.SetPoints(points)
        wrong.InsertNextCell(VTK_LAGRANGE_TETRAHEDRON, 7, range(7))
        array = numpy_to_vtk(numpy.arange(7.0), deep=True)
        array.SetName("T")
        wrong.GetPointData().AddArray(array)
        for data, reason in ((flat, "the mesh is flat: it has no extent along y"),
                             (wrong, "1 with a number of points that their type does not have")):
            with self.subTest(reason=reason), self.assertRaisesRegex(ReadingError, reason):
                draw(make(data))

    def test_cells_without_finite_values(self):
        rows = numpy.where(numpy.arange(STEPS.size) // SIDE % 2 == 1, numpy.nan, STEPS)
        other = numpy_to_vtk(numpy.zeros(STEPS.size), deep=True)
        other.SetName("p")
        for values, cells, message in (
                (rows, False, "No cell has finite values of the array 'T' at all of its points"),
                (numpy.full((SIDE - 1) ** 3, numpy.inf), True,
                 "The array 'T' has no finite values")):
            image = make_image(values, cells=cells)
            with self.subTest(message=message), self.assertRaisesRegex(ReadingError, message + "$"):
                make(image)
            image.GetPointData().AddArray(other)
            with self.assertRaisesRegex(ReadingError, message + "; there are also p$"):
                make(image, array="T")

    def test_fill_values(self):
        """Values that a netCDF file has filled in are no values."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        name = os.path.join(folder.name, "sea.nc")
        values = numpy.arange(64.0).reshape(4, 4, 4)
        values[0] = 9.96921e36
        write_netcdf(name, values, 9.96921e36)
        scene = make_scene(make_parser().parse_args([name]))
        self.assertEqual((scene.levels.low, scene.levels.high), (16.0, 63.0))


class TimeSteps(unittest.TestCase):
    def test_steps_and_parts_without_cells(self):
        """A step without cells is left out where another one is asked for, a part always."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        names = [os.path.join(folder.name, name) for name in ("empty.vtu", "image.vti", "all.pvd")]
        for name, writer, data in zip(
                names, (vtkXMLUnstructuredGridWriter(), vtkXMLImageDataWriter()),
                (vtkUnstructuredGrid(), make_image(STEPS.astype(float)))):
            writer.SetFileName(name)
            writer.SetInputData(data)
            writer.Write()
        scene = make_scene(make_parser().parse_args([*names[:2], "--step", "1"]))
        self.assertEqual((scene.step, scene.get_range()), (1, (0.0, 16.0)))
        with self.assertRaisesRegex(ReadingError, "The mesh has no cells"):
            make_scene(make_parser().parse_args(names[:2]))
        with open(names[2], "w") as file:
            file.write('<VTKFile type="Collection"><Collection><DataSet file="empty.vtu"/>'
                       '<DataSet file="image.vti"/></Collection></VTKFile>')
        self.assertEqual(MeshSeries(names[2:]).read(0).GetNumberOfCells(), (SIDE - 1) ** 3)

    def expect_like(self, scene, step):
        """Expects the picture of a scene of that step alone."""
        alone = make(step, array=scene.array, limits=scene.get_range())
        alone.volume.GetProperty().SetScalarOpacityUnitDistance(
            scene.volume.GetProperty().GetScalarOpacityUnitDistance())
        alone.levels = scene.levels
        alone.set_curve(None)
        scene.reset_camera()
        self.assertEqual(abs(draw(scene) - draw(alone)).max(), 0)

    def test_an_array_that_moves_to_cells(self):
        steps = (make_image(STEPS.astype(float)),
                 make_image(STEPS[:(SIDE - 1) ** 3].astype(float), cells=True))
        scene = make(*steps)
        scene.set_step(1)
        self.expect_like(scene, steps[1])
        scene.set_step(0)
        self.expect_like(scene, steps[0])

    def test_an_array_with_other_components(self):
        vectors = numpy.zeros((STEPS.size, 3))
        vectors[:, 2] = -STEPS
        steps = (make_image(STEPS.astype(float)), make_image(vectors))
        scene = make(*steps)
        scene.set_step(1)
        self.expect_like(scene, steps[1])

    def test_a_mesh_that_moves(self):
        steps = (make_image(STEPS.astype(float)), make_image(STEPS.astype(float), origin=100.0))
        scene = make(*steps)
        scene.set_step(1)
        self.assertEqual(scene.bounds[:2], (100.0, 103.0))
        self.expect_like(scene, steps[1])

    def test_arrays_that_come_and_go(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        names = []
        for index, array in enumerate("AB"):
            names.append(os.path.join(folder.name, f"{index}.vti"))
            writer = vtkXMLImageDataWriter()
            writer.SetFileName(names[-1])
            writer.SetInputData(make_image(STEPS.astype(float) + index, array))
            writer.Write()
        for step in ("1", "-1"):
            scene = make_scene(make_parser().parse_args([*names, "--array", "B", "--step", step]))
            self.assertEqual((scene.step, scene.get_range()), (1, (1.0, 17.0)))
        for options, message in ((["--array", "B"], "no array 'B'; it has A"),
                                 (["--step", "1"], "Time step 1 has no array 'A'; it has B")):
            with self.subTest(options=options), self.assertRaisesRegex(ReadingError, message):
                make_scene(make_parser().parse_args([*names, *options]))


if __name__ == "__main__":
    unittest.main()
