// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HeightField.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace meniscus::reference
{
namespace
{

struct Fermat
{
  const HeightField& Field;
  const glm::dvec3& Eye;
  const glm::dvec3& Point;

  // Derivatives of the optical path by x and z.
  std::array<double, 2> operator()(double x, double z) const
  {
    double dx = 0.0;
    double dz = 0.0;
    this->Field.GetSlopes(x, z, dx, dz);
    const glm::dvec3 s(x, this->Field.GetHeight(x, z), z);
    const glm::dvec3 v = this->Field.Exterior * glm::normalize(s - this->Eye) -
      this->Field.Interior * glm::normalize(this->Point - s);
    return { v.x + dx * v.y, v.z + dz * v.y };
  }

  // Newton's method with finite differences; returns false if it does not converge within `reach`
  // of its start.
  bool Solve(double& x, double& z, double reach) const
  {
    const double x0 = x;
    const double z0 = z;
    const double h = 1e-5 * this->Field.Side;
    for (int i = 0; i < 60; ++i)
    {
      const auto f = (*this)(x, z);
      const auto fx = (*this)(x + h, z);
      const auto bx = (*this)(x - h, z);
      const auto fz = (*this)(x, z + h);
      const auto bz = (*this)(x, z - h);
      const double a = (fx[0] - bx[0]) / (2 * h);
      const double b = (fz[0] - bz[0]) / (2 * h);
      const double c = (fx[1] - bx[1]) / (2 * h);
      const double d = (fz[1] - bz[1]) / (2 * h);
      const double det = a * d - b * c;
      const double mx = (-f[0] * d + f[1] * b) / det;
      const double mz = (-f[1] * a + f[0] * c) / det;
      if (!(std::hypot(mx, mz) < 1e3 * this->Field.Side))
      {
        return false;
      }
      x += mx;
      z += mz;
      if (std::hypot(x - x0, z - z0) > reach)
      {
        return false;
      }
      if (std::hypot(mx, mz) < 1e-12 * this->Field.Side)
      {
        return true;
      }
    }
    return false;
  }
};

}

//------------------------------------------------------------------------------
double HeightField::GetHeight(double x, double z) const
{
  return this->Amplitude *
    (this->Shape == Shape::Waves ? std::sin(this->K * x) * std::sin(this->K * z)
                                 : std::exp(-this->K * this->K * (x * x + z * z)));
}

//------------------------------------------------------------------------------
void HeightField::GetSlopes(double x, double z, double& dx, double& dz) const
{
  if (this->Shape == Shape::Waves)
  {
    dx = this->Amplitude * this->K * std::cos(this->K * x) * std::sin(this->K * z);
    dz = this->Amplitude * this->K * std::sin(this->K * x) * std::cos(this->K * z);
    return;
  }
  const double factor = -2.0 * this->K * this->K * this->GetHeight(x, z);
  dx = factor * x;
  dz = factor * z;
}

//------------------------------------------------------------------------------
glm::dvec3 HeightField::GetNormal(double x, double z) const
{
  double dx = 0.0;
  double dz = 0.0;
  this->GetSlopes(x, z, dx, dz);
  return glm::normalize(glm::dvec3(-dx, 1.0, -dz));
}

//------------------------------------------------------------------------------
MembraneMesh HeightField::MakeMesh(int cells) const
{
  MembraneMesh mesh = MakeSquare(this->Side, cells, 0.0);
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    const double x = mesh.Points[i];
    const double z = mesh.Points[i + 2];
    mesh.Points[i + 1] = this->GetHeight(x, z);
    const glm::dvec3 normal = this->GetNormal(x, z);
    std::copy(&normal.x, &normal.x + 3, mesh.Normals.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return mesh;
}

//------------------------------------------------------------------------------
std::vector<glm::dvec3> HeightField::FindSightPoints(
  const glm::dvec3& eye, const glm::dvec3& point, int grid) const
{
  const Fermat fermat{ *this, eye, point };
  // One more node on each side: a cell's search uses its neighbours' nodes.
  const int nodes = grid + 3;
  const double step = this->Side / grid;
  const auto at = [this, step](int i) { return -0.5 * this->Side + step * (i - 1); };
  std::vector<std::array<double, 2>> values(static_cast<std::size_t>(nodes) * nodes);
  for (int j = 0; j < nodes; ++j)
  {
    for (int i = 0; i < nodes; ++i)
    {
      values[static_cast<std::size_t>(j) * nodes + i] = fermat(at(i), at(j));
    }
  }
  std::vector<glm::dvec3> found;
  for (int j = 1; j <= grid; ++j)
  {
    for (int i = 1; i <= grid; ++i)
    {
      bool both = true;
      for (std::size_t c = 0; c < 2; ++c)
      {
        double low = 1e300;
        double high = -1e300;
        for (int node = 0; node < 16; ++node)
        {
          const double v =
            values[static_cast<std::size_t>(j - 1 + node / 4) * nodes + i - 1 + node % 4][c];
          low = std::min(low, v);
          high = std::max(high, v);
        }
        both = both && low <= 0.0 && high >= 0.0;
      }
      double x = at(i) + 0.5 * step;
      double z = at(j) + 0.5 * step;
      if (!both || !fermat.Solve(x, z, 4.0 * step) ||
        std::max(std::fabs(x), std::fabs(z)) > 0.5 * this->Side)
      {
        continue;
      }
      const glm::dvec3 s(x, this->GetHeight(x, z), z);
      const glm::dvec3 normal = this->GetNormal(x, z);
      const bool known = std::any_of(found.begin(), found.end(),
        [&s, step](const glm::dvec3& other) { return glm::length(other - s) < 1e-6 * step; });
      const double height = glm::dot(point - s, normal);
      if (!known && glm::dot(s - eye, normal) < 0.0 &&
        (this->Mirrors ? height > 0.0 : height < 0.0))
      {
        found.push_back(s);
      }
    }
  }
  return found;
}

//------------------------------------------------------------------------------
glm::dvec3 HeightField::Intersect(
  const glm::dvec3& eye, const glm::dvec3& direction, double distance) const
{
  for (int i = 0; i < 40; ++i)
  {
    const glm::dvec3 s = eye + direction * distance;
    double dx = 0.0;
    double dz = 0.0;
    this->GetSlopes(s.x, s.z, dx, dz);
    distance -=
      (s.y - this->GetHeight(s.x, s.z)) / (direction.y - dx * direction.x - dz * direction.z);
  }
  return eye + direction * distance;
}

//------------------------------------------------------------------------------
std::optional<glm::dvec3> HeightField::Refract(
  const glm::dvec3& eye, const glm::dvec3& onSurface, double length) const
{
  const glm::dvec3 sight = glm::normalize(onSurface - eye);
  const glm::dvec3 normal = this->GetNormal(onSurface.x, onSurface.z);
  if (this->Mirrors)
  {
    return onSurface + length * (sight - 2.0 * glm::dot(sight, normal) * normal);
  }
  const glm::dvec3 tangent =
    (sight - normal * glm::dot(sight, normal)) * (this->Exterior / this->Interior);
  const double squared = 1.0 - glm::dot(tangent, tangent);
  if (squared < 0.0)
  {
    return {};
  }
  return onSurface + length * (tangent - normal * std::sqrt(squared));
}

}
