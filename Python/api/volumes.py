# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Volumes in PyVista's plotters."""
from __future__ import annotations

import difflib
import inspect
import math
import numbers
import re
from typing import TYPE_CHECKING, Any

import numpy
import pyvista
from vtkmodules.vtkCommonCore import VTK_SCALE_LOG10, vtkDataArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_TETRA, vtkUniformGrid, vtkUniformGridAMR, vtkUnstructuredGrid)

from ..arguments import (
    check_count, check_finite, check_numbers, check_plotter, refuse, take_number, take_range, warn)
from ..data import leaves_of
from ..names import BACKENDS, ISOSURFACE_OPACITY, MATERIAL, SCATTERED_SHARE, SHADOWED_MATERIAL
from ..viewer.cells import drawn_cells_of, drawn_leaves_of
from .functions import check_color_map, follow_table, make_opaque, take_opacity
from .mapper import make_mapper
from .scalars import Scalars, without_mask
from .surfaces import connect

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .types import Array, Indices, Mesh, Surfaces

# Colour maps that plotter.add_volume() gives the blocks of a dataset with multi_colors.
_BLOCK_COLORS = ("Reds", "Greens", "Blues", "Greys", "Oranges", "Purples")

# Arguments for surfaces, which plotter.add_volume() does not take, and what volumes have instead.
_INSTEAD = {
    "color": "cmap=[\"red\", \"red\"] draws all values in one colour",
    "nan_color": "cells without a finite value are not drawn",
    "above_color": "the range ends with the last colour of cmap",
    "below_color": "the range begins with the first colour of cmap",
    "show_edges": "plotter.add_mesh(mesh, style=\"wireframe\") adds the edges",
    "style": "blending= chooses how the values along a ray are shown",
    "smooth_shading": "light=True has light, which is smooth",
}

# Anti-aliasing that is for edges, where it leaves the number of a volume's rays as it is.
_AT_EDGES = ("msaa", "fxaa")


def _make_stand_in(bounds, scalars):
    """A tetrahedron with the bounds of a mesh and the extremes of its scalars. plotter.add_volume()
    makes of it all that a volume has besides its mapper."""
    left, right, front, back, bottom, top = bounds
    extremes = scalars.get_range()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    values = vtkDataArray.CreateDataArray(scalars.arrays[0].GetDataType())
    values.SetName(scalars.name)
    for point, value in zip(
            ((left, front, bottom), (right, back, bottom), (right, front, top), (left, back, top)),
            (*extremes, *extremes)):
        points.InsertNextPoint(point)
        values.InsertNextTuple1(value)
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.InsertNextCell(VTK_TETRA, 4, (0, 1, 2, 3))
    grid.GetPointData().SetScalars(values)
    return pyvista.wrap(grid)


def _find_unit_distance(mesh, bounds):
    """Length over which opacities are given: for image data as in plotter.add_volume()."""
    if isinstance(mesh, (pyvista.ImageData, pyvista.RectilinearGrid)):
        return mesh.length / max(1, sum(mesh.dimensions) / 3 - 1)
    length = math.hypot(*(bounds[2 * i + 1] - bounds[2 * i] for i in range(3)))
    cells = sum(int(drawn_cells_of(leaf).sum()) for leaf in drawn_leaves_of(mesh))
    return length / max(1, cells) ** (1 / 3)


def _add_blocks(plotter, blocks, scalars, name, arguments):
    """Adds each block of a dataset in colours of its own; returns the volumes."""
    name = name or "blocks(%s)" % blocks.GetAddressAsString("")
    volumes = []
    for number, block in enumerate(blocks):
        if block is not None:
            arguments["cmap"] = _BLOCK_COLORS[len(volumes) % len(_BLOCK_COLORS)]
            volumes.append(add_to(
                block, plotter, scalars, name="%s-%d" % (name, number), **arguments))
    return volumes


