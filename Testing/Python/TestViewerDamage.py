# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Files that VTK's readers cannot cope with, and meshes of extreme sizes, by the command: each is a
message and status 1, or the right picture."""
import contextlib
import io
import os
import subprocess
import sys
import tempfile
import unittest

from meniscus.viewer.command import main, make_parser, make_scene

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

    def test_bits(self):
        bits = self.write("bits.vtu", make_file(point_data=_array("B", [1, 0] * 6, "Bit")))
        scene = make_scene(make_parser().parse_args([bits]))
        self.assertEqual((scene.get_arrays(), scene.get_range()), (["B"], (0, 1)))

    def test_options(self):
        good = self.write("good.vtu", make_file())
        for options, message in ((("--range", "0", "inf"), "lower end below the upper"),
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
