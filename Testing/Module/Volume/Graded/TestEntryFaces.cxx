// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cones and drawn faces shorten searches for entries and change no result.
#include "GradedScene.h"

#include "TestBasics.h"
#include "Volume/Graded/BoundaryCones.h"
#include "Volume/Graded/BoundaryCrossings.h"
#include "Volume/Graded/EntryRaster.h"
#include "Volume/Graded/GradedRayWalk.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

constexpr int Pixels = 16;
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/** Rays of an eye, or parallel ones, that fill an image around the unit ball. */
struct Camera
{
  Camera(const glm::dvec3& direction, double distance, bool isParallel)
    : IsParallel(isParallel)
  {
    const glm::dvec3 along = glm::normalize(direction);
    const glm::dvec3 right = glm::normalize(glm::cross(along, glm::dvec3(0.3, 1.0, 0.2)));
    this->Axes = glm::dmat3(right, glm::cross(right, along), along);
    this->Eye = -distance * along;
    this->Step = (isParallel ? 2.2 : 2.2 / distance) / Pixels;
  }
  glm::dvec3 GetDirection(const glm::dvec2& pixel) const
  {
    const glm::dvec2 slope = this->IsParallel ? glm::dvec2(0.0) : this->Across(pixel);
    return this->Axes * glm::dvec3(slope, 1.0);
  }
  GradedRay GetRay(const glm::dvec2& pixel) const
  {
    const glm::dvec2 shift = this->IsParallel ? this->Across(pixel) : glm::dvec2(0.0);
    return { this->Eye + this->Axes * glm::dvec3(shift, 0.0), this->GetDirection(pixel) };
  }
  glm::dvec2 Project(const glm::dvec3& place) const
  {
    const glm::dvec3 there = glm::transpose(this->Axes) * (place - this->Eye);
    const glm::dvec2 across = glm::dvec2(there) / (this->IsParallel ? 1.0 : there.z);
    return there.z > 0.0 ? across / this->Step + 0.5 * (Pixels - 1) : glm::dvec2(NaN);
  }
  RayImage GetImage() const
  {
    const double depth = glm::dot(this->Axes[2], this->Eye);
    const AffinePixelMap across{ glm::dvec2(0.0), glm::dvec2(this->Step, 0.0),
      glm::dvec2(0.0, this->Step) };
    RayFrame frame;
    frame.RowX = this->Axes[0];
    frame.RowY = this->Axes[1];
    frame.RowDepth = this->Axes[2];
    frame.Origin = across;
    if (!this->IsParallel)
    {
      frame.Slope = across;
      frame.Origin.PerColumn *= -depth;
      frame.Origin.PerRow *= -depth;
    }
    return RayImage(frame, depth, glm::ivec2(Pixels));
  }

private:
  glm::dvec2 Across(const glm::dvec2& pixel) const
  {
    return this->Step * (pixel - 0.5 * (Pixels - 1));
  }

  bool IsParallel;
  glm::dmat3 Axes;
  glm::dvec3 Eye;
  double Step;
};

/** Meshes that rays leave and enter again: jittered, with holes where the index is unknown. */
std::vector<std::unique_ptr<GradedScene>> MakeScenes()
{
  RandomNumbers random(11);
  MeshArrays jittered = KuhnGrid(6);
  JitterInside(jittered, 0.05, random);
  const auto wave = [](const glm::dvec3& p)
  { return 1.5 + 0.3 * std::sin(5.0 * p.x) * std::cos(4.0 * p.y + p.z); };
  const auto holes = [&](const glm::dvec3& p)
  { return random.Uniform(0.0, 1.0) < 0.1 ? NaN : wave(p); };
  std::vector<std::unique_ptr<GradedScene>> scenes;
  scenes.push_back(std::make_unique<GradedScene>(KuhnGrid(5), wave));
  scenes.push_back(std::make_unique<GradedScene>(jittered, holes));
  scenes.push_back(std::make_unique<GradedScene>(jittered, holes, 1.0));
  scenes.push_back(std::make_unique<GradedScene>(BallOfCubes(8, 1.0), wave));
  return scenes;
}

void ExpectEqual(const std::vector<GradedRayResult>& a, const std::vector<GradedRayResult>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    ASSERT_EQ(a[i].State, b[i].State) << i;
    ASSERT_EQ(a[i].Entry, b[i].Entry) << i;
    ASSERT_EQ(a[i].Exit, b[i].Exit) << i;
    ASSERT_EQ(a[i].Direction, b[i].Direction) << i;
    ASSERT_EQ(a[i].OpticalPath, b[i].OpticalPath) << i;
  }
}

