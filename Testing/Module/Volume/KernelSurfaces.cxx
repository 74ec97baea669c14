// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "KernelSurfaces.h"
#include "TestBasics.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <iterator>

namespace meniscus::test
{

//------------------------------------------------------------------------------
void TestSurface::Set(const MembraneInput& input)
{
  EXPECT_EQ(this->Shape->SetMembrane(input, SurfaceParts::Boxes), MembraneStatus::Ready);
}

//------------------------------------------------------------------------------
Sheet::Sheet(const std::function<double(double, double)>& height, int cells)
{
  this->SetHeight(height, cells);
}

//------------------------------------------------------------------------------
void Sheet::SetHeight(const std::function<double(double, double)>& height, int cells)
{
  std::vector<double> points;
  std::vector<std::int64_t> triangles;
  for (const auto& [j, i] : Product(cells + 1, cells + 1))
  {
    const double x = 2.0 * i / cells - 1.0;
    const double y = 2.0 * j / cells - 1.0;
    points.insert(points.end(), { x, y, height(x, y) });
  }
  for (const auto& [j, i] : Product(Below<std::int64_t>(cells), Below<std::int64_t>(cells)))
  {
    const std::int64_t a = j * (cells + 1) + i;
    const std::int64_t b = a + cells + 1;
    triangles.insert(triangles.end(), { a, a + 1, b, a + 1, b + 1, b });
  }
  this->Set(
    { points.data(), points.size() / 3, triangles.data(), triangles.size() / 3, nullptr, nullptr });
}

//------------------------------------------------------------------------------
Sphere::Sphere(int resolution, double radius)
{
  std::vector<double> points{ 0.0, 0.0, 1.0, 0.0, 0.0, -1.0 };
  std::vector<std::int64_t> triangles;
  const auto at = [resolution](std::int64_t ring, std::int64_t i)
  { return 2 + (ring - 1) * resolution + i % resolution; };
  const int last = resolution / 2 - 1;
  for (int ring = 1; ring <= last; ++ring)
  {
    const double polar = glm::pi<double>() * ring / (last + 1);
    for (int i = 0; i < resolution; ++i)
    {
      const double azimuth = 2.0 * glm::pi<double>() * i / resolution;
      points.insert(points.end(),
        { std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar) });
      if (ring < last)
      {
        triangles.insert(triangles.end(), { at(ring, i), at(ring + 1, i), at(ring + 1, i + 1) });
        triangles.insert(triangles.end(), { at(ring, i), at(ring + 1, i + 1), at(ring, i + 1) });
      }
    }
  }
  for (int i = 0; i < resolution; ++i)
  {
    triangles.insert(triangles.end(), { 0, at(1, i), at(1, i + 1) });
    triangles.insert(triangles.end(), { 1, at(last, i + 1), at(last, i) });
  }
  const std::vector<double> normals = points;
  for (double& coordinate : points)
  {
    coordinate *= radius;
  }
  this->Set({ points.data(), points.size() / 3, triangles.data(), triangles.size() / 3, nullptr,
    normals.data() });
}

//------------------------------------------------------------------------------
bool WorldBox::Meets(const glm::dvec3& start, const glm::dvec3& along, double end) const
{
  double first = 0.0;
  double last = end;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double a = (this->Center[axis] - this->Half[axis] - start[axis]) / along[axis];
    const double b = (this->Center[axis] + this->Half[axis] - start[axis]) / along[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

//------------------------------------------------------------------------------
RefractedRayStack::View LookAt(
  const glm::dvec3& eye, const glm::dvec3& target, double width, bool parallel, int size)
{
  const glm::dvec3 depth = glm::normalize(target - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(depth, glm::dvec3(0.1, 0.9, 0.2)));
  RefractedRayStack::View view;
  view.Frame.ViewToWorld = glm::dmat3(right, glm::cross(depth, right), depth);
  AffinePixelMap& map = parallel ? view.Frame.Origin : view.Frame.Slope;
  const double step = (parallel ? width : width / glm::length(target - eye)) / size;
  map.PerColumn = { step, 0.0 };
  map.PerRow = { 0.0, step };
  view.Width = size;
  view.Height = size;
  view.Center = eye;
  view.EyeDepth = parallel ? -100.0 : 0.0;
  return view;
}

//------------------------------------------------------------------------------
void SetMesh(RefractedRayStack::View& view, const WorldBox& box, const std::vector<WorldBox>& parts)
{
  const auto inFrame = [&view](const WorldBox& of)
  {
    const glm::dmat3 toFrame = glm::transpose(view.Frame.ViewToWorld);
    const glm::dmat3 half(of.Half.x, 0.0, 0.0, 0.0, of.Half.y, 0.0, 0.0, 0.0, of.Half.z);
    return BoundsInFrame{ toFrame * (of.Center - view.Center), toFrame * half };
  };
  view.Mesh = inFrame(box);
  view.Parts.clear();
  std::transform(parts.begin(), parts.end(), std::back_inserter(view.Parts), inFrame);
}

}
