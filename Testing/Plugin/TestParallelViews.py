# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""In parallel views the eye is at infinity: behind a plane, parallel rays are refracted by the same
angle, and an object is seen at n1 / n2 of its distance from the sight point. The volume, the
geometry and the measuring filters agree."""
import math

import PluginTesting
from PluginTesting import SIZE, covered, screenshot
from paraview import servermanager, simple

INDEX = 1.333
DIRECTION = (0.6, 0.0, -0.8)  # of projection
DEPTH = 0.7


def make_water():
    return simple.Plane(Origin=[-4, -4, 0], Point1=[4, -4, 0], Point2=[-4, 4, 0], XResolution=8,
                        YResolution=8)


def make_points():
    """Points in the plane of the depth."""
    return simple.Plane(Origin=[-0.5, -0.5, -DEPTH], Point1=[0.5, -0.5, -DEPTH],
                        Point2=[-0.5, 0.5, -DEPTH], XResolution=2, YResolution=2)


def prepare(view):
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 1.5
    view.CameraPosition = [-3 * DIRECTION[0], 0, -DEPTH - 3 * DIRECTION[2]]
    view.CameraFocalPoint = [0, 0, -DEPTH]
    view.CameraViewUp = [0, 1, 0]


def seen_places(points):
    """Virtual points of true ones behind the plane z = 0."""
    inner = [DIRECTION[0] / INDEX, 0, -math.sqrt(1 - (DIRECTION[0] / INDEX) ** 2)]
    places = []
    for point in points:
        length = point[2] / inner[2]
        sight = [point[i] - length * inner[i] for i in range(3)]
        places.append([sight[i] + length / INDEX * DIRECTION[i] for i in range(3)])
    return places


def points_of(source):
    data = servermanager.Fetch(source)
    return [data.GetPoint(i) for i in range(data.GetNumberOfPoints())]


def largest_difference(some, others):
    assert len(some) == len(others) > 0
    return max(math.dist(a, b) for a, b in zip(some, others))


def check_points(view, water):
    """Tolerance: the eye is 1e5 sizes of the water, 11 units, away; its rays differ by 1e-5."""
    true = make_points()
    refracted = simple.RefractedGeometry(Geometry=true, Membrane=water)
    simple.Show(refracted, view)
    simple.Render(view)
    assert refracted.FollowCamera
    wanted = seen_places(points_of(true))
    # Borders are cut at image outlines; the corners of the square come first.
    seen = points_of(refracted)[:len(wanted)]
    difference = largest_difference(seen, wanted)
    assert difference < 3e-5, (difference, seen[:3], wanted[:3])
    simple.Hide(refracted, view)

    back = simple.TruePosition(Input=refracted, Membrane=water)
    back.FollowCamera = 1
    simple.Show(back, view)
    simple.Render(view)
    difference = largest_difference(points_of(back)[:len(wanted)], points_of(true))
    assert difference < 3e-5, difference
    simple.Hide(back, view)
    # An eye that is set is a place, also in a parallel view.
    refracted.EyePosition = [0, 0, 3]
    simple.Show(refracted, view)
    simple.Render(view)
    assert not refracted.FollowCamera
    below = [point for point in points_of(refracted) if math.hypot(point[0], point[1]) < 1e-6]
    assert abs(below[0][2] + DEPTH / INDEX) < 1e-6, below
    simple.Delete(refracted)


def check_pictures(view, water):
    """An opaque box as a volume through the water, and its surface as virtual geometry."""
    box = simple.Wavelet(WholeExtent=[-2, 2] * 3)
    place = simple.Transform(Input=simple.Tetrahedralize(Input=box))
    place.Transform.Scale = [0.2] * 3
    place.Transform.Translate = [0, 0, -DEPTH]
    display = simple.Show(place, view)
    display.SetRepresentationType("Volume (Exact)")
    opacity = simple.GetOpacityTransferFunction("RTData")
    opacity.Points = [0, 1, 0.5, 0, 300, 1, 0.5, 0]
    display.ScalarOpacityUnitDistance = 1e-4
    display.Membrane = water
    volume = covered(screenshot(view, "ParallelVolume"))
    simple.Hide(place, view)
    skin = simple.ExtractSurface(Input=place)
    refracted = simple.RefractedGeometry(Geometry=skin, Membrane=water)
    shown = simple.Show(refracted, view)
    simple.ColorBy(shown, None)
    shown.Ambient, shown.AmbientColor = 1, [1, 1, 1]
    surface = covered(screenshot(view, "ParallelSurface"))
    print("covered: %d and %d, different %d" % (len(volume), len(surface), len(volume ^ surface)))
    assert len(surface) > 0.02 * SIZE**2
    # The outline, of about four times the square root of the area, may differ by half a pixel.
    assert len(volume ^ surface) < 2 * math.sqrt(len(surface))


def test():
    PluginTesting.load_plugin()
    view = PluginTesting.make_view()
    view.UseFXAA = 0
    water = make_water()
    simple.Show(make_points(), view)
    simple.Render(view)  # the first one resets the camera
    simple.HideAll(view)
    prepare(view)
    check_points(view, water)
    check_pictures(view, water)


if __name__ == "__main__":
    PluginTesting.run(test)
