// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackSearch.h"

#include <algorithm>
#include <limits>

namespace meniscus
{
namespace
{

// Divisions of a patch in a search for one image, and of all patches in a search for all: a ring of
// images needs as many as are allowed.
constexpr int MostDivisions = 2000;

// In a search for all images, parts whose rays all pass are divided down to 2^-14, as in
// PatchRoots: a smaller undecided one holds a double root, on a caustic.
constexpr int DeepestOfAll = 14;

// As in PatchRoots: distance, in units of the part, beyond which a root is no evidence about it,
// and distance of two roots below which they are one, in units of the facet or of its distance from
// the eye.
constexpr double FarthestEvidence = 0.5;
constexpr double SameRoot = 1e-5;

// Cosine between a ray and the plane's normal below which its place in the plane is not used.
constexpr double SmallestCosine = 0.1;

}

//------------------------------------------------------------------------------
void StackSearch::Begin(std::int32_t facet)
{
  this->Facet = facet;
  this->Divisions = this->Images ? this->Divisions : 0;
  this->Patch = this->Stack.GetLinks()[0].Surface->GetPatches().GetPatch(facet);
  this->Shape = FacetShape(this->Patch);
  this->CoarseLevels = this->CountCoarseLevels(0);
}

//------------------------------------------------------------------------------
bool StackSearch::Find(std::int32_t facet, StackPath& path)
{
  this->Images = nullptr;
  this->Begin(facet);
  Part whole;
  for (std::size_t i = 0; i < 6; ++i)
  {
    whole[i] = this->Evaluate(BeamPlaces[i], path);
  }
  return this->SearchPart(whole, 0, path);
}

//------------------------------------------------------------------------------
void StackSearch::FindAll(
  const StackBeamParts& beam, StackPath& path, std::vector<StackPath>& images)
{
  this->Images = &images;
  const double slack =
    this->Stack.GetLinks().front().Surface->GetSlack(glm::length(this->Target.Point));
  beam.Visit(this->Target.Count, this->Target.Point, slack,
    [this, &beam, &path](const StackBeamParts::Part& part)
    {
      if (this->Facet != beam.GetFacet())
      {
        this->Begin(beam.GetFacet());
      }
      this->SearchPart(this->TakePart(beam, part, path), part.Depth, path);
    });
}

//------------------------------------------------------------------------------
// Where all rays pass, the steps of Newton's method are not needed, and no ray is traced.
StackSearch::Part StackSearch::TakePart(
  const StackBeamParts& beam, const StackBeamParts::Part& part, StackPath& path)
{
  const auto passes = [this, &beam](std::int32_t sample)
  { return beam.GetPassed(sample) >= this->Target.Count; };
  const bool isWhole = std::all_of(part.Samples.begin(), part.Samples.end(), passes);
  Part result;
  for (std::size_t i = 0; i < 6; ++i)
  {
    const std::int32_t sample = part.Samples[i];
    result[i].B = beam.GetPlace(sample);
    if (isWhole)
    {
      const StackBeamParts::Ray& ray = beam.GetRay(sample, this->Target.Count - 1);
      result[i].Away = this->Target.Point - ray.Origin;
      result[i].Direction = ray.Direction;
      result[i].Footprint = ray.Footprint;
      result[i].IsValid = true;
    }
    else if (passes(sample))
    {
      result[i] = this->Evaluate(result[i].B, path);
    }
  }
  return result;
}

//------------------------------------------------------------------------------
StackSearch::Sample StackSearch::Evaluate(const glm::dvec2& b, StackPath& path)
{
  Sample sample;
  sample.B = b;
  if (this->Stack.Trace({ this->Facet, b }, this->Target.Count, false, path) != PathEnd::Passed)
  {
    return sample;
  }
  const RayJet& ray = path.GetLast();
  sample.Away = this->Target.Point - ray.Origin;
  sample.Direction = ray.Direction;
  const glm::dvec3 nearest = GetNearest(ray, this->Target.Point);
  sample.Move = GetMove(ray, nearest, this->Target.Point - nearest);
  sample.Footprint = GetFootprint(path, path.Count);
  sample.IsValid = true;
  return sample;
}

//------------------------------------------------------------------------------
int StackSearch::CountCoarseLevels(int near) const
{
  return BeamDivision::CountCoarseLevels(
    this->Stack, this->Shape.GetSize(), near, this->Target.Count);
}

//------------------------------------------------------------------------------
// True if a part has been divided often enough: `levels` times since it was coarse, or since it was
// wider than its distance from the eye.
bool StackSearch::IsDeepest(const Part& part, int depth, int levels, bool fromCoarse) const
{
  if (depth < levels + (fromCoarse ? this->CoarseLevels : 0))
  {
    return false;
  }
  const int near = BeamDivision::CountNearLevels(
    this->Stack, this->Patch, (part[0].B + part[1].B + part[2].B) / 3.0);
  return depth >= levels + (fromCoarse ? this->CountCoarseLevels(near) : near);
}

//------------------------------------------------------------------------------
bool StackSearch::IsDeepest(const Part& part, int depth) const
{
  return this->Images ? this->IsDeepest(part, depth, DeepestOfAll, false)
                      : this->IsDeepest(part, depth, BeamDivision::DeepestLevel, true);
}

//------------------------------------------------------------------------------
// Returns true if the search is over.
bool StackSearch::TakeShot(const Part& part, const glm::dvec2& b, StackPath& path, Shot& shot)
{
  // The nearest crossings first: Shoot follows them.
  const StackPlace place{ this->Facet, b };
  const ShotEnd end = this->Stack.Trace(place, this->Target.Count, false, path) == PathEnd::Passed
    ? Shoot(this->Stack, this->Target, place, ShotSteps, path)
    : ShotEnd::Failed;
  if (end != ShotEnd::Converged)
  {
    shot = end == ShotEnd::Outside ? Shot::Elsewhere : Shot::Failed;
    return false;
  }
  shot = this->Judge(part, path);
  if (!IsImage(this->Stack, this->Target, path))
  {
    return false;
  }
  if (this->Images)
  {
    this->Add(path);
  }
  return !this->Images;
}

//------------------------------------------------------------------------------
// Where Newton's method has ended. One image is found in any part of the patch; among all images,
// each belongs to its part.
StackSearch::Shot StackSearch::Judge(const Part& part, const StackPath& path) const
{
  const StackPlace& root = path.Points[0].Place;
  if (!this->Images)
  {
    return root.Facet == this->Facet ? Shot::Here : Shot::Elsewhere;
  }
  const CurvedPatches& patches = this->Stack.GetLinks()[0].Surface->GetPatches();
  const glm::dvec2 b = root.Facet == this->Facet
    ? root.B
    : this->Patch.ProjectToFacet(patches.GetPatch(root.Facet).GetFlatPoint(root.B));
  const glm::dvec2 u = part[1].B - part[0].B;
  const glm::dvec2 v = part[2].B - part[0].B;
  const glm::dvec2 inside =
    glm::dvec2(Cross(b - part[0].B, v), Cross(u, b - part[0].B)) / Cross(u, v);
  return FindOutside(inside).Least >= -FarthestEvidence ? Shot::Here : Shot::Elsewhere;
}

//------------------------------------------------------------------------------
// Two parts, or patches, find a root on their common border.
void StackSearch::Add(const StackPath& path)
{
  const PathPoint& first = path.Points[0];
  const double same = SameRoot *
    std::min(this->Shape.GetSize(), glm::length(first.Ray.Origin - this->Stack.GetEye()));
  const bool isKnown = std::any_of(this->Images->begin(), this->Images->end(),
    [&first, same](const StackPath& other)
    { return glm::length(other.Points[0].Ray.Origin - first.Ray.Origin) < same; });
  if (!isKnown)
  {
    this->Images->push_back(path);
  }
}

//------------------------------------------------------------------------------
bool StackSearch::SearchPart(const Part& part, int depth, StackPath& path)
{
  const auto valid =
    std::count_if(part.begin(), part.end(), [](const Sample& s) { return s.IsValid; });
  TriangleMap places;
  if (valid == 6 && MeetPlane(part, places))
  {
    return this->SearchWhole(part, places, depth, path);
  }
  return this->SearchBroken(part, depth, path);
}

//------------------------------------------------------------------------------
// Places of the rays in the plane through the target that is normal to their mean direction,
// relative to the target. Returns false if a ray runs along it: the rays of one patch may go to all
// sides.
bool StackSearch::MeetPlane(const Part& part, TriangleMap& places)
{
  glm::dvec3 sum(0.0);
  for (const Sample& sample : part)
  {
    sum += sample.Direction;
  }
  const HeightFrame frame(glm::normalize(sum));
  for (std::size_t k = 0; k < 6; ++k)
  {
    const Sample& sample = part[k];
    const double cosine = frame.GetHeight(sample.Direction);
    // Written so that a NaN fails.
    if (!(cosine > SmallestCosine))
    {
      return false;
    }
    places[k] =
      frame.Project((frame.GetHeight(sample.Away) / cosine) * sample.Direction - sample.Away);
  }
  return true;
}

//------------------------------------------------------------------------------
bool StackSearch::SearchWhole(
  const Part& part, const TriangleMap& places, int depth, StackPath& path)
{
  TriangleMap control;
  double bend = 0.0;
  double size = 0.0;
  double reach = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2& a = places[(k + 1) % 3];
    const glm::dvec2& b = places[(k + 2) % 3];
    control[k] = places[k];
    control[k + 3] = 2.0 * places[k + 3] - 0.5 * (a + b);
    bend = std::max(bend, glm::length(places[k + 3] - 0.5 * (a + b)));
    size = std::max(size, glm::length(b - a));
    reach = std::max(reach, glm::length(a));
  }
  // Six rays do not represent the rays between them if the beam meets many patches.
  const double footprint = BeamDivision::GetExtent(CornersOf(part)) *
    std::max_element(part.begin(), part.end(),
      [](const Sample& a, const Sample& b) { return a.Footprint < b.Footprint; })
      ->Footprint;
  const bool isLast = this->IsDeepest(part, depth);
  const bool isDeepest = isLast || this->Divisions >= MostDivisions;
  if (footprint > LargestFootprint && !isDeepest)
  {
    return this->DivideWhere(part, depth, path);
  }
  const bool isGuess = !(bend <= BeamDivision::LargestDeflection * size);
  constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
  const double margin = BeamDivision::HigherDegree * bend + rounding * (reach + size);
  if (IsSeparated(control, margin))
  {
    return false;
  }
  const bool isCertain = !isGuess && (!this->Images || IsInjective(control, margin));
  if (!isCertain && !isDeepest)
  {
    return isGuess ? this->DivideWhere(part, depth, path) : this->Divide(part, depth, path);
  }
  Shot shot;
  if (this->TakeShot(part, this->GuessRoot(part, places), path, shot))
  {
    return true;
  }
  // A path from here to the target that is no image excludes the part: the map, which is nearly
  // linear, has no other root.
  if (shot != Shot::Here && !isDeepest)
  {
    return this->Divide(part, depth, path);
  }
  // In the smallest parts two images are one; larger ones that are left may have any number.
  this->Complete = this->Complete && shot != Shot::Failed && (!this->Images || isCertain || isLast);
  return false;
}

