# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Options of the command `meniscus` from a file, and the comparison with VTK's mappers."""
import contextlib
import importlib.util
import io
import os
import re
import socket
import subprocess
import sys
import unittest
import warnings
from unittest import mock

import numpy
from meniscus.viewer import contest, files, reading, web
from meniscus.viewer.command import main, make_parser, make_scene
from meniscus.viewer.reading import ReadingError
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_FLOAT
from vtkmodules.vtkCommonDataModel import VTK_VERTEX, vtkImageData, vtkUnstructuredGrid
from vtkmodules.vtkIOImage import vtkMetaImageWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from TestViewer import FolderCase, make_block, radius, read_picture, write

try:
    import tomllib  # noqa: F401
    HAS_TOML = True
except ImportError:
    try:
        import tomli  # noqa: F401
        HAS_TOML = True
    except ImportError:
        HAS_TOML = False

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Documentation",
                    "command.md")


class Case(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        block = make_block({"r": radius, "z": lambda x, y, z: z, "v": lambda x, y, z: x})
        cls.mesh = write(vtkXMLUnstructuredGridWriter(), block, cls.name("mesh.vtu"))

    def run_command(self, *arguments):
        """Exit status, standard output and standard error."""
        output, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors), \
                warnings.catch_warnings():
            warnings.filterwarnings("ignore", category=DeprecationWarning, module=r"vtkmodules\.")
            status = main(list(arguments))
        return status, output.getvalue(), errors.getvalue()


