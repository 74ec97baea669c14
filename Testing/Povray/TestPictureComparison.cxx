// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Counts of pixels in pictures made by hand.
#include "PictureComparison.h"
#include "TestBasics.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 20;

using Color = std::array<unsigned char, 3>;
constexpr Color Black{ 0, 0, 0 };
constexpr Color Gray{ 100, 100, 100 };
constexpr Color Red{ 255, 0, 0 };
constexpr Color White{ 255, 255, 255 };

ByteImage MakePicture(const std::function<Color(int x, int y)>& colorOf)
{
  ByteImage image;
  image.Width = Size;
  image.Height = Size;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const Color color = colorOf(x, y);
      image.Rgb.insert(image.Rgb.end(), color.begin(), color.end());
    }
  }
  return image;
}

/** Black left of a column, white from there. */
ByteImage MakeEdge(int column)
{
  return MakePicture([column](int x, int) { return x < column ? Black : White; });
}

} // anonymous namespace

TEST(PictureComparison, EqualPicturesHaveEdgesAndNoDifference)
{
  const PictureComparison result = ComparePictures(MakeEdge(7), MakeEdge(7));
  EXPECT_EQ(result.Pixels, Size * Size);
  EXPECT_EQ(result.EdgeLength, Size);
  EXPECT_EQ(result.EdgePixels, 2 * Size);
  EXPECT_TRUE(result.Different.empty());
  EXPECT_EQ(result.GetFraction(), 0.0);
}

TEST(PictureComparison, DisplacedEdgesDifferOnEdges)
{
  const PictureComparison near = ComparePictures(MakeEdge(8), MakeEdge(7));
  EXPECT_EQ(near.Different.size(), static_cast<std::size_t>(Size));
  EXPECT_EQ(near.DifferentOffEdges, 0);
  EXPECT_DOUBLE_EQ(near.GetFraction(), 1.0 / Size);
  const PictureComparison far = ComparePictures(MakeEdge(10), MakeEdge(7));
  EXPECT_EQ(far.Different.size(), static_cast<std::size_t>(3 * Size));
  EXPECT_EQ(far.DifferentOffEdges, 2 * Size);
  EXPECT_DOUBLE_EQ(far.FractionOffEdges(), 2.0 / Size);
}

TEST(PictureComparison, SmallDifferencesOfColorDoNotCount)
{
  const auto level = [](int value)
  {
    const auto byte = static_cast<unsigned char>(value);
    return MakePicture([byte](int, int) { return Color{ byte, 50, 50 }; });
  };
  EXPECT_TRUE(ComparePictures(level(58), level(50)).Different.empty());
  EXPECT_EQ(
    ComparePictures(level(59), level(50)).Different.size(), static_cast<std::size_t>(Size * Size));
}

TEST(PictureComparison, SingleWrongPixelIsFound)
{
  const ByteImage drawn = MakePicture([](int x, int y) { return x == 3 && y == 16 ? Red : White; });
  const PictureComparison result =
    ComparePictures(drawn, MakePicture([](int, int) { return White; }));
  ASSERT_EQ(result.Different.size(), 1u);
  EXPECT_EQ(result.Different[0].X, 3);
  EXPECT_EQ(result.Different[0].Y, 16);
  EXPECT_EQ(result.DifferentOffEdges, 1);
}

TEST(PictureComparison, CloseUpsExplainWhatTheyShow)
{
  const ObjectColors object{ Black, White };
  const ByteImage border = MakePicture([](int x, int) { return x < 5 ? Gray : White; });
  // Its own colour; the colour of a face that the object's border may show.
  EXPECT_TRUE(IsExplained(White.data(), border, object));
  EXPECT_TRUE(IsExplained(Black.data(), border, object));
  // Within the object there is no hidden face; far from it, nothing of it.
  const ByteImage inside = MakePicture([](int, int) { return White; });
  EXPECT_FALSE(IsExplained(Black.data(), inside, object));
  const ByteImage outside = MakePicture([](int, int) { return Gray; });
  EXPECT_FALSE(IsExplained(Black.data(), outside, object));
  // The background, which is no object.
  EXPECT_FALSE(IsExplained(Red.data(), border, {}));
  EXPECT_TRUE(IsExplained(Gray.data(), border, {}));
}

TEST(PictureComparison, LimitIsTheSweptArea)
{
  PictureComparison comparison;
  comparison.EdgeLength = 1000;
  EXPECT_DOUBLE_EQ(LargestDifference(comparison, 0.1, 0.0), 130.0); // 100 + 3 * 10
  EXPECT_DOUBLE_EQ(LargestDifference(comparison, 0.0, 25.0), 40.0); // 25 + 3 * 5
  EXPECT_EQ(LargestDifference(comparison, 0.0, 0.0), 0.0);
}
