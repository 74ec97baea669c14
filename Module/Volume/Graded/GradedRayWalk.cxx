// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/GradedRayWalk.h"

#include "Volume/Graded/GradedCell.h"
#include "Volume/Mesh/CellFaces.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meniscus
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/**
 * Largest squared momentum that a glide may drop, in units of GlideHeight times the force. A zigzag
 * of the height h has p^2 = 2 h |Force|; the force on the other side of the face may be 8 times as
 * large.
 */
constexpr double LargestDrop = 16.0;

/**
 * Longest step of a zigzag in units of the cell. Longer ones are so few that no ray has to glide.
 */
constexpr double LongestShare = 1.0 / 64.0;

/** Time, in units of that through the cell, in which a ray that is at a vertex stays there. */
constexpr double TimeAtVertex = 0x1p-40;

/**
 * Largest weight of a vertex opposite a face that the ray is taken to be on. A cell
 * whose height is 2^-20 of the radius has such a weight at GlideHeight.
 */
constexpr double LargestGlidingWeight = 0x1p-11;

/** Random number of a step, the same on every machine. */
std::uint64_t Scatter(std::int64_t step)
{
  std::uint64_t z = static_cast<std::uint64_t>(step) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  return z ^ (z >> 27);
}

/** Replaces two vectors by their components in one or two faces of a cell. */
void HoldFaces(const GradedCell& cell, int first, int second, glm::dvec3& a, glm::dvec3& b)
{
  if (second < 0)
  {
    const glm::dvec3 normal = glm::normalize(cell.Gradients[first]);
    a -= glm::dot(a, normal) * normal;
    b -= glm::dot(b, normal) * normal;
    return;
  }
  const glm::dvec3 edge = glm::normalize(glm::cross(cell.Gradients[first], cell.Gradients[second]));
  a = glm::dot(a, edge) * edge;
  b = glm::dot(b, edge) * edge;
}

/**
 * Refracts a momentum at a face by Snell's law, or reflects it if it is totally reflected, which
 * returns false.
 * @param normal outward normal of the mesh; 0 for none, which refracts nothing.
 * @param squaredIndex that of the medium beyond.
 * @param side 1 for a ray that leaves, -1 for one that enters.
 */
bool Refract(const glm::dvec3& normal, double squaredIndex, double side, glm::dvec3& momentum)
{
  const double across = glm::dot(momentum, normal);
  const glm::dvec3 along = momentum - across * normal;
  const double rest = squaredIndex - glm::dot(along, along);
  if (rest < 0.0 && glm::dot(normal, normal) > 0.0)
  {
    momentum = along - across * normal;
    return false;
  }
  momentum = along + side * std::sqrt(std::max(rest, 0.0)) * normal;
  return true;
}

}

/** State of a ray on its way. */
struct GradedRayWalk::Path
{
  GradedRayResult* Result = nullptr;
  GradedRayStatistics* Statistics = nullptr;
  /** Outside of the mesh: a place and the direction; unit length. */
  glm::dvec3 Origin{ 0.0 };
  glm::dvec3 Direction{ 0.0 };
  /** Inside: the cell, the face by which the ray has come (-1 for none), weights and momentum. */
  std::int64_t Cell = -1;
  int Entry = -1;
  std::array<double, 4> Weights{};
  glm::dvec3 Momentum{ 0.0 };
  std::int64_t Steps = 0;
  /** Integral of grad(n) / n along a straight ray. */
  glm::dvec3 Deflection{ 0.0 };
  /** Length of a straight way to a place that is looked for; infinite for a ray of light. */
  double Limit = Infinity;
  bool HasEntered = false;
  /** Place at which the ray entered last. */
  glm::dvec3 PassageBegin{ 0.0 };
  /** Index of refraction on the way to the next entry. */
  double IndexBefore = 1.0;
  /** Faces by which the ray has entered without moving on since. */
  std::vector<std::int32_t> Touched;
  /** True if the last step is short enough for a zigzag. */
  bool IsShort = false;
  /** Short steps in a row, and the cell that was remembered last in their course. */
  std::int64_t ShortSteps = 0;
  std::int64_t Anchor = -1;
  /** Number of faces that the ray must glide along in its next step: 0 to 2. */
  int Constraints = 0;
  /** Constraints that were tried last since the last step that was not short; 0 for none. */
  int LastConstraints = 0;

