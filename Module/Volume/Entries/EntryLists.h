// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Entries_EntryLists_h
#define meniscus_Volume_Entries_EntryLists_h

#include "Volume/Packet/Data/PacketRays.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Entries of many rays, collected in any order and then sorted by ray, depth and face. The cost is
 * linear in the number of entries if they are added approximately in the order of depth.
 */
class EntryLists
{
public:
  /** Removes all entries and expects rays numbered from 0. */
  void Start(std::size_t numberOfRays);

  void Add(std::int32_t ray, const PacketEntry& entry) { this->Hits.push_back({ ray, entry }); }

  /** Sorts the entries; the lists can be read afterwards. */
  void Sort();

  /** Entries of all rays; those of a ray are [GetBegin(ray), GetBegin(ray + 1)). */
  const std::vector<PacketEntry>& GetEntries() const { return this->Entries; }
  std::int32_t GetBegin(std::size_t ray) const { return this->Begins[ray]; }

private:
  struct Hit
  {
    std::int32_t Ray;
    PacketEntry Entry;
  };

  std::vector<Hit> Hits;
  std::vector<PacketEntry> Entries;
  std::vector<std::int32_t> Begins;
};

}

#endif
