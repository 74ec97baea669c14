// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Rays that a varying index of refraction bends: single cells, degenerate ways, robustness.
#include "GradedScene.h"

#include "GradedRayIntegrator.h"
#include "TestBasics.h"
#include "Volume/Graded/GradedCell.h"
#include "Volume/Graded/GradedCellTable.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

SquaredIndexField LinearField(double base, const glm::dvec3& slope)
{
  return [=](const glm::dvec3& p) { return base + glm::dot(slope, p); };
}

/** A field of random values, one per point of the mesh. */
SquaredIndexField RandomField(double contrast, RandomNumbers& random)
{
  return [contrast, &random](const glm::dvec3&) { return 1.0 + contrast * random.Uniform(); };
}

glm::dvec3 RandomPoint(RandomNumbers& random)
{
  const double x = random.Uniform();
  const double y = random.Uniform();
  return { x, y, random.Uniform() };
}

void ExpectAllThrough(const GradedRayStatistics& statistics)
{
  EXPECT_EQ(statistics.Lost, 0);
  EXPECT_EQ(statistics.Trapped, 0);
}

}

TEST(GradedCell, TimeToZeroIsTheFirstRoot)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(TimeToZero(1.0, -2.0, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(TimeToZero(1.0, 0.0, -2.0), 1.0);
  EXPECT_DOUBLE_EQ(TimeToZero(0.0, 1.0, -2.0), 1.0);
  EXPECT_DOUBLE_EQ(TimeToZero(2.0, -3.0, 2.0), 1.0);
  EXPECT_EQ(TimeToZero(0.0, -1.0, 5.0), 0.0);
  EXPECT_EQ(TimeToZero(0.0, 0.0, -1.0), 0.0);
  EXPECT_EQ(TimeToZero(1.0, 1.0, 1.0), infinity);
  EXPECT_EQ(TimeToZero(1.0, -1.0, 4.0), infinity);
  EXPECT_EQ(TimeToZero(0.0, 0.0, 0.0), infinity);
  // Small curvatures: the other formula for the root loses all digits.
  EXPECT_NEAR(TimeToZero(1.0, -1.0, 1.0e-17), 1.0, 1.0e-15);
  EXPECT_NEAR(TimeToZero(1.0e-20, -1.0, -1.0), 1.0e-20, 1.0e-35);
}

TEST(GradedCell, PathIsAParabola)
{
  RandomNumbers random(1);
  int turned = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const glm::dvec3 slope = random.Uniform(0.0, 0.9) * random.GetDirection();
    GradedScene scene(SingleTetrahedron(), LinearField(2.0, slope));
    const glm::dvec3 target = 0.25 * RandomPoint(random);
    const glm::dvec3 direction = random.GetDirection();
    const GradedRayResult ray = scene.Trace(target - 3.0 * direction, direction);
    ASSERT_EQ(ray.State, GradedRayState::Left);
    // The momentum along the slope tells the time; positions of the mesh are rounded to 2^-31.
    const double n = std::sqrt(2.0 + glm::dot(slope, ray.Entry));
    const glm::dvec3 momentum = n * direction;
    const glm::dvec3 force = 0.5 * slope;
    const glm::dvec3 end = std::sqrt(2.0 + glm::dot(slope, ray.Exit)) * ray.Direction;
    const double time = glm::dot(end - momentum, force) / glm::dot(force, force);
    turned += glm::dot(momentum, force) * glm::dot(end, force) < 0.0 ? 1 : 0;
    const glm::dvec3 exact = ray.Entry + time * momentum + 0.5 * time * time * force;
    // Rounded vertices change the slope by 2^-30 or so, and the time is a quotient.
    EXPECT_NEAR(glm::length(exact - ray.Exit), 0.0, 1.0e-8 / glm::length(slope));
    const double path =
      time * (n * n + time * (glm::dot(momentum, force) + time * glm::dot(force, force) / 3.0));
    EXPECT_NEAR(ray.OpticalPath, path, 1.0e-8 / glm::length(slope));
  }
  EXPECT_GT(turned, 10);
}

