# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""What helps to read a picture of a mesh: outline, axes with units, edges of the surface."""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter, vtkGeometryFilter
from vtkmodules.vtkFiltersSources import vtkOutlineSource
from vtkmodules.vtkRenderingAnnotation import vtkCubeAxesActor2D
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

INK = (0.1, 0.1, 0.15)
_LINES = (0.35, 0.38, 0.45)


def find_label_format(*ranges: Sequence[float]) -> str:
    """Format of numbers at equal distances in these ranges, each with a lower and an upper end: of
    3 digits, or of more, up to 8, that keep them within 1/40 of the range."""
    digits = 3
    for low, high in ranges:
        largest = max(abs(low), abs(high))
        if 0.0 < high - low < math.inf and largest < math.inf:
            # Half a unit of the last of d digits is up to 5 * 10^-d of the number.
            digits = max(digits, math.ceil(math.log10(200.0 * (largest / (high - low)))))
    return f"%.{min(digits, 8)}g"


class Furniture:
    """Outline, axes and edges in the renderer of a volume; none is shown at first.

    Names: "outline", "axes", "edges".
    """

    NAMES = ("outline", "axes", "edges")

    def __init__(self, renderer: Any) -> None:
        self._data: Any = None
        self._box = vtkOutlineSource()
        outline = self._make_lines()
        outline.GetMapper().SetInputConnection(self._box.GetOutputPort())
        self._axes = self._make_axes(renderer)
        self._edges = self._make_lines()
        self._edges.GetProperty().SetRepresentationToWireframe()
        self._edges.GetMapper().ScalarVisibilityOff()
        self._props = {"outline": outline, "axes": self._axes, "edges": self._edges}
        for prop in self._props.values():
            prop.VisibilityOff()
            prop.PickableOff()
            renderer.AddViewProp(prop)

    @staticmethod
    def _make_lines() -> Any:
        actor = vtkActor()
        actor.SetMapper(vtkPolyDataMapper())
        actor.GetProperty().SetColor(*_LINES)
        actor.GetProperty().LightingOff()
        return actor

    @staticmethod
    def _make_axes(renderer: Any) -> Any:
        axes = vtkCubeAxesActor2D()
        axes.SetCamera(renderer.GetActiveCamera())
        axes.SetFlyModeToOuterEdges()
        axes.SetNumberOfLabels(3)  # more overlap along a short side
        axes.SetFontFactor(1.1)
        axes.SetCornerOffset(0.04)
        axes.GetProperty().SetColor(*_LINES)
        for text in axes.GetAxisTitleTextProperty(), axes.GetAxisLabelTextProperty():
            text.SetColor(*INK)
            text.ShadowOff()
            text.ItalicOff()
            text.BoldOff()
        return axes

    def set_unit(self, unit: str) -> None:
        """Unit of the lengths at the axes, such as "m"; empty: none."""
        for name in "XYZ":
            label = f"{name.lower()} ({unit})" if unit else name.lower()
            getattr(self._axes, f"Set{name}Label")(label)

    def set_data(self, data: Any, bounds: Any) -> None:
        """Goes around another mesh."""
        self._data = data
        self._box.SetBounds(*bounds)
        self._axes.SetBounds(*bounds)
        self._axes.SetLabelFormat(find_label_format(*zip(bounds[::2], bounds[1::2])))
        if self.get("edges"):
            self._update_edges()

    def get(self, name: str) -> bool:
        return bool(self._props[name].GetVisibility())

    def set(self, name: str, shown: bool) -> None:
        if name == "edges" and shown:
            self._update_edges()
        self._props[name].SetVisibility(bool(shown))

    def _update_edges(self) -> None:
        """Edges are found only while they are shown: this takes time for large meshes."""
        composite = isinstance(self._data, vtkCompositeDataSet)
        surface = vtkCompositeDataGeometryFilter() if composite else vtkGeometryFilter()
        surface.SetInputDataObject(self._data)
        surface.Update()
        self._edges.GetMapper().SetInputDataObject(surface.GetOutput())

    def set_clipping_plane(self, plane: Any) -> None:
        """Cuts the edges, as the volume, at a plane; None: nothing."""
        mapper = self._edges.GetMapper()
        mapper.RemoveAllClippingPlanes()
        if plane is not None:
            mapper.AddClippingPlane(plane)
