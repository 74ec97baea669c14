// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Membrane/MembraneMessages.h"
#include "Filters/Membrane/PreparedScene.h"

#include "vtkType.h"

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

class vtkImplicitFunction;
class vtkInformationVector;
class vtkPolyData;
class vtkRefractingInterfaceCollection;

namespace meniscus
{

/** The half space normal.p + offset >= 0, in world coordinates; the normal is a unit vector. */
struct ViewPlane
{
  glm::dvec3 Normal;
  double Offset;
};

/**
 * One or more surfaces between media, and an eye: the state that all filters of refraction share.
 * The kernel's geometry is kept as long as the underlying values do not change, whatever the
 * modification times are. A surface that is listed twice is built once. Scenes that are updated
 * while a Loan exists have their surfaces together if their values are the same; others have their
 * own.
 */
class RefractionScene
{
public:
  /** Use of an interface's exact surface: the points are moved onto it, or left where they are. */
  enum class Fitting
  {
    Exact,
    AsGiven
  };

  /** Computations for an eye: images of points, or sight rays alone, which need no preparation. */
  enum class Use
  {
    Images,
    Rays
  };

  explicit RefractionScene(Fitting fitting = Fitting::Exact, Use use = Use::Images);
  RefractionScene(const RefractionScene&) = delete;
  RefractionScene& operator=(const RefractionScene&) = delete;

  /**
   * Permission to use surfaces that other scenes may have prepared. After the loan, the scene must
   * not solve, nor return its solver, before the next one.
   */
  class Loan
  {
  public:
    explicit Loan(RefractionScene& scene);
    ~Loan();
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

  private:
    RefractionScene& Scene;
  };

  /** Surfaces at a port of the scene's owner, and their interfaces. */
  struct Input
  {
    vtkInformationVector* Surfaces;
    int Port; ///< its number, for messages
    vtkRefractingInterfaceCollection* Interfaces;
    bool IsCurved = true;  ///< false: flat facets, of one surface
    bool Reflects = false; ///< true: one surface, a mirror of curved patches
  };

  /**
   * Sets surfaces and eye. Returns false, with an error, if they cannot be used. An error in
   * `messages` is kept unless the list has one.
   */
  bool Update(const Input& input, const std::array<double, 3>& eye, SceneMessages& messages);

  /** Sets the surfaces alone, for rays from several eyes, or for SetEye(). */
  bool SetSurfaces(const Input& input, SceneMessages& messages);

  /**
   * Sets the eye, and turns surfaces round whose interfaces say so. Returns false, with an error,
   * if the eye cannot be used. Warns, once per change, of an eye from which rays do not pass the
   * surfaces in the order of the list, and of an eye inside of a closed membrane or behind pieces
   * of it.
   */
  bool SetEye(const std::array<double, 3>& eye, SceneMessages& messages);

  /**
   * Warns if no eye sees the side of the first refracting surface from which rays pass it, unless
   * it was so at the last call with the same surfaces. Eyes are examined once per change of the
   * surfaces, or of the eye of SetEye().
   */
  void ReportEyes(const std::vector<glm::dvec3>& eyes, SceneMessages& messages);

  glm::dvec3 GetEye() const
  {
    return glm::dvec3(this->View.Eye[0], this->View.Eye[1], this->View.Eye[2]);
  }

  /**
   * Interfaces that rays from the eye pass; one interface is passed from its front. Places are
   * relative to GetOrigin().
   */
  std::vector<RefractionStack::Link> ListLinks() const;
  const glm::dvec3& GetOrigin() const;
  /** Computes the parts of the surfaces that single rays need, unless they exist. */
  void PrepareCrossings();
  /** False if the eye is known to see no side from which rays pass the surfaces. */
  bool SeesSurface() const { return this->Sees; }
  /** The first refracting surface in front of the eye; without one, the list's first surface. */
  const Membrane& GetFirstMembrane() const;

  /** Calls `body` with the solver of the surfaces and returns its result. */
  template <typename Body>
  auto Visit(Body&& body)
  {
    return std::visit(std::forward<Body>(body), this->Prepared->Solver);
  }
  /**
   * Solver of several interfaces, which gives details of the paths through them; null if there is
   * one only.
   */
  const StackSolver* GetPathSolver() const
  {
    return std::get_if<StackSolver>(&this->Prepared->Solver);
  }
  /** Solver of one interface with curved patches, which alone may be asked for it. */
  CurvedMembraneSolver& GetCurved()
  {
    return std::get<CurvedMembraneSolver>(this->Prepared->Solver);
  }
  /** The interface of GetCurved() as a list, if it is an exact plane before the eye; or null. */
  const ParallelPlanes* GetPlane() const
  {
    return this->Prepared->Plane.IsEmpty() ? nullptr : &this->Prepared->Plane;
  }
  /** Interfaces of a scene that is used for rays. */
  const RefractionStack& GetStack() const { return this->GetPathSolver()->GetStack(); }

