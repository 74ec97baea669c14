# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes, their time steps and surfaces from files, by VTK's readers."""
import contextlib
import importlib
import os
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataSet
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter, vtkDataSetSurfaceFilter

# Reader by the ending of the file's name, as VTK module and class. VTK's modules are loaded when
# they are used, because a build of VTK may lack some.
READERS = {
    ".vtu": ("vtkIOXML", "vtkXMLUnstructuredGridReader"),
    ".pvtu": ("vtkIOXML", "vtkXMLPUnstructuredGridReader"),
    ".vti": ("vtkIOXML", "vtkXMLImageDataReader"),
    ".vtr": ("vtkIOXML", "vtkXMLRectilinearGridReader"),
    ".vts": ("vtkIOXML", "vtkXMLStructuredGridReader"),
    ".vtp": ("vtkIOXML", "vtkXMLPolyDataReader"),
    ".vtm": ("vtkIOXML", "vtkXMLMultiBlockDataReader"),
    ".vtk": ("vtkIOLegacy", "vtkDataSetReader"),
    ".vtkhdf": ("vtkIOHDF", "vtkHDFReader"),
    ".hdf": ("vtkIOHDF", "vtkHDFReader"),
    ".e": ("vtkIOExodus", "vtkExodusIIReader"),
    ".ex2": ("vtkIOExodus", "vtkExodusIIReader"),
    ".exo": ("vtkIOExodus", "vtkExodusIIReader"),
    ".case": ("vtkIOEnSight", "vtkGenericEnSightReader"),
    ".cgns": ("vtkIOCGNSReader", "vtkCGNSReader"),
    ".stl": ("vtkIOGeometry", "vtkSTLReader"),
    ".obj": ("vtkIOGeometry", "vtkOBJReader"),
    ".ply": ("vtkIOPLY", "vtkPLYReader"),
}


class ReadingError(Exception):
    """A file that cannot be used; the message names the file and the reason."""


def _make_reader(name):
    suffix = os.path.splitext(name)[1].lower()
    if not os.path.exists(name):
        raise ReadingError(f"{name}: there is no such file")
    if os.path.isdir(name):
        raise ReadingError(f"{name}: this is a folder, not a file")
    if suffix not in READERS:
        raise ReadingError(f"{name}: files that end in '{suffix}' cannot be read; known endings "
                           "are " + ", ".join([*READERS, ".pvd"]))
    module, reader = READERS[suffix]
    try:
        return getattr(importlib.import_module("vtkmodules." + module), reader)()
    except (ImportError, AttributeError):
        raise ReadingError(f"{name}: this build of VTK has no {reader}") from None


@contextlib.contextmanager
def _reading(name):
    """Turns the first error that VTK reports into a ReadingError, and prints none."""
    shown, kept = vtkOutputWindow.GetInstance(), vtkStringOutputWindow()
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(kept)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        yield
    finally:
        vtkOutputWindow.SetInstance(shown)
        vtkLogger.SetStderrVerbosity(vtkLogger.ConvertToVerbosity(verbosity))
    for report in kept.GetOutput().split("ERROR: ")[1:]:
        message = report.split("\n", 1)[-1].split("): ", 1)[-1]
        raise ReadingError(f"{name}: {message.splitlines()[0]}")


class _Source:
    """A reader of one file."""

    def __init__(self, name):
        self.name = name
        self.reader = _make_reader(name)
        if hasattr(self.reader, "SetFileName"):
            self.reader.SetFileName(name)
        else:
            self.reader.SetCaseFileName(name)
        with _reading(name):
            self.reader.UpdateInformation()
        if self.reader.GetClassName() == "vtkExodusIIReader":
            for kind in (self.reader.NODAL, self.reader.ELEM_BLOCK):
                self.reader.SetAllArrayStatus(kind, 1)
        if self.reader.GetClassName() == "vtkDataSetReader":
            self.reader.ReadAllScalarsOn()
            self.reader.ReadAllVectorsOn()
            self.reader.ReadAllFieldsOn()

    def get_times(self):
        """Time values of the file's steps; empty if it has none."""
        information = self.reader.GetOutputInformation(0)
        key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        return list(information.Get(key)) if information.Has(key) else []

    def read(self, time=None):
        with _reading(self.name):
            if time is None:
                self.reader.Update()
            else:
                self.reader.UpdateTimeStep(time)
        return self.reader.GetOutputDataObject(0)


