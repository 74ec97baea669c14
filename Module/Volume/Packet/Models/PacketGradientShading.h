// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraMedium.glsl (light and opacity by gradients)
#pragma once

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/PacketIntervals.h"
#include "Volume/Packet/Models/PacketLights.h"

#include <array>

namespace meniscus
{

/** A medium without effects of gradients: its functions compile to nothing. */
template <class Simd>
class PacketNoGradientShading
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  static constexpr bool UsesGradients = false;
  static constexpr bool Fades = false;
  static constexpr bool UsesCellGradients = false;
  /** Number of vectors per vertex that it uses, the first of the interpolated values. */
  static constexpr int NumberOfTriples = 0;

  explicit PacketNoGradientShading(const PacketJob&) {}

  void Enter(Mask) {}
  template <class Place>
  void Begin(Mask, const Place&)
  {
  }
  Float ApplyGradientOpacity(Float density, Float) const { return density; }
  void Shade(Float (&)[3], Float) const {}
};

/**
 * Effects of gradients on the segments of composite blending: light that multiplies the colour,
 * light that is added to it, and a factor of the attenuation; computed at the ends of a segment and
 * linear in between. Gradients are interpolated between vertices, or constant in each cell. With
 * Shadowed, the transmittances of PacketJob::VertexLight weaken the light.
 */
template <class Simd, bool OfVertices, bool Shadowed = false>
class PacketGradientShading
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  static constexpr bool UsesGradients = true;
  static constexpr bool Fades = false;
  static constexpr bool UsesCellGradients = !OfVertices;
  static constexpr int NumberOfTriples = (OfVertices ? 1 : 0) + (Shadowed ? 1 : 0);

  explicit PacketGradientShading(const PacketJob& job)
    : Medium(*job.Medium)
    , Lights(*job.Medium)
    , Opacity(job.Medium->NumberOfOpacityIntervals > 0 ? job.Medium->Opacity : job.Intervals,
        job.Medium->NumberOfOpacityIntervals > 0 ? job.Medium->NumberOfOpacityIntervals : 1)
    , Continues(Simd::FromBits(0))
  {
    this->Front.SetNeutral();
    this->Back.SetNeutral();
  }

  /**
   * Called when the rays of some lanes enter the mesh: the next segment does not continue the last
   * one.
   */
  void Enter(Mask lanes) { this->Continues = Simd::AndNot(this->Continues, lanes); }

  /** Starts new segments for `lanes`, a subset of the lanes that made a step. */
  template <class Place>
  void Begin(Mask lanes, const Place& place)
  {
    if (Simd::Bits(lanes) == 0)
    {
      this->Continues = Simd::AndNot(this->Continues, place.Stepped);
      return;
    }
    if constexpr (OfVertices)
    {
      this->Front.Replace(lanes, this->Back);
      const Mask elsewhere = lanes & (Simd::Not(this->Continues) | place.Late);
      if (Simd::Bits(elsewhere) != 0)
      {
        this->Evaluate(elsewhere, this->ToFrame(place.StartValues), place.StartValues,
          place.StartDepth, place.Ray, this->Front);
      }
      this->Evaluate(lanes, this->ToFrame(place.EndValues), place.EndValues, place.EndDepth,
        place.Ray, this->Back);
      this->Continues = Simd::AndNot(this->Continues, place.Stepped) | lanes;
    }
    else
    {
      const Vector gradient = this->ToFrame(place.CellGradient);
      this->SetOpacity(lanes, gradient, this->Front);
      this->Back.Opacity = Simd::Select(lanes, this->Front.Opacity, this->Back.Opacity);
      if (this->Medium.Shading)
      {
        this->LightCell(lanes, gradient, place);
      }
    }
  }

  /** Density of the medium at a fraction of the segment. */
  Float ApplyGradientOpacity(Float density, Float done) const
  {
    return density * Simd::Fma(done, this->Back.Opacity - this->Front.Opacity, this->Front.Opacity);
  }
  /** Lights a colour that is emitted at a fraction of the segment. */
  void Shade(Float (&color)[3], Float done) const
  {
    if (!this->Medium.Shading)
    {
      return;
    }
    const auto mix = [done](Float from, Float to) { return Simd::Fma(done, to - from, from); };
    for (int c = 0; c < 3; ++c)
    {
      color[c] =
        Simd::Fma(color[c], mix(this->Front.Light.Reflected[c], this->Back.Light.Reflected[c]),
          mix(this->Front.Light.Highlight[c], this->Back.Light.Highlight[c]));
    }
  }

