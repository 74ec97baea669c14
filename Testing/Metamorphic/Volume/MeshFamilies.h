// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MeshArrays.h"
#include "RandomNumbers.h"

namespace meniscus::test
{

/** A random mesh with one scalar per point. */
struct FamilyMesh
{
  std::string Name;
  MeshArrays Mesh;
  /**
   * True if all components are linear functions of the position and all faces are planar, so that
   * any division into tetrahedra gives the same image.
   */
  bool Linear = false;
};

/** Kinds of meshes that RandomMesh() chooses from. */
enum class MeshFamily
{
  RandomPoints, ///< Delaunay's tetrahedra of random points
  Hexahedra,
  Wedges,
  Pyramids,
  Mixed, ///< hexahedra, pyramids and wedges in one mesh
  Slivers,
  Graded, ///< sizes of cells from that of the domain to 1 / 30,000 of it
  Parts,  ///< blocks with holes, or in two parts
  Random, ///< small meshes of HardMeshes.h
  Data    ///< the shared data meshes; RandomPoints if they are missing
};

/**
 * A mesh of a family with a random field.
 * @param linear a linear field, and no moved points where faces would not stay planar.
 */
FamilyMesh MakeFamilyMesh(MeshFamily family, bool linear, RandomNumbers& random);

/** A random family: data meshes once in 30, the others equally often. */
MeshFamily RandomFamily(RandomNumbers& random);

/** Replaces the values by random fields, one per component, linear or not. */
void SetRandomFields(MeshArrays& mesh, int components, bool linear, RandomNumbers& random);

/** Moves the values of a mesh's points to its cells: the mean of each cell's points. */
void MoveToCells(MeshArrays& mesh);

} // namespace meniscus::test
