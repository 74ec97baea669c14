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

/** Four numbers of each lane's row of the table, from the k-th on. */
void LoadOfRows(const double* const* rows, int k, Number* columns)
{
#if defined(__AVX512F__)
  const auto pair = [rows, k](int i)
  {
    return _mm512_insertf64x4(
      _mm512_castpd256_pd512(_mm256_load_pd(rows[i] + k)), _mm256_load_pd(rows[i + 4] + k), 1);
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
    return _mm256_insertf128_pd(
      _mm256_castpd128_pd256(_mm_load_pd(rows[i] + column)), _mm_load_pd(rows[i + 2] + column), 1);
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
    columns[i] = Number{ rows[0][k + i], rows[1][k + i] };
  }
#endif
}

void Store(double* to, Number value)
{
  std::memcpy(to, &value, sizeof(value));
}

Number SizeOf(Number x)
{
  return Choose(x < 0.0, -x, x);
}

Number SmallerOf(Number a, Number b)
{
  return Choose(a < b, a, b);
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
  Number Size() const { return SizeOf(this->X) + SizeOf(this->Y) + SizeOf(this->Z); }
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
  void Read(const double* const* rows)
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
  void Try(double face, Number weight, Number rate, Vector gradient)
  {
    const Mask isNearer = -rate * this->Weight > weight * this->Fall;
    this->Face = Choose(isNearer, Splat(face), this->Face);
    this->Weight = Choose(isNearer, weight, this->Weight);
    this->Fall = Choose(isNearer, -rate, this->Fall);
    this->Gradient = Choose(isNearer, gradient, this->Gradient);
  }

  Number Face = Splat(-1.0);
  /**
   * Weight at the beginning and rate of its fall: the time is their quotient, infinite at first.
   */
  Number Weight = Splat(1.0);
  Number Fall = Splat(0.0);
  Vector Gradient = { Splat(0.0), Splat(0.0), Splat(0.0) };
};

/** The series of a ray in its cell without its first term, the momentum. */
struct Series
{
  void Read(const Coefficients& cell, Vector place, Vector momentum)
  {
    this->Force = cell.GetVector(Row::Force) + cell.Derive(place);
    this->Second = 0.5 * this->Force;
    this->Third = (1.0 / 6.0) * cell.Derive(momentum);
    this->Fourth = (1.0 / 12.0) * cell.Derive(this->Second);
    this->Fifth = (1.0 / 20.0) * cell.Derive(this->Third);
  }

  /**
   * Time at which the exit's weight is 0: the first three terms of the root as a series in the
   * curvature, and a step of Newton's method, whose change is returned.
   */
  Number Solve(const Exit& exit, Number& t) const
  {
    const Number c2 = Product(exit.Gradient, this->Second);
    const Number c3 = Product(exit.Gradient, this->Third);
    const Number c4 = Product(exit.Gradient, this->Fourth);
    const Number c5 = Product(exit.Gradient, this->Fifth);
    const Number perFall = 1.0 / exit.Fall;
    const Number straight = exit.Weight * perFall;
    const Number bend = straight * perFall * (c2 + straight * c3);
    t = straight * (1.0 + bend * (1.0 + 2.0 * bend));
    const Number square = t * t;
    const Number curve = t * ((c2 + t * c3) + square * (c4 + t * c5));
    const Number slope = t * ((2.0 * c2 + t * (3.0 * c3)) + square * (4.0 * c4 + t * (5.0 * c5)));
    const Number change = (exit.Weight + t * (curve - exit.Fall)) / (slope - exit.Fall);
    t = t - change;
    return change;
  }
  /** Place from the beginning. */
  Vector GetWay(Vector momentum, Number t) const
  {
    return t *
      (momentum + t * (this->Second + t * (this->Third + t * (this->Fourth + t * this->Fifth))));
  }
  Vector GetMomentum(Vector momentum, Number t) const
  {
    return momentum +
      t *
      (this->Force + t * (3.0 * this->Third + t * (4.0 * this->Fourth + t * (5.0 * this->Fifth))));
  }
  /** Integral of the place without its fifth term, which does not change the integral of n^2. */
  Vector Integrate(Vector momentum, Number t) const
  {
    return t * t *
      (0.5 * momentum +
        t *
          (Splat(1.0 / 3.0) * this->Second + t * (0.25 * this->Third + t * (0.2 * this->Fourth))));
  }

  Vector Force;
  Vector Second;
  Vector Third;
  Vector Fourth;
  Vector Fifth;
};

/** Where a ray is in its cell at the beginning of a step. */
struct Begin
{
  void Read(const GradedLanes& lanes, const Coefficients& cell, int i)
  {
    this->Place = LoadVector(lanes.Place, i);
    this->Momentum = LoadVector(lanes.Momentum, i);
    const Number entry = Load(lanes.Entry + i);
    const Vector w = LoadVector(lanes.Weights, i);
    const Number zero = Splat(0.0);
    this->Weights[0] = Choose(entry == 0.0, zero, w.X);
    this->Weights[1] = Choose(entry == 1.0, zero, Choose(entry < 1.0, w.X, w.Y));
    this->Weights[2] = Choose(entry == 2.0, zero, Choose(entry < 2.0, w.Y, w.Z));
    this->Weights[3] = Choose(entry == 3.0, zero, w.Z);
    for (int k = 0; k < 3; ++k)
    {
      this->Rates[k + 1] = Product(cell.GetGradient(k), this->Momentum);
    }
    this->Rates[0] = -(this->Rates[1] + this->Rates[2] + this->Rates[3]);
  }

