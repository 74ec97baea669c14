// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Plain data only: kernels are compiled once per instruction set, and inline functions that such
 * files share with others could be merged by the linker.
 */
#ifndef meniscus_Volume_Packet_Data_PacketOptics_h
#define meniscus_Volume_Packet_Data_PacketOptics_h

#include <cstdint>

namespace meniscus
{

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

/** An isosurface in normalised scalars. */
struct PacketSurface
{
  float Scalar;
  float Opacity;
  float Color[3];
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
struct GradientShading
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

}

#endif
