// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Object/ObjectSurface.h"

#include "Filters/Common/CellLoop.h"
#include "Filters/Common/PolygonDivision.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTriangleFilter.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <vector>

namespace meniscus
{
namespace
{

const char* const PointIds = "MeniscusSourcePoint";
const char* const CellIds = "MeniscusSourceCell";

/** Latest time of a data set and, for a vtkPolyData, of the arrays of its polygons. */
vtkMTimeType GetTime(vtkDataSet* data)
{
  vtkMTimeType time = data->GetMTime();
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    vtkCellArray* cells = surface->GetPolys();
    time = std::max(
      { time, cells->GetConnectivityArray()->GetMTime(), cells->GetOffsetsArray()->GetMTime() });
  }
  return time;
}

/**
 * True if a polygon turns to both sides, by more than the rounding of the cross product of its
 * edges. Its area vector determines the side. Corners that repeat the one before them do not count.
 */
bool IsConcave(std::vector<glm::dvec3>& corners)
{
  // Rounding of a cross product, as in Membrane.cxx, for edges from coordinates that are rounded.
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  if (corners.back() == corners.front())
  {
    corners.pop_back();
  }
  const std::size_t count = corners.size();
  const glm::dvec3 area = GetTwiceTheArea(corners);
  double reach = 0.0;
  for (const glm::dvec3& corner : corners)
  {
    reach = std::max(reach, glm::length(corner));
  }
  const double size = glm::length(area);
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 in = corners[(i + 1) % count] - corners[i];
    const glm::dvec3 out = corners[(i + 2) % count] - corners[(i + 1) % count];
    const double turn = glm::dot(glm::cross(in, out), area);
    if (turn < -rounding * reach * (glm::length(in) + glm::length(out)) * size)
    {
      return true;
    }
  }
  return false;
}

/** Cells of a polydata that are not convex, by their ids; those with points that exist. */
std::vector<vtkIdType> FindConcave(vtkPolyData* data)
{
  std::vector<vtkIdType> concave;
  std::vector<glm::dvec3> corners;
  const vtkIdType points = data->GetNumberOfPoints();
  vtkIdType cell = data->GetNumberOfVerts() + data->GetNumberOfLines();
  ForEachCell(data->GetPolys(),
    [&](vtkIdType count, const vtkIdType* ids)
    {
      const auto isPoint = [points](vtkIdType id) { return id >= 0 && id < points; };
      if (count > 3 && std::all_of(ids, ids + count, isPoint))
      {
        corners.resize(static_cast<std::size_t>(count));
        for (std::size_t i = 0; i < corners.size(); ++i)
        {
          data->GetPoint(ids[i], &corners[i].x);
        }
        if (IsConcave(corners))
        {
          concave.push_back(cell);
        }
      }
      ++cell;
    });
  return concave;
}

/** Ids of which several faces, triangles or points have the same one are not global any more. */
void UnmarkGlobalIds(vtkDataSetAttributes* data)
{
  data->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
}

/** Replaces polygons of a polydata by triangles. */
class PolygonReplacement
{
public:
  PolygonReplacement(vtkPolyData* from, const std::vector<vtkIdType>& concave)
    : From(from)
    , Concave(concave)
  {
  }

