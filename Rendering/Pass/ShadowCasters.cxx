// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/ShadowCasters.h"

#include "Common/MedianSplit.h"
#include "Filters/Common/CellLoop.h"
#include "Rendering/Pass/LitMesh.h"
#include "Rendering/Pass/SurfacePoint.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyData.h"
#include "vtkShaderProgram.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace meniscus
{
namespace
{

/** Places in tables are floats, which have all whole numbers up to this one. */
constexpr std::size_t MostBoxes = 16777216;

/**
 * Share of the largest coordinate that bounds the error of a height above a plane in the shader.
 * The height is a sum of three products and a distance, with 4 roundings of up to sqrt(3) of the
 * largest coordinate; so are the roundings of the corner, the interpolated place and the plane,
 * with 2 each: 10 sqrt(3) roundings of 2^-24, and 2^-19 is 32. The corners of boxes are less wrong.
 */
constexpr double RoundingShare = 1.0 / 524288.0;

void Append(std::vector<float>& values, const glm::dvec3& xyz, double w)
{
  for (const double value : { xyz.x, xyz.y, xyz.z, w })
  {
    values.push_back(static_cast<float>(value));
  }
}

/** Twice the largest distance of a polygon's corner from the plane that its area vector has. */
double TwistOf(vtkPolyData* surface, vtkIdType size, const vtkIdType* ids)
{
  const glm::dvec3 first = PointOf(surface, ids[0]);
  glm::dvec3 area(0.0);
  for (vtkIdType i = 2; i < size; ++i)
  {
    area += glm::cross(PointOf(surface, ids[i - 1]) - first, PointOf(surface, ids[i]) - first);
  }
  const double length = glm::length(area);
  double largest = 0.0;
  for (vtkIdType i = 1; i < size && length > 0.0; ++i)
  {
    const double height = glm::dot(PointOf(surface, ids[i]) - first, area) / length;
    largest = std::max(largest, std::fabs(height));
  }
  return 2.0 * largest;
}

double LargestTwist(vtkPolyData* surface)
{
  double largest = 0.0;
  const vtkIdType points = surface->GetNumberOfPoints();
  ForEachCell(surface->GetPolys(),
    [&](vtkIdType size, const vtkIdType* ids)
    {
      const bool isKnown =
        std::all_of(ids, ids + size, [points](vtkIdType i) { return i >= 0 && i < points; });
      const double twist = size > 3 && isKnown ? TwistOf(surface, size, ids) : 0.0;
      largest = std::isfinite(twist) ? std::max(largest, twist) : largest;
    });
  return largest;
}

}

/** A triangle with its box. */
struct ShadowCasters::Box
{
  bool operator<(const Box& other) const { return this->Index < other.Index; }

  glm::dvec3 Lower;
  glm::dvec3 Upper;
  std::size_t Index; ///< of the triangle
  std::array<glm::dvec3, 3> Corners;
  int Number; ///< of its object
};

bool ShadowCasters::Source::operator==(const Source& other) const
{
  return this->Number == other.Number && this->Surface == other.Surface && this->Time == other.Time;
}

//------------------------------------------------------------------------------
std::vector<ShadowCasters::Source> ShadowCasters::ListSources(const std::vector<Caster>& casters)
{
  std::vector<Source> sources;
  const auto add = [&](int number, vtkDataObject* object)
  {
    if (auto* data = vtkDataSet::SafeDownCast(object))
    {
      const ObjectSurface surface = this->Surfaces.Get(data);
      sources.push_back({ number, surface.Data, surface.Data->GetMTime() });
    }
  };
  for (const Caster& caster : casters)
  {
    auto* blocks = vtkCompositeDataSet::SafeDownCast(caster.Data);
    if (!blocks)
    {
      add(caster.Number, caster.Data);
      continue;
    }
    const auto iterator = vtk::TakeSmartPointer(blocks->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      add(caster.Number, iterator->GetCurrentDataObject());
    }
  }
  return sources;
}

//------------------------------------------------------------------------------
void ShadowCasters::Update(const std::vector<Caster>& casters)
{
  std::vector<Source> sources = this->ListSources(casters);
  if (sources == this->Sources)
  {
    return;
  }
  this->Sources = std::move(sources);
  ++this->Updates;
  this->IsUploaded = false;
  this->Triangles.clear();
  this->Nodes.clear();
  this->Twists.clear();
  std::vector<Box> boxes;
  for (const Source& source : this->Sources)
  {
    ListTriangles(source, boxes);
    double& twist = this->Twists[source.Number];
    twist = std::max(twist, LargestTwist(source.Surface));
  }
  this->Reach = 0.0;
  if (!boxes.empty())
  {
    glm::dvec3 low = boxes.front().Lower;
    glm::dvec3 high = boxes.front().Upper;
    for (const Box& box : boxes)
    {
      low = glm::min(low, box.Lower);
      high = glm::max(high, box.Upper);
    }
    this->Origin = 0.5 * low + 0.5 * high;
    const glm::dvec3 far = high - this->Origin;
    this->Reach = std::max({ far.x, far.y, far.z });
  }
  for (const Box& box : boxes)
  {
    this->AddTriangle(box);
  }
  if (!boxes.empty() && boxes.size() <= MostBoxes / 2)
  {
    this->AddNode(boxes, 0, boxes.size());
  }
}

//------------------------------------------------------------------------------
/** Lists the triangles of a surface; those without area hide nothing. */
void ShadowCasters::ListTriangles(const Source& source, std::vector<Box>& boxes)
{
  for (const LitMesh::Face& face : LitMesh::ListFaces(source.Surface, nullptr))
  {
    const glm::dvec3 a = PointOf(source.Surface, face.Corners[0]);
    const glm::dvec3 b = PointOf(source.Surface, face.Corners[1]);
    const glm::dvec3 c = PointOf(source.Surface, face.Corners[2]);
    if (glm::length(glm::cross(b - a, c - a)) > 0.0)
    {
      boxes.push_back({ glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), boxes.size(),
        { a, b, c }, source.Number });
    }
  }
}

