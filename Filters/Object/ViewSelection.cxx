// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Object/ViewSelection.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkMath.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// Distance of the eye of a parallel camera, in sizes of the surfaces. Sight rays are parallel up to
// its inverse, a hundredth of a pixel in a picture of a thousand; the rounding of coordinates grows
// with it, to 1e-11 sizes.
constexpr double FarAway = 1e5;

// View angle at which a degree is the same part of a perspective and of a parallel picture: VTK's
// default.
constexpr double ViewAngle = 30.0;

class Selector
{
public:
  Selector(const RefractionScene& scene, vtkIdType cells, const std::vector<double>& points)
    : Scene(scene)
    , Points(points)
    , IsUsed(points.size() / 3, false)
  {
    this->Selection.IsActive = true;
    this->Selection.Cells.assign(static_cast<std::size_t>(cells), false);
    this->Selection.Chunks.assign(
      (this->IsUsed.size() + CellImages::Chunk - 1) / ObjectImages::Chunk, false);
  }

  void Add(const ObjectTopology::Cells& cells)
  {
    for (std::size_t i = 0; i < cells.GetCount(); ++i)
    {
      const std::int64_t* first = cells.Connectivity.data() + cells.Offsets[i];
      const std::int64_t* last = cells.Connectivity.data() + cells.Offsets[i + 1];
      if (this->Select(first, last))
      {
        this->Selection.Cells[static_cast<std::size_t>(cells.Ids[i])] = true;
      }
    }
  }

  ViewSelection Finish()
  {
    for (std::size_t i = 0; i < this->IsUsed.size(); ++i)
    {
      const auto id = static_cast<std::int64_t>(i);
      if (!this->IsUsed[i])
      {
        this->Select(&id, &id + 1);
      }
    }
    for (std::size_t i = 0; i < this->IsUsed.size(); ++i)
    {
      this->Selection.CulledPoints += !this->Selection.HasPoint(i);
    }
    this->Selection.CulledCells = static_cast<vtkIdType>(
      std::count(this->Selection.Cells.begin(), this->Selection.Cells.end(), false));
    return std::move(this->Selection);
  }

private:
  bool Select(const std::int64_t* first, const std::int64_t* last)
  {
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(std::numeric_limits<double>::lowest());
    bool isFinite = true;
    for (const std::int64_t* id = first; id != last; ++id)
    {
      this->IsUsed[static_cast<std::size_t>(*id)] = true;
      const double* p = this->Points.data() + 3 * *id;
      isFinite = isFinite && std::isfinite(p[0] + p[1] + p[2]);
      low = glm::min(low, glm::dvec3(p[0], p[1], p[2]));
      high = glm::max(high, glm::dvec3(p[0], p[1], p[2]));
    }
    // Points that cannot be solved have to be counted, so they are not culled.
    if (isFinite && !this->Scene.MayBeInView(low, high))
    {
      return false;
    }
    for (const std::int64_t* id = first; id != last; ++id)
    {
      this->Selection.Chunks[static_cast<std::size_t>(*id) / CellImages::Chunk] = true;
    }
    return true;
  }

  const RefractionScene& Scene;
  const std::vector<double>& Points;
  std::vector<bool> IsUsed;
  ViewSelection Selection;
};

ObjectTopology::Cells SelectFrom(const ObjectTopology::Cells& cells, const ViewSelection& selection)
{
  ObjectTopology::Cells result;
  for (std::size_t i = 0; i < cells.GetCount(); ++i)
  {
    if (selection.HasCell(cells.Ids[i]))
    {
      result.Connectivity.insert(result.Connectivity.end(),
        cells.Connectivity.begin() + cells.Offsets[i],
        cells.Connectivity.begin() + cells.Offsets[i + 1]);
      result.Offsets.push_back(static_cast<std::int64_t>(result.Connectivity.size()));
      result.Ids.push_back(cells.Ids[i]);
    }
  }
  return result;
}

}

//------------------------------------------------------------------------------
CameraEye FindEye(vtkCamera* camera, const vtkBoundingBox& bounds)
{
  CameraEye eye;
  camera->GetPosition(&eye.Position.x);
  eye.Degree = vtkMath::RadiansFromDegrees(1.0);
  const bool hasSize = bounds.IsValid() && bounds.GetDiagonalLength() > 0.0;
  if (camera->GetParallelProjection() && hasSize)
  {
    const double distance = FarAway * bounds.GetDiagonalLength();
    glm::dvec3 center;
    glm::dvec3 direction;
    bounds.GetCenter(&center.x);
    camera->GetDirectionOfProjection(&direction.x);
    eye.Position = center - distance * direction;
    eye.Degree = 2.0 * camera->GetParallelScale() / ViewAngle / distance;
  }
  return eye;
}

//------------------------------------------------------------------------------
std::vector<ViewPlane> FindViewPlanes(vtkCamera* camera, double aspect)
{
  double all[24]; // left, right, bottom, top, and two that depend on the clipping range
  camera->GetFrustumPlanes(aspect > 0.0 ? aspect : 1.0, all);
  const bool isWide = camera->GetUseHorizontalViewAngle() != 0;
  std::vector<ViewPlane> planes;
  for (int i = 0; i < 4; ++i)
  {
    if (aspect > 0.0 || (i < 2) == isWide)
    {
      const glm::dvec3 normal(all[4 * i], all[4 * i + 1], all[4 * i + 2]);
      const double length = glm::length(normal);
      planes.push_back({ normal / length, all[4 * i + 3] / length });
    }
  }
  glm::dvec3 eye;
  glm::dvec3 ahead;
  camera->GetPosition(&eye.x);
  camera->GetDirectionOfProjection(&ahead.x);
  planes.push_back({ ahead, -glm::dot(ahead, eye) });
  return planes;
}

//------------------------------------------------------------------------------
ViewSelection SelectInView(const RefractionScene& scene, const ObjectTopology& topology,
  vtkIdType numberOfCells, const std::vector<double>& points)
{
  Selector selector(scene, numberOfCells, points);
  selector.Add(topology.Vertices);
  selector.Add(topology.Lines);
  selector.Add(topology.Polygons);
  ViewSelection selection = selector.Finish();
  selection.CulledCells -= topology.BrokenCells; // these are counted separately
  return selection;
}

//------------------------------------------------------------------------------
ObjectTopology SelectCells(const ObjectTopology& topology, const ViewSelection& selection)
{
  ObjectTopology result;
  result.Vertices = SelectFrom(topology.Vertices, selection);
  result.Lines = SelectFrom(topology.Lines, selection);
  result.Polygons = SelectFrom(topology.Polygons, selection);
  result.BrokenCells = topology.BrokenCells;
  return result;
}

}
