// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Simd/SimdPair.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/BinMeasureModel.h"
#include "Volume/Packet/Models/BlendModeModels.h"
#include "Volume/Packet/Models/MultiComponentModel.h"
#include "Volume/Packet/Models/OpticalDepthModel.h"
#include "Volume/Packet/Models/PacketGradientShading.h"
#include "Volume/Packet/Models/PreIntegratedModel.h"
#include "Volume/Packet/Models/RayEventModel.h"
#include "Volume/Packet/Models/ScalarMeasureModel.h"
#include "Volume/Packet/Walk/PacketWalk.h"

namespace meniscus
{

/** Effect of a clear medium between the rays and the first interface: none. */
template <class, class Optics>
using PacketClearMedium = Optics;

/**
 * Instantiates Model for a medium; effects of gradients are compiled only where there are some.
 * Between is PacketClearMedium or PacketFadedMedium.
 */
template <class Simd, template <class...> class Model, template <class, class> class Between>
void CastMedium(const PacketJob& job)
{
  if (!job.Medium)
  {
    PacketWalk<Simd, Model<Simd, Between<Simd, PacketNoGradientShading<Simd>>>>(job).Run();
  }
  else if (job.VertexLight && job.VertexGradients)
  {
    PacketWalk<Simd, Model<Simd, Between<Simd, PacketGradientShading<Simd, true, true>>>>(job)
      .Run();
  }
  else if (job.VertexLight)
  {
    PacketWalk<Simd, Model<Simd, Between<Simd, PacketGradientShading<Simd, false, true>>>>(job)
      .Run();
  }
  else if (job.VertexGradients)
  {
    PacketWalk<Simd, Model<Simd, Between<Simd, PacketGradientShading<Simd, true>>>>(job).Run();
  }
  else
  {
    PacketWalk<Simd, Model<Simd, Between<Simd, PacketGradientShading<Simd, false>>>>(job).Run();
  }
}

template <class Simd, class Medium>
using PacketColorAndOpacity =
  MultiComponentModel<Simd, ComponentMixture::ColorAndOpacity, 2, Medium>;
template <class Simd, class Medium>
using PacketColorsAsTheyAre =
  MultiComponentModel<Simd, ComponentMixture::RedGreenBlueOpacity, 1, Medium>;
/**
 * Gradients have no effect on independent components; with PacketJob::VertexLight, they scatter
 * light.
 */
template <class Simd, int Functions, class Medium>
using PacketIndependent =
  MultiComponentModel<Simd, ComponentMixture::Independent, Functions, Medium>;

template <class Simd, class Medium>
void CastIndependent(const PacketJob& job)
{
  if (job.NumberOfOtherIntervals[2] > 0)
  {
    PacketWalk<Simd, PacketIndependent<Simd, 4, Medium>>(job).Run();
  }
  else if (job.NumberOfOtherIntervals[1] > 0)
  {
    PacketWalk<Simd, PacketIndependent<Simd, 3, Medium>>(job).Run();
  }
  else
  {
    PacketWalk<Simd, PacketIndependent<Simd, 2, Medium>>(job).Run();
  }
}

/** Casts a medium of one scalar by Model, of several components by MultiComponentModel. */
template <class Simd, template <class...> class Model, template <class, class> class Between>
void CastComposite(const PacketJob& job)
{
  switch (job.Mixture)
  {
    case ComponentMixture::Independent:
      if (job.Medium && job.VertexLight)
      {
        CastIndependent<Simd, Between<Simd, PacketGradientShading<Simd, false, true>>>(job);
      }
      else
      {
        CastIndependent<Simd, Between<Simd, PacketNoGradientShading<Simd>>>(job);
      }
      break;
    case ComponentMixture::ColorAndOpacity:
      CastMedium<Simd, PacketColorAndOpacity, Between>(job);
      break;
    case ComponentMixture::RedGreenBlueOpacity:
      CastMedium<Simd, PacketColorsAsTheyAre, Between>(job);
      break;
    default:
      CastMedium<Simd, Model, Between>(job);
  }
}

/** Casts with the packet model of a blend mode. */
template <class Simd, BlendMode Mode, template <class...> class Model>
void CastBlendMode(const PacketJob& job)
{
  constexpr const BlendModel& description = GetBlendModel(Mode);
  static_assert(Model<Simd>::NumberOfValues == (description.HidesBehind() ? 4 : 2),
    "colour and transmittance, or a number and a length");
  static_assert(Model<Simd>::SeesJumps == description.SeesJumps());
  if constexpr (description.IsMedium())
  {
    if (job.Medium || job.Mixture != ComponentMixture::None)
    {
      CastComposite<Simd, Model, PacketClearMedium>(job);
      return;
    }
    // Models with more values per lane are slower in pairs: registers have to be stored.
    using Pair = SimdPair<Simd>;
    PacketWalk<Pair, Model<Pair, PacketNoGradientShading<Pair>>>(job).Run();
  }
  else
  {
    PacketWalk<Simd, Model<Simd>>(job).Run();
  }
}

/** Finds events of a medium, with the values that its attenuation depends on. */
template <class Simd>
void FindMediumEvents(const PacketJob& job)
{
  const bool hasFactor = job.Medium && job.Medium->NumberOfOpacityIntervals > 0;
  const bool ofVertices = job.Medium && job.VertexGradients;
  if (job.Mixture != ComponentMixture::None)
  {
    if (ofVertices)
    {
      PacketWalk<Simd, RayEventModel<Simd, 2, false, false>>(job).Run();
    }
    else if (hasFactor)
    {
      PacketWalk<Simd, RayEventModel<Simd, 1, true, false>>(job).Run();
    }
    else
    {
      PacketWalk<Simd, RayEventModel<Simd, 1, false, false>>(job).Run();
    }
  }
  else if (hasFactor && ofVertices)
  {
    PacketWalk<Simd, RayEventModel<Simd, 1, false, false>>(job).Run();
  }
  else if (hasFactor)
  {
    PacketWalk<Simd, RayEventModel<Simd, 0, true, false>>(job).Run();
  }
  else
  {
    PacketWalk<Simd, RayEventModel<Simd, 0, false, false>>(job).Run();
  }
}

/** Measures rays instead of drawing them. */
template <class Simd>
void MeasurePackets(const PacketJob& job)
{
  switch (job.Measuring)
  {
    case RayMeasuring::ScalarsAndOpticalDepth:
      PacketWalk<Simd, ScalarMeasureModel<Simd, true>>(job).Run();
      break;
    case RayMeasuring::VertexBins:
      PacketWalk<Simd, BinMeasureModel<Simd, false>>(job).Run();
      break;
    case RayMeasuring::CellBins:
      PacketWalk<Simd, BinMeasureModel<Simd, true>>(job).Run();
      break;
    case RayMeasuring::Events:
      if (job.Blending == BlendMode::Isosurfaces)
      {
        PacketWalk<Simd, RayEventModel<Simd, 0, false, true>>(job).Run();
      }
      else
      {
        FindMediumEvents<Simd>(job);
      }
      break;
    case RayMeasuring::OpticalDepth:
      PacketWalk<Simd, OpticalDepthModel<Simd>>(job).Run();
      break;
    default:
      PacketWalk<Simd, ScalarMeasureModel<Simd, false>>(job).Run();
  }
}

template <class Simd>
void CastPacketsWith(const PacketJob& job)
{
  if (job.Measuring != RayMeasuring::None)
  {
    MeasurePackets<Simd>(job);
    return;
  }
  if (job.SegmentTable)
  {
    PacketWalk<Simd, PreIntegratedModel<Simd>>(job).Run();
    return;
  }
  switch (job.Blending)
  {
#define MENISCUS_CAST(name, number, label, model, ...)                                             \
  case BlendMode::name:                                                                            \
    CastBlendMode<Simd, BlendMode::name, model>(job);                                              \
    break;
    MENISCUS_BLEND_MODES(MENISCUS_CAST)
#undef MENISCUS_CAST
  }
}

}
