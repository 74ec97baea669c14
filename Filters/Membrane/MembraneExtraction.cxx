// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/MembraneExtraction.h"

#include "Filters/Common/CellLoop.h"
#include "Filters/Common/TouchingPolygon.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meniscus
{
namespace
{

const char* const SourceName = "MeniscusSourceCell";

class Extraction
{
public:
  explicit Extraction(vtkPolyData* membrane)
    : Surface(membrane)
  {
  }

  MembraneArrays Run()
  {
    this->TakePoints();
    this->TakeNormals();
    vtkIdType cell = this->Surface->GetNumberOfVerts() + this->Surface->GetNumberOfLines();
    this->ForEachCell(this->Surface->GetPolys(), cell, &Extraction::AddPolygon);
    cell += this->Surface->GetNumberOfPolys();
    this->ForEachCell(this->Surface->GetStrips(), cell, &Extraction::AddStrip);
    if (this->Polygons->GetNumberOfCells() > 0)
    {
      this->SplitPolygons();
      this->SortByCell();
    }
    return std::move(this->Arrays);
  }

private:
  using AddCell = void (Extraction::*)(vtkIdType cell, vtkIdType count, const vtkIdType* ids);

  void TakePoints()
  {
    const vtkIdType count = this->Surface->GetNumberOfPoints();
    this->Arrays.Points.resize(3 * static_cast<std::size_t>(count));
    for (vtkIdType i = 0; i < count; ++i)
    {
      this->Surface->GetPoint(i, this->Arrays.Points.data() + 3 * i);
    }
  }

  void TakeNormals()
  {
    vtkDataArray* normals = this->Surface->GetPointData()->GetNormals();
    if (!normals)
    {
      return;
    }
    const vtkIdType count = this->Surface->GetNumberOfPoints();
    if (normals->GetNumberOfComponents() != 3 || normals->GetNumberOfTuples() != count)
    {
      this->Arrays.NormalsRejected = true;
      return;
    }
    this->Arrays.Normals.resize(3 * static_cast<std::size_t>(count));
    for (vtkIdType i = 0; i < count; ++i)
    {
      normals->GetTuple(i, this->Arrays.Normals.data() + 3 * i);
    }
  }

  void ForEachCell(vtkCellArray* cells, vtkIdType cell, AddCell add)
  {
    if (!cells)
    {
      return;
    }
    meniscus::ForEachCell(
      cells, [&](vtkIdType count, const vtkIdType* ids) { (this->*add)(cell++, count, ids); });
  }

  void AddTriangle(vtkIdType cell, vtkIdType a, vtkIdType b, vtkIdType c)
  {
    this->Arrays.Triangles.insert(this->Arrays.Triangles.end(), { a, b, c });
    this->Arrays.CellIds.push_back(cell);
  }

  void AddPolygon(vtkIdType cell, vtkIdType count, const vtkIdType* ids)
  {
    if (count == 3)
    {
      this->AddTriangle(cell, ids[0], ids[1], ids[2]);
      return;
    }
    const vtkIdType* bad =
      std::find_if_not(ids, ids + count, [this](vtkIdType id) { return this->IsUsable(id); });
    if (bad != ids + count)
    {
      this->AddTriangle(cell, *bad, *bad, *bad);
    }
    else if (count > 3)
    {
      this->Polygons->InsertNextCell(count, ids);
      this->PolygonCells->InsertNextValue(cell);
    }
    else if (count > 0)
    {
      this->AddTriangle(cell, ids[0], ids[0], ids[0]);
    }
  }

  void AddStrip(vtkIdType cell, vtkIdType count, const vtkIdType* ids)
  {
    for (vtkIdType i = 0; i + 2 < count; ++i)
    {
      const vtkIdType odd = i % 2;
      this->AddTriangle(cell, ids[i], ids[i + 1 + odd], ids[i + 2 - odd]);
    }
  }

  bool IsUsable(vtkIdType id) const
  {
    if (id < 0 || id >= this->Surface->GetNumberOfPoints())
    {
      return false;
    }
    const double* p = this->Arrays.Points.data() + 3 * id;
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  }

  void SplitPolygons()
  {
    this->PolygonCells->SetName(SourceName);
    vtkNew<vtkPolyData> polygons;
    polygons->SetPoints(this->Surface->GetPoints());
    polygons->SetPolys(this->Polygons);
    polygons->GetCellData()->AddArray(this->PolygonCells);
    vtkNew<vtkTriangleFilter> split;
    split->SetInputData(polygons);
    split->Update();
    vtkPolyData* triangles = split->GetOutput();
    const auto* cells =
      vtkIdTypeArray::SafeDownCast(triangles->GetCellData()->GetArray(SourceName));
    this->SplitCells = cells;
    this->ForEachCell(triangles->GetPolys(), 0, &Extraction::AddSplitTriangle);

    // A polygon that yielded no triangle touches itself or has no area.
    std::vector<std::int64_t> found = this->Arrays.CellIds;
    std::sort(found.begin(), found.end());
    vtkIdType polygon = 0;
    meniscus::ForEachCell(this->Polygons,
      [&](vtkIdType count, const vtkIdType* ids)
      {
        const vtkIdType cell = this->PolygonCells->GetValue(polygon++);
        if (!std::binary_search(found.begin(), found.end(), cell))
        {
          const bool isDivided = DivideTouchingPolygon(this->Surface->GetPoints(), count, ids,
            [&](const vtkIdType* three) { this->AddTriangle(cell, three[0], three[1], three[2]); });
          if (!isDivided)
          {
            this->AddTriangle(cell, ids[0], ids[0], ids[0]);
          }
        }
      });
  }

  void AddSplitTriangle(vtkIdType triangle, vtkIdType count, const vtkIdType* ids)
  {
    if (count == 3 && this->SplitCells)
    {
      this->AddTriangle(this->SplitCells->GetValue(triangle), ids[0], ids[1], ids[2]);
    }
  }

  void SortByCell()
  {
    std::vector<std::size_t> order(this->Arrays.CellIds.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto& cells = this->Arrays.CellIds;
    std::stable_sort(order.begin(), order.end(),
      [&cells](std::size_t a, std::size_t b) { return cells[a] < cells[b]; });
    MembraneArrays sorted;
    for (const std::size_t i : order)
    {
      const std::int64_t* ids = this->Arrays.Triangles.data() + 3 * i;
      sorted.Triangles.insert(sorted.Triangles.end(), ids, ids + 3);
      sorted.CellIds.push_back(cells[i]);
    }
    this->Arrays.Triangles = std::move(sorted.Triangles);
    this->Arrays.CellIds = std::move(sorted.CellIds);
  }

  vtkPolyData* Surface;
  MembraneArrays Arrays;
  vtkNew<vtkCellArray> Polygons;
  vtkNew<vtkIdTypeArray> PolygonCells;
  const vtkIdTypeArray* SplitCells = nullptr;
};

}

//------------------------------------------------------------------------------
bool MembraneArrays::operator==(const MembraneArrays& other) const
{
  return this->Points == other.Points && this->Normals == other.Normals &&
    this->Triangles == other.Triangles && this->CellIds == other.CellIds &&
    this->NormalsRejected == other.NormalsRejected;
}

//------------------------------------------------------------------------------
MembraneInput MembraneArrays::AsInput() const
{
  MembraneInput input;
  input.Points = this->Points.data();
  input.NumberOfPoints = this->Points.size() / 3;
  input.Triangles = this->Triangles.data();
  input.NumberOfTriangles = this->Triangles.size() / 3;
  input.CellIds = this->CellIds.data();
  input.Normals = this->Normals.empty() ? nullptr : this->Normals.data();
  return input;
}

//------------------------------------------------------------------------------
void MembraneArrays::Turn()
{
  for (std::size_t i = 0; i < this->Triangles.size(); i += 3)
  {
    std::swap(this->Triangles[i + 1], this->Triangles[i + 2]);
  }
  for (double& component : this->Normals)
  {
    component = -component;
  }
}

//------------------------------------------------------------------------------
vtkMTimeType GetMembraneTime(vtkPolyData* membrane)
{
  vtkMTimeType time = membrane->GetMTime();
  for (vtkCellArray* cells : { membrane->GetPolys(), membrane->GetStrips() })
  {
    time = std::max(
      { time, cells->GetConnectivityArray()->GetMTime(), cells->GetOffsetsArray()->GetMTime() });
  }
  return time;
}

//------------------------------------------------------------------------------
MembraneArrays ExtractMembrane(vtkPolyData* membrane)
{
  return Extraction(membrane).Run();
}

}
