// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Two points, in ascending order. */
struct EdgePoints
{
  std::int32_t First = 0;
  std::int32_t Second = 0;

  EdgePoints() = default;
  EdgePoints(std::int32_t a, std::int32_t b)
    : First(a < b ? a : b)
    , Second(a < b ? b : a)
  {
  }
  bool operator==(const EdgePoints& other) const
  {
    return this->First == other.First && this->Second == other.Second;
  }
  bool operator<(const EdgePoints& other) const
  {
    return this->First != other.First ? this->First < other.First : this->Second < other.Second;
  }
};

/** Edges, numbered in the order in which they were added: a hash table with open addressing. */
class EdgeIndex
{
public:
  static constexpr std::int32_t None = -1;

  /** @param expected number of edges for which there is room at first. */
  explicit EdgeIndex(std::size_t expected = 0);

  /** Adds an edge unless it is there. Returns true if it was added. */
  bool Add(const EdgePoints& edge);
  /** Number of an edge, or None. Any number of threads may call this at the same time. */
  std::int32_t Find(const EdgePoints& edge) const;

  std::size_t GetSize() const { return this->Edges.size(); }
  const std::vector<EdgePoints>& GetEdges() const { return this->Edges; }

private:
  std::size_t SlotOf(const EdgePoints& edge) const;
  void Grow(std::size_t slots);

  std::vector<EdgePoints> Edges;
  /** Numbers of edges, or None; the length is a power of two. */
  std::vector<std::int32_t> Slots;
};

}
