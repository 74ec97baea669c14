// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRayIntegral
 * @brief   integrals along rays through a mesh, as an image of numbers
 *
 * Casts one ray per pixel through a mesh and writes what it measures as float arrays of a
 * vtkImageData. It needs neither a window nor OpenGL. The rays are those of the native backend of
 * vtkTetrahedraRayCastMapper: the scalar is linear in each tetrahedron (constant for cell data),
 * and there is no sampling distance.
 *
 * Input port 0 is the mesh: any vtkDataSet or vtkCompositeDataSet that vtkTetrahedraRayCastMapper
 * takes, with the same division of cells. SetInputArrayToProcess(0, 0, 0, association, name)
 * chooses the scalar, as point or cell data; the default are the active scalars of the points, or
 * else of the cells. Path lengths and first and last depths need none: without active scalars every
 * cell counts. Input port 1 takes surfaces that refract the rays, as the mapper's membranes.
 *
 * The output is an image of ImageSize pixels, one point per pixel. Its point arrays, all of 32-bit
 * floats with one tuple per pixel, are switched on separately. Here are their switches and, in
 * brackets, the value of rays that miss the mesh:
 * - `Integral` (ComputeIntegral): integral of the scalar, scalar times length [0];
 * - `PathLength` (ComputePathLength): length in cells [0];
 * - `OpticalDepth` (ComputeOpticalDepth): integral of the attenuation coefficient [0];
 * - `FirstDepth` (ComputeFirstDepth), `LastDepth` (ComputeLastDepth): distance along the ray at
 * which its first cell begins and its last one ends [NaN];
 * - `Minimum` and `MinimumDepth` (ComputeMinimum): smallest scalar, and the first distance at which
 *   it is reached [NaN];
 * - `Maximum` and `MaximumDepth` (ComputeMaximum): largest scalar, likewise [NaN];
 * - `RGBA` (ComputeRGBA), 4 components: premultiplied colour and opacity [0];
 * - `EnergyBins` (ComputeEnergyBins), one component per bin: transmitted intensity [the intensity
 * of the bin].
 *
 * Lengths are in world coordinates, the coordinates of the input. Distances count along the ray,
 * also where it is refracted: from the camera's position (with parallel projection, from the plane
 * through it), or from the rectangle, in front of which they are negative. Rays of a camera begin
 * at its position; parallel rays extend beyond the rectangle on both sides. The camera's clipping
 * range does not count.
 *
 * A cell with a scalar that is not finite does not count, as in the mapper
 * (GetNumberOfTransparentCells()). If only arrays of energy bins are wanted, attenuation takes the
 * place of the scalar.
 *
 * **Energy bins.** A bin has the intensity I0 behind the mesh. The image has I0 exp(-integral of
 * mu) plus the emission e of the mesh, attenuated on its way to the viewer. mu and e are
 * BinAttenuation and BinEmission times the scalar, or the components of AttenuationArrayName and
 * EmissionArrayName.
 *
 * **Errors.** Without a usable input, array, frame, property or interface an error is reported and
 * the output is empty: no cells; a missing array, one of the wrong length or without the chosen
 * component; an image size below 1 or an image that exceeds the computer's memory (found before
 * anything is allocated); a rectangle without area, with axes that are not perpendicular or with
 * numbers that are not finite; a camera with a singular matrix; a negative attenuation; no array
 * switched on.
 *
 * Tables of the mesh, of the scalar and of the surfaces are kept until their values change: another
 * frame costs the cast only (GetNumberOfMeshBuilds()). Rays are cast in parallel by vtkSMPTools;
 * results do not depend on the number of threads. Progress is reported; after an abort the output
 * is empty.
 *
 * @sa vtkTetrahedraRayCastMapper
 */
#ifndef vtkTetrahedraRayIntegral_h
#define vtkTetrahedraRayIntegral_h

#include "vtkImageAlgorithm.h"
#include "vtkMeniscusModule.h" // For export macro
#include "vtkSmartPointer.h"   // For members

