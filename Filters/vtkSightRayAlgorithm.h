// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSightRayAlgorithm
 * @brief   base of the filters that trace sight rays to points through refracting surfaces
 *
 * Port 0 is a vtkPointSet, each of whose points lies on a sight ray; port 1 has the surfaces, one
 * connection per interface of SetInterfaces(). Rays may start from one eye or from an eye per
 * point. The output of subclasses is vtkPolyData, if they do not override
 * FillOutputPortInformation() and RequestDataObject().
 *
 * @sa vtkSightRayFilter vtkTriangulatedPositionFilter vtkTruePositionFilter
 */
#ifndef vtkSightRayAlgorithm_h
#define vtkSightRayAlgorithm_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkPointSetAlgorithm.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

#include <functional> // For std::function
#include <memory>     // For std::unique_ptr
#include <string>     // For std::string

class vtkPointSet;
class vtkPolyData;
class vtkRefractingInterfaceCollection;

namespace meniscus
{
class PointEyes;
class RefractionStack;
class RefractionScene;
}

class VTKMENISCUS_EXPORT vtkSightRayAlgorithm : public vtkPointSetAlgorithm
{
public:
  vtkTypeMacro(vtkSightRayAlgorithm, vtkPointSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** @{ */
  /**
   * Set/Get the eye in world coordinates. Must be finite and on no surface. The side of a surface
   * that an eye is on follows from the normals. Default is (0, 0, 1).
   */
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the name of a point array with three components: the eye of each point, for points
   * that were seen from several places, such as the cameras of photographs or the track of a
   * scanner. EyePosition is not used then. A point whose eye is not finite or lies on a surface
   * counts as one that is not finite. Points with the same eye should follow each other. An
   * empty name, the default, means that all points have the eye EyePosition.
   */
  virtual void SetEyeArrayName(const std::string& name);
  virtual std::string GetEyeArrayName();
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
   * Set/Get the refracting interfaces, in the order in which sight rays meet them. The list may be
   * shared with other filters and mappers. Interface i has the surface of connection i of port 1,
   * the indices of refraction and, optionally, the exact surface onto which its points are moved;
   * another number of connections is an error when the filter runs. Null, the default, stands for a
   * list of one with default values.
   *
   * With several interfaces, the media, the sides and the depth of a seen point are defined by
   * vtkRefractedGeometryFilter::SetInterfaces(). If there is an interface behind a point, the ray
   * to the point must also meet that interface.
   */
  void SetInterfaces(vtkRefractingInterfaceCollection* interfaces);
  vtkRefractingInterfaceCollection* GetInterfaces();
  /** @} */

  /** @{ */
  /**
   * Set the first surface at port 1; add the surface of the next interface of the list; both by
   * connection or as data; remove all surfaces; get their number.
   */
  void SetMembraneConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetMembraneData(vtkPolyData* membrane);
  void AddMembraneConnection(vtkAlgorithmOutput* output);
  void AddMembraneData(vtkPolyData* membrane);
  void RemoveAllMembranes();
  int GetNumberOfMembranes();
  /** @} */

  /**
   * Number of times since construction that the patches of a surface were built: once per change of
   * its points, triangles or normals.
   */
  vtkTypeInt64 GetNumberOfPatchBuilds() const;

  /** Modification time of this filter and of the interfaces. */
  vtkMTimeType GetMTime() override;

protected:
  vtkSightRayAlgorithm();
  ~vtkSightRayAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int ComputeInputUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /** Sets surfaces and eyes. Returns false after an error, which has been reported. */
  bool UpdateScene(vtkPointSet* points, vtkInformationVector* membranes, meniscus::PointEyes& eyes);
  /**
   * Calls `body(begin, end)` for consecutive ranges of numbers below `count`, and reports progress
   * in between. Returns false after an abort.
   */
  bool RunInSteps(vtkIdType count, const std::function<void(vtkIdType, vtkIdType)>& body);
  /** The stack of the last UpdateScene(). */
  const meniscus::RefractionStack& GetStack() const;
  /** The surfaces, their interfaces and the stack made of them. */
  const meniscus::RefractionScene& GetScene() const;

private:
  vtkSightRayAlgorithm(const vtkSightRayAlgorithm&) = delete;
  void operator=(const vtkSightRayAlgorithm&) = delete;

  double EyePosition[3] = { 0.0, 0.0, 1.0 };
  std::string EyeArrayName;
  vtkSmartPointer<vtkRefractingInterfaceCollection> Interfaces;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
