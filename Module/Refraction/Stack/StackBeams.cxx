// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackBeams.h"

#include "Refraction/Tubes/RefractedRayBounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// Assumed part of higher degree, relative to that of second degree, as in PatchRoots.
constexpr double HigherDegree = 0.5;

}

//------------------------------------------------------------------------------
void StackBeams::Update(const RefractionStack& stack, const RangeLoop& loop)
{
  this->Stack = &stack;
  const std::vector<RefractionStack::Link>& links = stack.GetLinks();
  const RefractingSurface* first = links.front().Surface.get();
  if (this->TreesOver != first || this->Trees.size() != links.size())
  {
    this->BuildTrees();
  }
  const std::size_t facets = first->GetMembrane().GetFacets().size();
  this->Bounds.assign(links.size(), std::vector<TubeBounds>(facets));
  this->Middles.assign(links.size(), std::vector<RayJet>(facets));
  this->PassedByMiddle.assign(facets, 0);
  this->Parts.clear();
  this->Parts.resize(facets);
  this->PartsOnce = std::make_unique<std::once_flag[]>(facets);
  loop(facets,
    [this](std::size_t begin, std::size_t end)
    {
      Samples samples;
      for (std::size_t i = begin; i < end; ++i)
      {
        this->Bound(static_cast<std::int32_t>(i), samples);
      }
    });
  for (std::size_t k = 0; k < links.size(); ++k)
  {
    this->Trees[k].Refit([this, k](std::int32_t facet)
      { return this->Bounds[k][static_cast<std::size_t>(facet)]; },
      loop);
  }
}

//------------------------------------------------------------------------------
void StackBeams::BuildTrees()
{
  const RefractionStack::Link& first = this->Stack->GetLinks().front();
  const Membrane& membrane = first.Surface->GetMembrane();
  std::vector<glm::dvec3> centroids = membrane.ComputeCentroids();
  for (glm::dvec3& centroid : centroids)
  {
    centroid += first.Shift;
  }
  RayTubeTree tree;
  tree.Build(centroids, membrane.GetRadius());
  this->Trees.assign(this->Stack->GetLinks().size(), tree);
  this->TreesOver = first.Surface.get();
}

//------------------------------------------------------------------------------
void StackBeams::Bound(std::int32_t facet, Samples& samples)
{
  const auto i = static_cast<std::size_t>(facet);
  const std::size_t count = this->Stack->GetLinks().size();
  TubeBounds leg = this->BoundFirstLeg(facet);
  this->Bounds[0][i] = leg;
  if (!leg.IsValid())
  {
    return;
  }
  StackPath& path = samples[0];
  path.Forget(count);
  this->Stack->Trace({ facet, glm::dvec2(1.0 / 3.0) }, count, false, path);
  this->PassedByMiddle[i] = static_cast<std::uint32_t>(path.Count);
  for (std::size_t k = 0; k < path.Count; ++k)
  {
    this->Middles[k][i] = path.Points[k].Ray;
  }
  if (count == 1)
  {
    return;
  }
  for (std::size_t k = 0; k < 6; ++k)
  {
    // The places of another ray are good guesses.
    samples[k] = k == 0 ? path : samples[k - 1];
    this->Stack->Trace({ facet, BeamPlaces[k] }, count, false, samples[k]);
  }
  for (std::size_t k = 1; k < count && leg.IsValid(); ++k)
  {
    TubeBounds bySamples;
    leg = this->BoundBySamples(samples, k, bySamples)
      ? bySamples
      : BoundNextLeg(this->Stack->GetLinks()[k], leg);
    this->Bounds[k][i] = leg;
  }
}

//------------------------------------------------------------------------------
bool StackBeams::BoundBySamples(const Samples& samples, std::size_t leg, TubeBounds& bounds) const
{
  std::array<glm::dvec3, 6> origins;
  std::array<glm::dvec3, 6> directions;
  for (std::size_t i = 0; i < 6; ++i)
  {
    if (samples[i].Count <= leg || GetFootprint(samples[i], leg + 1) > LargestFootprint)
    {
      return false;
    }
    origins[i] = samples[i].Points[leg].Ray.Origin;
    directions[i] = samples[i].Points[leg].Ray.Direction;
  }
  AxisBox start;
  AxisBox direction;
  if (!BoundBeamMap(origins, 0.0, HigherDegree, start) ||
    !BoundBeamMap(directions, SmallBeamDeflection, HigherDegree, direction))
  {
    return false;
  }
  bounds = { start.Low, start.High, direction.Low, direction.High };
  return true;
}

//------------------------------------------------------------------------------
TubeBounds StackBeams::BoundFirstLeg(std::int32_t facet) const
{
  const RefractionStack::Link& first = this->Stack->GetLinks().front();
  TubeBounds leg = BoundRefractedRays(first.Surface->GetPatch(facet, !first.Passage.FromFront),
    this->Stack->GetEye() - first.Shift, first.Passage.Before / first.Passage.Behind);
  if (leg.IsValid())
  {
    leg.StartLow += first.Shift;
    leg.StartHigh += first.Shift;
  }
  return leg;
}

//------------------------------------------------------------------------------
const StackBeamParts& StackBeams::GetParts(std::int32_t facet) const
{
  const auto i = static_cast<std::size_t>(facet);
  std::call_once(this->PartsOnce[i],
    [this, facet, i] { this->Parts[i] = std::make_unique<StackBeamParts>(*this->Stack, facet); });
  return *this->Parts[i];
}

//------------------------------------------------------------------------------
bool StackBeams::MayShow(
  const StackTarget& target, std::int32_t facet, const PatchTriangle& corners) const
{
  const double slack = this->Stack->GetLinks().front().Surface->GetSlack(glm::length(target.Point));
  return MayReach(
    *this->Stack, facet, corners, target.Count, { target.Point - slack, target.Point + slack });
}

//------------------------------------------------------------------------------
void StackBeams::FindCandidates(const StackTarget& target, std::vector<Candidate>& candidates) const
{
  candidates.clear();
  const std::size_t leg = target.Count - 1;
  this->Trees[leg].Visit(target.Point, glm::dvec3(0.0),
    [this, &target, &candidates, leg](std::int32_t facet)
    {
      Candidate candidate{ facet, glm::dvec2(0.0), std::numeric_limits<double>::infinity() };
      const auto i = static_cast<std::size_t>(facet);
      if (this->PassedByMiddle[i] > leg)
      {
        const RayJet& ray = this->Middles[leg][i];
        const glm::dvec3 nearest = GetNearest(ray, target.Point);
        candidate.Move = GetMove(ray, nearest, target.Point - nearest);
        const double size = GetLargest(candidate.Move);
        candidate.Size = std::isfinite(size) ? size : candidate.Size;
      }
      candidates.push_back(candidate);
      return std::numeric_limits<std::int32_t>::max();
    });
  std::sort(candidates.begin(), candidates.end(),
    [](const Candidate& a, const Candidate& b)
    { return a.Size != b.Size ? a.Size < b.Size : a.Facet < b.Facet; });
}

}
