// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GradedPathCheck.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace meniscus::reference
{
namespace
{

using Real = long double;
using Vector = std::array<Real, 3>;

/**
 * Rounding of a place in units of the radius: positions of at most 1 in size, and places of at most
 * 4 before the mesh, are sums of products in double precision, of 16 roundings of 2^-53 at most 4.
 */
constexpr Real PlaceError = 0x1p-47L;
/**
 * Error of a direction of a step. The series of a step may end at terms of 2^-46 of the way; in the
 * direction, which is its derivative, a term of the seventh order counts seven times.
 */
constexpr Real DirectionError = 0x1p-43L;
/** Rounding of positions in a mesh: a ray that glides may be off by as much. */
constexpr Real GlideError = 0x1p-28L;

Vector Extend(const Vector3& v)
{
  return { v[0], v[1], v[2] };
}

Vector Sum(const Vector& a, Real factor, const Vector& b)
{
  return { a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2] };
}

Real Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Real Length(const Vector& a)
{
  return std::sqrt(Dot(a, a));
}

Real Distance(const Vector& a, const Vector& b)
{
  return Length(Sum(a, -1.0L, b));
}

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Vector Unit(const Vector& a)
{
  const Real length = Length(a);
  return length > 0.0L ? Sum(Vector{}, 1.0L / length, a) : Vector{};
}

constexpr std::size_t Ends[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } };

/** Solution of s'' = a s with s = 0 and s' = 1 at 0. */
Real SineOf(Real a, Real t)
{
  const Real square = a * t * t;
  if (std::abs(square) < 1.0e-4L)
  {
    return t * (1.0L + square / 6.0L * (1.0L + square / 20.0L * (1.0L + square / 42.0L)));
  }
  const Real rate = std::sqrt(std::abs(a));
  return (a > 0.0L ? std::sinh(rate * t) : std::sin(rate * t)) / rate;
}

/** Eigenvectors and eigenvalues of a symmetric matrix, by Jacobi's rotations. */
void FindAxes(std::array<Vector, 3> matrix, std::array<Vector, 3>& axes, Vector& values)
{
  axes = { Vector{ 1, 0, 0 }, Vector{ 0, 1, 0 }, Vector{ 0, 0, 1 } };
  constexpr int sweeps = 12;
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    for (const auto& [p, q] : { std::pair<int, int>(0, 1), { 0, 2 }, { 1, 2 } })
    {
      if (matrix[p][q] == 0.0L)
      {
        continue;
      }
      const Real angle = 0.5L * std::atan2(2.0L * matrix[p][q], matrix[q][q] - matrix[p][p]);
      const Real c = std::cos(angle);
      const Real s = std::sin(angle);
      for (auto* rows : { &matrix, &axes })
      {
        const Vector first = (*rows)[p];
        const Vector second = (*rows)[q];
        (*rows)[p] = Sum(Sum(Vector{}, c, first), -s, second);
        (*rows)[q] = Sum(Sum(Vector{}, s, first), c, second);
      }
      for (Vector& row : matrix)
      {
        const Real first = row[p];
        const Real second = row[q];
        row[p] = c * first - s * second;
        row[q] = s * first + c * second;
      }
    }
  }
  values = { matrix[0][0], matrix[1][1], matrix[2][2] };
}

}

