// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractionErrorVolume
 * @brief   error of virtual geometry behind a membrane, over a box
 *
 * The error volumes of the thesis "Refraction by geometric transforms", section 4.1, for any
 * membrane, eye and box. They show whether a membrane's mesh is good enough for a scene before
 * geometry is placed behind it.
 *
 * Each sample of a regular grid is taken as a true point and moved to its virtual point with the
 * membrane's mesh, as vtkRefractedGeometryFilter does it. The sight ray of the virtual point is
 * then traced through the exact surface, Eq. 2.2, and Eq. 2.4 is inverted on the refracted ray. The
 * error is the distance between the resulting point and the sample, in world units.
 *
 * Input port 0 is the membrane, as for vtkRefractedGeometryFilter; it is repeatable (see
 * SetInterfaces() for several surfaces), and so is port 1. The exact surface is
 * - an implicit function that the membrane's points lie on (SetExactMembrane), with its gradient;
 * - otherwise the membrane on the optional input port 1, a finer mesh of the same surface, as
 *   curved patches;
 * - otherwise the curved patches of the membrane itself. This measures the error of FLAT_FACETS
 *   only; CURVED has no error by this measure, and the filter warns.
 *
 * Output is a vtkImageData with point arrays:
 * - `RefractionError` (the active scalars, 1 double, world length): NaN if not measured;
 * - `SampleState` (1 unsigned char): MEASURED, NO_IMAGE (outside the visible volume),
 *   SEVERAL_IMAGES (zones of convergence; with FLAT_FACETS, points in more than one cell),
 *   NO_EXACT_POINT (the sight ray misses the exact surface or is totally reflected), NOT_FINITE
 *   (coordinates out of range);
 * - `ErrorColor` (3 unsigned char): the thesis's colours, green below the first of ColorLimits,
 *   blue below the second, red below the third and white above, darker for smaller errors of the
 *   same colour; black if not measured;
 * - `AngularError` (1 double, degrees), with AngularErrorsOn(): angle at the eye between the places
 *   where the sample is drawn and where it would be seen; NaN if there is no such place nearby.
 *
 * As in the thesis, the statistics are over MEASURED samples only. They are also in the field data,
 * as `MeanError`, `StandardDeviation`, `LargestError` and `NumberOfMeasuredSamples`, and refer to
 * the part of the volume that was requested last.
 *
 * Samples are measured in parallel with vtkSMPTools; results do not depend on the number of
 * threads. An implicit function is evaluated on all of them, as in vtkSampleFunction. Progress is
 * reported; after an abort the output is empty. Cost: about 1 microsecond per sample and thread
 * with FLAT_FACETS, 3 with CURVED; angles take up to ten times as long. The membrane's mesh is
 * read again only if its values change, and rays are computed again only if the eye or an index
 * changes.
 *
 * @note A point with an error of 20 units far below the membrane may look better than one with an
 *   error of 2 just below it (thesis): `RefractionError` is a length in the interior.
 *   `AngularError` is what a viewer sees. In a picture of h rows with a view angle of a, an error
 *   of e in the middle is h tan(e) / (2 tan(a / 2)) pixels.
 * @note A ray may meet an implicit function beyond the border of the membrane's mesh.
 *
 * @sa vtkRefractedGeometryFilter
 */
#ifndef vtkRefractionErrorVolume_h
#define vtkRefractionErrorVolume_h

#include "vtkImageAlgorithm.h"
#include "vtkMeniscusModule.h" // For export macro
#include "vtkSmartPointer.h"   // For the implicit function

#include <functional> // For std::function
#include <memory>     // For std::unique_ptr

class vtkRefractingInterfaceCollection;
class vtkImageData;
class vtkImplicitFunction;
class vtkPolyData;

