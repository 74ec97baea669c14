// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraSchlieren
 * @brief   shadowgraph, schlieren image and interferogram of a medium that bends light
 *
 * Casts one ray of light per pixel through a mesh in which the index of refraction n varies, and
 * writes the images that optical instruments make of the rays, as float arrays of a vtkImageData.
 * It needs neither a window nor OpenGL. Mesh, rays and image are those of vtkBentRayAlgorithm.
 * Input port 1, optional, is a vtkImageData with a background picture: the first component of its
 * active point scalars, its lowest slice.
 *
 * The output has these point arrays of 32-bit floats. Brackets name the values of rays that miss
 * the mesh or were stopped in it:
 * - `Deflection`, 2 components: change of the slope of the ray, tangents along the image's axes
 *   [0];
 * - `OpticalPathDifference`: integral of n - ReferenceIndex along the ray, a length [0];
 * - `Shadowgraph`: irradiance on a screen ScreenDistance behind the mesh, over the irradiance
 *   without a medium. Light that reaches a pixel along several paths adds up, as in caustics; light
 *   of stopped rays is missing;
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
 * **Bad input.** Rays that stay in the mesh are stopped; a warning reports them. GetStatistics()
 * counts them, and also the rays that have passed inverted cells, where light goes back. A
 * background without pixels is an error, with an empty output.
 *
 * Rays are cast in parallel by vtkSMPTools; results do not depend on the number of threads. They
 * are kept: if only instruments change, such as the knife edge, a distance, the wavelength or the
 * background, no ray is cast again.
 *
 * @sa vtkTetrahedraMirage vtkTetrahedraRayIntegral
 */
#ifndef vtkTetrahedraSchlieren_h
#define vtkTetrahedraSchlieren_h

#include "vtkBentRayAlgorithm.h"
#include "vtkMeniscusModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkTable;

class VTKMENISCUS_EXPORT vtkTetrahedraSchlieren : public vtkBentRayAlgorithm
{
public:
  static vtkTetrahedraSchlieren* New();
  vtkTypeMacro(vtkTetrahedraSchlieren, vtkBentRayAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** @{ */
  /** Set/Get the index that optical path differences are relative to. Default is 1. */
  vtkSetMacro(ReferenceIndex, double);
  vtkGetMacro(ReferenceIndex, double);
  /** @} */

  /** @{ */
  /** Set/Get the distance of the shadowgraph's screen behind the mesh. Default is 1. */
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

protected:
  vtkTetrahedraSchlieren();
  ~vtkTetrahedraSchlieren() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTetrahedraSchlieren(const vtkTetrahedraSchlieren&) = delete;
  void operator=(const vtkTetrahedraSchlieren&) = delete;

  class vtkInternals;

  bool CheckSettings(vtkImageData* background);
  bool UpdateRays();
  void MakeImages(vtkImageData* background, vtkImageData* output);

  double ReferenceIndex = 1.0;
  double ScreenDistance = 1.0;
  double KnifeAngle = 90.0;
  double KnifeCutOff = 0.5;
  double KnifeRange = 0.0;
  double Wavelength = 589.3e-9;
  double Fringes[2] = { 0.0, 0.0 };
  double BackgroundDistance = 1.0;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
