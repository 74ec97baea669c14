# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every public name exists in Python, setters and getters agree, counters begin at 0."""
import math
import unittest

from meniscus import (
    vtkMembraneCellFilter, vtkRefractedGeometryFilter, vtkRefractedLightFilter,
    vtkRefractionErrorVolume, vtkRefractionPass, vtkTetrahedraRayCastMapper,
    vtkTetrahedraRayIntegral)
from vtkmodules.vtkCommonDataModel import vtkSphere
from vtkmodules.vtkRenderingCore import vtkCamera


class PropertyTest(unittest.TestCase):
    def check_pair(self, thing, name, values):
        for value in values:
            getattr(thing, "Set" + name)(value)
            self.assertEqual(getattr(thing, "Get" + name)(), value, name)

    def check_mode(self, thing, name, constants, default):
        self.assertEqual(getattr(thing, "Get" + name)(), getattr(thing, default), name)
        values = [getattr(thing, constant) for constant in constants]
        self.assertEqual(len(set(values)), len(values), name)
        self.check_pair(thing, name, values)

    def check_counters(self, thing, names):
        for name in names:
            self.assertEqual(getattr(thing, "Get" + name)(), 0, name)

    def check_statistics(self, thing, names):
        """Each name is in the table once, with a meaning and the value that it has by name; getters
        of the same name agree; unknown names are errors."""
        table = thing.GetStatistics()
        self.assertEqual([table.GetColumnName(i) for i in range(table.GetNumberOfColumns())],
                         ["Name", "Meaning", "Value"])
        listed = {}
        for row in range(table.GetNumberOfRows()):
            name, meaning, value = (table.GetValue(row, column) for column in range(3))
            self.assertNotIn(name.ToString(), listed)
            self.assertGreater(len(meaning.ToString()), 10)
            listed[name.ToString()] = value.ToDouble()
            self.assertEqual(thing.GetStatistic(name.ToString()), value.ToDouble())
            if hasattr(thing, "Get" + name.ToString()):
                self.assertEqual(getattr(thing, "Get" + name.ToString())(), value.ToDouble())
            self.assertIn(name.ToString() + ": ", str(thing))
        for name in names:
            self.assertEqual(listed[name], 0, name)
        told = []
        thing.AddObserver("ErrorEvent", lambda *_: told.append(1))
        self.assertTrue(math.isnan(thing.GetStatistic("NumberOfElephants")))
        self.assertTrue(math.isnan(thing.GetStatistic(None)))
        self.assertEqual(len(told), 2)

    def check_choices(self, thing, choices):
        """Every value of an enumeration has a method that sets it."""
        for name, values in choices.items():
            for setting, constant in values.items():
                getattr(thing, "Set%sTo%s" % (name, setting))()
                self.assertEqual(
                    getattr(thing, "Get" + name)(), getattr(thing, constant), (name, setting))


