// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Curved patches and the sight points on them: closed forms, analytic membranes, a dense search.
#include "ExactStack.h"
#include "OracleImages.h"
#include "ReadySolver.h"
#include "Refraction/Membrane/Optics.h"
#include "Refraction/Tubes/RefractedRayBounds.h"
#include "RefractionTestRandom.h"
#include "ThesisTables.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

const HeightField Waves{ HeightField::Shape::Waves, 200.0, 3.0, 0.02 * std::acos(-1.0), 1.0,
  1.333 };

//------------------------------------------------------------------------------
// The acceptance of issue 4: planes 1e-8, bowls, hemisphere from 450. Patches reproduce planes and
// spheres, so the remaining error is rounding and the error of Newton's method, 1e-12 of a facet,
// magnified by focusing.
TEST(RefractionCurved, ReachesTheTargetsOfTheThesisTables)
{
  for (const auto& row : meniscus::reference::GetThesisRows())
  {
    if (row.SphereRatio > 0.0 && row.Exterior > row.Interior)
    {
      continue; // takes minutes; it is covered by the benchmark
    }
    const auto ours = meniscus::reference::MeasureThesisRowCurved(row);
    EXPECT_LT(ours.Mean, 1e-8) << row.Table << " " << row.SphereRatio << " " << row.EyeHeight;
    EXPECT_LT(ours.Largest, 1e-6) << row.Table << " " << row.SphereRatio << " " << row.EyeHeight;
    EXPECT_GE(ours.Points, static_cast<std::size_t>(0.98 * row.Points)) << row.Table;
  }
}

//------------------------------------------------------------------------------
// Parts of a facet that may be a million times as wide as the eye is high, and much longer than
// wide.
TEST(RefractionCurved, ImagesInHugeFacetsAreDecided)
{
  struct Sea
  {
    double HalfWidth;
    double Slenderness;
  };
  for (const Sea& size : { Sea{ 1e2, 1.0 }, Sea{ 1e4, 1.0 }, Sea{ 1e5, 1.0 }, Sea{ 1e6, 1.0 },
         Sea{ 1e7, 1.0 }, Sea{ 1e4, 20.0 }, Sea{ 1e6, 8.0 }, Sea{ 1e2, 50.0 }, Sea{ 1e6, 20.0 },
         Sea{ 1e7, 50.0 }, Sea{ 1e7, 200.0 } })
  {
    const double half = size.HalfWidth;
    for (const double interior : { 1.333, 0.75 })
    {
      SCOPED_TRACE(::testing::Message()
        << "half width " << half << ", slenderness " << size.Slenderness << ", index " << interior);
      MembraneMesh sea = meniscus::reference::MakePlane(0.0, 2.0 * half, 1);
      sea.Translate(half * glm::dvec3(0.37, 0.0, -0.2));
      for (std::size_t i = 0; i < sea.Points.size(); i += 3)
      {
        sea.Points[i] /= size.Slenderness;
      }
      const glm::dvec3 eye(0.3, 1.1, -0.4);
      ReadySolver geometry(sea, eye, 1.0, interior);
      // Coordinates of the sea's rim and Newton's method have about 2e-16 of its width each.
      const double rounding = 1e-11 + 1e-14 * half;
      Random random(13);
      for (int i = 0; i < 100; ++i)
      {
        const glm::dvec3 point(random(-0.8, 0.8), random(-2.2, -0.05), random(-0.8, 0.8));
        std::vector<VirtualVertex> images;
        ASSERT_EQ(geometry.FindImages(point, images), ImageState::Found);
        ASSERT_EQ(images.size(), 1u);
        const auto sine = [&images](const glm::dvec3& from)
        {
          const glm::dvec3 way = images[0].SightPoint - from;
          return std::hypot(way.x, way.z) / glm::length(way);
        };
        EXPECT_NEAR(sine(eye), interior * sine(point), 20.0 * rounding);
        EXPECT_NEAR(images[0].SightPoint.y, 0.0, rounding);
      }
      EXPECT_EQ(geometry.GetNumberOfUndecidedSearches(), 0);
    }
  }
}

