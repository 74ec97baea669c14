// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraComponents.glsl (integral of several components)
#pragma once

#include "Volume/Optics/MediumConstants.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/BlendedColor.h"
#include "Volume/Packet/Models/PacketExponential.h"
#include "Volume/Packet/Models/PacketGradientShading.h"
#include "Volume/Packet/Models/PacketIntervals.h"

#include <cstddef>
#include <utility>

namespace meniscus
{

/**
 * The density-emitter integral of scalars of several components, each linear along a segment: the
 * twin of vtkTetrahedraComponents.glsl. A segment is split where one of the scalars passes a point
 * of its function, and into pieces of optical depth <= 1/2. On a piece attenuation is linear, and
 * emission, attenuation times colour, quadratic; Gauss' rule of three points integrates it times
 * the transmittance to 1e-6 of the largest emission. The same interface as CompositeModel.
 *
 * Functions: number of scalars that have their own function.
 */
template <class Simd, ComponentMixture Mixture, int Functions, class Medium>
class MultiComponentModel : public BlendedColor<Simd>
{
public:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  explicit MultiComponentModel(const PacketJob& job)
    : MultiComponentModel(job, std::make_index_sequence<Functions>())
  {
  }

  void Enter(Mask lanes) { this->Optics.Enter(lanes); }

  template <class Place>
  Mask Begin(Mask lanes, Float from, Float to, Float length, const Place& place)
  {
    const Mask valid = SegmentsOf<Simd>(lanes, from, to, length);
    constexpr int first = 3 * Medium::NumberOfTriples;
    for (int f = 0; f < Functions; ++f)
    {
      const Float start = f == 0 ? from : place.StartValues.Of[first + f - 1];
      const Float end = f == 0 ? to : place.EndValues.Of[first + f - 1];
      this->Start[f] = Simd::Select(valid, start, this->Start[f]);
      this->End[f] = Simd::Select(valid, end, this->End[f]);
      this->Now[f] = Simd::Select(valid, start, this->Now[f]);
    }
    if constexpr (Mixture == ComponentMixture::RedGreenBlueOpacity)
    {
      for (int channel = 0; channel < 3; ++channel)
      {
        Float& start = this->StartColor[channel];
        Float& end = this->EndColor[channel];
        start = Simd::Select(valid, place.StartValues.Of[first + channel], start);
        end = Simd::Select(valid, place.EndValues.Of[first + channel], end);
      }
    }
    this->Done = Simd::Select(valid, Simd::Splat(0.0f), this->Done);
    this->Length = Simd::Select(valid, length, this->Length);
    this->Optics.Begin(valid, place);
    return valid;
  }

  Mask Advance(Mask lanes)
  {
    if (Simd::Bits(lanes) == 0)
    {
      return lanes;
    }
    Course courses[Functions];
    Piece piece;
    piece.Reached = Simd::Splat(1.0f);
    for (int f = 0; f < Functions; ++f)
    {
      const Fields& fields = this->Intervals[f].GetFields();
      const Mask outside = lanes & ((this->Now[f] < fields.Lower) | (this->Now[f] > fields.Upper));
      if (Simd::Bits(outside) != 0)
      {
        this->Intervals[f].Find(outside, this->Now[f]);
      }
      courses[f] = this->FindCourse(f);
      piece.Reached = Simd::Min(piece.Reached, Simd::Max(courses[f].Leaves, this->Done));
    }
    piece.Length = (piece.Reached - this->Done) * this->Length;
    this->FindBacks(courses, piece);
    this->FindDensity(piece);
    this->Integrate(piece);
    return this->Move(lanes, courses, piece);
  }

  static constexpr int NumberOfTriples = Medium::NumberOfTriples + 1;
  static constexpr bool UsesCellGradients = Medium::UsesCellGradients;
  static constexpr bool UsesLines = Medium::UsesGradients;

private:
  using Fields = typename PacketIntervals<Simd>::Fields;

  template <std::size_t... Number>
  MultiComponentModel(const PacketJob& job, std::index_sequence<Number...>)
    // Lower transmittances have too few digits left to decrease further.
    : BlendedColor<Simd>(
        Simd::Max(Simd::Splat(job.TerminationTransmittance), Simd::Splat(1.0e-30f)))
    , Intervals{ IntervalsOf(job, static_cast<int>(Number))... }
    , Done(Simd::Splat(0.0f))
    , Length(Simd::Splat(0.0f))
    , Optics(job)
  {
    const Float zero = Simd::Splat(0.0f);
    for (Float* values : { this->Start, this->End, this->Now })
    {
      for (int f = 0; f < Functions; ++f)
      {
        values[f] = zero;
      }
    }
    for (int channel = 0; channel < 3; ++channel)
    {
      this->StartColor[channel] = this->EndColor[channel] = zero;
    }
  }
  static PacketIntervals<Simd> IntervalsOf(const PacketJob& job, int function)
  {
    return function == 0 ? PacketIntervals<Simd>(job.Intervals, job.NumberOfIntervals)
                         : PacketIntervals<Simd>(job.OtherIntervals[function - 1],
                             job.NumberOfOtherIntervals[function - 1]);
  }