/** A solution in a cell. */
struct GradedPathCheck::Flow
{
  Flow(const Cell& cell, const Vector& place, const Vector& momentum, const Vector& force)
    : Place(place)
  {
    std::array<Vector, 3> matrix{};
    for (std::size_t edge = 0; edge < 6; ++edge)
    {
      const Vector& a = cell.Gradients[Ends[edge][0]];
      const Vector& b = cell.Gradients[Ends[edge][1]];
      for (std::size_t i = 0; i < 3; ++i)
      {
        const Real factor = 0.5L * cell.Terms[edge];
        matrix[i] = Sum(Sum(matrix[i], factor * a[i], b), factor * b[i], a);
      }
    }
    FindAxes(matrix, this->Axes, this->Rates);
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->Momentum[i] = Dot(this->Axes[i], momentum);
      this->Force[i] = Dot(this->Axes[i], force);
    }
  }

  Vector PlaceAt(Real t) const
  {
    Vector sum = this->Place;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Real half = SineOf(this->Rates[i], 0.5L * t);
      sum = Sum(sum,
        this->Momentum[i] * SineOf(this->Rates[i], t) + 2.0L * this->Force[i] * half * half,
        this->Axes[i]);
    }
    return sum;
  }
  Vector MomentumAt(Real t) const
  {
    Vector sum{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Real half = SineOf(this->Rates[i], 0.5L * t);
      sum = Sum(sum,
        this->Momentum[i] * (1.0L + 2.0L * this->Rates[i] * half * half) +
          this->Force[i] * SineOf(this->Rates[i], t),
        this->Axes[i]);
    }
    return sum;
  }
  /** Integral of n^2, by Gauss's rule of three points on each of some parts. */
  Real OpticalPathTo(Real t) const
  {
    constexpr int parts = 32;
    const Real step = t / parts;
    const Real offset = 0.5L * std::sqrt(0.6L);
    Real sum = 0.0L;
    for (int part = 0; part < parts; ++part)
    {
      for (int point = -1; point <= 1; ++point)
      {
        const Vector p = this->MomentumAt(step * (part + 0.5L + point * offset));
        sum += step * (point == 0 ? 8.0L : 5.0L) / 18.0L * Dot(p, p);
      }
    }
    return sum;
  }
  /** Time at which the ray is nearest to a place, by Newton's method from a straight way. */
  Real TimeAt(const Vector& place, Real opticalPath) const
  {
    const Vector momentum = this->MomentumAt(0.0L);
    Real t = Dot(Sum(place, -1.0L, this->Place), momentum) / Dot(momentum, momentum);
    const Real square = Dot(momentum, momentum);
    const Real longest = std::max(4.0L * Distance(place, this->Place) / std::sqrt(square),
      2.0L * std::abs(opticalPath) / square);
    Real best = 0.0L;
    Real least = Distance(place, this->Place);
    // The first guesses cover ways that turn back, forwards and, in inverted cells, backwards.
    constexpr int guesses = 16;
    for (int guess = -guesses; guess <= guesses; ++guess)
    {
      t = (guess == 0 ? t : longest * guess / guesses);
      for (int step = 0; step < 12; ++step)
      {
        const Vector p = this->MomentumAt(t);
        t += Dot(Sum(place, -1.0L, this->PlaceAt(t)), p) / Dot(p, p);
      }
      const Real distance = Distance(place, this->PlaceAt(t));
      if (distance < least)
      {
        least = distance;
        best = t;
      }
    }
    return best;
  }

  Vector Place;
  std::array<Vector, 3> Axes;
  Vector Rates;
  Vector Momentum;
  Vector Force;
};

//------------------------------------------------------------------------------
GradedPathCheck::GradedPathCheck(GradedField field)
  : Field(std::move(field))
  , LastError(PlaceError)
  , CellsOfPoints(this->Field.Points.size())
{
  for (std::size_t c = 0; c < this->Field.Cells.size(); ++c)
  {
    this->Cells.push_back(this->MakeCell(c));
    for (const std::int64_t point : this->Field.Cells[c])
    {
      this->CellsOfPoints[static_cast<std::size_t>(point)].push_back(static_cast<std::int64_t>(c));
    }
  }
}

