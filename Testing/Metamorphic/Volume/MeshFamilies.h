// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_MeshFamilies_h
#define meniscus_MeshFamilies_h

#include "MeshArrays.h"
#include "RandomNumbers.h"

#include <string>

namespace meniscus
{
namespace test
{

/** A random mesh with one scalar per point. */
struct FamilyMesh
{
  std::string Name;
  MeshArrays Mesh;
  /**
   * Whether all components are linear functions of the position and all faces are planar, so that
   * any division into tetrahedra shows the same.
   */
  bool Linear = false;
  /** Whether the mesh is within [-1, 1]^3 or hardly larger, as membranes expect. */
  bool UnitBox = true;
};

/** Kinds of meshes that randomMesh() chooses from. */
enum class MeshFamily
{
  RandomPoints, ///< Delaunay's tetrahedra of random points
  Hexahedra,
  Wedges,
  Pyramids,
  Mixed, ///< hexahedra, pyramids and wedges in one mesh
  Slivers,
  Graded, ///< cells from the domain's size to 1 / 30,000 of it
  Parts,  ///< blocks with holes, or in two parts
  Random, ///< small ones of HardMeshes.h
  Data    ///< the shared data meshes; RandomPoints where they are missing
};

/**
 * A mesh of a family with a random field.
 * @param linear  a linear field, and no moved points where faces would not stay planar.
 */
FamilyMesh makeFamilyMesh(MeshFamily family, bool linear, RandomNumbers& random);

/** A family at random: data meshes once in 30, the others equally often. */
MeshFamily randomFamily(RandomNumbers& random);

/** Replaces the values by those of some fields, one per component, linear or not. */
void setRandomFields(MeshArrays& mesh, int components, bool linear, RandomNumbers& random);

/** Moves the values of a mesh's points to its cells: the mean of each cell's points. */
void moveToCells(MeshArrays& mesh);

} // namespace test
} // namespace meniscus

#endif