def _read_collection(name):
    """Files and times of a ParaView data file (.pvd)."""
    if not os.path.exists(name):
        raise ReadingError(f"{name}: there is no such file")
    try:
        sets = ElementTree.parse(name).getroot().findall("./Collection/DataSet")
        steps = [(float(item.get("timestep", number)), item.get("file"))
                 for number, item in enumerate(sets)]
    except (ElementTree.ParseError, ValueError) as error:
        raise ReadingError(f"{name}: {error}") from None
    if not steps or not all(file for _, file in steps):
        raise ReadingError(f"{name}: the collection names no files")
    folder = os.path.dirname(name)
    return [(time, os.path.join(folder, file)) for time, file in sorted(steps)]


def leaves_of(data):
    """The data sets of a data set or a composite one; empty blocks are left out."""
    if isinstance(data, vtkDataSet):
        return [data]
    leaves = []
    if isinstance(data, vtkCompositeDataSet):
        iterator = data.NewIterator()
        iterator.InitTraversal()
        while not iterator.IsDoneWithTraversal():
            leaf = iterator.GetCurrentDataObject()
            if isinstance(leaf, vtkDataSet):
                leaves.append(leaf)
            iterator.GoToNextItem()
    return leaves


class MeshSeries:
    """Time steps of a mesh: those of one file, of a .pvd file, or one file per step."""

    def __init__(self, names):
        """names: file names. Several files are the steps of one mesh, in this order."""
        self.steps = []  # pairs of time and a function that reads
        if len(names) == 1 and names[0].lower().endswith(".pvd"):
            named = _read_collection(names[0])
        else:
            named = [(float(number), name) for number, name in enumerate(names)]
        for time, name in named:
            self.steps.append((time, self._make_reading(name)))
        if len(named) == 1:
            source = _Source(named[0][1])
            times = source.get_times()
            self.steps = [(time, lambda time=time: source.read(time)) for time in times] or [
                (0.0, source.read)]

    @staticmethod
    def _make_reading(name):
        return lambda: _Source(name).read()

    def get_times(self):
        return [time for time, _ in self.steps]

    def read(self, step):
        """The data of a step; without cells or arrays it is a ReadingError."""
        data = self.steps[step][1]()
        leaves = leaves_of(data)
        if not any(leaf.GetNumberOfCells() for leaf in leaves):
            raise ReadingError("The mesh has no cells")
        return data


def arrays_of(data):
    """Arrays of points and cells as {name: (association, components)}; points come first."""
    arrays = {}
    for association in ("points", "cells"):
        for leaf in leaves_of(data):
            attributes = leaf.GetPointData() if association == "points" else leaf.GetCellData()
            for index in range(attributes.GetNumberOfArrays()):
                array = attributes.GetArray(index)
                if array is not None and array.GetName() and not _is_internal(array.GetName()):
                    found = (association, array.GetNumberOfComponents())
                    arrays.setdefault(array.GetName(), found)
    return arrays


def _is_internal(name):
    """Arrays that readers and filters add for themselves."""
    return name in ("vtkGhostType", "vtkOriginalPointIds", "vtkOriginalCellIds", "ObjectId",
                    "GlobalNodeId", "GlobalElementId", "PedigreeNodeId", "PedigreeElementId")


def read_surface(name):
    """The surface of a file's data, as vtkPolyData."""
    data = _Source(name).read()
    composite = isinstance(data, vtkCompositeDataSet)
    surface = vtkCompositeDataGeometryFilter() if composite else vtkDataSetSurfaceFilter()
    surface.SetInputDataObject(data)
    surface.Update()
    if surface.GetOutput().GetNumberOfPolys() + surface.GetOutput().GetNumberOfStrips() == 0:
        raise ReadingError(f"{name}: the file has no surface")
    return surface.GetOutput()
