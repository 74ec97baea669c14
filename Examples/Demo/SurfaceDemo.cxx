// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceDemo.h"

#include "DemoPictures.h"

#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkConeSource.h"
#include "vtkElevationFilter.h"
#include "vtkPiecewiseFunction.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkTetrahedralizeSurface.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <cstdio>

namespace
{

// Colour and opacity by height, from dark blue to yellow.
void SetLook(vtkVolumeProperty* property)
{
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction();
  colors->AddRGBPoint(0.0, 0.16, 0.04, 0.36);
  colors->AddRGBPoint(0.5, 0.83, 0.28, 0.26);
  colors->AddRGBPoint(1.0, 0.99, 0.9, 0.5);
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
  opacity->AddPoint(0.0, 0.2);
  opacity->AddPoint(0.45, 0.05);
  opacity->AddPoint(0.5, 0.9);
  opacity->AddPoint(0.55, 0.05);
  opacity->AddPoint(1.0, 0.9);
  property->SetScalarOpacityUnitDistance(0.08);
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool RunSurfaceDemo(const std::string& folder)
{
  vtkNew<vtkConeSource> pyramid;
  pyramid->SetResolution(6);
  pyramid->SetDirection(0.0, 1.0, 0.0);
  vtkNew<vtkElevationFilter> height;
  height->SetInputConnection(pyramid->GetOutputPort());
  height->SetLowPoint(0.0, -0.5, 0.0);
  height->SetHighPoint(0.0, 0.5, 0.0);
  vtkNew<vtkTetrahedralizeSurface> filler;
  filler->SetInputConnection(height->GetOutputPort());
  filler->SetMaximumVolume(1e-3);
  filler->Update();
  const vtkIdType cells = filler->GetOutput()->GetNumberOfCells();
  std::printf("a surface filled with %lld tetrahedra by %s, radius to shortest edge at most %.2f\n",
    static_cast<long long>(cells),
    filler->GetUsedMesher() == vtkTetrahedralizeSurface::TETGEN ? "TetGen" : "vtkDelaunay3D",
    filler->GetLargestRadiusEdgeRatio());
  if (cells == 0)
  {
    return false;
  }
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetInputConnection(filler->GetOutputPort());
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectScalarArray("Elevation");
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  SetLook(volume->GetProperty());
  DemoPictures pictures(folder);
  vtkRenderer* renderer = pictures.GetRenderer();
  renderer->AddVolume(volume);
  renderer->GetActiveCamera()->SetPosition(1.5, 1.2, 3.0);
  renderer->ResetCamera();
  return pictures.Write("surface", "a closed surface, filled with tetrahedra");
}
