// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CellIntegrator.h"

#include <vtkBoundingBox.h>

namespace meniscus::test
{

namespace
{

const double Exactly[3] = { 0.0, 0.0, 0.0 };

}

CellIntegrator::CellIntegrator(vtkUnstructuredGrid* grid, vtkIdType cell)
  : Scalars(grid->GetPointData()->GetScalars())
{
  grid->GetCell(cell, this->Cell);
  this->Weights.resize(static_cast<std::size_t>(this->Cell->GetNumberOfPoints()));
  this->Start = glm::dvec3(this->Cell->GetCellType() == VTK_HEXAHEDRON ? 0.5 : 0.25);
  this->Cell->GetPoints()->ComputeBounds();
  vtkBoundingBox box(this->Cell->GetPoints()->GetBounds());
  box.Inflate(0.3 * box.GetMaxLength());
  box.GetBounds(this->Bounds);
}

glm::dvec2 CellIntegrator::Integrate(const WorldRay& ray)
{
  // The cells lie within 2 of the origin, and the ray is parametrised from its nearest point.
  const double middle = -glm::dot(ray.Origin, ray.Direction);
  constexpr int samples = 80;
  constexpr int fine = 16;
  constexpr double half = 2.0;
  constexpr double step = 2.0 * half / samples;
  // Next to a side the ray may leave the cell and come back between two samples.
  constexpr double near = 0.1;
  glm::dvec2 sum(0.0);
  double begin = 0.0;
  double last = middle - half;
  double before = this->DepthInside(ray, last);
  for (int i = 1; i <= samples; ++i)
  {
    const double end = middle - half + step * i;
    const double there = this->DepthInside(ray, end);
    const int parts = std::min(std::abs(before), std::abs(there)) < near ? fine : 1;
    for (int part = 1; part <= parts; ++part)
    {
      const double s = end - step * (parts - part) / parts;
      const double now = part == parts ? there : this->DepthInside(ray, s);
      if (before < 0.0 && now >= 0.0)
      {
        begin = this->FindEnd(ray, last, s);
      }
      else if (before >= 0.0 && now < 0.0)
      {
        sum += this->Sum(ray, begin, this->FindEnd(ray, s, last));
      }
      before = now;
      last = s;
    }
  }
  return sum;
}

glm::dvec3 CellIntegrator::Position(const glm::dvec3& place)
{
  this->Weigh(place);
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < this->Weights.size(); ++i)
  {
    const glm::dvec3 at = PointOf(this->Cell->GetPoints(), static_cast<vtkIdType>(i));
    sum += this->Weights[i] * glm::dvec3(at[0], at[1], at[2]);
  }
  return sum;
}

void CellIntegrator::Weigh(const glm::dvec3& place)
{
  const double at[3] = { place.x, place.y, place.z };
  this->Cell->InterpolateFunctions(at, this->Weights.data());
}

/** Finds the parametric coordinates of a point of the ray by Newton's method. */
bool CellIntegrator::Invert(const WorldRay& ray, double s)
{
  const glm::dvec3 target = ray.Origin + s * ray.Direction;
  glm::dvec3 place(this->Start);
  for (int i = 0; i < 60; ++i)
  {
    const glm::dvec3 miss = target - this->Position(place);
    constexpr double h = 1e-5;
    glm::dmat3 slope;
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::dvec3 step(0.0);
      step[axis] = h;
      slope[axis] = (this->Position(place + step) - this->Position(place - step)) / (2.0 * h);
    }
    glm::dvec3 move = glm::inverse(slope) * miss;
    const double length = glm::length(move);
    move *= length > 0.3 ? 0.3 / length : 1.0;
    place += move;
    if (!(length < 1e3))
    {
      return false;
    }
    if (length < 1e-12)
    {
      this->Place = place;
      return true;
    }
  }
  return false;
}

