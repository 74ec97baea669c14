// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Plain data only: kernels are compiled once per instruction set, and inline functions that such
 * files share with others could be merged by the linker.
 */
#ifndef meniscus_Volume_Packet_Data_PacketRays_h
#define meniscus_Volume_Packet_Data_PacketRays_h

#include <cstdint>

namespace meniscus
{

/** A vertex as the rays of an image see it: 16 bytes. */
struct PacketVertex
{
  /** Grid coordinates x, y and depth (FixedPointRays), depth in units of DepthUnit. */
  std::int32_t Place[3];
  /** Normalised; NaN makes the vertex's cells transparent. */
  float Scalar;

  /**
   * Grid units of depth per unit of the frame: 2^30 - 2^11, a float. The mesh's depths are within
   * the frame's unit, so that differences of depths, interpolated in floats, fit in 32 bits.
   */
  static constexpr double GridPerDepth = 1073739776.0;
  static constexpr float DepthUnit = static_cast<float>(1.0 / GridPerDepth);
};

/**
 * A ray and the frame about it: where a vertex lies as seen along the ray, from which it is
 * (u, v) = (x, y) - floor((depth * Slope + Offset) / 2^32), in grid units.
 */
struct PacketRay
{
  /** |u|, |v| < 2^31 for all vertices of the mesh. */
  std::int32_t Slope[2];
  std::int64_t Offset[2];
  /** World length of a unit of depth. */
  float LengthPerDepth;
  /** Where the ray begins and ends to count. */
  float StartDepth;
  float EndDepth;
  /** Its entries: [FirstEntry, EndEntry) of the job's, ascending depth. */
  std::int32_t FirstEntry;
  std::int32_t EndEntry;
};

/** A boundary face by which a ray enters the mesh. */
struct PacketEntry
{
  /** Counter-clockwise about the ray. */
  std::int32_t Vertices[3];
  /** Cell * 4 + index of the cell's vertex opposite to the face. */
  std::int32_t CellFace;
  float Depth;
};

struct PacketResult
{
  /** Premultiplied RGBA, or PacketJob::KeepsValues. */
  float Color[4];
  /**
   * Where the ray's end lies, if nothing hides it: the face by which it entered the cell behind the
   * last one that counts, 4 * cell + face, if there is no other cell at the end; else one of these.
   */
  std::int32_t End;
  static constexpr std::int32_t Outside = -1;
  /** In the mesh, or on its boundary, nothing else is known. */
  static constexpr std::int32_t Somewhere = -2;
  /** Cells crossed. */
  std::int32_t Steps;
  /** 1 if a walk did not end on the boundary: never, if arithmetic is IEEE's. */
  std::int32_t Lost;
};

/** A face of the boundary, counter-clockwise about the rays that enter by it. */
struct PacketFace
{
  std::int32_t Vertices[3];
  /** As of PacketEntry. */
  std::int32_t CellFace;
};

/** Which of up to 64 rays enter by which faces. */
struct PacketFaceJob
{
  const PacketVertex* Vertices;
  const PacketFace* Faces;
  std::int32_t NumberOfFaces;
  const PacketRay* Rays;
  std::int32_t NumberOfRays;
  /** One per face; bit i: ray i enters by it. */
  std::uint64_t* Entered;
};

}

#endif
