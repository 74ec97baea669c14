// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Common/Statistics.h"
#include "Rendering/Integral/EnergyBins.h"
#include "Rendering/Integral/IntegralCaster.h"
#include "vtkTetrahedraRayIntegral.h"

#include "vtkDataArray.h"
#include "vtkDataArraySelection.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkVolumeProperty.h"

#include <vector>

class vtkTetrahedraRayIntegral::vtkInternals : public meniscus::IntegralCaster
{
public:
  static const std::vector<meniscus::Statistic<vtkTetrahedraRayIntegral>>& List();

  /** Arrays of the output by name. */
  vtkNew<vtkDataArraySelection> Arrays;
  /** Filled when it is asked for. */
  vtkNew<vtkTable> StatisticsTable;
  std::vector<meniscus::EnergyBin> EnergyBins;
  /** Used where no array depends on the volume property. */
  vtkNew<vtkVolumeProperty> NoProperty;
  meniscus::FunctionFeatures NoFeatures;
  /** Used as scalars where their values do not matter: one array per data set. */
  std::vector<vtkSmartPointer<vtkDataArray>> Constants;
};
