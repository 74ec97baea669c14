// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraFading.glsl (light that a medium takes and scatters)
#pragma once

#include "Volume/Optics/MediumConstants.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/PacketExponential.h"

#include <cstdint>

namespace meniscus
{

/**
 * Fading of the light that a volume emits, on its way through the medium in front of it
 * (RefractionMedium): a colour c at a path length d is seen as s c + (1 - s) M, with the medium's
 * colour M and the share s of d. Added to Inner, the effect of gradients.
 */
template <class Simd, class Inner>
class PacketFadedMedium : public Inner
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  /** Models keep the place in the segment, as for gradients. */
  static constexpr bool UsesGradients = true;
  static constexpr bool Fades = true;

  explicit PacketFadedMedium(const PacketJob& job)
    : Inner(job)
    , Job(job)
    , Path(Simd::Splat(0.0f))
    , Way(Simd::Splat(0.0f))
  {
  }

  /** Starts new segments for `lanes`. */
  template <class Place>
  void Begin(Mask lanes, const Place& place)
  {
    Inner::Begin(lanes, place);
    float paths[Simd::Width];
    float lengths[Simd::Width];
    for (int lane = 0; lane < Simd::Width; ++lane)
    {
      const std::int32_t ray = place.Rays[lane];
      paths[lane] = ray >= 0 ? this->Job.PathsAtPivot[ray] : 0.0f;
      lengths[lane] = ray >= 0 ? this->Job.Rays[ray].LengthPerDepth : 0.0f;
    }
    const Float zero = Simd::Splat(0.0f);
    const Float perDepth = Simd::Load(lengths);
    const Float path = Simd::Max(Simd::Fma(place.StartDepth, perDepth, Simd::Load(paths)), zero);
    this->Path = Simd::Select(lanes, path, this->Path);
    this->Way = Simd::Select(lanes, (place.EndDepth - place.StartDepth) * perDepth, this->Way);
  }

  /**
   * Fraction of the part of the segment between two fractions of it that may be integrated at once:
   * up to an attenuation of LargestFadedDepth in every channel that can be seen, or to a bend of
   * the linear share. 1 if the ends of the part ahead are equal in single precision.
   */
  Float LimitPart(Float from, Float to) const
  {
    const Float one = Simd::Splat(1.0f);
    const Float path = Simd::Fma(from, this->Way, this->Path);
    const Float share = to - from;
    const Float way = share * this->Way;
    const Float limit = Simd::Min(
      this->Job.Fading->IsLinear ? this->LimitLinear(path, way) : this->LimitExponential(path, way),
      one);
    return Simd::Select(limit * share < Simd::Splat(SmallestPart), one, limit);
  }

  /** Fades a density times a colour that is emitted at a fraction of the segment. */
  void Fade(Float density, Float (&emission)[3], Float done) const
  {
    const PacketFading& fading = *this->Job.Fading;
    const Float path = Simd::Fma(done, this->Way, this->Path);
    Float share = Simd::Splat(1.0f);
    if (fading.IsLinear)
    {
      share = this->ShareOfLinear(path);
    }
    for (int channel = 0; channel < 3; ++channel)
    {
      if (!fading.IsLinear)
      {
        share =
          Simd::Splat(1.0f) - AbsorbedAll<Simd>(path * Simd::Splat(fading.Attenuation[channel]));
      }
      const Float scattered = density * Simd::Splat(fading.Color[channel]);
      emission[channel] = Simd::Fma(share, emission[channel] - scattered, scattered);
    }
  }

private:
  Float LimitExponential(Float path, Float way) const
  {
    const Float zero = Simd::Splat(0.0f);
    Float largest = zero;
    for (const float attenuation : this->Job.Fading->Attenuation)
    {
      const Float coefficient = Simd::Splat(attenuation);
      const Mask seen = coefficient * path < Simd::Splat(InvisibleDepth);
      largest = Simd::Max(largest, Simd::Select(seen, coefficient, zero));
    }
    return Simd::Splat(LargestFadedDepth) / Simd::Max(largest * way, Simd::Splat(1.0e-30f));
  }

  Float LimitLinear(Float path, Float way) const
  {
    const Float one = Simd::Splat(1.0f);
    Float limit = one;
    for (const float bend : this->Job.Fading->Range)
    {
      const Float ahead = Simd::Splat(bend) - path;
      const Mask between = (ahead > Simd::Splat(0.0f)) & (ahead < way);
      limit = Simd::Min(limit, Simd::Select(between, ahead / way, one));
    }
    return limit;
  }

  Float ShareOfLinear(Float path) const
  {
    const float(&range)[2] = this->Job.Fading->Range;
    const Float zero = Simd::Splat(0.0f);
    const Float one = Simd::Splat(1.0f);
    const Float ahead = Simd::Splat(range[1]) - path;
    if (range[1] > range[0])
    {
      return Simd::Min(Simd::Max(ahead * Simd::Splat(1.0f / (range[1] - range[0])), zero), one);
    }
    return Simd::Select(ahead > zero, one, zero);
  }

  /** Fraction of a segment below which a part makes no progress in floats. */
  static constexpr float SmallestPart = 1.0f / 4194304.0f;

  const PacketJob& Job;
  /** Way through the medium up to the start of the segment, and along the segment. */
  Float Path;
  Float Way;
};

}
