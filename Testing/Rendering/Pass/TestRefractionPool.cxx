// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkRefractionPass compared with rays through exact waves: a pool with textured walls and three
// objects.
#include "ComparisonSheet.h"
#include "PoolScene.h"
#include "TestBasics.h"

using namespace meniscus::test;

namespace
{

constexpr double Accepted = 8.0 / 255.0;
constexpr int Cells = 96;

struct PoolDifference
{
  int Water = 0;
  int Differing = 0; ///< number of pixels that differ by more than Accepted in any channel
  double Percent() const { return 100.0 * this->Differing / this->Water; }
};

/**
 * Drawn image, traced image and their difference side by side, for inspection and for the
 * documentation.
 */
void Save(const std::string& name, const meniscus::test::ByteImage& drawn, const PoolPicture& truth)
{
  constexpr int size = PoolScene::Pixels;
  ComparisonSheet sheet({ "" }, { "vtkRefractionPass", "traced rays", "8 x difference" }, size);
  for (const auto& [y, x] : Product(size, size))
  {
    const glm::dvec3& exact = truth.Colors[static_cast<std::size_t>(y) * size + x];
    const unsigned char* pixel = drawn.GetPixel(x, y);
    const glm::dvec3 ours = glm::dvec3(pixel[0], pixel[1], pixel[2]) / 255.0;
    sheet.SetPixel(0, 0, x, y, ours);
    sheet.SetPixel(0, 1, x, y, exact);
    sheet.SetPixel(0, 2, x, y, 1.0 - 8.0 * glm::abs(ours - exact));
  }
  sheet.Write(std::string(MENISCUS_TEMPORARY_DIR) + "/pool-" + name + ".png");
}

PoolDifference Compare(const meniscus::test::ByteImage& drawn, const PoolPicture& truth)
{
  PoolDifference result;
  for (std::size_t i = 0; i < truth.Colors.size(); ++i)
  {
    if (!truth.IsWater[i])
    {
      continue;
    }
    double largest = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      largest = std::max(largest, std::fabs(drawn.Rgb[3 * i + c] / 255.0 - truth.Colors[i][c]));
    }
    ++result.Water;
    result.Differing += largest > Accepted;
  }
  return result;
}

PoolDifference MeasureCase(PoolScene& scene, const std::string& name, const PoolOptics& optics)
{
  scene.SetOptics(optics);
  const auto drawn = scene.Draw();
  const PoolPicture truth = scene.Trace();
  Save(name, drawn, truth);
  const PoolDifference difference = Compare(drawn, truth);
  ::testing::Test::RecordProperty(name + " percent", std::to_string(difference.Percent()));
  EXPECT_GT(difference.Water, 60000);
  return difference;
}

} // anonymous namespace

TEST(RefractionPool, LooksLikeRaysThroughTheExactWaves)
{
  PoolScene scene(Cells);
  const glm::dvec3 attenuation(0.02, 0.008, 0.004);
  EXPECT_LT(MeasureCase(scene, "clear", {}).Percent(), 0.1);
  EXPECT_LT(MeasureCase(scene, "attenuated", { false, false, attenuation }).Percent(), 0.5);
  EXPECT_LT(MeasureCase(scene, "reflecting", { true, true, glm::dvec3(0.0) }).Percent(), 0.5);
  EXPECT_LT(MeasureCase(scene, "all", { true, true, attenuation }).Percent(), 0.5);
}

TEST(RefractionPool, ALampInColouredWaterLightsTruePlaces)
{
  PoolScene scene(Cells);
  PoolOptics optics;
  optics.Lamp = true;
  EXPECT_LT(MeasureCase(scene, "lamp", optics).Percent(), 0.5);
  optics.Attenuation = glm::dvec3(0.02, 0.008, 0.004);
  optics.Scattered = glm::dvec3(0.05, 0.2, 0.25);
  optics.Fresnel = true;
  optics.Sky = true;
  EXPECT_LT(MeasureCase(scene, "lamp in coloured water", optics).Percent(), 0.5);
}

TEST(RefractionPool, WavesThatMoveAreFollowed)
{
  PoolScene scene(Cells);
  scene.Draw();
  scene.MoveWater(1.0);
  EXPECT_LT(
    MeasureCase(scene, "moved", { true, true, glm::dvec3(0.02, 0.008, 0.004) }).Percent(), 0.5);
}
