// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraLights.glsl (lights)
// Twin: Module/Volume/Optics/SurfaceLighting.cxx (lights)
#pragma once

#include "Volume/Optics/MediumConstants.h"
#include "Volume/Packet/Data/PacketOptics.h"
#include "Volume/Packet/Data/PacketRays.h"

#include <array>
#include <cstdint>

namespace meniscus
{

/**
 * x^y for x in [0, 1], by lane; 0^0 = 1. Integer exponents are computed by squaring, with an error
 * of about y 2^-24.
 */
template <class Simd>
class PacketPower
{
public:
  using Float = typename Simd::Float;

  explicit PacketPower(float exponent)
    : Exponent(exponent)
    , Whole(exponent >= 0.0f && exponent <= LargestWhole &&
        exponent == static_cast<float>(static_cast<std::int32_t>(exponent)))
  {
  }

  Float operator()(Float x) const
  {
    if (this->Whole)
    {
      Float result = Simd::Splat(1.0f);
      for (auto left = static_cast<std::int32_t>(this->Exponent); left > 0; left /= 2)
      {
        result = left % 2 != 0 ? result * x : result;
        x = x * x;
      }
      return result;
    }
    float lanes[Simd::Width];
    Simd::Store(lanes, x);
    for (float& lane : lanes)
    {
      lane = __builtin_powf(lane, this->Exponent);
    }
    return Simd::Load(lanes);
  }

private:
  /** For larger exponents, the general function is as fast. */
  static constexpr float LargestWhole = 1024.0f;

  float Exponent;
  bool Whole;
};

/** Effect of light on a colour: it is multiplied by Reflected, then Highlight is added. */
template <class Simd>
struct PacketLit
{
  std::array<typename Simd::Float, 3> Reflected;
  std::array<typename Simd::Float, 3> Highlight;
};

/**
 * Light with global illumination as a function of the numbers of VertexLight, in which it is
 * linear: the ambient light, and the light of the brightest lamp and of the others, all for
 * transmittances of 1.
 */
template <class Simd>
struct PacketLitParts
{
  typename Simd::Float Ambient;
  PacketLit<Simd> Brightest;
  PacketLit<Simd> Others;
  /** False if the others are 0. */
  bool HasOthers;

  /** @param shadow the numbers of VertexLight at the place. */
  PacketLit<Simd> Attenuate(const std::array<typename Simd::Float, 3>& shadow) const
  {
    PacketLit<Simd> lit;
    for (int c = 0; c < 3; ++c)
    {
      lit.Reflected[c] = Simd::Fma(shadow[BrightestTransmittance], this->Brightest.Reflected[c],
        this->Ambient * shadow[AmbientTransmittance]);
      lit.Highlight[c] = shadow[BrightestTransmittance] * this->Brightest.Highlight[c];
    }
    for (int c = 0; this->HasOthers && c < 3; ++c)
    {
      const typename Simd::Float other = shadow[OtherTransmittance];
      lit.Reflected[c] = Simd::Fma(other, this->Others.Reflected[c], lit.Reflected[c]);
      lit.Highlight[c] = Simd::Fma(other, this->Others.Highlight[c], lit.Highlight[c]);
    }
    return lit;
  }
};

/**
 * A ray per lane in its frame: (X, Y, Depth) at the pivot, the change of X and Y per depth, and the
 * unit vector towards the eye.
 */
template <class Simd>
struct PacketLine
{
  typename Simd::Float X;
  typename Simd::Float Y;
  typename Simd::Float Depth;
  typename Simd::Float SlopeX;
  typename Simd::Float SlopeY;
  std::array<typename Simd::Float, 3> ToEye;
};

/** Single-precision version of Light() of SurfaceLighting.h, for one place per lane. */
template <class Simd>
class PacketLights
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;
  using Vector = std::array<Float, 3>;

  explicit PacketLights(const GradientShading& medium)
    : Medium(medium)
    , SpecularPower(medium.SpecularPower)
  {
    for (std::int32_t i = 0; i < medium.NumberOfLights; ++i)
    {
      this->Positional = this->Positional || medium.Lights[i].Position[3] != 0.0f;
    }
  }

  /** True if the result depends on the position of a normal on the ray. */
  bool DependOnPlace() const { return this->Positional; }

  /**
   * Light on a surface with a normal of any length, in the frame; 0 leaves the ambient light only.
   */
  PacketLit<Simd> Light(const Vector& normal, Float depth, const PacketLine<Simd>& ray) const;
  /** The same with global illumination, see SurfaceLighting. */
  PacketLitParts<Simd> LightInParts(
    const Vector& normal, Float depth, const PacketLine<Simd>& ray) const;

private:
  /** A place on each ray, and the normal there that faces the eye. */
  struct Surface
  {
    Vector Place;
    Vector Normal;
    /** Lanes with a normal. */
    Mask Any;
  };

