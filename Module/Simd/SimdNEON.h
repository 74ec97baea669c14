// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Packets of 4 lanes for 64-bit ARM; see SimdPortable.h for the meaning of each name. */
#pragma once

#include <arm_neon.h>

#include <cstdint>

namespace meniscus
{

struct SimdNEON
{
  static constexpr int Width = 4;

  /** All bits of a lane are set, or none. */
  struct Mask
  {
    uint32x4_t Bits;
    friend Mask operator&(Mask a, Mask b) { return { vandq_u32(a.Bits, b.Bits) }; }
    friend Mask operator|(Mask a, Mask b) { return { vorrq_u32(a.Bits, b.Bits) }; }
  };

  struct Float
  {
    float32x4_t V;
    friend Float operator+(Float a, Float b) { return { vaddq_f32(a.V, b.V) }; }
    friend Float operator-(Float a, Float b) { return { vsubq_f32(a.V, b.V) }; }
    friend Float operator*(Float a, Float b) { return { vmulq_f32(a.V, b.V) }; }
    friend Float operator/(Float a, Float b) { return { vdivq_f32(a.V, b.V) }; }
    friend Mask operator<(Float a, Float b) { return { vcltq_f32(a.V, b.V) }; }
    friend Mask operator>(Float a, Float b) { return { vcgtq_f32(a.V, b.V) }; }
  };

  struct Int
  {
    int32x4_t V;
    friend Int operator+(Int a, Int b) { return { vaddq_s32(a.V, b.V) }; }
    friend Int operator-(Int a, Int b) { return { vsubq_s32(a.V, b.V) }; }
    friend Mask operator<(Int a, Int b) { return { vcltq_s32(a.V, b.V) }; }
    friend Mask operator>(Int a, Int b) { return { vcgtq_s32(a.V, b.V) }; }
  };

  static Float Load(const float* from) { return { vld1q_f32(from) }; }
  static Int Load(const std::int32_t* from) { return { vld1q_s32(from) }; }
  static void Store(float* to, Float x) { vst1q_f32(to, x.V); }
  static void Store(std::int32_t* to, Int x) { vst1q_s32(to, x.V); }
  static Float Splat(float value) { return { vdupq_n_f32(value) }; }
  static Int Splat(std::int32_t value) { return { vdupq_n_s32(value) }; }

  static Float Fma(Float a, Float b, Float c) { return { vfmaq_f32(c.V, a.V, b.V) }; }
  static Float SubtractProduct(Float a, Float b, Float c) { return { vfmsq_f32(a.V, b.V, c.V) }; }
  static Float CrossProduct(Float a, Float b, Float c, Float d)
  {
    const float32x4_t bc = vmulq_f32(b.V, c.V);
    const float32x4_t roundOff = vfmsq_f32(bc, b.V, c.V);
    return { vaddq_f32(vfmaq_f32(vnegq_f32(bc), a.V, d.V), roundOff) };
  }
  // vminq and vmaxq are not used: they return NaN if either argument is NaN.
  static Float Min(Float a, Float b) { return Select(a < b, a, b); }
  static Float Max(Float a, Float b) { return Select(a > b, a, b); }
  static Float Abs(Float a) { return { vabsq_f32(a.V) }; }
  static Float Sqrt(Float a) { return { vsqrtq_f32(a.V) }; }

  static Float Select(Mask mask, Float yes, Float no)
  {
    return { vbslq_f32(mask.Bits, yes.V, no.V) };
  }
  static Int Select(Mask mask, Int yes, Int no) { return { vbslq_s32(mask.Bits, yes.V, no.V) }; }
  static Int One(Mask mask) { return { vreinterpretq_s32_u32(vshrq_n_u32(mask.Bits, 31)) }; }
  static Mask AndNot(Mask a, Mask b) { return { vbicq_u32(a.Bits, b.Bits) }; }
  static Mask Not(Mask a) { return { vmvnq_u32(a.Bits) }; }
  static unsigned int Bits(Mask mask) { return vaddvq_u32(vandq_u32(mask.Bits, LaneBits())); }
  static Mask FromBits(unsigned int bits) { return { vtstq_u32(vdupq_n_u32(bits), LaneBits()) }; }

