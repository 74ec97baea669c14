// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Surfaces that are ready for solving, and a list of them, so that scenes with the same surfaces,
 * eye and indices of refraction prepare them once together.
 */
#pragma once

#include "Filters/Membrane/SourceSurface.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"
#include "Refraction/Stack/StackSolver.h"

#include "vtkType.h"

#include <array>
#include <memory>
#include <variant>
#include <vector>

namespace meniscus
{

/** Values, besides the shapes of the surfaces, on which the rays behind them depend. */
struct SceneView
{
  std::array<double, 3> Eye{};       ///< world coordinates
  std::vector<InterfaceMedia> Media; ///< of each interface
  /** Whether each surface, if it is open and shows the eye its other side, is turned round. */
  std::vector<bool> Turns;
  bool Reflects = false;

  bool operator==(const SceneView& other) const
  {
    return this->Eye == other.Eye && this->Media == other.Media && this->Turns == other.Turns &&
      this->Reflects == other.Reflects;
  }
};

/** Numbers of the shapes of a scene and of their rays. No two of them in a process are equal. */
struct SceneVersion
{
  vtkTypeInt64 Shape = -1;
  vtkTypeInt64 Rays = -1;

  bool operator==(const SceneVersion& other) const
  {
    return this->Shape == other.Shape && this->Rays == other.Rays;
  }
  /** A number that was not given before. May be called from any thread. */
  static vtkTypeInt64 MakeNumber();
};

/** A surface of a list, and the number of its shape. */
struct PreparedSurface
{
  /** Shared with an earlier surface of the list that has the same values. */
  SourceSurface Source;
  vtkTypeInt64 Shape = -1;
};

/** Surfaces, the solver over them, and the values that they were prepared from. */
struct PreparedScene
{
  std::vector<PreparedSurface> Surfaces;
  SceneView View;
  bool HasSolver = false; ///< the solver has the shapes of `Surfaces`, and `Media`
  bool HasRays = false;   ///< the solver has the eye of `View`
  SceneVersion Version;
  std::vector<InterfaceMedia> Media;
  /** One surface of flat facets, one of curved patches, or a list. */
  std::variant<FlatMembraneSolver, CurvedMembraneSolver, StackSolver> Solver;
  /** One refracting surface as a list, and as an exact plane in front of the eye; or empty. */
  RefractionStack Path;
  ParallelPlanes Plane;
  /** Read and written by the functions below only. */
  bool IsListed = false;
  bool IsBorrowed = false;
};

/**
 * Surfaces with these values for a scene that has used `own`, as it was at the version `last`:
 * `own`, one that another scene has prepared, or one to be prepared. The latter is `own`, even if
 * other scenes use it, so that animated surfaces are updated once for all of them. It is a new
 * one if another scene has changed `own` in the meantime, or has it from the same objects while
 * this scene goes to others.
 *
 * Until ReturnScene() nobody else borrows it. Scenes that work at the same time therefore have
 * surfaces of their own, and none waits for another. May be called from any thread.
 */
std::shared_ptr<PreparedScene> BorrowScene(const std::shared_ptr<PreparedScene>& own,
  const SceneVersion& last, const std::vector<MembraneOrigin>& origins, const SceneView& view);
void ReturnScene(PreparedScene& scene);

}
