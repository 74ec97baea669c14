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

/** Effects of gradients on the medium in composite blending. */
struct GradientShading
{
  /** Rows: normalised model coordinates to the frame of the rays. */
  float GradientToFrame[3][3];
  /** Factor from the length of a gradient in the frame to the argument of gradient opacity. */
  float GradientMagnitude;
  /** Gradient opacity, a factor of the attenuation; none if the number of intervals is 0. */
  const PacketInterval* Opacity;
  std::int32_t NumberOfOpacityIntervals;
  /** True if the colour is lit. */
  bool Shading;
  float Ambient;
  float Diffuse;
  float Specular;
  float SpecularPower;
  const PacketLight* Lights;
  std::int32_t NumberOfLights;
  /** With PacketJob::VertexLight, see SurfaceLighting. */
  std::int32_t BrightestLight;
  float Scattering;
  float Anisotropy;
};

/** Indices of the numbers of PacketJob::VertexLight. */
enum VertexLight
{
  /** Mean transmittance from all directions, a factor of the ambient light. */
  AmbientTransmittance,
  /** Transmittance from the brightest light, and the weighted mean of the other lights'. */
  BrightestTransmittance,
  OtherTransmittance,
  NumberOfVertexLights
};

/** A RefractionMedium in single precision. */
struct PacketFading
{
  bool IsLinear;
  float Attenuation[3];
  float Range[2];
  float Color[3];
};

/** A PreIntegrationTable. */
struct PacketSegmentTable
{
  const float* Values;
  std::int32_t Scalars;
  std::int32_t Lengths;
  float ShortestReciprocal;
  float LengthsPerOctave;
  /**
   * The table is indexed by (scalar - Middle) * PerHalfRange in [-1, 1]; outside of that it is
   * constant.
   */
  float Middle;
  float PerHalfRange;
};

}