  Surface SurfaceAt(const Vector& normal, Float depth, const PacketLine<Simd>& ray) const
  {
    const Float zero = Simd::Splat(0.0f);
    const Float one = Simd::Splat(1.0f);
    const Float largest =
      Simd::Max(Simd::Abs(normal[0]), Simd::Max(Simd::Abs(normal[1]), Simd::Abs(normal[2])));
    Surface surface;
    surface.Any = largest > zero;
    const Vector facing = Normalized(normal, surface.Any, largest);
    const Mask away = Dot(facing, ray.ToEye) < zero;
    surface.Normal = Scaled(facing, Simd::Select(away, zero - one, one));
    const Float fromPivot = depth * Simd::Splat(PacketVertex::DepthUnit);
    surface.Place = { Simd::Fma(fromPivot, ray.SlopeX, ray.X),
      Simd::Fma(fromPivot, ray.SlopeY, ray.Y), fromPivot + ray.Depth };
    return surface;
  }

  /** Henyey and Greenstein's phase function, 1 in the mean; for the cosine of the turn of light. */
  Float Phase(Float cosine) const
  {
    const float g = this->Medium.Anisotropy;
    const Float square =
      Simd::Max(Simd::Fma(Simd::Splat(-2.0f * g), cosine, Simd::Splat(1.0f + g * g)),
        Simd::Splat(SmallestTurn));
    return Simd::Splat(1.0f - g * g) / (square * Simd::Sqrt(square));
  }

  static Float Dot(const Vector& a, const Vector& b)
  {
    return Simd::Fma(a[0], b[0], Simd::Fma(a[1], b[1], a[2] * b[2]));
  }
  /**
   * Clamps a cosine to [0, 1]: powers of one that rounding carried beyond 1 would overflow. The
   * cosine of a direction that does not exist, NaN, becomes 0.
   */
  static Float Clamped(Float cosine)
  {
    return Simd::Min(Simd::Max(cosine, Simd::Splat(0.0f)), Simd::Splat(1.0f));
  }
  static Float Cosine(const Vector& a, const Vector& b) { return Clamped(Dot(a, b)); }
  static Vector Scaled(const Vector& a, Float by) { return { a[0] * by, a[1] * by, a[2] * by }; }
  static Vector Splat(const float* of)
  {
    return { Simd::Splat(of[0]), Simd::Splat(of[1]), Simd::Splat(of[2]) };
  }

  /**
   * Vectors of length 1; those that are not `any`, which are 0, have no meaning.
   * @param largest magnitude of the largest component.
   */
  static Vector Normalized(const Vector& a, Mask any, Float largest)
  {
    // Between these bounds the square of the length neither overflows nor loses digits; other
    // vectors are scaled first.
    const Float one = Simd::Splat(1.0f);
    const Mask tiny = largest < Simd::Splat(9.094947017729282e-13f); // 2^-40
    const Mask huge = largest > Simd::Splat(1.099511627776e+12f);    // 2^40
    const Mask extreme = any & (tiny | huge);
    Vector safe = a;
    if (Simd::Bits(extreme) != 0)
    {
      safe = Scaled(a, Simd::Select(extreme, Reciprocal(Simd::Select(any, largest, one)), one));
    }
    return Scaled(safe, Reciprocal(Simd::Sqrt(Simd::Select(any, Dot(safe, safe), one))));
  }
  static Float Reciprocal(Float x) { return Simd::Splat(1.0f) / x; }