//------------------------------------------------------------------------------
double MeasureWaves(int cells)
{
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  ReadySolver geometry(Waves.MakeMesh(cells), eye);
  Random random(5);
  double sum = 0.0;
  constexpr int points = 4000;
  for (int i = 0; i < points; ++i)
  {
    const glm::dvec3 point(random(-60.0, 60.0), random(-60.0, -10.0), random(-60.0, 60.0));
    const VirtualVertex vertex = geometry.SolveOne(point);
    EXPECT_EQ(vertex.State, ImageState::Found);
    const glm::dvec3 sight = vertex.SightPoint - eye;
    const glm::dvec3 exact = Waves.Intersect(eye, glm::normalize(sight), glm::length(sight));
    const auto computed = Waves.Refract(eye, exact, glm::length(vertex.Position - exact) * 1.333);
    EXPECT_TRUE(computed);
    sum += glm::length(*computed - point);
  }
  return sum / points;
}

TEST(RefractionCurved, ConvergesOnWavesWithThirdOrder)
{
  const double coarse = MeasureWaves(40);
  const double middle = MeasureWaves(80);
  const double fine = MeasureWaves(160);
  EXPECT_LT(fine, 1e-5); // 51,200 facets
  EXPECT_GT(std::log2(coarse / middle), 2.8);
  EXPECT_GT(std::log2(middle / fine), 2.8);
  RecordProperty("mean_error_51200_facets", std::to_string(fine));
}

//------------------------------------------------------------------------------
TEST(RefractionCurved, DerivativesOfAPatchAgreeWithDifferences)
{
  meniscus::Membrane membrane;
  membrane.Build(meniscus::reference::MakeRandom(200.0, 12, 4.0, 0.3, 71).AsInput());
  CurvedPatches patches;
  patches.Build(membrane, meniscus::SerialLoop);
  Random random(73);
  for (std::int32_t facet = 0; facet < 288; ++facet)
  {
    const CurvedPatch patch = patches.GetPatch(facet);
    const glm::dvec2 b(random(0.0, 0.5), random(0.0, 0.5));
    meniscus::PatchJet jet;
    patch.Evaluate(b, jet);
    const meniscus::PatchPoint at = patch.Evaluate(b);
    EXPECT_LT(glm::length(at.Position - jet.Position), 1e-13 * 200.0);
    for (int k = 0; k < 2; ++k)
    {
      const double h = 1e-6;
      glm::dvec2 step(0.0);
      step[k] = h;
      const meniscus::PatchPoint after = patch.Evaluate(b + step);
      const meniscus::PatchPoint before = patch.Evaluate(b - step);
      // Error of second-order differences: h^2, and rounding / h.
      EXPECT_LT(
        glm::length((after.Position - before.Position) / (2.0 * h) - jet.PositionBy[k]), 1e-6);
      EXPECT_LT(glm::length((after.Normal - before.Normal) / (2.0 * h) - jet.NormalBy[k]), 1e-8);
    }
  }
}

