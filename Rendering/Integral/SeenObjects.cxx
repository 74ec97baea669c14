// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/SeenObjects.h"

#include "Common/FiniteVector.h"
#include "Filters/Common/NamedArray.h"
#include "Filters/Object/ObjectTopology.h"
#include "Rendering/Integral/SurfaceTexture.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkScalarsToColors.h"
#include "vtkUnsignedCharArray.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace meniscus
{
namespace
{

constexpr double NoValue = std::numeric_limits<double>::quiet_NaN();

glm::dvec3 PointOf(vtkDataSet* data, vtkIdType point)
{
  glm::dvec3 place;
  data->GetPoint(point, glm::value_ptr(place));
  return place;
}

}

/** Colours of the objects' cells or points, and texture coordinates; null if there are none. */
struct SeenObjects::Colors
{
  vtkSmartPointer<vtkUnsignedCharArray> Values;
  bool AreOfPoints = false;
  vtkDataArray* TextureCoordinates = nullptr;
};

//------------------------------------------------------------------------------
void SeenObjects::Read(vtkDataSet* objects, const TetrahedralMesh& mesh)
{
  this->Surface = this->Surfaces.Get(objects);
  this->Corners.clear();
  this->Polygons.clear();
  vtkPolyData* data = this->Surface.Data;
  const ObjectTopology topology = ExtractTopology(data);
  this->BrokenCells = topology.BrokenCells;
  this->Radius = mesh.GetRadius();
  std::vector<glm::dvec3> points(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = (PointOf(data, static_cast<vtkIdType>(i)) - mesh.GetCenter()) / this->Radius;
  }
  const ObjectTopology::Cells& polygons = topology.Polygons;
  for (std::size_t cell = 0; cell < polygons.GetCount(); ++cell)
  {
    const auto begin = polygons.Connectivity.begin() + polygons.Offsets[cell];
    const auto end = polygons.Connectivity.begin() + polygons.Offsets[cell + 1];
    const bool isFinite = std::all_of(begin, end,
      [&points](std::int64_t point) { return IsFinite(points[static_cast<std::size_t>(point)]); });
    this->BrokenCells += isFinite ? 0 : 1;
    for (auto third = begin + 2; isFinite && begin != end && third < end; ++third)
    {
      this->Corners.push_back({ static_cast<std::int32_t>(*begin),
        static_cast<std::int32_t>(*(third - 1)), static_cast<std::int32_t>(*third) });
      this->Polygons.push_back(polygons.Ids[cell]);
    }
  }
  this->Triangles.Build(std::move(points), this->Corners);
  const glm::dvec3 half = mesh.GetHalfSize() / this->Radius;
  const AxisBox& box = this->Triangles.GetBounds();
  // Positions of the mesh are rounded.
  const double slack = TetrahedralMesh::PositionUnit;
  this->InMesh = glm::all(glm::lessThanEqual(box.Low, half + slack)) &&
    glm::all(glm::greaterThanEqual(box.High, -half - slack));
}

//------------------------------------------------------------------------------
bool SeenObjects::HasTextureCoordinates() const
{
  return this->Surface.Data->GetPointData()->GetTCoords() != nullptr;
}

//------------------------------------------------------------------------------
SeenObjects::Colors SeenObjects::MapColors(const ObjectShading& shading) const
{
  Colors colors;
  vtkPolyData* data = this->Surface.Data;
  vtkDataArray* scalars = data->GetCellData()->GetScalars();
  if (!scalars)
  {
    scalars = data->GetPointData()->GetScalars();
    colors.AreOfPoints = scalars != nullptr;
  }
  if (scalars)
  {
    colors.Values = MapToColors(scalars, shading.LookupTable, VTK_COLOR_MODE_DEFAULT);
  }
  if (shading.Texture && !shading.Texture->IsEmpty())
  {
    colors.TextureCoordinates = data->GetPointData()->GetTCoords();
  }
  return colors;
}

//------------------------------------------------------------------------------
/** Colour of the surface at a hit, without light. */
glm::dvec3 SeenObjects::SurfaceColorOf(
  const OpaqueHit& hit, const Colors& colors, const ObjectShading& shading) const
{
  const auto number = static_cast<std::size_t>(hit.Triangle);
  const auto& corners = this->Corners[number];
  glm::dvec3 color(colors.AreOfPoints ? 0.0 : 1.0);
  if (colors.Values && !colors.AreOfPoints)
  {
    color = GetColor(colors.Values, this->Polygons[number]);
  }
  glm::dvec2 coordinates(0.0);
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (colors.AreOfPoints)
    {
      color += hit.Weights[i] * GetColor(colors.Values, corners[i]);
    }
    for (int k = 0; colors.TextureCoordinates && k < 2; ++k)
    {
      const bool exists = k < colors.TextureCoordinates->GetNumberOfComponents();
      coordinates[k] +=
        exists ? hit.Weights[i] * colors.TextureCoordinates->GetComponent(corners[i], k) : 0.0;
    }
  }
  return colors.TextureCoordinates ? color * shading.Texture->At(coordinates) : color;
}

