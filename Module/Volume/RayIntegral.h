// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_RayIntegral_h
#define meniscus_Volume_RayIntegral_h

#include "Volume/TransferFunction.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace meniscus
{

/**
 * The density-emitter integral along a ray, front to back, over segments whose scalar is linear:
 * dC = attenuation * color * T ds, dT = -attenuation * T ds.
 *
 * A segment is split at the transfer function's points and into parts of optical depth <= 1. For a
 * part with linear attenuation and colour, K. Moreland and E. Angel, "A Fast High Accuracy Volume
 * Renderer for Unstructured Data" (2004), give cf - cb zeta + (cb - cf) psi; it is written
 * cf (1 - psi) + cb (psi - zeta), free of cancellation, with psi by a polynomial of the optical
 * depth and the density at the front (error below 3e-7).
 */
class RayIntegral
{
public:
  /**
   * @param intervals  from BuildIntervals(); must outlive this.
   * @param terminationTransmittance  the integral stops when the transmittance is not above it.
   */
  RayIntegral(
    const std::vector<TransferFunctionInterval>& intervals, float terminationTransmittance);

  /** Adds a segment. One with a scalar that is not finite, or of no length, adds nothing. */
  void AddSegment(float scalar0, float scalar1, float length);

  bool IsTerminated() const { return !(this->Transmittance > this->TerminationTransmittance); }
  /** Premultiplied. */
  const glm::vec3& GetColor() const { return this->Color; }
  float GetTransmittance() const { return this->Transmittance; }

private:
  void FindInterval(float scalar);
  float AddPart(const TransferFunctionInterval& interval, float from, float to, float length);

  const std::vector<TransferFunctionInterval>& Intervals;
  float TerminationTransmittance;
  glm::vec3 Color{ 0.0f };
  float Transmittance = 1.0f;
  std::size_t Current = 0;
};

}

#endif
