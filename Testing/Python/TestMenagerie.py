# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Files in the manner of many programs, Testing/Data/Menagerie, by the command `meniscus`: volume,
bounds, arrays and time steps, or the message about a file that cannot be drawn."""
import contextlib
import csv
import importlib.util
import io
import os
import shutil
import tempfile
import unittest

import numpy
from meniscus import vtkTetrahedraRayIntegral
from meniscus.data import leaves_of
from meniscus.viewer import reading
from meniscus.viewer.command import main, make_parser, make_scene
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data", "Menagerie")
VERSION = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion())


def read_table():
    """Rows of expected.csv as dictionaries."""
    with open(os.path.join(FOLDER, "expected.csv"), newline="") as file:
        return list(csv.DictReader(file, delimiter="|", quoting=csv.QUOTE_NONE))


def find_missing(row):
    """What is missing to read a file, or an empty text."""
    needs = row["needs"]
    if needs.startswith("VTK "):
        wanted = tuple(int(number) for number in needs[4:].split("."))
        return needs if VERSION < wanted else ""
    return " ".join(name for name in needs.split() if importlib.util.find_spec(name) is None)


def measure_volume(data, array, association):
    """Volume of the cells that are drawn, from the lengths of parallel rays along z. Cells are
    prisms or boxes over squares, which the pixels divide evenly: the sum is exact."""
    rays = vtkTetrahedraRayIntegral()
    rays.SetInputDataObject(data)
    rays.SetInputArrayToProcess(0, 0, 0, 0 if association == "points" else 1, array)
    rays.GetArraySelection().DisableArray("Integral")
    rays.GetArraySelection().EnableArray("PathLength")
    rays.SetImageSize(40, 20)
    rays.Update()
    image = rays.GetOutput()
    lengths = vtk_to_numpy(image.GetPointData().GetArray("PathLength")).astype(float)
    spacing = image.GetSpacing()
    return lengths.sum() * spacing[0] * spacing[1]


class TestMenagerie(unittest.TestCase):
    def setUp(self):
        self.rows = read_table()

    def test_table_names_all_files(self):
        """At least sixty files, none larger than 20 KB."""
        self.assertGreater(len(self.rows), 60)
        for row in self.rows:
            self.assertTrue(os.path.exists(os.path.join(FOLDER, row["file"])), row["file"])
        sizes = {os.path.join(folder, name): os.path.getsize(os.path.join(folder, name))
                 for folder, _, names in os.walk(FOLDER) for name in names}
        self.assertLessEqual(max(size for size in sizes.values()), 20480)

    def check_mesh(self, row):
        name = os.path.join(FOLDER, row["file"])
        scene = make_scene(make_parser().parse_args([name]))
        numpy.testing.assert_allclose(
            scene.bounds, [float(x) for x in row["bounds"].split()], rtol=0, atol=1e-9)
        self.assertEqual(len(scene.series.get_times()), int(row["steps"]))
        arrays = reading.arrays_of(scene.data)
        self.assertEqual(", ".join(f"{association[:-1]} {array}"
                                   for array, (association, _) in arrays.items()), row["arrays"])
        array = next(iter(arrays))
        for step in range(len(scene.series.get_times())):
            volume = measure_volume(scene.series.read(step), array, arrays[array][0])
            self.assertAlmostEqual(volume, float(row["volume"]), 5)

    def test_meshes(self):
        for row in self.rows:
            if row["error"] or not float(row["volume"]):
                continue
            with self.subTest(file=row["file"]):
                if find_missing(row):
                    self.skipTest("no " + find_missing(row))
                self.check_mesh(row)

    def test_values_of_steps(self):
        """The point array T of these files grows with 1 + time; it is 7 at most at time 0."""
        for row in self.rows:
            if row["file"] not in ("ensight/box.case", "xdmf/steps.xdmf", "vtkhdf/steps.vtkhdf"):
                continue
            with self.subTest(file=row["file"]):
                if find_missing(row):
                    self.skipTest("no " + find_missing(row))
                series = reading.MeshSeries([os.path.join(FOLDER, row["file"])])
                for step, time in enumerate(series.get_times()):
                    data = series.read(step)
                    largest = max(leaf.GetPointData().GetArray("T").GetRange()[1]
                                  for leaf in leaves_of(data))
                    self.assertAlmostEqual(largest, 7 * (1 + time))

    def run_command(self, name):
        """Status, standard error and whether a picture was written."""
        errors = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(errors):
            picture = os.path.join(folder, "picture.png")
            status = main([name, "--output", picture, "--size", "40x30"])
            return status, errors.getvalue(), os.path.exists(picture)

    def test_folders(self):
        """The folder of a case of OpenFOAM needs no file of the case's own."""
        with tempfile.TemporaryDirectory() as folder:
            case = os.path.join(folder, "case")
            shutil.copytree(os.path.join(FOLDER, "openfoam"), case,
                            ignore=shutil.ignore_patterns("*.foam"))
            self.assertEqual(self.run_command(case), (0, "", True))
            shutil.rmtree(os.path.join(case, "constant"))
            status, errors, written = self.run_command(case)
            self.assertEqual((status, written), (1, False))
            self.assertIn("Cannot open directory", errors)

    def test_messages(self):
        for row in self.rows:
            if float(row["volume"]):
                continue
            with self.subTest(file=row["file"]):
                status, errors, written = self.run_command(os.path.join(FOLDER, row["file"]))
                self.assertEqual((status, written), (1, False), errors)
                self.assertTrue(errors.startswith("meniscus: "), errors)
                self.assertIn(row["error"], errors)
                self.assertEqual(errors.count("\n"), 1, errors)

    def test_pictures(self):
        """The command writes a picture of each mesh."""
        for row in self.rows:
            if not float(row["volume"]) or find_missing(row):
                continue
            with self.subTest(file=row["file"]):
                status, errors, written = self.run_command(os.path.join(FOLDER, row["file"]))
                self.assertEqual((status, written), (0, True), errors)


if __name__ == "__main__":
    unittest.main()
