// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackSolver.h"

#include "Refraction/Membrane/Optics.h"
#include "Refraction/Stack/PlaneImages.h"
#include "Refraction/Stack/StackSearch.h"
#include "Refraction/Surface/CurveCrossings.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace meniscus
{
namespace
{

// Newton steps from the prediction by the previous path. More are a sign of another branch.
constexpr int FollowSteps = 10;

// Distance outside of a facet from which a predicted place belongs to the next one. Most errors of
// predictions are smaller; another value changes the number of steps only.
constexpr double PredictedBorder = 0.01;

// As in CurvedMembraneSolver: change of the step between points, relative to the step, up to which
// the steps are equal.
constexpr double SameStep = 0.5;

// Patches whose middle ray passes the point most closely: they are tried first, from the place that
// the ray's derivatives predict, if that is within some patches.
constexpr std::size_t QuickTries = 3;
constexpr int QuickSteps = 12;
constexpr double FarthestGuess = 4.0;

glm::dvec3 GetPoint(const double* points, std::size_t i)
{
  return { points[3 * i], points[3 * i + 1], points[3 * i + 2] };
}

// Parameters of a ray by which its origin moves by `shift`, as far as it can within the surface.
glm::dvec2 GetParameters(const RayJet& ray, const glm::dvec3& shift)
{
  const glm::dvec3 u = ray.OriginBy[0];
  const glm::dvec3 v = ray.OriginBy[1];
  const double uu = glm::dot(u, u);
  const double uv = glm::dot(u, v);
  const double vv = glm::dot(v, v);
  const double su = glm::dot(shift, u);
  const double sv = glm::dot(shift, v);
  const double inverse = 1.0 / (uu * vv - uv * uv);
  return { inverse * (su * vv - sv * uv), inverse * (sv * uu - su * uv) };
}

}

//------------------------------------------------------------------------------
MediaChain StackSolver::SetInterfaces(const std::vector<Interface>& list)
{
  this->Beams.Clear();
  this->Planes.Clear();
  return this->Stack.SetInterfaces(list);
}

//------------------------------------------------------------------------------
EyeStatus StackSolver::SetEye(const glm::dvec3& eye, const RangeLoop& loop)
{
  const EyeStatus status = this->Stack.SetEye(eye);
  this->Planes.Clear();
  this->BeamsOnce = std::make_unique<std::once_flag>();
  if (status == EyeStatus::Ready && !this->Stack.GetLinks().empty())
  {
    this->Planes.Set(this->Stack);
    this->BoundLegs();
    if (!this->Planes.AreExact())
    {
      this->PrepareBeams(loop);
    }
  }
  return status;
}

//------------------------------------------------------------------------------
const StackBeams& StackSolver::PrepareBeams(const RangeLoop& loop) const
{
  if (!this->Stack.GetLinks().empty())
  {
    std::call_once(*this->BeamsOnce, [this, &loop] { this->Beams.Update(this->Stack, loop); });
  }
  return this->Beams;
}

//------------------------------------------------------------------------------
// A leg between two interfaces is inside of the hull of both.
void StackSolver::BoundLegs()
{
  this->LegBoxes.clear();
  AxisBox last;
  for (const RefractionStack::Link& link : this->Stack.GetLinks())
  {
    AxisBox box;
    const auto facets = static_cast<std::int32_t>(link.Surface->GetMembrane().GetFacets().size());
    for (std::int32_t facet = 0; facet < facets; ++facet)
    {
      box.Add(link.Surface->GetBounds(facet).Box);
    }
    box.Low += link.Shift;
    box.High += link.Shift;
    if (&link != &this->Stack.GetLinks().front())
    {
      last.Add(box);
      this->LegBoxes.push_back(last);
    }
    last = box;
  }
}

//------------------------------------------------------------------------------
// False if no ray can show a point between interface `count`, counted from 1, and the next one.
bool StackSolver::MayBeOnLeg(const glm::dvec3& local, std::size_t count) const
{
  const double slack = this->Stack.GetLinks().front().Surface->GetSlack(glm::length(local));
  return count > this->LegBoxes.size() ||
    Overlap({ local - slack, local + slack }, this->LegBoxes[count - 1]);
}

//------------------------------------------------------------------------------
// False if FindBehindPlanes decides about the point: it is in front of exact parallel planes,
// behind which all refracted rays are, or behind some of them, which are the only way to it.
bool StackSolver::NeedsSearch(const glm::dvec3& local) const
{
  return !this->Planes.AreExact() || this->Planes.CountInFront(local) < 0;
}

//------------------------------------------------------------------------------
bool StackSolver::IsInReach(const glm::dvec3& local) const
{
  const auto& links = this->Stack.GetLinks();
  return RayTubeTree::IsInReach(local,
    links.empty() ? std::numeric_limits<double>::infinity()
                  : links.front().Surface->GetMembrane().GetRadius());
}

//------------------------------------------------------------------------------
void StackSolver::Solve(const double* points, std::size_t begin, std::size_t end,
  VirtualVertex* vertices, StackDetail* details, double* legs) const
{
  const ImageOutput output{ vertices, details, legs, this->Stack.GetNumberOfInterfaces() };
  for (std::size_t first = begin; first < end;)
  {
    const std::size_t last = std::min((first / Chain + 1) * Chain, end);
    this->SolveChain(points, first, last, output);
    first = last;
  }
}

//------------------------------------------------------------------------------
void StackSolver::SolveChain(
  const double* points, std::size_t begin, std::size_t end, const ImageOutput& output) const
{
  Memory memory;
  const StackPath none{};
  thread_local std::vector<std::size_t> others; // kept so that its memory is reused
  others.clear();
  this->SolveBehindPlanes(points, begin, end, output, others);
  for (const std::size_t i : others)
  {
    const glm::dvec3 point = GetPoint(points, i);
    const StackVertex vertex = this->SolvePoint(point, memory);
    output.Vertices[i] = vertex;
    output.Details[i] = vertex;
    this->MeasureLegs(
      point, vertex.Passed > 0 ? memory.Path : none, output.Legs + output.LegsPerPoint * i);
  }
}

//------------------------------------------------------------------------------
void StackSolver::SolveBehindPlanes(const double* points, std::size_t begin, std::size_t end,
  const ImageOutput& output, std::vector<std::size_t>& others) const
{
  if (this->Planes.AreExact())
  {
    meniscus::SolveBehindPlanes(this->Planes, points, begin, end, output, others);
    return;
  }
  for (std::size_t i = begin; i < end; ++i)
  {
    others.push_back(i);
  }
}

//------------------------------------------------------------------------------
void StackSolver::MeasureLegs(const glm::dvec3& point, const StackPath& path, double* legs) const
{
  const std::size_t components = this->Stack.GetNumberOfInterfaces();
  std::fill(legs, legs + components, 0.0);
  // Interfaces behind the eye come first in the list.
  double* leg = legs + (components - this->Stack.GetLinks().size());
  for (std::size_t k = 0; k < path.Count; ++k)
  {
    const glm::dvec3 next =
      k + 1 < path.Count ? path.Points[k + 1].Ray.Origin : point - this->Stack.GetOrigin();
    leg[k] = glm::length(next - path.Points[k].Ray.Origin);
  }
}

//------------------------------------------------------------------------------
StackVertex StackSolver::SolvePoint(const glm::dvec3& point, Memory& memory) const
{
  const glm::dvec3 local = point - this->Stack.GetOrigin();
  StackVertex vertex;
  vertex.Position = point;
  if (!this->IsInReach(local))
  {
    vertex.State = ImageState::NotFinite;
    return vertex;
  }
  if (this->Stack.GetLinks().empty())
  {
    return this->PassThrough(point);
  }
  bool isFound = this->Follow(local, memory);
  if (!isFound)
  {
    memory.Changes.clear();
    isFound = this->FindBehindPlanes(local, memory.Next);
  }
  const std::size_t most = this->NeedsSearch(local) ? this->Stack.GetLinks().size() : 0;
  for (std::size_t count = most; count > 0 && !isFound; --count)
  {
    isFound = this->MayBeOnLeg(local, count) && this->FindFirst({ local, count }, memory.Next);
  }
  if (!isFound)
  {
    return IsBeforeAll(this->Stack, local) ? this->PassThrough(point) : vertex;
  }
  std::swap(memory.Path, memory.Next);
  memory.Point = local;
  return this->MakeRefracted(local, memory.Path);
}

//------------------------------------------------------------------------------
// Places are predicted by their derivatives at the last point. Where the steps are equal, half of
// the change of the derivatives since the step before gives the second order, across patches, too.
bool StackSolver::Follow(const glm::dvec3& local, Memory& memory) const
{
  const StackPath& known = memory.Path;
  const std::size_t count = known.Count;
  if (count == 0)
  {
    return false;
  }
  StackPath& path = memory.Next;
  path.Points.resize(this->Stack.GetLinks().size());
  memory.Held.resize(this->Stack.GetLinks().size());
  const StackTarget target{ local, count };
  const glm::dvec3 step = local - memory.Point;
  const glm::dvec2 move = GetMove(known.GetLast(), memory.Point, step);
  const glm::dvec3 turn = step - memory.Step;
  const bool isSame = glm::dot(turn, turn) < SameStep * SameStep * glm::dot(step, step) &&
    memory.Changes.size() == count;
  memory.Changes.resize(count);
  memory.Step = step;
  glm::dvec2 first(0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const PathPoint& point = known.Points[i];
    const glm::dvec3 change = GetChange(point.Ray.OriginBy, move);
    const glm::dvec2 both =
      isSame ? move + GetParameters(point.Ray, 0.5 * (change - memory.Changes[i])) : move;
    const glm::dvec2 predicted = GetChange(point.By, both);
    memory.Changes[i] = change;
    first = i == 0 ? predicted : first;
    path.Points[i].Place = { point.Place.Facet, point.Place.B + predicted };
  }
  StackPlace place = known.Points[0].Place;
  return Advance(this->Stack, first, place, PredictedBorder) &&
    ShootNear(this->Stack, target, place, FollowSteps, path, memory.Held) == ShotEnd::Converged &&
    IsImage(this->Stack, target, path);
}

//------------------------------------------------------------------------------
bool StackSolver::FindFirst(const StackTarget& target, StackPath& path) const
{
  thread_local std::vector<StackBeams::Candidate> candidates; // kept so that its memory is reused
  const StackBeams& beams = this->GetBeams();
  beams.FindCandidates(target, candidates);
  path.Forget(this->Stack.GetLinks().size());
  const std::size_t tries = std::min(candidates.size(), QuickTries);
  for (std::size_t i = 0; i < tries && candidates[i].Size < FarthestGuess; ++i)
  {
    StackPlace place{ candidates[i].Facet, glm::dvec2(1.0 / 3.0) };
    if (Advance(this->Stack, candidates[i].Move, place) &&
      this->Stack.Trace(place, target.Count, false, path) == PathEnd::Passed &&
      Shoot(this->Stack, target, place, QuickSteps, path) == ShotEnd::Converged &&
      IsImage(this->Stack, target, path))
    {
      return true;
    }
  }
  StackSearch search(this->Stack, beams, target);
  for (const StackBeams::Candidate& candidate : candidates)
  {
    if (search.Find(candidate.Facet, path))
    {
      return true;
    }
  }
  this->Undecided += search.IsComplete() ? 0 : 1;
  return false;
}

//------------------------------------------------------------------------------
// The only image of a point behind parallel planes. If they are not exact, Newton's method moves
// the sight ray by rounding. Returns false if there is none, or, if they are not exact, if the
// point is seen within rounding of a critical angle.
bool StackSolver::FindBehindPlanes(const glm::dvec3& local, StackPath& path) const
{
  const int inFront = this->Planes.CountInFront(local);
  if (inFront <= 0)
  {
    return false;
  }
  const StackTarget target{ local, static_cast<std::size_t>(inFront) };
  if (this->Planes.AreExact())
  {
    return this->Planes.FindPath(local, target.Count, path) && GoesOn(this->Stack, target, path);
  }
  SurfaceCrossing crossing;
  path.Forget(this->Stack.GetLinks().size());
  return this->Stack.FindNext(
           0, this->Stack.GetEye(), this->Planes.FindSight(local, target.Count), crossing) &&
    this->Stack.Trace({ crossing.Facet, crossing.B }, target.Count, false, path) ==
    PathEnd::Passed &&
    Shoot(this->Stack, target, { crossing.Facet, crossing.B }, ShotSteps, path) ==
    ShotEnd::Converged &&
    IsImage(this->Stack, target, path);
}

//------------------------------------------------------------------------------
ImageState StackSolver::FindImages(const glm::dvec3& point, std::vector<StackPath>& images) const
{
  images.clear();
  const glm::dvec3 local = point - this->Stack.GetOrigin();
  if (!this->IsInReach(local))
  {
    return ImageState::NotFinite;
  }
  StackPath path;
  if (this->FindBehindPlanes(local, path))
  {
    images.push_back(path);
    return ImageState::Found;
  }
  bool isComplete = true;
  const std::size_t most = this->NeedsSearch(local) ? this->Stack.GetLinks().size() : 0;
  for (std::size_t count = most; count > 0; --count)
  {
    if (!this->MayBeOnLeg(local, count))
    {
      continue;
    }
    const StackTarget target{ local, count };
    const StackBeams& beams = this->GetBeams();
    StackSearch search(this->Stack, beams, target);
    beams.VisitFacets(count, local, glm::dvec3(0.0),
      [&beams, &search, &path, &images](std::int32_t facet)
      { search.FindAll(beams.GetParts(facet), path, images); });
    isComplete = isComplete && search.IsComplete();
  }
  this->Undecided += isComplete ? 0 : 1;
  std::sort(images.begin(), images.end(),
    [](const StackPath& a, const StackPath& b)
    {
      const StackPlace& first = a.Points[0].Place;
      const StackPlace& second = b.Points[0].Place;
      return std::tie(b.Count, first.Facet, first.B.x, first.B.y) <
        std::tie(a.Count, second.Facet, second.B.x, second.B.y);
    });
  // A point on the first surface has been found behind it.
  const bool isOnFirst = std::any_of(images.begin(), images.end(),
    [this, &local](const StackPath& image)
    {
      return glm::length(local - image.Points[0].Ray.Origin) <=
        this->Stack.GetLinks()[0].Surface->GetSlack(glm::length(local));
    });
  if (this->Stack.GetLinks().empty() || (!isOnFirst && IsBeforeAll(this->Stack, local)))
  {
    images.emplace_back();
  }
  return images.empty() ? ImageState::NoImage : ImageState::Found;
}

//------------------------------------------------------------------------------
ImageState StackSolver::FindImages(
  const glm::dvec3& point, Memory& memory, std::vector<StackPath>& images) const
{
  const glm::dvec3 local = point - this->Stack.GetOrigin();
  const int inFront = this->IsInReach(local) ? this->Planes.CountInFront(local) : -1;
  if (inFront > 0 && static_cast<std::size_t>(inFront) == memory.Path.Count &&
    this->Follow(local, memory))
  {
    std::swap(memory.Path, memory.Next);
    memory.Point = local;
    images.assign(1, memory.Path);
    return ImageState::Found;
  }
  const ImageState state = this->FindImages(point, images);
  if (inFront > 0 && images.size() == 1)
  {
    memory.Path = images[0];
    memory.Point = local;
    memory.Changes.clear();
  }
  return state;
}

//------------------------------------------------------------------------------
StackVertex StackSolver::MakeRefracted(const glm::dvec3& local, const StackPath& path) const
{
  const std::vector<RefractionStack::Link>& links = this->Stack.GetLinks();
  const glm::dvec3& origin = this->Stack.GetOrigin();
  const PathPoint& first = path.Points[0];
  StackVertex vertex;
  vertex.State = ImageState::Found;
  vertex.Passed = static_cast<std::int32_t>(path.Count);
  double optical = 0.0;
  PlateTransmittance transmittance;
  for (std::size_t k = 0; k < path.Count; ++k)
  {
    const PathPoint& point = path.Points[k];
    const InterfacePassage& passage = links[k].Passage;
    const glm::dvec3& next = k + 1 < path.Count ? path.Points[k + 1].Ray.Origin : local;
    const double length = glm::length(next - point.Ray.Origin);
    vertex.Depth += length;
    optical += length / passage.Behind;
    transmittance.Add(point.Cosine, passage.Before, passage.Behind);
    vertex.LastSightPoint = point.Ray.Origin + origin;
  }
  vertex.Transmittance = transmittance.Get();
  vertex.Reflectance =
    FresnelReflectance(first.Cosine, links[0].Passage.Before, links[0].Passage.Behind);
  vertex.SightPoint = first.Ray.Origin + origin;
  vertex.Position = first.Ray.Origin + path.Sight * (links[0].Passage.Before * optical) + origin;
  vertex.Cosine = first.Cosine;
  vertex.Facet = first.Place.Facet;
  // The image is mirrored if the rays turn around the last ray the other way than around the sight
  // ray.
  const RayJet& last = path.GetLast();
  const double distance = glm::dot(local - last.Origin, last.Direction);
  const VectorBy by = last.OriginBy + distance * last.DirectionBy;
  const double atPoint = glm::dot(last.Direction, glm::cross(by[0], by[1]));
  const double atEye = glm::dot(path.Sight, glm::cross(path.SightBy[0], path.SightBy[1]));
  vertex.Orientation = static_cast<signed char>((atPoint < 0.0) == (atEye < 0.0) ? 1 : -1);
  return vertex;
}

//------------------------------------------------------------------------------
void StackSolver::Retrace(
  const glm::dvec3& sightPoint, std::int32_t facet, std::size_t count, StackPath& path) const
{
  path.Count = 0;
  if (count == 0)
  {
    return;
  }
  const RefractionStack::Link& link = this->Stack.GetLinks().front();
  const CurvedPatch patch = link.Surface->GetPatch(facet, !link.Passage.FromFront);
  const glm::dvec3 eye = this->Stack.GetEye() - link.Shift;
  const glm::dvec3 place = sightPoint - this->Stack.GetOrigin() - link.Shift;
  glm::dvec2 b = patch.ProjectToFacet(place);
  double l = 1.0;
  MeetPatch(patch, { eye, place - eye }, b, l);
  this->Stack.Trace({ facet, b }, count, false, path);
}

//------------------------------------------------------------------------------
StackVertex StackSolver::PassThrough(const glm::dvec3& point) const
{
  StackVertex vertex;
  vertex.Position = point;
  vertex.SightPoint = point;
  vertex.LastSightPoint = point;
  vertex.State = ImageState::Found;
  return vertex;
}

}