def _add_bar(plotter, title, scalar_bar_args, show_scalar_bar):
    """Adds a scalar bar by the rules of plotter.add_volume()."""
    if show_scalar_bar is None:
        show_scalar_bar = plotter.theme.show_scalar_bar or scalar_bar_args
    if show_scalar_bar:
        arguments = dict(scalar_bar_args or {})
        if title is not None:
            arguments.setdefault("title", title)
        plotter.add_scalar_bar(**arguments)


def _time_of(mesh):
    """Time of the last change of a mesh; a MultiBlock does not know those of its blocks."""
    return max([mesh.GetMTime()] + [leaf.GetMTime() for leaf in leaves_of(mesh)])


def _follow_mesh(renderer, mapper, mesh, choose):
    """Mixes the components that a mapper draws again, before a frame, when the mesh has changed.
    choose(mesh): returns Scalars."""
    last = _time_of(mesh)

    def look(caller, _event):
        nonlocal last
        volumes = caller.GetVolumes()
        if not any(volumes.GetItemAsObject(index).GetMapper() is mapper
                   for index in range(volumes.GetNumberOfItems())):
            caller.RemoveObserver(tag)  # the volume has gone, and the mesh may go
        elif _time_of(mesh) > last:
            last = _time_of(mesh)
            mapper.SetInputData(choose(mesh).mesh)

    tag = renderer.AddObserver("StartEvent", look)


def _choose_limits(arguments, scalars):
    """Range of the colours for plotter.add_volume(), in arguments."""
    if arguments.get("clim", arguments.get("rng")) is None:
        if arguments.get("log_scale"):
            arguments["clim"] = scalars.get_positive_range()
        elif scalars.limits is not None:
            arguments["clim"] = tuple(map(float, scalars.limits))
        elif scalars.are_truths():  # bytes are from 0 to 255
            arguments["clim"] = 0.0, 1.0


def _choose_look(arguments, blending, light, shadows):
    """Light, material and opacity for plotter.add_volume(), in arguments."""
    surfaces = blending == "isosurface"
    if light is None:
        light = surfaces or shadows > 0.0
    if light:
        arguments.setdefault("shade", True)
        for name, value in (SHADOWED_MATERIAL if shadows else MATERIAL).items():
            arguments.setdefault(name, value)
    if surfaces:
        arguments.setdefault("opacity", [ISOSURFACE_OPACITY] * 2)


def _check_numbers(arguments, unit_distance):
    """Raises a ValueError for numbers that PyVista and VTK take without a word, and that leave
    nothing to be seen, or something else."""
    if unit_distance is not None:
        take_number("opacity_unit_distance", unit_distance, above=0.0)
    for name in MATERIAL:
        if arguments.get(name) is not None:
            arguments[name] = take_number(name, arguments[name], least=0.0)
    for name in ("clim", "rng"):
        _check_limits(name, arguments)
    if arguments.get("n_colors") is not None:
        check_count("n_colors", arguments["n_colors"])
    _check_opacity(arguments.get("opacity"))
    matrix = arguments.get("user_matrix")
    if isinstance(matrix, numpy.ndarray) and matrix.dtype.kind == "f":
        check_finite("user_matrix", matrix.ravel())


def _check_opacity(opacity):
    """The name of a function, a number, or a list of them."""
    if opacity is None or isinstance(opacity, str):
        return
    values = None if isinstance(opacity, (bytes, dict)) else numpy.asarray(opacity)
    if values is None or values.dtype.kind not in "biuf" or values.ndim > 1 or not values.size:
        refuse("opacity", "the name of a function, a number or a list of numbers", opacity)
    check_finite("opacity", values.ravel())
    if (values < 0).any():
        raise ValueError("opacity must be numbers of at least 0, not %r" % float(values.min()))


def _check_limits(name, arguments):
    """Makes a pair of the range of the colours, which one number stands for as well."""
    value = arguments.get(name)
    if value is None:
        return
    if not hasattr(value, "__len__"):
        value = take_number(name, value, least=0.0)
        value = -value, value
    arguments[name] = take_range(name, value)
    if arguments.get("log_scale") and arguments[name][1] <= 0.0:
        raise ValueError("%s must have an upper end above 0 for log_scale, not %r" % (
            name, arguments[name]))


