// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractedLightFilter
 * @brief   how brightly a light shines on geometry through a membrane: caustics
 *
 * Adds to polygonal geometry (port 0) the irradiance that it gets from a light beyond a membrane
 * (port 1): refracted light gathers in bright lines on the floor of a pool.
 *
 *     light->SetInputConnection(floor->GetOutputPort());
 *     light->SetMembraneConnection(water->GetOutputPort());
 *     light->SetLightPosition(0.3, 0.0, 1.0);
 *     filter->SetInputConnection(light->GetOutputPort()); // vtkRefractedGeometryFilter, say
 *
 * The output is the input with the array `RefractionIrradiance` (float, one component) per cell and
 * per point, in units of what the light throws on a surface that faces it at the membrane: flat
 * water under light that comes straight down lets through 0.98 of it. What a cell gets is
 *
 *     (1 - F) A' / A,
 *
 * A the cell's area, A' that of the part of the membrane that its light passes, as the light sees
 * it, F Fresnel's reflectance there (Eq. 2.6 of the thesis that Documentation/refraction.md
 * retells). With the light in place of the eye the parts are the sight points of the cell's images,
 * which vtkRefractedGeometryFilter finds; where the light is folded a cell has several, and they
 * add up. So what the cells get together is what the membrane lets through, whatever their size. A
 * point has the mean of its cells, by area.
 *
 * Lines and vertices get 0, like what the light does not reach through the membrane.
 *
 * @note Objects throw no shadows, on themselves only if OneSided is set.
 * @note A cell is lit evenly: what is smaller than it is not seen.
 * @note A light at infinity is taken for one ten thousand times the scene's size away.
 *
 * @sa vtkRefractedGeometryFilter
 */
#ifndef vtkRefractedLightFilter_h
#define vtkRefractedLightFilter_h

#include "vtkBoundingBox.h"    // For what the light falls on
#include "vtkMeniscusModule.h" // For export macro
#include "vtkNew.h"            // For the filter inside
#include "vtkPolyDataAlgorithm.h"

class vtkRefractedGeometryFilter;

class VTKMENISCUS_EXPORT vtkRefractedLightFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkRefractedLightFilter* New();
  vtkTypeMacro(vtkRefractedLightFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** @{ */
  /**
   * Set/Get where the light is, in world coordinates, if it is positional; else the direction to
   * it. Finite and, as a direction, not zero; anything else is an error when the filter runs.
   * Default is (0, 0, 1).
   */
  vtkSetVector3Macro(LightPosition, double);
  vtkGetVector3Macro(LightPosition, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether the light is at a place, not at infinity. Default is off.
   */
  vtkSetMacro(Positional, bool);
  vtkGetMacro(Positional, bool);
  vtkBooleanMacro(Positional, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether cells are lit from the side only from which their points are counter-clockwise,
   * as those of closed surfaces are. Default is off.
   */
  vtkSetMacro(OneSided, bool);
  vtkGetMacro(OneSided, bool);
  vtkBooleanMacro(OneSided, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the indices of refraction on the light's side and behind the membrane. Positive and
   * finite; anything else is an error when the filter runs. Defaults are 1.0 and 1.333.
   */
  vtkSetMacro(ExteriorIndexOfRefraction, double);
  vtkGetMacro(ExteriorIndexOfRefraction, double);
  vtkSetMacro(InteriorIndexOfRefraction, double);
  vtkGetMacro(InteriorIndexOfRefraction, double);
  /** @} */

  /** @{ */
  /**
   * Set the membrane, port 1, by connection or by data.
   */
  void SetMembraneConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetMembraneData(vtkPolyData* membrane);
  /** @} */

  /**
   * The filter that looks from the light; its counters tell what was computed.
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
   * Of geometry beside the input that the same light falls on: other pieces and blocks. A light at
   * infinity is then where it is for all of them together. Default is none.
   */
  vtkBoundingBox OtherGeometry;

private:
  vtkRefractedLightFilter(const vtkRefractedLightFilter&) = delete;
  void operator=(const vtkRefractedLightFilter&) = delete;

  bool PlaceLight(vtkPolyData* input, vtkPolyData* membrane);
  bool Look(vtkPolyData* input, vtkPolyData* membrane);

  double LightPosition[3] = { 0.0, 0.0, 1.0 };
  bool Positional = false;
  bool OneSided = false;
  double ExteriorIndexOfRefraction = 1.0;
  double InteriorIndexOfRefraction = 1.333;
  vtkNew<vtkRefractedGeometryFilter> View;
  vtkNew<vtkPolyData> Surfaces;
};

#endif
