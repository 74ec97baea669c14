// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Tetrahedralizer_h
#define meniscus_Volume_Tetrahedralizer_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Tetrahedra in place of other cells, without new points, and the same on both sides of a face.
 *
 * Each cell is pulled to its point of the smallest number: that point with the triangles of all
 * faces that do not contain it; each face is a fan from its own smallest point. So a face is split
 * as its points' numbers say, whatever the cell (J. Dompierre, P. Labbe, M.-G. Vallet, R. Camarero,
 * "How to Subdivide Pyramids, Prisms, and Hexahedra into Tetrahedra", 1999, have the rule for
 * quadrilateral faces). Faces need not be plane. A cell that is not convex may get inverted
 * tetrahedra, which sum up to its volume. Tetrahedra with a repeated point, as of a hexahedron with
 * merged corners, have no volume and are left away.
 */
class Tetrahedralizer
{
public:
  /** Cells with points and faces in VTK's order. */
  void AddTetrahedron(const std::int64_t* points);
  void AddVoxel(const std::int64_t* points);
  void AddHexahedron(const std::int64_t* points);
  void AddWedge(const std::int64_t* points);
  void AddPyramid(const std::int64_t* points);
  /** 10 points; 8 tetrahedra, each face in 4 triangles. */
  void AddQuadraticTetrahedron(const std::int64_t* points);

  /** A cell given by its faces: for each the number of points, then the points, around the face. */
  void AddPolyhedron(const std::int64_t* faces, std::size_t numberOfFaces);

  /** Points of the tetrahedra, four each. */
  const std::vector<std::int64_t>& GetTetrahedra() const { return this->Tetrahedra; }

private:
  void Add(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d);
  void AddFan(std::int64_t apex, const std::int64_t* face, std::size_t size);
  template <std::size_t Size>
  void AddShape(const std::int64_t* points, const int (&faces)[Size]);

  std::vector<std::int64_t> Tetrahedra;
};

}

#endif
