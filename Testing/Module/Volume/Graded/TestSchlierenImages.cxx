// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Images of instruments, and the straight rays of small angles.
#include "GradedScene.h"

#include "TestBasics.h"
#include "Volume/Graded/SchlierenImages.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Landing points of an image of a size by a map of places. */
template <typename Map>
std::vector<glm::dvec2> Land(int width, int height, Map&& map)
{
  std::vector<glm::dvec2> landings;
  for (const auto& [j, i] : Product(height, width))
  {
    landings.push_back(map(glm::dvec2(i, j)));
  }
  return landings;
}

double SumOf(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}

TEST(Shadowgraph, LightIsConserved)
{
  const glm::dvec2 middle(31.5, 23.5);
  const auto landings = Land(64, 48,
    [&](const glm::dvec2& p)
    {
      // Folds, but nothing leaves the image.
      const glm::dvec2 r = (p - middle) / glm::dvec2(32.0, 24.0);
      const double keep = std::pow((1.0 - r.x * r.x) * (1.0 - r.y * r.y), 3.0);
      return p + 9.0 * keep * glm::dvec2(std::sin(0.5 * p.y), std::cos(0.4 * p.x));
    });
  double off = 0.0;
  const auto image = ComputeShadowgraph(landings, 64, 48, SerialLoop, off);
  EXPECT_NEAR(SumOf(image), 64.0 * 48.0, 64.0 * 48.0 * 1.0e-4);
  EXPECT_NEAR(off, 0.0, 64.0 * 48.0 * 1.0e-4);
}

// The light of a lens in a coarse mesh that is missing in its image has landed beyond the image: a
// screen with a margin catches all of it.
TEST(Shadowgraph, MissingLightIsBeyondTheImage)
{
  constexpr int size = 40;
  constexpr int margin = 10;
  constexpr int all = size + 2 * margin;
  for (const int cubes : { 7, 12 })
  {
    GradedScene lens(CenteredGrid(cubes, 1.0),
      [](const glm::dvec3& p)
      {
        const double n = 1.0 + 0.05 * std::exp(-20.0 * glm::dot(p, p));
        return n * n;
      });
    const auto landOn = [&](const glm::dvec2& pixel)
    {
      const glm::dvec2 place = (pixel + 0.5) * (2.0 / size) - 1.0;
      const GradedRayResult ray = lens.Trace(glm::dvec3(place, 2.0), glm::dvec3(0.0, 0.0, -1.0));
      const glm::dvec3 way = (-3.0 - ray.Exit.z) / ray.Direction.z * ray.Direction;
      return (glm::dvec2(ray.Exit + way) + 1.0) * (0.5 * size) - 0.5;
    };
    const auto landings = Land(size, size, landOn);
    const auto withMargin = Land(all, all,
      [&](const glm::dvec2& place)
      {
        const glm::dvec2 pixel = place - static_cast<double>(margin);
        const bool isLit = pixel.x >= 0 && pixel.y >= 0 && pixel.x < size && pixel.y < size;
        return isLit ? landOn(pixel) + static_cast<double>(margin)
                     : glm::dvec2(std::numeric_limits<double>::quiet_NaN());
      });
    double off = 0.0;
    ComputeShadowgraph(landings, size, size, SerialLoop, off);
    double beyondMargin = 0.0;
    ComputeShadowgraph(withMargin, all, all, SerialLoop, beyondMargin);
    // Measured: 5.2e-4 and 4.4e-6 of the light.
    EXPECT_NEAR(off / (size * size), cubes == 7 ? 5.2e-4 : 4.4e-6, cubes == 7 ? 1.0e-5 : 1.0e-6);
    EXPECT_NEAR(beyondMargin / (size * size), 0.0, 1.0e-12);
    EXPECT_EQ(lens.Statistics.Trapped + lens.Statistics.Lost, 0);
  }
}

TEST(Shadowgraph, IrradianceIsTheInverseOfTheJacobian)
{
  // Magnified by 2 and 0.5 about the middle: the light is as dense as before.
  double off = 0.0;
  auto image = ComputeShadowgraph(
    Land(32, 32, [](const glm::dvec2& p) { return 15.5 + glm::dvec2(2.0, 0.5) * (p - 15.5); }), 32,
    32, SerialLoop, off);
  EXPECT_NEAR(image[16 * 32 + 16], 1.0, 1.0e-12);
  EXPECT_NEAR(image[2 * 32 + 16], 0.0, 1.0e-12);
  EXPECT_NEAR(off, 0.5 * 32.0 * 32.0, 1.0e-9);
  image =
    ComputeShadowgraph(Land(32, 32, [](const glm::dvec2& p) { return 15.5 + 0.5 * (p - 15.5); }),
      32, 32, SerialLoop, off);
  EXPECT_NEAR(image[16 * 32 + 16], 4.0, 1.0e-12);
  EXPECT_NEAR(off, 0.0, 1.0e-9);
}

