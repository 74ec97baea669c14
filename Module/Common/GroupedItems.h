// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** A list of item numbers per group, such as the facets at each vertex, stored in two arrays. */
class GroupedItems
{
public:
  struct Group
  {
    const std::int32_t* First;
    const std::int32_t* Last;
    const std::int32_t* begin() const { return this->First; }
    const std::int32_t* end() const { return this->Last; }
  };

  /**
   * Sets the groups. `forEach(visit)` calls `visit(group, item)` for all pairs, of which there may
   * be 2^31 - 1. It is called twice; items keep the order of its second call.
   */
  template <typename ForEach>
  void Set(std::size_t groups, const ForEach& forEach)
  {
    this->Begins.assign(groups + 1, 0);
    forEach([this](std::size_t group, std::int32_t) { ++this->Begins[group + 1]; });
    for (std::size_t group = 0; group < groups; ++group)
    {
      this->Begins[group + 1] += this->Begins[group];
    }
    this->Items.resize(static_cast<std::size_t>(this->Begins.back()));
    std::vector<std::int32_t> next(this->Begins.begin(), this->Begins.end() - 1);
    forEach([this, &next](std::size_t group, std::int32_t item)
      { this->Items[static_cast<std::size_t>(next[group]++)] = item; });
  }

  std::size_t GetNumberOfGroups() const
  {
    return this->Begins.empty() ? 0 : this->Begins.size() - 1;
  }
  bool IsEmpty(std::size_t group) const { return this->Begins[group] == this->Begins[group + 1]; }
  Group operator[](std::size_t group) const
  {
    return { this->Items.data() + this->Begins[group],
      this->Items.data() + this->Begins[group + 1] };
  }

private:
  /** Place of the first item of each group, and the end of the last group; empty before Set(). */
  std::vector<std::int32_t> Begins;
  std::vector<std::int32_t> Items;
};

}
