// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MembraneMeshes.h"
#include "Refraction/Surface/MediaChain.h"
#include "StressRandom.h"

namespace meniscus::test
{

/** An interface of a list, and how rays pass it by construction. */
struct StackLayer
{
  std::size_t Mesh; ///< number of its surface; closed bodies share one
  InterfaceMedia Media;
  bool FromFront;

  double GetBefore() const { return this->FromFront ? this->Media.Exterior : this->Media.Interior; }
  double GetBehind() const { return this->FromFront ? this->Media.Interior : this->Media.Exterior; }
};

/**
 * A list of two or three interfaces and an eye, in a frame in which the widest surface is 200 wide
 * and rays go down along y. The kernel gets them scaled and then translated.
 */
struct StackCase
{
  std::vector<reference::MembraneMesh> Meshes;
  std::vector<StackLayer> Layers;
  std::size_t LayersBehindEye = 0;
  double Scale = 1.0;
  glm::dvec3 Offset{ 0.0 };
  glm::dvec3 Eye{ 0.0 };
  std::uint64_t Seed = 0;   ///< of the points
  double BorderShare = 0.1; ///< share of the points on rays through edges and corners of facets
};

/** A mirror, an eye and points in front of it, in the same frame. */
struct MirrorCase
{
  reference::MembraneMesh Mesh;
  double Scale = 1.0;
  glm::dvec3 Offset{ 0.0 };
  glm::dvec3 Eye{ 0.0 };
  std::uint64_t Seed = 0;
};

/** A named generator of cases, as RefractionFamily. */
struct StackFamily
{
  std::string Name;
  double Cases; ///< at an intensity of 1
  std::function<StackCase(StressRandom&)> Make;
};
std::vector<StackFamily> StackFamilies();

struct MirrorFamily
{
  std::string Name;
  double Cases;
  std::function<MirrorCase(StressRandom&)> Make;
};
std::vector<MirrorFamily> MirrorFamilies();

} // namespace meniscus::test
