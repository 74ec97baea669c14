// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVTetrahedraMirage
 * @brief   vtkTetrahedraMirage for ParaView, whose proxies set numbers, functions and inputs
 *
 * The camera is set by numbers, the volume property by its functions. Port 2, which is optional,
 * has the image of the texture.
 */
#ifndef vtkPVTetrahedraMirage_h
#define vtkPVTetrahedraMirage_h

#include "vtkCamera.h"                        // For the numbers
#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkNew.h"                           // For members
#include "vtkTetrahedraMirage.h"

class vtkColorTransferFunction;
class vtkPiecewiseFunction;
class vtkTexture;
class vtkVolumeProperty;

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

  /** @{ */
  /** Show the medium itself by functions of a volume property, or, the default, do not. */
  void SetShowVolume(bool isShown);
  void SetVolumeColors(vtkColorTransferFunction* colors);
  void SetVolumeOpacity(vtkPiecewiseFunction* opacity);
  void SetScalarOpacityUnitDistance(double distance);
  /** @} */

  /** @{ */
  /** Remove an optional input, which a proxy does before it sets one. */
  void RemoveObjects() { this->RemoveAllInputConnections(1); }
  void RemoveTexturePicture() { this->RemoveAllInputConnections(2); }
  /** @} */

protected:
  vtkPVTetrahedraMirage();
  ~vtkPVTetrahedraMirage() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPVTetrahedraMirage(const vtkPVTetrahedraMirage&) = delete;
  void operator=(const vtkPVTetrahedraMirage&) = delete;

  vtkNew<vtkVolumeProperty> Functions;
  vtkNew<vtkTexture> Picture;
};

#endif
