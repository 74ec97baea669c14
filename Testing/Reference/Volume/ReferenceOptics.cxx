// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceOptics.h"

#include <algorithm>
#include <cmath>

namespace meniscus::reference
{

namespace
{

// a + factor * b
Vector3 Add(const Vector3& a, double factor, const Vector3& b)
{
  return { a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2] };
}

Vector3 Scaled(double factor, const Vector3& a)
{
  return Add(Vector3{ 0.0, 0.0, 0.0 }, factor, a);
}

Vector3 PointAt(const Ray& ray, double t)
{
  return Add(ray.Origin, t, ray.Direction);
}

// Fractions of a segment at which its scalar passes a node of the function, with 0 and 1.
std::vector<double> Breaks(const RaySegment& segment, const ReferenceTransferFunction& function)
{
  std::vector<double> at{ 0.0, 1.0 };
  for (const TransferFunctionNode& node : function.GetNodes())
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

double ScalarAt(const RaySegment& segment, double u)
{
  return segment.ScalarBegin + u * (segment.ScalarEnd - segment.ScalarBegin);
}

// Simpson's rule on each linear piece of the attenuation.
double AdditiveTerm(
  const RaySegment& segment, const ReferenceTransferFunction& function, const double range[2])
{
  const std::vector<double> at = Breaks(segment, function);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
  {
    const double middle = 0.5 * (at[i] + at[i + 1]);
    const std::size_t piece = function.PieceOf(ScalarAt(segment, middle));
    const auto term = [&](double u)
    {
      const double s = ScalarAt(segment, u);
      return function.ValueInPiece(piece, s).Attenuation * (s - range[0]) / (range[1] - range[0]);
    };
    sum += (at[i + 1] - at[i]) / 6.0 * (term(at[i]) + 4.0 * term(middle) + term(at[i + 1]));
  }
  return sum;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::array<double, 4> Project(const Ray& ray, const std::vector<RaySegment>& segments,
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
    const double size = (segment.End - segment.Begin) * MakeLength(ray.Direction);
    largest = std::max({ largest, segment.ScalarBegin, segment.ScalarEnd });
    smallest = std::min({ smallest, segment.ScalarBegin, segment.ScalarEnd });
    integral += size * 0.5 * (segment.ScalarBegin + segment.ScalarEnd);
    covered += size;
    additive +=
      projection == Projection::Additive ? size * AdditiveTerm(segment, function, range) : 0.0;
  }
  if (projection == Projection::Additive)
  {
    const double grey = std::min(std::max(additive, 0.0), 1.0);
    return { grey, grey, grey, 1.0 };
  }
  const double shown = projection == Projection::Maximum
    ? largest
    : (projection == Projection::Minimum ? smallest : integral / covered);
  const OpticalSample sample = function.GetValue(shown);
  const double alpha = sample.Attenuation;
  return { alpha * sample.Color[0], alpha * sample.Color[1], alpha * sample.Color[2], alpha };
}

//------------------------------------------------------------------------------
Ray ClipRay(const Ray& ray, const std::vector<HalfSpace>& halfSpaces)
{
  Ray clipped = ray;
  for (const HalfSpace& half : halfSpaces)
  {
    const double height = Dot(half.Normal, Add(ray.Origin, -1.0, half.Origin));
    const double slope = Dot(half.Normal, ray.Direction);
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
Ray ClipToCube(const Ray& ray)
{
  Ray clipped = ray;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double a = (-1.0 - ray.Origin[axis]) / ray.Direction[axis];
    const double b = (1.0 - ray.Origin[axis]) / ray.Direction[axis];
    clipped.Begin = std::max(clipped.Begin, std::min(a, b));
    clipped.End = std::min(clipped.End, std::max(a, b));
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
  for (const std::int64_t id : mesh.ContributingCells())
  {
    const std::int64_t* ids = mesh.GetCell(static_cast<std::size_t>(id));
    Vector3 edges[3];
    for (int i = 0; i < 3; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        edges[i][axis] = mesh.GetPoint(ids[i + 1])[axis] - mesh.GetPoint(ids[0])[axis];
      }
    }
    const Vector3 cross{ edges[1][1] * edges[2][2] - edges[1][2] * edges[2][1],
      edges[1][2] * edges[2][0] - edges[1][0] * edges[2][2],
      edges[1][0] * edges[2][1] - edges[1][1] * edges[2][0] };
    const double volume = std::fabs(Dot(edges[0], cross));
    for (int i = 0; i < 4; ++i)
    {
      const std::size_t point = static_cast<std::size_t>(ids[i]);
      if (point >= volumes.size())
      {
        volumes.resize(point + 1, 0.0);
        this->AtPoints.resize(point + 1, Vector3{ 0.0, 0.0, 0.0 });
      }
      volumes[point] += volume;
      this->AtPoints[point] = Add(this->AtPoints[point], volume, this->OfCell(id));
    }
  }
  for (std::size_t i = 0; i < volumes.size(); ++i)
  {
    this->AtPoints[i] = Scaled(volumes[i] > 0.0 ? 1.0 / volumes[i] : 0.0, this->AtPoints[i]);
  }
}

//------------------------------------------------------------------------------
Vector3 ReferenceGradients::OfCell(std::int64_t cell) const
{
  const std::int64_t* ids = this->Mesh.GetCell(static_cast<std::size_t>(cell));
  const CellPlanes& planes = this->Mesh.GetPlanes(static_cast<std::size_t>(cell));
  // The gradient is computed from differences, so that equal scalars have no gradient instead of
  // one of rounding.
  Vector3 gradient{ 0.0, 0.0, 0.0 };
  for (int i = 1; i < 4; ++i)
  {
    gradient = Add(
      gradient, this->Mesh.GetScalar(ids[i]) - this->Mesh.GetScalar(ids[0]), planes.Gradient[i]);
  }
  return gradient;
}

//------------------------------------------------------------------------------
Vector3 ReferenceGradients::At(std::int64_t cell, const Vector3& position) const
{
  if (this->AtPoints.empty())
  {
    return this->OfCell(cell);
  }
  const std::int64_t* ids = this->Mesh.GetCell(static_cast<std::size_t>(cell));
  const CellPlanes& planes = this->Mesh.GetPlanes(static_cast<std::size_t>(cell));
  const Vector3 fromCenter = Add(position, -1.0, this->Mesh.GetCenter());
  Vector3 gradient{ 0.0, 0.0, 0.0 };
  for (int i = 0; i < 4; ++i)
  {
    const double weight = Dot(planes.Gradient[i], fromCenter) + planes.Offset[i];
    gradient = Add(gradient, weight, this->AtPoints[static_cast<std::size_t>(ids[i])]);
  }
  return gradient;
}

//------------------------------------------------------------------------------
std::array<double, 3> Shade(const Material& material, const Ray& ray, const Vector3& position,
  const Vector3& gradient, const std::array<double, 3>& emitted)
{
  std::array<double, 3> shown = Scaled(material.Ambient, emitted);
  const double size = MakeLength(gradient);
  if (size == 0.0)
  {
    return shown;
  }
  const Vector3 toEye = Scaled(-1.0 / MakeLength(ray.Direction), ray.Direction);
  const double side = Dot(gradient, toEye) < 0.0 ? -1.0 : 1.0;
  const Vector3 normal = Scaled(side / size, gradient);
  for (const Light& light : material.Lights)
  {
    const Vector3 way = light.Positional ? Add(light.Place, -1.0, position) : light.Place;
    const double distance = MakeLength(way);
    const Vector3 toLight = Scaled(1.0 / distance, way);
    double strength = 1.0;
    if (light.Positional)
    {
      strength /= light.Falloff[0] + distance * (light.Falloff[1] + distance * light.Falloff[2]);
    }
    if (light.ConeCosine >= -1.0)
    {
      const double inCone = -Dot(toLight, light.Axis) / MakeLength(light.Axis);
      strength *= inCone >= light.ConeCosine ? std::pow(inCone, light.Exponent) : 0.0;
    }
    const double facing = Dot(normal, toLight);
    if (facing <= 0.0)
    {
      continue;
    }
    const double glance = 2.0 * facing * Dot(normal, toEye) - Dot(toLight, toEye);
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
std::array<double, 4> BlendSurfaces(const Ray& ray, const std::vector<RaySegment>& segments,
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
        const Vector3 x = PointAt(ray, segment.Begin + one.first * (segment.End - segment.Begin));
        color = Shade(material, ray, x, gradients->At(segment.Cell, x), color);
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
std::array<double, 4> IntegrateShaded(const Ray& ray, const std::vector<RaySegment>& segments,
  const ReferenceTransferFunction& function, const ReferenceGradients& gradients,
  const Material* material, const std::function<double(double)>& gradientOpacity, int stepsPerPiece)
{
  std::array<double, 4> total{ 0.0, 0.0, 0.0, 0.0 };
  double transmittance = 1.0;
  for (const RaySegment& segment : segments)
  {
    const double size = (segment.End - segment.Begin) * MakeLength(ray.Direction);
    const std::vector<double> at = Breaks(segment, function);
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
    {
      const double step = (at[i + 1] - at[i]) / stepsPerPiece;
      for (int k = 0; k < stepsPerPiece; ++k)
      {
        const double u = at[i] + (k + 0.5) * step;
        const Vector3 x = PointAt(ray, segment.Begin + u * (segment.End - segment.Begin));
        const Vector3 gradient = gradients.At(segment.Cell, x);
        const OpticalSample sample = function.GetValue(ScalarAt(segment, u));
        const double factor = gradientOpacity ? gradientOpacity(MakeLength(gradient)) : 1.0;
        const double passed = std::exp(-factor * sample.Attenuation * step * size);
        const std::array<double, 3> color =
          material ? Shade(*material, ray, x, gradient, sample.Color) : sample.Color;
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

} // namespace meniscus::reference
