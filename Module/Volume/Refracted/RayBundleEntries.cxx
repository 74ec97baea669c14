// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RayBundleEntries.h"

#include "Common/BlockLoop.h"
#include "Simd/InstructionSets.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Packet/Kernels/PacketKernels.h"
#include "Volume/Rays/ExactEdgeTest.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace meniscus
{
namespace
{

/**
 * Distance, in grid units, by which a line may miss a face and enter by it nevertheless: half a
 * unit of rounding of a vertex across the ray and half along it, and FixedPointRays::RoundingOfRay
 * for the ray.
 */
constexpr double GridMargin = 324.0;
static_assert(
  0.5 + 0.5 + FixedPointRays::RoundingOfRay < GridMargin, "rounding of vertices and rays");

}

//------------------------------------------------------------------------------
bool HasInvertedCells(const TetrahedralMesh& mesh, const RangeLoop& loop)
{
  const std::vector<glm::ivec3>& places = mesh.GetFixedPositions();
  std::atomic<bool> found{ false };
  ForEachBlock(static_cast<std::size_t>(mesh.GetNumberOfCells()), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last && !found; ++c)
      {
        const auto& ids = mesh.GetCells()[c].Vertices;
        const auto edge = [&](std::size_t k)
        {
          return glm::dvec3(places[static_cast<std::size_t>(ids[k])]) -
            glm::dvec3(places[static_cast<std::size_t>(ids[0])]);
        };
        const glm::dvec3 edges[3] = { edge(1), edge(2), edge(3) };
        const double volume = glm::dot(edges[0], glm::cross(edges[1], edges[2]));
        // Vertices are rounded by half a unit per axis, so the error of an edge is up to sqrt(3)
        // units, and the error of the volume is that times the area of each pair of edges.
        const double lengths[3] = { glm::length(edges[0]), glm::length(edges[1]),
          glm::length(edges[2]) };
        const double rounding = std::sqrt(3.0) *
          (lengths[0] * lengths[1] + lengths[1] * lengths[2] + lengths[2] * lengths[0]);
        const bool positive = mesh.GetFace(static_cast<std::int64_t>(c), 0).Outward > 0;
        if ((positive ? volume : -volume) < -rounding)
        {
          found = true;
        }
      }
    });
  return found;
}

//------------------------------------------------------------------------------
BoundsInFrame BoxOf(const BoundaryTree& tree, const RayFrame& view)
{
  BoundsInFrame box;
  if (!tree.GetNodes().empty())
  {
    const BoundaryTree::Node& root = tree.GetNodes().front();
    const glm::dmat3 toFrame = glm::transpose(glm::dmat3(view.RowX, view.RowY, view.RowDepth));
    box.Center = toFrame * glm::dvec3(root.Center);
    box.HalfEdges =
      toFrame * glm::dmat3(root.Half.x, 0.0, 0.0, 0.0, root.Half.y, 0.0, 0.0, 0.0, root.Half.z);
  }
  return box;
}

/**
 * Lines between two depths. At both depths, and therefore between them, they are within a
 * rectangle.
 */
struct RayBundleEntries::Bundle
{
  double First;
  double Last;
  glm::dvec2 Lower[2];
  glm::dvec2 Upper[2];
  /** Slopes differ from the mean by at most the spread. */
  glm::dvec2 MeanSlope;
  glm::dvec2 SlopeSpread;

  glm::dvec2 LowerAt(double depth) const { return this->Between(this->Lower, depth); }
  glm::dvec2 UpperAt(double depth) const { return this->Between(this->Upper, depth); }
  glm::dvec2 Between(const glm::dvec2 (&ends)[2], double depth) const
  {
    const double share =
      this->Last > this->First ? (depth - this->First) / (this->Last - this->First) : 0.0;
    return ends[0] + share * (ends[1] - ends[0]);
  }
};

//------------------------------------------------------------------------------
RayBundleEntries::RayBundleEntries(const TetrahedralMesh& mesh, const BoundaryTree& tree,
  const RefractionFrame& frame, InstructionSet set)
  : Mesh(mesh)
  , Tree(tree)
  , Frame(frame)
  , Set(set)
{
  const RayFrame& rows = frame.Rays.GetFrame();
  this->ToFrame = glm::transpose(glm::dmat3(rows.RowX, rows.RowY, rows.RowDepth));
  this->Reach =
    glm::dmat3(glm::abs(this->ToFrame[0]), glm::abs(this->ToFrame[1]), glm::abs(this->ToFrame[2]));
}

