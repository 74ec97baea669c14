// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/RayCastTables.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Counts the bytes of tables that are read in place, once for each version of a table. */
class TableCounter
{
public:
  /** Adds the bytes of a table unless they were counted for this version. */
  void Count(const RayCastTableState& table, std::int64_t bytes)
  {
    TableVersions& counted = this->Counted[static_cast<std::size_t>(table.Table)];
    if (counted != table.Versions)
    {
      counted = table.Versions;
      this->Bytes += bytes;
    }
  }
  /** Number of bytes counted so far. */
  std::int64_t GetBytes() const { return this->Bytes; }

  /** Number of bytes of a table's values, without reserved memory. */
  template <typename T>
  static std::int64_t SizeOf(const std::vector<T>& table)
  {
    return static_cast<std::int64_t>(table.size() * sizeof(T));
  }

private:
  std::array<TableVersions, static_cast<std::size_t>(RayCastTable::NumberOfTables)> Counted;
  std::int64_t Bytes = 0;
};

}