//------------------------------------------------------------------------------
// Place from which Newton's method starts: the root of the linear part if that is near the part,
// otherwise the place whose ray passes the target most closely.
glm::dvec2 StackSearch::GuessRoot(const Part& part, const TriangleMap& places) const
{
  const glm::dvec2 u = places[1] - places[0];
  const glm::dvec2 v = places[2] - places[0];
  const glm::dvec2 inside = glm::dvec2(Cross(-places[0], v), Cross(u, -places[0])) / Cross(u, v);
  // Written so that a NaN fails.
  if (this->Images && FindOutside(inside).Least >= -FarthestEvidence)
  {
    return part[0].B + inside.x * (part[1].B - part[0].B) + inside.y * (part[2].B - part[0].B);
  }
  const auto nearest = std::min_element(places.begin(), places.end(),
    [](const glm::dvec2& a, const glm::dvec2& b) { return glm::dot(a, a) < glm::dot(b, b); });
  return part[static_cast<std::size_t>(nearest - places.begin())].B;
}

//------------------------------------------------------------------------------
bool StackSearch::SearchBroken(const Part& part, int depth, StackPath& path)
{
  const bool isBlind =
    std::none_of(part.begin(), part.end(), [](const Sample& s) { return s.IsValid; });
  const bool isDeepest = this->IsDeepest(
    part, depth, isBlind ? BeamDivision::DeepestBlind : BeamDivision::DeepestLevel, true);
  if (!isDeepest && this->Divisions < MostDivisions)
  {
    return this->DivideWhere(part, depth, path);
  }
  // Larger parts that are left may have any number of images.
  this->Complete = this->Complete && (!this->Images || isDeepest);
  const double size = BeamDivision::GetExtent(CornersOf(part));
  for (const Sample& sample : part)
  {
    if (sample.IsValid && GetLargest(sample.Move) < BeamDivision::FarthestRoot * size)
    {
      Shot shot;
      if (this->TakeShot(part, sample.B, path, shot))
      {
        return true;
      }
      this->Complete = this->Complete && shot != Shot::Failed;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
PatchTriangle StackSearch::CornersOf(const Part& part)
{
  return { part[0].B, part[1].B, part[2].B };
}

//------------------------------------------------------------------------------
bool StackSearch::Divide(const Part& part, int depth, StackPath& path)
{
  std::size_t corner = 0;
  return this->Shape.IsSlender(CornersOf(part), corner)
    ? this->SearchHalves(part, corner, { true, true }, path)
    : this->SearchQuarters(part, { true, true, true, true }, depth, path);
}

//------------------------------------------------------------------------------
// As Divide, but without the parts that interval arithmetic excludes, whose rays are not traced.
bool StackSearch::DivideWhere(const Part& part, int depth, StackPath& path)
{
  const auto mayShow = [this](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return this->Beams.MayShow(this->Target, this->Facet, { a, b, c });
  };
  std::size_t corner = 0;
  if (this->Shape.IsSlender(CornersOf(part), corner))
  {
    const glm::dvec2& from = part[corner].B;
    const glm::dvec2& middle = part[corner + 3].B;
    return this->SearchHalves(part, corner,
      { mayShow(from, part[(corner + 1) % 3].B, middle),
        mayShow(from, middle, part[(corner + 2) % 3].B) },
      path);
  }
  std::array<bool, 4> quarters;
  for (std::size_t k = 0; k < 3; ++k)
  {
    quarters[k] = mayShow(part[k].B, part[(k + 2) % 3 + 3].B, part[(k + 1) % 3 + 3].B);
  }
  quarters[3] = mayShow(part[3].B, part[4].B, part[5].B);
  return this->SearchQuarters(part, quarters, depth, path);
}

//------------------------------------------------------------------------------
// Searches those halves of a part that are marked, on both sides of the line from a corner to the
// middle of the opposite edge.
bool StackSearch::SearchHalves(
  const Part& part, std::size_t corner, const std::array<bool, 2>& halves, StackPath& path)
{
  ++this->Divisions;
  if (!halves[0] && !halves[1])
  {
    return false;
  }
  const std::size_t i = (corner + 1) % 3;
  const std::size_t j = (corner + 2) % 3;
  const Sample& middle = part[corner + 3];
  const Sample inside = this->Evaluate(0.5 * (part[corner].B + middle.B), path);
  for (const bool isFirst : { true, false })
  {
    if (!halves[isFirst ? 0 : 1])
    {
      continue;
    }
    const Sample& end = part[isFirst ? i : j];
    const Sample between = this->Evaluate(0.5 * (end.B + middle.B), path);
    const Part half = isFirst ? Part{ part[corner], end, middle, between, inside, part[j + 3] }
                              : Part{ part[corner], middle, end, between, part[i + 3], inside };
    const int depth = BeamDivision::CountLevels(this->Shape, CornersOf(half));
    if (this->SearchPart(half, depth, path))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
// Searches those quarters of a part that are marked: three at the corners, and one in the middle,
// whose corners are the middles of edges.
bool StackSearch::SearchQuarters(
  const Part& part, const std::array<bool, 4>& quarters, int depth, StackPath& path)
{
  ++this->Divisions;
  Part middle;
  for (std::size_t k = 0; k < 3; ++k)
  {
    middle[k] = part[k + 3];
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (quarters[k] || quarters[3])
    {
      middle[k + 3] = this->Evaluate(0.5 * (middle[(k + 1) % 3].B + middle[(k + 2) % 3].B), path);
    }
  }
  if (quarters[3] && this->SearchPart(middle, depth + 1, path))
  {
    return true;
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (!quarters[k])
    {
      continue;
    }
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    const Part corner{ part[k], part[j + 3], part[i + 3], middle[k + 3],
      this->Evaluate(0.5 * (part[k].B + part[i + 3].B), path),
      this->Evaluate(0.5 * (part[k].B + part[j + 3].B), path) };
    if (this->SearchPart(corner, depth + 1, path))
    {
      return true;
    }
  }
  return false;
}

}
