// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GradedRayIntegrator.h"

#include <algorithm>

namespace meniscus::reference
{
namespace
{

/** Vertices of the edges of a cell. */
constexpr std::size_t Ends[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } };

Vector3 Sum(const Vector3& a, double factor, const Vector3& b)
{
  return { a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2] };
}

Vector3 Cross(const Vector3& a, const Vector3& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

}

//------------------------------------------------------------------------------
LightRay RungeKuttaStep(
  const LightRay& ray, double step, const std::function<Vector3(const Vector3&)>& force)
{
  struct Change
  {
    Vector3 Position;
    Vector3 Momentum;
    double OpticalPath;
  };
  const auto changeAt = [&](double time, const Change& change)
  {
    const Vector3 momentum = Sum(ray.Momentum, time, change.Momentum);
    return Change{ momentum, force(Sum(ray.Position, time, change.Position)),
      Dot(momentum, momentum) };
  };
  const Change k1 = changeAt(0.0, Change{});
  const Change k2 = changeAt(0.5 * step, k1);
  const Change k3 = changeAt(0.5 * step, k2);
  const Change k4 = changeAt(step, k3);
  LightRay next = ray;
  const std::array<const Change*, 4> changes = { &k1, &k2, &k3, &k4 };
  const std::array<double, 4> weights = { 1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0 };
  for (std::size_t i = 0; i < 4; ++i)
  {
    next.Position = Sum(next.Position, step * weights[i], changes[i]->Position);
    next.Momentum = Sum(next.Momentum, step * weights[i], changes[i]->Momentum);
    next.OpticalPath += step * weights[i] * changes[i]->OpticalPath;
  }
  return next;
}

//------------------------------------------------------------------------------
GradedRayIntegrator::GradedRayIntegrator(const std::vector<double>& points,
  const std::vector<std::int64_t>& cells, const std::vector<double>& squaredIndices,
  const std::vector<double>& edgeTerms)
{
  for (std::size_t c = 0; c < cells.size(); c += 4)
  {
    std::array<Vector3, 4> corners;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const auto first = static_cast<std::size_t>(3 * cells[c + i]);
      corners[i] = { points[first], points[first + 1], points[first + 2] };
    }
    Cell cell{};
    for (std::size_t i = 0; i < 4; ++i)
    {
      const Vector3& base = corners[(i + 1) % 4];
      const Vector3 normal =
        Cross(Sum(corners[(i + 2) % 4], -1.0, base), Sum(corners[(i + 3) % 4], -1.0, base));
      const double height = Dot(normal, Sum(corners[i], -1.0, base));
      cell.Gradients[i] = Sum(Vector3{}, 1.0 / height, normal);
      cell.Offsets[i] = -Dot(cell.Gradients[i], base);
      const double square = squaredIndices[static_cast<std::size_t>(cells[c + i])];
      cell.Force = Sum(cell.Force, 0.5 * square, cell.Gradients[i]);
      cell.SquaredIndex += square * cell.Offsets[i];
    }
    std::copy_n(
      edgeTerms.begin() + static_cast<std::ptrdiff_t>(c / 4 * 6), 6, cell.EdgeTerms.begin());
    this->Cells.push_back(cell);
  }
}

//------------------------------------------------------------------------------
double GradedRayIntegrator::WeightOf(const Cell& cell, const Vector3& position)
{
  double least = 1.0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    least = std::min(least, Dot(cell.Gradients[i], position) + cell.Offsets[i]);
  }
  return least;
}

//------------------------------------------------------------------------------
Vector3 GradedRayIntegrator::ForceAt(const Cell& cell, const Vector3& position)
{
  Vector3 force = cell.Force;
  for (std::size_t edge = 0; edge < 6; ++edge)
  {
    const std::size_t i = Ends[edge][0];
    const std::size_t k = Ends[edge][1];
    const double first = Dot(cell.Gradients[i], position) + cell.Offsets[i];
    const double second = Dot(cell.Gradients[k], position) + cell.Offsets[k];
    force = Sum(force, 0.5 * cell.EdgeTerms[edge] * first, cell.Gradients[k]);
    force = Sum(force, 0.5 * cell.EdgeTerms[edge] * second, cell.Gradients[i]);
  }
  return force;
}

//------------------------------------------------------------------------------
const GradedRayIntegrator::Cell* GradedRayIntegrator::Find(const Vector3& position) const
{
  const Cell* found = nullptr;
  double best = 0.0;
  for (const Cell& cell : this->Cells)
  {
    const double weight = WeightOf(cell, position);
    if (weight >= best)
    {
      best = weight;
      found = &cell;
    }
  }
  return found;
}

//------------------------------------------------------------------------------
double GradedRayIntegrator::SquaredIndexAt(const Vector3& position) const
{
  const Cell& nearest = *std::max_element(this->Cells.begin(), this->Cells.end(),
    [&](const Cell& a, const Cell& b) { return WeightOf(a, position) < WeightOf(b, position); });
  double square = nearest.SquaredIndex + 2.0 * Dot(nearest.Force, position);
  for (std::size_t edge = 0; edge < 6; ++edge)
  {
    const std::size_t i = Ends[edge][0];
    const std::size_t k = Ends[edge][1];
    square += nearest.EdgeTerms[edge] * (Dot(nearest.Gradients[i], position) + nearest.Offsets[i]) *
      (Dot(nearest.Gradients[k], position) + nearest.Offsets[k]);
  }
  return square;
}

//------------------------------------------------------------------------------
LightRay GradedRayIntegrator::Follow(LightRay ray, double step) const
{
  // A place a little ahead tells the cell that the ray goes on in.
  constexpr double ahead = 1.0e-10;
  for (;;)
  {
    const Cell* cell = this->Find(Sum(ray.Position, ahead, ray.Momentum));
    if (!cell)
    {
      return ray;
    }
    const auto force = [cell](const Vector3& position) { return ForceAt(*cell, position); };
    LightRay next = RungeKuttaStep(ray, step, force);
    while (WeightOf(*cell, next.Position) >= 0.0)
    {
      ray = next;
      next = RungeKuttaStep(ray, step, force);
    }
    double inside = 0.0;
    double outside = step;
    for (int i = 0; i < 50; ++i)
    {
      const double middle = 0.5 * (inside + outside);
      const LightRay there = RungeKuttaStep(ray, middle, force);
      (WeightOf(*cell, there.Position) >= 0.0 ? inside : outside) = middle;
    }
    ray = RungeKuttaStep(ray, std::max(outside, ahead), force);
  }
}

}
