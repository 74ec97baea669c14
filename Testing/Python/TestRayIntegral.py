# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Ray integrals as arrays, with and without numpy: a block of voxels has closed forms."""
import math
import unittest

from meniscus import integrals, vtkTetrahedraRayIntegral
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import (
    vtkHyperTreeGrid, vtkImageData, vtkMolecule, vtkMultiBlockDataSet, vtkTable)
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkRenderingCore import vtkCamera

# The goal of the class, relative to the largest value.
TOLERANCE = 1e-6


def make_block():
    """Voxels over [0, 2] x [0, 1] x [0, 3] with the point array `density` = 1 + z."""
    block = vtkImageData()
    block.SetDimensions(5, 3, 7)
    block.SetSpacing(0.5, 0.5, 0.5)
    density = vtkDoubleArray()
    density.SetName("density")
    for i in range(block.GetNumberOfPoints()):
        density.InsertNextValue(1 + block.GetPoint(i)[2])
    block.GetPointData().AddArray(density)
    return block


class TestRayIntegral(unittest.TestCase):
    def setUp(self):
        self.block = make_block()

    def test_one_call(self):
        values = integrals.ray_integral(self.block, scalars="density", size=(8, 4))
        self.assertEqual(tuple(values.shape), (4, 8))
        # Seen along z: the integral of 1 + z over [0, 3].
        for row in range(4):
            for column in range(8):
                self.assertAlmostEqual(values[row, column], 7.5, delta=7.5 * TOLERANCE)

    def test_components(self):
        """A vector is measured by the component that is chosen, and by none silently."""
        vectors = vtkDoubleArray()
        vectors.SetName("vectors")
        vectors.SetNumberOfComponents(3)
        for i in range(self.block.GetNumberOfPoints()):
            vectors.InsertNextTuple3(-2.0, 0.0, 1.5)
        self.block.GetPointData().AddArray(vectors)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, self.block)
        for mesh in (self.block, blocks):
            for component, value in ((0, -2.0), (1, 0.0), (2, 1.5), ("magnitude", 2.5)):
                values = integrals.ray_integral(
                    mesh, scalars="vectors", component=component, size=(8, 4))
                self.assertAlmostEqual(values[1, 2], 3 * value, delta=7.5 * TOLERANCE)
            lengths = integrals.ray_integral(mesh, "PathLength", scalars="vectors", size=(8, 4))
            self.assertAlmostEqual(lengths[1, 2], 3, delta=3 * TOLERANCE)
            for component in (None, 3, "length"):
                with self.assertRaisesRegex(ValueError, 'component=0, 1, 2 or "magnitude"'):
                    integrals.ray_integral(mesh, scalars="vectors", component=component)
        # Another block with a number in place of the vector, before or behind it.
        numbers = make_block()
        numbers.GetPointData().GetArray("density").SetName("vectors")
        for number in range(2):
            blocks.SetBlock(number, numbers)
            blocks.SetBlock(1 - number, self.block)
            for component in (None, 2):
                with self.assertRaisesRegex(ValueError, "component"):
                    integrals.ray_integral(blocks, scalars="vectors", component=component)
        values = integrals.ray_integral(
            self.block, scalars="vectors", ArrayComponent=2, size=(8, 4))
        self.assertAlmostEqual(values[1, 2], 4.5, delta=4.5 * TOLERANCE)

    def test_data_that_are_no_mesh(self):
        for data in (vtkTable(), vtkMolecule(), vtkHyperTreeGrid()):
            with self.assertRaisesRegex(TypeError, "must be a dataset, not " + type(data).__name__):
                integrals.ray_integral(data)
        # A filter may yield anything: the pipeline says so.
        source = vtkTrivialProducer()
        source.SetOutput(vtkTable())
        with self.assertRaisesRegex(ValueError, "is of type vtkTable"):
            integrals.ray_integral(source)

    def test_a_file_that_is_absent(self):
        reader = vtkXMLImageDataReader()
        reader.SetFileName("absent.vti")
        reader.AddObserver("ErrorEvent", lambda *_: None)
        reader.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
        with self.assertRaisesRegex(ValueError, "the filter that makes it has failed"):
            integrals.ray_integral(reader)

    def test_bins(self):
        for bins in (3, "ab", [(1, 2, 3, 4)], ["x"], [None]):
            with self.assertRaisesRegex(TypeError, "^bins must be a list"):
                integrals.ray_integral(self.block, "EnergyBins", scalars="density", bins=bins)

    def test_surfaces(self):
        """The error about a mesh without volume says of which types its cells are."""
        sphere = vtkSphereSource()
        sphere.Update()
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, sphere.GetOutput())
        for mesh in (sphere.GetOutput(), blocks):
            with self.assertRaisesRegex(ValueError, r"96 vtkTriangle \(without a volume\)"):
                integrals.ray_integral(mesh, "PathLength")

    def test_without_numpy(self):
        numpy, integrals.numpy = integrals.numpy, None
        try:
            values = integrals.ray_integral(self.block, scalars="density", size=(8, 4))
        finally:
            integrals.numpy = numpy
        self.assertIsInstance(values, memoryview)
        self.assertEqual((values.format, values.shape), ("f", (4, 8)))
        self.assertAlmostEqual(values[3, 7], 7.5, delta=7.5 * TOLERANCE)

    def test_several_arrays(self):
        found = integrals.ray_integral(
            self.block, ["PathLength", "EnergyBins", "MaximumDepth"], scalars="density",
            size=(8, 4), bins=[0.1, (0.2, 0.5, 3.0)])
        self.assertEqual(sorted(found), ["EnergyBins", "MaximumDepth", "PathLength"])
        self.assertEqual(tuple(found["EnergyBins"].shape), (4, 8, 2))
        self.assertAlmostEqual(found["PathLength"][1, 2], 3, delta=3 * TOLERANCE)
        # The rectangle touches the box at z = 3, where the density is largest.
        self.assertAlmostEqual(found["MaximumDepth"][1, 2], 0, delta=3 * TOLERANCE)
        self.assertAlmostEqual(found["EnergyBins"][1, 2, 0], math.exp(-0.75), delta=TOLERANCE)
        expected = 3 * math.exp(-1.5) + 0.5 / 0.2 * (1 - math.exp(-1.5))
        self.assertAlmostEqual(found["EnergyBins"][1, 2, 1], expected, delta=3 * TOLERANCE)

    def test_camera(self):
        camera = vtkCamera()
        camera.SetPosition(1, 0.5, 13)
        camera.SetFocalPoint(1, 0.5, 0)
        depths = integrals.ray_integral(
            self.block, "FirstDepth", scalars="density", size=(3, 3), camera=camera)
        self.assertAlmostEqual(depths[1, 1], 10, delta=10 * TOLERANCE)
        self.assertTrue(math.isnan(depths[0, 0]))

    def test_properties(self):
        values = integrals.ray_integral(
            self.block, "PathLength", scalars="density", size=(6, 2), Direction=(0, -1, 0),
            ViewUp=(1, 0, 0))
        self.assertAlmostEqual(values[0, 3], 1, delta=TOLERANCE)

    def test_errors(self):
        with self.assertRaisesRegex(ValueError, "no scalar array named 'missing'"):
            integrals.ray_integral(self.block, scalars="missing")
        with self.assertRaisesRegex(ValueError, "no array 'Sum'"):
            integrals.ray_integral(self.block, "Sum", scalars="density")
        with self.assertRaisesRegex(ValueError, "at least 1 by 1"):
            integrals.ray_integral(self.block, scalars="density", size=(0, 3))
        with self.assertRaisesRegex(AttributeError, "no property 'Directions'.* Direction, "):
            integrals.ray_integral(self.block, scalars="density", Directions=(0, -1, 0))

    def test_class(self):
        rays = vtkTetrahedraRayIntegral()
        rays.SetInputData(self.block)
        rays.SetInputArrayToProcess(0, 0, 0, 0, "density")
        rays.SetImageSize(4, 4)
        rays.Update()
        rays.SetDirection(0.1, 0.2, -1)
        rays.Update()
        self.assertEqual(rays.GetStatistic("NumberOfMeshBuilds"), 1)
        self.assertEqual(rays.GetStatistic("NumberOfCasts"), 2)


if __name__ == "__main__":
    unittest.main()
