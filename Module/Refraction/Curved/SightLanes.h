// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Newton's method on Snell's law for several points at once, each in a patch of its own: plain
 * loops over arrays, compiled per instruction set. Every lane performs the operations of
 * SightEquation::Solve and ComputeVirtualPlace in the same order, in every set, so the results are
 * the same to the last bit.
 */
#pragma once

#include "Refraction/Curved/VirtualPlace.h"
#include "Refraction/Sight/SightEquation.h"
#include "Refraction/Surface/CurveCrossings.h"
#include "Simd/InstructionSets.h"

#include <glm/vec3.hpp>

namespace meniscus
{

/** Arrays of the data of each point; positions are relative to the membrane's origin. */
struct SightLanes
{
  /** Number of lanes, all of which are computed: the doubles of the widest register. */
  static constexpr int Count = 8;

  /** A vector of each lane, by component. */
  using Vectors = double[3][Count];

  /** Corners, normals and bends of the patch; 1 for edges that are cubics, 0 for straight ones. */
  Vectors Corner[3];
  Vectors Normal[3];
  Vectors Bend[3];
  double IsCubic[3][Count];
  /** Coefficients of the edges, which SolveLanes computes. */
  double Symmetric[3][Count];
  double Asymmetric[3][Count];

  /** Point whose image is sought, and the expected sight point. */
  Vectors Point;
  Vectors Target;

  /** Barycentric coordinates of Newton's iterate. */
  double B[2][Count];
  /** 1 if the target is not too far outside of the facet, otherwise 0. */
  double IsInside[Count];
  /** Members of SightEquation::Iterate: 1 for true, 0 for false. */
  double IsFinite[Count];
  double IsLast[Count];
  double HasLeft[Count];
  /** Place of the patch after the step, and the determinant before it. */
  Vectors At;
  Vectors NormalAt;
  double Determinant[Count];

  /** Members of VirtualPlace, and 1 or -1 for the orientation of the image. */
  Vectors Position;
  double Depth[Count];
  double Reflectance[Count];
  double Cosine[Count];
  double Orientation[Count];

  static void Set(Vectors& vectors, int lane, const glm::dvec3& vector)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      vectors[axis][lane] = vector[axis];
    }
  }
  static glm::dvec3 Get(const Vectors& vectors, int lane)
  {
    return { vectors[0][lane], vectors[1][lane], vectors[2][lane] };
  }
  /** True if the last step has ended Newton's method in a lane. */
  bool HasEnded(int lane) const
  {
    return !(this->IsFinite[lane] > 0.0) || this->IsLast[lane] > 0.0 || this->HasLeft[lane] > 0.0;
  }
  /** Its result. */
  SightRoot GetRoot(int lane) const
  {
    using End = enum SightRoot::End;
    const End end = !(this->IsFinite[lane] > 0.0)
      ? End::Failed
      : (this->IsLast[lane] > 0.0 ? End::Converged : End::Left);
    return { end, { this->B[0][lane], this->B[1][lane] },
      { Get(this->At, lane), Get(this->NormalAt, lane) }, this->Determinant[lane] };
  }
};

/**
 * Newton's method from the feet of the targets in the facets' planes, as SightEquation::Solve with
 * these limits. Lanes whose target is outside of the facet by more than `reach` fail. Lanes that
 * have not ended after `steps` steps stay open.
 * @pre GetInstructionSets() has the set
 */
void SolveLanes(const Media& media, int steps, double reach, InstructionSet set, SightLanes& lanes,
  SightRoot (&roots)[SightLanes::Count]);

/** Computes the virtual places and the orientations at the roots. */
void ComputeVirtualPlaces(const Media& media, InstructionSet set,
  const SightRoot (&roots)[SightLanes::Count], SightLanes& lanes);

}
