// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Common/Statistics.h"
#include "Rendering/Input/DrawnBounds.h"
#include "Rendering/Integral/RayPicker.h"
#include "Rendering/Pipeline/RayCastPipeline.h"
#include "vtkTetrahedraRayCastMapper.h"

#include "vtkNew.h"
#include "vtkTable.h"

#include <glm/mat4x4.hpp>

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

class vtkTetrahedraRayCastMapper::vtkInternals : public meniscus::RayCastPipeline
{
public:
  static const std::vector<meniscus::Statistic<vtkTetrahedraRayCastMapper>>& List();
  std::int64_t GetHostBytes() const;

  /** True in frames of still pictures: interaction asks for several frames per second. */
  static bool IsStill(vtkVolume* volume);
  /** Takes the volume's matrix over for positions in world coordinates, if it has an inverse. */
  void SetPlace(vtkVolume* volume);

  meniscus::ComponentMixture Mixture = meniscus::ComponentMixture::None;
  /** Component of the scalars to draw if they are not mixed, as in ScalarSelection. */
  int Component = meniscus::ScalarSelection::Only;
  /**
   * Estimated duration of the last frame with one ray per pixel, in seconds; 0 before the first
   * frame.
   */
  double FullImageTime = 0.0;
  /** The same if no ray is interpolated; an upper bound, since not all of the time is for rays. */
  double AllRaysTime = 0.0;

  /** Medium behind the membrane of the frame, and medium that the caller of RenderPart() gave. */
  meniscus::RefractionMedium Medium;
  meniscus::RefractionMedium Surroundings;
  /** Time of the settings for which a fault of the medium was told. */
  vtkMTimeType MediumFaultTime = 0;

  /** Light of the frame, if its medium attenuates it. */
  meniscus::VolumeIllumination::Request IlluminationRequest;
  vtkRenderWindow* IlluminationWindow = nullptr;

  /** Bounds of the input. */
  meniscus::DrawnBounds Bounds;
  /** Last warning about data sets that are left out. */
  std::string LastInputWarning;
  bool WarnedIntegration = false;
  bool WarnedBlendMode = false;
  bool WarnedComponents = false;
  bool WarnedLights = false;
  bool WarnedSize = false;
  /** Fallbacks that were reported: the backends that refused, and the backend that drew instead. */
  std::set<std::string> WarnedFallbacks;
  bool WarnedPeeling = false;
  /** Last error of a frame, and the time of the settings that it was told for. */
  std::string DrawFault;
  vtkMTimeType DrawFaultTime = 0;
  /** Inverse of the last matrix that has one, for positions given in world coordinates. */
  glm::dmat4 WorldToModel{ 1.0 };
  /** Null until the first pick. */
  std::unique_ptr<meniscus::RayPicker> Picker;
  /** Null until depths are written, and the depths of the last image that was cast. */
  std::unique_ptr<meniscus::RayPicker> DepthCaster;
  std::vector<float> Depths;
  /** Value of the backend's counter of casts at the cast that Depths belongs to. */
  std::int64_t DepthsOfCast = -1;
  /** Part of the volume that is drawn. */
  meniscus::MembranePart Part = meniscus::MembranePart::Whole;
  /** Filled when it is asked for. */
  vtkNew<vtkTable> StatisticsTable;
};
