// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace meniscus
{

/**
 * Packets of twice as many lanes as an instruction set has. A step of a ray is a chain of dependent
 * instructions and loads; a processor works on two of them at the same time.
 *
 * The first half of the lanes is in the member First. See SimdPortable.h for the meaning of the
 * other names.
 */
template <class Half>
struct SimdPair
{
  static constexpr int Width = 2 * Half::Width;

  struct Mask
  {
    typename Half::Mask First;
    typename Half::Mask Second;
    friend Mask operator&(Mask a, Mask b) { return { a.First & b.First, a.Second & b.Second }; }
    friend Mask operator|(Mask a, Mask b) { return { a.First | b.First, a.Second | b.Second }; }
  };

  struct Float
  {
    typename Half::Float First;
    typename Half::Float Second;
    friend Float operator+(Float a, Float b) { return { a.First + b.First, a.Second + b.Second }; }
    friend Float operator-(Float a, Float b) { return { a.First - b.First, a.Second - b.Second }; }
    friend Float operator*(Float a, Float b) { return { a.First * b.First, a.Second * b.Second }; }
    friend Float operator/(Float a, Float b) { return { a.First / b.First, a.Second / b.Second }; }
    friend Mask operator<(Float a, Float b) { return { a.First < b.First, a.Second < b.Second }; }
    friend Mask operator>(Float a, Float b) { return { a.First > b.First, a.Second > b.Second }; }
  };

  struct Int
  {
    typename Half::Int First;
    typename Half::Int Second;
    friend Int operator+(Int a, Int b) { return { a.First + b.First, a.Second + b.Second }; }
    friend Int operator-(Int a, Int b) { return { a.First - b.First, a.Second - b.Second }; }
    friend Mask operator<(Int a, Int b) { return { a.First < b.First, a.Second < b.Second }; }
    friend Mask operator>(Int a, Int b) { return { a.First > b.First, a.Second > b.Second }; }
  };

  static Float Load(const float* from)
  {
    return { Half::Load(from), Half::Load(from + Half::Width) };
  }
  static Int Load(const std::int32_t* from)
  {
    return { Half::Load(from), Half::Load(from + Half::Width) };
  }
  static void Store(float* to, Float x)
  {
    Half::Store(to, x.First);
    Half::Store(to + Half::Width, x.Second);
  }
  static void Store(std::int32_t* to, Int x)
  {
    Half::Store(to, x.First);
    Half::Store(to + Half::Width, x.Second);
  }
  static Float Splat(float value) { return { Half::Splat(value), Half::Splat(value) }; }
  static Int Splat(std::int32_t value) { return { Half::Splat(value), Half::Splat(value) }; }
  static Float Fma(Float a, Float b, Float c)
  {
    return { Half::Fma(a.First, b.First, c.First), Half::Fma(a.Second, b.Second, c.Second) };
  }
  static Float SubtractProduct(Float a, Float b, Float c)
  {
    return { Half::SubtractProduct(a.First, b.First, c.First),
      Half::SubtractProduct(a.Second, b.Second, c.Second) };
  }
  static Float CrossProduct(Float a, Float b, Float c, Float d)
  {
    return { Half::CrossProduct(a.First, b.First, c.First, d.First),
      Half::CrossProduct(a.Second, b.Second, c.Second, d.Second) };
  }
  static Float Min(Float a, Float b)
  {
    return { Half::Min(a.First, b.First), Half::Min(a.Second, b.Second) };
  }
  static Float Max(Float a, Float b)
  {
    return { Half::Max(a.First, b.First), Half::Max(a.Second, b.Second) };
  }
  static Float Abs(Float a) { return { Half::Abs(a.First), Half::Abs(a.Second) }; }
  static Float Sqrt(Float a) { return { Half::Sqrt(a.First), Half::Sqrt(a.Second) }; }
  static Float Select(Mask mask, Float yes, Float no)
  {
    return { Half::Select(mask.First, yes.First, no.First),
      Half::Select(mask.Second, yes.Second, no.Second) };
  }
  static Int Select(Mask mask, Int yes, Int no)
  {
    return { Half::Select(mask.First, yes.First, no.First),
      Half::Select(mask.Second, yes.Second, no.Second) };
  }
  static Int One(Mask mask) { return { Half::One(mask.First), Half::One(mask.Second) }; }
  static Mask AndNot(Mask a, Mask b)
  {
    return { Half::AndNot(a.First, b.First), Half::AndNot(a.Second, b.Second) };
  }
  static Mask Not(Mask a) { return { Half::Not(a.First), Half::Not(a.Second) }; }
  static unsigned int Bits(Mask mask)
  {
    return Half::Bits(mask.First) | Half::Bits(mask.Second) << Half::Width;
  }
  static Mask FromBits(unsigned int bits)
  {
    return { Half::FromBits(bits & ((1u << Half::Width) - 1u)),
      Half::FromBits(bits >> Half::Width) };
  }

  static Int Increment(Mask mask, Int a)
  {
    return { Half::Increment(mask.First, a.First), Half::Increment(mask.Second, a.Second) };
  }
  static Int Decrement(Mask mask, Int a)
  {
    return { Half::Decrement(mask.First, a.First), Half::Decrement(mask.Second, a.Second) };
  }
  static Int And(Int a, Int b)
  {
    return { Half::And(a.First, b.First), Half::And(a.Second, b.Second) };
  }
  static Float ToFloat(Int a) { return { Half::ToFloat(a.First), Half::ToFloat(a.Second) }; }
  static Int ToInt(Float a) { return { Half::ToInt(a.First), Half::ToInt(a.Second) }; }
  static Int AsInt(Float a) { return { Half::AsInt(a.First), Half::AsInt(a.Second) }; }
  static Int ShiftRight(Int a, Int b)
  {
    return { Half::ShiftRight(a.First, b.First), Half::ShiftRight(a.Second, b.Second) };
  }
  static Int LookupOf24(const std::int32_t (&table)[32], Int index)
  {
    return { Half::LookupOf24(table, index.First), Half::LookupOf24(table, index.Second) };
  }

  static void FollowPairs(const std::int32_t* pairs, Int index, Int& first, Int& second)
  {
    Half::FollowPairs(pairs, index.First, first.First, second.First);
    Half::FollowPairs(pairs, index.Second, first.Second, second.Second);
  }
  template <int Stride>
  static void GatherQuads(const float* from, Int index, Float& x, Float& y, Float& z, Float& w)
  {
    Half::template GatherQuads<Stride>(from, index.First, x.First, y.First, z.First, w.First);
    Half::template GatherQuads<Stride>(from, index.Second, x.Second, y.Second, z.Second, w.Second);
  }
  static void GatherTriples(const float* from, Int index, Float& x, Float& y, Float& z)
  {
    Half::GatherTriples(from, index.First, x.First, y.First, z.First);
    Half::GatherTriples(from, index.Second, x.Second, y.Second, z.Second);
  }
  static Float GatherCellScalars(const float* scalars, Int cellFace)
  {
    return { Half::GatherCellScalars(scalars, cellFace.First),
      Half::GatherCellScalars(scalars, cellFace.Second) };
  }
  static constexpr int LookupBlock = Half::LookupBlock;
  template <int Blocks>
  static Float Lookup(const float* table, Int index)
  {
    return { Half::template Lookup<Blocks>(table, index.First),
      Half::template Lookup<Blocks>(table, index.Second) };
  }
};

}
