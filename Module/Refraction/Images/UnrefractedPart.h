// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Images_UnrefractedPart_h
#define meniscus_Refraction_Images_UnrefractedPart_h

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/ImageMesh.h"
#include "Refraction/Images/PrimitiveMapper.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Adds the part of a triangle or line that is in front of the membrane
 * (CurvedMembraneSolver::IsInFront, prepared), as it is. Of a triangle it is bounded by `waterline`
 * where that is complete (FrontOutline). Otherwise, as where the membrane faces away from the eye,
 * and of a line, the primitive is halved where it crosses the membrane until its cut is straight
 * within `tolerance`, an angle in radians at the eye, to a 32nd at most.
 */
void AddFrontOfTriangle(const CurvedMembraneSolver& geometry, double tolerance,
  const MappedTriangle& triangle, std::int64_t sourceCell,
  const std::vector<WaterlinePiece>& waterline, ImageMesh& images);
void AddFrontOfLine(const CurvedMembraneSolver& geometry, const MappedTriangle& line,
  std::int64_t sourceCell, ImageMesh& images);

}

#endif
