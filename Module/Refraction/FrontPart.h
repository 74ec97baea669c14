// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_FrontPart_h
#define meniscus_Refraction_FrontPart_h

#include "Refraction/CurvedGeometry.h"
#include "Refraction/ImageMesh.h"
#include "Refraction/MembraneMapping.h"

#include <cstdint>

namespace meniscus
{

/**
 * Adds the part of a triangle or line that is in front of the membrane (CurvedGeometry::IsInFront,
 * prepared), as it is. The primitive is halved to a 32nd along the membrane; there its cut is
 * straight between exact crossings of the parts' sides.
 */
void AddFrontOfTriangle(const CurvedGeometry& geometry, const MappedTriangle& triangle,
  std::int64_t sourceCell, ImageMesh& images);
void AddFrontOfLine(const CurvedGeometry& geometry, const MappedTriangle& line,
  std::int64_t sourceCell, ImageMesh& images);

}

#endif
