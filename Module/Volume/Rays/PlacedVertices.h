// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Packet/Data/PacketRays.h"

#include <vector>

namespace meniscus
{

class FixedPointRays;
class TetrahedralMesh;

/**
 * Converts the vertices of a mesh to the fixed-point frame of an image's rays.
 * @param scalars one normalised scalar per mesh vertex; NaN makes its cells transparent. Empty if
 *   cells have the scalars.
 * @param vertices replaced by the result.
 */
void PlaceVertices(const TetrahedralMesh& mesh, const std::vector<float>& scalars,
  const FixedPointRays& rays, const RangeLoop& loop, std::vector<PacketVertex>& vertices);

}
