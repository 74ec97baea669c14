// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** What a membrane over the whole picture costs. */
#ifndef meniscus_VolumeMembranes_h
#define meniscus_VolumeMembranes_h

#include "VolumeComparison.h"

#include <string>
#include <vector>

namespace meniscus
{
namespace benchmark
{

/** Processor time of a frame over that of the same frame without the membrane. */
struct MembraneCost
{
  std::string Name;
  Spread Moving;  // camera moved since the last frame
  Spread Resting; // nothing changed but the camera's time
};

/** A backend through a plane above the mesh, one through its middle, a dome and waves. */
std::vector<MembraneCost> measureMembranes(
  const VolumeOptions& options, vtkUnstructuredGrid* grid, int backend);

} // namespace benchmark
} // namespace meniscus

#endif
