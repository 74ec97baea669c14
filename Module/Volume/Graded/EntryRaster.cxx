// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/EntryRaster.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{

namespace
{

/** Growth of the triangles in pixels: four times the largest error of a corner. */
constexpr double Growth = 0x1p-20;

/** Twice the area of a triangle, positive if its corners turn to the left. */
double TwiceArea(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
  const glm::dvec2 ab = b - a;
  const glm::dvec2 ac = c - a;
  return ab.x * ac.y - ab.y * ac.x;
}

/** A triangle's sides as half planes, in all of which are its places and those close to it. */
class Sides
{
public:
  explicit Sides(const std::array<glm::dvec2, 3>& corners)
  {
    const double turn = std::copysign(1.0, TwiceArea(corners[0], corners[1], corners[2]));
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
EntryRaster::EntryRaster(const TetrahedralMesh& mesh, const BoundaryTree& tree,
  const RayImage& image, const RangeLoop& loop)
  : Faces(tree.GetFaces().size())
{
  loop(this->Faces.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        this->Faces[i] = this->Draw(tree.GetFaces()[i], mesh, image);
      }
    });
  this->Usable = std::none_of(this->Faces.begin(), this->Faces.end(),
    [](const Drawn& face) { return std::isnan(face.Least.x); });
}

//------------------------------------------------------------------------------
EntryRaster::Drawn EntryRaster::Draw(
  const BoundaryFace& face, const TetrahedralMesh& mesh, const RayImage& image) const
{
  Drawn drawn;
  std::array<glm::dvec3, 3> places;
  for (std::size_t i = 0; i < 3; ++i)
  {
    places[i] = mesh.GetPosition(face.Vertices[i]);
    drawn.Corners[i] = image.Project(places[i]);
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
  for (const glm::dvec2& corner : corners)
  {
    const glm::dvec3 direction = image.GetDirection(corner);
    drawn.IsEntry |= !(glm::dot(normal, direction) >
      least * std::sqrt(glm::dot(normal, normal) * glm::dot(direction, direction)));
  }
  return drawn;
}

//------------------------------------------------------------------------------
EntryFaces EntryRaster::Collect(const glm::ivec2& first, const glm::ivec2& end,
  const std::function<std::size_t(int, int)>& numberOf) const
{
  EntryFaces found;
  const glm::ivec2 size = end - first;
  found.Heads.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), -1);
  const glm::dvec2 least(first);
  const glm::dvec2 most(end - 1);
  for (std::size_t i = 0; i < this->Faces.size(); ++i)
  {
    const Drawn& face = this->Faces[i];
    if (!face.IsEntry || face.Most.y < least.y || face.Least.y > most.y || face.Most.x < least.x ||
      face.Least.x > most.x)
    {
      continue;
    }
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
          found.Entries.push_back({ static_cast<std::int32_t>(i), head });
          head = static_cast<std::int32_t>(found.Entries.size() - 1);
        }
      }
    }
  }
  return found;
}

}