/** Walks the rays of an image, with cones and drawn faces or by the tree alone. */
std::vector<GradedRayResult> WalkImage(
  GradedScene& scene, const Camera& camera, bool isShort, std::int64_t& candidates)
{
  BoundaryCones cones;
  cones.Build(scene.Mesh, scene.Tree);
  scene.Medium.Cones = isShort ? &cones : nullptr;
  std::vector<GradedRay> rays;
  for (int i = 0; i < Pixels * Pixels; ++i)
  {
    rays.push_back(camera.GetRay(glm::dvec2(i % Pixels, i / Pixels)));
  }
  const EntryRaster raster(scene.Mesh, scene.Tree, camera.GetImage());
  EXPECT_TRUE(raster.IsUsable());
  const EntryFaces faces = raster.Collect({ 0, 0 }, { Pixels, Pixels },
    [](int column, int row) { return static_cast<std::size_t>(row * Pixels + column); });
  candidates = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    for (std::int32_t k = faces.GetFirst(i); k >= 0; k = faces.GetNext(k))
    {
      ++candidates;
    }
  }
  std::vector<GradedRayResult> results(rays.size());
  GradedRayWalk(scene.Medium)
    .WalkAll(
      rays, scene.Statistics, results.data(), BestInstructionSet(), isShort ? &faces : nullptr);
  return results;
}

}

TEST(EntryFaces, ResultsAreThoseOfTheTree)
{
  // Along axes and diagonals, where rays meet edges and faces are seen from the side.
  const glm::dvec3 directions[] = { { 0.3, -0.4, 0.8 }, { 0, 0, -1 }, { 1, 1, 1 }, { -1, 0, 0 } };
  for (const auto& scene : MakeScenes())
  {
    for (const bool inLanes : { false, true })
    {
      if (inLanes)
      {
        scene->PrepareLanes();
      }
      for (const glm::dvec3& direction : directions)
      {
        for (const bool isParallel : { true, false })
        {
          const Camera camera(direction, 3.0, isParallel);
          std::int64_t candidates = 0;
          const auto expected = WalkImage(*scene, camera, false, candidates);
          const auto found = WalkImage(*scene, camera, true, candidates);
          ExpectEqual(found, expected);
          const auto met = std::count_if(expected.begin(), expected.end(),
            [](const GradedRayResult& ray) { return ray.State == GradedRayState::Left; });
          EXPECT_GT(met, Pixels * Pixels / 8);
          // Faces that the rays leave by, half of all, are left out.
          EXPECT_LT(candidates, 4 * met);
        }
      }
    }
  }
}

// Rays that a gas has bent leave a cube behind all faces that they could enter by; where they pass
// a hole or come close to an edge, the tree must be asked.
TEST(EntryFaces, MostRaysDoNotEnterAgain)
{
  for (const bool hasHole : { false, true })
  {
    GradedScene scene(CenteredGrid(6, 1.0),
      [hasHole](const glm::dvec3& p)
      {
        const bool isHole = hasHole && glm::length(p) < 0.5;
        return isHole ? NaN : 1.0005 + 2.0e-4 * std::sin(3.0 * p.x) * std::cos(2.0 * p.y + p.z);
      });
    const Camera camera({ 0.1, 0.05, -1.0 }, 3.0, true);
    const EntryRaster raster(scene.Mesh, scene.Tree, camera.GetImage());
    const BoundaryCrossings crossings(scene.Mesh, scene.Tree);
    int ruledOut = 0;
    int entered = 0;
    for (int i = 0; i < Pixels * Pixels; ++i)
    {
      const GradedRay ray = camera.GetRay(glm::dvec2(i % Pixels, i / Pixels));
      const BoundaryCrossing first =
        crossings.Find(ray.Origin, glm::normalize(ray.Direction), false, {});
      const GradedRayResult result = scene.Walk(ray.Origin, ray.Direction);
      const bool mayEnter = raster.MayEnterAfter(result.Exit, result.Direction);
      ruledOut += result.State == GradedRayState::Left && !mayEnter ? 1 : 0;
      // From before the mesh, and from its middle, where the hole is left.
      EXPECT_TRUE(
        first.Face < 0 || raster.MayEnterAfter(ray.Origin, glm::normalize(ray.Direction)));
      const glm::dvec3 middle = result.Entry + 0.5 * (result.Exit - result.Entry);
      if (crossings.Find(middle, result.Direction, false, {}).Face >= 0)
      {
        EXPECT_TRUE(raster.MayEnterAfter(middle, result.Direction)) << i;
        ++entered;
      }
      EXPECT_TRUE(raster.MayEnterAfter(result.Exit, -result.Direction));
    }
    EXPECT_GT(ruledOut, Pixels * Pixels / 8) << hasHole;
    EXPECT_GT(entered, hasHole ? 4 : -1);
  }
}

