// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVRefractedGeometryFilter
 * @brief   vtkRefractedGeometryFilter for ParaView: on several ranks, with a view given by numbers
 *
 * Every rank refracts its own geometry behind the whole membrane, which is gathered from all ranks
 * and blocks each time the filter runs. The geometry is not gathered. The membrane is transferred
 * once per run, and each rank keeps all of it: about 400 bytes per facet.
 *
 * Geometry may be composite; its output has the same structure, with empty blocks where the input
 * is not a vtkPolyData. `SightFacet` numbers the cells of the gathered membrane, which are the
 * input's cells if only one rank and block has any.
 *
 * The view for ViewCulling is given by numbers, which can be linked to the properties of a view.
 * ViewCulling is off by default, so that the output can be viewed from any side.
 */
#ifndef vtkPVRefractedGeometryFilter_h
#define vtkPVRefractedGeometryFilter_h

#include "SurfaceGathering.h"                 // For the table of interfaces
#include "vtkCamera.h"                        // For the view
#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkNew.h"                           // For the view
#include "vtkRefractedGeometryFilter.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVRefractedGeometryFilter
  : public vtkRefractedGeometryFilter
{
public:
  vtkTypeMacro(vtkPVRefractedGeometryFilter, vtkRefractedGeometryFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Sets the exact form of the first surface, in all rows that name it. */
  void SetExactMembrane(vtkImplicitFunction* function);

  using vtkRefractedGeometryFilter::SetEyePosition;
  void SetEyePosition(double x, double y, double z) override;
  void SetViewCulling(bool culling) override;

  /** @{ */
  /**
   * Set the view for ViewCulling, besides the eye's position: focal point, view up, and vertical
   * view angle in degrees. Defaults are (0, 0, 0), (0, 1, 0) and 30.
   */
  void SetViewFocalPoint(double x, double y, double z) { this->View->SetFocalPoint(x, y, z); }
  void SetViewUp(double x, double y, double z) { this->View->SetViewUp(x, y, z); }
  void SetViewAngle(double degrees) { this->View->SetViewAngle(degrees); }
  /** @} */

  /** @{ */
  /**
   * Set whether the view is parallel, and half its height in world units. The eye is then at
   * infinity, in the direction from the focal point to EyePosition. Defaults are false and 1.
   */
  void SetViewParallelProjection(bool parallel);
  void SetViewParallelScale(double scale) { this->View->SetParallelScale(scale); }
  /** @} */

private:
  void UseViewIfNeeded();

  vtkNew<vtkCamera> View;

  meniscusBlockPortsDeclarations(vtkPVRefractedGeometryFilter, RequestUpdateExtent);
};

#endif
