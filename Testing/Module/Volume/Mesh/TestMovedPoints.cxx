// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes whose points move: their tables are those that are built of the moved points, whatever the
// order of vertices and cells, or MovePoints() says that they are not.
#include "KernelMeshes.h"
#include "TestBasics.h"
#include "Volume/Mesh/BoundaryTree.h"

#include <glm/vector_relational.hpp>

#include <thread>

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Three points of a face in the order in which its normal points outwards, the lowest first. */
using OrientedFace = std::array<std::int32_t, 3>;

OrientedFace MakeOrientedFace(const TetrahedralMesh& mesh, const BoundaryFace& face)
{
  OrientedFace points;
  for (int i = 0; i < 3; ++i)
  {
    points[i] = mesh.GetSourcePoints()[face.Vertices[i]];
  }
  std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
  return points;
}

/** A mesh in terms of the input's points and cells, without its own order. */
struct UnorderedMesh
{
  glm::dvec3 Center;
  double Radius;
  double SmallestCell;
  std::map<std::int32_t, std::array<std::int32_t, 3>> Positions;
  /** Cell across the face opposite a point of a cell. */
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> Neighbors;
  /** Boundary faces with their cells. */
  std::multiset<std::pair<OrientedFace, std::int32_t>> Boundary;
  std::int64_t Active;
  std::int64_t CutLinks;

  explicit UnorderedMesh(const TetrahedralMesh& mesh)
    : Center(mesh.GetCenter())
    , Radius(mesh.GetRadius())
    , SmallestCell(mesh.GetSmallestCell())
    , Active(mesh.GetNumberOfActiveCells())
    , CutLinks(mesh.GetNumberOfCutLinks())
  {
    const auto& points = mesh.GetSourcePoints();
    const auto& sources = mesh.GetSourceCells();
    for (std::size_t v = 0; v < points.size(); ++v)
    {
      const glm::ivec3 p = mesh.GetFixedPositions()[v];
      this->Positions[points[v]] = { p.x, p.y, p.z };
    }
    for (std::size_t c = 0; c < sources.size(); ++c)
    {
      const TetrahedralMesh::Cell& cell = mesh.GetCells()[c];
      for (int i = 0; i < 4; ++i)
      {
        const std::int32_t link = cell.Links[i];
        // Inactive neighbours count with another sign.
        this->Neighbors[{ sources[c], points[cell.Vertices[i]] }] =
          link == TetrahedralMesh::NoNeighbor ? -1
          : link < 0                          ? -2 - sources[TetrahedralMesh::MarkedLink(link) / 4]
                                              : sources[link / 4];
      }
    }
    for (const BoundaryFace& face : mesh.GetBoundary())
    {
      this->Boundary.emplace(MakeOrientedFace(mesh, face), sources[face.CellFace / 4]);
    }
  }
};

void ExpectSame(const TetrahedralMesh& moved, const TetrahedralMesh& built)
{
  const UnorderedMesh a(moved);
  const UnorderedMesh b(built);
  EXPECT_EQ(a.Center, b.Center);
  EXPECT_EQ(a.Radius, b.Radius);
  EXPECT_EQ(a.SmallestCell, b.SmallestCell);
  EXPECT_EQ(a.Positions, b.Positions);
  EXPECT_EQ(a.Neighbors, b.Neighbors);
  EXPECT_EQ(a.Boundary, b.Boundary);
  EXPECT_EQ(a.Active, b.Active);
  EXPECT_EQ(a.CutLinks, b.CutLinks);
}

TetrahedralMesh Build(const MeshArrays& arrays, bool matchPositions = false)
{
  TetrahedraView view = arrays.View();
  view.KeepSourceCells = true;
  view.MatchPositions = matchPositions;
  TetrahedralMesh mesh;
  mesh.Build(view);
  return mesh;
}

/** Motion of points with x > 1.5, the second of two meshes; others stay. */
Motion OnlySecond(const Motion& motion)
{
  return [motion](const glm::dvec3& p) { return p.x > 1.5 ? motion(p) : p; };
}

