// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A membrane that is ready for solving, and a list of them, so that scenes with the same membrane,
 * eye and indices of refraction prepare one of them together.
 */
#ifndef meniscus_Filters_Membrane_PreparedMembrane_h
#define meniscus_Filters_Membrane_PreparedMembrane_h

#include "Filters/Membrane/SourceSurface.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"

#include "vtkType.h"

#include <array>
#include <memory>

namespace meniscus
{

/** Values on which the rays behind a membrane depend. */
struct MembraneView
{
  /** Position of the eye in world coordinates, exterior and interior index of refraction. */
  std::array<double, 5> Eye{};
  bool Reflects = false;
  bool Turns = false; ///< an open membrane that does not face the eye is turned round

  bool operator==(const MembraneView& other) const
  {
    return this->Eye == other.Eye && this->Reflects == other.Reflects && this->Turns == other.Turns;
  }
};

/** Numbers of a shape and of its rays. No two of them in a process are equal. */
struct MembraneVersion
{
  vtkTypeInt64 Shape = -1;
  vtkTypeInt64 Rays = -1;

  bool operator==(const MembraneVersion& other) const
  {
    return this->Shape == other.Shape && this->Rays == other.Rays;
  }
  /** A number that was not given before. May be called from any thread. */
  static vtkTypeInt64 MakeNumber();
};

/** A membrane, the solvers over it, and the values that they were prepared from. */
struct PreparedMembrane
{
  SourceSurface Surface;
  MembraneView View;
  bool HasRays = false;
  MembraneVersion Version;
  FlatMembraneSolver Flat;
  CurvedMembraneSolver Curved;
  /** Read and written by the functions below only. */
  bool IsListed = false;
  bool IsBorrowed = false;
};

/**
 * Membrane with these values for a scene that has used `own`, as it was at the version `last`:
 * `own`, one that another scene has prepared, or one to be prepared. The latter is `own`, even if
 * other scenes use it, so that an animated membrane is updated once for all of them. It is a new
 * one if another scene has changed `own` in the meantime, or has it from the same object while this
 * scene goes to another.
 *
 * Until ReturnMembrane() nobody else borrows it. Scenes that work at the same time therefore have
 * membranes of their own, and none waits for another. May be called from any thread.
 */
std::shared_ptr<PreparedMembrane> BorrowMembrane(const std::shared_ptr<PreparedMembrane>& own,
  const MembraneVersion& last, const MembraneOrigin& origin, const MembraneView& view);
void ReturnMembrane(PreparedMembrane& membrane);

}

#endif
