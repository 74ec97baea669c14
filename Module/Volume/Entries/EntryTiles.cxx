// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraEntryTiles.glsl (faces that a tile is entered by)
#include "Volume/Entries/EntryTiles.h"

#include "Common/BlockLoop.h"
#include "Common/MortonOrder.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/PlacedVertices.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace meniscus
{
namespace
{

/** Number of rows of tiles that a thread fills at a time. */
constexpr int RowsPerBand = 8;

constexpr std::int64_t MostFaces = std::int64_t{ 1 } << 26;

/** Number of bits of the sorting key for depths in (-2, 2). */
constexpr int DepthBits = 30;
constexpr double DepthSteps = 268435456.0; // 2^28 per unit of depth

/**
 * Bound of the error of a depth in a shader. Depths of vertices are integers of FixedPointRays'
 * grid; the interpolation across a face rounds three products and two sums to 2^-24 of less than 2
 * each, and so does the float that holds the bound itself. The sum is 2^-21; the constant is four
 * times that.
 */
constexpr double DepthError = 1.9073486328125e-06; // 2^-19

/**
 * Bound of the error of u and v of a vertex about a ray in a shader, in grid units. Both are below
 * 2^31 near a ray that meets the mesh; one integer and one difference are rounded to float, with an
 * error of 64 each. Placing the vertex, the ray, and the product of depth and slope add less than 4
 * (fetchVertex in vtkTetrahedraRays.glsl).
 */
constexpr double ErrorInShader = 256.0;

/** A range of tiles in a row. */
struct TileSpan
{
  int First;
  int Last; // exclusive
};

}

/** A face in units of tiles: a ray of a tile may enter by it where no edge is negative. */
struct EntryTiles::Outline
{
  /**
   * Edges at column 0 and row 0, their change per column and per row, and 1 over the change per
   * column, or 0.
   */
  glm::dvec3 Constant;
  glm::dvec3 PerColumn;
  glm::dvec3 PerRow;
  glm::dvec3 Reciprocal;
  ProjectedFaces::PixelBox Tiles;
  std::int32_t Face;
  std::uint32_t Depth;

  /** Columns of a row. The rounding of the roots is far below the margin of the edges. */
  TileSpan ColumnsOf(int row) const
  {
    double begin = this->Tiles.Left;
    double end = this->Tiles.Right;
    for (int k = 0; k < 3; ++k)
    {
      const double atZero = this->Constant[k] + row * this->PerRow[k];
      const double root = -atZero * this->Reciprocal[k];
      if (this->Reciprocal[k] > 0.0)
      {
        begin = std::max(begin, std::ceil(root));
      }
      else if (this->Reciprocal[k] < 0.0)
      {
        end = std::min(end, std::floor(root) + 1.0);
      }
      else if (atZero < 0.0)
      {
        return { 0, 0 };
      }
    }
    return begin < end ? TileSpan{ static_cast<int>(begin), static_cast<int>(end) }
                       : TileSpan{ 0, 0 };
  }
};

//------------------------------------------------------------------------------
BoundaryMeasure MeasureBoundary(const TetrahedralMesh& mesh)
{
  BoundaryMeasure measure;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  glm::dvec3 lower(infinity);
  glm::dvec3 upper(-infinity);
  for (const BoundaryFace& face : mesh.GetBoundary())
  {
    const glm::dvec3 a = mesh.GetPosition(face.Vertices[0]);
    const glm::dvec3 b = mesh.GetPosition(face.Vertices[1]);
    const glm::dvec3 c = mesh.GetPosition(face.Vertices[2]);
    lower = glm::min(lower, glm::min(a, glm::min(b, c)));
    upper = glm::max(upper, glm::max(a, glm::max(b, c)));
    measure.Area += 0.5 * glm::length(glm::cross(b - a, c - a));
    measure.Perimeter += glm::length(b - a) + glm::length(c - b) + glm::length(a - c);
    ++measure.Faces;
  }
  if (measure.Faces > 0)
  {
    const glm::dvec3 size = upper - lower;
    measure.BoxArea = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
  }
  return measure;
}

//------------------------------------------------------------------------------
double ExpectedEntriesPerTile(const BoundaryMeasure& boundary, double tileSide)
{
  const double met = 0.25 * boundary.Area + 0.25 * tileSide * boundary.Perimeter +
    0.5 * tileSide * tileSide * static_cast<double>(boundary.Faces);
  // Tiles at the rim extend beyond the box, so the tiles that meet it cover more than its area.
  const double covered = 0.25 * boundary.BoxArea + tileSide * tileSide;
  return covered > 0.0 ? met / covered : 0.0;
}

//------------------------------------------------------------------------------
bool EntryTiles::Build(const TetrahedralMesh& mesh, const std::vector<BoundaryFace>& faces,
  const FixedPointRays& rays, int tileSize, const RangeLoop& loop)
{
  this->Columns = (rays.GetWidth() + tileSize - 1) / tileSize;
  this->Rows = (rays.GetHeight() + tileSize - 1) / tileSize;
  this->NearestDepths.resize(faces.size());
  std::vector<PacketVertex> vertices;
  PlaceVertices(mesh, {}, rays, loop, vertices);
  ProjectedFaces projected;
  projected.Set(vertices, faces, rays);
  std::vector<Outline> outlines = this->OutlineFaces(projected, tileSize, loop);
  this->SortByDepth(outlines, loop);
  return this->FillTiles(outlines, loop);
}

//------------------------------------------------------------------------------
/** Outlines of the faces by which rays may enter. */
std::vector<EntryTiles::Outline> EntryTiles::OutlineFaces(
  const ProjectedFaces& projected, int tileSize, const RangeLoop& loop) const
{
  const FixedPointRays& rays = projected.GetRays();
  const double error = ErrorInShader;
  // Vector from the image's centre to the centre of the first tile.
  const glm::dvec2 first =
    0.5 * (glm::dvec2(tileSize) - glm::dvec2(rays.GetWidth(), rays.GetHeight()));
  std::vector<std::vector<Outline>> parts(NumberOfBlocks(projected.GetNumberOfFaces()));
  ForEachBlock(projected.GetNumberOfFaces(), loop,
    [&](std::size_t block, std::size_t begin, std::size_t end)
    {
      for (std::size_t f = begin; f < end; ++f)
      {
        const auto index = static_cast<std::int32_t>(f);
        const ProjectedFaces::Face face = projected.Project(index);
        const ProjectedFaces::Footprint seen = projected.BoundPixels(face, error);
        const ProjectedFaces::PixelBox box = projected.PixelsIn(seen);
        if (box.IsEmpty())
        {
          continue;
        }
        Outline outline;
        outline.Face = index;
        outline.Tiles = { box.Left / tileSize, (box.Right - 1) / tileSize + 1,
          box.Bottom / tileSize, (box.Top - 1) / tileSize + 1 };
        const bool bounded = seen.Error < std::numeric_limits<double>::infinity();
        for (int k = 0; k < 3; ++k)
        {
          // Rays pass through pixel centres. Vertices with errors of less than `Error` span a
          // triangle within that distance of the face's.
          const glm::dvec3& edge = face.Edges[k];
          const double reach = 0.5 * (tileSize - 1) * (std::abs(edge[1]) + std::abs(edge[2])) +
            (bounded ? seen.Error * std::sqrt(edge[1] * edge[1] + edge[2] * edge[2]) : 0.0) +
            ProjectedFaces::Margin;
          outline.Constant[k] =
            bounded ? edge[0] + first.x * edge[1] + first.y * edge[2] + reach : 0.0;
          outline.PerColumn[k] = bounded ? tileSize * edge[1] : 0.0;
          outline.PerRow[k] = bounded ? tileSize * edge[2] : 0.0;
          outline.Reciprocal[k] = outline.PerColumn[k] != 0.0 ? 1.0 / outline.PerColumn[k] : 0.0;
        }
        // Depths are below 2 in magnitude.
        const double depth = projected.GetNearestDepth(index) - DepthError + 2.0;
        outline.Depth = static_cast<std::uint32_t>(
          std::min(std::max(depth * DepthSteps, 0.0), std::ldexp(1.0, DepthBits) - 1.0));
        parts[block].push_back(outline);
      }
    });
  std::vector<Outline> outlines;
  for (const std::vector<Outline>& part : parts)
  {
    outlines.insert(outlines.end(), part.begin(), part.end());
  }
  return outlines;
}

//------------------------------------------------------------------------------
void EntryTiles::SortByDepth(std::vector<Outline>& outlines, const RangeLoop& loop)
{
  std::vector<MortonKey> keys;
  keys.reserve(outlines.size());
  for (std::size_t i = 0; i < outlines.size(); ++i)
  {
    const Outline& outline = outlines[i];
    keys.push_back(MakeMortonKey(outline.Depth, i));
    // Rounded down, to a float not above the depth.
    const float nearest = static_cast<float>(outline.Depth / DepthSteps - 2.0);
    this->NearestDepths[static_cast<std::size_t>(outline.Face)] =
      std::nextafter(nearest, -std::numeric_limits<float>::infinity());
  }
  SortByCode(keys, loop);
  std::vector<Outline> sorted;
  sorted.reserve(outlines.size());
  for (const MortonKey key : keys)
  {
    sorted.push_back(outlines[IndexOf(key)]);
  }
  outlines.swap(sorted);
}

//------------------------------------------------------------------------------
/** Indices of the outlines that meet each band of rows of tiles, in their order. */
std::vector<std::vector<std::int32_t>> EntryTiles::DealToBands(
  const std::vector<Outline>& outlines) const
{
  std::vector<std::vector<std::int32_t>> bands(
    static_cast<std::size_t>((this->Rows + RowsPerBand - 1) / RowsPerBand));
  for (std::size_t i = 0; i < outlines.size(); ++i)
  {
    const int last = (outlines[i].Tiles.Top - 1) / RowsPerBand;
    for (int band = outlines[i].Tiles.Bottom / RowsPerBand; band <= last; ++band)
    {
      bands[static_cast<std::size_t>(band)].push_back(static_cast<std::int32_t>(i));
    }
  }
  return bands;
}

//------------------------------------------------------------------------------
/** Visits the faces of each band twice: once to count them and once to fill the lists. */
bool EntryTiles::FillTiles(const std::vector<Outline>& outlines, const RangeLoop& loop)
{
  const std::vector<std::vector<std::int32_t>> bands = this->DealToBands(outlines);
  const auto forEachTile = [&](std::size_t band, const auto& body)
  {
    const int firstRow = static_cast<int>(band) * RowsPerBand;
    const int lastRow = std::min(firstRow + RowsPerBand, this->Rows);
    for (const std::int32_t index : bands[band])
    {
      const Outline& outline = outlines[static_cast<std::size_t>(index)];
      const int last = std::min(lastRow, outline.Tiles.Top);
      for (int row = std::max(firstRow, outline.Tiles.Bottom); row < last; ++row)
      {
        const TileSpan span = outline.ColumnsOf(row);
        for (int column = span.First; column < span.Last; ++column)
        {
          body(row * this->Columns + column, outline.Face);
        }
      }
    }
  };
  const auto forEachBand = [&](const auto& body)
  { ForEachItem(bands.size(), loop, [&](std::size_t band) { forEachTile(band, body); }); };
  const std::size_t tiles =
    static_cast<std::size_t>(this->Rows) * static_cast<std::size_t>(this->Columns);
  std::vector<std::int32_t> next(tiles, 0);
  forEachBand([&next](int tile, std::int32_t) { ++next[tile]; });
  this->Begins.assign(1, 0);
  this->Faces.clear();
  if (std::accumulate(next.begin(), next.end(), std::int64_t{ 0 }) > MostFaces)
  {
    return false;
  }
  for (std::int32_t& count : next)
  {
    const std::int32_t begin = this->Begins.back();
    this->Begins.push_back(begin + count);
    count = begin;
  }
  this->Faces.resize(static_cast<std::size_t>(this->Begins.back()));
  forEachBand([this, &next](int tile, std::int32_t face) { this->Faces[next[tile]++] = face; });
  return true;
}

}
