# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Helpers for PyVista: volumes of tetrahedra, and geometry seen through a refracting surface."""
import math

import numpy
import pyvista
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_SCALE_LOG10, vtkDataArray, vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_TETRA, vtkCompositeDataSet, vtkPiecewiseFunction, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

from .data import check_component
from .viewer.cells import (
    check_drawable, drawn_cells_of, drawn_leaves_of, drawn_points_of)
from .viewer.files import ReadingError
from .vtkMeniscus import (
    vtkRefractedGeometryFilter, vtkRefractingInterface, vtkRefractingInterfaceCollection,
    vtkTetrahedraRayCastMapper)


def _set(target, properties):
    """Calls target's SetX for every X=value; an unknown name is an AttributeError."""
    for name, value in properties.items():
        getattr(target, "Set" + name)(value)


_BLEND_MODES = ("composite", "maximum", "minimum", "average", "additive")
# Colour maps that plotter.add_volume() gives the blocks of a dataset with multi_colors.
_BLOCK_COLORS = ("Reds", "Greens", "Blues", "Greys", "Oranges", "Purples")


class TetrahedraRayCastMapper(vtkTetrahedraRayCastMapper):
    """A vtkTetrahedraRayCastMapper with the attributes of PyVista's volume mappers, by which its
    plotters and scalar bars set the range."""

    def __init__(self):
        self._lookup_table = None
        self._scalar_range = (0.0, 1.0)

    @property
    def dataset(self):
        """Dataset that is drawn."""
        return pyvista.wrap(self.GetInputDataObject(0, 0))

    @property
    def lookup_table(self):
        """pyvista.LookupTable of the colours and opacities."""
        return self._lookup_table

    @lookup_table.setter
    def lookup_table(self, table):
        self._lookup_table = table

    @property
    def scalar_range(self):
        """Range of the lookup table."""
        return self._scalar_range

    @scalar_range.setter
    def scalar_range(self, limits):
        self._scalar_range = tuple(limits)
        if self._lookup_table is not None:
            self._lookup_table.SetRange(*limits)

    @property
    def blend_mode(self):
        """Name of the blend mode, or its number if PyVista has no name for it."""
        mode = self.GetBlendMode()
        return _BLEND_MODES[mode] if mode < len(_BLEND_MODES) else mode

    @blend_mode.setter
    def blend_mode(self, mode):
        if isinstance(mode, str):
            if mode not in _BLEND_MODES:
                raise ValueError("There is no blending '%s'; there are %s" % (
                    mode, ", ".join(_BLEND_MODES)))
            mode = _BLEND_MODES.index(mode)
        self.SetBlendMode(mode)


# Nodes of the functions of a logarithmic table. Between two nodes, functions are linear in the
# value instead of its logarithm: for a ratio r of their values, off by up to ln(r) / 8 of the step
# between them, 0.5 % for four decades.
_LOGARITHMIC_NODES = 256


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


def _make_functions(table):
    """Colour and opacity functions of a vtkLookupTable over its range."""
    colors = vtkColorTransferFunction()
    opacity = vtkPiecewiseFunction()
    values = numpy.array([table.GetTableValue(entry)
                          for entry in range(table.GetNumberOfTableValues())])
    scalars, entries = _make_nodes(table)
    channels = [numpy.interp(entries, range(len(values)), channel) for channel in values.T]
    for scalar, red, green, blue, alpha in zip(scalars, *channels):
        colors.AddRGBPoint(scalar, red, green, blue)
        opacity.AddPoint(scalar, alpha)
    return colors, opacity


def _follow_table(look, table):
    """Gives a volume property the functions of a table over its range, now and whenever the table
    changes. Those of PyVista run over the indices of the entries up to version 0.44, and over the
    value where the table's scale is logarithmic."""
    def apply(*_):
        colors, opacity = _make_functions(table)
        look.SetColor(colors)
        look.SetScalarOpacity(opacity)

    apply()
    table.AddObserver("ModifiedEvent", apply)