class VTKMENISCUS_EXPORT vtkRefractionErrorVolume : public vtkImageAlgorithm
{
public:
  static vtkRefractionErrorVolume* New();
  vtkTypeMacro(vtkRefractionErrorVolume, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Models of the membrane between its points, as in vtkRefractedGeometryFilter. */
  enum
  {
    FLAT_FACETS = 0, ///< linear interpolation in each facet, the thesis's method
    CURVED = 1       ///< smooth patches from positions and normals
  };

  /** Values of the array SampleState. */
  enum SampleStates
  {
    MEASURED = 0,       ///< the sample has an error
    NO_IMAGE = 1,       ///< outside the visible volume
    SEVERAL_IMAGES = 2, ///< zones of convergence
    NO_EXACT_POINT = 3, ///< the sight ray misses the exact surface or is totally reflected
    NOT_FINITE = 4      ///< coordinates out of range
  };

  /** @{ */
  /**
   * Set/Get the eye's position in world coordinates. Default is (0, 0, 1).
   */
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the indices of refraction on the eye's side and behind the membrane. Must be positive
   * and finite; anything else is an error when the filter runs. Defaults are 1.0 and 1.333.
   */
  virtual void SetExteriorIndexOfRefraction(double index);
  virtual double GetExteriorIndexOfRefraction();
  virtual void SetInteriorIndexOfRefraction(double index);
  virtual double GetInteriorIndexOfRefraction();
  /** @} */

  /** @{ */
  /**
   * Set/Get the refracting interfaces, in the order in which sight rays meet them. The list may be
   * shared with other filters and mappers. Interface i has the surface of connection i of port 0,
   * the indices of refraction and the exact surface; another number of connections is an error when
   * the filter runs. Null, the default, stands for a list of one with default values.
   *
   * With several interfaces, as for vtkRefractedGeometryFilter::SetInterfaces(), MembraneModel must
   * be CURVED. Port 1 has a finer mesh for each interface, or none.
   */
  void SetInterfaces(vtkRefractingInterfaceCollection* interfaces);
  vtkRefractingInterfaceCollection* GetInterfaces();
  /** @} */

  /** @{ */
  /** Set/Get the membrane model under test, FLAT_FACETS or CURVED. Default is CURVED. */
  virtual void SetMembraneModel(int model);
  vtkGetMacro(MembraneModel, int);
  void SetMembraneModelToFlatFacets() { this->SetMembraneModel(FLAT_FACETS); }
  void SetMembraneModelToCurved() { this->SetMembraneModel(CURVED); }
  /** @} */

  /** @{ */
  /**
   * Set/Get an implicit function whose zero set is the exact surface, on which the membrane's
   * points lie. The eye's side of it follows from the membrane's normals. Default is none.
   */
  void SetExactMembrane(vtkImplicitFunction* function);
  vtkImplicitFunction* GetExactMembrane();
  /** @} */

  /** @{ */
  /**
   * Add the surface of the next interface of the list to port 0, by connection or as data; remove
   * all surfaces; get their number. SetInterfaces() has the indices of refraction.
   */
  void AddMembraneConnection(vtkAlgorithmOutput* output);
  void AddMembraneData(vtkPolyData* membrane);
  void RemoveAllMembranes();
  int GetNumberOfMembranes();
  /** @} */

  /**
   * Set the finer membrane, port 1, by connection. Not used if there is an implicit function.
   */
  void SetReferenceConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  /**
   * Set the finer membrane, port 1, without a pipeline connection.
   */
  void SetReferenceData(vtkPolyData* membrane);
  /** @{ */
  /**
   * Add the finer membrane of the next interface, by connection or as data; remove all of them.
   */
  void AddReferenceConnection(vtkAlgorithmOutput* output) { this->AddInputConnection(1, output); }
  void AddReferenceData(vtkPolyData* membrane);
  void RemoveAllReferences();
  /** @} */

  /** @{ */
  /**
   * Set/Get the box, (xmin, xmax, ymin, ymax, zmin, zmax) in world coordinates. Values must be
   * finite, and no minimum above its maximum; anything else is an error. Default is -1 to 1 along
   * each axis.
   */
  vtkSetVector6Macro(ModelBounds, double);
  vtkGetVector6Macro(ModelBounds, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the number of samples along each side of the box, from border to border; a single
   * sample is at the minimum. Numbers below 1 are an error. Default is 40 along each side, as in
   * the thesis.
   */
  vtkSetVector3Macro(SampleDimensions, int);
  vtkGetVector3Macro(SampleDimensions, int);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether the array AngularError is made. Default is off.
   */
  vtkSetMacro(AngularErrors, bool);
  vtkGetMacro(AngularErrors, bool);
  vtkBooleanMacro(AngularErrors, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the errors, in world units, at which the array ErrorColor turns from green to blue,
   * from blue to red and from red to white. Values that are not positive, finite and in ascending
   * order are an error. Defaults are 1, 10 and 100, as in the thesis.
   */
  vtkSetVector3Macro(ColorLimits, double);
  vtkGetVector3Macro(ColorLimits, double);
  /** @} */

  /** @{ */
  /**
   * Statistics of the last update: mean, standard deviation and largest of the errors, in world
   * units, and the number of samples. 0 if nothing was measured.
   */
  double GetMeanError() const;
  double GetStandardDeviation() const;
  double GetLargestError() const;
  vtkTypeInt64 GetNumberOfMeasuredSamples() const;
  /** @} */

  /** @{ */
  /**
   * Counters since construction: number of times that the membrane's shape was read, and number of
   * times that rays were computed for it.
   */
  vtkTypeInt64 GetNumberOfPatchBuilds() const;
  vtkTypeInt64 GetNumberOfEyeUpdates() const;
  /** @} */

  /** Includes the time of the implicit function. */
  vtkMTimeType GetMTime() override;

protected:
  vtkRefractionErrorVolume();
  ~vtkRefractionErrorVolume() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /**
   * Replaces the statistics and their copies in the output's field data, for example by statistics
   * of several parts of the volume.
   */
  void SetStatistics(vtkImageData* output, double meanError, double standardDeviation,
    double largestError, vtkTypeInt64 numberOfMeasuredSamples);

private:
  vtkRefractionErrorVolume(const vtkRefractionErrorVolume&) = delete;
  void operator=(const vtkRefractionErrorVolume&) = delete;

  bool HasValidBox();
  bool HasValidLimits();
  bool UpdateScenes(vtkInformationVector* membranes, vtkInformationVector* references);
  bool MeasureSamples(vtkImageData* output);
  void FillOutput(vtkImageData* output);
  void AddAngles(vtkImageData* output);

  double EyePosition[3] = { 0.0, 0.0, 1.0 };
  int MembraneModel = CURVED;
  double ModelBounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  int SampleDimensions[3] = { 40, 40, 40 };
  bool AngularErrors = false;
  double ColorLimits[3] = { 1.0, 10.0, 100.0 };
  vtkSmartPointer<vtkRefractingInterfaceCollection> Interfaces;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
