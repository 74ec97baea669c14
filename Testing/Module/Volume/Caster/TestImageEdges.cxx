// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Edges of images that are known.
#include "TestBasics.h"
#include "Volume/Caster/ImageEdges.h"

using namespace meniscus::test;
using namespace meniscus;

namespace
{

constexpr int Width = 11;
constexpr int Height = 9;

/** Edges of an image whose opacity is a function of column and row. */
std::vector<std::uint8_t> EdgesOf(
  const std::function<float(int, int)>& opacity, int width = Width, int height = Height)
{
  std::vector<float> image;
  for (const auto& [row, column] : Product(height, width))
  {
    image.insert(image.end(), { 0.0f, 0.0f, 0.0f, opacity(column, row) });
  }
  std::vector<std::uint8_t> edges;
  FindImageEdges(image, width, height, { 0, width, 0, height }, SerialLoop, edges);
  return edges;
}

} // anonymous namespace

TEST(ImageEdges, LinearImagesHaveThemAtTheBorderAtMost)
{
  const auto edges =
    EdgesOf([](int column, int row) { return 0.02f * column + 0.03f * row + 0.1f; });
  for (const auto& [row, column] : Product(Numbers<int>(1, Height - 1), Numbers<int>(1, Width - 1)))
  {
    EXPECT_EQ(edges[row * Width + column], 0) << column << ", " << row;
  }
}

TEST(ImageEdges, BothSidesOfAStep)
{
  for (const float height : { 0.9f * EdgeThreshold, 1.1f * EdgeThreshold })
  {
    const bool isEdge = height > EdgeThreshold;
    const auto upright =
      EdgesOf([height](int column, int) { return column < 5 ? 0.3f : 0.3f + height; });
    const auto diagonal =
      EdgesOf([height](int column, int row) { return column < row ? 0.3f : 0.3f + height; });
    for (const auto& [row, column] : Product(Height, Width))
    {
      const std::size_t pixel = static_cast<std::size_t>(row * Width + column);
      const bool isBeside = column == 4 || column == 5;
      EXPECT_EQ(upright[pixel], isEdge && isBeside ? 2 : 0) << column << ", " << row;
      const bool isNear = column == row || column == row - 1;
      EXPECT_TRUE(diagonal[pixel] != 0 || !(isEdge && isNear)) << column << ", " << row;
      EXPECT_TRUE(diagonal[pixel] == 0 || isEdge) << column << ", " << row;
    }
  }
}

TEST(ImageEdges, OneRowOrColumn)
{
  const auto nothing = [](int, int) { return 0.0f; };
  EXPECT_EQ(EdgesOf(nothing, 1, 1), std::vector<std::uint8_t>(1, PixelEdge::HighestLevel));
  EXPECT_EQ(EdgesOf(nothing, 7, 1), std::vector<std::uint8_t>(7, PixelEdge::HighestLevel));
  EXPECT_EQ(EdgesOf(nothing, 1, 7), std::vector<std::uint8_t>(7, PixelEdge::HighestLevel));
  EXPECT_EQ(EdgesOf(nothing, 2, 2), std::vector<std::uint8_t>(4, 0));
}

TEST(ImageEdges, PixelsNextToTheFilledBoxCount)
{
  std::vector<float> image(std::size_t{ 4 } * Width * Height, 0.0f);
  image[4 * (4 * Width + 5) + 1] = 1.0f;
  std::vector<std::uint8_t> edges;
  FindImageEdges(image, Width, Height, { 5, 6, 4, 5 }, SerialLoop, edges);
  for (const auto& [row, column] : Product(Height, Width))
  {
    const bool isNear = std::abs(column - 5) <= 1 && std::abs(row - 4) <= 1;
    EXPECT_EQ(edges[row * Width + column] != 0, isNear) << column << ", " << row;
  }
  FindImageEdges(image, Width, Height, { Width, 0, Height, 0 }, SerialLoop, edges);
  EXPECT_EQ(edges, std::vector<std::uint8_t>(Width * Height, 0));
}

