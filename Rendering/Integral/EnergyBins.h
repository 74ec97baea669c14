// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Rendering/Common/ContentWatch.h"
#include "Rendering/Input/InputBlocks.h"
#include "Rendering/Input/VolumeInput.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace meniscus
{

/** Medium and radiation of one energy bin. */
struct EnergyBin
{
  /** Attenuation coefficient and emission, both per unit of the scalar and of length. */
  double Attenuation = 1.0;
  double Emission = 0.0;
  /** Intensity with which the radiation enters the mesh, on the side of the source. */
  double Intensity = 1.0;

  bool operator==(const EnergyBin& other) const
  {
    return this->Attenuation == other.Attenuation && this->Emission == other.Emission &&
      this->Intensity == other.Intensity;
  }
};

/**
 * Intensity behind a ray along which both attenuation and emission are proportional to the scalar.
 * @param integral integral of the scalar along the ray.
 */
double TransmittedIntensity(const EnergyBin& bin, double integral);

/** Attenuations and emissions of all bins in arrays of the input, one component per bin. */
class EnergyBinTables
{
public:
  /** Values of the vertices or of the cells, three per table. */
  struct Table
  {
    std::vector<glm::vec3> Values;
    /** First bin; with emission, Values has the attenuation and the emission of this bin. */
    int FirstBin = 0;
    int NumberOfBins = 1;
  };

  /**
   * Reads the arrays for a mesh if they have changed. Attenuations must not be negative.
   * @param emission no parts if nothing emits.
   * @return an error, or an empty text.
   */
  std::string Update(
    const VolumeInput& input, const InputBlocks& attenuation, const InputBlocks& emission);

  bool IsEmitting() const { return this->Emitting; }
  FieldAssociation GetFieldAssociation() const { return this->Place; }
  const std::vector<Table>& GetTables() const { return this->Tables; }
  /** Number of times that arrays were read. */
  std::int64_t GetNumberOfBuilds() const { return this->Builds; }

private:
  std::string Read(const InputBlocks& blocks, const VolumeInput& input, bool isEmission);

  std::vector<Table> Tables;
  bool Emitting = false;
  FieldAssociation Place = FieldAssociation::Points;
  ContentWatch AttenuationWatch;
  ContentWatch EmissionWatch;
  TableVersion BuiltMesh;
  std::int64_t Builds = 0;
};

}