@unittest.skipUnless(HAS_TOML, "neither tomllib nor tomli")
class TestConfig(Case):
    def write(self, text):
        name = self.name("options.toml")
        with open(name, "w") as file:
            file.write(text)
        return name

    def parse(self, text, *arguments):
        return make_parser().parse([*arguments, "--config", self.write(text)])

    def test_a_file_and_the_command_line_mean_the_same(self):
        line = make_parser().parse([
            "a.vtu", "b.vtu", "--array", "z", "--opacity", "0", "0.5", "1e-5", "--isovalues",
            "-0.5", "2", "--size", "20x10", "--light", "--units", "m", "K", "--view", "0", "-1",
            "2", "--cmap", "fire"])
        file = self.parse('mesh = ["a.vtu", "b.vtu"]\narray = "z"\nopacity = [0, 0.5, 1e-5]\n'
                          'isovalues = [-0.5, 2]\nsize = "20x10"\nlight = true\naxes = false\n'
                          'units = ["m", "K"]\nview = [0, -1, 2]\ncmap = "fire"\n')
        self.assertEqual({**vars(file), "config": None}, vars(line))

    def test_the_file_of_the_page(self):
        with open(PAGE) as file:
            text = re.search("```toml\n(.*?)```", file.read(), re.DOTALL).group(1)
        options = self.parse(text)
        self.assertEqual(options.mesh, ["step0.vtu", "step1.vtu"])
        self.assertEqual((options.colors, options.opacity), ("inferno", [0, 0, 0.3, 1]))

    def test_the_command_line_goes_before(self):
        options = self.parse('mesh = "a.vtu"\ndensity = 2\nlight = true\nrange = [-1e-7, 1]',
                             "b.vtu", "--density", "3")
        self.assertEqual((options.mesh, options.density, options.light, options.range),
                         (["b.vtu"], 3.0, True, [-1e-7, 1.0]))

    def test_options_of_the_file_are_left_out(self):
        text = ('mesh = "a.vtu"\ncmap = "inferno"\nlight = true\noutline = true\nclip = "x"\n'
                'opacity = [0, 1]\nunits = ["m"]\nstep = 2\nview = [0, 0, 1]')
        line = make_parser().parse(["a.vtu", "--outline"])
        options = self.parse(text, "--no-light", "--no-clip", "--no-opacity", "--no-units",
                             "--no-step", "--no-view", "--no-colors")
        line.config, line.left_out = options.config, options.left_out
        self.assertEqual(vars(options), vars(line))
        self.assertEqual(self.parse(text, "--no-clip", "--clip", "y").clip, "y")
        self.assertFalse(make_parser().parse(["a.vtu", "--no-light"]).light)
        for option in ("--no-config", "--no-help", "--no-contrast"):
            with contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit):
                make_parser().parse(["a.vtu", option])

    def test_messages(self):
        for text, message in (
                ("contrast = 1", "there is no option 'contrast'; known are mesh, array, range"),
                ("config = 'x'", "there is no option 'config'"),
                ("[window]\nsize = '2x2'", "there is no option 'window'"),
                ("density = 'thick'", "--density: invalid float value: 'thick'"),
                ("density = [1, 2]", "density has too many values"),
                ("view = [1, 2]", "--view: expected 3 arguments"),
                ("light = 1", "light must be true or false"),
                ("density = true", "density must be a number or text"),
                ("size = '3'", "--size: '3' is no size"),
                ("size = '100000x9'", "--size: both sizes must be from 1 to 16384"),
                ("mesh = 3", "mesh must be the name of a file"),
                ("units = ['--output', 'x.png']", "units must not begin with '-'"),
                ("a b", "Expected '='"),
                ("array = '\\xff", "")):
            with self.subTest(text=text):
                with self.assertRaises(ReadingError) as caught:
                    self.parse(text, "mesh.vtu")
                self.assertTrue(str(caught.exception).startswith(self.name("options.toml") + ": "))
                self.assertIn(message, str(caught.exception))

    def test_a_file_is_data(self):
        """Text that looks like code or like an option is a value."""
        ran = self.name("ran")
        for text in (f"__import__('os').mkdir('{ran}')", f"$(mkdir {ran})", "--output=x.png"):
            options = self.parse(f'array = "{text}"', self.mesh)
            self.assertEqual((options.array, options.output), (text, None))
            status, _, errors = self.run_command(
                self.mesh, "--config", self.name("options.toml"), "--output", self.name("no.png"))
            self.assertEqual(status, 1)
            self.assertIn("has no array", errors)
        self.assertFalse(os.path.exists(ran))

    def test_a_picture(self):
        picture = self.name("picture.png")
        self.write(f'mesh = "{self.mesh}"\noutput = "{picture}"\nsize = "40x30"\noutline = true')
        status, _, errors = self.run_command("--config", self.name("options.toml"))
        self.assertEqual((status, errors), (0, ""))
        self.assertEqual(read_picture(picture).shape, (40 * 30, 3))