  void Run(ObjectSurface& surface)
  {
    this->Triangulate();
    const vtkIdType before = this->From->GetNumberOfVerts() + this->From->GetNumberOfLines();
    for (vtkIdType cell = 0; cell < before; ++cell)
    {
      this->Sources->InsertNextValue(cell);
    }
    this->CopyPolygons(before);
    for (vtkIdType i = 0; i < this->From->GetNumberOfStrips(); ++i)
    {
      this->Sources->InsertNextValue(before + this->From->GetNumberOfPolys() + i);
    }
    vtkNew<vtkPolyData> result;
    result->ShallowCopy(this->From);
    result->SetPolys(this->Polygons);
    result->DeleteCells();
    this->CopyCellData(result);
    surface.Data = result;
    surface.Cells = this->Sources;
  }

private:
  /** Divides all concave polygons at once, each flat and at a size of 1. */
  void Triangulate()
  {
    this->Scaled->SetDataTypeToDouble();
    vtkNew<vtkIdTypeArray> numbers;
    numbers->SetName(CellIds);
    const vtkIdType before = this->From->GetNumberOfVerts() + this->From->GetNumberOfLines();
    for (const vtkIdType cell : this->Concave)
    {
      vtkIdType count = 0;
      const vtkIdType* ids = nullptr;
      this->From->GetPolys()->GetCellAtId(cell - before, count, ids);
      this->AddScaled(count, ids);
      numbers->InsertNextValue(cell);
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(this->Scaled);
    data->SetPolys(this->ScaledPolygons);
    data->GetCellData()->AddArray(numbers);
    vtkNew<vtkTriangleFilter> division;
    division->SetInputData(data);
    division->Update();
    this->Triangles = division->GetOutput();
  }

  void AddScaled(vtkIdType count, const vtkIdType* ids)
  {
    std::vector<glm::dvec3> corners(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      this->From->GetPoint(ids[i], &corners[i].x);
    }
    FlattenPolygon(corners);
    this->ScaledPolygons->InsertNextCell(static_cast<int>(count));
    std::unordered_map<vtkIdType, vtkIdType> known; // a polygon may touch itself at a point
    for (vtkIdType i = 0; i < count; ++i)
    {
      const auto [place, isNew] = known.emplace(ids[i], this->Scaled->GetNumberOfPoints());
      if (isNew)
      {
        this->Scaled->InsertNextPoint(&corners[static_cast<std::size_t>(i)].x);
        this->Originals.push_back(ids[i]);
      }
      this->ScaledPolygons->InsertCellPoint(place->second);
    }
  }

  /** Cells in the order of the input; the triangles of a polygon are in the order of their ids. */
  void CopyPolygons(vtkIdType cell)
  {
    auto* numbers = vtkIdTypeArray::SafeDownCast(this->Triangles->GetCellData()->GetArray(CellIds));
    const vtkIdType triangles = numbers ? this->Triangles->GetNumberOfPolys() : 0;
    vtkIdType next = 0;
    const auto iterator = vtk::TakeSmartPointer(this->From->GetPolys()->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      bool isDivided = false;
      for (; next < triangles && numbers->GetValue(next) == cell; ++next)
      {
        vtkIdType count = 0;
        const vtkIdType* ids = nullptr;
        this->Triangles->GetPolys()->GetCellAtId(next, count, ids);
        this->AddTriangle(ids, cell);
        isDivided = true;
      }
      if (!isDivided && !this->DivideTouching(cell))
      {
        vtkIdType count = 0;
        const vtkIdType* ids = nullptr;
        iterator->GetCurrentCell(count, ids);
        this->Add(count, ids, cell);
      }
      ++cell;
    }
  }

  /** Divides a concave polygon that vtkTriangleFilter has left out. */
  bool DivideTouching(vtkIdType cell)
  {
    const auto place = std::lower_bound(this->Concave.begin(), this->Concave.end(), cell);
    if (place == this->Concave.end() || *place != cell)
    {
      return false;
    }
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    this->ScaledPolygons->GetCellAtId(place - this->Concave.begin(), count, ids);
    return DividePolygon(this->Scaled, count, ids,
      [this, cell](const vtkIdType* three) { this->AddTriangle(three, cell); });
  }

  void AddTriangle(const vtkIdType* scaled, vtkIdType cell)
  {
    const auto get = [this, scaled](int k)
    { return this->Originals[static_cast<std::size_t>(scaled[k])]; };
    const vtkIdType ids[3] = { get(0), get(1), get(2) };
    this->Add(3, ids, cell);
  }

  void Add(vtkIdType count, const vtkIdType* ids, vtkIdType cell)
  {
    this->Polygons->InsertNextCell(count, ids);
    this->Sources->InsertNextValue(cell);
  }

  /** Arrays of another length than the input's cells are left out, as of other inputs. */
  void CopyCellData(vtkPolyData* result)
  {
    const vtkIdType cells = this->From->GetNumberOfCells();
    vtkNew<vtkCellData> fitting;
    fitting->ShallowCopy(this->From->GetCellData());
    for (int i = fitting->GetNumberOfArrays(); i-- > 0;)
    {
      if (fitting->GetAbstractArray(i)->GetNumberOfTuples() != cells)
      {
        fitting->RemoveArray(i);
      }
    }
    const vtkIdType count = this->Sources->GetNumberOfValues();
    vtkCellData* data = result->GetCellData();
    data->Initialize();
    data->CopyAllOn();
    data->CopyAllocate(fitting, count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      data->CopyData(fitting, this->Sources->GetValue(i), i);
    }
    UnmarkGlobalIds(data);
  }

  vtkPolyData* From;
  const std::vector<vtkIdType>& Concave;
  vtkNew<vtkPoints> Scaled; ///< of the concave polygons, each about the origin
  vtkNew<vtkCellArray> ScaledPolygons;
  std::vector<vtkIdType> Originals; ///< points of the input, by the scaled ones
  vtkSmartPointer<vtkPolyData> Triangles;
  vtkNew<vtkCellArray> Polygons;
  vtkNew<vtkIdTypeArray> Sources;
};

/** Takes an array of ids out of attributes. */
vtkSmartPointer<vtkIdTypeArray> Take(vtkDataSetAttributes* attributes, const char* name)
{
  const vtkSmartPointer<vtkIdTypeArray> ids =
    vtkIdTypeArray::SafeDownCast(attributes->GetArray(name));
  attributes->RemoveArray(name);
  return ids;
}

/** True if an id below `count` is there twice: points of a grid on several of its sides. */
bool AreRepeated(vtkIdTypeArray* ids, vtkIdType count)
{
  std::vector<bool> isKnown(static_cast<std::size_t>(count), false);
  for (vtkIdType i = 0; ids && i < ids->GetNumberOfValues(); ++i)
  {
    const auto id = static_cast<std::size_t>(ids->GetValue(i));
    if (isKnown[id])
    {
      return true;
    }
    isKnown[id] = true;
  }
  return false;
}

void ExtractSurface(vtkDataSet* input, ObjectSurface& surface)
{
  vtkNew<vtkDataSetSurfaceFilter> faces;
  faces->PassThroughPointIdsOn();
  faces->PassThroughCellIdsOn();
  faces->SetOriginalPointIdsName(PointIds);
  faces->SetOriginalCellIdsName(CellIds);
  faces->SetInputData(input);
  faces->Update();
  surface.Data = faces->GetOutput();
  surface.Points = Take(surface.Data->GetPointData(), PointIds);
  surface.Cells = Take(surface.Data->GetCellData(), CellIds);
  UnmarkGlobalIds(surface.Data->GetCellData());
  if (AreRepeated(surface.Points, input->GetNumberOfPoints()))
  {
    UnmarkGlobalIds(surface.Data->GetPointData());
  }
}

/** Replaces the ids in an array of a name by those that `ids` has for them. */
void Restore(vtkFieldData* data, const char* name, vtkIdTypeArray* ids)
{
  auto* array = vtkIdTypeArray::SafeDownCast(data->GetArray(name));
  if (!array || !ids)
  {
    return;
  }
  vtkNew<vtkIdTypeArray> restored; // the array may be kept for another run
  restored->SetName(name);
  restored->SetNumberOfValues(array->GetNumberOfValues());
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    const vtkIdType id = array->GetValue(i);
    restored->SetValue(i, id < 0 ? id : ids->GetValue(id));
  }
  data->AddArray(restored);
}

}

