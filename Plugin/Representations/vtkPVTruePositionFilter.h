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
  static vtkPVTruePositionFilter* New();
  vtkTypeMacro(vtkPVTruePositionFilter, vtkTruePositionFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** @{ */
  /**
   * Set the rows of the table of interfaces and their number, and the two indices that are used
   * without rows. See InterfaceTable.
   */
  meniscusInterfaceTableDeclarations();
  /** @} */

  /** Sets the exact form of the first surface, in all rows that name it. */
  void SetExactMembrane(vtkImplicitFunction* function);

  int ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

protected:
  vtkPVTruePositionFilter();
  ~vtkPVTruePositionFilter() override;

  meniscusBlockPortsDeclarations(ComputeInputUpdateExtent);
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPVTruePositionFilter(const vtkPVTruePositionFilter&) = delete;
  void operator=(const vtkPVTruePositionFilter&) = delete;

  meniscus::InterfaceTable Table;
};

#endif