  bool IsSearching() const { return this->Limit < Infinity; }
  void ForgetZigzag()
  {
    this->ShortSteps = 0;
    this->Anchor = -1;
    this->LastConstraints = 0;
  }
  void AddStraight(double length, double first, double last, const glm::dvec3& force);
  void NoteConstraints()
  {
    this->LastConstraints = this->Constraints > 0 ? this->Constraints : this->LastConstraints;
    this->Constraints = 0;
  }
};

//------------------------------------------------------------------------------
/** Adds the integrals along a straight piece of a length, between two values of n^2. */
void GradedRayWalk::Path::AddStraight(
  double length, double first, double last, const glm::dvec3& force)
{
  const double roots[2] = { std::sqrt(first), std::sqrt(last) };
  this->Result->OpticalPath +=
    length * (2.0 / 3.0) * (first + roots[0] * roots[1] + last) / (roots[0] + roots[1]);
  const double change = (last - first) / first;
  this->Deflection += length / first * (change == 0.0 ? 1.0 : std::log1p(change) / change) * force;
}

/** Barycentric weights along the path in a cell. */
struct GradedRayWalk::Quadratics
{
  glm::dvec3 Momentum;
  glm::dvec3 Force;
  std::array<double, 4> Rates;
  std::array<double, 4> Curvatures;
  /** Faces that the ray stays on. */
  std::array<bool, 4> IsHeld{};

  void Set(const GradedCell& cell);
  bool Hold(const GradedCell& cell, const Path& path);
  int ChooseExit(
    const GradedCell& cell, const Path& path, bool atRandom, double shortTime, double& time) const;
  void MoveTo(double time, int face, std::array<double, 4>& weights) const;
};

//------------------------------------------------------------------------------
void GradedRayWalk::Quadratics::Set(const GradedCell& cell)
{
  for (int i = 0; i < 4; ++i)
  {
    this->Rates[i] = this->IsHeld[i] ? 0.0 : glm::dot(cell.Gradients[i], this->Momentum);
    this->Curvatures[i] = this->IsHeld[i] ? 0.0 : glm::dot(cell.Gradients[i], this->Force);
  }
}

//------------------------------------------------------------------------------
/**
 * Keeps the ray on the face or, for two constraints, on the edge of the cell at which it is and
 * which is nearest to its direction. Returns false if the ray does not zigzag there.
 */
bool GradedRayWalk::Quadratics::Hold(const GradedCell& cell, const Path& path)
{
  if (cell.IsFlat || path.Entry < 0)
  {
    return false;
  }
  double least = LargestDrop * GlideHeight * glm::length(cell.Force);
  int faces[2] = { -1, -1 };
  const glm::dvec3 momentum = this->Momentum;
  const glm::dvec3 force = this->Force;
  const auto attempt = [&](int first, int second)
  {
    glm::dvec3 heldMomentum = momentum;
    glm::dvec3 heldForce = force;
    HoldFaces(cell, first, second, heldMomentum, heldForce);
    const glm::dvec3 dropped = momentum - heldMomentum;
    if (glm::dot(dropped, dropped) <= least)
    {
      least = glm::dot(dropped, dropped);
      this->Momentum = heldMomentum;
      this->Force = heldForce;
      faces[0] = first;
      faces[1] = second;
    }
  };
  for (int i = 0; i < 4; ++i)
  {
    if (path.Weights[i] > LargestGlidingWeight)
    {
      continue;
    }
    if (path.Constraints == 1)
    {
      attempt(i, -1);
    }
    for (int k = i + 1; k < 4 && path.Constraints == 2; ++k)
    {
      if (path.Weights[k] <= LargestGlidingWeight)
      {
        attempt(i, k);
      }
    }
  }
  for (const int face : faces)
  {
    if (face >= 0)
    {
      this->IsHeld[face] = true;
    }
  }
  return faces[0] >= 0;
}

