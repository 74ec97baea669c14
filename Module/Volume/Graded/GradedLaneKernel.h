// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Steps of lanes, compiled once per instruction set, by GradedLanesOfSet.cxx.in. No name of this
 * file is seen by other files.
 */
#pragma once

#include "Volume/Graded/GradedLanes.h"
#include "Volume/Graded/GradedPassage.h"

#if defined(__AVX__)
#include <immintrin.h>
#endif

#include <cstdint>
#include <cstring>
#include <limits>

namespace meniscus
{
namespace
{

#if defined(__AVX512F__)
constexpr int Width = 8;
#elif defined(__AVX__)
constexpr int Width = 4;
#else
constexpr int Width = 2;
#endif
static_assert(GradedLanes::Size % Width == 0, "no lane is left over");

/** One number per lane, in the vector types of GCC and Clang, and the results of comparisons. */
using Number = double __attribute__((vector_size(8 * Width)));
using Mask = std::int64_t __attribute__((vector_size(8 * Width)));
/** One whole number per lane. */
using Whole = std::int32_t __attribute__((vector_size(4 * Width)));

Number Splat(double value)
{
  return value - Number{};
}

Number Choose(Mask condition, Number yes, Number no)
{
  return condition ? yes : no;
}

Number Load(const double* from)
{
  Number result;
  std::memcpy(&result, from, sizeof(result));
  return result;
}

/** Faces of links, as numbers. */
Number LoadFaces(const std::int32_t* links)
{
  Whole result;
  std::memcpy(&result, links, sizeof(result));
  return __builtin_convertvector(result & 3, Number);
}

/** Four numbers of each lane's row of the table, from the k-th on. */
void LoadOfRows(const GradedCellRow* const* rows, int k, Number* columns)
{
#if defined(__AVX512F__)
  const auto pair = [rows, k](int i)
  {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(rows[i]->Values + k)),
      _mm256_load_pd(rows[i + 4]->Values + k), 1);
  };
  const __m512d first[2] = { pair(0), pair(2) };
  const __m512d second[2] = { pair(1), pair(3) };
  const __m512i lower = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i upper = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  const __m512d even[2] = { _mm512_unpacklo_pd(first[0], second[0]),
    _mm512_unpacklo_pd(first[1], second[1]) };
  const __m512d odd[2] = { _mm512_unpackhi_pd(first[0], second[0]),
    _mm512_unpackhi_pd(first[1], second[1]) };
  columns[0] = _mm512_permutex2var_pd(even[0], lower, even[1]);
  columns[1] = _mm512_permutex2var_pd(odd[0], lower, odd[1]);
  columns[2] = _mm512_permutex2var_pd(even[0], upper, even[1]);
  columns[3] = _mm512_permutex2var_pd(odd[0], upper, odd[1]);
#elif defined(__AVX__)
  const auto pair = [rows](int i, int column)
  {
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(rows[i]->Values + column)),
      _mm_load_pd(rows[i + 2]->Values + column), 1);
  };
  for (int half = 0; half < 4; half += 2)
  {
    const __m256d first = pair(0, k + half);
    const __m256d second = pair(1, k + half);
    columns[half] = _mm256_unpacklo_pd(first, second);
    columns[half + 1] = _mm256_unpackhi_pd(first, second);
  }
#else
  for (int i = 0; i < 4; ++i)
  {
    columns[i] = Number{ rows[0]->Values[k + i], rows[1]->Values[k + i] };
  }
#endif
}

void Store(double* to, Number value)
{
  std::memcpy(to, &value, sizeof(value));
}

void Store(std::int32_t* to, Number value)
{
  const Whole whole = __builtin_convertvector(value, Whole);
  std::memcpy(to, &whole, sizeof(whole));
}

Number SizeOf(Number x)
{
  return reinterpret_cast<Number>(
    reinterpret_cast<Mask>(x) & (Mask{} + std::numeric_limits<std::int64_t>::max()));
}

