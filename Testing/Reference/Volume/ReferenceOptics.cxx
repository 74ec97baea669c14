// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceOptics.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace reference
{

namespace
{

double dot(const Vector3& a, const Vector3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double length(const Vector3& a)
{
  return std::sqrt(dot(a, a));
}

// a + factor * b
Vector3 add(const Vector3& a, double factor, const Vector3& b)
{
  return { a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2] };
}

Vector3 scaled(double factor, const Vector3& a)
{
  return add(Vector3{ 0.0, 0.0, 0.0 }, factor, a);
}

Vector3 pointAt(const Ray& ray, double t)
{
  return add(ray.Origin, t, ray.Direction);
}

// Fractions of a segment at which its scalar passes a node of the function, with 0 and 1.
std::vector<double> breaks(const RaySegment& segment, const ReferenceTransferFunction& function)
{
  std::vector<double> at{ 0.0, 1.0 };
  for (const TransferFunctionNode& node : function.nodes())
  {
    const double u =
      (node.Scalar - segment.ScalarBegin) / (segment.ScalarEnd - segment.ScalarBegin);
    if (u > 0.0 && u < 1.0)
    {
      at.push_back(u);
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}

double scalarAt(const RaySegment& segment, double u)
{
  return segment.ScalarBegin + u * (segment.ScalarEnd - segment.ScalarBegin);
}

// Simpson's rule on each linear piece of the attenuation.
double additiveTerm(
  const RaySegment& segment, const ReferenceTransferFunction& function, const double range[2])
{
  const std::vector<double> at = breaks(segment, function);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
  {
    const double middle = 0.5 * (at[i] + at[i + 1]);
    const std::size_t piece = function.pieceOf(scalarAt(segment, middle));
    const auto term = [&](double u)
    {
      const double s = scalarAt(segment, u);
      return function.valueInPiece(piece, s).Attenuation * (s - range[0]) / (range[1] - range[0]);
    };
    sum += (at[i + 1] - at[i]) / 6.0 * (term(at[i]) + 4.0 * term(middle) + term(at[i + 1]));
  }
  return sum;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::array<double, 4> project(const Ray& ray, const std::vector<RaySegment>& segments,
  Projection projection, const ReferenceTransferFunction& function, const double range[2])
{
  if (segments.empty())
  {
    return { 0.0, 0.0, 0.0, 0.0 };
  }
  double largest = segments[0].ScalarBegin;
  double smallest = largest;
  double integral = 0.0;
  double covered = 0.0;
  double additive = 0.0;
  for (const RaySegment& segment : segments)
  {
    const double size = (segment.End - segment.Begin) * length(ray.Direction);
    largest = std::max({ largest, segment.ScalarBegin, segment.ScalarEnd });
    smallest = std::min({ smallest, segment.ScalarBegin, segment.ScalarEnd });
    integral += size * 0.5 * (segment.ScalarBegin + segment.ScalarEnd);
    covered += size;
    additive +=
      projection == Projection::Additive ? size * additiveTerm(segment, function, range) : 0.0;
  }
  if (projection == Projection::Additive)
  {
    const double grey = std::min(std::max(additive, 0.0), 1.0);
    return { grey, grey, grey, 1.0 };
  }
  const double shown = projection == Projection::Maximum
    ? largest
    : (projection == Projection::Minimum ? smallest : integral / covered);
  const OpticalSample sample = function.value(shown);
  const double alpha = sample.Attenuation;
  return { alpha * sample.Color[0], alpha * sample.Color[1], alpha * sample.Color[2], alpha };
}

//------------------------------------------------------------------------------
Ray clipRay(const Ray& ray, const std::vector<HalfSpace>& halfSpaces)
{
  Ray clipped = ray;
  for (const HalfSpace& half : halfSpaces)
  {
    const double height = dot(half.Normal, add(ray.Origin, -1.0, half.Origin));
    const double slope = dot(half.Normal, ray.Direction);
    if (slope > 0.0)
    {
      clipped.Begin = std::max(clipped.Begin, -height / slope);
    }
    else if (slope < 0.0)
    {
      clipped.End = std::min(clipped.End, -height / slope);
    }
    else if (height < 0.0)
    {
      clipped.End = clipped.Begin;
    }
  }
  return clipped;
}

//------------------------------------------------------------------------------
ReferenceGradients::ReferenceGradients(const ReferenceMesh& mesh, bool smooth)
  : Mesh(mesh)
{
  if (!smooth)
  {
    return;
  }
  std::vector<double> volumes;
  for (const std::int64_t id : mesh.contributingCells())
  {
    const std::int64_t* ids = mesh.cell(static_cast<std::size_t>(id));
    Vector3 edges[3];
    for (int i = 0; i < 3; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        edges[i][axis] = mesh.point(ids[i + 1])[axis] - mesh.point(ids[0])[axis];
      }
    }
    const Vector3 cross{ edges[1][1] * edges[2][2] - edges[1][2] * edges[2][1],
      edges[1][2] * edges[2][0] - edges[1][0] * edges[2][2],
      edges[1][0] * edges[2][1] - edges[1][1] * edges[2][0] };
    const double volume = std::fabs(dot(edges[0], cross));
    for (int i = 0; i < 4; ++i)
    {
      const std::size_t point = static_cast<std::size_t>(ids[i]);
      if (point >= volumes.size())
      {
        volumes.resize(point + 1, 0.0);
        this->AtPoints.resize(point + 1, Vector3{ 0.0, 0.0, 0.0 });
      }
      volumes[point] += volume;
      this->AtPoints[point] = add(this->AtPoints[point], volume, this->ofCell(id));
    }
  }
  for (std::size_t i = 0; i < volumes.size(); ++i)
  {
    this->AtPoints[i] = scaled(volumes[i] > 0.0 ? 1.0 / volumes[i] : 0.0, this->AtPoints[i]);
  }
}

//------------------------------------------------------------------------------
Vector3 ReferenceGradients::ofCell(std::int64_t cell) const
{
  const std::int64_t* ids = this->Mesh.cell(static_cast<std::size_t>(cell));
  const CellPlanes& planes = this->Mesh.planes(static_cast<std::size_t>(cell));
  // The gradient is computed from differences, so that equal scalars have no gradient instead of
  // one of rounding.
  Vector3 gradient{ 0.0, 0.0, 0.0 };
  for (int i = 1; i < 4; ++i)
  {
    gradient =
      add(gradient, this->Mesh.scalar(ids[i]) - this->Mesh.scalar(ids[0]), planes.Gradient[i]);
  }
  return gradient;
}

//------------------------------------------------------------------------------
Vector3 ReferenceGradients::at(std::int64_t cell, const Vector3& position) const
{
  if (this->AtPoints.empty())
  {
    return this->ofCell(cell);
  }
  const std::int64_t* ids = this->Mesh.cell(static_cast<std::size_t>(cell));
  const CellPlanes& planes = this->Mesh.planes(static_cast<std::size_t>(cell));
  const Vector3 fromCenter = add(position, -1.0, this->Mesh.center());
  Vector3 gradient{ 0.0, 0.0, 0.0 };
  for (int i = 0; i < 4; ++i)
  {
    const double weight = dot(planes.Gradient[i], fromCenter) + planes.Offset[i];
    gradient = add(gradient, weight, this->AtPoints[static_cast<std::size_t>(ids[i])]);
  }
  return gradient;
}

//------------------------------------------------------------------------------
std::array<double, 3> shade(const Material& material, const Ray& ray, const Vector3& position,
  const Vector3& gradient, const std::array<double, 3>& emitted)
{
  std::array<double, 3> shown = scaled(material.Ambient, emitted);
  const double size = length(gradient);
  if (size == 0.0)
  {
    return shown;
  }
  const Vector3 toEye = scaled(-1.0 / length(ray.Direction), ray.Direction);
  const double side = dot(gradient, toEye) < 0.0 ? -1.0 : 1.0;
  const Vector3 normal = scaled(side / size, gradient);
  for (const Light& light : material.Lights)
  {
    const Vector3 way = light.Positional ? add(light.Place, -1.0, position) : light.Place;
    const double distance = length(way);
    const Vector3 toLight = scaled(1.0 / distance, way);
    double strength = 1.0;
    if (light.Positional)
    {
      strength /= light.Falloff[0] + distance * (light.Falloff[1] + distance * light.Falloff[2]);
    }
    if (light.ConeCosine >= -1.0)
    {
      const double inCone = -dot(toLight, light.Axis) / length(light.Axis);
      strength *= inCone >= light.ConeCosine ? std::pow(inCone, light.Exponent) : 0.0;
    }
    const double facing = dot(normal, toLight);
    if (facing <= 0.0)
    {
      continue;
    }
    const double glance = 2.0 * facing * dot(normal, toEye) - dot(toLight, toEye);
    const double highlight = glance > 0.0 ? std::pow(glance, material.Power) : 0.0;
    for (int c = 0; c < 3; ++c)
    {
      shown[c] += strength *
        (material.Diffuse * facing * light.Diffuse[c] * emitted[c] +
          material.Specular * highlight * light.Specular[c]);
    }
  }
  return shown;
}

//------------------------------------------------------------------------------
std::array<double, 4> blendSurfaces(const Ray& ray, const std::vector<RaySegment>& segments,
  const std::vector<Surface>& surfaces, const ReferenceGradients* gradients,
  const Material& material)
{
  std::array<double, 4> total{ 0.0, 0.0, 0.0, 0.0 };
  for (const RaySegment& segment : segments)
  {
    std::vector<std::pair<double, const Surface*>> met;
    for (const Surface& surface : surfaces)
    {
      if ((segment.ScalarBegin < surface.Scalar) != (segment.ScalarEnd < surface.Scalar))
      {
        met.emplace_back(
          (surface.Scalar - segment.ScalarBegin) / (segment.ScalarEnd - segment.ScalarBegin),
          &surface);
      }
    }
    std::sort(met.begin(), met.end());
    for (const auto& one : met)
    {
      std::array<double, 3> color = one.second->Color;
      if (gradients)
      {
        const Vector3 x = pointAt(ray, segment.Begin + one.first * (segment.End - segment.Begin));
        color = shade(material, ray, x, gradients->at(segment.Cell, x), color);
      }
      const double share = (1.0 - total[3]) * one.second->Alpha;
      for (int c = 0; c < 3; ++c)
      {
        total[c] += share * color[c];
      }
      total[3] += share;
    }
  }
  return total;
}

//------------------------------------------------------------------------------
std::array<double, 4> integrateShaded(const Ray& ray, const std::vector<RaySegment>& segments,
  const ReferenceTransferFunction& function, const ReferenceGradients& gradients,
  const Material* material, const std::function<double(double)>& gradientOpacity, int stepsPerPiece)
{
  std::array<double, 4> total{ 0.0, 0.0, 0.0, 0.0 };
  double transmittance = 1.0;
  for (const RaySegment& segment : segments)
  {
    const double size = (segment.End - segment.Begin) * length(ray.Direction);
    const std::vector<double> at = breaks(segment, function);
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
    {
      const double step = (at[i + 1] - at[i]) / stepsPerPiece;
      for (int k = 0; k < stepsPerPiece; ++k)
      {
        const double u = at[i] + (k + 0.5) * step;
        const Vector3 x = pointAt(ray, segment.Begin + u * (segment.End - segment.Begin));
        const Vector3 gradient = gradients.at(segment.Cell, x);
        const OpticalSample sample = function.value(scalarAt(segment, u));
        const double factor = gradientOpacity ? gradientOpacity(length(gradient)) : 1.0;
        const double passed = std::exp(-factor * sample.Attenuation * step * size);
        const std::array<double, 3> color =
          material ? shade(*material, ray, x, gradient, sample.Color) : sample.Color;
        for (int c = 0; c < 3; ++c)
        {
          total[c] += transmittance * (1.0 - passed) * color[c];
        }
        transmittance *= passed;
      }
    }
  }
  total[3] = 1.0 - transmittance;
  return total;
}

} // namespace reference
} // namespace meniscus
