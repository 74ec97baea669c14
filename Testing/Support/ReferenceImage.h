// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PixelRays.h"
#include "ReferenceRayIntegrator.h"
#include "VolumeScene.h"

namespace meniscus::test
{

/**
 * Results of the reference for the pixels of a viewport, premultiplied, in rows from the bottom.
 */
struct ReferenceImage
{
  int Width = 0;
  int Height = 0;
  std::vector<std::array<double, 4>> Rgba;
  std::vector<char> Covered;
  reference::ReferenceTransferFunction Function;

  const std::array<double, 4>& GetPixel(int x, int y) const
  {
    return this->Rgba[static_cast<std::size_t>(y) * this->Width + x];
  }
};

/** The reference for a grid's active point scalars, in world coordinates (`matrix` may be null). */
std::unique_ptr<reference::ReferenceRayIntegrator> MakeReference(
  vtkUnstructuredGrid* grid, vtkMatrix4x4* matrix = nullptr);

/** Ray of a pixel (counted from the viewport's lower left corner); a scene may shorten it. */
using RayOfPixel = std::function<reference::Ray(int, int)>;

/**
 * Traces all pixels on all processors, for several transfer functions at once (cells are located
 * once). With a step, only pixels with x and y divisible by it are traced.
 */
std::vector<ReferenceImage> RenderReference(const reference::ReferenceRayIntegrator& integrator,
  int width, int height, const RayOfPixel& rayOf,
  const std::vector<reference::ReferenceTransferFunction>& functions);

/** Largest difference between image and reference that counts as equal in float. */
constexpr double FloatTolerance = 1e-4;

/**
 * Distance, relative to a mesh's diagonal, by which float rounding of the vertices moves the mesh:
 * 2^-24 of twice the half diagonal in each direction, and the same again from the ray's direction.
 */
constexpr double RoundingDistance = 1e-7;

/** Fraction of a mesh's covered pixels that may be excused as silhouettes before a test fails. */
constexpr double LargestSilhouetteShare = 1e-3;

struct Comparison
{
  double Largest = 0.0;               // over all pixels but silhouettes
  double Rms = 0.0;                   // over covered pixels but silhouettes
  std::size_t Covered = 0;            // pixels that the reference covers
  std::size_t Wrong = 0;              // error above the tolerance, not on a silhouette
  std::size_t BeyondRounding = 0;     // wrong, and by more than rounding of the vertices explains
  std::size_t Silhouettes = 0;        // error above the tolerance, on a silhouette
  std::size_t CoverageMismatches = 0; // drawn where the reference misses, silhouettes apart
  int WorstPixel[2] = { -1, -1 };
  std::array<double, 4> WorstImage{};
  std::array<double, 4> WorstReference{};
  // Change of the exact result at the worst pixel when its ray moves by RoundingDistance. Computed
  // for a wrong pixel only.
  double WorstSensitivity = 0.0;

  std::string GetText() const;
};

/** Compares a float image with the reference pixel by pixel. */
Comparison CompareToReference(const FloatImage& image, const ReferenceImage& truth,
  const reference::ReferenceRayIntegrator& integrator, const RayOfPixel& rayOf,
  double tolerance = FloatTolerance);

/**
 * As above, for an 8-bit image over an opaque background of whole grey levels, with a tolerance of
 * 1/255 plus the error of 8-bit blending over that background. A window may be larger than the
 * viewport, whose lower left corner is given.
 */
Comparison CompareToReference(const ByteImage& image, const ReferenceImage& truth,
  const reference::ReferenceRayIntegrator& integrator, const RayOfPixel& rayOf,
  const std::array<double, 3>& background, int left = 0, int bottom = 0);

} // namespace meniscus::test