//------------------------------------------------------------------------------
/** The face, counter-clockwise about the lines that enter by it. */
PacketFace RayBundleEntries::SeenBy(const BoundaryFace& face) const
{
  const bool counterClockwise = face.Outward * this->Frame.Rays.GetFrame().Handedness > 0;
  return { { face.Vertices[counterClockwise ? 0 : 1], face.Vertices[counterClockwise ? 1 : 0],
             face.Vertices[2] },
    face.CellFace };
}

//------------------------------------------------------------------------------
/**
 * False if the orientation of the face shows that no line of the bundle enters by it. Twice its
 * projected area about a line is affine in the slopes; rounding of vertices and rays moves its
 * corners by GridMargin.
 */
bool RayBundleEntries::MayFace(const PacketFace& face, const Bundle& bundle) const
{
  const auto placeOf = [this, &face](int k)
  {
    const auto& place = this->Frame.Vertices[static_cast<std::size_t>(face.Vertices[k])].Place;
    return glm::dvec3(place[0], place[1], place[2]);
  };
  const glm::dvec3 corner = placeOf(0);
  // Unit of depth over unit of the grid across.
  const glm::dvec3 scale(
    1.0, 1.0, 1.0 / PacketVertex::GridPerDepth / this->Frame.Rays.GetGridUnit());
  const glm::dvec3 first = scale * (placeOf(1) - corner);
  const glm::dvec3 second = scale * (placeOf(2) - corner);
  const glm::dvec3 normal = glm::cross(first, second);
  const glm::dvec2 across(normal);
  const double area = normal.z + glm::dot(across, bundle.MeanSlope);
  const double spread = glm::dot(glm::abs(across), bundle.SlopeSpread);
  // Both ends of an edge have an error of GridMargin, in all sqrt(2) times 2 of it. About a line
  // with slopes within 1, an edge is at most sqrt(3) times as long.
  constexpr double offset = 2.83 * GridMargin;
  const double edges = 1.74 * (glm::length(first) + glm::length(second));
  return area + spread > -offset * (edges + offset);
}

//------------------------------------------------------------------------------
void RayBundleEntries::CollectFaces(const Bundle& bundle, std::vector<PacketFace>& faces) const
{
  faces.clear();
  const double margin = GridMargin * this->Frame.Rays.GetGridUnit();
  const std::vector<BoundaryTree::Node>& nodes = this->Tree.GetNodes();
  std::size_t at = 0;
  while (at < nodes.size())
  {
    const BoundaryTree::Node& node = nodes[at];
    const glm::dvec3 center = this->ToFrame * glm::dvec3(node.Center);
    const glm::dvec3 half = this->Reach * glm::dvec3(node.Half) + margin;
    const double first = std::max(center.z - half.z, bundle.First);
    const double last = std::min(center.z + half.z, bundle.Last);
    bool meets = first <= last;
    if (meets)
    {
      const glm::dvec2 lower = glm::min(bundle.LowerAt(first), bundle.LowerAt(last));
      const glm::dvec2 upper = glm::max(bundle.UpperAt(first), bundle.UpperAt(last));
      meets = center.x + half.x >= lower.x && center.x - half.x <= upper.x &&
        center.y + half.y >= lower.y && center.y - half.y <= upper.y;
    }
    if (meets && node.Face >= 0)
    {
      const PacketFace face =
        this->SeenBy(this->Tree.GetFaces()[static_cast<std::size_t>(node.Face)]);
      if (this->MayFace(face, bundle))
      {
        faces.push_back(face);
      }
    }
    at = meets ? at + 1 : static_cast<std::size_t>(node.Skip);
  }
}

