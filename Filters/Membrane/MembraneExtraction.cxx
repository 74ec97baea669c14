// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/MembraneExtraction.h"

#include "Filters/Common/CellLoop.h"
#include "Filters/Common/PolygonDivision.h"

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
#include <iterator>
#include <numeric>
#include <vector>

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
    vtkNew<vtkIdTypeArray> numbers;
    numbers->SetName(SourceName);
    numbers->SetNumberOfValues(this->Polygons->GetNumberOfCells());
    std::iota(numbers->Begin(), numbers->End(), vtkIdType(0));
    vtkNew<vtkPolyData> polygons;
    polygons->SetPoints(this->Surface->GetPoints());
    polygons->SetPolys(this->Polygons);
    polygons->GetCellData()->AddArray(numbers);
    vtkNew<vtkTriangleFilter> split;
    split->SetInputData(polygons);
    split->Update();
    vtkPolyData* triangles = split->GetOutput();
    auto* sources = vtkIdTypeArray::SafeDownCast(triangles->GetCellData()->GetArray(SourceName));
    std::vector<std::vector<vtkIdType>> parts(
      static_cast<std::size_t>(this->Polygons->GetNumberOfCells()));
    vtkIdType triangle = 0;
    meniscus::ForEachCell(triangles->GetPolys(),
      [&](vtkIdType count, const vtkIdType* ids)
      {
        const vtkIdType number = sources ? sources->GetValue(triangle++) : 0;
        std::vector<vtkIdType>& part = parts[static_cast<std::size_t>(number)];
        part.insert(part.end(), ids, ids + (count == 3 ? 3 : 0));
      });
    vtkIdType polygon = 0;
    meniscus::ForEachCell(this->Polygons,
      [&](vtkIdType count, const vtkIdType* ids)
      {
        const auto number = static_cast<std::size_t>(polygon);
        this->AddDivided(this->PolygonCells->GetValue(polygon++), count, ids, parts[number]);
      });
  }

  /** Adds the triangles of a polygon that vtkTriangleFilter has made, or others if some lack. */
  void AddDivided(
    vtkIdType cell, vtkIdType count, const vtkIdType* ids, const std::vector<vtkIdType>& triangles)
  {
    const auto addTriangle = [this, cell](const vtkIdType* three)
    { this->AddTriangle(cell, three[0], three[1], three[2]); };
    if (this->IsComplete(count, ids, triangles))
    {
      for (std::size_t i = 0; i < triangles.size(); i += 3)
      {
        addTriangle(triangles.data() + i);
      }
    }
    else if (!DividePolygon(this->Surface->GetPoints(), count, ids, addTriangle))
    {
      this->AddTriangle(cell, ids[0], ids[0], ids[0]);
    }
  }

  bool IsComplete(
    vtkIdType count, const vtkIdType* ids, const std::vector<vtkIdType>& triangles) const
  {
    const auto get = [this](vtkIdType id)
    {
      const double* place = this->Arrays.Points.data() + 3 * id;
      return glm::dvec3(place[0], place[1], place[2]);
    };
    std::vector<glm::dvec3> corners;
    std::transform(ids, ids + count, std::back_inserter(corners), get);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < triangles.size(); i += 3)
    {
      const glm::dvec3 first = get(triangles[i]);
      sum += glm::cross(get(triangles[i + 1]) - first, get(triangles[i + 2]) - first);
    }
    return !triangles.empty() && IsCompleteDivision(corners, sum);
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
