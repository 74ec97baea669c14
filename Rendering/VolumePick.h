// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Integral/EventArrays.h"
#include "Rendering/Integral/RayPicker.h"

#include <array>

class vtkDataSet;

namespace meniscus
{

/** A place found by vtkTetrahedraVolumePicker. */
struct PickedPlace
{
  bool IsFound = false;
  InputEvent Event;
  vtkDataSet* DataSet = nullptr;
};

/** A pick of one volume. */
struct VolumePick
{
  PickedPixel Pixel;
  /** Pixels of the viewport. */
  int ViewportSize[2] = { 0, 0 };
  /** Accumulated opacity of OpacityReachedEvent. */
  double Opacity = 0.5;
  std::array<PickedPlace, NumberOfRayEvents> Places;
};

}
