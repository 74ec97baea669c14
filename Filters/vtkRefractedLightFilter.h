// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractedLightFilter
 * @brief   irradiance of geometry lit through a membrane: caustics
 *
 * Adds to polygonal geometry (port 0), or to the surface of a grid, the irradiance that it receives
 * from a light on the other side of a membrane (port 1), such as the bright lines of refracted
 * light on the floor of a pool.
 *
 *     light->SetInputConnection(floor->GetOutputPort());
 *     light->SetMembraneConnection(water->GetOutputPort());
 *     light->SetLightPosition(0.3, 0.0, 1.0);
 *     filter->SetInputConnection(light->GetOutputPort()); // for example vtkRefractedGeometryFilter
 *
 * The output is the input with the array `RefractionIrradiance` (float, one component) per cell and
 * per point, in units of the light's irradiance on a surface that faces it at the membrane: under
 * vertical light, flat water transmits 0.98 of it. The irradiance of a cell is
 *
 *     (1 - F) A' / A,
 *
 * with the cell's area A, the area A' of the part of the membrane through which the cell gets its
 * light, projected along the direction of the light, and the Fresnel reflectance F there (Eq. 2.6
 * of the thesis that Documentation/refraction-method.md summarises). With the light in place of the
 * eye, these parts consist of the sight points of the cell's images, which
 * vtkRefractedGeometryFilter computes. Where the light is folded, a cell has several images, whose
 * light is added. The sum over all cells is therefore the light that the membrane transmits,
 * whatever the size of the cells. A point has the mean of its cells, weighted by area.
 *
 * Port 1 is repeatable; see SetInterfaces() for several surfaces.
 *
 * Lines and vertices get 0, and so do cells that the light does not reach through the membrane.
 *
 * @note Objects cast no shadows, except on themselves if OneSided is on.
 * @note The irradiance is constant in a cell: smaller details are not resolved.
 * @note A light at infinity is approximated by a light at a distance of ten thousand times the
 *   scene's size.
 *
 * @sa vtkRefractedGeometryFilter
 */
#ifndef vtkRefractedLightFilter_h
#define vtkRefractedLightFilter_h

#include "vtkBoundingBox.h"    // For the bounds of the lit geometry
#include "vtkMeniscusModule.h" // For export macro
#include "vtkNew.h"            // For the filter inside
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

#include <memory> // For std::unique_ptr

class vtkRefractingInterfaceCollection;
class vtkRefractedGeometryFilter;

class VTKMENISCUS_EXPORT vtkRefractedLightFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkRefractedLightFilter* New();
  vtkTypeMacro(vtkRefractedLightFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** @{ */
  /**
   * Set/Get the position of the light in world coordinates if it is positional; otherwise the
   * direction to it. Must be finite and, as a direction, not zero; anything else is an error when
   * the filter runs. Default is (0, 0, 1).
   */
  vtkSetVector3Macro(LightPosition, double);
  vtkGetVector3Macro(LightPosition, double);
  /** @} */

  /** @{ */
  /** Set/Get whether the light has a position, instead of being at infinity. Default is off. */
  vtkSetMacro(Positional, bool);
  vtkGetMacro(Positional, bool);
  vtkBooleanMacro(Positional, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether cells are lit only from the side on which their points are counter-clockwise,
   * which is the outside of closed surfaces. Default is off.
   */
  vtkSetMacro(OneSided, bool);
  vtkGetMacro(OneSided, bool);
  vtkBooleanMacro(OneSided, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether cells and points also get the arrays `RefractionLightVector` (3 floats) and
   * `RefractionLightPath` (1 float). The vector is the light that passes an area across the rays,
   * in the units of the irradiance, times the unit vector back along the ray, summed over all rays
   * that reach the cell: its product with a unit normal is the irradiance of a surface with this
   * normal. The path is the mean length of the rays behind the membrane, weighted by their light.
   * vtkRefractionPass lights objects by them. Default is off.
   */
  vtkSetMacro(LightVectors, bool);
  vtkGetMacro(LightVectors, bool);
  vtkBooleanMacro(LightVectors, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the indices of refraction on the light's side and behind the membrane. Must be positive
   * and finite; anything else is an error when the filter runs. Defaults are 1.0 and 1.333.
   */
  virtual void SetExteriorIndexOfRefraction(double index);
  virtual double GetExteriorIndexOfRefraction();
  virtual void SetInteriorIndexOfRefraction(double index);
  virtual double GetInteriorIndexOfRefraction();
  /** @} */

  /** @{ */
  /**
   * Set/Get the refracting interfaces, in the order in which the light's rays meet them. The list
   * may be shared with other filters and mappers. Interface i has the surface of connection i of
   * port 1, the indices of refraction and, optionally, the exact surface; another number of
   * connections is an error when the filter runs. Null, the default, stands for a list of one with
   * default values.
   *
   * With several interfaces, media and sides have the meaning that they have in
   * vtkRefractedGeometryFilter::SetInterfaces(). A cell gets the light of the beams of rays that
   * reach it, times the transmittance of all interfaces in front of it. Rays that miss a later
   * surface end there.
   */
  void SetInterfaces(vtkRefractingInterfaceCollection* interfaces);
  vtkRefractingInterfaceCollection* GetInterfaces();
  /** @} */

  /** @{ */
  /** Set the membrane, port 1, by connection or as data. */
  void SetMembraneConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetMembraneData(vtkPolyData* membrane);
  /** @} */

  /** @{ */
  /**
   * Add the surface of the next interface of the list to port 1, by connection or as data; remove
   * all surfaces; get their number. SetInterfaces() has the indices of refraction.
   */
  void AddMembraneConnection(vtkAlgorithmOutput* output);
  void AddMembraneData(vtkPolyData* membrane);
  void RemoveAllMembranes();
  int GetNumberOfMembranes();
  /** @} */

  /** @{ */
  /**
   * The lit geometry. For composite data, whose output is composite too (GetOutputDataObject()), it
   * has all blocks in one object, with the arrays that all of them have. Call Update() before.
   */
  vtkPolyData* GetOutput();
  vtkPolyData* GetOutput(int port) { return port == 0 ? this->GetOutput() : nullptr; }
  /** @} */

  /** Modification time of this filter and of the interfaces. */
  vtkMTimeType GetMTime() override;

  /**
   * The filter that computes images with the light in place of the eye, behind one interface; its
   * counters show the work done.
   */
  vtkRefractedGeometryFilter* GetView();

protected:
  vtkRefractedLightFilter();
  ~vtkRefractedLightFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /**
   * Bounds of other geometry that the same light falls on: other pieces and blocks. A light at
   * infinity is then placed at the same distance for all of them. Default is none.
   */
  vtkBoundingBox OtherGeometry;

private:
  vtkRefractedLightFilter(const vtkRefractedLightFilter&) = delete;
  void operator=(const vtkRefractedLightFilter&) = delete;

  bool PlaceLight(vtkPolyData* input, const std::vector<vtkPolyData*>& membranes);
  bool Look(vtkPolyData* input, vtkPolyData* membrane);

  double LightPosition[3] = { 0.0, 0.0, 1.0 };
  bool Positional = false;
  bool OneSided = false;
  bool LightVectors = false;
  vtkSmartPointer<vtkRefractingInterfaceCollection> Interfaces;
  vtkNew<vtkRefractedGeometryFilter> View;
  vtkNew<vtkPolyData> Surfaces;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
