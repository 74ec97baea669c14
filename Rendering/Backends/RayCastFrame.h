// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/RayCastBackend.h"
#include "Rendering/Property/RayCastOptics.h"
#include "Volume/Rays/RayFrame.h"
#include "Volume/Refracted/RayLegs.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace meniscus
{

/** How an image gets into the framebuffer. */
struct RayCastOutput
{
  /** Rays of the image; fewer than the viewport's pixels are interpolated. */
  int ImageSize[2] = { 0, 0 };
  /** Box of pixels of the image outside of which no ray meets the mesh. */
  RayCastImageBox Meeting{ 0, 0, 0, 0 };
  /** Rays of a pixel along each axis, where its neighbours differ. */
  int RaysAcross = 1;
  /**
   * Whether a backend may interpolate rays between others that differ little: in images that
   * interaction makes coarse.
   */
  bool Interpolating = false;
  /** Still picture, which the application may give up. */
  bool MayStop = false;
  /** Hardware selection: a value where the image is visible, in place of its colour. */
  bool Selecting = false;
  glm::vec3 SelectionValue{ 0.0f };
  /** Bias of a picture that is composited later, in steps of 1/255. */
  float ColorBias = 0.0f;
};

/** Refraction of a frame's rays at a membrane. */
struct RayCastRefraction
{
  MembranePart Part = MembranePart::Whole;
  /** Whether there is a membrane that bends rays. */
  bool Wanted = false;
  /** Whether rays of this frame meet it; known when the frame is cast. */
  bool Met = false;
  /** Origin of the frame in world coordinates, and depth of the eye in the frame. */
  glm::dvec3 Center{ 0.0 };
  double EyeDepth = 0.0;
};

/** Opacity at which a ray ends, unless the application chooses another one. */
constexpr double DefaultTerminationOpacity = 1.0 - 1.0 / 131072.0;
/**
 * Opacity at which a ray ends in images that interaction makes coarse. The light behind that end is
 * lost: at most 1/512 of full scale, less than half a level of 8 bits (1/510).
 */
constexpr double CoarseTerminationOpacity = 1.0 - 1.0 / 512.0;

/** Parameters of a frame besides the tables. */
struct RayCastFrame
{
  RayFrame Rays;
  /**
   * Map from the model to clip coordinates, without their depth: the same for images of all sizes
   * and for all clipping ranges.
   */
  glm::dmat4 ModelToClip{ 1.0 };
  double EarlyTerminationOpacity = 1.0;
  /**
   * Transmittance at which a ray ends. Where so little is left, single precision has no digits to
   * lose.
   */
  double TerminationTransmittance() const
  {
    return std::max(1.0 - this->EarlyTerminationOpacity, 1.0e-30);
  }
  RayCastOptics Optics;
  RayCastRefraction Refracting;
  RayCastOutput Output;
  /** Texels that a table on the graphics device may have. */
  std::int64_t MaximumTableSize = std::numeric_limits<std::int64_t>::max();
  /** Modification time of the mapper; a new one makes the frame another one. */
  std::uint64_t SettingsTime = 0;
};

/**
 * True if two frames have the same image, given the same tables and opaque geometry. The way of the
 * image to the framebuffer may differ, and the clipping range, if it does not cut the mesh.
 */
bool HaveSameImage(const RayCastFrame& a, const RayCastFrame& b);

}
