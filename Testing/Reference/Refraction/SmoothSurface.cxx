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
  const T phase = wave.Kx * x + wave.Kz * z + T(wave.Phase);
  const T sine = wave.Amplitude * Sine(phase);
  const T cosine = wave.Amplitude * Cosine(phase);
  jet.F = jet.F + sine;
  jet.X = jet.X + wave.Kx * cosine;
  jet.Z = jet.Z + wave.Kz * cosine;
  jet.Xx = jet.Xx - (wave.Kx * wave.Kx) * sine;
  jet.Xz = jet.Xz - (wave.Kx * wave.Kz) * sine;
  jet.Zz = jet.Zz - (wave.Kz * wave.Kz) * sine;
}

template <typename T>
void AddHill(HeightJet<T>& jet, const SmoothSurface::Hill& hill, const T& x, const T& z)
{
  const T dx = x - T(hill.CentreX);
  const T dz = z - T(hill.CentreZ);
  const double s = hill.K * hill.K;
  const T f = hill.Amplitude * Exponential((-s) * (Square(dx) + Square(dz)));
  jet.F = jet.F + f;
  jet.X = jet.X + (-2.0 * s) * (f * dx);
  jet.Z = jet.Z + (-2.0 * s) * (f * dz);
  jet.Xx = jet.Xx + (2.0 * s) * (f * ((2.0 * s) * Square(dx) - T(1.0)));
  jet.Xz = jet.Xz + (4.0 * s * s) * (f * (dx * dz));
  jet.Zz = jet.Zz + (2.0 * s) * (f * ((2.0 * s) * Square(dz) - T(1.0)));
}

template <typename T>
void AddSphere(HeightJet<T>& jet, double radius, const T& x, const T& z)
{
  const double sign = radius > 0.0 ? 1.0 : -1.0;
  const T w = Root(T(radius * radius) - Square(x) - Square(z));
  const T inverse = T(1.0) / w;
  const T cube = inverse * Square(inverse);
  jet.F = jet.F + sign * (T(sign * radius) - w);
  jet.X = jet.X + sign * (x * inverse);
  jet.Z = jet.Z + sign * (z * inverse);
  jet.Xx = jet.Xx + sign * (inverse + Square(x) * cube);
  jet.Xz = jet.Xz + sign * ((x * z) * cube);
  jet.Zz = jet.Zz + sign * (inverse + Square(z) * cube);
}

template <typename T>
HeightJet<T> Sum(const SmoothSurface& surface, const T& x, const T& z)
{
  HeightJet<T> jet;
  for (const SmoothSurface::Wave& wave : surface.Waves)
  {
    AddWave(jet, wave, x, z);
  }
  for (const SmoothSurface::Hill& hill : surface.Hills)
  {
    AddHill(jet, hill, x, z);
  }
  if (surface.SphereRadius != 0.0)
  {
    AddSphere(jet, surface.SphereRadius, x, z);
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
  return glm::normalize(glm::dvec3(-jet.X, 1.0, -jet.Z));
}

//------------------------------------------------------------------------------
glm::dvec3 SmoothSurface::Intersect(
  const glm::dvec3& eye, const glm::dvec3& direction, double distance) const
{
  for (int i = 0; i < 40; ++i)
  {
    const glm::dvec3 s = eye + direction * distance;
    const HeightJet<double> jet = this->At(s.x, s.z);
    distance -= (s.y - jet.F) / (direction.y - jet.X * direction.x - jet.Z * direction.z);
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
  MembraneMesh mesh = MakeSquare(this->Side, cells, 0.0);
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    const double x = mesh.Points[i];
    const double z = mesh.Points[i + 2];
    mesh.Points[i + 1] = this->At(x, z).F;
    const glm::dvec3 normal = this->GetNormal(x, z);
    std::copy(&normal.x, &normal.x + 3, mesh.Normals.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return mesh;
}

}
