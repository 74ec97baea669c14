// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cells of VTK's data sets, read with checks: files may contain anything.
#pragma once

#include "Rendering/Input/IdView.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

class vtkCellArray;
class vtkDataSet;
class vtkIdList;
class vtkIdTypeArray;
class vtkIntArray;
class vtkUnsignedCharArray;

namespace meniscus
{

/** Cells that cannot be used, by reason. A cell is counted once, under the first that applies. */
struct UnusableCells
{
  /** Cells, or faces of polyhedra, stored outside of their array. */
  std::int64_t OutsideOfArray = 0;
  std::int64_t PointOutOfRange = 0;
  /** Numbers of points that the type does not have. */
  std::int64_t WrongNumberOfPoints = 0;
  /** Polyhedra without faces, or with faces of fewer than three points. */
  std::int64_t MissingFaces = 0;

  std::int64_t Total() const
  {
    return this->OutsideOfArray + this->PointOutOfRange + this->WrongNumberOfPoints +
      this->MissingFaces;
  }
  void Add(const UnusableCells& other)
  {
    this->OutsideOfArray += other.OutsideOfArray;
    this->PointOutOfRange += other.PointOutOfRange;
    this->WrongNumberOfPoints += other.WrongNumberOfPoints;
    this->MissingFaces += other.MissingFaces;
  }
};

/** True for cell types with a volume, also for those that are not drawn. */
bool HasVolume(int type);

/**
 * Reason why the arrays of a data set contradict each other, so that none of its cells can be read:
 * too few cell types, ghost flags, degrees, weights, points or coordinates. Empty if there is none.
 */
std::string DescribeFault(vtkDataSet* grid);

/** Types of the cells of an unstructured grid that stores them as bytes; otherwise null. */
const unsigned char* FindCellTypes(vtkDataSet* grid);

/** Lists of integers in a vtkCellArray. */
class CellLists
{
public:
  CellLists() = default;
  /** @param lists null for none; must outlive this object. */
  explicit CellLists(vtkCellArray* lists);

  /** Finds the place of a list in GetIds(). Returns false if it is outside of the array. */
  bool Find(std::int64_t list, std::int64_t& first, std::int64_t& last) const
  {
    if (list < 0 || list + 1 >= this->Offsets.GetSize())
    {
      return false;
    }
    first = this->Offsets[list];
    last = this->Offsets[list + 1];
    return first >= 0 && first <= last && last <= this->Ids.GetSize();
  }
  const IdView& GetIds() const { return this->Ids; }
  std::int64_t GetSize() const { return std::max<std::int64_t>(this->Offsets.GetSize() - 1, 0); }
  /** True if each list i of [first, last) is the range [size * i, size * (i + 1)) of GetIds(). */
  bool HaveSize(std::int64_t size, std::int64_t first, std::int64_t last) const;

private:
  IdView Offsets;
  IdView Ids;
};

/**
 * Reader of a data set's cells, which must outlive it. Several threads may read at the same time if
 * IsThreadSafe().
 */
class CellReader
{
public:
  /** @pre DescribeFault() finds nothing. */
  explicit CellReader(vtkDataSet* grid);

  vtkDataSet* GetGrid() const { return this->Grid; }
  int GetType(vtkIdType cell) const
  {
    return this->Types ? this->Types[cell] : this->ComputeType(cell);
  }
  /** True for duplicate, hidden and refined cells. */
  bool IsLeftOut(vtkIdType cell) const;
  /**
   * True if all cells are tetrahedra of four points each, whatever their type, one after another in
   * GetIds().
   */
  bool HasOnlyTetrahedra() const;
  /** Points of all cells; empty if the data set does not store them. */
  const IdView& GetIds() const { return this->Cells.GetIds(); }
  /** Flags of the cells (vtkGhostType); null if there are none. */
  vtkUnsignedCharArray* GetGhosts() const { return this->Ghosts; }
  /** Flags of cells that are left out. */
  static unsigned char GetLeftOutFlags();

  /**
   * Reads the points of a cell with a volume, other than a polyhedron. Returns false after counting
   * the cell if the points are not in the data set, or if the type has another number of points.
   */
  bool ReadPoints(vtkIdType cell, vtkIdList* points, UnusableCells& unusable) const;
  /**
   * Reads the faces of a polyhedron: for each, the number of points and the points. Returns false
   * after counting the cell if it has no usable faces.
   */
  bool ReadFaces(vtkIdType cell, std::vector<std::int64_t>& faces, std::size_t& numberOfFaces,
    UnusableCells& unusable) const;

private:
  int ComputeType(vtkIdType cell) const;
  bool AreTetrahedra(vtkIdType first, vtkIdType last) const;
  bool FitsType(vtkIdType cell, vtkIdType size) const;
  bool AddFace(const IdView& ids, std::int64_t first, std::int64_t last,
    std::vector<std::int64_t>& faces, UnusableCells& unusable) const;

  vtkDataSet* Grid;
  /** Types of the cells; null if they are not stored as bytes. */
  const unsigned char* Types = nullptr;
  vtkIdType NumberOfPoints;
  vtkUnsignedCharArray* Ghosts;
  /** Degrees of cells of higher order along their axes; null if their points decide. */
  vtkDataArray* Degrees;
  /** True if the class guarantees the points of each cell. */
  bool IsStructured;
  /** True if Cells has the points. */
  bool HasLists = false;
  CellLists Cells;
  /** Faces of polyhedra, in one of two forms: see FaceStorage. */
  bool HasStream = false;
  IdView Stream;
  IdView Starts;
  CellLists Faces;
  CellLists FacesOfCells;
};

}
