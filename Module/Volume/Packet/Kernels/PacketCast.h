// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Packet_Kernels_PacketCast_h
#define meniscus_Volume_Packet_Kernels_PacketCast_h

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/CompositeModel.h"
#include "Volume/Packet/Models/IntensityProjectionModel.h"
#include "Volume/Packet/Models/IsosurfaceModel.h"
#include "Volume/Packet/Models/MultiComponentModel.h"
#include "Volume/Packet/Models/PacketGradientShading.h"
#include "Volume/Packet/Models/PreIntegratedModel.h"
#include "Volume/Packet/Walk/PacketWalk.h"

namespace meniscus
{

/** Instantiates Model for a medium; effects of gradients are compiled only where there are some. */
template <class Simd, template <class, class> class Model>
void CastMedium(const PacketJob& job)
{
  if (!job.Medium)
  {
    PacketWalk<Simd, Model<Simd, PacketNoGradientShading<Simd>>>(job).Run();
  }
  else if (job.VertexGradients)
  {
    PacketWalk<Simd, Model<Simd, PacketGradientShading<Simd, true>>>(job).Run();
  }
  else
  {
    PacketWalk<Simd, Model<Simd, PacketGradientShading<Simd, false>>>(job).Run();
  }
}

template <class Simd, class Medium>
using PacketColorAndOpacity = MultiComponentModel<Simd, PacketMixture::ColorAndOpacity, 2, Medium>;
template <class Simd, class Medium>
using PacketColorsAsTheyAre =
  MultiComponentModel<Simd, PacketMixture::RedGreenBlueOpacity, 1, Medium>;
/** Gradients have no effect on independent components. */
template <class Simd, int Functions>
using PacketIndependent =
  MultiComponentModel<Simd, PacketMixture::Independent, Functions, PacketNoGradientShading<Simd>>;

template <class Simd>
void CastIndependent(const PacketJob& job)
{
  if (job.NumberOfOtherIntervals[2] > 0)
  {
    PacketWalk<Simd, PacketIndependent<Simd, 4>>(job).Run();
  }
  else if (job.NumberOfOtherIntervals[1] > 0)
  {
    PacketWalk<Simd, PacketIndependent<Simd, 3>>(job).Run();
  }
  else
  {
    PacketWalk<Simd, PacketIndependent<Simd, 2>>(job).Run();
  }
}

template <class Simd>
void CastComposite(const PacketJob& job)
{
  switch (job.Mixture)
  {
    case PacketMixture::Independent:
      CastIndependent<Simd>(job);
      break;
    case PacketMixture::ColorAndOpacity:
      CastMedium<Simd, PacketColorAndOpacity>(job);
      break;
    case PacketMixture::RedGreenBlueOpacity:
      CastMedium<Simd, PacketColorsAsTheyAre>(job);
      break;
    default:
      CastMedium<Simd, CompositeModel>(job);
  }
}

template <class Simd>
void CastPacketsWith(const PacketJob& job)
{
  if (job.SegmentTable)
  {
    PacketWalk<Simd, PreIntegratedModel<Simd>>(job).Run();
  }
  else if (job.Blending == PacketBlending::Composite)
  {
    CastComposite<Simd>(job);
  }
  else if (job.Blending == PacketBlending::Isosurfaces)
  {
    PacketWalk<Simd, IsosurfaceModel<Simd>>(job).Run();
  }
  else
  {
    PacketWalk<Simd, IntensityProjectionModel<Simd>>(job).Run();
  }
}

}

#endif
