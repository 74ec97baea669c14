// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/Native/RefinedImage.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Backends/TableCounter.h"
#include "Volume/Caster/ImageEdges.h"

#include "vtkSMPThreadLocal.h"

#include <algorithm>
#include <cstddef>

namespace meniscus
{
namespace
{

using PixelBox = BoundaryRaster::PixelBox;

/** True for the pixels with an edge above a level. */
auto IsAbove(int level)
{
  return [level](std::uint8_t edge) { return PixelEdge(edge).GetLevel() > level; };
}

/** Copies a box of an image of four numbers per pixel. */
void CopyRows(
  const PixelBox& box, int width, const std::vector<float>& from, std::vector<float>& to)
{
  for (int row = box.Bottom; row < box.Top; ++row)
  {
    const std::ptrdiff_t start = 4 * (std::ptrdiff_t{ row } * width + box.Left);
    std::copy_n(from.begin() + start, 4 * (box.Right - box.Left), to.begin() + start);
  }
}

/** A box and the pixels next to it. */
PixelBox Widen(const PixelBox& box, int width, int height)
{
  return { std::max(box.Left - 1, 0), std::min(box.Right + 1, width), std::max(box.Bottom - 1, 0),
    std::min(box.Top + 1, height) };
}

/**
 * The tiles of one ray per pixel around a box and the pixels next to it. The middle ray of a pixel
 * counts, and its rounding may depend on the rays of its tile.
 */
PixelBox GetTilesAround(const PixelBox& box, int width, int height)
{
  constexpr int size = BoundaryRaster::TileSize;
  const PixelBox wide = Widen(box, width, height);
  const auto up = [](int end, int last) { return std::min((end + size - 1) / size * size, last); };
  return { wide.Left / size * size, up(wide.Right, width), wide.Bottom / size * size,
    up(wide.Top, height) };
}

}

//------------------------------------------------------------------------------
bool RefinedImage::Refine(const std::vector<float>& image, int width, const PixelBox& filled,
  std::int64_t rays, int across, const ImageDepths& depths, RayCastTarget& target,
  const std::function<TileCaster::Scene()>& makeScene)
{
  this->EdgesBefore.swap(this->Edges);
  const int height = static_cast<int>(depths.Now.size()) / width;
  FindImageEdges(image, width, height, filled, ThreadedLoop, this->Edges);
  const int levelBefore = this->Tolerated;
  this->Tolerated = ChooseEdgeLevel(this->Edges, rays, across);
  this->NumberOfEdges =
    std::count_if(this->Edges.begin(), this->Edges.end(), IsAbove(this->Tolerated));
  const bool hasSize = this->Pixels.size() == image.size() && this->Width == width;
  const PixelBox before = hasSize ? this->Filled : PixelBox{ 0, 0, 0, 0 };
  this->Filled = filled.IsEmpty() ? filled : Widen(filled, width, height);
  if (this->NumberOfEdges == 0)
  {
    this->Pixels = image;
    this->Width = width;
    this->OfTile.clear();
    return true;
  }
  if (!hasSize)
  {
    this->Pixels.assign(image.size(), 0.0f);
    this->Width = width;
  }
  this->FindTiles(height, TileCaster::PixelsAcrossTile(across));
  TileCaster::Scene scene = makeScene();
  scene.Refining.Tiles = &this->HasEdges;
  const TileCaster caster(scene, ThreadedLoop);
  const bool isKept = depths.Before && hasSize && this->Tolerated == levelBefore &&
    this->OfTile.size() == static_cast<std::size_t>(caster.GetNumberOfTiles());
  this->OfTile.resize(static_cast<std::size_t>(caster.GetNumberOfTiles()));
  PixelBox changed = this->Filled;
  changed.Add(before);
  const bool finished = this->CastTiles(
    caster, image, changed, { depths.Now, isKept ? depths.Before : nullptr }, target);
  this->BoundFilled(caster);
  if (!finished)
  {
    this->Filled.Add(before);
  }
  return finished;
}

//------------------------------------------------------------------------------
/** Finds the tiles, of so many columns and rows, with pixels that get several rays. */
void RefinedImage::FindTiles(int height, int size)
{
  const int columns = (this->Width + size - 1) / size;
  const int rows = (height + size - 1) / size;
  this->HasEdges.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  for (int row = 0; row < height; ++row)
  {
    const std::uint8_t* const edges = this->Edges.data() + std::ptrdiff_t{ row } * this->Width;
    std::uint8_t* const tiles = this->HasEdges.data() + std::ptrdiff_t{ row / size } * columns;
    for (int column = 0; column < this->Width; ++column)
    {
      if (edges[column] != 0 && IsAbove(this->Tolerated)(edges[column]))
      {
        tiles[column / size] = 1;
      }
    }
  }
}

//------------------------------------------------------------------------------
bool RefinedImage::CastTiles(const TileCaster& caster, const std::vector<float>& image,
  const PixelBox& changed, const ImageDepths& depths, RayCastTarget& target)
{
  const int width = this->Width;
  const int height = static_cast<int>(depths.Now.size()) / width;
  this->Tiles.Begin(caster.GetNumberOfTiles(), depths.Before != nullptr,
    [&](int tile)
    {
      const PixelBox box = caster.GetPixels(tile);
      return depths.AreThoseBefore(GetTilesAround(box, width, height), width) &&
        HaveEqualRows(box, width, this->Edges, this->EdgesBefore);
    });
  vtkSMPThreadLocal<TileCaster::Workspace> workspaces;
  return this->Tiles.Cast(target,
    [&](int tile)
    {
      const PixelBox box = caster.GetPixels(tile);
      const bool hasEdges = this->HasEdges[static_cast<std::size_t>(tile)] != 0;
      if (hasEdges || box.Overlaps(changed))
      {
        CopyRows(box, width, image, this->Pixels);
        SmoothEdges(image, width, height, this->Edges, this->Tolerated, box, this->Pixels);
      }
      this->OfTile[static_cast<std::size_t>(tile)] = hasEdges
        ? caster.Refine(tile, depths.Now.data(), { this->Edges.data(), this->Tolerated },
            this->Pixels.data(), workspaces.Local())
        : RayStatistics();
    });
}

//------------------------------------------------------------------------------
/** Adds the tiles whose rays met the mesh to the box of the filled pixels. */
void RefinedImage::BoundFilled(const TileCaster& caster)
{
  for (int tile = 0; tile < caster.GetNumberOfTiles(); ++tile)
  {
    if (this->OfTile[static_cast<std::size_t>(tile)].Rays > 0)
    {
      this->Filled.Add(caster.GetPixels(tile));
    }
  }
}

//------------------------------------------------------------------------------
void RefinedImage::Clear()
{
  *this = RefinedImage();
}

//------------------------------------------------------------------------------
std::int64_t RefinedImage::GetBytes() const
{
  return BytesOf(this->Pixels) + BytesOf(this->Edges) + BytesOf(this->EdgesBefore);
}

//------------------------------------------------------------------------------
void RefinedImage::AddTo(RayCastStatistics& total) const
{
  total.RefinedPixels += this->NumberOfEdges;
  for (const RayStatistics& tile : this->OfTile)
  {
    total.Steps += tile.Steps;
    total.RefiningSteps += tile.Steps;
    total.Rays += tile.Rays;
    total.Lost += tile.Lost;
    total.Overlaps += tile.Overlaps;
  }
}

}
