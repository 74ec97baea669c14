# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The data sets of composite data."""
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
