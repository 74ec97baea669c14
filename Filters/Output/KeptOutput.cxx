// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Output/KeptOutput.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstring>

namespace meniscus
{
namespace
{

/** Where a vtkPolyData has cells of one kind that the outputs have. */
struct CellPlace
{
  vtkCellArray* (vtkPolyData::*Get)();
  void (vtkPolyData::*Set)(vtkCellArray*);
};

constexpr CellPlace CellPlaces[] = { { &vtkPolyData::GetVerts, &vtkPolyData::SetVerts },
  { &vtkPolyData::GetLines, &vtkPolyData::SetLines },
  { &vtkPolyData::GetPolys, &vtkPolyData::SetPolys } };

bool HaveSameValues(vtkDataArray* a, vtkDataArray* b)
{
  if (!a || !b || a->GetDataType() != b->GetDataType() ||
    a->GetNumberOfComponents() != b->GetNumberOfComponents() ||
    a->GetNumberOfTuples() != b->GetNumberOfTuples() || !a->HasStandardMemoryLayout() ||
    !b->HasStandardMemoryLayout())
  {
    return false;
  }
  const auto size = static_cast<std::size_t>(a->GetNumberOfValues()) *
    static_cast<std::size_t>(a->GetDataTypeSize());
  return size == 0 || std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0), size) == 0;
}

bool HaveSameValues(vtkCellArray* a, vtkCellArray* b)
{
  return a && b && HaveSameValues(a->GetConnectivityArray(), b->GetConnectivityArray()) &&
    HaveSameValues(a->GetOffsetsArray(), b->GetOffsetsArray());
}

/** True if an array of the new output may be replaced by one of the last output. */
bool IsSameArray(vtkDataArray* fresh, vtkDataArray* last)
{
  // Keys and names of components come from the input; consumers have added keys to the last array.
  return HaveSameValues(fresh, last) && !fresh->HasInformation() && !fresh->HasAComponentName() &&
    !last->HasAComponentName() && fresh->GetLookupTable() == last->GetLookupTable();
}

void ReuseArrays(vtkDataSetAttributes* last, vtkDataSetAttributes* output)
{
  for (int k = 0; k < output->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* fresh = output->GetArray(k);
    const char* name = fresh ? fresh->GetName() : nullptr;
    vtkDataArray* kept = name ? last->GetArray(name) : nullptr;
    if (kept && IsSameArray(fresh, kept))
    {
      // Takes the place of the array with this name, and its role as an attribute.
      output->AddArray(kept);
    }
  }
}

template <typename Object>
vtkSmartPointer<Object> Copy(Object* from)
{
  auto copy = vtk::TakeSmartPointer(from->NewInstance());
  copy->DeepCopy(from);
  return copy;
}

void CopyArrays(vtkDataSetAttributes* owned, vtkDataSetAttributes* output)
{
  for (int k = 0; k < owned->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* array = owned->GetArray(k);
    if (array && output->GetArray(array->GetName()) == array)
    {
      output->AddArray(Copy(array));
    }
  }
}

void CopyOwned(vtkPolyData* owned, vtkPolyData* output)
{
  if (output->GetPoints() == owned->GetPoints())
  {
    vtkNew<vtkPoints> points;
    points->SetData(Copy(owned->GetPoints()->GetData()));
    output->SetPoints(points);
  }
  for (const CellPlace& place : CellPlaces)
  {
    if ((output->*place.Get)() == (owned->*place.Get)())
    {
      (output->*place.Set)(Copy((owned->*place.Get)()));
    }
  }
  CopyArrays(owned->GetPointData(), output->GetPointData());
  CopyArrays(owned->GetCellData(), output->GetCellData());
}

}

//------------------------------------------------------------------------------
void KeptOutput::Reuse(vtkPolyData* output, vtkPolyData* owned)
{
  vtkPoints* points = output->GetPoints();
  vtkPoints* kept = this->Last->GetPoints();
  if (points && kept && HaveSameValues(points->GetData(), kept->GetData()))
  {
    output->SetPoints(kept);
  }
  for (const CellPlace& place : CellPlaces)
  {
    vtkCellArray* last = (this->Last->*place.Get)();
    if (HaveSameValues((output->*place.Get)(), last))
    {
      (output->*place.Set)(last);
    }
  }
  ReuseArrays(this->Last->GetPointData(), output->GetPointData());
  ReuseArrays(this->Last->GetCellData(), output->GetCellData());
  if (owned)
  {
    CopyOwned(owned, output);
  }
  this->Last->ShallowCopy(output);
}

}