/** The first of two numbers that are packed by GradedCellRow::PackUpwards(). */
Number FirstOfPair(Number packed)
{
  return packed;
}

Number SecondOfPair(Number packed)
{
  return reinterpret_cast<Number>(reinterpret_cast<Mask>(packed) << 32);
}

Number SmallerOf(Number a, Number b)
{
  return Choose(a < b, a, b);
}

Number LargerOf(Number a, Number b)
{
  return Choose(a > b, a, b);
}

/** One vector per lane. */
struct Vector
{
  Number X;
  Number Y;
  Number Z;

  friend Vector operator+(Vector a, Vector b) { return { a.X + b.X, a.Y + b.Y, a.Z + b.Z }; }
  friend Vector operator*(Number f, Vector a) { return { f * a.X, f * a.Y, f * a.Z }; }
  friend Vector operator*(double f, Vector a) { return Splat(f) * a; }
};

Number Product(Vector a, Vector b)
{
  return a.X * b.X + a.Y * b.Y + a.Z * b.Z;
}

Vector Choose(Mask condition, Vector yes, Vector no)
{
  return { Choose(condition, yes.X, no.X), Choose(condition, yes.Y, no.Y),
    Choose(condition, yes.Z, no.Z) };
}

Vector LoadVector(const double (&from)[3][GradedLanes::Size], int i)
{
  return { Load(from[0] + i), Load(from[1] + i), Load(from[2] + i) };
}

void StoreVector(double (&to)[3][GradedLanes::Size], int i, Vector value)
{
  Store(to[0] + i, value.X);
  Store(to[1] + i, value.Y);
  Store(to[2] + i, value.Z);
}

using Row = GradedCellRow;

/** Coefficients of the lanes' cells. */
struct Coefficients
{
  void Read(const GradedCellRow* const* rows)
  {
    static_assert(Row::Size % 4 == 0, "whole blocks of four");
    for (int k = 0; k < Row::Size; k += 4)
    {
      LoadOfRows(rows, k, this->Values + k);
    }
  }
  Number operator[](int column) const { return this->Values[column]; }
  Vector GetVector(int column) const
  {
    return { this->Values[column], this->Values[column + 1], this->Values[column + 2] };
  }
  Vector GetGradient(int k) const { return this->GetVector(Row::Gradients + 3 * k); }
  /** The force's derivative times a vector. */
  Vector Derive(Vector v) const
  {
    const Vector diagonal = this->GetVector(Row::Derivative);
    const Vector others = this->GetVector(Row::Derivative + 3);
    return { diagonal.X * v.X + others.X * v.Y + others.Y * v.Z,
      others.X * v.X + diagonal.Y * v.Y + others.Z * v.Z,
      others.Y * v.X + others.Z * v.Y + diagonal.Z * v.Z };
  }

private:
  Number Values[Row::Size];
};

/** The face by which a straight way leaves the cell. */
struct Exit
{
  /** That of two faces which is reached first; any of them if none is reached. */
  static Exit FirstOf(const Exit& a, const Exit& b)
  {
    const Mask isSecond = b.Rate * a.Weight < b.Weight * a.Rate;
    return { Choose(isSecond, b.Face, a.Face), Choose(isSecond, b.Weight, a.Weight),
      Choose(isSecond, b.Rate, a.Rate), Choose(isSecond, b.Gradient, a.Gradient) };
  }

  Number Face;
  /** Weight at the beginning and its rate: if that is negative, the time is their quotient. */
  Number Weight;
  Number Rate;
  Vector Gradient;
};

/** Time at which a weight is 0. */
struct Root
{
  Number Time;
  /** Change of the time in the last step of Newton's method. */
  Number Change;
  /** The larger one of the weight's rates at the beginning and before that step. */
  Number LargestRate;
};

