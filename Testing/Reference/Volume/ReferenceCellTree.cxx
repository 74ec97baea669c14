// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceCellTree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus::reference
{

namespace
{

constexpr std::int32_t CellsPerLeaf = 3;

// Boxes are padded by more than the widening of the half-spaces (1e-13 of the diagonal).
constexpr double BoxPadding = 1e-12;

// Replaces a direction component of 0: so small that the ray stays in its slab.
constexpr double SmallestComponent = 1e-300;

struct RayFrame
{
  Vector3 Origin;
  Vector3 Inverse;
  double Begin;
  double End;
};

bool MeetsBox(const RayFrame& ray, const std::array<double, 6>& box)
{
  double begin = ray.Begin;
  double end = ray.End;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = (box[axis] - ray.Origin[axis]) * ray.Inverse[axis];
    const double high = (box[axis + 3] - ray.Origin[axis]) * ray.Inverse[axis];
    begin = std::max(begin, std::min(low, high));
    end = std::min(end, std::max(low, high));
  }
  return begin <= end;
}

} // anonymous namespace

//------------------------------------------------------------------------------
ReferenceCellTree::ReferenceCellTree(const ReferenceMesh& mesh)
  : Padding(BoxPadding * mesh.GetDiagonal())
{
  for (std::size_t id = 0; id < mesh.GetNumberOfCells(); ++id)
  {
    if (mesh.GetKind(id) == ReferenceMesh::CellKind::Contributing ||
      mesh.GetKind(id) == ReferenceMesh::CellKind::Inverted)
    {
      this->Order.push_back(static_cast<std::int64_t>(id));
    }
  }
  std::vector<Vector3> centroids(mesh.GetNumberOfCells());
  for (const std::int64_t id : this->Order)
  {
    const std::int64_t* ids = mesh.GetCell(static_cast<std::size_t>(id));
    for (int axis = 0; axis < 3; ++axis)
    {
      centroids[id][axis] = 0.25 *
        (mesh.GetPoint(ids[0])[axis] + mesh.GetPoint(ids[1])[axis] + mesh.GetPoint(ids[2])[axis] +
          mesh.GetPoint(ids[3])[axis]);
    }
  }
  if (!this->Order.empty())
  {
    this->Nodes.reserve(this->Order.size());
    this->Build(mesh, centroids, 0, static_cast<std::int32_t>(this->Order.size()));
  }
}

//------------------------------------------------------------------------------
std::array<double, 6> ReferenceCellTree::BoxOf(
  const ReferenceMesh& mesh, std::int32_t begin, std::int32_t end) const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 6> box{ infinity, infinity, infinity, -infinity, -infinity, -infinity };
  for (std::int32_t i = begin; i < end; ++i)
  {
    const std::int64_t* ids = mesh.GetCell(static_cast<std::size_t>(this->Order[i]));
    for (int corner = 0; corner < 4; ++corner)
    {
      const double* x = mesh.GetPoint(ids[corner]);
      for (int axis = 0; axis < 3; ++axis)
      {
        box[axis] = std::min(box[axis], x[axis] - this->Padding);
        box[axis + 3] = std::max(box[axis + 3], x[axis] + this->Padding);
      }
    }
  }
  return box;
}

//------------------------------------------------------------------------------
// Median split along the longest axis: balanced, so the recursion is no deeper than log2(cells).
void ReferenceCellTree::Build(const ReferenceMesh& mesh, const std::vector<Vector3>& centroids,
  std::int32_t begin, std::int32_t end)
{
  const std::size_t self = this->Nodes.size();
  this->Nodes.push_back(Node{ this->BoxOf(mesh, begin, end), begin, end - begin });
  if (end - begin <= CellsPerLeaf)
  {
    return;
  }
  const std::array<double, 6>& box = this->Nodes[self].Box;
  int axis = 0;
  for (int other = 1; other < 3; ++other)
  {
    axis = box[other + 3] - box[other] > box[axis + 3] - box[axis] ? other : axis;
  }
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(this->Order.begin() + begin, this->Order.begin() + middle,
    this->Order.begin() + end,
    [&centroids, axis](std::int64_t a, std::int64_t b)
    { return centroids[a][axis] < centroids[b][axis]; });
  this->Build(mesh, centroids, begin, middle);
  this->Nodes[self].First = static_cast<std::int32_t>(this->Nodes.size());
  this->Nodes[self].Count = 0;
  this->Build(mesh, centroids, middle, end);
}

//------------------------------------------------------------------------------
void ReferenceCellTree::Candidates(const Ray& ray, std::vector<std::int64_t>& cells) const
{
  if (this->Nodes.empty())
  {
    return;
  }
  RayFrame frame{ ray.Origin, {}, ray.Begin, ray.End };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double component = ray.Direction[axis];
    frame.Inverse[axis] =
      1.0 / (std::fabs(component) < SmallestComponent ? SmallestComponent : component);
  }
  std::int32_t stack[64]; // the tree is balanced: its depth is at most 31 for 32-bit indices
  int top = 0;
  stack[top++] = 0;
  while (top > 0)
  {
    const std::int32_t index = stack[--top];
    const Node& node = this->Nodes[index];
    if (!MeetsBox(frame, node.Box))
    {
      continue;
    }
    if (node.Count > 0)
    {
      cells.insert(cells.end(), this->Order.begin() + node.First,
        this->Order.begin() + node.First + node.Count);
      continue;
    }
    stack[top++] = node.First;
    stack[top++] = index + 1;
  }
}

} // namespace meniscus::reference
