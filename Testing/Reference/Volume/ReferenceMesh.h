// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus::reference
{

using Vector3 = std::array<double, 3>;

inline double Dot(const Vector3& a, const Vector3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double MakeLength(const Vector3& a)
{
  return std::sqrt(Dot(a, a));
}

/** The four half-spaces of one tetrahedron: barycentric weights as affine functions of position. */
struct CellPlanes
{
  /** Weight i at x is Gradient[i] . (x - mesh centre) + Offset[i]. */
  std::array<Vector3, 4> Gradient;
  std::array<double, 4> Offset;
  /** Weight at a distance of one tolerance outside face i. */
  std::array<double, 4> Slack;
};

/**
 * Tetrahedra as sets of half-spaces, for a reference that finds cells by clipping instead of
 * walking.
 *
 * Inverted cells are determined by a flood fill over shared faces, which gives every cell of a
 * component the orientation that agrees with its neighbours; the component's sign is that of most
 * of its cells. A cell whose volume has the other sign is inverted and does not contribute. Cells
 * without volume, with repeated or out-of-range ids, or with positions or scalars that are not
 * finite do not contribute either.
 */
class ReferenceMesh
{
public:
  /** Points in world coordinates (xyz), cells as 4 ids each, one scalar per point. */
  ReferenceMesh(
    std::vector<double> points, std::vector<std::int64_t> cells, std::vector<double> scalars);

  std::size_t GetNumberOfCells() const { return this->Cells.size() / 4; }
  const std::int64_t* GetCell(std::size_t id) const { return &this->Cells[4 * id]; }
  const double* GetPoint(std::int64_t id) const { return &this->Points[3 * id]; }
  double GetScalar(std::int64_t id) const { return this->Scalars[id]; }
  const CellPlanes& GetPlanes(std::size_t id) const { return this->Planes[id]; }

  enum class CellKind : signed char
  {
    Inverted = -1,
    Flat = 0,
    Contributing = 1,
    Rejected = 2
  };
  CellKind GetKind(std::size_t id) const { return this->Kinds[id]; }

  /** Cell and face (4 * cell + face) on the other side of a face, -1 on the boundary. */
  std::int64_t GetNeighbor(std::int64_t cellFace) const { return this->Neighbors[cellFace]; }

  /** Ids of the cells that contribute, in increasing order. */
  const std::vector<std::int64_t>& ContributingCells() const { return this->Contributing; }
  std::size_t NumberOfInvertedCells() const { return this->InvertedCells; }
  std::size_t NumberOfZeroVolumeCells() const { return this->ZeroVolumeCells; }
  std::size_t NumberOfRejectedCells() const { return this->RejectedCells; }
  std::size_t NumberOfBoundaryFaces() const { return this->BoundaryFaces; }

  const Vector3& GetCenter() const { return this->Center; }
  /** Diagonal of the bounding box of the usable cells, 0 without any. */
  double GetDiagonal() const { return this->Diagonal; }

private:
  void FindBounds(const std::vector<char>& usable);
  std::vector<int> VolumeSigns(const std::vector<char>& usable) const;
  bool IsUsable(std::size_t id) const;
  void FindKinds(const std::vector<int>& signs);
  std::vector<int> Orient(const std::vector<int>& signs);
  void FindPlanes(std::size_t id);

  std::vector<double> Points;
  std::vector<std::int64_t> Cells;
  std::vector<double> Scalars;
  std::vector<CellPlanes> Planes;
  std::vector<CellKind> Kinds;
  std::vector<std::int64_t> Neighbors;
  std::vector<std::int64_t> Contributing;
  std::size_t InvertedCells = 0;
  std::size_t ZeroVolumeCells = 0;
  std::size_t RejectedCells = 0;
  std::size_t BoundaryFaces = 0;
  Vector3 Center{ 0.0, 0.0, 0.0 };
  double Diagonal = 0.0;
};

} // namespace meniscus::reference