  /**
   * Adds the light that a surface reflects, and the light that the medium scatters.
   * @param scattered null if none is wanted.
   */
  void Add(const PacketLight& light, const Surface& surface, const Vector& toEye,
    PacketLit<Simd>& sum, Vector* scattered) const
  {
    const Float zero = Simd::Splat(0.0f);
    const Float one = Simd::Splat(1.0f);
    Vector toLight = Splat(light.Position);
    Float strength = one;
    if (light.Position[3] != 0.0f)
    {
      for (int i = 0; i < 3; ++i)
      {
        toLight[i] = toLight[i] - surface.Place[i];
      }
      const Float distance = Simd::Sqrt(Dot(toLight, toLight));
      toLight = Scaled(toLight, Reciprocal(distance));
      const Float quadratic = Simd::Splat(light.Falloff[2]);
      strength = Reciprocal(
        Simd::Fma(distance, Simd::Fma(distance, quadratic, Simd::Splat(light.Falloff[1])),
          Simd::Splat(light.Falloff[0])));
      strength = Simd::Min(strength, Simd::Splat(LargestLightStrength));
    }
    const Vector& normal = surface.Normal;
    const Float facing = Cosine(normal, toLight);
    if (light.Cone[3] >= -1.0f)
    {
      const Float inCone = zero - Dot(toLight, Splat(light.Cone));
      if (light.Falloff[3] != 0.0f)
      {
        strength = strength * PacketPower<Simd>(light.Falloff[3])(Clamped(inCone));
      }
      strength = Simd::Select(inCone < Simd::Splat(light.Cone[3]), zero, strength);
    }
    if (scattered)
    {
      // Light goes against toLight and on towards the eye.
      Float turned = strength * Simd::Splat(this->Medium.Diffuse);
      if (this->Medium.Anisotropy != 0.0f)
      {
        turned = turned * this->Phase(zero - Dot(toLight, toEye));
      }
      for (int c = 0; c < 3; ++c)
      {
        (*scattered)[c] = Simd::Fma(turned, Simd::Splat(light.Diffuse[c]), (*scattered)[c]);
      }
    }
    strength = Simd::Select(facing > zero, strength, zero);
    const Vector mirrored = Scaled(normal, facing + facing);
    const Float glance = Cosine(
      { mirrored[0] - toLight[0], mirrored[1] - toLight[1], mirrored[2] - toLight[2] }, toEye);
    const Float diffuse = strength * Simd::Splat(this->Medium.Diffuse) * facing;
    const Float shine = Simd::Select(glance > zero,
      strength * Simd::Splat(this->Medium.Specular) * this->SpecularPower(glance), zero);
    for (int c = 0; c < 3; ++c)
    {
      sum.Reflected[c] = Simd::Fma(diffuse, Simd::Splat(light.Diffuse[c]), sum.Reflected[c]);
      sum.Highlight[c] = Simd::Fma(shine, Simd::Splat(light.Specular[c]), sum.Highlight[c]);
    }
  }

  const GradientShading& Medium;
  PacketPower<Simd> SpecularPower;
  bool Positional = false;
};

//------------------------------------------------------------------------------
template <class Simd>
PacketLit<Simd> PacketLights<Simd>::Light(
  const Vector& normal, Float depth, const PacketLine<Simd>& ray) const
{
  const Float zero = Simd::Splat(0.0f);
  PacketLit<Simd> lit;
  lit.Reflected.fill(Simd::Splat(this->Medium.Ambient));
  lit.Highlight.fill(zero);
  const Surface surface = this->SurfaceAt(normal, depth, ray);
  PacketLit<Simd> sum = lit;
  for (std::int32_t i = 0; i < this->Medium.NumberOfLights; ++i)
  {
    this->Add(this->Medium.Lights[i], surface, ray.ToEye, sum, nullptr);
  }
  for (int c = 0; c < 3; ++c)
  {
    lit.Reflected[c] = Simd::Select(surface.Any, sum.Reflected[c], lit.Reflected[c]);
    lit.Highlight[c] = Simd::Select(surface.Any, sum.Highlight[c], lit.Highlight[c]);
  }
  return lit;
}

//------------------------------------------------------------------------------
template <class Simd>
PacketLitParts<Simd> PacketLights<Simd>::LightInParts(
  const Vector& normal, Float depth, const PacketLine<Simd>& ray) const
{
  const Float zero = Simd::Splat(0.0f);
  const Surface surface = this->SurfaceAt(normal, depth, ray);
  PacketLitParts<Simd> parts;
  parts.Ambient = Simd::Splat(this->Medium.Ambient);
  parts.HasOthers = this->Medium.NumberOfLights > 1;
  PacketLit<Simd>* const sums[2] = { &parts.Brightest, &parts.Others };
  Vector scattered[2];
  for (int part = 0; part < 2; ++part)
  {
    sums[part]->Reflected.fill(zero);
    sums[part]->Highlight.fill(zero);
    scattered[part].fill(zero);
  }
  const bool scatters = this->Medium.Scattering > 0.0f;
  for (std::int32_t i = 0; i < this->Medium.NumberOfLights; ++i)
  {
    const int part = i == this->Medium.BrightestLight ? 0 : 1;
    this->Add(this->Medium.Lights[i], surface, ray.ToEye, *sums[part],
      scatters ? &scattered[part] : nullptr);
  }
  const Float share = Simd::Splat(this->Medium.Scattering);
  for (int part = 0; part < (parts.HasOthers ? 2 : 1); ++part)
  {
    for (int c = 0; c < 3; ++c)
    {
      Float& reflected = sums[part]->Reflected[c];
      Float& highlight = sums[part]->Highlight[c];
      reflected = Simd::Select(surface.Any, reflected, zero);
      highlight = Simd::Select(surface.Any, highlight, zero);
      if (scatters)
      {
        reflected = Simd::Fma(share, scattered[part][c] - reflected, reflected);
        highlight = Simd::Fma(zero - share, highlight, highlight);
      }
    }
  }
  return parts;
}

}