def _take_shadows(shadows, properties):
    """The reach of shadows, which the mapper's properties get with the light that is scattered."""
    reach = take_number("shadows", shadows, least=0.0, most=1.0)
    if reach > 0.0:
        properties.setdefault("GlobalIlluminationReach", reach)
        properties.setdefault("VolumetricScatteringBlending", SCATTERED_SHARE)
    return reach


def _choose_blending(blending, isovalues, scalars):
    """Name of the blend mode, of which isovalues select isosurfaces if none is given."""
    if blending is None:
        blending = "composite" if isovalues is None else "isosurface"
    if not isinstance(blending, (str, int)):
        refuse("blending", "the name of a blend mode", blending)
    if blending == "isosurfaces":
        blending = "isosurface"
    if isovalues is not None:
        _check_isovalues(isovalues)
    if isovalues is not None and blending != "isosurface":
        raise ValueError("isovalues are those of blending=\"isosurface\", not of '%s'" % blending)
    if scalars.is_mixed and blending not in ("composite", 0):
        raise ValueError("rgba and opacity_array need blending=\"composite\"")
    return blending


def _check_isovalues(isovalues):
    """Values, or their number."""
    if isinstance(isovalues, (bytes, str)):
        refuse("isovalues", "a whole number, or a list of values", isovalues)
    if not hasattr(isovalues, "__len__"):
        if not isinstance(isovalues, numbers.Integral):
            refuse("isovalues", "a whole number, or a list of values", isovalues)
        check_count("isovalues", isovalues)
        return
    check_numbers("isovalues", isovalues, len(isovalues))
    check_count("The number of isovalues", len(isovalues))
    check_finite("isovalues", isovalues)


def _set_isovalues(look, isovalues, limits, is_logarithmic):
    """isovalues: values, or the number of values at equal distances inside limits, of their
    logarithms if is_logarithmic."""
    if not hasattr(isovalues, "__len__"):
        space = numpy.geomspace if is_logarithmic and limits[0] > 0.0 else numpy.linspace
        isovalues = space(*limits, isovalues + 2)[1:-1]
    contours = look.GetIsoSurfaceValues()
    contours.SetNumberOfContours(len(isovalues))
    for index, value in enumerate(isovalues):
        contours.SetValue(index, value)


def _find_largest(function, low, high):
    """The largest value of a vtkPiecewiseFunction from low to high."""
    node = [0.0] * 4
    places = []
    for index in range(function.GetSize()):
        function.GetNodeValue(index, node)
        if low < node[0] < high:
            places.append(node[0])
    return max(function.GetValue(place) for place in (low, *places, high))


def _warn_of_thinness(largest, bounds, unit_distance):
    """Warns of a volume that a picture of 8 bits does not show, from its broadest side.

    largest: opacity over the unit distance.
    """
    shortest = min(bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3))
    if 0.0 < largest * shortest / unit_distance < 1.0 / 255.0:
        warn("The volume is all but transparent along its shortest side, of %g: opacities are over "
             "the length %g; give another one with opacity_unit_distance" % (
                 shortest, unit_distance))


def _warn_of_emptiness(look, scalars, blending, bounds):
    """Warns of a volume of which nothing is seen, or hardly anything."""
    low, high = map(float, scalars.get_range())
    if blending != "isosurface":
        largest = _find_largest(look.GetScalarOpacity(), low, high)
        empty, reason = largest <= 0.0, "the opacity is 0 for all of its values"
        if blending in ("composite", 0):
            _warn_of_thinness(largest, bounds, look.GetScalarOpacityUnitDistance())
    else:
        contours = look.GetIsoSurfaceValues()
        values = [contours.GetValue(index) for index in range(contours.GetNumberOfContours())]
        empty, reason = not any(
            low <= value <= high for value in values), "it has none of the isovalues"
    if empty:
        warn("Nothing of '%s' can be seen: %s, from %g to %g" % (scalars.name, reason, low, high))


