// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/BoundaryCones.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{

namespace
{

constexpr double HalfTurn = 3.14159265358979324;

/**
 * Smallest area of a face, over the product of two edges, whose normal is used: rounding turns it
 * by up to 2^-50 over this, far less than Margin.
 */
constexpr double SmallestArea = 0x1p-26;
/** Added to sines. Axis and sine are rounded to single precision, 2^-24 each. */
constexpr double Margin = 0x1p-20;

/** A cone in double precision; an angle of a quarter turn or more bounds nothing. */
struct WideCone
{
  glm::dvec3 Axis{ 0.0 };
  double Angle = HalfTurn;
};

WideCone ConeOf(const BoundaryFace& face, const TetrahedralMesh& mesh)
{
  const glm::dvec3 first = mesh.GetPosition(face.Vertices[0]);
  const glm::dvec3 edges[2] = { mesh.GetPosition(face.Vertices[1]) - first,
    mesh.GetPosition(face.Vertices[2]) - first };
  const glm::dvec3 normal = glm::cross(edges[0], edges[1]);
  const double area = glm::length(normal);
  if (!(area > SmallestArea * glm::length(edges[0]) * glm::length(edges[1])))
  {
    return {};
  }
  return { normal / area, 0.0 };
}

/** Angle between two unit vectors; accurate for small ones. */
double AngleBetween(const glm::dvec3& a, const glm::dvec3& b)
{
  return 2.0 * std::asin(std::min(0.5 * glm::length(a - b), 1.0));
}

WideCone Join(const WideCone& a, const WideCone& b)
{
  const glm::dvec3 sum = a.Axis + b.Axis;
  const double length = glm::length(sum);
  if (a.Angle >= 0.5 * HalfTurn || b.Angle >= 0.5 * HalfTurn || !(length > 0.0))
  {
    return {};
  }
  const glm::dvec3 axis = sum / length;
  return { axis,
    std::max(a.Angle + AngleBetween(axis, a.Axis), b.Angle + AngleBetween(axis, b.Axis)) };
}

}

//------------------------------------------------------------------------------
void BoundaryCones::Build(const TetrahedralMesh& mesh, const BoundaryTree& tree)
{
  const auto& nodes = tree.GetNodes();
  std::vector<WideCone> wide(nodes.size());
  this->Cones.assign(nodes.size(), {});
  // Children follow their parent.
  for (std::size_t n = nodes.size(); n-- > 0;)
  {
    const BoundaryTree::Node& node = nodes[n];
    wide[n] = node.Face >= 0 ? ConeOf(tree.GetFaces()[static_cast<std::size_t>(node.Face)], mesh)
                             : Join(wide[n + 1], wide[static_cast<std::size_t>(nodes[n + 1].Skip)]);
    if (wide[n].Angle < 0.5 * HalfTurn)
    {
      this->Cones[n].Axis = glm::vec3(wide[n].Axis);
      this->Cones[n].Sine = static_cast<float>(std::sin(wide[n].Angle) + Margin);
    }
  }
}

}
