// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Every operation of the SIMD types compared with scalar code, to the bit. AVX2 and AVX-512 need
// their own compiler options; they are covered by the images of PacketWalkTest and
// PacketOpticsTest.
#include "Simd/SimdPair.h"
#include "Simd/SimdPortable.h"
#ifdef __aarch64__
#include "Simd/SimdNEON.h"
#include "TestBasics.h"
#endif

namespace
{

using meniscus::SimdPortable;

constexpr int Rounds = 2000;

template <class Simd>
class SimdOperations : public ::testing::Test
{
protected:
  static constexpr int Width = Simd::Width;
  using Float = typename Simd::Float;
  using Int = typename Simd::Int;
  using Mask = typename Simd::Mask;

  /** Numbers of all magnitudes, with zeros of both signs, infinities and NaN. */
  float AnyFloat()
  {
    static const float special[] = { 0.0f, -0.0f, 1.0f, std::numeric_limits<float>::infinity(),
      -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(),
      std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max() };
    if (this->Random() % 4 == 0)
    {
      return special[this->Random() % 8];
    }
    return this->Finite();
  }
  /** A number within 2^-10 to 2^10, of either sign. */
  float Finite()
  {
    const float size = std::ldexp(1.0f + static_cast<float>(this->Random() % 4096) / 4096.0f,
      static_cast<int>(this->Random() % 20) - 10);
    return this->Random() % 2 == 0 ? size : -size;
  }
  std::int32_t AnyInt()
  {
    static const std::int32_t special[] = { 0, 1, -1, INT32_MAX, INT32_MIN };
    return this->Random() % 4 == 0 ? special[this->Random() % 5]
                                   : static_cast<std::int32_t>(this->Random());
  }

  static void ExpectSame(const Float& value, const float (&expected)[Width], const char* name)
  {
    float lanes[Width];
    Simd::Store(lanes, value);
    for (int i = 0; i < Width; ++i)
    {
      const bool bothNaN = std::isnan(lanes[i]) && std::isnan(expected[i]);
      EXPECT_TRUE(bothNaN || std::memcmp(lanes + i, expected + i, sizeof(float)) == 0)
        << name << ", lane " << i << ": " << lanes[i] << " for " << expected[i];
    }
  }
  static void ExpectSame(const Int& value, const std::int32_t (&expected)[Width], const char* name)
  {
    std::int32_t lanes[Width];
    Simd::Store(lanes, value);
    for (int i = 0; i < Width; ++i)
    {
      EXPECT_EQ(lanes[i], expected[i]) << name << ", lane " << i;
    }
  }
  static void ExpectSame(const Mask& value, const bool (&expected)[Width], const char* name)
  {
    unsigned int bits = 0;
    for (int i = 0; i < Width; ++i)
    {
      bits |= (expected[i] ? 1u : 0u) << i;
    }
    EXPECT_EQ(Simd::Bits(value), bits) << name;
  }

  /** Fills lanes and, by a function of the lane's index, the expected values. */
  template <typename T, typename Make>
  static void Fill(T (&lanes)[Width], const Make& make)
  {
    for (int i = 0; i < Width; ++i)
    {
      lanes[i] = make(i);
    }
  }

  std::mt19937 Random{ 20261122 };
};

#ifdef __aarch64__
using Sets = ::testing::Types<SimdPortable, meniscus::SimdPair<SimdPortable>, meniscus::SimdNEON>;
#else
using Sets = ::testing::Types<SimdPortable, meniscus::SimdPair<SimdPortable>>;
#endif
TYPED_TEST_SUITE(SimdOperations, Sets);

}

