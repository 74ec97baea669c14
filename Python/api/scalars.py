# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of a mesh that are drawn: one, colours, or one for colours and one for opacity."""

import numpy
import pyvista
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet

from ..arguments import check_name, check_values, refuse, take_range, warn
from ..data import check_component, replace_leaves, with_array
from ..viewer.cells import check_drawable, drawn_cells_of, drawn_leaves_of, drawn_points_of
from ..viewer.files import ReadingError
from ..viewer.shown import choose_of_range

# Array that is added to shallow copies of the data sets where several arrays are mixed.
_MIXED = "Meniscus"


def copy_with(mesh, name, in_points, leaves, arrays):
    """Shallow copy of a mesh whose leaves have further arrays of a name, of points or cells; blocks
    that are not among the leaves are empty. arrays: numpy arrays, one per leaf."""
    copies = [with_array(leaf, name, in_points, array) for leaf, array in zip(leaves, arrays)]
    copy = replace_leaves(mesh, leaves, copies)
    return copy if isinstance(mesh, vtkCompositeDataSet) else pyvista.wrap(copy)


def without_mask(values):
    """Values of which those that are masked, if it is an array of numpy.ma, are not numbers."""
    if not numpy.ma.isMaskedArray(values):
        return values
    if not numpy.ma.is_masked(values):
        return values.data
    kind = values.dtype if values.dtype.kind == "f" else float
    return values.astype(kind).filled(numpy.nan)


