// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraComposite.glsl (integral of a medium)
#pragma once

#include "Volume/Optics/MediumConstants.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/BlendedColor.h"
#include "Volume/Packet/Models/PacketExponential.h"
#include "Volume/Packet/Models/PacketGradientShading.h"
#include "Volume/Packet/Models/PacketIntervals.h"

#include <cstddef>
#include <cstdint>

namespace meniscus
{

/**
 * The density-emitter integral along rays, front to back, over segments whose scalar is linear: dC
 * = attenuation * color * T ds, dT = -attenuation * T ds. One ray per lane.
 *
 * A segment is split at the transfer function's points and into parts of optical depth <= 1. For a
 * part with linear attenuation and colour, K. Moreland and E. Angel, "A Fast High Accuracy Volume
 * Renderer for Unstructured Data" (2004), give cf - cb zeta + (cb - cf) psi; it is written
 * cf (1 - psi) + cb (psi - zeta), free of cancellation, with psi by a polynomial (AbsorptionFit).
 *
 * Medium defines the effect of gradients: PacketNoGradientShading or PacketGradientShading; with
 * PacketFadedMedium around it, parts are of optical depth <= 1/2 and integrated by Gauss' rule of
 * three points.
 */
template <class Simd, class Medium = PacketNoGradientShading<Simd>>
class CompositeModel : public BlendedColor<Simd>
{
public:
  using Float = typename Simd::Float;
  using Int = typename Simd::Int;
  using Mask = typename Simd::Mask;

  explicit CompositeModel(const PacketJob& job);

  /**
   * Gives a segment to each of `lanes`; returns the lanes with a segment to integrate. Segments
   * without length, or with a scalar that is not finite, are skipped.
   */
  template <class Place>
  Mask Begin(Mask lanes, Float from, Float to, Float length, const Place& place)
  {
    const Mask valid = SegmentsOf<Simd>(lanes, from, to, length);
    this->From = Simd::Select(valid, from, this->From);
    this->To = Simd::Select(valid, to, this->To);
    this->Remaining = Simd::Select(valid, length, this->Remaining);
    if constexpr (Medium::UsesGradients)
    {
      this->Ahead = Simd::Select(valid, Simd::Splat(1.0f), this->Ahead);
    }
    this->Optics.Begin(valid, place);
    return valid;
  }
  /** Called when the rays of some lanes enter the mesh, or come back into it. */
  void Enter(Mask lanes) { this->Optics.Enter(lanes); }

  /**
   * Integrates one part of the segments of `lanes`; returns the lanes that have more. Always
   * inlined, although there are many variants: a call would cost 6 % of a frame's instructions.
   */
  [[gnu::always_inline]] Mask Advance(Mask lanes)
  {
    const auto& fields = this->Intervals.GetFields();
    const Mask outside = lanes & ((this->From < fields.Lower) | (this->From > fields.Upper));
    if (Simd::Bits(outside) != 0)
    {
      this->Intervals.Find(outside, this->From);
    }
    Part part = this->FindPart();
    if (Simd::Bits(part.Thick) != 0)
    {
      this->ShortenThick(part);
    }
    if constexpr (Medium::Fades)
    {
      this->AddFadedPart(part);
    }
    else
    {
      this->AddPart(part);
    }
    const Mask more = lanes & (part.Upward | part.Downward | part.Thick) &
      (this->Transmittance > this->Termination);
    this->Remaining = Simd::Select(more, this->Remaining - part.Length, Simd::Splat(0.0f));
    this->From = part.To;
    this->Intervals.Move(part.Upward, part.Downward);
    return more;
  }

  /** Requirements of Begin() on its place (PacketWalk::SegmentPlace). */
  static constexpr int NumberOfTriples = Medium::NumberOfTriples;
  static constexpr bool UsesCellGradients = Medium::UsesCellGradients;
  static constexpr bool UsesLines = Medium::UsesGradients;

private:
  /** AbsorptionFit in all lanes. */
  struct Coefficients
  {
    Float ThinAbsorbed[4];
    Float ThinMean[4][3];
    Float ThickAbsorbed[7];
    Float ThickMean[6][5];
  };

  /** Part of the segments that is integrated at once. */
  struct Part
  {
    /** Scalar at the end. */
    Float To;
    /** Fraction of the remaining segment, and length. */
    Float Share;
    Float Length;
    /** Attenuation at both ends times the length, and the mean of these: the optical depth. */
    Float Density;
    Float DensityTo;
    Float Depth;
    /**
     * Lanes whose segment goes on above or below the interval; lanes whose part is shortened,
     * because of its depth or of the medium in front of it.
     */
    Mask Upward;
    Mask Downward;
    Mask Thick;
    /** Fraction of the part that may be integrated at once; used if the medium fades. */
    Float Limit;
  };

