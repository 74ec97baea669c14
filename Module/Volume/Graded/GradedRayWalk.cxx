// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/GradedRayWalk.h"

#include "Volume/Graded/GradedCell.h"
#include "Volume/Graded/GradedPassage.h"
#include "Volume/Graded/GradedRayPath.h"
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

/** Result of a step that ends in the cell. */
constexpr int StaysInCell = 4;

/** Time, in units of that through the cell, in which a ray that is at a vertex stays there. */
constexpr double TimeAtVertex = 0x1p-40;

/**
 * Refracts a momentum at a face by Snell's law, or reflects it if it is totally reflected, which
 * returns false.
 * @param normal unit normal, outwards from the mesh; 0 for none, which refracts nothing.
 * @param squaredIndex of the medium beyond.
 * @param side 1 for a ray that goes along the normal, as one that leaves, -1 for one against it.
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

/**
 * True if a ray is in a cell for so short a time that its arc is no higher than positions are
 * rounded, and its way is a small share of the cell's size.
 * @param square of the momentum.
 */
bool IsShortPassage(const GradedPassage& way, const GradedCell& cell, double time, double square)
{
  const double height = 0.125 * time * time;
  constexpr double glideHeight = GradedPassage::GlideHeight;
  constexpr double longest = GradedPassage::LongestShare;
  return height * height * glm::dot(way.GetForce(), way.GetForce()) <= glideHeight * glideHeight &&
    time * time * square <= longest * longest * cell.SquaredSize;
}

/**
 * Refracts a momentum by Snell's law in a flat cell in which n^2 differs between the ray's places
 * on its two sides: a jump of the index. Returns false for a total reflection.
 */
bool PassFlatCell(const GradedCell& cell, const std::array<double, 4>& end, glm::dvec3& momentum)
{
  const glm::dvec3 normal = cell.GetWidestNormal();
  const double length = glm::length(normal);
  const double square = cell.GetSquaredIndex(end);
  const bool passes = !(length > 0.0) ||
    Refract(normal / length, square, std::copysign(1.0, glm::dot(momentum, normal)), momentum);
  momentum *= passes ? std::sqrt(square / glm::dot(momentum, momentum)) : 1.0;
  return passes;
}

}

//------------------------------------------------------------------------------
/** Adds the integrals along a straight piece of a length that ends at barycentric weights. */
void GradedRayWalk::Path::AddStraight(
  const GradedCell& cell, double length, const std::array<double, 4>& end)
{
  const double first = cell.GetSquaredIndex(this->Place.Weights);
  const double last = cell.GetSquaredIndex(end);
  if (cell.IsCurved)
  {
    // Gauss's rule of three points, the last of which is that in the middle.
    const double offset = 0.5 * std::sqrt(0.6);
    for (const double part : { 0.5 - offset, 0.5 + offset, 0.5 })
    {
      std::array<double, 4> weights;
      for (std::size_t i = 0; i < weights.size(); ++i)
      {
        weights[i] = (1.0 - part) * this->Place.Weights[i] + part * end[i];
      }
      const double share = (part == 0.5 ? 8.0 : 5.0) / 18.0 * length;
      const double square = cell.GetSquaredIndex(weights);
      this->Result->OpticalPath += share * std::sqrt(square);
      this->Deflection += share / square * cell.GetForce(weights);
    }
    return;
  }
  const double roots[2] = { std::sqrt(first), std::sqrt(last) };
  this->Result->OpticalPath +=
    length * (2.0 / 3.0) * (first + roots[0] * roots[1] + last) / (roots[0] + roots[1]);
  const double change = (last - first) / first;
  this->Deflection +=
    length / first * (change == 0.0 ? 1.0 : std::log1p(change) / change) * cell.Force;
}

//------------------------------------------------------------------------------
void GradedRayStatistics::Add(const GradedRayStatistics& other)
{
  this->Rays += other.Rays;
  this->Steps += other.Steps;
  this->LaneSteps += other.LaneSteps;
  this->Reflections += other.Reflections;
  this->Glides += other.Glides;
  this->FlatSteps += other.FlatSteps;
  this->InvertedSteps += other.InvertedSteps;
  this->Trapped += other.Trapped;
  this->TrappedInFolds += other.TrappedInFolds;
  this->Lost += other.Lost;
}