class _Scalars:
    """The array of a mesh or of all its blocks that is drawn.

    mesh: the mesh. name: of the array. in_points: whether points have it. component: its number, or
    None for the magnitude. title: for the legend.
    """

    def __init__(self, mesh, scalars, preference, component):
        self.title = scalars if scalars is None or isinstance(scalars, str) else ""
        try:
            check_drawable(mesh)
        except ReadingError as error:
            raise ValueError(str(error)) from None
        if isinstance(mesh, vtkCompositeDataSet):
            self._find_in_blocks(mesh, scalars, preference)
        else:
            self._find(mesh, scalars, preference)
        if self.title is None:
            self.title = self.name
        self._choose_component(component)

    def _find(self, mesh, scalars, preference):
        """An array that is given is added to a shallow copy under PyVista's name for it."""
        if scalars is not None and not isinstance(scalars, str):
            mesh = mesh.copy(deep=False)
            mesh["Data"] = scalars
            scalars = "Data"
        scalars = scalars or mesh.active_scalars_name
        if scalars is None:
            raise ValueError("The mesh has no active scalars; name an array with scalars=, one of: "
                             + ", ".join(mesh.array_names))
        association = mesh.get_array_association(scalars, preference=preference)
        self.mesh, self.name = mesh, scalars
        self.in_points = association == pyvista.FieldAssociation.POINT
        self._take_arrays([mesh])

    def _find_in_blocks(self, blocks, scalars, preference):
        leaves = drawn_leaves_of(blocks)
        if scalars is None:
            names = {pyvista.wrap(leaf).active_scalars_name for leaf in leaves} - {None}
            if len(names) != 1:
                found = ", but " + ", ".join(sorted(names)) if names else ""
                raise ValueError("The blocks have no common active scalars%s; name an array with "
                                 "scalars=" % found)
            scalars = names.pop()
        elif not isinstance(scalars, str):
            raise TypeError("The scalars of a MultiBlock are the name of an array")
        self.mesh, self.name = blocks, scalars
        for self.in_points in (preference == "point", preference != "point"):
            self._take_arrays(leaves)
            if self.arrays:
                return
        raise KeyError("No block has an array '%s'" % scalars)

    def _take_arrays(self, leaves):
        self.arrays, self._leaves = [], []
        for leaf in leaves:
            attributes = leaf.GetPointData() if self.in_points else leaf.GetCellData()
            if attributes.HasArray(self.name):
                self.arrays.append(attributes.GetArray(self.name))
                self._leaves.append(leaf)
        if None in self.arrays:
            raise TypeError("The array '%s' is not numeric" % self.name)

    def _choose_component(self, component):
        count = self.arrays[0].GetNumberOfComponents()
        check_component(self.name, count, component)
        if count > 1:
            self.title += "-%s" % component
        self.component = None if component == "magnitude" else component

    def select_in(self, mapper):
        """Sets the array of a mapper."""
        if self.in_points:
            mapper.SetScalarModeToUsePointFieldData()
        else:
            mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectScalarArray(self.name)
        if self.arrays[0].GetNumberOfComponents() == 1:
            return
        if self.component is None:
            mapper.SetVectorMode(mapper.MAGNITUDE)
        else:
            mapper.SetVectorMode(mapper.COMPONENT)
            mapper.SetVectorComponent(self.component)

    def get_values(self):
        """The values of all cells that are drawn, of all blocks, as an array."""
        drawn = drawn_points_of if self.in_points else drawn_cells_of
        values = [vtk_to_numpy(array)[drawn(leaf)]
                  for array, leaf in zip(self.arrays, self._leaves)]
        if values[0].ndim > 1:
            values = [numpy.linalg.norm(each, axis=1) if self.component is None
                      else each[:, self.component] for each in values]
        return numpy.concatenate(values)

    def get_range(self):
        """Extremes of the values that are finite."""
        values = self.get_values()
        values = values[numpy.isfinite(values)]
        if not values.size:
            raise ValueError("The array '%s' has no finite values" % self.name)
        return values.min(), values.max()

    def get_positive_range(self):
        """Extremes of the values that have a logarithm."""
        values = self.get_values()
        values = values[numpy.isfinite(values) & (values > 0)]
        if not values.size:
            raise ValueError("The array '%s' has no value above 0 for log_scale" % self.name)
        return float(values.min()), float(values.max())

    def count_categories(self, categories):
        """Number of categories; True means the number of values."""
        return len(numpy.unique(self.get_values())) if categories is True else categories


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
    """Length over which opacities are given: for image data that of plotter.add_volume()."""
    if isinstance(mesh, (pyvista.ImageData, pyvista.RectilinearGrid)):
        return mesh.length / max(1, sum(mesh.dimensions) / 3 - 1)
    length = math.hypot(*(bounds[2 * i + 1] - bounds[2 * i] for i in range(3)))
    cells = sum(int(drawn_cells_of(leaf).sum()) for leaf in drawn_leaves_of(mesh))
    return length / max(1, cells) ** (1 / 3)


