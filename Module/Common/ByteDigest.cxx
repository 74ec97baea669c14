// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/ByteDigest.h"

#include <cstring>

namespace meniscus
{
namespace
{

/** Words of a piece. */
constexpr std::size_t PieceWords = 128;
constexpr std::size_t PieceBytes = PieceWords * sizeof(std::uint64_t);
/** Bytes of a pair of words, whose sums with their keys are multiplied. */
constexpr std::size_t PairBytes = 2 * sizeof(std::uint64_t);

/** The first 61 bits after the point of pi. */
constexpr std::uint64_t PlaceOfPieces = 0x0487ed5110b4611au;

/**
 * Keys: numbers of the generator SplitMix64 (G. Steele, D. Lea, C. Flood, 2014), from the second 64
 * bits after the point of pi.
 */
struct KeyTable
{
  std::uint64_t Words[PieceWords]{};

  constexpr KeyTable()
  {
    std::uint64_t state = 0x13198a2e03707344u;
    for (std::uint64_t& word : this->Words)
    {
      state += 0x9e3779b97f4a7c15u;
      word = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
      word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
      word = word ^ (word >> 31);
    }
  }
};
constexpr KeyTable Keys;

unsigned __int128 ProductOfPair(const unsigned char* bytes, const std::uint64_t* keys)
{
  std::uint64_t words[2];
  std::memcpy(words, bytes, PairBytes);
  return static_cast<unsigned __int128>(words[0] + keys[0]) * (words[1] + keys[1]);
}

/** Adds the sum of the pairs of a piece. */
void AddPiece(const unsigned char* bytes, std::size_t pairs, PolynomialSum& digest)
{
  // Two sums, each of which waits for its own additions only.
  unsigned __int128 sums[2] = { 0, 0 };
  std::size_t pair = 0;
  for (; pair + 1 < pairs; pair += 2)
  {
    sums[0] += ProductOfPair(bytes + pair * PairBytes, Keys.Words + 2 * pair);
    sums[1] += ProductOfPair(bytes + (pair + 1) * PairBytes, Keys.Words + 2 * (pair + 1));
  }
  if (pair < pairs)
  {
    sums[0] += ProductOfPair(bytes + pair * PairBytes, Keys.Words + 2 * pair);
  }
  const unsigned __int128 sum = sums[0] + sums[1];
  constexpr int third = 43; // bits: three coefficients have all 128 of the sum
  constexpr std::uint64_t mask = (std::uint64_t{ 1 } << third) - 1;
  digest.AddCoefficient(static_cast<std::uint64_t>(sum) & mask);
  digest.AddCoefficient(static_cast<std::uint64_t>(sum >> third) & mask);
  digest.AddCoefficient(static_cast<std::uint64_t>(sum >> 2 * third));
}

}

//------------------------------------------------------------------------------
std::uint64_t DigestBytes(const unsigned char* bytes, std::size_t size)
{
  PolynomialSum digest(PlaceOfPieces);
  std::size_t at = 0;
  for (; at + PieceBytes <= size; at += PieceBytes)
  {
    AddPiece(bytes + at, PieceBytes / PairBytes, digest);
  }
  if (at < size)
  {
    // Zeros follow the last bytes, the number of which counts.
    unsigned char rest[PieceBytes] = {};
    std::memcpy(rest, bytes + at, size - at);
    AddPiece(rest, (size - at + PairBytes - 1) / PairBytes, digest);
  }
  digest.AddWord(size);
  return digest.GetValue();
}

}
