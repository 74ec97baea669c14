// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/InputContent.h"

#include "Rendering/Common/VTKVersions.h"

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

namespace meniscus
{
namespace
{

/** Storage of the points and cells of a data set. */
struct MeshParts
{
  /** Objects besides the arrays. */
  std::vector<vtkObject*> Holders;
  std::vector<vtkDataArray*> Arrays;
  /** Values that are members of the data set. */
  std::vector<double> Numbers;
  /** True if this is the whole storage; otherwise any modification counts as a change. */
  bool IsComplete = true;
};

void AddCells(vtkCellArray* cells, MeshParts& parts)
{
  parts.Holders.push_back(cells);
  if (cells)
  {
    parts.Arrays.push_back(cells->GetConnectivityArray());
    parts.Arrays.push_back(cells->GetOffsetsArray());
  }
}

template <typename T>
void AddNumbers(const T* first, int count, MeshParts& parts)
{
  parts.Numbers.insert(parts.Numbers.end(), first, first + count);
}

MeshParts PartsOf(vtkDataSet* grid)
{
  MeshParts parts;
  parts.Holders = { grid, grid->GetPointData(), grid->GetCellData() };
  parts.Arrays = { grid->GetCellGhostArray(), grid->GetPointGhostArray() };
  auto* set = vtkPointSet::SafeDownCast(grid);
  if (vtkPoints* points = set ? set->GetPoints() : nullptr)
  {
    parts.Holders.push_back(points);
    parts.Arrays.push_back(points->GetData());
  }
  if (auto* unstructured = vtkUnstructuredGrid::SafeDownCast(grid))
  {
    AddCells(unstructured->GetCells(), parts);
    AddFaces(unstructured, parts.Holders, parts.Arrays);
  }
  else if (auto* explicitGrid = vtkExplicitStructuredGrid::SafeDownCast(grid))
  {
    AddCells(explicitGrid->GetCells(), parts);
    AddNumbers(explicitGrid->GetExtent(), 6, parts);
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(grid))
  {
    AddNumbers(structured->GetExtent(), 6, parts);
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    parts.Arrays.push_back(rectilinear->GetXCoordinates());
    parts.Arrays.push_back(rectilinear->GetYCoordinates());
    parts.Arrays.push_back(rectilinear->GetZCoordinates());
    AddNumbers(rectilinear->GetExtent(), 6, parts);
  }
  else if (auto* image = vtkImageData::SafeDownCast(grid))
  {
    AddNumbers(image->GetExtent(), 6, parts);
    AddNumbers(image->GetOrigin(), 3, parts);
    AddNumbers(image->GetSpacing(), 3, parts);
    parts.Holders.push_back(image->GetDirectionMatrix());
    AddNumbers(image->GetDirectionMatrix()->GetData(), 9, parts);
  }
  else
  {
    parts.IsComplete = false;
  }
  return parts;
}

/** Adds the types of the cells, which versions of VTK keep in different arrays. */
void AddCellTypes(vtkDataSet* grid, ContentDigest& digest)
{
  if (vtkUnstructuredGrid::SafeDownCast(grid) && grid->GetNumberOfCells() > 0)
  {
    digest.AddValues(static_cast<std::size_t>(grid->GetNumberOfCells()),
      [grid](std::size_t cell) { return grid->GetCellType(static_cast<vtkIdType>(cell)); });
  }
}

vtkDataSetAttributes* AttributesOf(vtkDataSet* grid, FieldAssociation place)
{
  return place == FieldAssociation::Cells ? static_cast<vtkDataSetAttributes*>(grid->GetCellData())
                                          : grid->GetPointData();
}

}

//------------------------------------------------------------------------------
std::vector<ObjectVersion> MeshVersions(const InputBlocks& input)
{
  std::vector<ObjectVersion> versions;
  for (const InputPart& part : input.Parts)
  {
    const MeshParts parts = PartsOf(part.Grid);
    for (vtkObject* holder : parts.Holders)
    {
      // Own times are used because the time of a data set or of its attributes includes those of
      // all arrays.
      versions.push_back(ObjectVersion::Own(holder));
    }
    for (vtkDataArray* array : parts.Arrays)
    {
      versions.emplace_back(array);
    }
    if (!parts.IsComplete)
    {
      versions.emplace_back(part.Grid);
    }
  }
  return versions;
}

//------------------------------------------------------------------------------
std::uint64_t DigestMesh(const InputBlocks& input)
{
  ContentDigest digest;
  for (const InputPart& part : input.Parts)
  {
    const MeshParts parts = PartsOf(part.Grid);
    digest.Add(static_cast<std::uint64_t>(part.Grid->GetDataObjectType()));
    digest.Add(static_cast<std::uint64_t>(part.Grid->GetNumberOfCells()));
    for (vtkDataArray* array : parts.Arrays)
    {
      digest.Add(array);
    }
    for (const double number : parts.Numbers)
    {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &number, sizeof(bits));
      digest.Add(bits);
    }
    AddCellTypes(part.Grid, digest);
    if (!parts.IsComplete)
    {
      digest.Add(reinterpret_cast<std::uintptr_t>(part.Grid));
      digest.Add(part.Grid->GetMTime());
    }
  }
  return digest.GetValue();
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
