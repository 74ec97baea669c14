// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/InputContent.h"

#include "Rendering/Common/VTKVersions.h"
#include "Rendering/Input/CellReader.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <cstring>
#include <utility>

namespace meniscus
{
namespace
{

/** Storage of the points or the cells of a data set. */
struct Storage
{
  /** Objects besides the arrays. */
  std::vector<vtkObject*> Holders;
  std::vector<vtkDataArray*> Arrays;
  /** Values that are members of the data set. */
  std::vector<double> Numbers;
  /** True if this is the whole storage; otherwise any modification counts as a change. */
  bool IsComplete = true;

  template <typename T>
  void AddNumbers(const T* first, int count)
  {
    this->Numbers.insert(this->Numbers.end(), first, first + count);
  }
};

/** Objects that may receive Modified() instead of the storage of points or cells. */
std::vector<vtkObject*> HoldersOf(vtkDataSet* grid)
{
  return { grid, grid->GetPointData(), grid->GetCellData() };
}

Storage PointStorageOf(vtkDataSet* grid)
{
  Storage storage;
  storage.Holders = HoldersOf(grid);
  auto* set = vtkPointSet::SafeDownCast(grid);
  if (vtkPoints* points = set ? set->GetPoints() : nullptr)
  {
    storage.Holders.push_back(points);
    storage.Arrays.push_back(points->GetData());
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    storage.Arrays = { rectilinear->GetXCoordinates(), rectilinear->GetYCoordinates(),
      rectilinear->GetZCoordinates() };
  }
  else if (auto* image = vtkImageData::SafeDownCast(grid))
  {
    storage.AddNumbers(image->GetOrigin(), 3);
    storage.AddNumbers(image->GetSpacing(), 3);
    // The origin is the place of the point with index 0, which need not be in the extent.
    storage.AddNumbers(image->GetExtent(), 6);
    storage.Holders.push_back(image->GetDirectionMatrix());
    storage.AddNumbers(image->GetDirectionMatrix()->GetData(), 9);
  }
  return storage;
}

void AddCells(vtkCellArray* cells, Storage& storage)
{
  storage.Holders.push_back(cells);
  if (cells)
  {
    storage.Arrays.push_back(cells->GetConnectivityArray());
    storage.Arrays.push_back(cells->GetOffsetsArray());
  }
}

/** The cells, the ghost flags, and the number of points, of which the cells are made. */
Storage CellStorageOf(vtkDataSet* grid)
{
  Storage storage;
  storage.Holders = HoldersOf(grid);
  storage.Arrays = { grid->GetCellGhostArray(), grid->GetPointGhostArray() };
  const double sizes[2] = { static_cast<double>(grid->GetNumberOfPoints()),
    static_cast<double>(grid->GetNumberOfCells()) };
  storage.AddNumbers(sizes, 2);
  if (auto* unstructured = vtkUnstructuredGrid::SafeDownCast(grid))
  {
    AddCells(unstructured->GetCells(), storage);
    AddFaces(unstructured, storage.Holders, storage.Arrays);
  }
  else if (auto* explicitGrid = vtkExplicitStructuredGrid::SafeDownCast(grid))
  {
    AddCells(explicitGrid->GetCells(), storage);
    storage.AddNumbers(explicitGrid->GetExtent(), 6);
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(grid))
  {
    storage.AddNumbers(structured->GetExtent(), 6);
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    storage.AddNumbers(rectilinear->GetExtent(), 6);
  }
  else if (auto* image = vtkImageData::SafeDownCast(grid))
  {
    storage.AddNumbers(image->GetExtent(), 6);
  }
  else
  {
    storage.IsComplete = false;
  }
  return storage;
}

/** Versions of the objects that store something of each part. */
std::vector<ObjectVersion> VersionsOf(
  const InputBlocks& input, Storage (*storageOf)(vtkDataSet* grid))
{
  std::vector<ObjectVersion> versions;
  for (const InputPart& part : input.Parts)
  {
    const Storage storage = storageOf(part.Grid);
    for (vtkObject* holder : storage.Holders)
    {
      // Own times are used because the time of a data set or of its attributes includes those of
      // all arrays.
      versions.push_back(ObjectVersion::Own(holder));
    }
    for (vtkDataArray* array : storage.Arrays)
    {
      versions.emplace_back(array);
    }
    if (!storage.IsComplete)
    {
      versions.emplace_back(part.Grid);
    }
  }
  return versions;
}

void AddStorage(const Storage& storage, vtkDataSet* grid, ContentDigest& digest)
{
  for (vtkDataArray* array : storage.Arrays)
  {
    digest.Add(array);
  }
  for (const double number : storage.Numbers)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof(bits));
    digest.Add(bits);
  }
  if (!storage.IsComplete)
  {
    digest.Add(reinterpret_cast<std::uintptr_t>(grid));
    digest.Add(grid->GetMTime());
  }
}

