// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackCheck.h"

#include "StackChecker.h"

#include <thread>

namespace meniscus::test
{

namespace
{

constexpr int RimPointsPerCase = 8;

template <typename T>
bool HasSameBits(const T& a, const T& b)
{
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool IsSame(const VirtualVertex& a, const VirtualVertex& b)
{
  return HasSameBits(a.Position, b.Position) && HasSameBits(a.SightPoint, b.SightPoint) &&
    HasSameBits(a.Depth, b.Depth) && HasSameBits(a.Reflectance, b.Reflectance) &&
    a.Facet == b.Facet && a.State == b.State && a.Orientation == b.Orientation;
}

//------------------------------------------------------------------------------
reference::MembraneMesh PlaceMesh(
  reference::MembraneMesh mesh, double scale, const glm::dvec3& offset)
{
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    mesh.Points[i] = scale * mesh.Points[i] + offset[static_cast<int>(i % 3)];
  }
  return mesh;
}

//------------------------------------------------------------------------------
double RoundingOf(double scale, const glm::dvec3& offset, const glm::dvec3& eye)
{
  return 4.0 * std::numeric_limits<double>::epsilon() *
    (glm::length(offset) + scale * (glm::length(eye) + 4.0 * Side));
}

//------------------------------------------------------------------------------
std::vector<double> PointsAlong(const std::vector<glm::dvec3>& points, std::size_t count)
{
  std::vector<double> coordinates;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double at = static_cast<double>((points.size() - 1) * i) / count;
    const auto k = static_cast<std::size_t>(at);
    const double part = at - static_cast<double>(k);
    const glm::dvec3 p = (1.0 - part) * points[k] + part * points[k + 1];
    coordinates.insert(coordinates.end(), { p.x, p.y, p.z });
  }
  return coordinates;
}

//------------------------------------------------------------------------------
glm::dvec2 RandomPlace(StressRandom& random)
{
  const glm::dvec2 b(random.Uniform(), random.Uniform());
  return b.x + b.y > 1.0 ? 1.0 - b : b;
}

//------------------------------------------------------------------------------
double MeasureCondition(const glm::dvec2& b, const glm::dvec3& point, const glm::dvec3& axis,
  const std::function<std::optional<NearRay>(const glm::dvec2&)>& rayAt)
{
  constexpr double h = 1e-5;
  glm::dvec3 by[2];
  for (int k = 0; k < 2; ++k)
  {
    const double step = b[k] > 0.5 ? -h : h;
    glm::dvec2 beside = b;
    beside[k] += step;
    const std::optional<NearRay> ray = rayAt(beside);
    if (!ray)
    {
      return 0.0;
    }
    const double length = glm::dot(point - ray->Origin, axis) / glm::dot(ray->Direction, axis);
    by[k] = (ray->Origin + length * ray->Direction - point) / step;
  }
  const double longest = std::max(glm::dot(by[0], by[0]), glm::dot(by[1], by[1]));
  return std::fabs(glm::dot(axis, glm::cross(by[0], by[1]))) / longest;
}

//------------------------------------------------------------------------------
std::vector<Interface> StackChecker::MakeList() const
{
  std::vector<Interface> list;
  for (const StackLayer& layer : this->Test.Layers)
  {
    list.push_back({ this->Surfaces[layer.Mesh].Surface, layer.Media });
  }
  return list;
}

//------------------------------------------------------------------------------
// The same list with interfaces of equal indices at both ends and between.
std::vector<Interface> StackChecker::MakePaddedList()
{
  std::vector<Interface> list;
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
bool StackChecker::SetSolver(StackSolver& solver, const std::vector<Interface>& list, bool threads)
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
    const reference::MembraneMesh mesh = PlaceMesh(this->Test.Meshes[m], scale, this->Test.Offset);
    TracedSurface& surface = this->Surfaces[m];
    if (surface.Surface->SetMembrane(mesh.AsInput(), SurfaceParts::Crossings) !=
      MembraneStatus::Ready)
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
  this->Rounding = RoundingOf(scale, this->Test.Offset, this->Test.Eye);
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
PatchHit StackChecker::ChoosePlace()
{
  const auto facets = static_cast<int>(this->GetSurface(0).Tracer->GetNumberOfFacets());
  const auto facet = static_cast<std::int32_t>(this->Random.Below(facets));
  glm::dvec2 b = RandomPlace(this->Random);
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
// A place in the first surface that faces the eye, or none.
std::optional<PatchHit> StackChecker::ChooseFront()
{
  for (int k = 0; k < 20; ++k)
  {
    const PatchHit place = this->ChoosePlace();
    if (glm::dot(place.Normal, place.Position - this->Eye) < 0.0)
    {
      return place;
    }
  }
  return std::nullopt;
}

//------------------------------------------------------------------------------
// A place whose ray passes more interfaces than another one that is 0.1 to 0.0001 facets away, or
// none: next to a border or a critical angle.
std::optional<PatchHit> StackChecker::ChooseRim()
{
  for (int k = 0; k < 20; ++k)
  {
    const std::optional<PatchHit> place = this->ChooseFront();
    if (!place)
    {
      return std::nullopt;
    }
    PatchHit passed = *place;
    glm::dvec2 stopped = RandomPlace(this->Random);
    std::size_t most = this->Trace(passed).Points.size();
    const PatchHit other = this->Evaluate(0, passed.Facet, stopped);
    const std::size_t least = this->Trace(other).Points.size();
    if (least == most)
    {
      continue;
    }
    if (least > most)
    {
      stopped = passed.B;
      passed = other;
      most = least;
    }
    const double distance = std::pow(10.0, this->Random.Uniform(-4.0, -1.0));
    while (glm::length(passed.B - stopped) > distance)
    {
      const PatchHit middle = this->Evaluate(0, passed.Facet, 0.5 * (passed.B + stopped));
      if (this->Trace(middle).Points.size() >= most)
      {
        passed = middle;
      }
      else
      {
        stopped = middle.B;
      }
    }
    return passed;
  }
  return std::nullopt;
}

//------------------------------------------------------------------------------
// A point on a ray that was traced before: its image is known.
void StackChecker::CheckPlanted(int i, const PatchHit& first)
{
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
  const glm::dvec3 world = this->ToWorld(point);
  const glm::dvec3 rounded = world - this->Frame;
  this->Points.push_back(world);
  BothSearches<StackSolver, StackPath, StackVertex> found;
  if (!found.Run(this->Solver, world, this->Tally))
  {
    this->Tally.Count(&RefractionTally::Failed, i, "no answer", 0);
    return;
  }
  for (const StackPath& image : found.All)
  {
    this->CheckImage(i, rounded, image);
  }
  const double size = this->GetSurface(0).Tracer->GetSize(0);
  const auto isKnown = [&](const glm::dvec3& sight, std::size_t passed)
  {
    return std::any_of(found.All.begin(), found.All.end(),
      [&](const StackPath& image)
      {
        return image.Count == passed &&
          (passed == 0 ||
            glm::length(image.Points[0].Ray.Origin - sight) <
              SamePlace * size + 8.0 * this->Rounding);
      });
  };
  if (found.First.State == ImageState::Found)
  {
    const StackPath path = found.First.Passed > 0 ? found.Memory.Path : StackPath();
    this->CheckImage(i, rounded, path);
    if (found.IsDecided && !isKnown(found.First.SightPoint - this->Frame, path.Count))
    {
      this->Tally.Count(
        &RefractionTally::Wrong, i, "first image is not among all images", path.Count);
    }
  }
  if (planted)
  {
    ++this->Tally.Images;
    if (!isKnown(planted->Position, count))
    {
      this->Tally.Count(&RefractionTally::Missed, i,
        found.IsDecided ? "missed image behind interfaces" : "missed image, reported as undecided",
        count);
    }
    if (found.First.State != ImageState::Found)
    {
      this->Tally.Count(&RefractionTally::Missed, i, "no first image behind interfaces", count);
    }
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
  const std::vector<double> points = PointsAlong(this->Points, count);
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
        this->Tally.Count(&RefractionTally::Wrong, number,
          other == &padded ? "other bits with equal indices" : "other bits on two threads", i);
      }
    }
    if (i >= checked)
    {
      continue;
    }
    const glm::dvec3 world(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    const StackVertex vertex = this->Solver.SolvePoint(world, memory);
    if (vertex.State == ImageState::Found)
    {
      this->CheckImage(number, world - this->Frame, vertex.Passed > 0 ? memory.Path : StackPath());
    }
  }
}

//------------------------------------------------------------------------------
RefractionTally StackChecker::Run()
{
  if (!this->SetUp())
  {
    this->Tally.Count(&RefractionTally::Failed, 0, "surface, list or eye refused", 0);
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
        this->Tally.Count(&RefractionTally::Failed, 0, "the list begins elsewhere; interfaces",
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
    else if (const std::optional<PatchHit> place = this->ChooseFront())
    {
      this->CheckPlanted(i, *place);
    }
  }
  for (int i = PointsPerCase; i < PointsPerCase + RimPointsPerCase; ++i)
  {
    if (const std::optional<PatchHit> place = this->ChooseRim())
    {
      this->CheckPlanted(i, *place);
    }
  }
  this->CheckChains();
  return this->Tally;
}

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

} // namespace meniscus::test
