// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Curved/SightFollower.h"

#include "Refraction/Curved/VirtualPlace.h"
#include "Refraction/Surface/PatchCrossings.h"

#include <algorithm>

namespace meniscus
{
namespace
{

// Limits: Newton steps in one patch, how far a step may leave the patch before the next patch takes
// over, the number of such changes, and of facets to cross on the way to the next target. For
// longer ways the tree is faster.
constexpr int Steps = 8;
constexpr double Reach = 0.3;
constexpr int MostPatches = 8;
constexpr int LongestWalk = 64;

// All lanes of a block are computed, at the cost of about two points that are followed alone.
constexpr int FewTrails = 3;

}

//------------------------------------------------------------------------------
// True if the trail goes on in another patch.
bool SightFollower::MayGoOn(SightTrail& trail)
{
  if (trail.End == SightTrail::State::Open && trail.Patches == MostPatches)
  {
    trail.End = SightTrail::State::Lost;
  }
  trail.Patches += trail.End == SightTrail::State::Open;
  return trail.End == SightTrail::State::Open;
}

//------------------------------------------------------------------------------
std::int32_t SightFollower::Expect(std::int32_t facet, std::int32_t step) const
{
  const std::int64_t hint = std::int64_t{ facet } + step;
  if (step == 0 || hint < 0 || hint >= static_cast<std::int64_t>(this->Patches.GetSize()))
  {
    return CurvedPatches::NoFacet;
  }
  this->Patches.PrefetchPatch(static_cast<std::int32_t>(hint));
  return static_cast<std::int32_t>(hint);
}

//------------------------------------------------------------------------------
// True if a facet faces the same side as the last place and its corner is not half as far from the
// target.
bool SightFollower::IsNearer(std::int32_t facet, const SightTrail& trail) const
{
  const PatchPoint corner = this->Patches.GetCorner(facet);
  const PatchPoint& last = trail.Place.Root.At;
  const glm::dvec3 way = corner.Position - trail.Target;
  const glm::dvec3 wayBefore = last.Position - trail.Target;
  return 4.0 * glm::dot(way, way) < glm::dot(wayBefore, wayBefore) &&
    glm::dot(corner.Normal, last.Normal) > 0.0;
}

//------------------------------------------------------------------------------
// The walk to the target, from the last place of the trail or from its hint.
FacetWalk SightFollower::WalkToTarget(const SightTrail& trail) const
{
  const bool isHinted =
    trail.Patches == 1 && trail.Hint != CurvedPatches::NoFacet && this->IsNearer(trail.Hint, trail);
  return FacetWalk(this->Patches, isHinted ? trail.Hint : trail.Place.Facet, trail.Target,
    trail.Place.Root.At.Normal, LongestWalk);
}

//------------------------------------------------------------------------------
// Goes on from the end of Newton's method in a patch.
void SightFollower::Resume(SightTrail& trail) const
{
  using End = enum SightRoot::End;
  const SightRoot& root = trail.Place.Root;
  if (root.End == End::Converged && FindOutside(root.B).Least >= -PatchCrossings::Border)
  {
    trail.End = this->Optics.MakeEquation(trail.Point).IsImage(root.At) ? SightTrail::State::Found
                                                                        : SightTrail::State::Lost;
    return;
  }
  trail.End = root.End == End::Converged || root.End == End::Left ? SightTrail::State::Open
                                                                  : SightTrail::State::Lost;
}

//------------------------------------------------------------------------------
// Newton's method in the patch that the trail comes to next.
void SightFollower::FollowInPatch(SightTrail& trail) const
{
  trail.Place.Facet = WalkToTarget(trail).Finish();
  const CurvedPatch patch = this->Patches.GetPatch(trail.Place.Facet);
  const glm::dvec2 start = patch.ProjectToFacet(trail.Target);
  SightRoot& root = trail.Place.Root;
  if (FindOutside(start).Least < -Reach)
  {
    root = { SightRoot::End::Failed, start, {}, 0.0 };
  }
  else
  {
    root = this->Optics.MakeEquation(trail.Point).Solve(patch, start, Steps, Reach);
  }
  this->Resume(trail);
  if (trail.End == SightTrail::State::Found)
  {
    *trail.Vertex = this->MakeVertex(trail.Point, patch, trail.Place);
  }
  trail.Target = patch.GetFlatPoint(root.B);
}

//------------------------------------------------------------------------------
void SightFollower::Follow(SightTrail& trail) const
{
  while (MayGoOn(trail))
  {
    this->FollowInPatch(trail);
  }
}

//------------------------------------------------------------------------------
void SightFollower::FollowAll(const std::vector<SightTrail*>& trails) const
{
  SightLanes lanes;
  SightTrail* block[SightLanes::Count];
  const auto follow = [this, &lanes, &block](int count)
  {
    if (count >= FewTrails)
    {
      this->FollowBlock(block, count, lanes);
      return;
    }
    for (int i = 0; i < count; ++i)
    {
      this->FollowInPatch(*block[i]);
    }
  };
  bool isOpen = true;
  while (isOpen)
  {
    isOpen = false;
    int count = 0;
    for (SightTrail* trail : trails)
    {
      if (!MayGoOn(*trail))
      {
        continue;
      }
      block[count++] = trail;
      if (count == SightLanes::Count)
      {
        follow(count);
        count = 0;
      }
      isOpen = true;
    }
    follow(count);
  }
}

//------------------------------------------------------------------------------
// Walks of all trails to their targets, in turns.
void SightFollower::WalkAll(SightTrail* const* trails, int count) const
{
  FacetWalk walks[SightLanes::Count];
  int lanes[SightLanes::Count];
  for (int i = 0; i < count; ++i)
  {
    walks[i] = this->WalkToTarget(*trails[i]);
    lanes[i] = i;
  }
  for (int open = count; open > 0;)
  {
    const int before = open;
    open = 0;
    for (int i = 0; i < before; ++i)
    {
      const int lane = lanes[i];
      lanes[open] = lane;
      open += walks[lane].Advance();
    }
  }
  for (int i = 0; i < count; ++i)
  {
    trails[i]->Place.Facet = walks[i].GetFacet();
  }
}

//------------------------------------------------------------------------------
void SightFollower::Load(const SightTrail& trail, int lane, SightLanes& lanes) const
{
  this->Patches.LoadPatch(trail.Place.Facet, lane, lanes);
  SightLanes::Set(lanes.Point, lane, trail.Point);
  SightLanes::Set(lanes.Target, lane, trail.Target);
}

//------------------------------------------------------------------------------
// Newton's method in the patches that the trails have come to. The last trail fills free lanes.
void SightFollower::FollowBlock(SightTrail* const* trails, int count, SightLanes& lanes) const
{
  this->WalkAll(trails, count);
  for (int lane = 0; lane < SightLanes::Count; ++lane)
  {
    this->Load(*trails[std::min(lane, count - 1)], lane, lanes);
  }
  SightRoot roots[SightLanes::Count];
  SolveLanes(this->Optics, Steps, Reach, this->Set, lanes, roots);
  bool isFound = false;
  for (int lane = 0; lane < count; ++lane)
  {
    trails[lane]->Place.Root = roots[lane];
    this->Resume(*trails[lane]);
    isFound = isFound || trails[lane]->End == SightTrail::State::Found;
  }
  if (isFound)
  {
    ComputeVirtualPlaces(this->Optics, this->Set, roots, lanes);
  }
  for (int lane = 0; lane < count; ++lane)
  {
    SightTrail& trail = *trails[lane];
    if (trail.End == SightTrail::State::Found)
    {
      const VirtualPlace place{ SightLanes::Get(lanes.Position, lane), lanes.Depth[lane],
        lanes.Reflectance[lane], lanes.Cosine[lane] };
      *trail.Vertex =
        this->MakeVertex(trail.Point, trail.Place, place, lanes.Orientation[lane] < 0.0 ? -1 : 1);
    }
    else if (trail.End == SightTrail::State::Open)
    {
      trail.Target = this->Patches.GetPatch(trail.Place.Facet).GetFlatPoint(trail.Place.Root.B);
    }
  }
}

//------------------------------------------------------------------------------
VirtualVertex SightFollower::MakeVertex(
  const glm::dvec3& local, const SightPlace& at, const VirtualPlace& place, int orientation) const
{
  VirtualVertex vertex;
  vertex.Position = (this->Optics.IsIdentity() ? local : place.Position) + this->Origin;
  vertex.SightPoint = at.Root.At.Position + this->Origin;
  vertex.Depth = place.Depth;
  vertex.Reflectance = place.Reflectance;
  vertex.Cosine = place.Cosine;
  vertex.Facet = at.Facet;
  vertex.State = ImageState::Found;
  vertex.Orientation = static_cast<signed char>(orientation);
  return vertex;
}

//------------------------------------------------------------------------------
VirtualVertex SightFollower::MakeVertex(
  const glm::dvec3& local, const CurvedPatch& patch, const SightPlace& at) const
{
  const SightRoot& root = at.Root;
  return this->MakeVertex(local, at,
    ComputeVirtualPlace(this->Optics, this->Optics.GetLaw(), local, root.At),
    SightEquation::GetOrientation(patch, root.At.Normal, root.Determinant));
}

}