//------------------------------------------------------------------------------
void RayBundleEntries::Collect(const std::vector<Line>& lines,
  const std::vector<std::int32_t>& numbers, Workspace& workspace, std::vector<Hit>& hits) const
{
  if (numbers.empty())
  {
    return;
  }
  const double extent = this->Frame.Extent;
  Bundle bundle{ extent, extent, { glm::dvec2(1e30), glm::dvec2(1e30) },
    { glm::dvec2(-1e30), glm::dvec2(-1e30) }, glm::dvec2(0.0), glm::dvec2(0.0) };
  glm::dvec2 least(1e30);
  glm::dvec2 most(-1e30);
  workspace.Rays.clear();
  for (const std::int32_t number : numbers)
  {
    const Line& line = lines[static_cast<std::size_t>(number)];
    bundle.First = std::min(bundle.First, std::max(line.From, -extent));
    least = glm::min(least, line.Of.Slope);
    most = glm::max(most, line.Of.Slope);
    workspace.Rays.push_back(line.Ray);
  }
  bundle.MeanSlope = 0.5 * (least + most);
  bundle.SlopeSpread = 0.5 * (most - least);
  for (const std::int32_t number : numbers)
  {
    const FrameLine& line = lines[static_cast<std::size_t>(number)].Of;
    for (int end = 0; end < 2; ++end)
    {
      const glm::dvec2 at = line.Origin + (end == 0 ? bundle.First : bundle.Last) * line.Slope;
      bundle.Lower[end] = glm::min(bundle.Lower[end], at);
      bundle.Upper[end] = glm::max(bundle.Upper[end], at);
    }
  }
  this->CollectFaces(bundle, workspace.Faces);
  workspace.Entered.resize(workspace.Faces.size());
  PacketFaceJob job;
  job.Vertices = this->Frame.Vertices.data();
  job.Faces = workspace.Faces.data();
  job.NumberOfFaces = static_cast<std::int32_t>(workspace.Faces.size());
  job.Rays = workspace.Rays.data();
  job.NumberOfRays = static_cast<std::int32_t>(numbers.size());
  job.Pivot = this->Frame.Rays.GetPivot();
  job.RaysAreFine = this->Frame.Rays.AreFine();
  job.Entered = workspace.Entered.data();
  FindEntered(job, this->Set);

  for (std::size_t f = 0; f < workspace.Faces.size(); ++f)
  {
    const PacketFace& face = workspace.Faces[f];
    for (std::size_t i = 0; i < numbers.size() && workspace.Entered[f] >> i != 0; ++i)
    {
      PacketEntry entry;
      if ((workspace.Entered[f] >> i & 1u) != 0 && this->Enters(face, workspace.Rays[i], entry) &&
        this->Frame.Rays.ToFrame(entry.Depth) >= lines[static_cast<std::size_t>(numbers[i])].From)
      {
        hits.push_back({ numbers[i], entry });
      }
    }
  }
}

//------------------------------------------------------------------------------
/** Tests whether the ray enters by the face and computes the entry. */
bool RayBundleEntries::Enters(
  const PacketFace& face, const PacketRay& ray, PacketEntry& entry) const
{
  using Test = ExactEdgeTest<RayBundleEntries>;
  const auto cornerOf = [&](int k)
  {
    const std::int32_t vertex = face.Vertices[k];
    return Test::AboutRay(this->Frame.Vertices[static_cast<std::size_t>(vertex)], vertex, ray,
      this->Frame.Rays.GetPivot(), this->Frame.Rays.AreFine());
  };
  const auto found = ExactEntry<RayBundleEntries>::Of(cornerOf(0), cornerOf(1), cornerOf(2));
  entry = { { face.Vertices[0], face.Vertices[1], face.Vertices[2] }, face.CellFace, found.Depth };
  return found.Entered;
}

//------------------------------------------------------------------------------
bool RayBundleEntries::EntersCell(
  std::int64_t cell, const PacketRay& ray, double before, PacketEntry& entry) const
{
  for (int k = 0; k < 4; ++k)
  {
    const PacketFace face = this->SeenBy(this->Mesh.GetFace(cell, k));
    if (this->Enters(face, ray, entry) && this->Frame.Rays.ToFrame(entry.Depth) <= before)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool RayBundleEntries::FindEntryNear(
  std::int32_t cellFace, const PacketRay& ray, double before, PacketEntry& entry) const
{
  const std::int64_t behind = cellFace / 4;
  const std::int32_t back =
    this->Mesh.GetCells()[static_cast<std::size_t>(behind)].Links[cellFace % 4];
  const std::int64_t inFront = back / 4;
  if (back >= 0 && this->EntersCell(inFront, ray, before, entry))
  {
    return true;
  }
  if (this->EntersCell(behind, ray, before, entry))
  {
    return true;
  }
  for (int k = 0; back >= 0 && k < 4; ++k)
  {
    const std::int32_t link = this->Mesh.GetCells()[static_cast<std::size_t>(inFront)].Links[k];
    if (link >= 0 && this->EntersCell(link / 4, ray, before, entry))
    {
      return true;
    }
  }
  return false;
}

}