//------------------------------------------------------------------------------
void ShadowCasters::AddTriangle(const Box& box)
{
  const glm::dvec3 a = box.Corners[0] - this->Origin;
  const glm::dvec3 b = box.Corners[1] - this->Origin;
  const glm::dvec3 c = box.Corners[2] - this->Origin;
  const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  Append(this->Triangles, a, box.Number);
  Append(this->Triangles, b, 0.0);
  Append(this->Triangles, c, 0.0);
  Append(this->Triangles, normal, -glm::dot(normal, a));
}

//------------------------------------------------------------------------------
/** Adds the tree of the boxes [first, last). */
void ShadowCasters::AddNode(std::vector<Box>& boxes, std::size_t first, std::size_t last)
{
  glm::dvec3 low = boxes[first].Lower;
  glm::dvec3 high = boxes[first].Upper;
  for (std::size_t i = first + 1; i < last; ++i)
  {
    low = glm::min(low, boxes[i].Lower);
    high = glm::max(high, boxes[i].Upper);
  }
  const bool isLeaf = last - first == 1;
  // A tree of n boxes has 2 n - 1 nodes.
  const std::size_t next = this->Nodes.size() / 8 + 2 * (last - first) - 1;
  Append(this->Nodes, low - this->Origin, static_cast<double>(next));
  Append(this->Nodes, high - this->Origin, isLeaf ? static_cast<double>(boxes[first].Index) : -1.0);
  if (!isLeaf)
  {
    Box* const all = boxes.data();
    const auto middle = static_cast<std::size_t>(
      SplitAtMedian(all + first, all + last, [](const Box& box) { return box.Lower + box.Upper; }) -
      all);
    this->AddNode(boxes, first, middle);
    this->AddNode(boxes, middle, last);
  }
}

//------------------------------------------------------------------------------
std::string ShadowCasters::Upload(vtkOpenGLRenderWindow* window)
{
  if (this->IsUploaded)
  {
    return std::string();
  }
  if (this->Nodes.empty())
  {
    return std::to_string(this->Triangles.size() / 16) + " triangles are more than " +
      std::to_string(MostBoxes / 2);
  }
  std::string error = this->NodeTable.Upload(window, this->Nodes.data(), this->Nodes.size(), 4, 2);
  error = error.empty()
    ? this->TriangleTable.Upload(window, this->Triangles.data(), this->Triangles.size(), 4, 4)
    : error;
  this->IsUploaded = error.empty();
  return error;
}

//------------------------------------------------------------------------------
void ShadowCasters::Activate(vtkShaderProgram* program, int number, const glm::dvec3& origin)
{
  this->NodeTable.Activate(program, "shadowNodes");
  this->TriangleTable.Activate(program, "shadowTriangles");
  const auto twist = this->Twists.find(number);
  program->SetUniformi("shadowNumberOfNodes", static_cast<int>(this->NodeTable.GetNumberOfRows()));
  program->SetUniformi("shadowObject", number);
  // Added to a place of the object, it leads to one of the tables.
  const glm::dvec3 offset = origin - this->Origin;
  const glm::dvec3 far = glm::abs(offset);
  const double reach = this->Reach + std::max({ far.x, far.y, far.z });
  const float between[3] = { static_cast<float>(offset.x), static_cast<float>(offset.y),
    static_cast<float>(offset.z) };
  program->SetUniform3f("shadowOffset", between);
  program->SetUniformf("shadowRounding", static_cast<float>(RoundingShare * reach));
  program->SetUniformf(
    "shadowTwist", static_cast<float>(twist == this->Twists.end() ? 0.0 : twist->second));
}

//------------------------------------------------------------------------------
void ShadowCasters::Deactivate()
{
  this->NodeTable.Deactivate();
  this->TriangleTable.Deactivate();
}

//------------------------------------------------------------------------------
void ShadowCasters::Release(vtkWindow* window)
{
  this->NodeTable.Release(window);
  this->TriangleTable.Release(window);
  this->IsUploaded = false;
}

}
