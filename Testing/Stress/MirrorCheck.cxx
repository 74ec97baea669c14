// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PatchTracer.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "StackCheck.h"

namespace meniscus::test
{

namespace
{

glm::dvec3 ReflectRay(const glm::dvec3& direction, const glm::dvec3& normal)
{
  return direction - 2.0 * glm::dot(direction, normal) * normal;
}

//------------------------------------------------------------------------------
// Positions are in world coordinates, relative to the mirror's origin.
class MirrorChecker
{
public:
  explicit MirrorChecker(const MirrorCase& test)
    : Test(test)
    , Random(test.Seed)
  {
  }

  RefractionTally Run();

private:
  bool SetUp();
  PatchHit ChoosePlace();
  bool FindPlace(const VirtualVertex& vertex, PatchHit& place) const;
  double GetCondition(const PatchHit& first, const glm::dvec3& point) const;
  bool IsFree(const PatchHit& first, const glm::dvec3& direction, double length) const;
  void CheckPlanted(int i);
  void CheckPoint(int i, const glm::dvec3& point, const PatchHit* planted);
  void CheckImage(int i, const glm::dvec3& point, const VirtualVertex& vertex);
  void CheckChains();

  const MirrorCase& Test;
  StressRandom Random;
  CurvedMembraneSolver Mirror;
  CurvedMembraneSolver Threaded;
  std::unique_ptr<PatchTracer> Tracer;
  glm::dvec3 Frame{ 0.0 };
  glm::dvec3 Eye{ 0.0 };
  double Rounding = 0.0;
  RefractionTally Tally;
  std::vector<glm::dvec3> Points; ///< all points so far, in world coordinates
};

//------------------------------------------------------------------------------
bool MirrorChecker::SetUp()
{
  const reference::MembraneMesh mesh =
    PlaceMesh(this->Test.Mesh, this->Test.Scale, this->Test.Offset);
  const glm::dvec3 eye = this->Test.Scale * this->Test.Eye + this->Test.Offset;
  if (this->Mirror.SetMembrane(mesh.AsInput()) != MembraneStatus::Ready ||
    this->Mirror.SetEye(eye, 1.0, 1.5, SerialLoop, true) != EyeStatus::Ready ||
    this->Threaded.SetMembrane(mesh.AsInput(), ReversedThreadsLoop) != MembraneStatus::Ready ||
    this->Threaded.SetEye(eye, 1.0, 1.5, ReversedThreadsLoop, true) != EyeStatus::Ready)
  {
    return false;
  }
  this->Tracer = std::make_unique<PatchTracer>(
    this->Mirror.GetPatches(), this->Mirror.GetMembrane().GetFacets().size());
  this->Frame = this->Mirror.GetMembrane().GetOrigin();
  this->Eye = eye - this->Frame;
  this->Rounding = RoundingOf(this->Test.Scale, this->Test.Offset, this->Test.Eye);
  return true;
}

//------------------------------------------------------------------------------
// A place that faces the eye, sometimes on an edge or a corner of a facet.
PatchHit MirrorChecker::ChoosePlace()
{
  PatchHit place{};
  for (int k = 0; k < 40; ++k)
  {
    const auto facets = static_cast<int>(this->Tracer->GetNumberOfFacets());
    const auto facet = static_cast<std::int32_t>(this->Random.Below(facets));
    glm::dvec2 b = RandomPlace(this->Random);
    if (this->Random.Below(8) == 0)
    {
      b = this->Random.Below(2) ? glm::dvec2(b.x, 0.0) : glm::dvec2(0.0, 1.0);
    }
    place = this->Tracer->Evaluate(facet, b, true);
    if (glm::dot(place.Normal, place.Position - this->Eye) < 0.0)
    {
      break;
    }
  }
  return place;
}

//------------------------------------------------------------------------------
// The place of a sight point in its patch, where the ray from the eye meets it.
bool MirrorChecker::FindPlace(const VirtualVertex& vertex, PatchHit& place) const
{
  const glm::dvec3 sight = vertex.SightPoint - this->Frame;
  const std::vector<PatchHit> hits =
    this->Tracer->FindCrossings(this->Eye, glm::normalize(sight - this->Eye), true, 0.0);
  double nearest = std::numeric_limits<double>::infinity();
  for (const PatchHit& hit : hits)
  {
    const double distance = glm::length(hit.Position - sight);
    if (distance < nearest)
    {
      nearest = distance;
      place = hit;
    }
  }
  return std::isfinite(nearest);
}

//------------------------------------------------------------------------------
double MirrorChecker::GetCondition(const PatchHit& first, const glm::dvec3& point) const
{
  return MeasureCondition(first.B, point, glm::normalize(point - first.Position),
    [&](const glm::dvec2& b)
    {
      const PatchHit near = this->Tracer->Evaluate(first.Facet, b, true);
      return NearRay{ near.Position,
        ReflectRay(glm::normalize(near.Position - this->Eye), near.Normal) };
    });
}

//------------------------------------------------------------------------------
// True if the reflected ray does not meet the mirror again, from either side: its end is in front.
bool MirrorChecker::IsFree(const PatchHit& first, const glm::dvec3& direction, double length) const
{
  const double same = SamePlace * this->Tracer->GetSize(first.Facet);
  for (const bool fromFront : { true, false })
  {
    for (const PatchHit& hit :
      this->Tracer->FindCrossings(first.Position, direction, fromFront, same))
    {
      if (hit.Distance < length + same)
      {
        return false;
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void MirrorChecker::CheckPlanted(int i)
{
  const PatchHit first = this->ChoosePlace();
  const glm::dvec3 sight = glm::normalize(first.Position - this->Eye);
  if (glm::dot(first.Normal, sight) >= 0.0)
  {
    return;
  }
  const glm::dvec3 direction = ReflectRay(sight, first.Normal);
  const double length = this->Test.Scale * Side * std::pow(10.0, this->Random.Uniform(-2.0, 0.3));
  const glm::dvec3 point = first.Position + length * direction;
  const bool isFree = this->IsFree(first, direction, length);
  const bool isCertain = -glm::dot(first.Normal, sight) > Marginal &&
    !this->Tracer->IsAtBorder(first.Facet, first.B, AtBorder) &&
    this->GetCondition(first, point) > Marginal;
  this->Tally.Uncertain += isFree && !isCertain;
  this->CheckPoint(i, point, isFree && isCertain ? &first : nullptr);
}

//------------------------------------------------------------------------------
void MirrorChecker::CheckPoint(int i, const glm::dvec3& point, const PatchHit* planted)
{
  const glm::dvec3 world = point + this->Frame;
  const glm::dvec3 rounded = world - this->Frame;
  this->Points.push_back(world);
  BothSearches<CurvedMembraneSolver, VirtualVertex, VirtualVertex> found;
  if (!found.Run(this->Mirror, world, this->Tally))
  {
    this->Tally.Count(&RefractionTally::Failed, i, "no answer of a mirror", 0.0);
    return;
  }
  const double same = SamePlace * this->Tracer->GetSize(0) + 8.0 * this->Rounding;
  const auto isKnown = [&](const glm::dvec3& sight)
  {
    return std::any_of(found.All.begin(), found.All.end(),
      [&](const VirtualVertex& image) { return glm::length(image.SightPoint - sight) < same; });
  };
  for (const VirtualVertex& image : found.All)
  {
    this->CheckImage(i, rounded, image);
  }
  if (found.First.State == ImageState::Found)
  {
    this->CheckImage(i, rounded, found.First);
    if (found.IsDecided && !isKnown(found.First.SightPoint))
    {
      this->Tally.Count(
        &RefractionTally::Wrong, i, "first image of a mirror is not among all images", 0.0);
    }
  }
  if (planted)
  {
    ++this->Tally.Images;
    if (!isKnown(planted->Position + this->Frame))
    {
      this->Tally.Count(
        &RefractionTally::Missed, i, "missed image in a mirror; decided", found.IsDecided);
    }
    if (found.First.State != ImageState::Found)
    {
      this->Tally.Count(&RefractionTally::Missed, i, "no first image in a mirror", 0.0);
    }
  }
}

//------------------------------------------------------------------------------
// The difference of the unit vectors from the sight point is parallel to the normal; eye and point
// are in front of it. For the tolerance see StackChecker::CheckLaw.
void MirrorChecker::CheckImage(int i, const glm::dvec3& point, const VirtualVertex& vertex)
{
  const glm::dvec3 sight = vertex.SightPoint - this->Frame;
  const glm::dvec3 position = vertex.Position - this->Frame;
  const double out = glm::length(point - sight);
  const double in = glm::length(sight - this->Eye);
  const bool isFinite = std::isfinite(position.x + position.y + position.z + out + vertex.Depth);
  if (!isFinite || !(vertex.Reflectance >= 0.0 && vertex.Reflectance <= 1.0))
  {
    this->Tally.Count(&RefractionTally::Wrong, i, "not a number in a mirror", vertex.Reflectance);
    return;
  }
  if (vertex.Depth == 0.0)
  {
    return; // on the mirror: its own image
  }
  PatchHit place{};
  const double size = this->Tracer->GetSize(std::max(vertex.Facet, 0));
  const double off = Rest * size + 4.0 * this->Rounding;
  const auto isThere = [&place, &sight, off]
  { return glm::length(place.Position - sight) <= 4.0 * off && place.Inside >= -1e-9; };
  if ((!this->FindPlace(vertex, place) || !isThere()) && vertex.Facet >= 0)
  {
    place = this->Tracer->FindFoot(vertex.Facet, sight, true);
  }
  if (!isThere())
  {
    if (!this->Tracer->IsAtBorder(vertex.Facet, { 1.0 / 3.0, 1.0 / 3.0 }, 1.0))
    {
      this->Tally.Count(
        &RefractionTally::False, i, "sight point is not on the mirror", vertex.Facet);
    }
    return;
  }
  const glm::dvec3 a = (sight - this->Eye) / in;
  const glm::dvec3 b = (point - sight) / out;
  const double residual = glm::length(glm::cross(b - a, place.Normal));
  const double tolerance = off * (2.0 / in + 2.0 / out + 8.0 / size);
  if (!(residual <= tolerance) || !(glm::dot(a, place.Normal) < tolerance) ||
    !(-glm::dot(b, place.Normal) < tolerance))
  {
    this->Tally.Count(&RefractionTally::False, i, "law of reflection is off by", residual);
    return;
  }
  if (std::min(in, out) > size)
  {
    this->Tally.Largest = std::max(this->Tally.Largest, residual);
  }
  const double rounding = 8.0 * this->Rounding * (1.0 + 4.0 * out / in) + 1e-13 * out;
  const double misplaced = glm::length(position - (sight + out * a));
  if (!(misplaced <= rounding) || !(std::fabs(vertex.Depth - out) <= rounding))
  {
    this->Tally.Count(
      &RefractionTally::Wrong, i, "virtual vertex of a mirror is off by", misplaced);
  }
}

//------------------------------------------------------------------------------
void MirrorChecker::CheckChains()
{
  if (this->Points.size() < 2)
  {
    return;
  }
  constexpr std::size_t count = CurvedMembraneSolver::Chain + 40;
  const std::vector<double> points = PointsAlong(this->Points, count);
  const auto solve = [&](const CurvedMembraneSolver& solver, const RangeLoop& loop)
  {
    constexpr std::size_t chain = CurvedMembraneSolver::Chain;
    std::vector<VirtualVertex> vertices(count);
    loop((count + chain - 1) / chain,
      [&](std::size_t begin, std::size_t end) {
        solver.Solve(points.data(), begin * chain, std::min(count, end * chain), vertices.data());
      });
    return vertices;
  };
  const std::vector<VirtualVertex> serial = solve(this->Mirror, SerialLoop);
  const std::vector<VirtualVertex> threaded = solve(this->Threaded, ReversedThreadsLoop);
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 world(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    if (!IsSame(serial[i], threaded[i]))
    {
      this->Tally.Count(&RefractionTally::Wrong, static_cast<int>(i),
        "other bits of a mirror on two threads", serial[i].Depth);
    }
    if (serial[i].State == ImageState::Found)
    {
      this->CheckImage(static_cast<int>(i), world - this->Frame, serial[i]);
    }
  }
}

//------------------------------------------------------------------------------
RefractionTally MirrorChecker::Run()
{
  if (!this->SetUp())
  {
    this->Tally.Count(&RefractionTally::Failed, 0, "mirror or eye refused", 0.0);
    return this->Tally;
  }
  for (int i = 0; i < PointsPerCase; ++i)
  {
    if (this->Random.Below(6) == 0)
    {
      const glm::dvec3 at = Side * this->Random.Uniform(0.05, 1.5) * this->Random.GetDirection();
      this->CheckPoint(i, this->Test.Scale * at + this->Test.Offset - this->Frame, nullptr);
    }
    else
    {
      this->CheckPlanted(i);
    }
  }
  this->CheckChains();
  return this->Tally;
}

} // anonymous namespace

//------------------------------------------------------------------------------
RefractionTally CheckMirror(const MirrorCase& test)
{
  return MirrorChecker(test).Run();
}

} // namespace meniscus::test
