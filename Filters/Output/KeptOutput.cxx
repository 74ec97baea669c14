// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Output/KeptOutput.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <cstddef>
#include <cstring>
#include <string>

namespace meniscus
{
namespace
{

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

}

//------------------------------------------------------------------------------
void KeptOutput::Reuse(vtkPolyData* output)
{
  vtkPoints* points = output->GetPoints();
  vtkPoints* kept = this->Last->GetPoints();
  if (points && kept && HaveSameValues(points->GetData(), kept->GetData()))
  {
    output->SetPoints(kept);
  }
  if (HaveSameValues(output->GetVerts(), this->Last->GetVerts()))
  {
    output->SetVerts(this->Last->GetVerts());
  }
  if (HaveSameValues(output->GetLines(), this->Last->GetLines()))
  {
    output->SetLines(this->Last->GetLines());
  }
  if (HaveSameValues(output->GetPolys(), this->Last->GetPolys()))
  {
    output->SetPolys(this->Last->GetPolys());
  }
  ReuseArrays(this->Last->GetPointData(), output->GetPointData());
  ReuseArrays(this->Last->GetCellData(), output->GetCellData());
  this->Last->ShallowCopy(output);
}

}