//------------------------------------------------------------------------------
GradedPathCheck::Cell GradedPathCheck::MakeCell(std::size_t number) const
{
  const auto& vertices = this->Field.Cells[number];
  std::array<Vector, 4> corners;
  for (std::size_t i = 0; i < 4; ++i)
  {
    corners[i] = Extend(this->Field.Points[static_cast<std::size_t>(vertices[i])]);
  }
  Cell cell{};
  for (std::size_t edge = 0; edge < 6; ++edge)
  {
    cell.Terms[edge] = this->Field.EdgeTerms[number][edge];
  }
  for (const auto& [a, b] : Ends)
  {
    cell.Size = std::max(cell.Size, Distance(corners[a], corners[b]));
  }
  Real widest = 0.0L;
  Real longest = 0.0L;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Vector& base = corners[(i + 1) % 4];
    const Vector normal =
      Cross(Sum(corners[(i + 2) % 4], -1.0L, base), Sum(corners[(i + 3) % 4], -1.0L, base));
    const Real volume = Dot(normal, Sum(corners[i], -1.0L, base));
    longest = std::max(longest, Distance(corners[i], base));
    cell.Slenderness = cell.Size * cell.Size * cell.Size / std::abs(volume);
    if (Length(normal) > widest)
    {
      widest = Length(normal);
      cell.Normal = Unit(normal);
    }
    // The limit of GradedCell.h: a smaller volume may be the rounding error of a flat cell.
    cell.IsFlat = cell.IsFlat || std::abs(volume) <= 0x1p-49L * longest * longest * longest;
    cell.Gradients[i] = Sum(Vector{}, 1.0L / volume, normal);
    cell.Steepness[i] = Length(cell.Gradients[i]);
    cell.Offsets[i] = -Dot(cell.Gradients[i], base);
    const Real square = this->Field.SquaredIndices[static_cast<std::size_t>(vertices[i])];
    cell.Force = Sum(cell.Force, 0.5L * square, cell.Gradients[i]);
    cell.Square += square * cell.Offsets[i];
  }
  return cell;
}

//------------------------------------------------------------------------------
std::array<long double, 4> GradedPathCheck::WeightsAt(const Cell& cell, const Vector& place) const
{
  std::array<Real, 4> weights;
  for (std::size_t i = 0; i < 4; ++i)
  {
    weights[i] = Dot(cell.Gradients[i], place) + cell.Offsets[i];
  }
  return weights;
}

//------------------------------------------------------------------------------
GradedPathCheck::Vector GradedPathCheck::ForceAt(const Cell& cell, const Vector& place) const
{
  const auto w = this->WeightsAt(cell, place);
  Vector force = cell.Force;
  for (std::size_t edge = 0; edge < 6; ++edge)
  {
    const std::size_t i = Ends[edge][0];
    const std::size_t k = Ends[edge][1];
    force = Sum(force, 0.5L * cell.Terms[edge] * w[i], cell.Gradients[k]);
    force = Sum(force, 0.5L * cell.Terms[edge] * w[k], cell.Gradients[i]);
  }
  return force;
}

//------------------------------------------------------------------------------
long double GradedPathCheck::SquareAt(const Cell& cell, const Vector& place) const
{
  const auto w = this->WeightsAt(cell, place);
  Real square = cell.Square + 2.0L * Dot(cell.Force, place);
  for (std::size_t edge = 0; edge < 6; ++edge)
  {
    square += cell.Terms[edge] * w[Ends[edge][0]] * w[Ends[edge][1]];
  }
  return square;
}

