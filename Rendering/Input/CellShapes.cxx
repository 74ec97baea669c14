// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/CellShapes.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkHexahedron.h"
#include "vtkPointData.h"
#include "vtkPyramid.h"
#include "vtkSmartPointer.h"
#include "vtkVoxel.h"
#include "vtkWedge.h"

#include <algorithm>
#include <array>
#include <mutex>

namespace meniscus
{

namespace
{

constexpr CellKind Kinds[] = {
  { VTK_EMPTY_CELL, {}, 0, 0 },
  { VTK_TETRA, { VTK_TETRA, 4, 0 }, 4, 1 },
  { VTK_VOXEL, { VTK_VOXEL, 8, 1 }, 8, 6 },
  { VTK_HEXAHEDRON, { VTK_HEXAHEDRON, 8, 1 }, 8, 6 },
  { VTK_WEDGE, { VTK_WEDGE, 6, 1 }, 6, 3 },
  { VTK_PYRAMID, { VTK_PYRAMID, 5, 1 }, 5, 2 },
  { VTK_PENTAGONAL_PRISM, {}, 10, 1 },
  { VTK_HEXAGONAL_PRISM, {}, 12, 1 },
  { VTK_CONVEX_POINT_SET, {}, 4, 1 },
  { VTK_QUADRATIC_TETRA, { VTK_TETRA, 4, 2 }, 10, 8 },
  { VTK_QUADRATIC_HEXAHEDRON, { VTK_HEXAHEDRON, 8, 2 }, 20, 22 },
  { VTK_TRIQUADRATIC_HEXAHEDRON, { VTK_HEXAHEDRON, 8, 2 }, 27, 48, 26 },
  { VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, { VTK_HEXAHEDRON, 8, 2 }, 24, 36 },
  { VTK_QUADRATIC_WEDGE, { VTK_WEDGE, 6, 2 }, 15, 15 },
  { VTK_QUADRATIC_LINEAR_WEDGE, { VTK_WEDGE, 6, 2 }, 12, 12 },
  { VTK_BIQUADRATIC_QUADRATIC_WEDGE, { VTK_WEDGE, 6, 2 }, 18, 24 },
  { VTK_QUADRATIC_PYRAMID, { VTK_PYRAMID, 5, 2 }, 13, 13 },
  // Its triangles have a point in the middle.
  { VTK_TRIQUADRATIC_PYRAMID, { VTK_PYRAMID, 5, 3 }, 19, 32, 18 },
  { VTK_LAGRANGE_TETRAHEDRON, { VTK_TETRA, 4, CellShape::Varying }, 0, 1 },
  { VTK_BEZIER_TETRAHEDRON, { VTK_TETRA, 4, CellShape::Varying }, 0, 1 },
  { VTK_LAGRANGE_HEXAHEDRON, { VTK_HEXAHEDRON, 8, CellShape::Varying }, 0, 6 },
  { VTK_BEZIER_HEXAHEDRON, { VTK_HEXAHEDRON, 8, CellShape::Varying }, 0, 6 },
  { VTK_LAGRANGE_WEDGE, { VTK_WEDGE, 6, CellShape::Varying }, 0, 3 },
  { VTK_BEZIER_WEDGE, { VTK_WEDGE, 6, CellShape::Varying }, 0, 3 },
  // Drawn if they are of order 1.
  { VTK_LAGRANGE_PYRAMID, {}, 5, 1 },
  { VTK_BEZIER_PYRAMID, {}, 5, 1 },
};

/** The kinds by type; the last entry is for unknown types. */
constexpr std::array<CellKind, VTK_NUMBER_OF_CELL_TYPES + 1> ListByType()
{
  std::array<CellKind, VTK_NUMBER_OF_CELL_TYPES + 1> byType{};
  for (const CellKind& kind : Kinds)
  {
    byType[kind.Type] = kind;
  }
  return byType;
}

}

//------------------------------------------------------------------------------
const CellKind& KindOf(int type)
{
  static constexpr auto all = ListByType();
  return all[type >= 0 && type < VTK_NUMBER_OF_CELL_TYPES ? type : VTK_NUMBER_OF_CELL_TYPES];
}

//------------------------------------------------------------------------------
int ResolveCellType(int type, vtkIdType numberOfPoints)
{
  if (type == VTK_LAGRANGE_PYRAMID || type == VTK_BEZIER_PYRAMID)
  {
    return numberOfPoints == ShapeOf(VTK_PYRAMID).NumberOfCorners ? VTK_PYRAMID : type;
  }
  const CellShape shape = ShapeOf(type);
  return shape.Degree == CellShape::Varying && numberOfPoints == shape.NumberOfCorners
    ? shape.LinearType
    : type;
}

//------------------------------------------------------------------------------
bool HasCellClass(int type)
{
  static const std::vector<bool> known = []()
  {
    std::vector<bool> all(VTK_NUMBER_OF_CELL_TYPES);
    for (int i = 0; i < VTK_NUMBER_OF_CELL_TYPES; ++i)
    {
      all[static_cast<std::size_t>(i)] =
        vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(i)) != nullptr;
    }
    return all;
  }();
  return type >= 0 && type < VTK_NUMBER_OF_CELL_TYPES && known[static_cast<std::size_t>(type)];
}