const Motion ToSecond = [](const glm::dvec3& p) { return p + glm::dvec3(2.0, 0.0, 0.0); };

/** Two tetrahedra on opposite sides of a common face. */
MeshArrays TwoTetrahedra()
{
  return { { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25, 0.25, 1, 0.25, 0.25, -1 },
    { 0, 1, 2, 3, 0, 1, 2, 4 } };
}

}

TEST(MovedPoints, TablesAreThoseOfABuild)
{
  // Waves, turns, a change of scale, and folds that invert cells.
  const std::vector<Motion> motions{
    [](const glm::dvec3& p) { return p + 0.02 * glm::dvec3(std::sin(7 * p.y), 0, p.x * p.y); },
    [](const glm::dvec3& p) { return glm::dvec3(-p.y, p.x, p.z) + 100.0; },
    [](const glm::dvec3& p) { return 1e-3 * p; },
    [](const glm::dvec3& p)
    { return p + 0.2 * glm::dvec3(std::sin(31 * p.x), std::cos(40 * p.z), 0); },
  };
  MeshArrays arrays = KuhnGrid(13); // more than one block of cells
  Jitter(arrays, 0.01, 3);
  TetrahedralMesh mesh = Build(arrays);
  for (std::size_t i = 0; i < motions.size(); ++i)
  {
    SCOPED_TRACE(i);
    const MeshArrays moved = Moved(arrays, motions[i]);
    ASSERT_TRUE(mesh.MovePoints(moved.Points.data()));
    ExpectSame(mesh, Build(moved));
  }
  ASSERT_TRUE(mesh.MovePoints(arrays.Points.data()));
  ExpectSame(mesh, Build(arrays));
}

TEST(MovedPoints, MirroredPartsAreTurned)
{
  const Motion mirror = [](const glm::dvec3& p) { return glm::dvec3(p.x, p.y, -p.z); };
  const MeshArrays arrays = Joined(KuhnGrid(4), Moved(KuhnGrid(3), ToSecond));
  TetrahedralMesh mesh = Build(arrays);
  const MeshArrays one = Moved(arrays, OnlySecond(mirror));
  const MeshArrays both = Moved(arrays, mirror);
  for (const MeshArrays* moved : { &one, &both, &arrays })
  {
    ASSERT_TRUE(mesh.MovePoints(moved->Points.data()));
    ExpectSame(mesh, Build(*moved));
  }
}

TEST(MovedPoints, FlatPartsAreKept)
{
  const Motion flatten = [](const glm::dvec3& p) { return glm::dvec3(p.x, p.y, 0.5); };
  const MeshArrays arrays = Joined(KuhnGrid(4), Moved(KuhnGrid(3), ToSecond));
  TetrahedralMesh mesh = Build(arrays);
  const MeshArrays flat = Moved(arrays, OnlySecond(flatten));
  ASSERT_TRUE(mesh.MovePoints(flat.Points.data()));
  EXPECT_EQ(UnorderedMesh(mesh).Neighbors, UnorderedMesh(Build(flat)).Neighbors);
  ASSERT_TRUE(mesh.MovePoints(arrays.Points.data()));
  ExpectSame(mesh, Build(arrays));
}

TEST(MovedPoints, ActiveCellsStay)
{
  const MeshArrays arrays = KuhnGrid(5);
  const MeshArrays moved =
    Moved(arrays, [](const glm::dvec3& p) { return glm::dvec3(p.x + 0.1 * p.y, p.y, -p.z); });
  TetrahedralMesh mesh = Build(arrays);
  TetrahedralMesh built = Build(moved);
  for (TetrahedralMesh* each : { &mesh, &built })
  {
    std::vector<std::uint8_t> active;
    for (const std::int32_t source : each->GetSourceCells())
    {
      active.push_back(source % 7 < 3);
    }
    each->SetActiveCells(active, 0);
  }
  ASSERT_TRUE(mesh.MovePoints(moved.Points.data()));
  ExpectSame(mesh, built);
  // They can change afterwards, as after a build.
  for (TetrahedralMesh* each : { &mesh, &built })
  {
    each->SetActiveCells(std::vector<std::uint8_t>(each->GetCells().size(), 1), 0);
  }
  ExpectSame(mesh, built);
}

