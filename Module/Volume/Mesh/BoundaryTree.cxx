// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/BoundaryTree.h"

#include "Common/MedianSplit.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstring>

namespace meniscus
{

struct BoundaryTree::Box
{
  glm::vec3 Lower;
  glm::vec3 Upper;
};

struct BoundaryTree::Item : Box
{
  /** Number of the face in the mesh's boundary. */
  std::int32_t Index;

  bool operator<(const Item& other) const { return this->Index < other.Index; }
};

namespace
{

/**
 * Smallest float half extent for which the box around `center` contains [lower, upper] in exact
 * arithmetic.
 */
float HalfExtent(float center, float lower, float upper)
{
  const double half =
    std::max(static_cast<double>(upper) - center, static_cast<double>(center) - lower);
  const float rounded = static_cast<float>(half);
  // The bits of the next larger float are those of a float that is not negative, plus 1. No branch:
  // none predicts the rounding.
  std::uint32_t bits = 0;
  std::memcpy(&bits, &rounded, sizeof(bits));
  bits += rounded < half ? 1 : 0;
  float result = 0.0f;
  std::memcpy(&result, &bits, sizeof(result));
  return result;
}

/** Surface area of a box, times a constant. */
double AreaOf(const glm::vec3& half)
{
  return static_cast<double>(half.x) * half.y + static_cast<double>(half.y) * half.z +
    static_cast<double>(half.z) * half.x;
}

/** Box of a face, as a type with the members Lower and Upper. */
template <typename Box>
void SetBox(const TetrahedralMesh& mesh, const BoundaryFace& face, Box& box)
{
  const glm::vec3 a(mesh.GetPosition(face.Vertices[0]));
  const glm::vec3 b(mesh.GetPosition(face.Vertices[1]));
  const glm::vec3 c(mesh.GetPosition(face.Vertices[2]));
  box.Lower = glm::min(a, glm::min(b, c));
  box.Upper = glm::max(a, glm::max(b, c));
}

}

//------------------------------------------------------------------------------
void BoundaryTree::Build(const TetrahedralMesh& mesh)
{
  this->Nodes.clear();
  this->Faces.clear();
  const auto& boundary = mesh.GetBoundary();
  if (boundary.empty())
  {
    return;
  }
  std::vector<Item> items(boundary.size());
  for (std::size_t f = 0; f < boundary.size(); ++f)
  {
    SetBox(mesh, boundary[f], items[f]);
    items[f].Index = static_cast<std::int32_t>(f);
  }
  this->Nodes.reserve(2 * items.size() - 1);
  this->BuildSubtree(items, 0, items.size());
  this->Faces.reserve(items.size());
  for (const Item& item : items)
  {
    this->Faces.push_back(boundary[item.Index]);
  }
  this->BuiltCost = this->FitBoxes(mesh);
}

//------------------------------------------------------------------------------
/** Adds the nodes of a subtree without their boxes, and sorts its items into the order of leaves.
 */
void BoundaryTree::BuildSubtree(std::vector<Item>& items, std::size_t first, std::size_t last)
{
  const std::size_t node = this->Nodes.size();
  this->Nodes.push_back({ glm::vec3(0.0f), glm::vec3(0.0f), 0, -1 });
  if (last - first == 1)
  {
    this->Nodes[node].Face = static_cast<std::int32_t>(first);
  }
  else
  {
    const auto begin = items.begin();
    const auto half = SplitAtMedian(begin + static_cast<std::ptrdiff_t>(first),
      begin + static_cast<std::ptrdiff_t>(last),
      [](const Item& item) { return item.Lower + item.Upper; });
    const auto middle = static_cast<std::size_t>(half - begin);
    this->BuildSubtree(items, first, middle);
    this->BuildSubtree(items, middle, last);
  }
  this->Nodes[node].Skip = static_cast<std::int32_t>(this->Nodes.size());
}

//------------------------------------------------------------------------------
bool BoundaryTree::Refit(const TetrahedralMesh& mesh)
{
  for (BoundaryFace& face : this->Faces)
  {
    mesh.Orient(face);
  }
  constexpr double mostGrowth = 2.0;
  return this->FitBoxes(mesh) <= mostGrowth * this->BuiltCost;
}

//------------------------------------------------------------------------------
/**
 * Sets the boxes of all nodes. Returns the sum of their areas relative to that of the root, or 0 if
 * the root has none.
 */
double BoundaryTree::FitBoxes(const TetrahedralMesh& mesh)
{
  std::vector<Box> boxes(this->Nodes.size());
  double area = 0.0;
  // Children follow their parents: the first one at once, the second one after its subtree.
  for (std::size_t n = this->Nodes.size(); n-- > 0;)
  {
    Node& node = this->Nodes[n];
    Box& box = boxes[n];
    if (node.Face >= 0)
    {
      SetBox(mesh, this->Faces[node.Face], box);
    }
    else
    {
      const Box& first = boxes[n + 1];
      const Box& second = boxes[this->Nodes[n + 1].Skip];
      box = { glm::min(first.Lower, second.Lower), glm::max(first.Upper, second.Upper) };
    }
    node.Center = 0.5f * (box.Lower + box.Upper);
    for (int axis = 0; axis < 3; ++axis)
    {
      node.Half[axis] = HalfExtent(node.Center[axis], box.Lower[axis], box.Upper[axis]);
    }
    area += AreaOf(node.Half);
  }
  const double whole = this->Nodes.empty() ? 0.0 : AreaOf(this->Nodes.front().Half);
  return whole > 0.0 ? area / whole : 0.0;
}

}
