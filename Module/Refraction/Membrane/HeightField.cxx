// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Membrane/HeightField.h"

#include "Refraction/Membrane/CrossProduct.h"

#include <cmath>
#include <limits>
#include <vector>

namespace meniscus
{
namespace
{

/** Border as a list: for each of its vertices the next one, -1 for others. */
class Border
{
public:
  explicit Border(std::size_t vertices)
    : Next(vertices, -1)
  {
  }

  /** Returns false if a border edge leaves the vertex already. */
  bool Add(std::int32_t from, std::int32_t to)
  {
    std::int32_t& next = this->Next[static_cast<std::size_t>(from)];
    if (next != -1)
    {
      return false;
    }
    next = to;
    this->First = from;
    ++this->Count;
    return true;
  }

  /** True if the border is one loop that makes one full turn and turns to the left everywhere. */
  bool IsConvexLoop(const Membrane& membrane, const HeightFrame& frame) const
  {
    // Positions are rounded as world coordinates and as local ones, and so are the ends of the
    // sides; the error of the cross product of two sides is that times their lengths.
    constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
    const double slack = rounding * (membrane.GetRadius() + glm::length(membrane.GetOrigin()));
    double turned = 0.0;
    std::size_t steps = 0;
    std::int32_t at = this->First;
    do
    {
      const std::int32_t middle = this->GetNext(at);
      const std::int32_t end = middle == -1 ? -1 : this->GetNext(middle);
      if (end == -1)
      {
        return false;
      }
      const glm::dvec2 before = frame.Project(GetEdge(membrane, at, middle));
      const glm::dvec2 after = frame.Project(GetEdge(membrane, middle, end));
      const double cross = Cross(before, after);
      if (!(cross >= -slack * (glm::length(before) + glm::length(after))))
      {
        return false;
      }
      turned += std::atan2(cross, glm::dot(before, after));
      at = middle;
      ++steps;
    } while (at != this->First && steps <= this->Count);
    constexpr double circle = 6.283185307179586;
    return steps == this->Count && std::fabs(turned - circle) < 0.5 * circle;
  }

private:
  std::int32_t GetNext(std::int32_t vertex) const
  {
    return this->Next[static_cast<std::size_t>(vertex)];
  }
  static glm::dvec3 GetEdge(const Membrane& membrane, std::int32_t from, std::int32_t to)
  {
    return membrane.GetPositions()[static_cast<std::size_t>(to)] -
      membrane.GetPositions()[static_cast<std::size_t>(from)];
  }

  std::vector<std::int32_t> Next;
  std::int32_t First = 0;
  std::size_t Count = 0;
};

}

//------------------------------------------------------------------------------
HeightFrame::HeightFrame(const glm::dvec3& axis)
  : Axis(axis)
{
  const glm::dvec3 a = glm::abs(axis);
  const glm::dvec3 other = a.x <= a.y && a.x <= a.z
    ? glm::dvec3(1.0, 0.0, 0.0)
    : (a.y <= a.z ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0));
  this->First = glm::normalize(glm::cross(other, axis));
  this->Second = glm::cross(axis, this->First);
}

//------------------------------------------------------------------------------
bool IsConvexField(const Membrane& membrane, const CurvedPatches& patches, const HeightFrame& frame)
{
  const auto& facets = membrane.GetFacets();
  if (facets.empty())
  {
    return false;
  }
  const auto at = [&membrane](std::int32_t vertex) -> const glm::dvec3&
  { return membrane.GetPositions()[static_cast<std::size_t>(vertex)]; };
  // Facets may have either winding, but all of them the same.
  const auto area = [&at, &frame](const Membrane::Facet& f)
  { return frame.GetHeight(glm::cross(at(f[1]) - at(f[0]), at(f[2]) - at(f[0]))); };
  const bool left = area(facets[0]) > 0.0;
  Border border(membrane.GetPositions().size());
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    const Membrane::Facet& f = facets[i];
    const double winding = area(f);
    if (!(left ? winding > 0.0 : winding < 0.0))
    {
      return false;
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      if (patches.GetNeighbour(static_cast<std::int32_t>(i), static_cast<int>(k)) !=
        CurvedPatches::NoFacet)
      {
        continue;
      }
      const std::int32_t from = f[(k + 1) % 3];
      const std::int32_t to = f[(k + 2) % 3];
      if (!(left ? border.Add(from, to) : border.Add(to, from)))
      {
        return false;
      }
    }
  }
  return border.IsConvexLoop(membrane, frame);
}

}
