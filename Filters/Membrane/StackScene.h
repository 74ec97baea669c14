// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_Membrane_StackScene_h
#define meniscus_Filters_Membrane_StackScene_h

#include "Filters/Membrane/SourceSurface.h"
#include "Refraction/Stack/StackSolver.h"

#include "vtkType.h"

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

class vtkRefractingInterfaceCollection;

namespace meniscus
{

/**
 * Several surfaces between media, and an eye: as RefractionScene, but for a list of interfaces. A
 * surface that is listed twice is built once.
 */
class StackScene
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

  explicit StackScene(Fitting fitting = Fitting::Exact, Use use = Use::Images)
    : UsedFitting(fitting)
    , UsedFor(use)
  {
  }

  /**
   * Sets the surfaces and their interfaces, which FindStackFault accepts. Returns false, with an
   * error, if a surface cannot be used.
   */
  bool SetInterfaces(const std::vector<vtkPolyData*>& surfaces,
    vtkRefractingInterfaceCollection* interfaces, SceneMessages& messages);

  /**
   * Sets the eye, and turns surfaces round whose interfaces say so. Returns false, with an error,
   * if the eye cannot be used. Warns, once per change, if no ray from the eye passes the surfaces
   * in the order of the list, and when the eye comes behind the first of them.
   */
  bool SetEye(const std::array<double, 3>& eye, SceneMessages& messages);

  /**
   * Warns if no eye sees the side of the first refracting surface from which rays pass it, unless
   * it was so at the last call with the same surfaces. Eyes are examined once per change of the
   * surfaces, or of the eye of SetEye().
   */
  void ReportEyes(const std::vector<glm::dvec3>& eyes, SceneMessages& messages);

  const StackSolver& GetSolver() const { return this->Solver; }
  /** The first surface in front of the eye that refracts; that of the list if there is none. */
  const Membrane& GetFirstMembrane() const;

  vtkTypeInt64 GetNumberOfPatchBuilds() const { return this->PatchBuilds; }
  vtkTypeInt64 GetNumberOfEyeUpdates() const { return this->EyeUpdates; }
  /** Number of the rays for the current eye and surfaces, see MembraneVersion. */
  vtkTypeInt64 GetRays() const { return this->Rays; }

private:
  struct Entry
  {
    /** Copies share the surface of an earlier entry with the same values. */
    SourceSurface Source{ SourceSurface::Change::NewObject };
    bool Turns = false; ///< the surface is turned towards the eye
  };

  bool UpdateEntry(std::size_t index, vtkPolyData* source, vtkImplicitFunction* function,
    bool& isNew, SceneMessages& messages);
  void SetSolverInterfaces();
  bool IsOnWrongSide(std::size_t index, const glm::dvec3& eye) const;
  void TurnSurfaces(const glm::dvec3& eye);
  std::string DescribeSides();

  Fitting UsedFitting;
  Use UsedFor;
  std::vector<Entry> Entries;
  std::vector<InterfaceMedia> Media;
  StackSolver Solver;
  std::array<double, 3> Eye{};
  bool IsEyeReady = false;
  bool AreEyesExamined = false; ///< by ReportEyes(), with AreEyesBehind as the result
  bool AreEyesBehind = false;
  std::size_t InterfacesBehindEye = 0; ///< refracting interfaces that are left out
  vtkTypeInt64 PatchBuilds = 0;
  vtkTypeInt64 EyeUpdates = 0;
  vtkTypeInt64 Rays = -1;
};

}

#endif
