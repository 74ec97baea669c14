// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef RayCastNative_h
#define RayCastNative_h

#include "Volume/RayStatistics.h"
#include "Volume/TileCaster.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * The ray caster on the CPU: SIMD packets of the widest instruction set there is, tiles in parallel
 * by vtkSMPTools. The image does not depend on the number of threads.
 */
class RayCastNative
{
public:
  RayCastNative();

  void UpdateVertices(const TetrahedralMesh& mesh, const std::vector<float>& scalars);
  void UpdateIntervals(const std::vector<TransferFunctionInterval>& intervals);

  /**
   * Casts the rays of an image.
   * @param scene        its Tables and Set are filled in here.
   * @param opaqueDepth  window depths in [0, 1], one per pixel, rows from below.
   * @param image        premultiplied RGBA per pixel; resized.
   */
  RayStatistics Cast(
    TileCaster::Scene scene, const std::vector<float>& opaqueDepth, std::vector<float>& image);

  InstructionSet GetInstructionSet() const { return this->Set; }
  /** Bytes of tables made, ever. */
  std::int64_t GetTableBytes() const { return this->TableBytes; }

private:
  PacketTables Tables;
  InstructionSet Set;
  std::int64_t TableBytes = 0;
};

}

#endif
