# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Several refracting interfaces in ParaView's filters: a pane of glass between air and water in
closed form, a ball that is one surface in two rows, and the filter True Position."""
import math

import PluginTesting
from paraview import servermanager, simple

EYE = (0.3, 0.2, 2.0)
MEDIA = (1.0, 1.5, 1.333)
PANE = (0.0, -0.1)
ROWS = [0, MEDIA[0], MEDIA[1], 1, MEDIA[1], MEDIA[2]]
# The points of the sources are single precision: 2^-24 of coordinates of about 1, a few times.
TOLERANCE = 1e-6


def plane(half, height, resolution):
    return simple.Plane(Origin=[-half, -half, height], Point1=[half, -half, height],
                        Point2=[-half, half, height], XResolution=resolution,
                        YResolution=resolution)


def sine(a, b):
    dx, dy, dz = (p - q for p, q in zip(a, b))
    return math.hypot(dx, dy) / math.sqrt(dx * dx + dy * dy + dz * dz)


def reflectances(cosine, before, behind):
    ratio = before / behind
    refracted = math.sqrt(1 - ratio * ratio * (1 - cosine * cosine))
    s = (before * cosine - behind * refracted) / (before * cosine + behind * refracted)
    p = (behind * cosine - before * refracted) / (behind * cosine + before * refracted)
    return s * s, p * p


def largest_shift(first, second):
    assert first.GetNumberOfPoints() == second.GetNumberOfPoints() > 0
    return max(math.dist(first.GetPoint(i), second.GetPoint(i))
               for i in range(first.GetNumberOfPoints()))


def distance_from_centre(a, b):
    """Distance of the line through two points from the origin."""
    cross = [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
    return math.hypot(*cross) / math.dist(a, b)


def check_geometry(sphere, surfaces):
    """Snell's law at both surfaces; then the way back."""
    refracted = simple.RefractedGeometry(Geometry=sphere, Membrane=surfaces, EyePosition=EYE)
    refracted.Images = "First image"
    refracted.Interfaces = ROWS
    refracted.OutputPointsPrecision = "Double"
    virtual = servermanager.Fetch(refracted)
    source = servermanager.Fetch(sphere)
    assert virtual.GetNumberOfPoints() == source.GetNumberOfPoints()
    points = virtual.GetPointData()
    for i in range(virtual.GetNumberOfPoints()):
        sight = points.GetArray("SightPoint").GetTuple(i)
        last = points.GetArray("LastSightPoint").GetTuple(i)
        sines = [sine(EYE, sight), sine(sight, last), sine(last, source.GetPoint(i))]
        assert abs(sight[2] - PANE[0]) < TOLERANCE and abs(last[2] - PANE[1]) < TOLERANCE
        invariants = [n * s for n, s in zip(MEDIA, sines)]
        assert max(invariants) - min(invariants) < TOLERANCE, invariants

    truth = simple.TruePosition(Input=refracted, Membrane=surfaces, EyePosition=EYE)
    truth.Interfaces = ROWS
    found = servermanager.Fetch(truth)
    assert found.GetPointData().GetArray("SeenState").GetRange() == (1.0, 1.0)
    shift = largest_shift(found, source)
    assert shift < TOLERANCE, "the way back ends %g from the source" % shift


def check_one_interface(sphere, surface):
    """A table with one row, and no table, are the same."""
    plain = simple.RefractedGeometry(Geometry=sphere, Membrane=surface, EyePosition=EYE,
                                     Images="First image", InteriorIndexOfRefraction=1.4)
    row = simple.RefractedGeometry(Geometry=sphere, Membrane=surface, EyePosition=EYE,
                                   Images="First image", Interfaces=[0, 1.0, 1.4])
    expected = servermanager.Fetch(plain)
    assert largest_shift(expected, servermanager.Fetch(row)) == 0
    row.Interfaces = []  # back to the two indices
    row.InteriorIndexOfRefraction = 1.4
    assert largest_shift(expected, servermanager.Fetch(row)) == 0
    back = simple.TruePosition(Input=plain, Membrane=surface, EyePosition=EYE,
                               InteriorIndexOfRefraction=1.4)
    assert largest_shift(servermanager.Fetch(back), servermanager.Fetch(sphere)) < 2 * TOLERANCE
    blocks = simple.TruePosition(Input=simple.GroupDatasets(Input=[plain, plain]),
                                 Membrane=surface, EyePosition=EYE, InteriorIndexOfRefraction=1.4)
    found = servermanager.Fetch(blocks)
    assert found.GetNumberOfBlocks() == 2
    assert largest_shift(found.GetBlock(1), servermanager.Fetch(back)) == 0


