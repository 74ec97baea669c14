// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketRays.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Entries of many rays, sorted by ray, depth and face. The cost is linear in the number of entries
 * if they come approximately in the order of depth.
 */
class EntryLists
{
public:
  /**
   * Makes the entries from `count` hits, in any order, of rays numbered from 0. Replaces earlier
   * entries.
   * @param faces faces that the hits refer to.
   */
  void Set(
    std::size_t numberOfRays, const PacketHit* hits, std::size_t count, const PacketFace* faces);

  /** Entries of all rays; a ray has the entries [GetBegin(ray), GetBegin(ray + 1)). */
  const std::vector<PacketEntry>& GetEntries() const { return this->Entries; }
  std::int32_t GetBegin(std::size_t ray) const { return this->Begins[ray]; }

private:
  std::vector<PacketEntry> Entries;
  std::vector<std::int32_t> Begins;
};

}
