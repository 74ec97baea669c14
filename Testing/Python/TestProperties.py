# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every public name exists in Python, setters and getters agree, counters begin at 0."""
import unittest

from meniscus import (
    vtkMembraneCellFilter, vtkRefractedGeometryFilter, vtkRefractedLightFilter,
    vtkRefractionErrorVolume, vtkTetrahedraRayCastMapper)
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
            "NumberOfMeshBuilds", "NumberOfPointUpdates", "NumberOfScalarUpdates",
            "NumberOfTransferFunctionBuilds",
            "NumberOfActiveSetBuilds", "UploadedBytes", "NumberOfActiveCells",
            "NumberOfTraversalSteps", "NumberOfRays", "NumberOfLostRays",
            "NumberOfUndecidedRays",
            "NumberOfRejectedCells", "NumberOfPreIntegrationBuilds"])

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
            "NumberOfFailedSolves", "NumberOfUndecidedSearches",
            "NumberOfCulledVertices", "NumberOfCulledCells"])


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
