// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Rays_RayPivot_h
#define meniscus_Volume_Rays_RayPivot_h

#include "Volume/Rays/RayFrame.h"

namespace meniscus
{

class TetrahedralMesh;

/**
 * Depth from which depths along an image's rays are counted (FixedPointRays), in units of the
 * frame: about where the first of the rays begins to be seen, at the near clipping plane or behind
 * it at the mesh's bounding box. A picture of a small part of the mesh thus has depths that are as
 * precise as those of a mesh of this size, wherever the part and the eye are.
 *
 * Any pivot within the unit is valid; rays on a grid of pixels are enough to find a good one.
 */
double FindPivot(const RayFrame& frame, int width, int height, const TetrahedralMesh& mesh);

}

#endif