class TestMessages(Case):
    def test_without_toml(self):
        absent = {"tomllib": None, "tomli": None}
        with open(self.name("x.toml"), "w") as file:
            file.write("edges = true\n")
        with mock.patch.dict(sys.modules, absent):
            status, _, errors = self.run_command(self.mesh, "--config", self.name("x.toml"))
        self.assertEqual(status, 1)
        self.assertIn("pip install tomli", errors)

    def test_without_trame(self):
        with mock.patch.dict(sys.modules, {"trame": None, "trame.app": None}):
            status, _, errors = self.run_command(self.mesh, "--web", "--port", "0")
        self.assertEqual(status, 1)
        self.assertIn("pip install trame trame-vuetify trame-rca", errors)

    def test_a_system_without_localhost(self):
        """Neither is there a page's address to look up before trame is found missing."""
        unknown = mock.patch("socket.getaddrinfo", side_effect=socket.gaierror(-2, "not known"))
        with unknown:
            self.assertEqual(web.find_address("localhost"), "127.0.0.1")
            self.assertEqual(web.find_address("10.0.0.1"), "10.0.0.1")
            self.test_without_trame()

    def test_files_of_other_packages(self):
        """An image of MetaImage (.mhd) is read by PyVista, and a file of TetGen by meshio."""
        image = vtkImageData()
        image.SetDimensions(3, 4, 5)
        image.AllocateScalars(VTK_FLOAT, 1)
        vtk_to_numpy(image.GetPointData().GetScalars())[:] = range(60)
        writer = vtkMetaImageWriter()
        writer.SetInputData(image)
        writer.SetFileName(self.name("image.mhd"))
        writer.SetRAWFileName(self.name("image.raw"))
        writer.Write()
        with open(self.name("mesh.ele"), "w") as file:
            file.write("1 4 0\n0 0 1 2 3\n")
        with open(self.name("mesh.node"), "w") as file:
            file.write("4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n")
        for name, package, cells in (("image.mhd", "pyvista", 24), ("mesh.ele", "meshio", 1)):
            if importlib.util.find_spec(package):
                data = reading.MeshSeries([self.name(name)]).read(0)
                self.assertEqual(data.GetNumberOfCells(), cells)
            with mock.patch.dict(sys.modules, {"pyvista": None, "meshio": None}):
                with self.assertRaisesRegex(ReadingError, "pip install pyvista meshio"):
                    reading.MeshSeries([self.name(name)])

    def test_first_bytes_of_cgns(self):
        """Both kinds of ADF are taken; what only begins like one would end the process."""
        name = self.name("grid.cgns")
        for start in (b"@(#)", bytes(byte | 0x80 for byte in b"@(#)")):
            for rest, is_adf in ((b"ADF Database Version A02011>", True), (b"ADF garbage", False)):
                with open(name, "wb") as file:
                    file.write(start + rest)
                if is_adf:
                    files._check_signature(name)
                else:
                    with self.assertRaisesRegex(ReadingError, "not a file of the kind"):
                        files._check_signature(name)

    def test_points_only(self):
        points = vtkUnstructuredGrid()
        points.SetPoints(reading.MeshSeries([self.mesh]).read(0).GetPoints())
        bare = write(vtkXMLUnstructuredGridWriter(), points, self.name("bare.vtu"))
        points.Allocate(1)
        for point in range(3):
            points.InsertNextCell(VTK_VERTEX, 1, [point])
        vertices = write(vtkXMLUnstructuredGridWriter(), points, self.name("vertices.vtu"))
        for name, message in ((bare, "has no cells"), (vertices, "its cells are: 3 Vertex")):
            status, _, errors = self.run_command(name, "--output", self.name("none.png"))
            self.assertEqual(status, 1)
            self.assertIn(message, errors)

    def test_places_of_the_mesh(self):
        """It may follow the values of an option with numbers."""
        first = make_parser().parse(["a.vtu", "b.vtu", "--opacity", "0", "-1e-5", "--light"])
        for words in (["--opacity", "0", "-1e-5", "a.vtu", "b.vtu", "--light"],
                      ["--light", "--opacity", "0", "-1e-5", "a.vtu", "b.vtu"],
                      ["--light", "--opacity", "0", "-1e-5", "--", "a.vtu", "b.vtu"],
                      ["a.vtu", "--opacity", "0", "-1e-5", "b.vtu", "--light"]):
            self.assertEqual(vars(make_parser().parse(words)), vars(first), words)

    def test_command_lines_that_are_refused(self):
        for words, expected in (
                (["--units", "m", "a.vtu"],
                 "meniscus demo; it goes before --units, which takes any number of values\n"),
                (["--light"], "no mesh is named: meniscus MESH, or meniscus demo\n"),
                (["a.vtu", "--size", "800", "600"], "--size: '800' is no size, such as 800x600"),
                (["a.vtu", "--size", "800,600"], "'800,600' is no size"),
                (["a.vtu", "--size", "axb"], "'axb' is no size"),
                (["a.vtu", "--port", "web"], "--port: 'web' is not a whole number"),
                (["a.vtu", "--orbit", "0.5"], "--orbit: '0.5' is not a whole number"),
                (["a.vtu", "--opacity", "linear"], "--opacity: 'linear' is not a number"),
                (["--isovalues", "a.vtu", "0.5"], "--isovalues: 'a.vtu' is not a number")):
            with contextlib.redirect_stderr(io.StringIO()) as message, \
                    self.assertRaises(SystemExit):
                make_parser().parse(words)
            self.assertIn(expected, message.getvalue())

    def test_version(self):
        with contextlib.redirect_stdout(io.StringIO()) as output, \
                self.assertRaises(SystemExit) as end:
            make_parser().parse(["--version"])
        self.assertEqual(end.exception.code, 0)
        self.assertRegex(output.getvalue(), r"^meniscus \d+\.\d+\.\d+\n$")

    def test_help(self):
        """has titles, and examples that the parser takes."""
        text = make_parser().format_help()
        self.assertIn("\nvalues, colours and opacity:\n  --array", text)
        for line in re.findall("^  meniscus (.*?)  ", text, re.MULTILINE):
            self.assertTrue(make_parser().parse(line.split()).mesh)

    def test_absent_file(self):
        """It is told whether or not there is a package that could read it."""
        for absent in ({}, {"tomllib": None, "tomli": None}):
            with mock.patch.dict(sys.modules, absent):
                status, _, errors = self.run_command("--config", self.name("absent.toml"))
            self.assertEqual(status, 1)
            self.assertIn("absent.toml: there is no such file", errors)

    def test_options_that_do_not_go_together(self):
        for arguments, message in ((["--watch", "--output", "x.png"], "--watch goes with"),
                                   (["--compare", "--web"], "--compare makes a picture"),
                                   (["--compare", "--light"], "without --light"),
                                   (["--compare", "--shadows"], "--shadows"),
                                   (["--compare", "--blend", "maximum"], "composite"),
                                   (["--index", "1.5"], "--water SURFACE"),
                                   (["--blend", "maximum", "--isovalues", "0.5"],
                                    "--isovalues are those of --blend isosurface"),
                                   (["--units", "m", "K", "s"], "at most two")):
            status, _, errors = self.run_command(self.mesh, *arguments)
            self.assertEqual(status, 1, arguments)
            self.assertIn(message, errors)

    def test_a_movie_without_an_encoder(self):
        """What was in the file stays."""
        name = self.name("turn.mp4")
        with open(name, "w") as file:
            file.write("kept")

        class Writer:
            def __enter__(self):
                raise ImportError("no encoder")

            def __exit__(self, *_):
                return False

        def get_writer(target, **_):
            open(target, "w").close()
            return Writer()

        imageio = mock.Mock(**{"v2.get_writer": get_writer})
        with mock.patch.dict(sys.modules, {"imageio": imageio, "imageio.v2": imageio.v2}):
            status, _, errors = self.run_command(self.mesh, "--movie", name, "--orbit", "2")
        self.assertEqual(status, 1)
        self.assertIn("pip install 'imageio[ffmpeg]'", errors)
        with open(name) as file:
            self.assertEqual(file.read(), "kept")
        self.assertEqual([file for file in os.listdir(self.folder.name) if "turn" in file],
                         ["turn.mp4"])
        with mock.patch.dict(sys.modules, {"imageio": imageio, "imageio.v2": imageio.v2}):
            status, _, errors = self.run_command(self.mesh, "--movie", self.name("absent/turn.mp4"))
        self.assertEqual(status, 1)
        self.assertIn("there is no folder", errors)

    def test_before_the_mesh_is_read(self):
        """What needs no mesh is told at once."""
        absent = self.name("absent")
        for arguments, message in (
                (["--output", absent + ".jpg"], "end in '.png'"),
                (["--output", absent + "/a.png"], f"there is no folder '{absent}'"),
                (["--orbit", "9"], "--orbit needs"), (["--movie", "a.xyz"], "imageio|ending"),
                (["--blend", "maximum", "--isovalues", "1"], "--isovalues"),
                (["--view", "0", "0", "0"], "no direction")):
            status, output, errors = self.run_command("absent.vtu", *arguments)
            self.assertEqual((status, output), (1, ""))
            self.assertRegex(errors, message)


