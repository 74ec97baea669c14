// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraLights.glsl (lights)
// Twin: Module/Volume/Optics/SurfaceLighting.cxx (lights)
#ifndef meniscus_Volume_Packet_Models_PacketLights_h
#define meniscus_Volume_Packet_Models_PacketLights_h

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
  PacketLit<Simd> Light(const Vector& normal, Float depth, const PacketLine<Simd>& ray) const
  {
    const Float one = Simd::Splat(1.0f);
    return this->LightBy(PacketUnshadowed(), normal, depth, ray, { one, one, one });
  }
  /**
   * The same with global illumination, see SurfaceLighting.
   * @param shadow the numbers of VertexLight at the place.
   */
  PacketLit<Simd> LightShadowed(
    const Vector& normal, Float depth, const PacketLine<Simd>& ray, const Vector& shadow) const
  {
    return this->LightBy(PacketShadowed(), normal, depth, ray, shadow);
  }

private:
  struct PacketUnshadowed
  {
    static constexpr bool Scatters = false;
  };
  struct PacketShadowed
  {
    static constexpr bool Scatters = true;
  };
  template <class Kind>
  PacketLit<Simd> LightBy(Kind, const Vector& normal, Float depth, const PacketLine<Simd>& ray,
    const Vector& shadow) const;
  /** Henyey and Greenstein's phase function, 1 in the mean; for the cosine of the turn of light. */
  Float Phase(Float cosine) const;

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
  static Vector Normalized(const Vector& a, Mask any, Float largest);
  static Float Reciprocal(Float x) { return Simd::Splat(1.0f) / x; }

  /**
   * Adds the light that a surface reflects, and the light that the medium scatters.
   * @param shadow transmittance from the light.
   */
  template <class Kind>
  void Add(Kind, const PacketLight& light, Float shadow, const Vector& place, const Vector& normal,
    const Vector& toEye, PacketLit<Simd>& sum, Vector& scattered) const;

  const GradientShading& Medium;
  PacketPower<Simd> SpecularPower;
  bool Positional = false;
};

//------------------------------------------------------------------------------
template <class Simd>
inline auto PacketLights<Simd>::Phase(Float cosine) const -> Float
{
  const float g = this->Medium.Anisotropy;
  const Float square =
    Simd::Max(Simd::Fma(Simd::Splat(-2.0f * g), cosine, Simd::Splat(1.0f + g * g)),
      Simd::Splat(SmallestTurn));
  return Simd::Splat(1.0f - g * g) / (square * Simd::Sqrt(square));
}

//------------------------------------------------------------------------------
template <class Simd>
template <class Kind>
inline void PacketLights<Simd>::Add(Kind, const PacketLight& light, Float shadow,
  const Vector& place, const Vector& normal, const Vector& toEye, PacketLit<Simd>& sum,
  Vector& scattered) const
{
  const Float zero = Simd::Splat(0.0f);
  const Float one = Simd::Splat(1.0f);
  Vector toLight = Splat(light.Position);
  Float strength = one;
  if (light.Position[3] != 0.0f)
  {
    for (int i = 0; i < 3; ++i)
    {
      toLight[i] = toLight[i] - place[i];
    }
    const Float distance = Simd::Sqrt(Dot(toLight, toLight));
    toLight = Scaled(toLight, Reciprocal(distance));
    const Float quadratic = Simd::Splat(light.Falloff[2]);
    strength =
      Reciprocal(Simd::Fma(distance, Simd::Fma(distance, quadratic, Simd::Splat(light.Falloff[1])),
        Simd::Splat(light.Falloff[0])));
    strength = Simd::Min(strength, Simd::Splat(LargestLightStrength));
  }
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
  if constexpr (Kind::Scatters)
  {
    strength = strength * shadow;
    // Light goes against toLight and on towards the eye.
    const Float turned =
      strength * Simd::Splat(this->Medium.Diffuse) * this->Phase(zero - Dot(toLight, toEye));
    for (int c = 0; c < 3; ++c)
    {
      scattered[c] = Simd::Fma(turned, Simd::Splat(light.Diffuse[c]), scattered[c]);
    }
  }
  strength = Simd::Select(facing > zero, strength, zero);
  const Vector mirrored = Scaled(normal, facing + facing);
  const Float glance =
    Cosine({ mirrored[0] - toLight[0], mirrored[1] - toLight[1], mirrored[2] - toLight[2] }, toEye);
  const Float diffuse = strength * Simd::Splat(this->Medium.Diffuse) * facing;
  const Float shine = Simd::Select(glance > zero,
    strength * Simd::Splat(this->Medium.Specular) * this->SpecularPower(glance), zero);
  for (int c = 0; c < 3; ++c)
  {
    sum.Reflected[c] = Simd::Fma(diffuse, Simd::Splat(light.Diffuse[c]), sum.Reflected[c]);
    sum.Highlight[c] = Simd::Fma(shine, Simd::Splat(light.Specular[c]), sum.Highlight[c]);
  }
}

