// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Curved/SightLanes.h"

#include "Simd/LaneLoop.h"

#include <algorithm>

namespace meniscus
{
namespace
{

double ToNumber(bool value)
{
  return value ? 1.0 : 0.0;
}

/** The patch of a lane without its edges' coefficients. */
inline CurvedPatch GetFrame(const SightLanes& lanes, int i)
{
  CurvedPatch patch;
  for (int k = 0; k < 3; ++k)
  {
    patch.Corner[k] = SightLanes::Get(lanes.Corner[k], i);
    patch.Normal[k] = SightLanes::Get(lanes.Normal[k], i);
  }
  return patch;
}

/** Loop bodies, for one lane each. */
struct StartKernel
{
  double Reach;

  void operator()(SightLanes& lanes, int i) const
  {
    CurvedPatch patch = GetFrame(lanes, i);
    for (int k = 0; k < 3; ++k)
    {
      patch.FitEdge(k);
      lanes.Symmetric[k][i] = lanes.IsCubic[k][i] > 0.0 ? patch.Symmetric[k] : 0.0;
      lanes.Asymmetric[k][i] = lanes.IsCubic[k][i] > 0.0 ? patch.Asymmetric[k] : 0.0;
    }
    const glm::dvec2 b = patch.ProjectToFacet(SightLanes::Get(lanes.Target, i));
    lanes.B[0][i] = b.x;
    lanes.B[1][i] = b.y;
    const double least = std::min(std::min(1.0 - b.x - b.y, b.x), b.y);
    lanes.IsInside[i] = ToNumber(!(least < -this->Reach));
  }
};

template <bool Reflects>
struct NewtonKernel
{
  Media Law;
  double Reach;

  void operator()(SightLanes& lanes, int i) const
  {
    CurvedPatch patch = GetFrame(lanes, i);
    for (int k = 0; k < 3; ++k)
    {
      patch.Bend[k] = SightLanes::Get(lanes.Bend[k], i);
      patch.Symmetric[k] = lanes.Symmetric[k][i];
      patch.Asymmetric[k] = lanes.Asymmetric[k][i];
    }
    const SightEquation equation(this->Law.Eye, SightLanes::Get(lanes.Point, i), this->Law.Exterior,
      this->Law.Interior, Reflects);
    const glm::dvec2 b(lanes.B[0][i], lanes.B[1][i]);
    const SightEquation::Iterate iterate = equation.Advance(patch, b, this->Reach);
    const PatchPoint at = iterate.GetPlace();
    lanes.B[0][i] = iterate.B.x;
    lanes.B[1][i] = iterate.B.y;
    lanes.At[0][i] = at.Position.x;
    lanes.At[1][i] = at.Position.y;
    lanes.At[2][i] = at.Position.z;
    lanes.NormalAt[0][i] = at.Normal.x;
    lanes.NormalAt[1][i] = at.Normal.y;
    lanes.NormalAt[2][i] = at.Normal.z;
    lanes.Determinant[i] = iterate.Determinant;
    lanes.IsFinite[i] = ToNumber(iterate.IsFinite);
    lanes.IsLast[i] = ToNumber(iterate.IsLast);
    lanes.HasLeft[i] = ToNumber(iterate.HasLeft);
  }
};

struct PlaceKernel
{
  Media Optics;
  Media Law;

  void operator()(SightLanes& lanes, int i) const
  {
    const PatchPoint at{ SightLanes::Get(lanes.At, i), SightLanes::Get(lanes.NormalAt, i) };
    const VirtualPlace place =
      ComputeVirtualPlace(this->Optics, this->Law, SightLanes::Get(lanes.Point, i), at);
    lanes.Position[0][i] = place.Position.x;
    lanes.Position[1][i] = place.Position.y;
    lanes.Position[2][i] = place.Position.z;
    lanes.Depth[i] = place.Depth;
    lanes.Reflectance[i] = place.Reflectance;
    lanes.Cosine[i] = place.Cosine;
    lanes.Orientation[i] =
      SightEquation::GetOrientation(GetFrame(lanes, i), at.Normal, lanes.Determinant[i]);
  }
};

}

//------------------------------------------------------------------------------
void SolveLanes(const Media& media, int steps, double reach, InstructionSet set, SightLanes& lanes,
  SightRoot (&roots)[SightLanes::Count])
{
  using End = enum SightRoot::End;
  RunLanes(StartKernel{ reach }, set, lanes);
  int open = 0;
  for (int lane = 0; lane < SightLanes::Count; ++lane)
  {
    roots[lane].End = lanes.IsInside[lane] > 0.0 ? End::Open : End::Failed;
    open += lanes.IsInside[lane] > 0.0;
  }
  const Media law = media.GetLaw();
  for (int i = 0; i < steps && open > 0; ++i)
  {
    if (media.Reflects)
    {
      RunLanes(NewtonKernel<true>{ law, reach }, set, lanes);
    }
    else
    {
      RunLanes(NewtonKernel<false>{ law, reach }, set, lanes);
    }
    for (int lane = 0; lane < SightLanes::Count; ++lane)
    {
      if (roots[lane].End == End::Open && lanes.HasEnded(lane))
      {
        roots[lane] = lanes.GetRoot(lane);
        --open;
      }
    }
  }
}

//------------------------------------------------------------------------------
void ComputeVirtualPlaces(const Media& media, InstructionSet set,
  const SightRoot (&roots)[SightLanes::Count], SightLanes& lanes)
{
  for (int lane = 0; lane < SightLanes::Count; ++lane)
  {
    SightLanes::Set(lanes.At, lane, roots[lane].At.Position);
    SightLanes::Set(lanes.NormalAt, lane, roots[lane].At.Normal);
    lanes.Determinant[lane] = roots[lane].Determinant;
  }
  RunLanes(PlaceKernel{ media, media.GetLaw() }, set, lanes);
}

}
