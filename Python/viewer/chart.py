# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A strip below the volume: the histogram of the array and the curve of opacity, whose points are
dragged, added and removed with the mouse."""
from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkChartsCore import (
    vtkAxis, vtkChart, vtkChartXY, vtkPiecewiseControlPointsItem, vtkPiecewiseFunctionItem)
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction, vtkTable
from vtkmodules.vtkRenderingContext2D import vtkContextActor
from vtkmodules.vtkRenderingCore import vtkRenderer
from vtkmodules.vtkViewsContext2D import vtkContextInteractorStyle

from .furniture import INK

# Height of the strip as a share of the window's.
HEIGHT = 0.24
# Room for the points at the ends of the range, as shares of it.
_MARGIN, _TOP_MARGIN = 0.01, 0.08
_PAPER = (0.965, 0.97, 0.975)
_CURVE = (60, 60, 75)


def _make_column(name: str, values: Any) -> Any:
    array = numpy_to_vtk(numpy.asarray(values, float), deep=True)
    array.SetName(name)
    return array


class OpacityChart:
    """The chart of a MeshScene in a renderer of its own (attribute renderer).

    style: interactor style that passes the events of the mouse to the chart.
    """

    def __init__(self, scene: Any, changed: Callable[[], None]) -> None:
        """changed: called after the mouse has changed the curve of the scene."""
        self._scene = scene
        self._changed = changed
        self._filling = False
        self._shown: Any = None
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(*_PAPER)
        self.renderer.SetViewport(0.0, 0.0, 1.0, HEIGHT)
        self.renderer.InteractiveOff()
        self.function = vtkPiecewiseFunction()
        self.chart = self._make_chart()
        self._table = vtkTable()
        self._bars = self.chart.AddPlot(vtkChart.BAR)
        self._bars.GetPen().SetOpacity(0)
        self._bars.SetWidth(1.0)
        self._line = vtkPiecewiseFunctionItem()
        self._line.SetPiecewiseFunction(self.function)
        self._line.SetMaskAboveCurve(True)
        self._line.GetPen().SetColor(*_CURVE)
        self._line.SetOpacity(0.25)
        self._line.GetPolyLinePen().SetColor(*_CURVE)
        self._line.GetPolyLinePen().SetWidth(2.0)
        self.chart.AddPlot(self._line)
        self.points = self._make_points()
        self.chart.AddPlot(self.points)
        actor = vtkContextActor()
        actor.GetScene().AddItem(self.chart)
        actor.GetScene().SetRenderer(self.renderer)
        self.renderer.AddActor(actor)
        self._context = actor.GetScene()
        self.style = vtkContextInteractorStyle()
        self.update()

    @staticmethod
    def _make_chart() -> Any:
        chart = vtkChartXY()
        chart.SetAutoAxes(False)
        chart.SetZoomWithMouseWheel(False)
        chart.SetBarWidthFraction(1.0)
        # The buttons of the mouse belong to the curve.
        for action in (vtkChart.PAN, vtkChart.ZOOM, vtkChart.SELECT):
            chart.SetActionToButton(action, -1)
        for place, title in ((vtkAxis.BOTTOM, ""), (vtkAxis.LEFT, "opacity")):
            axis = chart.GetAxis(place)
            axis.SetTitle(title)
            axis.SetBehavior(vtkAxis.FIXED)
            axis.SetGridVisible(False)
            for text in (axis.GetTitleProperties(), axis.GetLabelProperties()):
                text.SetColor(*INK)
                text.SetFontSize(13)
                text.BoldOff()
        chart.GetAxis(vtkAxis.LEFT).SetRange(-_TOP_MARGIN, 1.0 + _TOP_MARGIN)
        for place in (vtkAxis.TOP, vtkAxis.RIGHT):
            chart.GetAxis(place).SetVisible(False)
        return chart

    def _make_points(self) -> Any:
        points = vtkPiecewiseControlPointsItem()
        points.SetPiecewiseFunction(self.function)
        points.SetEndPointsXMovable(False)
        points.SetEndPointsYMovable(True)
        points.SetEndPointsRemovable(False)
        points.SetShowLabels(False)
        points.GetPen().SetColor(*_CURVE)
        points.GetPen().SetWidth(2.0)
        points.GetBrush().SetColor(*_CURVE)
        points.AddObserver("ModifiedEvent", lambda *_: self._take_curve())
        self.function.AddObserver("ModifiedEvent", lambda *_: self._take_curve())
        return points

    def set_visible(self, visible: bool) -> None:
        self.renderer.SetDraw(visible)

    def activate(self, interactor: Any) -> None:
        """Gives the mouse to the chart."""
        interactor.SetInteractorStyle(self.style)
        self.style.SetScene(self._context)

    def deactivate(self, interactor: Any, style: Any) -> None:
        """Gives the mouse to another style. Without an interactor the chart's own must not have a
        scene, whose changes it would pass on."""
        self.style.SetScene(None)
        interactor.SetInteractorStyle(style)

    def update(self) -> None:
        """Shows the scene's array, colours and curve."""
        scene = self._scene
        low, high = scene.get_range()
        curve = scene.get_curve()
        shown = (scene.array, (low, high), scene.colors, scene.unit, scene.step, curve)
        if shown == self._shown:
            return
        self._shown = shown
        self._show_histogram(low, high)
        self.chart.GetAxis(vtkAxis.BOTTOM).SetTitle(scene.get_title())
        self.chart.GetAxis(vtkAxis.BOTTOM).SetRange(
            low - _MARGIN * (high - low), high + _MARGIN * (high - low))
        self._filling = True
        self.function.RemoveAllPoints()
        for place, opacity in curve:
            self.function.AddPoint(low + place * (high - low), opacity)
        # Points stay in the chart.
        self.points.SetUserBounds(low, high, 0.0, 1.0)
        self.points.SetValidBounds(low, high, 0.0, 1.0)
        self._filling = False

    def _show_histogram(self, low: float, high: float) -> None:
        volumes = self._scene.get_histogram()
        edges = numpy.linspace(low, high, volumes.size + 1)
        # Roots, because some values are thousands of times as frequent as others.
        heights = numpy.sqrt(volumes / (volumes.max() or 1.0))
        self._table = vtkTable()
        for name, values in (("value", 0.5 * (edges[1:] + edges[:-1])), ("height", heights)):
            self._table.AddColumn(_make_column(name, values))
        self._bars.SetInputData(self._table, "value", "height")
        self._bars.SetLookupTable(self._scene.bar.GetLookupTable())
        self._bars.SelectColorArray("value")
        self._bars.ScalarVisibilityOn()

    def _take_curve(self) -> None:
        if self._filling:
            return
        low, high = self._scene.get_range()
        curve, node = [], [0.0] * 4
        for index in range(self.function.GetSize()):
            self.function.GetNodeValue(index, node)
            curve.append(((node[0] - low) / (high - low), node[1]))
        if len(curve) < 2 or curve == self._scene.get_curve():
            return
        self._scene.set_curve(curve)
        self._shown = None
        self._changed()