// With the gradient of the vertices that the mesh has rounded.
TEST(GradedCell, PathIsExactToRounding)
{
  const MeshArrays cell{ { 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, 0, 1 }, { 0, 1, 2, 3 } };
  RandomNumbers random(2);
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i)
  {
    const glm::dvec3 slope = random.Uniform(0.05, 0.5) * random.GetDirection();
    GradedScene scene(cell, LinearField(2.0, slope));
    const glm::dvec3 direction = random.GetDirection();
    const glm::dvec3 target = 0.3 * RandomPoint(random);
    const GradedRayResult ray = scene.Trace(target - 3.0 * direction, direction);
    ASSERT_EQ(ray.State, GradedRayState::Left);
    // The field that the mesh has at its vertices.
    glm::dvec3 corners[4];
    double values[4];
    for (int v = 0; v < 4; ++v)
    {
      corners[v] = scene.Mesh.GetCenter() + scene.Mesh.GetRadius() * scene.Mesh.GetPosition(v);
      values[v] = scene.Squares[static_cast<std::size_t>(v)];
    }
    const glm::dmat3 edges(
      corners[1] - corners[0], corners[2] - corners[0], corners[3] - corners[0]);
    const glm::dvec3 force = 0.5 * glm::inverse(glm::transpose(edges)) *
      glm::dvec3(values[1] - values[0], values[2] - values[0], values[3] - values[0]);
    const auto squareAt = [&](const glm::dvec3& p)
    { return values[0] + 2.0 * glm::dot(force, p - corners[0]); };
    const glm::dvec3 momentum = std::sqrt(squareAt(ray.Entry)) * direction;
    const glm::dvec3 end = std::sqrt(squareAt(ray.Exit)) * ray.Direction;
    const double time = 2.0 * glm::dot(ray.Exit - ray.Entry, momentum + end) /
      glm::dot(momentum + end, momentum + end);
    const glm::dvec3 exact = ray.Entry + time * momentum + 0.5 * time * time * force;
    worst = std::max(worst, glm::length(exact - ray.Exit));
  }
  EXPECT_LT(worst, 1.0e-12);
}

TEST(GradedRayWalk, LinearFieldIsOneParabolaInAnyMesh)
{
  MeshArrays arrays = KuhnBlock(64, 2, 2, 4.0);
  RandomNumbers random(3);
  for (std::size_t i = 0; i < arrays.Points.size(); ++i)
  {
    arrays.Points[i] += random.Uniform(-0.03, 0.03);
  }
  const glm::dvec3 slope(0.002, 0.001, -0.0015);
  GradedScene scene(arrays, LinearField(1.7, slope));
  for (int i = 0; i < 200; ++i)
  {
    const glm::dvec3 origin(-1.0, random.Uniform(0.15, 0.25), random.Uniform(0.25, 0.35));
    const glm::dvec3 direction =
      glm::normalize(glm::dvec3(1.0, random.Uniform(-0.005, 0.005), random.Uniform(-0.005, 0.005)));
    const GradedRayResult ray = scene.Trace(origin, direction);
    const glm::dvec3 momentum = std::sqrt(1.7 + glm::dot(slope, ray.Entry)) * direction;
    const glm::dvec3 end = std::sqrt(1.7 + glm::dot(slope, ray.Exit)) * ray.Direction;
    // The momentum across the slope stays across the slope, to the rounding of positions, 2^-31.
    EXPECT_NEAR(glm::length(glm::cross(end - momentum, slope)) / glm::length(slope), 0.0, 2.0e-8);
  }
  EXPECT_GT(scene.Statistics.Steps, 200 * 100);
  ExpectAllThrough(scene.Statistics);
}

/** The same field as in the mesh of a scene, for the reference. */
reference::GradedRayIntegrator MakeIntegrator(const GradedScene& scene)
{
  std::vector<double> points;
  for (std::int64_t v = 0; v < scene.Mesh.GetNumberOfVertices(); ++v)
  {
    const glm::dvec3 place = scene.Mesh.GetPosition(v);
    points.insert(points.end(), { place.x, place.y, place.z });
  }
  std::vector<std::int64_t> cells;
  std::vector<double> terms;
  for (std::size_t c = 0; c < scene.Mesh.GetCells().size(); ++c)
  {
    const auto& vertices = scene.Mesh.GetCells()[c].Vertices;
    cells.insert(cells.end(), vertices.begin(), vertices.end());
    const EdgeTerms ofCell = scene.Medium.Terms ? scene.Terms[c] : EdgeTerms{};
    terms.insert(terms.end(), ofCell.begin(), ofCell.end());
  }
  return reference::GradedRayIntegrator(points, cells, scene.Squares, terms);
}

