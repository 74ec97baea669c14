# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Annotations of the accessor and the functions, as mypy and pyright check a user's program and the
accessor's own in their strict modes. Skipped without mypy and PyVista 0.48.

The exit status is then 125, which CTest counts as skipped.
"""
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest

try:
    import pyvista
except ImportError:
    pyvista = None
if not hasattr(pyvista, "register_dataset_accessor") or not importlib.util.find_spec("mypy"):
    print("skipped: no pyvista 0.48 or no mypy")
    sys.exit(125)

import meniscus

PACKAGE = os.path.dirname(meniscus.__file__)
ACCESSOR = os.path.join(PACKAGE, "api", "accessor.py")
PROGRAM = """# pyright: strict
from __future__ import annotations

import numpy
import pyvista
from meniscus import add_to, integral, mirage, pick, plot, true_positions, triangulate
from meniscus.api.accessor import MeniscusAccessor
from meniscus.api.picking import Pick

mesh = pyvista.UnstructuredGrid()
plotter = pyvista.Plotter()
accessor = MeniscusAccessor(mesh)
accessor.plot("T", cmap="inferno")
accessor.add_to(plotter, "T", blending="maximum", isovalues=[1.0, 2.0])
found: Pick | None = accessor.pick(plotter, 1, 2)
shape: tuple[int, ...] = accessor.radiograph("T", [0.1, 0.2], size=(3, 4)).shape
accessor.integral("T", "path_length")
for each in accessor.compare("T"):
    print(each.name, each.milliseconds + each.rms)
accessor.refracted(mesh, plotter, [1.5, 1.333])
accessor.mirage(mesh, "T", ["color", "depth"], size=(3, 4))
accessor.apparent(mesh, (0.0, 0.0, 1.0), "T")
plot(mesh, "T")
add_to(mesh, plotter)
integral(mesh)
pick(mesh, plotter, 0, 0)
mirage(mesh, mesh, camera=plotter)
places = numpy.zeros((3, 3))
true_positions(places, (0, 0, 1), mesh, 1.333)
triangulate(places[None], places[:1], (places, places), [1.0, 1.333])
"""
# Each of these lines must be an error.
WRONG = """accessor.plot("T", window_size=3)
accessor.pick(plotter, "left", 2)
accessor.radiograph(3)
accessor.compare("T", frames="many")
accessor.refracted()
accessor.mirage(mesh, 3)
add_to(plotter, mesh)
true_positions(places, (0, 0, 1), 5)
"""


class TestTypes(unittest.TestCase):
    def check(self, command):
        """Runs a checker on the right program and the accessor, and on each wrong line."""
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "program.py")
            with open(program, "w") as file:
                file.write(PROGRAM)
            self.assertEqual(self.errors_of(command, folder, [program, ACCESSOR]), [])
            with open(program, "w") as file:
                file.write(PROGRAM + WRONG)
            errors = self.errors_of(command, folder, [program])
            first = PROGRAM.count("\n") + 1
            lines = {int(error.split(":")[1]) for error in errors}
            self.assertEqual(lines, set(range(first, first + WRONG.count("\n"))), errors)

    def errors_of(self, command, folder, files):
        environment = dict(os.environ, MYPYPATH="")
        if "site-packages" not in PACKAGE:
            environment["MYPYPATH"] = os.path.dirname(PACKAGE)
        done = subprocess.run([*command, *files], text=True, cwd=folder, env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        lines = [line.strip() for line in done.stdout.splitlines()]
        self.assertRegex(done.stdout, r"(?m)\d+ errors?\b|^Success", done.stdout)
        return [line for line in lines if " error" in line and (
            "program.py:" in line or "accessor.py:" in line)]

    def test_mypy(self):
        self.check([sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent"])

    def test_pyright(self):
        if not importlib.util.find_spec("pyright"):
            self.skipTest("no pyright")
        self.check([sys.executable, "-m", "pyright", "--pythonpath", sys.executable])


if __name__ == "__main__":
    unittest.main()
