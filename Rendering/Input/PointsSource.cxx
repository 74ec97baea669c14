// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/PointsSource.h"

#include "Common/BlockLoop.h"
#include "Rendering/Common/VTKVersions.h"
#include "Rendering/Input/GridLayout.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataSet.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSOADataArrayTemplate.h"

namespace meniscus
{
namespace
{

/** Looks at the coordinates in the array's memory; false for arrays of another layout or type. */
template <typename T>
bool ViewCoordinates(vtkDataArray* points, PointsView& view)
{
  if (auto* triples = vtkAOSDataArrayTemplate<T>::FastDownCast(points))
  {
    view = PointsView(triples->GetPointer(0));
    return true;
  }
  auto* axes = vtkSOADataArrayTemplate<T>::FastDownCast(points);
  if (axes && KeepsComponentsApart(axes, 0))
  {
    view = PointsView(axes->GetComponentArrayPointer(0), axes->GetComponentArrayPointer(1),
      axes->GetComponentArrayPointer(2));
    return true;
  }
  return false;
}

vtkPoints* PointsOf(vtkDataSet* grid)
{
  vtkPointSet* set = vtkPointSet::SafeDownCast(grid);
  return set ? set->GetPoints() : nullptr;
}

}

//------------------------------------------------------------------------------
PointsSource::PointsSource(const std::vector<vtkDataSet*>& grids, const RangeLoop& loop)
{
  for (vtkDataSet* grid : grids)
  {
    this->NumberOfPoints += grid->GetNumberOfPoints();
  }
  vtkPoints* points = grids.size() == 1 ? PointsOf(grids[0]) : nullptr;
  if (points)
  {
    this->LookAt(points->GetData());
  }
  else
  {
    this->Copy(grids, loop);
  }
}

//------------------------------------------------------------------------------
void PointsSource::LookAt(vtkDataArray* points)
{
  if (!ViewCoordinates<double>(points, this->View) && !ViewCoordinates<float>(points, this->View))
  {
    this->Copies = CopyValues<double>(points);
    this->View = this->Copies.data();
  }
}

//------------------------------------------------------------------------------
void PointsSource::Copy(const std::vector<vtkDataSet*>& grids, const RangeLoop& loop)
{
  this->Copies.resize(3 * static_cast<std::size_t>(this->NumberOfPoints));
  double* next = this->Copies.data();
  for (vtkDataSet* grid : grids)
  {
    const auto size = static_cast<std::size_t>(grid->GetNumberOfPoints());
    ForEachInBlocks(size, IsThreadSafe(grid) ? loop : SerialLoop,
      [grid, next](std::size_t p) { grid->GetPoint(static_cast<vtkIdType>(p), next + 3 * p); });
    next += 3 * size;
  }
  this->View = this->Copies.data();
}

}
