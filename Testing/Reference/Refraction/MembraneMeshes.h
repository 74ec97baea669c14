// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Triangle meshes of membranes for tests and benchmarks. The y axis points to the eye, the apex is
 * the origin, facets are counter-clockwise as seen from the eye, and normals are exact.
 */
#pragma once

#include "Refraction/Membrane/Membrane.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace meniscus::reference
{

struct MembraneMesh
{
  std::vector<double> Points;
  std::vector<double> Normals;
  std::vector<std::int64_t> Triangles;

  void AddPoint(const glm::dvec3& point, const glm::dvec3& normal);
  void AddTriangle(std::int64_t a, std::int64_t b, std::int64_t c);
  /**
   * Adds two triangles per cell of a grid of `rings` rows of `around` vertices around an axis,
   * which start at the vertex `first`.
   */
  void AddRings(std::int64_t first, int rings, int around);
  std::size_t GetNumberOfFacets() const { return this->Triangles.size() / 3; }
  /** Views of the arrays, with or without the normals. */
  MembraneInput AsInput(bool withNormals = true) const;
  void Translate(const glm::dvec3& offset);
};

/**
 * A disc whose ring k = 1 .. rings has 2^(k+1) vertices at radius k / rings: 125 vertices and 184
 * facets for five rings. `sphereRadius` > 0 conforms it to a sphere of that radius, concave to the
 * eye; 0 leaves it flat.
 */
MembraneMesh MakeDisc(double radius, int rings, double sphereRadius);

/** A square of `cells` x `cells` x 2 facets about the axis, flat or conformed to a sphere. */
MembraneMesh MakeSquare(double side, int cells, double sphereRadius);

/** A square with the height of two crossed sine waves of `amplitude` and `waves` periods. */
MembraneMesh MakeWaves(double side, int cells, double amplitude, double waves);

/**
 * A square of random heights in [-roughness, roughness] and random normals within `tilt` (tangent)
 * of the axis. The same seed gives the same mesh.
 */
MembraneMesh MakeRandom(double side, int cells, double roughness, double tilt, unsigned seed);

/**
 * A closed unit sphere as vtkSphereSource creates it, with poles on the z axis and thin facets
 * around them. `side` is 1 for outward normals and -1 for inward ones.
 */
MembraneMesh MakeSphere(int resolution, double side);

}
