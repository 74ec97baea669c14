// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Meshes rewritten so that they describe the same field.
 */
#pragma once

#include "MeshArrays.h"
#include "RandomNumbers.h"

class vtkRectilinearGrid;

namespace meniscus::test
{

template <typename Sequence>
void Shuffle(Sequence& sequence, RandomNumbers& random)
{
  for (std::size_t i = sequence.size(); i > 1; --i)
  {
    std::swap(sequence[i - 1], sequence[random.Below(static_cast<int>(i))]);
  }
}

void ShuffleCells(MeshArrays& mesh, RandomNumbers& random);
/** Permutes the vertices of each tetrahedron, half of them to the other orientation. */
void TurnCells(MeshArrays& mesh, RandomNumbers& random);
void ShufflePoints(MeshArrays& mesh, RandomNumbers& random);

/** Appends points that no cell uses, within the bounds. */
void AddIdlePoints(MeshArrays& mesh, RandomNumbers& random);

/** Gives every cell its own points, numbered in the order that they had within the cell. */
void UnsharePoints(MeshArrays& mesh);

/** Random parts of the cells, each with its own points only, in the order that they had. */
std::vector<MeshArrays> SplitMesh(const MeshArrays& mesh, int parts, RandomNumbers& random);

/** Concatenates meshes and renumbers their points. */
MeshArrays AppendMeshes(const std::vector<MeshArrays>& meshes);

/** Divides each tetrahedron in 4 at its middle, or in 8 at the middles of its edges. */
void DivideTetrahedra(MeshArrays& mesh, int parts);

/**
 * Converts tetrahedra, hexahedra, wedges and pyramids to quadratic cells with straight edges;
 * hexahedra get 20 or 27 points at random, and so on.
 */
void MakeQuadratic(MeshArrays& mesh, RandomNumbers& random);

/** The cells of a rectilinear grid as hexahedra or voxels, without values. */
MeshArrays MakeRectilinearCells(RandomNumbers& random);
/** The grid to which these cells belong, with their values. */
vtkSmartPointer<vtkRectilinearGrid> ToRectilinear(const MeshArrays& mesh);

/**
 * Sets random fields with the number of components and the association of those of another mesh.
 */
void SetRandomFieldsLike(MeshArrays& mesh, const MeshArrays& other, RandomNumbers& random);

} // namespace meniscus::test
