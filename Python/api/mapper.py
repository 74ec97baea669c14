# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The mapper with the attributes of PyVista's mappers."""
import pyvista

from ..names import BACKENDS, BLEND_MODES, choose, set_properties
from ..vtkMeniscus import vtkTetrahedraRayCastMapper


class TetrahedraRayCastMapper(vtkTetrahedraRayCastMapper):
    """A vtkTetrahedraRayCastMapper with the attributes of PyVista's volume mappers, by which its
    plotters and scalar bars set the range."""

    def __init__(self):
        self.source = None  # the mesh that add_to() was given, of which the input may be a copy
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
        """Name of the blend mode."""
        mode = self.GetBlendMode()
        return next((name for name, number in BLEND_MODES.items() if number == mode), mode)

    @blend_mode.setter
    def blend_mode(self, mode):
        if isinstance(mode, str):
            mode = choose("blend mode", "isosurface" if mode == "isosurfaces" else mode,
                          BLEND_MODES)
        self.SetBlendMode(mode)


def make_mapper(scalars, blending, backend, properties):
    """A mapper of Scalars. properties: X=value, for which SetX is called; an unknown name is an
    AttributeError."""
    mapper = TetrahedraRayCastMapper()
    scalars.select_in(mapper)
    mapper.blend_mode = blending
    mapper.SetBackend(choose("backend", backend, BACKENDS))
    if isinstance(scalars.mesh, (pyvista.ImageData, pyvista.RectilinearGrid)):
        mapper.SetOpacityModel(mapper.OPACITY_PER_UNIT_DISTANCE)  # as VTK's mappers of these
    set_properties(mapper, properties)
    return mapper