  /**
   * Part of the segments inside the interval. If the scalar does not change, the share is 0 / 0,
   * which Min() replaces by 1; lanes without a segment get a finite value.
   */
  [[gnu::always_inline]] Part FindPart() const
  {
    const Float zero = Simd::Splat(0.0f);
    const Float one = Simd::Splat(1.0f);
    const auto& fields = this->Intervals.GetFields();
    Part part;
    part.Upward = this->To > fields.Upper;
    part.Downward = this->To < fields.Lower;
    part.To = Simd::Min(Simd::Max(this->To, fields.Lower), fields.Upper);
    part.Share = (part.To - this->From) / (this->To - this->From);
    part.Share = Simd::Max(Simd::Min(part.Share, one), zero);
    part.Length = part.Share * this->Remaining;
    const auto densityAt = [&](Float fromLower)
    {
      return part.Length *
        Simd::Max(Simd::Fma(fromLower, fields.AttenuationSlope, fields.Attenuation), zero);
    };
    const Float done = one - this->Ahead;
    part.Density = this->Optics.ApplyGradientOpacity(densityAt(this->From - fields.Lower), done);
    part.DensityTo = this->Optics.ApplyGradientOpacity(
      densityAt(part.To - fields.Lower), Simd::Fma(part.Share, this->Ahead, done));
    part.Depth = Simd::Splat(0.5f) * (part.Density + part.DensityTo);
    part.Thick = part.Depth > Simd::Splat(LargestPartDepth);
    if constexpr (Medium::Fades)
    {
      part.Limit = this->Optics.LimitPart(done, Simd::Fma(part.Share, this->Ahead, done));
      part.Thick = part.Thick | (part.Limit < one);
    }
    return part;
  }

  /** Shortens the thick parts to the largest optical depth. */
  [[gnu::always_inline]] void ShortenThick(Part& part) const
  {
    // share (density + share (densityTo - density) / 2) = D, the root without cancellation.
    const Float zero = Simd::Splat(0.0f);
    const Float one = Simd::Splat(1.0f);
    const Float largest = Simd::Splat(LargestDepth);
    const Float density = Simd::Min(part.Density, largest);
    const Float change = Simd::Min(part.DensityTo, largest) - density;
    const Float twice =
      LargestPartDepth == 1.0f ? change + change : Simd::Splat(2.0f * LargestPartDepth) * change;
    const Float root = Simd::Sqrt(Simd::Max(Simd::Fma(density, density, twice), zero));
    Float share = Simd::Select(
      part.Thick, Simd::Min(Simd::Splat(2.0f * LargestPartDepth) / (density + root), one), one);
    if constexpr (Medium::Fades)
    {
      share = Simd::Min(share, Simd::Select(part.Thick, part.Limit, one));
    }
    part.To = Simd::Select(part.Thick, Simd::Fma(share, part.To - this->From, this->From), part.To);
    part.Length = part.Length * share;
    part.Share = part.Share * share;
    part.Density = density * share;
    if constexpr (Medium::Fades)
    {
      part.DensityTo = share * Simd::Fma(share, change, density);
      part.Depth = Simd::Splat(0.5f) * (part.Density + part.DensityTo);
    }
    else
    {
      part.Depth = Simd::Min(part.Depth, one);
    }
    part.Upward = Simd::AndNot(part.Upward, part.Thick);
    part.Downward = Simd::AndNot(part.Downward, part.Thick);
  }

  /** Adds the light of a part to the colour, and its absorption to the transmittance. */
  [[gnu::always_inline]] void AddPart(const Part& part)
  {
    const auto& fields = this->Intervals.GetFields();
    Float gone;
    Float mean;
    this->Absorb(part.Depth, part.Density, gone, mean);
    const Float weight = this->Transmittance * gone;
    Float weightOfChange = this->Transmittance * Simd::Max(gone - mean, Simd::Splat(0.0f));
    const Float offset = this->From - fields.Lower;
    Float color[3];
    Float change[3];
    for (int channel = 0; channel < 3; ++channel)
    {
      change[channel] = fields.ColorSlope[channel];
      color[channel] = Simd::Fma(offset, change[channel], fields.Color[channel]);
    }
    if constexpr (Medium::UsesGradients)
    {
      const Float done = Simd::Splat(1.0f) - this->Ahead;
      Float colorTo[3];
      for (int channel = 0; channel < 3; ++channel)
      {
        colorTo[channel] = Simd::Fma(part.To - this->From, change[channel], color[channel]);
      }
      this->Optics.Shade(color, done);
      this->Optics.Shade(colorTo, Simd::Fma(part.Share, this->Ahead, done));
      for (int channel = 0; channel < 3; ++channel)
      {
        change[channel] = colorTo[channel] - color[channel];
      }
      this->Ahead = this->Ahead - part.Share * this->Ahead;
    }
    else
    {
      weightOfChange = weightOfChange * (part.To - this->From);
    }
    for (int channel = 0; channel < 3; ++channel)
    {
      this->Color[channel] = Simd::Fma(
        weightOfChange, change[channel], Simd::Fma(weight, color[channel], this->Color[channel]));
    }
    this->Transmittance = this->Transmittance - weight;
  }