/** Powers of a time over their factorials, from the first on. */
struct Powers
{
  explicit Powers(Number t)
    : First(t)
    , Second(0.5 * t * t)
    , Third((1.0 / 3.0) * t * this->Second)
    , Fourth(0.25 * t * this->Third)
    , Fifth(0.2 * t * this->Fourth)
  {
  }

  Number First;
  Number Second;
  Number Third;
  Number Fourth;
  Number Fifth;
};

/** Derivatives of the momentum of a ray in its cell by the time, from the first on. */
struct Series
{
  void Read(const Coefficients& cell, Vector place, Vector momentum)
  {
    this->Force = cell.GetVector(Row::Force) + cell.Derive(place);
    this->Second = cell.Derive(momentum);
    this->Third = cell.Derive(this->Force);
    this->Fourth = cell.Derive(this->Second);
  }

  /**
   * Time at which the exit's weight is 0: the first three terms of the root as a series in the
   * curvature, and a step of Newton's method.
   */
  Root Solve(const Exit& exit) const
  {
    const Number d2 = Product(exit.Gradient, this->Force);
    const Number c2 = 0.5 * d2;
    const Number c3 = (1.0 / 6.0) * Product(exit.Gradient, this->Second);
    const Number c4 = (1.0 / 24.0) * Product(exit.Gradient, this->Third);
    const Number c5 = (1.0 / 120.0) * Product(exit.Gradient, this->Fourth);
    const Number perFall = -1.0 / exit.Rate;
    const Number straight = exit.Weight * perFall;
    const Number bend = straight * perFall * (c2 + straight * c3);
    const Number t = straight * (1.0 + bend * (1.0 + 2.0 * bend));
    const Number square = t * t;
    const Number curve = t * ((c2 + t * c3) + square * (c4 + t * c5));
    const Number slope = t * ((d2 + t * (3.0 * c3)) + square * (4.0 * c4 + t * (5.0 * c5)));
    const Number endRate = slope + exit.Rate;
    const Number change = (exit.Weight + t * (curve + exit.Rate)) / endRate;
    return { t - change, change, LargerOf(exit.Rate, endRate) };
  }
  /** Place from the beginning. */
  Vector GetWay(Vector momentum, const Powers& t) const
  {
    return t.First * momentum +
      (t.Second * this->Force +
        (t.Third * this->Second + (t.Fourth * this->Third + t.Fifth * this->Fourth)));
  }
  Vector GetMomentum(Vector momentum, const Powers& t) const
  {
    return momentum +
      (t.First * this->Force +
        (t.Second * this->Second + (t.Third * this->Third + t.Fourth * this->Fourth)));
  }
  /**
   * Product of the force and the integral of the place, without the fifth term, which does not
   * change the integral of n^2.
   */
  Number IntegrateAlongForce(Vector momentum, const Powers& t) const
  {
    return t.Second * Product(this->Force, momentum) +
      (t.Third * Product(this->Force, this->Force) +
        (t.Fourth * Product(this->Force, this->Second) +
          t.Fifth * Product(this->Force, this->Third)));
  }

  Vector Force;
  Vector Second;
  Vector Third;
  Vector Fourth;
};

/** Where a ray is in its cell at the beginning of a step. */
struct Begin
{
  void Read(const GradedLanes& lanes, const Coefficients& cell, Vector momentum, int i)
  {
    const Number entry = LoadFaces(lanes.Links + i);
    const Vector w = LoadVector(lanes.Weights, i);
    const Number zero = Splat(0.0);
    this->Weights[0] = Choose(entry > 0.0, w.X, zero);
    this->Weights[1] = Choose(entry > 1.0, w.Y, Choose(entry > 0.0, zero, w.X));
    this->Weights[2] = Choose(entry > 2.0, w.Z, Choose(entry > 1.0, zero, w.Y));
    this->Weights[3] = Choose(entry > 2.0, zero, w.Z);
    for (int k = 0; k < 3; ++k)
    {
      this->Rates[k + 1] = Product(cell.GetGradient(k), momentum);
    }
    this->Rates[0] = -(this->Rates[1] + this->Rates[2] + this->Rates[3]);
  }

