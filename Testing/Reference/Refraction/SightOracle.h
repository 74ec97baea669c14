// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * All sight points on a smooth surface, by an interval Newton method in double precision,
 * independently of the kernel's patches, trees and searches.
 *
 * The equation is Snell's law along the surface, F = (h.tx, h.tz) with h = n1 |p| a - n2 |a| p, a =
 * S - eye, p = point - S, tx = (1, fx, 0), tz = (0, fz, 1). Boxes of (x, z) are divided until the
 * mean value form or a Newton step proves that there is no root, or the derivative over the box
 * proves that there is at most one.
 *
 * The membrane under test is a mesh, whose surface differs from the smooth one. Its error is given
 * and widens every test: an image is `certain` if every surface within that error has exactly one
 * image within `radius` of it. Everything else (near caustics, borders, the critical angle, the
 * point's own place) lies in `uncertain` boxes.
 */
#pragma once

#include "SmoothSurface.h"

#include <glm/vec3.hpp>

#include <vector>

namespace meniscus::reference
{

/**
 * Largest distance of a mesh's surface from the smooth one, and of its unit normals from those of
 * the smooth one. The first also covers rounding of eye and point.
 */
struct SurfaceError
{
  double Position = 0.0;
  double Normal = 0.0;
};

struct OracleImage
{
  glm::dvec3 Sight;
  double Radius;
  int Orientation; ///< +1, or -1 where the image is mirrored
};

/** A box in x and z in which there may be any number of images. */
struct OracleBox
{
  double X;
  double Z;
  double Half;
};

struct OracleAnswer
{
  std::vector<OracleImage> Images;
  std::vector<OracleBox> Uncertain;
  bool Complete = true; ///< false: abandoned after too many boxes

  bool IsUncertain(double x, double z, double slack) const;
};

class SightOracle
{
public:
  SightOracle(const SmoothSurface& surface, const glm::dvec3& eye, double exterior, double interior,
    const SurfaceError& error)
    : Surface(surface)
    , Eye(eye)
    , Exterior(exterior)
    , Interior(interior)
    , Error(error)
  {
  }

  OracleAnswer Find(const glm::dvec3& point) const;

private:
  class Search;

  const SmoothSurface& Surface;
  glm::dvec3 Eye;
  double Exterior;
  double Interior;
  SurfaceError Error;
};

}
