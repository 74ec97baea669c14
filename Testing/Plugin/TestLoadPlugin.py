# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loads and offers the filter in the menu and the representation."""
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


def last_group(proxy, name):
    """The group of properties in which ParaView's panel shows a property: the last that names
    it."""
    groups = [proxy.GetPropertyGroup(i) for i in range(proxy.GetNumberOfPropertyGroups())]
    return [group for group in groups
            if proxy.GetProperty(name) in map(
                group.GetProperty, range(group.GetNumberOfProperties()))
            ][-1]


def values_of(element, inverse):
    """Values that the decorators of an XML element compare with, to show or to hide it."""
    found = set()
    if (element.GetAttribute("inverse") == "1") == inverse:
        found.add(element.GetAttribute("value"))
    for i in range(element.GetNumberOfNestedElements()):
        found |= values_of(element.GetNestedElement(i), inverse)
    return found


def check_plugin():
    filter_proxy = simple.RefractedGeometry(Geometry=simple.Sphere(), Membrane=simple.Plane())
    assert filter_proxy.ExactMembrane.GetXMLName() == "None"
    for name, default in PROPERTIES.items():
        value = getattr(filter_proxy, name)
        assert value == default, "%s is %r, not %r" % (name, value, default)
    assert filter_proxy.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")

    grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-2, 2] * 3))
    display = simple.Show(grid, PluginTesting.make_view())
    available = display.GetProperty("Representation").Available
    assert "Tetrahedra Ray Cast" in available, available
    assert display.Membrane is None
    for name, hides in [("ScalarOpacityUnitDistance", False), ("OpacityArrayName", False),
                        ("BlendMode", False), ("Opacity", True), ("LineWidth", True)]:
        told = values_of(last_group(display.SMProxy, name).GetHints(), hides)
        assert "Tetrahedra Ray Cast" in told, "%s is told of %s" % (name, told)


def test():
    PluginTesting.load_plugin()
    check_plugin()


if __name__ == "__main__":
    PluginTesting.run(test)
