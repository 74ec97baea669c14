// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SmoothSurface.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>

namespace meniscus::reference
{
namespace
{

template <typename T>
void AddWave(HeightJet<T>& jet, const SmoothSurface::Wave& wave, const T& x, const T& z)
{
  const T phase = wave.kx * x + wave.kz * z + T(wave.phase);
  const T sine = wave.amplitude * Sine(phase);
  const T cosine = wave.amplitude * Cosine(phase);
  jet.f = jet.f + sine;
  jet.x = jet.x + wave.kx * cosine;
  jet.z = jet.z + wave.kz * cosine;
  jet.xx = jet.xx - (wave.kx * wave.kx) * sine;
  jet.xz = jet.xz - (wave.kx * wave.kz) * sine;
  jet.zz = jet.zz - (wave.kz * wave.kz) * sine;
}

template <typename T>
void AddHill(HeightJet<T>& jet, const SmoothSurface::Hill& hill, const T& x, const T& z)
{
  const T dx = x - T(hill.centreX);
  const T dz = z - T(hill.centreZ);
  const double s = hill.k * hill.k;
  const T f = hill.amplitude * Exponential((-s) * (Square(dx) + Square(dz)));
  jet.f = jet.f + f;
  jet.x = jet.x + (-2.0 * s) * (f * dx);
  jet.z = jet.z + (-2.0 * s) * (f * dz);
  jet.xx = jet.xx + (2.0 * s) * (f * ((2.0 * s) * Square(dx) - T(1.0)));
  jet.xz = jet.xz + (4.0 * s * s) * (f * (dx * dz));
  jet.zz = jet.zz + (2.0 * s) * (f * ((2.0 * s) * Square(dz) - T(1.0)));
}

template <typename T>
void AddSphere(HeightJet<T>& jet, double radius, const T& x, const T& z)
{
  const double sign = radius > 0.0 ? 1.0 : -1.0;
  const T w = Root(T(radius * radius) - Square(x) - Square(z));
  const T inverse = T(1.0) / w;
  const T cube = inverse * Square(inverse);
  jet.f = jet.f + sign * (T(sign * radius) - w);
  jet.x = jet.x + sign * (x * inverse);
  jet.z = jet.z + sign * (z * inverse);
  jet.xx = jet.xx + sign * (inverse + Square(x) * cube);
  jet.xz = jet.xz + sign * ((x * z) * cube);
  jet.zz = jet.zz + sign * (inverse + Square(z) * cube);
}

template <typename T>
HeightJet<T> Sum(const SmoothSurface& surface, const T& x, const T& z)
{
  HeightJet<T> jet;
  for (const SmoothSurface::Wave& wave : surface.waves)
  {
    AddWave(jet, wave, x, z);
  }
  for (const SmoothSurface::Hill& hill : surface.hills)
  {
    AddHill(jet, hill, x, z);
  }
  if (surface.sphereRadius != 0.0)
  {
    AddSphere(jet, surface.sphereRadius, x, z);
  }
  return jet;
}

}

//------------------------------------------------------------------------------
HeightJet<double> SmoothSurface::At(double x, double z) const
{
  return Sum(*this, x, z);
}

//------------------------------------------------------------------------------
HeightJet<Interval> SmoothSurface::Over(const Interval& x, const Interval& z) const
{
  return Sum(*this, x, z);
}

//------------------------------------------------------------------------------
glm::dvec3 SmoothSurface::GetNormal(double x, double z) const
{
  const HeightJet<double> jet = this->At(x, z);
  return glm::normalize(glm::dvec3(-jet.x, 1.0, -jet.z));
}

//------------------------------------------------------------------------------
glm::dvec3 SmoothSurface::Intersect(
  const glm::dvec3& eye, const glm::dvec3& direction, double distance) const
{
  for (int i = 0; i < 40; ++i)
  {
    const glm::dvec3 s = eye + direction * distance;
    const HeightJet<double> jet = this->At(s.x, s.z);
    distance -= (s.y - jet.f) / (direction.y - jet.x * direction.x - jet.z * direction.z);
  }
  return eye + direction * distance;
}

//------------------------------------------------------------------------------
std::optional<glm::dvec3> SmoothSurface::Refract(
  const glm::dvec3& eye, const glm::dvec3& onSurface, double ratio) const
{
  const glm::dvec3 sight = glm::normalize(onSurface - eye);
  const glm::dvec3 normal = this->GetNormal(onSurface.x, onSurface.z);
  const double along = glm::dot(sight, normal);
  const glm::dvec3 tangent = (sight - normal * along) * ratio;
  const double squared = 1.0 - glm::dot(tangent, tangent);
  if (!(along < 0.0) || squared < 0.0)
  {
    return {};
  }
  return tangent - normal * std::sqrt(squared);
}

//------------------------------------------------------------------------------
MembraneMesh SmoothSurface::MakeMesh(int cells) const
{
  MembraneMesh mesh = MakeSquare(this->side, cells, 0.0);
  for (std::size_t i = 0; i < mesh.points.size(); i += 3)
  {
    const double x = mesh.points[i];
    const double z = mesh.points[i + 2];
    mesh.points[i + 1] = this->At(x, z).f;
    const glm::dvec3 normal = this->GetNormal(x, z);
    std::copy(&normal.x, &normal.x + 3, mesh.normals.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return mesh;
}

}
