// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ByteReader.h"
#include "Refraction/Images/CellImages.h"
#include "Refraction/Images/ImageMesh.h"
#include "Refraction/Membrane/Membrane.h"

#include <cstdint>
#include <vector>

namespace meniscus::test
{

/** Arrays of a surface: a sheet of heights, a closed body or any triangles. */
class FuzzSurface
{
public:
  explicit FuzzSurface(ByteReader& reader);

  const MembraneInput& GetInput() const { return this->Input; }
  /** Replaces the points; triangles stay. */
  void ReadPoints(ByteReader& reader);

private:
  void ReadSheet(ByteReader& reader);
  void ReadBody(ByteReader& reader);
  void ReadTriangles(ByteReader& reader);
  void ReadNormals(ByteReader& reader);
  void Borrow();

  MembraneInput Input;
  std::vector<double> Points;
  std::vector<std::int64_t> Triangles;
  std::vector<std::int64_t> Ids;
  std::vector<double> Normals;
};

/** Requires that a membrane is consistent and that all triangles are accounted for. */
void CheckSurface(const Membrane& surface, const MembraneInput& input, MembraneStatus status);

/**
 * True for a radius from 2^-100 to 2^100: solvers form products of up to ten lengths, which are in
 * the range of double then.
 */
bool IsOfSolvableSize(const Membrane& surface);

/** An index of refraction, mostly of an existing medium. */
double ReadIndexOfRefraction(ByteReader& reader);

/** Points, lines and polygons that are seen through a surface. */
struct FuzzObject
{
  explicit FuzzObject(ByteReader& reader);

  std::size_t GetNumberOfPoints() const { return this->Points.size() / 3; }
  glm::dvec3 GetPoint(std::size_t i) const
  {
    return { this->Points[3 * i], this->Points[3 * i + 1], this->Points[3 * i + 2] };
  }

  /** Maps all cells, and requires that their images are consistent. */
  void Map(const CellImages& images, bool closesSeams) const;

  std::vector<double> Points;
  std::vector<std::int64_t> LineEnds{ 0 };
  std::vector<std::int64_t> Lines;
  std::vector<std::int64_t> PolygonEnds{ 0 };
  std::vector<std::int64_t> Polygons;
  std::vector<std::int64_t> Names;
};

/** Requires that an image of a point has finite values in their ranges. */
void CheckImage(const VirtualVertex& image, std::size_t facets);

}