  static Int Increment(Mask mask, Int a)
  {
    return { vsubq_s32(a.V, vreinterpretq_s32_u32(mask.Bits)) };
  }
  static Int Decrement(Mask mask, Int a)
  {
    return { vaddq_s32(a.V, vreinterpretq_s32_u32(mask.Bits)) };
  }
  static Int And(Int a, Int b) { return { vandq_s32(a.V, b.V) }; }
  static Float ToFloat(Int a) { return { vcvtq_f32_s32(a.V) }; }
  static Int ToInt(Float a) { return { vcvtnq_s32_f32(a.V) }; }
  static Int ShiftRight(Int a, Int b)
  {
    return { vreinterpretq_s32_u32(vshlq_u32(vreinterpretq_u32_s32(a.V), vnegq_s32(b.V))) };
  }
  static Int LookupOf24(const std::int32_t (&table)[32], Int index)
  {
    return LoadFrom(table, index);
  }
  static Int LoadFrom(const std::int32_t* from, Int index)
  {
    std::int32_t at[Width];
    Store(at, index);
    for (std::int32_t& value : at)
    {
      value = from[static_cast<std::uint32_t>(value)];
    }
    return Load(at);
  }

  template <int Stride>
  static void GatherQuads(const float* from, Int index, Float& x, Float& y, Float& z, Float& w)
  {
    std::int32_t at[Width];
    Store(at, index);
    const auto row = [&](int i) { return vld1q_f32(from + std::int64_t{ Stride } * at[i]); };
    Transpose(row(0), row(1), row(2), row(3), x, y, z, w);
  }
  static void GatherTriples(const float* from, Int index, Float& x, Float& y, Float& z)
  {
    std::int32_t at[Width];
    Store(at, index);
    // No values beyond the third are read.
    const auto row = [&](int i)
    {
      const float* triple = from + std::int64_t{ 3 } * at[i];
      return vcombine_f32(vld1_f32(triple), vld1_dup_f32(triple + 2));
    };
    Float none;
    Transpose(row(0), row(1), row(2), row(3), x, y, z, none);
  }
  static void FollowPairs(const std::int32_t* pairs, Int index, Int& first, Int& second)
  {
    std::int32_t at[Width];
    Store(at, index);
    const auto pair = [&](int i)
    {
      const int32x2_t loaded = vld1_s32(pairs + std::int64_t{ 2 } * at[i]);
      const std::int32_t next = vget_lane_s32(loaded, 0);
      __builtin_prefetch(pairs + std::int64_t{ 2 } * (next < 0 ? 0 : next));
      return loaded;
    };
    const int32x4_t low = vcombine_s32(pair(0), pair(1));
    const int32x4_t high = vcombine_s32(pair(2), pair(3));
    first.V = vuzp1q_s32(low, high);
    second.V = vuzp2q_s32(low, high);
  }
  static Float GatherCellScalars(const float* scalars, Int cellFace)
  {
    return LoadLanes(scalars, { vshrq_n_s32(cellFace.V, 2) });
  }
  static constexpr int LookupBlock = 8;
  template <int Blocks>
  static Float Lookup(const float* table, Int index)
  {
    return LoadLanes(table, index);
  }
  static Int AsInt(Float a) { return { vreinterpretq_s32_f32(a.V) }; }

private:
  /** Lane i has bit i set. */
  static uint32x4_t LaneBits()
  {
    static const std::uint32_t bits[Width] = { 1, 2, 4, 8 };
    return vld1q_u32(bits);
  }

  /** from[index] for each lane. */
  static Float LoadLanes(const float* from, Int index)
  {
    std::int32_t at[Width];
    Store(at, index);
    const float lanes[Width] = { from[at[0]], from[at[1]], from[at[2]], from[at[3]] };
    return Load(lanes);
  }

  static void Transpose(float32x4_t r0, float32x4_t r1, float32x4_t r2, float32x4_t r3, Float& x,
    Float& y, Float& z, Float& w)
  {
    const auto wide = [](float32x4_t a) { return vreinterpretq_f64_f32(a); };
    const auto narrow = [](float64x2_t a) { return vreinterpretq_f32_f64(a); };
    const float32x4_t xz01 = vtrn1q_f32(r0, r1);
    const float32x4_t yw01 = vtrn2q_f32(r0, r1);
    const float32x4_t xz23 = vtrn1q_f32(r2, r3);
    const float32x4_t yw23 = vtrn2q_f32(r2, r3);
    x.V = narrow(vtrn1q_f64(wide(xz01), wide(xz23)));
    y.V = narrow(vtrn1q_f64(wide(yw01), wide(yw23)));
    z.V = narrow(vtrn2q_f64(wide(xz01), wide(xz23)));
    w.V = narrow(vtrn2q_f64(wide(yw01), wide(yw23)));
  }
};

}
