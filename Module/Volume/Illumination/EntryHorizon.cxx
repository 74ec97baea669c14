// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Illumination/EntryHorizon.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/**
 * Distance, in grid units, by which a line along the depth may miss a face and enter by it, or its
 * depth there may be wrong: coordinates about the line are below 2^32, and rounded twice by 2^-24
 * of them.
 */
constexpr double Margin = 512.0;
/** Depth of squares without a face. */
constexpr float Nowhere = -std::numeric_limits<float>::infinity();

glm::dvec2 AcrossOf(const PacketVertex& vertex)
{
  return { vertex.Place[0], vertex.Place[1] };
}

}

//------------------------------------------------------------------------------
void EntryHorizon::Set(const std::vector<BoundaryFace>& faces, const RefractionFrame& frame)
{
  this->Depths.assign(std::size_t{ Size } * Size, Nowhere);
  const auto cornerOf = [&frame](const BoundaryFace& face, std::size_t k)
  { return &frame.Vertices[static_cast<std::size_t>(face.Vertices[k])]; };
  glm::dvec2 upper(-std::numeric_limits<double>::infinity());
  this->Lower = -upper;
  for (const BoundaryFace& face : faces)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const glm::dvec2 place = AcrossOf(*cornerOf(face, k));
      this->Lower = glm::min(this->Lower, place - Margin);
      upper = glm::max(upper, place + Margin);
    }
  }
  this->PerUnit = static_cast<double>(Size) / (upper - this->Lower);
  // Faces are counter-clockwise from outside (EnteredFace()).
  const double sense = frame.Rays.GetFrame().Handedness < 0 ? -1.0 : 1.0;
  for (const BoundaryFace& face : faces)
  {
    const PacketVertex* const corners[3] = { cornerOf(face, 0), cornerOf(face, 1),
      cornerOf(face, 2) };
    const glm::dvec2 first = AcrossOf(*corners[1]) - AcrossOf(*corners[0]);
    const glm::dvec2 second = AcrossOf(*corners[2]) - AcrossOf(*corners[0]);
    const double area = first.x * second.y - first.y * second.x;
    // Both ends of an edge are displaced by up to sqrt(2) times the margin.
    constexpr double offset = 2.83 * Margin;
    if (sense * area > -offset * (glm::length(first) + glm::length(second) + offset))
    {
      this->Raise(corners, area);
    }
  }
}

//------------------------------------------------------------------------------
/** Raises the squares that a face meets to its largest depth in each of them. */
void EntryHorizon::Raise(const PacketVertex* const (&corners)[3], double area)
{
  glm::dvec3 places[3];
  for (int k = 0; k < 3; ++k)
  {
    const std::int32_t* place = corners[k]->Place;
    places[k] = { (place[0] - this->Lower.x) * this->PerUnit.x,
      (place[1] - this->Lower.y) * this->PerUnit.y, place[2] };
  }
  const glm::dvec3 low = glm::min(places[0], glm::min(places[1], places[2]));
  const glm::dvec3 high = glm::max(places[0], glm::max(places[1], places[2]));
  const glm::dvec2 margin = Margin * this->PerUnit;
  const auto squareOf = [](double place)
  { return std::clamp(static_cast<int>(std::floor(place)), 0, Size - 1); };
  const int left = squareOf(low.x - margin.x);
  const int right = squareOf(high.x + margin.x);
  const int bottom = squareOf(low.y - margin.y);
  const int top = squareOf(high.y + margin.y);
  const glm::dvec3 first = places[1] - places[0];
  const glm::dvec3 second = places[2] - places[0];
  // Change of the depth along x and y. In steep faces the largest depth of all is used.
  const double inSquares = area * this->PerUnit.x * this->PerUnit.y;
  const glm::dvec2 slope(
    first.z * second.y - second.z * first.y, second.z * first.x - first.z * second.x);
  const bool isSteep = std::fabs(inSquares) < 1.0e-6;
  for (int row = bottom; row <= top; ++row)
  {
    for (int column = left; column <= right; ++column)
    {
      double depth = high.z;
      if (!isSteep)
      {
        const glm::dvec2 perSquare = slope / inSquares;
        const glm::dvec2 corner(perSquare.x > 0.0 ? column + 1.0 + margin.x : column - margin.x,
          perSquare.y > 0.0 ? row + 1.0 + margin.y : row - margin.y);
        depth = std::min(depth, places[0].z + glm::dot(perSquare, corner - glm::dvec2(places[0])));
      }
      float& most = this->Depths[static_cast<std::size_t>(row * Size + column)];
      most = std::max(most, static_cast<float>(depth));
    }
  }
}

//------------------------------------------------------------------------------
bool EntryHorizon::MayEnter(const PacketRay& ray, double depth) const
{
  const glm::dvec2 place(
    double{ ray.Fraction[0] } + ray.Offset[0], double{ ray.Fraction[1] } + ray.Offset[1]);
  const glm::dvec2 square = (place - this->Lower) * this->PerUnit;
  if (!(square.x >= 0.0 && square.x < Size && square.y >= 0.0 && square.y < Size))
  {
    return false;
  }
  const auto index = static_cast<std::size_t>(square.y) * Size + static_cast<std::size_t>(square.x);
  return this->Depths[index] + Margin >= depth * PacketVertex::GridPerDepth;
}

}
