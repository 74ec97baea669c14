// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Exact places of the corners that clipping makes: where a curve of the membrane (b + s db in a
 * patch) looks at a line of the object (origin + l direction), or meets it. Newton's method from
 * the linear guess; false, and nothing changed, if it does not settle close to it.
 */
#ifndef meniscus_Refraction_MappingPlace_h
#define meniscus_Refraction_MappingPlace_h

#include "Refraction/SightEquation.h"

namespace meniscus
{

/// A straight line of the object or a curve of a patch.
struct ObjectLine
{
  glm::dvec3 origin;
  glm::dvec3 direction;
};
struct PatchLine
{
  glm::dvec2 origin;
  glm::dvec2 direction;
};

struct Media
{
  glm::dvec3 eye;
  double exterior;
  double interior;
};

/// Where the curve's point at `s` is the sight point of the line's point at `l`.
bool LookAlong(const CurvedPatch& patch, const Media& media, const PatchLine& curve,
  const ObjectLine& line, double& s, double& l);

/// Where the curve meets the plane through `point` with `normal`.
bool MeetPlane(const CurvedPatch& patch, const PatchLine& curve, const glm::dvec3& point,
  const glm::dvec3& normal, double& s);

/// Where the line meets the patch.
bool MeetPatch(const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l);
/// The same with the patch's normal there, not normalised. Newton's method ends with a step shorter
/// than `lastStep`, the square of which is left.
bool MeetPatch(const CurvedPatch& patch, const ObjectLine& line, double lastStep, glm::dvec2& b,
  double& l, glm::dvec3& normal);

}

#endif
