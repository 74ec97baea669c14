// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Part of CurvedMembraneSolver: one image of each point, found from those of other points.
#include "Refraction/Curved/CurvedMembraneSolver.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace meniscus
{
namespace
{

// Points are taken to move on as before, and their sight points with them, if the step differs from
// the previous one by no more than this fraction of it.
constexpr double SameStep = 0.5;

// Square of the ratio to the shortest failed step, beyond which a step is not followed. Points in
// random order fail mostly, at the cost of several searches by the tree each. A step of the same
// length as a failed one is tried, since an image may end at any step of a regular grid.
constexpr double LongestFailed = 1.21;

}

//------------------------------------------------------------------------------
void CurvedMembraneSolver::Solve(const double* points, std::size_t begin, std::size_t end,
  VirtualVertex* vertices, const unsigned char* isAsked) const
{
  for (std::size_t first = begin; first < end;)
  {
    const std::size_t last = std::min((first / Chain + ChainsAtOnce) * Chain, end);
    this->SolveChains(points, first, last, vertices, isAsked);
    first = last;
  }
}

//------------------------------------------------------------------------------
// Solves the first points of up to ChainsAtOnce chains together, then the second ones and so on.
void CurvedMembraneSolver::SolveChains(const double* points, std::size_t begin, std::size_t end,
  VirtualVertex* vertices, const unsigned char* isAsked) const
{
  const SightFollower follower = this->GetFollower();
  std::array<Memory, ChainsAtOnce> memories;
  std::array<SightTrail, ChainsAtOnce> trails;
  std::vector<SightTrail*> open;
  for (std::size_t step = 0; step < Chain; ++step)
  {
    open.clear();
    const auto visit = [&](const auto& work)
    {
      for (std::size_t chain = 0; chain < ChainsAtOnce; ++chain)
      {
        const std::size_t i = (begin / Chain + chain) * Chain + step;
        if (i >= begin && i < end && (!isAsked || isAsked[i]))
        {
          work(i, memories[chain], trails[chain]);
        }
      }
    };
    visit(
      [&](std::size_t i, Memory& memory, SightTrail& trail)
      {
        const double* p = points + 3 * i;
        trail.Vertex = vertices + i;
        if (this->Begin(glm::dvec3(p[0], p[1], p[2]), memory, trail))
        {
          open.push_back(&trail);
        }
      });
    follower.FollowAll(open);
    visit(
      [&](std::size_t i, Memory& memory, SightTrail& trail)
      {
        const double* p = points + 3 * i;
        this->Finish(glm::dvec3(p[0], p[1], p[2]), trail, memory);
      });
  }
}

//------------------------------------------------------------------------------
VirtualVertex CurvedMembraneSolver::SolvePoint(const glm::dvec3& point, Memory& memory) const
{
  VirtualVertex vertex;
  SightTrail trail;
  trail.Vertex = &vertex;
  if (this->Begin(point, memory, trail))
  {
    this->GetFollower().Follow(trail);
  }
  this->Finish(point, trail, memory);
  return vertex;
}

//------------------------------------------------------------------------------
// Prepares the search for a point where the answers for the previous points predict the sight
// point. Returns false if there is nothing to follow.
bool CurvedMembraneSolver::Begin(
  const glm::dvec3& point, const Memory& memory, SightTrail& trail) const
{
  trail.Point = point - this->GetMembrane().GetOrigin();
  trail.Hint = CurvedPatches::NoFacet;
  trail.End = SightTrail::State::Open;
  trail.Patches = 0;
  if (!this->IsInReach(trail.Point))
  {
    *trail.Vertex = VirtualVertex();
    trail.Vertex->Position = point;
    trail.Vertex->State = ImageState::NotFinite;
    trail.End = SightTrail::State::Answered;
    return false;
  }
  if (this->Optics.Reflects)
  {
    *trail.Vertex = VirtualVertex();
    trail.Vertex->Position = point;
    if (this->FindOnMirror(trail.Point, *trail.Vertex))
    {
      trail.End = SightTrail::State::Answered;
      return false;
    }
  }
  const glm::dvec3 way = trail.Point - memory.Point;
  if (memory.Place.Facet == CurvedPatches::NoFacet ||
    !(glm::dot(way, way) <= LongestFailed * memory.FailedStep))
  {
    trail.End = SightTrail::State::Lost;
    return false;
  }
  trail.Place = memory.Place;
  trail.Target = memory.Place.Root.At.Position;
  const glm::dvec3 turn = way - memory.PointStep;
  if (glm::dot(turn, turn) < SameStep * SameStep * glm::dot(memory.PointStep, memory.PointStep))
  {
    trail.Target += memory.IsTurning ? memory.SightStep + memory.SightTurn : memory.SightStep;
    // Regular meshes number the facets along a straight way regularly.
    trail.Hint = this->GetFollower().Expect(memory.Place.Facet, memory.FacetStep);
  }
  return true;
}

//------------------------------------------------------------------------------
// Searches all patches for a point that could not be followed, and records the answer.
void CurvedMembraneSolver::Finish(const glm::dvec3& point, SightTrail& trail, Memory& memory) const
{
  if (trail.End == SightTrail::State::Answered)
  {
    return;
  }
  const bool first = memory.Place.Facet == CurvedPatches::NoFacet;
  const glm::dvec3 way = trail.Point - memory.Point;
  if (trail.End != SightTrail::State::Found)
  {
    memory.FailedStep =
      trail.Patches > 0 ? std::min(memory.FailedStep, glm::dot(way, way)) : memory.FailedStep;
    if (!this->FindFirst(this->MakeEquation(trail.Point), trail.Point, trail.Place))
    {
      *trail.Vertex = VirtualVertex();
      trail.Vertex->Position = point;
      return;
    }
    *trail.Vertex =
      this->MakeVertex(trail.Point, this->GetPatches().GetPatch(trail.Place.Facet), trail.Place);
  }
  if (!first)
  {
    const glm::dvec3 step = trail.Place.Root.At.Position - memory.Place.Root.At.Position;
    const glm::dvec3 turn = step - memory.SightStep;
    const glm::dvec3 change = turn - memory.SightTurn;
    memory.IsTurning = glm::dot(change, change) < glm::dot(turn, turn);
    memory.SightTurn = turn;
    memory.SightStep = step;
    memory.PointStep = way;
    memory.FacetStep = trail.Place.Facet - memory.Place.Facet;
  }
  memory.Point = trail.Point;
  memory.Place = trail.Place;
}

//------------------------------------------------------------------------------
// Prepares the search for a point between two images. Returns false if there is nothing to follow.
bool CurvedMembraneSolver::BeginBetween(const glm::dvec3& point, const VirtualVertex& first,
  const VirtualVertex& second, SightTrail& trail) const
{
  trail.Point = point - this->GetMembrane().GetOrigin();
  trail.Place.Facet = first.Facet;
  trail.Target = 0.5 * (first.SightPoint + second.SightPoint) - this->GetMembrane().GetOrigin();
  trail.Place.Root.At.Normal = this->Optics.Eye - trail.Target;
  return first.Facet != CurvedPatches::NoFacet && this->IsInReach(trail.Point);
}

//------------------------------------------------------------------------------
VirtualVertex CurvedMembraneSolver::SolveBetween(
  const glm::dvec3& point, const VirtualVertex& first, const VirtualVertex& second) const
{
  VirtualVertex vertex;
  SightTrail trail;
  trail.Vertex = &vertex;
  if (this->BeginBetween(point, first, second, trail))
  {
    this->GetFollower().Follow(trail);
  }
  return vertex;
}

//------------------------------------------------------------------------------
void CurvedMembraneSolver::SolveAllBetween(const PointBetween* points, std::size_t count) const
{
  std::array<SightTrail, MostBetween> trails;
  std::vector<SightTrail*> open;
  open.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    *points[i].Image = VirtualVertex();
    trails[i].Vertex = points[i].Image;
    if (this->BeginBetween(points[i].Point, *points[i].First, *points[i].Second, trails[i]))
    {
      open.push_back(&trails[i]);
    }
  }
  this->GetFollower().FollowAll(open);
}

}
