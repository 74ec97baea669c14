# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Several refracting interfaces in ParaView's filters: a pane of glass between air and water in
closed form, a ball that is one surface in two rows, lists that cannot be used, and the filter True
Position."""
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


def transmittance(cosine, before, behind):
    ratio = before / behind
    refracted = math.sqrt(1 - ratio * ratio * (1 - cosine * cosine))
    s = (before * cosine - behind * refracted) / (before * cosine + behind * refracted)
    p = (behind * cosine - before * refracted) / (behind * cosine + before * refracted)
    return 1 - (s * s + p * p) / 2


def largest_shift(first, second):
    assert first.GetNumberOfPoints() == second.GetNumberOfPoints() > 0
    return max(math.dist(first.GetPoint(i), second.GetPoint(i))
               for i in range(first.GetNumberOfPoints()))


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
    return refracted


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
    """A ball of index 1.5, exact by its formula: a point on its axis through the eye stays there,
    and its depth is the sum of the legs over their indices."""
    ball = simple.Sphere(Radius=0.5, ThetaResolution=48, PhiResolution=24)
    target = simple.Sphere(Center=[0, 0, -1], Radius=1e-4)
    lens = simple.RefractedGeometry(Geometry=target, Membrane=ball, EyePosition=[0, 0, 2],
                                    Images="First image", Interfaces=[0, 1, 1.5, 0, 1, 1.5])
    lens.ExactMembrane = "Sphere"
    lens.ExactMembrane.Radius = 0.5
    seen = servermanager.Fetch(lens)
    assert seen.GetNumberOfPoints() == servermanager.Fetch(target).GetNumberOfPoints()
    x, y, z = seen.GetCenter()
    # Paraxial: the target's radius is 1e-4 of the ball's.
    assert abs(z - (0.5 - 1.0 / 1.5 - 0.5)) < 1e-3 and math.hypot(x, y) < 1e-3, (x, y, z)


def check_light(surfaces):
    light = simple.RefractedLight(Geometry=plane(0.5, -1, 10), Membrane=surfaces)
    light.Interfaces = ROWS
    for angle in 0, 0.8:
        light.LightPosition = [math.sin(angle), 0, math.cos(angle)]
        inside = math.sqrt(1 - (math.sin(angle) / MEDIA[1]) ** 2)
        expected = (math.cos(angle) * transmittance(math.cos(angle), *MEDIA[:2])
                    * transmittance(inside, *MEDIA[1:]))
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


def check_bad_lists(refracted, surfaces):
    for rows in ([0, 1, 1.5, 2, 1.5, 1.333],  # there is no surface 2
                 [0, 1, 1.5, 0.5, 1.5, 1.333], [0, 1, 1.5, -1, 1.5, 1.333],
                 [0, 1, 1.5, math.nan, 1.5, 1.333],
                 [0, 1, 1.5],  # surface 1 has no row
                 [0, 1, 1.5, 1, 1.4, 1.333],  # media do not match
                 [0, 1, 1.5, 1, 1.5, -1.333], [0, 1, math.nan, 1, 1.5, 1.333]):
        refracted.Interfaces = rows
        assert servermanager.Fetch(refracted).GetNumberOfPoints() == 0, rows
    refracted.Interfaces = []  # two surfaces, and one interface
    assert servermanager.Fetch(refracted).GetNumberOfPoints() == 0
    refracted.Interfaces = ROWS
    assert servermanager.Fetch(refracted).GetNumberOfPoints() > 0


def test():
    PluginTesting.load_plugin()
    surfaces = [plane(5, z, 8) for z in PANE]
    sphere = simple.Sphere(Center=[0, 0, -0.6], Radius=0.3)
    refracted = check_geometry(sphere, surfaces)
    check_one_interface(sphere, surfaces[0])
    check_ball()
    check_light(surfaces)
    check_errors(surfaces)
    print("BAD LISTS")  # their errors are expected from here on
    check_bad_lists(refracted, surfaces)
    print("FINISHED")


if __name__ == "__main__":
    PluginTesting.run(test)
