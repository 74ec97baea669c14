// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cells that are given repeatedly count once.
#include "KernelMeshes.h"
#include "KernelPicture.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Each cell one to three times, its points in any order, all cells in any order. */
MeshArrays Doubled(const MeshArrays& arrays, unsigned int seed)
{
  std::mt19937 random(seed);
  std::vector<std::array<std::int64_t, 4>> cells;
  for (std::size_t c = 0; c < arrays.Cells.size(); c += 4)
  {
    const std::int64_t* ids = arrays.Cells.data() + c;
    std::array<std::int64_t, 4> cell{ ids[0], ids[1], ids[2], ids[3] };
    for (unsigned int copies = 1 + random() % 3; copies > 0; --copies)
    {
      std::shuffle(cell.begin(), cell.end(), random);
      cells.push_back(cell);
    }
  }
  std::shuffle(cells.begin(), cells.end(), random);
  MeshArrays doubled{ arrays.Points, {} };
  for (const auto& cell : cells)
  {
    doubled.Cells.insert(doubled.Cells.end(), cell.begin(), cell.end());
  }
  return doubled;
}

/** Expects the picture of a cube that is filled once, seen along an axis. */
void ExpectFilledOnce(PictureScene& scene)
{
  scene.Scalars.assign(static_cast<std::size_t>(scene.Mesh.GetNumberOfVertices()), 0.5f);
  scene.Intervals = ConstantFunction(0.7);
  scene.Frame = FrameAlongZ(scene.Mesh, 0.6, 48);
  const Picture picture = CastPicture(scene, 48, InstructionSet::Portable);
  EXPECT_EQ(picture.Statistics.Lost, 0);
  for (const auto& [row, column] : Product(Numbers(5, 43), Numbers(5, 43)))
  {
    ASSERT_NEAR(picture.Alpha(column, row), -std::expm1(-0.7), 1e-6) << column << " " << row;
  }
}

}

TEST(DuplicateCells, TwoCellsGivenTwiceAreLinkedAsTwo)
{
  const MeshArrays arrays = { { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.3, 0.3, -1 },
    { 0, 1, 2, 3, 3, 2, 1, 0, 0, 1, 2, 4, 4, 0, 1, 2 } };
  TetrahedraView view = arrays.View();
  view.KeepSourceCells = true;
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(view), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetNumberOfCells(), 2);
  EXPECT_EQ(mesh.GetRejectedCells().Duplicate, 2);
  EXPECT_EQ(mesh.GetRejectedCells().Total(), 2);
  EXPECT_EQ(mesh.GetBoundary().size(), 6u);
  std::vector<std::int32_t> sources = mesh.GetSourceCells();
  std::sort(sources.begin(), sources.end());
  EXPECT_EQ(sources, (std::vector<std::int32_t>{ 0, 2 })) << "the first of equal cells is kept";
}

TEST(DuplicateCells, MeshGivenInAnyNumberAndOrderIsTheMesh)
{
  for (const auto& [n, seed] : Product(List(1, 3, 12), Below<unsigned int>(4)))
  {
    const MeshArrays arrays = KuhnGrid(n);
    TetrahedralMesh once;
    TetrahedralMesh doubled;
    ASSERT_EQ(once.Build(arrays.View()), MeshStatus::Ok);
    const MeshArrays given = Doubled(arrays, seed);
    ASSERT_EQ(doubled.Build(given.View()), MeshStatus::Ok);
    EXPECT_EQ(doubled.GetNumberOfCells(), once.GetNumberOfCells());
    EXPECT_EQ(doubled.GetRejectedCells().Duplicate,
      static_cast<std::int64_t>(given.Cells.size() - arrays.Cells.size()) / 4);
    EXPECT_EQ(doubled.GetBoundary().size(), once.GetBoundary().size());
    EXPECT_EQ(doubled.GetNumberOfCutLinks(), 0);
  }
}