/** The order of n^2, and how rays are walked. */
struct WalkKind
{
  bool IsQuadratic;
  bool InLanes;
};

class GradedRayWalkOfKind : public ::testing::TestWithParam<WalkKind>
{
};

INSTANTIATE_TEST_SUITE_P(Walks, GradedRayWalkOfKind,
  ::testing::Values(WalkKind{ true, false }, WalkKind{ false, false }, WalkKind{ true, true },
    WalkKind{ false, true }),
  [](const auto& one)
  {
    return std::string(one.param.IsQuadratic ? "Quadratic" : "Linear") +
      (one.param.InLanes ? "Lanes" : "");
  });

TEST_P(GradedRayWalkOfKind, AgreesWithRungeKutta)
{
  RandomNumbers random(4);
  double worst = 0.0;
  std::int64_t rays = 0;
  std::int64_t steps = 0;
  const double contrasts[3] = { 1.0e-3, 0.05, 0.8 };
  for (int mesh = 0; mesh < 12; ++mesh)
  {
    MeshArrays arrays = KuhnGrid(3);
    JitterInside(arrays, 0.08, random);
    GradedScene scene(
      arrays, RandomField(contrasts[mesh % 3], random), 0.0, GetParam().IsQuadratic);
    const reference::GradedRayIntegrator integrator = MakeIntegrator(scene);
    scene.InLanes = GetParam().InLanes;
    for (int i = 0; i < 40; ++i, ++rays)
    {
      const glm::dvec3 direction = random.GetDirection();
      const glm::dvec3 target = random.Uniform(0.0, 0.4) * random.GetDirection();
      const GradedRayResult ray = scene.Walk(target - 3.0 * direction, direction);
      reference::LightRay light;
      light.Position = { ray.Entry.x, ray.Entry.y, ray.Entry.z };
      const double index = std::sqrt(integrator.SquaredIndexAt(light.Position));
      for (int axis = 0; axis < 3; ++axis)
      {
        light.Momentum[axis] = index * direction[axis];
      }
      light = integrator.Follow(light, 2.0e-3);
      const glm::dvec3 exit(light.Position[0], light.Position[1], light.Position[2]);
      worst = std::max(worst, glm::length(exit - ray.Exit));
      EXPECT_NEAR(ray.OpticalPath, light.OpticalPath, 1.0e-6);
    }
    ExpectAllThrough(scene.Statistics);
    steps += scene.Statistics.Steps;
  }
  EXPECT_LT(worst, 1.0e-6) << rays << " rays";
  EXPECT_GT(steps, 4 * rays);
}

TEST_P(GradedRayWalkOfKind, RaysReturn)
{
  RandomNumbers random(5);
  MeshArrays arrays = KuhnGrid(6);
  JitterInside(arrays, 0.05, random);
  GradedScene scene(
    arrays,
    [](const glm::dvec3& p) { return 1.5 + 0.4 * std::sin(5.0 * p.x) * std::cos(4.0 * p.y + p.z); },
    0.0, GetParam().IsQuadratic);
  scene.InLanes = GetParam().InLanes;
  for (const double outside : { 0.0, 1.0 })
  {
    scene.Medium.OutsideIndex = outside;
    for (int i = 0; i < 500; ++i)
    {
      const glm::dvec3 direction = random.GetDirection();
      const glm::dvec3 origin = RandomPoint(random) - 3.0 * direction;
      const GradedRayResult there = scene.Trace(origin, direction);
      if (there.State != GradedRayState::Left || there.OpticalPath == 0.0)
      {
        continue;
      }
      const GradedRayResult back =
        scene.Trace(there.Exit + 0.5 * there.Direction, -there.Direction);
      EXPECT_NEAR(glm::length(back.Exit - there.Entry), 0.0, 1.0e-9);
      EXPECT_NEAR(glm::length(back.Direction + direction), 0.0, 1.0e-9);
      EXPECT_NEAR(back.OpticalPath, there.OpticalPath, 1.0e-9);
    }
  }
  ExpectAllThrough(scene.Statistics);
}

