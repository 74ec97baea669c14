// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_RayCastMapperInternals_h
#define meniscus_Rendering_RayCastMapperInternals_h

#include "Rendering/Pipeline/RayCastPipeline.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <glm/mat4x4.hpp>

#include <set>
#include <string>

class vtkTetrahedraRayCastMapper::vtkInternals : public meniscus::RayCastPipeline
{
public:
  meniscus::ComponentMixture Mixture = meniscus::ComponentMixture::None;
  /** The component of the scalars that is drawn if they do not mix, as in ScalarSelection. */
  int Component = meniscus::ScalarSelection::Only;
  /** Seconds that the last frame would have taken with a ray per pixel; 0 before it. */
  double FullImageTime = 0.0;

  /** What was last said of data sets that are left out. */
  std::string LastInputWarning;
  bool WarnedIntegration = false;
  bool WarnedBlendMode = false;
  bool WarnedComponents = false;
  /** Fallbacks that were reported: the backends that refused, and the one that drew. */
  std::set<std::string> WarnedFallbacks;
  bool WarnedPeeling = false;
  /** Of the last frame, for what is in the world. */
  glm::dmat4 WorldToModel{ 1.0 };
};

#endif
