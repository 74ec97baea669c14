// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/MediumSegments.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/CompositeModel.h"
#include "Volume/Packet/Models/PacketLanes.h"

#include <cstdint>

namespace meniscus
{

/** Integrates lists of segments by the model of composite blending, one ray per lane. */
template <class Simd>
void IntegrateSegmentsWith(const PacketJob& job, const MediumSegmentList& list)
{
  using Mask = typename Simd::Mask;
  using Model = CompositeModel<Simd>;
  constexpr int width = Simd::Width;
  const Mask all = Simd::FromBits(AllLanes<Simd>);
  Model model(job);
  for (std::int32_t first = 0; first < list.NumberOfRays; first += width)
  {
    const std::int32_t rays =
      list.NumberOfRays - first < width ? list.NumberOfRays - first : std::int32_t{ width };
    std::int32_t begins[width] = {};
    std::int32_t most = 0;
    for (std::int32_t lane = 0; lane < rays; ++lane)
    {
      begins[lane] = first + lane > 0 ? list.Ends[first + lane - 1] : 0;
      const std::int32_t count = list.Ends[first + lane] - begins[lane];
      most = count > most ? count : most;
    }
    model.Reset(all);
    for (std::int32_t i = 0; i < most && Simd::Bits(model.IsOn()) != 0; ++i)
    {
      float numbers[3][width] = {};
      for (std::int32_t lane = 0; lane < rays; ++lane)
      {
        if (begins[lane] + i < list.Ends[first + lane])
        {
          const MediumSegment& segment = list.Segments[begins[lane] + i];
          numbers[0][lane] = segment.From;
          numbers[1][lane] = segment.To;
          numbers[2][lane] = segment.Length;
        }
      }
      Mask lanes = model.Begin(
        model.IsOn(), Simd::Load(numbers[0]), Simd::Load(numbers[1]), Simd::Load(numbers[2]), 0);
      while (Simd::Bits(lanes) != 0)
      {
        lanes = model.Advance(lanes);
      }
    }
    constexpr int numberOfValues = Model::NumberOfValues;
    float values[numberOfValues][width];
    model.Store(values);
    for (std::int32_t lane = 0; lane < rays; ++lane)
    {
      for (int k = 0; k < numberOfValues; ++k)
      {
        list.Values[numberOfValues * (first + lane) + k] = values[k][lane];
      }
    }
  }
}

}
