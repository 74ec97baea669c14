# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Helpers for PyVista: volumes of tetrahedra, and geometry seen through a refracting surface."""
import pyvista
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction, vtkVolume

from .vtkMeniscus import (
    vtkRefractedGeometryFilter, vtkRefractingInterface, vtkRefractingInterfaceCollection,
    vtkTetrahedraRayCastMapper)


def _set(target, properties):
    """Calls target's SetX for every X=value; an unknown name is an AttributeError."""
    for name, value in properties.items():
        getattr(target, "Set" + name)(value)


def _find_limits(mesh, scalars, clim):
    """Range of the colour map, by the rules of plotter.add_volume()."""
    if clim is None:
        is_bytes = mesh[scalars].dtype == "uint8"
        if is_bytes:
            return 0.0, 255.0
        return tuple(float(end) for end in mesh.get_data_range(scalars))
    if isinstance(clim, (int, float)):
        return -float(clim), float(clim)
    lowest, highest = clim
    return float(lowest), float(highest)


def _make_functions(table, limits):
    """Colour and opacity functions of a vtkLookupTable over a range of scalars.

    PyVista's own functions of a table run over the indices of its entries up to version 0.44, and
    over its range from 0.45 on. The entries read by VTK's interface are the same in all versions.
    """
    colors = vtkColorTransferFunction()
    opacity = vtkPiecewiseFunction()
    last = max(1, table.GetNumberOfTableValues() - 1)
    for entry in range(table.GetNumberOfTableValues()):
        scalar = limits[0] + (limits[1] - limits[0]) * entry / last
        red, green, blue, alpha = table.GetTableValue(entry)
        colors.AddRGBPoint(scalar, red, green, blue)
        opacity.AddPoint(scalar, alpha)
    return colors, opacity


def add_volume(plotter, mesh, scalars=None, *, cmap=None, opacity="linear", clim=None,
               opacity_unit_distance=None, show_scalar_bar=True, name=None, **properties):
    """Adds a mesh to a plotter as a volume, with vtkTetrahedraRayCastMapper; returns the vtkVolume.

    plotter: pyvista.Plotter.
    mesh: a PyVista dataset with tetrahedra or other cells.
    scalars: name of a point or cell array with one component; default: the active scalars.
    cmap, opacity, clim, name: as for plotter.add_volume().
    opacity_unit_distance: the length over which opacities are given, in the mesh's unit; default:
        the mesh's diagonal divided by the cube root of its number of cells.
    properties: properties of the mapper, such as BlendMode=1.
    """
    mesh = pyvista.wrap(mesh)
    scalars = scalars or mesh.active_scalars_name
    if scalars is None:
        raise ValueError("The mesh has no active scalars; name an array with scalars=")
    in_points = mesh.get_array_association(scalars) == pyvista.FieldAssociation.POINT
    limits = _find_limits(mesh, scalars, clim)
    cmap = plotter.theme.cmap if cmap is None else cmap
    table = pyvista.LookupTable(cmap=cmap, scalar_range=limits)
    table.apply_opacity(opacity)

    mapper = vtkTetrahedraRayCastMapper()
    mapper.SetInputData(mesh)
    if in_points:
        mapper.SetScalarModeToUsePointFieldData()
    else:
        mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectScalarArray(scalars)
    _set(mapper, properties)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    look = volume.GetProperty()
    colors, opacities = _make_functions(table, limits)
    look.SetColor(colors)
    look.SetScalarOpacity(opacities)
    look.SetScalarOpacityUnitDistance(
        opacity_unit_distance or mesh.length / max(1, mesh.n_cells) ** (1 / 3))
    plotter.add_actor(volume, name=name)
    if show_scalar_bar:
        shown = pyvista.DataSetMapper()
        shown.lookup_table = pyvista.LookupTable(cmap=cmap, scalar_range=limits)
        shown.scalar_range = limits
        plotter.add_scalar_bar(title=scalars, mapper=shown)
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
