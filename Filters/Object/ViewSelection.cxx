// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Object/ViewSelection.h"

#include "vtkCamera.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

class Selector
{
public:
  Selector(const RefractionScene& scene, vtkIdType cells, const std::vector<double>& points)
    : Scene(scene)
    , Points(points)
    , IsUsed(points.size() / 3, false)
  {
    this->Selection.isActive = true;
    this->Selection.cells.assign(static_cast<std::size_t>(cells), false);
    this->Selection.chunks.assign(
      (this->IsUsed.size() + ObjectImages::Chunk - 1) / ObjectImages::Chunk, false);
  }

  void Add(const ObjectTopology::Cells& cells)
  {
    for (std::size_t i = 0; i < cells.GetCount(); ++i)
    {
      const std::int64_t* first = cells.connectivity.data() + cells.offsets[i];
      const std::int64_t* last = cells.connectivity.data() + cells.offsets[i + 1];
      if (this->Select(first, last))
      {
        this->Selection.cells[static_cast<std::size_t>(cells.ids[i])] = true;
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
      this->Selection.culledPoints += !this->Selection.HasPoint(i);
    }
    this->Selection.culledCells = static_cast<vtkIdType>(
      std::count(this->Selection.cells.begin(), this->Selection.cells.end(), false));
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
    // What cannot be solved is to be counted, not culled.
    if (isFinite && !this->Scene.MayBeInView(low, high))
    {
      return false;
    }
    for (const std::int64_t* id = first; id != last; ++id)
    {
      this->Selection.chunks[static_cast<std::size_t>(*id) / ObjectImages::Chunk] = true;
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
    if (selection.HasCell(cells.ids[i]))
    {
      result.connectivity.insert(result.connectivity.end(),
        cells.connectivity.begin() + cells.offsets[i],
        cells.connectivity.begin() + cells.offsets[i + 1]);
      result.offsets.push_back(static_cast<std::int64_t>(result.connectivity.size()));
      result.ids.push_back(cells.ids[i]);
    }
  }
  return result;
}

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
  selector.Add(topology.vertices);
  selector.Add(topology.lines);
  selector.Add(topology.polygons);
  ViewSelection selection = selector.Finish();
  selection.culledCells -= topology.brokenCells; // counted as such
  return selection;
}

//------------------------------------------------------------------------------
ObjectTopology SelectCells(const ObjectTopology& topology, const ViewSelection& selection)
{
  ObjectTopology result;
  result.vertices = SelectFrom(topology.vertices, selection);
  result.lines = SelectFrom(topology.lines, selection);
  result.polygons = SelectFrom(topology.polygons, selection);
  result.brokenCells = topology.brokenCells;
  return result;
}

}
