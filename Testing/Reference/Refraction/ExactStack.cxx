// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ExactStack.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace meniscus::reference
{
namespace
{

// Distance to the surface; nothing if the ray misses it.
std::optional<double> Meet(
  const ExactSurface& surface, const glm::dvec3& origin, const glm::dvec3& direction)
{
  const glm::dvec3 away = origin - surface.Centre;
  if (surface.Radius == 0.0)
  {
    const double distance = -glm::dot(away, surface.Normal) / glm::dot(direction, surface.Normal);
    return distance >= 0.0 ? std::optional<double>(distance) : std::nullopt;
  }
  // A spheroid is a sphere where y is multiplied by the root of its stretch.
  const glm::dvec3 scale(1.0, std::sqrt(surface.Stretch), 1.0);
  const glm::dvec3 along = scale * direction;
  const double length = glm::length(along);
  const double middle = -glm::dot(scale * away, along) / length;
  const glm::dvec3 nearest = scale * away + middle * (along / length);
  const double squared = surface.Radius * surface.Radius - glm::dot(nearest, nearest);
  if (squared < 0.0)
  {
    return std::nullopt;
  }
  const double root = surface.IsFarSide ? std::sqrt(squared) : -std::sqrt(squared);
  const double distance = (middle + root) / length;
  return distance >= 0.0 ? std::optional<double>(distance) : std::nullopt;
}

void AddOriented(MembraneMesh& mesh, const std::array<std::int64_t, 3>& t)
{
  const auto at = [](const std::vector<double>& values, std::int64_t i)
  {
    const auto k = 3 * static_cast<std::size_t>(i);
    return glm::dvec3(values[k], values[k + 1], values[k + 2]);
  };
  const glm::dvec3 a = at(mesh.Points, t[0]);
  const glm::dvec3 winding = glm::cross(at(mesh.Points, t[1]) - a, at(mesh.Points, t[2]) - a);
  if (glm::dot(winding, at(mesh.Normals, t[0])) > 0.0)
  {
    mesh.AddTriangle(t[0], t[1], t[2]);
  }
  else
  {
    mesh.AddTriangle(t[0], t[2], t[1]);
  }
}

void AddGrid(MembraneMesh& mesh, int cells)
{
  for (int j = 0; j < cells; ++j)
  {
    for (int i = 0; i < cells; ++i)
    {
      const std::int64_t a = j * (cells + 1) + i;
      const std::int64_t b = a + 1;
      const std::int64_t c = a + cells + 1;
      AddOriented(mesh, { a, b, c });
      AddOriented(mesh, { b, c + 1, c });
    }
  }
}

}

//------------------------------------------------------------------------------
std::optional<ExactPath> TraceExactly(
  const std::vector<ExactSurface>& surfaces, const glm::dvec3& eye, const glm::dvec3& direction)
{
  ExactPath path;
  path.Directions.push_back(glm::normalize(direction));
  glm::dvec3 origin = eye;
  for (const ExactSurface& surface : surfaces)
  {
    const glm::dvec3 incoming = path.Directions.back();
    const std::optional<double> distance = Meet(surface, origin, incoming);
    if (!distance)
    {
      return std::nullopt;
    }
    origin += *distance * incoming;
    const glm::dvec3 normal = glm::normalize(surface.Radius == 0.0
        ? surface.Normal
        : glm::dvec3(1.0, surface.Stretch, 1.0) * (origin - surface.Centre));
    // Along the tangent, n sin is kept; along the normal, the rest of a unit vector, the same way.
    const double along = glm::dot(incoming, normal);
    const glm::dvec3 tangential = (surface.Before / surface.Behind) * (incoming - along * normal);
    const double rest = 1.0 - glm::dot(tangential, tangential);
    if (rest <= 0.0)
    {
      return std::nullopt;
    }
    path.Points.push_back(origin);
    path.Directions.push_back(tangential + std::copysign(std::sqrt(rest), along) * normal);
  }
  return path;
}

//------------------------------------------------------------------------------
ExactImage MakeImage(
  const std::vector<ExactSurface>& surfaces, const ExactPath& path, double length)
{
  const glm::dvec3 point = path.Points.back() + length * path.Directions.back();
  double apparent = 0.0;
  for (std::size_t k = 0; k < surfaces.size(); ++k)
  {
    const glm::dvec3 next = k + 1 < surfaces.size() ? path.Points[k + 1] : point;
    apparent += glm::length(next - path.Points[k]) * surfaces[0].Before / surfaces[k].Behind;
  }
  return { point, path.Points[0] + apparent * path.Directions[0] };
}

//------------------------------------------------------------------------------
glm::dvec2 MakeReflectances(double sine, double before, double behind)
{
  const double c = std::sqrt(1.0 - std::pow(sine / before, 2.0));
  const double d = std::sqrt(1.0 - std::pow(sine / behind, 2.0));
  const double s = (before * c - behind * d) / (before * c + behind * d);
  const double p = (behind * c - before * d) / (behind * c + before * d);
  return { s * s, p * p };
}

//------------------------------------------------------------------------------
double MakeReflectance(double cosine, double before, double behind)
{
  const double c = std::clamp(cosine, 0.0, 1.0);
  const double sine = before * std::sqrt(1.0 - c * c);
  if (sine >= behind)
  {
    return 1.0;
  }
  const glm::dvec2 reflected = MakeReflectances(sine, before, behind);
  return 0.5 * (reflected.x + reflected.y);
}

//------------------------------------------------------------------------------
double MakePlateTransmittance(double sine, double before, double plate, double behind)
{
  const glm::dvec2 upper = MakeReflectances(sine, before, plate);
  const glm::dvec2 lower = MakeReflectances(sine, plate, behind);
  const glm::dvec2 passed = (1.0 - upper) * (1.0 - lower) / (1.0 - upper * lower);
  return 0.5 * (passed.x + passed.y);
}

//------------------------------------------------------------------------------
MembraneMesh MakeSphere(const glm::dvec3& centre, double radius, int levels, bool outwards)
{
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<glm::dvec3> points;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double a : { -1.0, 1.0 })
    {
      for (const double b : { -golden, golden })
      {
        glm::dvec3 p(0.0);
        p[(axis + 1) % 3] = a;
        p[(axis + 2) % 3] = b;
        points.push_back(glm::normalize(p));
      }
    }
  }
  // Faces join points at the distance of an edge.
  const double edge = 2.0 / std::sqrt(1.0 + golden * golden);
  std::vector<std::array<std::int64_t, 3>> faces;
  const auto joined = [&points, edge](std::size_t i, std::size_t j)
  { return std::fabs(glm::length(points[i] - points[j]) - edge) < 1e-6; };
  for (std::size_t i = 0; i < 12; ++i)
  {
    for (std::size_t j = i + 1; j < 12; ++j)
    {
      for (std::size_t k = j + 1; k < 12; ++k)
      {
        if (joined(i, j) && joined(j, k) && joined(k, i))
        {
          faces.push_back({ static_cast<std::int64_t>(i), static_cast<std::int64_t>(j),
            static_cast<std::int64_t>(k) });
        }
      }
    }
  }
  for (int level = 0; level < levels; ++level)
  {
    std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> middles;
    const auto middle = [&points, &middles](std::int64_t a, std::int64_t b)
    {
      const std::pair<std::int64_t, std::int64_t> key = std::minmax(a, b);
      const auto found = middles.find(key);
      if (found != middles.end())
      {
        return found->second;
      }
      points.push_back(
        glm::normalize(points[static_cast<std::size_t>(a)] + points[static_cast<std::size_t>(b)]));
      const auto index = static_cast<std::int64_t>(points.size()) - 1;
      middles[key] = index;
      return index;
    };
    std::vector<std::array<std::int64_t, 3>> finer;
    for (const auto& face : faces)
    {
      const std::int64_t ab = middle(face[0], face[1]);
      const std::int64_t bc = middle(face[1], face[2]);
      const std::int64_t ca = middle(face[2], face[0]);
      finer.push_back({ face[0], ab, ca });
      finer.push_back({ ab, face[1], bc });
      finer.push_back({ ca, bc, face[2] });
      finer.push_back({ ab, bc, ca });
    }
    faces = std::move(finer);
  }
  MembraneMesh mesh;
  for (const glm::dvec3& point : points)
  {
    mesh.AddPoint(centre + radius * point, outwards ? point : -point);
  }
  for (const auto& face : faces)
  {
    AddOriented(mesh, face);
  }
  return mesh;
}