//------------------------------------------------------------------------------
/**
 * Face whose weight is the first to fall below 0, and the time; of equal ones, that of the lowest
 * rank. -1 if there is none.
 * @param atRandom choose among the faces that are reached within the short time: a ray that goes in
 *   circles about an edge or a vertex, without a zigzag, finds its way out so.
 */
int GradedRayWalk::Quadratics::ChooseExit(
  const GradedCell& cell, const Path& path, bool atRandom, double shortTime, double& time) const
{
  int face = -1;
  std::uint64_t best = 0;
  for (int i = 0; i < 4; ++i)
  {
    // A quadratic is above its tangent if it bends upwards, and has no zero before a place at which
    // it is positive if it bends downwards.
    const double bend = std::min(this->Curvatures[i], 0.0);
    if (face >= 0 && !atRandom &&
      path.Weights[i] + time * (this->Rates[i] + 0.5 * time * bend) > 0.0)
    {
      continue;
    }
    const double reached = TimeToZero(path.Weights[i], this->Rates[i], this->Curvatures[i]);
    const bool random = atRandom && reached <= shortTime;
    const std::uint64_t rank = random ? Scatter(4 * path.Steps + i) | 1 : 0;
    if (reached < Infinity && (face < 0 || rank > best || (best == 0 && reached < time)))
    {
      face = i;
      time = reached;
      best = rank;
    }
  }
  if (face < 0 && cell.IsFlat)
  {
    // The ray is in the cell's plane, or the cell has no area: any way out is as good.
    face = static_cast<int>(Scatter(path.Steps) % 4);
    time = 0.0;
  }
  return face;
}

//------------------------------------------------------------------------------
/** Moves weights to their values after a time; that of the face (-1 for none) becomes 0. */
void GradedRayWalk::Quadratics::MoveTo(double time, int face, std::array<double, 4>& weights) const
{
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    const double moved = weights[i] + time * (this->Rates[i] + 0.5 * time * this->Curvatures[i]);
    weights[i] = i == face ? 0.0 : std::max(moved, 0.0);
    sum += weights[i];
  }
  const double scale = 1.0 / sum;
  for (double& weight : weights)
  {
    weight *= scale;
  }
}

//------------------------------------------------------------------------------
void GradedRayStatistics::Add(const GradedRayStatistics& other)
{
  this->Rays += other.Rays;
  this->Steps += other.Steps;
  this->Reflections += other.Reflections;
  this->Glides += other.Glides;
  this->FlatSteps += other.FlatSteps;
  this->InvertedSteps += other.InvertedSteps;
  this->Trapped += other.Trapped;
  this->Lost += other.Lost;
}

//------------------------------------------------------------------------------
GradedRayWalk::GradedRayWalk(const GradedMedium& medium)
  : Medium(medium)
  , Crossings(*medium.Mesh, *medium.Tree)
{
  constexpr std::int64_t fewest = 65536;
  this->MaximumNumberOfSteps = medium.MaximumNumberOfSteps > 0
    ? medium.MaximumNumberOfSteps
    : std::max(fewest, 4 * medium.Mesh->GetNumberOfActiveCells());
}

//------------------------------------------------------------------------------
GradedRayResult GradedRayWalk::Walk(
  const glm::dvec3& origin, const glm::dvec3& direction, GradedRayStatistics& statistics) const
{
  GradedRayResult result;
  Path path;
  path.Result = &result;
  path.Statistics = &statistics;
  path.Origin = result.Entry = result.Exit = origin;
  path.Direction = result.Direction = glm::normalize(direction);
  if ((this->MayBeInside(origin) && this->BeginInside(path)) || this->EnterMesh(path))
  {
    do
    {
      this->CrossCells(path);
    } while (result.State == GradedRayState::Left && this->EnterMesh(path));
  }
  if (this->Medium.IsStraight)
  {
    const glm::dvec3 along = result.Direction;
    result.Direction =
      glm::normalize(along + path.Deflection - glm::dot(path.Deflection, along) * along);
  }
  statistics.Rays += result.State != GradedRayState::Missed ? 1 : 0;
  statistics.Trapped += result.State == GradedRayState::Trapped ? 1 : 0;
  statistics.Lost += result.State == GradedRayState::Lost ? 1 : 0;
  statistics.Steps += path.Steps;
  return result;
}

