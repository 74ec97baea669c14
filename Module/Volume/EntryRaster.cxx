// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/EntryRaster.h"

#include "Volume/Packet/ExactGrid.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace meniscus
{
namespace
{

/**
 * By what rounding can change an edge's area: RoundingOfRay in each of four numbers, each the
 * factor of another of at most 2^30 + 2, and the double arithmetic, much less.
 */
constexpr double Margin = 4294967296.0; // 2^32
static_assert(4.0 * PixelRays::RoundingOfRay * 1073741826.0 < Margin, "rounding of rays");

/** u or v of a vertex, a function of the pixel. */
glm::dvec3 Coefficients(
  const AffinePixelMap& offset, const AffinePixelMap& slope, int axis, const PacketVertex& vertex)
{
  const double depth = vertex.Place[2];
  return { vertex.Place[axis] - offset.Base[axis] - depth * slope.Base[axis],
    -offset.PerColumn[axis] - depth * slope.PerColumn[axis],
    -offset.PerRow[axis] - depth * slope.PerRow[axis] };
}

/** The affine function u_p v_q - v_p u_q of the pixel, whose second-order terms vanish. */
glm::dvec3 EdgeFunction(
  const glm::dvec3& up, const glm::dvec3& vp, const glm::dvec3& uq, const glm::dvec3& vq)
{
  return { up[0] * vq[0] - vp[0] * uq[0],
    up[0] * vq[1] + up[1] * vq[0] - vp[0] * uq[1] - vp[1] * uq[0],
    up[0] * vq[2] + up[2] * vq[0] - vp[0] * uq[2] - vp[2] * uq[0] };
}

/** Pixels of a row, from a first one on. */
struct PixelSpan
{
  int First;
  int Last; // exclusive
};

/** The part of `count` pixels from `first` on where no edge is below -Margin, or a little more. */
PixelSpan SpanOf(const glm::dvec3 (&edges)[3], const glm::dvec2& first, int count)
{
  double begin = 0.0;
  double end = count;
  for (const glm::dvec3& edge : edges)
  {
    const double excess = edge[0] + first.x * edge[1] + first.y * edge[2] + Margin;
    if (edge[1] != 0.0)
    {
      const double root = -excess / edge[1];
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

/** A face, its vertices counter-clockwise about the rays that enter by it. */
struct EntryRaster::SeenFace
{
  std::int32_t Ids[3];
  SeenVertex Vertices[3];
  /** Of edges 01, 12, 20. */
  glm::dvec3 Edges[3];
};

//------------------------------------------------------------------------------
EntryRaster::SeenVertex EntryRaster::See(std::int32_t vertex) const
{
  const PacketVertex& seen = (*this->Vertices)[vertex];
  const AffinePixelMap& offset = this->Rays.GetOffset();
  const AffinePixelMap& slope = this->Rays.GetSlope();
  return { Coefficients(offset, slope, 0, seen), Coefficients(offset, slope, 1, seen),
    PixelRays::DepthOf(seen.Place[2]) };
}

//------------------------------------------------------------------------------
EntryRaster::SeenFace EntryRaster::See(const BoundaryFace& face) const
{
  const bool counterClockwise = face.Outward * this->Rays.GetFrame().Handedness > 0;
  SeenFace seen;
  seen.Ids[0] = face.Vertices[counterClockwise ? 0 : 1];
  seen.Ids[1] = face.Vertices[counterClockwise ? 1 : 0];
  seen.Ids[2] = face.Vertices[2];
  for (int i = 0; i < 3; ++i)
  {
    seen.Vertices[i] = this->See(seen.Ids[i]);
  }
  for (int i = 0; i < 3; ++i)
  {
    const SeenVertex& p = seen.Vertices[i];
    const SeenVertex& q = seen.Vertices[(i + 1) % 3];
    seen.Edges[i] = EdgeFunction(p.U, p.V, q.U, q.V);
  }
  return seen;
}

//------------------------------------------------------------------------------
/** Where the face may be entered: empty if it can be told to face away. */
EntryRaster::PixelBox EntryRaster::BoxOf(const SeenFace& face) const
{
  const PixelBox whole{ 0, this->Rays.GetWidth(), 0, this->Rays.GetHeight() };
  glm::dvec2 lower(1.0e30);
  glm::dvec2 upper(-1.0e30);
  bool facesAway = true;
  const SeenVertex& first = face.Vertices[0];
  for (int k = 0; k < 3; ++k)
  {
    // The pixel whose ray passes through the vertex: u = v = 0. How u and v change with the column
    // is 0 in the plane of the eye and the other way behind it.
    const SeenVertex& vertex = face.Vertices[k];
    const double side = vertex.U[1] * vertex.V[2] - vertex.U[2] * vertex.V[1];
    const bool together = vertex.U[1] * first.U[1] + vertex.V[1] * first.V[1] > 0.0;
    const glm::dvec2 pixel = glm::dvec2(vertex.U[2] * vertex.V[0] - vertex.U[0] * vertex.V[2],
                               vertex.U[0] * vertex.V[1] - vertex.U[1] * vertex.V[0]) /
      side;
    if (!together || !(std::abs(pixel.x) < 1.0e9) || !(std::abs(pixel.y) < 1.0e9))
    {
      return whole; // about the plane of the eye, where the face is seen without bounds
    }
    lower = glm::dvec2(std::min(lower.x, pixel.x), std::min(lower.y, pixel.y));
    upper = glm::dvec2(std::max(upper.x, pixel.x), std::max(upper.y, pixel.y));
    const glm::dvec3& opposite = face.Edges[(k + 1) % 3];
    // Within a face that turns the other way, one edge is below a third of its value at the vertex
    // opposite.
    facesAway =
      facesAway && opposite[0] + pixel.x * opposite[1] + pixel.y * opposite[2] < -3.0 * Margin;
  }
  if (facesAway)
  {
    return { 0, 0, 0, 0 };
  }
  const auto clamped = [](double value, int size)
  { return static_cast<int>(std::min(std::max(value, 0.0), static_cast<double>(size))); };
  const glm::dvec2 center(0.5 * whole.Right, 0.5 * whole.Top);
  // Pixel p has its centre at p + 0.5; one more on each side for rounding.
  return { clamped(lower.x + center.x - 1.5, whole.Right),
    clamped(upper.x + center.x + 1.5, whole.Right), clamped(lower.y + center.y - 1.5, whole.Top),
    clamped(upper.y + center.y + 1.5, whole.Top) };
}

//------------------------------------------------------------------------------
void EntryRaster::Build(const std::vector<PacketVertex>& vertices,
  const std::vector<BoundaryFace>& faces, const PixelRays& rays)
{
  this->Vertices = &vertices;
  this->Faces = &faces;
  this->Rays = rays;
  this->Columns = (this->Rays.GetWidth() + TileSize - 1) / TileSize;
  this->Rows = (this->Rays.GetHeight() + TileSize - 1) / TileSize;

  std::vector<PixelBox> boxes(faces.size());
  this->TileBegin.assign(this->GetNumberOfTiles() + 1, 0);
  const auto forTilesOf = [this](const PixelBox& box, const auto& body)
  {
    if (box.Left >= box.Right || box.Bottom >= box.Top)
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
    boxes[f] = this->BoxOf(this->See(faces[f]));
    forTilesOf(boxes[f], [this](int tile) { ++this->TileBegin[tile + 1]; });
  }
  for (int tile = 0; tile < this->GetNumberOfTiles(); ++tile)
  {
    this->TileBegin[tile + 1] += this->TileBegin[tile];
  }
  this->FaceOfSlot.resize(this->TileBegin.back());
  std::vector<std::int32_t> next(this->TileBegin.begin(), this->TileBegin.end() - 1);
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    forTilesOf(
      boxes[f], [&](int tile) { this->FaceOfSlot[next[tile]++] = static_cast<std::int32_t>(f); });
  }
}

//------------------------------------------------------------------------------
EntryRaster::PixelBox EntryRaster::BoxOfTile(int tile) const
{
  const int left = tile % this->Columns * TileSize;
  const int bottom = tile / this->Columns * TileSize;
  return { left, std::min(left + TileSize, this->Rays.GetWidth()), bottom,
    std::min(bottom + TileSize, this->Rays.GetHeight()) };
}

//------------------------------------------------------------------------------
double EntryRaster::NearestDepth(int tile) const
{
  double nearest = std::numeric_limits<double>::infinity();
  for (std::int32_t slot = this->TileBegin[tile]; slot < this->TileBegin[tile + 1]; ++slot)
  {
    for (const std::int32_t vertex : (*this->Faces)[this->FaceOfSlot[slot]].Vertices)
    {
      nearest = std::min(nearest, PixelRays::DepthOf((*this->Vertices)[vertex].Place[2]));
    }
  }
  return nearest;
}

//------------------------------------------------------------------------------
bool EntryRaster::EntersExactly(
  const SeenFace& face, const glm::ivec2& pixel, double (&areas)[3]) const
{
  const glm::dvec2 center = this->Rays.FromCenter(pixel.x, pixel.y);
  const glm::dvec2 offset = glm::abs(this->Rays.GetOffset().At(center.x, center.y));
  if (!(offset.x <= PixelRays::LargestOffset) || !(offset.y <= PixelRays::LargestOffset))
  {
    return false; // too far away to meet the mesh
  }
  const PacketRay ray = this->Rays.RayOf(pixel.x, pixel.y);
  using Grid = ExactGrid<EntryRaster>;
  std::int32_t grid[3][3];
  for (int k = 0; k < 3; ++k)
  {
    const std::int32_t(&place)[3] = (*this->Vertices)[face.Ids[k]].Place;
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
/** Where the ray meets the face; one without projected area is met at its first vertex. */
double EntryRaster::DepthAt(const SeenFace& face, const double (&areas)[3])
{
  const double total = areas[0] + areas[1] + areas[2];
  return total > 0.0 ? (areas[1] * face.Vertices[0].Depth + areas[2] * face.Vertices[1].Depth +
                         areas[0] * face.Vertices[2].Depth) /
      total
                     : face.Vertices[0].Depth;
}

//------------------------------------------------------------------------------
void EntryRaster::CollectFace(
  const BoundaryFace& boundary, const PixelBox& tile, std::vector<Hit>& hits) const
{
  const SeenFace face = this->See(boundary);
  const PixelBox box = this->BoxOf(face);
  for (int row = std::max(box.Bottom, tile.Bottom); row < std::min(box.Top, tile.Top); ++row)
  {
    const int left = std::max(box.Left, tile.Left);
    const int right = std::min(box.Right, tile.Right);
    const PixelSpan span = SpanOf(face.Edges, this->Rays.FromCenter(left, row), right - left);
    for (int column = left + span.First; column < left + span.Last; ++column)
    {
      const glm::dvec2 pixel = this->Rays.FromCenter(column, row);
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
      hits.push_back({ (row - tile.Bottom) * TileSize + column - tile.Left,
        { { face.Ids[0], face.Ids[1], face.Ids[2] }, boundary.CellFace,
          static_cast<float>(DepthAt(face, areas)) } });
    }
  }
}

//------------------------------------------------------------------------------
void EntryRaster::CollectHits(int tile, std::vector<Hit>& hits) const
{
  hits.clear();
  const PixelBox box = this->BoxOfTile(tile);
  for (std::int32_t slot = this->TileBegin[tile]; slot < this->TileBegin[tile + 1]; ++slot)
  {
    this->CollectFace((*this->Faces)[this->FaceOfSlot[slot]], box, hits);
  }
  std::sort(hits.begin(), hits.end(),
    [](const Hit& a, const Hit& b)
    {
      return std::tie(a.Pixel, a.Entry.Depth, a.Entry.CellFace) <
        std::tie(b.Pixel, b.Entry.Depth, b.Entry.CellFace);
    });
}

}