TYPED_TEST(SimdOperations, FloatArithmeticAndComparisons)
{
  using Simd = TypeParam;
  constexpr int width = Simd::Width;
  for (int round = 0; round < Rounds; ++round)
  {
    float a[width];
    float b[width];
    float expected[width];
    bool truth[width];
    this->Fill(a, [&](int) { return this->AnyFloat(); });
    this->Fill(b, [&](int) { return this->AnyFloat(); });
    const auto x = Simd::Load(a);
    const auto y = Simd::Load(b);
    this->Fill(expected, [&](int i) { return a[i] + b[i]; });
    this->ExpectSame(x + y, expected, "sum");
    this->Fill(expected, [&](int i) { return a[i] - b[i]; });
    this->ExpectSame(x - y, expected, "difference");
    this->Fill(expected, [&](int i) { return a[i] * b[i]; });
    this->ExpectSame(x * y, expected, "product");
    this->Fill(expected, [&](int i) { return a[i] / b[i]; });
    this->ExpectSame(x / y, expected, "quotient");
    this->Fill(expected, [&](int i) { return a[i] < b[i] ? a[i] : b[i]; });
    this->ExpectSame(Simd::Min(x, y), expected, "minimum");
    this->Fill(expected, [&](int i) { return a[i] > b[i] ? a[i] : b[i]; });
    this->ExpectSame(Simd::Max(x, y), expected, "maximum");
    this->Fill(expected, [&](int i) { return std::fabs(a[i]); });
    this->ExpectSame(Simd::Abs(x), expected, "absolute value");
    this->Fill(expected, [&](int i) { return std::sqrt(std::fabs(a[i])); });
    this->ExpectSame(Simd::Sqrt(Simd::Abs(x)), expected, "square root");
    this->Fill(truth, [&](int i) { return a[i] < b[i]; });
    this->ExpectSame(x < y, truth, "less");
    this->Fill(truth, [&](int i) { return a[i] > b[i]; });
    this->ExpectSame(x > y, truth, "greater");
    std::int32_t bits[width];
    std::memcpy(bits, a, sizeof(bits));
    this->ExpectSame(Simd::AsInt(x), bits, "bits");
  }
}

TYPED_TEST(SimdOperations, FusedOperationsAreWithinTheirRounding)
{
  using Simd = TypeParam;
  constexpr int width = Simd::Width;
  // One rounding of the result and, without a fused operation, one of each product: 2^-24 each.
  const double unit = std::ldexp(1.0, -24);
  for (int round = 0; round < Rounds; ++round)
  {
    float v[4][width];
    for (float(&lanes)[width] : v)
    {
      this->Fill(lanes, [&](int) { return this->Finite(); });
    }
    float sum[width];
    float cross[width];
    Simd::Store(sum, Simd::Fma(Simd::Load(v[0]), Simd::Load(v[1]), Simd::Load(v[2])));
    Simd::Store(cross,
      Simd::CrossProduct(Simd::Load(v[0]), Simd::Load(v[1]), Simd::Load(v[2]), Simd::Load(v[3])));
    for (int i = 0; i < width; ++i)
    {
      const double ab = static_cast<double>(v[0][i]) * v[1][i];
      const double ad = static_cast<double>(v[0][i]) * v[3][i];
      const double bc = static_cast<double>(v[1][i]) * v[2][i];
      EXPECT_NEAR(sum[i], ab + v[2][i], unit * (std::fabs(ab) + std::fabs(ab + v[2][i])));
      EXPECT_NEAR(
        cross[i], ad - bc, unit * (std::fabs(ad) + std::fabs(bc) + 2.0 * std::fabs(ad - bc)));
    }
  }
}

