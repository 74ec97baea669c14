// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRayIntegral
 * @brief   integrals along rays through a mesh, as an image of numbers
 *
 * Casts one ray per pixel through a mesh and writes its measurements as float arrays of a
 * vtkImageData. It needs neither a window nor OpenGL. The rays are cast as by the native backend of
 * vtkTetrahedraRayCastMapper: the scalar is linear in each tetrahedron (constant for cell data),
 * and there is no sampling distance.
 *
 * Input port 0 is the mesh: any vtkDataSet or vtkCompositeDataSet that vtkTetrahedraRayCastMapper
 * takes, with the same division of cells. SetInputArrayToProcess(0, 0, 0, association, name)
 * chooses the scalar, as point or cell data; by default, the active scalars of the points are used,
 * or else those of the cells. Path lengths and first and last depths need no scalar: without active
 * scalars every cell counts. Input port 1 takes surfaces that refract the rays, as the mapper's
 * membranes.
 *
 * The output is an image of ImageSize pixels, one point per pixel. Its point arrays, all of 32-bit
 * floats with one tuple per pixel, are switched on by name (GetArraySelection()). In brackets, the
 * value of rays that miss the mesh:
 * - `Integral`: integral of the scalar, scalar times length [0];
 * - `PathLength`: length in cells [0];
 * - `OpticalDepth`: integral of the attenuation coefficient [0];
 * - `FirstDepth`, `LastDepth`: distance along the ray at which its first cell begins and its last
 *   one ends [NaN];
 * - `Minimum` and `MinimumDepth`: smallest scalar, and the first distance at which it is reached
 *   [NaN];
 * - `Maximum` and `MaximumDepth`: largest scalar, likewise [NaN];
 * - `RGBA`, 4 components: premultiplied colour and opacity [0];
 * - `EnergyBins`, one component per bin: transmitted intensity [the intensity of the bin].
 *
 * Lengths are in world coordinates, the coordinates of the input. Distances count along the ray,
 * also where it is refracted: from the camera's position (with parallel projection, from the plane
 * through it), or from the rectangle, in front of which they are negative. Rays of a camera begin
 * at its position; parallel rays extend beyond the rectangle on both sides. The camera's clipping
 * range has no effect.
 *
 * A cell with a scalar that is not finite is left out, as in the mapper; the statistic
 * "NumberOfTransparentCells" counts such cells. If only EnergyBins of an attenuation array are
 * switched on, that array takes the place of the scalar.
 *
 * **Energy bins.** A bin has the intensity I0 behind the mesh. The image has I0 exp(-integral of
 * mu) plus the emission e of the mesh, attenuated on its way to the viewer. mu and e are
 * BinAttenuation and BinEmission times the scalar, or the components of AttenuationArrayName and
 * EmissionArrayName. A warning tells of a bin whose rays are all absorbed, or amplified by a
 * negative attenuation, and of numbers beyond the range of the output.
 *
 * **Errors.** Without a usable input, array, frame, property or interface an error is reported and
 * the output is empty: no cells; a missing array, one of the wrong length or without the chosen
 * component; an image size below 1 or an image that exceeds the computer's memory (found before
 * anything is allocated); a rectangle without area, with axes that are not perpendicular or with
 * numbers that are not finite; a camera with a singular matrix; a negative attenuation in an array;
 * no array switched on.
 *
 * Tables of the mesh, of the scalar and of the surfaces are kept until their values change: another
 * frame costs the cast only (the statistic "NumberOfMeshBuilds"). Rays are cast in parallel by
 * vtkSMPTools; results do not depend on the number of threads. Progress is reported; after an abort
 * the output is empty.
 *
 * @sa vtkTetrahedraRayCastMapper
 */
#ifndef vtkTetrahedraRayIntegral_h
#define vtkTetrahedraRayIntegral_h

#include "OpacityModel.h" // For meniscusOpacityModelMacro
#include "vtkImageAlgorithm.h"
#include "vtkMeniscusModule.h" // For export macro
#include "vtkSmartPointer.h"   // For members

#include <memory> // For std::unique_ptr

