// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDepthImagePoints
 * @brief   points where a camera sees the pixels of a depth image
 *
 * The input is a vtkImageData of one slice whose point scalars, or the point array of
 * SetInputArrayToProcess(), are depths; its lower left pixel is the first one. The output has a
 * vertex for each pixel with a depth, on the ray through the middle of the pixel, in world
 * coordinates and double precision. Pixels whose depth is not finite or not positive, and pixels of
 * the far plane in a depth buffer, are left out. The other point arrays of the image are copied,
 * and the point array `PixelId` (vtkIdType) has the number of the pixel, from 0.
 *
 * VTK's vtkDepthImageToPointCloud is not used: it only takes depth buffers, draws the first and the
 * last pixel at the edges of the view instead of half a pixel inside, keeps depths that are not
 * finite and copies no arrays but colours.
 *
 * vtkTruePositionFilter with the camera's position as the eye moves the points to where they are.
 * Its SetDepth() chooses the meaning of a distance behind a refracting surface: the apparent depth
 * of rendered virtual geometry, the optical length of a laser scan, or the length of the path.
 *
 * @sa vtkTruePositionFilter
 */
#ifndef vtkDepthImagePoints_h
#define vtkDepthImagePoints_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

class vtkCamera;
class vtkDataArray;
class vtkImageData;

class VTKMENISCUS_EXPORT vtkDepthImagePoints : public vtkPolyDataAlgorithm
{
public:
  static vtkDepthImagePoints* New();
  vtkTypeMacro(vtkDepthImagePoints, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Meanings of a depth. */
  enum
  {
    DEPTH_BUFFER = 0, ///< value of OpenGL's depth buffer, from 0 to 1
    VIEW_DEPTH = 1,   ///< distance from the eye along the direction of projection
    RANGE = 2         ///< distance from the eye, as a scanner gives it
  };

  /** @{ */
  /**
   * Set/Get the camera that made the image. Without a camera, the default, or with a parallel
   * projection, the filter reports an error when it runs.
   */
  void SetCamera(vtkCamera* camera);
  vtkCamera* GetCamera();
  /** @} */

  /** @{ */
  /** Set/Get the meaning of the depths. Default is DEPTH_BUFFER. */
  virtual void SetDepthType(int type);
  vtkGetMacro(DepthType, int);
  void SetDepthTypeToDepthBuffer() { this->SetDepthType(DEPTH_BUFFER); }
  void SetDepthTypeToViewDepth() { this->SetDepthType(VIEW_DEPTH); }
  void SetDepthTypeToRange() { this->SetDepthType(RANGE); }
  /** @} */

  /** Modification time of this object and of the camera. */
  vtkMTimeType GetMTime() override;

protected:
  vtkDepthImagePoints();
  ~vtkDepthImagePoints() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkDepthImagePoints(const vtkDepthImagePoints&) = delete;
  void operator=(const vtkDepthImagePoints&) = delete;

  const char* FindFault(vtkImageData* image, vtkDataArray* depths) const;

  vtkSmartPointer<vtkCamera> Camera;
  int DepthType = DEPTH_BUFFER;
};

#endif
