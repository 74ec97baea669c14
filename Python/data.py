# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Data sets of composite data, and components of their arrays."""
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataSet


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


def check_component(name, count, component):
    """Raises a ValueError unless a component of an array is a number below count or "magnitude";
    None is allowed if there is only one."""
    if component in ("magnitude", *range(count)) or (component is None and count == 1):
        return
    problem = ("has %d components" % count if component is None
               else "has no component %r" % component)
    raise ValueError('The array \'%s\' %s; choose one with component=%s or "magnitude"' % (
        name, problem, ", ".join(map(str, range(count)))))
