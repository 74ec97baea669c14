// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Mesh_Tetrahedralizer_h
#define meniscus_Volume_Mesh_Tetrahedralizer_h

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
 * merged corners, have no volume and are left away. No tetrahedron of a convex cell with plane
 * faces is flat, also if it has points on its edges: flat ones would come between the cells of a
 * face.
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
  /** @{ */
  /**
   * Cells with points on their edges. Their corners are cut off, so a triangle gives 4 triangles
   * and a quadrilateral 4 and that between them, which is split as any; what is left is pulled like
   * a cell.
   */
  void AddQuadraticTetrahedron(const std::int64_t* points);
  void AddQuadraticHexahedron(const std::int64_t* points);
  void AddQuadraticWedge(const std::int64_t* points);
  void AddQuadraticPyramid(const std::int64_t* points);
  /** @} */
  /** A wedge with points on the edges of its triangles alone: 4 wedges side by side. */
  void AddQuadraticLinearWedge(const std::int64_t* points);

  /** A cell given by its faces: for each the number of points, then the points, around the face. */
  void AddPolyhedron(const std::int64_t* faces, std::size_t numberOfFaces);
  /**
   * The same, pulled to a point of the caller's choice, in the cell or one of its faces: with all
   * triangles that do not contain it.
   */
  void AddCone(std::int64_t apex, const std::int64_t* faces, std::size_t numberOfFaces);

  /** Points of the tetrahedra, four each. */
  const std::vector<std::int64_t>& GetTetrahedra() const { return this->Tetrahedra; }

private:
  void Add(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d);
  void AddFan(std::int64_t apex, const std::int64_t* face, std::size_t size);
  template <std::size_t Size>
  void AddParts(const std::int64_t* points, const int (&parts)[Size][4]);
  template <std::size_t Size>
  void AddShape(const std::int64_t* points, const int (&faces)[Size]);

  std::vector<std::int64_t> Tetrahedra;
};

}

#endif
