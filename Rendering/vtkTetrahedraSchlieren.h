// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraSchlieren
 * @brief   shadowgraph, schlieren image and interferogram of a medium that bends light
 *
 * Casts one ray of light per pixel through a mesh in which the index of refraction n varies, and
 * writes what optical instruments make of the rays, as float arrays of a vtkImageData. It needs
 * neither a window nor OpenGL. n^2 is quadratic in each tetrahedron, linear at jumps, and rays are
 * exact in it; there is no step size. Errors are of second order in the size of the cells.
 *
 * Input port 0 is the mesh: any vtkDataSet or vtkCompositeDataSet that vtkTetrahedraRayIntegral
 * takes. SetInputArrayToProcess(0, 0, 0, association, name) chooses a point array, by default the
 * active scalars: densities of a gas (Quantity DENSITY), from which n = 1 + GladstoneDale *
 * density, or values of n (REFRACTIVE_INDEX). Input port 1, optional, is a vtkImageData with a
 * background picture: the first component of its active point scalars, its lowest slice.
 *
 * Rays are parallel along Direction, around the mesh's bounding box, or come from Camera. The
 * output has ImageSize points, one per pixel, and these point arrays of 32-bit floats. Brackets
 * name the values of rays that miss the mesh or were stopped in it:
 * - `Deflection`, 2 components: change of the slope of the ray, tangents along the image's axes
 *   [0];
 * - `OpticalPathDifference`: integral of n - ReferenceIndex along the ray, a length [0];
 * - `Shadowgraph`: irradiance on a screen ScreenDistance behind the mesh, over the irradiance
 *   without a medium. Light that reaches a pixel on several ways adds up, as in caustics; light of
 *   stopped rays is missing;
 * - `Schlieren`: share of the light that passes a knife edge, from 0 to 1 [1 - KnifeCutOff];
 * - `Interferogram`: intensity of the light superposed with a plane reference wave, from 0 to 1;
 * - `Displacement`, 2 components: shift of a background BackgroundDistance behind the mesh as seen
 *   through it, in pixels [0];
 * - `Background`: the background picture as seen through the mesh; only with input port 1. The
 *   picture fills the image if nothing deflects the rays.
 *
 * Lengths are in world coordinates, the coordinates of the input. "Behind the mesh" counts from the
 * far side of its bounding box along the middle ray.
 *
 * **Bad input.** Cells with a value that is not finite, with n <= 0 or with a negative density are
 * holes; indices below 1 are used. Rays that stay in the mesh are stopped. Warnings report these,
 * and GetStatistics() counts them. Errors, with an empty output: no
 * cells, no such point array, no usable values, an image size below 1, a background without pixels,
 * a direction that is zero or parallel to ViewUp.
 *
 * Rays are cast in parallel by vtkSMPTools; results do not depend on the number of threads. They
 * are kept: if only instruments change, such as the knife edge, a distance, the wavelength or the
 * background, no ray is cast again.
 *
 * @sa vtkTetrahedraRayIntegral
 */
#ifndef vtkTetrahedraSchlieren_h
#define vtkTetrahedraSchlieren_h

#include "vtkImageAlgorithm.h"
#include "vtkMeniscusModule.h" // For export macro
#include "vtkSmartPointer.h"   // For members

#include <memory> // For std::unique_ptr

class vtkCamera;
class vtkTable;

namespace meniscus
{
struct InputBlocks;
}

class VTKMENISCUS_EXPORT vtkTetrahedraSchlieren : public vtkImageAlgorithm
{
public:
  static vtkTetrahedraSchlieren* New();
  vtkTypeMacro(vtkTetrahedraSchlieren, vtkImageAlgorithm);
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
  /** Set/Get the index that optical path differences are relative to. Default is 1. */
  vtkSetMacro(ReferenceIndex, double);
  vtkGetMacro(ReferenceIndex, double);
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

  /** @{ */
  /** Set/Get the distance of the shadowgraph's screen behind the mesh, a length. Default is 1. */
  vtkSetMacro(ScreenDistance, double);
  vtkGetMacro(ScreenDistance, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the angle of the knife edge: the direction from the blade into the open, in degrees
   * from the image's first axis to its second one. Default is 90, a horizontal blade below.
   */
  vtkSetMacro(KnifeAngle, double);
  vtkGetMacro(KnifeAngle, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the share of the light that the knife cuts off without a medium, in [0, 1]. Default is
   * 0.5.
   */
  virtual void SetKnifeCutOff(double part);
  vtkGetMacro(KnifeCutOff, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the difference in deflection, as a slope, between rays that are wholly cut off and rays
   * that wholly pass: width of the light source's image over the focal length of the schlieren
   * head, >= 0. With 0, the default, it is twice the largest deflection towards or away from the
   * knife in the image.
   */
  virtual void SetKnifeRange(double range);
  vtkGetMacro(KnifeRange, double);
  /** @} */

  /** @{ */
  /** Set/Get the wavelength in the input's unit of length, > 0. Default is 589.3e-9. */
  vtkSetMacro(Wavelength, double);
  vtkGetMacro(Wavelength, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the tilt of the interferogram's reference wave: numbers of fringes over the width and
   * over the height of the image. Default is (0, 0): infinite fringes.
   */
  vtkSetVector2Macro(Fringes, double);
  vtkGetVector2Macro(Fringes, double);
  /** @} */

  /** @{ */
  /** Set/Get the distance of the background behind the mesh, a length. Default is 1. */
  vtkSetMacro(BackgroundDistance, double);
  vtkGetMacro(BackgroundDistance, double);
  /** @} */

  /** @{ */
  /**
   * Counters by name: a table with one row each and the columns Name, Meaning and Value, which
   * belongs to this object and is filled anew by each call; and the value of one name, such as
   * "NumberOfStoppedRays". An unknown name is an error, and the value is not a number.
   */
  vtkTable* GetStatistics();
  double GetStatistic(const char* name);
  /** @} */

  /** Includes the time of the camera. */
  vtkMTimeType GetMTime() override;

protected:
  vtkTetrahedraSchlieren();
  ~vtkTetrahedraSchlieren() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTetrahedraSchlieren(const vtkTetrahedraSchlieren&) = delete;
  void operator=(const vtkTetrahedraSchlieren&) = delete;

  class vtkInternals;

  bool TellError(const std::string& error);
  bool CheckSettings(vtkImageData* background);
  bool UpdateMedium(vtkDataObject* input);
  void ReadIndices(const meniscus::InputBlocks& blocks);
  bool UpdateView();
  bool UpdateRays();
  void MakeImages(vtkImageData* background, vtkImageData* output);

  int Quantity = DENSITY;
  double GladstoneDale;
  vtkTypeBool BendRays = 1;
  double OutsideIndex = 0.0;
  double ReferenceIndex = 1.0;
  double Direction[3] = { 0.0, 0.0, -1.0 };
  double ViewUp[3] = { 0.0, 1.0, 0.0 };
  int ImageSize[2] = { 256, 256 };
  double ScreenDistance = 1.0;
  double KnifeAngle = 90.0;
  double KnifeCutOff = 0.5;
  double KnifeRange = 0.0;
  double Wavelength = 589.3e-9;
  double Fringes[2] = { 0.0, 0.0 };
  double BackgroundDistance = 1.0;
  vtkSmartPointer<vtkCamera> Camera;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
