// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeView.h"
#include "VTKBasics.h"

namespace meniscus::test
{

//------------------------------------------------------------------------------
VolumeView VolumeView::Towards(
  const double bounds[6], const glm::dvec3& direction, bool parallel, double zoom)
{
  const glm::dvec3 low(bounds[0], bounds[2], bounds[4]);
  const glm::dvec3 high(bounds[1], bounds[3], bounds[5]);
  const double radius = 0.5 * glm::distance(low, high);
  // From a distance of 3.8 radii, half the height at unit depth is the tangent of 15 degrees.
  const double distance = radius / std::sin(vtkMath::RadiansFromDegrees(15.0));
  VolumeView view;
  view.Focus = 0.5 * (low + high);
  view.Eye = view.Focus - distance * glm::normalize(direction);
  view.Up = std::fabs(glm::normalize(direction).y) > 0.9 ? glm::dvec3(0.0, 0.0, 1.0)
                                                         : glm::dvec3(0.0, 1.0, 0.0);
  view.Parallel = parallel;
  view.HalfHeight = (parallel ? radius : std::tan(vtkMath::RadiansFromDegrees(15.0))) / zoom;
  view.Near = distance - 1.1 * radius;
  view.Far = distance + 1.1 * radius;
  return view;
}

//------------------------------------------------------------------------------
VolumeView::Axes VolumeView::GetAxes() const
{
  Axes axes;
  axes.Forward = glm::normalize(this->Focus - this->Eye);
  axes.Right = glm::normalize(glm::cross(axes.Forward, this->Up));
  axes.Up = glm::cross(axes.Right, axes.Forward);
  return axes;
}

//------------------------------------------------------------------------------
reference::Ray VolumeView::GetRay(int x, int y, int size) const
{
  const Axes a = this->GetAxes();
  const double u = this->HalfHeight * (2.0 * (x + 0.5) / size - 1.0);
  const double v = this->HalfHeight * (2.0 * (y + 0.5) / size - 1.0);
  const glm::dvec3 sideways = u * a.Right + v * a.Up;
  const glm::dvec3 origin = this->Parallel ? this->Eye + sideways : this->Eye;
  const glm::dvec3 direction = this->Parallel ? a.Forward : a.Forward + sideways;
  reference::Ray ray;
  std::copy_n(&origin[0], 3, ray.Origin.begin());
  std::copy_n(&direction[0], 3, ray.Direction.begin());
  ray.Begin = this->Near;
  ray.End = this->Far;
  return ray;
}

//------------------------------------------------------------------------------
void VolumeView::ApplyTo(vtkRenderer* renderer) const
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(&this->Eye[0]);
  camera->SetFocalPoint(&this->Focus[0]);
  camera->SetViewUp(&this->Up[0]);
  camera->SetParallelProjection(this->Parallel);
  if (this->Parallel)
  {
    camera->SetParallelScale(this->HalfHeight);
  }
  else
  {
    camera->SetViewAngle(vtkMath::DegreesFromRadians(2.0 * std::atan(this->HalfHeight)));
  }
  camera->SetClippingRange(this->Near, this->Far);
}

} // namespace meniscus::test
