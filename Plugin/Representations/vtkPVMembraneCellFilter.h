// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVMembraneCellFilter
 * @brief   vtkMembraneCellFilter for ParaView, with the surfaces of all ranks and blocks
 *
 * The cells are made on the first rank. See InterfaceTable for the
 * rows of the table.
 */
#ifndef vtkPVMembraneCellFilter_h
#define vtkPVMembraneCellFilter_h

#include "SurfaceGathering.h" // For the table of interfaces
#include "vtkMembraneCellFilter.h"
#include "vtkMeniscusRepresentationsModule.h" // For export macro

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVMembraneCellFilter : public vtkMembraneCellFilter
{
public:
  vtkTypeMacro(vtkPVMembraneCellFilter, vtkMembraneCellFilter);

private:
  meniscusSurfaceGatheringDeclarations(vtkPVMembraneCellFilter, RequestUpdateExtent);
};

#endif
