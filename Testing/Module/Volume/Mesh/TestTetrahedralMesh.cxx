// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "KernelMeshes.h"
#include "TestBasics.h"

#include <thread>

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Volume enclosed by the oriented boundary, in units of the radius cubed. */
double EnclosedVolume(const TetrahedralMesh& mesh)
{
  double volume = 0.0;
  for (const BoundaryFace& face : mesh.GetBoundary())
  {
    const glm::dvec3 a = mesh.GetPosition(face.Vertices[0]);
    const glm::dvec3 b = mesh.GetPosition(face.Vertices[1]);
    const glm::dvec3 c = mesh.GetPosition(face.Vertices[2]);
    volume += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  return volume;
}

/** Expects links to lead there and back, across the same three vertices. */
void ExpectConsistentLinks(const TetrahedralMesh& mesh)
{
  const auto& cells = mesh.GetCells();
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    EXPECT_TRUE(std::is_sorted(cells[c].Vertices.begin(), cells[c].Vertices.end()));
    for (int face = 0; face < 4; ++face)
    {
      const std::int32_t link = cells[c].Links[face];
      if (link == TetrahedralMesh::NoNeighbor)
      {
        continue;
      }
      const auto& other = cells[link / 4];
      EXPECT_EQ(other.Links[link % 4], static_cast<std::int32_t>(4 * c + face));
      std::multiset<std::int32_t> mine(cells[c].Vertices.begin(), cells[c].Vertices.end());
      std::multiset<std::int32_t> theirs(other.Vertices.begin(), other.Vertices.end());
      mine.erase(mine.find(cells[c].Vertices[face]));
      theirs.erase(theirs.find(other.Vertices[link % 4]));
      EXPECT_EQ(mine, theirs);
    }
  }
}

}

TEST(TetrahedralMesh, LinksAndBoundaryOfAGrid)
{
  const int n = 4;
  const MeshArrays arrays = KuhnGrid(n);
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetNumberOfCells(), 6 * n * n * n);
  EXPECT_EQ(mesh.GetNumberOfVertices(), (n + 1) * (n + 1) * (n + 1));
  EXPECT_EQ(mesh.GetBoundary().size(), std::size_t(6 * 2 * n * n));
  EXPECT_EQ(mesh.GetNumberOfCutLinks(), 0);
  EXPECT_EQ(mesh.GetRejectedCells().Total(), 0);
  ExpectConsistentLinks(mesh);
  const double radius = mesh.GetRadius();
  EXPECT_NEAR(radius, std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(EnclosedVolume(mesh) * radius * radius * radius, 1.0, 1e-6);
}

TEST(TetrahedralMesh, TheSmallestCellIsThatWithTheShortestLongestEdge)
{
  // The longest edges of Kuhn's tetrahedra are the diagonals of the cubes, twice the radius over n.
  const int n = 5;
  MeshArrays arrays = KuhnGrid(n);
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
  EXPECT_NEAR(mesh.GetSmallestCell(), 2.0 / n, 1e-6);
  // A small tetrahedron outside of all others, whose longest edge is the diagonal of a square, and
  // a smaller one without volume.
  const double size = 1e-3;
  const auto next = static_cast<std::int64_t>(arrays.Points.size() / 3);
  arrays.Points.insert(arrays.Points.end(),
    { 0.5, 0.5, 1.01, 0.5 + size, 0.5, 1.01, 0.5, 0.5 + size, 1.01, 0.5, 0.5, 1.01 + size, 0.5, 0.5,
      1.01 + 0.5 * size, 0.5, 0.5, 1.01 + 0.25 * size });
  arrays.Cells.insert(
    arrays.Cells.end(), { next, next + 1, next + 2, next + 3, next, next + 3, next + 4, next + 5 });
  ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
  EXPECT_NEAR(mesh.GetSmallestCell() * mesh.GetRadius() / size, std::sqrt(2.0), 1e-5);
}

TEST(TetrahedralMesh, OrientationIsThatOfTheWholeNotOfEachCell)
{
  MeshArrays turned = KuhnGrid(3);
  for (std::size_t c = 0; c < turned.Cells.size(); c += 8) // every other cell
  {
    std::swap(turned.Cells[c], turned.Cells[c + 1]);
  }
  MeshArrays tangled = KuhnGrid(6);
  Jitter(tangled, 0.12, 7); // inverts many cells
  for (const MeshArrays& arrays : { turned, tangled })
  {
    TetrahedralMesh mesh;
    ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
    EXPECT_EQ(mesh.GetNumberOfCutLinks(), 0);
    EXPECT_GT(EnclosedVolume(mesh), 0.0);
    ExpectConsistentLinks(mesh);
  }
}

