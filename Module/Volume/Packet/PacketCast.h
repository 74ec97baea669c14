// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Packet_PacketCast_h
#define meniscus_Volume_Packet_PacketCast_h

#include "Volume/Packet/PacketComponents.h"
#include "Volume/Packet/PacketIntegral.h"
#include "Volume/Packet/PacketIsosurfaces.h"
#include "Volume/Packet/PacketMedium.h"
#include "Volume/Packet/PacketPreIntegrated.h"
#include "Volume/Packet/PacketProjection.h"
#include "Volume/Packet/PacketWalk.h"

namespace meniscus
{

/** Model is made for a medium: what gradients do is not asked for where they do nothing. */
template <class Simd, template <class, class> class Model>
void CastMedium(const PacketJob& job)
{
  if (!job.Medium)
  {
    PacketWalk<Simd, Model<Simd, PacketPlainMedium<Simd>>>(job).Run();
  }
  else if (job.VertexGradients)
  {
    PacketWalk<Simd, Model<Simd, PacketLitMedium<Simd, true>>>(job).Run();
  }
  else
  {
    PacketWalk<Simd, Model<Simd, PacketLitMedium<Simd, false>>>(job).Run();
  }
}

template <class Simd, class Medium>
using PacketColorAndOpacity = PacketComponents<Simd, PacketMixture::ColorAndOpacity, 2, Medium>;
template <class Simd, class Medium>
using PacketColorsAsTheyAre = PacketComponents<Simd, PacketMixture::RedGreenBlueOpacity, 1, Medium>;
/** Gradients do nothing to independent components. */
template <class Simd, int Functions>
using PacketIndependent =
  PacketComponents<Simd, PacketMixture::Independent, Functions, PacketPlainMedium<Simd>>;

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
      CastMedium<Simd, PacketIntegral>(job);
  }
}

template <class Simd>
void CastPacketsWith(const PacketJob& job)
{
  if (job.SegmentTable)
  {
    PacketWalk<Simd, PacketPreIntegrated<Simd>>(job).Run();
  }
  else if (job.Blending == PacketBlending::Composite)
  {
    CastComposite<Simd>(job);
  }
  else if (job.Blending == PacketBlending::Isosurfaces)
  {
    PacketWalk<Simd, PacketIsosurfaces<Simd>>(job).Run();
  }
  else
  {
    PacketWalk<Simd, PacketProjection<Simd>>(job).Run();
  }
}

}

#endif
