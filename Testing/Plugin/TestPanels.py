# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The panel of Volume (Exact): groups, labels, what is shown by default, the unit distance; its
colours when it is chosen, as for ParaView's own Volume; its older name."""
import PluginTesting
from PluginTesting import value_of
from paraview import simple

EXACT, OLDER = "Volume (Exact)", "Tetrahedra Ray Cast"
SHOWN = ["BlendMode", "IsosurfaceValues", "Shade", "GlobalIlluminationReach", "CellDivision"]
REFRACTING = {
    "Membrane": "Refracting Surface",
    "ExteriorIndexOfRefraction": "Index of Refraction, Side of Normals",
    "InteriorIndexOfRefraction": "Index of Refraction, Other Side",
    "MediumModel": "Medium Behind the Surface",
    "MediumAttenuationCoefficients": "Attenuation of the Medium",
    "MediumRange": "Range of the Medium",
    "MediumColor": "Color of the Medium",
    "SecondMembrane": "Second Refracting Surface",
    "ThirdMembrane": "Third Refracting Surface",
    "Interfaces": "Interfaces",
}


def properties_of(group):
    return [group.GetProperty(i) for i in range(group.GetNumberOfProperties())]


def last_group(proxy, name):
    """The group of properties in which ParaView's panel shows a property: the last that names
    it."""
    groups = [proxy.GetPropertyGroup(i) for i in range(proxy.GetNumberOfPropertyGroups())]
    return [group for group in groups if proxy.GetProperty(name) in properties_of(group)][-1]


def values_of(element, inverse):
    """Values that the decorators of an XML element compare with, to show or to hide it."""
    found = set()
    if (element.GetAttribute("inverse") == "1") == inverse:
        found.add(element.GetAttribute("value"))
    for i in range(element.GetNumberOfNestedElements()):
        found |= values_of(element.GetNestedElement(i), inverse)
    return found


def check_groups(display):
    proxy = display.SMProxy
    available = display.GetProperty("Representation").Available
    assert EXACT in available and OLDER not in available, available
    for name, hides in [("ScalarOpacityUnitDistance", False), ("OpacityArrayName", False),
                        ("BlendMode", False), ("Membrane", False), ("Opacity", True),
                        ("LineWidth", True)]:
        told = values_of(last_group(proxy, name).GetHints(), hides)
        assert EXACT in told, "%s is told of %s" % (name, told)

    own = properties_of(last_group(proxy, "BlendMode"))
    shown = [proxy.GetProperty(name) for name in SHOWN]
    assert [one for one in own if one.GetPanelVisibility() == "default"] == shown
    group = last_group(proxy, "Membrane")
    assert group.GetXMLLabel() == "Refracting Surfaces"
    assert properties_of(group) == [proxy.GetProperty(name) for name in REFRACTING]
    # Advanced, or shown only together with a surface.
    assert display.Membrane is None
    for name, label in REFRACTING.items():
        one = proxy.GetProperty(name)
        assert one.GetXMLLabel() == label, one.GetXMLLabel()
        waits = one.GetHints() and "null" in values_of(one.GetHints(), True)
        assert waits or one.GetPanelVisibility() == "advanced", name
    for one in own + properties_of(group):
        text = one.GetDocumentation().GetDescription()
        assert text and "membrane" not in (one.GetXMLLabel() + text).lower(), text


def colors_of(display):
    """What a user sees of the colours: array, functions and whether there is a legend."""
    view = simple.GetActiveView()
    table, opacity = display.LookupTable, display.ScalarOpacityFunction
    return (value_of(display, "ColorArrayName"), table and list(table.RGBPoints),
            opacity and list(opacity.Points),
            bool(table) and display.SMProxy.IsScalarBarVisible(view.SMProxy))


def make_grid(name="RTData", cells=False):
    """A mesh with one array, of points or of cells."""
    named = simple.Calculator(Input=simple.Wavelet(WholeExtent=[-2, 2] * 3), Function="RTData",
                              ResultArrayName=name)
    one = simple.PassArrays(Input=named, PointDataArrays=[name])
    grid = simple.Tetrahedralize(Input=one)
    return simple.PointDatatoCellData(Input=grid) if cells else grid


def check_colors_of(view, cells):
    """Chooses Volume, then Volume (Exact), each for a mesh without colours."""
    seen = []
    for number, representation in enumerate(["Volume", EXACT] + ([] if cells else [OLDER])):
        array = "%s%d" % ("Cells" if cells else "Points", number)
        display = simple.Show(make_grid(array, cells), view)
        simple.ColorBy(display, None)
        assert display.SetRepresentationType(representation)
        assert display.Representation == (EXACT if number else "Volume")
        chosen, *functions = colors_of(display)
        assert chosen[1] == array, chosen
        seen.append((chosen[0], functions))
        simple.Hide(display.Input, view)
    assert seen.count(seen[0]) == len(seen), seen


def check_colors(view):
    check_colors_of(view, False)
    check_colors_of(view, True)
    # Colours that are there stay.
    two = simple.Calculator(Input=make_grid(), ResultArrayName="Other", Function="2*RTData")
    display = simple.Show(two, view)
    simple.ColorBy(display, ("POINTS", "Other"))
    table = display.LookupTable
    table.RescaleTransferFunction(1, 2)
    display.SetRepresentationType(EXACT)
    assert value_of(display, "ColorArrayName") == ["POINTS", "Other"]
    assert list(table.RGBPoints)[0] == 1 and list(table.RGBPoints)[-4] == 2
    # A mesh without arrays: nothing to colour by.
    bare = simple.PassArrays(Input=make_grid(), PointDataArrays=[], CellDataArrays=[])
    display = simple.Show(bare, view)
    assert display.SetRepresentationType(EXACT) and display.Representation == EXACT
    assert value_of(display, "ColorArrayName")[1] in ("", None)


def check_older_name(display):
    display.Representation = "Surface"
    display.Representation = OLDER
    assert display.Representation == EXACT
    # Other representations are those of ParaView.
    surface = simple.Show(simple.Sphere(), simple.GetActiveView())
    assert surface.SMProxy.IsA("vtkSMPVRepresentationProxy")
    assert not surface.SetRepresentationType(EXACT)


def check_unit_distance(display):
    """A mesh of a thousand times the size has a thousand times the unit distance."""
    large = simple.Transform(Input=simple.GetActiveSource())
    large.Transform.Scale = [1000] * 3
    unit = simple.Show(large, simple.GetActiveView()).ScalarOpacityUnitDistance
    assert abs(unit / display.ScalarOpacityUnitDistance - 1000) < 1e-6, unit


def test():
    PluginTesting.load_plugin()
    view = PluginTesting.make_view()
    grid = make_grid()
    display = simple.Show(grid, view)
    check_groups(display)
    check_unit_distance(display)
    check_older_name(display)
    check_colors(view)


if __name__ == "__main__":
    PluginTesting.run(test)
