// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/ByteDigest.h"
#include "TestBasics.h"

using namespace meniscus::test;
using namespace meniscus;

namespace
{

std::vector<unsigned char> RandomBytes(std::size_t size)
{
  std::mt19937 random(11);
  std::vector<unsigned char> bytes(size);
  for (unsigned char& byte : bytes)
  {
    byte = static_cast<unsigned char>(random());
  }
  return bytes;
}

std::uint64_t DigestOf(const std::vector<unsigned char>& bytes)
{
  return DigestBytes(bytes.data(), bytes.size());
}

}

TEST(ByteDigest, EveryBitCounts)
{
  // Lengths around those of words, pairs of words and pieces of 1024 bytes.
  for (const std::size_t size : { 1, 7, 8, 9, 15, 16, 17, 33, 1023, 1024, 1025, 2500 })
  {
    std::vector<unsigned char> bytes = RandomBytes(size);
    std::set<std::uint64_t> digests{ DigestOf(bytes) };
    for (unsigned char& byte : bytes)
    {
      for (int bit = 0; bit < 8; ++bit)
      {
        byte = static_cast<unsigned char>(byte ^ (1 << bit));
        digests.insert(DigestOf(bytes));
        byte = static_cast<unsigned char>(byte ^ (1 << bit));
      }
    }
    EXPECT_EQ(digests.size(), 8 * size + 1) << size;
  }
}

TEST(ByteDigest, NumberOfZerosCounts)
{
  const std::vector<unsigned char> zeros(3000, 0);
  std::set<std::uint64_t> digests;
  for (std::size_t size = 0; size <= zeros.size(); ++size)
  {
    digests.insert(DigestBytes(zeros.data(), size));
  }
  EXPECT_EQ(digests.size(), zeros.size() + 1);
}

TEST(ByteDigest, OrderOfWordsCounts)
{
  const std::vector<unsigned char> bytes = RandomBytes(3072);
  std::set<std::uint64_t> digests{ DigestOf(bytes) };
  const std::size_t words = bytes.size() / 8;
  std::size_t count = 1;
  for (const auto& [i, distance] : Product(Below<std::size_t>(words), List(1, 2, 3, 128, 256)))
  {
    if (i + distance < words)
    {
      std::vector<unsigned char> swapped = bytes;
      std::swap_ranges(
        swapped.begin() + 8 * i, swapped.begin() + 8 * i + 8, swapped.begin() + 8 * (i + distance));
      digests.insert(DigestOf(swapped));
      ++count;
    }
  }
  EXPECT_EQ(digests.size(), count);
}

TEST(ByteDigest, DoesNotDependOnThePlaceInMemory)
{
  const std::vector<unsigned char> bytes = RandomBytes(2500);
  std::vector<unsigned char> memory(bytes.size() + 16, 0xff);
  for (std::size_t offset = 0; offset < 16; ++offset)
  {
    std::memcpy(memory.data() + offset, bytes.data(), bytes.size());
    EXPECT_EQ(DigestBytes(memory.data() + offset, bytes.size()), DigestOf(bytes)) << offset;
  }
}

TEST(PolynomialSum, IsThatOfWholeNumbers)
{
  // x^3 + 5 x^2 + 7 x + 11 for x = 2^32, modulo 2^61 - 1: x^2 is 8, x^3 is 8 x.
  PolynomialSum sum(std::uint64_t{ 1 } << 32);
  for (const std::uint64_t coefficient : { 5, 7, 11 })
  {
    sum.AddCoefficient(coefficient);
  }
  EXPECT_EQ(sum.GetValue(), (std::uint64_t{ 15 } << 32) + 51);
}
