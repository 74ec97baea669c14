// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackBeamParts.h"

#include "Refraction/Stack/StackShot.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

// As in PatchRoots, for interpolants that are only guesses.
constexpr double HigherDegreeOfGuess = 2.0;

// Divisions of one patch; parts that are left are divided by each search that needs it.
constexpr std::size_t MostBeamDivisions = 1 << 12;

// Least cosine between a ray and the mean of the six of its part in parts that are not divided
// further for their spread. Another value changes the time only, as long as StackSearch projects
// the rays onto a plane.
constexpr double LeastCosine = 0.5;

// Bounds of rays within `reach` of a ray in the parameters of its patch, to first order.
void AddAround(TubeBounds& bounds, const RayJet& ray, double reach)
{
  const glm::dvec3 start = reach * (glm::abs(ray.OriginBy[0]) + glm::abs(ray.OriginBy[1]));
  const glm::dvec3 turn = reach * (glm::abs(ray.DirectionBy[0]) + glm::abs(ray.DirectionBy[1]));
  bounds.Add(ray.Origin - start, ray.Direction - turn);
  bounds.Add(ray.Origin + start, ray.Direction + turn);
}

}

const glm::dvec2 BeamPlaces[6] = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 }, { 0.5, 0.5 },
  { 0.0, 0.5 }, { 0.5, 0.0 } };

//------------------------------------------------------------------------------
// The distance from the eye to the place is at least a third of a part around it that the eye is
// at, so that such a part is divided further.
int BeamDivision::CountNearLevels(
  const RefractionStack& stack, const CurvedPatch& patch, const glm::dvec2& b)
{
  const RefractionStack::Link& first = stack.GetLinks().front();
  const double distance = glm::length(patch.Evaluate(b).Position + first.Shift - stack.GetEye());
  double size = patch.GetSize();
  int levels = 0;
  while (levels < MostNearLevels && size > distance)
  {
    size *= 0.5;
    ++levels;
  }
  return levels;
}

//------------------------------------------------------------------------------
int BeamDivision::CountCoarseLevels(
  const RefractionStack& stack, double size, int near, std::size_t interfaces)
{
  const std::vector<RefractionStack::Link>& links = stack.GetLinks();
  double smallest = std::numeric_limits<double>::max();
  for (std::size_t k = 1; k < interfaces; ++k)
  {
    smallest = std::min(smallest, links[k].Surface->GetWidth());
  }
  int levels = near;
  while (levels < near + MostCoarseLevels && std::ldexp(size, -levels) > smallest)
  {
    ++levels;
  }
  return levels;
}

//------------------------------------------------------------------------------
int BeamDivision::CountLevels(const FacetShape& facet, const PatchTriangle& corners)
{
  return static_cast<int>(std::lround(std::log2(facet.GetSize() / facet.MeasureSize(corners))));
}

//------------------------------------------------------------------------------
double BeamDivision::GetExtent(const PatchTriangle& corners)
{
  const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
  const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
  return std::max(high.x - low.x, high.y - low.y);
}

//------------------------------------------------------------------------------
bool BoundBeamMap(
  const std::array<glm::dvec3, 6>& f, double least, double higherDegree, AxisBox& box)
{
  double bend = 0.0;
  double size = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec3& a = f[(k + 1) % 3];
    const glm::dvec3& b = f[(k + 2) % 3];
    const glm::dvec3 control = 2.0 * f[k + 3] - 0.5 * (a + b);
    box.Add({ f[k], f[k] });
    box.Add({ control, control });
    bend = std::max(bend, glm::length(f[k + 3] - 0.5 * (a + b)));
    size = std::max(size, glm::length(b - a));
  }
  const bool isGuess = !(bend <= BeamDivision::LargestDeflection * size);
  const double margin = (isGuess ? HigherDegreeOfGuess : higherDegree) * bend;
  box.Low -= margin;
  box.High += margin;
  return !isGuess || bend < least;
}

//------------------------------------------------------------------------------
// Divides the beam of one patch, level by level.
class StackBeamParts::Builder
{
public:
  Builder(const RefractionStack& stack, StackBeamParts& result)
    : Stack(stack)
    , Result(result)
    , Links(result.Links)
    , Patch(stack.GetLinks().front().Surface->GetPatches().GetPatch(result.Facet))
    , Shape(this->Patch)
  {
  }

