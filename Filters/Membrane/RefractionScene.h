// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_Membrane_RefractionScene_h
#define meniscus_Filters_Membrane_RefractionScene_h

#include "Filters/Membrane/MembraneMessages.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"

#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <array>
#include <cstddef>
#include <vector>

class vtkImplicitFunction;
class vtkPolyData;

namespace meniscus
{

/** The half space normal.p + offset >= 0, in world coordinates; the normal is a unit vector. */
struct ViewPlane
{
  glm::dvec3 Normal;
  double Offset;
};

/**
 * A membrane, an eye and two media: the state that all filters of refraction share. The kernel's
 * geometry is kept as long as the underlying values do not change, whatever the modification times
 * are.
 */
class RefractionScene
{
public:
  /**
   * Position of the eye in world coordinates, followed by the exterior and the interior index of
   * refraction.
   */
  using Eye = std::array<double, 5>;

  /**
   * Sets the membrane; with a function, its points are moved onto the function's zero set. Returns
   * false, with an error message, if the membrane cannot be used.
   */
  bool SetMembrane(vtkPolyData* membrane, bool curved, SceneMessages& messages,
    vtkImplicitFunction* function = nullptr);

  /**
   * Sets the eye. Returns false, with an error message, if it cannot be used. Adds a warning when
   * the eye enters a closed membrane whose normals point outwards, when pieces of the membrane come
   * to lie behind each other, and when the membrane changes in such a state. With `reflects`, for
   * curved membranes only, the membrane is a mirror.
   */
  bool SetEye(const Eye& eye, SceneMessages& messages, bool reflects = false);

  const Eye& GetEye() const { return this->Key.Values; }

  /** Computes one image of each point (x, y, z each) in [from, to). */
  void Solve(const double* points, std::size_t from, std::size_t to, VirtualVertex* vertices) const;

  /**
   * Determines the facets in view; the eye must have been set. Returns true if any facet is out of
   * view.
   */
  bool SetView(const std::vector<ViewPlane>& planes);
  /** Increases with every change of the facets in view. */
  vtkTypeInt64 GetViewChange() const { return this->ViewChange; }
  /** True if a part of the box may be seen through a facet in view, or without the membrane. */
  bool MayBeInView(const glm::dvec3& low, const glm::dvec3& high) const;

  bool IsCurved() const { return this->Curves; }
  const Membrane& GetMembrane() const
  {
    return this->Curves ? this->Curved.GetMembrane() : this->Flat.GetMembrane();
  }
  /** Solver that holds the membrane if IsCurved is true; otherwise it is empty. */
  CurvedMembraneSolver& GetCurved() { return this->Curved; }
  const CurvedMembraneSolver& GetCurved() const { return this->Curved; }
  const FlatMembraneSolver& GetFlat() const { return this->Flat; }

  vtkTypeInt64 GetNumberOfPatchBuilds() const { return this->PatchBuilds; }
  vtkTypeInt64 GetNumberOfEyeUpdates() const { return this->EyeUpdates; }
  /** Results for the current eye and curved membrane. */
  bool IsEyeEnclosed() const { return this->EyeEnclosed; }
  vtkTypeInt64 GetNumberOfMembranePointsBehind() const { return this->PointsBehind; }

private:
  /** Values on which the refracted rays depend. */
  struct EyeKey
  {
    Eye Values{};
    vtkTypeInt64 MembraneBuild = -1;
    bool Reflects = false;
  };

  MembraneStatus BuildMembrane(bool curved);
  void ReportEye(SceneMessages& messages);

  FlatMembraneSolver Flat;
  CurvedMembraneSolver Curved;
  bool Curves = false;

  vtkWeakPointer<vtkPolyData> MembraneSource;
  vtkMTimeType MembraneTime = 0;
  vtkImplicitFunction* Function = nullptr; ///< used for comparison only
  vtkMTimeType FunctionTime = 0;
  MembraneArrays Arrays;
  bool MembraneReady = false;
  EyeKey Key;
  std::vector<bool> FacetsInView;
  vtkTypeInt64 ViewChange = 0;

  vtkTypeInt64 PatchBuilds = 0;
  vtkTypeInt64 EyeUpdates = 0;
  bool EyeEnclosed = false;
  vtkTypeInt64 PointsBehind = 0;
  vtkTypeInt64 EyeReportOf = -1; ///< build number of the membrane for which the warnings were given
};

}

#endif