//------------------------------------------------------------------------------
glm::dvec3 PlaceOfCorner(const CellShape& shape, int corner)
{
  constexpr double hexahedron[8][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 },
    { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
  constexpr double wedge[6][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 },
    { 0, 1, 1 } };
  const auto at = [corner](const double(*corners)[3])
  { return glm::dvec3(corners[corner][0], corners[corner][1], corners[corner][2]); };
  switch (shape.LinearType)
  {
    case VTK_VOXEL:
      return glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    case VTK_HEXAHEDRON:
    case VTK_PYRAMID: // its points are the hexahedron's first five
      return at(hexahedron);
    default: // the points of a tetrahedron are the wedge's first four
      return at(wedge);
  }
}

//------------------------------------------------------------------------------
GridShapeFunctions::GridShapeFunctions(const std::vector<vtkDataSet*>& grids)
  : Grids(grids)
{
  std::int64_t points = 0;
  std::int64_t cells = 0;
  for (vtkDataSet* grid : grids)
  {
    this->FirstPoints.push_back(points);
    this->FirstCells.push_back(cells);
    points += grid->GetNumberOfPoints();
    cells += grid->GetNumberOfCells();
  }
}

//------------------------------------------------------------------------------
void GridShapeFunctions::Load(std::int32_t cell)
{
  if (cell == this->Loaded)
  {
    return;
  }
  const auto after = std::upper_bound(this->FirstCells.begin() + 1, this->FirstCells.end(), cell);
  const auto part = static_cast<std::size_t>(after - this->FirstCells.begin()) - 1;
  vtkDataSet* grid = this->Grids[part];
  const auto local = static_cast<vtkIdType>(cell - this->FirstCells[part]);
  this->FirstPoint = this->FirstPoints[part];
  this->Type = grid->GetCellType(local);
  grid->GetCellPoints(local, this->Ids);
  // Weights of the points make a Bezier cell of order 1 rational, other than the linear cell.
  if (!grid->GetPointData()->GetRationalWeights())
  {
    this->Type = ResolveCellType(this->Type, this->Ids->GetNumberOfIds());
  }
  if (ShapeOf(this->Type).Degree != 1)
  {
    grid->GetCell(local, this->Generic);
  }
  this->Weights.resize(static_cast<std::size_t>(this->Ids->GetNumberOfIds()));
  this->Loaded = cell;
}

//------------------------------------------------------------------------------
void GridShapeFunctions::Evaluate(const glm::dvec3& place)
{
  double at[3] = { place.x, place.y, place.z };
  if (ShapeOf(this->Type).LinearType == VTK_PYRAMID && place.z < 1.0)
  {
    at[0] /= 1.0 - place.z;
    at[1] /= 1.0 - place.z;
  }
  switch (this->Type)
  {
    case VTK_VOXEL:
      vtkVoxel::InterpolationFunctions(at, this->Weights.data());
      break;
    case VTK_HEXAHEDRON:
      vtkHexahedron::InterpolationFunctions(at, this->Weights.data());
      break;
    case VTK_WEDGE:
      vtkWedge::InterpolationFunctions(at, this->Weights.data());
      break;
    case VTK_PYRAMID:
      vtkPyramid::InterpolationFunctions(at, this->Weights.data());
      break;
    case VTK_BEZIER_WEDGE:
    {
      // VTK evaluates all of them in one triangle, which it keeps in a static variable.
      static std::mutex mutex;
      const std::lock_guard<std::mutex> guard(mutex);
      this->Generic->InterpolateFunctions(at, this->Weights.data());
      break;
    }
    default:
      this->Generic->InterpolateFunctions(at, this->Weights.data());
      break;
  }
}

//------------------------------------------------------------------------------
void GridShapeFunctions::Weigh(std::int32_t cell, const glm::dvec3& place, PointWeights& row)
{
  this->Load(cell);
  this->Evaluate(place);
  for (std::size_t i = 0; i < this->Weights.size(); ++i)
  {
    row.Add(
      static_cast<std::int32_t>(this->FirstPoint + this->Ids->GetId(static_cast<vtkIdType>(i))),
      this->Weights[i]);
  }
}

//------------------------------------------------------------------------------
/** Trilinear functions are linear along an axis; a wedge's also in planes across its axis. */
bool GridShapeFunctions::IsLinear(std::int32_t cell, const glm::vec3& from, const glm::vec3& to)
{
  this->Load(cell);
  const int x = from.x != to.x;
  const int y = from.y != to.y;
  const int z = from.z != to.z;
  switch (this->Type)
  {
    case VTK_VOXEL:
    case VTK_HEXAHEDRON:
      return x + y + z < 2;
    case VTK_WEDGE:
      return z == 0 || x + y == 0;
    default:
      return false;
  }
}

//------------------------------------------------------------------------------
int GridShapeFunctions::GetDegree(std::int32_t cell)
{
  this->Load(cell);
  const int degree = ShapeOf(this->Type).Degree;
  if (degree != CellShape::Varying)
  {
    return degree;
  }
  int most = 1;
  for (int edge = 0; edge < this->Generic->GetNumberOfEdges(); ++edge)
  {
    most = std::max(most, static_cast<int>(this->Generic->GetEdge(edge)->GetNumberOfPoints()) - 1);
  }
  return most;
}

}