def _add_blocks(plotter, blocks, scalars, arguments):
    """Adds each block of a dataset in colours of its own; returns the volumes."""
    name = arguments.pop("name", None) or "blocks(%s)" % blocks.GetAddressAsString("")
    volumes = []
    for number, block in enumerate(blocks):
        if block is not None:
            arguments["cmap"] = _BLOCK_COLORS[len(volumes) % len(_BLOCK_COLORS)]
            volumes.append(add_volume(
                plotter, block, scalars, name="%s-%d" % (name, number), **arguments))
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


def _make_mapper(scalars, blending, properties):
    mapper = TetrahedraRayCastMapper()
    mapper.SetInputData(scalars.mesh)
    scalars.select_in(mapper)
    mapper.blend_mode = blending
    if isinstance(scalars.mesh, (pyvista.ImageData, pyvista.RectilinearGrid)):
        mapper.SetOpacityModel(mapper.OPACITY_PER_UNIT_DISTANCE)  # as VTK's mappers of these
    _set(mapper, properties)
    return mapper


def _choose_limits(arguments, scalars):
    """Range of the colours for plotter.add_volume(), in arguments."""
    if hasattr(arguments.get("clim"), "__len__"):
        arguments["clim"] = tuple(arguments["clim"])  # PyVista 0.44 takes no arrays
    if arguments.get("log_scale") and arguments.get("clim", arguments.get("rng")) is None:
        arguments["clim"] = scalars.get_positive_range()


def add_volume(plotter, mesh, scalars=None, *, component=None, preference="point",
               blending="composite", categories=False, opacity_unit_distance=None,
               scalar_bar_args=None, show_scalar_bar=None, render=True, name=None,
               multi_colors=False, **arguments):
    """Adds a mesh to a plotter as a volume, with vtkTetrahedraRayCastMapper; returns the
    pyvista.Volume.

    plotter: pyvista.Plotter.
    mesh: a PyVista dataset with tetrahedra or other cells. The blocks of a pyvista.MultiBlock are
        one mesh, with one range of values; those without the array or without volume are left out.
    scalars: name of a point or cell array, or an array of values; default: the active scalars.
    component: number of a component from 0, or "magnitude"; needed for an array with several.
    opacity_unit_distance: the length over which opacities are given, in the mesh's unit; default:
        the mesh's diagonal divided by the mean number of cells along an axis. Over this length an
        image or rectilinear grid has the given opacity, another mesh 1 - exp(-opacity), as with
        plotter.add_volume().
    blending: "composite", "maximum", "minimum", "average" or "additive".
    multi_colors: adds each block of a pyvista.MultiBlock as a volume of its own in colours of its
        own, blended in the order of the blocks; returns a list of them.
    arguments: all other arguments of plotter.add_volume(), such as cmap, opacity, clim, log_scale,
        shade or scalar_bar_args, and properties of the mapper, such as BlendMode=1. With log_scale,
        colour and opacity depend on the logarithm of the value; without clim, from the least value
        above 0 on.

    A ValueError is raised for a mesh without volume, for several components without a choice, and
    for scalars that are missing or not finite; a KeyError for the name of an array that does not
    exist.
    """
    mesh = pyvista.wrap(mesh)
    if multi_colors and isinstance(mesh, pyvista.MultiBlock):
        return _add_blocks(plotter, mesh, scalars, dict(
            arguments, component=component, preference=preference, blending=blending,
            categories=categories, opacity_unit_distance=opacity_unit_distance,
            scalar_bar_args=scalar_bar_args, show_scalar_bar=show_scalar_bar, render=render,
            name=name))
    chosen = _Scalars(mesh, scalars, preference, component)
    properties = {key: arguments.pop(key) for key in list(arguments) if key[0].isupper()}
    _choose_limits(arguments, chosen)
    mapper = _make_mapper(chosen, blending, properties)
    bounds = tuple(mapper.GetBounds())
    volume = plotter.add_volume(
        _make_stand_in(bounds, chosen), scalars=chosen.name,
        categories=chosen.count_categories(categories),
        opacity_unit_distance=opacity_unit_distance or _find_unit_distance(chosen.mesh, bounds),
        show_scalar_bar=False, render=False,
        name=name or "%s(%s)" % (type(mesh).__name__, mapper.GetAddressAsString("")), **arguments)
    mapper.scalar_range = volume.mapper.scalar_range
    # After the range: a user's table keeps its own.
    mapper.lookup_table = volume.mapper.lookup_table
    volume.mapper = mapper
    plotter.mapper = mapper
    logarithmic = mapper.lookup_table.GetScale() == VTK_SCALE_LOG10
    if logarithmic or pyvista.version_info < (0, 45):
        _follow_table(volume.prop, mapper.lookup_table)
    _add_bar(plotter, chosen.title, scalar_bar_args, show_scalar_bar)
    if render:
        plotter.render()
    return volume


