// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Rays/RayFrame.h"

namespace meniscus
{

class TetrahedralMesh;

/**
 * Depth from which depths along an image's rays are counted (FixedPointRays), in units of the
 * frame: between the depths at which rays begin and cease to be in the mesh's bounding box, behind
 * the near clipping plane. Rounding errors grow with the distance from the pivot. Measured in
 * pixels, errors at the near end are a fixed share of errors at the far end, which is hidden more
 * often. Depths in a picture of a small part of the mesh, or from an eye inside of it, are thus as
 * precise as in a picture of a mesh of this small size, wherever the part and the eye are. For
 * meshes with cells below about a thousandth of their radius it is the near end.
 *
 * Any pivot within the unit is valid; rays on a grid of pixels are enough to find a good one.
 */
double FindPivot(const RayFrame& frame, int width, int height, const TetrahedralMesh& mesh);

}
