// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/ViewBounds.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{

//------------------------------------------------------------------------------
bool MayBeInView(vtkRenderer* renderer, const double bounds[6])
{
  double planes[24];
  renderer->GetActiveCamera()->GetFrustumPlanes(renderer->GetTiledAspectRatio(), planes);
  for (int p = 0; p < 6; ++p)
  {
    const double* plane = planes + 4 * p;
    bool beyond = true;
    for (int corner = 0; corner < 8 && beyond; ++corner)
    {
      const double height = plane[0] * bounds[corner & 1] +
        plane[1] * bounds[2 + (corner >> 1 & 1)] + plane[2] * bounds[4 + (corner >> 2 & 1)] +
        plane[3];
      beyond = height < 0.0;
    }
    if (beyond)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// The matrices are those of drawing, also in stereo. Fragments lie within a pixel of the corners'
// rectangle: shaders transform points in single precision.
vtkRecti FindPixels(vtkRenderer* renderer, const double bounds[6], const int (&size)[2])
{
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkNew<vtkMatrix4x4> toClip;
  vtkMatrix4x4::Multiply4x4(
    camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0),
    camera->GetModelViewTransformMatrix(), toClip);
  double low[2] = { std::numeric_limits<double>::max(), std::numeric_limits<double>::max() };
  double high[2] = { 0.0, 0.0 };
  for (int corner = 0; corner < 8; ++corner)
  {
    const double place[4] = { bounds[corner & 1], bounds[2 + (corner >> 1 & 1)],
      bounds[4 + (corner >> 2 & 1)], 1.0 };
    double clip[4];
    toClip->MultiplyPoint(place, clip);
    if (!(clip[3] > 0.0))
    {
      return { 0, 0, size[0], size[1] };
    }
    for (int axis = 0; axis < 2; ++axis)
    {
      const double pixel = 0.5 * (clip[axis] / clip[3] + 1.0) * size[axis];
      low[axis] = std::min(low[axis], std::clamp(pixel - 1.0, 0.0, double(size[axis])));
      high[axis] = std::max(high[axis], std::clamp(pixel + 1.0, 0.0, double(size[axis])));
    }
  }
  const int first[2] = { static_cast<int>(low[0]), static_cast<int>(low[1]) };
  return { first[0], first[1], static_cast<int>(std::ceil(high[0])) - first[0],
    static_cast<int>(std::ceil(high[1])) - first[1] };
}

//------------------------------------------------------------------------------
void HoldInClippingRange(vtkRenderer* renderer, const double bounds[6])
{
  if (!(bounds[0] <= bounds[1]))
  {
    return;
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  double position[3];
  double direction[3];
  double range[2];
  camera->GetPosition(position);
  camera->GetDirectionOfProjection(direction);
  camera->GetClippingRange(range);
  double nearest = std::numeric_limits<double>::max();
  double farthest = std::numeric_limits<double>::lowest();
  for (int corner = 0; corner < 8; ++corner)
  {
    const double depth = direction[0] * (bounds[corner & 1] - position[0]) +
      direction[1] * (bounds[2 + (corner >> 1 & 1)] - position[1]) +
      direction[2] * (bounds[4 + (corner >> 2 & 1)] - position[2]);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  // As in vtkRenderer::ResetCameraClippingRange: a small margin, and a limit on the near plane so
  // that the depth buffer's resolution is not spent close to the eye.
  constexpr double room = 0.01;
  constexpr double smallestRatio = 0.001;
  const double low = std::max((1.0 - room) * nearest, smallestRatio * farthest);
  const bool holds = range[0] <= std::max(nearest, low) && range[1] >= farthest;
  if (farthest > 0.0 && !holds)
  {
    camera->SetClippingRange(std::min(range[0], low), std::max(range[1], (1.0 + room) * farthest));
  }
}

}
