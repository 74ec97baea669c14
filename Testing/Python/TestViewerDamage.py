# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Files that VTK's readers cannot cope with, and meshes of extreme sizes, by the command: each is a
message and status 1, or the right picture."""
import contextlib
import io
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkRectilinearGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

from meniscus.viewer.appended import find_fault
from meniscus.viewer.cells import check_damage
from meniscus.viewer.command import main, make_parser, make_scene
from meniscus.viewer.reading import ReadingError

POINTS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1, 2)]
CELLS = [0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10]


def _array(name, values, kind="Float64", more=""):
    return (f'<DataArray type="{kind}" Name="{name}" format="ascii" {more}>'
            + " ".join(map(str, values)) + "</DataArray>")


def make_file(scale=1.0, cells=2, kind=12, point_data=None, cell_data="", shape="Float64"):
    """Text of a .vtu of two cubes."""
    points = [scale * x for point in POINTS for x in point]
    if point_data is None:
        point_data = _array("T", [point[0] for point in POINTS])
    return (f'<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">'
            f'<UnstructuredGrid><Piece NumberOfPoints="12" NumberOfCells="{cells}">'
            f'<PointData>{point_data}</PointData><CellData>{cell_data}</CellData><Points>'
            + _array("", points, shape, 'NumberOfComponents="3"') + "</Points><Cells>"
            + _array("connectivity", CELLS, "Int64") + _array("offsets", [8, 16], "Int64")
            + _array("types", [kind] * 2, "UInt8")
            + "</Cells></Piece></UnstructuredGrid></VTKFile>")


def make_appended(encoding, compressor):
    """A .vtu of two cubes with appended data."""
    reader = vtkXMLUnstructuredGridReader()
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "mesh.vtu")
        with open(name, "w", encoding="ascii") as file:
            file.write(make_file())
        reader.SetFileName(name)
        reader.Update()
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(reader.GetOutput())
    writer.SetDataModeToAppended()
    writer.SetEncodeAppendedData(encoding == "base64")
    getattr(writer, "SetCompressorTypeTo" + compressor)()
    writer.WriteToOutputStringOn()
    writer.Write()
    text = writer.GetOutputString()
    return text if isinstance(text, bytes) else text.encode("latin-1")


def make_series(names):
    return '{"files": [%s]}' % ", ".join('{"name": %s}' % name for name in names)


class Damage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def write(self, name, text):
        name = os.path.join(self.folder, name)
        with open(name, "wb") as file:
            file.write(text if isinstance(text, bytes) else text.encode())
        return name

    def run_command(self, name, *options):
        """Status and errors of the command, which writes a picture."""
        errors = io.StringIO()
        picture = os.path.join(self.folder, "picture.png")
        with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
            status = main([name, "--size", "99x99", *options, "--output", picture])
        return status, errors.getvalue()

    def test_messages(self):
        for name, text, message in (
                ("no-faces.vtu", make_file(kind=42), "2 polyhedra have no faces"),
                ("words.vtu", make_file(shape="String"), "no cells"),
                ("ghosts.vtu", make_file(cell_data=_array(
                    "vtkGhostType", [0] * 4, "UInt8", 'NumberOfComponents="2"')), "2 components"),
                ("encoding.pvd", '<?xml version="1.0" encoding="klingon"?><VTKFile/>',
                 "unknown encoding"),
                ("deep.series", "[" * 100000, "too deeply"),
                ("list.series", make_series(["[1]"]), "no list 'files' of names"),
                ("number.series", make_series(["7"]), "no list 'files' of names"),
                ("time.series", '{"files": [{"name": "a.vtu", "time": 1%s}]}' % ("0" * 400),
                 "is not a number")):
            with self.subTest(name=name):
                status, errors = self.run_command(self.write(name, text))
                self.assertEqual(status, 1)
                self.assertTrue(errors.startswith("meniscus: "), errors)
                self.assertIn(message, errors)

    @unittest.skipUnless(hasattr(os, "mkfifo"), "needs pipes")
    def test_pipes_and_devices(self):
        """They are not waited for."""
        pipe, device = (os.path.join(self.folder, name) for name in ("pipe.vtu", "zero.pvd"))
        os.mkfifo(pipe)
        os.symlink("/dev/zero", device)
        for name in (pipe, device):
            for arguments in ((name,), (self.write("good.vtu", make_file()), "--water", name)):
                with self.subTest(arguments=arguments):
                    status, errors = self.run_command(*arguments)
                    self.assertEqual(status, 1)
                    self.assertIn("a pipe or a device", errors)

    def test_axes_without_coordinates(self):
        """A rectilinear grid needs one for each of its points along an axis."""
        for axis, coordinates, message in (
                ("x", (0, 1), "2 coordinates for 3 points along x"),
                ("y", (0,), "1 coordinates for 2 points along y"),
                ("z", (0, 1, 2), "3 coordinates for 2 points along z"),
                ("x", (0, 2, 1), "along x do not ascend"),
                ("z", (0, math.nan), "along z do not ascend"),
                ("y", (1, 0), None)):
            with self.subTest(axis=axis, coordinates=coordinates):
                grid = vtkRectilinearGrid()
                grid.SetDimensions(3, 2, 2)
                for name, size in (("X", 3), ("Y", 2), ("Z", 2)):
                    places = coordinates if name.lower() == axis else range(size)
                    getattr(grid, f"Set{name}Coordinates")(
                        numpy_to_vtk(numpy.array(places, float), deep=True))
                if message is None:
                    check_damage(grid)
                else:
                    with self.assertRaisesRegex(ReadingError, message):
                        check_damage(grid)
        # The reader has filled up the axis.
        axes = [_array("", range(size)) for size in (3, 2, 2)]
        name = self.write("axes.vtr", (
            '<VTKFile type="RectilinearGrid" version="1.0" byte_order="LittleEndian">'
            '<RectilinearGrid WholeExtent="0 2 0 1 0 1"><Piece Extent="0 2 0 1 0 1">'
            "<PointData>" + _array("T", range(12)) + "</PointData><Coordinates>"
            + _array("", (5, 6)) + "".join(axes[1:])
            + "</Coordinates></Piece></RectilinearGrid></VTKFile>"))
        status, errors = self.run_command(name)
        self.assertEqual(status, 1)
        self.assertIn("along x", errors)

    def test_appended_data(self):
        """Arrays that are not where the file says are not read from elsewhere in the memory."""
        for encoding in ("raw", "base64"):
            for compressor in ("None", "ZLib"):
                good = make_appended(encoding, compressor)
                self.assertIsNone(self.find_fault(good))
                offsets = [int(text) for text in re.findall(b'offset="([0-9]+)"', good)]
                self.assertGreater(len(offsets), 4)
                for index, offset in enumerate(offsets):
                    place = b'offset="%d"' % offset
                    # The number of indices of points is not known beforehand.
                    near = () if index == 2 else (offset + 1, offset + 4)
                    for wrong in (-5, 10 ** 8, 2 ** 63, *near):
                        with self.subTest(encoding=encoding, compressor=compressor, index=index,
                                          offset=wrong):
                            damaged = good.replace(place, b'offset="%d"' % wrong)
                            self.assertIsNotNone(self.find_fault(damaged))
                begin = good.index(b"_", good.index(b"<AppendedData")) + 1
                self.assertIsNotNone(self.find_fault(good[:begin + offsets[-1] + 3]))
        name = self.write("wrong.vtu", make_appended("raw", "None").replace(
            b'offset="0"', b'offset="123456"'))
        status, errors = self.run_command(name)
        self.assertEqual(status, 1)
        self.assertIn("123456, is wrong", errors)

    def find_fault(self, text):
        return find_fault(self.write("appended.vtu", text))

    def test_bits(self):
        bits = self.write("bits.vtu", make_file(point_data=_array("B", [1, 0] * 6, "Bit")))
        scene = make_scene(make_parser().parse_args([bits]))
        self.assertEqual((scene.get_arrays(), scene.get_range()), (["B"], (0, 1)))

    def test_options(self):
        good = self.write("good.vtu", make_file())
        for options, message in ((("--range", "0", "inf"), "the lower one first"),
                                 (("--clip", ""), "no axis ''")):
            with self.subTest(options=options):
                status, errors = self.run_command(good, *options)
                self.assertEqual(status, 1)
                self.assertIn(message, errors)

    def test_sizes(self):
        """The eye is at a distance from a mesh of any size."""
        for scale in (1e-15, 1.0, 1e20, 1e37):
            with self.subTest(scale=scale):
                name = self.write("size.vtu", make_file(scale))
                self.assertEqual(self.run_command(name), (0, ""))

    @unittest.skipUnless(hasattr(os, "fork"), "needs child processes")
    def test_crashes(self):
        """Readers that end the process: the command as a program tells which file it was."""
        for name, text in (
                ("many.vtu", make_file(cells=10 ** 12)),
                ("negative.vtu", make_file(cells=-2)),
                ("zero.cgns", b"@(#)ADF Database Version" + bytes(100))):
            with self.subTest(name=name):
                file = self.write(name, text)
                ended = subprocess.run(
                    [sys.executable, "-m", "meniscus", file, "--output", file + ".png"],
                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual(ended.returncode, 1, ended.stderr)
                self.assertTrue(ended.stderr.startswith(f"meniscus: {file}: "), ended.stderr)

    @unittest.skipUnless(hasattr(os, "fork"), "needs child processes")
    def test_status_of_the_program(self):
        good = self.write("good.vtu", make_file())
        for options, status in ((("--size", "5"), 2), (("--array", "q", "--output", "a.png"), 1),
                                (("--output", os.path.join(self.folder, "a.png")), 0)):
            with self.subTest(options=options):
                ended = subprocess.run([sys.executable, "-m", "meniscus", good, *options],
                                       capture_output=True, check=False)
                self.assertEqual(ended.returncode, status, ended.stderr)


if __name__ == "__main__":
    unittest.main()
