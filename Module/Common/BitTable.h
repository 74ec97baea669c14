// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/BlockLoop.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * One bit per item. Threads may write the bits of different blocks of ForEachBlock() at the same
 * time.
 */
class BitTable
{
public:
  /** Sets the number of items, all of which get the same value. */
  void Assign(std::size_t count, bool value)
  {
    this->Words.assign((count + BitsOfWord - 1) / BitsOfWord, value ? ~Word{ 0 } : Word{ 0 });
    this->Words.shrink_to_fit();
  }

  bool operator[](std::size_t item) const
  {
    return (this->Words[item / BitsOfWord] >> item % BitsOfWord & 1u) != 0;
  }

  void Set(std::size_t item, bool value)
  {
    const Word bit = Word{ 1 } << item % BitsOfWord;
    Word& word = this->Words[item / BitsOfWord];
    word = value ? word | bit : word & ~bit;
  }

  /** True if all items that are set are set in another table of as many items, too. */
  bool IsWithin(const BitTable& other) const
  {
    for (std::size_t word = 0; word < this->Words.size(); ++word)
    {
      if ((this->Words[word] & ~other.Words[word]) != 0)
      {
        return false;
      }
    }
    return true;
  }

  std::int64_t GetBytes() const
  {
    return static_cast<std::int64_t>(this->Words.capacity() * sizeof(Word));
  }

private:
  using Word = std::uint64_t;
  static constexpr std::size_t BitsOfWord = 64;
  static_assert(BlockSize % BitsOfWord == 0, "no word belongs to two blocks");

  std::vector<Word> Words;
};

}
