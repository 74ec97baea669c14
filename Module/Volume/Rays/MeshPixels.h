// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Rays/ProjectedFaces.h"
#include "Volume/Rays/RayFrame.h"

namespace meniscus
{

class TetrahedralMesh;

/**
 * A box of pixels outside of which no ray of an image meets the mesh; all pixels if the clipping
 * planes cut the mesh, which may then reach behind the eye.
 */
ProjectedFaces::PixelBox FindMeshPixels(
  const RayFrame& frame, int width, int height, const TetrahedralMesh& mesh);

}