//------------------------------------------------------------------------------
// Rough membranes, where few neighbours are smooth and many fits singular, in frames of any
// orientation. Half of the digits of a fit are right, 2^-26, and bends are kept in single
// precision, 2^-24 each; they are at most 0.4. A fit taken for another one differs by 1e-2.
TEST(RefractionCurved, FitsTurnWithTheMembrane)
{
  Random random(83);
  double most = 0.0;
  for (unsigned seed = 0; seed < 60; ++seed)
  {
    const MembraneMesh mesh =
      meniscus::reference::MakeRandom(4.0, 8, random(0.0, 0.2), random(0.2, 0.8), seed);
    const glm::dvec3 first = glm::normalize(random.Point({ -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 }));
    const glm::dvec3 second =
      glm::normalize(glm::cross(first, random.Point({ -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 })));
    const glm::dmat3 turn(first, second, glm::cross(first, second));
    MembraneMesh turned = mesh;
    for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
    {
      const glm::dvec3 point =
        turn * glm::dvec3(mesh.Points[i], mesh.Points[i + 1], mesh.Points[i + 2]);
      const glm::dvec3 normal =
        turn * glm::dvec3(mesh.Normals[i], mesh.Normals[i + 1], mesh.Normals[i + 2]);
      for (int axis = 0; axis < 3; ++axis)
      {
        turned.Points[i + static_cast<std::size_t>(axis)] = point[axis];
        turned.Normals[i + static_cast<std::size_t>(axis)] = normal[axis];
      }
    }
    meniscus::Membrane membranes[2];
    CurvedPatches patches[2];
    membranes[0].Build(mesh.AsInput());
    membranes[1].Build(turned.AsInput());
    patches[0].Build(membranes[0], meniscus::SerialLoop);
    patches[1].Build(membranes[1], meniscus::SerialLoop);
    for (std::int32_t facet = 0; facet < 128; ++facet)
    {
      const CurvedPatch patch = patches[0].GetPatch(facet);
      const CurvedPatch other = patches[1].GetPatch(facet);
      for (int k = 0; k < 3; ++k)
      {
        most = std::max(most, glm::length(turn * patch.Bend[k] - other.Bend[k]));
      }
    }
  }
  EXPECT_LT(most, 0x1p-20);
}

//------------------------------------------------------------------------------
// For any surface: smooth, rough beyond all fallbacks, with borders, or non-manifold.
TEST(RefractionCurved, PatchesShareTheirEdges)
{
  MembraneMesh fan = meniscus::reference::MakeRandom(200.0, 6, 40.0, 2.0, 5);
  fan.AddTriangle(0, 8, 20); // a third facet on the edge from 0 to 8
  for (const MembraneMesh& mesh :
    { Waves.MakeMesh(12), meniscus::reference::MakeDisc(100, 4, 101.0),
      meniscus::reference::MakeRandom(200.0, 12, 60.0, 3.0, 77), fan })
  {
    meniscus::Membrane membrane;
    membrane.Build(mesh.AsInput());
    CurvedPatches patches;
    patches.Build(membrane, meniscus::SerialLoop);
    const auto& facets = membrane.GetFacets();
    int shared = 0;
    for (std::size_t i = 0; i < facets.size(); ++i)
    {
      for (const auto& [j, k] : Product(Below<std::size_t>(i), 9))
      {
        const auto a = static_cast<std::size_t>(k / 3);
        const auto b = static_cast<std::size_t>(k % 3);
        if (facets[i][(a + 1) % 3] != facets[j][(b + 2) % 3] ||
          facets[i][(a + 2) % 3] != facets[j][(b + 1) % 3])
        {
          continue;
        }
        ++shared;
        glm::dvec3 first(0.0);
        glm::dvec3 second(0.0);
        first[static_cast<int>(a + 1) % 3] = second[static_cast<int>(b + 2) % 3] = 0.3;
        first[static_cast<int>(a + 2) % 3] = second[static_cast<int>(b + 1) % 3] = 0.7;
        const auto p = patches.GetPatch(static_cast<int>(i)).Evaluate({ first.y, first.z });
        const auto q = patches.GetPatch(static_cast<int>(j)).Evaluate({ second.y, second.z });
        EXPECT_LT(glm::length(p.Position - q.Position), 1e-13 * 200.0);
        EXPECT_LT(glm::length(p.Normal - q.Normal), 1e-14);
      }
    }
    EXPECT_GE(shared, static_cast<int>(facets.size()));
  }
}

