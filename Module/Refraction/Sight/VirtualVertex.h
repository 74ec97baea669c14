// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace meniscus
{

enum class ImageState : unsigned char
{
  Found,
  NoImage,   ///< the surface shows no image of the point
  NotFinite, ///< NaN, infinite, or farther than RayTubeTree::FarthestRadii: no answer is possible
  NotAsked   ///< the caller did not ask for this point
};

/** Place where the eye sees a point through a surface. */
struct VirtualVertex
{
  glm::dvec3 Position{ 0.0 };   ///< Eq. 2.4, world coordinates; the true point if there is no image
  glm::dvec3 SightPoint{ 0.0 }; ///< point in which the sight ray meets the facet, world coordinates
  double Depth = 0.0;           ///< distance from the sight point to the true point
  double Reflectance = 0.0;     ///< exact Fresnel reflectance at the sight point
  double Cosine = 1.0; ///< cosine of the angle of incidence at the sight point, on the eye's side
  std::int32_t Facet = -1; ///< index among the membrane's accepted facets
  ImageState State = ImageState::NoImage;
  signed char Orientation = 1; ///< -1: mirrored; otherwise +1
};

}
