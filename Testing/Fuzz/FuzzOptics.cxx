// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzOptics.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus::test
{
namespace
{

constexpr int MostPoints = 9;
constexpr int MostLights = 4;

glm::dmat4 ReadMatrix(ByteReader& reader)
{
  glm::dmat4 matrix(1.0);
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      matrix[column][row] = reader.Number();
    }
  }
  return matrix;
}

}

//------------------------------------------------------------------------------
std::vector<TransferFunctionPoint> ReadFunction(ByteReader& reader)
{
  std::vector<TransferFunctionPoint> points(static_cast<std::size_t>(reader.Below(MostPoints)));
  for (TransferFunctionPoint& point : points)
  {
    point.Scalar = reader.FiniteNumber();
    point.Attenuation = std::fabs(reader.FiniteNumber());
    point.Color = reader.Color();
  }
  std::stable_sort(points.begin(), points.end(),
    [](const TransferFunctionPoint& a, const TransferFunctionPoint& b)
    { return a.Scalar < b.Scalar; });
  return points;
}

//------------------------------------------------------------------------------
ScalarDistribution DistributionOf(const std::vector<double>& scalars)
{
  double lowest = std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::lowest();
  for (const double scalar : scalars)
  {
    if (std::isfinite(scalar))
    {
      lowest = std::min(lowest, scalar);
      highest = std::max(highest, scalar);
    }
  }
  return ScalarDistribution(lowest, highest, scalars);
}

//------------------------------------------------------------------------------
SurfaceLighting ReadLighting(ByteReader& reader)
{
  SurfaceLighting lighting;
  lighting.Ambient = reader.Share();
  lighting.Diffuse = reader.Share();
  lighting.Specular = reader.Share();
  lighting.SpecularPower = std::fabs(reader.FiniteNumber());
  lighting.Lights.resize(static_cast<std::size_t>(reader.Below(MostLights)));
  for (RayCastLight& light : lighting.Lights)
  {
    light.Position = glm::dvec4(reader.FiniteVector(), reader.Below(2));
    light.Diffuse = reader.Color();
    light.Specular = reader.Color();
    if (reader.Flag())
    {
      const double angle = reader.Share() * std::acos(0.0);
      light.Cone = glm::dvec4(reader.FiniteVector(), std::cos(angle));
      const double constant = reader.Share();
      const double linear = reader.Share();
      light.Falloff = glm::dvec4(constant, linear, reader.Share(), 8.0 * reader.Share());
    }
  }
  return lighting;
}

//------------------------------------------------------------------------------
RayFrameInput ReadCamera(
  ByteReader& reader, const glm::dvec3& center, double radius, int width, int height)
{
  RayFrameInput input;
  input.Center = center;
  input.Radius = radius;
  input.ImageSize = glm::dvec2(width, height);
  if (reader.Flag())
  {
    input.ModelToWorld = ReadMatrix(reader);
  }
  if (reader.Below(16) == 15)
  {
    input.WorldToView = ReadMatrix(reader);
    input.ViewToClip = ReadMatrix(reader);
    return input;
  }
  const glm::dvec3 target(input.ModelToWorld * glm::dvec4(center, 1.0));
  const double distance = reader.Number() * radius;
  const glm::dvec3 direction = reader.Vector();
  input.WorldToView = glm::lookAt(target + distance * direction, target, reader.Vector());
  const double width2 = reader.Number() * radius;
  const double nearest = reader.Number() * radius;
  const double farthest = nearest + reader.Number() * radius;
  input.ViewToClip = reader.Flag()
    ? glm::perspective(3.1 * reader.Share(), 1.0, nearest, farthest)
    : glm::ortho(-width2, width2, -width2, width2, nearest, farthest);
  return input;
}

}
