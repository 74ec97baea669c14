# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Calls that cannot be right are Python errors, or VTK errors that can be observed; none
crashes."""
import gc
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import meniscus
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer, vtkRenderWindow, vtkVolume


class TestBadInput(unittest.TestCase):
    def setUp(self):
        self.errors = []

    def observe(self, thing):
        thing.AddObserver("ErrorEvent", lambda *_: self.errors.append(1))
        return thing

    def test_wrong_types(self):
        mapper = meniscus.vtkTetrahedraRayCastMapper()
        refraction = meniscus.vtkRefractedGeometryFilter()
        volume = meniscus.vtkRefractionErrorVolume()
        light = meniscus.vtkRefractedLightFilter()
        step = meniscus.vtkRefractionPass()
        for call, arguments in [
                (mapper.SetBackend, ["native"]), (mapper.SetInputData, [vtkPolyData]),
                (mapper.SetEarlyTerminationOpacity, [None]), (mapper.Render, [None, 3]),
                (refraction.SetEyePosition, [1, 2]), (refraction.SetCamera, [vtkPolyData()]),
                (refraction.SetMembraneData, [vtkUnstructuredGrid()]),
                (volume.SetSampleDimensions, ["a", "b", "c"]),
                (light.SetLightPosition, ["above"]),
                (step.AddVolume, [vtkPolyData(), vtkVolume()])]:
            with self.assertRaises(TypeError, msg=call.__name__):
                call(*arguments)
        with self.assertRaises(AttributeError):
            mapper.SetNotThere(1)

    def test_deleted_objects(self):
        """Objects that Python released are kept by the objects that use them."""
        refraction = self.observe(meniscus.vtkRefractedGeometryFilter())
        ball = vtkSphereSource()
        ball.SetCenter(0, 0, -1)
        water = vtkPlaneSource()
        camera = vtkCamera()
        camera.SetPosition(0, 0, 3)
        refraction.SetInputConnection(0, ball.GetOutputPort())
        refraction.SetInputConnection(1, water.GetOutputPort())
        refraction.SetCamera(camera)
        refraction.ViewCullingOff()
        del ball, water, camera
        gc.collect()
        refraction.Update()
        self.assertGreater(refraction.GetOutput().GetNumberOfPoints(), 0)
        self.assertFalse(self.errors)

    def test_deleted_window(self):
        mapper = meniscus.vtkTetrahedraRayCastMapper()
        mapper.SetInputData(vtkUnstructuredGrid())
        volume = vtkVolume()
        volume.SetMapper(mapper)
        renderer = vtkRenderer()
        renderer.AddVolume(volume)
        window = vtkRenderWindow()
        window.AddRenderer(renderer)
        window.Render()
        del window, renderer, volume
        gc.collect()
        self.assertEqual(mapper.GetNumberOfLostRays(), 0)

    def test_no_input(self):
        refraction = self.observe(meniscus.vtkRefractedGeometryFilter())
        self.observe(refraction.GetExecutive())
        refraction.Update()
        self.assertTrue(self.errors)
        self.assertEqual(refraction.GetOutput().GetNumberOfPoints(), 0)

    def test_no_interface(self):
        interfaces = self.observe(meniscus.vtkRefractingInterfaceCollection())
        interfaces.AddItem(None)
        self.assertEqual(len(self.errors), 1)
        self.assertEqual(interfaces.GetNumberOfItems(), 0)
        self.assertIsNone(interfaces.GetInterface(0))

    def test_other_vtk(self):
        """Another vtkmodules, or none, is an ImportError that explains the correction."""
        other = ("class vtkVersion:\n    @staticmethod\n"
                 "    def GetVTKVersion():\n        return '9.9.9'\n")
        for text, message in [(other, "are VTK 9.9.9"), ("raise ImportError", "No vtkmodules")]:
            with tempfile.TemporaryDirectory() as folder:
                os.mkdir(os.path.join(folder, "vtkmodules"))
                for name, content in [("__init__.py", ""), ("vtkCommonCore.py", text)]:
                    with open(os.path.join(folder, "vtkmodules", name), "w") as file:
                        file.write(content)
                path = folder + os.pathsep + os.path.dirname(os.path.dirname(meniscus.__file__))
                done = subprocess.run(
                    [sys.executable, "-B", "-c", "import meniscus"], stderr=subprocess.PIPE,
                    text=True, env=dict(os.environ, PYTHONPATH=path))
                self.assertEqual(done.returncode, 1)
                self.assertIn(message, done.stderr)
                self.assertRegex(done.stderr, "--system-site-packages|pip install vtk==")

    def test_library_missing(self):
        """If the library cannot be loaded, an ImportError names it."""
        with tempfile.TemporaryDirectory() as folder:
            package = os.path.join(folder, "meniscus")
            os.mkdir(package)
            shutil.copy(os.path.join(os.path.dirname(meniscus.__file__), "__init__.py"), package)
            with open(os.path.join(package, "vtkMeniscus.so"), "w") as file:
                file.write("no library")
            done = subprocess.run(
                [sys.executable, "-B", "-c", "import meniscus"], stderr=subprocess.PIPE, text=True,
                env=dict(
                    os.environ, PYTHONPATH=folder + os.pathsep + os.environ.get("PYTHONPATH", "")))
            self.assertEqual(done.returncode, 1)
            self.assertIn("A library that meniscus needs does not load", done.stderr)
            self.assertIn("vtkMeniscus.so", done.stderr)


if __name__ == "__main__":
    unittest.main()
