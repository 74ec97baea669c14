# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every property of the representation reaches the mapper or the volume's property, and starts with
the mapper's default."""
import re

import PluginTesting
import vtkmodules.vtkRenderingVolume  # noqa: F401  the mapper's base class
from paraview import simple

# Property: its default, another value and the number of that value.
MAPPER = {
    "Backend": ("Automatic", "Processor (native)", 2),
    "BlendMode": ("Composite", "Isosurface", 5),
    "Integration": ("Exact", "Pre-integrated", 1),
    "PreIntegrationScalarSize": (256, 64, 64),
    "PreIntegrationLengthSize": (16, 8, 8),
    "OpacityModel": ("Attenuation coefficient", "Opacity per unit distance", 1),
    "Gradients": ("Per vertex (smooth)", "Per cell (flat)", 0),
    "EarlyTerminationOpacity": (1 - 1 / 131072, 0.5, 0.5),
    "AutoAdjustSampleDistances": (1, 0, 0),
    "MaximumImageSampleDistance": (8, 4, 4),
    "ImageSampleDistance": (1, 2, 2),
    "ExteriorIndexOfRefraction": (1, 1.25, 1.25),
    "InteriorIndexOfRefraction": (1.333, 1.5, 1.5),
}
VOLUME = {
    "Shade": (0, 1, 1),
    "Ambient": (0, 0.25, 0.25),
    "Diffuse": (1, 0.5, 0.5),
    "Specular": (0, 0.75, 0.75),
    "SpecularPower": (100, 20, 20),
    "ScalarOpacityUnitDistance": (None, 3, 3),
}


def number_of(thing, name):
    """A value by its getter or, where ParaView's Python does not know the class, as printed."""
    if hasattr(thing, "Get" + name):
        return float(getattr(thing, "Get" + name)())
    match = re.search(r"^ *%s: (\S+)$" % name, str(thing), re.MULTILINE)
    assert match, "%s does not print %s" % (thing.GetClassName(), name)
    return float(match.group(1))


def check(display, thing, table):
    for name, (default, other, number) in table.items():
        value = PluginTesting.value_of(display, name)
        assert default is None or value == default, "%s is %r" % (name, value)
        before = number_of(thing, name)
        if isinstance(default, (int, float)):
            assert abs(before - default) < 1e-6, "%s is %r there" % (name, before)
        setattr(display, name, other)
        after = number_of(thing, name)
        assert after == number, "%s did not arrive: %g" % (name, after)
        setattr(display, name, value)
        assert number_of(thing, name) == before, name + ", back"


def test():
    PluginTesting.load_plugin()
    grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-3, 3] * 3))
    view = PluginTesting.make_view()
    display = simple.Show(grid, view)
    display.SetRepresentationType("Volume (Exact)")
    simple.ColorBy(display, ("POINTS", "RTData"))
    simple.Render(view)
    mapper = PluginTesting.mapper_of(display)
    assert mapper.GetClassName() == "vtkTetrahedraRayCastMapper"
    volume = display.SMProxy.GetClientSideObject().GetActiveRepresentation().GetActor()

    check(display, mapper, MAPPER)
    check(display, volume.GetProperty(), VOLUME)
    display.IsosurfaceValues = [100.0, 150.0, 200.0]
    values = volume.GetProperty().GetIsoSurfaceValues()
    assert [values.GetValue(i) for i in range(values.GetNumberOfContours())] == [100, 150, 200]
    display.IsosurfaceValues = [120.0]
    assert values.GetNumberOfContours() == 1 and values.GetValue(0) == 120


if __name__ == "__main__":
    PluginTesting.run(test)
