// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Entries/BoundaryRaster.h"

#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/ExactEdgeTest.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

constexpr double Margin = ProjectedFaces::Margin;

/** A range of pixels in a row. */
struct PixelSpan
{
  int First;
  int Last; // exclusive
};

/**
 * Part of a row of `count` pixels from `first` in which no edge is below -Margin, give or take a
 * little.
 * @param reciprocals 1 over the change of each edge per column; 0 if there is no change.
 */
PixelSpan SpanOf(
  const glm::dvec3 (&edges)[3], const double (&reciprocals)[3], const glm::dvec2& first, int count)
{
  double begin = 0.0;
  double end = count;
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3& edge = edges[k];
    const double excess = edge[0] + first.x * edge[1] + first.y * edge[2] + Margin;
    if (edge[1] != 0.0)
    {
      const double root = -excess * reciprocals[k];
      begin = edge[1] > 0.0 ? std::max(begin, root - 1.0) : begin;
      end = edge[1] < 0.0 ? std::min(end, root + 2.0) : end;
    }
    else if (excess < 0.0)
    {
      return { 0, 0 };
    }
  }
  return begin < end ? PixelSpan{ static_cast<int>(begin), static_cast<int>(end) }
                     : PixelSpan{ 0, 0 };
}

}

//------------------------------------------------------------------------------
void BoundaryRaster::Build(const std::vector<PacketVertex>& vertices,
  const std::vector<BoundaryFace>& faces, const FixedPointRays& rays)
{
  this->Faces.Set(vertices, faces, rays);
  this->Columns = (rays.GetWidth() + TileSize - 1) / TileSize;
  this->Rows = (rays.GetHeight() + TileSize - 1) / TileSize;

  this->Boxes.resize(faces.size());
  this->TileBegin.assign(this->GetNumberOfTiles() + 1, 0);
  const auto forTilesOf = [this](const PixelBox& box, const auto& body)
  {
    if (box.IsEmpty())
    {
      return;
    }
    for (int row = box.Bottom / TileSize; row <= (box.Top - 1) / TileSize; ++row)
    {
      for (int column = box.Left / TileSize; column <= (box.Right - 1) / TileSize; ++column)
      {
        body(row * this->Columns + column);
      }
    }
  };
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    const auto index = static_cast<std::int32_t>(f);
    this->Boxes[f] = this->Faces.BoundPixels(this->Faces.Project(index)).Box;
    forTilesOf(this->Boxes[f], [this](int tile) { ++this->TileBegin[tile + 1]; });
  }
  for (int tile = 0; tile < this->GetNumberOfTiles(); ++tile)
  {
    this->TileBegin[tile + 1] += this->TileBegin[tile];
  }
  this->FaceOfSlot.resize(this->TileBegin.back());
  std::vector<std::int32_t> next(this->TileBegin.begin(), this->TileBegin.end() - 1);
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    forTilesOf(this->Boxes[f],
      [&](int tile) { this->FaceOfSlot[next[tile]++] = static_cast<std::int32_t>(f); });
  }
}

//------------------------------------------------------------------------------
ProjectedFaces::PixelBox BoundaryRaster::BoxOfTile(int tile) const
{
  const int left = tile % this->Columns * TileSize;
  const int bottom = tile / this->Columns * TileSize;
  return { left, std::min(left + TileSize, this->GetRays().GetWidth()), bottom,
    std::min(bottom + TileSize, this->GetRays().GetHeight()) };
}

//------------------------------------------------------------------------------
double BoundaryRaster::NearestDepth(int tile) const
{
  double nearest = std::numeric_limits<double>::infinity();
  for (std::int32_t slot = this->TileBegin[tile]; slot < this->TileBegin[tile + 1]; ++slot)
  {
    nearest = std::min(nearest, this->Faces.GetNearestDepth(this->FaceOfSlot[slot]));
  }
  return nearest;
}