  Exit FindExit(const Coefficients& cell) const
  {
    const auto exitBy = [this](int face, Vector gradient) {
      return Exit{ Splat(face), this->Weights[face], this->Rates[face], gradient };
    };
    const Vector first = -1.0 * (cell.GetGradient(0) + cell.GetGradient(1) + cell.GetGradient(2));
    return Exit::FirstOf(Exit::FirstOf(exitBy(0, first), exitBy(1, cell.GetGradient(0))),
      Exit::FirstOf(exitBy(2, cell.GetGradient(1)), exitBy(3, cell.GetGradient(2))));
  }

  Number Weights[4];
  Number Rates[4];
};

/** Those of the numbers of four faces that are not one face's, in their order. */
Vector OthersThan(Number face, const Number (&ofFaces)[4])
{
  return { Choose(face > 0.0, ofFaces[0], ofFaces[1]), Choose(face > 1.0, ofFaces[1], ofFaces[2]),
    Choose(face > 2.0, ofFaces[2], ofFaces[3]) };
}

/** A step of lanes in parts, so that those of several lanes are computed side by side. */
struct LaneStep
{
  void FindExit(const GradedLanes& lanes, int i);
  void FindTime();
  void Move(GradedLanes& lanes, int i) const;

  /** Coefficients of the cell that count at the end. */
  Vector Gradients[3];
  Number Times;
  Number HigherTerms;
  Begin Start;
  Exit End;
  Series Way;
  /** Not a number if the time has no proof. */
  Number Time;
  /** Twice the largest sum of the higher terms of a weight. */
  Number Higher;
};

void LaneStep::FindExit(const GradedLanes& lanes, int i)
{
  Coefficients cell;
  cell.Read(lanes.Rows + i);
  const Vector momentum = LoadVector(lanes.Momentum, i);
  this->Start.Read(lanes, cell, momentum, i);
  this->End = this->Start.FindExit(cell);
  this->Way.Read(cell, LoadVector(lanes.Place, i), momentum);
  for (int k = 0; k < 3; ++k)
  {
    this->Gradients[k] = cell.GetGradient(k);
  }
  this->Times = cell[Row::Times];
  this->HigherTerms = cell[Row::HigherTerms];
}

void LaneStep::FindTime()
{
  const Root root = this->Way.Solve(this->End);
  const Number linear = FirstOfPair(this->HigherTerms);
  const Number cubic = SecondOfPair(this->HigherTerms) * (root.Time * root.Time);
  // The weight of the exit falls all the way (GradedPassage::IsFirst): its rate is below the larger
  // one of those at both ends and twice its terms above the first order. Newton's method has
  // changed the rate at the end by less than the last change's share of GradedStepBounds' K.
  constexpr double changeOfRate = GradedPassage::LastChange / GradedPassage::Rounding;
  const Mask isRoot = (SizeOf(root.Change) <= GradedPassage::LastChange * root.Time) &
    (root.Time <= FirstOfPair(this->Times)) &
    (3.0 * cubic + changeOfRate * linear < -root.LargestRate);
  this->Time = Choose(isRoot, root.Time, Splat(std::numeric_limits<double>::quiet_NaN()));
  this->Higher = root.Time * (linear + cubic);
}