def check_ball():
    """A ball of index 1.5, exact by its formula: both sight points are on it, Snell's law holds at
    both, and the depth is the sum of the legs over their indices. One image is shown, which may be
    on the axis or in the ring around it."""
    ball = simple.Sphere(Radius=0.5, ThetaResolution=48, PhiResolution=24)
    eye, target = (0, 0, 2), (0.01, 0.02, -0.9)
    lens = simple.RefractedGeometry(Geometry=simple.Sphere(Center=target, Radius=1e-3),
                                    Membrane=ball, EyePosition=eye, Images="First image",
                                    OutputPointsPrecision="Double")
    lens.Interfaces = [0, 1, 1.5, 0, 1, 1.5]
    lens.ExactMembrane = "Sphere"
    lens.ExactMembrane.Radius = 0.5
    seen = servermanager.Fetch(lens)
    source = servermanager.Fetch(lens.Geometry)
    assert seen.GetNumberOfPoints() == source.GetNumberOfPoints()
    points = seen.GetPointData()
    for i in range(seen.GetNumberOfPoints()):
        sight = points.GetArray("SightPoint").GetTuple(i)
        last = points.GetArray("LastSightPoint").GetTuple(i)
        inside, behind = points.GetArray("LegLengths").GetTuple(i)
        true = source.GetPoint(int(points.GetArray("SourcePointId").GetTuple1(i)))
        assert abs(math.dist(sight, (0, 0, 0)) - 0.5) < TOLERANCE
        assert abs(math.dist(last, (0, 0, 0)) - 0.5) < TOLERANCE
        assert abs(math.dist(sight, last) - inside) < TOLERANCE
        assert abs(math.dist(last, true) - behind) < TOLERANCE
        assert abs(math.dist(seen.GetPoint(i), sight) - inside / 1.5 - behind) < TOLERANCE
        # Distance of a ray's line from the centre, times the index: kept through the ball.
        moments = [n * distance_from_centre(p, q)
                   for n, p, q in ((1, eye, sight), (1.5, sight, last), (1, last, true))]
        assert max(moments) - min(moments) < TOLERANCE, moments


def check_light(surfaces):
    light = simple.RefractedLight(Geometry=plane(0.5, -1, 10), Membrane=surfaces)
    light.Interfaces = ROWS
    for angle in 0, 0.8:
        light.LightPosition = [math.sin(angle), 0, math.cos(angle)]
        inside = math.sqrt(1 - (math.sin(angle) / MEDIA[1]) ** 2)
        # Of each polarisation, with all reflections between the sides of the pane (Stokes 1862).
        expected = math.cos(angle) / 2 * sum(
            (1 - first) * (1 - last) / (1 - first * last)
            for first, last in zip(reflectances(math.cos(angle), *MEDIA[:2]),
                                   reflectances(inside, *MEDIA[1:])))
        data = servermanager.Fetch(light).GetPointData()
        low, high = data.GetArray("RefractionIrradiance").GetRange()
        # The light is ten thousand sizes of the scene away.
        assert abs(low - expected) < 2e-4 and abs(high - expected) < 2e-4, (low, high, expected)


def check_errors(surfaces):
    volume = simple.RefractionErrorVolume(Membrane=surfaces, FinerMembrane=surfaces,
                                          EyePosition=EYE, Interfaces=ROWS)
    volume.ModelBounds = [-1, 1, -1, 1, -2, -0.2]
    volume.SampleDimensions = [4, 4, 4]
    fields = servermanager.Fetch(volume).GetFieldData()
    assert fields.GetArray("NumberOfMeasuredSamples").GetValue(0) == 64
    assert fields.GetArray("LargestError").GetValue(0) < 1e-9


def test():
    PluginTesting.load_plugin()
    surfaces = [plane(5, z, 8) for z in PANE]
    sphere = simple.Sphere(Center=[0, 0, -0.6], Radius=0.3)
    check_geometry(sphere, surfaces)
    check_one_interface(sphere, surfaces[0])
    check_ball()
    check_light(surfaces)
    check_errors(surfaces)


if __name__ == "__main__":
    PluginTesting.run(test)
