// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_RefractionCase_h
#define meniscus_RefractionCase_h

#include "MembraneMeshes.h"
#include "SmoothSurface.h"
#include "StressRandom.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace meniscus
{
namespace test
{

/** What decides which images are right. */
enum class RefractionTruth
{
  Smooth, ///< the smooth surface that the mesh stands for, by the oracle
  Patches ///< the membrane's own patches, by a dense search: rough, folded and joined surfaces
};

/**
 * A membrane, an eye and what it looks at, in a frame where the membrane is 200 wide. The kernel
 * gets all of it scaled, then moved.
 */
struct RefractionCase
{
  RefractionTruth Truth = RefractionTruth::Smooth;
  reference::SmoothSurface Surface;
  reference::MembraneMesh Mesh;
  double FacetSize = 0.0;
  /**
   * How often a place of the membrane may be there: facets repeated with points of their own are
   * surfaces of their own.
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
  /** Triangles whose images are drawn, too. */
  std::vector<std::array<glm::dvec3, 3>> Triangles;
};

/** Cases of one kind, made one by one. */
struct RefractionFamily
{
  std::string Name;
  int Cases = 0;
  std::function<RefractionCase(int)> Make;
};

/** All families. The number of cases grows with the intensity, 1 takes half a minute. */
std::vector<RefractionFamily> refractionFamilies(double intensity, std::uint64_t seed);

} // namespace test
} // namespace meniscus

#endif
