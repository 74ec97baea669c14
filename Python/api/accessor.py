# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The accessor mesh.meniscus of PyVista's meshes."""
# pyright: strict
from __future__ import annotations

import functools
import inspect
from typing import TYPE_CHECKING, Any, Callable, Generic, TypeVar, overload

import pyvista

from .comparison import compare
from .mirages import apparent, mirage
from .picking import pick
from .rays import integral, radiograph
from .refraction import refracted
from .schlieren import schlieren
from .volumes import add_to, plot

if TYPE_CHECKING:
    from typing_extensions import Concatenate, ParamSpec

    from .types import Mesh

    P = ParamSpec("P")
else:
    P = TypeVar("P")
R = TypeVar("R")


class _OfMesh(Generic[P, R]):
    """A function whose first argument is a mesh, as a method of the mesh's accessor."""

    def __init__(self, function: Callable[Concatenate[Mesh, P], R]) -> None:
        self._function = function
        self.__doc__ = function.__doc__

    @overload
    def __get__(self, accessor: None, owner: type) -> Callable[Concatenate[Mesh, P], R]: ...
    @overload
    def __get__(self, accessor: MeniscusAccessor, owner: type) -> Callable[P, R]: ...

    def __get__(self, accessor: MeniscusAccessor | None, owner: type) -> Callable[..., R]:
        if accessor is None:
            return self._function

        @functools.wraps(self._function)
        def method(*arguments: Any, **named: Any) -> R:
            return self._function(accessor.mesh, *arguments, **named)

        signature = inspect.signature(self._function)
        parameters = list(signature.parameters.values())[1:]
        setattr(method, "__signature__", signature.replace(parameters=parameters))
        return method


class MeniscusAccessor:
    """Exact volume rendering, ray integrals, schlieren images, mirages and refraction:
    `mesh.meniscus`.

    The methods are the functions of the package meniscus of the same names, without their first
    argument.
    """

    def __init__(self, mesh: Mesh) -> None:
        """mesh: a pyvista.DataSet or pyvista.MultiBlock."""
        self.mesh = mesh

    plot = _OfMesh(plot)
    add_to = _OfMesh(add_to)
    radiograph = _OfMesh(radiograph)
    integral = _OfMesh(integral)
    pick = _OfMesh(pick)
    compare = _OfMesh(compare)
    refracted = _OfMesh(refracted)
    schlieren = _OfMesh(schlieren)
    mirage = _OfMesh(mirage)
    apparent = _OfMesh(apparent)


def register() -> None:
    """Adds the accessor to PyVista's meshes, from version 0.48 on."""
    if hasattr(pyvista, "register_dataset_accessor"):
        for kind in (pyvista.DataSet, pyvista.MultiBlock):
            # Not hasattr(), for which PyVista would load this module again.
            if "meniscus" not in vars(kind):
                pyvista.register_dataset_accessor("meniscus", kind)(MeniscusAccessor)


register()