  /** Place up to which a function is linear in a piece, as a fraction of the segment. */
  struct Course
  {
    Mask Upward;
    Mask Downward;
    Float Leaves;
  };

  Course FindCourse(int f) const
  {
    const Fields& fields = this->Intervals[f].GetFields();
    const Float one = Simd::Splat(1.0f);
    Course course;
    course.Upward = this->End[f] > fields.Upper;
    course.Downward = this->End[f] < fields.Lower;
    const Float bound = Simd::Select(course.Upward, fields.Upper, fields.Lower);
    const Float place = (bound - this->Start[f]) / (this->End[f] - this->Start[f]);
    course.Leaves = Simd::Select(course.Upward | course.Downward,
      Simd::Max(Simd::Min(place, one), this->Done), Simd::Splat(2.0f));
    return course;
  }

  /** A piece of the segments, for all lanes. */
  struct Piece
  {
    Float Reached;
    Float Length;
    Float Front[Functions];
    Float Back[Functions];
    /** Optical density at both ends. */
    Float Density;
    Float DensityTo;
    /** Integrated fraction of the piece: up to an optical depth of 1/2. */
    Float Part;
    Float Depth;
    Mask Whole;
  };

  void FindBacks(const Course (&courses)[Functions], Piece& piece) const
  {
    const Mask partly = piece.Reached < Simd::Splat(1.0f);
    for (int f = 0; f < Functions; ++f)
    {
      const Fields& fields = this->Intervals[f].GetFields();
      Float ahead =
        Simd::Select(partly, Mix(this->Start[f], this->End[f], piece.Reached), this->End[f]);
      ahead = Simd::Min(Simd::Max(ahead, fields.Lower), fields.Upper);
      const Float bound = Simd::Select(courses[f].Upward, fields.Upper, fields.Lower);
      piece.Front[f] = this->Now[f];
      piece.Back[f] = Simd::Select(courses[f].Leaves > piece.Reached, ahead, bound);
    }
  }

  void FindDensity(Piece& piece) const
  {
    const Float zero = Simd::Splat(0.0f);
    const Float one = Simd::Splat(1.0f);
    const Float largest = Simd::Splat(LargestGaussDepth);
    constexpr int dense = Mixture == ComponentMixture::Independent ? Functions : 1;
    piece.Density = piece.DensityTo = zero;
    for (int f = 0; f < dense; ++f)
    {
      const Fields& fields = this->Intervals[f].GetFields();
      piece.Density = piece.Density + DensityAt(fields, piece.Front[f], piece.Length);
      piece.DensityTo = piece.DensityTo + DensityAt(fields, piece.Back[f], piece.Length);
    }
    piece.Density = this->Optics.ApplyGradientOpacity(piece.Density, this->Done);
    piece.DensityTo = this->Optics.ApplyGradientOpacity(piece.DensityTo, piece.Reached);
    piece.Depth = Simd::Splat(0.5f) * (piece.Density + piece.DensityTo);
    const Mask thick = piece.Depth > largest;
    piece.Whole = Simd::Not(thick);
    piece.Part = one;
    if (Simd::Bits(thick) != 0)
    {
      // part (density + part slope / 2) = 1/2, the root without cancellation.
      const Float slope = piece.DensityTo - piece.Density;
      const Float root =
        Simd::Sqrt(Simd::Max(Simd::Fma(piece.Density, piece.Density, slope), zero));
      const Float part = Simd::Min(one / (piece.Density + root), one);
      piece.Part = Simd::Select(thick, part, one);
      piece.Depth = Simd::Min(piece.Depth, largest);
    }
    if constexpr (Medium::Fades)
    {
      const Float limit = this->Optics.LimitPart(this->Done, piece.Reached);
      const Mask limited = limit < piece.Part;
      piece.Whole = Simd::AndNot(piece.Whole, limited);
      piece.Part = Simd::Select(limited, limit, piece.Part);
      const Float slope = piece.DensityTo - piece.Density;
      const Float depth =
        piece.Part * Simd::Fma(Simd::Splat(0.5f) * piece.Part, slope, piece.Density);
      piece.Depth = Simd::Select(limited, depth, piece.Depth);
    }
  }

