// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_PatchTube_h
#define meniscus_Refraction_PatchTube_h

#include "Refraction/CellTree.h"
#include "Refraction/CurvedPatch.h"

namespace meniscus
{

/// Longest distance between the points of a patch and those of its facet.
double BoundBulge(const CurvedPatch& patch);

/**
 * A tube around every ray that Snell's law refracts at a point of `patch`, not valid where there is
 * none: where all of the patch faces away from the eye or reflects totally. `ratio` is n1 / n2.
 *
 * By intervals, in the form of Eq. 2.2: R = ratio D + g(c) N with c = D.N. D, N and c are boxes
 * about the patch's middle, g is monotonic in c, so no ray is outside whatever the patch's shape.
 */
TubeBounds BoundRefractedRays(const CurvedPatch& patch, const glm::dvec3& eye, double ratio);

}

#endif
