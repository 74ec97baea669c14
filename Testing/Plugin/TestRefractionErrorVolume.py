# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The error volume of flat facets compared with a finer mesh of the same waves, measured and
drawn."""
import PluginTesting
from paraview import servermanager, simple

WAVES = "coords+kHat*0.1*sin(2*coordsX)*cos(2*coordsY)"
# Second order: a quarter of the error; a factor of 3 allows for the positions of the samples.
LEAST_GAIN = 3


def waves(resolution):
    plane = simple.Plane(Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0],
                         XResolution=resolution, YResolution=resolution)
    return simple.Calculator(Input=plane, CoordinateResults=1, Function=WAVES)


def measure(membrane, finer):
    volume = simple.RefractionErrorVolume(Membrane=membrane, FinerMembrane=finer)
    volume.EyePosition = [0.3, 0.2, 6]
    volume.MembraneModel = "Flat facets"
    volume.ModelBounds = [-1, 1, -1, 1, -2, -0.4]
    volume.SampleDimensions = [12, 12, 12]
    data = servermanager.Fetch(volume)
    assert data.GetDimensions() == (12, 12, 12)
    field = data.GetFieldData()
    measured = field.GetArray("NumberOfMeasuredSamples").GetTuple1(0)
    assert measured > 1000, "%g samples are measured" % measured
    return volume, field.GetArray("MeanError").GetTuple1(0)


def measure_cap(resolution, exact):
    """Flat facets of a spherical cap, whose points are those of the formula."""
    cap = simple.Sphere(Radius=2, EndPhi=60, PhiResolution=resolution,
                        ThetaResolution=4 * resolution)
    volume = simple.RefractionErrorVolume(Membrane=cap, EyePosition=[0.1, 0.2, 6],
                                          MembraneModel="Flat facets")
    volume.ModelBounds = [-0.5, 0.5, -0.5, 0.5, 0, 1.2]
    volume.SampleDimensions = [10, 10, 10]
    volume.ExactMembrane = exact
    if exact == "Sphere":
        volume.ExactMembrane.Radius = 2
    field = servermanager.Fetch(volume).GetFieldData()
    assert field.GetArray("NumberOfMeasuredSamples").GetTuple1(0) > 500
    return field.GetArray("MeanError").GetTuple1(0)


def check_exact():
    """The error against the formula is of second order and differs from that against the mesh's
    patches."""
    coarse, fine = measure_cap(12, "Sphere"), measure_cap(24, "Sphere")
    print("mean errors of a cap %.2e, %.2e" % (coarse, fine))
    assert 0 < fine < coarse / LEAST_GAIN
    patches = measure_cap(12, "None")
    assert patches != coarse and abs(patches - coarse) < 0.1 * coarse, patches


def test():
    PluginTesting.load_plugin()
    check_exact()
    finer = waves(200)
    coarse = measure(waves(20), finer)[1]
    volume, fine = measure(waves(40), finer)
    print("mean errors %.2e, %.2e" % (coarse, fine))
    assert 0 < fine < coarse / LEAST_GAIN
    assert volume.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")

    view = PluginTesting.make_view()
    display = simple.Show(volume, view)
    display.SetRepresentationType("Slice")
    simple.ColorBy(display, ("POINTS", "RefractionError"))
    simple.ResetCamera(view)
    drawn = PluginTesting.covered(PluginTesting.screenshot(view, "RefractionErrorVolume"))
    assert len(drawn) > 0.05 * PluginTesting.SIZE**2, "the picture is all but empty"


if __name__ == "__main__":
    PluginTesting.run(test)
