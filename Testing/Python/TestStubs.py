# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The type stubs are valid Python and contain every class and method of the package."""
import ast
import os
import unittest

import meniscus

STUBS = os.path.join(os.path.dirname(meniscus.__file__), "vtkMeniscus.pyi")


class TestStubs(unittest.TestCase):
    def test_complete(self):
        with open(STUBS) as file:
            tree = ast.parse(file.read())
        found = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
        classes = {name: value for name, value in vars(meniscus).items()
                   if name.startswith("vtk") and isinstance(value, type)}
        self.assertEqual(set(found), set(classes))
        for name, kind in classes.items():
            methods = {node.name for node in found[name].body if isinstance(node, ast.FunctionDef)}
            expected = {key for key, value in vars(kind).items()
                        if key[0].isupper() and callable(value) and not isinstance(value, type)}
            self.assertEqual(expected - methods, set(), name)
            self.assertGreater(len(methods), 5, name)

    def test_types(self):
        """Types of VTK are those of vtkmodules, and numbers are number types."""
        with open(STUBS) as file:
            text = file.read()
        self.assertIn(
            "from vtkmodules.vtkRenderingVolume import vtkUnstructuredGridVolumeMapper", text)
        self.assertRegex(text, r"def SetCamera\(self, camera: vtkCamera\) -> None")
        self.assertRegex(text, r"def SetInteriorIndexOfRefraction\(self, \w+: float\) -> None")
        self.assertNotRegex(text, r"vtk(Camera|PolyData|Renderer) = Any")

    def test_marker(self):
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(STUBS), "py.typed")))


if __name__ == "__main__":
    unittest.main()
