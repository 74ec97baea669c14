// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomNumbers.h"
#include "ReferenceRayIntegrator.h"
#include "Volume/Graded/GradedRayWalk.h"
#include "Volume/Graded/VolumeLight.h"

namespace meniscus::test
{

/**
 * Light of a random medium along bent rays, compared with an integral in double precision along the
 * places of the same path. The path itself is judged elsewhere (GradedPathCheck.h).
 */
class StressBentLight
{
public:
  /** @param mesh must outlive this object. */
  StressBentLight(const TetrahedralMesh& mesh, RandomNumbers& random);

  /** Judges the light of a ray; returns an empty text if it is right. */
  std::string Judge(const GradedMedium& medium, const GradedRay& ray) const;

private:
  std::string Compare(
    const KeptLight& light, const std::vector<reference::RaySegment>& segments) const;

  const TetrahedralMesh& Mesh;
  std::vector<float> Scalars;
  std::vector<std::uint8_t> Flags;
  std::vector<PacketInterval> Intervals;
  reference::ReferenceTransferFunction Function;
  EmittingMedium Light;
};

} // namespace meniscus::test
