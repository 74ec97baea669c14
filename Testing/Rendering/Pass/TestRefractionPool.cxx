// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkRefractionPass compared with rays through exact waves: a pool with textured walls and three
// objects.
#include "PoolScene.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

using namespace meniscus::testing;

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
  vtkNew<vtkImageData> image;
  image->SetDimensions(3 * size, size, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        const double exact = truth.Colors[static_cast<std::size_t>(y) * size + x][c];
        const double ours = drawn.GetPixel(x, y)[c] / 255.0;
        const double values[3] = { ours, exact,
          1.0 - std::min(8.0 * std::fabs(ours - exact), 1.0) };
        for (int k = 0; k < 3; ++k)
        {
          static_cast<unsigned char*>(image->GetScalarPointer(k * size + x, y, 0))[c] =
            static_cast<unsigned char>(std::lround(255.0 * values[k]));
        }
      }
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName((std::string(MENISCUS_TEMPORARY_DIR) + "/pool-" + name + ".png").c_str());
  writer->SetInputData(image);
  writer->Write();
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
