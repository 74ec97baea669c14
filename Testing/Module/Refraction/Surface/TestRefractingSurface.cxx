// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MembraneMeshes.h"

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"
#include "Refraction/Surface/RefractingSurface.h"
#include "TestBasics.h"

namespace meniscus
{
namespace
{

reference::MembraneMesh MakeMesh(double amplitude, int cells = 12)
{
  return reference::MakeWaves(100.0, cells, amplitude, 3.0);
}

/** Expects the same patches, boxes and crossings, bit by bit. */
void ExpectSame(const RefractingSurface& a, const RefractingSurface& b)
{
  const auto count = static_cast<std::int32_t>(a.GetMembrane().GetFacets().size());
  ASSERT_EQ(a.GetMembrane().GetFacets(), b.GetMembrane().GetFacets());
  for (std::int32_t facet = 0; facet < count; ++facet)
  {
    const glm::dvec2 middle(0.3, 0.4);
    EXPECT_EQ(a.GetPatch(facet, false).Evaluate(middle).Position,
      b.GetPatch(facet, false).Evaluate(middle).Position);
    EXPECT_EQ(a.GetBounds(facet).Box.Low, b.GetBounds(facet).Box.Low);
    EXPECT_EQ(a.GetBounds(facet).Box.High, b.GetBounds(facet).Box.High);
    EXPECT_EQ(a.GetBounds(facet).Bulge, b.GetBounds(facet).Bulge);
  }
  const glm::dvec3 down(0.1, -0.99, 0.1);
  for (int i = -4; i <= 4; ++i)
  {
    SurfaceCrossing first;
    SurfaceCrossing second;
    const glm::dvec3 origin(9.0 * i, 50.0, 7.0 * i);
    ASSERT_TRUE(a.FindCrossing(origin, glm::normalize(down), 0, 0.0, 1e3, first));
    ASSERT_TRUE(b.FindCrossing(origin, glm::normalize(down), 0, 0.0, 1e3, second));
    EXPECT_EQ(first.Facet, second.Facet);
    EXPECT_EQ(first.Distance, second.Distance);
  }
}

/** A surface whose points move is refitted, with the result of a new one. */
TEST(RefractingSurface, MovedPointsKeepTheTopology)
{
  RefractingSurface moved;
  moved.SetMembrane(MakeMesh(1.0).AsInput(), SurfaceParts::Crossings);
  const std::int64_t topology = moved.GetTopology();
  ASSERT_EQ(
    moved.SetMembrane(MakeMesh(2.0).AsInput(), SurfaceParts::Crossings), MembraneStatus::Ready);
  EXPECT_EQ(moved.GetTopology(), topology);
  RefractingSurface fresh;
  fresh.SetMembrane(MakeMesh(2.0).AsInput(), SurfaceParts::Crossings);
  EXPECT_NE(fresh.GetTopology(), topology);
  ExpectSame(moved, fresh);
  moved.SetMembrane(MakeMesh(2.0, 13).AsInput(), SurfaceParts::Patches);
  EXPECT_NE(moved.GetTopology(), topology);
}

/** Parts that are prepared one by one are the same as those that are prepared at once. */
TEST(RefractingSurface, PartsArePreparedInAnyNumberOfSteps)
{
  RefractingSurface slow;
  slow.SetMembrane(MakeMesh(1.0).AsInput(), SurfaceParts::Facets);
  for (const SurfaceParts parts : { SurfaceParts::Patches, SurfaceParts::Boxes,
         SurfaceParts::Patches, SurfaceParts::Crossings, SurfaceParts::Crossings })
  {
    slow.Prepare(parts);
  }
  RefractingSurface fast;
  fast.SetMembrane(MakeMesh(1.0).AsInput(), SurfaceParts::Crossings);
  ExpectSame(slow, fast);
}

/** A new shape has no parts of the last one. */
TEST(RefractingSurface, AShapeWithoutFacetsIsEmpty)
{
  RefractingSurface surface;
  surface.Prepare(SurfaceParts::Crossings);
  SurfaceCrossing crossing;
  const glm::dvec3 up(0.0, 1.0, 0.0);
  EXPECT_FALSE(surface.FindCrossing(glm::dvec3(0.0, -50.0, 0.0), up, 0, 0.0, 1e3, crossing));
  surface.SetMembrane(MakeMesh(1.0).AsInput(), SurfaceParts::Crossings);
  EXPECT_TRUE(surface.FindCrossing(glm::dvec3(0.0, -50.0, 0.0), up, 0, 0.0, 1e3, crossing));
  EXPECT_EQ(surface.SetMembrane(MembraneInput(), SurfaceParts::Crossings), MembraneStatus::Empty);
  EXPECT_FALSE(surface.FindCrossing(glm::dvec3(0.0, -50.0, 0.0), up, 0, 0.0, 1e3, crossing));
}

/** Solvers that share a surface find the images that they find with their own, also if it moves. */
template <typename Solver>
void ExpectSharedImages()
{
  const glm::dvec3 eye(5.0, 200.0, 3.0);
  const auto surface = std::make_shared<RefractingSurface>();
  Solver shared;
  for (const double amplitude : { 1.0, 2.0 })
  {
    const reference::MembraneMesh mesh = MakeMesh(amplitude);
    surface->SetMembrane(mesh.AsInput(), SurfaceParts::Patches);
    shared.SetSurface(surface);
    Solver own;
    own.SetMembrane(mesh.AsInput());
    ASSERT_EQ(shared.SetEye(eye, 1.0, 1.333), EyeStatus::Ready);
    ASSERT_EQ(own.SetEye(eye, 1.0, 1.333), EyeStatus::Ready);
    std::vector<double> points;
    for (int i = -10; i <= 10; ++i)
    {
      points.insert(points.end(), { 2.5 * i, -20.0 - i, -2.0 * i });
    }
    const std::size_t count = points.size() / 3;
    std::vector<VirtualVertex> images[2] = { std::vector<VirtualVertex>(count),
      std::vector<VirtualVertex>(count) };
    shared.Solve(points.data(), 0, count, images[0].data());
    own.Solve(points.data(), 0, count, images[1].data());
    for (std::size_t i = 0; i < count; ++i)
    {
      EXPECT_EQ(images[0][i].State, ImageState::Found);
      EXPECT_EQ(images[0][i].Position, images[1][i].Position);
    }
  }
}

TEST(RefractingSurface, FlatAndCurvedSolversShareIt)
{
  ExpectSharedImages<CurvedMembraneSolver>();
  ExpectSharedImages<FlatMembraneSolver>();
}

}
}
