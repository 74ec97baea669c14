// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMCubeAroundDomain.h"

#include "vtkBoundingBox.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"

#include <vector>

vtkStandardNewMacro(vtkSMCubeAroundDomain);

//------------------------------------------------------------------------------
vtkSMCubeAroundDomain::vtkSMCubeAroundDomain() = default;

//------------------------------------------------------------------------------
vtkSMCubeAroundDomain::~vtkSMCubeAroundDomain() = default;

//------------------------------------------------------------------------------
void vtkSMCubeAroundDomain::Update(vtkSMProperty* vtkNotUsed(property))
{
  vtkPVDataInformation* information = this->GetInputInformation();
  if (!information)
  {
    return;
  }
  double bounds[6];
  information->GetBounds(bounds);
  const vtkBoundingBox box(bounds);
  if (!box.IsValid() || !(box.GetMaxLength() > 0.0))
  {
    return;
  }
  double center[3];
  box.GetCenter(center);
  const double half = 0.5 * box.GetMaxLength();
  std::vector<vtkEntry> entries;
  for (double middle : center)
  {
    const vtkEntry range(middle - half, middle + half);
    entries.insert(entries.end(), 2, range); // for the minimum and the maximum
  }
  this->SetEntries(entries);
}
