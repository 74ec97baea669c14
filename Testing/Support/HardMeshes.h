// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Meshes that are hard on a ray caster, on top of those of TestMeshes.h.
 */
#ifndef meniscus_HardMeshes_h
#define meniscus_HardMeshes_h

#include "RandomNumbers.h"
#include "TestMeshes.h"

#include <glm/vec3.hpp>

namespace meniscus
{
namespace test
{

/** Replaces every point by the function of it. */
void mapPoints(vtkUnstructuredGrid* grid, const std::function<glm::dvec3(glm::dvec3)>& map);

/** Share of cells whose volume has another sign than most. */
double invertedShare(vtkUnstructuredGrid* grid);

/** A block tangled until at least the share of its cells is inverted. */
Grid makeTangledBlock(int n, double share, unsigned int seed);

/**
 * A block with every second layer of cubes thinned to the share of the others' thickness, in all
 * directions; 0 gives runs of cells without volume.
 */
Grid makeLayeredBlock(int n, double share);

/** Two blocks that touch in a plane but share no point. */
Grid makeSeam(int n);

/**
 * A small valid mesh: either a part of a jittered block under a random affine map, cells left out
 * at random, or a tetrahedron divided at random points over and over. Points, cells and the
 * vertices of each cell in random order.
 */
Grid makeRandomMesh(RandomNumbers& random);

/**
 * Unconnected and wrongly connected cells: random vertices, repeated vertices and cells, faces of
 * more than two cells.
 */
Grid makeSoup(RandomNumbers& random);

} // namespace test
} // namespace meniscus

#endif