// Random fields and meshes of all kinds: with inverted cells, flat cells and holes.
TEST_P(GradedRayWalkOfKind, NoRayIsLost)
{
  RandomNumbers random(6);
  GradedRayStatistics sums;
  for (int mesh = 0; mesh < 40; ++mesh)
  {
    MeshArrays arrays = KuhnGrid(4);
    const double amounts[4] = { 0.0, 0.05, 0.12, 0.3 };
    Jitter(arrays, amounts[mesh % 4], static_cast<unsigned int>(mesh));
    if (mesh % 3 == 1)
    {
      // A layer of cubes becomes flat.
      for (std::size_t p = 2; p < arrays.Points.size(); p += 3)
      {
        arrays.Points[p] = std::abs(arrays.Points[p] - 0.5) < 0.1 ? 0.25 : arrays.Points[p];
      }
    }
    for (std::size_t c = 0; mesh % 3 == 2 && c + 4 < arrays.Cells.size(); c += 4)
    {
      if (random.Below(3) == 0)
      {
        arrays.Cells.erase(arrays.Cells.begin() + static_cast<std::ptrdiff_t>(c),
          arrays.Cells.begin() + static_cast<std::ptrdiff_t>(c + 4));
      }
    }
    GradedScene scene(arrays,
      RandomField(mesh % 5 == 0 ? 3.0
          : mesh % 2 == 0       ? 1.0e-3
                                : 0.1,
        random),
      mesh % 2, GetParam().IsQuadratic);
    scene.Medium.MaximumNumberOfSteps = 4096;
    scene.InLanes = GetParam().InLanes;
    for (int i = 0; i < 300; ++i)
    {
      const int axis = random.Below(12);
      const glm::dvec3 direction =
        axis < 3 ? glm::dvec3(axis == 0, axis == 1, axis == 2) : random.GetDirection();
      const glm::dvec3 target =
        i % 2 == 0 ? glm::dvec3(arrays.PointAt(random.Below(125))) : RandomPoint(random);
      const GradedRayResult ray = scene.Trace(target - 2.0 * direction, direction);
      EXPECT_TRUE(std::isfinite(ray.OpticalPath));
      EXPECT_NEAR(glm::length(ray.Direction), 1.0, 1.0e-14);
    }
    sums.Add(scene.Statistics);
  }
  EXPECT_EQ(sums.Lost, 0);
  EXPECT_GT(sums.Rays, 8000);
  EXPECT_GT(sums.FlatSteps, 100);
  EXPECT_GT(sums.InvertedSteps, 100);
  // Rays that total reflection between random facets keeps for thousands of steps.
  EXPECT_LT(sums.Trapped, sums.Rays / 100);
}

// n^2 falls on both sides of a plane of faces: a ray in it stays there.
TEST(GradedRayWalk, RayGlidesAlongARidge)
{
  GradedScene plane(
    CenteredGrid(4, 1.0), [](const glm::dvec3& p) { return 3.0 - std::abs(p.y); }, 0.0, false);
  GradedScene edge(
    CenteredGrid(4, 1.0), [](const glm::dvec3& p) { return 3.0 - std::abs(p.y) - std::abs(p.z); },
    0.0, false);
  for (const bool inLanes : { false, true })
  {
    for (GradedScene* scene : { &plane, &edge })
    {
      scene->InLanes = inLanes;
      for (const double z : { 0.0, 0.1, 0.3 })
      {
        const double place = scene == &edge ? 0.0 : z;
        const GradedRayResult ray =
          scene->Trace(glm::dvec3(-2.0, 0.0, place), glm::dvec3(1.0, 0.0, 0.0));
        EXPECT_NEAR(glm::length(ray.Exit - glm::dvec3(1.0, 0.0, place)), 0.0, 1.0e-9);
        EXPECT_NEAR(ray.OpticalPath, 2.0 * std::sqrt(3.0), 1.0e-9);
      }
      ExpectAllThrough(scene->Statistics);
      EXPECT_GT(scene->Statistics.Glides, 0);
    }
  }
}

// Rays in planes of symmetry of a lens, in which faces lie that the mesh has rounded.
TEST(GradedRayWalk, PlanesOfSymmetryDoNotTrap)
{
  GradedScene lens(CenteredGrid(7, 1.0),
    [](const glm::dvec3& p)
    {
      const double n = 1.0 + 0.05 * std::exp(-20.0 * glm::dot(p, p));
      return n * n;
    });
  for (const bool inLanes : { false, true })
  {
    lens.InLanes = inLanes;
    for (const auto& [j, i] : Product(40, 40))
    {
      lens.Trace(
        glm::dvec3((i + 0.5) / 20.0 - 1.0, (j + 0.5) / 20.0 - 1.0, 3.0), glm::dvec3(0, 0, -1.0));
    }
  }
  ExpectAllThrough(lens.Statistics);
  EXPECT_LT(lens.Statistics.Steps, 2 * 1600 * 100);
}

