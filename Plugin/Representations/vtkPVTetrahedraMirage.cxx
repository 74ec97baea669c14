// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVTetrahedraMirage.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPVTetrahedraMirage);

//------------------------------------------------------------------------------
vtkPVTetrahedraMirage::vtkPVTetrahedraMirage()
{
  this->SetCamera(vtkNew<vtkCamera>());
}

//------------------------------------------------------------------------------
vtkPVTetrahedraMirage::~vtkPVTetrahedraMirage() = default;