  /** The same behind a medium that fades the light, by Gauss' rule of three points. */
  void AddFadedPart(const Part& part)
  {
    const auto& fields = this->Intervals.GetFields();
    const Float one = Simd::Splat(1.0f);
    const Float slope = part.DensityTo - part.Density;
    const Float done = one - this->Ahead;
    constexpr float places[3] = { 0.5f - GaussPlace, 0.5f, 0.5f + GaussPlace };
    constexpr float weights[3] = { GaussWeights[0], GaussWeights[1], GaussWeights[0] };
    for (int q = 0; q < 3; ++q)
    {
      const Float at = Simd::Splat(places[q]);
      const Float doneHere = Simd::Fma(at * part.Share, this->Ahead, done);
      const Float offset = Simd::Fma(at, part.To - this->From, this->From) - fields.Lower;
      Float emission[3];
      for (int channel = 0; channel < 3; ++channel)
      {
        emission[channel] = Simd::Fma(offset, fields.ColorSlope[channel], fields.Color[channel]);
      }
      this->Optics.Shade(emission, doneHere);
      this->Optics.Fade(one, emission, doneHere);
      const Float before = at * Simd::Fma(Simd::Splat(0.5f) * at, slope, part.Density);
      const Float weight = Simd::Splat(weights[q]) * this->Transmittance *
        Simd::Fma(at, slope, part.Density) * (one - Absorbed<Simd>(Simd::Min(before, one)));
      for (int channel = 0; channel < 3; ++channel)
      {
        this->Color[channel] = Simd::Fma(weight, emission[channel], this->Color[channel]);
      }
    }
    this->Ahead = this->Ahead - part.Share * this->Ahead;
    this->Transmittance =
      this->Transmittance - this->Transmittance * Absorbed<Simd>(Simd::Min(part.Depth, one));
  }
  /** Largest optical depth of a part. */
  static constexpr float LargestPartDepth = Medium::Fades ? LargestGaussDepth : 1.0f;

  /** Horner's scheme with the first `terms` coefficients. */
  template <std::size_t Size>
  static Float Polynomial(Float x, const Float (&coefficients)[Size], int terms = Size)
  {
    Float sum = coefficients[terms - 1];
    for (int i = terms - 2; i >= 0; --i)
    {
      sum = Simd::Fma(x, sum, coefficients[i]);
    }
    return sum;
  }

  void Absorb(Float depth, Float density, Float& gone, Float& mean) const
  {
    const auto& fit = this->Fit;
    if (Simd::Bits(depth > Simd::Splat(0.125f)) == 0)
    {
      gone = depth * Polynomial(depth, fit.ThinAbsorbed);
      const Float p1 = Polynomial(depth, fit.ThinMean[1]);
      const Float p2 = Polynomial(depth, fit.ThinMean[2], 2);
      const Float byDensity = Simd::Fma(density, Simd::Fma(density, fit.ThinMean[3][0], p2), p1);
      mean = Simd::Fma(density, byDensity, depth * Polynomial(depth, fit.ThinMean[0]));
      return;
    }
    gone = depth * Polynomial(depth, fit.ThickAbsorbed);
    Float byDensity = fit.ThickMean[5][0];
    byDensity = Simd::Fma(density, byDensity, Polynomial(depth, fit.ThickMean[4], 2));
    byDensity = Simd::Fma(density, byDensity, Polynomial(depth, fit.ThickMean[3], 3));
    byDensity = Simd::Fma(density, byDensity, Polynomial(depth, fit.ThickMean[2], 4));
    byDensity = Simd::Fma(density, byDensity, Polynomial(depth, fit.ThickMean[1]));
    mean = Simd::Fma(density, byDensity, depth * Polynomial(depth, fit.ThickMean[0]));
  }
  void SetCoefficients();

  PacketIntervals<Simd> Intervals;
  Float From;
  Float To;
  /** Length still to be integrated; 0 if there is none. */
  Float Remaining;
  /** The same as a fraction of the segment; used with gradients only. */
  Float Ahead;
  Coefficients Fit;
  Medium Optics;
};

//------------------------------------------------------------------------------
template <class Simd, class Medium>
CompositeModel<Simd, Medium>::CompositeModel(const PacketJob& job)
  : BlendedColor<Simd>(Simd::Splat(job.TerminationTransmittance))
  , Intervals(job.Intervals, job.NumberOfIntervals)
  , From(Simd::Splat(0.0f))
  , To(Simd::Splat(0.0f))
  , Remaining(Simd::Splat(0.0f))
  , Ahead(Simd::Splat(0.0f))
  , Optics(job)
{
  this->SetCoefficients();
}

//------------------------------------------------------------------------------
template <class Simd, class Medium>
void CompositeModel<Simd, Medium>::SetCoefficients()
{
  const auto splat = [](const float* from, Float* to, int count)
  {
    for (int i = 0; i < count; ++i)
    {
      to[i] = Simd::Splat(from[i]);
    }
  };
  splat(AbsorptionFit::ThinAbsorbed, this->Fit.ThinAbsorbed, 4);
  splat(AbsorptionFit::ThinMean[0], this->Fit.ThinMean[0], 12);
  splat(AbsorptionFit::ThickAbsorbed, this->Fit.ThickAbsorbed, 7);
  splat(AbsorptionFit::ThickMean[0], this->Fit.ThickMean[0], 30);
}

}