class TestMapper(PropertyTest):
    def setUp(self):
        self.mapper = vtkTetrahedraRayCastMapper()

    def test_modes(self):
        models = ["ATTENUATION_COEFFICIENT", "OPACITY_PER_UNIT_DISTANCE"]
        self.check_mode(self.mapper, "OpacityModel", models, "ATTENUATION_COEFFICIENT")
        self.check_mode(self.mapper, "Backend", ["AUTOMATIC", "OPENGL", "NATIVE"], "AUTOMATIC")
        self.check_mode(self.mapper, "Integration", ["EXACT", "PRE_INTEGRATED"], "EXACT")
        self.check_pair(self.mapper, "BlendMode", range(6))
        self.mapper.GetActiveBackend()

    def test_pre_integration(self):
        self.check_pair(self.mapper, "PreIntegrationScalarSize", [2, 100, 1024])
        self.check_pair(self.mapper, "PreIntegrationLengthSize", [1, 16, 128])

    def test_early_termination(self):
        self.check_pair(self.mapper, "EarlyTerminationOpacity", [0.5, 1.0])

    def test_counters(self):
        self.check_counters(self.mapper, [
            "NumberOfMeshBuilds", "NumberOfScalarUpdates", "NumberOfTransferFunctionBuilds",
            "NumberOfActiveSetBuilds", "UploadedBytes", "NumberOfActiveCells",
            "NumberOfTraversalSteps", "NumberOfRays", "NumberOfLostRays", "NumberOfRejectedCells"])
        self.check_statistics(self.mapper, [
            "NumberOfPointUpdates", "NumberOfUndecidedRays", "NumberOfPreIntegrationBuilds"])

    def test_choices(self):
        self.check_choices(self.mapper, {
            "VectorMode": {"Disabled": "DISABLED", "Magnitude": "MAGNITUDE",
                           "Component": "COMPONENT"},
            "CellDivision": {"Fixed": "FIXED_DIVISION", "Adaptive": "ADAPTIVE_DIVISION"},
            "OpacityModel": {"AttenuationCoefficient": "ATTENUATION_COEFFICIENT",
                             "OpacityPerUnitDistance": "OPACITY_PER_UNIT_DISTANCE"},
            "Backend": {"Automatic": "AUTOMATIC", "OpenGL": "OPENGL", "Native": "NATIVE",
                        "Compute": "COMPUTE"},
            "Integration": {"Exact": "EXACT", "PreIntegrated": "PRE_INTEGRATED"},
            "Gradients": {"CellGradients": "CELL_GRADIENTS",
                          "VertexGradients": "VERTEX_GRADIENTS"},
            "DepthWriting": {"NoDepth": "NO_DEPTH", "FirstVisibleDepth": "FIRST_VISIBLE_DEPTH",
                             "OpacityDepth": "OPACITY_DEPTH"},
            "MediumModel": {"Exponential": "EXPONENTIAL", "Linear": "LINEAR"}})

    def test_limits(self):
        """A number beyond its limits becomes the nearest limit."""
        for name, low, high in (("ColorBias", 0, 0.5), ("Backend", 0, 3), ("DepthWriting", -1, 1),
                                ("PreIntegrationScalarSize", 2, 1024)):
            for value, kept in ((low - 1, low), (high + 1, high)):
                getattr(self.mapper, "Set" + name)(value)
                self.assertEqual(getattr(self.mapper, "Get" + name)(), kept, name)

    def test_prints_itself(self):
        self.assertIn("Integration", str(self.mapper))


class TestFilter(PropertyTest):
    def setUp(self):
        self.filter = vtkRefractedGeometryFilter()

    def test_eye(self):
        self.filter.SetEyePosition(1, 2, 3)
        self.assertEqual(self.filter.GetEyePosition(), (1, 2, 3))
        camera = vtkCamera()
        self.filter.SetCamera(camera)
        self.assertIs(self.filter.GetCamera(), camera)
        before = self.filter.GetMTime()
        camera.SetPosition(4, 5, 6)
        self.assertGreater(self.filter.GetMTime(), before)
        self.filter.SetCamera(None)

    def test_indices(self):
        self.assertEqual(self.filter.GetExteriorIndexOfRefraction(), 1.0)
        self.assertEqual(self.filter.GetInteriorIndexOfRefraction(), 1.333)
        self.check_pair(self.filter, "ExteriorIndexOfRefraction", [1.333])
        self.check_pair(self.filter, "InteriorIndexOfRefraction", [1.0])

    def test_modes(self):
        self.check_mode(self.filter, "MembraneModel", ["FLAT_FACETS", "CURVED"], "CURVED")
        self.check_mode(self.filter, "Images", ["FIRST_IMAGE", "ALL_IMAGES"], "ALL_IMAGES")
        self.check_mode(self.filter, "ReflectanceModel", ["FRESNEL", "SCHLICK"], "FRESNEL")

    def test_view(self):
        self.assertTrue(self.filter.GetViewCulling())
        self.filter.ViewCullingOff()
        self.assertFalse(self.filter.GetViewCulling())
        self.assertEqual(self.filter.GetViewAspectRatio(), 0)
        self.check_pair(self.filter, "ViewAspectRatio", [1.5])

    def test_normals(self):
        self.assertFalse(self.filter.GetVirtualNormals())
        self.filter.VirtualNormalsOn()
        self.assertTrue(self.filter.GetVirtualNormals())
        self.assertEqual(self.filter.GetLightDirection(), (0, 0, 0))
        self.check_pair(self.filter, "LightDirection", [(1, 2, 3)])

    def test_counters(self):
        self.check_counters(self.filter, [
            "NumberOfPatchBuilds", "NumberOfEyeUpdates", "NumberOfSolvedVertices",
            "NumberOfFailedSolves"])
        self.check_statistics(self.filter, [
            "NumberOfUndecidedSearches", "NumberOfCulledVertices", "NumberOfCulledCells"])

    def test_choices(self):
        self.check_choices(self.filter, {
            "Mode": {"Refraction": "REFRACTION", "Reflection": "REFLECTION"},
            "MembraneModel": {"FlatFacets": "FLAT_FACETS", "Curved": "CURVED"},
            "Images": {"FirstImage": "FIRST_IMAGE", "AllImages": "ALL_IMAGES"},
            "ReflectanceModel": {"Fresnel": "FRESNEL", "Schlick": "SCHLICK"}})