class Scalars:
    """The array of a mesh or of all its blocks that is drawn.

    mesh: the mesh. name: of the array. in_points: whether points have it. component: its number, or
    None for the magnitude. title: for the legend. arrays, leaves: the array of each block that is
    drawn and has one, and these blocks. limits: range of the functions, if the values do not say.
    opacity_limits: range of the opacities of another array, or None. has_colors: whether the array
    is drawn as colours. is_mixed: whether several components are drawn at once.
    """

    limits = opacity_limits = None
    is_mixed = False

    def __init__(self, mesh, scalars, preference, component, rgba=None):
        check_values("scalars", scalars)
        self.title = scalars if scalars is None or isinstance(scalars, str) else ""
        try:
            check_drawable(mesh)
        except ReadingError as error:
            raise ValueError(str(error)) from None
        if isinstance(mesh, vtkCompositeDataSet):
            self._find_in_blocks(mesh, scalars, preference)
        else:
            self._find(mesh, scalars, preference)
        if self.title is None:
            self.title = self.name
        self.has_colors = component is None and self._are_colors() if rgba is None else rgba
        if self.has_colors:
            self._take_colors(component)
        else:
            self._choose_component(component)
            self._check_nearness()

    def _find(self, mesh, scalars, preference):
        """An array that is given is added to a shallow copy under PyVista's name for it."""
        if scalars is not None and not isinstance(scalars, str):
            mesh = mesh.copy(deep=False)
            mesh["Data"] = without_mask(scalars)
            scalars = "Data"
        scalars = scalars or mesh.active_scalars_name
        if scalars is None and not mesh.array_names:
            raise ValueError("The mesh has no arrays; give its values with scalars=, one per point "
                             "or cell")
        if scalars is None:
            raise ValueError("The mesh has no active scalars; name an array with scalars=, one of: "
                             + ", ".join(mesh.array_names))
        try:
            association = mesh.get_array_association(scalars, preference=preference)
        except KeyError:
            raise KeyError("The mesh has no array '%s'; it has %s" % (
                scalars, ", ".join(mesh.array_names) or "none")) from None
        self.mesh, self.name = mesh, scalars
        self.in_points = association == pyvista.FieldAssociation.POINT
        self._take_arrays([mesh])

    def _find_in_blocks(self, blocks, scalars, preference):
        leaves = drawn_leaves_of(blocks)
        if scalars is None:
            names = {pyvista.wrap(leaf).active_scalars_name for leaf in leaves} - {None}
            if len(names) != 1:
                found = ", but " + ", ".join(sorted(names)) if names else ""
                raise ValueError("The blocks have no common active scalars%s; name an array with "
                                 "scalars=" % found)
            scalars = names.pop()
        elif not isinstance(scalars, str):
            refuse("scalars of a MultiBlock", "the name of an array, a str", scalars)
        self.mesh, self.name = blocks, scalars
        for self.in_points in (preference == "point", preference != "point"):
            self._take_arrays(leaves)
            if self.arrays:
                return
        names = {name for leaf in leaves for name in pyvista.wrap(leaf).array_names}
        raise KeyError("No block has an array '%s'; there are %s" % (
            scalars, ", ".join(sorted(names)) or "none"))

    def _take_arrays(self, leaves):
        self.arrays, self.leaves = [], []
        for leaf in leaves:
            attributes = leaf.GetPointData() if self.in_points else leaf.GetCellData()
            if attributes.HasArray(self.name):
                self.arrays.append(attributes.GetArray(self.name))
                self.leaves.append(leaf)
        # Since VTK 9.7 the comparison of an array with `==`, as by `in`, has one result per value.
        if any(array is None for array in self.arrays):
            raise TypeError("The array '%s' is not numeric" % self.name)

    def _are_colors(self):
        """Whether plotter.add_volume() takes the array as colours."""
        return self.in_points and all(array.GetNumberOfComponents() == 4 and vtk_to_numpy(
            array).dtype == numpy.uint8 for array in self.arrays)

    def are_truths(self):
        """Whether all values are true or false, which PyVista keeps as bytes."""
        if any(array.GetDataType() != VTK_UNSIGNED_CHAR for array in self.arrays):
            return False
        return all((leaf.point_data if self.in_points else leaf.cell_data)[self.name].dtype == bool
                   for leaf in map(pyvista.wrap, self.leaves))

    def _choose_component(self, component):
        counts = sorted({array.GetNumberOfComponents() for array in self.arrays})
        if len(counts) > 1:
            raise ValueError("The array '%s' has %s components, depending on the block" % (
                self.name, " or ".join(map(str, counts))))
        count = counts[0]
        try:
            check_component(self.name, count, component)
        except ValueError as error:
            raise ValueError("%s%s" % (error, ", or draw colours with rgba=True"
                                       if count in (3, 4) else "")) from None
        if count > 1:
            self.title += "-%s" % component
        self.component = None if component == "magnitude" else component

    def _check_nearness(self):
        """Warns of values for which functions have no nodes that are near enough."""
        values = self.get_values()
        whole = values.dtype.kind in "iu"
        values = values[numpy.isfinite(values)]
        if not values.size:
            return
        extremes = values.min(), values.max()
        low, high = map(int if whole else float, extremes)
        shown = choose_of_range(low, high, whole)
        if not shown.is_plain():
            warn("The values of '%s', from %r to %r, are too near to each other, or too large or "
                 "small, for functions of colour and opacity; draw %s instead" % (
                     self.name, low, high, shown.name_of(self.name)))

    def _take_colors(self, component):
        """Mixes the components as colour and opacity."""
        colors = [vtk_to_numpy(array) for array in self.arrays]
        if component is not None:
            raise ValueError("rgba=True draws all components; leave component out")
        for values in colors:
            if values.ndim != 2 or values.shape[1] not in (3, 4):
                raise ValueError("The array '%s' has %d components; colours have 3 or 4 (rgba=True)"
                                 % (self.name, values.shape[1] if values.ndim == 2 else 1))
            if values.dtype != numpy.uint8 and values.dtype.kind != "f":
                raise ValueError("The colours '%s' are of the type %s; they must be uint8, from 0 "
                                 "to 255, or floating-point numbers from 0 to 1" % (
                                     self.name, values.dtype))
        if len({values.dtype == numpy.uint8 for values in colors}) > 1:
            raise ValueError("The colours '%s' are uint8 in some blocks and floating-point numbers "
                             "in others" % self.name)
        self.limits = (0.0, 255.0 if colors[0].dtype == numpy.uint8 else 1.0)
        self.component = None
        self._mix([values if values.shape[1] == 4 else numpy.column_stack(
            [values, numpy.full(len(values), self.limits[1], values.dtype)]) for values in colors])

    def add_opacity(self, name, component, limits):
        """Takes the opacity from another array of points, whose range is limits or its own."""
        check_name("opacity_array", name)
        other = Scalars(self.mesh, name, "point" if self.in_points else "cell", component, False)
        if other.in_points != self.in_points:
            raise ValueError("The arrays '%s' and '%s' must both belong to points" % (
                self.name, other.name))
        if len(other.leaves) != len(self.leaves) or len(
                [1 for ours, theirs in zip(self.leaves, other.leaves) if ours is not theirs]):
            raise ValueError("Some blocks have only one of the arrays '%s' and '%s'" % (
                self.name, other.name))
        self.opacity_limits = (other.get_range() if limits is None
                               else take_range("opacity_clim", limits))
        columns = [[each.get_values_of(index) for each in (self, other)]
                   for index in range(len(self.leaves))]
        self._mix([numpy.column_stack(pair) for pair in columns])

    def _mix(self, arrays):
        if not self.in_points:
            raise ValueError("Colours and opacities of the array '%s' must belong to points; "
                             "mesh.cell_data_to_point_data() makes such arrays" % self.name)
        self.mesh = copy_with(self.mesh, _MIXED, True, self.leaves, arrays)
        self.is_mixed = True

    def select_in(self, mapper):
        """Sets the input and the array of a mapper."""
        mapper.SetInputData(self.mesh)
        if self.in_points:
            mapper.SetScalarModeToUsePointFieldData()
        else:
            mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectScalarArray(_MIXED if self.is_mixed else self.name)
        if self.is_mixed or self.arrays[0].GetNumberOfComponents() == 1:
            return
        if self.component is None:
            mapper.SetVectorMode(mapper.MAGNITUDE)
        else:
            mapper.SetVectorMode(mapper.COMPONENT)
            mapper.SetVectorComponent(self.component)

    def get_values_of(self, index):
        """The values that are drawn of one block, of all points or cells."""
        values = vtk_to_numpy(self.arrays[index])
        if values.ndim == 1:
            return values
        return (numpy.linalg.norm(values, axis=1) if self.component is None
                else values[:, self.component])

    def get_values(self):
        """The values of all cells that are drawn, of all blocks, as an array."""
        drawn = drawn_points_of if self.in_points else drawn_cells_of
        return numpy.concatenate([self.get_values_of(index)[drawn(leaf)]
                                  for index, leaf in enumerate(self.leaves)])

    def get_range(self):
        """Extremes of the values that are finite."""
        if self.limits is not None:
            return self.limits
        values = self.get_values()
        values = values[numpy.isfinite(values)]
        if not values.size:
            raise ValueError("The array '%s' has no finite values" % self.name)
        return values.min(), values.max()

    def get_positive_range(self):
        """Extremes of the values that have a logarithm."""
        values = self.get_values()
        values = values[numpy.isfinite(values) & (values > 0)]
        if not values.size:
            raise ValueError("The array '%s' has no value above 0 for log_scale" % self.name)
        return float(values.min()), float(values.max())

    def count_categories(self, categories):
        """Number of categories; True means the number of values."""
        return len(numpy.unique(self.get_values())) if categories is True else categories
