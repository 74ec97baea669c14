// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/RayWalk.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

// As in Rendering/glsl/vtkTetrahedraRays.glsl, which derives them.
constexpr float GridRadius = 4194304.0f;
constexpr float BoxMargin = 8.0f;

constexpr float BeforeEverything = -1.0e+30f;

}

//------------------------------------------------------------------------------
RayWalk::RayWalk(const RayCastScene& scene)
  : Scene(scene)
  , RowX(scene.Frame.RowX)
  , RowY(scene.Frame.RowY)
  , RowDepth(scene.Frame.RowDepth)
  , U(0.0f)
  , V(0.0f)
  , Origin(0.0f)
  , NearDepth(static_cast<float>(scene.Frame.NearDepth))
{
}

//------------------------------------------------------------------------------
bool RayWalk::SetUpRay(const glm::vec2& pixel)
{
  const RayFrame& frame = this->Scene.Frame;
  const glm::vec2 origin(frame.Origin.At(pixel.x, pixel.y));
  const glm::vec2 slope(frame.Slope.At(pixel.x, pixel.y));
  this->U = this->RowX - slope.x * this->RowDepth;
  this->V = this->RowY - slope.y * this->RowDepth;
  const glm::vec2 scale(GridRadius / glm::length(this->U), GridRadius / glm::length(this->V));
  this->U *= scale.x;
  this->V *= scale.y;
  this->Origin = origin * scale;
  this->LengthPerDepth =
    static_cast<float>(glm::length(frame.ViewToWorld * glm::dvec3(slope.x, slope.y, 1.0)));
  return std::abs(this->Origin.x) <= GridRadius + BoxMargin &&
    std::abs(this->Origin.y) <= GridRadius + BoxMargin;
}

//------------------------------------------------------------------------------
RayWalk::Vertex RayWalk::Project(std::int32_t vertex) const
{
  const glm::vec3& p = this->Scene.Mesh->GetPositions()[vertex];
  return { std::floor(glm::dot(this->U, p) - this->Origin.x + 0.5f),
    std::floor(glm::dot(this->V, p) - this->Origin.y + 0.5f), glm::dot(this->RowDepth, p),
    (*this->Scene.Scalars)[vertex], vertex };
}

//------------------------------------------------------------------------------
bool RayWalk::TurnsLeft(const Vertex& p, const Vertex& q, double area)
{
  if (area != 0.0)
  {
    return area > 0.0;
  }
  if (p.V != q.V)
  {
    return q.V < p.V;
  }
  return p.U != q.U ? q.U > p.U : p.Id < q.Id;
}

//------------------------------------------------------------------------------
void RayWalk::Interpolate(Face& face, float depth, float scalar)
{
  const double total = face.Areas[0] + face.Areas[1] + face.Areas[2];
  face.Depth = depth;
  face.Scalar = scalar;
  if (total > 0.0)
  {
    const float wa = static_cast<float>(face.Areas[1] / total);
    const float wb = static_cast<float>(face.Areas[2] / total);
    const float wc = static_cast<float>(face.Areas[0] / total);
    const Vertex* corner = face.Corners;
    face.Depth = wa * corner[0].Depth + wb * corner[1].Depth + wc * corner[2].Depth;
    face.Scalar = wa * corner[0].Scalar + wb * corner[1].Scalar + wc * corner[2].Scalar;
  }
}

//------------------------------------------------------------------------------
bool RayWalk::Enter(const BoundaryFace& boundary, Face& face) const
{
  face.TurnsLeft = boundary.Outward * this->Scene.Frame.Handedness > 0;
  for (int i = 0; i < 3; ++i)
  {
    face.Corners[i] = this->Project(boundary.Vertices[i]);
  }
  for (int i = 0; i < 3; ++i)
  {
    const Vertex& p = face.Corners[i];
    const Vertex& q = face.Corners[(i + 1) % 3];
    const double area = Area(p, q);
    if (TurnsLeft(p, q, area) != face.TurnsLeft)
    {
      return false;
    }
    face.Areas[i] = std::abs(area);
  }
  // A face without projected area is met at its first vertex.
  Interpolate(face, face.Corners[0].Depth, face.Corners[0].Scalar);
  return true;
}

//------------------------------------------------------------------------------
bool RayWalk::MeetsBox(const BoundaryTree::Node& node) const
{
  return std::abs(glm::dot(this->U, node.Center) - this->Origin.x) <=
    glm::dot(glm::abs(this->U), node.Half) + BoxMargin &&
    std::abs(glm::dot(this->V, node.Center) - this->Origin.y) <=
    glm::dot(glm::abs(this->V), node.Half) + BoxMargin;
}

//------------------------------------------------------------------------------
void RayWalk::CollectEntries(float endDepth)
{
  this->Entries.clear();
  const auto& nodes = this->Scene.Tree->GetNodes();
  Face face;
  for (std::size_t n = 0; n < nodes.size();)
  {
    const BoundaryTree::Node& node = nodes[n];
    const bool hit = this->MeetsBox(node);
    if (hit && node.Face >= 0 && this->Enter(this->Scene.Tree->GetFaces()[node.Face], face) &&
      face.Depth < endDepth)
    {
      this->Entries.push_back({ face.Depth, node.Face });
    }
    n = hit ? n + 1 : static_cast<std::size_t>(node.Skip);
  }
  std::sort(this->Entries.begin(), this->Entries.end());
}