  /** Attenuation times colour at a fraction of the piece, over its length. */
  void Emission(const Piece& piece, Float at, Float (&emission)[3]) const
  {
    if constexpr (Mixture == ComponentMixture::Independent)
    {
      for (Float& channel : emission)
      {
        channel = Simd::Splat(0.0f);
      }
      for (int f = 0; f < Functions; ++f)
      {
        const Fields& fields = this->Intervals[f].GetFields();
        const Float scalar = Mix(piece.Front[f], piece.Back[f], at);
        const Float density = DensityAt(fields, scalar, piece.Length);
        for (int channel = 0; channel < 3; ++channel)
        {
          emission[channel] =
            Simd::Fma(density, ColorAt(fields, scalar, channel), emission[channel]);
        }
      }
      // Without a gradient no highlight is added, which the density would have to multiply.
      this->Optics.Shade(emission, Mix(this->Done, piece.Reached, at));
    }
    else
    {
      const Float done = Mix(this->Done, piece.Reached, at);
      for (int channel = 0; channel < 3; ++channel)
      {
        if constexpr (Mixture == ComponentMixture::ColorAndOpacity)
        {
          emission[channel] = ColorAt(
            this->Intervals[1].GetFields(), Mix(piece.Front[1], piece.Back[1], at), channel);
        }
        else
        {
          emission[channel] = Mix(this->StartColor[channel], this->EndColor[channel], done);
        }
      }
      this->Optics.Shade(emission, done);
      const Float density = Mix(piece.Density, piece.DensityTo, at);
      for (Float& channel : emission)
      {
        channel = density * channel;
      }
    }
  }

  void Integrate(const Piece& piece)
  {
    const Float one = Simd::Splat(1.0f);
    const Float slope = piece.DensityTo - piece.Density;
    constexpr float places[3] = { 0.5f - GaussPlace, 0.5f, 0.5f + GaussPlace };
    constexpr float weights[3] = { GaussWeights[0], GaussWeights[1], GaussWeights[0] };
    for (int q = 0; q < 3; ++q)
    {
      const Float at = piece.Part * Simd::Splat(places[q]);
      Float emission[3];
      this->Emission(piece, at, emission);
      if constexpr (Medium::Fades)
      {
        this->Optics.Fade(
          Mix(piece.Density, piece.DensityTo, at), emission, Mix(this->Done, piece.Reached, at));
      }
      const Float before = at * Simd::Fma(Simd::Splat(0.5f) * at, slope, piece.Density);
      const Float weight = Simd::Splat(weights[q]) * this->Transmittance * piece.Part *
        (one - Absorbed<Simd>(Simd::Min(before, one)));
      for (int channel = 0; channel < 3; ++channel)
      {
        this->Color[channel] = Simd::Fma(weight, emission[channel], this->Color[channel]);
      }
    }
    this->Transmittance = this->Transmittance - this->Transmittance * Absorbed<Simd>(piece.Depth);
  }

  /** Continues behind the piece; returns the lanes that have more. */
  Mask Move(Mask lanes, const Course (&courses)[Functions], const Piece& piece)
  {
    Mask more = Simd::AndNot(lanes, piece.Whole);
    this->Done =
      Simd::Select(piece.Whole, piece.Reached, Mix(this->Done, piece.Reached, piece.Part));
    for (int f = 0; f < Functions; ++f)
    {
      const Course& course = courses[f];
      more = more | (lanes & (course.Upward | course.Downward));
      this->Now[f] =
        Simd::Select(piece.Whole, piece.Back[f], Mix(piece.Front[f], piece.Back[f], piece.Part));
      const Mask moved = Simd::AndNot(lanes & piece.Whole, course.Leaves > piece.Reached);
      this->Intervals[f].Move(moved & course.Upward, moved & course.Downward);
    }
    more = more & this->IsOn();
    this->Length = Simd::Select(more, this->Length, Simd::Splat(0.0f));
    return more;
  }

  static Float Mix(Float from, Float to, Float at) { return Simd::Fma(at, to - from, from); }
  static Float DensityAt(const Fields& fields, Float scalar, Float length)
  {
    // Beyond a depth of 1e18 results do not differ; its square is finite.
    const Float attenuation =
      Simd::Fma(scalar - fields.Lower, fields.AttenuationSlope, fields.Attenuation);
    return Simd::Min(Simd::Max(attenuation * length, Simd::Splat(0.0f)), Simd::Splat(LargestDepth));
  }
  static Float ColorAt(const Fields& fields, Float scalar, int channel)
  {
    return Simd::Fma(scalar - fields.Lower, fields.ColorSlope[channel], fields.Color[channel]);
  }

  PacketIntervals<Simd> Intervals[Functions];
  // The pending segment: scalars at its ends, and the place up to which it has been integrated.
  Float Start[Functions];
  Float End[Functions];
  Float Now[Functions];
  Float StartColor[3];
  Float EndColor[3];
  /** Integrated fraction. */
  Float Done;
  /** Length of the whole segment; 0 if there is none. */
  Float Length;
  Medium Optics;
};

}