// A gas: each ray has the same result whatever goes on in the other lanes, with any instructions,
// and nearly all steps are those of lanes.
TEST(GradedRayWalk, LanesDoNotDependOnEachOther)
{
  RandomNumbers random(7);
  MeshArrays arrays = KuhnGrid(6);
  JitterInside(arrays, 0.05, random);
  GradedScene gas(arrays,
    [](const glm::dvec3& p)
    { return 1.0005 + 2.0e-4 * std::sin(5.0 * p.x) * std::cos(4.0 * p.y); });
  std::vector<GradedRay> rays;
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 direction = random.GetDirection();
    rays.push_back(
      { random.Uniform(0.0, 0.9) * random.GetDirection() - 2.0 * direction, direction });
  }
  gas.PrepareLanes();
  const GradedRayWalk walk(gas.Medium);
  for (const InstructionSet set : GetInstructionSets())
  {
    GradedRayStatistics together;
    GradedRayStatistics apart;
    std::vector<GradedRayResult> results(rays.size());
    walk.WalkAll(rays, together, results.data(), set);
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      GradedRayResult one;
      walk.WalkAll({ rays[i] }, apart, &one, InstructionSet::Portable);
      const GradedRayResult& result = results[i];
      EXPECT_EQ(result.State, one.State);
      EXPECT_EQ(result.Exit, one.Exit);
      EXPECT_EQ(result.Direction, one.Direction);
      EXPECT_EQ(result.OpticalPath, one.OpticalPath);
      const GradedRayResult alone = walk.Walk(rays[i].Origin, rays[i].Direction, gas.Statistics);
      EXPECT_EQ(result.State, alone.State);
      EXPECT_NEAR(glm::length(result.Exit - alone.Exit), 0.0, 1.0e-12);
      EXPECT_NEAR(glm::length(result.Direction - alone.Direction), 0.0, 1.0e-12);
      EXPECT_NEAR(result.OpticalPath, alone.OpticalPath, 1.0e-12);
    }
    EXPECT_EQ(together.Steps, apart.Steps);
    EXPECT_GT(together.LaneSteps, together.Steps * 4 / 5);
    ExpectAllThrough(together);
  }
}

TEST(GradedRayWalk, PrismRefractsAndReflectsTotally)
{
  GradedScene glass(KuhnGrid(2), LinearField(2.25, glm::dvec3(0.0)), 1.0);
  // Through two parallel sides: shifted, not turned.
  const glm::dvec3 slanted = glm::normalize(glm::dvec3(0.3, 0.1, 1.0));
  const GradedRayResult through = glass.Trace(glm::dvec3(0.3, 0.4, -0.5), slanted);
  EXPECT_NEAR(glm::length(through.Direction - slanted), 0.0, 1.0e-14);
  const glm::dvec3 inside = glm::normalize(glm::dvec3(0.3, 0.1, 0.0) / (1.5 * std::sqrt(1.1)) +
    glm::dvec3(0.0, 0.0, std::sqrt(1.0 - 0.1 / (2.25 * 1.1))));
  EXPECT_NEAR(glm::length(through.Exit - (through.Entry + inside / inside.z)), 0.0, 3.0e-9);
  EXPECT_NEAR(through.OpticalPath, 1.5 / inside.z, 3.0e-9);
  // In by one side at an angle, totally reflected at the next one.
  const GradedRayResult reflected =
    glass.Trace(glm::dvec3(0.5, 0.5, 0.95) - glm::normalize(glm::dvec3(1.0, 0.0, 0.4)),
      glm::dvec3(1.0, 0.0, 0.4));
  EXPECT_EQ(glass.Statistics.Reflections, 1);
  EXPECT_NEAR(reflected.Direction.z, -0.4 / std::sqrt(1.16), 1.0e-12);
  ExpectAllThrough(glass.Statistics);
}