class TestCompletion(Case):
    def complete(self, line):
        """The words that argcomplete offers after a line, which it writes to a file."""
        name = self.name("words")
        environment = {**os.environ, "_ARGCOMPLETE": "1", "COMP_LINE": line, "COMP_TYPE": "9",
                       "COMP_POINT": str(len(line)), "_ARGCOMPLETE_IFS": "\n",
                       "_ARGCOMPLETE_STDOUT_FILENAME": name}
        subprocess.run([sys.executable, "-m", "meniscus"], env=environment, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(name) as file:
            return [word.strip() for word in file.read().split("\n")]

    @unittest.skipUnless(importlib.util.find_spec("argcomplete"), "no argcomplete")
    def test_words(self):
        self.assertEqual(self.complete("meniscus mesh.vtu --cmap inf"), ["inferno"])
        self.assertIn("maximum", self.complete("meniscus --blend "))
        self.assertEqual(self.complete("meniscus --outl"), ["--outline"])


class TestCompare(Case):
    def test_panels(self):
        name = self.name("compared.png")
        status, output, _ = self.run_command(self.mesh, "--compare", "--output", name, "--size",
                                             "240x160")
        self.assertEqual(status, 0)
        rows = [line.split() for line in output.splitlines()[2:]]
        self.assertEqual([row[0] for row in rows], ["meniscus", "projected", "ray", "z"])
        self.assertEqual(float(rows[0][-1]), 0.0)
        for row in rows:
            self.assertGreater(float(row[-3]), 0.0)  # milliseconds
        # The picture has the four pictures in its quarters.
        pixels = read_picture(name).reshape(160, 240, 3)
        for lower in (0, 80):
            for left in (0, 120):
                panel = pixels[lower:lower + 60, left:left + 120].max(axis=2) > 20
                self.assertGreater(pixels[lower:lower + 60, left:left + 120].max(), 60)
                # The block, seen from (1, 0.7, 1), fills the height of its panel.
                self.assertGreater(panel.any(axis=1).sum(), 50)
                # The name of the mapper ends within its panel.
                self.assertLess(pixels[lower + 66:lower + 80, left + 117:left + 120].max(), 20)

    def test_the_scene_stays(self):
        scene = make_scene(make_parser().parse([self.mesh, "--array", "z"]))
        mapper, camera = scene.volume.GetMapper(), scene.renderer.GetActiveCamera().GetPosition()
        look = scene.volume.GetProperty()
        distance = 0.5
        mapper.SetImageSampleDistance(distance)
        pairs = list(contest.compare_on(scene, (120, 80)))
        self.assertIs(scene.volume.GetMapper(), mapper)
        self.assertIs(scene.volume.GetProperty(), look)
        self.assertEqual(mapper.GetImageSampleDistance(), distance)
        self.assertEqual(scene.renderer.GetActiveCamera().GetPosition(), camera)
        for found, picture in pairs:
            self.assertEqual(picture.shape, (40, 60, 3))
            self.assertGreater(numpy.ptp(picture), 20, found)

    def test_opacities_above_one(self):
        """The same medium for all mappers, though VTK's cut opacities off at 1."""
        scene = make_scene(make_parser().parse(
            [self.mesh, "--array", "z", "--opacity", "0", "0.9"]))
        self.assertGreater(scene.volume.GetProperty().GetScalarOpacity().GetValue(
            scene.get_range()[1]), 1.0)
        (_, ours), *others = contest.compare_on(scene, (240, 160))
        for found, picture in others:  # cut off, 0.13 of the light
            self.assertLess(abs(picture.mean() / ours.mean() - 1.0), 0.1, found)


if __name__ == "__main__":
    unittest.main()