class TestRayIntegral(PropertyTest):
    def setUp(self):
        self.rays = vtkTetrahedraRayIntegral()

    def test_statistics(self):
        self.check_statistics(self.rays, ["NumberOfCasts", "NumberOfLostRays", "NumberOfRays"])

    def test_choices(self):
        self.check_choices(self.rays, {
            "FrameMode": {"Fitted": "FITTED", "Parallel": "PARALLEL", "Camera": "CAMERA"},
            "CellDivision": {"Fixed": "FIXED_DIVISION", "Adaptive": "ADAPTIVE_DIVISION"},
            "OpacityModel": {"AttenuationCoefficient": "ATTENUATION_COEFFICIENT",
                             "OpacityPerUnitDistance": "OPACITY_PER_UNIT_DISTANCE"}})

    def test_arrays(self):
        """The integral is on and the others are off; a change modifies the filter."""
        arrays = self.rays.GetArraySelection()
        enabled = [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())
                   if arrays.GetArraySetting(i)]
        self.assertEqual(enabled, ["Integral"])
        before = self.rays.GetMTime()
        arrays.EnableArray("MaximumDepth")
        self.assertGreater(self.rays.GetMTime(), before)


class TestPass(PropertyTest):
    def test_choices(self):
        self.check_choices(vtkRefractionPass(), {
            "ReflectanceModel": {"Fresnel": "FRESNEL", "Schlick": "SCHLICK", "None": "NONE",
                                 "Mirror": "MIRROR"},
            "MediumModel": {"Exponential": "EXPONENTIAL", "Linear": "LINEAR"},
            "Lighting": {"VirtualSpace": "VIRTUAL_SPACE", "TrueSpace": "TRUE_SPACE"}})


class TestRefractedLight(PropertyTest):
    def test_properties(self):
        light = vtkRefractedLightFilter()
        self.check_pair(light, "LightPosition", [(1, 2, 3)])
        self.check_pair(light, "ExteriorIndexOfRefraction", [1.333])
        self.check_pair(light, "InteriorIndexOfRefraction", [1.0])
        self.assertFalse(light.GetPositional())
        light.PositionalOn()
        self.assertTrue(light.GetPositional())
        self.assertFalse(light.GetOneSided())
        light.OneSidedOn()
        self.assertTrue(light.GetOneSided())


class TestErrorVolume(PropertyTest):
    def setUp(self):
        self.volume = vtkRefractionErrorVolume()

    def test_properties(self):
        self.check_mode(self.volume, "MembraneModel", ["FLAT_FACETS", "CURVED"], "CURVED")
        self.check_pair(self.volume, "EyePosition", [(1, 2, 3)])
        self.check_pair(self.volume, "ExteriorIndexOfRefraction", [1.333])
        self.check_pair(self.volume, "InteriorIndexOfRefraction", [1.0])
        self.check_pair(self.volume, "ModelBounds", [(1, 2, 3, 4, 5, 6)])
        self.check_pair(self.volume, "SampleDimensions", [(7, 8, 9)])
        self.check_pair(self.volume, "ColorLimits", [(0.1, 0.2, 0.3)])
        self.assertFalse(self.volume.GetAngularErrors())
        self.volume.AngularErrorsOn()
        self.assertTrue(self.volume.GetAngularErrors())

    def test_exact_membrane(self):
        sphere = vtkSphere()
        self.volume.SetExactMembrane(sphere)
        self.assertIs(self.volume.GetExactMembrane(), sphere)
        before = self.volume.GetMTime()
        sphere.SetRadius(7)
        self.assertGreater(self.volume.GetMTime(), before)

    def test_counters(self):
        self.check_counters(self.volume, [
            "NumberOfPatchBuilds", "NumberOfEyeUpdates", "NumberOfMeasuredSamples", "MeanError",
            "StandardDeviation", "LargestError"])


class TestMembraneCells(PropertyTest):
    def test_properties(self):
        cells = vtkMembraneCellFilter()
        self.check_pair(cells, "EyePosition", [(1, 2, 3)])
        self.check_pair(cells, "ExteriorIndexOfRefraction", [1.333])
        self.check_pair(cells, "InteriorIndexOfRefraction", [1.0])
        self.check_pair(cells, "CellLength", [2.5])
        self.check_counters(cells, [
            "NumberOfBackFacingFacets", "NumberOfTotallyReflectedFacets", "NumberOfMissedFacets"])


if __name__ == "__main__":
    unittest.main()