TYPED_TEST(SimdOperations, IntegersAndMasks)
{
  using Simd = TypeParam;
  constexpr int width = Simd::Width;
  const auto wrap = [](std::int64_t value)
  { return static_cast<std::int32_t>(static_cast<std::uint32_t>(value)); };
  for (int round = 0; round < Rounds; ++round)
  {
    std::int32_t a[width];
    std::int32_t b[width];
    std::int32_t expected[width];
    bool truth[width];
    // Half the range: sums that overflow are undefined in the portable set.
    this->Fill(a, [&](int) { return this->AnyInt() / 2; });
    this->Fill(b, [&](int) { return this->AnyInt() / 2; });
    const auto x = Simd::Load(a);
    const auto y = Simd::Load(b);
    this->Fill(expected, [&](int i) { return wrap(std::int64_t{ a[i] } + b[i]); });
    this->ExpectSame(x + y, expected, "sum");
    this->Fill(expected, [&](int i) { return wrap(std::int64_t{ a[i] } - b[i]); });
    this->ExpectSame(x - y, expected, "difference");
    this->Fill(expected, [&](int i) { return a[i] & b[i]; });
    this->ExpectSame(Simd::And(x, y), expected, "and");
    this->Fill(truth, [&](int i) { return a[i] < b[i]; });
    const auto less = x < y;
    this->ExpectSame(less, truth, "less");
    this->ExpectSame(y > x, truth, "greater");
    this->ExpectSame(Simd::FromBits(Simd::Bits(less)), truth, "mask from bits");
    this->Fill(expected, [&](int i) { return truth[i] ? 1 : 0; });
    this->ExpectSame(Simd::One(less), expected, "one");
    this->Fill(expected, [&](int i) { return a[i] + (truth[i] ? 1 : 0); });
    this->ExpectSame(Simd::Increment(less, x), expected, "increment");
    this->Fill(expected, [&](int i) { return a[i] - (truth[i] ? 1 : 0); });
    this->ExpectSame(Simd::Decrement(less, x), expected, "decrement");
    this->Fill(expected, [&](int i) { return truth[i] ? a[i] : b[i]; });
    this->ExpectSame(Simd::Select(less, x, y), expected, "selection");
    const unsigned int other = static_cast<unsigned int>(this->Random()) & ((1u << width) - 1u);
    const auto mask = Simd::FromBits(other);
    const unsigned int bits = Simd::Bits(less);
    EXPECT_EQ(Simd::Bits(less & mask), bits & other);
    EXPECT_EQ(Simd::Bits(less | mask), bits | other);
    EXPECT_EQ(Simd::Bits(Simd::AndNot(less, mask)), bits & ~other);
    EXPECT_EQ(Simd::Bits(Simd::Not(mask)), ~other & ((1u << width) - 1u));
    float rounded[width];
    this->Fill(rounded, [&](int i) { return static_cast<float>(a[i]); });
    this->ExpectSame(Simd::ToFloat(x), rounded, "conversion");
  }
}

TYPED_TEST(SimdOperations, RoundsToTheNearestInteger)
{
  using Simd = TypeParam;
  constexpr int width = Simd::Width;
  for (int round = 0; round < 1000; ++round)
  {
    float values[width];
    std::int32_t expected[width];
    for (int i = 0; i < width; ++i)
    {
      // Halves, as many as fit into the digits of a float, and numbers of any size.
      const int shift = 1 + std::abs(this->AnyInt() % 8);
      const std::int32_t number = this->AnyInt() >> (round % 2 == 0 ? 8 : shift);
      values[i] = static_cast<float>(number) * (round % 2 == 0 ? 0.5f : 1.0f);
      expected[i] = static_cast<std::int32_t>(std::nearbyint(double{ values[i] }));
    }
    this->ExpectSame(Simd::ToInt(Simd::Load(values)), expected, "rounding");
  }
}

TYPED_TEST(SimdOperations, ShiftsAndTablesOfWords)
{
  using Simd = TypeParam;
  constexpr int width = Simd::Width;
  std::int32_t table[32];
  for (std::int32_t& word : table)
  {
    word = this->AnyInt() & 0x7fffffff;
  }
  for (int round = 0; round < Rounds; ++round)
  {
    std::int32_t a[width];
    std::int32_t by[width];
    std::int32_t expected[width];
    this->Fill(a, [&](int) { return this->AnyInt() & 0x7fffffff; });
    this->Fill(by, [&](int) { return static_cast<std::int32_t>(this->Random() % 32); });
    this->Fill(expected, [&](int i) { return a[i] >> by[i]; });
    this->ExpectSame(Simd::ShiftRight(Simd::Load(a), Simd::Load(by)), expected, "shift");
    this->Fill(by, [&](int) { return static_cast<std::int32_t>(this->Random() % 24); });
    this->Fill(expected, [&](int i) { return table[by[i]]; });
    this->ExpectSame(Simd::LookupOf24(table, Simd::Load(by)), expected, "word");
  }
}

