// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceRayIntegrator.h"

#include "RayCrossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meniscus::reference
{

namespace
{

// Gaps and clipped lengths below this fraction of the diagonal are rounding, not geometry:
// half-spaces are widened by 1e-13, and a face met at 1e-4 radian stretches that by 1e4.
constexpr double NegligibleLength = 1e-9;

// Emission behind this transmittance cannot change a result in double precision by 1e-15.
constexpr double DarkTransmittance = 1e-16;

// Optical depth of a piece up to which 4 points are exact to 1e-12, and of a piece for 8 points
// (error term of Gauss-Legendre with the derivatives of a quadratic times exp(-quadratic)).
constexpr double ThinDepth = 0.02;
constexpr double ThickDepth = 1.0;

// Gauss-Legendre on [-1, 1], positive half.
constexpr double Points4[2] = { 0.33998104358485626480, 0.86113631159405257522 };
constexpr double Weights4[2] = { 0.65214515486254614263, 0.34785484513745385737 };
constexpr double Points8[4] = { 0.18343464249564980494, 0.52553240991632898582,
  0.79666647741362673959, 0.96028985649753623168 };
constexpr double Weights8[4] = { 0.36268378337836198297, 0.31370664587788728734,
  0.22238103445337447054, 0.10122853629037625915 };

struct Accumulator
{
  std::array<double, 3> Color{ 0.0, 0.0, 0.0 };
  double Transmittance = 1.0;
};

// Adds the weighted emission at one abscissa, u in [0, 1] along a piece of the given length.
void AddSample(const OpticalSample& begin, const OpticalSample& end, double pieceLength, double u,
  double weight, Accumulator& sum)
{
  const double slope = end.Attenuation - begin.Attenuation;
  const double attenuation = begin.Attenuation + u * slope;
  const double depth = pieceLength * u * (begin.Attenuation + 0.5 * u * slope);
  const double emission = weight * pieceLength * attenuation * std::exp(-depth);
  for (int c = 0; c < 3; ++c)
  {
    sum.Color[c] += emission * (begin.Color[c] + u * (end.Color[c] - begin.Color[c]));
  }
}

// One piece in which attenuation and colour are linear, of optical depth at most ThickDepth.
template <int Half>
void AddPiece(const OpticalSample& begin, const OpticalSample& end, double pieceLength,
  const double (&points)[Half], const double (&weights)[Half], Accumulator& total)
{
  Accumulator sum;
  for (int i = 0; i < Half; ++i)
  {
    AddSample(begin, end, pieceLength, 0.5 * (1.0 - points[i]), 0.5 * weights[i], sum);
    AddSample(begin, end, pieceLength, 0.5 * (1.0 + points[i]), 0.5 * weights[i], sum);
  }
  const double depth = 0.5 * pieceLength * (begin.Attenuation + end.Attenuation);
  for (int c = 0; c < 3; ++c)
  {
    total.Color[c] += total.Transmittance * sum.Color[c];
  }
  total.Transmittance *= std::exp(-depth);
}

OpticalSample Mix(const OpticalSample& a, const OpticalSample& b, double u)
{
  OpticalSample sample;
  sample.Attenuation = a.Attenuation + u * (b.Attenuation - a.Attenuation);
  for (int c = 0; c < 3; ++c)
  {
    sample.Color[c] = a.Color[c] + u * (b.Color[c] - a.Color[c]);
  }
  return sample;
}

// Splits a piece of linear optics until Gauss-Legendre is exact to the target.
void AddLinearPiece(
  const OpticalSample& begin, const OpticalSample& end, double pieceLength, Accumulator& total)
{
  const double depth = 0.5 * pieceLength * (begin.Attenuation + end.Attenuation);
  if (depth <= 0.0)
  {
    return;
  }
  if (depth <= ThinDepth)
  {
    AddPiece(begin, end, pieceLength, Points4, Weights4, total);
    return;
  }
  const int parts = static_cast<int>(std::min(std::ceil(depth / ThickDepth), 1e6));
  for (int i = 0; i < parts && total.Transmittance > DarkTransmittance; ++i)
  {
    AddPiece(Mix(begin, end, static_cast<double>(i) / parts),
      Mix(begin, end, static_cast<double>(i + 1) / parts), pieceLength / parts, Points8, Weights8,
      total);
  }
}

// Splits one segment at the nodes of the transfer function inside its scalar range.
void AddSegment(const RaySegment& segment, double lengthPerUnit,
  const ReferenceTransferFunction& function, Accumulator& total)
{
  const double s0 = segment.ScalarBegin;
  const double s1 = segment.ScalarEnd;
  const double segmentLength = (segment.End - segment.Begin) * lengthPerUnit;
  const auto add = [&](double from, double to)
  {
    const double a = s0 + from * (s1 - s0);
    const double b = s0 + to * (s1 - s0);
    const std::size_t piece = function.PieceOf(0.5 * (a + b));
    AddLinearPiece(function.ValueInPiece(piece, a), function.ValueInPiece(piece, b),
      (to - from) * segmentLength, total);
  };

  const auto& nodes = function.GetNodes();
  const std::size_t first = function.PieceOf(std::min(s0, s1));
  const std::size_t last = function.PieceOf(std::max(s0, s1));
  double from = 0.0;
  for (std::size_t k = first; k < last && s0 != s1; ++k)
  {
    const std::size_t node = s0 < s1 ? k : last - 1 - (k - first);
    const double to = std::min(std::max((nodes[node].Scalar - s0) / (s1 - s0), from), 1.0);
    if (to > from)
    {
      add(from, to);
      from = to;
    }
  }
  if (from < 1.0)
  {
    add(from, 1.0);
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
ReferenceRayIntegrator::ReferenceRayIntegrator(
  std::vector<double> points, std::vector<std::int64_t> cells, std::vector<double> scalars)
  : Mesh(std::move(points), std::move(cells), std::move(scalars))
  , Tree(this->Mesh)
{
}

namespace
{

// The part of a segment from a position on.
RaySegment Tail(RaySegment segment, double from)
{
  if (from > segment.Begin)
  {
    const double u = (from - segment.Begin) / (segment.End - segment.Begin);
    segment.ScalarBegin += u * (segment.ScalarEnd - segment.ScalarBegin);
    segment.Begin = from;
  }
  return segment;
}

RaySegment Head(RaySegment segment, double to)
{
  if (to < segment.End)
  {
    const double u = (to - segment.Begin) / (segment.End - segment.Begin);
    segment.ScalarEnd = segment.ScalarBegin + u * (segment.ScalarEnd - segment.ScalarBegin);
    segment.End = to;
  }
  return segment;
}

} // anonymous namespace

//------------------------------------------------------------------------------
RayReport ReferenceRayIntegrator::FindSegments(
  const Ray& ray, std::vector<RaySegment>& segments) const
{
  return this->FindSegments(ray, nullptr, segments);
}

//------------------------------------------------------------------------------
bool ReferenceRayIntegrator::CanBeSeen(
  std::int64_t cell, const ReferenceTransferFunction& function) const
{
  const std::int64_t* ids = this->Mesh.GetCell(static_cast<std::size_t>(cell));
  double low = this->Mesh.GetScalar(ids[0]);
  double high = low;
  for (int i = 1; i < 4; ++i)
  {
    low = std::min(low, this->Mesh.GetScalar(ids[i]));
    high = std::max(high, this->Mesh.GetScalar(ids[i]));
  }
  const auto& nodes = function.GetNodes();
  for (std::size_t piece = function.PieceOf(low); piece <= function.PieceOf(high); ++piece)
  {
    const double from = piece > 0 ? std::max(low, nodes[piece - 1].Scalar) : low;
    const double to = piece < nodes.size() ? std::min(high, nodes[piece].Scalar) : high;
    if ((from < to || low == high) &&
      (function.ValueInPiece(piece, from).Attenuation > 0.0 ||
        function.ValueInPiece(piece, to).Attenuation > 0.0))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
RayReport ReferenceRayIntegrator::FindVisibleSegments(
  const Ray& ray, const CellTest& canBeSeen, std::vector<RaySegment>& segments) const
{
  const RayReport report = this->FindSegments(ray, nullptr, segments);
  // Without overlap, invisible segments are superfluous but harmless.
  return report.Ordered || report.Overlaps > 0 ? this->FindSegments(ray, &canBeSeen, segments)
                                               : report;
}

//------------------------------------------------------------------------------
RayReport ReferenceRayIntegrator::FindVisibleSegments(const Ray& ray,
  const ReferenceTransferFunction& function, std::vector<RaySegment>& segments) const
{
  return this->FindVisibleSegments(
    ray, [&](std::int64_t cell) { return this->CanBeSeen(cell, function); }, segments);
}

//------------------------------------------------------------------------------
RayReport ReferenceRayIntegrator::FindSegments(
  const Ray& ray, const CellTest* canBeSeen, std::vector<RaySegment>& segments) const
{
  static thread_local std::vector<Crossing> crossings;
  FindCrossings(this->Mesh, this->Tree, ray, canBeSeen, crossings);
  const double lengthPerUnit = MakeLength(ray.Direction);
  const double negligible = NegligibleLength * this->Mesh.GetDiagonal() / lengthPerUnit;
  RayReport report;
  report.Ordered = NeedsOrder(this->Mesh, crossings, negligible);
  if (report.Ordered)
  {
    FindOrderedCrossings(this->Mesh, this->Tree, ray, canBeSeen, crossings);
  }
  segments.clear();
  double cursor = -std::numeric_limits<double>::max();
  for (const Crossing& crossing : crossings)
  {
    const RaySegment& whole = crossing.Segment;
    if (crossing.Inverted)
    {
      // A path enters it at its far end, which is then the depth reached.
      cursor = std::max(cursor, whole.End);
      continue;
    }
    report.Gaps += !segments.empty() && whole.Begin > cursor + negligible;
    const double clipped = std::min(cursor, whole.End) - whole.Begin;
    report.Overlaps += clipped > negligible;
    const double begin = std::max({ cursor, whole.Begin, ray.Begin });
    const double end = std::min(whole.End, ray.End);
    cursor = std::max(cursor, whole.End);
    if (begin < end)
    {
      segments.push_back(Head(Tail(whole, begin), end));
    }
  }
  report.Cells = segments.size();
  return report;
}

//------------------------------------------------------------------------------
std::array<double, 4> ReferenceRayIntegrator::Integrate(const Ray& ray,
  const std::vector<RaySegment>& segments, const ReferenceTransferFunction& function)
{
  const double lengthPerUnit = MakeLength(ray.Direction);
  Accumulator total;
  for (const RaySegment& segment : segments)
  {
    if (total.Transmittance <= DarkTransmittance)
    {
      break;
    }
    AddSegment(segment, lengthPerUnit, function, total);
  }
  return { total.Color[0], total.Color[1], total.Color[2], 1.0 - total.Transmittance };
}

//------------------------------------------------------------------------------
std::array<double, 4> ReferenceRayIntegrator::Trace(
  const Ray& ray, const ReferenceTransferFunction& function) const
{
  std::vector<RaySegment> segments;
  this->FindVisibleSegments(ray, function, segments);
  return Integrate(ray, segments, function);
}

//------------------------------------------------------------------------------
std::vector<CoveredSpan> ReferenceRayIntegrator::CoveredSpans(const Ray& ray) const
{
  std::vector<RaySegment> segments;
  this->FindSegments(ray, segments);
  const double negligible = NegligibleLength * this->Mesh.GetDiagonal() / MakeLength(ray.Direction);
  std::vector<CoveredSpan> spans;
  for (const RaySegment& segment : segments)
  {
    if (spans.empty() || segment.Begin > spans.back().End + negligible)
    {
      spans.push_back(CoveredSpan{ segment.Begin, segment.End });
    }
    spans.back().End = segment.End;
  }
  return spans;
}

namespace
{

// Largest move of an end of a span; infinite if the numbers of spans differ.
double SpanChange(const std::vector<CoveredSpan>& a, const std::vector<CoveredSpan>& b)
{
  if (a.size() != b.size())
  {
    return std::numeric_limits<double>::infinity();
  }
  double change = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    change =
      std::max({ change, std::fabs(a[i].Begin - b[i].Begin), std::fabs(a[i].End - b[i].End) });
  }
  return change;
}

Ray Moved(const Ray& ray, const Vector3& by, double distance)
{
  Ray result = ray;
  for (int axis = 0; axis < 3; ++axis)
  {
    result.Origin[axis] += distance * by[axis];
  }
  return result;
}

double LargestDifference(const std::array<double, 4>& a, const std::array<double, 4>& b)
{
  double largest = 0.0;
  for (int c = 0; c < 4; ++c)
  {
    largest = std::max(largest, std::fabs(a[c] - b[c]));
  }
  return largest;
}

// Two unit vectors across the ray.
std::array<Vector3, 2> AcrossRay(const Vector3& direction)
{
  const double size = MakeLength(direction);
  const Vector3 w{ direction[0] / size, direction[1] / size, direction[2] / size };
  const int least = std::fabs(w[0]) < std::fabs(w[1]) ? (std::fabs(w[0]) < std::fabs(w[2]) ? 0 : 2)
                                                      : (std::fabs(w[1]) < std::fabs(w[2]) ? 1 : 2);
  Vector3 u{ -w[least] * w[0], -w[least] * w[1], -w[least] * w[2] };
  u[least] += 1.0;
  const double scale = 1.0 / MakeLength(u);
  u = { scale * u[0], scale * u[1], scale * u[2] };
  return { u,
    Vector3{ w[1] * u[2] - w[2] * u[1], w[2] * u[0] - w[0] * u[2], w[0] * u[1] - w[1] * u[0] } };
}

// Unit vectors across the ray in 8 directions.
std::array<Vector3, 8> DirectionsAcross(const Vector3& direction)
{
  const std::array<Vector3, 2> across = AcrossRay(direction);
  std::array<Vector3, 8> result;
  for (int i = 0; i < 8; ++i)
  {
    const double angle = i * 0.78539816339744830962;
    for (int axis = 0; axis < 3; ++axis)
    {
      result[i][axis] = std::cos(angle) * across[0][axis] + std::sin(angle) * across[1][axis];
    }
  }
  return result;
}

// Fraction of the distance at which a change is evaluated again.
constexpr double Fraction = 0.125;

// True if a change above the threshold does not shrink with the distance.
bool IsJump(double near, double far, double threshold)
{
  const bool proportional = near > 0.5 * Fraction * far && near < 2.0 * Fraction * far;
  return std::max(near, far) > threshold && !proportional;
}

} // anonymous namespace

//------------------------------------------------------------------------------
RayClass ReferenceRayIntegrator::Classify(
  const Ray& ray, double distance, const ReferenceTransferFunction& function) const
{
  // A face met at a slope below this moves a span's end in proportion; a jump at a silhouette edge
  // exceeds it and does not shrink with the distance.
  constexpr double steepestSlope = 20.0;
  // A smaller jump of the result cannot be the cause of a wrong pixel.
  constexpr double smallestJump = 1e-5;
  const double steep = steepestSlope * distance / MakeLength(ray.Direction);
  const std::vector<CoveredSpan> here = this->CoveredSpans(ray);
  std::vector<RaySegment> segments;
  const bool ordered = this->FindSegments(ray, segments).Ordered;
  this->FindVisibleSegments(ray, function, segments);
  const std::array<double, 4> result = Integrate(ray, segments, function);
  for (const Vector3& by : DirectionsAcross(ray.Direction))
  {
    const Ray farRay = Moved(ray, by, distance);
    const Ray nearRay = Moved(ray, by, Fraction * distance);
    if (IsJump(SpanChange(here, this->CoveredSpans(nearRay)),
          SpanChange(here, this->CoveredSpans(farRay)), steep))
    {
      return RayClass::Silhouette;
    }
    if (ordered &&
      IsJump(LargestDifference(result, this->Trace(nearRay, function)),
        LargestDifference(result, this->Trace(farRay, function)), smallestJump))
    {
      return RayClass::Silhouette;
    }
  }
  return here.empty() ? RayClass::Missed : RayClass::Covered;
}

//------------------------------------------------------------------------------
double ReferenceRayIntegrator::Sensitivity(
  const Ray& ray, double distance, const ReferenceTransferFunction& function) const
{
  const std::array<double, 4> result = this->Trace(ray, function);
  double largest = 0.0;
  for (const Vector3& by : DirectionsAcross(ray.Direction))
  {
    largest =
      std::max(largest, LargestDifference(result, this->Trace(Moved(ray, by, distance), function)));
  }
  return largest;
}

} // namespace meniscus::reference
