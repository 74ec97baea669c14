// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The error measurements of the thesis's Tables 4.1 to 4.5: the printed figures, and functions that
 * measure the same rows again. Documentation/refraction-measurements.md describes the set-up.
 */
#pragma once

#include "AnalyticMembrane.h"
#include "MembraneMeshes.h"
#include "Refraction/Sight/VirtualVertex.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace meniscus::reference
{

enum class MembraneShape
{
  Disc,  ///< radius 141.5, five rings
  Square ///< side 200
};

/** One row of a table: its set-up and the printed numbers. */
struct ThesisRow
{
  const char* Table;
  MembraneShape Shape;
  int SquareCells;    ///< facets per side / 2 of a square
  double SphereRatio; ///< sphere radius / 141.5; 0: planar
  double EyeHeight;   ///< above the apex
  double EyeOffset;   ///< from the axis
  double Exterior;
  double Interior;
  double Mean;
  double Deviation;
  int Points; ///< 0: not printed
};

struct ErrorStatistics
{
  double Mean = 0.0;
  double Deviation = 0.0;
  double Largest = 0.0;
  std::size_t Points = 0;
};

/** The 54 rows of Tables 4.1, 4.2, 4.3, 4.4 and 4.5, in the order of the thesis. */
const std::vector<ThesisRow>& GetThesisRows();

/**
 * True if a row belongs to Tables 4.1, 4.2, 4.3 or 4.5, whose 46 rows are used for the acceptance.
 */
bool IsReproducible(const ThesisRow& row);

/** Membrane, eye and exact surface of a row. */
MembraneMesh MakeThesisMesh(const ThesisRow& row);
glm::dvec3 GetThesisEye(const ThesisRow& row);
AnalyticMembrane GetThesisSurface(const ThesisRow& row);

/** Distance of walls, in barycentric coordinates, at which two cells count as several answers. */
constexpr double ThesisWall = 1e-7;

/** Distance of a point from the exact point behind its image; nothing if it does not count. */
std::optional<double> FindThesisError(
  const ThesisRow& row, const glm::dvec3& point, const VirtualVertex& vertex);

/** Error of a point; nothing if it does not count. */
using ErrorFunction = std::function<std::optional<double>(const glm::dvec3& point)>;

/** The samples of the error volume. */
ErrorStatistics MeasureErrors(const ErrorFunction& errorAt);

/**
 * Samples the error volume of a row: the distance between each true point and the exact point that
 * corresponds to its computed virtual vertex, with the thesis's flat facets.
 */
ErrorStatistics MeasureThesisRow(const ThesisRow& row);

/** As above, with curved patches, over the points with exactly one image. */
ErrorStatistics MeasureThesisRowCurved(const ThesisRow& row);

}