def _surface_of(data):
    """The surface of a dataset or of all blocks of one."""
    data = pyvista.wrap(data)
    if isinstance(data, vtkCompositeDataSet):
        surface = vtkCompositeDataGeometryFilter()
        surface.SetInputDataObject(data)
        surface.Update()
        return pyvista.wrap(surface.GetOutput())
    return data if isinstance(data, pyvista.PolyData) else data.extract_surface()


def _make_interfaces(indices, before):
    """List of interfaces of indices behind each, or of pairs, as for refracted()."""
    interfaces = vtkRefractingInterfaceCollection()
    for index in indices:
        exterior, interior = index if isinstance(index, (tuple, list)) else (before, index)
        interface = vtkRefractingInterface()
        interface.SetExteriorIndexOfRefraction(exterior)
        interface.SetInteriorIndexOfRefraction(interior)
        interfaces.AddItem(interface)
        before = exterior if interior == before else interior
    return interfaces


def refracted(mesh, membrane, eye, index=1.333, **properties):
    """Returns the virtual geometry of a mesh, which looks like the mesh seen through the membrane.

    mesh: a PyVista dataset; its surface is used.
    membrane: a PyVista dataset, or a list of them in the order in which the sight rays meet them.
    eye: a position, or an object with the attribute position, such as plotter.camera.
    index: index of refraction behind the membrane. Of a list, one for each surface, whose normals
        then point to the eye's side; or a pair of the indices on the side of its normals and on the
        other side, as for a closed body, which is listed twice.
    properties: properties of vtkRefractedGeometryFilter, such as ExteriorIndexOfRefraction=1.5. A
        list of membranes has one image of each point (Images=0).
    """
    refraction = vtkRefractedGeometryFilter()
    refraction.SetInputData(0, _surface_of(mesh))
    refraction.SetEyePosition(*getattr(eye, "position", eye))
    if isinstance(membrane, (tuple, list)):
        before = properties.pop("ExteriorIndexOfRefraction", 1.0)
        refraction.SetInterfaces(_make_interfaces(index, before))
        for surface in membrane:
            refraction.AddMembraneData(_surface_of(surface))
        refraction.SetImagesToFirstImage()
    else:
        refraction.SetMembraneData(_surface_of(membrane))
        refraction.SetInteriorIndexOfRefraction(index)
    _set(refraction, properties)
    refraction.Update()
    return pyvista.wrap(refraction.GetOutput())
