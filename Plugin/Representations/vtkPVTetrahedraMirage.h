// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVTetrahedraMirage
 * @brief   vtkTetrahedraMirage whose camera is set by numbers
 *
 * For ParaView, whose proxies set numbers and no vtkCamera.
 */
#ifndef vtkPVTetrahedraMirage_h
#define vtkPVTetrahedraMirage_h

#include "vtkCamera.h"                        // For the numbers
#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkTetrahedraMirage.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVTetrahedraMirage : public vtkTetrahedraMirage
{
public:
  static vtkPVTetrahedraMirage* New();
  vtkTypeMacro(vtkPVTetrahedraMirage, vtkTetrahedraMirage);

  /** @{ */
  /**
   * Set the camera: position, focal point, view up, vertical view angle in degrees, and for a
   * parallel view half of the height of the picture. Defaults are vtkCamera's.
   */
  void SetEyePosition(double x, double y, double z) { this->GetCamera()->SetPosition(x, y, z); }
  void SetViewFocalPoint(double x, double y, double z)
  {
    this->GetCamera()->SetFocalPoint(x, y, z);
  }
  void SetCameraViewUp(double x, double y, double z) { this->GetCamera()->SetViewUp(x, y, z); }
  void SetViewAngle(double degrees) { this->GetCamera()->SetViewAngle(degrees); }
  void SetViewParallelProjection(int isParallel)
  {
    this->GetCamera()->SetParallelProjection(isParallel);
  }
  void SetViewParallelScale(double scale) { this->GetCamera()->SetParallelScale(scale); }
  /** @} */

protected:
  vtkPVTetrahedraMirage();
  ~vtkPVTetrahedraMirage() override;

private:
  vtkPVTetrahedraMirage(const vtkPVTetrahedraMirage&) = delete;
  void operator=(const vtkPVTetrahedraMirage&) = delete;
};

#endif