//------------------------------------------------------------------------------
TEST(RefractionCurved, TubesHoldEveryRefractedRay)
{
  Random random(79);
  const MembraneMesh meshes[] = { Waves.MakeMesh(10),
    meniscus::reference::MakeRandom(200.0, 10, 30.0, 1.0, 81) };
  const glm::dvec3 eyes[] = { { 20, 300, 10 }, { 400, 1, 10 }, { 1, 35, 2 }, { 50, 1e5, -1e4 } };
  int rays = 0;
  for (const MembraneMesh& mesh : meshes)
  {
    meniscus::Membrane membrane;
    membrane.Build(mesh.AsInput());
    CurvedPatches patches;
    patches.Build(membrane, meniscus::SerialLoop);
    for (int i = 0; i < 40000; ++i)
    {
      const glm::dvec3 eye = eyes[i % 4] - membrane.GetOrigin();
      const double ratio = i % 8 < 4 ? 0.75 : 1.5;
      const CurvedPatch patch = patches.GetPatch(i % 200);
      double u = random(0.0, 1.0);
      double v = random(0.0, 1.0);
      if (u + v > 1.0)
      {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const auto at = patch.Evaluate({ u, v });
      const auto ray = meniscus::ComputeRefractionRay(
        glm::normalize(at.Position - eye), glm::normalize(at.Normal), ratio);
      if (ray.Kind != meniscus::RayKind::Refracted ||
        glm::length(at.Normal) < CurvedPatch::ShortestNormal)
      {
        continue;
      }
      ++rays;
      const meniscus::TubeBounds tube = meniscus::BoundRefractedRays(patch, eye, ratio);
      ASSERT_TRUE(tube.IsValid());
      for (int k = 0; k < 3; ++k)
      {
        ASSERT_GE(at.Position[k], tube.StartLow[k] - 1e-12);
        ASSERT_LE(at.Position[k], tube.StartHigh[k] + 1e-12);
        ASSERT_GE(ray.Direction[k], tube.DirectionLow[k] - 1e-14);
        ASSERT_LE(ray.Direction[k], tube.DirectionHigh[k] + 1e-14);
      }
    }
  }
  EXPECT_GT(rays, 20000);
}

//------------------------------------------------------------------------------
struct OracleCase
{
  const char* Name;
  HeightField Field;
  glm::dvec3 Eye;
  int Cells;
  double Depth; ///< depth of the deepest point
  double Reach; ///< lateral extent of the points
};

TEST(RefractionCurved, FindsAllImagesAndNoOthers)
{
  const double pi = std::acos(-1.0);
  const OracleCase cases[] = {
    { "waves", { HeightField::Shape::Waves, 200.0, 5.0, 0.03 * pi, 1.0, 1.333 },
      { 20.0, 300.0, 10.0 }, 64, 250.0, 80.0 },
    { "into the thinner medium", { HeightField::Shape::Waves, 200.0, 5.0, 0.03 * pi, 1.333, 1.0 },
      { 20.0, 300.0, 10.0 }, 64, 250.0, 80.0 },
    { "dome", { HeightField::Shape::Dome, 200.0, 30.0, 0.025, 1.0, 1.5 }, { 5.0, 400.0, 3.0 }, 64,
      300.0, 20.0 },
    { "low eye", { HeightField::Shape::Waves, 200.0, 3.0, 0.04 * pi, 1.0, 1.333 },
      { 120.0, 90.0, 20.0 }, 96, 250.0, 80.0 },
  };
  for (const OracleCase& test : cases)
  {
    SCOPED_TRACE(test.Name);
    ReadySolver geometry(
      test.Field.MakeMesh(test.Cells), test.Eye, test.Field.Exterior, test.Field.Interior);
    Random random(83);
    OracleCounts counts;
    constexpr int points = 300;
    for (int i = 0; i < points; ++i)
    {
      const glm::dvec3 point(random(-test.Reach, test.Reach), random(-test.Depth, -40.0),
        random(-test.Reach, test.Reach));
      ExpectImagesOfTheField(geometry, test.Field, test.Cells, test.Eye, point, counts);
    }
    EXPECT_GT(counts.Images, points / 2);
    EXPECT_GT(counts.Several, points / 20);
    EXPECT_LT(counts.Close, points / 10);
  }
}

//------------------------------------------------------------------------------
// On the axis of a dome, beyond its focus, the images form a ring: the search must end, and must
// not return false images.
TEST(RefractionCurved, RingsOfImagesDoNotHoldUp)
{
  const HeightField dome{ HeightField::Shape::Dome, 200.0, 30.0, 0.025, 1.0, 1.5 };
  const glm::dvec3 eye(0.0, 400.0, 0.0);
  const glm::dvec3 point(0.0, -200.0, 0.0);
  ReadySolver geometry(dome.MakeMesh(32), eye, 1.0, 1.5);
  std::vector<VirtualVertex> images;
  EXPECT_EQ(geometry.FindImages(point, images), ImageState::Found);
  EXPECT_GT(images.size(), 1u);
  for (const VirtualVertex& image : images)
  {
    const auto seen = dome.Refract(eye, image.SightPoint, image.Depth);
    ASSERT_TRUE(seen);
    // Where the rays of a ring meet, an error of the patch is not magnified.
    EXPECT_LT(glm::length(*seen - point), 1.0);
  }
  EXPECT_EQ(geometry.SolveOne(point).State, ImageState::Found);
}

//------------------------------------------------------------------------------
// A bowl that is a sphere exactly, from dense to thin: on the axis, before the focus of the rays
// near it, the images are a ring to the last digit. They are not all found, which is counted. A
// point off the axis has one.
TEST(RefractionCurved, CountsSearchesThatAreUndecided)
{
  ReadySolver geometry(
    meniscus::reference::MakeDisc(100.0, 12, 200.0), { 0.0, 2000.0, 0.0 }, 1.5, 1.0);
  std::vector<VirtualVertex> images;
  EXPECT_EQ(geometry.FindImages({ 30.0, -60.0, 7.0 }, images), ImageState::Found);
  EXPECT_EQ(images.size(), 1u);
  EXPECT_EQ(geometry.GetNumberOfUndecidedSearches(), 0);
  EXPECT_EQ(geometry.FindImages({ 0.0, -550.0, 0.0 }, images), ImageState::Found);
  EXPECT_GT(images.size(), 100u);
  EXPECT_EQ(geometry.GetNumberOfUndecidedSearches(), 1);
}

//------------------------------------------------------------------------------
// A point 0.04 facets behind a rough membrane. The cone of its distance, between the places at
// which the residual was taken, made a part that holds the only image seem to hold none; with the
// corners of the facet in another order it was found. A membrane whose image is seen from one order
// of the corners is seen from all.
TEST(RefractionCurved, PointsCloseToTheMembraneHaveTheirImageInAnyOrderOfCorners)
{
  Random random(97);
  int missing = 0;
  int found = 0;
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    const MembraneMesh mesh = meniscus::reference::MakeRandom(4.0, 8, 0.1, 0.4, seed);
    ReadySolver geometry[3];
    for (std::size_t turn = 0; turn < 3; ++turn)
    {
      MembraneMesh turned = mesh;
      for (std::size_t i = 0; i < turned.Triangles.size(); i += 3)
      {
        for (std::size_t k = 0; k < 3; ++k)
        {
          turned.Triangles[i + k] = mesh.Triangles[i + (k + turn) % 3];
        }
      }
      geometry[turn].Set(turned, { -1.8, 2.5, 0.9 }, 1.0, 1.33);
    }
    for (int i = 0; i < 500; ++i)
    {
      const glm::dvec3 point(random(-1.8, 1.8), random(-0.2, 0.1), random(-1.8, 1.8));
      std::vector<VirtualVertex> images[3];
      for (int turn = 0; turn < 3; ++turn)
      {
        geometry[turn].FindImages(point, images[turn]);
      }
      found += images[0].empty() ? 0 : 1;
      missing += images[0].size() != images[1].size() || images[0].size() != images[2].size();
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_EQ(missing, 0);
}

//------------------------------------------------------------------------------
// Points in random order: once a step could not be continued, steps more than a tenth longer are
// solved as at the start of a chain, bit by bit. These are most of them.
TEST(RefractionCurved, LongStepsAreNotContinuedAfterAFailure)
{
  ReadySolver geometry(Waves.MakeMesh(128), { 20.0, 300.0, 10.0 });
  Random random(7);
  CurvedMembraneSolver::Memory memory;
  std::size_t notContinued = 0;
  for (std::size_t i = 0; i < CurvedMembraneSolver::Chain; ++i)
  {
    const glm::dvec3 point = random.Point({ -60.0, -60.0, -60.0 }, { 60.0, -10.0, 60.0 });
    const double step = glm::length(point - geometry.GetMembrane().GetOrigin() - memory.Point);
    const bool isLong = i > 0 && step > 1.11 * std::sqrt(memory.FailedStep);
    const VirtualVertex vertex = geometry.SolvePoint(point, memory);
    if (isLong)
    {
      ++notContinued;
      CurvedMembraneSolver::Memory fresh;
      const VirtualVertex first = geometry.SolvePoint(point, fresh);
      EXPECT_EQ(first.Facet, vertex.Facet);
      EXPECT_EQ(first.Position, vertex.Position);
      EXPECT_EQ(first.SightPoint, vertex.SightPoint);
    }
  }
  EXPECT_GT(notContinued, CurvedMembraneSolver::Chain / 2);
}

//------------------------------------------------------------------------------
TEST(RefractionCurved, TheOneImageIsOneOfAll)
{
  ReadySolver geometry(meniscus::reference::MakeWaves(200.0, 40, 5.0, 3.0), { 20.0, 300.0, 10.0 });
  std::vector<double> points;
  Random random(89);
  for (int i = 0; i < 3000; ++i)
  {
    points.insert(points.end(), { random(-90, 90), random(-250, -10), random(-90, 90) });
  }
  std::vector<VirtualVertex> one(1000);
  geometry.Solve(points.data(), 0, 1000, one.data());
  std::vector<VirtualVertex> all;
  int several = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    const double* p = points.data() + 3 * i;
    EXPECT_EQ(geometry.FindImages({ p[0], p[1], p[2] }, all), one[i].State);
    const bool known = std::any_of(all.begin(), all.end(),
      [&one, i](const VirtualVertex& vertex)
      { return glm::length(vertex.SightPoint - one[i].SightPoint) < 1e-6; });
    EXPECT_EQ(known, one[i].State == ImageState::Found) << i;
    several += all.size() > 1;
  }
  EXPECT_GT(several, 50);
}

//------------------------------------------------------------------------------
TEST(RefractionCurved, ResultsDoNotDependOnTheRanges)
{
  ReadySolver geometry(meniscus::reference::MakeWaves(200.0, 40, 5.0, 3.0), { 20.0, 300.0, 10.0 });
  constexpr std::size_t count = 5 * CurvedMembraneSolver::Chain;
  std::vector<double> points;
  Random random(91);
  for (std::size_t i = 0; i < 3 * count; ++i)
  {
    points.push_back(random(-90.0, 90.0));
  }
  std::vector<VirtualVertex> a(count);
  std::vector<VirtualVertex> b(count);
  geometry.Solve(points.data(), 0, count, a.data());
  for (std::size_t k = 5; k-- > 0;)
  {
    geometry.Solve(points.data(), k * CurvedMembraneSolver::Chain,
      (k + 1) * CurvedMembraneSolver::Chain, b.data());
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    EXPECT_EQ(a[i].Position, b[i].Position) << i;
    EXPECT_EQ(a[i].State, b[i].State) << i;
  }
}

//------------------------------------------------------------------------------
TEST(RefractionCurved, ADeformedMembraneIsAsGoodAsANewOne)
{
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  ReadySolver moved(meniscus::reference::MakeWaves(200.0, 24, 1.0, 2.0), eye);
  moved.Set(meniscus::reference::MakeWaves(200.0, 24, 4.0, 3.0), eye);
  ReadySolver fresh(meniscus::reference::MakeWaves(200.0, 24, 4.0, 3.0), eye);
  Random random(97);
  std::vector<VirtualVertex> a;
  std::vector<VirtualVertex> b;
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 point(random(-80, 80), random(-200, -10), random(-80, 80));
    moved.FindImages(point, a);
    fresh.FindImages(point, b);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k)
    {
      EXPECT_EQ(a[k].Position, b[k].Position);
    }
  }
}

