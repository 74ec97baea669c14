# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""`import meniscus` works together with vtkmodules, and its classes behave like VTK's."""
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


if __name__ == "__main__":
    unittest.main()
