// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The error of virtual vertices, as the thesis measures it (section 4.1): a point is taken through
 * the algorithm to its virtual vertex; the sight ray of that vertex is traced through the exact
 * surface, and Eq. 2.4 undone on the exact refraction ray. The distance from the point that this
 * gives to the one at the start is the error.
 */
#ifndef meniscus_Refraction_Curved_ErrorSamples_h
#define meniscus_Refraction_Curved_ErrorSamples_h

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"

#include <glm/vec3.hpp>

#include <cstddef>

namespace meniscus
{

/** The surface that a membrane's mesh stands for, in world coordinates. */
class ExactSurface
{
public:
  virtual ~ExactSurface() = default;

  /**
   * Where the ray from the eye along the unit vector `direction` meets the surface near
   * `vertex.sightPoint`, and the unit normal there, towards the eye's side. False if nowhere.
   */
  virtual bool Meet(const glm::dvec3& point, const VirtualVertex& vertex,
    const glm::dvec3& direction, PatchPoint& at) const = 0;
};

/** Curved patches as the exact surface: of the same mesh, or of a finer one. */
class PatchesAsSurface : public ExactSurface
{
public:
  /** `geometry` has the same eye and media as the one that is measured, and outlives this. */
  explicit PatchesAsSurface(const CurvedMembraneSolver& geometry)
    : Geometry(geometry)
  {
  }
  bool Meet(const glm::dvec3& point, const VirtualVertex& vertex, const glm::dvec3& direction,
    PatchPoint& at) const override;

private:
  const CurvedMembraneSolver& Geometry;
};

/** What became of a sample. */
enum class SampleState : unsigned char
{
  Measured = 0,
  NoImage = 1,       ///< the algorithm has none
  SeveralImages = 2, ///< a zone of convergence, or on the wall between two cells
  NoExactPoint = 3,  ///< the exact surface shows nothing there: missed, or total reflection
  NotFinite = 4      ///< the sample's coordinates are out of range
};

struct ErrorSample
{
  double Error = 0.0; ///< world length; of a measured sample only
  SampleState State = SampleState::NoImage;
};

struct ErrorSummary
{
  double Mean = 0.0;
  double Deviation = 0.0; ///< of the measured samples themselves, not an estimate for others
  double Largest = 0.0;
  std::size_t Count = 0; ///< measured samples
};

class ErrorSampler
{
public:
  /** Eye in the world, and media, that the geometries have. */
  ErrorSampler(const ExactSurface& exact, const glm::dvec3& eye, double exterior, double interior)
    : Exact(exact)
    , Optics{ eye, exterior, interior }
  {
  }

  /** With the thesis's cells: points in exactly one of them count. */
  ErrorSample Measure(const FlatMembraneSolver& geometry, const glm::dvec3& point) const;

  /** With curved patches: points with exactly one image count. */
  ErrorSample Measure(const CurvedMembraneSolver& geometry, const glm::dvec3& point) const;

private:
  ErrorSample Compare(const glm::dvec3& point, const VirtualVertex& vertex) const;

  const ExactSurface& Exact;
  Media Optics;
};

/**
 * In the order of the samples, in two passes: no cancellation, the same on any number of threads.
 */
ErrorSummary Summarize(const ErrorSample* samples, std::size_t count);

}

#endif
