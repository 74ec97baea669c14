// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Common_TableVersion_h
#define meniscus_Common_TableVersion_h

#include <array>
#include <cstdint>

namespace meniscus
{

/**
 * Version of a table. The table's owner bumps it with each change; whoever makes something of the
 * table keeps a copy and compares. The version of a table that was never made equals the default.
 */
class TableVersion
{
public:
  TableVersion() = default;
  explicit TableVersion(std::int64_t changes)
    : Changes(changes)
  {
  }

  void Bump() { ++this->Changes; }
  /** Number of changes so far. */
  std::int64_t GetChanges() const { return this->Changes; }

  bool operator==(const TableVersion& other) const { return this->Changes == other.Changes; }
  bool operator!=(const TableVersion& other) const { return !(*this == other); }

private:
  std::int64_t Changes = 0;
};

/** Versions of up to three tables that something was made from; the default: not made yet. */
class TableVersions
{
public:
  TableVersions() = default;
  TableVersions(
    TableVersion first, TableVersion second = TableVersion(), TableVersion third = TableVersion())
    : Versions{ first, second, third }
  {
  }

  bool operator==(const TableVersions& other) const { return this->Versions == other.Versions; }
  bool operator!=(const TableVersions& other) const { return !(*this == other); }

private:
  std::array<TableVersion, 3> Versions;
};

}

#endif
