# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Colour and opacity functions of lookup tables, and colour maps by name."""
import importlib.util

import numpy
import pyvista
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_SCALE_LOG10, vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

from ..arguments import refuse

# Nodes of the functions of a logarithmic table. Between two nodes, functions are linear in the
# value instead of its logarithm: for a ratio r of their values, off by up to ln(r) / 8 of the step
# between them, 0.5 % for four decades.
_LOGARITHMIC_NODES = 256


def check_color_map(cmap):
    """Raises a ValueError for the name of a colour map that neither PyVista nor matplotlib,
    cmocean or colorcet have; it lists names and says which packages are not installed."""
    if isinstance(cmap, (bytes, int, float)):
        refuse("cmap", "the name of a colour map, a str, or a colour map", cmap)
    if not isinstance(cmap, str):
        return
    try:
        pyvista.get_cmap_safe(cmap)
    except (ValueError, KeyError, TypeError, ImportError) as error:
        missing = [name for name in ("matplotlib", "cmocean", "colorcet")
                   if importlib.util.find_spec(name) is None]
        text = "There is no colour map '%s': %s" % (cmap, error)
        if "matplotlib" not in missing:
            import matplotlib
            names = (name for name in matplotlib.colormaps if not name.endswith("_r"))
            text += "; matplotlib has " + ", ".join(sorted(names, key=str.lower))
        if missing:
            text += ("; more are in packages that are not installed: pip install "
                     + " ".join(missing))
        raise ValueError(text) from None


def _make_nodes(table):
    """Scalars of the nodes of a table's functions, and the indices of their entries, which may be
    fractions."""
    last = max(1, table.GetNumberOfTableValues() - 1)
    limits = list(table.GetTableRange())
    if table.GetScale() != VTK_SCALE_LOG10:
        entries = numpy.arange(last + 1)
        return limits[0] + (limits[1] - limits[0]) * entries / last, entries
    exponents = [0.0, 0.0]
    vtkLookupTable.GetLogRange(limits, exponents)
    entries = numpy.linspace(0, last, last * -(-_LOGARITHMIC_NODES // last) + 1)
    return 10.0 ** numpy.interp(entries, (0, last), exponents), entries


def make_functions(table):
    """Colour and opacity functions of a vtkLookupTable over its range."""
    colors = vtkColorTransferFunction()
    opacity = vtkPiecewiseFunction()
    values = vtk_to_numpy(table.GetTable()) / 255.0
    scalars, entries = _make_nodes(table)
    channels = [numpy.interp(entries, range(len(values)), channel) for channel in values.T]
    for scalar, red, green, blue, alpha in zip(scalars, *channels):
        colors.AddRGBPoint(scalar, red, green, blue)
        opacity.AddPoint(scalar, alpha)
    return colors, opacity


def take_opacity(table, limits):
    """Opacity function of a table over limits."""
    values = vtk_to_numpy(table.GetTable())
    opacity = vtkPiecewiseFunction()
    for place, alpha in zip(numpy.linspace(*limits, len(values)), values[:, 3] / 255.0):
        opacity.AddPoint(place, alpha)
    return opacity


def make_opaque(table):
    """Sets all opacities of a table to 1."""
    vtk_to_numpy(table.GetTable())[:, 3] = 255
    table.Modified()


def follow_table(look, table, opacity=None):
    """Gives a volume property the functions of a table, now and whenever the table changes. Those
    of PyVista run over the indices of the entries up to version 0.44, and over the value where the
    table's scale is logarithmic. opacity: function that is used instead of the table's."""
    def apply(*_):
        colors, own = make_functions(table)
        look.SetColor(colors)
        look.SetScalarOpacity(own if opacity is None else opacity)

    apply()
    # After the observer of PyVista, which is renewed whenever it is called.
    table.AddObserver("ModifiedEvent", apply, -1.0)
