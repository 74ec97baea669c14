// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ByteReader.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <cstdint>
#include <vector>

namespace meniscus::test
{

/** Arrays of a mesh in one of the forms that TetrahedraView accepts. */
class FuzzMesh
{
public:
  explicit FuzzMesh(ByteReader& reader);

  const TetrahedraView& GetView() const { return this->View; }
  std::int64_t GetNumberOfPoints() const { return this->View.NumberOfPoints; }
  /** Replaces the points. */
  void ReadPoints(ByteReader& reader);

private:
  void ReadCells(ByteReader& reader);
  void ReadSingleCells(ByteReader& reader, int count);
  void ReadShapes(ByteReader& reader, int count);
  void ReadOptions(ByteReader& reader);

  TetrahedraView View;
  bool IsShort = false;
  std::vector<double> Points;
  std::vector<float> ShortPoints;
  std::vector<std::int64_t> Cells;
  std::vector<std::int32_t> ShortCells;
  std::vector<std::uint8_t> Flags;
  std::vector<std::int32_t> Sources;
};

/** Requires that the tables of a mesh are consistent and that all cells are accounted for. */
void CheckMesh(const TetrahedralMesh& mesh, const TetrahedraView& view, MeshStatus status);

}
