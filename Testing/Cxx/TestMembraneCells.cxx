// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cells of the thesis below a coarse wavy membrane: prisms between the refracted rays of facets.
#include "RegressionScene.h"

#include <vtkDataSetMapper.h>
#include <vtkMembraneCellFilter.h>

using namespace meniscus::test;

int TestMembraneCells(int argc, char* argv[])
{
  RegressionScene scene;
  LookAtWater(scene, 6.0);
  vtkNew<vtkMembraneCellFilter> cells;
  cells->SetInputData(MakeWaves(0.9, 0.0, 6));
  cells->SetEyePosition(0.0, 0.0, 3.0);
  vtkNew<vtkDataSetMapper> mapper;
  mapper->SetInputConnection(cells->GetOutputPort());
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray("FacetId");
  mapper->SetScalarRange(0.0, 35.0);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->EdgeVisibilityOn();
  scene.GetRenderer()->AddActor(actor);
  return Finish(argc, argv, scene);
}