//------------------------------------------------------------------------------
MembraneMesh MakeCap(const glm::dvec3& centre, double radius, const glm::dvec3& along,
  const glm::dvec3& front, double side, int cells)
{
  MembraneMesh mesh;
  for (int j = 0; j <= cells; ++j)
  {
    for (int i = 0; i <= cells; ++i)
    {
      const double x = side * (static_cast<double>(i) / cells - 0.5);
      const double z = side * (static_cast<double>(j) / cells - 0.5);
      const double y = std::sqrt(radius * radius - x * x - z * z);
      const glm::dvec3 out = glm::dvec3(x, along.y * y, z) / radius;
      mesh.AddPoint(centre + radius * out, glm::dot(out, front) < 0.0 ? -out : out);
    }
  }
  AddGrid(mesh, cells);
  return mesh;
}

//------------------------------------------------------------------------------
MembraneMesh MakePlane(double y, double side, int cells, bool down)
{
  MembraneMesh mesh;
  for (int j = 0; j <= cells; ++j)
  {
    for (int i = 0; i <= cells; ++i)
    {
      mesh.AddPoint({ side * (static_cast<double>(i) / cells - 0.5), y,
                      side * (static_cast<double>(j) / cells - 0.5) },
        { 0.0, down ? -1.0 : 1.0, 0.0 });
    }
  }
  AddGrid(mesh, cells);
  return mesh;
}

}
