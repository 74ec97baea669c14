// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Plain data only: kernels are compiled once per instruction set, and the linker could merge inline
 * functions that such files share with others.
 */
#pragma once

#include <cstdint>

namespace meniscus
{

/** A vertex in the grid of an image's rays: 16 bytes. */
struct PacketVertex
{
  /**
   * Grid coordinates x, y and depth (FixedPointRays); depth in units of DepthUnit, from the centre
   * of the mesh.
   */
  std::int32_t Place[3];
  /** Normalised scalar; NaN makes the vertex's cells transparent. */
  float Scalar;

  /**
   * Grid units of depth per unit of the frame: 2^30 - 2^11, a float. The mesh's depths are within
   * the frame's unit, so that differences of depths, interpolated in floats, fit in 32 bits.
   */
  static constexpr double GridPerDepth = 1073739776.0;
  static constexpr float DepthUnit = static_cast<float>(1.0 / GridPerDepth);
};

/**
 * A ray and its frame of reference. Relative to the ray, a vertex has the coordinates u, v =
 * fma(-Slope, float(depth), float(place - Offset)), in grid units, for its x and y; depths count
 * from the pivot of the rays (FixedPointRays). Differences of integers are exact; each conversion
 * to float and fma round once.
 *
 * Rays are fine if they are close to each other, or cells are small (FixedPointRays::AreFine()).
 * Coordinates about them are the sum of this number and a correction for its rounding:
 * fma(-SlopeRest, float(depth), fma(-Slope, r(depth), r(place - Offset) - Fraction)), where r(x) =
 * x - float(x). Their rounding errors are 2^-24 of the coordinates themselves, not of place and
 * depth.
 */
struct PacketRay
{
  /** Such that differences from places of the mesh are within 32 bits. */
  std::int32_t Offset[2];
  /** Grid units across per grid unit of depth; 0 or at least 2^-40 in magnitude. */
  float Slope[2];
  /** Remainder of the exact offset of a fine ray, in grid units: a multiple of 2^-16 within 1/2. */
  float Fraction[2];
  /** Difference of a fine ray's exact slope from Slope; 0 or at least 2^-40 in magnitude. */
  float SlopeRest[2];
  /** World length of a grid unit of depth. */
  float LengthPerDepth;
  /** Depths between which the ray is integrated, in grid units from the pivot. */
  float StartDepth;
  float EndDepth;
  /**
   * Entries of the ray: [FirstEntry, EndEntry) of the job's entries, in the order of their depth.
   */
  std::int32_t FirstEntry;
  std::int32_t EndEntry;
};

/** A boundary face by which a ray enters the mesh. */
struct PacketEntry
{
  /** Counter-clockwise about the ray. */
  std::int32_t Vertices[3];
  /** Cell * 4 + index of the cell's vertex opposite the face. */
  std::int32_t CellFace;
  /** Grid units from the pivot. */
  float Depth;
};

struct PacketResult
{
  /** Premultiplied RGBA; with PacketJob::KeepsValues, the values of the model. */
  float Color[4];
  /**
   * Place of the ray's end, unless the ray became opaque before it: the face by which the ray
   * entered the cell behind the last integrated one, as 4 * cell + face, if no other cell can
   * contain the end; otherwise one of these constants.
   */
  std::int32_t End;
  static constexpr std::int32_t Outside = -1;
  /** In the mesh or on its boundary; the cell is not known. */
  static constexpr std::int32_t Somewhere = -2;
  /** Number of cells crossed. */
  std::int32_t Steps;
  /** 1 if a walk did not end on the boundary, which cannot happen with IEEE arithmetic. */
  std::int32_t Lost;
  /**
   * 1 if the ray entered the mesh again by more than OverlapDepth, in grid units, in front of the
   * place that it had reached: parts of the mesh overlap.
   */
  std::int32_t Overlaps;
  /**
   * 2^-10 of the mesh's radius. Shallower overlaps are common and hard to see: faces that are not
   * planar, tangled cells, seams between parts.
   */
  static constexpr float OverlapDepth = static_cast<float>(PacketVertex::GridPerDepth / 1024.0);
};

/** A boundary face, counter-clockwise about the rays that enter by it. */
struct PacketFace
{
  std::int32_t Vertices[3];
  /** As in PacketEntry. */
  std::int32_t CellFace;
};

/** Consecutive rays [First, End) that may enter by a face. */
struct PacketSpan
{
  std::int32_t Face;
  std::int32_t First;
  std::int32_t End;
};

/** A ray that enters by a face. */
struct PacketHit
{
  std::int32_t Ray;
  std::int32_t Face;
  /** As in PacketEntry. */
  float Depth;
};

/** Tests of faces with spans of rays. */
struct PacketSpanJob
{
  const PacketVertex* Vertices;
  const PacketFace* Faces;
  const PacketSpan* Spans;
  std::int32_t NumberOfSpans;
  /** Lines of all rays as in PacketRay; readable up to 16 entries behind the last. */
  const std::int32_t* Offsets[2];
  const float* Slopes[2];
  /** Read only if rays are fine. */
  const float* Fractions[2];
  const float* SlopeRests[2];
  /** Pivot of the rays in grid units of depth. */
  std::int32_t Pivot;
  bool RaysAreFine;
  /** In the order of the spans; room for one hit per ray of each span. */
  PacketHit* Hits;
  std::int32_t NumberOfHits;
};

}
