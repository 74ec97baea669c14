// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RayLegs.h"

#include "Common/Prefetch.h"

#include <glm/geometric.hpp>

namespace meniscus
{
namespace
{

constexpr int TileSize = RefractedRayTiles::TileSize;

}

//------------------------------------------------------------------------------
LegRange LegsOf(MembranePart part)
{
  LegRange legs;
  legs.First = part == MembranePart::Behind ? 1 : legs.First;
  legs.End = part == MembranePart::InFront ? 1 : legs.End;
  return legs;
}

//------------------------------------------------------------------------------
RayLegs::RayLegs(const RayFrame& sight, int width, int height,
  const std::vector<const RefractedRayTiles*>& refracted, int pitch)
  : Sight(sight)
  , Width(width)
  , Height(height)
  , Pitch(pitch)
  , Columns((width + pitch - 1) / pitch)
  , Rows((height + pitch - 1) / pitch)
  , Refracted(refracted)
{
}

//------------------------------------------------------------------------------
int RayLegs::GetNumberOfLegs(int tile) const
{
  int number = 1;
  while (number < this->GetNumberOfLegs() && this->GetTile(number, tile))
  {
    ++number;
  }
  return number;
}

//------------------------------------------------------------------------------
void RayLegs::PrefetchSquare(int leg, int tile, int square) const
{
  constexpr int side = RefractedRayTiles::SquareSize;
  if (square < RefractedRayTiles::SquaresOfTile && this->MayShow(leg, tile, square))
  {
    const RefractedRay* rays = this->GetTile(leg, tile) +
      RefractedRayTiles::RowOfSquare(square) * TileSize + RefractedRayTiles::ColumnOfSquare(square);
    for (int row = 0; row < side; ++row)
    {
      Prefetch(rays + row * TileSize, side * sizeof(RefractedRay));
    }
  }
}

//------------------------------------------------------------------------------
bool RayLegs::Find(int tile, int pixel, int number, RayLeg& leg) const
{
  const double column = this->GetLeft(tile) + pixel % TileSize + 0.5 - 0.5 * this->Width;
  const double row = this->GetBottom(tile) + pixel / TileSize + 0.5 - 0.5 * this->Height;
  leg = RayLeg::OfSight(this->Sight.Origin, this->Sight.Slope, column, row);
  for (int k = 1; k <= number; ++k)
  {
    const RefractedRay* rays = this->GetTile(k, tile);
    if (!rays || !rays[pixel].GoesOn())
    {
      return false;
    }
    leg.Refract(rays[pixel]);
  }
  const RefractedRay* next =
    number + 1 < this->GetNumberOfLegs() ? this->GetTile(number + 1, tile) : nullptr;
  leg.End = next ? next[pixel].Depth : std::numeric_limits<double>::infinity();
  return true;
}

//------------------------------------------------------------------------------
double RayLegs::GetLengthBefore(int tile, int pixel, int number, double depth) const
{
  if (number == 0)
  {
    return 0.0;
  }
  RayLeg sight;
  this->Find(tile, pixel, 0, sight);
  return (sight.End - depth) * glm::length(this->Sight.ViewToWorld * sight.Step) +
    this->GetLengthBehindMembrane(tile, pixel, number);
}

//------------------------------------------------------------------------------
double RayLegs::GetLengthBehindMembrane(int tile, int pixel, int number) const
{
  double length = 0.0;
  for (int k = 1; k < number; ++k)
  {
    RayLeg leg;
    this->Find(tile, pixel, k, leg);
    length += (leg.End - leg.Depth) * glm::length(this->Sight.ViewToWorld * leg.Step);
  }
  return length;
}

}
