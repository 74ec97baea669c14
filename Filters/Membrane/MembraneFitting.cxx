// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/MembraneExtraction.h"

#include "vtkImplicitFunction.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// Newton's method takes a few steps to a surface that the points are near to. Where the function is
// not the surface's, more would not lead to it either.
constexpr int MostSteps = 50;

// Newton's method has converged when a step is below the rounding of the point's coordinates.
constexpr double LastStep = 16.0 * std::numeric_limits<double>::epsilon();

class Fitting
{
public:
  Fitting(vtkImplicitFunction* function, MembraneArrays& arrays)
    : Function(function)
    , Arrays(arrays)
  {
  }

  std::size_t Run()
  {
    const std::size_t count = this->Arrays.Points.size() / 3;
    const double side = this->FindSide(count);
    std::vector<double> normals(3 * count, 0.0);
    const std::vector<bool> isUsed = this->FindUsed(count);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!isUsed[i])
      {
        continue;
      }
      glm::dvec3 point = this->GetPoint(i);
      if (!this->MoveOnto(point))
      {
        ++lost;
        continue;
      }
      const glm::dvec3 normal = side * glm::normalize(this->GetGradient(point));
      std::copy(&point.x, &point.x + 3, this->Arrays.Points.begin() + 3 * static_cast<long>(i));
      std::copy(&normal.x, &normal.x + 3, normals.begin() + 3 * static_cast<long>(i));
    }
    this->Arrays.Normals = std::move(normals);
    this->Arrays.NormalsRejected = false;
    return lost;
  }

private:
  glm::dvec3 GetPoint(std::size_t i) const
  {
    const double* p = this->Arrays.Points.data() + 3 * i;
    return { p[0], p[1], p[2] };
  }

  glm::dvec3 GetGradient(const glm::dvec3& at) const
  {
    double gradient[3] = { 0.0, 0.0, 0.0 };
    this->Function->FunctionGradient(&at.x, gradient);
    return { gradient[0], gradient[1], gradient[2] };
  }

  // True if all corners exist.
  bool IsWhole(std::size_t triangle, std::size_t count) const
  {
    const std::int64_t* ids = this->Arrays.Triangles.data() + 3 * triangle;
    return std::all_of(ids, ids + 3,
      [count](std::int64_t id) { return id >= 0 && id < static_cast<std::int64_t>(count); });
  }

  std::vector<bool> FindUsed(std::size_t count) const
  {
    std::vector<bool> isUsed(count, false);
    for (std::size_t i = 0; i < this->Arrays.Triangles.size() / 3; ++i)
    {
      for (std::size_t k = 0; k < 3 && this->IsWhole(i, count); ++k)
      {
        const auto id = static_cast<std::size_t>(this->Arrays.Triangles[3 * i + k]);
        const glm::dvec3 point = this->GetPoint(id);
        isUsed[id] = std::isfinite(point.x + point.y + point.z);
      }
    }
    return isUsed;
  }

  // +1 if most gradients point to the side of the normals, or of the facets' winding; otherwise -1.
  double FindSide(std::size_t count) const
  {
    double along = 0.0;
    for (std::size_t i = 0; i < this->Arrays.Triangles.size() / 3; ++i)
    {
      if (!this->IsWhole(i, count))
      {
        continue;
      }
      const auto id = [this, i](std::size_t k)
      { return static_cast<std::size_t>(this->Arrays.Triangles[3 * i + k]); };
      const glm::dvec3 corner = this->GetPoint(id(0));
      glm::dvec3 normal =
        glm::cross(this->GetPoint(id(1)) - corner, this->GetPoint(id(2)) - corner);
      if (!this->Arrays.Normals.empty())
      {
        const double* n = this->Arrays.Normals.data() + 3 * id(0);
        normal = glm::length(normal) * glm::dvec3(n[0], n[1], n[2]);
      }
      const glm::dvec3 gradient = this->GetGradient(corner);
      const double part = glm::dot(gradient, normal) / glm::length(gradient);
      along += std::isfinite(part) ? part : 0.0;
    }
    return along < 0.0 ? -1.0 : 1.0;
  }

  bool MoveOnto(glm::dvec3& point) const
  {
    double last = std::numeric_limits<double>::max();
    for (int i = 0; i < MostSteps; ++i)
    {
      const glm::dvec3 gradient = this->GetGradient(point);
      const glm::dvec3 step =
        this->Function->FunctionValue(&point.x) / glm::dot(gradient, gradient) * gradient;
      const double length = glm::length(step);
      if (!std::isfinite(length))
      {
        return false;
      }
      point -= step;
      // Rounding of the function itself may keep the steps above the rounding of the coordinates.
      // In that case the method has converged when the steps no longer shrink.
      const double reach = glm::length(point);
      if (length <= LastStep * reach || (length <= std::sqrt(LastStep) * reach && length >= last))
      {
        return true;
      }
      last = length;
    }
    return false;
  }

  vtkImplicitFunction* Function;
  MembraneArrays& Arrays;
};

}

//------------------------------------------------------------------------------
std::size_t FitToFunction(vtkImplicitFunction* function, MembraneArrays& arrays)
{
  return Fitting(function, arrays).Run();
}

}