// Coordinates about rays and signs of edges are the same to the last bit in every set. Factors are
// chosen so that their products nearly cancel.
TYPED_TEST(SimdOperations, ProductsAreSubtractedWithOneRounding)
{
  using Simd = TypeParam;
  constexpr int width = Simd::Width;
  int cancelled = 0;
  for (int round = 0; round < Rounds; ++round)
  {
    float a[width];
    float b[width];
    float c[width];
    float d[width];
    float expected[width];
    const auto anyFactor = [&](int)
    {
      // Coordinates are multiples of 2^-63 (ExactEdgeTest), and so are the neighbours of these.
      const auto digits = static_cast<float>(this->AnyInt() | 1);
      return std::ldexp(digits, static_cast<int>(this->Random() % 39) - 38);
    };
    this->Fill(b, anyFactor);
    this->Fill(c, anyFactor);
    this->Fill(a, [&](int i) { return b[i] * c[i]; });
    this->Fill(expected, [&](int i) { return std::fma(-b[i], c[i], a[i]); });
    this->ExpectSame(
      Simd::SubtractProduct(Simd::Load(a), Simd::Load(b), Simd::Load(c)), expected, "rest");
    // a d - b c for a = b (1 + x), d = c (1 - x), to the nearest floats.
    this->Fill(a, [&](int i) { return std::nextafter(b[i], 0.0f); });
    this->Fill(d, [&](int i) { return std::nextafter(c[i], i % 2 == 0 ? 1e30f : -1e30f); });
    const auto result =
      Simd::CrossProduct(Simd::Load(a), Simd::Load(b), Simd::Load(c), Simd::Load(d));
    float determinants[width];
    Simd::Store(determinants, result);
    for (int i = 0; i < width; ++i)
    {
      // Products of floats are exact in long double, and so is the sign of their difference.
      const long double exact =
        static_cast<long double>(a[i]) * d[i] - static_cast<long double>(b[i]) * c[i];
      const long double error = std::fabs(static_cast<long double>(determinants[i]) - exact);
      EXPECT_LE(error, std::fabs(exact) * std::ldexp(1.0L, -22)) << a[i] << " " << d[i];
      EXPECT_EQ(determinants[i] > 0.0f, exact > 0.0L);
      EXPECT_EQ(determinants[i] < 0.0f, exact < 0.0L);
      cancelled += a[i] * d[i] == b[i] * c[i] && exact != 0.0L;
    }
  }
  EXPECT_GT(cancelled, 10);
}

TYPED_TEST(SimdOperations, GathersAndLookUps)
{
  using Simd = TypeParam;
  constexpr int width = Simd::Width;
  std::vector<float> table(64 * 5);
  std::vector<std::int32_t> pairs(2 * 256);
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    table[i] = static_cast<float>(i) - 7.5f;
  }
  for (std::int32_t& number : pairs)
  {
    // Places in the table, and negative numbers: links to no neighbour, and marked links.
    number = static_cast<std::int32_t>(this->Random() % 512) - 256;
  }
  for (int round = 0; round < Rounds; ++round)
  {
    std::int32_t at[width];
    this->Fill(at, [&](int) { return static_cast<std::int32_t>(this->Random() % 64); });
    const auto index = Simd::Load(at);
    typename Simd::Float q[4];
    float expected[width];
    Simd::template GatherQuads<5>(table.data(), index, q[0], q[1], q[2], q[3]);
    for (int k = 0; k < 4; ++k)
    {
      this->Fill(expected, [&](int i) { return table[5 * at[i] + k]; });
      this->ExpectSame(q[k], expected, "quadruple");
    }
    Simd::GatherTriples(table.data(), index, q[0], q[1], q[2]);
    for (int k = 0; k < 3; ++k)
    {
      this->Fill(expected, [&](int i) { return table[3 * at[i] + k]; });
      this->ExpectSame(q[k], expected, "triple");
    }
    std::int32_t face[width];
    this->Fill(face, [&](int) { return static_cast<std::int32_t>(this->Random() % 256); });
    typename Simd::Int pair[2];
    Simd::FollowPairs(pairs.data(), Simd::Load(face), pair[0], pair[1]);
    for (int k = 0; k < 2; ++k)
    {
      std::int32_t number[width];
      this->Fill(number, [&](int i) { return pairs[2 * face[i] + k]; });
      this->ExpectSame(pair[k], number, "number of a pair");
    }
    this->Fill(expected, [&](int i) { return table[face[i] / 4]; });
    this->ExpectSame(
      Simd::GatherCellScalars(table.data(), Simd::Load(face)), expected, "cell scalar");
    this->Fill(face, [&](int) { return static_cast<std::int32_t>(this->Random() % 16); });
    this->Fill(expected, [&](int i) { return table[face[i]]; });
    this->ExpectSame(
      (Simd::template Lookup<2>(table.data(), Simd::Load(face))), expected, "table entry");
  }
}
