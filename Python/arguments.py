# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Types of arguments: a wrong one is a TypeError that names the argument."""
import numbers
import os

from vtkmodules.vtkCommonDataModel import vtkDataObject


def refuse(argument, expected, value):
    """Raises a TypeError about an argument."""
    hint = ""
    if isinstance(value, bytes):
        hint = " (bytes.decode() makes a str of bytes)"
    elif expected.startswith("a dataset") and isinstance(value, (str, os.PathLike)):
        hint = " (pyvista.read() reads a file)"
    raise TypeError("%s must be %s, not %s%s" % (argument, expected, type(value).__name__, hint))


def check_name(argument, value):
    """The name of an array, or None."""
    if value is not None and not isinstance(value, str):
        refuse(argument, "the name of an array, a str", value)


def check_names(argument, value):
    """A name, or several: a list of them."""
    names = [value] if isinstance(value, str) else value
    if not isinstance(names, (list, tuple)) or not all(isinstance(each, str) for each in names):
        refuse(argument, "a name or a list of names", value)
    return list(names)


def check_values(argument, value):
    """The name of an array, or the values themselves, or None."""
    import numpy
    if value is None or isinstance(value, str):
        return
    kind = "" if isinstance(value, (bytes, dict, os.PathLike)) else numpy.asarray(value).dtype.kind
    if kind not in tuple("biuf") or numpy.ndim(value) == 0:
        refuse(argument, "the name of an array, a str, or its values, one per point or cell", value)


def check_numbers(argument, value, count, kind=numbers.Real):
    """A given number of numbers."""
    try:
        found = () if isinstance(value, bytes) else tuple(value)
    except TypeError:
        found = ()
    if len(found) != count or not all(isinstance(each, kind) for each in found):
        refuse(argument, "%d %s" % (
            count, "whole numbers" if kind is numbers.Integral else "numbers"), value)


def check_dataset(argument, value):
    """A dataset of VTK or PyVista, or a filter whose output is one."""
    if not isinstance(value, vtkDataObject) and not hasattr(value, "GetOutputPort"):
        refuse(argument, "a dataset", value)
