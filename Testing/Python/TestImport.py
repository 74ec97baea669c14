# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""`import meniscus` works together with vtkmodules, and its classes behave like VTK's."""
import importlib
import pkgutil
import unittest

import meniscus
from vtkmodules.vtkCommonExecutionModel import vtkImageAlgorithm, vtkPolyDataAlgorithm
from vtkmodules.vtkRenderingVolume import vtkUnstructuredGridVolumeMapper


class TestImport(unittest.TestCase):
    def test_version(self):
        self.assertRegex(meniscus.__version__, r"^\d+\.\d+\.\d+$")

    def test_classes(self):
        self.assertIsInstance(meniscus.vtkRefractedGeometryFilter(), vtkPolyDataAlgorithm)
        self.assertIsInstance(meniscus.vtkRefractedLightFilter(), vtkPolyDataAlgorithm)
        self.assertIsInstance(meniscus.vtkRefractionErrorVolume(), vtkImageAlgorithm)
        self.assertIsInstance(
            meniscus.vtkTetrahedraRayCastMapper(), vtkUnstructuredGridVolumeMapper)

    def test_modules(self):
        """All modules are there that others import; packages such as PyVista may be missing."""
        names = [module.name for module in pkgutil.walk_packages(meniscus.__path__, "meniscus.")]
        for name in names:
            if name.rsplit(".", 1)[1].startswith(("__main__", "lib")):  # no modules of Python
                continue
            with self.subTest(name=name):
                try:
                    importlib.import_module(name)
                except ModuleNotFoundError as error:
                    self.assertFalse(error.name.startswith("meniscus"), error)
        self.assertIn("meniscus.viewer.command", names)


if __name__ == "__main__":
    unittest.main()