//------------------------------------------------------------------------------
GradedRayWalk::GradedRayWalk(const GradedMedium& medium)
  : Medium(medium)
  , Crossings(*medium.Mesh, *medium.Tree, medium.Cones)
{
  constexpr std::int64_t fewest = 65536; // see GradedMedium::MaximumNumberOfSteps
  this->MaximumNumberOfSteps = medium.MaximumNumberOfSteps > 0
    ? medium.MaximumNumberOfSteps
    : std::max(fewest, 4 * medium.Mesh->GetNumberOfActiveCells());
}

//------------------------------------------------------------------------------
GradedRayResult GradedRayWalk::Walk(
  const glm::dvec3& origin, const glm::dvec3& direction, GradedRayStatistics& statistics) const
{
  Path path;
  return this->WalkToEnd({ origin, direction }, statistics, path);
}

//------------------------------------------------------------------------------
GradedRayResult GradedRayWalk::Follow(
  const GradedRay& ray, GradedRayStatistics& statistics, GradedRayVisitor& visitor) const
{
  Path path;
  path.Visitor = &visitor;
  return this->WalkToEnd(ray, statistics, path);
}

//------------------------------------------------------------------------------
GradedRayResult GradedRayWalk::WalkToEnd(
  const GradedRay& ray, GradedRayStatistics& statistics, Path& path) const
{
  GradedRayResult result;
  if (this->Begin(ray, result, statistics, path))
  {
    while (this->Advance(path))
    {
    }
  }
  this->Finish(path);
  return result;
}

//------------------------------------------------------------------------------
/** Follows a ray to the first cell that it meets; returns false if it meets none. */
bool GradedRayWalk::Begin(
  const GradedRay& ray, GradedRayResult& result, GradedRayStatistics& statistics, Path& path) const
{
  path.Result = &result;
  path.Statistics = &statistics;
  path.Origin = result.Entry = result.Exit = ray.Origin;
  path.Direction = result.Direction = glm::normalize(ray.Direction);
  return (this->MayBeInside(ray.Origin) && this->BeginInside(path)) || this->EnterMesh(path);
}

