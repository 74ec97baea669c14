// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Backends_Native_RayCastNative_h
#define meniscus_Rendering_Backends_Native_RayCastNative_h

#include "Rendering/Property/VolumePropertyTables.h"
#include "Simd/InstructionSets.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Rays/RayStatistics.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Version of a mesh and of its scalars; 0: none. */
using VertexVersion = std::array<std::int64_t, 2>;

/**
 * The ray caster on the CPU: SIMD packets of the widest instruction set available, with tiles in
 * parallel by vtkSMPTools. The image does not depend on the number of threads.
 */
class RayCastNative
{
public:
  RayCastNative();

  void UpdateProperty(const VolumePropertyTables& property);

  /**
   * Casts the rays of an image.
   * @param scene its Tables and Set are filled in here.
   * @param scalars one normalised scalar per mesh vertex.
   * @param version changes with the mesh and the scalars.
   * @param opaqueDepth window depths in [0, 1], one per pixel, in rows from the bottom.
   * @param image premultiplied RGBA per pixel; resized.
   */
  RayStatistics Cast(TileCaster::Scene scene, const std::vector<float>& scalars,
    const VertexVersion& version, const std::vector<float>& opaqueDepth, std::vector<float>& image);

  InstructionSet GetInstructionSet() const { return this->Set; }
  /** Bytes of the tables. */
  std::int64_t GetBytes() const
  {
    return BytesOf(this->Tables.Vertices) + this->GetPropertyBytes();
  }
  /** Bytes of the tables of the transfer function. */
  std::int64_t GetPropertyBytes() const;

private:
  PacketTables Tables;
  FixedPointRays PlacedBy;
  VertexVersion PlacedVersion{ 0, 0 };
  InstructionSet Set;
};

}

#endif