TEST(MovedPoints, APositionThatIsNotFiniteNeedsABuild)
{
  for (const double value : { std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
  {
    const MeshArrays arrays = KuhnGrid(3);
    MeshArrays broken = arrays;
    broken.Points[3 * 21 + 1] = value;
    TetrahedralMesh mesh = Build(arrays);
    EXPECT_FALSE(mesh.MovePoints(broken.Points.data()));
    mesh = Build(broken);
    EXPECT_GT(mesh.GetRejectedCells().PointNotFinite, 0);
    // The cells that were left out are needed again.
    EXPECT_FALSE(mesh.MovePoints(arrays.Points.data()));
  }
}

TEST(MovedPoints, APointWithoutCellsMayBeAnywhere)
{
  MeshArrays arrays = KuhnGrid(3);
  arrays.Points.insert(arrays.Points.end(), { 1e9, std::nan(""), 0.0 });
  TetrahedralMesh mesh = Build(arrays);
  MeshArrays moved = Moved(arrays, [](const glm::dvec3& p) { return 1.5 * p; });
  ASSERT_TRUE(mesh.MovePoints(moved.Points.data()));
  ExpectSame(mesh, Build(moved));
}

TEST(MovedPoints, VolumesThatCancelNeedABuild)
{
  // The second tetrahedron folds over onto the side of the first one.
  const MeshArrays apart = TwoTetrahedra();
  MeshArrays folded = apart;
  folded.Points[3 * 4 + 2] = 1.0;
  folded.Points[3 * 4] = 0.3;
  TetrahedralMesh mesh = Build(apart);
  EXPECT_EQ(mesh.GetNumberOfCutLinks(), 0);
  EXPECT_FALSE(mesh.MovePoints(folded.Points.data()));
  mesh = Build(folded);
  EXPECT_EQ(mesh.GetNumberOfCutLinks(), 1);
  // The link that was cut is needed again.
  EXPECT_FALSE(mesh.MovePoints(apart.Points.data()));
  // A fold that leaves volume is no reason to cut it.
  folded.Points[3 * 4 + 2] = 0.5;
  EXPECT_FALSE(mesh.MovePoints(folded.Points.data()));
  mesh = Build(apart);
  ASSERT_TRUE(mesh.MovePoints(folded.Points.data()));
  ExpectSame(mesh, Build(folded));
}

TEST(MovedPoints, OtherCoincidentPointsNeedABuild)
{
  const MeshArrays cell = SingleTetrahedron();
  const MeshArrays apart = Joined(cell, Moved(cell, ToSecond));
  const MeshArrays together = Joined(cell, cell);
  const Motion shear = [](const glm::dvec3& p) { return p + glm::dvec3(0.3 * p.y, 0, 0); };
  TetrahedralMesh mesh = Build(apart, true);
  EXPECT_FALSE(mesh.MovePoints(together.Points.data()));
  mesh = Build(together, true);
  EXPECT_EQ(mesh.GetRejectedCells().Duplicate, 1);
  EXPECT_FALSE(mesh.MovePoints(apart.Points.data()));
  // The same points coincide.
  mesh = Build(together, true);
  ASSERT_TRUE(mesh.MovePoints(Moved(together, shear).Points.data()));
  ExpectSame(mesh, Build(Moved(together, shear), true));
  EXPECT_EQ(mesh.GetRejectedCells().Duplicate, 1);
  // One data set: positions do not matter.
  mesh = Build(apart, false);
  EXPECT_TRUE(mesh.MovePoints(together.Points.data()));
}

TEST(MovedPoints, AMeshWithoutExtentNeedsABuild)
{
  const MeshArrays arrays = KuhnGrid(3);
  const MeshArrays point = Moved(arrays, [](const glm::dvec3&) { return glm::dvec3(0.5); });
  TetrahedralMesh mesh = Build(point);
  EXPECT_FALSE(mesh.MovePoints(arrays.Points.data()));
  // The order of a mesh that had extent remains.
  mesh = Build(arrays);
  ASSERT_TRUE(mesh.MovePoints(point.Points.data()));
  EXPECT_EQ(mesh.GetRadius(), 0.0);
  ASSERT_TRUE(mesh.MovePoints(arrays.Points.data()));
  ExpectSame(mesh, Build(arrays));
}

TEST(MovedPoints, AnEmptyMeshNeedsABuild)
{
  const MeshArrays arrays = KuhnGrid(2);
  EXPECT_FALSE(TetrahedralMesh().MovePoints(arrays.Points.data()));
}

TEST(MovedPoints, BoundaryTreeIsFitted)
{
  const MeshArrays arrays = KuhnGrid(8);
  const MeshArrays moved =
    Moved(arrays, [](const glm::dvec3& p) { return glm::dvec3(p.x + 0.2 * p.y, p.y, -p.z); });
  TetrahedralMesh mesh = Build(arrays);
  BoundaryTree tree;
  tree.Build(mesh);
  const std::size_t size = tree.GetFaces().size();
  ASSERT_TRUE(mesh.MovePoints(moved.Points.data()));
  ASSERT_TRUE(tree.Refit(mesh));
  // All faces with their orientation after the motion, which mirrors the mesh.
  std::multiset<OrientedFace> faces;
  std::multiset<OrientedFace> boundary;
  for (std::size_t f = 0; f < size; ++f)
  {
    faces.insert(MakeOrientedFace(mesh, tree.GetFaces()[f]));
    boundary.insert(MakeOrientedFace(mesh, mesh.GetBoundary()[f]));
  }
  EXPECT_EQ(faces, boundary);
  // Each box contains the faces of its subtree.
  const auto& nodes = tree.GetNodes();
  for (std::size_t n = 0; n < nodes.size(); ++n)
  {
    for (auto below = static_cast<std::int32_t>(n); below < nodes[n].Skip; ++below)
    {
      if (nodes[below].Face < 0)
      {
        continue;
      }
      for (const std::int32_t vertex : tree.GetFaces()[nodes[below].Face].Vertices)
      {
        const glm::dvec3 offset =
          glm::abs(glm::dvec3(glm::vec3(mesh.GetPosition(vertex))) - glm::dvec3(nodes[n].Center));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(offset, glm::dvec3(nodes[n].Half))));
      }
    }
  }
}

