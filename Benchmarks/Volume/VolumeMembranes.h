// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Cost of a membrane over the whole image. */
#pragma once

#include "VolumeComparison.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkPolyData;

namespace meniscus::benchmark
{

/** Processor time of a frame relative to the same frame without the membrane. */
struct MembraneCost
{
  std::string Name;
  Spread Moving;  // camera moved since the last frame
  Spread Resting; // nothing has changed but the camera's time
};

/** Waves above a mesh that cover the images from elevations of 35 degrees and more. */
vtkSmartPointer<vtkPolyData> MakeWavesAbove(vtkUnstructuredGrid* grid);

/** One backend through a plane above the mesh, a plane through its middle, a dome and waves. */
std::vector<MembraneCost> MeasureMembranes(
  const VolumeOptions& options, vtkUnstructuredGrid* grid, int backend);

} // namespace meniscus::benchmark
