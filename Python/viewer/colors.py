# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Colour maps by name."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonColor import vtkColorSeries
from vtkmodules.vtkCommonCore import vtkLookupTable

# Schemes of vtkColorSeries (ColorBrewer), all of them ordered.
COLOR_MAPS = {
    "spectral": "BREWER_DIVERGING_SPECTRAL_11",
    "blue-purple": "BREWER_SEQUENTIAL_BLUE_PURPLE_9",
    "fire": "BREWER_SEQUENTIAL_YELLOW_ORANGE_BROWN_9",
    "blue-green": "BREWER_SEQUENTIAL_BLUE_GREEN_9",
    "purple-orange": "BREWER_DIVERGING_PURPLE_ORANGE_11",
    "brown-green": "BREWER_DIVERGING_BROWN_BLUE_GREEN_11",
}
# Diverging schemes run from warm to cold colours; high values are warm here.
_REVERSED = ("spectral",)


def fill_colors(function, name, low, high):
    """Sets a vtkColorTransferFunction to a colour map over a range."""
    series = vtkColorSeries()
    series.SetColorScheme(getattr(vtkColorSeries, COLOR_MAPS[name]))
    count = series.GetNumberOfColors()
    function.RemoveAllPoints()
    function.SetColorSpaceToLab()
    for index in range(count):
        color = series.GetColor(count - 1 - index if name in _REVERSED else index)
        function.AddRGBPoint(low + (high - low) * index / (count - 1),
                             *(color[channel] / 255.0 for channel in range(3)))


def make_table(function, low, high, entries=256):
    """A lookup table with the colours of a function, for a scalar bar."""
    colors = numpy.empty((entries, 3))
    function.GetTable(low, high, entries, colors.ravel())
    table = vtkLookupTable()
    table.SetNumberOfTableValues(entries)
    table.SetTableRange(low, high)
    rows = numpy.column_stack([numpy.rint(255.0 * colors), numpy.full(entries, 255.0)])
    table.SetTable(numpy_to_vtk(rows.astype(numpy.uint8), deep=True))
    return table
