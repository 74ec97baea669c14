// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Rays from sides of sub-cells that meet sides of the object, by these two sides. Two sub-cells
 * share the one, and two primitives the other, so that a ray is asked for up to four times.
 */
#pragma once

#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Surface/CurveCrossings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace meniscus
{

class KnownMeetings
{
public:
  /**
   * A side of a sub-cell and a side of the object. For equal keys MeetLine() computes the same ray,
   * to the last bit, because it begins with the same numbers.
   */
  struct Key
  {
    /** The vertices of the edge that the side lies on, the lower one first; or facet and -1. */
    std::array<std::int32_t, 2> Edge;
    glm::dvec2 From; ///< as SubCellSide::GetFrom()
    glm::dvec2 To;
    std::array<std::int64_t, 2> Side; ///< ends of the object's side, in its direction

    /** The key of a side of a sub-cell of a facet, and a side of the object from its first end. */
    static Key Make(const Membrane& membrane, std::int32_t facet, const SubCellSide& curve,
      std::int64_t first, std::int64_t last)
    {
      Key key{ { facet, -1 }, curve.GetFrom(), curve.GetTo(), { first, last } };
      if (curve.GetEdge() >= 0)
      {
        const Membrane::Facet& vertices = membrane.GetFacets()[static_cast<std::size_t>(facet)];
        const auto edge = static_cast<std::size_t>(curve.GetEdge());
        const auto [low, high] = std::minmax(vertices[(edge + 1) % 3], vertices[(edge + 2) % 3]);
        key.Edge = { low, high };
      }
      return key;
    }
    bool operator==(const Key& other) const
    {
      return this->Edge == other.Edge && this->From == other.From && this->To == other.To &&
        this->Side == other.Side;
    }
  };
  struct Meeting
  {
    RefractedPoint From;
    double Zero; ///< place on the side of the sub-cell, from 0 to 1 in its direction
  };

  /** The ray of a key; `compute()` returns it if it is not known. */
  template <typename Compute>
  const Meeting& Get(const Key& key, const Compute& compute)
  {
    this->Entries.resize(Size);
    Entry& entry = this->Entries[Hash(key) % Size];
    if (!entry.IsKnown || !(entry.Of == key))
    {
      entry = { key, compute(), true };
    }
    return entry.Value;
  }

private:
  // Enough for the rays of ten triangles of a few dozen sub-cells.
  static constexpr std::size_t Size = 256;

  struct Entry
  {
    Key Of;
    Meeting Value;
    bool IsKnown = false;
  };

  static std::size_t Hash(const Key& key)
  {
    const auto toBits = [](double value)
    {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof(bits));
      return bits;
    };
    std::uint64_t sum = 0;
    // The multiplier of a well mixed linear congruential generator, once more for each number.
    for (const std::uint64_t bits :
      { static_cast<std::uint64_t>(key.Edge[0]), static_cast<std::uint64_t>(key.Edge[1]),
        toBits(key.From.x + 2.0 * key.From.y), toBits(key.To.x + 2.0 * key.To.y),
        static_cast<std::uint64_t>(key.Side[0]), static_cast<std::uint64_t>(key.Side[1]) })
    {
      sum = (sum ^ bits) * 0x9e3779b97f4a7c15u;
      sum ^= sum >> 32;
    }
    return static_cast<std::size_t>(sum);
  }

  /** Indexed by a hash of the key, one entry each; a new entry replaces the old one. */
  std::vector<Entry> Entries;
};

}
