// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Rendering/Input/InputBlocks.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace meniscus
{

class VolumeInput;

/** Gradients of an input's scalars at its vertices or in its cells; remade when those changed. */
class VolumeGradients
{
public:
  /** @param place  Points: one gradient per vertex; Cells: one per cell. */
  explicit VolumeGradients(FieldAssociation place)
    : Place(place)
  {
  }

  /** @param parts  the data sets that the input's scalars were taken from. */
  void Update(const VolumeInput& input, const InputBlocks& parts);

  /** In normalised model coordinates. */
  const std::vector<glm::vec3>& GetValues() const { return this->Values; }
  /** Changes with the values, once per computation. */
  TableVersion GetVersion() const { return this->Version; }
  /** Bytes of the table. */
  std::int64_t GetBytes() const;

private:
  FieldAssociation Place;
  std::vector<glm::vec3> Values;
  TableVersion Version;
  /** Versions of the mesh and of the scalars that the gradients were computed from. */
  TableVersions BuiltInput;
};

}