TEST(DuplicateCells, MeshThatIsSmallBesideItsBoxAsWell)
{
  // The whole grid has one Morton code: thousands of cells are compared with each other.
  MeshArrays arrays = Moved(KuhnGrid(8), [](const glm::dvec3& p) { return 1e-6 * p; });
  const auto first = static_cast<std::int64_t>(arrays.Points.size() / 3);
  arrays.Points.insert(arrays.Points.end(), { 1, 0, 0, 1, 1, 0, 1, 0, 1, 2, 1, 1 });
  arrays.Cells.insert(arrays.Cells.end(), { first, first + 1, first + 2, first + 3 });
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(Doubled(arrays, 5).View()), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetNumberOfCells(), static_cast<std::int64_t>(arrays.Cells.size() / 4));
}

TEST(DuplicateCells, PositionsCountWhereTheyAreMatched)
{
  const MeshArrays arrays = Joined(KuhnGrid(3), KuhnGrid(3));
  const auto cells = static_cast<std::int64_t>(arrays.Cells.size() / 4);
  TetrahedraView view = arrays.View();
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(view), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetNumberOfCells(), cells) << "one data set: points are told apart";
  view.MatchPositions = true;
  ASSERT_EQ(mesh.Build(view), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetNumberOfCells(), cells / 2);
  EXPECT_EQ(mesh.GetRejectedCells().Duplicate, cells / 2);
  EXPECT_EQ(mesh.GetBoundary().size(), std::size_t(6 * 2 * 3 * 3));
}

TEST(DuplicateCells, PositionsThatDifferByTheSignOfZeroOrTheLastBit)
{
  MeshArrays arrays = Joined(SingleTetrahedron(), SingleTetrahedron());
  for (std::size_t i = 12; i < 24; ++i)
  {
    arrays.Points[i] = arrays.Points[i] == 0.0 ? -0.0 : arrays.Points[i];
  }
  TetrahedraView view = arrays.View();
  view.MatchPositions = true;
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(view), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetNumberOfCells(), 1);
  arrays.Points[15] = std::nextafter(1.0, 2.0);
  ASSERT_EQ(mesh.Build(view), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetNumberOfCells(), 2) << "another position, another cell";
}

TEST(DuplicateCells, CubeGivenRepeatedlyHidesWhatItsLengthSays)
{
  // Along an axis, every ray has a length of 1 inside the cube.
  for (unsigned int seed = 0; seed < 3; ++seed)
  {
    PictureScene scene;
    ASSERT_EQ(scene.Mesh.Build(Doubled(KuhnGrid(4), seed).View()), MeshStatus::Ok);
    ExpectFilledOnce(scene);
  }
}

TEST(DuplicateCells, CubeFilledTwiceWithDifferentCellsDoesNotVanish)
{
  // Kuhn's six cells share a diagonal. Six others of the same eight points and the same faces share
  // corner (1, 0, 0): each has a triangle of the sides x = 0, y = 1 and z = 1.
  MeshArrays arrays = KuhnGrid(1);
  TetrahedralMesh kuhn;
  ASSERT_EQ(kuhn.Build(arrays.View()), MeshStatus::Ok);
  const auto cornerAt = [&arrays](const glm::dvec3& wanted)
  {
    std::int64_t p = 0;
    while (arrays.PointAt(p) != wanted)
    {
      ++p;
    }
    return p;
  };
  const std::int64_t apex = cornerAt({ 1, 0, 0 });
  for (const BoundaryFace& face : kuhn.GetBoundary())
  {
    std::int64_t points[3];
    for (int i = 0; i < 3; ++i)
    {
      points[i] = kuhn.GetSourcePoints()[face.Vertices[i]];
    }
    const glm::dvec3 sum =
      arrays.PointAt(points[0]) + arrays.PointAt(points[1]) + arrays.PointAt(points[2]);
    if (sum.x == 0.0 || sum.y == 3.0 || sum.z == 3.0)
    {
      arrays.Cells.insert(arrays.Cells.end(), { apex, points[0], points[1], points[2] });
    }
  }
  ASSERT_EQ(arrays.Cells.size(), std::size_t(4 * 12));
  PictureScene scene;
  ASSERT_EQ(scene.Mesh.Build(arrays.View()), MeshStatus::Ok);
  EXPECT_GT(scene.Mesh.GetNumberOfCutLinks(), 0);
  ExpectFilledOnce(scene);
}
