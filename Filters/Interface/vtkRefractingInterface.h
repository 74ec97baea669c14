// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractingInterface
 * @brief   a surface between two media: indices of refraction and exact form
 *
 * Filters and mappers that refract hold a vtkRefractingInterfaceCollection. The interface of number
 * i has the surface of connection i of their membrane port; its triangles are taken from there. One
 * interface may be given to several filters and mappers, which then share indices and exact
 * surface.
 *
 * @sa vtkRefractingInterfaceCollection vtkRefractedGeometryFilter vtkTetrahedraRayCastMapper
 */
#ifndef vtkRefractingInterface_h
#define vtkRefractingInterface_h

#include "vtkMeniscusModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

class vtkImplicitFunction;

class VTKMENISCUS_EXPORT vtkRefractingInterface : public vtkObject
{
public:
  static vtkRefractingInterface* New();
  vtkTypeMacro(vtkRefractingInterface, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** @{ */
  /**
   * Set/Get the index of refraction on the side that the surface's normals point to, usually the
   * side of the eye or the light. Must be positive and finite; other values are an error of the
   * filter or mapper when it runs. Default is 1.0 (air).
   */
  vtkSetMacro(ExteriorIndexOfRefraction, double);
  vtkGetMacro(ExteriorIndexOfRefraction, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the index of refraction on the other side. Must be positive and finite; other values
   * are an error of the filter or mapper when it runs. Default is 1.333 (water).
   */
  vtkSetMacro(InteriorIndexOfRefraction, double);
  vtkGetMacro(InteriorIndexOfRefraction, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the function whose zero set is the exact surface. Null, the default, stands for none.
   * See vtkRefractedGeometryFilter::SetExactMembrane() and
   * vtkRefractionErrorVolume::SetExactMembrane().
   */
  void SetExactSurface(vtkImplicitFunction* function);
  vtkImplicitFunction* GetExactSurface();
  /** @} */

  /** @{ */
  /**
   * Set/Get whether an open surface is turned over if none of its facets faces the eye or the
   * light: its normals are reversed, so that the eye is on the side of ExteriorIndexOfRefraction.
   * In a list of several interfaces, a surface is turned to the side from which rays pass it when
   * they come from the exterior of the first one. Surfaces with facets on both sides and closed
   * surfaces are not turned. Filters with an eye for each point, vtkTetrahedraRayCastMapper and
   * vtkTetrahedraRayIntegral turn no surface. Default is off: filters with one eye then warn of
   * such a surface, which is right for an eye on the other side, such as an eye under water.
   */
  vtkSetMacro(TurnTowardsEye, bool);
  vtkGetMacro(TurnTowardsEye, bool);
  vtkBooleanMacro(TurnTowardsEye, bool);
  /** @} */

  /** True if the indices differ, so that rays change their direction at the surface. */
  bool IsRefracting() const
  {
    return this->ExteriorIndexOfRefraction != this->InteriorIndexOfRefraction;
  }

  /** Modification time of the interface and of its exact surface, the later one. */
  vtkMTimeType GetMTime() override;

protected:
  vtkRefractingInterface();
  ~vtkRefractingInterface() override;

private:
  vtkRefractingInterface(const vtkRefractingInterface&) = delete;
  void operator=(const vtkRefractingInterface&) = delete;

  double ExteriorIndexOfRefraction = 1.0;
  double InteriorIndexOfRefraction = 1.333;
  bool TurnTowardsEye = false;
  vtkSmartPointer<vtkImplicitFunction> ExactSurface;
};

#endif
