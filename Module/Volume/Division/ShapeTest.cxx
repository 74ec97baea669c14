// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Division/ShapeTest.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/**
 * Barycentric coordinates of the place that is drawn next to a position: its projection on a
 * triangle, or itself in a tetrahedron. Those of the middle if the corners span no area or volume.
 */
std::array<double, 4> ProjectedOn(
  const std::array<CellSample, 4>& corners, int count, const glm::dvec3& position)
{
  const glm::dvec3 u = corners[1].Position - corners[0].Position;
  const glm::dvec3 v = corners[2].Position - corners[0].Position;
  // For a triangle, the third direction is its normal.
  const glm::dvec3 w = count == 4 ? corners[3].Position - corners[0].Position : glm::cross(u, v);
  const glm::dmat3 span(u, v, w);
  const double share = 1.0 / count;
  std::array<double, 4> weights{ share, share, share, count == 4 ? share : 0.0 };
  if (glm::determinant(span) != 0.0)
  {
    const glm::dvec3 along = glm::inverse(span) * (position - corners[0].Position);
    const double last = count == 4 ? along.z : 0.0;
    weights = { 1.0 - along.x - along.y - last, along.x, along.y, last };
  }
  return weights;
}

}

//------------------------------------------------------------------------------
ShapeTest::ShapeTest(
  const PointFields& fields, const ShapeFunctionsMaker& functions, const DivisionMeasure& measure)
  : Sampler(fields, functions)
  , Measure(measure)
  , NumberOfFields(fields.GetNumberOfFields())
{
}

//------------------------------------------------------------------------------
double ShapeTest::MeasureEdge(
  std::int32_t cell, const glm::vec3& from, const glm::vec3& to, int parts)
{
  return this->MeasureEdge(
    cell, from, to, this->Sampler.Sample(cell, from), this->Sampler.Sample(cell, to), parts);
}

//------------------------------------------------------------------------------
double ShapeTest::MeasureEdge(std::int32_t cell, const glm::vec3& from, const glm::vec3& to,
  const CellSample& a, const CellSample& b, int parts)
{
  if (this->Sampler.IsLinear(cell, from, to))
  {
    return 0.0;
  }
  const glm::dvec3 chord = b.Position - a.Position;
  const double square = glm::dot(chord, chord);
  DrawnValues edge = this->ValuesOf(a, b, std::sqrt(square));
  bool hasGradients = !this->Measure.HasSurfaces;
  double most = 0.0;
  for (int i = 1; i < parts; ++i)
  {
    const double t = static_cast<double>(i) / parts;
    const CellSample sample =
      this->Sampler.Sample(cell, glm::mix(glm::dvec3(from), glm::dvec3(to), t));
    const glm::dvec3 offset = sample.Position - a.Position;
    // The place on the chord that is drawn next to the sample.
    const double along = square > 0.0 ? glm::clamp(glm::dot(offset, chord) / square, 0.0, 1.0) : t;
    CellSample drawn;
    drawn.Position = along * chord;
    for (std::size_t field = 0; field < this->NumberOfFields; ++field)
    {
      drawn.Values[field] = (1.0 - along) * a.Values[field] + along * b.Values[field];
    }
    const double distance = glm::length(offset - drawn.Position);
    double error = this->ErrorOf(sample, drawn, distance, edge);
    if (error > most && !hasGradients)
    {
      this->SetGradients(cell, from, to, edge);
      hasGradients = true;
      error = this->ErrorOf(sample, drawn, distance, edge);
    }
    most = std::max(most, error);
  }
  return most;
}

//------------------------------------------------------------------------------
auto ShapeTest::ValuesOf(const CellSample& a, const CellSample& b, double length) const
  -> DrawnValues
{
  DrawnValues values;
  for (std::size_t field = 0; field < this->NumberOfFields; ++field)
  {
    const auto ends = std::minmax(a.Values[field], b.Values[field]);
    DrawnValue& value = values[field];
    value.IsKnown = length > 0.0;
    value.Lowest = ends.first;
    value.Highest = ends.second;
    value.Slope = length > 0.0 ? (ends.second - ends.first) / length : 0.0;
    value.Length = length;
  }
  return values;
}

//------------------------------------------------------------------------------
/** The values as a piece draws them, with their gradients. */
auto ShapeTest::ValuesOf(const std::array<CellSample, 4>& corners) const -> DrawnValues
{
  const auto edge = [&corners](std::size_t i) { return corners[i].Position - corners[0].Position; };
  const glm::dmat3 span(edge(1), edge(2), edge(3));
  DrawnValues values;
  if (glm::determinant(span) == 0.0)
  {
    return values;
  }
  const glm::dmat3 toGradient = glm::inverse(glm::transpose(span));
  for (std::size_t field = 0; field < this->NumberOfFields; ++field)
  {
    const auto at = [&](std::size_t i) { return corners[i].Values[field]; };
    const auto ends = std::minmax({ at(0), at(1), at(2), at(3) });
    DrawnValue& value = values[field];
    value.IsKnown = true;
    value.Lowest = ends.first;
    value.Highest = ends.second;
    value.Gradient =
      glm::length(toGradient * glm::dvec3(at(1) - at(0), at(2) - at(0), at(3) - at(0)));
  }
  return values;
}

