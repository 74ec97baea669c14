# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Integrals along rays through a mesh, as arrays."""
import numbers

from vtkmodules.vtkCommonDataModel import vtkDataObject

from .arguments import check_dataset, check_name, check_names, check_numbers, refuse
from .data import check_component, find_arrays, take_arrays
from .names import set_properties
from .vtkMeniscus import vtkTetrahedraRayIntegral

try:
    import numpy
except ImportError:
    numpy = None

ARRAYS = ("Integral", "PathLength", "OpticalDepth", "FirstDepth", "LastDepth", "Minimum",
           "MinimumDepth", "Maximum", "MaximumDepth", "RGBA", "EnergyBins")
# Arrays that do not depend on scalars, and properties that choose components or other arrays.
_GEOMETRIC = {"PathLength", "FirstDepth", "LastDepth"}
_OWN_COMPONENTS = {"ArrayComponent", "AttenuationArrayName"}


def _as_rows(array, width, height):
    """Values of a VTK array as (height, width) or (height, width, components), without a copy."""
    shape = [height, width]
    if array.GetNumberOfComponents() > 1:
        shape.append(array.GetNumberOfComponents())
    view = memoryview(array).cast("B").cast("f", shape)
    return view if numpy is None else numpy.asarray(view)


def _set_bins(rays, bins):
    """Sets each bin to a coefficient, or to (attenuation, emission, intensity)."""
    setters = (rays.SetBinAttenuation, rays.SetBinEmission, rays.SetBinIntensity)
    if not hasattr(bins, "__len__") or isinstance(bins, (bytes, str)):
        refuse("bins", "a list of numbers, or of lists of up to three", bins)
    rays.SetNumberOfEnergyBins(len(bins))
    for number, values in enumerate(bins):
        values = values if isinstance(values, (tuple, list)) else (values,)
        if len(values) > len(setters) or not all(isinstance(x, numbers.Real) for x in values):
            refuse("bins", "a list of numbers, or of lists of up to three", bins)
        for setter, value in zip(setters, values):
            setter(number, value)


def _choose_component(rays, arrays, component):
    """Sets the component of arrays; one of arrays with several is a ValueError if none or another
    is chosen."""
    for array in arrays:
        check_component(array.GetName(), array.GetNumberOfComponents(), component)
    if arrays and component is not None:
        rays.SetArrayComponent(-1 if component == "magnitude" else component)


def ray_integral(mesh, arrays="Integral", *, scalars=None, component=None, size=(256, 256),
                 camera=None, bins=None, surfaces=None, indices=1.333, **properties):
    """Casts one ray per pixel through a mesh and returns what it measures.

    mesh: a VTK or PyVista dataset, or a filter whose output is one.
    arrays: the name of an array of vtkTetrahedraRayIntegral, or several of them: Integral,
        PathLength, OpticalDepth, FirstDepth, LastDepth, Minimum, MinimumDepth, Maximum,
        MaximumDepth, RGBA, EnergyBins.
    scalars: name of a point or cell array; default: the active scalars.
    component: number of a component from 0, or "magnitude"; needed for scalars with several.
    size: width and height of the image in pixels.
    camera: a vtkCamera; default: parallel rays along Direction, around the bounding box.
    bins: attenuation coefficients of energy bins, or tuples (attenuation, emission, intensity).
    surfaces, indices: refracting surfaces on the way of the rays, and indices of refraction; see
        meniscus.refracted().
    properties: properties of vtkTetrahedraRayIntegral, such as Direction=(0, -1, 0).

    Returns 32-bit floats of the shape (height, width), for RGBA and several bins (height, width,
    components), with rows from below: a numpy array or, without numpy, a memoryview. For several
    arrays, returns a dictionary of these by name. Input that cannot be used is a ValueError.
    """
    check_dataset("mesh", mesh)
    check_name("scalars", scalars)
    check_numbers("size", size, 2, numbers.Integral)
    size = tuple(map(int, size))
    for name in ("Direction", "ViewUp"):
        check_numbers({"Direction": "direction", "ViewUp": "up"}[name],
                      properties.get(name, (0, 0, 0)), 3)
    names = check_names("arrays", arrays)
    for name in names:
        if name not in ARRAYS:
            raise ValueError("There is no array '%s'; the arrays are %s" % (
                name, ", ".join(ARRAYS)))
    rays = vtkTetrahedraRayIntegral()
    if hasattr(mesh, "GetOutputPort"):
        rays.SetInputConnection(mesh.GetOutputPort())
    else:
        rays.SetInputData(mesh)
    rays.GetArraySelection().DisableAllArrays()
    for name in names:
        rays.GetArraySelection().EnableArray(name)
    if scalars is not None:
        rays.SetInputArrayToProcess(
            0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS_THEN_CELLS, scalars)
    if not _OWN_COMPONENTS & set(properties) and set(names) - _GEOMETRIC:
        _choose_component(rays, find_arrays(mesh, scalars), component)
    rays.SetImageSize(*size)
    if camera is not None:
        rays.SetCamera(camera)
    if bins is not None:
        _set_bins(rays, bins)
    if surfaces is not None:
        from .api.surfaces import connect  # needs numpy
        connect(rays, surfaces, indices)
    set_properties(rays, properties)
    found = {name: _as_rows(array, *size) for name, array in zip(names, take_arrays(rays, names))}
    return found[arrays] if isinstance(arrays, str) else found
