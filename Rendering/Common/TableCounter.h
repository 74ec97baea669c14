// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Common_TableCounter_h
#define meniscus_Rendering_Common_TableCounter_h

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
  enum Table
  {
    Cells,
    Vertices,
    CellScalars,
    VertexGradients,
    CellGradients,
    Components,
    Functions,
    PreIntegration,
    RefractedRays,
    NumberOfTables
  };
  using Version = std::array<std::int64_t, 2>;

  /**
   * Adds the bytes of a table unless they were counted for this version; version 0 means no table.
   */
  void Count(Table table, const Version& version, std::int64_t bytes)
  {
    if (this->Versions[table] != version)
    {
      this->Versions[table] = version;
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
  std::array<Version, NumberOfTables> Versions{};
  std::int64_t Bytes = 0;
};

}

#endif
