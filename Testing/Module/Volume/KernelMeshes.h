// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MathBasics.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/TransferFunction.h"
#include "Volume/Rays/RayFrame.h"

namespace meniscus::test
{

/** Points and tetrahedra as arrays of a mesh's caller. */
struct MeshArrays
{
  std::vector<double> Points;
  std::vector<std::int64_t> Cells;

  TetrahedraView View() const
  {
    return { this->Points.data(), static_cast<std::int64_t>(this->Points.size() / 3),
      this->Cells.data(), static_cast<std::int64_t>(this->Cells.size() / 4) };
  }
  glm::dvec3 PointAt(std::int64_t index) const
  {
    return { this->Points[3 * index], this->Points[3 * index + 1], this->Points[3 * index + 2] };
  }
};

/** The unit tetrahedron, its vertices in positive orientation. */
MeshArrays SingleTetrahedron();

/** n^3 cubes of edge 1 / n that fill [0, 1]^3, each split into Kuhn's 6 tetrahedra. */
MeshArrays KuhnGrid(int n);

/** nx * ny * nz such cubes, with a corner at the origin and so many per unit of length. */
MeshArrays KuhnBlock(int nx, int ny, int nz, double perUnit);

/** Motion of a point. */
using Motion = std::function<glm::dvec3(const glm::dvec3&)>;

/** The mesh with moved points. */
MeshArrays Moved(MeshArrays mesh, const Motion& motion);

/** Both meshes, without common points. */
MeshArrays Joined(const MeshArrays& a, const MeshArrays& b);

/**
 * Moves every point by up to `amount` along each axis, with a fixed seed; large amounts invert
 * cells.
 */
void Jitter(MeshArrays& mesh, double amount, unsigned int seed);

/** Orthographic rays along -z over the square of half side `extent` about (x, y) = (0.5, 0.5). */
RayFrame FrameAlongZ(const TetrahedralMesh& mesh, double extent, int pixels);

/** One interval of constant attenuation and colour. */
std::vector<TransferFunctionInterval> ConstantFunction(double attenuation);

}