// A shock: two blocks of different n^2, joined by a layer of flat cells.
TEST(GradedRayWalk, JumpRefractsAndReflectsTotally)
{
  MeshArrays arrays = KuhnBlock(3, 2, 2, 1.0);
  std::vector<bool> isBehind;
  for (std::size_t p = 0; p < arrays.Points.size(); p += 3)
  {
    isBehind.push_back(arrays.Points[p] > 1.5);
    arrays.Points[p] -= arrays.Points[p] > 1.5 ? 1.0 : 0.0;
  }
  for (const bool isQuadratic : { false, true })
  {
    std::size_t point = 0;
    GradedScene shock(
      arrays, [](const glm::dvec3&) { return 1.0; }, 0.0, isQuadratic);
    for (const std::int32_t source : shock.Mesh.GetSourcePoints())
    {
      shock.Squares[point++] = isBehind[static_cast<std::size_t>(source)] ? 2.25 : 1.0;
    }
    if (isQuadratic)
    {
      shock.Terms = ComputeEdgeTerms(shock.Mesh, shock.Squares);
    }
    shock.InLanes = isQuadratic;
    const glm::dvec3 slanted = glm::normalize(glm::dvec3(1.0, 0.3, 0.1));
    const GradedRayResult in = shock.Trace(glm::dvec3(-0.5, 0.83, 0.71), slanted);
    const glm::dvec3 along = glm::dvec3(0.0, 1.0, 1.0) * slanted / 1.5;
    const glm::dvec3 refracted = along + glm::dvec3(std::sqrt(1.0 - glm::dot(along, along)), 0, 0);
    EXPECT_NEAR(glm::length(in.Direction - refracted), 0.0, 1.0e-9) << isQuadratic;
    EXPECT_NEAR(in.OpticalPath, 1.0 / slanted.x + 1.5 / refracted.x, 1.0e-8);
    // And back.
    const GradedRayResult out = shock.Trace(in.Exit + 0.5 * in.Direction, -in.Direction);
    EXPECT_NEAR(glm::length(out.Direction + slanted), 0.0, 1.0e-9);
    // Beyond the critical angle.
    const GradedRayResult reflected = shock.Trace(
      glm::dvec3(2.0, 0.2, 0.71) + glm::dvec3(0.3, -0.4, 0.0), glm::dvec3(-0.6, 0.8, 0.0));
    EXPECT_NEAR(glm::length(reflected.Direction - glm::dvec3(0.6, 0.8, 0.0)), 0.0, 1.0e-9);
    EXPECT_EQ(shock.Statistics.Reflections, 1);
    EXPECT_GT(shock.Statistics.FlatSteps, 0);
    ExpectAllThrough(shock.Statistics);
  }
}

TEST(GradedRayWalk, RayIsStoppedAfterItsSteps)
{
  // A ray from inside of a dense cube meets all sides beyond the critical angle, for ever.
  GradedScene glass(KuhnGrid(2), LinearField(9.0, glm::dvec3(0.0)), 1.0);
  const GradedRayResult ray = glass.Trace(glm::dvec3(0.4, 0.45, 0.3), glm::dvec3(1.0, 1.1, 1.2));
  EXPECT_EQ(ray.State, GradedRayState::Trapped);
  EXPECT_EQ(glass.Statistics.Trapped, 1);
  EXPECT_EQ(glass.Statistics.TrappedInFolds, 0);
  EXPECT_EQ(glass.Statistics.Steps, 65536);
}

// A cell beyond the boundary, turned inside out by a vertex that has been pulled through its face:
// light enters it by its far side and goes back to the near one. From there it goes on, past the
// face by which it has entered, straight or bent.
TEST(GradedRayWalk, RayLeavesAFoldForward)
{
  const MeshArrays arrays = Moved(KuhnGrid(2), // the middle of the top
    [](const glm::dvec3& p)
    { return p == glm::dvec3(0.5, 0.5, 1.0) ? p + glm::dvec3(0.8, 0.0, 0.0) : p; });
  for (const bool isStraight : { false, true })
  {
    GradedScene scene(arrays, LinearField(1.5, glm::dvec3(0.2, 0.1, 0.3)));
    scene.Medium.IsStraight = isStraight;
    RandomNumbers random(8);
    for (int i = 0; i < 4000; ++i)
    {
      const glm::dvec3 direction = random.GetDirection();
      const glm::dvec3 target(random.Uniform(0.5, 1.3), random.Uniform(0.0, 1.0), 0.9);
      const GradedRayResult ray = scene.Trace(target - 3.0 * direction, direction);
      EXPECT_NE(ray.State, GradedRayState::Trapped) << i;
    }
    EXPECT_GT(scene.Statistics.InvertedSteps, 100);
    ExpectAllThrough(scene.Statistics);
    // Far fewer than the steps of rays that go round in the fold.
    EXPECT_LT(scene.Statistics.Steps, 40 * scene.Statistics.Rays);
  }
}