//------------------------------------------------------------------------------
/** Counts a ray that has ended. */
void GradedRayWalk::Finish(Path& path) const
{
  GradedRayResult& result = *path.Result;
  GradedRayStatistics& statistics = *path.Statistics;
  if (this->Medium.IsStraight)
  {
    const glm::dvec3 along = result.Direction;
    result.Direction =
      glm::normalize(along + path.Deflection - glm::dot(path.Deflection, along) * along);
  }
  statistics.Rays += result.State != GradedRayState::Missed ? 1 : 0;
  statistics.Trapped += result.State == GradedRayState::Trapped ? 1 : 0;
  statistics.TrappedInFolds +=
    result.State == GradedRayState::Trapped && path.HasPassedFold ? 1 : 0;
  statistics.Lost += result.State == GradedRayState::Lost ? 1 : 0;
  statistics.Steps += path.Steps;
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
  path.Place.Entry = -1;
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
    const BoundaryCrossing crossing = this->FindEntry(path);
    if (crossing.Face < 0)
    {
      path.TellLeg(Infinity);
      result.State = path.IsEnded ? GradedRayState::Ended : result.State;
      return false;
    }
    if (crossing.Distance > std::max(path.TouchError, crossing.Error))
    {
      path.Touched.clear();
      path.TouchError = 0.0;
    }
    path.TouchError = std::max(path.TouchError, crossing.Error);
    path.Touched.push_back(crossing.Face);
    path.Entered.push_back(crossing.Face);
    this->PutIn(crossing, path);
    path.PassageBegin = this->PlaceOf(path);
    path.TellLeg(crossing.Distance);
    if (path.IsEnded)
    {
      result.State = GradedRayState::Ended;
      return false;
    }
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
    if (Refract(this->OutwardNormal(path.Cell, path.Place.Entry), inside, -1.0, path.Momentum))
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
BoundaryCrossing GradedRayWalk::FindEntry(Path& path) const
{
  if (!path.Faces)
  {
    if (path.Raster && !path.Raster->MayEnterAfter(path.Origin, path.Direction))
    {
      return {};
    }
    return this->Crossings.Find(path.Origin, path.Direction, false, path.Touched, path.Passed);
  }
  const EntryFaces& faces = *path.Faces;
  path.Faces = nullptr;
  return this->Crossings.FindAmong(path.Origin, path.Direction, faces, path.Number);
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
  path.Place.Entry = face.CellFace % 4;
  path.Place.Weights.fill(0.0);
  for (int i = 0, k = 0; i < 4; ++i)
  {
    if (i != path.Place.Entry)
    {
      path.Place.Weights[i] = weights[k++];
    }
  }
  path.Result->State = GradedRayState::Left;
  path.ForgetZigzag();
}

//------------------------------------------------------------------------------
/** Takes a ray to the next cell; returns false if it has left the mesh for good or is stopped. */
bool GradedRayWalk::Advance(Path& path) const
{
  GradedRayResult& result = *path.Result;
  const bool isOver = path.Steps >= this->MaximumNumberOfSteps;
  const int face = isOver ? -1 : this->CrossCell(path);
  if (path.IsEnded)
  {
    result.State = GradedRayState::Ended;
    return false;
  }
  if (face == StaysInCell)
  {
    return true;
  }
  if (face < 0)
  {
    result.State = isOver ? GradedRayState::Trapped : GradedRayState::Lost;
    result.Exit = this->PlaceOf(path);
    result.Direction = glm::normalize(path.Momentum);
    return false;
  }
  const std::int32_t link = this->CellOf(path).Links[face];
  if (link >= 0)
  {
    this->PassTo(link, face, path);
  }
  else if (this->LeaveMesh(face, path))
  {
    return this->EnterMesh(path);
  }
  this->WatchForZigzag(path);
  return true;
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
    weights[k + (k >= entry ? 1 : 0)] = path.Place.Weights[k + (k >= face ? 1 : 0)];
  }
  path.Place.Weights = weights;
  path.Cell = link / 4;
  path.Place.Entry = entry;
}

//------------------------------------------------------------------------------
/** Takes the ray out of the mesh. Returns false if it is reflected back into its cell. */
bool GradedRayWalk::LeaveMesh(int face, Path& path) const
{
  GradedRayResult& result = *path.Result;
  const double outside = this->Medium.OutsideIndex;
  path.IndexBefore = outside > 0.0 ? outside
    : this->Medium.IsStraight      ? std::sqrt(this->SquaredIndexAt(path))
                                   : glm::length(path.Momentum);
  if (outside > 0.0 && !this->Medium.IsStraight &&
    !Refract(this->OutwardNormal(path.Cell, face), outside * outside, 1.0, path.Momentum))
  {
    ++path.Statistics->Reflections;
    path.Place.Entry = face;
    return false;
  }
  if (path.IsFolded)
  {
    path.PassOverEntries();
  }
  path.Origin = result.Exit = this->PlaceOf(path);
  path.Direction = result.Direction = glm::normalize(path.Momentum);
  if (glm::length(path.Origin - path.PassageBegin) >
    std::max(path.TouchError, BoundaryCrossings::DistanceError))
  {
    path.Touched.clear();
    path.TouchError = 0.0;
  }
  return true;
}

//------------------------------------------------------------------------------
/**
 * Moves the ray to the face by which it leaves its cell, which is returned; -1 if there is none, or
 * if the ray's limit is reached before; StaysInCell if the way to the face needs another step.
 */