def _take_array(values):
    """An array with three dimensions in a type that VTK has; masked values are not numbers."""
    if values.dtype.kind not in "biuf" or values.ndim != 3:
        raise ValueError("An array is a volume if it has three dimensions and real numbers, not "
                         "%d dimensions of %s" % (values.ndim, values.dtype))
    values = without_mask(values)
    if values.dtype.kind == "f" and values.dtype.itemsize not in (4, 8):
        return values.astype(numpy.float32 if values.dtype.itemsize < 4 else float)
    return values


def _as_image(grid):
    """A vtkUniformGrid, which PyVista does not know, as an image."""
    image = pyvista.ImageData()
    image.ShallowCopy(grid)
    return image


def _wrap(mesh, resolution):
    """A mesh of any library as PyVista's. resolution: distances of the values of an array with
    three dimensions, which plotter.add_volume() takes as well."""
    if resolution is not None:
        if not isinstance(mesh, numpy.ndarray):
            raise ValueError("resolution is the spacing of an array of values; a mesh has its own")
        check_numbers("resolution", resolution, 3)
    if isinstance(mesh, numpy.ndarray):
        mesh = _take_array(mesh)
    elif isinstance(mesh, vtkUniformGrid):
        mesh = _as_image(mesh)
    elif isinstance(mesh, vtkUniformGridAMR):
        mesh = pyvista.MultiBlock([_as_image(leaf) for leaf in leaves_of(mesh)])
    try:
        wrapped = pyvista.wrap(mesh)
    except (NotImplementedError, TypeError):
        wrapped = None
    if wrapped is None:
        refuse("mesh", "a dataset", mesh)
    if resolution is not None:
        wrapped.spacing = [take_number("resolution", each, above=0.0) for each in resolution]
    return wrapped


def _add_stand_in(plotter, *positional, **named):
    """plotter.add_volume(); an error about a name that it does not know says what there is instead,
    or has names that are like it."""
    try:
        return plotter.add_volume(*positional, **named)
    except TypeError as error:
        wrong = re.match(r'"(\w+)".* invalid keyword', str(error))
        if not wrong:
            raise
        if wrong[1] in _INSTEAD:
            raise TypeError("%s; %s" % (error, _INSTEAD[wrong[1]])) from None
        known = {name for function in (plot, add_to, plotter.add_volume)
                 for name in inspect.signature(function).parameters}
        near = difflib.get_close_matches(wrong[1], sorted(known))
        raise TypeError("%s%s" % (error, near and "; did you mean %s?" % " or ".join(near) or "")
                        ) from None


def _refuse_mapper(mapper):
    """plotter.add_volume()'s choice among VTK's mappers."""
    if mapper is not None:
        raise ValueError("mapper=%r is a choice among PyVista's mappers; the rays of "
                         "vtkTetrahedraRayCastMapper are cast by backend=, one of %s" % (
                             mapper, ", ".join(BACKENDS)))