TEST(MovedPoints, ATreeOfScatteredFacesIsBuilt)
{
  MeshArrays arrays = KuhnGrid(8);
  TetrahedralMesh mesh = Build(arrays);
  BoundaryTree tree;
  tree.Build(mesh);
  Jitter(arrays, 0.4, 5);
  ASSERT_TRUE(mesh.MovePoints(arrays.Points.data()));
  EXPECT_FALSE(tree.Refit(mesh));
  tree.Build(mesh);
  EXPECT_TRUE(tree.Refit(mesh));
}

TEST(MovedPoints, ThreadsDoNotMatter)
{
  const RangeLoop reversed = [](std::size_t count, const RangeBody& body)
  {
    const auto work = [&](std::size_t parity)
    {
      for (std::size_t i = count; i-- > 0;)
      {
        if (i % 2 == parity)
        {
          body(i, i + 1);
        }
      }
    };
    std::thread other(work, 0);
    work(1);
    other.join();
  };
  MeshArrays arrays = Joined(KuhnGrid(12), Moved(KuhnGrid(11), ToSecond));
  TetrahedralMesh serial = Build(arrays);
  TetrahedralMesh parallel = serial;
  Jitter(arrays, 0.03, 5);
  ASSERT_TRUE(serial.MovePoints(arrays.Points.data()));
  ASSERT_TRUE(parallel.MovePoints(arrays.Points.data(), reversed));
  EXPECT_EQ(serial.GetFixedPositions(), parallel.GetFixedPositions());
  ExpectSame(parallel, serial);
}