int GradedRayWalk::CrossCell(Path& path) const
{
  const GradedCell cell =
    MakeGradedCell(*this->Medium.Mesh, *this->Medium.SquaredIndices, this->Medium.Terms, path.Cell);
  ++path.Steps;
  path.Statistics->FlatSteps += cell.IsFlat ? 1 : 0;
  path.Statistics->InvertedSteps += cell.IsInverted ? 1 : 0;
  path.IsFolded |= cell.IsInverted && !path.IsSearching();
  path.HasPassedFold |= path.IsFolded;
  const double sign = cell.IsInverted ? -1.0 : 1.0;
  const bool isStraight = path.IsSearching() || this->Medium.IsStraight;
  const double square = glm::dot(path.Momentum, path.Momentum);
  GradedPassage way(cell, path.Place, sign * path.Momentum, !isStraight);
  const bool glides = path.Constraints > 0 && way.Hold(path.Constraints);
  const bool atRandom = path.Constraints > 0 && !glides;
  const double shortTime = atRandom ? TimeAtVertex * std::sqrt(cell.SquaredSize / square) : 0.0;
  double time = Infinity;
  int face = way.FindExit(path.Steps, atRandom, shortTime, time);
  const double passed = cell.IsFlat ? 0.0 : sign * time;
  path.IsShort = IsShortPassage(way, cell, passed, square);
  path.NoteConstraints();
  path.Statistics->Glides += glides ? 1 : 0;
  if (path.IsSearching())
  {
    face = passed < path.Limit ? face : -1;
    time = cell.IsFlat ? time : sign * std::min(passed, path.Limit);
    path.Limit = std::max(0.0, path.Limit - passed);
  }
  if (!std::isfinite(time))
  {
    return -1;
  }
  way.MoveTo(time);
  const std::array<double, 4> end = way.GetWeights(face);
  const double opticalPath = path.Result->OpticalPath;
  if (this->Medium.IsStraight && !path.IsSearching())
  {
    path.AddStraight(cell, passed, end);
  }
  else if (!isStraight && cell.IsFlat)
  {
    if (!PassFlatCell(cell, end, path.Momentum) && path.Place.Entry >= 0)
    {
      ++path.Statistics->Reflections;
      return path.Place.Entry;
    }
  }
  else if (!isStraight)
  {
    path.Result->OpticalPath += sign * way.IntegrateSquare(square);
    const glm::dvec3 momentum = sign * way.GetMomentum();
    // |p| = n holds along the way but for rounding, which must not add up.
    path.Momentum = std::sqrt(cell.GetSquaredIndex(end) / glm::dot(momentum, momentum)) * momentum;
  }
  if (path.Visitor && !path.IsSearching() && !cell.IsFlat)
  {
    path.IsEnded = !this->TellArc(way, time, end, opticalPath, path);
  }
  path.Place.Weights = end;
  if (face < 0 && !path.IsSearching())
  {
    path.Place.Entry = -1;
    return StaysInCell;
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
  GradedCell cell;
  ReadField(*this->Medium.Mesh, *this->Medium.SquaredIndices, this->Medium.Terms, path.Cell, cell);
  return cell.GetSquaredIndex(path.Place.Weights);
}

//------------------------------------------------------------------------------
glm::dvec3 GradedRayWalk::PlaceOf(const Path& path) const
{
  return this->PlaceIn(path.Cell, path.Place.Weights);
}

//------------------------------------------------------------------------------
glm::dvec3 GradedRayWalk::PlaceIn(std::int64_t cell, const std::array<double, 4>& weights) const
{
  const auto& vertices = this->Medium.Mesh->GetCells()[static_cast<std::size_t>(cell)].Vertices;
  glm::dvec3 sum(0.0);
  for (int i = 0; i < 4; ++i)
  {
    sum += weights[i] * this->Medium.Mesh->GetPosition(vertices[i]);
  }
  return sum;
}

//------------------------------------------------------------------------------
/**
 * Tells the visitor of the way in a cell. Returns false if the ray is to end.
 * @param opticalPath of the ray up to the beginning of the way.
 */
bool GradedRayWalk::TellArc(GradedPassage& way, double time, const std::array<double, 4>& end,
  double opticalPath, const Path& path) const
{
  GradedArc arc(way, time);
  arc.Cell = path.Cell;
  arc.BeginWeights = path.Place.Weights;
  arc.EndWeights = end;
  arc.BeginPath = opticalPath;
  arc.EndPath = path.Result->OpticalPath;
  arc.Begin = this->PlaceOf(path);
  arc.End = this->PlaceIn(path.Cell, end);
  return path.Visitor->VisitArc(arc);
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