def add_to(
    mesh: Mesh, /, plotter: pyvista.Plotter, scalars: str | Array | None = None, *,
    component: int | str | None = None, rgba: bool | None = None,
    opacity_array: str | None = None, opacity_component: int | str | None = None,
    opacity_clim: Sequence[float] | None = None,
    blending: str | None = None, isovalues: int | Sequence[float] | None = None,
    light: bool | None = None, shadows: bool | float = False,
    opacity_unit_distance: float | None = None, backend: str = "automatic",
    surfaces: Surfaces | None = None, indices: Indices = 1.333,
    preference: str = "point", categories: bool | int = False,
    resolution: Sequence[float] | None = None,
    scalar_bar_args: dict[str, Any] | None = None, show_scalar_bar: bool | None = None,
    render: bool = True, name: str | None = None, multi_colors: bool = False, **arguments: Any,
) -> Any:
    """Adds a mesh to a plotter as a volume and returns the pyvista.Volume.

    mesh: a dataset with cells that have a volume, of any type. The blocks of a pyvista.MultiBlock,
        or of an AMR grid of VTK, are one mesh with one range of values; blocks without the array or
        without volume are left out.
    plotter: pyvista.Plotter.
    scalars: name of an array of points or cells, or the values themselves, one per point or cell;
        default: the active scalars. Cells with masked values are not drawn.
    component: number of a component from 0, or "magnitude"; needed for an array with several.
    rgba: draws an array of points with 3 or 4 components as colours, and the fourth as opacity:
        uint8 from 0 to 255, or floating-point numbers from 0 to 1. Default: whether there are 4
        components of uint8, as in plotter.add_volume().
    opacity_array: name of another array of points, which the opacity is taken from; the colours
        are those of scalars. opacity_component: as component. opacity_clim: range over which
        `opacity` runs, (low, high); default: the range of the array's values.
    blending: "composite" (default), "maximum", "minimum", "average", "additive", "isosurface".
    isovalues: values of isosurfaces, or the number of values at equal distances inside clim (with
        log_scale, of their logarithms), for blending="isosurface", which they select; default: 3.
    light: whether the volume is lit, with one material for all. Default: isosurfaces only.
        PyVista's shade, ambient, diffuse, specular and specular_power override it.
    shadows: whether the volume casts shadows into itself, and scatters light; True, or the share of
        the volume's size that shadows reach, from 0 to 1. The volume is then lit. Shadows are cast
        again whenever a light moves: lights that follow the camera make turning slower. Default:
        False.
    opacity_unit_distance: the length over which opacities are given, in the mesh's unit; default:
        the mesh's diagonal divided by the mean number of cells along an axis. Over this length an
        image or rectilinear grid has the given opacity, another mesh 1 - exp(-opacity), as with
        plotter.add_volume().
    backend: what casts the rays: "automatic" (default), "opengl", "compute", "native".
    surfaces, indices: refracting surfaces through which the volume is seen, and indices of
        refraction; see meniscus.refracted(). Default: none.
    multi_colors: adds each block of a pyvista.MultiBlock as a volume of its own in colours of its
        own, blended in the order of the blocks; returns a list of them. Default: False.
    preference, categories, resolution, scalar_bar_args, show_scalar_bar, render, name: as in
        plotter.add_volume().
    arguments: all other arguments of plotter.add_volume() but mapper, such as cmap (a name of
        PyVista, matplotlib, cmocean or colorcet), opacity, clim, log_scale, n_colors, user_matrix;
        and properties of vtkTetrahedraRayCastMapper, such as CellDivision="adaptive". With
        log_scale, colour and opacity depend on the logarithm of the value; without clim, from the
        least value above 0 on.

    Raises ValueError for a mesh without volume, for several components without a choice, for
    scalars that are missing or not finite, for numbers that are not finite or out of range, limits
    whose upper end comes first, and for names of modes and colour maps that do not exist (the
    message lists those that do); KeyError for the name of an array that does not exist.
    """
    _refuse_mapper(arguments.pop("mapper", None))
    source, mesh = mesh, _wrap(mesh, resolution)
    check_plotter(plotter)
    if multi_colors and isinstance(mesh, pyvista.MultiBlock):
        return _add_blocks(plotter, mesh, scalars, name, dict(
            arguments, component=component, rgba=rgba, opacity_array=opacity_array,
            opacity_component=opacity_component, opacity_clim=opacity_clim, blending=blending,
            isovalues=isovalues, light=light, shadows=shadows,
            opacity_unit_distance=opacity_unit_distance, backend=backend, surfaces=surfaces,
            indices=indices, preference=preference, categories=categories,
            scalar_bar_args=scalar_bar_args, show_scalar_bar=show_scalar_bar, render=render))
    if opacity_array is not None and rgba:
        raise ValueError("rgba=True has an opacity of its own; leave opacity_array out")

    def choose(mesh):
        chosen = Scalars(mesh, scalars, preference, component,
                         False if rgba is None and opacity_array is not None else rgba)
        if opacity_array is not None:
            chosen.add_opacity(opacity_array, opacity_component, opacity_clim)
        return chosen

    chosen = choose(mesh)
    if not isinstance(categories, bool):
        check_count("categories", categories)
    blending = _choose_blending(blending, isovalues, chosen)
    _check_numbers(arguments, opacity_unit_distance)
    properties = {key: arguments.pop(key) for key in list(arguments) if key[0].isupper()}
    check_color_map(arguments.get("cmap"))
    _choose_limits(arguments, chosen)
    _choose_look(arguments, blending, light, _take_shadows(shadows, properties))
    mapper = make_mapper(chosen, blending, backend, properties)
    if opacity_unit_distance is None:
        opacity_unit_distance = _find_unit_distance(chosen.mesh, tuple(mapper.GetBounds()))
    if surfaces is not None:
        connect(mapper, surfaces, indices)
    volume = _add_stand_in(
        plotter, _make_stand_in(tuple(mapper.GetBounds()), chosen), scalars=chosen.name,
        categories=chosen.count_categories(categories),
        opacity_unit_distance=opacity_unit_distance, show_scalar_bar=False, render=False,
        name=name or "%s(%s)" % (type(mesh).__name__, mapper.GetAddressAsString("")), **arguments)
    mapper.scalar_range = volume.mapper.scalar_range
    # After the range: a user's table keeps its own.
    mapper.lookup_table = volume.mapper.lookup_table
    mapper.source = source
    volume.mapper = mapper
    plotter.mapper = mapper
    look = volume.prop
    table = mapper.lookup_table
    if chosen.opacity_limits:
        opacity = take_opacity(table, chosen.opacity_limits)
        if table is not arguments.get("cmap"):
            make_opaque(table)  # the legend shows colours alone
        follow_table(look, table, opacity)
    elif table.GetScale() == VTK_SCALE_LOG10 or pyvista.version_info < (0, 45):
        follow_table(look, table)
    if chosen.is_mixed:
        look.SetIndependentComponents(False)
        _follow_mesh(plotter.renderer, mapper, mesh, choose)
    if blending == "isosurface":
        _set_isovalues(look, 3 if isovalues is None else isovalues, mapper.scalar_range,
                       table.GetScale() == VTK_SCALE_LOG10)
    if not chosen.is_mixed:
        _warn_of_emptiness(look, chosen, blending, mapper.GetBounds())
    if not chosen.has_colors:
        _add_bar(plotter, chosen.title, scalar_bar_args, show_scalar_bar)
    if render:
        plotter.render()
    return volume


