# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Time steps of readers, which make new arrays in each step: the mesh is built once, and a step
costs an update of the scalars, or of the positions if points move."""
import math
import os
import unittest

from VolumeWindow import make_wavelet, VolumeWindow
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkUnstructuredGrid
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

try:
    from vtkmodules.vtkIOExodus import vtkExodusIIReader, vtkExodusIIWriter
except ImportError:
    vtkExodusIIReader = None

STEPS = 20
SCALARS = "pressure"
# Exodus files have one array per component.
DISPLACEMENTS = ["DISPL" + axis for axis in "XYZ"]


def make_mesh():
    tetrahedra = make_wavelet(2)
    tetrahedra.Update()
    mesh = vtkUnstructuredGrid()
    mesh.CopyStructure(tetrahedra.GetOutput())
    return mesh


def add_array(mesh, name, value_at):
    array = vtkDoubleArray()
    array.SetName(name)
    for i in range(mesh.GetNumberOfPoints()):
        array.InsertNextValue(value_at(*mesh.GetPoint(i)))
    mesh.GetPointData().AddArray(array)


def make_step(mesh, time):
    """The mesh with the scalars and displacements of a time."""
    step = vtkUnstructuredGrid()
    step.DeepCopy(mesh)
    add_array(step, SCALARS, lambda x, y, z: 100 + 50 * math.sin(x + time) * math.cos(y - z))
    for name, scale in zip(DISPLACEMENTS, (0.1, 0.05, 0)):
        add_array(step, name, lambda x, y, z, scale=scale: scale * time * z)
    step.GetPointData().SetActiveScalars(SCALARS)
    return step


class Steps(VTKPythonAlgorithmBase):
    """A source of time steps."""

    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkUnstructuredGrid")
        self.mesh = make_mesh()

    def RequestInformation(self, request, inputs, outputs):
        times = [0.2 * step for step in range(STEPS)]
        info = outputs.GetInformationObject(0)
        info.Set(vtkStreamingDemandDrivenPipeline.TIME_STEPS(), times, STEPS)
        info.Set(vtkStreamingDemandDrivenPipeline.TIME_RANGE(), (times[0], times[-1]), 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        key = vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        time = info.Get(key) if info.Has(key) else 0.0
        output = vtkUnstructuredGrid.GetData(outputs)
        output.ShallowCopy(make_step(self.mesh, time))
        output.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), time)
        return 1


class View(VolumeWindow):
    """A window with one volume of an algorithm's output."""

    def __init__(self, source):
        super().__init__(100, 50, 150)
        self.mapper.SetInputConnection(source.GetOutputPort())
        self.mapper.SetScalarModeToUsePointFieldData()
        self.mapper.SelectScalarArray(SCALARS)


class TestTimeSteps(unittest.TestCase):
    @unittest.skipUnless(vtkExodusIIReader, "VTK has no reader of Exodus files")
    def test_exodus(self):
        name = "time-steps.exo"
        writer = vtkExodusIIWriter()
        source = Steps()
        writer.SetInputConnection(source.GetOutputPort())
        writer.SetFileName(name)
        writer.WriteAllTimeStepsOn()
        writer.Write()
        for displaced in (False, True):
            with self.subTest(displaced=displaced):
                reader = vtkExodusIIReader()
                reader.SetFileName(name)
                reader.SetApplyDisplacements(displaced)
                reader.UpdateInformation()
                reader.SetAllArrayStatus(vtkExodusIIReader.NODAL, 1)
                times = reader.GetOutputInformation(0).Get(
                    vtkStreamingDemandDrivenPipeline.TIME_STEPS())
                self.assertEqual(len(times), STEPS)
                view = View(reader)
                pictures = set()
                for step, time in enumerate(times):
                    reader.UpdateTimeStep(time)
                    pictures.add(view.draw())
                    self.assertEqual(view.work(), (1, step if displaced else 0, step + 1))
                self.assertEqual(len(pictures), STEPS)
        os.remove(name)


if __name__ == "__main__":
    unittest.main()