TEST(TetrahedralMesh, PartsOfBothSignsMakeOneWhole)
{
  // Cells are oriented in blocks of thousands, which are joined: the boundary encloses the unit
  // cube, whatever the signs of the parts were.
  for (const int n : { 11, 12, 16, 20 })
  {
    TetrahedralMesh mesh;
    mesh.Build(KuhnGrid(n).View());
    const double radius = mesh.GetRadius();
    EXPECT_NEAR(EnclosedVolume(mesh) * radius * radius * radius, 1.0, 1e-5) << n;
  }
}

TEST(TetrahedralMesh, RejectsAndCountsBadCells)
{
  MeshArrays arrays = KuhnGrid(2);
  const std::size_t good = arrays.Cells.size() / 4;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::int64_t bad = static_cast<std::int64_t>(arrays.Points.size() / 3);
  arrays.Points.insert(arrays.Points.end(), { 0.5, nan, 0.5 });
  arrays.Cells.insert(arrays.Cells.end(), { 0, 1, 2, 27 + 1 }); // beyond the last point
  arrays.Cells.insert(arrays.Cells.end(), { 0, 1, 2, -1 });
  arrays.Cells.insert(arrays.Cells.end(), { 0, 1, 1, 2 });
  arrays.Cells.insert(arrays.Cells.end(), { 0, 1, 2, bad });
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetRejectedCells().IndexOutOfRange, 2);
  EXPECT_EQ(mesh.GetRejectedCells().RepeatedVertex, 1);
  EXPECT_EQ(mesh.GetRejectedCells().PointNotFinite, 1);
  EXPECT_EQ(mesh.GetNumberOfCells(), static_cast<std::int64_t>(good));
}

TEST(TetrahedralMesh, EmptyAndRebuilt)
{
  TetrahedralMesh mesh;
  EXPECT_EQ(mesh.Build(TetrahedraView()), MeshStatus::Empty);
  EXPECT_EQ(mesh.Build(SingleTetrahedron().View()), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetBoundary().size(), 4u);
  EXPECT_EQ(mesh.Build(TetrahedraView()), MeshStatus::Empty);
  EXPECT_TRUE(mesh.GetBoundary().empty());
  EXPECT_TRUE(mesh.GetFixedPositions().empty());
}

TEST(TetrahedralMesh, RefusesMoreThanItsIndicesHold)
{
  TetrahedraView view;
  view.NumberOfCells = TetrahedralMesh::MaximumNumberOfCells + 1;
  TetrahedralMesh mesh;
  EXPECT_EQ(mesh.Build(view), MeshStatus::TooLarge);
}

TEST(TetrahedralMesh, DoesNotDependOnTheLoopNorOnTheTypesOfTheInput)
{
  MeshArrays arrays = KuhnGrid(15); // several blocks
  Jitter(arrays, 0.06, 5);          // with inverted cells
  arrays = Moved(arrays, [](const glm::dvec3& p) { return glm::dvec3(glm::vec3(p)); });
  TetrahedralMesh serial;
  ASSERT_EQ(serial.Build(arrays.View()), MeshStatus::Ok);

  const std::vector<float> points(arrays.Points.begin(), arrays.Points.end());
  const std::vector<std::int32_t> cells(arrays.Cells.begin(), arrays.Cells.end());
  TetrahedraView view = arrays.View();
  view.Points = points.data();
  view.Cells = nullptr;
  view.ShortCells = cells.data();
  view.KeepSourceCells = true;
  MeshBuildControl control;
  control.Loop = [](std::size_t count, const RangeBody& body)
  {
    const auto work = [&body, count](std::size_t first)
    {
      for (std::size_t i = first; i < count; i += 3)
      {
        body(count - 1 - i, count - i);
      }
    };
    std::thread a(work, 0);
    std::thread b(work, 1);
    work(2);
    a.join();
    b.join();
  };
  TetrahedralMesh parallel;
  ASSERT_EQ(parallel.Build(view, control), MeshStatus::Ok);
  EXPECT_EQ(parallel.GetSourcePoints(), serial.GetSourcePoints());
  ASSERT_EQ(parallel.GetNumberOfCells(), serial.GetNumberOfCells());
  for (std::size_t c = 0; c < serial.GetCells().size(); ++c)
  {
    EXPECT_EQ(parallel.GetCells()[c].Vertices, serial.GetCells()[c].Vertices);
    EXPECT_EQ(parallel.GetCells()[c].Links, serial.GetCells()[c].Links);
    const std::int64_t* source = arrays.Cells.data() + 4 * parallel.GetSourceCells()[c];
    std::set<std::int64_t> points4(source, source + 4);
    for (const std::int32_t vertex : serial.GetCells()[c].Vertices)
    {
      EXPECT_EQ(points4.count(serial.GetSourcePoints()[vertex]), 1u);
    }
  }
  ASSERT_EQ(parallel.GetBoundary().size(), serial.GetBoundary().size());
  for (std::size_t f = 0; f < serial.GetBoundary().size(); ++f)
  {
    EXPECT_EQ(parallel.GetBoundary()[f].CellFace, serial.GetBoundary()[f].CellFace);
    EXPECT_EQ(parallel.GetBoundary()[f].Vertices, serial.GetBoundary()[f].Vertices);
  }
}

