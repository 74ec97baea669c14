// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Images of vtkTetrahedraSchlieren: rays behind a medium, and arrays of instruments. */
#pragma once

#include "Rendering/Integral/IntegralView.h"
#include "Volume/Graded/GradedRayWalk.h"
#include "Volume/Graded/RayImage.h"
#include "Volume/Graded/SchlierenImages.h"

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

class vtkImageData;

namespace meniscus
{

/**
 * Light behind a medium of a pixel whose ray has met it, whatever the instruments. Lengths are in
 * units of the mesh's radius.
 */
struct LightBehind
{
  /** Slope in the frame of the rays; NaN for a ray that returns. */
  glm::dvec2 Slope{ 0.0 };
  /** Place in the frame at which a ray with this slope is at the depth 0. */
  glm::dvec2 Place{ 0.0 };
  /** Integral of n along the path in the mesh, and the length of the path along the pixel's ray. */
  double OpticalPath = 0.0;
  double Length = 0.0;
};

/** Plane across the axis of a frame of rays, with the pixels of the rays in it. */
struct RayPlane
{
  double Depth = 0.0;
  /** Pixel of a place: Pixel + PerPlace * place. */
  glm::dvec2 Pixel{ 0.0 };
  glm::dmat2 PerPlace{ 1.0 };

  /** Pixel whose undisturbed ray reaches the same place; NaN for a ray that returns. */
  glm::dvec2 Meet(const LightBehind& light) const
  {
    return this->Pixel + this->PerPlace * (light.Place + this->Depth * light.Slope);
  }
};

/** Rays of an image's pixels in the mesh's units, and places in the image that they reach. */
class SchlierenRays
{
public:
  SchlierenRays(const IntegralView& view, const int size[2]);

  glm::dvec3 GetOrigin(const glm::dvec2& pixel) const { return this->Image.GetOrigin(pixel); }
  glm::dvec3 GetDirection(const glm::dvec2& pixel) const { return this->Image.GetDirection(pixel); }
  const RayImage& GetImage() const { return this->Image; }
  /** Depth in the frame at a distance in world coordinates behind a box about the centre. */
  double GetDepthBehind(const glm::dvec3& half, double distance) const;
  RayPlane GetPlane(double depth) const;
  LightBehind Measure(const glm::dvec2& pixel, const GradedRayResult& ray) const;

private:
  const IntegralView& View;
  RayImage Image;
};

/** Light of all pixels behind a medium, row by row. */
struct LightOfImage
{
  std::vector<GradedRayState> States;
  /** Without meaning for the rays that have missed the medium. */
  std::vector<LightBehind> Behind;
};

/** Instruments behind a medium. Lengths are in world coordinates. */
struct Instruments
{
  /** Index that optical path differences are relative to. */
  double ReferenceIndex = 1.0;
  /** Distances of the shadowgraph's screen and of the background behind the mesh's box. */
  double ScreenDistance = 1.0;
  double BackgroundDistance = 1.0;
  /** A range of 0 stands for twice the largest deflection along the knife. */
  KnifeEdge Knife;
  Interferometer Meter;
  /** Picture behind the mesh; null for none. */
  vtkImageData* Background = nullptr;
};

/**
 * Adds the arrays of all instruments to an image. Returns false if the knife cuts off all light.
 * @param shadows memory that is used again.
 */
bool WriteImages(const SchlierenRays& rays, const LightOfImage& light, const TetrahedralMesh& mesh,
  const Instruments& instruments, Shadowgraph& shadows, vtkImageData* output);

}
