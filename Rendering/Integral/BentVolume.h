// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Emission and absorption of a medium that bends light, from VTK data. */
#pragma once

#include "Rendering/Input/InputBlocks.h"
#include "Rendering/Input/VolumeComponents.h"
#include "Rendering/Property/VolumePropertyTables.h"
#include "Volume/Graded/VolumeLight.h"

#include <cstdint>
#include <vector>

class vtkVolumeProperty;

namespace meniscus
{

class BentMedium;

class BentVolume
{
public:
  /**
   * Reads the first component of the scalars, and a property.
   * @param scalars those that the medium was updated with.
   * @param perUnitDistance opacity is the alpha of one unit distance.
   * @param medium its input takes the scalars; must outlive this object.
   */
  InputReport Update(const InputBlocks& scalars, vtkVolumeProperty* property, bool perUnitDistance,
    BentMedium& medium);

  /** Sets HasLight for the cells in which something is seen. */
  void MarkCells(std::vector<std::uint8_t>& flags) const;
  /** Refers to this object. */
  const EmittingMedium& GetMedium() const { return this->Medium; }

private:
  VolumePropertyTables Property;
  /** None: one component is used. */
  VolumeComponents Components;
  std::vector<PacketInterval> Intervals;
  const TetrahedralMesh* Seen = nullptr;
  EmittingMedium Medium;
};

}