def _furnish(plotter, text, show_axes, show_bounds, show_grid):
    """Adds what pyvista.plot() shows beside the mesh."""
    if show_axes if show_axes is not None else plotter.theme.axes.show:
        plotter.add_axes()
    if text:
        plotter.add_text(text)
    if show_grid:
        plotter.show_grid()
    elif show_bounds:
        plotter.show_bounds()


def _place_camera(plotter, cpos, zoom, parallel_projection):
    """Places the camera as pyvista.plot() does."""
    plotter.camera_position = plotter.get_default_cam_pos() if cpos is None else cpos
    plotter.camera_set = cpos is not None
    if parallel_projection:
        plotter.enable_parallel_projection()
    if zoom is not None:
        plotter.camera.zoom(zoom)


def _smooth_edges(plotter, anti_aliasing):
    """Anti-aliasing as pyvista.plot() has it."""
    if anti_aliasing is True:
        plotter.enable_anti_aliasing()
    elif anti_aliasing is False:
        plotter.disable_anti_aliasing()
    elif anti_aliasing is not None:
        plotter.enable_anti_aliasing(anti_aliasing)


def _refuse_surfaces(volume, eye_dome_lighting, ssao):
    """Arguments of pyvista.plot() that are for surfaces alone."""
    if not volume:
        raise ValueError("volume=False draws surfaces, which pyvista.plot() does")
    for name, value in ("eye_dome_lighting", eye_dome_lighting), ("ssao", ssao):
        if value:
            raise ValueError("%s shades surfaces; shadows=True has shadows in volumes" % name)


