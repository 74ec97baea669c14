// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_vtkRefractionErrorVolumeInternals_h
#define meniscus_Filters_vtkRefractionErrorVolumeInternals_h

#include "vtkRefractionErrorVolume.h"

#include "Filters/Membrane/RefractionScene.h"
#include "Filters/Membrane/StackScene.h"
#include "Refraction/Curved/ErrorSamples.h"

#include <vector>

/** Scenes, samples and statistics of a volume. */
class vtkRefractionErrorVolume::vtkInternals
{
public:
  using Fitting = meniscus::StackScene::Fitting;

  meniscus::RefractionScene Scene; ///< of one interface
  /** The finer mesh, or the same mesh if the scene has flat facets. */
  meniscus::RefractionScene Reference;
  // Several interfaces, whose exact surfaces are compared with the meshes as they are given.
  meniscus::StackScene Stack{ Fitting::AsGiven };
  meniscus::StackScene StackReference{ Fitting::AsGiven };
  bool HasStackReference = false;
  std::vector<meniscus::ErrorSample> Samples;
  meniscus::ErrorSummary Summary;
  bool WarnedOfNoReference = false;
};

#endif
