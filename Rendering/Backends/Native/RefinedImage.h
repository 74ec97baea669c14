// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/Native/ImageDepths.h"
#include "Rendering/Backends/Native/TilesToCast.h"
#include "Rendering/Backends/RayCastBackend.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Entries/BoundaryRaster.h"
#include "Volume/Rays/RayStatistics.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus
{

/**
 * An image with several rays for each pixel at an edge (FindImageEdges()), made of an image with
 * one ray per pixel. Tiles are kept where nothing but depths elsewhere has changed.
 */
class RefinedImage
{
public:
  /**
   * @param image one ray per pixel, premultiplied RGBA, rows from below.
   * @param filled pixels of the image outside this box are zero.
   * @param rays rays of the image that met the mesh.
   * @param across rays in a row of a pixel at an edge, at most.
   * @param target of the image, which is asked whether to go on.
   * @param makeScene scene of the rays of a refined image; called if there is an edge.
   * @return false if the application gives up the frame.
   */
  bool Refine(const std::vector<float>& image, int width, const BoundaryRaster::PixelBox& filled,
    std::int64_t rays, int across, const ImageDepths& depths, RayCastTarget& target,
    const std::function<TileCaster::Scene()>& makeScene);
  /** Makes the next image anew in all tiles. */
  void Forget() { this->Tiles = TilesToCast(); }
  /** Frees the image. */
  void Clear();

  const std::vector<float>& GetPixels() const { return this->Pixels; }
  /** Pixels outside this box are zero. */
  RayCastImageBox GetFilled() const
  {
    return { this->Filled.Left, this->Filled.Right, this->Filled.Bottom, this->Filled.Top };
  }
  std::int64_t GetBytes() const;
  /** Adds the rays of pixels at edges. */
  void AddTo(RayCastStatistics& total) const;

private:
  bool CastTiles(const TileCaster& caster, const std::vector<float>& image,
    const BoundaryRaster::PixelBox& changed, const ImageDepths& depths, RayCastTarget& target);
  void FindTiles(int height, int size);
  void BoundFilled(const TileCaster& caster);

  std::vector<float> Pixels;
  int Width = 0;
  /** Edges of the pixels (PixelEdge), in this image and in the image before it. */
  std::vector<std::uint8_t> Edges;
  std::vector<std::uint8_t> EdgesBefore;
  /** Nonzero for each tile with pixels that get several rays. */
  std::vector<std::uint8_t> HasEdges;
  std::vector<RayStatistics> OfTile;
  TilesToCast Tiles;
  BoundaryRaster::PixelBox Filled{ 0, 0, 0, 0 };
  /** Edges up to this level are left as they are. */
  int Tolerated = 0;
  std::int64_t NumberOfEdges = 0;
};

}
