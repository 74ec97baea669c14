# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Helpers for PyVista: volumes of tetrahedra, and geometry seen through a refracting surface."""
import pyvista
from vtkmodules.vtkCommonCore import vtkDataArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkPiecewiseFunction, vtkUnstructuredGrid
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

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


def _make_functions(table):
    """Colour and opacity functions of a vtkLookupTable over its range."""
    colors = vtkColorTransferFunction()
    opacity = vtkPiecewiseFunction()
    lowest, highest = table.GetTableRange()
    last = max(1, table.GetNumberOfTableValues() - 1)
    color = [0.0, 0.0, 0.0]
    for entry in range(table.GetNumberOfTableValues()):
        scalar = lowest + (highest - lowest) * entry / last
        table.GetColor(scalar, color)
        colors.AddRGBPoint(scalar, *color)
        opacity.AddPoint(scalar, table.GetTableValue(entry)[3])
    return colors, opacity


def _follow_table(look, table):
    """Gives a volume property the functions of a table over its range, now and whenever the table
    changes. Those of PyVista run over the indices of the entries up to version 0.44."""
    def apply(*_):
        colors, opacity = _make_functions(table)
        look.SetColor(colors)
        look.SetScalarOpacity(opacity)

    apply()
    table.AddObserver("ModifiedEvent", apply)


def _name_scalars(mesh, scalars, preference):
    """Returns a mesh, the name of its array and whether points have it; an array that is given is
    added to a shallow copy under PyVista's name for it."""
    if scalars is not None and not isinstance(scalars, str):
        mesh = mesh.copy(deep=False)
        mesh["Data"] = scalars
        scalars = "Data"
    scalars = scalars or mesh.active_scalars_name
    if scalars is None:
        raise ValueError("The mesh has no active scalars; name an array with scalars=")
    association = mesh.get_array_association(scalars, preference=preference)
    return mesh, scalars, association == pyvista.FieldAssociation.POINT


def _make_stand_in(mesh, scalars, in_points):
    """A tetrahedron with the bounds of a mesh and the extremes of an array. plotter.add_volume()
    makes of it all that a volume has besides its mapper."""
    array = (mesh.GetPointData() if in_points else mesh.GetCellData()).GetArray(scalars)
    if array is None:
        raise TypeError("The array '%s' is not numeric" % scalars)
    left, right, front, back, bottom, top = mesh.bounds
    extremes = mesh.get_data_range(scalars, preference="point" if in_points else "cell")
    points = vtkPoints()
    values = vtkDataArray.CreateDataArray(array.GetDataType())
    values.SetName(scalars)
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


def _find_unit_distance(mesh):
    """Length over which opacities are given: for image data that of plotter.add_volume()."""
    if isinstance(mesh, (pyvista.ImageData, pyvista.RectilinearGrid)):
        return mesh.length / max(1, sum(mesh.dimensions) / 3 - 1)
    return mesh.length / max(1, mesh.n_cells) ** (1 / 3)


def _count_categories(mesh, scalars, in_points, categories):
    """Number of categories; True means the number of values."""
    if categories is True:
        values = (mesh.point_data if in_points else mesh.cell_data)[scalars]
        return len(set(values.tolist()))
    return categories


def _add_blocks(plotter, blocks, scalars, arguments):
    """Adds each block of a dataset; returns the volumes."""
    name = arguments.pop("name", None) or "blocks(%s)" % blocks.GetAddressAsString("")
    colors = arguments.pop("multi_colors", False)
    volumes = []
    for number, block in enumerate(blocks):
        if block is not None:
            if colors:
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


def add_volume(plotter, mesh, scalars=None, *, preference="point", blending="composite",
               categories=False, opacity_unit_distance=None, scalar_bar_args=None,
               show_scalar_bar=None, render=True, name=None, **arguments):
    """Adds a mesh to a plotter as a volume, with vtkTetrahedraRayCastMapper; returns the
    pyvista.Volume, or a list of them for the blocks of a pyvista.MultiBlock.

    plotter: pyvista.Plotter.
    mesh: a PyVista dataset with tetrahedra or other cells.
    scalars: name of a point or cell array with one component, or an array; default: the active
        scalars.
    opacity_unit_distance: the length over which opacities are given, in the mesh's unit; default:
        the mesh's diagonal divided by the mean number of cells along an axis. Over this length an
        image or rectilinear grid has the given opacity, another mesh 1 - exp(-opacity), as with
        plotter.add_volume().
    blending: "composite", "maximum", "minimum", "average" or "additive".
    arguments: all other arguments of plotter.add_volume(), such as cmap, opacity, clim, log_scale,
        shade or scalar_bar_args, and properties of the mapper, such as BlendMode=1.
    """
    mesh = pyvista.wrap(mesh)
    if isinstance(mesh, pyvista.MultiBlock):
        return _add_blocks(plotter, mesh, scalars, dict(
            arguments, preference=preference, blending=blending, categories=categories,
            opacity_unit_distance=opacity_unit_distance, scalar_bar_args=scalar_bar_args,
            show_scalar_bar=show_scalar_bar, render=render, name=name))
    title = scalars if scalars is None or isinstance(scalars, str) else ""
    mesh, scalars, in_points = _name_scalars(mesh, scalars, preference)
    properties = {key: arguments.pop(key) for key in list(arguments) if key[0].isupper()}
    if hasattr(arguments.get("clim"), "__len__"):
        arguments["clim"] = tuple(arguments["clim"])  # PyVista 0.44 takes no arrays

    mapper = TetrahedraRayCastMapper()
    mapper.SetInputData(mesh)
    if in_points:
        mapper.SetScalarModeToUsePointFieldData()
    else:
        mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectScalarArray(scalars)
    mapper.blend_mode = blending
    if isinstance(mesh, (pyvista.ImageData, pyvista.RectilinearGrid)):
        mapper.SetOpacityModel(mapper.OPACITY_PER_UNIT_DISTANCE)  # as VTK's mappers of these
    _set(mapper, properties)

    volume = plotter.add_volume(
        _make_stand_in(mesh, scalars, in_points), scalars=scalars,
        categories=_count_categories(mesh, scalars, in_points, categories),
        opacity_unit_distance=opacity_unit_distance or _find_unit_distance(mesh),
        show_scalar_bar=False, render=False,
        name=name or "%s(%s)" % (type(mesh).__name__, mapper.GetAddressAsString("")), **arguments)
    mapper.scalar_range = volume.mapper.scalar_range
    # After the range: a user's table keeps its own.
    mapper.lookup_table = volume.mapper.lookup_table
    volume.mapper = mapper
    plotter.mapper = mapper
    if pyvista.version_info < (0, 45):
        _follow_table(volume.prop, mapper.lookup_table)
    _add_bar(plotter, scalars if title is None else title, scalar_bar_args, show_scalar_bar)
    if render:
        plotter.render()
    return volume


def _surface_of(data):
    """The surface of a dataset."""
    data = pyvista.wrap(data)
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
