// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace meniscus
{

/**
 * Value of a polynomial over the field of 2^61 - 1 elements, whose coefficients come one by one.
 * Two different polynomials of degree n agree in at most n places of the field.
 */
class PolynomialSum
{
public:
  /** @param place at which the polynomial is evaluated, less than the size of the field. */
  explicit PolynomialSum(std::uint64_t place)
    : Place(place)
  {
  }
  /** Adds a coefficient of less than 2^60. */
  void AddCoefficient(std::uint64_t coefficient)
  {
    // The sum stays below the size of the field + 8.
    const auto product = static_cast<unsigned __int128>(this->Sum) * this->Place;
    const std::uint64_t folded = (static_cast<std::uint64_t>(product) & FieldSize) +
      static_cast<std::uint64_t>(product >> 61) + coefficient;
    this->Sum = (folded & FieldSize) + (folded >> 61);
  }
  /** Adds a number as two coefficients: it may exceed the field. */
  void AddWord(std::uint64_t word)
  {
    this->AddCoefficient(word >> 32);
    this->AddCoefficient(word & 0xffffffffu);
  }
  /** The value, less than the size of the field. */
  std::uint64_t GetValue() const { return this->Sum % FieldSize; }

private:
  /** A prime. */
  static constexpr std::uint64_t FieldSize = (std::uint64_t{ 1 } << 61) - 1;

  std::uint64_t Place;
  /** Not zero, so that zeros count. */
  std::uint64_t Sum = 1;
};

/**
 * Digest of bytes, less than 2^61, that reads memory about as fast as it comes: sums of products of
 * pairs of words, each with a key added, for pieces of a KiB, which are coefficients of a
 * polynomial (the hash functions NH of J. Black et al., "UMAC", 1999, and VHASH of T. Krovetz,
 * 2006).
 *
 * Two different pieces have the same sum for 2^-64 of all keys, whatever their difference is, and
 * two different polynomials of n coefficients the same value at n / 2^61 of all places.
 */
std::uint64_t DigestBytes(const unsigned char* bytes, std::size_t size);

}
