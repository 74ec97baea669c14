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
  static vtkPVRefractedLightFilter* New();
  vtkTypeMacro(vtkPVRefractedLightFilter, vtkRefractedLightFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** @{ */
  /**
   * Set the rows of the table of interfaces and their number, and the two indices that are used
   * without rows. See InterfaceTable.
   */
  meniscusInterfaceTableDeclarations();
  /** @} */

  int ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

protected:
  vtkPVRefractedLightFilter();
  ~vtkPVRefractedLightFilter() override;

  meniscusBlockPortsDeclarations(RequestUpdateExtent);
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPVRefractedLightFilter(const vtkPVRefractedLightFilter&) = delete;
  void operator=(const vtkPVRefractedLightFilter&) = delete;

  meniscus::InterfaceTable Table;
};

#endif
