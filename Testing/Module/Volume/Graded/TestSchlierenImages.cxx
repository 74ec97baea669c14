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

/** @param off replaced by the light beyond the image. */
std::vector<double> ComputeShadowgraph(
  const std::vector<glm::dvec2>& landings, int width, int height, double& off)
{
  Shadowgraph shadows;
  // A second image in the memory of a first one.
  for (const auto& first : { std::vector<glm::dvec2>(landings.size()), landings })
  {
    shadows.Landings = first;
    shadows.Compute(width, height, SerialLoop);
  }
  off = shadows.GetLightOffScreen();
  return shadows.GetIrradiance();
}

using Places = std::vector<glm::dvec2>;

/** The part of a polygon at which a linear function is not negative. */
Places Cut(const Places& polygon, const glm::dvec3& function)
{
  Places part;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const glm::dvec2 a = polygon[i];
    const glm::dvec2 b = polygon[(i + 1) % polygon.size()];
    const double atA = glm::dot(function, glm::dvec3(a, 1.0));
    const double atB = glm::dot(function, glm::dvec3(b, 1.0));
    if (atA >= 0.0)
    {
      part.push_back(a);
    }
    if (atA * atB < 0.0)
    {
      part.push_back(a + atA / (atA - atB) * (b - a));
    }
  }
  return part;
}

double AreaOf(const Places& polygon)
{
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const glm::dvec2 a = polygon[i];
    const glm::dvec2 b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * std::abs(twice);
}

/** Shadowgraph of corners of which each pixel's four turn to one side, pixel by pixel. */
std::vector<double> SpreadOverPixels(const std::vector<Places>& quadrangles, int width, int height)
{
  std::vector<double> image(static_cast<std::size_t>(width * height), 0.0);
  for (const Places& whole : quadrangles)
  {
    for (const auto& [j, i] : Product(height, width))
    {
      Places part = whole;
      for (const glm::dvec3& side : { glm::dvec3(1.0, 0.0, 0.5 - i), glm::dvec3(-1.0, 0.0, 0.5 + i),
             glm::dvec3(0.0, 1.0, 0.5 - j), glm::dvec3(0.0, -1.0, 0.5 + j) })
      {
        part = Cut(part, side);
      }
      image[static_cast<std::size_t>(j * width + i)] += AreaOf(part) / AreaOf(whole);
    }
  }
  return image;
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
  const auto image = ComputeShadowgraph(landings, 64, 48, off);
  EXPECT_NEAR(SumOf(image), 64.0 * 48.0, 64.0 * 48.0 * 1.0e-4);
  EXPECT_NEAR(off, 0.0, 64.0 * 48.0 * 1.0e-4);
}

