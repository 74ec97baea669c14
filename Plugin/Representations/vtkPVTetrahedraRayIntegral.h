// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVTetrahedraRayIntegral
 * @brief   vtkTetrahedraRayIntegral for ParaView, with blocks of surfaces and a table of interfaces
 *
 * Use it on one rank: rays are not continued in the cells of other ranks. See InterfaceTable for
 * the rows of the table.
 */
#ifndef vtkPVTetrahedraRayIntegral_h
#define vtkPVTetrahedraRayIntegral_h

#include "SurfaceGathering.h"                 // For the table of interfaces
#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkTetrahedraRayIntegral.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVTetrahedraRayIntegral : public vtkTetrahedraRayIntegral
{
public:
  vtkTypeMacro(vtkPVTetrahedraRayIntegral, vtkTetrahedraRayIntegral);

private:
  meniscusSurfaceGatheringDeclarations(vtkPVTetrahedraRayIntegral, RequestUpdateExtent);
};

#endif
