// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Codes of positions along the Morton curve, and the order that they give.
#include "Common/MortonOrder.h"
#include "TestBasics.h"

using namespace meniscus;

TEST(MortonOrder, WholeNumbersHaveTheCodesOfTheirPlaces)
{
  const MortonCurve curve(glm::dvec3(-1.0), glm::dvec3(1.0));
  const std::int64_t end = std::int64_t{ 1 } << 32;
  for (const std::int64_t value : { -end, -end + 1, std::int64_t{ -12345678 }, std::int64_t{ 0 },
         std::int64_t{ 987654321 }, end - 1, end })
  {
    const std::int64_t position[3] = { value, -value, value / 3 };
    const glm::dvec3 place = glm::dvec3(position[0], position[1], position[2]) / double(end);
    EXPECT_EQ(MortonCode(position, 33), curve.Code(place)) << value;
  }
}

TEST(MortonOrder, SortsStablyAndClampsToTheBox)
{
  const std::vector<std::uint32_t> codes = { 5, 1u << 29, 5, 0, 40000 };
  std::vector<MortonKey> keys;
  for (std::size_t i = 0; i < codes.size(); ++i)
  {
    keys.push_back(MakeMortonKey(codes[i], i));
  }
  SortByCode(keys);
  std::vector<std::size_t> order;
  std::transform(keys.begin(), keys.end(), std::back_inserter(order), IndexOf);
  EXPECT_EQ(order, (std::vector<std::size_t>{ 3, 0, 2, 4, 1 }));
  const MortonCurve curve(glm::dvec3(0.0), glm::dvec3(1.0, 1.0, 0.0));
  EXPECT_EQ(curve.Code(glm::dvec3(-5.0)), 0u);
  EXPECT_EQ(curve.Code(glm::dvec3(9.0, 9.0, 9.0)), 0x1B6DB6DBu); // x and y full, z flat
}

TEST(MortonOrder, TakesBoxesThatAreTooFlatForTheirScale)
{
  // 1024 cells per 1e-310 are beyond the range of double, and so is the length of the other box.
  const MortonCurve thin(glm::dvec3(0.0), glm::dvec3(1.0, 1.0, 1e-310));
  EXPECT_EQ(thin.Code(glm::dvec3(0.0)), 0u);
  EXPECT_EQ(thin.Code(glm::dvec3(0.0, 0.0, 1e-310)), 0x24924924u); // z full
  const MortonCurve vast(glm::dvec3(-1e308), glm::dvec3(1e308));
  EXPECT_EQ(vast.Code(glm::dvec3(-1e308)), 0u);
  EXPECT_EQ(vast.Code(glm::dvec3(1e308)), 0u);
}
