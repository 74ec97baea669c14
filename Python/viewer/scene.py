# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A mesh as a volume, with its settings; windows, pages and pictures show it."""
import math

import numpy
from vtkmodules.vtkCommonCore import vtkMath
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkVolume)

from .. import vtkTetrahedraRayCastMapper
from ..names import BACKENDS, BLEND_MODES, ISOSURFACE_OPACITY, MATERIAL, SHADOWED_MATERIAL
from .cells import drawn_leaves_of
from .colors import COLOR_MAPS, fill_colors, find_colors, make_table
from .curves import check_curve, fill_function, simplify
from .furniture import Furniture, find_label_format
from .levels import BINS, Levels, values_of
from .reading import MeshSeries, ReadingError, arrays_of
from .shown import Shown, choose_shown

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
# Modes with a curve of opacity of their own, by blend mode. In a projection and for isosurfaces an
# opacity belongs to a value, in a volume to a length.
_KINDS = {"maximum": "projection", "minimum": "projection", "average": "projection",
          "isosurface": "isosurface"}
_VOLUME = "volume"
_CURVES = {"projection": [(0.0, 0.0), (1.0, 1.0)],
           "isosurface": [(0.0, ISOSURFACE_OPACITY), (1.0, ISOSURFACE_OPACITY)]}
BACKGROUND = ((0.93, 0.95, 0.97), (0.70, 0.76, 0.84))
# Pixels from the left border of the bar to the right border of the window.
BAR_ROOM = 100.0
# An end of the colour map that is a smaller share of its range is 0 in the legend, which has three
# digits: 0 to 1, not 2.4e-23 to 1.
ROUND_OFF = 1e-6
# The lamp that casts shadows: its place, as that of a camera light, and its intensity.
SHADOW_LAMP = (-1.2, 1.6, 1.0)
SHADOW_INTENSITY = 2.2

# Characters of the name of an array that are shown: a longer name covers the picture.
LONGEST_NAME = 40


def shorten(name):
    """A name of at most LONGEST_NAME characters, in one line, with an ellipsis in place of the
    rest."""
    name = " ".join(name.split())
    half = (LONGEST_NAME - 3) // 2
    return name if len(name) <= LONGEST_NAME else f"{name[:half]}...{name[-half:]}"