//------------------------------------------------------------------------------
bool GradedPathCheck::Contains(const Cell& cell, const Vector& place, Real tolerance) const
{
  const auto weights = this->WeightsAt(cell, place);
  for (std::size_t i = 0; i < 4; ++i)
  {
    if (weights[i] < -tolerance * cell.Steepness[i])
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/** Cells that share a vertex with cells. */
std::vector<std::int64_t> GradedPathCheck::CellsAround(const std::vector<std::int64_t>& cells) const
{
  std::vector<std::int64_t> around;
  for (const std::int64_t cell : cells)
  {
    for (const std::int64_t point : this->Field.Cells[static_cast<std::size_t>(cell)])
    {
      const auto& more = this->CellsOfPoints[static_cast<std::size_t>(point)];
      around.insert(around.end(), more.begin(), more.end());
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

//------------------------------------------------------------------------------
void GradedPathCheck::Begin(const PlaceOnRay& ray)
{
  this->Last = ray;
  this->HasPassedFold = false;
  this->Near.clear();
}

//------------------------------------------------------------------------------
GradedPathCheck::Vector GradedPathCheck::NormalOf(std::int64_t face) const
{
  const auto& vertices = this->Field.Boundary[static_cast<std::size_t>(face)];
  std::array<Vector, 3> corners;
  for (std::size_t i = 0; i < 3; ++i)
  {
    corners[i] = Extend(this->Field.Points[static_cast<std::size_t>(vertices[i])]);
  }
  return Unit(Cross(Sum(corners[1], -1.0L, corners[0]), Sum(corners[2], -1.0L, corners[0])));
}

//------------------------------------------------------------------------------
/** Entries of the straight ray from the last place up to the first certain one, near ones first. */
std::vector<GradedPathCheck::Crossing> GradedPathCheck::FindCrossings() const
{
  const Vector origin = Extend(this->Last.Position);
  const Vector direction = Extend(this->Last.Direction);
  std::vector<Crossing> crossings;
  for (std::size_t f = 0; f < this->Field.Boundary.size(); ++f)
  {
    const auto& vertices = this->Field.Boundary[f];
    std::array<Vector, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
    {
      corners[i] =
        Sum(Extend(this->Field.Points[static_cast<std::size_t>(vertices[i])]), -1.0L, origin);
    }
    const Vector normal =
      Cross(Sum(corners[1], -1.0L, corners[0]), Sum(corners[2], -1.0L, corners[0]));
    const Real fall = Dot(direction, normal);
    Real least = 1.0L;
    Real distance = 0.0L;
    const Real size = Length(corners[0]) + Length(corners[1]) + Length(corners[2]);
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Vector& a = corners[(i + 1) % 3];
      const Vector& b = corners[(i + 2) % 3];
      // Distance of the ray from the edge, in the direction across both.
      const Vector across = Cross(direction, Sum(b, -1.0L, a));
      const Real length = Length(across);
      const Real inside = -Dot(direction, Cross(a, b)) / (length > 0.0L ? length : 1.0L);
      least = std::min(least, inside);
    }
    const Real tolerance = PlaceError * (1.0L + size);
    distance = fall != 0.0L ? Dot(corners[0], normal) / fall : 0.0L;
    // The place is a mean of the corners by quotients of triple products of the direction and two
    // corners, which are at most 2 from the ray.
    const Real longest = std::max({ Distance(corners[0], corners[1]),
      Distance(corners[1], corners[2]), Distance(corners[2], corners[0]) });
    const Real error = PlaceError * (1.0L + 4.0L * longest / -fall);
    // A ray that leaves the mesh at a vertex may enter again by a face that it grazes there, whose
    // crossing may be behind it by its error.
    if (!(fall < 0.0L) || least < -tolerance || distance < -std::max(tolerance, error))
    {
      continue;
    }
    // A face that is seen edge-on, and a place on the face, are no certain crossings.
    const bool isCertain =
      !this->HasPassedFold && least > tolerance && distance > tolerance * Length(normal) / -fall;
    crossings.push_back({ distance, error, static_cast<std::int64_t>(f), isCertain });
  }
  std::sort(crossings.begin(), crossings.end(),
    [](const Crossing& a, const Crossing& b) { return a.Distance < b.Distance; });
  const auto first =
    std::find_if(crossings.begin(), crossings.end(), [](const Crossing& c) { return c.IsCertain; });
  if (first != crossings.end())
  {
    const Real last = first->Distance + first->Error;
    crossings.erase(std::remove_if(crossings.begin(), crossings.end(),
                      [last](const Crossing& c) { return c.Distance - c.Error > last; }),
      crossings.end());
  }
  return crossings;
}

//------------------------------------------------------------------------------
bool GradedPathCheck::MeetsMesh() const
{
  const auto crossings = this->FindCrossings();
  return std::any_of(
    crossings.begin(), crossings.end(), [](const Crossing& c) { return c.IsCertain; });
}

//------------------------------------------------------------------------------
/** True if a direction is that of a momentum refracted or reflected at a plane. */
bool GradedPathCheck::IsRefracted(const Vector& momentum, const Vector& normal,
  const Vector& direction, Real square, Real side, Real tolerance) const
{
  const Real across = Dot(momentum, normal);
  const Vector along = Sum(momentum, -across, normal);
  const Real rest = square - Dot(along, along);
  // At grazing exit the angle is a root of the rest, which is known to the tolerance.
  const Real root = std::sqrt(std::max(rest, 0.0L));
  const Vector refracted = Unit(Sum(along, side * root, normal));
  const Vector reflected = Unit(Sum(along, -across, normal));
  const Real reach =
    tolerance + (rest > tolerance ? tolerance / root : std::sqrt(2.0L * tolerance));
  return (rest > -tolerance && Distance(refracted, direction) <= reach) ||
    (rest < tolerance && Distance(reflected, direction) <= reach);
}

//------------------------------------------------------------------------------
/** True if the ray ends in a direction, or is refracted or reflected into it at the boundary. */
bool GradedPathCheck::MatchesDirection(
  const Vector& momentum, const Vector& place, const PlaceOnRay& next, Real tolerance) const
{
  const Vector direction = Extend(next.Direction);
  if (Distance(Unit(momentum), direction) <= tolerance)
  {
    return true;
  }
  if (this->Field.OutsideIndex == 0.0)
  {
    return false;
  }
  const Real outside = this->Field.OutsideIndex;
  for (std::size_t f = 0; f < this->Field.Boundary.size(); ++f)
  {
    const Vector normal = this->NormalOf(static_cast<std::int64_t>(f));
    const Vector corner =
      Extend(this->Field.Points[static_cast<std::size_t>(this->Field.Boundary[f][0])]);
    if (std::abs(Dot(Sum(place, -1.0L, corner), normal)) <= PlaceError &&
      this->IsRefracted(momentum, normal, direction, outside * outside, 1.0L, tolerance))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/** @param knowsPath true if the optical path at the beginning is known. */
bool GradedPathCheck::GoThroughCell(std::int64_t number, const PlaceOnRay& from,
  const PlaceOnRay& next, bool glides, bool knowsPath) const
{
  const Cell& cell = this->Cells[static_cast<std::size_t>(number)];
  const Vector begin = Extend(from.Position);
  const Vector end = Extend(next.Position);
  const Real error = glides ? GlideError : this->LastError;
  if (cell.IsFlat || !this->Contains(cell, begin, error) || !this->Contains(cell, end, error))
  {
    return false;
  }
  const Real square = this->SquareAt(cell, begin);
  const Vector force = this->ForceAt(cell, begin);
  // n^2, and with it the momentum, is known as well as the place.
  const Vector endForce = this->ForceAt(cell, end);
  const Real change = 2.0L * std::max(Length(force), Length(endForce)) / square;
  const Real turn = (glides ? 0.0L : DirectionError) + error * change;
  if (glides)
  {
    // The momentum across the faces is dropped; a zigzag has a squared one of 16 heights times the
    // force, on both sides of the face.
    return Distance(Extend(from.Direction), Extend(next.Direction)) <=
      2.0L * std::sqrt(16.0L * GlideError * change) + change * Distance(begin, end);
  }
  const Real path = static_cast<Real>(next.OpticalPath) - from.OpticalPath;
  const Flow flow(cell, begin, Sum(Vector{}, std::sqrt(square), Extend(from.Direction)), force);
  const Real time = flow.TimeAt(end, knowsPath ? path : 0.0L);
  const Real length = std::abs(time) * std::sqrt(square);
  // The path under test has places of weights, each of which changes by a gradient times the way. A
  // gradient is a product of two edges, of at most the square S of the size, over the volume V.
  // The product is rounded by at most 2 sqrt(3) S; its quotient, its scalar product with the way
  // and the sum of two powers of the time by 7 S: 10.5 roundings of S / V times the way. The volume
  // is one for all, so that its error changes the time only. The place is the mean of the corners,
  // at most the size away, by three such weights and one that is 1 minus their sum: 6 times 10.5
  // roundings of 2^-53, less than 2^-47.
  const Real tolerance = error + turn * length + PlaceError * cell.Slenderness * length;
  if (Distance(flow.PlaceAt(time), end) > tolerance)
  {
    return false;
  }
  // Inside all the way. It may end there, if the next step goes on in the cell.
  constexpr int samples = 32;
  for (int i = 1; i < samples; ++i)
  {
    if (!this->Contains(cell, flow.PlaceAt(time * i / samples), 2.0L * tolerance))
    {
      return false;
    }
  }
  // The place and its time differ by the tolerance over the momentum; both ends count, and n^2 is
  // known as well as the place.
  if (knowsPath &&
    std::abs(flow.OpticalPathTo(time) - path) >
      (4.0L + change * length) * (1.0L + std::sqrt(square)) * tolerance)
  {
    return false;
  }
  return this->MatchesDirection(
    flow.MomentumAt(time), end, next, 4.0L * turn * (1.0L + change * length));
}

//------------------------------------------------------------------------------
/** True if the ray has stayed where it is: it passes an edge, a vertex or a flat cell. */
bool GradedPathCheck::StaysAt(const PlaceOnRay& next)
{
  const Vector end = Extend(next.Position);
  if (Distance(Extend(this->Last.Position), end) > 2.0L * this->LastError)
  {
    return false;
  }
  const Vector before = Extend(this->Last.Direction);
  const Vector after = Extend(next.Direction);
  if (Distance(before, after) <= DirectionError)
  {
    return true;
  }
  for (const std::int64_t number : this->CellsAround(this->CellsAround(this->Near)))
  {
    const Cell& cell = this->Cells[static_cast<std::size_t>(number)];
    const Vector corner = Extend(
      this->Field
        .Points[static_cast<std::size_t>(this->Field.Cells[static_cast<std::size_t>(number)][0])]);
    if (cell.IsFlat && std::abs(Dot(cell.Normal, Sum(end, -1.0L, corner))) <= 2.0L * PlaceError &&
      std::abs(Dot(cell.Normal, Cross(before, after))) <= 4.0L * DirectionError)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/** Takes a ray from a place outside into the mesh. */
PlaceOnRay GradedPathCheck::Enter(const PlaceOnRay& from, const Crossing& crossing) const
{
  PlaceOnRay entry = from;
  Vector place = Sum(Extend(from.Position), crossing.Distance, Extend(from.Direction));
  Vector direction = Extend(from.Direction);
  if (this->Field.OutsideIndex > 0.0)
  {
    const Vector normal = this->NormalOf(crossing.Face);
    const auto cell = this->Field.Boundary[static_cast<std::size_t>(crossing.Face)][3];
    const Real square = this->SquareAt(this->Cells[static_cast<std::size_t>(cell)], place);
    const Real across = this->Field.OutsideIndex * Dot(direction, normal);
    const Vector along = Sum(Sum(Vector{}, this->Field.OutsideIndex, direction), -across, normal);
    const Real rest = square - Dot(along, along);
    direction = Unit(Sum(along, rest > 0.0L ? -std::sqrt(rest) : -across, normal));
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    entry.Position[axis] = static_cast<double>(place[axis]);
    entry.Direction[axis] = static_cast<double>(direction[axis]);
  }
  return entry;
}

//------------------------------------------------------------------------------
bool GradedPathCheck::GoTo(const PlaceOnRay& next, bool glides)
{
  const auto isThrough = [&](std::int64_t cell)
  {
    if (!this->GoThroughCell(cell, this->Last, next, glides, true))
    {
      return false;
    }
    this->Last = next;
    this->Near = { cell };
    return true;
  };
  if (!this->Near.empty())
  {
    auto around = this->CellsAround(this->Near);
    if (std::any_of(around.begin(), around.end(), isThrough))
    {
      return true;
    }
    if (this->StaysAt(next))
    {
      this->Last = next;
      return true;
    }
    around = this->CellsAround(this->CellsAround(around));
    if (std::any_of(around.begin(), around.end(), isThrough))
    {
      return true;
    }
  }
  const PlaceOnRay before = this->Last;
  const std::vector<Crossing> crossings = this->FindCrossings();
  Real error = PlaceError;
  for (const Crossing& crossing : crossings)
  {
    error = std::max(error, crossing.Error);
  }
  for (const Crossing& crossing : crossings)
  {
    const auto cell = this->Field.Boundary[static_cast<std::size_t>(crossing.Face)][3];
    this->Near = { cell };
    this->Last = this->Enter(before, crossing);
    this->LastError = 2.0L * error;
    const bool isPath =
      this->GoThroughCell(cell, this->Last, next, glides, false) || this->StaysAt(next);
    this->LastError = PlaceError;
    if (isPath)
    {
      this->Last = next;
      return true;
    }
  }
  return false;
}

}