//------------------------------------------------------------------------------
/**
 * Vectors of length 1; those that are not `any`, which are 0, have no meaning.
 * @param largest magnitude of the largest component.
 */
template <class Simd>
inline auto PacketLights<Simd>::Normalized(const Vector& a, Mask any, Float largest) -> Vector
{
  // Between these bounds the square of the length neither overflows nor loses digits; other vectors
  // are scaled first.
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

//------------------------------------------------------------------------------
template <class Simd>
template <class Kind>
PacketLit<Simd> PacketLights<Simd>::LightBy(Kind kind, const Vector& normal, Float depth,
  const PacketLine<Simd>& ray, const Vector& shadow) const
{
  const Float zero = Simd::Splat(0.0f);
  const Float one = Simd::Splat(1.0f);
  PacketLit<Simd> lit;
  const Float ambient = Simd::Splat(this->Medium.Ambient);
  lit.Reflected.fill(Kind::Scatters ? ambient * shadow[AmbientTransmittance] : ambient);
  lit.Highlight.fill(zero);

  const Float largest =
    Simd::Max(Simd::Abs(normal[0]), Simd::Max(Simd::Abs(normal[1]), Simd::Abs(normal[2])));
  const Mask any = largest > zero;
  Vector facing = Normalized(normal, any, largest);
  const Mask away = Dot(facing, ray.ToEye) < zero;
  facing = Scaled(facing, Simd::Select(away, zero - one, one));
  const Float fromPivot = depth * Simd::Splat(PacketVertex::DepthUnit);
  const Vector place = { Simd::Fma(fromPivot, ray.SlopeX, ray.X),
    Simd::Fma(fromPivot, ray.SlopeY, ray.Y), fromPivot + ray.Depth };
  PacketLit<Simd> sum = lit;
  Vector scattered = lit.Reflected;
  for (std::int32_t i = 0; i < this->Medium.NumberOfLights; ++i)
  {
    const bool isBrightest = i == this->Medium.BrightestLight;
    this->Add(kind, this->Medium.Lights[i],
      shadow[isBrightest ? BrightestTransmittance : OtherTransmittance], place, facing, ray.ToEye,
      sum, scattered);
  }
  for (int c = 0; c < 3; ++c)
  {
    lit.Reflected[c] = Simd::Select(any, sum.Reflected[c], lit.Reflected[c]);
    lit.Highlight[c] = Simd::Select(any, sum.Highlight[c], lit.Highlight[c]);
  }
  if constexpr (Kind::Scatters)
  {
    const Float share = Simd::Splat(this->Medium.Scattering);
    for (int c = 0; c < 3; ++c)
    {
      lit.Reflected[c] = Simd::Fma(share, scattered[c] - lit.Reflected[c], lit.Reflected[c]);
      lit.Highlight[c] = Simd::Fma(zero - share, lit.Highlight[c], lit.Highlight[c]);
    }
  }
  return lit;
}

}

#endif
