# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Names of the settings of vtkTetrahedraRayCastMapper, and the material of lit volumes."""
from vtkmodules.vtkRenderingVolume import vtkVolumeMapper

from .vtkMeniscus import vtkTetrahedraRayCastMapper

BLEND_MODES = {
    "composite": vtkVolumeMapper.COMPOSITE_BLEND,
    "maximum": vtkVolumeMapper.MAXIMUM_INTENSITY_BLEND,
    "minimum": vtkVolumeMapper.MINIMUM_INTENSITY_BLEND,
    "average": vtkVolumeMapper.AVERAGE_INTENSITY_BLEND,
    "additive": vtkVolumeMapper.ADDITIVE_BLEND,
    "isosurface": vtkVolumeMapper.ISOSURFACE_BLEND,
}
BACKENDS = {
    "automatic": vtkTetrahedraRayCastMapper.AUTOMATIC,
    "opengl": vtkTetrahedraRayCastMapper.OPENGL,
    "compute": vtkTetrahedraRayCastMapper.COMPUTE,
    "native": vtkTetrahedraRayCastMapper.NATIVE,
}
# Phong coefficients of lit volumes and isosurfaces.
MATERIAL = {"ambient": 0.35, "diffuse": 0.7, "specular": 0.25, "specular_power": 25.0}
ISOSURFACE_OPACITY = 0.4


def choose(kind, name, known):
    """The value of a name in a dictionary; a name that is not in it is a ValueError that lists the
    names. kind: what is named, such as "blend mode"."""
    if name not in known:
        raise ValueError("There is no %s '%s'; known are %s" % (kind, name, ", ".join(known)))
    return known[name]
