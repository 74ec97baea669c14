// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Meshes that are difficult for a ray caster, in addition to TestMeshes.h. */
#pragma once

#include "RandomNumbers.h"
#include "TestMeshes.h"

#include <glm/vec3.hpp>

namespace meniscus::test
{

/** Fraction of cells whose volume has another sign than most cells'. */
double InvertedShare(vtkUnstructuredGrid* grid);

/** A block that is tangled until at least the given fraction of its cells is inverted. */
Grid MakeTangledBlock(int n, double share, unsigned int seed);

/**
 * A block in which every second layer of cubes, in all directions, is thinned to the given fraction
 * of the others' thickness; 0 gives runs of cells without volume.
 */
Grid MakeLayeredBlock(int n, double share);

/** Two blocks that touch in a plane but share no point. */
Grid MakeSeam(int n);

/**
 * A small valid mesh: either a part of a jittered block under a random affine map, with random
 * cells left out, or a tetrahedron divided repeatedly at random points. Points, cells and the
 * vertices of each cell are in random order.
 */
Grid MakeRandomMesh(RandomNumbers& random);

/**
 * A copy of a tetrahedral grid with points, cells and the vertices of each cell in random order;
 * scalars are given by the field.
 */
Grid MakeScrambled(vtkUnstructuredGrid* grid, const Field& field, RandomNumbers& random);

/**
 * Disconnected and invalidly connected cells: random vertices, repeated vertices and cells, faces
 * of more than two cells.
 */
Grid MakeSoup(RandomNumbers& random);

} // namespace meniscus::test
