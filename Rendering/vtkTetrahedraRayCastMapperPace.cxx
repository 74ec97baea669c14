// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Distances of rays of vtkTetrahedraRayCastMapper, by the time that a frame may take.
#include "vtkTetrahedraRayCastMapper.h"

#include "Rendering/RayCastMapperInternals.h"

#include "vtkVolume.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::vtkInternals::IsStill(vtkVolume* volume)
{
  constexpr double stillTime = 1.0;
  const double allocated = volume->GetAllocatedRenderTime();
  return allocated <= 0.0 || allocated >= stillTime;
}

//------------------------------------------------------------------------------
double vtkTetrahedraRayCastMapper::ChooseImageSampleDistance(vtkVolume* volume)
{
  if (!this->AutoAdjustSampleDistances)
  {
    return this->ImageSampleDistance;
  }
  if (this->ImageSampleDistance < 1.0f && vtkInternals::IsStill(volume))
  {
    return this->ImageSampleDistance;
  }
  const double allocated = volume->GetAllocatedRenderTime();
  if (!(allocated > 0.0 && this->Internals->AllRaysTime > allocated))
  {
    return 1.0;
  }
  // The time is proportional to the number of rays, the inverse square of the distance.
  const double distance = std::sqrt(std::max(this->Internals->FullImageTime / allocated, 1.0));
  return std::min(distance, static_cast<double>(this->MaximumImageSampleDistance));
}

//------------------------------------------------------------------------------
/**
 * True for images that interaction makes coarse: their rays are some pixels apart, or one per pixel
 * if not all of these can be cast in time.
 */
bool vtkTetrahedraRayCastMapper::IsCoarse(vtkVolume* volume, double sampleDistance)
{
  const bool castsAllRays = vtkInternals::IsStill(volume) ||
    !(this->MaximumImageSampleDistance > 1.0f) ||
    this->Internals->AllRaysTime <= volume->GetAllocatedRenderTime();
  return this->AutoAdjustSampleDistances && (sampleDistance > 1.0 || !castsAllRays);
}

//------------------------------------------------------------------------------
/**
 * Time of a frame with one ray per pixel, as a share of the time of the last frame.
 * @param casts number of casts before it.
 */
double vtkTetrahedraRayCastMapper::GetShareOfOneRay(vtkTypeInt64 casts)
{
  const double distance = this->UsedImageSampleDistance;
  if (distance >= 1.0)
  {
    return distance * distance;
  }
  const vtkTypeInt64 images = this->Internals->GetNumberOfCasts() - casts;
  if (images > 1)
  {
    return 1.0 / static_cast<double>(images);
  }
  // One image, of which some pixels have several rays.
  const meniscus::RayCastStatistics statistics = this->Internals->GetStatistics();
  const double steps = static_cast<double>(std::max<std::int64_t>(statistics.Steps, 1));
  return 1.0 - static_cast<double>(statistics.RefiningSteps) / steps;
}