TEST(RayImage, HasRaysAndPixelsOfACamera)
{
  for (const bool isParallel : { true, false })
  {
    const Camera camera({ 0.3, -0.4, 0.8 }, 3.0, isParallel);
    const RayImage image = camera.GetImage();
    for (const auto& [row, column] : Product(Pixels, Pixels))
    {
      const glm::dvec2 pixel(column, row);
      const GradedRay ray = camera.GetRay(pixel);
      const glm::dvec3 turned = glm::normalize(ray.Direction + glm::dvec3(0.02, 0.0, 0.0));
      const double turn = glm::length(turned - glm::normalize(ray.Direction));
      EXPECT_NEAR(glm::length(image.GetOrigin(pixel) - ray.Origin), 0.0, 1.0e-14);
      EXPECT_NEAR(glm::length(image.GetDirection(pixel) - ray.Direction), 0.0, 1.0e-14);
      EXPECT_TRUE(image.IsNearRay(pixel, turned, 1.01 * turn));
      EXPECT_FALSE(image.IsNearRay(pixel, turned, 0.99 * turn));
      EXPECT_FALSE(image.IsNearRay(pixel, -turned, 0.5));
      for (const double way : { 2.1, 3.7 })
      {
        const glm::dvec3 place = ray.Origin + way * ray.Direction;
        EXPECT_NEAR(glm::length(image.Project(place) - pixel), 0.0, 1.0e-12);
        EXPECT_NEAR(glm::length(camera.Project(place) - pixel), 0.0, 1.0e-12);
      }
      EXPECT_TRUE(std::isnan(image.Project(ray.Origin - 0.1 * ray.Direction).x));
    }
  }
}

TEST(EntryFaces, RaysWithoutFacesAreLeftOut)
{
  const auto scene = std::move(MakeScenes().front());
  const Camera camera({ 0.3, -0.4, 0.8 }, 3.0, true);
  const EntryRaster raster(scene->Mesh, scene->Tree, camera.GetImage());
  const auto collect = [&raster]()
  {
    return raster.Collect({ 0, 0 }, { Pixels, Pixels },
      [](int column, int row) { return static_cast<std::size_t>(row * Pixels + column); });
  };
  const EntryFaces all = collect();
  EntryFaces few = collect();
  const std::vector<std::size_t> kept = few.KeepRaysWithFaces();
  EXPECT_GT(kept.size(), 10u);
  std::size_t next = 0;
  for (std::size_t ray = 0; ray < Pixels * Pixels; ++ray)
  {
    if (all.GetFirst(ray) >= 0)
    {
      ASSERT_LT(next, kept.size());
      EXPECT_EQ(kept[next], ray);
      EXPECT_EQ(few.GetFirst(next), all.GetFirst(ray));
      ++next;
    }
  }
  EXPECT_EQ(next, kept.size());
}

// Distances of crossings against those of extended precision, from faces seen from the front to
// faces that are grazed: their errors are bounded, and those of the latter exceed the bound of the
// former.
TEST(BoundaryCrossings, ErrorsOfDistancesAreBounded)
{
  RandomNumbers random(21);
  int crossed = 0;
  int beyond = 0;
  for (int i = 0; i < 300; ++i)
  {
    MeshArrays arrays = KuhnGrid(1);
    Jitter(arrays, 0.2, static_cast<unsigned int>(i));
    const GradedScene scene(arrays, [](const glm::dvec3&) { return 2.0; });
    const BoundaryCrossings crossings(scene.Mesh, scene.Tree);
    const auto& faces = scene.Tree.GetFaces();
    for (std::size_t number = 0; number < faces.size(); ++number)
    {
      const auto& vertices = faces[number].Vertices;
      const glm::dvec3 corners[3] = { scene.Mesh.GetPosition(vertices[0]),
        scene.Mesh.GetPosition(vertices[1]), scene.Mesh.GetPosition(vertices[2]) };
      const glm::dvec3 normal =
        glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
      const double angle = std::pow(10.0, random.Uniform(-5.0, 0.0));
      const glm::dvec3 direction =
        glm::normalize(glm::normalize(corners[1] - corners[0] +
                         random.Uniform(0.1, 1.0) * (corners[2] - corners[0])) -
          angle * normal);
      const glm::dvec3 origin = (corners[0] + corners[1] + corners[2]) / 3.0 - 0.3 * direction;
      const BoundaryCrossing found = crossings.Find(origin, direction, false, {});
      if (found.Face != static_cast<std::int32_t>(number))
      {
        continue;
      }
      using Exact = glm::vec<3, long double, glm::defaultp>;
      const Exact first(corners[0]);
      const Exact exactNormal = glm::cross(Exact(corners[1]) - first, Exact(corners[2]) - first);
      const long double distance =
        glm::dot(exactNormal, first - Exact(origin)) / glm::dot(exactNormal, Exact(direction));
      const double error = std::abs(static_cast<double>(found.Distance - distance));
      if (found.Error == TetrahedralMesh::PositionUnit)
      {
        continue;
      }
      EXPECT_LE(error, found.Error) << i << ' ' << number << ' ' << angle;
      EXPECT_GE(found.Error, BoundaryCrossings::DistanceError);
      ++crossed;
      beyond += error > BoundaryCrossings::DistanceError ? 1 : 0;
    }
  }
  EXPECT_GT(crossed, 1000);
  EXPECT_GT(beyond, 10);
}

TEST(EntryFaces, NothingIsCollectedIfAPlaceHasNoPixel)
{
  const auto scene = std::move(MakeScenes().front());
  const Camera inside({ 0, 0, 1 }, 0.1, false);
  const EntryRaster raster(scene->Mesh, scene->Tree, inside.GetImage());
  EXPECT_FALSE(raster.IsUsable());
}