  void Run()
  {
    this->Path.Forget(this->Links);
    Part whole;
    for (std::size_t i = 0; i < 6; ++i)
    {
      whole.Samples[i] = this->Add(BeamPlaces[i]);
    }
    this->Result.Parts.push_back(whole);
    for (std::size_t i = 0; i < this->Result.Parts.size(); ++i)
    {
      Part& part = this->Result.Parts[i];
      part.Resolved = this->CountResolved(part);
      if (part.Resolved < this->Links && this->Divisions < MostBeamDivisions &&
        this->IsDivided(part))
      {
        this->Divide(i);
      }
    }
    this->BoundAll();
  }

private:
  std::int32_t Add(const glm::dvec2& b)
  {
    this->Stack.Trace({ this->Result.Facet, b }, this->Links, false, this->Path);
    this->Result.Places.push_back(b);
    this->Result.Passed.push_back(static_cast<std::uint8_t>(this->Path.Count));
    for (std::size_t k = 0; k < this->Links; ++k)
    {
      const RayJet& ray = this->Path.Points[k].Ray;
      this->Jets.push_back(ray);
      this->Result.Rays.push_back(k < this->Path.Count
          ? Ray{ ray.Origin, ray.Direction, GetFootprint(this->Path, k + 1) }
          : Ray());
    }
    return static_cast<std::int32_t>(this->Result.Places.size() - 1);
  }

  // Sample in the middle of a side between two samples, which two parts share.
  std::int32_t GetMiddle(std::int32_t a, std::int32_t b)
  {
    const auto low = static_cast<std::uint64_t>(std::min(a, b));
    const std::uint64_t key = low << 32 | static_cast<std::uint64_t>(std::max(a, b));
    const auto known = this->Middles.find(key);
    if (known != this->Middles.end())
    {
      return known->second;
    }
    const std::int32_t middle =
      this->Add(0.5 * (this->Result.GetPlace(a) + this->Result.GetPlace(b)));
    this->Middles[key] = middle;
    return middle;
  }

  std::size_t CountPassing(const Part& part, std::size_t count) const
  {
    return static_cast<std::size_t>(std::count_if(part.Samples.begin(), part.Samples.end(),
      [this, count](std::int32_t sample) { return this->Result.GetPassed(sample) >= count; }));
  }

  bool HasSmallFootprint(const Part& part, std::size_t leg) const
  {
    const double extent = BeamDivision::GetExtent(this->GetCorners(part));
    return std::all_of(part.Samples.begin(), part.Samples.end(),
      [this, extent, leg](std::int32_t sample)
      { return extent * this->Result.GetRay(sample, leg).Footprint <= LargestFootprint; });
  }