class MeshScene:
    """The volume of a MeshSeries in a vtkRenderer (attribute renderer).

    Every setter takes effect with the next frame. A name that does not exist is a ReadingError.
    """

    def __init__(self, series, array=None, limits=None, report=lambda line: None,
                 step=0):
        """array, limits: see set_array(); default: the first array. report: gets a line about the
        mesh as soon as it is read, before work that may take long. step: shown first if the first
        time step lacks the array, or cannot be drawn."""
        self.series = series
        self.step, self.data = self._read_first(series, array, step)
        report(self.describe())
        self.colors = COLOR_MAPS[0]
        self._curves = {}  # by the kinds of _KINDS; without one it is the default
        self.density = 1.0
        self.blend = "composite"
        self.isovalues = None  # None: chosen by volume
        self.limits = None  # None: the range of the first step's values
        self.unit = ""
        self.clip_axis = None
        self.clip_share = 0.5
        self._has_surface = False
        self.direction = (1.0, 0.7, 1.0)
        self.up = (0.0, 1.0, 0.0)
        self.mapper = vtkTetrahedraRayCastMapper()
        self.shown = Shown()
        self.volume = vtkVolume()
        self.volume.SetMapper(self.mapper)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(*BACKGROUND[0])
        self.renderer.SetBackground2(*BACKGROUND[1])
        self.renderer.GradientBackgroundOn()
        self.renderer.AddVolume(self.volume)
        self._add_bar()
        self._clip_plane = vtkPlane()
        look = self.volume.GetProperty()
        look.SetAmbient(MATERIAL["ambient"])
        look.SetDiffuse(MATERIAL["diffuse"])
        look.SetSpecular(MATERIAL["specular"])
        look.SetSpecularPower(MATERIAL["specular_power"])
        self.set_array(self.get_arrays()[0] if array is None else array, limits)
        # Of the cells that are drawn: blocks without the array are not.
        self.bounds = tuple(self.mapper.GetBounds())
        self.diagonal = math.hypot(*(self.bounds[2 * i + 1] - self.bounds[2 * i]
                                     for i in range(3)))
        look.SetScalarOpacityUnitDistance(self.diagonal)
        self.furniture = Furniture(self.renderer)
        self.furniture.set_data(self.data, self.bounds)

    @staticmethod
    def _read_first(series, array, step):
        """Number and data of the first time step, or of `step` if that has no cells to be drawn, or
        lacks the array."""
        try:
            data = series.read(0)
        except ReadingError:
            if not step:
                raise
        else:
            if not step or array is None or array in arrays_of(data):
                return 0, data
        return step, series.read(step)

    def _add_bar(self):
        self._turns, self._reset_at, self._zoom = 1, None, 1.0  # of reset_camera()
        self.bar = vtkScalarBarActor()
        self.bar.SetMaximumWidthInPixels(90)
        self.renderer.AddObserver("StartEvent", lambda *_: self._fit_to_window())
        self.bar.SetHeight(0.8)
        self.bar.UnconstrainedFontSizeOn()
        self.bar.SetVerticalTitleSeparation(8)
        for text in (self.bar.GetTitleTextProperty(), self.bar.GetLabelTextProperty()):
            text.SetColor(0.1, 0.1, 0.15)
            text.SetFontSize(14)
            text.ShadowOff()
            text.ItalicOff()
            text.BoldOff()
        self.renderer.AddViewProp(self.bar)

    def _fit_to_window(self):
        """Before a frame: the bar at the right border, with room for its labels, but in the last
        quarter of the window; the volume in the middle of the rest."""
        width, height = (max(length, 1) for length in self.renderer.GetSize())
        room = min(BAR_ROOM / width, 0.25)
        self.bar.SetPosition(1.0 - room, 0.08)
        camera = self.renderer.GetActiveCamera()
        if camera.GetMTime() == self._reset_at:
            self.fit_camera(camera, (1.0 - room) * width / height)
            self.renderer.ResetCameraClippingRange()
        if camera.GetWindowCenter() != (room, 0.0):
            camera.SetWindowCenter(room, 0.0)

    def set_zoom(self, zoom):
        """Sets the factor by which the first view, and that of reset_camera(), enlarges the mesh;
        with 1, its bounds fit into the picture."""
        if not 0.0 < zoom < math.inf:
            raise ReadingError("The zoom must be above 0")
        self._zoom = zoom

    def fit_camera(self, camera, aspect):
        """Moves the eye so that the corners of the mesh's bounds fit into a picture of that width
        by height, from each of the directions of reset_camera(); with a zoom, into one that is
        larger by this factor."""
        fill = self._zoom * (0.8 if self.furniture.get("axes") else 0.94) * math.tan(
            math.radians(0.5 * camera.GetViewAngle()))
        corners = self._get_corners()
        distance = 0.0
        position = camera.GetPosition()
        for turn in range(self._turns):
            camera.SetPosition(position)
            camera.Azimuth(360.0 * turn / self._turns)
            view = camera.GetViewTransformMatrix()
            x, y, z = ([view.GetElement(i, j) for j in range(3)] @ corners for i in range(3))
            # A corner is within the border if |x| <= aspect fill (distance - z), and so on.
            reach = numpy.maximum(abs(x) / aspect, abs(y)) / fill
            distance = max(distance, (z + reach).max())
        camera.SetPosition(position)
        if 0.0 < distance < math.inf:  # bounds may be too large for their differences
            camera.Dolly(camera.GetDistance() / distance)

    def _get_corners(self):
        """Corners of the mesh's bounds, from their middle."""
        half = [0.5 * (self.bounds[2 * i + 1] - self.bounds[2 * i]) for i in range(3)]
        signs = numpy.indices((2, 2, 2)).reshape(3, 8).T * 2 - 1
        return (signs * half).T

    def get_arrays(self):
        """Names of the arrays that can be shown: of points, then of cells."""
        return list(arrays_of(self.data))

    def get_range(self):
        """Range of the colour map, in the numbers that are shown."""
        return self.limits or (self.levels.low, self.levels.high)

    def set_array(self, name, limits=None):
        """Shows an array; of one with several components, the magnitude.

        limits: range of the colour map; default: the range of the values. If the values need it,
        differences are shown instead of them, see choose_shown().
        """
        arrays = arrays_of(self.data)
        if name not in arrays:
            raise ReadingError(f"The mesh has no array '{name}'; it has " + ", ".join(arrays))
        association, _ = arrays[name]
        if limits and not -math.inf < limits[0] < limits[1] < math.inf:
            raise ReadingError("The range of the colour map must be two finite numbers, "
                               "the lower one first")
        levels = Levels(self.data, name, association)
        if levels.is_empty:
            raise ReadingError(self._explain_no_values(name, association))
        shown = choose_shown(self.data, name, association, levels.low, levels.high)
        if not shown.is_plain():
            levels = Levels(shown.apply(self.data, name, association), name, association)
        self.shown = shown
        self.array = name
        self.limits = limits and tuple(map(shown.number_of, limits))
        self.levels = levels
        self._select()
        self._update_functions()

    def _explain_no_values(self, name, association):
        """Why no cell has values of an array that can be shown."""
        values = [values_of(attributes.GetArray(name), None) for attributes in (
            leaf.GetPointData() if association == "points" else leaf.GetCellData()
            for leaf in drawn_leaves_of(self.data)) if attributes.HasArray(name)]
        others = [other for other in arrays_of(self.data) if other != name]
        return (f"The array '{name}' has no finite values" if not any(
            numpy.isfinite(part).any() for part in values) else
            f"No cell has finite values of the array '{name}' at all of its points") + (
                f"; there are also {', '.join(others)}" if others else "")

    def get_drawn(self):
        """The data that are drawn: those of the time step, with the numbers that are shown."""
        association, _ = arrays_of(self.data)[self.array]
        return self.shown.apply(self.data, self.array, association)

    def _select(self):
        """Gives the mapper the data and the array of a time step."""
        association, components = arrays_of(self.data)[self.array]
        self.mapper.SetInputData(self.get_drawn())
        if association == "points":
            self.mapper.SetScalarModeToUsePointFieldData()
        else:
            self.mapper.SetScalarModeToUseCellFieldData()
        self.mapper.SelectScalarArray(self.array)
        self.mapper.SetVectorMode(self.mapper.MAGNITUDE if components > 1 and self.shown.is_plain()
                                  else self.mapper.DISABLED)

    def _get_kind(self):
        return _KINDS.get(self.blend, _VOLUME)

    def get_curve(self):
        """The curve of opacity of the blend mode: points (place, opacity), where the place is 0 at
        the lower and 1 at the upper end of the range of the colour map. Of a volume the opacity is
        over a tenth of the mesh's diagonal."""
        kind = self._get_kind()
        if kind in self._curves:
            return self._curves[kind]
        return _CURVES[kind] if kind in _CURVES else simplify(
            self.levels.get_opacity(self.mapper.GetBounds()), self.get_range())

    def set_curve(self, points):
        """Sets the curve of the blend mode, points as of get_curve(), two at least; None: the
        default, which for a volume is chosen by the isosurface areas."""
        self._set_curve(self._get_kind(), points)

    def _set_curve(self, kind, points):
        self._curves.pop(kind, None)
        if points:
            self._curves[kind] = check_curve(points)
        self._update_functions()

    def get_histogram(self):
        """Volumes of the mesh by value, in equal bins over the range of the colour map."""
        return self.levels.get_histogram(*self.get_range())

    def _update_functions(self):
        low, high = self.get_range()
        look = self.volume.GetProperty()
        fill_colors(look.GetRGBTransferFunction(), self.colors, low, high)
        opacity = look.GetScalarOpacity()
        kind = self._get_kind()
        if kind == _VOLUME and kind not in self._curves:
            opacity.RemoveAllPoints()
            for scalar, coefficient in self.levels.get_opacity(self.mapper.GetBounds()):
                opacity.AddPoint(scalar, coefficient)
        else:
            fill_function(opacity, self.get_curve(), (low, high), kind == _VOLUME)
        contours = look.GetIsoSurfaceValues()
        values = (list(map(self.shown.number_of, self.isovalues)) if self.isovalues
                  else self.levels.get_isovalues())
        contours.SetNumberOfContours(len(values))
        for index, value in enumerate(values):
            contours.SetValue(index, value)
        ends = [0.0 if abs(end) < ROUND_OFF * (high - low) else end for end in (low, high)]
        self.bar.SetLookupTable(make_table(look.GetRGBTransferFunction(), *ends))
        self.bar.SetNumberOfLabels(5 if low < high else 1)
        self.bar.SetLabelFormat(find_label_format(ends))
        self.bar.SetTitle(self.get_title())

    def get_title(self):
        """Name of the numbers that are shown, with their unit if there is one."""
        name = self.shown.name_of(shorten(self.array))
        return f"{name} ({self.unit})" if self.unit else name

    def set_units(self, length="", value=""):
        """Units of lengths and of the array, such as "m" and "K", for the axes and the legend."""
        self.furniture.set_unit(length)
        self.unit = value
        self.bar.SetTitle(self.get_title())

    def set_colors(self, name):
        if find_colors(name) is None:
            raise ReadingError(f"There is no colour map '{name}'; known are "
                               + ", ".join(COLOR_MAPS) + ", and the names of the packages "
                               "matplotlib, cmocean, colorcet and trame-colormaps that are "
                               "installed (pip install)")
        self.colors = name
        self._update_functions()

    def set_density(self, factor):
        """Multiplies all attenuation coefficients by a factor > 0; 1 is the default."""
        if not 0.0 < factor < math.inf:
            raise ReadingError("The density must be a number above 0")
        self.density = factor
        self.volume.GetProperty().SetScalarOpacityUnitDistance(self.diagonal / factor)

    def set_opacities(self, values):
        """Opacities of a volume in [0, 1] at equal distances over the range of the colour map, each
        over a tenth of the mesh's diagonal; None: opacities chosen by volume."""
        if values and (len(values) < 2 or not all(0.0 <= value <= 1.0 for value in values)):
            raise ReadingError("Opacities must be at least two numbers from 0 to 1")
        self._set_curve(_VOLUME, values and [
            (index / (len(values) - 1), value) for index, value in enumerate(values)])

    def set_blend(self, name):
        if name not in BLEND_MODES:
            raise ReadingError(f"There is no blend mode '{name}'; known are "
                               + ", ".join(BLEND_MODES))
        self.blend = name
        self.mapper.SetBlendMode(BLEND_MODES[name])
        self._update_functions()

    def set_isovalues(self, values):
        """Shows isosurfaces of these values; None: values chosen by volume."""
        self.isovalues = sorted(values) if values else None
        self.set_blend("isosurface")

    def describe(self):
        """One line about the mesh: cells, points, memory, time steps, arrays."""
        leaves = drawn_leaves_of(self.data)
        cells = sum(leaf.GetNumberOfCells() for leaf in leaves)
        points = sum(leaf.GetNumberOfPoints() for leaf in leaves)
        arrays = ", ".join(name if components == 1 else f"{name} ({components})"
                           for name, (_, components) in arrays_of(self.data).items())
        steps = len(self.series.get_times())
        return (f"{cells:,} cells, {points:,} points, {self.data.GetActualMemorySize() / 1024:.1f}"
                f" MiB, {steps} time step{'s' if steps > 1 else ''}; arrays: {arrays}")

    def set_lit(self, lit):
        self.volume.GetProperty().SetShade(bool(lit))

    def is_lit(self):
        return bool(self.volume.GetProperty().GetShade())

    def set_shadows(self, reach):
        """reach: share of the volume's size over which it casts shadows into itself; 0: none.

        Shadows need a lamp beside the camera, and one that is brighter, as they darken.
        """
        self.mapper.SetGlobalIlluminationReach(reach)
        look = self.volume.GetProperty()
        look.SetAmbient((SHADOWED_MATERIAL if reach > 0.0 else MATERIAL)["ambient"])
        self.renderer.RemoveAllLights()
        self.renderer.SetAutomaticLightCreation(reach <= 0.0)
        if reach > 0.0:
            lamp = vtkLight()
            lamp.SetLightTypeToCameraLight()
            lamp.SetPosition(*SHADOW_LAMP)
            lamp.SetIntensity(SHADOW_INTENSITY)
            self.renderer.AddLight(lamp)

    def set_rays_at_edges(self, several):
        """several: true for up to 16 rays per pixel at edges of still pictures."""
        self.mapper.SetImageSampleDistance(0.25 if several else 1.0)

    def set_backend(self, name):
        if name not in BACKENDS:
            raise ReadingError(f"There is no backend '{name}'; known are " + ", ".join(BACKENDS))
        self.mapper.SetBackend(BACKENDS[name])

    def set_clip(self, axis, share=0.5):
        """Removes the part of the mesh below a share of its extent along an axis; None: nothing."""
        self.mapper.RemoveAllClippingPlanes()
        self.clip_axis = axis
        self.clip_share = share
        self.furniture.set_clipping_plane(None)
        if axis is None:
            return
        if axis not in AXES:
            raise ReadingError(f"There is no axis '{axis}'; they are x, y and z")
        if not math.isfinite(share):
            raise ReadingError("The share of a clipped extent must be a finite number")
        number = list(AXES).index(axis)
        low, high = self.bounds[2 * number], self.bounds[2 * number + 1]
        self._clip_plane.SetNormal(*AXES[axis])
        self._clip_plane.SetOrigin(*(component * (low + share * (high - low))
                                     for component in AXES[axis]))
        self.mapper.AddClippingPlane(self._clip_plane)
        self.furniture.set_clipping_plane(self._clip_plane)

    def set_step(self, step):
        """Shows another time step; the functions stay, so that colours can be compared."""
        self._take(self.series, step)

    def reload(self):
        """Reads the files of the series again, and keeps view and settings. If they cannot be used,
        it is a ReadingError, and the mesh of before stays."""
        series = MeshSeries(self.series.names)
        self._take(series, min(self.step, len(series.get_times()) - 1))

    def _take(self, series, step):
        data = series.read(step)
        arrays = arrays_of(data)
        if self.array not in arrays:
            raise ReadingError(f"Time step {step} has no array '{self.array}'; it has "
                               + (", ".join(arrays) or "none"))
        self.series, self.step, self.data = series, step, data
        self._select()
        self.bounds = tuple(self.mapper.GetBounds())
        self.furniture.set_data(data, self.bounds)

    def set_surface(self, surface, index, before=1.0):
        """Shows the volume through a refracting surface, whose border is drawn.

        surface: vtkPolyData. index, before: of refraction on the far and on the near side of it,
            where its normals point to the near side.
        """
        if not (index > 0.0 and before > 0.0):
            raise ReadingError("Indices of refraction must be above 0")
        self._has_surface = True
        self.mapper.SetMembraneData(surface)
        self.mapper.SetExteriorIndexOfRefraction(before)
        self.mapper.SetInteriorIndexOfRefraction(index)
        border = vtkFeatureEdges()
        border.SetInputData(surface)
        border.BoundaryEdgesOn()
        border.FeatureEdgesOff()
        border.NonManifoldEdgesOff()
        border.ManifoldEdgesOff()
        border.ColoringOff()
        lines = vtkPolyDataMapper()
        lines.SetInputConnection(border.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(lines)
        actor.GetProperty().SetColor(0.1, 0.3, 0.6)
        actor.GetProperty().LightingOff()
        self.renderer.AddActor(actor)

    def has_surface(self):
        return self._has_surface

    def reset_camera(self, direction=None, up=None, turns=1):
        """Looks at the volume from a direction, given as a vector to the eye. If the upward axis is
        parallel to it, another one is upward. Default: direction and axis of the last call. turns:
        number of directions around that axis from which all of the volume must fit into the
        picture. The distance is found before the next frame, for the size of its window."""
        self.direction = direction = direction or self.direction
        self.up = up = up or self.up
        if vtkMath.AngleBetweenVectors(direction, up) in (0.0, math.pi):
            up = (up[2], up[0], up[1])
        camera = self.renderer.GetActiveCamera()
        center = [0.5 * (self.bounds[2 * i] + self.bounds[2 * i + 1]) for i in range(3)]
        camera.SetFocalPoint(*center)
        # At this distance from it, so that it is not lost in the coordinates of a huge mesh.
        length = math.hypot(*direction)
        camera.SetPosition(*(center[i] + direction[i] / length * self.diagonal for i in range(3)))
        camera.SetViewUp(*up)
        self.renderer.ResetCamera(self.bounds)
        self._turns, self._reset_at = turns, camera.GetMTime()

    def explain_empty_picture(self):
        """Reason why a picture of the scene shows nothing of the mesh."""
        low, high = self.levels.low, self.levels.high
        opacity = self.volume.GetProperty().GetScalarOpacity()
        name = self.shown.name_of(self.array)
        opacities = numpy.empty(BINS + 1)
        opacity.GetTable(low, high, BINS + 1, opacities)
        if not opacities.any():
            return f"the opacity is 0 for all values of '{name}', from {low:g} to {high:g}"
        if self.clip_axis is not None and self.mapper.GetNumberOfActiveCells() > 0:
            return "the clipping plane removes all of it"
        flat = [axis for index, axis in enumerate(AXES)
                if not self.bounds[2 * index] < self.bounds[2 * index + 1]]
        if 0 < len(flat) < len(AXES):
            return "the mesh is flat: it has no extent along " + " and ".join(flat)
        if self.blend == "isosurface":
            return f"no cell has one of the isovalues; '{name}' goes from {low:g} to {high:g}"
        return "no ray through a pixel meets a cell that can be seen"
