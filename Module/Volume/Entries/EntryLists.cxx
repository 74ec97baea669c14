// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Entries/EntryLists.h"
#include "Volume/Packet/Data/PacketRays.h"

#include <algorithm>

namespace meniscus
{
namespace
{

bool IsBefore(const PacketEntry& a, const PacketEntry& b)
{
  return a.Depth != b.Depth ? a.Depth < b.Depth : a.CellFace < b.CellFace;
}

/**
 * Sorts by insertion, which is linear for entries that are nearly in order; falls back to
 * std::sort.
 */
void SortEntries(PacketEntry* first, PacketEntry* last)
{
  // Mean number of places by which an entry may move before sorting by comparison is cheaper.
  constexpr std::ptrdiff_t moves = 8;
  std::ptrdiff_t movesLeft = moves * (last - first);
  for (PacketEntry* next = first; next != last; ++next)
  {
    if (next == first || !IsBefore(*next, *(next - 1)))
    {
      continue;
    }
    if (movesLeft < 0)
    {
      std::sort(first, last, IsBefore);
      return;
    }
    const PacketEntry entry = *next;
    PacketEntry* place = next;
    for (; place != first && IsBefore(entry, *(place - 1)); --place)
    {
      *place = *(place - 1);
    }
    *place = entry;
    movesLeft -= next - place;
  }
}

}

//------------------------------------------------------------------------------
void EntryLists::Start(std::size_t numberOfRays)
{
  this->Hits.clear();
  this->Entries.clear();
  this->Begins.assign(numberOfRays + 1, 0);
}

//------------------------------------------------------------------------------
void EntryLists::Sort()
{
  for (const Hit& hit : this->Hits)
  {
    ++this->Begins[hit.Ray];
  }
  // End of each ray's list. It moves to the beginning of the list while the list is filled
  // backwards.
  std::int32_t end = 0;
  for (std::int32_t& begin : this->Begins)
  {
    end += begin;
    begin = end;
  }
  this->Entries.resize(this->Hits.size());
  for (std::size_t i = this->Hits.size(); i > 0; --i)
  {
    const Hit& hit = this->Hits[i - 1];
    this->Entries[--this->Begins[hit.Ray]] = hit.Entry;
  }
  for (std::size_t ray = 0; ray + 1 < this->Begins.size(); ++ray)
  {
    SortEntries(
      this->Entries.data() + this->Begins[ray], this->Entries.data() + this->Begins[ray + 1]);
  }
}

}