  Exit FindExit(const Coefficients& cell) const
  {
    Exit exit;
    exit.Try(0.0, this->Weights[0], this->Rates[0],
      -1.0 * (cell.GetGradient(0) + cell.GetGradient(1) + cell.GetGradient(2)));
    for (int k = 1; k < 4; ++k)
    {
      exit.Try(k, this->Weights[k], this->Rates[k], cell.GetGradient(k - 1));
    }
    return exit;
  }

  Vector Place;
  Vector Momentum;
  Number Weights[4];
  Number Rates[4];
};

/** A step of lanes in three parts, so that those of several lanes are computed side by side. */
struct LaneStep
{
  void FindExit(const GradedLanes& lanes, int i);
  void FindTime() { this->Change = this->Way.Solve(this->End, this->Time); }
  void Finish(GradedLanes& lanes, int i) const;

  Coefficients Cell;
  Begin Start;
  Exit End;
  Series Way;
  Number Time;
  Number Change;
};

void LaneStep::FindExit(const GradedLanes& lanes, int i)
{
  this->Cell.Read(lanes.Rows + i);
  this->Start.Read(lanes, this->Cell, i);
  this->End = this->Start.FindExit(this->Cell);
  this->Way.Read(this->Cell, this->Start.Place, this->Start.Momentum);
}

void LaneStep::Finish(GradedLanes& lanes, int i) const
{
  const Coefficients& cell = this->Cell;
  const Begin& begin = this->Start;
  const Exit& exit = this->End;
  const Series& series = this->Way;
  const Number t = this->Time;
  const Number change = this->Change;
  const Vector way = series.GetWay(begin.Momentum, t);
  const Vector end = series.GetMomentum(begin.Momentum, t);

  // Bounds, in sums of the sizes of components. The higher terms are at most 1 / 6 of the exponent
  // times (1 + exponent / 20 + ...).
  const Number exponent = cell[Row::Norm] * t * t;
  const Number length = begin.Momentum.Size() * t;
  const Number bend = series.Force.Size() * t * t;
  const Number higher =
    2.0 * cell[Row::LargestGradient] * (length + bend) * (0.2 * exponent + GradedPassage::Rounding);
  Number ends[4] = { Splat(0.0), Product(cell.GetGradient(0), way),
    Product(cell.GetGradient(1), way), Product(cell.GetGradient(2), way) };
  ends[0] = -(ends[1] + ends[2] + ends[3]);
  Number least = Splat(1.0);
  Number excess = Splat(-1.0);
  for (int k = 0; k < 4; ++k)
  {
    const Mask isExit = exit.Face == double(k);
    ends[k] = begin.Weights[k] + ends[k];
    const Number above = SmallerOf(ends[k], begin.Weights[k] + t * begin.Rates[k]);
    least = Choose(isExit, least, SmallerOf(least, above - higher));
    ends[k] = Choose(isExit, Splat(0.0), ends[k]);
    excess = excess + ends[k];
  }
  // The sixth term is exponent^2 / 360 of the second, the seventh exponent^3 / 5040 of the first.
  const Mask isExact = exponent * exponent * (exponent * length + 7.0 * bend) <=
    5040.0 * GradedLanes::LargestRest * length;
  // The weight of the exit falls all the way (GradedPassage::IsFirst).
  const Number endFall = -Product(exit.Gradient, end);
  const Mask isRoot = (SizeOf(change) <= GradedPassage::LastChange * t) &
    (t * SmallerOf(exit.Fall, endFall) >
      1.2 * cell[Row::LargestGradient] * (length + bend) * exponent);
  const Number square = Product(begin.Momentum, begin.Momentum);
  constexpr double glideHeight = GradedPassage::GlideHeight;
  constexpr double share = GradedPassage::LongestShare;
  const Mask isLong = (t * t * square > share * share * cell[Row::SquaredSize]) |
    (t * t * t * t * Product(series.Force, series.Force) > 64.0 * glideHeight * glideHeight);
  const Number shortSteps = Load(lanes.ShortSteps + i);
  const Number run = Choose(isLong, Splat(0.0), shortSteps + 1.0);
  const Number steps = Load(lanes.Steps + i);
  const Mask isDone = (least > 0.0) & isExact & isRoot & (t > 0.0) &
    (SizeOf(excess) < GradedPassage::LastChange) & (run <= GradedLanes::MostShortSteps) &
    (steps < Load(lanes.LastStep + i));

  const Vector mean = series.Integrate(begin.Momentum, t);
  const Number path = 0.5 * (square * t + Product(series.Force, mean) + Product(end, way));
  const Number scale = 1.0 - excess;
  const Vector kept = { Choose(exit.Face <= 0.0, ends[1], ends[0]),
    Choose(exit.Face <= 1.0, ends[2], ends[1]), Choose(exit.Face <= 2.0, ends[3], ends[2]) };
  StoreVector(lanes.Place, i, Choose(isDone, begin.Place + way, begin.Place));
  StoreVector(lanes.Momentum, i, Choose(isDone, end, begin.Momentum));
  StoreVector(lanes.Weights, i, Choose(isDone, scale * kept, LoadVector(lanes.Weights, i)));
  const Number before = Load(lanes.OpticalPath + i);
  Store(lanes.OpticalPath + i, Choose(isDone, before + path, before));
  Store(lanes.Steps + i, Choose(isDone, steps + 1.0, steps));
  Store(lanes.ShortSteps + i, Choose(isDone, run, shortSteps));
  Store(lanes.Exit + i, Choose(isDone, exit.Face, Splat(-1.0)));
}

/** Steps of all lanes. */
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
  for (int group = 0; group < groups; ++group)
  {
    steps[group].Finish(lanes, group * Width);
  }
}

}

}