//------------------------------------------------------------------------------
/**
 * Sets the smallest gradients at the ends and in the middle of an edge. A surface is displaced by a
 * difference of the value divided by its gradient; along an edge that is nearly in the surface, the
 * slope is much smaller.
 */
void ShapeTest::SetGradients(
  std::int32_t cell, const glm::vec3& from, const glm::vec3& to, DrawnValues& values)
{
  // Share of a cell: a gradient that changes by its own size in the cell is off by half of this.
  constexpr double step = 1.0e-4;
  std::array<double, CellSample::MostFields> least;
  least.fill(std::numeric_limits<double>::infinity());
  for (const double share : { 0.0, 0.5, 1.0 })
  {
    const glm::dvec3 place = glm::mix(glm::dvec3(from), glm::dvec3(to), share);
    const CellSample here = this->Sampler.Sample(cell, place);
    std::array<CellSample, 4> around{ here, here, here, here };
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::dvec3 next = place;
      next[axis] += place[axis] > 0.5 ? -step : step;
      around[static_cast<std::size_t>(axis) + 1] = this->Sampler.Sample(cell, next);
    }
    const DrawnValues drawn = this->ValuesOf(around);
    for (std::size_t field = 0; field < this->NumberOfFields; ++field)
    {
      least[field] = std::min(least[field], drawn[field].Gradient);
    }
  }
  for (std::size_t field = 0; field < this->NumberOfFields; ++field)
  {
    values[field].Gradient = std::isfinite(least[field]) ? least[field] : 0.0;
  }
}

//------------------------------------------------------------------------------
double ShapeTest::MeasureMiddle(
  const CellPiece& piece, const int* corners, int count, const std::vector<CellSample>& points)
{
  std::array<CellSample, 4> samples;
  glm::dvec3 place(0.0);
  for (int i = 0; i < count; ++i)
  {
    const auto corner = static_cast<std::size_t>(corners[i]);
    samples[static_cast<std::size_t>(i)] = points[static_cast<std::size_t>(piece.Points[corner])];
    place += glm::dvec3(piece.Places[corner]) / static_cast<double>(count);
  }
  const CellSample sample = this->Sampler.Sample(piece.Cell, place);
  const std::array<double, 4> weights = ProjectedOn(samples, count, sample.Position);
  CellSample drawn;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    drawn.Position += weights[i] * samples[i].Position;
    for (std::size_t field = 0; field < this->NumberOfFields; ++field)
    {
      drawn.Values[field] += weights[i] * samples[i].Values[field];
    }
  }
  const DrawnValues inside =
    count == 4 && this->Measure.HasSurfaces ? this->ValuesOf(samples) : DrawnValues();
  return this->ErrorOf(sample, drawn, glm::length(sample.Position - drawn.Position), inside);
}

//------------------------------------------------------------------------------
/** Error of a value that is drawn as another one. */
double ShapeTest::ValueError(
  std::size_t field, double value, double drawn, const DrawnValue& edge) const
{
  const ErrorScale& scale = this->Measure.OfValues[field];
  const double difference = std::abs(value - drawn);
  double error = scale.Measure(value, drawn);
  double slope = edge.Slope;
  if (this->Measure.HasSurfaces && edge.IsKnown)
  {
    error = std::max(error, scale.Bound(edge.Lowest, edge.Highest, difference));
    // That of a parabola at one of the ends: an edge that a surface touches has hardly any slope.
    slope += edge.Length > 0.0 ? 4.0 * difference / edge.Length : 0.0;
    slope = std::max(slope, edge.Gradient);
  }
  return this->Measure.ValuesMayMove && slope > 0.0
    ? std::min(error, this->Measure.OfPlace * difference / slope)
    : error;
}

//------------------------------------------------------------------------------
/**
 * Differences that are not finite are no errors: no division would make them smaller.
 * @param edge the values that are drawn; without slopes if they are not known.
 */
double ShapeTest::ErrorOf(
  const CellSample& sample, const CellSample& drawn, double distance, const DrawnValues& edge) const
{
  const DivisionMeasure& measure = this->Measure;
  double most = distance > measure.PlaceRounding ? measure.OfPlace * distance : 0.0;
  for (std::size_t field = 0; field < this->NumberOfFields; ++field)
  {
    const double value = sample.Values[field];
    if (std::abs(value - drawn.Values[field]) > measure.ValueRounding[field])
    {
      most = std::max(most, this->ValueError(field, value, drawn.Values[field], edge[field]));
    }
  }
  return std::isfinite(most) ? most : 0.0;
}

}
