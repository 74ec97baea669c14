// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MathBasics.h"
#include "Simd/InstructionSets.h"
#include "TestBasics.h"
#include "Volume/Caster/TileCaster.h"

namespace meniscus::test
{

/** A mesh ready for ray casting; the caller sets the optics. */
struct PictureScene
{
  TetrahedralMesh Mesh;
  std::vector<float> Scalars;
  std::vector<TransferFunctionInterval> Intervals;
  RayFrame Frame;
  std::vector<std::vector<TransferFunctionInterval>> OtherIntervals{};
  std::vector<TransferFunctionInterval> GradientIntervals{};
  std::vector<PacketSurface> Surfaces{};
  /** Everything but mesh, tables and rays. */
  TileCaster::Scene Optics{};
};

struct Picture
{
  int Size = 0;
  std::vector<float> Rgba;
  RayStatistics Statistics;

  float Alpha(int column, int row) const { return this->Rgba[4 * (row * this->Size + column) + 3]; }
};

/**
 * Casts the size x size pixels about the image's centre, every ray integrated to its end.
 * @param windowDepth depth at which all rays end; 1 is the far plane.
 */
Picture CastPicture(
  const PictureScene& scene, int size, InstructionSet set, float windowDepth = 1.0f);

/** The same with a depth per pixel, rows from below. */
Picture CastPicture(
  const PictureScene& scene, int size, InstructionSet set, const std::vector<float>& windowDepths);

/** Name of a test for an instruction set, of letters and digits. */
std::string TestNameOf(const ::testing::TestParamInfo<InstructionSet>& tested);

}
