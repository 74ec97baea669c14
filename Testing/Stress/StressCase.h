// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestMeshes.h"
#include "VolumeFunctions.h"
#include "VolumeView.h"

namespace meniscus::test
{

/** Criterion for a correct image. */
enum class StressRule
{
  /** Cells do not overlap: compared with the double-precision reference, pixel by pixel. */
  Reference,
  /**
   * There is no exact reference (tangled cells, cells below the resolution of single precision).
   * Checks that values are finite, opacities in [0, 1], colours within opacity times the brightest
   * colour, and the opacity at most that of the ray's path through the mesh's bounding box at the
   * largest attenuation.
   */
  Bounds
};

/** A mesh, a function and views of it. */
struct StressCase
{
  std::string Name;
  int Number = 0; ///< in its family
  Grid Mesh;      ///< tetrahedra with point scalars; null: not available, the case is skipped
  VolumeFunction Function;
  std::vector<VolumeView> Views;
  StressRule Rule = StressRule::Reference;
  int Size = 64; ///< pixels per side
  /**
   * Largest fraction of the covered pixels that are excused as silhouettes. Aligned rays run in the
   * mesh's boundary by design.
   */
  double SilhouetteShare = 0.01;
};

/** Cases of one kind, created one by one. */
struct StressFamily
{
  std::string Name;
  int Cases = 0;
  std::function<StressCase(int)> Make;
};

/**
 * All families.
 * @param intensity 1 takes seconds; the number of random meshes grows with it, that of repetitions
 *   with its square root.
 */
std::vector<StressFamily> StressFamilies(double intensity, std::uint64_t seed);

} // namespace meniscus::test