void LaneStep::Move(GradedLanes& lanes, int i) const
{
  const Begin& begin = this->Start;
  const Vector momentum = LoadVector(lanes.Momentum, i);
  const Powers t(this->Time);
  const Vector way = this->Way.GetWay(momentum, t);
  const Vector endMomentum = this->Way.GetMomentum(momentum, t);
  Number ends[4] = { Splat(0.0), Product(this->Gradients[0], way), Product(this->Gradients[1], way),
    Product(this->Gradients[2], way) };
  ends[0] = -(ends[1] + ends[2] + ends[3]);
  Number tangents[4];
  for (int k = 0; k < 4; ++k)
  {
    ends[k] = begin.Weights[k] + ends[k];
    tangents[k] = begin.Weights[k] + t.First * begin.Rates[k];
  }
  const Vector kept = OthersThan(this->End.Face, ends);
  const Vector ahead = OthersThan(this->End.Face, tangents);
  const Number excess = (kept.X + kept.Y) + (kept.Z - 1.0);
  const Number shortSteps = Load(lanes.ShortSteps + i);
  const Number run = Choose(t.First > SecondOfPair(this->Times), Splat(0.0), shortSteps + 1.0);
  // Numbers that are not finite make the excess one of them.
  const Number least = SmallerOf(
    SmallerOf(SmallerOf(kept.X, ahead.X), SmallerOf(kept.Y, ahead.Y)), SmallerOf(kept.Z, ahead.Z));
  const Mask isDone = (least > this->Higher) & (SizeOf(excess) < GradedPassage::LastChange) &
    (run <= GradedLanes::MostShortSteps);

  const Number path = Load(lanes.OpticalPath + i);
  const Number ofStep = 0.5 *
    (Product(momentum, momentum) * t.First + this->Way.IntegrateAlongForce(momentum, t) +
      Product(endMomentum, way));
  const Vector place = LoadVector(lanes.Place, i);
  StoreVector(lanes.Place, i, Choose(isDone, place + way, place));
  StoreVector(lanes.Momentum, i, Choose(isDone, endMomentum, momentum));
  StoreVector(
    lanes.Weights, i, Choose(isDone, (1.0 - excess) * kept, LoadVector(lanes.Weights, i)));
  Store(lanes.OpticalPath + i, Choose(isDone, path + ofStep, path));
  Store(lanes.ShortSteps + i, Choose(isDone, run, shortSteps));
  Store(lanes.Exit + i, Choose(isDone, this->End.Face, Splat(-1.0)));
}

/** Takes lanes to the cells behind their exits, and notes those that have to wait. */
template <bool IsWatching>
void PassOn(GradedLanes& lanes, int begin, int end)
{
  int waiting = lanes.WaitingCount;
  for (int lane = begin; lane < end; ++lane)
  {
    const std::int32_t exit = lanes.Exit[lane];
    const std::int32_t link = lanes.Rows[lane]->Links[exit & 3];
    if ((exit | link) < 0)
    {
      lanes.Waiting[waiting++] = lane;
      continue;
    }
    const std::int32_t cell = link >> 2;
    const GradedCellRow* const row = lanes.Table + cell;
    Fetch(*row);
    lanes.Links[lane] = link;
    lanes.Rows[lane] = IsWatching && lanes.Watched[cell] ? lanes.Impassable : row;
  }
  lanes.WaitingCount = waiting;
}

/** Steps of all lanes. */
template <bool IsWatching>
void StepAll(GradedLanes& lanes)
{
  LaneStep steps[GradedLanes::Size / Width];
  const int groups = (lanes.Count + Width - 1) / Width;
  for (int group = 0; group < groups; ++group)
  {
    steps[group].FindExit(lanes, group * Width);
  }
  for (int group = 0; group < groups; ++group)
  {
    steps[group].FindTime();
  }
  lanes.WaitingCount = 0;
  // Lanes pass on while later ones move: their exits are known by then, and rows are on their way.
  constexpr int later = 2;
  for (int group = 0; group < groups + later; ++group)
  {
    if (group < groups)
    {
      steps[group].Move(lanes, group * Width);
    }
    if (group >= later)
    {
      const int begin = (group - later) * Width;
      const int end = begin + Width;
      PassOn<IsWatching>(lanes, begin, end < lanes.Count ? end : lanes.Count);
    }
  }
}

void StepAll(GradedLanes& lanes)
{
  if (lanes.Watched)
  {
    StepAll<true>(lanes);
  }
  else
  {
    StepAll<false>(lanes);
  }
}

}

}
