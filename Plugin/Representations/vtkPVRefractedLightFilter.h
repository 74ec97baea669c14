// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVRefractedLightFilter
 * @brief   vtkRefractedLightFilter for ParaView on several ranks
 *
 * Every rank lights its own geometry through the whole membrane, as in
 * vtkPVRefractedGeometryFilter. A light at infinity has the same position for all ranks and blocks,
 * so that a cell has the same irradiance on whichever rank it is. Points on the border of a rank's
 * part have the mean of its own cells.
 */
#ifndef vtkPVRefractedLightFilter_h
#define vtkPVRefractedLightFilter_h

#include "SurfaceGathering.h"                 // For the table of interfaces
#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkRefractedLightFilter.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVRefractedLightFilter : public vtkRefractedLightFilter
{
public:
  vtkTypeMacro(vtkPVRefractedLightFilter, vtkRefractedLightFilter);

private:
  meniscusBlockPortsDeclarations(vtkPVRefractedLightFilter, RequestUpdateExtent);
};

#endif