class vtkCamera;
class vtkDataArraySelection;
class vtkPolyData;
class vtkRefractingInterfaceCollection;
class vtkTable;
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
  enum
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
  virtual void SetFrameMode(int mode);
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
   * put its points at the centres of the rectangle's parts; the product of the first two spacings
   * is a pixel's area. In the mode CAMERA the unit is a pixel: the origin is 0, the spacing 1.
   */
  vtkSetVector2Macro(ImageSize, int);
  vtkGetVector2Macro(ImageSize, int);
  /** @} */

  /** Division of cells that are not linear tetrahedra. */
  enum
  {
    FIXED_DIVISION = 0,   ///< into tetrahedra between the points of the cell
    ADAPTIVE_DIVISION = 1 ///< into tetrahedra that follow its shape functions
  };

  /** @{ */
  /**
   * Set/Get the division of cells: FIXED_DIVISION, the default, or ADAPTIVE_DIVISION, which follows
   * VTK's shape functions of the cells within the tolerance below. See
   * vtkTetrahedraRayCastMapper::SetCellDivision() and Documentation/true-cells.md.
   */
  virtual void SetCellDivision(int division);
  vtkGetMacro(CellDivision, int);
  void SetCellDivisionToFixed() { this->SetCellDivision(FIXED_DIVISION); }
  void SetCellDivisionToAdaptive() { this->SetCellDivision(ADAPTIVE_DIVISION); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the tolerance of ADAPTIVE_DIVISION, > 0: the largest difference of the scalar from its
   * linear interpolation in the edges of the tetrahedra, as a fraction of the range of its finite
   * values; or the largest displacement, as four times the fraction of the diagonal of the input's
   * points. Default is 1/256, as in the mapper; for measurements, set a smaller tolerance and a
   * sufficient budget.
   */
  vtkSetMacro(DivisionTolerance, double);
  vtkGetMacro(DivisionTolerance, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the budget of ADAPTIVE_DIVISION: the largest number of tetrahedra that it makes, where
   * errors are largest. If the budget ends the division before the tolerance is reached, there is a
   * warning. Default is 0: twice as many as FIXED_DIVISION makes, but at least 100,000.
   */
  virtual void SetMaximumNumberOfPieces(vtkTypeInt64 pieces);
  vtkGetMacro(MaximumNumberOfPieces, vtkTypeInt64);
  /** @} */

  /** @{ */
  /**
   * Set/Get the component of the scalar, from 0, or -1 for the length of its tuples. Arrays of one
   * component ignore it. Default is 0.
   */
  virtual void SetArrayComponent(int component);
  vtkGetMacro(ArrayComponent, int);
  /** @} */

  /**
   * Arrays of the output by name, as in VTK's readers: EnableArray("PathLength"),
   * DisableAllArrays(). `Integral` is on by default, all others are off. A name that does not exist
   * is an error when the filter runs.
   *
   * Besides the arrays of the class comment there are the events of rays: `FirstVisible`, the first
   * visible place; `OpacityReached`, the place at which the accumulated opacity reaches
   * EventOpacity; and `LargestContribution`, the place of the largest contribution per length.
   * Each adds arrays whose names begin with its own: `Depth` (distance along the ray), `Value` (the
   * scalar there), `Position` (3 components, world coordinates; behind refracting surfaces the true
   * place), all of 32-bit floats; `CellId` (vtkIdTypeArray: cell of the input's data set), `Block`
   * (vtkIntArray: its flat index, for composite input) and `Surface` (vtkIntArray: index of the
   * isosurface in the property, with isosurface blending). Rays without the event have NaN, and -1
   * in arrays of integers.
   */
  vtkDataArraySelection* GetArraySelection();

  /** @{ */
  /** Set/Get the accumulated opacity of `OpacityReached`, from 0 to 1. Default is 0.5. */
  virtual void SetEventOpacity(double opacity);
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
   * composite blending without light. For RGBA, OpticalDepth and events, Shade and gradient opacity
   * have no effect, and the functions of component 0 are used. Default is none.
   */
  void SetVolumeProperty(vtkVolumeProperty* property);
  vtkVolumeProperty* GetVolumeProperty();
  /** @} */

  /** @{ */
  /**
   * Set/Get the meaning of the property's opacity, as vtkTetrahedraRayCastMapper::SetOpacityModel()
   * defines it. Default is ATTENUATION_COEFFICIENT.
   */
  meniscusOpacityModelMacro();
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
   * not finite lets the cell pass without effect on its bin. The default, none, and
   * an empty name stand for BinAttenuation.
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
   * Counters, sizes and errors by name: a table with one row each and the columns Name, Meaning and
   * Value, which belongs to this object and is filled anew by each call; and the value of one name,
   * such as "NumberOfCasts". An unknown name is an error, and the value is not a number.
   */
  vtkTable* GetStatistics();
  double GetStatistic(const char* name);
  /** @} */

  /** Modification time of this filter, its camera, property, interfaces and array selection. */
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
