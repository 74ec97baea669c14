# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Filters behind a pane of glass, two surfaces with a table of interfaces, and filters of
measurements by several cameras, against Snell's law."""
import math

import PluginTesting
from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIdTypeArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

EYE = [0.2, 0.1, 2]
GLASS, WATER = 1.5, 1.333
ROWS = [0, 1, GLASS, 1, GLASS, WATER]
LEVELS = (0, -0.1)  # of the faces of the pane
SLOPE = 0.6  # sine of a ray in air


def plane(half, z, resolution=1):
    return simple.Plane(Origin=[-half, -half, z], Point1=[half, -half, z], Point2=[-half, half, z],
                        XResolution=resolution, YResolution=resolution)


def make_pane():
    return [plane(8, z) for z in LEVELS]


def sine(start, end):
    """Of the angle to the vertical."""
    return math.hypot(end[0] - start[0], end[1] - start[1]) / math.dist(start, end)


def check_sight_rays(view):
    """Without an eye that is set, it is at the camera."""
    rays = simple.SightRays(Input=plane(1, -0.7, 3), Membrane=make_pane())
    rays.Interfaces = ROWS
    rays.UpdatePipeline()
    lines = servermanager.Fetch(rays)
    assert list(rays.EyePosition) == EYE, list(rays.EyePosition)
    assert lines.GetNumberOfCells() == 3 * 16, lines.GetNumberOfCells()
    legs = lines.GetCellData()
    for cell in range(lines.GetNumberOfCells()):
        ids = lines.GetCell(cell).GetPointIds()
        ends = [lines.GetPoint(ids.GetId(i)) for i in range(2)]
        leg = int(legs.GetArray("Leg").GetTuple1(cell))
        index = legs.GetArray("IndexOfRefraction").GetValue(cell)
        assert index == (1, GLASS, WATER)[leg]
        if leg == 0:
            first = sine(*ends)
        assert abs(index * sine(*ends) - first) < 1e-6, (cell, leg)
    assert rays.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")
    rays.FollowCamera = 1
    simple.Show(rays, view)
    view.CameraPosition = [1, 0, 3]
    simple.Render(view)
    assert list(rays.EyePosition) == [1, 0, 3], list(rays.EyePosition)
    simple.Hide(rays, view)


def check_cells():
    """A cell for each facet in the glass, and one in the water behind it."""
    first = plane(1, LEVELS[0], 2)
    cells = simple.MembraneCells(Membrane=[first, plane(8, LEVELS[1])], EyePosition=EYE)
    cells.Interfaces = ROWS
    cells.CellLength = 1.5
    grid = servermanager.Fetch(cells)
    assert grid.GetNumberOfCells() == 2 * 8, grid.GetNumberOfCells()
    behind = 0
    for number in range(grid.GetNumberOfCells()):
        ids = grid.GetCell(number).GetPointIds()
        for corner in range(3):
            near, far = (grid.GetPoint(ids.GetId(corner + k)) for k in (0, 3))
            is_glass = abs(near[2] - LEVELS[0]) < 1e-6
            behind += not is_glass
            if is_glass:
                assert abs(far[2] - LEVELS[1]) < 1e-6, far
            else:
                assert abs(near[2] - LEVELS[1]) < 1e-6 and abs(math.dist(near, far) - 1.5) < 1e-6
    assert behind == 3 * 8, behind
    assert cells.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")


def check_true_depths():
    """A point seen straight down, one unit behind the surface: how deep it is by each meaning."""
    seen = simple.PointSource(Center=[EYE[0], EYE[1], -1], NumberOfPoints=1, Radius=0)
    truth = simple.TruePosition(Input=seen, Membrane=plane(8, 0), EyePosition=EYE)
    for depth, length in (("Apparent", WATER), ("Optical", 1 / WATER), ("Geometric", 1)):
        truth.Depth = depth
        place = servermanager.Fetch(truth).GetPoint(0)
        assert abs(place[2] + length) < 1e-6, (depth, place)


def place_of_sight(eye, point):
    """The place on the water, z = 0, at which an eye sees a point: by bisection."""
    away = [point[i] - eye[i] for i in range(2)]
    low, high = 0.0, 1.0
    for _ in range(60):
        part = (low + high) / 2
        place = [eye[i] + part * away[i] for i in range(2)] + [0]
        if sine(eye, place) < WATER * sine(place, point):
            low = part
        else:
            high = part
    return place


