// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/PatchIntersectionBatch.h"

#include "Refraction/Membrane/Optics.h"
#include "Simd/InstructionSets.h"
#include "Simd/LaneLoop.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/** Loop bodies, for one lane each. */
struct PlaneKernel
{
  FacetPlane Plane;
  SightRays Rays;
  double NormalLength;

  void operator()(PatchIntersectionBatch& lanes, int i) const
  {
    const glm::dvec3 direction = this->Rays.DirectionOf(lanes, i);
    const FacetPlane::Meeting meeting = this->Plane.Meet(this->Rays.StartOf(lanes, i), direction);
    lanes.Depth[i] = meeting.Depth;
    lanes.X[i] = meeting.X;
    lanes.Y[i] = meeting.Y;
    lanes.Least[i] = meeting.Least;
    lanes.Slant[i] = this->NormalLength * glm::length(direction) / std::fabs(meeting.Along);
  }
};

struct NormalKernel
{
  CurvedPatch Patch;

  void operator()(PatchIntersectionBatch& lanes, int i) const
  {
    const glm::dvec3 normal = this->Patch.GetNormal(glm::dvec2(lanes.X[i], lanes.Y[i]));
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes.Normal[axis][i] = normal[axis];
    }
  }
};

template <class RayType>
struct PatchKernel
{
  CurvedPatch Patch;
  RayType Rays;
  double Scale;

  void operator()(typename RayType::Batch& lanes, int i) const
  {
    const glm::dvec3 direction = this->Rays.DirectionOf(lanes, i);
    const glm::dvec3 start = this->Rays.StartOf(lanes, i);
    PatchJet jet;
    this->Patch.Evaluate(glm::dvec2(lanes.PatchX[i], lanes.PatchY[i]), jet);
    // Cramer's rule for by0 x + by1 y - direction l = rest.
    const glm::dvec3 along = this->Scale * direction;
    const glm::dvec3 rest = start + (lanes.Depth[i] + lanes.Behind[i]) * direction - jet.Position;
    const glm::dvec3 byX = glm::cross(jet.PositionBy[1], along);
    const double inverse = 1.0 / glm::dot(jet.PositionBy[0], byX);
    const double x = inverse * glm::dot(rest, byX);
    const double y = inverse * glm::dot(jet.PositionBy[0], glm::cross(rest, along));
    const double l = -inverse * glm::dot(rest, glm::cross(jet.PositionBy[0], jet.PositionBy[1]));
    lanes.PatchX[i] += x;
    lanes.PatchY[i] += y;
    lanes.Behind[i] += l * this->Scale;
    lanes.Move[i] = std::max(std::max(std::fabs(x), std::fabs(y)), std::fabs(l));
    // The last step is so short that the normal is linear within rounding.
    const glm::dvec3 normal = jet.Normal + x * jet.NormalBy[0] + y * jet.NormalBy[1];
    lanes.Normal[0][i] = normal.x;
    lanes.Normal[1][i] = normal.y;
    lanes.Normal[2][i] = normal.z;
  }
};

template <class RayType>
struct RefractKernel
{
  RayType Rays;
  double Ratio;

  void operator()(typename RayType::Batch& lanes, int i) const
  {
    const glm::dvec3 direction = this->Rays.DirectionOf(lanes, i);
    const double length = glm::length(direction);
    const glm::dvec3 sight = direction / length;
    const glm::dvec3 normal =
      glm::normalize(glm::dvec3(lanes.Normal[0][i], lanes.Normal[1][i], lanes.Normal[2][i]));
    // From behind, light passes from the interior into the exterior.
    const double facing = glm::dot(sight, normal);
    const double sign = facing > 0.0 ? -1.0 : 1.0;
    const double ratio = facing > 0.0 ? 1.0 / this->Ratio : this->Ratio;
    const double cosine = sign * facing;
    const double radicand = RefractionRadicand(cosine, ratio);
    // A point that is drawn at a distance behind the sight point is that distance times n2 / n1
    // away along the refracted ray (Eq. 2.4).
    const glm::dvec3 step =
      length / ratio * RefractionDirection(sight, sign * normal, ratio, cosine, radicand);
    lanes.Normal[0][i] = step.x;
    lanes.Normal[1][i] = step.y;
    lanes.Normal[2][i] = step.z;
    lanes.Refracted[i] = radicand < 0.0 ? 0.0 : sign;
  }
};

}

//------------------------------------------------------------------------------
void PatchIntersectionBatch::Copy(int to, int from)
{
  this->Index[to] = this->Index[from];
  for (double* of : { this->Column, this->Row, this->Depth, this->X, this->Y, this->Least,
         this->Slant, this->PatchX, this->PatchY, this->Behind })
  {
    of[to] = of[from];
  }
}

//------------------------------------------------------------------------------
void FreeRayBatch::CopyRay(int to, int from)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Start[axis][to] = this->Start[axis][from];
    this->Direction[axis][to] = this->Direction[axis][from];
  }
}

//------------------------------------------------------------------------------
void MeetPlane(
  const FacetPlane& plane, const SightRays& rays, InstructionSet set, PatchIntersectionBatch& lanes)
{
  RunLanes(PlaneKernel{ plane, rays, glm::length(plane.Normal) }, set, lanes);
}

//------------------------------------------------------------------------------
void SetNormals(const CurvedPatch& patch, InstructionSet set, PatchIntersectionBatch& lanes)
{
  RunLanes(NormalKernel{ patch }, set, lanes);
}

//------------------------------------------------------------------------------
template <class Rays>
void StepToPatch(const CurvedPatch& patch, const Rays& rays, double scale, InstructionSet set,
  typename Rays::Batch& lanes)
{
  RunLanes(PatchKernel<Rays>{ patch, rays, scale }, set, lanes);
}

//------------------------------------------------------------------------------
template <class Rays>
void Refract(const Rays& rays, double ratio, InstructionSet set, typename Rays::Batch& lanes)
{
  RunLanes(RefractKernel<Rays>{ rays, ratio }, set, lanes);
}

template void StepToPatch(
  const CurvedPatch&, const SightRays&, double, InstructionSet, PatchIntersectionBatch&);
template void StepToPatch(
  const CurvedPatch&, const FreeRays&, double, InstructionSet, FreeRayBatch&);
template void Refract(const SightRays&, double, InstructionSet, PatchIntersectionBatch&);
template void Refract(const FreeRays&, double, InstructionSet, FreeRayBatch&);

}