//------------------------------------------------------------------------------
glm::dvec3 SeenObjects::ColorOf(
  const OpaqueHit& hit, const Colors& colors, const ObjectShading& shading) const
{
  const auto& corners = this->Corners[static_cast<std::size_t>(hit.Triangle)];
  const glm::dvec3 first = PointOf(this->Surface.Data, corners[0]);
  const glm::dvec3 normal = glm::cross(PointOf(this->Surface.Data, corners[1]) - first,
    PointOf(this->Surface.Data, corners[2]) - first);
  const bool isHeadlight = shading.LightDirection == glm::dvec3(0.0);
  const glm::dvec3& light = isHeadlight ? hit.Direction : shading.LightDirection;
  const double sizes = glm::length(normal) * glm::length(light);
  // Light shines on the side that is seen if it falls from there.
  const double side = hit.IsFront ? -1.0 : 1.0;
  const double cosine = sizes > 0.0 ? std::max(0.0, side * glm::dot(normal, light) / sizes) : 0.0;
  return this->SurfaceColorOf(hit, colors, shading) *
    (shading.Ambient + (1.0 - shading.Ambient) * cosine);
}

//------------------------------------------------------------------------------
/** Place of a hit in world coordinates. */
glm::dvec3 SeenObjects::PlaceOf(const OpaqueHit& hit) const
{
  const auto& corners = this->Corners[static_cast<std::size_t>(hit.Triangle)];
  glm::dvec3 place(0.0);
  for (std::size_t i = 0; i < 3; ++i)
  {
    place += hit.Weights[i] * PointOf(this->Surface.Data, corners[i]);
  }
  return place;
}

//------------------------------------------------------------------------------
void SeenObjects::Write(const std::vector<OpaqueSight>& sights, const std::vector<glm::dvec3>& eyes,
  const ObjectShading& shading, vtkImageData* output) const
{
  auto* tones = AddPointArray<vtkUnsignedCharArray>(output, "Color", 3);
  auto* states = AddPointArray<vtkUnsignedCharArray>(output, "Seen", 1);
  auto* cells = AddPointArray<vtkIdTypeArray>(output, "CellId", 1);
  auto* places = AddPointArray<vtkDoubleArray>(output, "Position", 3);
  auto* depths = AddPointArray<vtkFloatArray>(output, "Depth", 1);
  auto* directions = AddPointArray<vtkFloatArray>(output, "Direction", 3);
  const Colors colors = this->MapColors(shading);
  for (std::size_t i = 0; i < sights.size(); ++i)
  {
    const auto number = static_cast<vtkIdType>(i);
    const OpaqueSight& sight = sights[i];
    const bool isSeen = sight.Hit.Triangle >= 0;
    const glm::dvec3 behind =
      isSeen ? this->ColorOf(sight.Hit, colors, shading) : shading.Background;
    const float* const light = sight.Light.Values;
    const glm::dvec3 color = glm::dvec3(light[0], light[1], light[2]) + double{ light[3] } * behind;
    const glm::dvec3 place = isSeen ? this->PlaceOf(sight.Hit) : glm::dvec3(NoValue);
    for (int k = 0; k < 3; ++k)
    {
      tones->SetTypedComponent(
        number, k, static_cast<unsigned char>(255.0 * glm::clamp(color[k], 0.0, 1.0) + 0.5));
      directions->SetTypedComponent(number, k, static_cast<float>(sight.Direction[k]));
      places->SetTypedComponent(number, k, place[k]);
    }
    states->SetValue(number, isSeen ? 1 : (sight.IsStopped ? 2 : 0));
    depths->SetValue(number,
      static_cast<float>(isSeen ? this->Radius * glm::length(sight.Hit.Place - eyes[i]) : NoValue));
    vtkIdType cell = isSeen ? this->Polygons[static_cast<std::size_t>(sight.Hit.Triangle)] : -1;
    if (isSeen && this->Surface.Cells)
    {
      cell = this->Surface.Cells->GetValue(cell);
    }
    cells->SetValue(number, cell);
  }
}

}
