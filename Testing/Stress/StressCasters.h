// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** All uses of the software under test by the stress programme. */
#pragma once

#include "StressCase.h"
#include "VolumeScene.h"

class vtkUnstructuredGrid;

namespace meniscus
{

class TetrahedralMesh;

namespace test
{

/** Builds the kernel's mesh of tetrahedra. */
void BuildKernelMesh(vtkUnstructuredGrid* grid, TetrahedralMesh& mesh);

struct StressImage
{
  FloatImage Image;
  std::int64_t Steps = 0;
  std::int64_t Rays = 0;
  std::int64_t Lost = 0;
};

/** Draws one case after the other, each in all of its views. */
class StressCaster
{
public:
  virtual ~StressCaster() = default;
  virtual void Take(const StressCase& stress) = 0;
  virtual StressImage Cast(const VolumeView& view) = 0;
};

/** "kernel", "opengl" or "native" (the last two: the mapper with that backend); null for others. */
std::unique_ptr<StressCaster> MakeStressCaster(const std::string& name);

} // namespace test
} // namespace meniscus
