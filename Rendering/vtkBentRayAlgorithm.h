// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBentRayAlgorithm
 * @brief   base of the filters that cast rays of an image through a medium that bends light
 *
 * Input port 0 is the mesh: any vtkDataSet or vtkCompositeDataSet that vtkTetrahedraRayIntegral
 * takes. SetInputArrayToProcess(0, 0, 0, association, name) chooses a point array, by default the
 * active scalars: densities of a gas (Quantity DENSITY), from which n = 1 + GladstoneDale *
 * density, or values of n (REFRACTIVE_INDEX). n^2 is quadratic in each tetrahedron, linear at
 * jumps, and rays are exact in it; there is no step size. Errors are of second order in the size of
 * the cells.
 *
 * Rays are parallel along Direction, around the mesh's bounding box, or come from Camera, one per
 * pixel of ImageSize. The output is a vtkImageData with one point per pixel, unless a subclass
 * overrides FillOutputPortInformation().
 *
 * Cells with a value that is not finite, with n <= 0 or with a negative density are holes; indices
 * below 1 are used. Warnings report both. Errors, with an empty output: no cells, no such point
 * array, no usable values, an image size below 1, a direction that is zero or parallel to ViewUp.
 *
 * @sa vtkTetrahedraSchlieren vtkTetrahedraMirage
 */
#ifndef vtkBentRayAlgorithm_h
#define vtkBentRayAlgorithm_h

#include "vtkImageAlgorithm.h"
#include "vtkMeniscusModule.h" // For export macro
#include "vtkSmartPointer.h"   // For members

#include <cstddef>    // For std::size_t
#include <functional> // For std::function
#include <memory>     // For std::unique_ptr
#include <string>     // For std::string

class vtkCamera;
class vtkDataObject;

namespace meniscus
{
struct BentRayView;
}

class VTKMENISCUS_EXPORT vtkBentRayAlgorithm : public vtkImageAlgorithm
{
public:
  vtkTypeMacro(vtkBentRayAlgorithm, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Meanings of the input's values. */
  enum
  {
    DENSITY = 0,         ///< density of a gas
    REFRACTIVE_INDEX = 1 ///< index of refraction
  };

  /** @{ */
  /** Set/Get the meaning of the input's values. Default is DENSITY. */
  virtual void SetQuantity(int quantity);
  vtkGetMacro(Quantity, int);
  void SetQuantityToDensity() { this->SetQuantity(DENSITY); }
  void SetQuantityToRefractiveIndex() { this->SetQuantity(REFRACTIVE_INDEX); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the Gladstone-Dale constant, volume per mass. Default is 2.26157e-4 m^3/kg: dry air at
   * 589.3 nm, by Ciddor's equations (Applied Optics 35, 1996).
   */
  vtkSetMacro(GladstoneDale, double);
  vtkGetMacro(GladstoneDale, double);
  /** @} */

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
   * Set/Get the index of refraction outside of the mesh, >= 0, for Snell's law on its boundary:
   * for lenses and solids. With 0, the default, nothing is refracted there: the boundary is the end
   * of the data, not of the medium. Has no effect on straight rays.
   */
  virtual void SetOutsideIndex(double index);
  vtkGetMacro(OutsideIndex, double);
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

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /** Reports an error, if there is one. Returns true if there is none. */
  bool TellError(const std::string& error);
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

  /** The medium and the rays of the last UpdateView(). */
  std::unique_ptr<meniscus::BentRayView> View;

private:
  vtkBentRayAlgorithm(const vtkBentRayAlgorithm&) = delete;
  void operator=(const vtkBentRayAlgorithm&) = delete;

  int Quantity = DENSITY;
  double GladstoneDale;
  vtkTypeBool BendRays = 1;
  double OutsideIndex = 0.0;
  double Direction[3] = { 0.0, 0.0, -1.0 };
  double ViewUp[3] = { 0.0, 1.0, 0.0 };
  int ImageSize[2] = { 256, 256 };
  vtkSmartPointer<vtkCamera> Camera;
};

#endif