def check_triangulation():
    """Two points, seen by three eyes; an observation is a place on the surface."""
    points = [(0.1, -0.2, -0.8), (-0.4, 0.3, -1.5)]
    eyes = [(2, 0, 1), (-1, 1, 2), (0, -2, 1.5)]
    data, places = vtkPolyData(), vtkPoints()
    places.SetDataTypeToDouble()
    numbers, seen_from = vtkIdTypeArray(), vtkDoubleArray()
    numbers.SetName("PointId")
    seen_from.SetName("Eye")
    seen_from.SetNumberOfComponents(3)
    for eye in eyes:
        for number, point in enumerate(points):
            places.InsertNextPoint(place_of_sight(eye, point))
            numbers.InsertNextValue(number)
            seen_from.InsertNextTuple(eye)
    data.SetPoints(places)
    data.GetPointData().AddArray(numbers)
    data.GetPointData().AddArray(seen_from)
    observed = simple.TrivialProducer()
    observed.SMProxy.GetClientSideObject().SetOutput(data)
    found = servermanager.Fetch(simple.TriangulatedPosition(Input=observed, Membrane=plane(8, 0)))
    assert found.GetNumberOfPoints() == 2
    for number, point in enumerate(points):
        assert math.dist(found.GetPoint(number), point) < 1e-6, found.GetPoint(number)
    # One eye cannot see how far away they are.
    behind = simple.TruePosition(Input=observed, Membrane=plane(8, 0), EyeArrayName="Eye")
    assert servermanager.Fetch(behind).GetNumberOfPoints() == 6


def check_depths():
    """Ranges of two, straight down from three: the points are on a sphere around the eye."""
    image = vtkImageData()
    image.SetDimensions(4, 4, 1)
    ranges = vtkDoubleArray()
    ranges.SetName("range")
    for _ in range(16):
        ranges.InsertNextValue(2)
    image.GetPointData().AddArray(ranges)
    source = simple.TrivialProducer()
    source.SMProxy.GetClientSideObject().SetOutput(image)
    points = simple.DepthImagePoints(Input=source, DepthType="Range", EyePosition=[0, 0, 3],
                                     ViewAngle=60)
    data = servermanager.Fetch(points)
    assert data.GetNumberOfPoints() == 16, data.GetNumberOfPoints()
    places = [data.GetPoint(i) for i in range(16)]
    assert all(abs(math.dist(place, [0, 0, 3]) - 2) < 1e-9 for place in places)
    assert places[0][0] < 0 and places[0][1] < 0 and places[15][0] > 0 and places[15][1] > 0
    points.DepthType = "View depth"
    data = servermanager.Fetch(points)
    assert all(abs(data.GetPoint(i)[2] - 1) < 1e-9 for i in range(16))


def check_integral():
    """Longest way of slanted rays through a layer under the pane: one over the cosine in water.
    Without rows, and behind one surface, it is that of a ray from air to water as well."""
    layer = simple.Transform(Input=simple.Wavelet(WholeExtent=[-4, 4, -4, 4, 0, 1]))
    layer.Transform.Translate = [0, 0, -2]
    layer.UpdatePipeline()
    rays = simple.TetrahedraRayIntegral(Input=layer, ImageSize=[40, 40],
                                        Direction=[SLOPE, 0, -math.sqrt(1 - SLOPE**2)])
    rays.ComputePathLength = 1
    wanted = {1: 1 / math.sqrt(1 - SLOPE**2), WATER: 1 / math.sqrt(1 - (SLOPE / WATER)**2)}

    def longest():
        return servermanager.Fetch(rays).GetPointData().GetArray("PathLength").GetRange()[1]
    assert abs(longest() - wanted[1]) < 1e-5, longest()
    rays.Membranes = make_pane()
    rays.Interfaces = ROWS
    assert abs(longest() - wanted[WATER]) < 1e-5, longest()
    rays.Interfaces = []
    rays.Membranes = [plane(8, 0)]
    assert abs(longest() - wanted[WATER]) < 1e-5, longest()
    # The component of a vector, and its length.
    vectors = simple.Calculator(Input=layer, ResultArrayName="V", Function="3*iHat+4*jHat")
    rays.Membranes = []
    rays.Input = vectors
    rays.ScalarArray = ["POINTS", "V"]
    rays.Direction = [0, 0, -1]
    for component, value in ((0, 3), (1, 4), (-1, 5)):
        rays.ArrayComponent = component
        data = servermanager.Fetch(rays).GetPointData()
        assert abs(data.GetArray("Integral").GetRange()[1] - value) < 1e-4, component


def test():
    PluginTesting.load_plugin()
    view = PluginTesting.make_view()
    simple.Show(plane(1, 0), view)
    simple.Render(view)  # the first one resets the camera
    simple.HideAll(view)
    view.CameraPosition = EYE
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    check_sight_rays(view)
    check_cells()
    check_true_depths()
    check_triangulation()
    check_depths()
    check_integral()


if __name__ == "__main__":
    PluginTesting.run(test)
