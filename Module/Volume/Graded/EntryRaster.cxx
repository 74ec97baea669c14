// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/EntryRaster.h"

#include "Refraction/Membrane/CrossProduct.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{

namespace
{

/** Growth of the triangles in pixels: four times the largest error of a corner. */
constexpr double Growth = 0x1p-20;

/**
 * Largest length of the difference of the unit vectors of a ray that has been bent and of a ray of
 * the image that it is close to. Any number is right; larger ones let more faces count, and smaller
 * ones fewer rays.
 */
constexpr double LargestTurn = 1.0 / 64.0;

/** Pixels of a tile in rows and columns, and largest number of tiles that one ray looks at. */
constexpr double TileSize = 8.0;
constexpr int MostTiles = 16;

/** A triangle's sides as half planes, in all of which are its places and those close to it. */
class Sides
{
public:
  explicit Sides(const std::array<glm::dvec2, 3>& corners)
  {
    const double turn = std::copysign(1.0, Cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (std::size_t i = 0; i < 3; ++i)
    {
      const glm::dvec2& from = corners[i];
      const glm::dvec2 side = corners[(i + 1) % 3] - from;
      this->Normals[i] = turn * glm::dvec2(-side.y, side.x);
      this->Least[i] = glm::dot(this->Normals[i], from) - Growth * glm::length(side);
    }
  }
  bool Have(const glm::dvec2& place) const
  {
    return glm::dot(this->Normals[0], place) >= this->Least[0] &&
      glm::dot(this->Normals[1], place) >= this->Least[1] &&
      glm::dot(this->Normals[2], place) >= this->Least[2];
  }

private:
  std::array<glm::dvec2, 3> Normals;
  std::array<double, 3> Least;
};

}

//------------------------------------------------------------------------------
std::vector<std::size_t> EntryFaces::KeepRaysWithFaces()
{
  std::vector<std::size_t> kept;
  for (std::size_t ray = 0; ray < this->Heads.size(); ++ray)
  {
    if (this->Heads[ray] >= 0)
    {
      this->Heads[kept.size()] = this->Heads[ray];
      kept.push_back(ray);
    }
  }
  this->Heads.resize(kept.size());
  return kept;
}

//------------------------------------------------------------------------------
EntryRaster::EntryRaster(const TetrahedralMesh& mesh, const BoundaryTree& tree,
  const RayImage& image, const RangeLoop& loop)
  : Image(image)
  , Axis(image.GetAxis())
  , Faces(tree.GetFaces().size())
{
  ForEachItem(this->Faces.size(), loop,
    [&](std::size_t i) { this->Faces[i] = this->Draw(tree.GetFaces()[i], mesh); });
  this->Usable = std::none_of(this->Faces.begin(), this->Faces.end(),
    [](const Drawn& face) { return std::isnan(face.Least.x); });
  if (this->Usable)
  {
    this->FillTiles();
    this->GroupEntries();
  }
}

//------------------------------------------------------------------------------
EntryRaster::Drawn EntryRaster::Draw(const BoundaryFace& face, const TetrahedralMesh& mesh) const
{
  Drawn drawn;
  std::array<glm::dvec3, 3> places;
  for (std::size_t i = 0; i < 3; ++i)
  {
    places[i] = mesh.GetPosition(face.Vertices[i]);
    drawn.Corners[i] = this->Image.Project(places[i]);
    if (std::isnan(drawn.Corners[i].x + drawn.Corners[i].y))
    {
      drawn.Least = drawn.Most = glm::dvec2(std::nan(""));
      return drawn;
    }
  }
  const auto& corners = drawn.Corners;
  drawn.Least = glm::min(corners[0], glm::min(corners[1], corners[2])) - Growth;
  drawn.Most = glm::max(corners[0], glm::max(corners[1], corners[2])) + Growth;
  // If the rays at the corners leave, so do those between them: directions are affine.
  const glm::dvec3 normal = glm::cross(places[1] - places[0], places[2] - places[0]);
  // Far more than the rounding of the product, and than its change over Growth.
  constexpr double least = 0x1p-16;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const glm::dvec3 direction = this->Image.GetDirection(corners[i]);
    const double across = glm::dot(normal, direction);
    const double size = std::sqrt(glm::dot(normal, normal) * glm::dot(direction, direction));
    drawn.IsEntry |= !(across > least * size);
    drawn.IsNearlyEntry |= !(across > (LargestTurn + least) * size);
    const double depth = glm::dot(this->Axis, places[i]);
    drawn.Depth = i == 0 ? depth : std::max(drawn.Depth, depth);
  }
  return drawn;
}

//------------------------------------------------------------------------------
void EntryRaster::FillTiles()
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const glm::ivec2 tiles(glm::ceil(glm::dvec2(this->Image.GetSize()) / TileSize));
  this->TilesPerRow = tiles.x;
  this->DepthsOfTiles.assign(
    static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y), -infinity);
  this->LargestDepth = -infinity;
  for (const Drawn& face : this->Faces)
  {
    this->LargestDepth = std::max(this->LargestDepth, face.Depth);
    if (!face.IsNearlyEntry)
    {
      continue;
    }
    const glm::dvec2 last(tiles - 1);
    const glm::ivec2 begin(glm::clamp(glm::floor(face.Least / TileSize), glm::dvec2(0.0), last));
    const glm::ivec2 end(glm::clamp(glm::floor(face.Most / TileSize), glm::dvec2(0.0), last));
    for (int row = begin.y; row <= end.y; ++row)
    {
      for (int column = begin.x; column <= end.x; ++column)
      {
        double& depth = this->DepthsOfTiles[static_cast<std::size_t>(row * tiles.x + column)];
        depth = std::max(depth, face.Depth);
      }
    }
  }
}