//------------------------------------------------------------------------------
bool BoundaryRaster::EntersExactly(
  const ProjectedFaces::Face& face, const glm::ivec2& pixel, double (&areas)[3]) const
{
  const glm::dvec2 center = this->GetRays().FromCenter(pixel.x, pixel.y);
  const glm::dvec2 offset = glm::abs(this->GetRays().GetOffset().At(center.x, center.y));
  if (!(offset.x <= FixedPointRays::LargestOffset) || !(offset.y <= FixedPointRays::LargestOffset))
  {
    return false; // too far away to meet the mesh
  }
  const PacketRay ray = this->GetRays().RayOf(pixel.x, pixel.y);
  using Grid = ExactEdgeTest<BoundaryRaster>;
  std::int32_t grid[3][3];
  for (int k = 0; k < 3; ++k)
  {
    const std::int32_t(&place)[3] = this->Faces.GetVertex(face.Ids[k]).Place;
    for (int axis = 0; axis < 2; ++axis)
    {
      grid[k][axis] = Grid::AboutRay(place[axis], place[2], ray.Slope[axis], ray.Offset[axis]);
    }
    grid[k][2] = face.Ids[k];
  }
  for (int k = 0; k < 3; ++k)
  {
    std::int64_t area;
    if (!Grid::TurnsLeft(grid[k], grid[(k + 1) % 3], area))
    {
      return false;
    }
    areas[k] = static_cast<double>(area);
  }
  return true;
}

//------------------------------------------------------------------------------
/**
 * Depth at which the ray meets the face; a face without projected area is met at its first vertex.
 */
double BoundaryRaster::DepthAt(const ProjectedFaces::Face& face, const double (&areas)[3])
{
  const double total = areas[0] + areas[1] + areas[2];
  return total > 0.0 ? (areas[1] * face.Vertices[0].Depth + areas[2] * face.Vertices[1].Depth +
                         areas[0] * face.Vertices[2].Depth) /
      total
                     : face.Vertices[0].Depth;
}

//------------------------------------------------------------------------------
void BoundaryRaster::CollectFace(std::int32_t index, const PixelBox& tile, EntryLists& lists) const
{
  const ProjectedFaces::Face face = this->Faces.Project(index);
  double reciprocals[3];
  for (int k = 0; k < 3; ++k)
  {
    reciprocals[k] = face.Edges[k][1] != 0.0 ? 1.0 / face.Edges[k][1] : 0.0;
  }
  const PixelBox& box = this->Boxes[index];
  for (int row = std::max(box.Bottom, tile.Bottom); row < std::min(box.Top, tile.Top); ++row)
  {
    const int left = std::max(box.Left, tile.Left);
    const int right = std::min(box.Right, tile.Right);
    const PixelSpan span =
      SpanOf(face.Edges, reciprocals, this->GetRays().FromCenter(left, row), right - left);
    for (int column = left + span.First; column < left + span.Last; ++column)
    {
      const glm::dvec2 pixel = this->GetRays().FromCenter(column, row);
      double areas[3];
      for (int k = 0; k < 3; ++k)
      {
        areas[k] = face.Edges[k][0] + pixel.x * face.Edges[k][1] + pixel.y * face.Edges[k][2];
      }
      const double least = std::min(areas[0], std::min(areas[1], areas[2]));
      if (!(least > Margin) &&
        (least < -Margin || !this->EntersExactly(face, { column, row }, areas)))
      {
        continue;
      }
      lists.Add((row - tile.Bottom) * TileSize + column - tile.Left,
        { { face.Ids[0], face.Ids[1], face.Ids[2] }, this->Faces.GetFace(index).CellFace,
          static_cast<float>(DepthAt(face, areas)) });
    }
  }
}

//------------------------------------------------------------------------------
void BoundaryRaster::CollectEntries(int tile, Workspace& workspace) const
{
  // In a mesh whose cells share no faces, each pixel has many faces: taking them from near to far
  // leaves little to sort.
  workspace.Faces.clear();
  for (std::int32_t slot = this->TileBegin[tile]; slot < this->TileBegin[tile + 1]; ++slot)
  {
    const std::int32_t face = this->FaceOfSlot[slot];
    workspace.Faces.emplace_back(static_cast<float>(this->Faces.GetNearestDepth(face)), face);
  }
  std::sort(workspace.Faces.begin(), workspace.Faces.end());
  workspace.Lists.Start(TileSize * TileSize);
  const PixelBox box = this->BoxOfTile(tile);
  for (const auto& face : workspace.Faces)
  {
    this->CollectFace(face.second, box, workspace.Lists);
  }
  workspace.Lists.Sort();
}

}
