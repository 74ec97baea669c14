// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Rays through a tetrahedral mesh in SIMD packets, one ray per lane.
 *
 * Plain data only: the caster is compiled once per instruction set, and what such a file shares
 * with others must not bring inline functions that the linker could merge.
 */
#ifndef meniscus_Volume_Packet_Packet_h
#define meniscus_Volume_Packet_Packet_h

#include <cstdint>

#include <glm/fwd.hpp>

namespace meniscus
{

struct SurfaceLighting;

/** A vertex as the rays of an image see it: 16 bytes. */
struct PacketVertex
{
  /** Grid coordinates x, y and depth (PixelRays), depth in units of DepthUnit. */
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

/** A TransferFunctionInterval in three groups of four. */
struct PacketInterval
{
  float Lower;
  float Upper;
  float Attenuation;
  float AttenuationSlope;
  float Color[4];
  float ColorSlope[4];
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

/** What becomes of the segments of a ray: see PacketIntegral, PacketProjection, PacketIsosurfaces.
 */
enum class PacketBlending
{
  Composite,
  Maximum,
  Minimum,
  Average,
  Additive,
  Isosurfaces
};

/** An isosurface in normalised scalars. */
struct PacketSurface
{
  float Scalar;
  float Opacity;
  float Color[3];
};

/** How components of the vertices make colour and attenuation, with composite blending. */
enum class PacketMixture
{
  /** There is one scalar. */
  None,
  /** Each has a function of its own; attenuations and emissions add up. */
  Independent,
  /** The scalar gives the attenuation, another the colour. */
  ColorAndOpacity,
  /** The scalar gives the attenuation, the others are the colour. */
  RedGreenBlueOpacity
};

/** A RayCastLight in single precision. */
struct PacketLight
{
  float Position[4];
  float Diffuse[3];
  float Specular[3];
  float Cone[4];
  float Falloff[4];
};

/** What gradients do to the medium of composite blending. */
struct PacketMedium
{
  /** Rows: normalised model coordinates to the frame of the rays. */
  float GradientToFrame[3][3];
  /** From a gradient's length in the frame to what gradient opacity is a function of. */
  float GradientMagnitude;
  /** The factor of the attenuation; none if the number is 0. */
  const PacketInterval* Opacity;
  std::int32_t NumberOfOpacityIntervals;
  /** Whether the colour is lit. */
  bool Shading;
  float Ambient;
  float Diffuse;
  float Specular;
  float SpecularPower;
  const PacketLight* Lights;
  std::int32_t NumberOfLights;
};

/** A PreIntegrationTable. */
struct PacketSegmentTable
{
  const float* Values;
  std::int32_t Scalars;
  std::int32_t Lengths;
  float ShortestReciprocal;
  float LengthsPerOctave;
  /** A scalar has the place (scalar - Middle) * PerHalfRange in [-1, 1]; beyond, all is constant.
   */
  float Middle;
  float PerHalfRange;
};

struct PacketJob
{
  PacketBlending Blending;
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
  PacketMixture Mixture;
  /** Three numbers per vertex: scalars beside the main one, normalised, or a colour; if mixed. */
  const float* Components;
  /** Of those scalars, where they have functions. */
  const PacketInterval* OtherIntervals[3];
  std::int32_t NumberOfOtherIntervals[3];
  /** In place of the intervals, for one scalar without gradients; null for none. */
  const PacketSegmentTable* SegmentTable;
  /** Null where gradients do nothing to the medium. */
  const PacketMedium* Medium;
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
   * (JoinValues()) and shown by FinishValues(): colour and transmittance, or a number and the
   * length that it is of.
   */
  bool KeepsValues;
  /** One per ray. */
  PacketResult* Results;
};

/** What isosurfaces have left of a ray. */
struct PacketSurfaceState
{
  /** Premultiplied. */
  float Color[3];
  float Transmittance;
  /** The isovalues next to the scalar, the lower one included. */
  float Lower;
  float Upper;
};

/** Part of a ray within a cell, where the scalar is linear. */
struct PacketSegment
{
  float From;
  float To;
  float StartDepth;
  float EndDepth;
  /** 4 * cell + the face entered by. */
  std::int32_t CellFace;
  std::int32_t Ray;
};

/** Adds the isosurfaces that a segment meets, front to back. */
void CrossSurfaces(const PacketJob& job, const PacketSegment& segment, PacketSurfaceState& state);

/** What a ray that meets nothing keeps. */
void ClearValues(PacketBlending blending, float (&values)[4]);

/** Puts the values of what lies behind to those of what lies before. */
void JoinValues(PacketBlending blending, const float (&behind)[4], float (&values)[4]);

/** Premultiplied RGBA of kept values. */
void FinishValues(const PacketJob& job, const float (&values)[4], float (&color)[4]);

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

/**
 * Colour over opacity and mean attenuation of a segment between two places in [-1, 1], by linear
 * interpolation in the table's scalars and in the number of its length.
 */
void LookUpSegment(
  const PacketSegmentTable& table, float from, float to, float length, float (&mean)[4]);

enum class InstructionSet
{
  Portable,
  AVX2,
  AVX512
};

/** The widest instruction set that this processor and this build have. */
InstructionSet BestInstructionSet();

/** Whether this processor and this build have it. */
bool HasInstructionSet(InstructionSet set);

/** "AVX-512", "AVX2" or "portable". */
const char* NameOf(InstructionSet set);

/** Casts all rays of the job on the calling thread. @pre HasInstructionSet(set) */
void CastPackets(const PacketJob& job, InstructionSet set);

/** Tests all faces with all rays. @pre HasInstructionSet(set) */
void FindEntered(const PacketFaceJob& job, InstructionSet set);

}

#endif
