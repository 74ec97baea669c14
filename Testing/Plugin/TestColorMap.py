# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Compares pictures with the colours of the colour map, for the settings of the colour map editor:
an opaque bar whose scalars rise from left to right, seen from the front by its maximum, shows the
map. Log scale, few colours, colours below and above the range and their borders, NaN."""
import math

import PluginTesting
from PluginTesting import SIZE, screenshot
from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkDoubleArray

LENGTH, LOWEST, HIGHEST = 100, 1.0, 1001.0
RISING = "1+10*coordsX"
LOW, HIGH = 10.0, 500.0
TOLERANCE = 2  # of 255: the map's colours and ours are both rounded
STEEPEST = 20  # steps of 255 in a pixel; a larger step is a border


def scalar_at(column):
    """Scalar in the middle of a column of pixels; the bar is as long as the image is wide."""
    return LOWEST + (HIGHEST - LOWEST) * (column + 0.5) / SIZE


def make_bar(function):
    bar = simple.Calculator(Input=simple.Wavelet(WholeExtent=[0, LENGTH, 0, 9, 0, 2]),
                            ResultArrayName="Rising", Function=function)
    return simple.Tetrahedralize(Input=bar)


def show(view, bar):
    display = simple.Show(bar, view)
    display.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(display, ("POINTS", "Rising"))
    display.BlendMode = "Maximum intensity"
    display.SetScalarBarVisibility(view, False)
    simple.Render(view)  # the first one resets the camera
    view.CameraParallelProjection = 1
    view.CameraParallelScale = LENGTH / 2
    view.CameraPosition = [LENGTH / 2, 4.5, 100]
    view.CameraFocalPoint = [LENGTH / 2, 4.5, 0]
    view.CameraViewUp = [0, 1, 0]


def row_of(view, name):
    """The pixels along the middle of the bar."""
    return screenshot(view, "ColorMap" + name)[SIZE // 2 * SIZE:][:SIZE]


def distance(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def is_between(color, others):
    """At a border, which is a 4096th of an interval wide, a pixel may be a mixture."""
    return all(min(channel) <= value <= max(channel) for value, channel in zip(color, zip(*others)))


def colors_of(table, scalars):
    """Colours with which ParaView draws surfaces."""
    array = vtkDoubleArray()
    for scalar in scalars:
        array.InsertNextValue(scalar)
    mapped = table.MapScalars(array, 1, 0)  # even an array of colours
    return [mapped.GetTuple(i)[:3] for i in range(len(scalars))]


def check(view, colors, name, columns=range(SIZE)):
    """Checks that each pixel has the colour of a surface with a scalar in the pixel or in its
    neighbours, so that borders are off by a pixel at most. Returns the colours next to borders and
    the pixels at them."""
    row = row_of(view, name)
    table = colors.SMProxy.GetClientSideObject()
    parts = 8  # of a pixel
    worst, borders = 0, []
    for column in columns:
        wanted = colors_of(
            table, [scalar_at(column + k / parts) for k in range(-parts, parts + 1)])
        found = min(distance(row[column], color) for color in wanted)
        if max(map(distance, wanted, wanted[1:])) > STEEPEST:
            borders.append(column)
            if is_between(row[column], wanted):
                continue
        worst = max(worst, found)
        assert found <= TOLERANCE, "%s: pixel %d, scalar %g, is %s, not %s" % (
            name, column, scalar_at(column), row[column], wanted[parts])
    found = {row[column] for column in columns if column not in borders}
    print("%s: worst difference %d of 255, %d colours, borders at %s"
          % (name, worst, len(found), borders))
    return found, borders


def columns_of(scalar):
    """The two columns between whose middles a scalar is."""
    place = (scalar - LOWEST) / (HIGHEST - LOWEST) * SIZE - 0.5
    return {int(place), int(place) + 1}


def check_features(view, colors):
    plain, borders = check(view, colors, "Plain")
    assert len(plain) > 60 and not borders

    colors.UseBelowRangeColor = colors.UseAboveRangeColor = 1
    colors.BelowRangeColor, colors.AboveRangeColor = [0, 1, 0], [1, 1, 0]
    ranged, borders = check(view, colors, "Ranged")
    assert {(0, 255, 0), (255, 255, 0)} <= ranged, ranged
    assert columns_of(LOW) & set(borders) and columns_of(HIGH) & set(borders)

    colors.NumberOfTableValues = 5
    few, borders = check(view, colors, "RangedFew")
    assert len(few) == 7, few
    for i in range(6):
        assert columns_of(LOW + i * (HIGH - LOW) / 5) & set(borders), "no border %d" % i

    colors.UseBelowRangeColor = colors.UseAboveRangeColor = 0
    assert len(check(view, colors, "Few")[0]) == 5
    colors.MapControlPointsToLogSpace()
    colors.UseLogScale = 1
    few, borders = check(view, colors, "FewLog")
    assert len(few) == 5
    for i in range(1, 5):
        assert columns_of(LOW * (HIGH / LOW) ** (i / 5)) & set(borders), "no border %d" % i

    colors.NumberOfTableValues = 256
    log, _ = check(view, colors, "Log")
    assert log != plain and len(log) > 60
    colors.Discretize = 0
    check(view, colors, "Smooth")


def check_not_a_number(view):
    """Cells with a NaN at a vertex are left out, whatever the colour of NaN is."""
    data = servermanager.Fetch(make_bar(RISING))
    rising = data.GetPointData().GetArray("Rising")
    for i in range(data.GetNumberOfPoints()):
        if 40 < data.GetPoint(i)[0] < 60:
            rising.SetTuple1(i, math.nan)
    bar = simple.TrivialProducer()
    bar.SMProxy.GetClientSideObject().SetOutput(data)
    show(view, bar)
    colors = simple.GetColorTransferFunction("Rising")
    colors.NanColor = [1, 0, 1]
    first, last = (SIZE * x // LENGTH for x in (40, 60))
    row = row_of(view, "NaN")
    assert set(row[first + 1:last - 1]) == {PluginTesting.BACKGROUND}, set(row[first:last])
    check(view, colors, "NaN", [*range(first - 1), *range(last + 1, SIZE)])


def test():
    PluginTesting.load_plugin()
    view = PluginTesting.make_view()
    bar = make_bar(RISING)
    show(view, bar)
    colors = simple.GetColorTransferFunction("Rising")
    colors.RescaleTransferFunction(LOW, HIGH)
    opacity = simple.GetOpacityTransferFunction("Rising")
    opacity.Points = [LOWEST, 1, 0.5, 0, HIGHEST, 1, 0.5, 0]
    check_features(view, colors)
    simple.Hide(bar, view)
    check_not_a_number(view)


if __name__ == "__main__":
    PluginTesting.run(test)
