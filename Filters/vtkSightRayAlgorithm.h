// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSightRayAlgorithm
 * @brief   base of the filters that trace sight rays to points through refracting surfaces
 *
 * Port 0 is a vtkPointSet, each of whose points lies on a sight ray; port 1 has the surfaces, one
 * connection per interface of SetInterfaces(), as in vtkTruePositionFilter. Rays may start from one
 * eye or from an eye per point.
 *
 * @sa vtkSightRayFilter vtkTriangulatedPositionFilter vtkTruePositionFilter
 */
#ifndef vtkSightRayAlgorithm_h
#define vtkSightRayAlgorithm_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkPointSet;
class vtkRefractingInterfaceCollection;

namespace meniscus
{
class PointEyes;
class RefractionStack;
}

class VTKMENISCUS_EXPORT vtkSightRayAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkSightRayAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** @{ */
  /** Set/Get the eye of all points in world coordinates. Default is (0, 0, 1). */
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the name of a point array with three components: the eye of each point. EyePosition is
   * not used then. An empty name, the default, stands for one eye.
   */
  virtual void SetEyeArrayName(const std::string& name);
  virtual std::string GetEyeArrayName();
  /** @} */

  /** @{ */
  /** Set/Get the indices of refraction of the first interface; see SetInterfaces(). */
  virtual void SetExteriorIndexOfRefraction(double index);
  virtual double GetExteriorIndexOfRefraction();
  virtual void SetInteriorIndexOfRefraction(double index);
  virtual double GetInteriorIndexOfRefraction();
  /** @} */

  /** @{ */
  /**
   * Set/Get the refracting interfaces, in the order in which sight rays meet them, as in
   * vtkTruePositionFilter::SetInterfaces().
   */
  void SetInterfaces(vtkRefractingInterfaceCollection* interfaces);
  vtkRefractingInterfaceCollection* GetInterfaces();
  /** @} */

  /** @{ */
  /** Set the first surface, add that of the next interface, remove all, get their number. */
  void SetMembraneConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetMembraneData(vtkPolyData* membrane);
  void AddMembraneConnection(vtkAlgorithmOutput* output);
  void AddMembraneData(vtkPolyData* membrane);
  void RemoveAllMembranes();
  int GetNumberOfMembranes();
  /** @} */

  /** Number of patches built since construction: once per change of a surface's values. */
  vtkTypeInt64 GetNumberOfPatchBuilds() const;

  /** Modification time, which includes that of the interfaces. */
  vtkMTimeType GetMTime() override;

protected:
  vtkSightRayAlgorithm();
  ~vtkSightRayAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /** Sets surfaces and eyes. Returns false after an error, which has been reported. */
  bool UpdateScene(vtkPointSet* points, vtkInformationVector* membranes, meniscus::PointEyes& eyes);
  /** The stack of the last UpdateScene(). */
  const meniscus::RefractionStack& GetStack() const;

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
