// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Rays/RayFrame.h"
#include "Volume/Refracted/RefractedRayTiles.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <limits>
#include <vector>

namespace meniscus
{

/**
 * Part of a ray that is drawn: the whole ray, the part in front of the membrane (and rays that miss
 * it), or the part behind it.
 */
enum class MembranePart
{
  Whole,
  InFront,
  Behind
};

/** Numbers of the legs that are drawn. */
struct LegRange
{
  int First = 0;
  /** Exclusive. */
  int End = std::numeric_limits<int>::max();
};

/** Legs of a part of a ray: leg 0 is in front of the membrane. */
LegRange LegsOf(MembranePart part);

/**
 * A straight part of a pixel's ray between two refracting interfaces, in the frame of the view. The
 * point drawn at the depth d (see RefractedRay) is Begin + (d - Depth) * Step.
 */
struct RayLeg
{
  /** For leg 0, the point at depth 0; otherwise the sight point. */
  glm::dvec3 Begin{ 0.0 };
  glm::dvec3 Step{ 0.0 };
  /** Drawn depth of Begin. */
  double Depth = 0.0;
  /** Drawn depth at which the leg ends on the next interface; infinite if it does not meet one. */
  double End = std::numeric_limits<double>::infinity();

  /** Leg 0 of a pixel's ray; column and row count from the image's centre. */
  static RayLeg OfSight(
    const AffinePixelMap& origin, const AffinePixelMap& slope, double column, double row)
  {
    RayLeg leg;
    leg.Begin = glm::dvec3(origin.At(column, row), 0.0);
    leg.Step = glm::dvec3(slope.At(column, row), 1.0);
    return leg;
  }
  /** Replaces the leg by the next one, but for its end. */
  void Refract(const RefractedRay& ray)
  {
    this->Begin += (ray.Depth - this->Depth) * this->Step;
    this->Step = ray.Step;
    this->Depth = ray.Depth;
  }
};

/**
 * The legs of an image's rays. Leg 0 of a ray is its sight ray, and every refraction appends one. A
 * ray whose refraction at an interface is not known, or that does not go on there, has no further
 * legs.
 */
class RayLegs
{
public:
  /**
   * @param sight rays of the image's pixels.
   * @param refracted rays behind each of the interfaces, in the order in which rays meet them.
   *   These objects must outlive this one.
   * @param pitch rays from a tile to the next one: RefractedRayTiles::TileSize, or less if no ray
   *   is refracted.
   */
  RayLegs(const RayFrame& sight, int width, int height,
    const std::vector<const RefractedRayTiles*>& refracted = {},
    int pitch = RefractedRayTiles::TileSize);

  const RayFrame& GetSight() const { return this->Sight; }
  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }
  int GetNumberOfTiles() const { return this->Columns * this->Rows; }

  /** Number of legs of the rays that have most. */
  int GetNumberOfLegs() const { return 1 + static_cast<int>(this->Refracted.size()); }
  /** The same among the rays of a tile. */
  int GetNumberOfLegs(int tile) const;

  /**
   * Rays of a tile behind interface number `leg` - 1, on which leg number `leg` begins; null if
   * none of them meets the interface. Legs are numbered from 1 here.
   */
  const RefractedRay* GetTile(int leg, int tile) const
  {
    return this->Refracted[static_cast<std::size_t>(leg) - 1]->GetTile(tile);
  }

  /** False if no ray of a square of a tile has leg number `leg`. */
  bool HasLegs(int leg, int tile, int square) const
  {
    return this->Refracted[static_cast<std::size_t>(leg) - 1]->GoesOn(tile, square);
  }
  /** False if none of the legs of a tile, or of a square of it, may meet the mesh. */
  bool MayShow(int leg, int tile) const
  {
    return this->Refracted[static_cast<std::size_t>(leg) - 1]->MayShow(tile);
  }
  bool MayShow(int leg, int tile, int square) const
  {
    return this->Refracted[static_cast<std::size_t>(leg) - 1]->MayShow(tile, square);
  }

  /**
   * Largest depth at which a ray of a tile that may come to the mesh before meets the first
   * interface: infinite if one passes it, -infinity if there is none.
   */
  double GetFarthestEnd(int tile) const { return this->Refracted.front()->GetFarthest(tile); }

  /** Requests the rays of a square, if they are to be read; `square` may be behind the last one. */
  void PrefetchSquare(int leg, int tile, int square) const;

  /** Lower left pixel of a tile. */
  int GetLeft(int tile) const { return tile % this->Columns * this->Pitch; }
  int GetBottom(int tile) const { return tile / this->Columns * this->Pitch; }

  /**
   * Computes leg number `number` of a pixel's ray. Returns false if the ray has no such leg.
   * @param pixel number of the pixel in the tile, in rows of RefractedRayTiles::TileSize.
   */
  bool Find(int tile, int pixel, int number, RayLeg& leg) const;
  /**
   * World length of a pixel's ray from a depth on leg 0 to the beginning of leg number `number`; 0
   * for leg 0.
   * @pre Find() returns true.
   */
  double GetLengthBefore(int tile, int pixel, int number, double depth) const;
  /** The same from the beginning of leg 1, the first sight point; 0 for legs 0 and 1. */
  double GetLengthBehindMembrane(int tile, int pixel, int number) const;

private:
  RayFrame Sight;
  int Width;
  int Height;
  int Pitch;
  int Columns;
  int Rows;
  std::vector<const RefractedRayTiles*> Refracted;
};

}
