# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes, their time steps and surfaces from files."""
import os

from vtkmodules.vtkCommonCore import vtkBitArray, vtkDoubleArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter, vtkDataSetSurfaceFilter

from ..data import leaves_of
from .cells import check_damage, check_drawable, drawn_leaves_of
from .files import ReadingError, text_of
from .sample import make_sample
from .series import is_collection, open_source

# Name of the mesh that comes with the package.
SAMPLE = "demo"
# Array of a mesh without arrays.
UNIFORM = "uniform"


def _make_uniform(size):
    array = vtkDoubleArray()
    array.SetName(UNIFORM)
    array.SetNumberOfTuples(size)
    array.Fill(1.0)
    return array


class MeshSeries:
    """Time steps of a mesh: the steps of a file or collection, or one step per file."""

    def __init__(self, names):
        """names: file names. Several files are the steps of one mesh, in this order; among them, a
        collection (.pvd, .series) counts with all of its steps. "demo" is the mesh of the package,
            unless there is a file of that name."""
        self.names = list(names)
        self.steps = []  # pairs of time and a function that reads
        for name in names:
            if name == SAMPLE and not os.path.exists(name):
                self.steps.append((float(len(self.steps)), make_sample))
            elif len(names) > 1 and not is_collection(name):
                if not os.path.exists(name):  # before the first step is shown
                    raise ReadingError(f"{name}: there is no such file")
                self.steps.append((float(len(self.steps)), self._make_reading(name)))
            else:
                self._add_source(open_source(name))

    @staticmethod
    def _make_reading(name):
        return lambda: open_source(name).read()

    def _add_source(self, source):
        self.steps += [(time, lambda time=time: source.read(time)) for time in source.get_times()
                       ] or [(float(len(self.steps)), source.read)]

    def get_times(self):
        return [time for time, _ in self.steps]

    def read(self, step):
        """The data of a step; if it is damaged or has no volume, it is a ReadingError. Without an
        array it gets one of cells, UNIFORM, with the value 1."""
        data = self.steps[step][1]()
        _mend_arrays(data)
        check_damage(data)
        check_drawable(data)
        if not arrays_of(data):
            for leaf in drawn_leaves_of(data):
                leaf.GetCellData().AddArray(_make_uniform(leaf.GetNumberOfCells()))
        return data


def _mend_arrays(data):
    """Makes the names of arrays text, where a program has written them in Latin-1, and arrays of
    bits arrays of bytes, which numpy knows."""
    for leaf in leaves_of(data):
        for attributes in (leaf.GetPointData(), leaf.GetCellData()):
            for index in range(attributes.GetNumberOfArrays()):
                array = attributes.GetAbstractArray(index)
                if isinstance(array.GetName(), bytes):
                    array.SetName(text_of(array.GetName()))
                if isinstance(array, vtkBitArray):
                    values = vtkUnsignedCharArray()
                    values.DeepCopy(array)
                    attributes.AddArray(values)  # in its place: names are unique


def arrays_of(data):
    """Arrays of points and cells as {name: (association, components)}; points come first. Of data
    sets that differ in components, the largest number counts."""
    arrays = {}
    leaves = drawn_leaves_of(data)
    for association in ("points", "cells"):
        for leaf in leaves:
            attributes = leaf.GetPointData() if association == "points" else leaf.GetCellData()
            for index in range(attributes.GetNumberOfArrays()):
                array = attributes.GetArray(index)
                if array is not None and array.GetName() and not _is_internal(array.GetName()):
                    place, components = arrays.get(array.GetName(), (association, 0))
                    if place == association:
                        components = max(components, array.GetNumberOfComponents())
                    arrays[array.GetName()] = (place, components)
    return arrays


def _is_internal(name):
    """Arrays that readers and filters add for themselves."""
    return name in ("vtkGhostType", "vtkOriginalPointIds", "vtkOriginalCellIds", "ObjectId",
                    "GlobalNodeId", "GlobalElementId", "PedigreeNodeId", "PedigreeElementId")


def read_surface(name):
    """The surface of a file's data, as vtkPolyData."""
    data = open_source(name).read()
    check_damage(data)
    composite = isinstance(data, vtkCompositeDataSet)
    surface = vtkCompositeDataGeometryFilter() if composite else vtkDataSetSurfaceFilter()
    surface.SetInputDataObject(data)
    surface.Update()
    if surface.GetOutput().GetNumberOfPolys() + surface.GetOutput().GetNumberOfStrips() == 0:
        raise ReadingError(f"{name}: the file has no surface")
    return surface.GetOutput()