TEST(Shadowgraph, DegenerateLightIsCounted)
{
  double off = 0.0;
  // All light in one point; then none, beyond the screen, and a pixel without a ray.
  auto image = ComputeShadowgraph(
    Land(8, 8, [](const glm::dvec2&) { return glm::dvec2(3.0, 4.0); }), 8, 8, SerialLoop, off);
  EXPECT_NEAR(SumOf(image), 64.0, 1.0e-9);
  EXPECT_NEAR(image[4 * 8 + 3], 64.0, 1.0e-9);
  image = ComputeShadowgraph(
    Land(8, 8, [](const glm::dvec2& p) { return p + 1.0e9; }), 8, 8, SerialLoop, off);
  EXPECT_EQ(SumOf(image), 0.0);
  EXPECT_NEAR(off, 64.0, 1.0e-9);
  auto landings = Land(8, 8, [](const glm::dvec2& p) { return p; });
  landings[9] = glm::dvec2(std::numeric_limits<double>::quiet_NaN());
  image = ComputeShadowgraph(landings, 8, 8, SerialLoop, off);
  EXPECT_NEAR(image[9], 0.0, 1.0e-12);
  EXPECT_NEAR(image[10], 1.0, 1.0e-12);
  EXPECT_NEAR(off, 0.0, 1.0e-12);
}

TEST(KnifeEdge, CutsOffWhatIsDeflectedTowardsTheBlade)
{
  KnifeEdge knife;
  knife.Range = 0.01;
  EXPECT_DOUBLE_EQ(knife.Transmit({ 0.0, 0.0 }), 0.5);
  EXPECT_NEAR(knife.Transmit({ 1.0, 0.002 }), 0.7, 1.0e-12);
  EXPECT_EQ(knife.Transmit({ 0.0, -0.02 }), 0.0);
  EXPECT_EQ(knife.Transmit({ 0.0, 0.02 }), 1.0);
  knife.SetAngle(0.0);
  knife.CutOff = 1.0;
  EXPECT_NEAR(knife.Transmit({ 0.002, 1.0 }), 0.2, 1.0e-12);
  EXPECT_EQ(knife.Transmit({ 0.0, 0.0 }), 0.0);
}

TEST(Interferometer, FringesFollowPathsAndTilt)
{
  Interferometer meter;
  meter.Wavelength = 0.5;
  EXPECT_DOUBLE_EQ(meter.Interfere(0.0, { 0.3, 0.7 }), 1.0);
  EXPECT_NEAR(meter.Interfere(0.25, { 0.3, 0.7 }), 0.0, 1.0e-15);
  EXPECT_NEAR(meter.Interfere(-1.0, { 0.3, 0.7 }), 1.0, 1.0e-15);
  meter.Fringes = { 10.0, 0.0 };
  EXPECT_NEAR(meter.Interfere(0.0, { 0.05, 0.7 }), 0.0, 1.0e-12);
}

TEST(SamplePicture, IsLinearAndStaysInside)
{
  const std::vector<float> picture = { 0.0f, 1.0f, 2.0f, 10.0f, 11.0f, 12.0f };
  EXPECT_DOUBLE_EQ(SamplePicture(picture, 3, 2, { 1.5, 0.5 }), 6.5);
  EXPECT_DOUBLE_EQ(SamplePicture(picture, 3, 2, { -4.0, 9.0 }), 10.0);
  EXPECT_DOUBLE_EQ(SamplePicture({ 3.0f }, 1, 1, { 0.4, 0.2 }), 3.0);
}

// The same field, straight and bent: both the deflection and the path differ by second order.
TEST(StraightRays, DifferFromBentOnesBySecondOrder)
{
  double deflections[2];
  double paths[2];
  for (int k = 0; k < 2; ++k)
  {
    const double strength = k == 0 ? 0.04 : 0.02;
    GradedScene scene(CenteredGrid(12, 1.0),
      [=](const glm::dvec3& p) { return 1.0 + strength * std::exp(-4.0 * glm::dot(p, p)); });
    // Both rays pass the same faces, at which the gradient jumps a little.
    const glm::dvec3 origin(0.31, 0.1, -2.0);
    const glm::dvec3 direction(0.0, 0.0, 1.0);
    const GradedRayResult bent = scene.Trace(origin, direction);
    scene.Medium.IsStraight = true;
    const GradedRayResult straight = scene.Trace(origin, direction);
    EXPECT_NEAR(glm::length(straight.Exit - glm::dvec3(0.31, 0.1, 1.0)), 0.0, 1.0e-8);
    deflections[k] = glm::length(bent.Direction - straight.Direction);
    paths[k] = std::abs(bent.OpticalPath - straight.OpticalPath);
    EXPECT_LT(deflections[k], 0.1 * glm::length(straight.Direction - direction));
  }
  EXPECT_GT(std::log2(deflections[0] / deflections[1]), 1.75);
  EXPECT_GT(std::log2(paths[0] / paths[1]), 1.75);
}

TEST(StraightRays, IntegralsAreExactInALinearField)
{
  GradedScene scene(KuhnGrid(3), [](const glm::dvec3& p) { return 1.5 + 0.4 * p.z + 0.1 * p.x; });
  scene.Medium.IsStraight = true;
  const GradedRayResult ray = scene.Trace(glm::dvec3(0.4, 0.3, -1.0), glm::dvec3(0.0, 0.0, 1.0));
  const double first = 1.54;
  const double last = 1.94;
  const double path = (std::pow(last, 1.5) - std::pow(first, 1.5)) / 0.6;
  EXPECT_NEAR(ray.OpticalPath, path, 3.0e-9);
  const double slope = 0.5 * 0.1 * std::log(last / first) / 0.4;
  EXPECT_NEAR(ray.Direction.x / ray.Direction.z, slope, 1.0e-9);
}
