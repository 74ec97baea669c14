// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBentRayAlgorithm
 * @brief   base of the filters that cast rays of an image through a medium that bends light
 *
 * Input port 0 is the mesh, read as vtkBentMediumAlgorithm describes. Rays are parallel along
 * Direction, around the mesh's bounding box, or come from Camera, one per pixel of ImageSize. The
 * output is a vtkImageData with one point per pixel.
 *
 * Errors, with an empty output, besides those of the mesh: an image size below 1, a direction that
 * is zero or parallel to ViewUp.
 *
 * @sa vtkTetrahedraSchlieren vtkTetrahedraMirage
 */
#ifndef vtkBentRayAlgorithm_h
#define vtkBentRayAlgorithm_h

#include "vtkBentMediumAlgorithm.h"
#include "vtkMeniscusModule.h" // For export macro
#include "vtkSmartPointer.h"   // For members

#include <cstddef>    // For std::size_t
#include <functional> // For std::function
#include <memory>     // For std::unique_ptr

class vtkCamera;
class vtkDataObject;

namespace meniscus
{
struct BentRayView;
}

class VTKMENISCUS_EXPORT vtkBentRayAlgorithm : public vtkBentMediumAlgorithm
{
public:
  vtkTypeMacro(vtkBentRayAlgorithm, vtkBentMediumAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** @{ */
  /**
   * Set/Get whether the medium bends the rays. Otherwise they are straight, and their deflection is
   * the integral of grad(n) / n across them: the usual approximation for small angles. Default is
   * on.
   */
  vtkSetMacro(BendRays, vtkTypeBool);
  vtkGetMacro(BendRays, vtkTypeBool);
  vtkBooleanMacro(BendRays, vtkTypeBool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the direction of parallel rays and the direction that is drawn upwards; any lengths,
   * not parallel to each other. Defaults are (0, 0, -1) and (0, 1, 0).
   */
  vtkSetVector3Macro(Direction, double);
  vtkGetVector3Macro(Direction, double);
  vtkSetVector3Macro(ViewUp, double);
  vtkGetVector3Macro(ViewUp, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the camera whose rays are used, perspective or parallel. Null, the default, stands for
   * parallel rays along Direction.
   */
  void SetCamera(vtkCamera* camera);
  vtkCamera* GetCamera();
  /** @} */

  /** @{ */
  /** Set/Get the number of pixels, at least 1 by 1. Default is 256 by 256. */
  vtkSetVector2Macro(ImageSize, int);
  vtkGetVector2Macro(ImageSize, int);
  /** @} */

  /** Includes the time of the camera. */
  vtkMTimeType GetMTime() override;

protected:
  vtkBentRayAlgorithm();
  ~vtkBentRayAlgorithm() override;

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /**
   * Reads the mesh and computes the rays before they are bent. Returns false after an error, which
   * has been reported, or an abort.
   * @param input the mesh, of port 0.
   * @param share share of the progress that this takes.
   */
  bool UpdateView(vtkDataObject* input, double share);
  /**
   * Calls body(first, end) for blocks of the image's rows, on several threads. Returns false after
   * an abort.
   * @param body is given a block's first row and the row after its last.
   * @param from progress at which this begins.
   * @param share share of the progress that this takes.
   */
  bool RunRows(
    const std::function<void(std::size_t, std::size_t)>& body, double from, double share);
  /** Gives an image its size and, for parallel rays, its place. */
  void PlaceImage(vtkImageData* image);

  /** The rays of the last UpdateView(). */
  std::unique_ptr<meniscus::BentRayView> View;

private:
  vtkBentRayAlgorithm(const vtkBentRayAlgorithm&) = delete;
  void operator=(const vtkBentRayAlgorithm&) = delete;

  vtkTypeBool BendRays = 1;
  double Direction[3] = { 0.0, 0.0, -1.0 };
  double ViewUp[3] = { 0.0, 1.0, 0.0 };
  int ImageSize[2] = { 256, 256 };
  vtkSmartPointer<vtkCamera> Camera;
};

#endif
