// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The table of blend modes, and the results of parts of a ray joined as it says.
#include "TestBasics.h"
#include "Volume/Optics/BlendModels.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Kernels/KeptValues.h"

using namespace meniscus;

namespace
{

/** Result of two parts of a ray, {number, length} each, where lengths are kept. */
void ExpectJoined(BlendMode mode, float number, float length, float numberBehind,
  float lengthBehind, float expected)
{
  float values[4] = { number, length, 0.0f, 0.0f };
  const float behind[4] = { numberBehind, lengthBehind, 0.0f, 0.0f };
  JoinValues(mode, behind, values);
  EXPECT_EQ(values[0], expected) << GetBlendModel(mode).Label;
  EXPECT_EQ(values[1], length + lengthBehind) << GetBlendModel(mode).Label;
}

}

TEST(BlendModels, NumbersAndNames)
{
  std::set<std::string> labels;
  int previous = -1;
  for (const BlendModel& model : BlendModels)
  {
    const int number = static_cast<int>(model.Mode);
    EXPECT_GT(number, previous) << model.Label;
    previous = number;
    EXPECT_TRUE(labels.insert(model.Label).second) << model.Label;
    EXPECT_EQ(FindBlendModel(number), &model);
    EXPECT_EQ(&GetBlendModel(model.Mode), &model);
  }
  EXPECT_EQ(FindBlendModel(-1), nullptr);
  EXPECT_EQ(FindBlendModel(previous + 1), nullptr);
}

TEST(BlendModels, OpacityMeaning)
{
  // OpacityModel of the mapper is there for media.
  EXPECT_EQ(OpacityMeaningOf(BlendMode::Composite, false), OpacityMeaning::Attenuation);
  EXPECT_EQ(OpacityMeaningOf(BlendMode::Composite, true), OpacityMeaning::AlphaPerUnitDistance);
  for (const bool perUnitDistance : { false, true })
  {
    EXPECT_EQ(OpacityMeaningOf(BlendMode::Additive, perUnitDistance), OpacityMeaning::Attenuation);
    EXPECT_EQ(
      OpacityMeaningOf(BlendMode::MaximumIntensity, perUnitDistance), OpacityMeaning::Alpha);
    EXPECT_EQ(OpacityMeaningOf(BlendMode::Isosurfaces, perUnitDistance), OpacityMeaning::Alpha);
  }
}

TEST(BlendModels, AccumulatedOpacity)
{
  for (const BlendModel& model : BlendModels)
  {
    EXPECT_EQ(model.AccumulatesOpacity(),
      model.IsMedium() || model.IsLit() || model.Mode == BlendMode::Additive)
      << model.Label;
  }
}

TEST(BlendModels, NothingInFrontOrBehindChangesNothing)
{
  for (const BlendModel& model : BlendModels)
  {
    for (const bool isInFront : { false, true })
    {
      float parts[2][4] = { { -0.5f, 0.25f, 0.125f, 0.75f }, { -0.5f, 0.25f, 0.125f, 0.75f } };
      ClearValues(model.Mode, parts[isInFront ? 0 : 1]);
      JoinValues(model.Mode, parts[1], parts[0]);
      const float expected[4] = { -0.5f, 0.25f, 0.125f, 0.75f };
      for (int i = 0; i < (model.HidesBehind() ? 4 : 2); ++i)
      {
        EXPECT_EQ(parts[0][i], expected[i]) << model.Label << isInFront;
      }
    }
  }
}

TEST(BlendModels, ColorsInFrontHide)
{
  for (const BlendModel& model : BlendModels)
  {
    if (!model.HidesBehind())
    {
      continue;
    }
    // A quarter shines through the front: the back adds a quarter of its colour.
    float values[4] = { 0.5f, 0.25f, 0.0f, 0.25f };
    const float behind[4] = { 0.5f, 0.0f, 1.0f, 0.5f };
    JoinValues(model.Mode, behind, values);
    const float expected[4] = { 0.625f, 0.25f, 0.25f, 0.125f };
    for (int i = 0; i < 4; ++i)
    {
      EXPECT_EQ(values[i], expected[i]) << model.Label;
    }
  }
}

TEST(BlendModels, NumbersJoin)
{
  ExpectJoined(BlendMode::MaximumIntensity, -0.5f, 2.0f, 0.25f, 4.0f, 0.25f);
  ExpectJoined(BlendMode::MaximumIntensity, 0.25f, 2.0f, -0.5f, 4.0f, 0.25f);
  ExpectJoined(BlendMode::MinimumIntensity, -0.5f, 2.0f, 0.25f, 4.0f, -0.5f);
  ExpectJoined(BlendMode::MinimumIntensity, 0.25f, 2.0f, -0.5f, 4.0f, -0.5f);
  // Means are kept as integrals, so both modes add.
  ExpectJoined(BlendMode::AverageIntensity, -0.5f, 2.0f, 0.25f, 4.0f, -0.25f);
  ExpectJoined(BlendMode::Additive, 0.5f, 2.0f, 0.25f, 4.0f, 0.75f);
}

TEST(BlendModels, ResultsShow)
{
  // Twice the scalar as red, an alpha of 1/2.
  const PacketInterval interval{ -1.0f, 1.0f, 0.5f, 0.0f, { -2.0f, 0.0f, 0.0f, 0.0f },
    { 2.0f, 0.0f, 0.0f, 0.0f } };
  PacketJob job{};
  job.Intervals = &interval;
  job.NumberOfIntervals = 1;
  const float number[4] = { 0.5f, 2.0f, 0.0f, 0.0f };
  const auto expect = [&](BlendMode mode, const float(&values)[4], float red, float alpha)
  {
    job.Blending = mode;
    float color[4];
    FinishValues(job, values, color);
    EXPECT_EQ(color[0], red) << GetBlendModel(mode).Label;
    EXPECT_EQ(color[3], alpha) << GetBlendModel(mode).Label;
  };
  expect(BlendMode::MaximumIntensity, number, 0.5f, 0.5f);
  expect(BlendMode::MinimumIntensity, number, 0.5f, 0.5f);
  expect(BlendMode::AverageIntensity, number, 0.25f, 0.5f); // a mean of 1/4
  expect(BlendMode::Additive, number, 0.5f, 1.0f);
  const float color[4] = { 0.5f, 0.25f, 0.0f, 0.25f };
  expect(BlendMode::Composite, color, 0.5f, 0.75f);
  expect(BlendMode::Isosurfaces, color, 0.5f, 0.75f);
}