//------------------------------------------------------------------------------
void EntryRaster::GroupEntries()
{
  const int rows = static_cast<int>(this->DepthsOfTiles.size()) / this->TilesPerRow;
  const auto rowOf = [rows](double pixel)
  { return static_cast<int>(std::clamp(pixel / TileSize, 0.0, rows - 1.0)); };
  this->EntriesOfRows.Set(static_cast<std::size_t>(rows),
    [this, &rowOf](const auto& visit)
    {
      for (std::size_t i = 0; i < this->Faces.size(); ++i)
      {
        const Drawn& face = this->Faces[i];
        const int last = rowOf(face.Most.y);
        for (int row = rowOf(face.Least.y); face.IsEntry && row <= last; ++row)
        {
          visit(static_cast<std::size_t>(row), static_cast<std::int32_t>(i));
        }
      }
    });
}

//------------------------------------------------------------------------------
// Directions of the image's rays are affine: a ray that is close to them at two pixels is so at all
// pixels between them, and goes out by every face by which all rays go out that are as close.
bool EntryRaster::MayEnterAfter(const glm::dvec3& place, const glm::dvec3& direction) const
{
  // Far more than the rounding of a depth, and than the distance at which a face still counts that
  // is behind the place.
  constexpr double depthError = 0x1p-40;
  const double depth = glm::dot(this->Axis, place);
  const double rate = glm::dot(this->Axis, direction);
  if (!(rate > 0.0))
  {
    return true;
  }
  const glm::dvec2 first = this->Image.Project(place);
  const double way = std::max(this->LargestDepth - depth, 0.0) / rate;
  const glm::dvec2 last = this->Image.Project(place + way * direction);
  const glm::dvec2 least = (glm::min(first, last) - 1.0) / TileSize;
  const glm::dvec2 most = (glm::max(first, last) + 1.0) / TileSize;
  const int rows =
    this->TilesPerRow > 0 ? static_cast<int>(this->DepthsOfTiles.size()) / this->TilesPerRow : 0;
  const bool isInImage =
    least.x >= 0.0 && least.y >= 0.0 && most.x < this->TilesPerRow && most.y < rows;
  if (!isInImage || !this->Image.IsNearRay(first, direction, LargestTurn) ||
    !this->Image.IsNearRay(last, direction, LargestTurn))
  {
    return true;
  }
  const glm::ivec2 begin(glm::floor(least));
  const glm::ivec2 end = glm::ivec2(glm::floor(most)) + 1;
  if ((end.x - begin.x) * (end.y - begin.y) > MostTiles)
  {
    return true;
  }
  for (int row = begin.y; row < end.y; ++row)
  {
    for (int column = begin.x; column < end.x; ++column)
    {
      if (this->DepthsOfTiles[static_cast<std::size_t>(row * this->TilesPerRow + column)] >=
        depth - depthError)
      {
        return true;
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
EntryFaces EntryRaster::Collect(const glm::ivec2& first, const glm::ivec2& end,
  const std::function<std::size_t(int, int)>& numberOf) const
{
  EntryFaces found;
  found.Raster = this;
  const glm::ivec2 size = end - first;
  found.Heads.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), -1);
  const glm::dvec2 least(first);
  const glm::dvec2 most(end - 1);
  const auto draw = [&](std::int32_t number)
  {
    const Drawn& face = this->Faces[static_cast<std::size_t>(number)];
    const Sides sides(face.Corners);
    const glm::ivec2 begin(glm::ceil(glm::max(face.Least, least)));
    const glm::ivec2 last(glm::floor(glm::min(face.Most, most)));
    for (int row = begin.y; row <= last.y; ++row)
    {
      for (int column = begin.x; column <= last.x; ++column)
      {
        if (sides.Have(glm::dvec2(column, row)))
        {
          std::int32_t& head = found.Heads[numberOf(column, row)];
          found.Entries.push_back({ number, head });
          head = static_cast<std::int32_t>(found.Entries.size() - 1);
        }
      }
    }
  };
  const auto firstTile = static_cast<std::size_t>(least.y / TileSize);
  const auto endTile = std::min(
    static_cast<std::size_t>(most.y / TileSize) + 1, this->EntriesOfRows.GetNumberOfGroups());
  for (std::size_t tile = firstTile; tile < endTile; ++tile)
  {
    for (const std::int32_t number : this->EntriesOfRows[tile])
    {
      const Drawn& face = this->Faces[static_cast<std::size_t>(number)];
      // A face in several rows of tiles is drawn with the first of them.
      const bool isDrawn = tile > firstTile && face.Least.y < TileSize * static_cast<double>(tile);
      if (!isDrawn && face.Most.y >= least.y && face.Least.y <= most.y && face.Most.x >= least.x &&
        face.Least.x <= most.x)
      {
        draw(number);
      }
    }
  }
  return found;
}

}
