// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVDepthImagePoints.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPVDepthImagePoints);

//------------------------------------------------------------------------------
vtkPVDepthImagePoints::vtkPVDepthImagePoints()
{
  this->SetCamera(vtkNew<vtkCamera>());
}

//------------------------------------------------------------------------------
vtkPVDepthImagePoints::~vtkPVDepthImagePoints() = default;
