# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The command `meniscus`: files, transfer functions, settings, keys, pictures and messages."""
import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings
from unittest import mock

import numpy
from meniscus.threads import run_blocks
from meniscus.viewer import furniture, levels, pictures, reading
from meniscus.viewer.command import main, make_parser, make_scene
from meniscus.viewer.reading import ReadingError
from meniscus.viewer.window import Window
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkFloatArray
from vtkmodules.vtkCommonDataModel import (
    vtkImageData, vtkMultiBlockDataSet, vtkRectilinearGrid, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersExtraction import vtkExtractUnstructuredGrid
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkBYUWriter
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataWriter, vtkXMLMultiBlockDataWriter, vtkXMLPolyDataWriter,
    vtkXMLUnstructuredGridWriter)

CELLS = 16  # per axis


def make_block(fields):
    """Tetrahedra of the cube [-1, 1]^3 with the point arrays {name: function of a point}."""
    block = vtkImageData()
    block.SetDimensions(CELLS + 1, CELLS + 1, CELLS + 1)
    block.SetOrigin(-1, -1, -1)
    block.SetSpacing(2 / CELLS, 2 / CELLS, 2 / CELLS)
    for name, field in fields.items():
        array = vtkDoubleArray()
        array.SetName(name)
        for point in range(block.GetNumberOfPoints()):
            array.InsertNextValue(field(*block.GetPoint(point)))
        block.GetPointData().AddArray(array)
    tetrahedra = vtkDataSetTriangleFilter()
    tetrahedra.SetInputData(block)
    tetrahedra.Update()
    return tetrahedra.GetOutput()


def write(writer, data, name):
    writer.SetInputData(data)
    writer.SetFileName(name)
    if not writer.Write():
        raise OSError(name)
    return name


def read_picture(name):
    reader = vtkPNGReader()
    reader.SetFileName(name)
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)


def radius(x, y, z):
    return (x * x + y * y + z * z) ** 0.5


class TestBlocks(unittest.TestCase):
    def test_each_index_once(self):
        for size in (0, 1, 99, 100, 1001):
            counts = numpy.zeros(size, int)

            def count(first, last):
                counts[first:last] += 1
            run_blocks(count, size, 100)
            self.assertTrue((counts == 1).all())

    def test_exceptions_reach_the_caller(self):
        def fail(first, _last):
            if first == 200:
                raise ReadingError("block")
        with self.assertRaisesRegex(ReadingError, "block"):
            run_blocks(fail, 1000, 100)