//------------------------------------------------------------------------------
std::int32_t RayWalk::Step(std::int32_t cellFace, Face& face) const
{
  const TetrahedralMesh::Cell& cell = this->Scene.Mesh->GetCells()[cellFace / 4];
  const int entered = cellFace % 4;
  const Vertex x = this->Project(cell.Vertices[entered]);
  double areas[3];
  bool with[3];
  for (int i = 0; i < 3; ++i)
  {
    areas[i] = Area(x, face.Corners[i]);
    with[i] = TurnsLeft(x, face.Corners[i], areas[i]) == face.TurnsLeft;
  }
  // The ray leaves between the consecutive edges xp, xq of which it is left of one, right of the
  // other; the third corner drops out.
  const int dropped = with[0] && !with[1] ? 2 : (with[1] && !with[2] ? 0 : 1);
  const std::int32_t link = cell.Links[dropped + (dropped >= entered ? 1 : 0)];

  // The exit face, ascending: x in place of the dropped vertex, moved to its rank.
  const int place = entered - (dropped < entered ? 1 : 0);
  const int p = dropped == 0 ? 1 : 0;
  const int q = dropped == 2 ? 1 : 2;
  const double areaPQ = face.Areas[dropped == 0 ? 1 : (dropped == 1 ? 2 : 0)];
  const double areaP = std::abs(areas[p]);
  const double areaQ = std::abs(areas[q]);
  const Vertex vertexP = face.Corners[p];
  const Vertex vertexQ = face.Corners[q];
  face.Corners[place] = x;
  face.Corners[place == 0 ? 1 : 0] = vertexP;
  face.Corners[place == 2 ? 1 : 2] = vertexQ;
  // Edges of the new triangle, in the order ab, bc, ca.
  face.Areas[place == 2 ? 0 : (place == 0 ? 1 : 2)] = areaPQ;
  face.Areas[place == 2 ? 2 : 0] = areaP;
  face.Areas[place == 0 ? 2 : 1] = areaQ;
  face.TurnsLeft = face.TurnsLeft != ((place - dropped) % 2 != 0);
  // A face without projected area keeps depth and scalar.
  Interpolate(face, face.Depth, face.Scalar);
  return link;
}

//------------------------------------------------------------------------------
void RayWalk::Advance(const Face& from, const Face& to, float endDepth, RayIntegral& integral)
{
  // What lies before the largest depth reached has been passed already and does not count again.
  const float start = std::max(this->DepthNow, this->NearDepth);
  const float end = std::min(to.Depth, endDepth);
  if (end > start)
  {
    const float perDepth = (to.Scalar - from.Scalar) / (to.Depth - from.Depth);
    const float scalar0 =
      start > from.Depth ? from.Scalar + (start - from.Depth) * perDepth : from.Scalar;
    const float scalar1 = end < to.Depth ? from.Scalar + (end - from.Depth) * perDepth : to.Scalar;
    integral.AddSegment(scalar0, scalar1, (end - start) * this->LengthPerDepth);
  }
  this->DepthNow = std::max(this->DepthNow, to.Depth);
}

//------------------------------------------------------------------------------
bool RayWalk::Walk(
  std::int32_t cellFace, Face& face, float endDepth, RayIntegral& integral, std::int64_t& steps)
{
  // A ray crosses a cell once through each of its 4 faces, in 2 orientations, at the most.
  const std::int64_t limit = steps + 8 * this->Scene.Mesh->GetNumberOfCells();
  while (steps < limit)
  {
    const Face from = face;
    cellFace = this->Step(cellFace, face);
    ++steps;
    this->Advance(from, face, endDepth, integral);
    if (cellFace < 0 || this->DepthNow >= endDepth || integral.IsTerminated())
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
RayResult RayWalk::Cast(const glm::vec2& pixel, float endDepth)
{
  RayResult result;
  if (!this->SetUpRay(pixel))
  {
    return result;
  }
  RayIntegral integral(*this->Scene.Intervals, this->Scene.TerminationTransmittance);
  this->CollectEntries(endDepth);
  this->DepthNow = BeforeEverything;
  for (const Entry& entry : this->Entries)
  {
    if (integral.IsTerminated() || this->DepthNow >= endDepth)
    {
      break;
    }
    const BoundaryFace& boundary = this->Scene.Tree->GetFaces()[entry.Face];
    Face face;
    this->Enter(boundary, face);
    this->DepthNow = std::max(this->DepthNow, entry.Depth);
    if (!this->Walk(boundary.CellFace, face, endDepth, integral, result.Steps))
    {
      result.Lost = true;
    }
  }
  result.Color = glm::vec4(integral.GetColor(), 1.0f - integral.GetTransmittance());
  return result;
}

}
