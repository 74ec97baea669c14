// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVSightRayFilter
 * @brief   vtkSightRayFilter for ParaView, with the surfaces of all ranks and blocks
 *
 * Every rank draws the rays to its own points through the whole surfaces. See InterfaceTable for
 * the rows of the table.
 */
#ifndef vtkPVSightRayFilter_h
#define vtkPVSightRayFilter_h

#include "SurfaceGathering.h"                 // For the table of interfaces
#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkSightRayFilter.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVSightRayFilter : public vtkSightRayFilter
{
public:
  vtkTypeMacro(vtkPVSightRayFilter, vtkSightRayFilter);

private:
  meniscusSurfaceGatheringDeclarations(vtkPVSightRayFilter, ComputeInputUpdateExtent);
};

#endif