class TestLevels(unittest.TestCase):
    def test_areas_of_spheres(self):
        found = levels.Levels(make_block({"r": radius}), "r", "points")
        width = (found.high - found.low) / levels.BINS
        quarter, half, whole = (found.areas[int((r - found.low) / width)] for r in (0.25, 0.5, 1.0))
        # Areas grow with the square of the radius. Two levels in three cross the layer of a cell's
        # width of 1/8 to either side: the mean square over it is up to (1/16)^2 / 3 above.
        self.assertAlmostEqual(half / quarter, 4, delta=0.5)
        self.assertAlmostEqual(whole / half, 4, delta=0.5)

    def test_planes_have_one_opacity(self):
        found = levels.Levels(make_block({"z": lambda x, y, z: z}), "z", "points")
        opacity = [value for _, value in found.get_opacity()]
        # Each plane crosses the same number of cells; those of a block are exact in binary.
        self.assertLess(max(opacity) - min(opacity), 1e-9 * min(opacity))
        self.assertLess(numpy.ptp(found.volumes), 1e-9)

    def test_layers_of_cells(self):
        """Eleven layers of cells have one opacity, whether or not a bin has a value of their faces,
        and whether values are rounded to single precision or not."""
        for offset, precise in (0.0, True), (300.1, True), (300.1, False):
            image = vtkImageData()
            image.SetDimensions(12, 5, 5)
            values = vtkDoubleArray() if precise else vtkFloatArray()
            values.SetName("T")
            for point in range(image.GetNumberOfPoints()):
                values.InsertNextValue(offset + image.GetPoint(point)[0])
            image.GetPointData().AddArray(values)
            found = levels.Levels(image, "T", "points")
            opacity = [value for _, value in found.get_opacity()]
            # Rounded to 2^-16, layers overlap by up to 2^-15 of 64 / 11 bins each: 2e-4 of a bin.
            # A tenth of contrast counts fully: 2e-3 of the opacity.
            bound = 1e-9 if precise else 4e-3
            self.assertLess(max(opacity) - min(opacity), bound * min(opacity), offset)
            self.assertAlmostEqual(found.volumes.sum(), 11 * 16)
            self.assertLess(numpy.ptp(found.volumes), bound * found.volumes.max())

    def test_cells_of_one_value(self):
        """Cell data in steps that are no multiple of a bin: no bin is left out."""
        image, values = vtkImageData(), vtkDoubleArray()
        image.SetDimensions(1000, 2, 2)
        values.SetName("p")
        for cell in range(image.GetNumberOfCells()):
            values.InsertNextValue(cell)
        image.GetCellData().AddArray(values)
        found = levels.Levels(image, "p", "cells")
        self.assertAlmostEqual(found.volumes.sum(), 999)
        # 15.6 steps to a bin, of which those within half a bin of an end count in it.
        self.assertLess(numpy.ptp(found.areas[1:-1]), 0.01 * found.areas[32])

    def test_mean_opacity(self):
        found = levels.Levels(make_block({"r": radius}), "r", "points")
        opacity = [value for _, value in found.get_opacity()]
        mean = sum(v * o for v, o in zip(found.volumes, opacity)) / found.volumes.sum()
        self.assertAlmostEqual(mean / 3 ** 0.5, levels.OPTICAL_DEPTH)
        self.assertAlmostEqual(found.volumes.sum(), 8.0)

    def test_isovalues_divide_the_volume(self):
        found = levels.Levels(make_block({"z": lambda x, y, z: z}), "z", "points")
        # Values are centres of bins of the width 2 / 64.
        for value, exact in zip(found.get_isovalues(), (-0.5, 0.0, 0.5)):
            self.assertAlmostEqual(value, exact, delta=1 / CELLS + 2 / levels.BINS)

    def test_constant_field(self):
        found = levels.Levels(make_block({"c": lambda *_: 3.0}), "c", "points")
        self.assertEqual((found.low, found.high), (3.0, 3.0))
        self.assertEqual(found.get_isovalues(), [3.0])
        self.assertTrue(all(value > 0 for _, value in found.get_opacity()))

    def test_boxes(self):
        """Images and rectilinear grids have the levels of the same cells one by one."""
        image, boxes = vtkImageData(), vtkRectilinearGrid()
        image.SetSpacing(0.5, 1.0, 2.0)
        for grid in (image, boxes):
            grid.SetDimensions(5, 4, 3)
        for axis, places in (("X", (0, 1, 3, 4, 9)), ("Y", (5, 4, 2, 1)), ("Z", (0, 1, 5))):
            coordinates = vtkDoubleArray()
            for place in places:
                coordinates.InsertNextValue(place)
            getattr(boxes, f"Set{axis}Coordinates")(coordinates)
        for grid in (image, boxes):
            for attributes, count in ((grid.GetPointData(), 60), (grid.GetCellData(), 24)):
                array = vtkDoubleArray()
                array.SetName("s")
                for index in range(count):
                    array.InsertNextValue((index * 37) % 61)
                attributes.AddArray(array)
            cells = vtkAppendFilter()
            cells.AddInputData(grid)
            cells.Update()
            for association in ("points", "cells"):
                found = levels.Levels(grid, "s", association)
                expected = levels.Levels(cells.GetOutput(), "s", association)
                self.assertEqual((found.low, found.high), (expected.low, expected.high))
                for ours, theirs in ((found.areas, expected.areas),
                                     (found.volumes, expected.volumes)):
                    self.assertLess(abs(ours - theirs).max(), 1e-12 * theirs.max())

    def test_cells_of_several_sizes(self):
        """Areas and volumes of cells of two types are the sums of those of either type."""
        tetrahedra, image = make_block({"z": lambda x, y, z: z}), vtkImageData()
        image.SetDimensions(5, 5, 9)
        image.SetOrigin(2, 2, -1)
        image.SetSpacing(0.25, 0.25, 0.25)
        heights = vtkDoubleArray()
        heights.SetName("z")
        for point in range(image.GetNumberOfPoints()):
            heights.InsertNextValue(image.GetPoint(point)[2])
        image.GetPointData().AddArray(heights)
        both = vtkAppendFilter()
        both.AddInputData(tetrahedra)
        both.AddInputData(image)
        both.Update()
        found, *parts = (
            levels.Levels(data, "z", "points") for data in (both.GetOutput(), tetrahedra, image))
        self.assertEqual((found.low, found.high), (-1.0, 1.0))
        for name in ("areas", "volumes"):
            ours, theirs = getattr(found, name), sum(getattr(part, name) for part in parts)
            self.assertLess(abs(ours - theirs).max(), 1e-12 * theirs.max())

    def test_values_that_are_not_finite(self):
        found = levels.Levels(
            make_block({"n": lambda x, y, z: float("nan") if x > 0 else z}), "n", "points")
        self.assertEqual((found.low, found.high), (-1.0, 1.0))


