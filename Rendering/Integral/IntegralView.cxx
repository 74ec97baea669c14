// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/IntegralView.h"

#include "Common/FiniteVector.h"
#include "Rendering/Common/Matrices.h"

#include "vtkCamera.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/**
 * Largest cosine between the axes of a rectangle. Axes given in single precision have rounding
 * errors of up to 2^-24 per coordinate relative to their length, and their cosine of up to
 * 4 sqrt(3) * 2^-24 = 4.1e-7.
 */
constexpr double LargestCosine = 1.0e-6;

/** Depth of a point in world coordinates. */
double DepthOf(const glm::dvec3& point, const IntegralView& view)
{
  return (glm::inverse(view.Rays.ViewToWorld) * (point - view.Center)).z;
}

std::string ComputeView(
  RayFrameInput& input, const int size[2], const TetrahedralMesh& mesh, IntegralView& view)
{
  input.Center = mesh.GetCenter();
  input.Radius = mesh.GetRadius();
  input.SmallestCell = mesh.GetSmallestCell();
  input.ImageSize = glm::dvec2(size[0], size[1]);
  view.Center = input.Center;
  switch (ComputeRayFrame(input, view.Rays))
  {
    case RayFrameStatus::Ok:
      return std::string();
    case RayFrameStatus::Singular:
      return "The matrix of the camera is singular or not finite";
    default:
      return "The camera's projection is not that of a plane image";
  }
}

}

//------------------------------------------------------------------------------
glm::dvec3 ParallelRectangle::GetDirection() const
{
  return glm::normalize(glm::cross(this->Axis2, this->Axis1));
}

//------------------------------------------------------------------------------
std::string DescribeFault(const ParallelRectangle& rectangle)
{
  if (!IsFinite(rectangle.Origin) || !IsFinite(rectangle.Axis1) || !IsFinite(rectangle.Axis2))
  {
    return "The frame's origin or one of its axes is not finite";
  }
  const double lengths = glm::length(rectangle.Axis1) * glm::length(rectangle.Axis2);
  const double area = glm::length(glm::cross(rectangle.Axis1, rectangle.Axis2));
  if (!(area > 0.0) || !std::isfinite(lengths))
  {
    return "The frame has no area, or one that is not finite";
  }
  if (std::abs(glm::dot(rectangle.Axis1, rectangle.Axis2)) > LargestCosine * lengths)
  {
    return "The frame's axes are not perpendicular to each other";
  }
  return std::string();
}

//------------------------------------------------------------------------------
std::string FitRectangle(const glm::dvec3& middle, const glm::dvec3& half,
  const glm::dvec3& direction, const glm::dvec3& up, const int size[2],
  ParallelRectangle& rectangle)
{
  const glm::dvec3 across = glm::cross(direction, up);
  const double area = glm::length(across);
  if (!IsFinite(direction) || !IsFinite(up) || !(area > 0.0) || !std::isfinite(area))
  {
    return "The direction of the rays and the direction upwards are parallel, zero or not finite";
  }
  const glm::dvec3 axes[3] = { across / area, glm::normalize(glm::cross(across, direction)),
    glm::normalize(direction) };
  double reach[3];
  for (int k = 0; k < 3; ++k)
  {
    reach[k] = glm::dot(glm::abs(axes[k]), half);
  }
  const double pixel = std::max(2.0 * reach[0] / size[0], 2.0 * reach[1] / size[1]);
  rectangle.Axis1 = pixel * size[0] * axes[0];
  rectangle.Axis2 = pixel * size[1] * axes[1];
  rectangle.Origin = middle - reach[2] * axes[2] - 0.5 * (rectangle.Axis1 + rectangle.Axis2);
  return std::string();
}

//------------------------------------------------------------------------------
std::string ComputeCameraView(
  vtkCamera* camera, const int size[2], const TetrahedralMesh& mesh, IntegralView& view)
{
  RayFrameInput input;
  input.WorldToView = ToGlm(camera->GetModelViewTransformMatrix());
  input.ViewToClip = ToGlm(camera->GetProjectionTransformMatrix(
    static_cast<double>(size[0]) / static_cast<double>(size[1]), -1.0, 1.0));
  const std::string error = ComputeView(input, size, mesh, view);
  if (error.empty())
  {
    const glm::dvec3 eye(glm::inverse(input.WorldToView) * glm::dvec4(0.0, 0.0, 0.0, 1.0));
    view.BeginDepth = view.MeasuredFrom = DepthOf(eye, view);
    view.Rays.NearDepth = view.BeginDepth;
  }
  return error;
}

//------------------------------------------------------------------------------
std::string ComputeParallelView(const ParallelRectangle& rectangle, const int size[2],
  const TetrahedralMesh& mesh, const std::vector<glm::dvec3>& others, IntegralView& view)
{
  const glm::dvec3 middle = rectangle.Origin + 0.5 * (rectangle.Axis1 + rectangle.Axis2);
  const glm::dvec3 depth = rectangle.GetDirection();
  const glm::dvec3 right = glm::normalize(rectangle.Axis1);
  const glm::dvec3 rows[3] = { right, glm::cross(right, depth), -depth };
  RayFrameInput input;
  input.ViewToClip[0][0] = 2.0 / glm::length(rectangle.Axis1);
  input.ViewToClip[1][1] = 2.0 / glm::length(rectangle.Axis2);
  input.ViewToClip[2][2] = -1.0;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      input.WorldToView[column][row] = rows[row][column];
    }
    input.WorldToView[3][row] = -glm::dot(rows[row], middle);
  }
  const std::string error = ComputeView(input, size, mesh, view);
  if (!error.empty())
  {
    return error;
  }
  view.MeasuredFrom = DepthOf(middle, view);
  // The mesh lies within depths of -1 and 1.
  double nearest = -1.0;
  for (const glm::dvec3& point : others)
  {
    nearest = std::min(nearest, DepthOf(point, view));
  }
  view.BeginDepth = nearest - 1.0;
  view.Rays.NearDepth = view.BeginDepth;
  return error;
}

}
