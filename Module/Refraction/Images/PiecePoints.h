// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Points of the pieces of a primitive, by their places. Up to six pieces have a corner in common,
 * and two of them a point on a side of the primitive.
 */
#pragma once

#include "Refraction/Images/ImageMesh.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace meniscus
{

class PiecePoints
{
public:
  /** Forgets all points; call this before the first piece of a primitive. */
  void Start()
  {
    this->Entries.resize(Size);
    ++this->Round;
  }

  /**
   * As ImageMesh::AddCell(), without points that are known and without corners that repeat the one
   * before. Adds no cell if fewer than three corners are left.
   */
  template <typename PointOf>
  void AddCell(std::size_t count, const PointOf& pointOf, bool turned, std::int64_t sourceCell,
    int orientation, ImageMesh& images)
  {
    std::vector<std::int64_t>& ids = images.Connectivity;
    const std::size_t first = ids.size();
    const std::size_t before = images.Points.size();
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::int64_t id = this->Add(pointOf(turned ? count - 1 - i : i), images.Points);
      if (ids.size() == first || ids.back() != id)
      {
        ids.push_back(id);
      }
    }
    if (ids.size() > first + 1 && ids.back() == ids[first])
    {
      ids.pop_back();
    }
    if (ids.size() < first + 3)
    {
      ids.resize(first);
      images.Points.resize(before);
      return;
    }
    images.EndCell(sourceCell, orientation);
  }

  /**
   * Index in `points` of a point that is equal to the last bit, up to the facet of its patch. If
   * none is known, adds this one.
   */
  std::int64_t Add(const ImagePoint& point, std::vector<ImagePoint>& points)
  {
    Entry& entry = this->Entries[Hash(point.Vertex.Position)];
    const auto known = static_cast<std::size_t>(entry.Index);
    if (entry.Round != this->Round || known >= points.size() || !AreEqual(points[known], point))
    {
      entry = { static_cast<std::int64_t>(points.size()), this->Round };
      points.push_back(point);
    }
    return entry.Index;
  }

private:
  // Enough for the corners of a few dozen facets.
  static constexpr std::size_t Size = 256;

  struct Entry
  {
    std::int64_t Index = -1;
    std::uint64_t Round = 0; ///< of the primitive; entries of others are not valid
  };

  static bool AreEqual(const ImagePoint& a, const ImagePoint& b)
  {
    return a.Vertex.Position == b.Vertex.Position && a.Vertex.SightPoint == b.Vertex.SightPoint &&
      a.Vertex.Orientation == b.Vertex.Orientation && a.Source == b.Source && a.Weight == b.Weight;
  }

  static std::size_t Hash(const glm::dvec3& place)
  {
    // The multiplier of a well mixed linear congruential generator.
    constexpr std::uint64_t multiplier = 0x9e3779b97f4a7c15u;
    std::uint64_t bits[3];
    std::memcpy(bits, &place.x, sizeof(bits));
    std::uint64_t sum = (bits[0] * multiplier ^ bits[1]) * multiplier ^ bits[2];
    sum ^= sum >> 32;
    return static_cast<std::size_t>(sum * multiplier >> 32) % Size;
  }

  /** Indexed by a hash of the place, one entry each; a new entry replaces the old one. */
  std::vector<Entry> Entries;
  std::uint64_t Round = 0;
};

}