//------------------------------------------------------------------------------
bool GradedRayWalk::MayBeInside(const glm::dvec3& place) const
{
  const auto& nodes = this->Medium.Tree->GetNodes();
  return !nodes.empty() &&
    glm::all(glm::lessThanEqual(glm::abs(place - glm::dvec3(nodes.front().Center)),
      glm::dvec3(nodes.front().Half) + BoundaryCrossings::DistanceError));
}

//------------------------------------------------------------------------------
/**
 * Puts a ray that begins inside of the mesh into its cell, which is found by a straight way back
 * from the boundary. Returns false if the ray begins outside.
 */
bool GradedRayWalk::BeginInside(Path& path) const
{
  const BoundaryCrossing first =
    this->Crossings.Find(path.Origin, path.Direction, true, path.Touched);
  if (first.Face < 0 || first.Enters)
  {
    return false;
  }
  const glm::dvec3 forward = path.Direction;
  this->PutIn(first, path);
  path.Momentum = -forward;
  path.Limit = first.Distance;
  while (path.Limit > 0.0 && path.Steps < this->MaximumNumberOfSteps)
  {
    const int face = this->CrossCell(path);
    const std::int32_t link =
      face < 0 ? TetrahedralMesh::NoNeighbor : this->CellOf(path).Links[face];
    if (link < 0)
    {
      break;
    }
    this->PassTo(link, face, path);
  }
  // A ray that passes an edge of the mesh from outside leaves at once.
  const bool isInside = path.Limit <= BoundaryCrossings::DistanceError;
  path.Limit = Infinity;
  path.Entry = -1;
  path.Momentum = (this->Medium.IsStraight ? 1.0 : std::sqrt(this->SquaredIndexAt(path))) * forward;
  path.HasEntered = isInside;
  path.PassageBegin = path.Origin;
  path.Result->State = isInside ? GradedRayState::Left : GradedRayState::Missed;
  return isInside;
}

//------------------------------------------------------------------------------
/** Puts the ray into the next cell that it meets; returns false if it meets none. */
bool GradedRayWalk::EnterMesh(Path& path) const
{
  GradedRayResult& result = *path.Result;
  for (; path.Steps < this->MaximumNumberOfSteps; ++path.Steps)
  {
    const BoundaryCrossing crossing =
      this->Crossings.Find(path.Origin, path.Direction, false, path.Touched);
    if (crossing.Face < 0)
    {
      return false;
    }
    if (crossing.Distance > BoundaryCrossings::DistanceError)
    {
      path.Touched.clear();
    }
    path.Touched.push_back(crossing.Face);
    this->PutIn(crossing, path);
    path.PassageBegin = this->PlaceOf(path);
    if (!path.HasEntered)
    {
      result.Entry = path.PassageBegin;
    }
    else
    {
      result.OpticalPath += crossing.Distance * path.IndexBefore;
    }
    path.HasEntered = true;
    const double inside = this->SquaredIndexAt(path);
    const double outside = this->Medium.OutsideIndex;
    if (outside == 0.0 || this->Medium.IsStraight)
    {
      path.Momentum = (this->Medium.IsStraight ? 1.0 : std::sqrt(inside)) * path.Direction;
      return true;
    }
    path.Momentum = outside * path.Direction;
    path.IndexBefore = outside;
    if (Refract(this->OutwardNormal(path.Cell, path.Entry), inside, -1.0, path.Momentum))
    {
      return true;
    }
    ++path.Statistics->Reflections;
    path.Origin = result.Exit = path.PassageBegin;
    path.Direction = result.Direction = glm::normalize(path.Momentum);
    result.State = GradedRayState::Left;
  }
  result.State = GradedRayState::Trapped;
  return false;
}

