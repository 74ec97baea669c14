// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/LitMesh.h"

#include "Filters/Common/CellLoop.h"
#include "Rendering/Pass/LocalPlaces.h"
#include "Rendering/Pass/SurfacePoint.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkOpenGLCellToVTKCellMap.h"
#include "vtkPoints.h"
#include "vtkProperty.h"
#include "vtkSmartPointer.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace meniscus
{
namespace
{

/** More divisions of a side are finer than the colours of a picture of that width. */
constexpr int MostDivisions = 2048;

/** Points of grids on sides of triangles, by the ends of the side, its divisions and the place. */
class SharedPoints
{
public:
  explicit SharedPoints(vtkPoints* points)
    : Points(points)
  {
  }

  /** Point at a place of a grid. `weights` are whole numbers with the sum `divisions`. */
  vtkIdType Get(const std::array<vtkIdType, 3>& corners, const std::array<int, 3>& weights,
    int divisions, const glm::dvec3& place)
  {
    Key key{ -1, -1, divisions, 0 };
    int used = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (weights[i] == 0)
      {
        continue;
      }
      ++used;
      if (key[0] < 0 || corners[i] < key[0])
      {
        key[1] = key[0];
        key[0] = corners[i];
        key[3] = weights[i];
      }
      else
      {
        key[1] = corners[i];
      }
    }
    if (used == 3)
    {
      return this->Points->InsertNextPoint(&place.x);
    }
    key = used == 1 ? Key{ key[0], -1, 0, 0 } : key;
    const auto known = this->Known.find(key);
    if (known != this->Known.end())
    {
      return known->second;
    }
    const vtkIdType point = this->Points->InsertNextPoint(&place.x);
    this->Known.emplace(key, point);
    return point;
  }

private:
  using Key = std::array<vtkIdType, 4>;
  vtkPoints* Points;
  std::map<Key, vtkIdType> Known;
};

}

//------------------------------------------------------------------------------
std::vector<LitMesh::Face> LitMesh::ListFaces(vtkPolyData* surface, vtkIdTypeArray* sources)
{
  std::vector<Face> faces;
  const vtkIdType points = surface->GetNumberOfPoints();
  vtkIdType cell = surface->GetNumberOfVerts() + surface->GetNumberOfLines();
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    ForEachCell(cells,
      [&](vtkIdType size, const vtkIdType* ids)
      {
        const vtkIdType source = sources ? sources->GetValue(cell) : cell;
        ++cell;
        const bool isKnown =
          std::all_of(ids, ids + size, [points](vtkIdType i) { return i >= 0 && i < points; });
        for (vtkIdType i = 2; isKnown && i < size; ++i)
        {
          const vtkIdType first = cells == surface->GetStrips() ? i - 2 : 0;
          Face face{ { ids[first], ids[i - 1], ids[i] }, source, 0.0 };
          double sum = 0.0;
          for (std::size_t k = 0; k < 3; ++k)
          {
            const double side = glm::distance(
              PointOf(surface, face.Corners[k]), PointOf(surface, face.Corners[(k + 1) % 3]));
            sum += side;
            face.Length = std::max(face.Length, side);
          }
          if (std::isfinite(sum))
          {
            faces.push_back(face);
          }
        }
      });
  }
  std::stable_sort(
    faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.Source < b.Source; });
  return faces;
}

//------------------------------------------------------------------------------
void LitMesh::Build(vtkPolyData* surface, vtkIdTypeArray* sources, int cells)
{
  const std::vector<Face> faces = ListFaces(surface, sources);
  this->Origin = LocalPlaces::MiddleOf(surface);
  this->Places.clear();
  this->Faces.clear();
  this->FirstFaces.assign(
    faces.empty() ? 0 : static_cast<std::size_t>(faces.back().Source) + 1, -1);
  double squares = 0.0;
  for (const Face& face : faces)
  {
    squares += face.Length * face.Length;
  }
  const double size = std::sqrt(squares / std::max(cells, 1));
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  SharedPoints shared(points);
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    const Face& face = faces[f];
    const double wanted = size > 0.0 ? std::round(face.Length / size) : 1.0;
    const int n = static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(MostDivisions)));
    std::size_t behind = 0;
    while (f + behind + 1 < faces.size() && faces[f + behind + 1].Source == face.Source)
    {
      ++behind;
    }
    std::int32_t& first = this->FirstFaces[static_cast<std::size_t>(face.Source)];
    first = first < 0 ? static_cast<std::int32_t>(f) : first;
    const std::size_t start = this->Places.size();
    std::array<glm::dvec3, 3> corners;
    const double numbers[3] = { static_cast<double>(n), static_cast<double>(start),
      static_cast<double>(behind) };
    for (std::size_t k = 0; k < 3; ++k)
    {
      corners[k] = PointOf(surface, face.Corners[k]);
      const glm::dvec3 near = corners[k] - this->Origin;
      for (const double number : { near.x, near.y, near.z, numbers[k] })
      {
        this->Faces.push_back(static_cast<float>(number));
      }
    }
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i + j <= n; ++i)
      {
        const glm::dvec3 place =
          (static_cast<double>(n - i - j) * corners[0] + static_cast<double>(i) * corners[1] +
            static_cast<double>(j) * corners[2]) /
          static_cast<double>(n);
        this->Places.push_back(shared.Get(face.Corners, { n - i - j, i, j }, n, place));
      }
    }
    this->AddTriangles(start, n, triangles);
  }
  this->Cells->Initialize();
  this->Cells->SetPoints(points);
  this->Cells->SetPolys(triangles);
}

//------------------------------------------------------------------------------
void LitMesh::AddTriangles(std::size_t start, int divisions, vtkCellArray* triangles) const
{
  const vtkIdType* row = this->Places.data() + start;
  for (int j = 0; j < divisions; ++j)
  {
    const int places = divisions + 1 - j;
    const vtkIdType* next = row + places;
    for (int i = 0; i + 1 < places; ++i)
    {
      triangles->InsertNextCell({ row[i], row[i + 1], next[i] });
      if (i + 2 < places)
      {
        triangles->InsertNextCell({ row[i + 1], next[i + 1], next[i] });
      }
    }
    row = next;
  }
}

//------------------------------------------------------------------------------
std::vector<std::int32_t> LitMesh::ListPrimitives(vtkPolyData* images) const
{
  vtkDataArray* sources = images->GetCellData()->GetArray("SourceCellId");
  if (!sources)
  {
    return {};
  }
  // VTK does not draw triangles of polygons two of whose corners are at one place. The table is
  // made as the mapper makes its own.
  vtkCellArray* cells[4] = { images->GetVerts(), images->GetLines(), images->GetPolys(),
    images->GetStrips() };
  vtkNew<vtkOpenGLCellToVTKCellMap> drawn;
  drawn->Update(cells, VTK_SURFACE, images->GetPoints());
  std::vector<std::int32_t> primitives(drawn->GetSize());
  for (std::size_t i = 0; i < primitives.size(); ++i)
  {
    const auto source = static_cast<std::size_t>(sources->GetComponent(drawn->GetValue(i), 0));
    primitives[i] = source < this->FirstFaces.size() ? this->FirstFaces[source] : -1;
  }
  return primitives;
}

}