//------------------------------------------------------------------------------
TEST(RefractionCurved, EqualIndicesAreTheIdentity)
{
  ReadySolver geometry(
    meniscus::reference::MakeWaves(200.0, 24, 3.0, 2.0), { 20.0, 300.0, 10.0 }, 1.5, 1.5);
  Random random(101);
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 point(random(-60, 60), random(-50, -10), random(-60, 60));
    const VirtualVertex vertex = geometry.SolveOne(point);
    ASSERT_EQ(vertex.State, ImageState::Found);
    EXPECT_LE(glm::length(vertex.Position - point), 1e-13 * 200.0);
    EXPECT_EQ(vertex.Reflectance, 0.0);
  }
}

//------------------------------------------------------------------------------
// A wall of a pool is a flat box. Facets that show a point of it are visited, and few others: of
// the wall below the near border, which is seen from behind, only those at the border.
TEST(RefractionCurved, FacetsThatShowPointsOfABoxAreVisited)
{
  ReadySolver geometry(Waves.MakeMesh(40), { 60.0, 260.0, -200.0 });
  Random random(41);
  std::vector<VirtualVertex> images;
  for (int i = 0; i < 200; ++i)
  {
    glm::dvec3 half = random.Point(glm::dvec3(0.0), { 10.0, 10.0, 10.0 });
    half[i % 3] = 0.0;
    const glm::dvec3 middle = random.Point({ -90.0, -80.0, -90.0 }, { 90.0, -14.0, 90.0 });
    const glm::dvec3 local = middle - geometry.GetMembrane().GetOrigin();
    std::vector<bool> isVisited(geometry.GetMembrane().GetFacets().size());
    geometry.VisitFacets(local, half,
      [&isVisited](std::int32_t facet) { isVisited[static_cast<std::size_t>(facet)] = true; });
    for (int k = 0; k < 20; ++k)
    {
      geometry.FindImages(random.Point(middle - half, middle + half), images);
      for (const VirtualVertex& image : images)
      {
        EXPECT_TRUE(isVisited[static_cast<std::size_t>(image.Facet)]);
      }
    }
  }
  std::size_t visited = 0;
  geometry.VisitFacets(glm::dvec3(0.0, -40.0, -100.0) - geometry.GetMembrane().GetOrigin(),
    { 100.0, 30.0, 0.0 }, [&visited](std::int32_t) { ++visited; });
  EXPECT_LE(visited, 80u);
}

