// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Triangles that a membrane accepts, skips and counts, and the normals that it computes.
#include "MembraneMeshes.h"
#include "Refraction/Membrane/Membrane.h"
#include "TestBasics.h"

#include <set>

namespace
{

using namespace meniscus;
using meniscus::reference::MembraneMesh;
using namespace meniscus::test;

const double NaN = std::numeric_limits<double>::quiet_NaN();

TEST(RefractionMembrane, ThesisDiscHasItsCounts)
{
  const MembraneMesh mesh = meniscus::reference::MakeDisc(141.5, 5, 0.0);
  EXPECT_EQ(mesh.Points.size(), 3u * 125u);
  EXPECT_EQ(mesh.GetNumberOfFacets(), 184u);
  Membrane membrane;
  EXPECT_EQ(membrane.Build(mesh.AsInput()), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetReport().Skipped(), 0u);
  EXPECT_EQ(membrane.GetReport().ComputedNormals, 0u);
}

TEST(RefractionMembrane, SkipsAndCountsEveryBadFacet)
{
  MembraneMesh mesh = meniscus::reference::MakeSquare(2.0, 2, 0.0); // 9 points, 8 facets
  mesh.AddPoint({ NaN, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
  mesh.AddPoint({ std::numeric_limits<double>::infinity(), 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
  mesh.AddTriangle(0, 1, 9);  // NaN
  mesh.AddTriangle(0, 10, 1); // infinite
  mesh.AddTriangle(0, 1, 11); // out of range
  mesh.AddTriangle(-1, 1, 2); // out of range
  mesh.AddTriangle(0, 1, 2);  // collinear
  mesh.AddTriangle(4, 4, 5);  // repeated corner
  const auto& t = mesh.Triangles;
  mesh.AddTriangle(t[1], t[2], t[0]); // the first one again, rotated
  mesh.AddTriangle(t[2], t[1], t[0]); // the first one again, with the opposite winding

  Membrane membrane;
  ASSERT_EQ(membrane.Build(mesh.AsInput()), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetFacets().size(), 8u);
  EXPECT_EQ(membrane.GetReport().NotFinite, 2u);
  EXPECT_EQ(membrane.GetReport().OutOfRange, 2u);
  EXPECT_EQ(membrane.GetReport().ZeroArea, 2u);
  EXPECT_EQ(membrane.GetReport().Duplicated, 2u);
  EXPECT_EQ(membrane.GetReport().Skipped(), 8u);
}

TEST(RefractionMembrane, CellIdsFollowTheFacetsThatStay)
{
  MembraneMesh mesh = meniscus::reference::MakeSquare(2.0, 1, 0.0);
  const std::vector<std::int64_t> ids = { 7, 70, 5 };
  mesh.Triangles.insert(mesh.Triangles.begin(), { 0, 0, 1 });
  MembraneInput input = mesh.AsInput();
  input.CellIds = ids.data();
  Membrane membrane;
  ASSERT_EQ(membrane.Build(input), MembraneStatus::Ready);
  ASSERT_EQ(membrane.GetFacets().size(), 2u);
  EXPECT_EQ(membrane.GetCellId(0), 70);
  EXPECT_EQ(membrane.GetCellId(1), 5);
}

TEST(RefractionMembrane, NothingUsableIsEmpty)
{
  Membrane membrane;
  EXPECT_EQ(membrane.Build(MembraneInput()), MembraneStatus::Empty);
  MembraneMesh flat;
  for (int i = 0; i < 3; ++i)
  {
    flat.AddPoint({ 1.0 * i, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
  }
  flat.AddTriangle(0, 1, 2);
  EXPECT_EQ(membrane.Build(flat.AsInput()), MembraneStatus::Empty);
  EXPECT_EQ(membrane.GetReport().ZeroArea, 1u);
  EXPECT_TRUE(membrane.GetFacets().empty());
}

TEST(RefractionMembrane, ExtremeScalesKeepTheirFacets)
{
  for (const double scale : { 1e-150, 1e-6, 1.0, 1e6, 1e150 })
  {
    const MembraneMesh mesh = meniscus::reference::MakeSquare(scale, 3, 0.0);
    Membrane membrane;
    ASSERT_EQ(membrane.Build(mesh.AsInput(false)), MembraneStatus::Ready) << scale;
    EXPECT_EQ(membrane.GetFacets().size(), 18u) << scale;
    EXPECT_EQ(membrane.GetNormals()[5], glm::dvec3(0.0, 1.0, 0.0)) << scale;
  }
}

// Squares of such edges are not in the range of double, and sums of the largest ones overflow.
TEST(RefractionMembrane, NormalsOfTheSmallestAndLargestMembranesHaveUnitLength)
{
  for (const double scale : { 1e-305, 1e-170, 1e160, 1e307 })
  {
    const MembraneMesh mesh = meniscus::reference::MakeSquare(scale, 3, 0.0);
    Membrane membrane;
    ASSERT_EQ(membrane.Build(mesh.AsInput(false)), MembraneStatus::Ready) << scale;
    for (const glm::dvec3& normal : membrane.GetNormals())
    {
      EXPECT_EQ(normal, glm::dvec3(0.0, 1.0, 0.0)) << scale;
    }
  }
}

// Local coordinates are rounded to 2^-53 of the radius, here 5e5: the small square at the origin
// becomes one point. It stays a square where it is alone.
TEST(RefractionMembrane, SkipsFacetsThatLocalCoordinatesFlatten)
{
  MembraneMesh mesh = meniscus::reference::MakeSquare(1e-14, 2, 0.0);
  const auto small = mesh.GetNumberOfFacets();
  Membrane alone;
  ASSERT_EQ(alone.Build(mesh.AsInput(false)), MembraneStatus::Ready);
  EXPECT_EQ(alone.GetFacets().size(), small);
  const auto first = static_cast<std::int64_t>(mesh.Points.size() / 3);
  mesh.AddPoint({ 0.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
  mesh.AddPoint({ 1e6, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
  mesh.AddPoint({ 0.0, 0.0, -1e6 }, { 0.0, 1.0, 0.0 });
  mesh.AddTriangle(first, first + 1, first + 2);
  Membrane membrane;
  ASSERT_EQ(membrane.Build(mesh.AsInput(false)), MembraneStatus::Ready);
  ASSERT_EQ(membrane.GetFacets().size(), 1u);
  EXPECT_EQ(membrane.GetCellId(0), static_cast<std::int64_t>(small));
  EXPECT_EQ(membrane.GetReport().ZeroArea, small);
  for (const std::int32_t vertex : membrane.GetFacets()[0])
  {
    EXPECT_EQ(membrane.GetNormals()[static_cast<std::size_t>(vertex)], glm::dvec3(0.0, 1.0, 0.0));
  }
}

TEST(RefractionMembrane, SkipsAFacetWithAnEdgeThatIsNotFinite)
{
  // The first two edges have a finite length of 1.2e308, the third one has not.
  MembraneMesh mesh;
  mesh.AddPoint({ 0.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
  mesh.AddPoint({ 1.2e308, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
  mesh.AddPoint({ -1.2e308, 0.0, 1e308 }, { 0.0, 1.0, 0.0 });
  mesh.AddTriangle(0, 1, 2);
  Membrane membrane;
  EXPECT_EQ(membrane.Build(mesh.AsInput(false)), MembraneStatus::Empty);
  EXPECT_EQ(membrane.GetReport().ZeroArea, 1u);
}

TEST(RefractionMembrane, ComputedNormalsOfAPlaneAreExact)
{
  const MembraneMesh mesh = meniscus::reference::MakeDisc(3.0, 4, 0.0);
  Membrane membrane;
  ASSERT_EQ(membrane.Build(mesh.AsInput(false)), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetReport().ComputedNormals, membrane.GetPositions().size());
  for (const glm::dvec3& normal : membrane.GetNormals())
  {
    EXPECT_EQ(normal, glm::dvec3(0.0, 1.0, 0.0));
  }
}

TEST(RefractionMembrane, ReplacesOnlyBadNormals)
{
  MembraneMesh mesh = meniscus::reference::MakeSquare(2.0, 2, 0.0);
  const glm::dvec3 given = glm::normalize(glm::dvec3(0.1, 1.0, 0.2));
  for (const auto& [i, k] : Product(Below<std::size_t>(9), 3))
  {
    mesh.Normals[3 * i + static_cast<std::size_t>(k)] = 5.0 * given[k];
  }
  std::fill(mesh.Normals.begin(), mesh.Normals.begin() + 3, 0.0);
  mesh.Normals[3 * 4] = NaN;
  Membrane membrane;
  ASSERT_EQ(membrane.Build(mesh.AsInput()), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetReport().ComputedNormals, 2u);
  EXPECT_EQ(membrane.GetNormals()[0], glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(membrane.GetNormals()[4], glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_LT(glm::length(membrane.GetNormals()[1] - given), 1e-15);
}

TEST(RefractionMembrane, NonManifoldAndInconsistentFacetsStillGetNormals)
{
  MembraneMesh mesh;
  mesh.AddPoint({ 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 });
  mesh.AddPoint({ 1.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 });
  mesh.AddPoint({ 0.0, 0.0, 1.0 }, { 0.0, 0.0, 0.0 });
  mesh.AddPoint({ 0.0, 0.0, -1.0 }, { 0.0, 0.0, 0.0 });
  mesh.AddPoint({ 0.0, 1.0, 0.0 }, { 0.0, 0.0, 0.0 });
  mesh.AddTriangle(0, 2, 1);
  mesh.AddTriangle(0, 1, 3);
  mesh.AddTriangle(0, 1, 4); // third facet on the edge 0-1
  Membrane membrane;
  ASSERT_EQ(membrane.Build(mesh.AsInput(false)), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetReport().NonManifoldFacets, 3u);
  EXPECT_EQ(membrane.GetFacets().size(), 3u);
  for (const glm::dvec3& normal : membrane.GetNormals())
  {
    EXPECT_NEAR(glm::length(normal), 1.0, 1e-15);
  }
  EXPECT_EQ(membrane.GetNormals()[2], glm::dvec3(0.0, 1.0, 0.0));
}

TEST(RefractionMembrane, ATurnedFacetKeepsItsBordersAndNeighbours)
{
  // Three triangles of a strip; the middle one has the other winding.
  MembraneMesh mesh;
  for (int i = 0; i < 5; ++i)
  {
    mesh.AddPoint({ i, 0.0, i % 2 }, { 0.0, 1.0, 0.0 });
  }
  mesh.AddTriangle(0, 1, 2);
  mesh.AddTriangle(1, 2, 3);
  mesh.AddTriangle(2, 3, 4);
  Membrane membrane;
  ASSERT_EQ(membrane.Build(mesh.AsInput()), MembraneStatus::Ready);
  ASSERT_EQ(membrane.GetReport().TurnedFacets, 1u);

  const SurfacePieces& pieces = membrane.GetPieces();
  std::set<std::set<std::int32_t>> borders;
  for (const SurfaceEdge& border : pieces.Borders)
  {
    borders.insert({ border.Ends[0], border.Ends[1] });
  }
  EXPECT_EQ(borders,
    (std::set<std::set<std::int32_t>>{ { 0, 1 }, { 0, 2 }, { 1, 3 }, { 2, 4 }, { 3, 4 } }));
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Membrane::Facet& facet = membrane.GetFacets()[i];
    for (std::size_t k = 0; k < 3; ++k)
    {
      std::set<std::int32_t> edge{ facet[(k + 1) % 3], facet[(k + 2) % 3] };
      const std::int32_t other = pieces.Neighbours[i][k];
      EXPECT_EQ(other < 0, borders.count(edge) == 1);
      if (other >= 0)
      {
        const Membrane::Facet& across = membrane.GetFacets()[static_cast<std::size_t>(other)];
        edge.insert(across.begin(), across.end());
        EXPECT_EQ(edge.size(), 3u); // both ends of the edge are corners of the other facet
      }
    }
  }
}

TEST(RefractionMembrane, FacetsThatCancelOutTakeTheFirstNormal)
{
  MembraneMesh mesh;
  mesh.AddPoint({ 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 });
  mesh.AddPoint({ 0.0, 0.0, 1.0 }, { 0.0, 0.0, 0.0 });
  mesh.AddPoint({ 1.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 });
  mesh.AddPoint({ 0.0, 0.0, -1.0 }, { 0.0, 0.0, 0.0 });
  mesh.AddTriangle(0, 1, 2); // up
  mesh.AddTriangle(0, 2, 3); // up; further down the same angle downwards
  mesh.Triangles[4] = 3;
  mesh.Triangles[5] = 2;
  Membrane membrane;
  ASSERT_EQ(membrane.Build(mesh.AsInput(false)), MembraneStatus::Ready);
  EXPECT_EQ(membrane.GetNormals()[0], glm::dvec3(0.0, 1.0, 0.0));
}

meniscus::MismatchedNormals GetMismatchedNormals(const MembraneMesh& mesh)
{
  Membrane membrane;
  EXPECT_EQ(membrane.Build(mesh.AsInput()), MembraneStatus::Ready);
  return membrane.GetReport().Normals;
}

TEST(RefractionMembrane, TheSurfacesOwnNormalsAreNotForeign)
{
  for (const int cells : { 3, 8, 40, 120 })
  {
    for (const double radius : { 0.0, 1.0, 30.0 })
    {
      const auto found = GetMismatchedNormals(meniscus::reference::MakeSquare(1.0, cells, radius));
      EXPECT_GT(found.Examined, 0u);
      EXPECT_EQ(found.Foreign, 0u) << cells << " cells, radius " << radius;
    }
    const auto found = GetMismatchedNormals(meniscus::reference::MakeWaves(1.0, cells, 0.03, 3.0));
    EXPECT_FALSE(found.AreMost()) << found.Foreign << " of " << found.Examined;
  }
  // In single precision, far from the origin.
  for (const double offset : { 10.0, 1e4 })
  {
    MembraneMesh far = meniscus::reference::MakeSquare(1.0, 40, 2.0);
    far.Translate(glm::dvec3(offset, -offset, 0.7 * offset));
    for (std::vector<double>* values : { &far.Points, &far.Normals })
    {
      for (double& value : *values)
      {
        value = static_cast<double>(static_cast<float>(value));
      }
    }
    EXPECT_FALSE(GetMismatchedNormals(far).AreMost()) << offset;
  }
}

TEST(RefractionMembrane, NormalsOfAPlaneAreForeignToWaves)
{
  // Facets of a seventh of a wave turn as much as the normals differ: such normals cannot be
  // detected.
  for (const int cells : { 40, 60, 200 })
  {
    MembraneMesh waves = meniscus::reference::MakeWaves(1.0, cells, 0.03, 3.0);
    waves.Normals = meniscus::reference::MakeSquare(1.0, cells, 0.0).Normals;
    const auto found = GetMismatchedNormals(waves);
    EXPECT_TRUE(found.AreMost()) << found.Foreign << " of " << found.Examined << ", " << cells;
    EXPECT_GT(found.Examined, 16u);
    EXPECT_LT(found.Examined, 128u);
  }
}

}