  /**
   * Computes one image of each point (x, y, z each) in [from, to). `details` and `legs` are those
   * of StackSolver::Solve; one interface leaves them as they are.
   */
  void Solve(const double* points, std::size_t from, std::size_t to, VirtualVertex* vertices,
    StackDetail* details, double* legs) const;

  /**
   * Determines the facets in view; the eye must have been set. Returns true if any facet of one
   * interface is out of view.
   */
  bool SetView(const std::vector<ViewPlane>& planes);
  /** Increases with every change of the facets in view. */
  vtkTypeInt64 GetViewChange() const { return this->ViewChange; }
  /** True if a part of the box may be seen through a facet in view, or without the membrane. */
  bool MayBeInView(const glm::dvec3& low, const glm::dvec3& high) const;

  /** Numbers that change with the shapes, and with the rays, whichever scene prepares them. */
  const SceneVersion& GetVersion() const { return this->Version; }
  /** Counters of the shapes and rays that this scene has prepared. */
  vtkTypeInt64 GetNumberOfPatchBuilds() const { return this->PatchBuilds; }
  vtkTypeInt64 GetNumberOfEyeUpdates() const { return this->EyeUpdates; }
  /** Results for the current eye and one curved membrane. */
  bool IsEyeEnclosed() const { return this->EyeEnclosed; }
  vtkTypeInt64 GetNumberOfMembranePointsBehind() const { return this->PointsBehind; }
  /** Number of triangles that were skipped, of all surfaces. */
  std::size_t GetNumberOfSkippedFacets() const { return this->SkippedFacets; }
  /** Number of this scene's searches and sides that were undecided. */
  vtkTypeInt64 GetNumberOfUndecided() const;

private:
  /** Objects that a surface is read from. */
  struct Source
  {
    vtkPolyData* Data;
    vtkImplicitFunction* Function;
    bool Curves;
  };
  std::vector<Source> ListSources(const Input& input, SceneMessages& messages) const;
  void Borrow(const std::vector<Source>& sources);
  bool UpdateSurfaces(const std::vector<Source>& sources, SceneMessages& messages);
  bool ReadSurface(std::size_t index, const Source& source);
  bool ReportSurfaces(SceneMessages& messages);
  template <typename Solver>
  Solver& UseSolver();
  void SetSolver();
  bool IsOnWrongSide(std::size_t index, const glm::dvec3& eye) const;
  void TurnSurfaces();
  EyeStatus PlaceEye();
  bool FindPlane(const CurvedMembraneSolver& curved);
  std::string DescribeMembrane(const CurvedMembraneSolver* curved);
  std::string DescribeList(const RefractionStack& stack);
  std::string DescribePieces(std::size_t index, const std::vector<glm::dvec3>& eyes, double side);
  /** The solver's count, to which all of its users add. */
  vtkTypeInt64 CountUndecided() const;

  Fitting UsedFitting;
  Use UsedFor;
  std::shared_ptr<PreparedScene> Prepared = std::make_shared<PreparedScene>();
  SceneVersion Version; ///< of the surfaces when this scene used them last
  SceneView View;
  std::vector<vtkTypeInt64> ReportedShapes; ///< of the surfaces that were described last
  std::vector<bool> FacetsInView;
  vtkTypeInt64 ViewChange = 0;

  vtkTypeInt64 PatchBuilds = 0;
  vtkTypeInt64 EyeUpdates = 0;
  std::size_t SkippedFacets = 0;
  bool MayBorrow = false;           ///< there is a Loan
  bool HasBorrowed = false;         ///< and it has been used
  vtkTypeInt64 Undecided = 0;       ///< until the last change of the solver or of a loan
  vtkTypeInt64 UndecidedBefore = 0; ///< count of the solver at that time
  bool AreEyesExamined = false;     ///< by ReportEyes(), with AreEyesBehind as the result
  bool AreEyesBehind = false;
  bool Sees = true;
  std::size_t InterfacesBehindEye = 0; ///< refracting interfaces that are left out
  bool EyeEnclosed = false;
  vtkTypeInt64 PointsBehind = 0;
  vtkTypeInt64 EyeReportOf = -1; ///< number of the shape for which the warnings were given
  vtkTypeInt64 PieceReportOf = -1;
};

}
