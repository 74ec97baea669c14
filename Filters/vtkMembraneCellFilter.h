// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMembraneCellFilter
 * @brief   cells of a refracting membrane as wedges
 *
 * Computes the part of space that an eye sees through each facet of the membrane: the prism between
 * the three refracted rays at the facet's corners (the thesis "Refraction by geometric transforms",
 * Fig. 3.1). The cells show how a membrane spreads or focuses the view, and where objects must be
 * to be seen. The rays at the corners are exact for the membrane's points and normals.
 *
 * Input port 0 is the membrane, as for vtkRefractedGeometryFilter, or several of them with
 * SetInterfaces(). Rays start at the corners of the first one. Behind it, and behind each later
 * interface, there is one wedge per facet, down to the next interface; behind the last one, edges
 * along the rays have the length CellLength.
 *
 * Output is a vtkUnstructuredGrid of VTK_WEDGE cells that share the points of their rays, with
 * - the point array `OpticalPath` (double): length of the path from the eye, times the indices of
 *   refraction along it;
 * - the cell array `FacetId` (vtkIdType): the cell of the first membrane;
 * - the cell array `Leg` (int): 1 behind the first interface, and so on;
 * - the cell array `IndexOfRefraction` (double): index of the cell's medium;
 * - the cell array `Orientation` (signed char): 1, or -1 if the rays cross in one direction because
 *   the membrane focuses, so that the far side is mirrored.
 *
 * A facet has no cells if a corner faces away from the eye or a ray is totally reflected there.
 * Where a ray is totally reflected at a later interface, or misses it, the cells of that leg and of
 * all legs behind it are left out. These facets are counted.
 *
 * @sa vtkSightRayFilter vtkRefractedGeometryFilter
 */
#ifndef vtkMembraneCellFilter_h
#define vtkMembraneCellFilter_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkSmartPointer.h"   // For the list of interfaces
#include "vtkUnstructuredGridAlgorithm.h"

#include <memory> // For std::unique_ptr

class vtkPolyData;
class vtkRefractingInterfaceCollection;

class VTKMENISCUS_EXPORT vtkMembraneCellFilter : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkMembraneCellFilter* New();
  vtkTypeMacro(vtkMembraneCellFilter, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** @{ */
  /**
   * Set/Get the eye in world coordinates. Must be finite and not on the first surface; anything
   * else is an error when the filter runs. Default is (0, 0, 1).
   */
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the indices of refraction of the first interface, on the eye's side and behind the
   * surface. Must be positive and finite; anything else is an error when the filter runs. Defaults
   * are 1.0 and 1.333.
   */
  virtual void SetExteriorIndexOfRefraction(double index);
  virtual double GetExteriorIndexOfRefraction();
  virtual void SetInteriorIndexOfRefraction(double index);
  virtual double GetInteriorIndexOfRefraction();
  /** @} */

  /** @{ */
  /**
   * Set/Get the refracting interfaces, in the order in which sight rays meet them, as for
   * vtkRefractedGeometryFilter::SetInterfaces(). Interface i has the surface of connection i of
   * port 0. Null, the default, stands for a list of one with default values.
   */
  void SetInterfaces(vtkRefractingInterfaceCollection* interfaces);
  vtkRefractingInterfaceCollection* GetInterfaces();
  /** @} */

  /** @{ */
  /**
   * Add the surface of the next interface of the list to port 0, by connection or as data; remove
   * all surfaces; get their number.
   */
  void AddMembraneConnection(vtkAlgorithmOutput* output);
  void AddMembraneData(vtkPolyData* membrane);
  void RemoveAllMembranes();
  int GetNumberOfMembranes();
  /** @} */

  /** @{ */
  /**
   * Set/Get the length of the rays behind the last interface, in world units. Must be positive and
   * finite; anything else is an error when the filter runs. Default is 1.
   */
  vtkSetMacro(CellLength, double);
  vtkGetMacro(CellLength, double);
  /** @} */

  /** @{ */
  /**
   * Facets of the last update without all of their cells: with a corner that faces away from the
   * eye; otherwise with a totally reflected ray; otherwise with a ray that misses an interface.
   */
  vtkGetMacro(NumberOfBackFacingFacets, vtkIdType);
  vtkGetMacro(NumberOfTotallyReflectedFacets, vtkIdType);
  vtkGetMacro(NumberOfMissedFacets, vtkIdType);
  /** @} */

  /** Modification time of this filter and of the interfaces. */
  vtkMTimeType GetMTime() override;

protected:
  vtkMembraneCellFilter();
  ~vtkMembraneCellFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkMembraneCellFilter(const vtkMembraneCellFilter&) = delete;
  void operator=(const vtkMembraneCellFilter&) = delete;

  bool UpdateScene(vtkInformationVector* membranes);

  double EyePosition[3] = { 0.0, 0.0, 1.0 };
  double CellLength = 1.0;
  vtkIdType NumberOfBackFacingFacets = 0;
  vtkIdType NumberOfTotallyReflectedFacets = 0;
  vtkIdType NumberOfMissedFacets = 0;
  vtkSmartPointer<vtkRefractingInterfaceCollection> Interfaces;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
