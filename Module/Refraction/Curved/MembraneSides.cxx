// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Curved/MembraneSides.h"

#include "Refraction/Surface/PatchCrossings.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// Two crossings are in the order of their heights if these differ by more than this fraction of the
// patch's size. Two crossings at a common edge may differ by the effect of PatchCrossings::Border
// in both of its facets.
constexpr double SameHeight = 4.0 * PatchCrossings::Border;

// Number of detours to try if the line along the axis decides nothing. The probability that one of
// them decides nothing is of the order of the rounding of coordinates, unless the patch is
// crumpled.
constexpr int Ways = 12;

constexpr double Lowest = std::numeric_limits<double>::lowest();

glm::dvec3 GetWinding(const CurvedPatch& patch)
{
  return glm::cross(patch.Corner[1] - patch.Corner[0], patch.Corner[2] - patch.Corner[0]);
}

/** Highest of the crossings, and the agreement of others at the same height. */
struct NearestCrossing
{
  double Height = Lowest;
  int Side = 0;
  std::int32_t Facet = CurvedPatches::NoFacet;
  double Same = 0.0;
  bool IsInside = false; ///< in the interior of its patch, or in the patches on both sides of an
                         ///< edge
  bool IsDisputed = false;

  /** Height below which crossings are certainly farther. */
  double GetLowest() const { return this->Height - this->Same; }

  /**
   * True if the crossing decides the side. Just outside of one facet, and not in its neighbour, the
   * line may pass an edge that both facets turn away from.
   */
  bool IsSure() const { return this->IsInside && !this->IsDisputed; }

  void Add(const PatchCrossing& crossing, std::int32_t of, double tie)
  {
    const double slack = std::max(tie, this->Same);
    if (crossing.Height > this->Height + slack)
    {
      *this = { crossing.Height, crossing.Side, of, tie, crossing.Outside >= 0.0, false };
    }
    else if (crossing.Height >= this->Height - slack)
    {
      this->IsInside = this->IsInside || of != this->Facet || crossing.Outside >= 0.0;
      this->IsDisputed = this->IsDisputed || crossing.Side != this->Side;
      this->Height = std::max(this->Height, crossing.Height);
      this->Same = slack;
    }
  }
};

// Directions on the unit sphere, no two of them parallel, along a golden-angle spiral.
glm::dvec3 GetWay(int i)
{
  constexpr double goldenAngle = 2.399963229728653;
  const double z = 1.0 - (2.0 * i + 1.0) / Ways;
  const double radius = std::sqrt(1.0 - z * z);
  return { radius * std::cos(goldenAngle * i), radius * std::sin(goldenAngle * i), z };
}

}

//------------------------------------------------------------------------------
void MembraneSides::Build(
  const Membrane& surface, const CurvedPatches& patches, const HeightFrame& frame)
{
  this->Surface = &surface;
  this->Patches = &patches;
  this->Frame = frame;
  // Rounding error of a patch's point and of Newton's method.
  this->Slack = 1024.0 * std::numeric_limits<double>::epsilon() * surface.GetRadius();
  const std::size_t count = surface.GetFacets().size();
  this->Columns.resize(count);
  std::vector<glm::dvec3> centroids(count, glm::dvec3(0.0));
  for (std::size_t i = 0; i < count; ++i)
  {
    const CurvedPatch patch = patches.GetPatch(static_cast<std::int32_t>(i));
    const glm::dvec3 sum = patch.Normal[0] + patch.Normal[1] + patch.Normal[2];
    this->Columns[i] = { std::nextafter(static_cast<float>(BoundBulge(patch)),
                           std::numeric_limits<float>::infinity()),
      static_cast<signed char>(glm::dot(GetWinding(patch), sum) < 0.0 ? -1 : 1) };
    for (const glm::dvec3& corner : patch.Corner)
    {
      centroids[i] += frame.ToFrame(corner) / 3.0;
    }
  }
  this->Tree.Build(centroids, count == 0 ? 1.0 : surface.GetRadius());
  this->Tree.Refit(
    [this](std::int32_t facet)
    {
      const glm::dvec3 bulge(
        static_cast<double>(this->Columns[static_cast<std::size_t>(facet)].Bulge));
      TubeBounds bounds;
      for (const std::int32_t vertex : this->Surface->GetFacets()[static_cast<std::size_t>(facet)])
      {
        const glm::dvec3 corner =
          this->Frame.ToFrame(this->Surface->GetPositions()[static_cast<std::size_t>(vertex)]);
        bounds.Add(corner - bulge, { 0.0, 0.0, 1.0 });
        bounds.Add(corner + bulge, { 0.0, 0.0, 1.0 });
      }
      return bounds;
    },
    SerialLoop);
}

