// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_Membrane_RefractionScene_h
#define meniscus_Filters_Membrane_RefractionScene_h

#include "Filters/Membrane/MembraneMessages.h"
#include "Filters/Membrane/PreparedMembrane.h"

#include "vtkType.h"

#include <cstddef>
#include <memory>
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
 * are. Scenes that are set while a Loan exists have one membrane together if their values are the
 * same; others have their own.
 */
class RefractionScene
{
public:
  /**
   * Position of the eye in world coordinates, followed by the exterior and the interior index of
   * refraction.
   */
  using Eye = std::array<double, 5>;

  RefractionScene();
  RefractionScene(const RefractionScene&) = delete;
  RefractionScene& operator=(const RefractionScene&) = delete;

  /**
   * Use of a membrane that other scenes may have prepared, see BorrowMembrane(). Call SetMembrane()
   * and SetEye() with the same values afterwards. The scene must not solve, nor return its solvers,
   * without a loan from then on.
   */
  class Loan
  {
  public:
    Loan(RefractionScene& scene, vtkPolyData* membrane, bool curved, vtkImplicitFunction* function,
      const MembraneView& view);
    ~Loan();
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

  private:
    RefractionScene& Scene;
  };

  /**
   * Sets the membrane; with a function, its points are moved onto the function's zero set. Returns
   * false, with an error message, if the membrane cannot be used.
   */
  bool SetMembrane(vtkPolyData* membrane, bool curved, SceneMessages& messages,
    vtkImplicitFunction* function = nullptr);

  /**
   * Sets the eye. Returns false, with an error message, if it cannot be used. Adds a warning when
   * the eye enters a closed membrane whose normals point outwards or comes behind an open one, when
   * pieces of the membrane come to lie behind each other, and when the membrane changes in such a
   * state. A membrane is a mirror, or turned round, as the view says; mirrors are curved.
   */
  bool SetEye(const MembraneView& view, SceneMessages& messages);

  const Eye& GetEye() const { return this->View.Eye; }

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

  bool IsCurved() const { return this->Prepared->Surface.GetOrigin().Curves; }
  const Membrane& GetMembrane() const { return this->Prepared->Surface.GetMembrane(); }
  const std::shared_ptr<RefractingSurface>& GetSurface() const
  {
    return this->Prepared->Surface.GetSurface();
  }
  /** Solver that holds the membrane if IsCurved is true; otherwise it is empty. */
  CurvedMembraneSolver& GetCurved() { return this->Prepared->Curved; }
  const CurvedMembraneSolver& GetCurved() const { return this->Prepared->Curved; }
  const FlatMembraneSolver& GetFlat() const { return this->Prepared->Flat; }

  /** Numbers that change with the shape, and with the rays, whichever scene prepares them. */
  const MembraneVersion& GetVersion() const { return this->Version; }
  /** Counters of the shapes and rays that this scene has prepared. */
  vtkTypeInt64 GetNumberOfPatchBuilds() const { return this->PatchBuilds; }
  vtkTypeInt64 GetNumberOfEyeUpdates() const { return this->EyeUpdates; }
  /** Results for the current eye and curved membrane. */
  bool IsEyeEnclosed() const { return this->EyeEnclosed; }
  /** True if the membrane is open and no facet faces the eye. */
  bool IsEyeBehind() const { return this->EyeBehind; }
  vtkTypeInt64 GetNumberOfMembranePointsBehind() const { return this->PointsBehind; }

  /** Number of the membrane's triangles that were skipped. */
  std::size_t GetNumberOfSkippedFacets() const { return this->SkippedFacets; }
  /** Number of this scene's searches and sides that were undecided. */
  vtkTypeInt64 GetNumberOfUndecided() const;

private:
  void SetShape();
  void TurnMembrane(const MembraneView& view);
  void ReportEye(SceneMessages& messages);
  /** The solver's count, to which all of its users add. */
  vtkTypeInt64 CountUndecided() const;

  std::shared_ptr<PreparedMembrane> Prepared;
  MembraneVersion Version; ///< of the membrane when this scene used it last
  MembraneView View;
  std::vector<bool> FacetsInView;
  vtkTypeInt64 ViewChange = 0;

  vtkTypeInt64 PatchBuilds = 0;
  vtkTypeInt64 EyeUpdates = 0;
  std::size_t SkippedFacets = 0;
  bool HasLoan = false;
  vtkTypeInt64 Undecided = 0;       ///< until the last loan
  vtkTypeInt64 UndecidedBefore = 0; ///< count of the solver at the beginning of the loan
  bool EyeEnclosed = false;
  bool EyeBehind = false;
  vtkTypeInt64 PointsBehind = 0;
  vtkTypeInt64 EyeReportOf = -1; ///< number of the shape for which the warnings were given
};

}

#endif
