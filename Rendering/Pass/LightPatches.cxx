// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/LightPatches.h"

#include "Filters/Common/CellLoop.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace meniscus
{
namespace
{

// Cells that face the light have it with a relative error of 0.26 % (Documentation/caustics.md,
// "Measured"), and those with a tenth of the cross-section of a regular triangle with ten times
// that. That is a step of a colour of 8 bits if the object's normals are 10 degrees off the cell's.
const double LeastShare = 0.1 * std::sqrt(3.0) / 4.0;

glm::dvec3 NormalizedOr(const glm::dvec3& vector, const glm::dvec3& other)
{
  const double length = glm::length(vector);
  return length > 0.0 && std::isfinite(length) ? vector / length : other;
}

}

//------------------------------------------------------------------------------
std::vector<LightPatches::Ring> LightPatches::ListRings(vtkPolyData* lit, vtkDataArray* vectors)
{
  std::vector<Ring> rings(static_cast<std::size_t>(lit->GetNumberOfPoints()));
  glm::dvec3 sum(0.0);
  const auto vectorOf = [vectors](std::size_t i)
  {
    glm::dvec3 vector;
    vectors->GetTuple(static_cast<vtkIdType>(i), &vector.x);
    return vector;
  };
  for (std::size_t i = 0; i < rings.size(); ++i)
  {
    sum += NormalizedOr(vectorOf(i), glm::dvec3(0.0));
  }
  const glm::dvec3 mean = NormalizedOr(sum, glm::dvec3(0.0));
  for (std::size_t i = 0; i < rings.size(); ++i)
  {
    rings[i].ToLight = NormalizedOr(vectorOf(i), mean);
  }
  ForEachCell(lit->GetPolys(),
    [&rings, lit](vtkIdType, const vtkIdType* ids)
    {
      glm::dvec3 corners[3];
      for (int k = 0; k < 3; ++k)
      {
        lit->GetPoint(ids[k], &corners[k].x);
      }
      const glm::dvec3 a = corners[1] - corners[0];
      const glm::dvec3 b = corners[2] - corners[0];
      const glm::dvec3 c = corners[2] - corners[1];
      const glm::dvec3 area = 0.5 * glm::cross(a, b);
      const double square = std::max({ glm::dot(a, a), glm::dot(b, b), glm::dot(c, c) });
      for (int k = 0; k < 3; ++k)
      {
        Ring& ring = rings[static_cast<std::size_t>(ids[k])];
        ring.SquaredRadius = std::max(ring.SquaredRadius, square);
        ring.HasThinCell =
          ring.HasThinCell || std::fabs(glm::dot(area, ring.ToLight)) < LeastShare * square;
      }
    });
  return rings;
}

//------------------------------------------------------------------------------
void LightPatches::Build(vtkPolyData* lit)
{
  this->Points.clear();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  vtkDataArray* vectors = lit->GetPointData()->GetArray("RefractionLightVector");
  const std::vector<Ring> rings = vectors ? ListRings(lit, vectors) : std::vector<Ring>();
  for (std::size_t i = 0; i < rings.size(); ++i)
  {
    const Ring& ring = rings[i];
    if (!ring.HasThinCell || ring.ToLight == glm::dvec3(0.0))
    {
      continue;
    }
    this->Points.push_back(static_cast<vtkIdType>(i));
    glm::dvec3 middle;
    lit->GetPoint(this->Points.back(), &middle.x);
    const glm::dvec3 axis =
      std::fabs(ring.ToLight.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 u =
      std::sqrt(ring.SquaredRadius) * glm::normalize(glm::cross(axis, ring.ToLight));
    const glm::dvec3 v = std::sqrt(0.75) * glm::cross(ring.ToLight, u);
    vtkIdType first = 0;
    for (const glm::dvec3& shift : { v - 0.5 * u, -v - 0.5 * u, u, glm::dvec3(0.0) })
    {
      const glm::dvec3 place = middle + shift;
      first = points->InsertNextPoint(&place.x) - 3;
    }
    triangles->InsertNextCell({ first, first + 1, first + 3 });
    triangles->InsertNextCell({ first + 1, first + 2, first + 3 });
    triangles->InsertNextCell({ first + 2, first, first + 3 });
  }
  this->Patches->Initialize();
  this->Patches->SetPoints(points);
  this->Patches->SetPolys(triangles);
}

}
