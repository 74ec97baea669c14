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
void EntryLists::Set(
  std::size_t numberOfRays, const PacketHit* hits, std::size_t count, const PacketFace* faces)
{
  this->Begins.assign(numberOfRays + 1, 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    ++this->Begins[static_cast<std::size_t>(hits[i].Ray)];
  }
  // End of each ray's list. It moves to the beginning of the list while the list is filled
  // backwards.
  std::int32_t end = 0;
  for (std::int32_t& begin : this->Begins)
  {
    end += begin;
    begin = end;
  }
  this->Entries.resize(count);
  for (std::size_t i = count; i > 0; --i)
  {
    const PacketHit& hit = hits[i - 1];
    const PacketFace& face = faces[hit.Face];
    this->Entries[static_cast<std::size_t>(--this->Begins[static_cast<std::size_t>(hit.Ray)])] = {
      { face.Vertices[0], face.Vertices[1], face.Vertices[2] }, face.CellFace, hit.Depth
    };
  }
  PacketEntry* const entries = this->Entries.data();
  for (std::size_t ray = 0; ray < numberOfRays; ++ray)
  {
    const std::int32_t first = this->Begins[ray];
    const std::int32_t last = this->Begins[ray + 1];
    if (last - first > 1)
    {
      SortEntries(entries + first, entries + last);
    }
  }
}

}