class FolderCase(unittest.TestCase):
    """Tests with a temporary folder for their files."""
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)

    @classmethod
    def name(cls, file):
        return os.path.join(cls.folder.name, file)


class TestCommand(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        block = make_block({"r": radius, "z": lambda x, y, z: z})
        cls.mesh = write(vtkXMLUnstructuredGridWriter(), block, cls.name("mesh.vtu"))
        moved = make_block({"r": lambda x, y, z: radius(x - 0.7, y, z), "z": lambda x, y, z: z})
        cls.later = write(vtkXMLUnstructuredGridWriter(), moved, cls.name("later.vtu"))
        water = vtkPlaneSource()
        water.SetOrigin(-3, 1.5, -3)
        water.SetPoint1(-3, 1.5, 3)
        water.SetPoint2(3, 1.5, -3)
        water.Update()
        cls.water = write(vtkXMLPolyDataWriter(), water.GetOutput(), cls.name("water.vtp"))

    def run_command(self, *arguments):
        """Exit status and standard error, without what VTK 9.6 does that NumPy 2.5 deprecates:
        unittest shows such warnings, the command does not."""
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors), warnings.catch_warnings():
            warnings.filterwarnings("ignore", category=DeprecationWarning, module=r"vtkmodules\.")
            status = main(list(arguments))
        return status, errors.getvalue()

    def draw(self, *arguments, size="160x120"):
        """The picture of a command."""
        picture = self.name("picture.png")
        if os.path.exists(picture):
            os.remove(picture)
        status, errors = self.run_command(*arguments, "--output", picture, "--size", size)
        self.assertEqual((status, errors), (0, ""))
        return read_picture(picture)

    def test_every_option_changes_the_picture(self):
        plain = self.draw(self.mesh)
        self.assertEqual(plain.shape, (160 * 120, 3))
        self.assertGreater(plain.max() - plain.min(), 50)
        self.assertEqual(abs(self.draw(self.mesh) - plain).max(), 0)
        for options in (["--array", "z"], ["--colors", "fire"], ["--blend", "maximum"],
                        ["--isovalues", "0.8"], ["--density", "4"], ["--light"],
                        ["--shadows"],
                        ["--clip", "x"], ["--clip", "z:0.7"], ["--range", "0.5", "1"],
                        ["--cmap", "coolwarm"], ["--opacity", "0", "1", "0"],
                        ["--view", "0", "1", "3"], ["--up", "z"], ["--water", self.water]):
            with self.subTest(options=options):
                self.assertGreater(abs(self.draw(self.mesh, *options) - plain).max(), 20)

    def test_modules_of_a_picture(self):
        """Parts of VTK for windows with widgets, charts and movies are not loaded for a picture."""
        program = ("import sys\nfrom meniscus.viewer.command import main\n"
                   "status = main(['demo', '--size', '64x48', '--output', sys.argv[1]])\n"
                   "wanted = {'vtkInteractionWidgets', 'vtkChartsCore', 'vtkFiltersVerdict'}\n"
                   "print(status, sorted(wanted & {name.split('.')[-1] for name in sys.modules}))")
        with tempfile.TemporaryDirectory() as folder:
            found = subprocess.run(
                [sys.executable, "-B", "-c", program, os.path.join(folder, "demo.png")],
                capture_output=True, text=True, check=True)
        self.assertEqual(found.stdout.splitlines()[-1], "0 []", found.stderr)

    def test_rays_at_edges(self):
        for options, distance in (([], 0.25), (["--backend", "native"], 0.25),
                                  (["--backend", "opengl"], 1), (["--web"], 1), (["--compare"], 1),
                                  (["--water", self.water], 1)):
            with self.subTest(options=options):
                scene = make_scene(make_parser().parse_args([self.mesh, *options]))
                self.assertEqual(scene.mapper.GetImageSampleDistance(), distance)

    def test_index_one_does_not_refract(self):
        # Only the border of the surface is drawn in addition: at most a line around the picture.
        through = self.draw(self.mesh, "--water", self.water, "--index", "1")
        changed = (abs(through - self.draw(self.mesh)).max(axis=1) > 2).mean()
        self.assertLess(changed, 0.05)

    def test_opacities_are_over_a_tenth_of_the_diagonal(self):
        """Through a cube of constant opacity a over a length d, 1 - (1 - a)^(2 / d) of the
        background is hidden along its side of length 2."""
        arguments = ["--opacity", "0.2", "0.2", "--view", "0", "0", "1", "--range", "-9", "-8"]
        picture = self.draw(self.mesh, *arguments)
        scene = make_scene(make_parser().parse_args([self.mesh, *arguments]))
        color = [255.0 * x for x in scene.volume.GetProperty().GetRGBTransferFunction().GetColor(0)]
        hidden = 1.0 - 0.8 ** (2.0 / (0.1 * 12.0 ** 0.5))
        middle = picture[60 * 160 + 80]
        corner = picture[60 * 160 + 2]
        for channel in range(3):
            # The background is a gradient along the height only.
            expected = hidden * color[channel] + (1.0 - hidden) * corner[channel]
            self.assertAlmostEqual(middle[channel], expected, delta=6.0)

    def test_the_mesh_of_the_package(self):
        picture = self.draw("demo")
        self.assertGreater((abs(picture - picture[0]).max(axis=1) > 20).mean(), 0.1)

    def test_the_view_fits_the_window_beside_the_legend(self):
        """The outline, whose corners are those of the mesh, reaches the borders of what the legend
        leaves in one direction at least."""
        for size in (400, 300), (700, 200), (300, 600):
            for view in ("1", "0.4", "0.3"), ("1", "0", "0"), ("-1", "2", "-3"):
                with self.subTest(size=size, view=view):
                    rows = self.draw(self.mesh, "--outline", "--view", *view,
                                     size=f"{size[0]}x{size[1]}").reshape(size[1], size[0], 3)
                    shown = abs(rows - rows[:, :1]).max(axis=2) > 12
                    beside = size[0] - min(100, size[0] // 4)
                    y, x = numpy.nonzero(shown[:, :beside])
                    margins = x.min(), y.min(), beside - x.max(), size[1] - y.max()
                    self.assertGreaterEqual(min(margins), 1)
                    shares = [2 * margin / length for margin, length in
                              zip(margins, (beside, size[1]) * 2)]
                    self.assertLess(min(shares), 0.08)

    def test_labels_differ(self):
        for low, high, digits in ((0, 1, 3), (-1.5, 1.5, 3), (300, 311, 4), (9.5, 10, 4),
                                  (4e6, 4e6 + 11, 8), (1e15, 1e15 + 2, 8), (3, 3, 3),
                                  (-1e308, 1e308, 3), (0, float("inf"), 3)):
            form = furniture.find_label_format((0, 1), (low, high))
            self.assertEqual(form, f"%.{digits}g", (low, high))
            if low < high < 1e15:
                for quarter in range(5):
                    exact = low + 0.25 * quarter * (high - low)
                    self.assertAlmostEqual(float(form % exact), exact, delta=(high - low) / 40)
        name = write(vtkXMLUnstructuredGridWriter(), make_block({"T": lambda x, *_: 305 + 5 * x}),
                     self.name("warm.vtu"))
        scene = make_scene(make_parser().parse_args([name]))
        self.assertEqual(scene.bar.GetLabelFormat(), "%.4g")

    def test_labels_of_the_legend_are_not_cut_off(self):
        for width in 400, 600, 1000:
            with self.subTest(width=width):
                rows = self.draw("demo", size=f"{width}x300").reshape(300, width, 3)
                # The background is a gradient along the height only.
                self.assertGreater(abs(rows[:, -60:] - rows[:, :1]).max(), 100)
                self.assertLess(abs(rows[:, -2:] - rows[:, :1]).max(), 4)

    def test_transparent_background(self):
        picture = self.draw(self.mesh, "--transparent")
        self.assertEqual(picture.shape[1], 4)
        self.assertEqual(picture[0, 3], 0)
        self.assertGreater(picture[60 * 160 + 70, 3], 50)

    def test_an_orbit(self):
        name = self.name("orbit.png")
        status, errors = self.run_command(self.mesh, "--output", name, "--orbit", "5", "--size",
                                          "160x120")
        self.assertEqual((status, errors), (0, ""))
        pictures = [read_picture(name.replace(".png", f"-{k:03d}.png")) for k in range(5)]
        self.assertGreater(abs(pictures[1] - pictures[0]).max(), 20)
        for picture in pictures:
            # All of the volume is seen, and the border of the picture shows the background alone,
            # which is a gradient along the height.
            rows = picture.reshape(120, 160, 3)
            self.assertLess(abs(rows[:, 1:100] - rows[:, :1])[[0, 1, -2, -1]].max(), 3)
            self.assertGreater(abs(rows[:, 1:60] - rows[:, :1]).max(), 50)
        self.assertFalse(os.path.exists(name.replace(".png", "-005.png")))
        # One picture is the one without an orbit.
        status, errors = self.run_command(self.mesh, "--output", name, "--orbit", "1", "--size",
                                          "160x120")
        self.assertEqual((status, errors), (0, ""))
        plain = self.draw(self.mesh)
        self.assertEqual(abs(read_picture(name.replace(".png", "-000.png")) - plain).max(), 0)
        status, errors = self.run_command(self.mesh, "--orbit", "3")
        self.assertEqual(status, 1)
        self.assertIn("--orbit needs", errors)

    def test_movies(self):
        try:
            import imageio  # noqa: F401
        except ImportError:
            status, errors = self.run_command(self.mesh, "--movie", self.name("turn.gif"))
            self.assertEqual(status, 1)
            self.assertIn("pip install 'imageio[ffmpeg]'", errors)
            return
        name = self.name("turn.gif")
        status, errors = self.run_command(self.mesh, "--movie", name, "--orbit", "3", "--size",
                                          "160x120")
        self.assertEqual((status, errors), (0, ""))
        self.assertGreater(os.path.getsize(name), 1000)

    def test_time_steps(self):
        first, last = self.draw(self.mesh), self.draw(self.mesh, self.later, "--step", "-1")
        self.assertGreater(abs(first - last).max(), 20)
        self.assertEqual(abs(self.draw(self.mesh, self.later) - first).max(), 0)
        collection = self.name("steps.pvd")
        with open(collection, "w") as file:
            file.write('<VTKFile type="Collection"><Collection>'
                       '<DataSet timestep="2.5" file="later.vtu"/>'
                       '<DataSet timestep="0" file="mesh.vtu"/></Collection></VTKFile>')
        self.assertEqual(abs(self.draw(collection, "--step", "1") - last).max(), 0)

    def test_parts_of_a_step(self):
        """All files of a time are one step: two halves are the whole."""
        block = reading.MeshSeries([self.mesh]).read(0)
        for number in range(2):
            half = vtkExtractUnstructuredGrid()
            half.SetInputData(block)
            half.CellClippingOn()
            count = block.GetNumberOfCells()
            half.SetCellMinimum(number * count // 2)
            half.SetCellMaximum((number + 1) * count // 2 - 1)
            half.Update()
            write(vtkXMLUnstructuredGridWriter(), half.GetOutput(), self.name(f"part{number}.vtu"))
        collection = self.name("parts.pvd")
        with open(collection, "w") as file:
            file.write('<VTKFile type="Collection"><Collection>' + "".join(
                f'<DataSet timestep="{time}" part="{part}" file="part{part}.vtu"/>'
                for time in (0, 1) for part in (0, 1)) + "</Collection></VTKFile>")
        self.assertEqual(reading.MeshSeries([collection]).get_times(), [0, 1])
        # The same cells in another order: the pictures are equal up to rounding.
        self.assertLessEqual(abs(self.draw(collection) - self.draw(self.mesh)).max(), 2)

    def test_other_data_sets(self):
        block = reading.MeshSeries([self.mesh]).read(0)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, block)
        name = write(vtkXMLMultiBlockDataWriter(), blocks, self.name("blocks.vtm"))
        # The same cells: the mapper's pictures of both are equal up to rounding.
        self.assertLessEqual(abs(self.draw(name) - self.draw(self.mesh)).max(), 2)
        image = vtkImageData()
        image.SetDimensions(5, 5, 5)
        vectors = vtkDoubleArray()
        vectors.SetName("velocity")
        vectors.SetNumberOfComponents(3)
        for point in range(image.GetNumberOfPoints()):
            vectors.InsertNextTuple(image.GetPoint(point))
        image.GetPointData().AddArray(vectors)
        name = write(vtkXMLImageDataWriter(), image, self.name("vectors.vti"))
        self.assertGreater(self.draw(name).std(), 5)

    def test_constant_field(self):
        name = write(vtkXMLUnstructuredGridWriter(), make_block({"c": lambda *_: 3.0}),
                     self.name("constant.vtu"))
        self.assertGreater(self.draw(name).std(), 5)

    def test_zoom(self):
        """Of half the size, the mesh fills half of the height, in the same place; of twice the
        size, all of it, with its borders outside."""
        ends = []
        for zoom in (), ("--zoom", "0.5"), ("--zoom", "2"):
            rows = self.draw(self.mesh, "--opacity", "1", "1", "--view", "0", "0", "1", *zoom
                             ).reshape(120, 160, 3)
            shown = abs(rows - rows[:, :1]).max(axis=2) > 20
            ends.append(numpy.flatnonzero(shown[:, 40:80].any(axis=1))[[0, -1]])
        (low, high), (half_low, half_high), twice = ends
        self.assertAlmostEqual(half_high - half_low, 0.5 * (high - low), delta=2)
        self.assertAlmostEqual(half_high + half_low, high + low, delta=2)
        self.assertEqual(list(twice), [0, 119])

    def test_view_along_the_upward_axis(self):
        for view in (("0", "1", "0"), ("0", "-2", "0")):
            scene = make_scene(make_parser().parse_args([self.mesh, "--view", *view]))
            camera = scene.renderer.GetActiveCamera()
            self.assertEqual(camera.GetViewUp(), (0, 0, 1))
            self.assertGreater(self.draw(self.mesh, "--view", *view).std(), 5)

    def test_mesh_without_arrays(self):
        """It is drawn with the same density everywhere."""
        bare = vtkUnstructuredGrid()
        bare.DeepCopy(reading.MeshSeries([self.mesh]).read(0))
        bare.GetPointData().Initialize()
        bare = write(vtkXMLUnstructuredGridWriter(), bare, self.name("bare.vtu"))
        constant = make_block({reading.UNIFORM: lambda *_: 1.0})
        constant = write(vtkXMLUnstructuredGridWriter(), constant, self.name("constant.vtu"))
        # Points or cells of one value: equal up to rounding.
        self.assertLessEqual(abs(self.draw(bare) - self.draw(constant)).max(), 2)

    def test_messages(self):
        broken = self.name("broken.vtu")
        with open(broken, "w") as file:
            file.write("<VTKFile")
        empty = vtkUnstructuredGrid()
        empty.SetPoints(reading.MeshSeries([self.mesh]).read(0).GetPoints())
        empty = write(vtkXMLUnstructuredGridWriter(), empty, self.name("empty.vtu"))
        damaged = vtkUnstructuredGrid()
        damaged.DeepCopy(reading.MeshSeries([self.mesh]).read(0))
        damaged.GetCells().GetConnectivityArray().SetComponent(7, 0, 100000)
        damaged = write(vtkXMLUnstructuredGridWriter(), damaged, self.name("damaged.vtu"))
        text = self.name("notes.txt")
        open(text, "w").close()
        noise = self.name("noise.vtk")  # VTK's message repeats bytes that are no text
        with open(noise, "wb") as file:
            file.write(b"\xff\xfe" * 100)
        for arguments, message in (
                ([self.name("absent.vtu")], "no such file"),
                ([self.folder.name], "folder"),
                ([text], "'.txt'"),
                ([broken], "broken.vtu"),
                ([noise], "noise.vtk"),
                ([empty], "no cells"),
                ([damaged], f"uses point 100000, but there are {(CELLS + 1) ** 3} points"),
                ([self.water], "no cells with a volume; its cells are: 1 Quad"),
                ([self.mesh, "--array", "q"], "has no array 'q'; it has r, z"),
                ([self.mesh, "--array", ""], "has no array ''; it has r, z"),
                ([self.mesh, "--colors", "q"], "no colour map 'q'; known are "),
                ([self.mesh, "--opacity", "0.5"], "at least two numbers"),
                ([self.mesh, "--opacity", "0", "2"], "from 0 to 1"),
                ([self.mesh, "--blend", "q"], "no blend mode 'q'; known are composite, "),
                ([self.mesh, "--backend", "q"], "no backend 'q'; known are automatic, "),
                ([self.mesh, "--density", "0"], "above 0"),
                ([self.mesh, "--range", "1", "1"], "the lower one first"),
                ([self.mesh, "--range", "nan", "1"], "the lower one first"),
                ([self.mesh, "--clip", "q"], "no axis 'q'; they are x, y and z"),
                ([self.mesh, "--clip", "x:q"], "'q' is not a number"),
                ([self.mesh, "--clip", "x:nan"], "finite"),
                ([self.mesh, "--density", "inf"], "above 0"),
                ([self.mesh, "--view", "0", "0", "0"], "no direction"),
                ([self.mesh, "--zoom", "0"], "zoom must be above 0"),
                ([self.mesh, "--zoom", "nan"], "zoom must be above 0"),
                ([self.mesh, "--step", "1"], "no time step 1; the mesh has "),
                ([self.mesh, "--isovalues", "9"], "isovalues; 'r' goes from 0 to 1.73"),
                ([self.mesh, "--blend", "maximum", "--range", "5", "6"], "the opacity is 0"),
                ([self.mesh, "--clip", "x:1"], "clipping plane"),
                ([self.mesh, "--array", "r", "--blend", "isosurface", "--clip", "z:2"],
                 "clipping plane"),
                ([self.mesh, "--water", self.name("absent.stl")], "no such file"),
                ([self.mesh, "--water", empty], "no surface"),
                ([self.mesh, "--water", self.water, "--index", "nan"], "above 0"),
                ([self.mesh, self.name("absent.vtu")], "absent.vtu: there is no such file"),
                ([self.mesh, "--output", self.name("picture.jpg")], "end in '.png'"),
                ([self.mesh, "--output", self.name("no/folder.png")], "there is no folder")):
            with self.subTest(arguments=arguments):
                if "--output" not in arguments:
                    arguments = [*arguments, "--output", self.name("none.png")]
                status, errors = self.run_command(*arguments)
                self.assertEqual(status, 1)
                self.assertIn(message, errors)
                self.assertTrue(errors.startswith("meniscus: "), errors)
                self.assertFalse(os.path.exists(self.name("none.png")))

    def test_names_in_latin_1(self):
        name = self.name("latin.vtk")
        with open(name, "wb") as file:
            file.write(b"# vtk DataFile Version 3.0\nT\nASCII\nDATASET STRUCTURED_POINTS\n"
                       b"DIMENSIONS 2 2 2\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 8\n"
                       b"SCALARS Temp\xe9rature double 1\nLOOKUP_TABLE default\n0 1 2 3 4 5 6 7\n")
        scene = make_scene(make_parser().parse_args([name, "--array", "Temp\xe9rature"]))
        self.assertEqual(scene.get_arrays(), ["Temp\xe9rature"])
        self.assertEqual(scene.get_range(), (0, 7))

    def test_surface_of_byu(self):
        """Its ending is also that of Exodus files."""
        name = self.name("ball.g")
        ball = vtkSphereSource()
        ball.Update()
        writer = vtkBYUWriter()
        writer.SetInputData(ball.GetOutput())
        writer.SetGeometryFileName(name)
        writer.Write()
        self.assertEqual(reading.read_surface(name).GetNumberOfPolys(),
                         ball.GetOutput().GetNumberOfPolys())
        status, errors = self.run_command(name, "--output", self.name("none.png"))
        self.assertEqual(status, 1)
        self.assertIn("no cells with a volume", errors)

    def test_without_a_display(self):
        display = os.environ.pop("DISPLAY", None)
        try:
            status, errors = self.run_command(self.mesh)
        finally:
            if display is not None:
                os.environ["DISPLAY"] = display
        self.assertEqual(status, 1)
        self.assertIn("--output", errors)

    def test_windows_without_a_display(self):
        def choose(minor, libraries, **variables):
            """The window that the command makes VTK 9.minor take."""
            version = mock.Mock(**{"GetVTKMajorVersion.return_value": 9,
                                   "GetVTKMinorVersion.return_value": minor})
            with mock.patch.dict(os.environ, variables, clear=True), \
                    mock.patch.object(pictures, "vtkVersion", version), \
                    mock.patch.object(pictures, "_can_load", libraries.__contains__):
                pictures._choose_headless_window()
                return os.environ.get("VTK_DEFAULT_OPENGL_WINDOW")

        egl, osmesa = "libEGL.so.1", "libOSMesa.so.8"
        self.assertEqual(choose(6, [egl, osmesa]), "vtkEGLRenderWindow")
        self.assertEqual(choose(6, [osmesa]), "vtkOSOpenGLRenderWindow")
        with self.assertRaisesRegex(reading.ReadingError, "libegl1"):
            choose(6, [])
        self.assertIsNone(choose(6, [egl], DISPLAY=":0"))
        self.assertEqual(choose(6, [egl], VTK_DEFAULT_OPENGL_WINDOW="x"), "x")
        self.assertIsNone(choose(1, [egl]))

    def test_keys(self):
        removed = shutil.copy(self.later, self.name("removed.vtu"))
        scene = make_scene(make_parser().parse_args([self.mesh, removed]))
        window = Window(scene, (160, 120), offscreen=True)
        self.addCleanup(window.close)
        window.window.Render()

        def press(key):
            window.interactor.SetKeySym(key)
            window.interactor.InvokeEvent("KeyPressEvent")

        for keys, get, value in (
                ("a", lambda: scene.array, "z"), ("a", lambda: scene.array, "r"),
                ("c", lambda: scene.colors, "inferno"), ("b", lambda: scene.blend, "maximum"),
                ("i", lambda: scene.blend, "isosurface"), ("i", lambda: scene.blend, "composite"),
                ("l", scene.is_lit, True), ("plus", lambda: scene.density, 1.25),
                ("minus", lambda: scene.density, 1.0), ("x", lambda: scene.clip_axis, "x"),
                ("greater", lambda: scene.clip_share, 0.55), ("x", lambda: scene.clip_axis, None),
                ("period", lambda: scene.step, 1), ("comma", lambda: scene.step, 0),
                ("h", window.help.GetVisibility, 1)):
            press(keys)
            self.assertEqual(get(), value, keys)
        self.assertIn("time 0 (1 of 2)", window.message.GetInput())
        window.interactor.SetEventPosition(80, 60)
        press("v")
        # The field is the distance from the centre at the vertices. Interpolated, it differs by at
        # most a cell's diameter, since distances change by no more than places.
        found = re.fullmatch(r"r ([0-9.]+) at \((.*), (.*), (.*)\), cell ([0-9]+)",
                             window.message.GetInput())
        value, x, y, z, cell = (float(group) for group in found.groups())
        self.assertAlmostEqual(radius(x, y, z), value, delta=3 ** 0.5 * 2 / CELLS)
        self.assertLess(cell, scene.data.GetNumberOfCells())
        window.interactor.SetEventPosition(0, 0)
        press("v")
        self.assertIn("Nothing", window.message.GetInput())
        # A step that cannot be read is a message in the window.
        os.remove(removed)
        press("period")
        self.assertIn("no such file", window.message.GetInput())


if __name__ == "__main__":
    unittest.main()
