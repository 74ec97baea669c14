# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""All filters are in the menu, with the defaults of the library and texts that make sense without
the pages."""
import PluginTesting
from paraview import servermanager, simple

# The properties of filters with refracting surfaces.
SURFACES = {"ExteriorIndexOfRefraction": 1.0, "InteriorIndexOfRefraction": 1.333, "Interfaces": []}
# The properties of media that bend light.
MEDIUM = {"Quantity": "Density", "GladstoneDale": 2.26157e-4, "OutsideIndex": 0}
FILTERS = {
    "ApparentGeometry": {**MEDIUM, "FollowCamera": 0, "SearchAngle": 2, "SearchResolution": 64},
    "DepthImagePoints": {"DepthType": "Depth buffer", "ViewAngle": 30,
                         "ViewClippingRange": [0.01, 1000.01]},
    "MembraneCells": {**SURFACES, "CellLength": 1, "FollowCamera": 0},
    "RefractedGeometry": {
        **SURFACES, "MembraneModel": "Curved", "Images": "All images", "AngularTolerance": 0.005,
        "CloseSeams": 1, "TrueGeometry": 0, "ViewCulling": 0, "ViewAngle": 30,
        "ViewAspectRatio": 0, "ReflectanceModel": "Fresnel", "VirtualNormals": 0,
        "OutputPointsPrecision": "Same as the geometry", "FollowCamera": 1},
    "RefractedLight": {**SURFACES, "Positional": 0, "OneSided": 0},
    "RefractionErrorVolume": {**SURFACES, "MembraneModel": "Curved", "AngularErrors": 0},
    "SightRays": {**SURFACES, "EyeArrayName": "", "FollowCamera": 0},
    "TetrahedraMirage": {
        **MEDIUM, "BendRays": 1, "FollowCamera": 0, "ViewAngle": 30, "ImageSize": [256, 256],
        "LightDirection": [0, 0, 0], "Ambient": 0.3, "BackgroundColor": [0, 0, 0]},
    "TetrahedraRayIntegral": {
        **SURFACES, "FrameMode": "Fitted", "ComputeIntegral": 1, "ComputePathLength": 0,
        "ArrayComponent": 0, "CellDivision": "Fixed", "ImageSize": [256, 256],
        "AttenuationArrayName": "", "EmissionArrayName": ""},
    "TetrahedraSchlieren": {
        **MEDIUM, "BendRays": 1, "ReferenceIndex": 1, "Direction": [0, 0, -1], "ViewUp": [0, 1, 0],
        "ImageSize": [256, 256],
        "KnifeAngle": 90, "KnifeCutOff": 0.5, "KnifeRange": 0, "ScreenDistance": 1,
        "Wavelength": 589.3e-9, "Fringes": [0, 0], "BackgroundDistance": 1},
    "TetrahedralizeSurface": {"Mesher": "Automatic", "MaximumRadiusEdgeRatio": 2,
                              "MaximumVolume": 0, "PreserveSurface": 0, "MesherProgram": "",
                              "TimeLimit": 300},
    "ImaginaryCells": {"MesherProgram": "", "TimeLimit": 300},
    "TriangulatedPosition": {**SURFACES, "EyeArrayName": "Eye", "PointIdArrayName": "PointId"},
    "TruePosition": {**SURFACES, "Depth": "Apparent", "EyeArrayName": "", "FollowCamera": 0},
}


def check_texts(one):
    proxy = one.SMProxy
    text = proxy.GetDocumentation()
    assert "membrane" not in text.GetDescription() and text.GetShortHelp(), proxy.GetXMLName()
    for i in range(proxy.GetNumberOfPropertyGroups()):
        assert "Membrane" not in (proxy.GetPropertyGroup(i).GetXMLLabel() or "")
    for key in one.ListProperties():
        told = one.GetProperty(key).SMProperty
        if told.GetPanelVisibility() != "never" and not told.GetInformationOnly():
            text = told.GetDocumentation().GetDescription()
            assert text and "membrane" not in text, (proxy.GetXMLName(), key, text)


def test():
    PluginTesting.load_plugin()
    for name, defaults in FILTERS.items():
        assert hasattr(simple, name), name
        one = getattr(servermanager.filters, name)()  # without a pipeline
        assert one.SMProxy.GetHints().FindNestedElementByName("ShowInMenu"), name
        check_texts(one)
        for key, default in defaults.items():
            value = PluginTesting.value_of(one, key)
            value = list(value) if isinstance(default, list) else value
            assert value == default, "%s.%s is %r, not %r" % (name, key, value, default)


if __name__ == "__main__":
    PluginTesting.run(test)
