# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Names of the settings of vtkTetrahedraRayCastMapper, the material of lit volumes, and properties
of VTK's objects by name."""
import math
import re

from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
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
# With shadows, which darken: a brighter material, and VolumetricScatteringBlending.
SHADOWED_MATERIAL = {**MATERIAL, "ambient": 0.5, "diffuse": 1.0}
SCATTERED_SHARE = 1.0
ISOSURFACE_OPACITY = 0.4


def choose(kind, name, known):
    """The value of a name in a dictionary; a name that is not in it is a ValueError that lists the
    names. kind: what is named, such as "blend mode"."""
    if not isinstance(name, str) or name not in known:
        raise ValueError("There is no %s '%s'; known are %s" % (kind, name, ", ".join(known)))
    return known[name]


def _find_choices(target, name):
    """The methods SetXToY() of a property X, by the names of the choices Y, in small letters."""
    start = "Set%sTo" % name
    return {re.sub("(?<=[a-z])(?=[A-Z][a-z])", "_", method[len(start):]).lower(): method
            for method in dir(target) if method.startswith(start)}


def set_properties(target, properties):
    """Calls SetX(value) of a vtkAlgorithm for each X=value of a dictionary, and SetXToY() for the
    name of a choice, X="y"; a name X that it has not is an AttributeError that lists those that it
    has, and NaN or another name of a choice a ValueError."""
    for name, value in properties.items():
        setter = getattr(target, "Set" + name, None)
        if setter is None:
            setters = {method[3:] for method in set(dir(target)) - set(dir(vtkAlgorithm))
                       if method.startswith("Set")}
            known = sorted(each for each in setters if each.split("To")[0] == each)
            raise AttributeError("There is no property '%s'; known are %s" % (
                name, ", ".join(known)))
        values = value if isinstance(value, (tuple, list)) else [value]
        if any(isinstance(each, float) and math.isnan(each) for each in values):
            raise ValueError("%s must not be NaN" % name)
        choices = _find_choices(target, name) if isinstance(value, str) else {}
        if choices:
            getattr(target, choose(name, value, choices))()
        else:
            setter(value)