//------------------------------------------------------------------------------
MembraneSides::Side MembraneSides::Find(const glm::dvec3& local) const
{
  const Look look = this->LookAlong(this->Frame, local, std::numeric_limits<double>::infinity());
  return look.OpenFacet == CurvedPatches::NoFacet ? look.Answer
                                                  : this->FindAround(local, look.OpenFacet);
}

//------------------------------------------------------------------------------
MembraneSides::Look MembraneSides::MakeLook(int side)
{
  return { side > 0 ? Side::Front : (side < 0 ? Side::Behind : Side::Unknown),
    CurvedPatches::NoFacet };
}

//------------------------------------------------------------------------------
MembraneSides::Side MembraneSides::FindAround(const glm::dvec3& local, std::int32_t openFacet) const
{
  const double size = this->Patches->GetPatch(openFacet).GetSize();
  for (int i = 0; i < Ways; ++i)
  {
    // About half of a facet: far enough to leave the patch that the line runs along, and not far
    // beyond other patches.
    const double reach = size * (0.3 + 0.4 * i / Ways);
    const glm::dvec3 way = GetWay(i);
    Look look = this->LookAlong(HeightFrame(-way), local, reach);
    if (look.OpenFacet == CurvedPatches::NoFacet && look.Answer == Side::Unknown)
    {
      look =
        this->LookAlong(this->Frame, local + reach * way, std::numeric_limits<double>::infinity());
      // The place is on a patch; the point itself is not.
      look.Answer = look.Answer == Side::On ? Side::Front : look.Answer;
    }
    if (look.OpenFacet == CurvedPatches::NoFacet)
    {
      return look.Answer;
    }
  }
  ++this->Undecided;
  return Side::Behind;
}

//------------------------------------------------------------------------------
// The side of the nearest patch below the point along the frame's axis, if it is no farther than
// `reach`.
MembraneSides::Look MembraneSides::LookAlong(
  const HeightFrame& frame, const glm::dvec3& local, double reach) const
{
  thread_local std::vector<Candidate> candidates; // kept between points so that its memory is
                                                  // reused
  candidates.clear();
  const double low = frame.GetHeight(local) - reach - this->Slack;
  double floor = low;
  const bool isAcross = reach < std::numeric_limits<double>::infinity();
  this->Tree.Visit(this->Frame.ToFrame(local),
    glm::dvec3(isAcross ? reach + this->Slack : this->Slack),
    [this, &frame, &local, low, &floor](std::int32_t facet)
    {
      const Candidate candidate = this->Classify(facet, frame, local, low);
      if (candidate.High >= floor)
      {
        candidates.push_back(candidate);
        floor = candidate.Side != 0 ? std::max(floor, candidate.Low) : floor;
      }
      return std::numeric_limits<std::int32_t>::max();
    });
  // Facets of equal height are ordered by their numbers: the result must not depend on the
  // library's sort.
  std::sort(candidates.begin(), candidates.end(),
    [](const Candidate& a, const Candidate& b)
    { return a.High != b.High ? a.High > b.High : a.Facet < b.Facet; });
  if (candidates.empty())
  {
    return MakeLook(0);
  }
  const Candidate& first = candidates.front();
  if (first.Side != 0 && (candidates.size() == 1 || candidates[1].High < first.Low))
  {
    return MakeLook(first.Side);
  }
  return this->LookExactly(candidates, frame, local, low);
}

