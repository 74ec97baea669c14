// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/ImageMesh.h"
#include "Refraction/Images/PrimitiveMapper.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Adds the part of a triangle or line in front of the membrane, unchanged. The sides of the
 * membrane must be prepared (CurvedMembraneSolver::IsInFront). For a triangle, the part is bounded
 * by `waterline` if that is complete (FrontOutline). Otherwise, for instance where the membrane
 * faces away from the eye, and for every line, the primitive is halved where it crosses the
 * membrane until its cut is straight within `tolerance`, an angle in radians at the eye, down to
 * 1/32 of its size.
 */
void AddFrontOfTriangle(const CurvedMembraneSolver& geometry, double tolerance,
  const MappedTriangle& triangle, std::int64_t sourceCell,
  const std::vector<WaterlinePiece>& waterline, ImageMesh& images);
void AddFrontOfLine(const CurvedMembraneSolver& geometry, const MappedTriangle& line,
  std::int64_t sourceCell, ImageMesh& images);

/** Sine of the angle at the eye between two places in world coordinates. */
double GetSineAtEye(
  const CurvedMembraneSolver& geometry, const glm::dvec3& first, const glm::dvec3& second);

}