// Against a cut of each quadrangle by each pixel, for light that is spread, dense, turned over,
// beyond all sides of the image, and missing.
TEST(Shadowgraph, LightIsThatOfEachQuadrangle)
{
  constexpr int width = 23;
  constexpr int height = 19;
  const glm::dmat2 maps[] = { { 1.0, 0.03, -0.02, 1.01 }, { 2.3, 0.4, -0.7, 1.8 },
    { 0.2, 0.01, 0.03, 0.11 }, { -0.9, 0.2, 0.3, 1.2 }, { 0.011, 0.0, 0.0, 0.012 } };
  for (const glm::dmat2& map : maps)
  {
    const auto landAt = [&map](const glm::dvec2& p)
    {
      const glm::dvec2 wave(std::sin(0.3 * p.y + 0.1), std::cos(0.2 * p.x));
      const glm::dvec2 middle(11.0, 9.0);
      return middle + map * (p - middle + 0.2 * wave) + glm::dvec2(0.31, -0.17);
    };
    // Where the light is dense, the quadrangles next to a dark pixel are not convex.
    const bool hasDark = std::abs(map[0][0]) > 0.5;
    const auto isDark = [hasDark](int column, int row)
    { return hasDark && column == 7 && row == 5; };
    auto landings = Land(width, height, landAt);
    if (hasDark)
    {
      landings[5 * width + 7] = glm::dvec2(std::numeric_limits<double>::quiet_NaN());
    }
    const auto cornerAt = [&](int column, int row)
    {
      glm::dvec2 sum(0.0);
      int count = 0;
      for (const auto& [j, i] : Product(2, 2))
      {
        const glm::ivec2 pixel(column - i, row - j);
        const bool isIn = pixel.x >= 0 && pixel.y >= 0 && pixel.x < width && pixel.y < height;
        if (isIn && !isDark(pixel.x, pixel.y))
        {
          sum += landAt(glm::dvec2(pixel)) - glm::dvec2(pixel);
          ++count;
        }
      }
      return glm::dvec2(column, row) - 0.5 + sum / static_cast<double>(count);
    };
    std::vector<Places> quadrangles;
    for (const auto& [j, i] : Product(height, width))
    {
      if (!isDark(i, j))
      {
        quadrangles.push_back(
          { cornerAt(i, j), cornerAt(i + 1, j), cornerAt(i + 1, j + 1), cornerAt(i, j + 1) });
      }
    }
    double off = 0.0;
    const auto image = ComputeShadowgraph(landings, width, height, off);
    const auto expected = SpreadOverPixels(quadrangles, width, height);
    for (std::size_t i = 0; i < image.size(); ++i)
    {
      EXPECT_NEAR(image[i], expected[i], 1.0e-9) << i;
    }
    EXPECT_NEAR(off, static_cast<double>(quadrangles.size()) - SumOf(expected), 1.0e-7);
  }
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
    ComputeShadowgraph(landings, size, size, off);
    double beyondMargin = 0.0;
    ComputeShadowgraph(withMargin, all, all, beyondMargin);
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
    32, off);
  EXPECT_NEAR(image[16 * 32 + 16], 1.0, 1.0e-12);
  EXPECT_NEAR(image[2 * 32 + 16], 0.0, 1.0e-12);
  EXPECT_NEAR(off, 0.5 * 32.0 * 32.0, 1.0e-9);
  image = ComputeShadowgraph(
    Land(32, 32, [](const glm::dvec2& p) { return 15.5 + 0.5 * (p - 15.5); }), 32, 32, off);
  EXPECT_NEAR(image[16 * 32 + 16], 4.0, 1.0e-12);
  EXPECT_NEAR(off, 0.0, 1.0e-9);
}

// Rounding bends the sides of quadrangles far beyond the image.
TEST(Shadowgraph, LightOfHugeQuadranglesIsBounded)
{
  RandomNumbers random(3);
  for (const double scale : { 1.0e3, 1.0e9, 1.0e12, 1.0e15 })
  {
    for (int round = 0; round < 20; ++round)
    {
      const auto landings = Land(12, 9,
        [&](const glm::dvec2& p)
        { return p + scale * glm::dvec2(random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0)); });
      double off = 0.0;
      const auto image = ComputeShadowgraph(landings, 12, 9, off);
      EXPECT_GE(*std::min_element(image.begin(), image.end()), 0.0);
      EXPECT_LE(SumOf(image), 12.0 * 9.0);
    }
  }
}

TEST(Shadowgraph, DegenerateLightIsCounted)
{
  double off = 0.0;
  // All light in one point; then none, beyond the screen, and a pixel without a ray.
  auto image = ComputeShadowgraph(
    Land(8, 8, [](const glm::dvec2&) { return glm::dvec2(3.0, 4.0); }), 8, 8, off);
  EXPECT_NEAR(SumOf(image), 64.0, 1.0e-9);
  EXPECT_NEAR(image[4 * 8 + 3], 64.0, 1.0e-9);
  image = ComputeShadowgraph(Land(8, 8, [](const glm::dvec2& p) { return p + 1.0e9; }), 8, 8, off);
  EXPECT_EQ(SumOf(image), 0.0);
  EXPECT_NEAR(off, 64.0, 1.0e-9);
  auto landings = Land(8, 8, [](const glm::dvec2& p) { return p; });
  landings[9] = glm::dvec2(std::numeric_limits<double>::quiet_NaN());
  image = ComputeShadowgraph(landings, 8, 8, off);
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