//------------------------------------------------------------------------------
// A candidate with the lowest number as `high` stands for no crossing.
MembraneSides::Candidate MembraneSides::Classify(
  std::int32_t facet, const HeightFrame& frame, const glm::dvec3& local, double low) const
{
  const auto& corners = this->Surface->GetFacets()[static_cast<std::size_t>(facet)];
  const Column& column = this->Columns[static_cast<std::size_t>(facet)];
  const double bulge = static_cast<double>(column.Bulge) + this->Slack;
  glm::dvec2 place[3];
  double lowest = std::numeric_limits<double>::max();
  double highest = Lowest;
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3 away =
      this->Surface
        ->GetPositions()[static_cast<std::size_t>(corners[static_cast<std::size_t>(k)])] -
      local;
    place[k] = frame.Project(away);
    const double height = frame.GetHeight(away);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  const double own = frame.GetHeight(local);
  const Candidate none{ facet, Lowest, Lowest, 0 };
  if (lowest - bulge > this->Slack || own + highest + bulge < low)
  {
    return none; // above the point, or too far below it
  }
  const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
  const double area = cross(place[1] - place[0], place[2] - place[0]);
  const double sign = area < 0.0 ? -1.0 : 1.0;
  bool isInside = true;
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec2& from = place[(k + 1) % 3];
    const glm::dvec2 side = place[(k + 2) % 3] - from;
    const double distance = sign * cross(from, side); // distance times the side's length, positive
                                                      // inside
    const double margin = bulge * glm::length(side);
    if (distance < -margin)
    {
      return none;
    }
    isInside = isInside && distance > margin;
  }
  const bool isBelow = highest + bulge < -this->Slack && own + lowest - bulge > low;
  return { facet, own + lowest - bulge, own + highest + bulge,
    isInside && isBelow ? (area < 0.0 ? -column.Front : column.Front) : 0 };
}

//------------------------------------------------------------------------------
MembraneSides::Look MembraneSides::LookExactly(const std::vector<Candidate>& candidates,
  const HeightFrame& frame, const glm::dvec3& local, double low) const
{
  const glm::dvec2 place = frame.Project(local);
  const double own = frame.GetHeight(local);
  NearestCrossing nearest;
  double open = Lowest;
  std::int32_t openFacet = CurvedPatches::NoFacet;
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const Candidate& candidate = candidates[i];
    if (candidate.High < nearest.GetLowest())
    {
      break; // the crossings are in the order of their heights
    }
    const bool isNext = i + 1 == candidates.size() || candidates[i + 1].High < candidate.Low;
    if (candidate.Side != 0 && isNext && std::max(open, nearest.Height) < candidate.Low)
    {
      return MakeLook(candidate.Side);
    }
    const CurvedPatch patch = this->Patches->GetPatch(candidate.Facet);
    PatchCrossings crossings(patch, frame);
    crossings.Find(place, std::max(low, nearest.GetLowest()), own + this->Slack);
    if (crossings.GetHighestOpen() > open)
    {
      open = crossings.GetHighestOpen();
      openFacet = candidate.Facet;
    }
    for (const PatchCrossing& crossing : crossings)
    {
      const double distance = own - crossing.Height;
      if (distance < -this->Slack || crossing.Height < low)
      {
        continue;
      }
      if (distance <= this->Slack)
      {
        return { Side::On, CurvedPatches::NoFacet };
      }
      nearest.Add(crossing, candidate.Facet, SameHeight * patch.GetSize());
    }
  }
  if (openFacet != CurvedPatches::NoFacet && open >= nearest.GetLowest())
  {
    return { Side::Unknown, openFacet };
  }
  return nearest.Facet == CurvedPatches::NoFacet || nearest.IsSure()
    ? MakeLook(nearest.Side)
    : Look{ Side::Unknown, nearest.Facet };
}

}
