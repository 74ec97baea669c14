// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Plain data only: kernels are compiled once per instruction set, and the linker could merge inline
 * functions that such files share with others.
 */
#pragma once

#include "Volume/Optics/BlendModels.h"
#include "Volume/Optics/ComponentMixture.h"
#include "Volume/Packet/Data/PacketOptics.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Packet/Data/RayEvents.h"
#include "Volume/Packet/Data/RayMeasuring.h"

#include <cstdint>

#include <glm/fwd.hpp>

namespace meniscus
{

struct SurfaceLighting;

struct PacketJob
{
  BlendMode Blending;
  /** Measurement that replaces the blend mode, with KeepsValues; see RayMeasuring.h. */
  RayMeasuring Measuring;
  /** True if bins emit light. */
  bool Emitting;
  const PacketVertex* Vertices;
  /** Per cell, 4 ascending vertices, then 4 links (TetrahedralMesh::Cell). */
  const std::int32_t* Cells;
  std::int64_t NumberOfCells;
  /** Link and next vertex of each face of each cell (CellPassages). */
  const std::int32_t* Passages;
  /** One normalised scalar per cell, used instead of the scalars of the vertices; null for none. */
  const float* CellScalars;
  const PacketInterval* Intervals;
  std::int32_t NumberOfIntervals;
  /** Position of a scalar in the data's range, 0 to 1: ShareAtZero + SharePerScalar * scalar. */
  float ShareAtZero;
  float SharePerScalar;
  ComponentMixture Mixture;
  /**
   * Three numbers per vertex, for mixtures of components: normalised scalars besides the main one,
   * or a colour. For RayMeasuring::VertexBins, the values of the bins.
   */
  const float* Components;
  /** Intervals of the functions of these scalars, if they have functions. */
  const PacketInterval* OtherIntervals[3];
  std::int32_t NumberOfOtherIntervals[3];
  /** Table used instead of the intervals, for one scalar without gradients; null for none. */
  const PacketSegmentTable* SegmentTable;
  /** Effects of gradients on the medium; null if there are none. */
  const GradientShading* Medium;
  /** Medium between the rays and the first interface; null for none. */
  const PacketFading* Fading;
  /**
   * With Fading, one number per ray: world length of the way through the medium up to the ray's
   * point at the pivot.
   */
  const float* PathsAtPivot;
  /** Isosurfaces in the order of their scalars. */
  const PacketSurface* Surfaces;
  std::int32_t NumberOfSurfaces;
  /** Lighting of surfaces; null for none. */
  const SurfaceLighting* Lighting;
  /**
   * Three numbers per vertex, in normalised model coordinates; null if gradients of cells are used.
   */
  const float* VertexGradients;
  /**
   * Three numbers (VertexLight) per vertex, or per cell for isosurfaces of cell data, of a medium
   * or isosurfaces that are lit with global illumination; null for none.
   */
  const float* VertexLight;
  /**
   * Three numbers per cell, where gradients of cells are needed; null if they are 0, for scalars of
   * cells. For RayMeasuring::CellBins, the values of the bins.
   */
  const float* CellGradients;
  const glm::dmat3* GradientToFrame;
  /** Grid unit of x and y, in units of the frame. */
  double GridUnit;
  /** Pivot of the rays in grid units of depth. */
  std::int32_t Pivot;
  bool RaysAreFine;
  /** Transmittance at or below which a ray ends. */
  float TerminationTransmittance;
  const PacketRay* Rays;
  std::int32_t NumberOfRays;
  const PacketEntry* Entries;
  /**
   * True if results are the model's values, to be joined with the values of the ray's other legs
   * (JoinValues()) and converted by FinishValues(): see KeptResult.
   */
  bool KeepsValues;
  /** One result per ray. */
  PacketResult* Results;
  /**
   * Values of models with more of them than a result has, NumberOfMeasuredScalars per ray; null for
   * other models.
   */
  float* Values;
  /** For RayMeasuring::Events, the events of each ray so far; null for other models. */
  RayEventState* Events;
  RayEventLimits EventLimits;
};

}