def plot(
    mesh: Mesh, /, scalars: str | Array | None = None, *, off_screen: bool | None = None,
    window_size: Sequence[int] | None = None, background: Any = None, cpos: Any = None,
    zoom: float | str | None = None, parallel_projection: bool = False, text: str = "",
    screenshot: Any = False, show_axes: bool | None = None, show_bounds: bool = False,
    show_grid: bool = False, full_screen: bool | None = None, interactive: bool = True,
    notebook: bool | None = None, theme: Any = None, jupyter_backend: str | None = None,
    return_img: bool = False, return_cpos: bool = False, return_viewer: bool = False,
    jupyter_kwargs: dict[str, Any] | None = None, before_close_callback: Any = None,
    auto_close: bool | None = None, anti_aliasing: str | bool | None = None,
    border: bool | None = None, border_color: Any = None, border_width: float | None = None,
    volume: bool = True, eye_dome_lighting: bool = False, ssao: bool = False, **arguments: Any,
) -> Any:
    """Shows a mesh as a volume in a window, or in a notebook.

    mesh, scalars: as in meniscus.add_to().
    off_screen: draws without a window; default: PyVista's setting.
    window_size: width and height in pixels; default: PyVista's setting.
    background: colour; default: PyVista's theme.
    cpos: camera position as pyvista.plot() takes it, such as "xy".
    zoom, parallel_projection, text, show_bounds, show_grid, full_screen, interactive, notebook,
        theme, return_cpos, return_viewer, jupyter_kwargs, before_close_callback, auto_close,
        border, border_color, border_width: as in pyvista.plot().
    anti_aliasing: "ssaa", "msaa", "fxaa", True or False, as in pyvista.plot(); default: the
        theme's, which is "msaa" in PyVista. With "msaa" and "fxaa" still pictures of the volume
        have up to 16 rays per pixel at edges, as by ImageSampleDistance=0.25.
    volume, eye_dome_lighting, ssao: for calls written for pyvista.plot(); other values than the
        defaults are refused, because surfaces are shaded by them. shadows has shadows in volumes.
    screenshot: file name of a picture, or True to return it.
    show_axes: whether axes are shown in a corner; default: PyVista's setting.
    jupyter_backend: in a notebook "trame" or "server" (pictures that the kernel draws, turned with
        the mouse), "static" (one picture) or "none". The browser cannot draw these volumes itself:
        "client" and "html" are a ValueError. Default: "server" where trame is installed, otherwise
        "static".
    return_img: returns the picture, (height, width, 3) of uint8.
    arguments: all other arguments of meniscus.add_to().

    Returns what pyvista.Plotter.show() returns.
    """
    from .notebook import choose_backend

    _refuse_surfaces(volume, eye_dome_lighting, ssao)
    if window_size is not None:
        check_numbers("window_size", window_size, 2, numbers.Integral)
    backend = choose_backend(jupyter_backend)
    plotter = pyvista.Plotter(
        off_screen=off_screen, window_size=window_size, notebook=notebook, theme=theme,
        border=border, border_color=border_color, border_width=border_width)
    if background is not None:
        plotter.set_background(background)
    if (plotter.theme.anti_aliasing if anti_aliasing is None else anti_aliasing) in _AT_EDGES:
        arguments.setdefault("ImageSampleDistance", 0.25)
    add_to(mesh, plotter, scalars, **{"render": False, **arguments})
    _furnish(plotter, text, show_axes, show_bounds, show_grid)
    _place_camera(plotter, cpos, zoom, parallel_projection)
    _smooth_edges(plotter, anti_aliasing)
    return plotter.show(
        screenshot=screenshot, full_screen=full_screen, interactive=interactive,
        return_img=return_img, return_cpos=return_cpos, return_viewer=return_viewer,
        auto_close=auto_close, before_close_callback=before_close_callback,
        jupyter_kwargs=jupyter_kwargs or {},
        **({"jupyter_backend": backend} if plotter.notebook else {}))
