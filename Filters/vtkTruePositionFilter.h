// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTruePositionFilter
 * @brief   true positions of points that are seen through a refracting surface
 *
 * The inverse of vtkRefractedGeometryFilter, for measurements that are made through water or glass:
 * points from photographs, laser scans or depth images lie where they are seen, and the filter
 * moves them to where they are. Port 0 is any vtkPointSet, port 1 the membrane, whose normals point
 * to the eye's side. Port 1 is repeatable; see SetInterfaces() for several surfaces.
 *
 * The sight ray from the eye to a point is refracted by Snell's law where it first meets the front
 * of the membrane, a curved surface through the vertices with their normals (CURVED of
 * vtkRefractedGeometryFilter). The point is moved to the refracted ray, to n2 / n1 times the
 * distance at which it is seen behind the sight point, so that vtkRefractedGeometryFilter moves it
 * back (Eq. 2.4 of the thesis "Refraction by geometric transforms").
 *
 * The output has the structure and the arrays of the input, and the point arrays
 *
 * | name         | type          | components | meaning                                           |
 * |--------------|---------------|------------|---------------------------------------------------|
 * | SeenState    | unsigned char | 1          | one of SeenStates                                 |
 * | SightPoint   | double        | 3          | place where the sight ray meets the membrane; NaN |
 * |              |               |            | if the point is not refracted                     |
 * | OpticalPath  | double        | 1          | length of the path from the eye to the point      |
 * |              |               |            | times the indices of refraction along it          |
 *
 * @sa vtkRefractedGeometryFilter vtkRefractionErrorVolume
 */
#ifndef vtkTruePositionFilter_h
#define vtkTruePositionFilter_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkPointSetAlgorithm.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkPointSet;
class vtkPolyData;
class vtkRefractingInterfaceCollection;

namespace meniscus
{
struct StackTruePosition;
}

class VTKMENISCUS_EXPORT vtkTruePositionFilter : public vtkPointSetAlgorithm
{
public:
  static vtkTruePositionFilter* New();
  vtkTypeMacro(vtkTruePositionFilter, vtkPointSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Values of the array SeenState. */
  enum SeenStates
  {
    UNREFRACTED = 0,       ///< no membrane in front of the point, which is not moved
    REFRACTED = 1,         ///< behind the membrane: the point is moved
    TOTALLY_REFLECTED = 2, ///< beyond the critical angle; the point is not moved
    NOT_FINITE = 3,        ///< not finite, at the eye, or its own eye cannot be used; not moved
    MISSED = 4             ///< the ray misses one of several surfaces; the point is not moved
  };

  /** @{ */
  /** Set/Get the eye in world coordinates. Must be finite. Default is (0, 0, 1). */
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the name of a point array with three components: the eye of each point, for points
   * that were seen from several places, such as the cameras of photographs or the track of a
   * scanner. EyePosition is not used then. A point whose eye is not finite or lies on a surface has
   * the state NOT_FINITE. Points with the same eye should follow each other. As with several
   * interfaces, the side of a surface that an eye is on follows from its normals. An empty name,
   * the default, stands for one eye.
   */
  virtual void SetEyeArrayName(const std::string& name);
  virtual std::string GetEyeArrayName();
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
   * shared with other filters and mappers. Interface i has the surface of connection i of port 1,
   * the indices of refraction and, optionally, the exact surface onto which its points are moved;
   * another number of connections is an error when the filter runs. Null, the default, stands for a
   * list of one with default values.
   *
   * With several interfaces, the media, the sides and the depth of a seen point are those of
   * vtkRefractedGeometryFilter::SetInterfaces(). A ray must meet the interface behind a point, too.
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

  /** Number of points of the last run that have no true position: TOTALLY_REFLECTED. */
  vtkTypeInt64 GetNumberOfTotallyReflectedPoints() const;
  /** Number of points of the last run whose rays miss one of several surfaces: MISSED. */
  vtkTypeInt64 GetNumberOfMissedPoints() const;
  /** Number of patches built since construction: once per change of the membrane's values. */
  vtkTypeInt64 GetNumberOfPatchBuilds() const;
  /** Number of times that the search was set up: once per change of eye, indices or membrane. */
  vtkTypeInt64 GetNumberOfEyeUpdates() const;

  /** Modification time, which includes that of the interfaces. */
  vtkMTimeType GetMTime() override;

protected:
  vtkTruePositionFilter();
  ~vtkTruePositionFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int ComputeInputUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTruePositionFilter(const vtkTruePositionFilter&) = delete;
  void operator=(const vtkTruePositionFilter&) = delete;

  bool UpdateScene(vtkPointSet* points, vtkInformationVector* membranes);
  meniscus::StackTruePosition FindOne(const double seen[3]) const;
  meniscus::StackTruePosition FindThroughStack(const double seen[3]) const;
  bool MovePoints(vtkPointSet* input, vtkPointSet* output);

  double EyePosition[3] = { 0.0, 0.0, 1.0 };
  std::string EyeArrayName;
  vtkSmartPointer<vtkRefractingInterfaceCollection> Interfaces;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
