// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Rendering/Input/VolumeInput.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/ComponentMixture.h"
#include "Volume/Optics/TransferFunction.h"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace meniscus
{

/**
 * Component that VolumeInput uses as the scalar: the first component, or the component that
 * determines the opacity.
 */
int MainComponent(ComponentMixture mixture);

/** Components of the arrays besides the main one, for the vertices of a mesh. */
class VolumeComponents
{
public:
  /**
   * Updates the components. It costs nothing if the input's mesh and scalars and the mixture are
   * unchanged. As for VolumeInput, other functions cost something only if they change the
   * normalisation.
   */
  InputReport Update(const VolumeInput& input, const InputBlocks& parts, ComponentMixture mixture,
    const FunctionFeatures& features);

  /** Number of components of the array; 1 if there is no mixture. */
  int GetNumberOfComponents() const { return this->NumberOfComponents; }
  /**
   * Up to three other components per vertex, each with its own normalisation, or colours in [0, 1].
   * All of them are NaN where a component is not finite. Empty without a mixture.
   */
  const std::vector<glm::vec3>& GetValues() const { return this->Values; }
  /** Normalisation of one of the other components that are scalars. */
  const ScalarNormalization& GetNormalization(int other) const
  {
    return this->Normalizations[other];
  }
  /** Changes with the values. */
  TableVersion GetVersion() const { return this->Version; }

private:
  bool ChooseNormalizations(const FunctionFeatures& features, bool keep);
  void TakeScalars(const VolumeInput& input, const InputBlocks& parts);
  void TakeColors(const VolumeInput& input, const InputBlocks& parts);

  ComponentMixture Mixture = ComponentMixture::None;
  int NumberOfComponents = 1;
  std::vector<glm::vec3> Values;
  /**
   * The other components that are scalars: their indices in the array, distributions,
   * normalisations.
   */
  std::vector<int> Others;
  std::array<ScalarDistribution, 3> Distributions;
  std::array<ScalarNormalization, 3> Normalizations;
  TableVersion BuiltFeatures;
  /** Versions of the mesh and of the scalars that the values were taken for. */
  TableVersions BuiltInput;
  TableVersion Version;
};

}
