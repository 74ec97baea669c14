// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeModes.h"

#include "VolumeMembranes.h"
#include "VolumeScene.h"

#include <vtkContourValues.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolumeMapper.h>
#include <vtkVolumeProperty.h>

#include <utility>

namespace meniscus::benchmark
{

namespace
{

const std::pair<const char*, VolumeMode> Modes[] = { { "composite", VolumeMode::Composite },
  { "lit", VolumeMode::Lit }, { "isosurface", VolumeMode::Isosurface },
  { "membrane", VolumeMode::Membrane } };

void ShowIsosurfaces(
  vtkUnstructuredGrid* grid, vtkUnstructuredGridVolumeMapper* mapper, vtkVolumeProperty* property)
{
  mapper->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  double range[2];
  grid->GetPointData()->GetScalars()->GetFiniteRange(range);
  for (int i = 0; i < 3; ++i)
  {
    const double share = 0.3 + 0.2 * i;
    property->GetIsoSurfaceValues()->SetValue(i, range[0] + share * (range[1] - range[0]));
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool FindVolumeMode(const std::string& name, VolumeMode& mode)
{
  for (const auto& entry : Modes)
  {
    if (name == entry.first)
    {
      mode = entry.second;
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
std::string NameOf(VolumeMode mode)
{
  for (const auto& entry : Modes)
  {
    if (mode == entry.second)
    {
      return entry.first;
    }
  }
  return "";
}

//------------------------------------------------------------------------------
void ApplyMode(VolumeMode mode, vtkUnstructuredGrid* grid, vtkUnstructuredGridVolumeMapper* mapper,
  vtkVolumeProperty* property)
{
  if (mode == VolumeMode::Lit || mode == VolumeMode::Isosurface)
  {
    property->ShadeOn();
  }
  if (mode == VolumeMode::Isosurface)
  {
    ShowIsosurfaces(grid, mapper, property);
  }
  auto* ours = vtkTetrahedraRayCastMapper::SafeDownCast(mapper);
  if (mode == VolumeMode::Membrane && ours)
  {
    ours->SetMembraneData(MakeWavesAbove(grid));
  }
}

//------------------------------------------------------------------------------
std::array<double, 2> ViewAnglesOf(VolumeMode mode, int view)
{
  const auto angles = test::ViewAngles(view);
  return { angles[0], mode == VolumeMode::Membrane ? 55.0 + angles[1] / 3.0 : angles[1] };
}

} // namespace meniscus::benchmark