/** Smallest distance from a side in parametric coordinates; negative outside. */
double CellIntegrator::DepthInside(const WorldRay& ray, double s)
{
  const glm::dvec3 at = ray.Origin + s * ray.Direction;
  if (!vtkMath::PointIsWithinBounds(&at.x, this->Bounds, Exactly) || !this->Invert(ray, s))
  {
    return -1.0;
  }
  const glm::dvec3& p = this->Place;
  double depth = std::min({ p.x, p.y, p.z });
  switch (this->Cell->GetCellType())
  {
    case VTK_HEXAHEDRON:
    case VTK_QUADRATIC_HEXAHEDRON:
    case VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
    case VTK_LAGRANGE_HEXAHEDRON:
    case VTK_BEZIER_HEXAHEDRON:
    case VTK_PYRAMID:
    case VTK_QUADRATIC_PYRAMID:
      return std::min({ depth, 1.0 - p.x, 1.0 - p.y, 1.0 - p.z });
    case VTK_WEDGE:
    case VTK_QUADRATIC_WEDGE:
    case VTK_QUADRATIC_LINEAR_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
    case VTK_LAGRANGE_WEDGE:
    case VTK_BEZIER_WEDGE:
      return std::min({ depth, 1.0 - p.x - p.y, 1.0 - p.z });
    default:
      return std::min(depth, 1.0 - p.x - p.y - p.z);
  }
}

/** The end of the stretch between a place outside and one inside, from which Newton begins. */
double CellIntegrator::FindEnd(const WorldRay& ray, double outside, double inside)
{
  const glm::dvec3 start = this->Start;
  EXPECT_TRUE(this->Invert(ray, inside));
  this->Start = this->Place;
  for (int i = 0; i < 36; ++i)
  {
    const double middle = 0.5 * (outside + inside);
    (this->DepthInside(ray, middle) >= 0.0 ? inside : outside) = middle;
  }
  this->Start = start;
  return inside;
}

/** Gauss' rule of three points in panels. */
glm::dvec2 CellIntegrator::Sum(const WorldRay& ray, double begin, double end)
{
  constexpr int panels = 4;
  constexpr double nodes[3] = { -0.7745966692414834, 0.0, 0.7745966692414834 };
  constexpr double weights[3] = { 5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0 };
  const double width = (end - begin) / panels;
  double sum = 0.0;
  for (const auto& [panel, i] : Product(panels, 3))
  {
    EXPECT_TRUE(this->Invert(ray, begin + width * (panel + 0.5 + 0.5 * nodes[i])));
    this->Weigh(this->Place);
    double value = 0.0;
    for (std::size_t k = 0; k < this->Weights.size(); ++k)
    {
      value +=
        this->Weights[k] * this->Scalars->GetTuple1(this->Cell->GetPointId(static_cast<int>(k)));
    }
    sum += weights[i] * width * value;
  }
  return { sum, end - begin };
}

double IntegrateImage(vtkImageData* image, int n, const WorldRay& ray)
{
  std::vector<double> cuts;
  double begin = -1e30;
  double end = 1e30;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double o = ray.Origin[axis];
    const double d = ray.Direction[axis];
    begin = std::max(begin, std::min((-1.0 - o) / d, (1.0 - o) / d));
    end = std::min(end, std::max((-1.0 - o) / d, (1.0 - o) / d));
    for (int i = 0; i <= n; ++i)
    {
      cuts.push_back((-1.0 + 2.0 * i / n - o) / d);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  const glm::dvec3 corners[8] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 0, 0, 1 },
    { 1, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 } };
  const auto valueAt = [&](double s)
  {
    const glm::dvec3 at = 0.5 * n * (ray.Origin + s * ray.Direction + 1.0);
    const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(at)), 0, n - 1);
    const glm::dvec3 t = at - glm::dvec3(cell);
    double value = 0.0;
    for (const glm::dvec3& c : corners)
    {
      const glm::dvec3 w = c * t + (1.0 - c) * (1.0 - t);
      const glm::ivec3 p = cell + glm::ivec3(c);
      value += w.x * w.y * w.z *
        image->GetPointData()->GetScalars()->GetTuple1((p.z * (n + 1) + p.y) * (n + 1) + p.x);
    }
    return value;
  };
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
  {
    const double a = std::max(cuts[i], begin);
    const double b = std::min(cuts[i + 1], end);
    // Gauss' rule of two points is exact for cubics.
    const double offset = 0.5 * (b - a) / std::sqrt(3.0);
    sum += b > a
      ? 0.5 * (b - a) * (valueAt(0.5 * (a + b) - offset) + valueAt(0.5 * (a + b) + offset))
      : 0.0;
  }
  return sum;
}

}
