// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Rays of pixels against one curved patch, and Snell's law, for many rays at once: plain loops over
 * arrays, compiled per instruction set. Every lane does the same operations in the same order
 * whatever the set, so results are the same to the last bit.
 */
#ifndef meniscus_Volume_Refracted_PatchIntersectionBatch_h
#define meniscus_Volume_Refracted_PatchIntersectionBatch_h

#include "Refraction/Membrane/CurvedPatch.h"
#include "Simd/InstructionSets.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace meniscus
{

/** Origins and directions (per depth) of pixels' rays: constant, per column, per row. */
struct SightRays
{
  glm::dvec3 Start[3];
  glm::dvec3 Direction[3];

  /** @param column, row  counted from the image's centre. */
  glm::dvec3 StartOf(double column, double row) const
  {
    return this->Start[0] + column * this->Start[1] + row * this->Start[2];
  }
  glm::dvec3 DirectionOf(double column, double row) const
  {
    return this->Direction[0] + column * this->Direction[1] + row * this->Direction[2];
  }
};

/** The plane of a facet. */
struct FacetPlane
{
  glm::dvec3 Corner;
  /** Its length is twice the area. */
  glm::dvec3 Normal;
  /** Gradients of the second and the third barycentric coordinate. */
  glm::dvec3 ByX;
  glm::dvec3 ByY;
};

/** Arrays of what is known of each ray. */
struct PatchIntersectionBatch
{
  static constexpr int Size = 64;

  int Count = 0;
  /** What the caller knows it by. */
  std::int32_t Index[Size];
  double Column[Size];
  double Row[Size];
  /** Where the ray meets the plane: how deep, and in barycentric coordinates of the facet. */
  double Depth[Size];
  double X[Size];
  double Y[Size];
  /** Of the three coordinates. */
  double Least[Size];
  /** The ray's length over that along the plane's normal. */
  double Slant[Size];
  /** Of the place on the patch: coordinates as above, and the depth behind that of the plane. */
  double PatchX[Size];
  double PatchY[Size];
  double Behind[Size];
  /** Of Newton's last step, in coordinates, in scaled depths. */
  double Move[Size];
  /** Of the patch, not normalised; after Refract() the step per depth along the refracted ray. */
  double Normal[3][Size];
  /** 0 where the ray is totally reflected. */
  double Refracted[Size];

  void Add(std::int32_t index, double column, double row);
  /** Lane `from` in place of lane `to`, but for Move and what follows. */
  void Keep(int to, int from);
};

/** Depth, X, Y, Least and Slant. @pre GetInstructionSets() has the set */
void MeetPlane(const FacetPlane& plane, const SightRays& rays, InstructionSet set,
  PatchIntersectionBatch& lanes);

/**
 * One step of Newton's method from PatchX, PatchY and Behind to where the ray meets the patch, Move
 * and Normal. @param scale  a depth that is about as long as the facet.
 */
void StepToPatch(const CurvedPatch& patch, const SightRays& rays, double scale, InstructionSet set,
  PatchIntersectionBatch& lanes);

/**
 * Snell's law with Normal, from either side. The step is the way along the refracted ray for a unit
 * of depth along the sight ray (the thesis's Eq. 2.4 undone), in the rays' space.
 * @param ratio  n1 / n2, for rays against the normals.
 */
void Refract(
  const SightRays& rays, double ratio, InstructionSet set, PatchIntersectionBatch& lanes);

}

#endif