#include <memory> // For std::unique_ptr

class vtkCamera;
class vtkPolyData;
class vtkRefractingInterfaceCollection;
class vtkVolumeProperty;

namespace meniscus
{
struct InputReport;
}

class VTKMENISCUS_EXPORT vtkTetrahedraRayIntegral : public vtkImageAlgorithm
{
public:
  static vtkTetrahedraRayIntegral* New();
  vtkTypeMacro(vtkTetrahedraRayIntegral, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Rays of the image. */
  enum FrameModes
  {
    /** Parallel rays along Direction, through a rectangle around the box of the cells in use. */
    FITTED = 0,
    /** Parallel rays through the rectangle of FrameOrigin, FrameAxis1 and FrameAxis2. */
    PARALLEL = 1,
    /** Rays of Camera, perspective or parallel. */
    CAMERA = 2
  };

  /** @{ */
  /** Set/Get the rays of the image. Default is FITTED. */
  vtkSetClampMacro(FrameMode, int, FITTED, CAMERA);
  vtkGetMacro(FrameMode, int);
  void SetFrameModeToFitted() { this->SetFrameMode(FITTED); }
  void SetFrameModeToParallel() { this->SetFrameMode(PARALLEL); }
  void SetFrameModeToCamera() { this->SetFrameMode(CAMERA); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the camera of the mode CAMERA. Setting one selects that mode. The image spans the
   * camera's view with the aspect ratio of ImageSize. Default is none.
   */
  void SetCamera(vtkCamera* camera);
  vtkCamera* GetCamera();
  /** @} */

  /** @{ */
  /**
   * Set/Get the direction of the rays of the mode FITTED and the direction that is drawn upwards;
   * any lengths, not parallel to each other. Defaults are (0, 0, -1) and (0, 1, 0).
   */
  vtkSetVector3Macro(Direction, double);
  vtkGetVector3Macro(Direction, double);
  vtkSetVector3Macro(ViewUp, double);
  vtkGetVector3Macro(ViewUp, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the rectangle of the mode PARALLEL in world coordinates: its lower left corner, its
   * lower edge and its left edge, perpendicular to each other. The rays go along FrameAxis2 x
   * FrameAxis1, so that an image with its first axis to the right is seen from its front, through
   * the centres of ImageSize equal parts. Defaults are (0, 0, 0), (1, 0, 0) and (0, 1, 0).
   */
  vtkSetVector3Macro(FrameOrigin, double);
  vtkGetVector3Macro(FrameOrigin, double);
  vtkSetVector3Macro(FrameAxis1, double);
  vtkGetVector3Macro(FrameAxis1, double);
  vtkSetVector3Macro(FrameAxis2, double);
  vtkGetVector3Macro(FrameAxis2, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the number of pixels, at least 1 by 1. Default is 256 by 256.
   *
   * The output has this extent. In the modes FITTED and PARALLEL its origin, spacing and direction
   * put its points to the centres of the rectangle's parts; the product of the first two spacings
   * is a pixel's area. In the mode CAMERA origin and spacing are those of pixels, 0 and 1.
   */
  vtkSetVector2Macro(ImageSize, int);
  vtkGetVector2Macro(ImageSize, int);
  /** @} */

  /** Division of cells that are not linear tetrahedra. */
  enum CellDivisions
  {
    FIXED_DIVISION = 0,   ///< into tetrahedra between the points of the cell
    ADAPTIVE_DIVISION = 1 ///< into as many as its shape functions take, within a tolerance
  };

  /** @{ */
  /**
   * Set/Get the division of cells: FIXED_DIVISION, the default, or ADAPTIVE_DIVISION, which follows
   * VTK's shape functions of the cells within the tolerance below. See
   * vtkTetrahedraRayCastMapper::SetCellDivision() and Documentation/true-cells.md.
   */
  vtkSetClampMacro(CellDivision, int, FIXED_DIVISION, ADAPTIVE_DIVISION);
  vtkGetMacro(CellDivision, int);
  void SetCellDivisionToFixed() { this->SetCellDivision(FIXED_DIVISION); }
  void SetCellDivisionToAdaptive() { this->SetCellDivision(ADAPTIVE_DIVISION); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the tolerance of ADAPTIVE_DIVISION, > 0: the largest difference of the scalar from its
   * linear interpolation in the edges of the tetrahedra, as a fraction of the range of its finite
   * values; or the largest displacement, as four times the fraction of the diagonal of the input's
   * points. Default is 1/256, as in the mapper; measurements take a smaller one, and a budget.
   */
  vtkSetMacro(DivisionTolerance, double);
  vtkGetMacro(DivisionTolerance, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the budget of ADAPTIVE_DIVISION: the largest number of tetrahedra that it makes, where
   * errors are largest. A warning reports if it ends the division before the tolerance is reached.
   * Default is 0: twice as many as FIXED_DIVISION makes, but at least 100,000.
   */
  vtkSetClampMacro(MaximumNumberOfPieces, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MaximumNumberOfPieces, vtkTypeInt64);
  /** @} */

  /** @{ */
  /**
   * Set/Get the component of the scalar, from 0, or -1 for the length of its tuples. Arrays of one
   * component ignore it. Default is 0.
   */
  vtkSetClampMacro(ArrayComponent, int, -1, VTK_INT_MAX);
  vtkGetMacro(ArrayComponent, int);
  /** @} */

  /** @{ */
  /**
   * Switch arrays of the output on or off. By default the integral is on and all others are off.
   */
  vtkSetMacro(ComputeIntegral, vtkTypeBool);
  vtkGetMacro(ComputeIntegral, vtkTypeBool);
  vtkBooleanMacro(ComputeIntegral, vtkTypeBool);
  vtkSetMacro(ComputePathLength, vtkTypeBool);
  vtkGetMacro(ComputePathLength, vtkTypeBool);
  vtkBooleanMacro(ComputePathLength, vtkTypeBool);
  vtkSetMacro(ComputeOpticalDepth, vtkTypeBool);
  vtkGetMacro(ComputeOpticalDepth, vtkTypeBool);
  vtkBooleanMacro(ComputeOpticalDepth, vtkTypeBool);
  vtkSetMacro(ComputeFirstDepth, vtkTypeBool);
  vtkGetMacro(ComputeFirstDepth, vtkTypeBool);
  vtkBooleanMacro(ComputeFirstDepth, vtkTypeBool);
  vtkSetMacro(ComputeLastDepth, vtkTypeBool);
  vtkGetMacro(ComputeLastDepth, vtkTypeBool);
  vtkBooleanMacro(ComputeLastDepth, vtkTypeBool);
  vtkSetMacro(ComputeMinimum, vtkTypeBool);
  vtkGetMacro(ComputeMinimum, vtkTypeBool);
  vtkBooleanMacro(ComputeMinimum, vtkTypeBool);
  vtkSetMacro(ComputeMaximum, vtkTypeBool);
  vtkGetMacro(ComputeMaximum, vtkTypeBool);
  vtkBooleanMacro(ComputeMaximum, vtkTypeBool);
  vtkSetMacro(ComputeRGBA, vtkTypeBool);
  vtkGetMacro(ComputeRGBA, vtkTypeBool);
  vtkBooleanMacro(ComputeRGBA, vtkTypeBool);
  vtkSetMacro(ComputeEnergyBins, vtkTypeBool);
  vtkGetMacro(ComputeEnergyBins, vtkTypeBool);
  vtkBooleanMacro(ComputeEnergyBins, vtkTypeBool);
  /** @} */

  /** @{ */
  /**
   * Switch the events of rays on or off: the first visible place, the place at which the
   * accumulated opacity reaches EventOpacity, and the place of the largest contribution per length.
   * By default they are off.
   *
   * Each adds arrays whose names begin with `FirstVisible`, `OpacityReached` or
   * `LargestContribution`: `Depth` (distance along the ray), `Value` (the scalar there), `Position`
   * (3 components, world coordinates; behind refracting surfaces the true place), all of 32-bit
   * floats; `CellId` (vtkIdTypeArray: cell of the input's data set), `Block` (vtkIntArray: its flat
   * index, for composite input) and `Surface` (vtkIntArray: index of the isosurface in the
   * property, with isosurface blending). Rays without the event have NaN, and -1 in arrays of
   * integers.
   */
  vtkSetMacro(ComputeFirstVisible, vtkTypeBool);
  vtkGetMacro(ComputeFirstVisible, vtkTypeBool);
  vtkBooleanMacro(ComputeFirstVisible, vtkTypeBool);
  vtkSetMacro(ComputeOpacityReached, vtkTypeBool);
  vtkGetMacro(ComputeOpacityReached, vtkTypeBool);
  vtkBooleanMacro(ComputeOpacityReached, vtkTypeBool);
  vtkSetMacro(ComputeLargestContribution, vtkTypeBool);
  vtkGetMacro(ComputeLargestContribution, vtkTypeBool);
  vtkBooleanMacro(ComputeLargestContribution, vtkTypeBool);
  /** @} */

  /** @{ */
  /** Set/Get the accumulated opacity of `OpacityReached`, from 0 to 1. Default is 0.5. */
  vtkSetClampMacro(EventOpacity, double, 0.0, 1.0);
  vtkGetMacro(EventOpacity, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the blend mode that defines events, a number of vtkVolumeMapper::BlendModes; see
   * vtkTetrahedraVolumePicker. Composite, additive and isosurface blending need a property; events
   * of isosurfaces exclude RGBA and OpticalDepth in one image. Default is
   * vtkVolumeMapper::COMPOSITE_BLEND.
   */
  vtkSetMacro(EventBlendMode, int);
  vtkGetMacro(EventBlendMode, int);
  /** @} */

  /** @{ */
  /**
   * Set/Get the property of RGBA, OpticalDepth and events, which need one. RGBA is the mapper's
   * composite blending without light: Shade and gradient opacity have no effect, also for the
   * others, and the functions of component 0 are used. Default is none.
   */
  void SetVolumeProperty(vtkVolumeProperty* property);
  vtkVolumeProperty* GetVolumeProperty();
  /** @} */

  /** Meanings of opacity, as in vtkTetrahedraRayCastMapper. */
  enum OpacityModels
  {
    ATTENUATION_COEFFICIENT = 0,
    OPACITY_PER_UNIT_DISTANCE = 1
  };

  /** @{ */
  /** Set/Get the meaning of the property's opacity. Default is ATTENUATION_COEFFICIENT. */
  vtkSetClampMacro(OpacityModel, int, ATTENUATION_COEFFICIENT, OPACITY_PER_UNIT_DISTANCE);
  vtkGetMacro(OpacityModel, int);
  void SetOpacityModelToAttenuationCoefficient() { this->SetOpacityModel(ATTENUATION_COEFFICIENT); }
  void SetOpacityModelToOpacityPerUnitDistance()
  {
    this->SetOpacityModel(OPACITY_PER_UNIT_DISTANCE);
  }
  /** @} */

  /** @{ */
  /**
   * Set/Get the number of energy bins. New bins have the defaults below. With arrays of attenuation
   * it is 0 or their number of components; anything else is an error when the filter runs. Default
   * is 0.
   */
  void SetNumberOfEnergyBins(int bins);
  int GetNumberOfEnergyBins();
  /** @} */

  /** @{ */
  /**
   * Set/Get numbers of a bin, counted from 0; a bin beyond the last one is added. BinAttenuation is
   * the attenuation coefficient and BinEmission the emission, both per unit of the scalar and of
   * length, any finite number; without effect if AttenuationArrayName is set. BinIntensity is the
   * intensity behind the mesh. Defaults are 1, 0 and 1. The getters return 0 for other bins.
   */
  void SetBinAttenuation(int bin, double attenuation);
  double GetBinAttenuation(int bin);
  void SetBinEmission(int bin, double emission);
  double GetBinEmission(int bin);
  void SetBinIntensity(int bin, double intensity);
  double GetBinIntensity(int bin);
  /** @} */

  /** @{ */
  /**
   * Set/Get the name of a point or cell array of the input with one component per bin: attenuation
   * coefficients per length, not negative. Point data is used if there are both. A value that is
   * not finite lets the cell pass without effect on its bin. Default is none, as
   * with an empty name: BinAttenuation counts.
   */
  vtkSetStringMacro(AttenuationArrayName);
  vtkGetStringMacro(AttenuationArrayName);
  /** @} */

  /** @{ */
  /**
   * Set/Get the name of an array with the emission per length, one component per bin, with the
   * association of the attenuation array, without which it has no effect. Default is none.
   */
  vtkSetStringMacro(EmissionArrayName);
  vtkGetStringMacro(EmissionArrayName);
  /** @} */

  /** @{ */
  /**
   * Set the refracting surfaces, port 1, in the order in which rays meet them, as in
   * vtkTetrahedraRayCastMapper. Set replaces all of them by one, Add appends one.
   */
  void SetMembraneConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetMembraneData(vtkPolyData* membrane);
  void AddMembraneConnection(vtkAlgorithmOutput* output) { this->AddInputConnection(1, output); }
  void AddMembraneData(vtkPolyData* membrane);
  void RemoveAllMembranes() { this->SetInputConnection(1, nullptr); }
  int GetNumberOfMembranes() { return this->GetNumberOfInputConnections(1); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the indices of refraction of the first surface on the side of its normals and on the
   * other side. Must be positive and finite; anything else is an error when the filter runs.
   * Defaults are 1.0 and 1.333.
   */
  virtual void SetExteriorIndexOfRefraction(double index);
  virtual double GetExteriorIndexOfRefraction();
  virtual void SetInteriorIndexOfRefraction(double index);
  virtual double GetInteriorIndexOfRefraction();
  /** @} */

  /** @{ */
  /**
   * Set/Get the refracting interfaces, one per surface. The list may be shared with other classes.
   * Null, the default, stands for a list of one with default values.
   */
  void SetInterfaces(vtkRefractingInterfaceCollection* interfaces);
  vtkRefractingInterfaceCollection* GetInterfaces();
  /** @} */

  /** @{ */
  /**
   * Counters since construction: builds of the mesh, updates of the positions alone (points have
   * moved, the cells are the same), updates of the scalars, determinations of the cells that count,
   * reductions of the volume property, readings of arrays of energy bins, builds of the shape of a
   * surface, and casts of an image's rays (one for all measurements of the scalar, one for RGBA,
   * one for three energy bins with arrays or for one that emits).
   */
  vtkTypeInt64 GetNumberOfMeshBuilds();
  vtkTypeInt64 GetNumberOfPointUpdates();
  vtkTypeInt64 GetNumberOfScalarUpdates();
  vtkTypeInt64 GetNumberOfActiveSetBuilds();
  vtkTypeInt64 GetNumberOfTransferFunctionBuilds();
  vtkTypeInt64 GetNumberOfBinUpdates();
  vtkTypeInt64 GetNumberOfMembraneBuilds();
  vtkTypeInt64 GetNumberOfCasts();
  /** @} */

  /** @{ */
  /**
   * Numbers of tetrahedra of the mesh, in all cells; of divisions of the cells since construction,
   * which are 0 with FIXED_DIVISION and for meshes of tetrahedra; and of the last division: cells
   * that are folded inside out in parts, and edges that exceed the tolerance after 23 divisions. A
   * warning reports the last two if they are not 0.
   */
  vtkTypeInt64 GetNumberOfTetrahedra();
  vtkTypeInt64 GetNumberOfCellDivisions();
  vtkTypeInt64 GetNumberOfFoldedCells();
  vtkTypeInt64 GetNumberOfUnresolvedEdges();
  /** @} */

  /** Error of the last division, as vtkTetrahedraRayCastMapper::GetDivisionError(). */
  double GetDivisionError();

  /**
   * Number of times that the input's cells were looked up for events since construction: once per
   * mesh.
   */
  vtkTypeInt64 GetNumberOfCellSearches();

  /** @{ */
  /**
   * Numbers of the last image or mesh: rays that met the mesh, crossed cells, rays whose walk did
   * not end on the boundary (which cannot happen with IEEE arithmetic), tetrahedra without a finite
   * scalar, and cells that were left out as in vtkTetrahedraRayCastMapper.
   */
  vtkTypeInt64 GetNumberOfRays();
  vtkTypeInt64 GetNumberOfTraversalSteps();
  vtkTypeInt64 GetNumberOfLostRays();
  vtkTypeInt64 GetNumberOfTransparentCells();
  vtkTypeInt64 GetNumberOfRejectedCells();
  /** @} */

  /** Includes the times of camera, property and interfaces. */
  vtkMTimeType GetMTime() override;

protected:
  vtkTetrahedraRayIntegral();
  ~vtkTetrahedraRayIntegral() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTetrahedraRayIntegral(const vtkTetrahedraRayIntegral&) = delete;
  void operator=(const vtkTetrahedraRayIntegral&) = delete;

  class vtkInternals;
  struct Request;

  bool Tell(const meniscus::InputReport& report);
  bool TellError(const std::string& error);
  meniscus::InputReport CollectScalars(vtkDataObject* input, Request& request);
  bool CollectInput(vtkDataObject* input, Request& request);
  bool ChooseEvents(Request& request);
  bool ChooseArrays(Request& request);
  bool UpdateTables(Request& request);
  bool UpdateMembranes(vtkInformationVector* membranes, Request& request);
  bool ComputeView(Request& request);
  bool Measure(Request& request, vtkDataObject* input, vtkImageData* output);

  int CellDivision = FIXED_DIVISION;
  double DivisionTolerance = 1.0 / 256.0;
  vtkTypeInt64 MaximumNumberOfPieces = 0;
  int FrameMode = FITTED;
  double Direction[3] = { 0.0, 0.0, -1.0 };
  double ViewUp[3] = { 0.0, 1.0, 0.0 };
  double FrameOrigin[3] = { 0.0, 0.0, 0.0 };
  double FrameAxis1[3] = { 1.0, 0.0, 0.0 };
  double FrameAxis2[3] = { 0.0, 1.0, 0.0 };
  int ImageSize[2] = { 256, 256 };
  int ArrayComponent = 0;
  vtkTypeBool ComputeIntegral = 1;
  vtkTypeBool ComputePathLength = 0;
  vtkTypeBool ComputeOpticalDepth = 0;
  vtkTypeBool ComputeFirstDepth = 0;
  vtkTypeBool ComputeLastDepth = 0;
  vtkTypeBool ComputeMinimum = 0;
  vtkTypeBool ComputeMaximum = 0;
  vtkTypeBool ComputeRGBA = 0;
  vtkTypeBool ComputeEnergyBins = 0;
  vtkTypeBool ComputeFirstVisible = 0;
  vtkTypeBool ComputeOpacityReached = 0;
  vtkTypeBool ComputeLargestContribution = 0;
  double EventOpacity = 0.5;
  int EventBlendMode = 0;
  int OpacityModel = ATTENUATION_COEFFICIENT;
  char* AttenuationArrayName = nullptr;
  char* EmissionArrayName = nullptr;
  vtkSmartPointer<vtkCamera> Camera;
  vtkSmartPointer<vtkVolumeProperty> VolumeProperty;
  vtkSmartPointer<vtkRefractingInterfaceCollection> Interfaces;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
