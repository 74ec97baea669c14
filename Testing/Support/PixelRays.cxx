// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelRays.h"
#include "VTKBasics.h"

namespace meniscus::test
{

//------------------------------------------------------------------------------
PixelRays::PixelRays(vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  double focus[3];
  double viewUp[3];
  camera->GetPosition(this->Position.data());
  camera->GetFocalPoint(focus);
  camera->GetViewUp(viewUp);
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Forward[axis] = focus[axis] - this->Position[axis];
  }
  vtkMath::Normalize(this->Forward.data());
  vtkMath::Cross(this->Forward.data(), viewUp, this->Right.data());
  vtkMath::Normalize(this->Right.data());
  vtkMath::Cross(this->Right.data(), this->Forward.data(), this->Up.data());

  renderer->GetTiledSizeAndOrigin(&this->Size[0], &this->Size[1], &this->Lower[0], &this->Lower[1]);
  this->Parallel = camera->GetParallelProjection() != 0;
  this->HalfHeight = this->Parallel
    ? camera->GetParallelScale()
    : std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
  this->HalfWidth = this->HalfHeight * renderer->GetTiledAspectRatio();
  camera->GetClippingRange(this->Clipping);
}

//------------------------------------------------------------------------------
reference::Ray PixelRays::RayAt(double x, double y) const
{
  const double right = this->HalfWidth * (2.0 * x / this->Size[0] - 1.0);
  const double up = this->HalfHeight * (2.0 * y / this->Size[1] - 1.0);
  reference::Ray ray{ this->Position, this->Forward, this->Clipping[0], this->Clipping[1] };
  reference::Vector3& shifted = this->Parallel ? ray.Origin : ray.Direction;
  for (int axis = 0; axis < 3; ++axis)
  {
    shifted[axis] += right * this->Right[axis] + up * this->Up[axis];
  }
  return ray;
}

} // namespace meniscus::test
