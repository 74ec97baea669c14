// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// All code that depends on the version of VTK.
#pragma once

#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

#include <vector>

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
#include "vtkCellTypeUtilities.h"
#else
#include "vtkCellTypes.h"
#endif

namespace meniscus
{

/**
 * Adds the objects and the arrays that hold the faces of polyhedra; adds nothing if there are none.
 */
inline void AddFaces(
  vtkUnstructuredGrid* grid, std::vector<vtkObject*>& holders, std::vector<vtkDataArray*>& arrays)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  for (vtkCellArray* cells : { grid->GetPolyhedronFaces(), grid->GetPolyhedronFaceLocations() })
  {
    holders.push_back(cells);
    arrays.push_back(cells ? cells->GetConnectivityArray() : nullptr);
    arrays.push_back(cells ? cells->GetOffsetsArray() : nullptr);
  }
#else
  static_cast<void>(holders); // the arrays are the grid's own
  arrays.push_back(grid->GetFaces());
  arrays.push_back(grid->GetFaceLocations());
#endif
}

/** Storage of the faces of polyhedra, of which each version of VTK has one kind. */
struct FaceStorage
{
  /** Points of each face, and faces of each cell. */
  vtkCellArray* Faces = nullptr;
  vtkCellArray* FacesOfCells = nullptr;
  /**
   * For each polyhedron the number of faces, and for each of these the number of points and the
   * points; and the place where each cell begins.
   */
  vtkIdTypeArray* Stream = nullptr;
  vtkIdTypeArray* Starts = nullptr;
};

/** Arrays of the faces; null if the grid has none. */
inline FaceStorage GetFaceStorage(vtkUnstructuredGrid* grid)
{
  FaceStorage storage;
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  storage.Faces = grid->GetPolyhedronFaces();
  storage.FacesOfCells = grid->GetPolyhedronFaceLocations();
#else
  storage.Stream = grid->GetFaces();
  storage.Starts = grid->GetFaceLocations();
#endif
  return storage;
}

/**
 * Types of the cells; null if there are none. Since VTK 9.6 cells of one type may have a constant
 * instead of an array, which GetCellTypesArray() does not yield.
 */
template <typename UnstructuredGrid>
auto GetTypesOfCells(UnstructuredGrid* grid, int)
  -> decltype(static_cast<vtkDataArray*>(grid->GetCellTypes()))
{
  return grid->GetCellTypes();
}
template <typename UnstructuredGrid>
vtkDataArray* GetTypesOfCells(UnstructuredGrid* grid, long)
{
  return grid->GetCellTypesArray();
}

/**
 * Whether an array keeps each component in an array of its own now. Since VTK 9.2 it may hold whole
 * tuples instead, and does so unless it was given component arrays; versions without
 * GetStorageType() do not tell.
 */
template <typename Array>
auto KeepsComponentsApart(Array* array, int) -> decltype(array->GetStorageType(), bool{})
{
  return array->GetStorageType() == Array::SOA;
}
template <typename Array>
bool KeepsComponentsApart(Array*, long)
{
  return VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 2, 0);
}

/**
 * Anisotropy of a property's scattering, in [-1, 1]; 0 in versions before 9.2, which have no such
 * member.
 */
template <typename Property>
auto GetScatteringAnisotropy(Property* property, int)
  -> decltype(static_cast<double>(property->GetScatteringAnisotropy()))
{
  return static_cast<double>(property->GetScatteringAnisotropy());
}
template <typename Property>
double GetScatteringAnisotropy(Property*, long)
{
  return 0.0;
}

/** Name of a cell type, such as "vtkWedge"; may be null. */
inline const char* NameOfCellType(int type)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  return vtkCellTypeUtilities::GetClassNameFromTypeId(type);
#else
  return vtkCellTypes::GetClassNameFromTypeId(type);
#endif
}

}
