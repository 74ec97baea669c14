// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Volume/Optics/PreIntegration.h"

#include <glm/mat4x4.hpp>

namespace meniscus
{

class VolumeInput;
class VolumePropertyTables;

/** The pre-integration table of a volume; rebuilt only when its inputs have changed. */
class VolumePreIntegration
{
public:
  /** Samples of the scalar range and of the length. */
  struct TableSize
  {
    int Scalars = 0;
    int Lengths = 0;
  };

  /**
   * Updates the table. It depends on the transfer function, the size and the longest edge in world
   * coordinates. A table is used down to a quarter of its longest edge, so that a volume can rotate
   * and change its size.
   */
  void Update(const VolumeInput& input, const VolumePropertyTables& property,
    const glm::dmat4& modelToWorld, const TableSize& size);

  const PreIntegrationTable& GetTable() const { return this->Table; }
  /** Changes with the table, once per build. */
  TableVersion GetVersion() const { return this->Version; }

private:
  PreIntegrationTable Table;
  TableVersion BuiltProperty;
  TableSize BuiltSize;
  TableVersion Version;
};

}
