// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_Membrane_RefractionScene_h
#define meniscus_Filters_Membrane_RefractionScene_h

#include "Filters/Membrane/MembraneExtraction.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"

#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

class vtkImplicitFunction;
class vtkPolyData;

namespace meniscus
{

/** What the owner of a scene has to report; empty if there is nothing. */
struct SceneMessages
{
  std::string Error;
  std::string Warning;
};

/** The half space normal.p + offset >= 0, in world coordinates; the normal is a unit vector. */
struct ViewPlane
{
  glm::dvec3 Normal;
  double Offset;
};

/**
 * A membrane, an eye and two media: what the filters of refraction share. Keeps the kernel's
 * geometry as long as the values behind it hold, whatever the modification times say.
 */
class RefractionScene
{
public:
  /** Position of the eye in the world, exterior and interior index of refraction. */
  using Eye = std::array<double, 5>;

  /**
   * Takes a membrane; with a function, that of its points on the function's zero set. False, with
   * an error, if it cannot be used.
   */
  bool SetMembrane(vtkPolyData* membrane, bool curved, SceneMessages& messages,
    vtkImplicitFunction* function = nullptr);

  /**
   * Takes an eye for the membrane. False, with an error, if it cannot be used. Warns when the eye
   * comes inside of a closed membrane whose normals point outwards, or when pieces of the membrane
   * come to lie behind each other, and when the membrane changes meanwhile.
   */
  bool SetEye(const Eye& eye, SceneMessages& messages);

  const Eye& GetEye() const { return this->Key.Values; }

  /** One image of each point (x, y, z each) in [from, to). */
  void Solve(const double* points, std::size_t from, std::size_t to, VirtualVertex* vertices) const;

  /**
   * Finds the facets that are in view, for an eye that has been set. True if any is out of view.
   */
  bool SetView(const std::vector<ViewPlane>& planes);
  /** Rises with every change of what SetView found. */
  vtkTypeInt64 GetViewChange() const { return this->ViewChange; }
  /** Whether something in the box may be seen through a facet in view, or without the membrane. */
  bool MayBeInView(const glm::dvec3& low, const glm::dvec3& high) const;

  bool IsCurved() const { return this->Curves; }
  const Membrane& GetMembrane() const
  {
    return this->Curves ? this->Curved.GetMembrane() : this->Flat.GetMembrane();
  }
  /** Only the one that IsCurved names has the membrane. */
  CurvedMembraneSolver& GetCurved() { return this->Curved; }
  const CurvedMembraneSolver& GetCurved() const { return this->Curved; }
  const FlatMembraneSolver& GetFlat() const { return this->Flat; }

  vtkTypeInt64 GetNumberOfPatchBuilds() const { return this->PatchBuilds; }
  vtkTypeInt64 GetNumberOfEyeUpdates() const { return this->EyeUpdates; }
  /** Of the present eye and curved membrane. */
  bool IsEyeEnclosed() const { return this->EyeEnclosed; }
  vtkTypeInt64 GetNumberOfMembranePointsBehind() const { return this->PointsBehind; }

private:
  /** Values that the refraction rays depend on. */
  struct EyeKey
  {
    Eye Values{};
    vtkTypeInt64 MembraneBuild = -1;
  };

  MembraneStatus BuildMembrane(bool curved);
  void ReportEye(SceneMessages& messages);
  bool ReportMembrane(MembraneStatus status, std::size_t lost, SceneMessages& messages) const;

  FlatMembraneSolver Flat;
  CurvedMembraneSolver Curved;
  bool Curves = false;

  vtkWeakPointer<vtkPolyData> MembraneSource;
  vtkMTimeType MembraneTime = 0;
  vtkImplicitFunction* Function = nullptr; ///< told apart only
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
  vtkTypeInt64 EyeReportOf = -1; ///< the membrane's build
};

}

#endif
