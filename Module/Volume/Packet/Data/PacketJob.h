// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Plain data only: kernels are compiled once per instruction set, and inline functions that such
 * files share with others could be merged by the linker.
 */
#ifndef meniscus_Volume_Packet_Data_PacketJob_h
#define meniscus_Volume_Packet_Data_PacketJob_h

#include "Volume/Optics/BlendModels.h"
#include "Volume/Optics/ComponentMixture.h"
#include "Volume/Packet/Data/PacketOptics.h"
#include "Volume/Packet/Data/PacketRays.h"

#include <cstdint>

#include <glm/fwd.hpp>

namespace meniscus
{

struct SurfaceLighting;

struct PacketJob
{
  BlendMode Blending;
  const PacketVertex* Vertices;
  /** Per cell, 4 ascending vertices, then 4 links (TetrahedralMesh::Cell). */
  const std::int32_t* Cells;
  std::int64_t NumberOfCells;
  /** One normalised scalar per cell, in place of those of the vertices; null for none. */
  const float* CellScalars;
  const PacketInterval* Intervals;
  std::int32_t NumberOfIntervals;
  /** Share of the data's range that a scalar is: ShareAtZero + SharePerScalar * scalar. */
  float ShareAtZero;
  float SharePerScalar;
  ComponentMixture Mixture;
  /** Three numbers per vertex: scalars beside the main one, normalised, or a colour; if mixed. */
  const float* Components;
  /** Of those scalars, where they have functions. */
  const PacketInterval* OtherIntervals[3];
  std::int32_t NumberOfOtherIntervals[3];
  /** In place of the intervals, for one scalar without gradients; null for none. */
  const PacketSegmentTable* SegmentTable;
  /** Null where gradients do nothing to the medium. */
  const GradientShading* Medium;
  /** Ascending scalars. */
  const PacketSurface* Surfaces;
  std::int32_t NumberOfSurfaces;
  /** Of surfaces; null for none. */
  const SurfaceLighting* Lighting;
  /** Three numbers per vertex, in normalised model coordinates; null for those of the cells. */
  const float* VertexGradients;
  /** The same per cell, where gradients of cells are needed. */
  const float* CellGradients;
  const glm::dmat3* GradientToFrame;
  /** Grid unit of x and y, in units of the frame. */
  double GridUnit;
  /** Rays end when their transmittance is not above it. */
  float TerminationTransmittance;
  const PacketRay* Rays;
  std::int32_t NumberOfRays;
  const PacketEntry* Entries;
  /**
   * Whether results are what the model keeps of a ray, to be joined with what lies behind
   * (JoinValues()) and shown by FinishValues(): see KeptResult.
   */
  bool KeepsValues;
  /** One per ray. */
  PacketResult* Results;
};

}

#endif
