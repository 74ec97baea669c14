// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVDepthImagePoints
 * @brief   vtkDepthImagePoints whose camera is set by numbers
 *
 * For ParaView, whose proxies set numbers and no vtkCamera.
 */
#ifndef vtkPVDepthImagePoints_h
#define vtkPVDepthImagePoints_h

#include "vtkCamera.h" // For the numbers
#include "vtkDepthImagePoints.h"
#include "vtkMeniscusRepresentationsModule.h" // For export macro

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVDepthImagePoints : public vtkDepthImagePoints
{
public:
  static vtkPVDepthImagePoints* New();
  vtkTypeMacro(vtkPVDepthImagePoints, vtkDepthImagePoints);

  /** @{ */
  /**
   * Set the camera that took the image: position, focal point, view up, vertical view angle in
   * degrees, and the distances of the near and the far clipping plane, which only depth buffers
   * need. Defaults are vtkCamera's.
   */
  void SetEyePosition(double x, double y, double z) { this->GetCamera()->SetPosition(x, y, z); }
  void SetViewFocalPoint(double x, double y, double z)
  {
    this->GetCamera()->SetFocalPoint(x, y, z);
  }
  void SetViewUp(double x, double y, double z) { this->GetCamera()->SetViewUp(x, y, z); }
  void SetViewAngle(double degrees) { this->GetCamera()->SetViewAngle(degrees); }
  void SetViewClippingRange(double near, double far)
  {
    this->GetCamera()->SetClippingRange(near, far);
  }
  /** @} */

protected:
  vtkPVDepthImagePoints();
  ~vtkPVDepthImagePoints() override;

private:
  vtkPVDepthImagePoints(const vtkPVDepthImagePoints&) = delete;
  void operator=(const vtkPVDepthImagePoints&) = delete;
};

#endif