//------------------------------------------------------------------------------
void ObjectSurface::RestoreIds(vtkPolyData* output) const
{
  Restore(output->GetPointData(), "SourcePointId", this->Points);
  Restore(output->GetFieldData(), "PointsWithoutImage", this->Points);
  Restore(output->GetCellData(), "SourceCellId", this->Cells);
}

//------------------------------------------------------------------------------
ObjectSurface ObjectSurfaces::Get(vtkDataSet* input)
{
  this->Entries.remove_if([](const Entry& entry) { return !entry.Source; });
  auto entry = std::find_if(this->Entries.begin(), this->Entries.end(),
    [input](const Entry& candidate) { return candidate.Source == input; });
  if (entry == this->Entries.end())
  {
    entry = this->Entries.emplace(this->Entries.end());
    entry->Source = input;
  }
  const vtkMTimeType time = GetTime(input);
  auto* data = vtkPolyData::SafeDownCast(input);
  if (entry->Time != time)
  {
    entry->Time = time;
    entry->Surface = ObjectSurface();
    const std::vector<vtkIdType> concave = data ? FindConcave(data) : std::vector<vtkIdType>();
    if (!data)
    {
      ExtractSurface(input, entry->Surface);
    }
    else if (!concave.empty())
    {
      PolygonReplacement(data, concave).Run(entry->Surface);
    }
  }
  ObjectSurface surface = entry->Surface;
  surface.Data = surface.Data ? surface.Data.Get() : data;
  return surface;
}

}
