# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Data sets of composite data, components of their arrays, and messages of filters."""
import numbers

from vtkmodules.util.misc import calldata_type
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataSet

from .arguments import warn


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


def with_array(leaf, name, in_points, values):
    """Shallow copy of a data set with a further array of its points or cells; values: of numpy."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk
    copy = leaf.NewInstance()
    copy.ShallowCopy(leaf)
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    (copy.GetPointData() if in_points else copy.GetCellData()).AddArray(array)
    return copy


def replace_leaves(data, leaves, copies):
    """Shallow copy of a data set or a composite one with other data sets in place of its leaves;
    blocks that are not among the leaves are empty."""
    if not isinstance(data, vtkCompositeDataSet):
        return copies[0]
    blocks = data.NewInstance()
    blocks.CopyStructure(data)
    iterator = data.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        for leaf, copy in zip(leaves, copies):
            if iterator.GetCurrentDataObject() is leaf:
                blocks.SetDataSet(iterator, copy)
        iterator.GoToNextItem()
    return blocks


def find_arrays(mesh, scalars, in_cells=True):
    """The arrays of a name, or the active scalars, of the points or else, with in_cells, of the
    cells of the data sets of a mesh, which may be a filter that makes it."""
    if hasattr(mesh, "GetOutputPort"):
        mesh.Update()
        mesh = mesh.GetOutputDataObject(0)
    found = []
    for leaf in leaves_of(mesh):
        for attributes in (leaf.GetPointData(), leaf.GetCellData())[:2 if in_cells else 1]:
            array = attributes.GetArray(scalars) if scalars else attributes.GetScalars()
            if array is not None:
                found.append(array)
                break
    return found


def check_component(name, count, component):
    """Raises a ValueError unless a component of an array is a number below count or "magnitude";
    None is allowed if there is only one."""
    is_number = isinstance(component, numbers.Integral) and not isinstance(component, bool)
    if (is_number or isinstance(component, str)) and component in ("magnitude", *range(count)):
        return
    if component is None and count == 1:
        return
    problem = ("has %d components" % count if component is None
               else "has no component %r" % (component,))
    raise ValueError('The array \'%s\' %s; choose one with component=%s or "magnitude"' % (
        name, problem, ", ".join(map(str, range(count)))))


def run(algorithm):
    """Updates a filter. An error that it reports is a ValueError, a warning a RuntimeWarning."""
    messages = {"ErrorEvent": [], "WarningEvent": []}
    faults = []

    @calldata_type(VTK_STRING)
    def note(caller, event, message):
        lines = [line.strip() for line in message.splitlines() if line.strip()]
        (messages[event] if caller is algorithm else faults).append(
            lines[-1].split("): ", 1)[-1] if lines else "unknown")

    # The pipeline says why it does not run the filter, or repeats that the filter has failed.
    watch = algorithm.GetExecutive().AddObserver("ErrorEvent", note)
    observers = [algorithm.AddObserver(event, note) for event in messages]
    try:
        algorithm.Update()
    finally:
        for observer in observers:
            algorithm.RemoveObserver(observer)
        algorithm.GetExecutive().RemoveObserver(watch)
    if messages["ErrorEvent"] or faults:
        # Warnings that came before may have the reason.
        raise ValueError(" ".join([(messages["ErrorEvent"] or faults)[0],
                                   *messages["WarningEvent"]]))
    for message in messages["WarningEvent"]:
        warn(message, RuntimeWarning)


def take_arrays(algorithm, names):
    """Updates a filter as run() does; returns arrays of the points of its output, by their names.
    It has none if a filter that makes its input has failed, which is a ValueError."""
    run(algorithm)
    points = algorithm.GetOutput().GetPointData()
    found = [points.GetArray(name) for name in names]
    if any(array is None for array in found):
        raise ValueError("There is no mesh: the filter that makes it has failed")
    return found
