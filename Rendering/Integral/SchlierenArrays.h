// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Images of vtkTetrahedraSchlieren: rays behind a medium, and arrays of instruments. */
#pragma once

#include "Rendering/Integral/IntegralView.h"
#include "Volume/Graded/EntryRaster.h"
#include "Volume/Graded/GradedRayWalk.h"
#include "Volume/Graded/SchlierenImages.h"

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

class vtkImageData;

namespace meniscus
{

/** Rays of an image's pixels in the mesh's units, and places in the image that they reach. */
/** Plane across the axis of a frame of rays, with the pixels of the rays in it. */
struct RayPlane
{
  double Depth = 0.0;
  /** Pixel of a place: Pixel + PerPlace * place. */
  glm::dvec2 Pixel{ 0.0 };
  glm::dmat2 PerPlace{ 1.0 };
};

class SchlierenRays
{
public:
  SchlierenRays(const IntegralView& view, const int size[2]);

  glm::dvec2 GetSlope(const glm::dvec2& pixel) const;
  glm::dvec3 GetOrigin(const glm::dvec2& pixel) const;
  glm::dvec3 GetDirection(const glm::dvec2& pixel) const;
  /** The rays as an image, which refers to this object. */
  RayImage GetImage() const;
  /** Depth in the frame at a distance in world coordinates behind a box about the centre. */
  double GetDepthBehind(const glm::dvec3& half, double distance) const;
  /** Change of a direction's slope from the pixel's ray; NaN for a ray that returns. */
  glm::dvec2 Deflect(const glm::dvec2& pixel, const glm::dvec3& direction) const;
  RayPlane GetPlane(double depth) const;
  /**
   * Pixel whose undisturbed ray reaches the place in a plane that this ray reaches; NaN for a ray
   * that returns.
   */
  glm::dvec2 Land(const GradedRayResult& ray, const RayPlane& plane) const;

private:
  glm::dmat2 GetSteps(double depth) const;
  glm::dvec2 Project(const glm::dvec3& place) const;

  const IntegralView& View;
  glm::ivec2 Size;
  glm::dmat3 ToFrame;
  glm::dmat3 FromFrame;
  glm::dvec2 Middle;
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
 * @param results of the image's rays, row by row.
 */
bool WriteImages(const SchlierenRays& rays, const std::vector<GradedRayResult>& results,
  const TetrahedralMesh& mesh, const Instruments& instruments, vtkImageData* output);

}
