# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Volumes and virtual geometry in PyVista's plotters, with the plotter as first argument."""
from .api import accessor  # noqa: F401, registers mesh.meniscus
from .api.mapper import TetrahedraRayCastMapper
from .api.refraction import refracted
from .api.volumes import add_to

__all__ = ["TetrahedraRayCastMapper", "add_volume", "refracted"]


def add_volume(plotter, mesh, scalars=None, **arguments):
    """Adds a mesh to a plotter as a volume: meniscus.add_to(mesh, plotter, scalars, ...)."""
    return add_to(mesh, plotter, scalars, **arguments)
