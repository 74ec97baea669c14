// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/ClosedSurface.h"
#include "Surface/HarmonicField.h"
#include "Surface/MeshingFiles.h"
#include "Surface/SolidCells.h"
#include "Surface/TetrahedronShape.h"
#include "TestBasics.h"

#include <filesystem>

using namespace meniscus;

namespace
{

/** The tetrahedron of the origin and the three unit vectors; a sixth is its volume. */
TriangleSurface MakeCorner()
{
  TriangleSurface surface;
  surface.Points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  surface.Triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  return surface;
}

/** A file of this test, which is removed with the object. */
struct TestFile
{
  std::string Name = (std::filesystem::temp_directory_path() /
    ("meniscus-" + std::to_string(std::hash<const void*>()(this)) + "-files"))
                       .string();
  ~TestFile() { std::filesystem::remove(this->Name); }
};

} // anonymous namespace

//------------------------------------------------------------------------------
TEST(ClosedSurface, WindsOnceAroundItsInside)
{
  TriangleSurface surface = MakeCorner();
  EXPECT_EQ(FindSurfaceFault(surface).Fault, SurfaceFault::None);
  EXPECT_DOUBLE_EQ(ComputeEnclosedVolume(surface), 1.0 / 6.0);
  EXPECT_EQ(ComputeWindingNumber(surface, { 0.1, 0.1, 0.1 }), 1);
  EXPECT_EQ(ComputeWindingNumber(surface, { 1e-9, 1e-9, 1e-9 }), 1);
  EXPECT_EQ(ComputeWindingNumber(surface, { -1e-9, 1e-9, 1e-9 }), 0);
  EXPECT_EQ(ComputeWindingNumber(surface, { 5.0, 0.0, 0.0 }), 0);
  for (Triangle& triangle : surface.Triangles)
  {
    std::swap(triangle[0], triangle[1]);
  }
  EXPECT_EQ(ComputeWindingNumber(surface, { 0.1, 0.1, 0.1 }), -1);
  EXPECT_EQ(FindSurfaceFault(surface).Fault, SurfaceFault::InsideOut);
}

//------------------------------------------------------------------------------
// A place far from the origin costs no digits of the volume.
TEST(ClosedSurface, VolumeDoesNotDependOnThePlace)
{
  TriangleSurface surface = MakeCorner();
  for (glm::dvec3& point : surface.Points)
  {
    point += glm::dvec3(1048576.0, -2097152.0, 4194304.0);
  }
  EXPECT_DOUBLE_EQ(ComputeEnclosedVolume(surface), 1.0 / 6.0);
}

//------------------------------------------------------------------------------
TEST(ClosedSurface, JoinsPointsOfEqualCoordinates)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<glm::dvec3> points = { { 9, 9, 9 }, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 },
    { -0.0, 0, 0 }, { nan, 0, 0 }, { nan, 0, 0 } };
  const TriangleSurface surface =
    JoinCoincidentPoints(points, { { 1, 2, 3 }, { 3, 2, 4 }, { 1, 4, 2 }, { 5, 6, 1 } });
  // The unused point is gone; zeros of either sign are one; points that are not finite are apart.
  EXPECT_EQ(surface.Sources, (std::vector<std::size_t>{ 1, 2, 3, 5, 6 }));
  EXPECT_EQ(surface.Triangles, (std::vector<Triangle>{ { 0, 1, 2 }, { 2, 1, 0 }, { 3, 4, 0 } }));
}

//------------------------------------------------------------------------------
TEST(TetrahedronShape, HasKnownRatios)
{
  const glm::dvec3 a(1, 1, 1);
  const glm::dvec3 b(1, -1, -1);
  const glm::dvec3 c(-1, 1, -1);
  const glm::dvec3 d(-1, -1, 1);
  EXPECT_NEAR(RadiusEdgeRatio(a, b, c, d), std::sqrt(6.0) / 4.0, 1e-15);
  EXPECT_FALSE(IsFlat(a, b, c, d));
  // Half the diagonal of a cube over its edge.
  EXPECT_NEAR(RadiusEdgeRatio({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }),
    0.5 * std::sqrt(3.0), 1e-15);
  EXPECT_TRUE(IsFlat({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0.3, 0.3, 0 }));
  EXPECT_TRUE(std::isinf(RadiusEdgeRatio({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 })));
}

//------------------------------------------------------------------------------
// Four cells around an inner point: a linear field is continued exactly.
TEST(HarmonicField, ContinuesLinearFields)
{
  TetrahedronCells cells;
  cells.Points = MakeCorner().Points;
  cells.Points.emplace_back(0.2, 0.3, 0.1);
  cells.Cells = { { 0, 2, 1, 4 }, { 0, 1, 3, 4 }, { 0, 3, 2, 4 }, { 1, 2, 3, 4 } };
  for (Tetrahedron& cell : cells.Cells)
  {
    std::swap(cell[0], cell[1]); // positive
  }
  const std::vector<bool> given = FindBoundaryPoints(cells);
  EXPECT_EQ(given, (std::vector<bool>{ true, true, true, true, false }));
  const HarmonicField field(cells, given);
  std::vector<double> values = { 1.0, 3.0, 0.0, 5.0, 100.0 }; // 1 + 2 x - y + 4 z
  EXPECT_TRUE(field.Continue(values));
  EXPECT_NEAR(values[4], 1.0 + 0.4 - 0.3 + 0.4, 1e-14);
  values[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(field.Continue(values));
  values[0] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(field.Continue(values));
}

//------------------------------------------------------------------------------
TEST(MeshingFiles, AreReadAsTheyWereWritten)
{
  const TestFile file;
  MeshingTask task;
  task.Surface = MakeCorner();
  task.RadiusEdgeRatio = 1.5;
  task.MaximumVolume = 1e-30;
  task.FillsHull = true;
  ASSERT_TRUE(WriteMeshingTask(file.Name, task));
  MeshingTask read;
  ASSERT_TRUE(ReadMeshingTask(file.Name, read));
  EXPECT_EQ(read.Surface.Points, task.Surface.Points);
  EXPECT_EQ(read.Surface.Triangles, task.Surface.Triangles);
  EXPECT_EQ(read.MaximumVolume, 1e-30);
  EXPECT_TRUE(read.FillsHull);
  EXPECT_FALSE(read.KeepsSurface);
  // Neither a part of a file, nor a file of the other kind, nor one with wrong indices.
  MeshingAnswer answer;
  EXPECT_FALSE(ReadMeshingAnswer(file.Name, answer));
  const auto size = std::filesystem::file_size(file.Name);
  for (std::uintmax_t part = 0; part < size; ++part)
  {
    std::filesystem::resize_file(file.Name, size - 1 - part);
    EXPECT_FALSE(ReadMeshingTask(file.Name, read)) << size - 1 - part;
  }
  task.Surface.Triangles[2][1] = 4;
  ASSERT_TRUE(WriteMeshingTask(file.Name, task));
  EXPECT_FALSE(ReadMeshingTask(file.Name, read));
  EXPECT_FALSE(ReadMeshingTask("/no/such/file", read));
}
