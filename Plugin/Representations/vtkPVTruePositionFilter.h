// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVTruePositionFilter
 * @brief   vtkTruePositionFilter for ParaView, on several ranks and for blocks
 *
 * Every rank moves its own points, behind the whole membranes, as in vtkPVRefractedGeometryFilter.
 */
#ifndef vtkPVTruePositionFilter_h
#define vtkPVTruePositionFilter_h

#include "SurfaceGathering.h"                 // For the table of interfaces
#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkTruePositionFilter.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVTruePositionFilter : public vtkTruePositionFilter
{
public:
  vtkTypeMacro(vtkPVTruePositionFilter, vtkTruePositionFilter);

  /** Sets the exact form of the first surface, in all rows that name it. */
  void SetExactMembrane(vtkImplicitFunction* function);

private:
  meniscusBlockPortsDeclarations(vtkPVTruePositionFilter, ComputeInputUpdateExtent);
};

#endif