private:
  using Vector = std::array<Float, 3>;

  /** Effects at one end of the segments. */
  struct End
  {
    PacketLit<Simd> Light;
    Float Opacity;

    void SetNeutral()
    {
      this->Light.Reflected.fill(Simd::Splat(1.0f));
      this->Light.Highlight.fill(Simd::Splat(0.0f));
      this->Opacity = Simd::Splat(1.0f);
    }
    void Replace(Mask lanes, const End& by)
    {
      this->ReplaceLight(lanes, by.Light);
      this->Opacity = Simd::Select(lanes, by.Opacity, this->Opacity);
    }
    void ReplaceLight(Mask lanes, const PacketLit<Simd>& by)
    {
      for (int c = 0; c < 3; ++c)
      {
        Float& reflected = this->Light.Reflected[c];
        Float& highlight = this->Light.Highlight[c];
        reflected = Simd::Select(lanes, by.Reflected[c], reflected);
        highlight = Simd::Select(lanes, by.Highlight[c], highlight);
      }
    }
  };

  // Results are written where they are used: copies cost as much as the interpolation of values.

  /** Effects of a gradient in `lanes` of an end of the segments. */
  template <class Values, class Line>
  void Evaluate(Mask lanes, const Vector& gradient, const Values& values, Float depth,
    const Line& ray, End& end)
  {
    if (this->Medium.Shading)
    {
      end.ReplaceLight(lanes, this->Light(gradient, values, depth, ray));
    }
    this->SetOpacity(lanes, gradient, end);
  }

  void SetOpacity(Mask lanes, const Vector& gradient, End& end)
  {
    if (this->Medium.NumberOfOpacityIntervals == 0)
    {
      return;
    }
    const Float square = Simd::Fma(
      gradient[0], gradient[0], Simd::Fma(gradient[1], gradient[1], gradient[2] * gradient[2]));
    const Float size = Simd::Splat(this->Medium.GradientMagnitude) * Simd::Sqrt(square);
    const auto& fields = this->Opacity.GetFields();
    const Mask outside = lanes & ((size < fields.Lower) | (size > fields.Upper));
    if (Simd::Bits(outside) != 0)
    {
      this->Opacity.Find(outside, size);
    }
    const Float opacity =
      Simd::Max(Simd::Fma(size - fields.Lower, fields.AttenuationSlope, fields.Attenuation),
        Simd::Splat(0.0f));
    end.Opacity = Simd::Select(lanes, opacity, end.Opacity);
  }
  /** @param values interpolated at the place; their last triple is the light. */
  template <class Values, class Line>
  PacketLit<Simd> Light(
    const Vector& gradient, const Values& values, Float depth, const Line& ray) const
  {
    if constexpr (Shadowed)
    {
      return this->Lights.LightInParts(gradient, depth, ray).Attenuate(ShadowOf(values));
    }
    else
    {
      return this->Lights.Light(gradient, depth, ray);
    }
  }

  /** Lights both ends of segments with the same gradient. */
  template <class Place>
  void LightCell(Mask lanes, const Vector& gradient, const Place& place)
  {
    if (this->Lights.DependOnPlace())
    {
      this->Front.ReplaceLight(
        lanes, this->Light(gradient, place.StartValues, place.StartDepth, place.Ray));
      this->Back.ReplaceLight(
        lanes, this->Light(gradient, place.EndValues, place.EndDepth, place.Ray));
    }
    else if constexpr (Shadowed)
    {
      const PacketLitParts<Simd> parts =
        this->Lights.LightInParts(gradient, place.StartDepth, place.Ray);
      this->Front.ReplaceLight(lanes, parts.Attenuate(ShadowOf(place.StartValues)));
      this->Back.ReplaceLight(lanes, parts.Attenuate(ShadowOf(place.EndValues)));
    }
    else
    {
      const PacketLit<Simd> lit =
        this->Light(gradient, place.StartValues, place.StartDepth, place.Ray);
      this->Front.ReplaceLight(lanes, lit);
      this->Back.ReplaceLight(lanes, lit);
    }
  }

  /** Transmittances of the lights among the values at a place. */
  template <class Values>
  static Vector ShadowOf(const Values& values)
  {
    constexpr int first = OfVertices ? 3 : 0;
    return { values.Of[first + AmbientTransmittance], values.Of[first + BrightestTransmittance],
      values.Of[first + OtherTransmittance] };
  }

  template <class Values>
  Vector ToFrame(const Values& values) const
  {
    Vector gradient;
    for (int row = 0; row < 3; ++row)
    {
      const float(&matrix)[3] = this->Medium.GradientToFrame[row];
      gradient[row] = Simd::Fma(Simd::Splat(matrix[0]), values.Of[0],
        Simd::Fma(Simd::Splat(matrix[1]), values.Of[1], Simd::Splat(matrix[2]) * values.Of[2]));
    }
    return gradient;
  }

  const GradientShading& Medium;
  PacketLights<Simd> Lights;
  PacketIntervals<Simd> Opacity;
  End Front;
  End Back;
  /** Lanes whose next segment begins where the last one ended, with the same gradient. */
  Mask Continues;
};

}
