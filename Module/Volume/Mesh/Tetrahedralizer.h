// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Splits other cells into tetrahedra, without new points and with matching triangles on both sides
 * of each face.
 *
 * Each cell is split by pulling its lowest-numbered point: that point is joined to the triangles of
 * all faces that do not contain it, and each face is a fan from its own lowest-numbered point. The
 * splitting of a face therefore depends on the numbers of its points alone, whatever the cell (J.
 * Dompierre, P. Labbe, M.-G. Vallet, R. Camarero, "How to Subdivide Pyramids, Prisms, and Hexahedra
 * into Tetrahedra", 1999, give this rule for quadrilateral faces). Faces need not be planar. A cell
 * that is not convex may yield inverted tetrahedra, whose signed volumes still add up to its
 * volume. Tetrahedra with a repeated point, for example of a hexahedron with merged corners, have
 * no volume and are omitted. No tetrahedron of a convex cell with planar faces is flat, even if the
 * cell has points on its edges: flat tetrahedra would separate the cells on both sides of a face.
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
   * Cells with points on their edges. Their corners are cut off first: a triangle yields 4
   * triangles, and a quadrilateral yields 4 triangles and the quadrilateral between them, which is
   * split like any other. The remaining core is pulled like a cell.
   */
  void AddQuadraticTetrahedron(const std::int64_t* points);
  void AddQuadraticHexahedron(const std::int64_t* points);
  void AddQuadraticWedge(const std::int64_t* points);
  void AddQuadraticPyramid(const std::int64_t* points);
  /** @} */
  /** A wedge with points on the edges of its triangles only: split into 4 adjacent wedges. */
  void AddQuadraticLinearWedge(const std::int64_t* points);

  /**
   * A cell given by its faces: for each, the number of points and then the points in order around
   * the face.
   */
  void AddPolyhedron(const std::int64_t* faces, std::size_t numberOfFaces);
  /**
   * As AddPolyhedron, but pulled to a point chosen by the caller, in the cell or in one of its
   * faces: joined to all triangles that do not contain it.
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