TEST(TetrahedralMesh, TakesTwoBitsBesidesVerticesAndLinksPerCell)
{
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(KuhnGrid(12).View()), MeshStatus::Ok);
  // Bits are in words of 8 bytes.
  const std::int64_t ofCells =
    32 * mesh.GetNumberOfCells() + 2 * 8 * (mesh.GetNumberOfCells() / 64 + 1);
  const std::int64_t ofVertices = 16 * mesh.GetNumberOfVertices();
  const auto ofFaces = static_cast<std::int64_t>(16 * mesh.GetBoundary().size());
  EXPECT_LE(mesh.GetBytes(), ofCells + ofVertices + ofFaces);
}

TEST(TetrahedralMesh, DoesNotDependOnTheLayoutOfThePoints)
{
  MeshArrays arrays = KuhnGrid(4);
  Jitter(arrays, 0.06, 5);
  // The same number in both precisions.
  arrays = Moved(arrays, [](const glm::dvec3& p) { return glm::dvec3(glm::vec3(p)); });
  TetrahedralMesh expected;
  ASSERT_EQ(expected.Build(arrays.View()), MeshStatus::Ok);

  std::vector<double> axes[3];
  std::vector<float> floatAxes[3];
  for (std::size_t i = 0; i < arrays.Points.size(); ++i)
  {
    axes[i % 3].push_back(arrays.Points[i]);
    floatAxes[i % 3].push_back(static_cast<float>(arrays.Points[i]));
  }
  for (const PointsView& points : { PointsView(axes[0].data(), axes[1].data(), axes[2].data()),
         PointsView(floatAxes[0].data(), floatAxes[1].data(), floatAxes[2].data()) })
  {
    TetrahedraView view = arrays.View();
    view.Points = points;
    TetrahedralMesh mesh;
    ASSERT_EQ(mesh.Build(view), MeshStatus::Ok);
    EXPECT_EQ(mesh.GetSourcePoints(), expected.GetSourcePoints());
    ASSERT_EQ(mesh.GetNumberOfVertices(), expected.GetNumberOfVertices());
    for (std::int64_t v = 0; v < mesh.GetNumberOfVertices(); ++v)
    {
      EXPECT_EQ(mesh.GetPosition(v), expected.GetPosition(v));
    }
  }
}

TEST(TetrahedralMesh, LeavesOutFlaggedCells)
{
  const MeshArrays arrays = KuhnGrid(2);
  TetrahedraView view = arrays.View();
  std::vector<std::uint8_t> flags(view.NumberOfCells, 4);
  flags[7] = 1;
  flags[20] = 3;
  view.CellFlags = flags.data();
  view.LeftOutBits = 1;
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(view), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetNumberOfCells(), view.NumberOfCells - 2);
  EXPECT_EQ(mesh.GetRejectedCells().Total(), 0);
}

TEST(TetrahedralMesh, TellsProgressAndCanBeAborted)
{
  const MeshArrays arrays = KuhnGrid(4);
  std::vector<double> told;
  MeshBuildControl control;
  control.Progress = [&told](double fraction)
  {
    told.push_back(fraction);
    return true;
  };
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(arrays.View(), control), MeshStatus::Ok);
  EXPECT_GE(told.size(), 4u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  for (const double last : told)
  {
    control.Progress = [last](double fraction) { return fraction < last; };
    EXPECT_EQ(mesh.Build(arrays.View(), control), MeshStatus::Aborted);
    EXPECT_EQ(mesh.GetNumberOfCells(), 0);
    EXPECT_TRUE(mesh.GetFixedPositions().empty());
  }
  EXPECT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
}

TEST(TetrahedralMesh, LinkThatNoOrientationAllowsIsCut)
{
  // A Moebius ring of prisms, each split into 3 tetrahedra: one twist of the sides of the square
  // cross-section. In 3D it is a ring of tetrahedra glued with a reversal; any cut makes it
  // orientable.
  const int n = 6;
  MeshArrays arrays;
  for (int i = 0; i < n; ++i)
  {
    const double angle = 2.0 * 3.14159265358979 * i / n;
    for (const double side : { -0.2, 0.2 })
    {
      arrays.Points.insert(arrays.Points.end(),
        { std::cos(angle) * (1.0 + side), std::sin(angle) * (1.0 + side), 0.3 * side });
    }
    arrays.Points.insert(arrays.Points.end(), { std::cos(angle), std::sin(angle), 0.3 });
  }
  for (std::int64_t i = 0; i < n; ++i)
  {
    const std::int64_t a[3] = { 3 * i, 3 * i + 1, 3 * i + 2 };
    const std::int64_t next = 3 * ((i + 1) % n);
    const bool twist = i == n - 1; // swaps two corners of the triangle
    const std::int64_t b[3] = { next + (twist ? 1 : 0), next + (twist ? 0 : 1), next + 2 };
    for (const auto& cell : { std::array<std::int64_t, 4>{ a[0], a[1], a[2], b[2] },
           std::array<std::int64_t, 4>{ a[0], a[1], b[1], b[2] },
           std::array<std::int64_t, 4>{ a[0], b[0], b[1], b[2] } })
    {
      arrays.Cells.insert(arrays.Cells.end(), cell.begin(), cell.end());
    }
  }
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetNumberOfCutLinks(), 1);
  ExpectConsistentLinks(mesh);
}