/** Adds the types of the cells, which versions of VTK keep in different arrays. */
void AddCellTypes(vtkDataSet* grid, ContentDigest& digest)
{
  if (vtkUnstructuredGrid::SafeDownCast(grid) && grid->GetNumberOfCells() > 0)
  {
    const auto size = static_cast<std::size_t>(grid->GetNumberOfCells());
    if (const unsigned char* types = FindCellTypes(grid))
    {
      digest.AddBytes(types, size);
      return;
    }
    // The digest of the same bytes.
    digest.AddValues(size,
      [grid](std::size_t cell)
      { return static_cast<unsigned char>(grid->GetCellType(static_cast<vtkIdType>(cell))); });
  }
}

vtkDataSetAttributes* AttributesOf(vtkDataSet* grid, FieldAssociation place)
{
  return place == FieldAssociation::Cells ? static_cast<vtkDataSetAttributes*>(grid->GetCellData())
                                          : grid->GetPointData();
}

}

//------------------------------------------------------------------------------
std::vector<ObjectVersion> CellVersions(const InputBlocks& input)
{
  return VersionsOf(input, CellStorageOf);
}

//------------------------------------------------------------------------------
std::uint64_t DigestCells(const InputBlocks& input)
{
  ContentDigest digest;
  for (const InputPart& part : input.Parts)
  {
    digest.Add(static_cast<std::uint64_t>(part.Grid->GetDataObjectType()));
    AddStorage(CellStorageOf(part.Grid), part.Grid, digest);
    AddCellTypes(part.Grid, digest);
  }
  return digest.GetValue();
}

//------------------------------------------------------------------------------
std::vector<ObjectVersion> PointVersions(const InputBlocks& input)
{
  return VersionsOf(input, PointStorageOf);
}

//------------------------------------------------------------------------------
std::uint64_t DigestPoints(const InputBlocks& input)
{
  ContentDigest digest;
  for (const InputPart& part : input.Parts)
  {
    AddStorage(PointStorageOf(part.Grid), part.Grid, digest);
  }
  return digest.GetValue();
}

//------------------------------------------------------------------------------
std::uint64_t InputDigests::OfCells(const InputBlocks& input)
{
  std::vector<ObjectVersion> versions = CellVersions(input);
  if (versions != this->Cells.Versions)
  {
    this->Cells = { std::move(versions), DigestCells(input) };
  }
  return this->Cells.Value;
}

//------------------------------------------------------------------------------
std::uint64_t InputDigests::OfPoints(const InputBlocks& input)
{
  std::vector<ObjectVersion> versions = PointVersions(input);
  if (versions != this->Points.Versions)
  {
    this->Points = { std::move(versions), DigestPoints(input) };
  }
  return this->Points.Value;
}

//------------------------------------------------------------------------------
std::vector<ObjectVersion> ScalarVersions(const InputBlocks& input)
{
  std::vector<ObjectVersion> versions;
  for (const InputPart& part : input.Parts)
  {
    versions.emplace_back(part.Scalars);
    versions.push_back(ObjectVersion::Own(AttributesOf(part.Grid, input.Place)));
    versions.push_back(ObjectVersion::Own(part.Grid));
  }
  return versions;
}

//------------------------------------------------------------------------------
std::uint64_t DigestScalars(const InputBlocks& input)
{
  ContentDigest digest;
  for (const InputPart& part : input.Parts)
  {
    digest.Add(part.Scalars);
  }
  return digest.GetValue();
}

}
