# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Types and values of arguments: a wrong type is a TypeError, a wrong value a ValueError, both with
the argument's name."""
import math
import numbers
import os
import sys
import warnings

from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataSet

_LONGEST_VALUE = 60  # characters of a list that a message repeats; of longer ones it has the type


def refuse(argument, expected, value):
    """Raises a TypeError about an argument."""
    hint = ""
    if isinstance(value, bytes):
        hint = " (bytes.decode() makes a str of bytes)"
    elif expected.startswith("a dataset") and isinstance(value, (str, os.PathLike)):
        hint = " (pyvista.read() reads a file)"
    elif expected.startswith("a dataset") and hasattr(value, "read"):
        hint = " (its read() returns one)"
    elif expected.startswith("a dataset") and hasattr(value, "GetOutputDataObject"):
        hint = " (its GetOutput() returns one)"
    found = type(value).__name__
    if isinstance(value, (list, tuple)) and len(repr(value)) <= _LONGEST_VALUE:
        found = repr(value)
    raise TypeError("%s must be %s, not %s%s" % (argument, expected, found, hint))


def warn(message, category=UserWarning):
    """A warning at the line of the program that called the package, however deep."""
    package, frame, level = __name__.partition(".")[0] + ".", sys._getframe(1), 2
    while frame.f_back and (frame.f_globals.get("__name__") or "").startswith(package):
        frame, level = frame.f_back, level + 1
    warnings.warn(message, category, stacklevel=level)


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


def check_finite(argument, values):
    """Numbers of an array or another collection that must be finite."""
    for each in values:
        if not math.isfinite(each):
            raise ValueError("%s must be finite numbers, not %r" % (argument, float(each)))


def take_number(argument, value, least=-math.inf, above=-math.inf, most=math.inf):
    """A finite number of any type, at least `least`, larger than `above` and at most `most`, as a
    float."""
    try:
        number = None if isinstance(value, (bytes, str)) else float(value)
    except (TypeError, ValueError):
        number = None
    if number is None:
        refuse(argument, "a number", value)
    if not (math.isfinite(number) and least <= number <= most and number > above):
        limits = [text % limit for text, limit in (
            ("at least %g", least), ("above %g", above), ("at most %g", most))
            if math.isfinite(limit)]
        raise ValueError("%s must be a finite number%s, not %r" % (
            argument, " " + " and ".join(limits) if limits else "", number))
    return number


def check_count(argument, value):
    """A whole number of at least 1."""
    if not isinstance(value, numbers.Integral):
        refuse(argument, "a whole number", value)
    if value < 1:
        raise ValueError("%s must be at least 1, not %d" % (argument, value))


def take_range(argument, value):
    """Two finite numbers, the lower one first, as floats."""
    check_numbers(argument, value, 2)
    low, high = map(float, value)
    check_finite(argument, (low, high))
    if low > high:
        raise ValueError("%s must have its lower end first, not %r" % (argument, (low, high)))
    return low, high


def check_plotter(value):
    """A plotter of PyVista."""
    if not hasattr(value, "add_volume"):
        refuse("plotter", "a pyvista.Plotter", value)


def check_dataset(argument, value):
    """A dataset of VTK or PyVista, or a filter whose output is one."""
    if not isinstance(value, (vtkDataSet, vtkCompositeDataSet)) and not hasattr(
            value, "GetOutputPort"):
        refuse(argument, "a dataset", value)