//------------------------------------------------------------------------------
TEST(RefractionCurved, BadPointsAndEyes)
{
  ReadySolver geometry(meniscus::reference::MakeSquare(200.0, 8, 0.0), { 0.0, 100.0, 0.0 });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : { nan, std::numeric_limits<double>::infinity(), 1e300 })
  {
    EXPECT_EQ(geometry.SolveOne({ 0.0, value, 0.0 }).State, ImageState::NotFinite);
  }
  EXPECT_EQ(geometry.SolveOne({ 0.0, 5.0, 0.0 }).State, ImageState::NoImage);
  EXPECT_EQ(geometry.SolveOne({ 0.0, 0.0, 0.0 }).State, ImageState::NoImage);
  EXPECT_EQ(geometry.SetEye({ 7.0, 0.0, 3.0 }, 1.0, 1.3), EyeStatus::OnTheMembrane);
  EXPECT_EQ(geometry.SetEye({ 12.5, 0.0, 0.0 }, 1.0, 1.3), EyeStatus::OnTheMembrane);
  EXPECT_EQ(geometry.SetEye({ 7.0, 1e-9, 3.0 }, 1.0, 1.3), EyeStatus::Ready);
  EXPECT_EQ(geometry.SetEye({ nan, 1.0, 3.0 }, 1.0, 1.3), EyeStatus::NotFinite);
  EXPECT_EQ(geometry.SetEye({ 7.0, 1.0, 3.0 }, 1.0, -1.3), EyeStatus::BadIndex);
  EXPECT_EQ(geometry.SetEye({ 7.0, -50.0, 3.0 }, 1.0, 1.3), EyeStatus::Ready);
  EXPECT_EQ(geometry.SolveOne({ 0.0, -10.0, 0.0 }).State, ImageState::NoImage); // from behind
  CurvedMembraneSolver empty;
  EXPECT_EQ(empty.SetMembrane(meniscus::MembraneInput()), MembraneStatus::Empty);
}

}