//------------------------------------------------------------------------------
void GradedRayWalk::PutIn(const BoundaryCrossing& crossing, Path& path) const
{
  const BoundaryFace& face = this->Medium.Tree->GetFaces()[static_cast<std::size_t>(crossing.Face)];
  std::array<double, 3> weights = crossing.Weights;
  if (!face.IsAscending())
  {
    std::swap(weights[0], weights[1]);
  }
  path.Cell = face.CellFace / 4;
  path.Entry = face.CellFace % 4;
  path.Weights.fill(0.0);
  for (int i = 0, k = 0; i < 4; ++i)
  {
    if (i != path.Entry)
    {
      path.Weights[i] = weights[k++];
    }
  }
  path.Result->State = GradedRayState::Left;
  path.ForgetZigzag();
}

//------------------------------------------------------------------------------
/** Follows a ray from cell to cell until it leaves the mesh or is stopped. */
void GradedRayWalk::CrossCells(Path& path) const
{
  GradedRayResult& result = *path.Result;
  for (;;)
  {
    const bool isOver = path.Steps >= this->MaximumNumberOfSteps;
    const int face = isOver ? -1 : this->CrossCell(path);
    if (face < 0)
    {
      result.State = isOver ? GradedRayState::Trapped : GradedRayState::Lost;
      result.Exit = this->PlaceOf(path);
      result.Direction = glm::normalize(path.Momentum);
      return;
    }
    const std::int32_t link = this->CellOf(path).Links[face];
    if (link >= 0)
    {
      this->PassTo(link, face, path);
    }
    else if (this->LeaveMesh(face, path))
    {
      return;
    }
    this->WatchForZigzag(path);
  }
}

//------------------------------------------------------------------------------
/** Gives the weights of the vertices of a face to the cell on its other side. */
void GradedRayWalk::PassTo(std::int32_t link, int face, Path& path) const
{
  // The vertices of both cells ascend: those of the face have the same order in both.
  std::array<double, 4> weights{};
  const int entry = link % 4;
  for (int k = 0; k < 3; ++k)
  {
    weights[k + (k >= entry ? 1 : 0)] = path.Weights[k + (k >= face ? 1 : 0)];
  }
  path.Weights = weights;
  path.Cell = link / 4;
  path.Entry = entry;
}

//------------------------------------------------------------------------------
/** Takes the ray out of the mesh. Returns false if it is reflected back into its cell. */
bool GradedRayWalk::LeaveMesh(int face, Path& path) const
{
  GradedRayResult& result = *path.Result;
  const double outside = this->Medium.OutsideIndex;
  path.IndexBefore = outside > 0.0 ? outside : std::sqrt(this->SquaredIndexAt(path));
  if (outside > 0.0 && !this->Medium.IsStraight &&
    !Refract(this->OutwardNormal(path.Cell, face), outside * outside, 1.0, path.Momentum))
  {
    ++path.Statistics->Reflections;
    path.Entry = face;
    return false;
  }
  path.Origin = result.Exit = this->PlaceOf(path);
  path.Direction = result.Direction = glm::normalize(path.Momentum);
  if (glm::length(path.Origin - path.PassageBegin) > BoundaryCrossings::DistanceError)
  {
    path.Touched.clear();
  }
  return true;
}

//------------------------------------------------------------------------------
/**
 * Moves the ray to the face by which it leaves its cell, which is returned; -1 if there is none, or
 * if the ray's limit is reached before.
 */