  // Bounds of the rays of a part, all of whose six rays pass. Returns false if they are a guess.
  bool BoundBySamples(const Part& part, std::size_t leg, TubeBounds& bounds) const
  {
    std::array<glm::dvec3, 6> origins;
    std::array<glm::dvec3, 6> directions;
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < 6; ++i)
    {
      const Ray& ray = this->Result.GetRay(part.Samples[i], leg);
      origins[i] = ray.Origin;
      directions[i] = ray.Direction;
      sum += ray.Direction;
    }
    const glm::dvec3 mean = glm::normalize(sum);
    // Written so that a NaN fails.
    const bool isNarrow = std::all_of(directions.begin(), directions.end(),
      [&mean](const glm::dvec3& direction) { return glm::dot(direction, mean) > LeastCosine; });
    AxisBox start;
    AxisBox direction;
    const bool isKnown = BoundBeamMap(origins, 0.0, BeamDivision::HigherDegree, start);
    const bool isTurnKnown =
      BoundBeamMap(directions, SmallBeamDeflection, BeamDivision::HigherDegree, direction);
    bounds = { start.Low, start.High, direction.Low, direction.High };
    return isNarrow && isKnown && isTurnKnown;
  }

  std::uint8_t CountResolved(const Part& part) const
  {
    std::uint8_t resolved = 0;
    TubeBounds bounds;
    while (resolved < this->Links && this->CountPassing(part, resolved + 1u) == 6 &&
      this->HasSmallFootprint(part, resolved) && this->BoundBySamples(part, resolved, bounds))
    {
      ++resolved;
    }
    return resolved;
  }

  PatchTriangle GetCorners(const Part& part) const
  {
    return { this->Result.GetPlace(part.Samples[0]), this->Result.GetPlace(part.Samples[1]),
      this->Result.GetPlace(part.Samples[2]) };
  }

  TubeBounds BoundByIntervals(const Part& part, std::size_t count) const
  {
    return BoundStackRays(this->Stack, this->Result.Facet, this->GetCorners(part), count);
  }

  int GetDeepest(const Part& part, std::size_t count) const
  {
    const PatchTriangle corners = this->GetCorners(part);
    const int near = BeamDivision::CountNearLevels(
      this->Stack, this->Patch, (corners[0] + corners[1] + corners[2]) / 3.0);
    return BeamDivision::CountCoarseLevels(this->Stack, this->Shape.GetSize(), near, count) +
      (this->CountPassing(part, count) == 0 ? BeamDivision::DeepestBlind
                                            : BeamDivision::DeepestLevel);
  }

  bool IsDivided(const Part& part) const
  {
    for (std::size_t count = part.Resolved + 1u; count <= this->Links; ++count)
    {
      if (part.Depth < this->GetDeepest(part, count) && this->MayPass(part, count))
      {
        return true;
      }
    }
    return false;
  }

  // False if no ray of the part passes `count` interfaces.
  bool MayPass(const Part& part, std::size_t count) const
  {
    return this->CountPassing(part, count) > 0 || this->BoundByIntervals(part, count).IsValid();
  }

  // Children with the samples at their corners: quarters, or halves of a slender part.
  std::vector<Part> MakeChildren(const Part& part) const
  {
    const std::array<std::int32_t, 6>& s = part.Samples;
    std::vector<Part> children;
    std::size_t corner = 0;
    if (this->Shape.IsSlender(this->GetCorners(part), corner))
    {
      const std::int32_t middle = s[corner + 3];
      children.resize(2);
      children[0].Samples = { s[corner], s[(corner + 1) % 3], middle, 0, 0, 0 };
      children[1].Samples = { s[corner], middle, s[(corner + 2) % 3], 0, 0, 0 };
      for (Part& half : children)
      {
        half.Depth =
          static_cast<std::uint8_t>(BeamDivision::CountLevels(this->Shape, this->GetCorners(half)));
      }
      return children;
    }
    children.resize(4);
    for (std::size_t k = 0; k < 3; ++k)
    {
      children[k].Samples = { s[k], s[(k + 2) % 3 + 3], s[(k + 1) % 3 + 3], 0, 0, 0 };
    }
    children[3].Samples = { s[3], s[4], s[5], 0, 0, 0 };
    for (Part& quarter : children)
    {
      quarter.Depth = static_cast<std::uint8_t>(part.Depth + 1);
    }
    return children;
  }

  void Divide(std::size_t index)
  {
    ++this->Divisions;
    const Part part = this->Result.Parts[index];
    const std::size_t first = this->Result.Parts.size();
    for (Part& child : this->MakeChildren(part))
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        child.Samples[k + 3] =
          this->GetMiddle(child.Samples[(k + 1) % 3], child.Samples[(k + 2) % 3]);
      }
      // Behind the first interfaces the whole part is searched.
      if (this->MayPass(child, part.Resolved + 1u))
      {
        this->Result.Parts.push_back(child);
      }
    }
    this->Result.Parts[index].FirstChild = static_cast<std::int32_t>(first);
    this->Result.Parts[index].Children =
      static_cast<std::uint8_t>(this->Result.Parts.size() - first);
    this->IsCut.resize(this->Result.Parts.size(), false);
    this->IsCut[index] = true;
  }

  // Bounds of the rays of a part that is searched as a whole behind `leg`.
  TubeBounds BoundLeaf(const Part& part, std::size_t leg) const
  {
    TubeBounds bounds;
    const std::size_t passing = this->CountPassing(part, leg + 1);
    if (passing == 6)
    {
      const bool isKnown = this->BoundBySamples(part, leg, bounds);
      return part.Resolved > leg || (isKnown && this->HasSmallFootprint(part, leg))
        ? bounds
        : this->BoundByIntervals(part, leg + 1);
    }
    if (part.Depth < this->GetDeepest(part, leg + 1))
    {
      return this->BoundByIntervals(part, leg + 1);
    }
    // A search tries the rays that pass, as far as Newton's method may lead from them.
    const double reach =
      BeamDivision::FarthestRoot * BeamDivision::GetExtent(this->GetCorners(part));
    for (const std::int32_t sample : part.Samples)
    {
      if (this->Result.GetPassed(sample) > leg)
      {
        AddAround(bounds, this->Jets[static_cast<std::size_t>(sample) * this->Links + leg], reach);
      }
    }
    return bounds;
  }

  // Children come behind their parents.
  void BoundAll()
  {
    const std::size_t count = this->Result.Parts.size();
    this->IsCut.resize(count, false);
    std::vector<TubeBounds> bounds(count * this->Links);
    for (std::size_t i = count; i-- > 0;)
    {
      const Part& part = this->Result.Parts[i];
      for (std::size_t leg = 0; leg < this->Links; ++leg)
      {
        TubeBounds& own = bounds[this->Result.GetIndex(i, leg)];
        if (!this->IsCut[i] || leg < part.Resolved)
        {
          own = this->BoundLeaf(part, leg);
          continue;
        }
        for (std::size_t k = 0; k < part.Children; ++k)
        {
          own.Add(
            bounds[this->Result.GetIndex(static_cast<std::size_t>(part.FirstChild) + k, leg)]);
        }
      }
    }
    this->Result.Tubes = std::vector<TubeClip>(bounds.begin(), bounds.end());
  }

  const RefractionStack& Stack;
  StackBeamParts& Result;
  std::size_t Links;
  CurvedPatch Patch;
  FacetShape Shape;
  std::vector<RayJet> Jets; ///< per sample and interface
  std::vector<bool> IsCut;  ///< per part
  std::unordered_map<std::uint64_t, std::int32_t> Middles;
  std::size_t Divisions = 0;
  StackPath Path;
};

//------------------------------------------------------------------------------
StackBeamParts::StackBeamParts(const RefractionStack& stack, std::int32_t facet)
  : Facet(facet)
  , Links(stack.GetLinks().size())
{
  Builder(stack, *this).Run();
}

}
