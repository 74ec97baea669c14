# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Numbers that are shown instead of values that differ too little from each other, or are too small
or too large, for the functions of colour and opacity."""
import math

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from ..data import leaves_of, replace_leaves, with_array

# Functions have nodes at floating-point numbers of 53 binary digits. 256 nodes need 8 of them; 16
# more keep a node's place to 2^-16 of the distance to the next one, the rest is for the offset.
_SMALLEST_SHARE = 2.0 ** (8 + 16 - 52)
# The reciprocal of the distance of two nodes, and the sum of two spreads, are finite in between.
_LARGEST_SPREAD, _SMALLEST_SPREAD = 1e300, 1e-300


class Shown:
    """The numbers (value - offset) * factor, for the values of an array."""

    def __init__(self, offset=0, factor=1.0):
        """offset: an int for an array of whole numbers."""
        self.offset = offset
        self.factor = factor

    def is_plain(self):
        """True if the values themselves are shown."""
        return self.offset == 0 and self.factor == 1.0

    def number_of(self, value):
        return float(value - self.offset) * self.factor

    def name_of(self, array):
        """What the numbers are, such as "T - 1e+15"."""
        text = f"{float(self.offset):g}"
        if float(text) != self.offset:
            text = repr(self.offset)
        name = f"{array} - {text}" if self.offset > 0 else array
        name = f"{array} + {text[1:]}" if self.offset < 0 else name
        return name if self.factor == 1.0 else f"{name} / {1.0 / self.factor:g}"

    def _convert(self, array):
        values = vtk_to_numpy(array)
        if values.ndim > 1:
            return (numpy.linalg.norm(values.astype(float), axis=1) - self.offset) * self.factor
        if isinstance(self.offset, int) and values.dtype.kind in "iu":
            # Differences are exact in 64 bits, where these go round, and small.
            whole = values.astype(numpy.int64).view(numpy.uint64)
            values = (whole - numpy.uint64(self.offset % 2 ** 64)).view(numpy.int64)
            return values.astype(float) * self.factor
        return (values.astype(float) - self.offset) * self.factor

    def apply(self, data, name, association):
        """A shallow copy of the data with these numbers in place of an array."""
        if self.is_plain():
            return data
        leaves, copies = [], []
        for leaf in leaves_of(data):
            attributes = leaf.GetPointData() if association == "points" else leaf.GetCellData()
            if attributes.HasArray(name):
                leaves.append(leaf)
                copies.append(with_array(leaf, name, association == "points",
                                         self._convert(attributes.GetArray(name))))
        return replace_leaves(data, leaves, copies)


def choose_shown(data, name, association, low, high):
    """What is shown of an array with values from low to high."""
    arrays = [attributes.GetArray(name) for attributes in (
        leaf.GetPointData() if association == "points" else leaf.GetCellData()
        for leaf in leaves_of(data)) if attributes.HasArray(name)]
    values = [vtk_to_numpy(array) for array in arrays]
    whole = all(part.dtype.kind in "iu" and part.ndim == 1 for part in values)
    if whole and max(abs(low), abs(high)) >= 2 ** 53:  # not all whole numbers are of this type
        low = min(int(part.min()) for part in values if part.size)
        high = max(int(part.max()) for part in values if part.size)
    return choose_of_range(low, high, whole)


def choose_of_range(low, high, whole):
    """whole: the values are whole numbers."""
    spread = high - low
    largest = max(abs(low), abs(high))
    if not low < high:
        return Shown()
    factor = 1.0
    if not _SMALLEST_SPREAD < spread < _LARGEST_SPREAD:
        factor = _SMALLEST_SPREAD if spread > 1.0 else _LARGEST_SPREAD
    if spread >= _SMALLEST_SHARE * largest:
        return Shown(0, factor)
    # A number of few digits that is near all values: the differences are exact.
    digits = -1 - math.floor(math.log10(spread))
    return Shown(round(int(low), min(digits, 0)) if whole else round(low, digits), factor)
