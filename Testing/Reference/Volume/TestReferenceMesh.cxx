// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceMesh.h"

#include <gtest/gtest.h>

#include <limits>

using namespace meniscus::reference;

namespace
{

const std::vector<double> UnitCorners{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };

// Two tetrahedra on both sides of the face (0, 1, 2).
const std::vector<double> TwoCellPoints{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1 };

} // anonymous namespace

TEST(ReferenceMesh, StoredVertexOrderDoesNotMatter)
{
  // The second cell is stored with a negative volume, but lies on the other side of the face.
  for (const std::vector<std::int64_t>& cells :
    { std::vector<std::int64_t>{ 0, 1, 2, 3, 0, 1, 2, 4 },
      std::vector<std::int64_t>{ 0, 1, 2, 3, 0, 2, 1, 4 } })
  {
    const ReferenceMesh mesh(TwoCellPoints, cells, std::vector<double>(5, 0.0));
    EXPECT_EQ(mesh.ContributingCells().size(), 2u);
    EXPECT_EQ(mesh.NumberOfInvertedCells(), 0u);
    EXPECT_EQ(mesh.NumberOfBoundaryFaces(), 6u);
  }
}

TEST(ReferenceMesh, CellFoldedOverItsNeighborIsInverted)
{
  // Three cells in a row; the last vertex is moved through the face to the side of its neighbours.
  std::vector<double> points = TwoCellPoints;
  points.insert(points.end(), { 1, 1, 1 });
  points[3 * 4 + 2] = 0.5;
  const ReferenceMesh mesh(
    points, { 0, 1, 2, 3, 0, 1, 2, 4, 1, 2, 3, 5 }, std::vector<double>(6, 0.0));
  EXPECT_EQ(mesh.NumberOfInvertedCells(), 1u);
  EXPECT_EQ(mesh.ContributingCells(), (std::vector<std::int64_t>{ 0, 2 }));
}

TEST(ReferenceMesh, FlatAndUnusableCellsAreCountedApart)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> points = UnitCorners;
  points.insert(points.end(), { 1, 1, 0, nan, 0, 0 });
  const ReferenceMesh mesh(points,
    { 0, 1, 2, 3, 0, 1, 2, 4, 0, 0, 1, 2, 0, 1, 2, 5, 0, 1, 2, 99, -1, 1, 2, 3 },
    std::vector<double>(6, 0.0));
  EXPECT_EQ(mesh.ContributingCells().size(), 1u);
  EXPECT_EQ(mesh.NumberOfZeroVolumeCells(), 2u);
  EXPECT_EQ(mesh.NumberOfRejectedCells(), 3u);
}

TEST(ReferenceMesh, CellsWithScalarsThatAreNotFiniteAreRejected)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const ReferenceMesh mesh(UnitCorners, { 0, 1, 2, 3 }, { 0, 1, infinity, 0 });
  EXPECT_TRUE(mesh.ContributingCells().empty());
  EXPECT_EQ(mesh.NumberOfRejectedCells(), 1u);
}

TEST(ReferenceMesh, PlanesAreBarycentricWeights)
{
  const ReferenceMesh mesh(UnitCorners, { 0, 1, 2, 3 }, { 0, 0, 0, 0 });
  const CellPlanes& planes = mesh.GetPlanes(0);
  for (int vertex = 0; vertex < 4; ++vertex)
  {
    for (int i = 0; i < 4; ++i)
    {
      double weight = planes.Offset[i];
      for (int axis = 0; axis < 3; ++axis)
      {
        weight += planes.Gradient[i][axis] * (mesh.GetPoint(vertex)[axis] - mesh.GetCenter()[axis]);
      }
      EXPECT_NEAR(weight, vertex == i ? 1.0 : 0.0, 1e-15);
    }
  }
}