int GradedRayWalk::CrossCell(Path& path) const
{
  const GradedCell cell =
    MakeGradedCell(*this->Medium.Mesh, *this->Medium.SquaredIndices, path.Cell);
  ++path.Steps;
  path.Statistics->FlatSteps += cell.IsFlat ? 1 : 0;
  path.Statistics->InvertedSteps += cell.IsInverted ? 1 : 0;
  const double sign = cell.IsInverted ? -1.0 : 1.0;
  const double square = cell.GetSquaredIndex(path.Weights);
  Quadratics way;
  way.Momentum = sign * path.Momentum;
  const bool isStraight = path.IsSearching() || this->Medium.IsStraight;
  way.Force = isStraight ? glm::dvec3(0.0) : cell.Force;
  const bool glides = path.Constraints > 0 && way.Hold(cell, path);
  way.Set(cell);
  if (path.Entry >= 0)
  {
    way.Rates[path.Entry] = std::max(way.Rates[path.Entry], 0.0);
  }
  double time = Infinity;
  const double shortTime = TimeAtVertex * std::sqrt(cell.SquaredSize / square);
  int face = way.ChooseExit(cell, path, path.Constraints > 0 && !glides, shortTime, time);
  const double passed = cell.IsFlat ? 0.0 : sign * time;
  path.IsShort = 0.125 * passed * passed * glm::length(cell.Force) <= GlideHeight &&
    passed * passed * square <= LongestShare * LongestShare * cell.SquaredSize;
  path.NoteConstraints();
  path.Statistics->Glides += glides ? 1 : 0;
  if (path.IsSearching())
  {
    face = passed < path.Limit ? face : -1;
    time = cell.IsFlat ? time : sign * std::min(passed, path.Limit);
    path.Limit = std::max(0.0, path.Limit - passed);
  }
  else if (face >= 0 && !isStraight)
  {
    const double drift = glm::dot(way.Momentum, way.Force);
    const double bend = glm::dot(way.Force, way.Force);
    path.Result->OpticalPath +=
      passed * (square + std::abs(passed) * (drift + std::abs(passed) * bend / 3.0));
  }
  if (std::isfinite(time))
  {
    way.MoveTo(time, face, path.Weights);
  }
  if (this->Medium.IsStraight && !path.IsSearching())
  {
    path.AddStraight(passed, square, cell.GetSquaredIndex(path.Weights), cell.Force);
  }
  if (!isStraight && face >= 0)
  {
    const glm::dvec3 momentum = sign * (way.Momentum + (cell.IsFlat ? 0.0 : time) * way.Force);
    // |p| = n holds along the parabola but for rounding, which must not add up.
    path.Momentum =
      std::sqrt(cell.GetSquaredIndex(path.Weights) / glm::dot(momentum, momentum)) * momentum;
  }
  return face;
}

//------------------------------------------------------------------------------
/** Notes a step for the search of zigzags, by Brent's algorithm for cycles. */
void GradedRayWalk::WatchForZigzag(Path& path) const
{
  if (!path.IsShort)
  {
    path.ForgetZigzag();
    return;
  }
  ++path.ShortSteps;
  if (path.Cell == path.Anchor)
  {
    // Along a face and along an edge in turn, until one leads on.
    path.Constraints = path.LastConstraints % 2 + 1;
    path.ShortSteps = 0;
    path.Anchor = -1;
  }
  else if ((path.ShortSteps & (path.ShortSteps - 1)) == 0)
  {
    path.Anchor = path.Cell;
  }
}

//------------------------------------------------------------------------------
const TetrahedralMesh::Cell& GradedRayWalk::CellOf(const Path& path) const
{
  return this->Medium.Mesh->GetCells()[static_cast<std::size_t>(path.Cell)];
}

//------------------------------------------------------------------------------
double GradedRayWalk::SquaredIndexAt(const Path& path) const
{
  const auto& vertices = this->CellOf(path).Vertices;
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    sum += path.Weights[i] * (*this->Medium.SquaredIndices)[static_cast<std::size_t>(vertices[i])];
  }
  return sum;
}

//------------------------------------------------------------------------------
glm::dvec3 GradedRayWalk::PlaceOf(const Path& path) const
{
  const auto& vertices = this->CellOf(path).Vertices;
  glm::dvec3 sum(0.0);
  for (int i = 0; i < 4; ++i)
  {
    sum += path.Weights[i] * this->Medium.Mesh->GetPosition(vertices[i]);
  }
  return sum;
}

//------------------------------------------------------------------------------
/** Normal of a face that points out of its cell by the mesh's orientation; 0 without area. */
glm::dvec3 GradedRayWalk::OutwardNormal(std::int64_t cell, int face) const
{
  const TetrahedralMesh& mesh = *this->Medium.Mesh;
  const auto vertices = mesh.GetFace(cell, face).Vertices;
  const glm::dvec3 first = mesh.GetPosition(vertices[0]);
  const glm::dvec3 area =
    glm::cross(mesh.GetPosition(vertices[1]) - first, mesh.GetPosition(vertices[2]) - first);
  const double length = glm::length(area);
  return length > 0.0 ? area / length : glm::dvec3(0.0);
}

}
