// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVTriangulatedPositionFilter
 * @brief   vtkTriangulatedPositionFilter for ParaView, with the surfaces of all ranks and blocks
 *
 * Every rank triangulates its own observations: all observations of one object point must be on one
 * rank. See InterfaceTable for the rows of the table.
 */
#ifndef vtkPVTriangulatedPositionFilter_h
#define vtkPVTriangulatedPositionFilter_h

#include "SurfaceGathering.h"                 // For the table of interfaces
#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkTriangulatedPositionFilter.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVTriangulatedPositionFilter
  : public vtkTriangulatedPositionFilter
{
public:
  vtkTypeMacro(vtkPVTriangulatedPositionFilter, vtkTriangulatedPositionFilter);

private:
  meniscusSurfaceGatheringDeclarations(vtkPVTriangulatedPositionFilter, ComputeInputUpdateExtent);
};

#endif