TEST(GradedRayWalk, RayBeginsInside)
{
  GradedScene scene(KuhnGrid(4), LinearField(2.0, glm::dvec3(0.0, 0.5, 0.0)));
  const glm::dvec3 origin(0.4, 0.3, 0.2);
  const GradedRayResult ray = scene.Trace(origin, glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_EQ(ray.Entry, origin);
  const double n = std::sqrt(2.15);
  const double time = 0.6 / n;
  EXPECT_NEAR(glm::length(ray.Exit - glm::dvec3(1.0, 0.3 + 0.125 * time * time, 0.2)), 0.0, 3.0e-9);
}

TEST(GradedRayWalk, MissedMeshChangesNothing)
{
  GradedScene scene(KuhnGrid(1), LinearField(2.0, glm::dvec3(0.0)));
  const GradedRayResult ray = scene.Trace(glm::dvec3(3.0), glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_EQ(ray.State, GradedRayState::Missed);
  EXPECT_EQ(ray.OpticalPath, 0.0);
  EXPECT_EQ(scene.Statistics.Rays, 0);
  EXPECT_EQ(GradedScene({ {}, {} }, LinearField(2.0, glm::dvec3(0.0)))
              .Trace(glm::dvec3(3.0), glm::dvec3(1.0, 0.0, 0.0))
              .State,
    GradedRayState::Missed);
}

TEST(GradedRayWalk, GapIsCrossedStraight)
{
  MeshArrays arrays = KuhnBlock(3, 1, 1, 1.0);
  arrays.Cells.erase(arrays.Cells.begin() + 24, arrays.Cells.begin() + 48);
  GradedScene scene(arrays, LinearField(2.25, glm::dvec3(0.0)), 1.0);
  const GradedRayResult ray = scene.Trace(glm::dvec3(-1.0, 0.4, 0.3), glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_NEAR(ray.OpticalPath, 1.5 + 1.0 + 1.5, 1.0e-8);
  EXPECT_NEAR(glm::length(ray.Exit - glm::dvec3(3.0, 0.4, 0.3)), 0.0, 1.0e-8);
}

TEST(RefractiveIndex, UnusableValuesAreCounted)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  IndexFaults faults;
  const std::vector<double> squares =
    SquareIndices({ 1.5, 0.9, 0.0, -1.0, nan, 1.0e200, 1.0e-200 }, faults);
  EXPECT_EQ(squares[0], 2.25);
  EXPECT_EQ(squares[1], 0.9 * 0.9);
  for (std::size_t i = 2; i < squares.size(); ++i)
  {
    EXPECT_TRUE(std::isnan(squares[i])) << i;
  }
  EXPECT_EQ(faults.NotFinite, 2);
  EXPECT_EQ(faults.NotPositive, 3);
  EXPECT_EQ(faults.BelowOne, 1);
  const std::vector<double> gas =
    SquareIndicesOfGas({ 0.0, 1.22546, -1.0, nan }, GladstoneDaleOfAir, faults);
  EXPECT_EQ(gas[0], 1.0);
  EXPECT_NEAR(std::sqrt(gas[1]), 1.000277147, 1.0e-9);
  EXPECT_EQ(faults.NotPositive, 1);
  EXPECT_EQ(faults.NotFinite, 1);
}

TEST(RefractiveIndex, CellsWithoutAnIndexAreHoles)
{
  GradedScene scene(KuhnBlock(3, 1, 1, 1.0),
    [](const glm::dvec3& p) {
      return p.x > 2.5 && p.y > 0.5 && p.z > 0.5 ? std::numeric_limits<double>::quiet_NaN() : 2.25;
    });
  EXPECT_EQ(scene.Unknown, 6);
  const GradedRayResult ray = scene.Trace(glm::dvec3(-1.0, 0.4, 0.3), glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_NEAR(ray.Exit.x, 2.0, 1.0e-8);
}