TEST(TetrahedralMesh, FacesOfMoreThanTwoCellsAreNeverLinked)
{
  // 2 to 6 cells on one face.
  MeshArrays arrays = { { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, {} };
  for (std::int64_t n = 1; n <= 6; ++n)
  {
    arrays.Points.insert(arrays.Points.end(), { 0.1 * n, 0.05 * n, n % 2 ? 1.0 : -1.0 });
    arrays.Cells.insert(arrays.Cells.end(), { 0, 1, 2, n + 2 });
    TetrahedralMesh mesh;
    ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
    EXPECT_EQ(mesh.GetBoundary().size(), static_cast<std::size_t>(n == 2 ? 6 : 4 * n));
  }
}

TEST(TetrahedralMesh, ManyCellsAboutAnEdge)
{
  const std::int64_t n = 3000;
  MeshArrays arrays = { { 0, 0, -1, 0, 0, 1 }, {} };
  for (std::int64_t i = 0; i < n; ++i)
  {
    const double angle = 2.0 * 3.14159265358979 * static_cast<double>(i) / n;
    arrays.Points.insert(arrays.Points.end(), { std::cos(angle), std::sin(angle), 0.0 });
    arrays.Cells.insert(arrays.Cells.end(), { 0, 1, 2 + i, 2 + (i + 1) % n });
  }
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetBoundary().size(), static_cast<std::size_t>(2 * n));
  EXPECT_EQ(mesh.GetNumberOfCutLinks(), 0);
  ExpectConsistentLinks(mesh);
}

// vtkTetrahedraEntryTilesCS finds the subtrees by the number of faces alone.
TEST(BoundaryTree, FirstChildrenHaveHalfOfTheFaces)
{
  MeshArrays arrays = KuhnGrid(3);
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
  BoundaryTree tree;
  tree.Build(mesh);
  const auto& nodes = tree.GetNodes();
  const auto facesOf = [&nodes](std::size_t node)
  { return (static_cast<std::size_t>(nodes[node].Skip) - node + 1) / 2; };
  EXPECT_EQ(facesOf(0), tree.GetFaces().size());
  for (std::size_t n = 0; n < nodes.size(); ++n)
  {
    const bool leaf = nodes[n].Face >= 0;
    EXPECT_EQ(leaf, facesOf(n) == 1);
    EXPECT_TRUE(leaf || facesOf(n + 1) == facesOf(n) / 2) << n;
  }
}

TEST(BoundaryTree, HoldsEveryFaceOnceAndInItsBoxes)
{
  MeshArrays arrays = KuhnGrid(5);
  Jitter(arrays, 0.05, 3);
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(arrays.View()), MeshStatus::Ok);
  BoundaryTree tree;
  tree.Build(mesh);
  const auto& nodes = tree.GetNodes();
  ASSERT_EQ(tree.GetFaces().size(), mesh.GetBoundary().size());
  ASSERT_EQ(nodes.size(), 2 * tree.GetFaces().size() - 1);
  std::set<std::int32_t> owners;
  for (const BoundaryFace& face : tree.GetFaces())
  {
    owners.insert(face.CellFace);
  }
  EXPECT_EQ(owners.size(), mesh.GetBoundary().size());
  for (std::size_t n = 0; n < nodes.size(); ++n)
  {
    for (std::size_t leaf = n; leaf < static_cast<std::size_t>(nodes[n].Skip); ++leaf)
    {
      if (nodes[leaf].Face < 0)
      {
        continue;
      }
      for (const std::int32_t v : tree.GetFaces()[nodes[leaf].Face].Vertices)
      {
        const glm::dvec3 offset =
          glm::abs(glm::dvec3(glm::vec3(mesh.GetPosition(v))) - glm::dvec3(nodes[n].Center));
        EXPECT_TRUE(offset.x <= nodes[n].Half.x && offset.y <= nodes[n].Half.y &&
          offset.z <= nodes[n].Half.z);
      }
    }
  }
}
