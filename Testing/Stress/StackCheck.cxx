// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackCheck.h"

#include "PatchTracer.h"
#include "Refraction/Stack/StackInverse.h"
#include "Refraction/Stack/StackSolver.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <thread>

namespace meniscus
{
namespace test
{

namespace
{

constexpr int PointsPerCase = 24;
constexpr double Side = 200.0;

// Positions on a patch: the rest of Newton's method is below 1e-10 of a facet (StackShot.cxx).
constexpr double Rest = 1e-8;

// Two images are the same, and a crossing is the one at hand, within this part of a facet.
constexpr double Same = 1e-5;

// Cosines, radicands of the square root in Snell's law, distances from borders in facets, and
// conditions of the map from the first surface to the point: what is closer to zero is left open,
// because rounding or the merging of close images decides there.
constexpr double Marginal = 1e-3;
constexpr double AtBorder = 1e-6;

// The round trip's goal, relative to the size of the scene.
constexpr double RoundTrip = 1e-9;

std::optional<glm::dvec3> RefractRay(
  const glm::dvec3& direction, const glm::dvec3& normal, double ratio, double& radicand)
{
  const glm::dvec3 along = ratio * (direction - glm::dot(direction, normal) * normal);
  radicand = 1.0 - glm::dot(along, along);
  if (radicand <= 0.0)
  {
    return std::nullopt;
  }
  return along - std::sqrt(radicand) * normal;
}

template <typename T>
bool HasSameBits(const T& a, const T& b)
{
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

bool IsSame(const VirtualVertex& a, const VirtualVertex& b)
{
  return HasSameBits(a.Position, b.Position) && HasSameBits(a.SightPoint, b.SightPoint) &&
    HasSameBits(a.Depth, b.Depth) && HasSameBits(a.Reflectance, b.Reflectance) &&
    a.Facet == b.Facet && a.State == b.State && a.Orientation == b.Orientation;
}

bool IsFinite(const glm::dvec3& v)
{
  return std::isfinite(v.x + v.y + v.z);
}

//------------------------------------------------------------------------------
/** A surface of the case, with its patches as the tracer sees them. */
struct TracedSurface
{
  std::shared_ptr<StackSurface> Surface = std::make_shared<StackSurface>();
  std::unique_ptr<PatchTracer> Tracer;
  glm::dvec3 Shift{ 0.0 }; ///< of its origin from that of the list
};

/** A sight ray that was traced from patch to patch without the kernel. */
struct TracedPath
{
  std::vector<PatchHit> Points;
  std::vector<glm::dvec3> Directions; ///< behind each interface
  PathEnd End = PathEnd::Passed;
  bool IsCertain = true;
};

class StackChecker
{
public:
  explicit StackChecker(const StackCase& test)
    : Test(test)
    , Random(test.Seed)
  {
  }

  RefractionTally Run();

private:
  bool SetUp();
  bool SetSolver(StackSolver& solver, const std::vector<StackInterface>& list, bool threads);
  std::vector<StackInterface> MakeList() const;
  std::vector<StackInterface> MakePaddedList();
  bool HasExpectedLinks() const;

  glm::dvec3 ToWorld(const glm::dvec3& frame) const { return frame + this->Frame; }
  const StackLayer& GetLayer(std::size_t k) const { return *this->Layers[k]; }
  const TracedSurface& GetSurface(std::size_t k) const
  {
    return this->Surfaces[this->Layers[k]->Mesh];
  }
  std::vector<PatchHit> FindCrossings(
    std::size_t k, const glm::dvec3& origin, const glm::dvec3& direction) const;
  PatchHit Evaluate(std::size_t k, std::int32_t facet, const glm::dvec2& b) const;
  TracedPath Trace(const PatchHit& first) const;
  double GetCondition(const TracedPath& path, const glm::dvec3& point) const;

  PatchHit ChoosePlace();
  void CheckPlanted(int i);
  void CheckElsewhere(int i);
  void CheckPoint(int i, const glm::dvec3& point, const PatchHit* planted, std::size_t count);
  void CheckImage(int i, const glm::dvec3& point, const StackPath& path);
  bool CheckLaw(int i, const glm::dvec3& point, const StackPath& path);
  bool CheckNearest(const glm::dvec3& point, const StackPath& path) const;
  void CheckVertex(
    int i, const glm::dvec3& point, const StackPath& path, const StackVertex& vertex);
  void CheckWayBack(int i, const glm::dvec3& point, const StackPath& path,
    const StackVertex& vertex);
  void CheckChains();

  template <typename Value>
  void Count(std::int64_t RefractionTally::*fault, int i, const char* text, const Value& value)
  {
    ++(this->Tally.*fault);
    if (this->Tally.First.empty())
    {
      std::ostringstream line;
      line.precision(10);
      line << "point " << i << ": " << text << ", " << value;
      this->Tally.First = line.str();
    }
  }

  const StackCase& Test;
  StressRandom Random;
  std::vector<TracedSurface> Surfaces;
  std::vector<const StackLayer*> Layers; ///< those in front of the eye that refract
  StackSolver Solver;
  StackSolver Threaded;
  StackSolver Padded;
  glm::dvec3 Frame{ 0.0 }; ///< origin of the list in world coordinates
  glm::dvec3 Eye{ 0.0 };   ///< relative to it
  double Rounding = 0.0;   ///< of a position
  RefractionTally Tally;
  std::vector<glm::dvec3> Points; ///< all points so far, in world coordinates
};

//------------------------------------------------------------------------------
std::vector<StackInterface> StackChecker::MakeList() const
{
  std::vector<StackInterface> list;
  for (const StackLayer& layer : this->Test.Layers)
  {
    list.push_back({ this->Surfaces[layer.Mesh].Surface, layer.Media });
  }
  return list;
}

//------------------------------------------------------------------------------
// The same list with interfaces of equal indices at both ends and between.
std::vector<StackInterface> StackChecker::MakePaddedList()
{
  std::vector<StackInterface> list;
  const auto pad = [this, &list](double index)
  {
    const int count = 1 + this->Random.Below(2);
    for (int i = 0; i < count; ++i)
    {
      const auto any =
        static_cast<std::size_t>(this->Random.Below(static_cast<int>(this->Surfaces.size())));
      list.push_back({ this->Surfaces[any].Surface, { index, index } });
    }
  };
  for (const StackLayer& layer : this->Test.Layers)
  {
    pad(layer.GetBefore());
    list.push_back({ this->Surfaces[layer.Mesh].Surface, layer.Media });
  }
  pad(this->Test.Layers.back().GetBehind());
  return list;
}

//------------------------------------------------------------------------------
bool StackChecker::SetSolver(
  StackSolver& solver, const std::vector<StackInterface>& list, bool threads)
{
  const glm::dvec3 eye = this->Test.Scale * this->Test.Eye + this->Test.Offset;
  return solver.SetInterfaces(list).Fault == MediaFault::None &&
    solver.SetEye(eye, threads ? RangeLoop(ReversedThreadsLoop) : RangeLoop(SerialLoop)) ==
    EyeStatus::Ready;
}

//------------------------------------------------------------------------------
bool StackChecker::SetUp()
{
  const double scale = this->Test.Scale;
  this->Surfaces = std::vector<TracedSurface>(this->Test.Meshes.size());
  for (std::size_t m = 0; m < this->Test.Meshes.size(); ++m)
  {
    reference::MembraneMesh mesh = this->Test.Meshes[m];
    for (std::size_t i = 0; i < mesh.Points.size(); ++i)
    {
      mesh.Points[i] = scale * mesh.Points[i] + this->Test.Offset[static_cast<int>(i % 3)];
    }
    TracedSurface& surface = this->Surfaces[m];
    if (surface.Surface->SetMembrane(mesh.AsInput()) != MembraneStatus::Ready)
    {
      return false;
    }
    surface.Tracer = std::make_unique<PatchTracer>(
      surface.Surface->GetPatches(), surface.Surface->GetMembrane().GetFacets().size());
  }
  if (!this->SetSolver(this->Solver, this->MakeList(), false) ||
    !this->SetSolver(this->Threaded, this->MakeList(), true) ||
    !this->SetSolver(this->Padded, this->MakePaddedList(), false))
  {
    return false;
  }
  this->Frame = this->Solver.GetStack().GetOrigin();
  this->Eye = scale * this->Test.Eye + this->Test.Offset - this->Frame;
  for (TracedSurface& surface : this->Surfaces)
  {
    surface.Shift = surface.Surface->GetMembrane().GetOrigin() - this->Frame;
  }
  std::size_t behindEye = this->Test.LayersBehindEye;
  for (const StackLayer& layer : this->Test.Layers)
  {
    if (behindEye > 0)
    {
      --behindEye;
    }
    else if (layer.GetBefore() != layer.GetBehind())
    {
      this->Layers.push_back(&layer);
    }
  }
  this->Rounding = 4.0 * std::numeric_limits<double>::epsilon() *
    (glm::length(this->Test.Offset) + scale * (glm::length(this->Test.Eye) + 4.0 * Side));
  return true;
}

//------------------------------------------------------------------------------
bool StackChecker::HasExpectedLinks() const
{
  const std::vector<RefractionStack::Link>& links = this->Solver.GetStack().GetLinks();
  bool same = links.size() == this->Layers.size();
  for (std::size_t k = 0; same && k < links.size(); ++k)
  {
    same = links[k].Surface == this->GetSurface(k).Surface &&
      links[k].Passage.FromFront == this->GetLayer(k).FromFront &&
      links[k].Passage.Before == this->GetLayer(k).GetBefore() &&
      links[k].Passage.Behind == this->GetLayer(k).GetBehind();
  }
  return same;
}

//------------------------------------------------------------------------------
std::vector<PatchHit> StackChecker::FindCrossings(
  std::size_t k, const glm::dvec3& origin, const glm::dvec3& direction) const
{
  const TracedSurface& surface = this->GetSurface(k);
  std::vector<PatchHit> hits = surface.Tracer->FindCrossings(
    origin - surface.Shift, direction, this->GetLayer(k).FromFront, 0.0);
  for (PatchHit& hit : hits)
  {
    hit.Position += surface.Shift;
  }
  return hits;
}

//------------------------------------------------------------------------------
PatchHit StackChecker::Evaluate(std::size_t k, std::int32_t facet, const glm::dvec2& b) const
{
  const TracedSurface& surface = this->GetSurface(k);
  PatchHit hit = surface.Tracer->Evaluate(facet, b, this->GetLayer(k).FromFront);
  hit.Position += surface.Shift;
  return hit;
}

//------------------------------------------------------------------------------
TracedPath StackChecker::Trace(const PatchHit& first) const
{
  TracedPath path;
  glm::dvec3 direction = glm::normalize(first.Position - this->Eye);
  PatchHit hit = first;
  for (std::size_t k = 0; k < this->Layers.size(); ++k)
  {
    if (k > 0)
    {
      const std::vector<PatchHit> hits = this->FindCrossings(k, path.Points.back().Position,
        direction);
      if (hits.empty())
      {
        path.End = PathEnd::Missed;
        return path;
      }
      hit = hits.front();
      const double size = this->GetSurface(k).Tracer->GetSize(hit.Facet);
      for (const PatchHit& other : hits)
      {
        // Another crossing as close, or one that the ray hardly makes.
        path.IsCertain = path.IsCertain &&
          (glm::length(other.Position - hit.Position) < 1e-9 * size ||
            other.Distance > hit.Distance + Marginal * size);
      }
    }
    const StackLayer& layer = this->GetLayer(k);
    double radicand = 0.0;
    const auto refracted =
      RefractRay(direction, hit.Normal, layer.GetBefore() / layer.GetBehind(), radicand);
    path.IsCertain = path.IsCertain && std::fabs(radicand) > Marginal * Marginal &&
      -glm::dot(direction, hit.Normal) > Marginal &&
      !this->GetSurface(k).Tracer->IsAtBorder(hit.Facet, hit.B, AtBorder);
    if (!refracted)
    {
      path.End = PathEnd::Reflected;
      return path;
    }
    direction = *refracted;
    path.Points.push_back(hit);
    path.Directions.push_back(direction);
  }
  return path;
}

//------------------------------------------------------------------------------
// Determinant of the map from the first facet to the plane through the point, over the square of
// its longer column, by differences: 0 on a caustic or if rays beside this one do not pass.
double StackChecker::GetCondition(const TracedPath& path, const glm::dvec3& point) const
{
  constexpr double h = 1e-5;
  const std::size_t count = path.Points.size();
  const glm::dvec3 axis = path.Directions.back();
  const PatchHit& first = path.Points.front();
  glm::dvec3 by[2];
  for (int k = 0; k < 2; ++k)
  {
    const double step = (k == 0 ? first.B.x : first.B.y) > 0.5 ? -h : h;
    const glm::dvec2 b = first.B + step * glm::dvec2(k == 0 ? 1.0 : 0.0, k == 0 ? 0.0 : 1.0);
    const TracedPath near = this->Trace(this->Evaluate(0, first.Facet, b));
    if (near.Points.size() < count)
    {
      return 0.0;
    }
    const glm::dvec3 origin = near.Points[count - 1].Position;
    const glm::dvec3 direction = near.Directions[count - 1];
    const double length = glm::dot(point - origin, axis) / glm::dot(direction, axis);
    by[k] = (origin + length * direction - point) / step;
  }
  const double longest = std::max(glm::dot(by[0], by[0]), glm::dot(by[1], by[1]));
  return std::fabs(glm::dot(axis, glm::cross(by[0], by[1]))) / longest;
}

//------------------------------------------------------------------------------
PatchHit StackChecker::ChoosePlace()
{
  const auto facets = static_cast<int>(this->GetSurface(0).Tracer->GetNumberOfFacets());
  const auto facet = static_cast<std::int32_t>(this->Random.Below(facets));
  glm::dvec2 b(this->Random.Uniform(), this->Random.Uniform());
  b = b.x + b.y > 1.0 ? 1.0 - b : b;
  if (this->Random.Uniform() < this->Test.BorderShare)
  {
    const double t = this->Random.Uniform();
    const glm::dvec2 places[6] = { { t, 0.0 }, { 0.0, t }, { t, 1.0 - t }, { 0.0, 0.0 },
      { 1.0, 0.0 }, { 0.0, 1.0 } };
    b = places[this->Random.Below(6)];
  }
  return this->Evaluate(0, facet, b);
}

//------------------------------------------------------------------------------
// A point on a ray that was traced before: its image is known.
void StackChecker::CheckPlanted(int i)
{
  PatchHit first = this->ChoosePlace();
  for (int k = 0; k < 20 && glm::dot(first.Normal, first.Position - this->Eye) >= 0.0; ++k)
  {
    first = this->ChoosePlace(); // it faces away
  }
  if (glm::dot(first.Normal, first.Position - this->Eye) >= 0.0)
  {
    return;
  }
  const TracedPath path = this->Trace(first);
  this->Tally.RaysMissed += path.End == PathEnd::Missed;
  this->Tally.RaysReflected += path.End == PathEnd::Reflected;
  if (path.Points.empty())
  {
    return;
  }
  // The last leg, or sometimes an earlier one.
  std::size_t count = path.Points.size();
  if (count > 1 && this->Random.Below(4) == 0)
  {
    count = 1 + static_cast<std::size_t>(this->Random.Below(static_cast<int>(count) - 1));
  }
  const PatchHit& last = path.Points[count - 1];
  const glm::dvec3& direction = path.Directions[count - 1];
  double most = 0.0;
  if (count < path.Points.size())
  {
    most = glm::length(path.Points[count].Position - last.Position);
  }
  else if (path.End == PathEnd::Reflected)
  {
    most = this->FindCrossings(count, last.Position, direction).front().Distance;
  }
  const double length = most > 0.0
    ? most * this->Random.Uniform(0.02, 0.98)
    : this->Test.Scale * Side * std::pow(10.0, this->Random.Uniform(-2.0, 0.5));
  const glm::dvec3 point = last.Position + length * direction;
  // A ray that misses the next surface shows nothing.
  const bool isSeen = count < path.Points.size() || path.End != PathEnd::Missed;
  TracedPath seen = path;
  seen.Points.resize(count);
  seen.Directions.resize(count);
  const bool isCertain = path.IsCertain && this->GetCondition(seen, point) > Marginal;
  this->Tally.Uncertain += isSeen && !isCertain;
  this->CheckPoint(i, point, isSeen && isCertain ? &first : nullptr, count);
}

//------------------------------------------------------------------------------
// A point anywhere: whatever is reported must be an image.
void StackChecker::CheckElsewhere(int i)
{
  const auto spread = [this] { return this->Random.Uniform(-0.6 * Side, 0.6 * Side); };
  const glm::dvec3 at(spread(), this->Random.Uniform(-2.0 * Side, 0.5 * Side), spread());
  const glm::dvec3 world = this->Test.Scale * at + this->Test.Offset;
  this->CheckPoint(i, world - this->Frame, nullptr, 0);
}

//------------------------------------------------------------------------------
void StackChecker::CheckPoint(
  int i, const glm::dvec3& point, const PatchHit* planted, std::size_t count)
{
  ++this->Tally.Points;
  const glm::dvec3 world = this->ToWorld(point);
  const glm::dvec3 rounded = world - this->Frame;
  this->Points.push_back(world);
  const std::int64_t undecided = this->Solver.GetNumberOfUndecidedSearches();
  std::vector<StackPath> images;
  const ImageState state = this->Solver.FindImages(world, images);
  const bool isDecided = this->Solver.GetNumberOfUndecidedSearches() == undecided;
  this->Tally.Undecided += !isDecided;
  StackSolver::Memory memory;
  StackPath path;
  const StackVertex first = this->Solver.SolvePoint(world, memory, path);
  if (state == ImageState::NotFinite || first.State == ImageState::NotFinite)
  {
    this->Count(&RefractionTally::Failed, i, "no answer", 0);
    return;
  }
  for (const StackPath& image : images)
  {
    this->CheckImage(i, rounded, image);
  }
  const double size = this->GetSurface(0).Tracer->GetSize(0);
  const auto isKnown = [&](const glm::dvec3& sight, std::size_t passed)
  {
    return std::any_of(images.begin(), images.end(),
      [&](const StackPath& image)
      {
        return image.Count == passed &&
          (passed == 0 ||
            glm::length(image.Points[0].Ray.Origin - sight) < Same * size + 8.0 * this->Rounding);
      });
  };
  if (first.State == ImageState::Found)
  {
    path.Count = static_cast<std::size_t>(first.Passed);
    this->CheckImage(i, rounded, path);
    if (isDecided && !isKnown(first.SightPoint - this->Frame, path.Count))
    {
      this->Count(&RefractionTally::Wrong, i, "first image is not among all images", path.Count);
    }
  }
  if (planted)
  {
    ++this->Tally.Images;
    if (!isKnown(planted->Position, count))
    {
      this->Count(&RefractionTally::Missed, i,
        isDecided ? "missed image behind interfaces" : "missed image, reported as undecided",
        count);
    }
    if (first.State != ImageState::Found)
    {
      this->Count(&RefractionTally::Missed, i, "no first image behind interfaces", count);
    }
  }
}

//------------------------------------------------------------------------------
void StackChecker::CheckImage(int i, const glm::dvec3& point, const StackPath& path)
{
  const StackVertex vertex = this->Solver.MakeVertex(this->ToWorld(point), path);
  if (!this->CheckLaw(i, point, path))
  {
    return;
  }
  if (!this->CheckNearest(point, path))
  {
    this->Count(&RefractionTally::False, i, "crosses a surface earlier, or not at all; interfaces",
      path.Count);
    return;
  }
  this->CheckVertex(i, point, path, vertex);
  this->CheckWayBack(i, point, path, vertex);
}

//------------------------------------------------------------------------------
// n1 times the part of the incoming unit vector along the surface is n2 times that of the outgoing
// one. Positions are off by Rest of a facet, which turns a leg by that over its length, and the
// normal by at most that over a facet's size, times the turn of the normals within it.
bool StackChecker::CheckLaw(int i, const glm::dvec3& point, const StackPath& path)
{
  glm::dvec3 before = this->Eye;
  for (std::size_t k = 0; k < path.Count; ++k)
  {
    const PathPoint& at = path.Points[k];
    const PatchHit hit = this->Evaluate(k, at.Place.Facet, at.Place.B);
    const double size = this->GetSurface(k).Tracer->GetSize(hit.Facet);
    const double off = Rest * size + 4.0 * this->Rounding;
    if (!(glm::length(hit.Position - at.Ray.Origin) <= off) || !(hit.Inside > -Same))
    {
      this->Count(&RefractionTally::False, i, "sight point is not on the surface", k);
      return false;
    }
    const glm::dvec3 next = k + 1 < path.Count ? path.Points[k + 1].Ray.Origin : point;
    const double in = glm::length(at.Ray.Origin - before);
    const double out = glm::length(next - at.Ray.Origin);
    const glm::dvec3 a = (at.Ray.Origin - before) / in;
    const glm::dvec3 b = (next - at.Ray.Origin) / out;
    const StackLayer& layer = this->GetLayer(k);
    const auto along = [&hit](const glm::dvec3& v) { return v - glm::dot(v, hit.Normal) * hit.Normal; };
    const double residual =
      glm::length(layer.GetBefore() * along(a) - layer.GetBehind() * along(b));
    const double most = std::max(layer.GetBefore(), layer.GetBehind());
    const double tolerance = most * off * (2.0 / in + 2.0 / out + 8.0 / size);
    // At grazing incidence the sign of the cosine is within the same tolerance.
    if (!(residual <= tolerance) || !(glm::dot(a, hit.Normal) < tolerance) ||
      !(glm::dot(b, hit.Normal) < tolerance))
    {
      this->Count(&RefractionTally::False, i, "Snell's law is off by", residual);
      return false;
    }
    if (std::min(in, out) > size)
    {
      this->Tally.Largest = std::max(this->Tally.Largest, residual);
    }
    before = at.Ray.Origin;
  }
  return true;
}

//------------------------------------------------------------------------------
// Each leg ends at its nearest crossing; the last one goes on to the next surface, if there is one.
bool StackChecker::CheckNearest(const glm::dvec3& point, const StackPath& path) const
{
  glm::dvec3 origin = path.Count > 0 ? path.Points[0].Ray.Origin : this->Eye;
  for (std::size_t k = path.Count > 0 ? 1 : 0; k <= path.Count && k < this->Layers.size(); ++k)
  {
    const bool isLast = k == path.Count;
    const glm::dvec3 end = isLast ? point : path.Points[k].Ray.Origin;
    const double length = glm::length(end - origin);
    const std::vector<PatchHit> hits =
      this->FindCrossings(k, origin, (end - origin) / length);
    const double size = this->GetSurface(k).Tracer->GetSize(0);
    const double same = Same * size + 8.0 * this->Rounding;
    for (const PatchHit& hit : hits)
    {
      const bool isClear =
        -glm::dot(hit.Normal, (end - origin) / length) > Marginal && hit.Inside > AtBorder;
      if (isClear && hit.Distance > same && hit.Distance < length - same)
      {
        return false;
      }
    }
    if (isLast && hits.empty())
    {
      return false;
    }
    origin = end;
  }
  return true;
}

//------------------------------------------------------------------------------
void StackChecker::CheckVertex(
  int i, const glm::dvec3& point, const StackPath& path, const StackVertex& vertex)
{
  const bool isFinite = IsFinite(vertex.Position) && IsFinite(vertex.SightPoint) &&
    IsFinite(vertex.LastSightPoint) && std::isfinite(vertex.Depth);
  const bool isInRange = vertex.Reflectance >= 0.0 && vertex.Reflectance <= 1.0 &&
    vertex.Transmittance >= 0.0 && vertex.Transmittance <= 1.0;
  if (!isFinite || !isInRange)
  {
    this->Count(&RefractionTally::Wrong, i, "not a number, or a share beyond 0 and 1", path.Count);
    return;
  }
  glm::dvec3 expected = point;
  double depth = 0.0;
  if (path.Count > 0)
  {
    double optical = 0.0;
    for (std::size_t k = 0; k < path.Count; ++k)
    {
      const glm::dvec3 next = k + 1 < path.Count ? path.Points[k + 1].Ray.Origin : point;
      const double leg = glm::length(next - path.Points[k].Ray.Origin);
      depth += leg;
      optical += leg / this->GetLayer(k).GetBehind();
    }
    const glm::dvec3 sight = path.Points[0].Ray.Origin - this->Eye;
    expected = path.Points[0].Ray.Origin +
      this->GetLayer(0).GetBefore() * optical / glm::length(sight) * sight;
  }
  // The direction has the rounding of both ends over their distance.
  const double sight = path.Count > 0 ? glm::length(path.Points[0].Ray.Origin - this->Eye) : 1.0;
  const double rounding = 8.0 * this->Rounding * (1.0 + 4.0 * depth / sight) + 1e-13 * depth;
  const double rest = path.Count > 0
    ? Rest * this->GetSurface(0).Tracer->GetSize(0) * (1.0 + 4.0 * depth / sight)
    : 0.0;
  const bool isRight = glm::length(vertex.Position - this->Frame - expected) <= rounding + rest &&
    std::fabs(vertex.Depth - depth) <= rounding + rest;
  if (!isRight)
  {
    this->Count(&RefractionTally::Wrong, i, "virtual vertex behind interfaces", path.Count);
  }
}

//------------------------------------------------------------------------------
void StackChecker::CheckWayBack(
  int i, const glm::dvec3& point, const StackPath& path, const StackVertex& vertex)
{
  if (path.Count == 0 || path.Count > this->Layers.size())
  {
    return;
  }
  // The way back follows the sight ray to its first crossing.
  const glm::dvec3 sight = path.Points[0].Ray.Origin - this->Eye;
  const std::vector<PatchHit> hits =
    this->FindCrossings(0, this->Eye, glm::normalize(sight));
  const double size = this->GetSurface(0).Tracer->GetSize(0);
  const PatchHit first = this->Evaluate(0, path.Points[0].Place.Facet, path.Points[0].Place.B);
  const TracedPath traced = this->Trace(first);
  if (hits.empty() || !traced.IsCertain || traced.Points.size() < path.Count ||
    hits.front().Distance < glm::length(sight) - Same * size ||
    -glm::dot(first.Normal, glm::normalize(sight)) < Marginal)
  {
    return;
  }
  ++this->Tally.RoundTrips;
  const StackTruePosition back =
    FindTruePosition(this->Solver.GetStack(), this->GetLayer(0).GetBefore(), vertex.Position);
  const double error = glm::length(back.Position - this->Frame - point);
  const double scene = glm::length(point - this->Eye) + this->Test.Scale * Side;
  // A spread of rays multiplies the rest of the first sight point.
  this->Tally.LargestRoundTrip = std::max(this->Tally.LargestRoundTrip, error / scene);
  if (back.State != SeenState::Refracted || !(error <= RoundTrip * scene + 100.0 * this->Rounding))
  {
    this->Count(&RefractionTally::Wrong, i, "round trip is off, relative to the scene, by",
      error / scene);
  }
}

//------------------------------------------------------------------------------
// Chains of points between the ones so far: the same bits on one thread and on two, with and
// without interfaces of equal indices, and images all along.
void StackChecker::CheckChains()
{
  if (this->Points.size() < 2)
  {
    return;
  }
  constexpr std::size_t count = StackSolver::Chain + 8;
  constexpr std::size_t checked = 24; // those compared with other lists and with the law
  std::vector<double> points;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double at = static_cast<double>((this->Points.size() - 1) * i) / count;
    const auto k = static_cast<std::size_t>(at);
    const double part = at - static_cast<double>(k);
    const glm::dvec3 p = (1.0 - part) * this->Points[k] + part * this->Points[k + 1];
    points.insert(points.end(), { p.x, p.y, p.z });
  }
  const std::size_t components = this->Solver.GetStack().GetNumberOfInterfaces();
  struct Result
  {
    std::vector<VirtualVertex> Vertices;
    std::vector<StackDetail> Details;
    std::vector<double> Legs;
  };
  const auto solve = [&](const StackSolver& solver, std::size_t end, const RangeLoop& loop)
  {
    Result result{ std::vector<VirtualVertex>(count), std::vector<StackDetail>(count),
      std::vector<double>(count * components + 1) };
    loop((end + StackSolver::Chain - 1) / StackSolver::Chain,
      [&](std::size_t firstChain, std::size_t lastChain)
      {
        solver.Solve(points.data(), firstChain * StackSolver::Chain,
          std::min(end, lastChain * StackSolver::Chain), result.Vertices.data(),
          result.Details.data(), result.Legs.data());
      });
    return result;
  };
  const Result serial = solve(this->Solver, count, SerialLoop);
  const Result threaded = solve(this->Threaded, count, ReversedThreadsLoop);
  const Result padded = solve(this->Padded, checked, SerialLoop);
  StackSolver::Memory memory;
  StackPath path;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto number = static_cast<int>(i);
    for (const Result* other : { &threaded, i < checked ? &padded : &threaded })
    {
      const bool same = IsSame(serial.Vertices[i], other->Vertices[i]) &&
        HasSameBits(serial.Details[i].Transmittance, other->Details[i].Transmittance) &&
        std::equal(serial.Legs.begin() + static_cast<std::ptrdiff_t>(components * i),
          serial.Legs.begin() + static_cast<std::ptrdiff_t>(components * (i + 1)),
          other->Legs.begin() + static_cast<std::ptrdiff_t>(components * i));
      if (!same)
      {
        this->Count(&RefractionTally::Wrong, number,
          other == &padded ? "other bits with equal indices" : "other bits on two threads", i);
      }
    }
    if (i >= checked)
    {
      continue;
    }
    const glm::dvec3 world(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    const StackVertex vertex = this->Solver.SolvePoint(world, memory, path);
    if (vertex.State == ImageState::Found)
    {
      path.Count = static_cast<std::size_t>(vertex.Passed);
      this->CheckImage(number, world - this->Frame, path);
    }
  }
}

//------------------------------------------------------------------------------
RefractionTally StackChecker::Run()
{
  if (!this->SetUp())
  {
    this->Count(&RefractionTally::Failed, 0, "surface, list or eye refused", 0);
    return this->Tally;
  }
  if (this->Layers.empty())
  {
    this->CheckChains();
    return this->Tally;
  }
  if (!this->HasExpectedLinks())
  {
    // Right only if no ray passes all interfaces.
    for (int i = 0; i < 200; ++i)
    {
      const PatchHit first = this->ChoosePlace();
      const TracedPath path = this->Trace(first);
      const bool passes = glm::dot(first.Normal, first.Position - this->Eye) < 0.0 &&
        path.IsCertain && path.End == PathEnd::Passed;
      if (passes)
      {
        this->Count(&RefractionTally::Failed, 0, "the list begins elsewhere; interfaces",
          this->Solver.GetStack().GetLinks().size());
        break;
      }
    }
    return this->Tally;
  }
  for (int i = 0; i < PointsPerCase; ++i)
  {
    if (this->Random.Below(5) == 0)
    {
      this->CheckElsewhere(i);
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
void ReversedThreadsLoop(std::size_t count, const RangeBody& body)
{
  constexpr std::size_t ranges = 7;
  const auto run = [count, &body](std::size_t first)
  {
    for (std::size_t k = ranges; k-- > 0;)
    {
      if (k % 2 == first && count * k / ranges < count * (k + 1) / ranges)
      {
        body(count * k / ranges, count * (k + 1) / ranges);
      }
    }
  };
  std::thread other(run, 1);
  run(0);
  other.join();
}

//------------------------------------------------------------------------------
RefractionTally CheckStack(const StackCase& test)
{
  return StackChecker(test).Run();
}

} // namespace test
} // namespace meniscus
