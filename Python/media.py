# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Media that bend light and the rays through them, as arguments of functions."""
import numbers

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject

from .arguments import check_dataset, check_name, check_names, check_numbers
from .data import find_arrays, take_arrays
from .names import choose, set_properties
from .vtkMeniscus import vtkBentMediumAlgorithm

_QUANTITIES = {"density": vtkBentMediumAlgorithm.DENSITY,
               "refractive_index": vtkBentMediumAlgorithm.REFRACTIVE_INDEX}


def connect_medium(target, port, argument, mesh, scalars, quantity):
    """Sets the mesh of a vtkBentMediumAlgorithm and the values of the mesh that it reads.

    port: the mesh's input port. argument: name of the function's argument with the mesh.
    """
    check_dataset(argument, mesh)
    check_name("scalars", scalars)
    if hasattr(mesh, "GetOutputPort"):
        target.SetInputConnection(port, mesh.GetOutputPort())
    else:
        target.SetInputDataObject(port, mesh)
    for array in find_arrays(mesh, scalars, in_cells=False):
        if array.GetNumberOfComponents() != 1:
            raise ValueError("The array '%s' has %d components; a %s is one number" % (
                array.GetName(), array.GetNumberOfComponents(), quantity))
    if scalars is not None:
        target.SetInputArrayToProcess(
            0, port, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, scalars)
    target.SetQuantity(choose("quantity", quantity, _QUANTITIES))


def cast(rays, image, arrays, size, direction, up, camera, properties):
    """Images of a vtkBentRayAlgorithm with a medium: an array of numpy with rows from below, or a
    dictionary of them by name if there are several.

    image: a name or a list of them. arrays: names of the output's arrays by names of images.
    """
    check_numbers("size", size, 2, numbers.Integral)
    check_numbers("direction", direction, 3)
    check_numbers("up", up, 3)
    names = check_names("image", image)
    wanted = [choose("image", name, arrays) for name in names]
    rays.SetImageSize(*size)
    rays.SetDirection(*direction)
    rays.SetViewUp(*up)
    rays.SetCamera(camera)
    set_properties(rays, properties)
    found = {}
    for name, array in zip(names, take_arrays(rays, wanted)):
        values = vtk_to_numpy(array)
        found[name] = values.reshape((size[1], size[0]) + values.shape[1:])
    return found[image] if isinstance(image, str) else found
