# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Colour maps by name."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonColor import vtkColorSeries
from vtkmodules.vtkCommonCore import vtkLookupTable

from .files import import_quietly

# Maps of matplotlib and of Moreland (2009) by colours at equal distances, between which they are
# off by at most 11 of 255; where matplotlib is installed its own are used.
_SAMPLED = {
    "viridis": "440154 48186a 472d7b 424086 3b528b 33638d 2c728e 26828e 21918c 1fa088 28ae80 3fbc73"
               " 5ec962 84d44b addc30 d8e219 fde725",
    "inferno": "000004 0b0724 210c4a 3d0965 57106e 71196e 8a226a a32c61 bc3754 d24644 e45a31 f1731d"
               " f98e09 fcac11 f9cb35 f2ea69 fcffa4",
    "cividis": "00224e 002e6a 1a386f 32436d 434e6c 535a6d 61656f 6f7073 7d7c78 8c8878 9b9476 aba072"
               " bcae6c cdbb63 dec958 f0d846 fee838",
    "coolwarm": "3b4cc0 4e68d8 6282ea 779af7 8db0fe a3c2fe b9d0f9 ccd9ed dddcdc ecd3c5 f5c4ac"
                " f7b093 f4987a eb7d62 dd5f4b ca3b37 b40426",
}
# Schemes of vtkColorSeries (ColorBrewer), all of them ordered.
_SCHEMES = {
    "spectral": "BREWER_DIVERGING_SPECTRAL_11",
    "blue-purple": "BREWER_SEQUENTIAL_BLUE_PURPLE_9",
    "fire": "BREWER_SEQUENTIAL_YELLOW_ORANGE_BROWN_9",
    "blue-green": "BREWER_SEQUENTIAL_BLUE_GREEN_9",
    "purple-orange": "BREWER_DIVERGING_PURPLE_ORANGE_11",
    "brown-green": "BREWER_DIVERGING_BROWN_BLUE_GREEN_11",
}
# Diverging schemes run from warm to cold colours; high values are warm here.
_REVERSED = ("spectral",)
# Names that need no other package, the default first.
COLOR_MAPS = (*_SAMPLED, *_SCHEMES)
# Packages whose maps matplotlib knows by name once they are imported, and the beginnings of these
# names.
_PACKAGES = {"cmocean": "cmo.", "colorcet": "cet_"}
# Presets of ParaView and of Crameri (2018).
_PRESETS = "trame_colormaps.core.presets"
_ENTRIES = 256


def _read_series(name):
    series = vtkColorSeries()
    series.SetColorScheme(getattr(vtkColorSeries, _SCHEMES[name]))
    order = range(series.GetNumberOfColors())
    return [[series.GetColor(index)[channel] / 255.0 for channel in range(3)]
            for index in (reversed(order) if name in _REVERSED else order)]


def _read_matplotlib(name):
    """Colours of a map that matplotlib, cmocean or colorcet have; None if it is not found."""
    matplotlib = import_quietly("matplotlib")
    if matplotlib is None or not hasattr(matplotlib, "colormaps"):
        return None
    maps = matplotlib.colormaps
    for package, prefix in _PACKAGES.items():
        if name not in maps and import_quietly(package) is not None and prefix + name in maps:
            name = prefix + name
    return maps[name](numpy.linspace(0.0, 1.0, _ENTRIES))[:, :3] if name in maps else None


def _read_preset(name):
    """Colours of a preset of trame-colormaps; None if it is not found."""
    presets = import_quietly(_PRESETS)
    function = presets.get_preset_ctf(name) if presets else None
    if function is None:
        return None
    colors = numpy.empty((_ENTRIES, 3))
    function.GetTable(*function.GetRange(), _ENTRIES, colors.ravel())
    return colors


def find_colors(name):
    """Colours from 0 to 1 of a map at equal distances, as rows; None if there is no such map."""
    if name in _SCHEMES:
        return _read_series(name)
    found = _read_matplotlib(name)
    if found is not None:
        return found
    if name not in _SAMPLED:
        return _read_preset(name)
    return [[value / 255.0 for value in bytes.fromhex(color)] for color in _SAMPLED[name].split()]


def list_colors():
    """Names for a menu: COLOR_MAPS and the presets of trame-colormaps, if it is installed."""
    presets = import_quietly(_PRESETS)
    return [*COLOR_MAPS, *dict.fromkeys(presets.get_active_presets() if presets else ())]


def fill_colors(function, name, low, high):
    """Sets a vtkColorTransferFunction to a colour map over a range."""
    colors = find_colors(name)
    function.RemoveAllPoints()
    if name in _SCHEMES:
        function.SetColorSpaceToLab()
    else:
        function.SetColorSpaceToRGB()
    for index, color in enumerate(colors):
        function.AddRGBPoint(low + (high - low) * index / (len(colors) - 1), *map(float, color))


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
