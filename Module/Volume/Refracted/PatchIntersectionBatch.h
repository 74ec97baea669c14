// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Intersection of rays with one curved patch, and Snell's law, for many rays at once: plain loops
 * over arrays, compiled per instruction set. Every lane performs the same operations in the
 * same order in every set, so the results are the same to the last bit.
 */
#pragma once

#include "Refraction/Membrane/CurvedPatch.h"
#include "Simd/InstructionSets.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>

namespace meniscus
{

/** Plane of a facet. */
struct FacetPlane
{
  glm::dvec3 Corner;
  /** Normal whose length is twice the facet's area. */
  glm::dvec3 Normal;
  /** Gradients of the second and the third barycentric coordinate. */
  glm::dvec3 ByX;
  glm::dvec3 ByY;

  /** Intersection with a ray. */
  struct Meeting
  {
    /** Component of the direction along the normal, and its reciprocal. */
    double Along;
    double Inverse;
    double Depth;
    /** Barycentric coordinates. */
    double X;
    double Y;
  };
  Meeting Meet(const glm::dvec3& start, const glm::dvec3& direction) const
  {
    Meeting meeting;
    const glm::dvec3 toCorner = this->Corner - start;
    meeting.Along = glm::dot(this->Normal, direction);
    meeting.Inverse = 1.0 / meeting.Along;
    meeting.Depth = glm::dot(this->Normal, toCorner) * meeting.Inverse;
    const glm::dvec3 inPlane = meeting.Depth * direction - toCorner;
    meeting.X = glm::dot(inPlane, this->ByX);
    meeting.Y = glm::dot(inPlane, this->ByY);
    return meeting;
  }
};

/** State of the search for the intersection of a ray and a patch, after a step. */
struct PatchSearch
{
  enum : std::int64_t
  {
    /** Another step is needed. */
    GoesOn,
    /** The ray meets the patch. */
    Meets,
    /** It meets the surface that continues the patch, close to the patch. */
    Misses,
    /** It meets that surface elsewhere, which does not exclude an intersection with the patch. */
    EndsOutside,
    /** Newton's method does not converge to a place near the facet. */
    Fails
  };
};

struct PatchSearchLimits
{
  /** Length of the last step, as PatchIntersectionBatch::Move. */
  double LastStep;
  /** Distance of a ray that meets a patch from its facet, in barycentric coordinates. */
  double Border;
  /** The same for places close to the patch. */
  double Reach;
};

/** Arrays of the data of each ray. Directions are per unit of depth. */
struct PatchIntersectionBatch
{
  static constexpr int Size = 64;

  int Count = 0;
  /** Number by which the caller identifies the ray. */
  std::int32_t Index[Size];
  double Start[3][Size];
  double Direction[3][Size];
  /** Intersection of the ray with the plane: depth, and barycentric coordinates in the facet. */
  double Depth[Size];
  double X[Size];
  double Y[Size];
  /** Length of the ray's direction over its component along the plane's normal. */
  double Slant[Size];
  /**
   * Intersection with the patch: barycentric coordinates, and the depth behind the intersection
   * with the plane.
   */
  double PatchX[Size];
  double PatchY[Size];
  double Behind[Size];
  /** Length of Newton's last step, in barycentric coordinates and scaled depth. */
  double Move[Size];
  /** Result of FindStates(): PatchSearch. */
  std::int64_t State[Size];
  /**
   * Normal of the patch, not normalised; after Refract(), the step along the refracted ray per unit
   * of depth.
   */
  double Normal[3][Size];
  /** 0 if the ray is totally reflected, otherwise 1 against the normal and -1 along it. */
  double Refracted[Size];

  glm::dvec3 GetStart(int i) const
  {
    return { this->Start[0][i], this->Start[1][i], this->Start[2][i] };
  }
  glm::dvec3 GetDirection(int i) const
  {
    return { this->Direction[0][i], this->Direction[1][i], this->Direction[2][i] };
  }
  void Add(std::int32_t index, const glm::dvec3& start, const glm::dvec3& direction)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Start[axis][this->Count] = start[axis];
      this->Direction[axis][this->Count] = direction[axis];
    }
    this->Index[this->Count] = index;
    ++this->Count;
  }
  /** Copies lane `from` to lane `to`, except for Move and the members after it. */
  void Keep(int to, int from)
  {
    if (to != from)
    {
      this->Copy(to, from);
    }
  }

private:
  void Copy(int to, int from);
};

/** Sets Normal to the patch's normal at X and Y. */
void SetNormals(const CurvedPatch& patch, InstructionSet set, PatchIntersectionBatch& lanes);

/**
 * Coefficients of a patch in single precision, for steps from the facet's plane to the patch with
 * the derivatives of the plane. Lengths are in units of the facet's size. On a patch that is not
 * strongly curved, the first step of Newton's method is then so short that it is the last one.
 */
struct PatchStart
{
  /** A component of the normals: a quadratic polynomial of the barycentric coordinates. */
  struct Form
  {
    float Corner[3];
    float Bend[3];

    /** @param products of the coordinates of the ends of each edge. */
    float At(float c, float x, float y, const float (&products)[3]) const
    {
      return c * this->Corner[0] + x * this->Corner[1] + y * this->Corner[2] +
        products[0] * this->Bend[0] + products[1] * this->Bend[1] + products[2] * this->Bend[2];
    }
  };

  PatchStart() = default;
  /**
   * @param size length of the facet's longest edge.
   * @param spread bound of the difference between the patch's normals and that of the plane.
   */
  PatchStart(const CurvedPatch& patch, const FacetPlane& plane, double size, double spread);

  double Size;
  /** The plane's unit normal, and the gradients of the barycentric coordinates. */
  glm::vec3 Up;
  glm::vec3 ByX;
  glm::vec3 ByY;
  /** Products of the facet's sides at its first corner: of each with itself, and of both, twice. */
  float Sides[3];
  Form AlongUp;
  Form AlongX;
  Form AlongY;
  float Symmetric[3];
  float Asymmetric[3];
  /** True if the normals differ so little that one step leads close enough. */
  bool IsGentle;
};

/**
 * Sets PatchX, PatchY and Behind to places near the intersections of the rays and the patch, from X
 * and Y.
 * @pre GetInstructionSets() has the set
 */
void StartNearPatch(const PatchStart& start, InstructionSet set, PatchIntersectionBatch& lanes);

/**
 * One step of Newton's method for PatchX, PatchY and Behind towards the intersection of the ray and
 * the patch; also computes Move and Normal.
 * @param scale a depth of about the size of the facet.
 */
void StepToPatch(
  const CurvedPatch& patch, double scale, InstructionSet set, PatchIntersectionBatch& lanes);

/**
 * Computes State after a step of Newton's method.
 * @param scale as for StepToPatch().
 */
void FindStates(
  const PatchSearchLimits& limits, double scale, InstructionSet set, PatchIntersectionBatch& lanes);

/**
 * Applies Snell's law with Normal, from either side. The step is the way along the refracted ray
 * per unit of depth along the ray (the inverse of the thesis's Eq. 2.4), in the rays' space.
 * @param ratio n1 / n2, for rays against the normals.
 */
void Refract(double ratio, InstructionSet set, PatchIntersectionBatch& lanes);

}
