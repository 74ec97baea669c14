# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes as an eye sees them through refracting surfaces."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pyvista

from ..arguments import check_dataset, check_numbers, warn
from ..data import run
from ..names import choose, set_properties
from ..vtkMeniscus import vtkRefractedGeometryFilter
from .surfaces import connect, surface_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .types import Indices, Mesh, Surfaces

_IMAGES = {"all": vtkRefractedGeometryFilter.ALL_IMAGES,
           "first": vtkRefractedGeometryFilter.FIRST_IMAGE}


def _make_filter(mesh, surfaces, indices, images, properties):
    """properties: X=value, for which SetX is called; an unknown name is an AttributeError."""
    refraction = vtkRefractedGeometryFilter()
    refraction.SetInputData(0, surface_of(mesh))
    connect(refraction, surfaces, indices, properties.pop("ExteriorIndexOfRefraction", 1.0))
    if images is None:
        images = "first" if isinstance(surfaces, (tuple, list)) else "all"
    refraction.SetImages(choose("value of images", images, _IMAGES))
    set_properties(refraction, properties)
    return refraction


def refracted(
    mesh: Mesh, /, surfaces: Surfaces, eye: Any, indices: Indices = 1.333, *,
    images: str | None = None, index: Indices | None = None, **arguments: Any,
) -> Any:
    """Virtual geometry of a mesh, which looks like the mesh seen through refracting surfaces.

    mesh: a dataset; its surface is used, or the surfaces of all blocks of a pyvista.MultiBlock.
    surfaces: a dataset, or a list of them in the order in which the sight rays meet them; their
        normals point to the eye's side. A surface may be a pair of arrays (points, triangles), of
        the shapes (n, 3) and (m, 3).
    eye: a pyvista.Plotter: the geometry is added to it, follows its camera, and the actor is
        returned. Or a position, three coordinates in the mesh's unit: a pyvista.PolyData is
        returned that is right for this eye only. A camera stands for its present position, with a
        RuntimeWarning, because the picture is wrong when the camera moves.
    indices: index of refraction behind the surface, default 1.333; for several surfaces a list, of
        the indices behind each, of all media with the eye's first, or of pairs of the indices on
        the side of its normals and on the other side, as for a closed body, which is listed twice.
        Without the eye's medium it has the index 1. index: the same argument.
    images: "all" images of each point, the default of one surface; or the "first", the default of a
        list.
    arguments: with a plotter, all arguments of plotter.add_mesh(), such as color, scalars or cmap.
        Properties of vtkRefractedGeometryFilter, such as VirtualNormals=True.

    Returns a pyvista.PolyData, or an actor of it, with the arrays of the mesh and further ones,
    such as SightPoint (points, 3) and RefractionDepth; see vtkRefractedGeometryFilter. Raises
    ValueError for surfaces and indices that do not fit together, and for surfaces that cannot be
    used.
    """
    check_dataset("mesh", mesh)
    if not hasattr(eye, "add_mesh"):
        check_numbers("eye", getattr(eye, "position", eye), 3)
    properties = {key: arguments.pop(key) for key in list(arguments) if key[0].isupper()}
    refraction = _make_filter(
        mesh, surfaces, indices if index is None else index, images, properties)
    if hasattr(eye, "add_mesh"):
        return _add_following(eye, refraction, arguments)
    if arguments:
        raise TypeError("Arguments of plotter.add_mesh() need a plotter as eye: "
                        + ", ".join(arguments))
    if hasattr(eye, "GetPosition"):
        warn("The geometry is that for the camera's present position; give the plotter as eye for "
             "an actor that follows the camera, or a position", RuntimeWarning)
    position: Sequence[float] = getattr(eye, "position", eye)
    refraction.SetEyePosition(*position)
    run(refraction)
    return pyvista.wrap(refraction.GetOutput())


def _add_following(plotter, refraction, arguments):
    """Adds the output of a filter whose eye follows a plotter's camera."""
    renderer = plotter.renderer
    if not plotter.camera_set:
        # Until the first frame, in which the plotter places its camera, the eye is where it would
        # see the mesh itself.
        renderer.camera_position = plotter.get_default_cam_pos()
        renderer.ResetCamera(refraction.GetInputDataObject(0, 0).GetBounds())
        renderer.camera_set = False
    refraction.SetEyePosition(renderer.GetActiveCamera().GetPosition())
    run(refraction)
    # In every frame, because the camera may be replaced.
    renderer.AddObserver("StartEvent", lambda caller, _: refraction.SetCamera(
        caller.GetActiveCamera()))
    try:
        return plotter.add_mesh(refraction, **arguments)
    except TypeError:
        if not arguments.pop("smooth_shading", False):
            raise
    # PyVista 0.44 refuses smooth shading of a filter. Its output has the mesh's normals.
    actor = plotter.add_mesh(refraction, smooth_shading=False, **arguments)
    actor.prop.interpolation = "Phong"
    return actor
