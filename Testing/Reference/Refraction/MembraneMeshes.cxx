// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MembraneMeshes.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <functional>
#include <random>

namespace meniscus::reference
{
namespace
{

const double Pi = std::acos(-1.0);

void AddOnSphere(MembraneMesh& mesh, double x, double z, double sphereRadius)
{
  if (sphereRadius <= 0.0)
  {
    mesh.AddPoint({ x, 0.0, z }, { 0.0, 1.0, 0.0 });
    return;
  }
  const double squared = sphereRadius * sphereRadius - x * x - z * z;
  const glm::dvec3 centre(0.0, sphereRadius, 0.0);
  const glm::dvec3 point(x, sphereRadius - std::sqrt(std::max(squared, 0.0)), z);
  mesh.AddPoint(point, glm::normalize(centre - point));
}

using AddVertex = std::function<void(MembraneMesh&, double x, double z)>;

MembraneMesh MakeGrid(double side, int cells, const AddVertex& add)
{
  MembraneMesh mesh;
  for (int j = 0; j <= cells; ++j)
  {
    for (int i = 0; i <= cells; ++i)
    {
      add(mesh, side * (static_cast<double>(i) / cells - 0.5),
        side * (static_cast<double>(j) / cells - 0.5));
    }
  }
  const std::int64_t row = cells + 1;
  for (std::int64_t j = 0; j < cells; ++j)
  {
    for (std::int64_t i = 0; i < cells; ++i)
    {
      const std::int64_t a = j * row + i;
      mesh.AddTriangle(a, a + row, a + row + 1);
      mesh.AddTriangle(a, a + row + 1, a + 1);
    }
  }
  return mesh;
}

}

//------------------------------------------------------------------------------
void MembraneMesh::AddPoint(const glm::dvec3& point, const glm::dvec3& normal)
{
  this->Points.insert(this->Points.end(), { point.x, point.y, point.z });
  this->Normals.insert(this->Normals.end(), { normal.x, normal.y, normal.z });
}

//------------------------------------------------------------------------------
void MembraneMesh::AddTriangle(std::int64_t a, std::int64_t b, std::int64_t c)
{
  this->Triangles.insert(this->Triangles.end(), { a, b, c });
}

//------------------------------------------------------------------------------
void MembraneMesh::AddRings(std::int64_t first, int rings, int around)
{
  for (int ring = 0; ring + 1 < rings; ++ring)
  {
    for (int i = 0; i < around; ++i)
    {
      const std::int64_t a = first + ring * around + i;
      const std::int64_t b = first + ring * around + (i + 1) % around;
      this->AddTriangle(a, b, b + around);
      this->AddTriangle(a, b + around, a + around);
    }
  }
}

//------------------------------------------------------------------------------
MembraneInput MembraneMesh::AsInput(bool withNormals) const
{
  MembraneInput input;
  input.Points = this->Points.data();
  input.NumberOfPoints = this->Points.size() / 3;
  input.Triangles = this->Triangles.data();
  input.NumberOfTriangles = this->Triangles.size() / 3;
  input.Normals = withNormals ? this->Normals.data() : nullptr;
  return input;
}

//------------------------------------------------------------------------------
void MembraneMesh::Translate(const glm::dvec3& offset)
{
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    this->Points[i] += offset[static_cast<int>(i % 3)];
  }
}

//------------------------------------------------------------------------------
MembraneMesh MakeDisc(double radius, int rings, double sphereRadius)
{
  MembraneMesh mesh;
  AddOnSphere(mesh, 0.0, 0.0, sphereRadius);
  std::int64_t inner = 0; // first vertex of the next inner ring
  std::int64_t innerCount = 1;
  for (int ring = 1; ring <= rings; ++ring)
  {
    const std::int64_t outer = inner + innerCount;
    const std::int64_t outerCount = ring == 1 ? 4 : 2 * innerCount;
    for (std::int64_t k = 0; k < outerCount; ++k)
    {
      const double angle = 2.0 * Pi * static_cast<double>(k) / static_cast<double>(outerCount);
      const double r = radius * ring / rings;
      AddOnSphere(mesh, r * std::cos(angle), r * std::sin(angle), sphereRadius);
    }
    for (std::int64_t k = 0; k < innerCount; ++k)
    {
      const auto in = [inner, innerCount](std::int64_t i) { return inner + i % innerCount; };
      const auto out = [outer, outerCount](std::int64_t i) { return outer + i % outerCount; };
      if (ring == 1)
      {
        for (std::int64_t i = 0; i < outerCount; ++i)
        {
          mesh.AddTriangle(0, out(i + 1), out(i));
        }
        continue;
      }
      mesh.AddTriangle(in(k), out(2 * k + 1), out(2 * k));
      mesh.AddTriangle(in(k), in(k + 1), out(2 * k + 1));
      mesh.AddTriangle(in(k + 1), out(2 * k + 2), out(2 * k + 1));
    }
    inner = outer;
    innerCount = outerCount;
  }
  return mesh;
}

//------------------------------------------------------------------------------
MembraneMesh MakeSquare(double side, int cells, double sphereRadius)
{
  return MakeGrid(side, cells,
    [sphereRadius](MembraneMesh& mesh, double x, double z)
    { AddOnSphere(mesh, x, z, sphereRadius); });
}

//------------------------------------------------------------------------------
MembraneMesh MakeWaves(double side, int cells, double amplitude, double waves)
{
  const double k = 2.0 * Pi * waves / side;
  return MakeGrid(side, cells,
    [amplitude, k](MembraneMesh& mesh, double x, double z)
    {
      const double height = amplitude * std::sin(k * x) * std::sin(k * z);
      const double dx = amplitude * k * std::cos(k * x) * std::sin(k * z);
      const double dz = amplitude * k * std::sin(k * x) * std::cos(k * z);
      mesh.AddPoint({ x, height, z }, glm::normalize(glm::dvec3(-dx, 1.0, -dz)));
    });
}

//------------------------------------------------------------------------------
MembraneMesh MakeRandom(double side, int cells, double roughness, double tilt, unsigned seed)
{
  std::mt19937 engine(seed);
  // std::uniform_real_distribution is not used: its values differ between libraries.
  const auto random = [&engine] { return 2.0 * (engine() / 4294967296.0) - 1.0; };
  return MakeGrid(side, cells,
    [&random, roughness, tilt](MembraneMesh& mesh, double x, double z)
    {
      const double y = roughness * random();
      const double nx = tilt * random();
      const double nz = tilt * random();
      mesh.AddPoint({ x, y, z }, glm::normalize(glm::dvec3(nx, 1.0, nz)));
    });
}

//------------------------------------------------------------------------------
MembraneMesh MakeSphere(int resolution, double side)
{
  MembraneMesh mesh;
  const auto add = [&mesh, side](const glm::dvec3& p) { mesh.AddPoint(p, side * p); };
  add({ 0.0, 0.0, 1.0 });
  add({ 0.0, 0.0, -1.0 });
  for (int ring = 1; ring < resolution - 1; ++ring)
  {
    const double polar = Pi * ring / (resolution - 1);
    for (int i = 0; i < resolution; ++i)
    {
      const double azimuth = 2.0 * Pi * i / resolution;
      add({ std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
        std::cos(polar) });
    }
  }
  mesh.AddRings(2, resolution - 2, resolution);
  const std::int64_t last = 2 + (resolution - 3) * resolution;
  for (int i = 0; i < resolution; ++i)
  {
    const int next = (i + 1) % resolution;
    mesh.AddTriangle(0, 2 + next, 2 + i);
    mesh.AddTriangle(1, last + i, last + next);
  }
  return mesh;
}

}