TEST(ImageEdges, LevelsFollowHeights)
{
  for (const float octaves : { 0.01f, 0.5f, 1.0f, 3.3f, 6.0f })
  {
    const float height = EdgeThreshold * std::exp2(octaves);
    const PixelEdge edge = PixelEdge::Make(height, true);
    EXPECT_TRUE(edge.IsFalling());
    EXPECT_EQ(PixelEdge(edge.GetCode()).GetLevel(), edge.GetLevel());
    EXPECT_GE(StepOfLevel(edge.GetLevel()), 0.9999f * height);
    EXPECT_LE(StepOfLevel(edge.GetLevel() - 1), 1.0001f * height);
  }
  EXPECT_EQ(PixelEdge::Make(1.0e+30f, false).GetLevel(), PixelEdge::HighestLevel);
  EXPECT_FALSE(PixelEdge::Make(1.0f, false).IsFalling());
}

TEST(ImageEdges, TheDiagonalOfTheLargerChangeIsKnown)
{
  // An edge that rises to the right changes the colour along the falling diagonal.
  const auto rising = EdgesOf([](int column, int row) { return column < row ? 0.0f : 1.0f; });
  const auto falling = EdgesOf([](int column, int row) { return column + row < 8 ? 0.0f : 1.0f; });
  const std::size_t middle = 4 * Width + 4;
  EXPECT_TRUE(PixelEdge(rising[middle]).IsFalling());
  EXPECT_GT(PixelEdge(falling[middle]).GetLevel(), 0);
  EXPECT_FALSE(PixelEdge(falling[middle]).IsFalling());
}

TEST(ImageEdges, ToleratedLevelBoundsRaysAndError)
{
  constexpr std::size_t pixels = 10000;
  const auto picture = [](std::size_t edges, float height)
  {
    std::vector<std::uint8_t> codes(pixels, 0);
    std::fill_n(codes.begin(), edges, PixelEdge::Make(height, false).GetCode());
    return codes;
  };
  EXPECT_EQ(ChooseEdgeLevel(picture(0, 1.0f), 0, 4), 0);
  // One pixel of a hundred has edges: they get all rays that they need.
  EXPECT_EQ(ChooseEdgeLevel(picture(100, 1.0f), pixels, 4), 0);
  // The square of the error is 0.6 of that of the tolerated step, and that of the mean of all
  // pixels 0.97^2 of that of EdgeThreshold.
  for (const std::size_t share : { 3, 9 })
  {
    const double largest = EdgeThreshold * std::sqrt(0.97 * 0.97 / 0.6 * share);
    const float limit = StepOfLevel(ChooseEdgeLevel(picture(pixels / share, 1.0f), 100, 4));
    EXPECT_LE(limit, largest);
    EXPECT_GT(limit, 0.9 * largest);
  }
  // They get 2.2 rays each, of 0.8 for each of the image.
  const float low = 1.5f * EdgeThreshold;
  EXPECT_EQ(ChooseEdgeLevel(picture(1000, low), 2760, 4), 0);
  EXPECT_GE(StepOfLevel(ChooseEdgeLevel(picture(1000, low), 2740, 4)), low);
  // A square of one ray has 9/16 of it.
  EXPECT_EQ(ChooseEdgeLevel(picture(1000, low), 710, 1), 0);
}

TEST(ImageEdges, ToleratedEdgesBecomeSmooth)
{
  constexpr int width = 4;
  constexpr int height = 2;
  std::vector<float> image(4 * width * height, 0.0f);
  for (const int pixel : { 2, 3, 6, 7 })
  {
    image[4 * pixel + 3] = 0.6f;
  }
  const std::vector<std::uint8_t> edges = { 0, 3, 4, 0, 0, 5, 4, 0 };
  std::vector<float> smooth = image;
  SmoothEdges(image, width, height, edges, 4, { 0, width, 0, height }, smooth);
  const float expected[8] = { 0.0f, 0.05f, 0.55f, 0.6f, 0.0f, 0.0f, 0.55f, 0.6f };
  for (std::size_t pixel = 0; pixel < 8; ++pixel)
  {
    EXPECT_FLOAT_EQ(smooth[4 * pixel + 3], expected[pixel]) << pixel;
    EXPECT_EQ(smooth[4 * pixel], 0.0f);
  }
}
