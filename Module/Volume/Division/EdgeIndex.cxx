// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Division/EdgeIndex.h"

namespace meniscus
{
namespace
{

/** Finaliser of MurmurHash3: each bit of the key changes each bit of the result. */
std::uint64_t HashOf(const EdgePoints& edge)
{
  std::uint64_t key =
    static_cast<std::uint64_t>(edge.First) << 32 | static_cast<std::uint32_t>(edge.Second);
  key = (key ^ (key >> 33)) * 0xff51afd7ed558ccdULL;
  key = (key ^ (key >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return key ^ (key >> 33);
}

}

//------------------------------------------------------------------------------
EdgeIndex::EdgeIndex(std::size_t expected)
{
  std::size_t slots = 16;
  while (slots < 2 * expected)
  {
    slots *= 2;
  }
  this->Edges.reserve(expected);
  this->Slots.assign(slots, None);
}

//------------------------------------------------------------------------------
/** Slot of the edge, or the free one in which it would be put. */
std::size_t EdgeIndex::SlotOf(const EdgePoints& edge) const
{
  const std::size_t mask = this->Slots.size() - 1;
  std::size_t slot = HashOf(edge) & mask;
  while (this->Slots[slot] != None &&
    !(this->Edges[static_cast<std::size_t>(this->Slots[slot])] == edge))
  {
    slot = (slot + 1) & mask;
  }
  return slot;
}

//------------------------------------------------------------------------------
bool EdgeIndex::Add(const EdgePoints& edge)
{
  // At most half of the slots are used: searches are short.
  if (2 * (this->Edges.size() + 1) > this->Slots.size())
  {
    this->Grow(2 * this->Slots.size());
  }
  const std::size_t slot = this->SlotOf(edge);
  if (this->Slots[slot] != None)
  {
    return false;
  }
  this->Slots[slot] = static_cast<std::int32_t>(this->Edges.size());
  this->Edges.push_back(edge);
  return true;
}

//------------------------------------------------------------------------------
std::int32_t EdgeIndex::Find(const EdgePoints& edge) const
{
  return this->Slots[this->SlotOf(edge)];
}

//------------------------------------------------------------------------------
void EdgeIndex::Grow(std::size_t slots)
{
  this->Slots.assign(slots, None);
  for (std::size_t i = 0; i < this->Edges.size(); ++i)
  {
    this->Slots[this->SlotOf(this->Edges[i])] = static_cast<std::int32_t>(i);
  }
}

}
