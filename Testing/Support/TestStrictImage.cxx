// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Tests of the strict comparison: it must detect differences that VTK's own comparison accepts.
#include "StrictImage.h"
#include "TestBasics.h"

#include <vtksys/SystemTools.hxx>

using namespace meniscus::test;

namespace
{

constexpr int Threshold = 1;

// A smooth image, in which a shift by one pixel changes little.
ByteImage Ramp()
{
  ByteImage image;
  image.Width = 40;
  image.Height = 30;
  for (const auto& [y, x] : Product(image.Height, image.Width))
  {
    for (const int value : { 5 * x, 7 * y, 2 * x + 3 * y })
    {
      image.Rgb.push_back(static_cast<unsigned char>(value));
    }
  }
  return image;
}

bool Passes(const ByteImage& image)
{
  const StrictDifference difference = CompareStrictly(Ramp(), image, Threshold);
  return difference.SameSize && difference.PixelsBeyond == 0;
}

} // anonymous namespace

TEST(StrictImage, EqualImagesPass)
{
  EXPECT_TRUE(Passes(Ramp()));
  EXPECT_EQ(CompareStrictly(Ramp(), Ramp(), 0).Largest, 0);
}

TEST(StrictImage, DifferenceWithinTheThresholdPasses)
{
  ByteImage image = Ramp();
  image.Rgb[777] = static_cast<unsigned char>(image.Rgb[777] + Threshold);
  EXPECT_TRUE(Passes(image));
  EXPECT_EQ(CompareStrictly(Ramp(), image, Threshold).Largest, Threshold);
}

TEST(StrictImage, OneLevelBeyondTheThresholdInOnePixelFails)
{
  ByteImage image = Ramp();
  image.Rgb[777] = static_cast<unsigned char>(image.Rgb[777] + Threshold + 1);
  EXPECT_FALSE(Passes(image));
  EXPECT_EQ(CompareStrictly(Ramp(), image, Threshold).PixelsBeyond, 1u);
}

TEST(StrictImage, ShiftByOnePixelFails)
{
  ByteImage image = Ramp();
  std::rotate(image.Rgb.begin(), image.Rgb.begin() + 3, image.Rgb.end());
  EXPECT_FALSE(Passes(image));
}

TEST(StrictImage, OffsetOfTheWholeImageFails)
{
  // VTK's default comparison accepts an offset of 50.
  ByteImage image = Ramp();
  for (unsigned char& value : image.Rgb)
  {
    value = static_cast<unsigned char>(std::min(255, value + 2));
  }
  EXPECT_FALSE(Passes(image));
}

TEST(StrictImage, OtherSizeFails)
{
  ByteImage image = Ramp();
  image.Height -= 1;
  image.Rgb.resize(image.Rgb.size() - 3 * static_cast<std::size_t>(image.Width));
  EXPECT_FALSE(Passes(image));
}

TEST(StrictImage, MissingBaselineFails)
{
  const BaselineResult result = CompareToBaseline(Ramp(), "NoSuchBaseline", Threshold);
  EXPECT_FALSE(result.Passed);
  EXPECT_TRUE(HasText(result.Message, "NoSuchBaseline"));
}

TEST(StrictImage, AnAlternateBaselinePasses)
{
  const std::string folder = std::string(MENISCUS_TEMPORARY_DIR) + "/AlternateBaselines";
  vtksys::SystemTools::RemoveADirectory(folder);
  vtksys::SystemTools::MakeDirectory(folder);
  ByteImage other = Ramp();
  std::reverse(other.Rgb.begin(), other.Rgb.end());
  WritePng(other, folder + "/Ramp.png");
  WritePng(other, folder + "/Ramp_1.png");
  EXPECT_FALSE(CompareToBaseline(Ramp(), "Ramp", Threshold, folder).Passed);
  WritePng(Ramp(), folder + "/Ramp_2.png");
  EXPECT_TRUE(CompareToBaseline(Ramp(), "Ramp", Threshold, folder).Passed);
}
