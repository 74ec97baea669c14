# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads and offers the filter in the menu."""
import PluginTesting
from paraview import simple

PROPERTIES = {
    "ExteriorIndexOfRefraction": 1.0,
    "InteriorIndexOfRefraction": 1.333,
    "MembraneModel": "Curved",
    "Images": "All images",
    "AngularTolerance": 0.005,
    "ViewCulling": 0,
    "ViewAngle": 30,
    "ViewAspectRatio": 0,
    "ReflectanceModel": "Fresnel",
    "VirtualNormals": 0,
    "OutputPointsPrecision": "Same as the geometry",
}


def check_plugin():
    filter_proxy = simple.RefractedGeometry(Geometry=simple.Sphere(), Membrane=simple.Plane())
    assert filter_proxy.ExactMembrane.GetXMLName() == "None"
    for name, default in PROPERTIES.items():
        value = getattr(filter_proxy, name)
        assert value == default, "%s is %r, not %r" % (name, value, default)
    assert filter_proxy.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")


def test():
    PluginTesting.load_plugin()
    check_plugin()


if __name__ == "__main__":
    PluginTesting.run(test)
