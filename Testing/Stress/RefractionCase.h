// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "SmoothSurface.h"
#include "StressRandom.h"

namespace meniscus::test
{

/** Criterion for the correct images. */
enum class RefractionTruth
{
  Smooth, ///< the smooth surface that the mesh approximates, by the oracle
  Patches ///< the membrane's own patches, by a dense search: rough, folded and joined surfaces
};

/**
 * A membrane, an eye and an object, in a frame in which the membrane is 200 wide. The kernel gets
 * all of them scaled and then translated.
 */
struct RefractionCase
{
  RefractionTruth Truth = RefractionTruth::Smooth;
  reference::SmoothSurface Surface;
  reference::MembraneMesh Mesh;
  double FacetSize = 0.0;
  /**
   * Largest number of coincident surfaces at a place of the membrane: repeated facets with their
   * own points are separate surfaces.
   */
  int Layers = 1;
  /** Facets that were cut out of the mesh, in x and z. */
  std::vector<std::array<glm::dvec2, 3>> Holes;
  double Scale = 1.0;
  glm::dvec3 Offset{ 0.0 };
  glm::dvec3 Eye{ 0.0 };
  double Exterior = 1.0;
  double Interior = 1.0;
  std::vector<glm::dvec3> Points;
  /** Triangles whose images are also drawn. */
  std::vector<std::array<glm::dvec3, 3>> Triangles;
};

struct RefractionTally;

/** Cases of one kind, created and checked one by one. */
struct RefractionFamily
{
  std::string Name;
  int Cases = 0;
  std::function<RefractionTally(int)> Check;
};

/**
 * All families: one interface, lists of interfaces, and mirrors. The number of cases grows with the
 * intensity; an intensity of 1 takes a minute.
 */
std::vector<RefractionFamily> RefractionFamilies(double intensity, std::uint64_t seed);

} // namespace meniscus::test
