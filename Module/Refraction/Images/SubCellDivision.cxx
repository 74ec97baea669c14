// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/SubCellDivision.h"

#include "Refraction/Membrane/CrossProduct.h"
#include "Refraction/Membrane/Optics.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

// An edge is divided into at most 32 parts, except next to the limit of incidence. Finer details
// lie within 1/32 of a facet of a focus. Divisions of wide sub-cells do not count.
constexpr int DeepestSides = 5;

// Chords of the limit are divided until they are within the tolerance, but not below 1/256 of a
// facet.
constexpr int DeepestChords = 8;

// Sides that are longer than their distance from the eye are wide, down to this part of the facet,
// about PatchCrossings::Border.
constexpr double ShortestWideSide = 0x1p-26;

// The limit on a side is bracketed to 2^-16 of it, far below the tolerance. Coordinates of nodes
// then have at most 24 binary digits, and 26 more in wide sub-cells. Midpoints are exact: both
// patches that share an edge compute them alike.
constexpr int LimitSteps = 16;

const double RightAngle = std::acos(0.0);

}

//------------------------------------------------------------------------------
SubCellDivision::SubCellDivision(const CurvedMembraneSolver& geometry, double tolerance,
  double nearest, double farthest, SharedNodes& shared)
  : Geometry(geometry)
  , Tolerance(tolerance)
  , Distance{ nearest, farthest }
  , Limit(geometry.GetMedia().Exterior > geometry.GetMedia().Interior
        ? std::asin(geometry.GetMedia().Interior / geometry.GetMedia().Exterior)
        : RightAngle)
  , Shared(shared)
{
}

//------------------------------------------------------------------------------
// The patch's points at its corners are the membrane's vertices.
SubCell SubCellDivision::MakeCorners(std::int32_t facet) const
{
  constexpr glm::dvec2 places[3] = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } };
  const Membrane& membrane = this->Geometry.GetMembrane();
  const Membrane::Facet& vertices = membrane.GetFacets()[static_cast<std::size_t>(facet)];
  SubCell nodes;
  for (std::size_t k = 0; k < 3; ++k)
  {
    nodes[k].B = places[k];
    nodes[k].From = this->Shared.GetRay(vertices[k],
      [this, &membrane, vertex = static_cast<std::size_t>(vertices[k])]()
      {
        return RefractAt({ membrane.GetPositions()[vertex], membrane.GetNormals()[vertex] },
          this->Geometry.GetMedia());
      });
  }
  return nodes;
}

//------------------------------------------------------------------------------
bool SubCellDivision::IsDivided(
  std::int32_t facet, const CurvedPatch& patch, const SubCell& nodes) const
{
  return this->Shared.IsDivided(facet,
    [this, &patch, &nodes]()
    {
      SubCellNode middle;
      return this->FindSplit(patch, nodes[1], nodes[2], 0, middle) ||
        this->FindSplit(patch, nodes[2], nodes[0], 0, middle) ||
        this->FindSplit(patch, nodes[0], nodes[1], 0, middle);
    });
}

//------------------------------------------------------------------------------
SubCellNode SubCellDivision::MakeNode(const CurvedPatch& patch, const glm::dvec2& b) const
{
  return { b, RefractAt(patch.Evaluate(b), this->Geometry.GetMedia()) };
}

//------------------------------------------------------------------------------
// True if a side has to be divided, and the node that divides it.
bool SubCellDivision::FindSplit(const CurvedPatch& patch, const SubCellNode& a,
  const SubCellNode& b, int depth, SubCellNode& split) const
{
  if (this->IsWide(a, b))
  {
    split = this->MakeNode(patch, 0.5 * (a.B + b.B));
    return true;
  }
  if (a.From.IsValid != b.From.IsValid)
  {
    if (a.IsAtLimit || b.IsAtLimit)
    {
      return false; // the part without rays of a side that has been divided
    }
    split = a.From.IsValid ? this->FindLimit(patch, a, b) : this->FindLimit(patch, b, a);
    return true;
  }
  const bool isChord = a.IsAtLimit && b.IsAtLimit;
  if (depth >= (isChord ? DeepestChords : DeepestSides))
  {
    return false;
  }
  split = this->MakeNode(patch, 0.5 * (a.B + b.B));
  if (!a.From.IsValid)
  {
    return split.From.IsValid || this->MayReachLimit(a, split, b);
  }
  if (isChord)
  {
    return this->IsOffLimit(a, split, b);
  }
  return !split.From.IsValid || this->IsBent(a, split, b);
}

//------------------------------------------------------------------------------
// True if a side is longer than its distance from the eye, so that places on it are seen in
// directions that its ends and its middle do not show. All of these sides are divided, so that
// sub-cells keep their shape. Where rays exist at all angles, it is enough to divide bent sides.
bool SubCellDivision::IsWide(const SubCellNode& a, const SubCellNode& b) const
{
  if (this->Limit >= RightAngle)
  {
    return false;
  }
  const glm::dvec3& first = a.From.At.Position;
  const glm::dvec3& second = b.From.At.Position;
  const glm::dvec3 along = second - first;
  const glm::dvec3 middle = 0.5 * (first + second) - this->Geometry.GetMedia().Eye;
  const glm::dvec2 part = glm::abs(b.B - a.B);
  return glm::dot(along, along) > glm::dot(middle, middle) &&
    std::max(part.x, part.y) > ShortestWideSide;
}

//------------------------------------------------------------------------------
bool SubCellDivision::IsWide(const SubCell& nodes) const
{
  return this->IsWide(nodes[0], nodes[1]) || this->IsWide(nodes[1], nodes[2]) ||
    this->IsWide(nodes[2], nodes[0]);
}

//------------------------------------------------------------------------------
// Last place with a ray on the way between two nodes.
SubCellNode SubCellDivision::FindLimit(
  const CurvedPatch& patch, const SubCellNode& valid, const SubCellNode& invalid) const
{
  SubCellNode last = valid;
  glm::dvec2 beyond = invalid.B;
  for (int i = 0; i < LimitSteps; ++i)
  {
    const SubCellNode middle = this->MakeNode(patch, 0.5 * (last.B + beyond));
    if (middle.From.IsValid)
    {
      last = middle;
    }
    else
    {
      beyond = middle.B;
    }
  }
  last.IsAtLimit = true;
  return last;
}

//------------------------------------------------------------------------------
// True if linear interpolation between a and b has an error above the tolerance at the middle. The
// error is measured where the refracted rays are at the object's nearest and farthest distance, and
// converted to an angle at the eye by the angle of the edge over the distance between the hits of
// its ends. The result does not depend on the primitive, so its neighbours divide the edge alike.
bool SubCellDivision::IsBent(
  const SubCellNode& a, const SubCellNode& middle, const SubCellNode& b) const
{
  const double angle = glm::length(a.From.At.Position - b.From.At.Position) /
    glm::length(middle.From.At.Position - this->Geometry.GetMedia().Eye);
  const auto isFar = [this, &a, &middle, &b, angle](double distance)
  {
    const auto hit = [distance](const SubCellNode& node)
    { return node.From.At.Position + distance * node.From.Ray; };
    const double error = glm::length(hit(middle) - 0.5 * (hit(a) + hit(b)));
    const double width = glm::length(hit(a) - hit(b));
    return angle * std::min(error, width) > this->Tolerance * width;
  };
  return isFar(this->Distance[0]) || isFar(this->Distance[1]);
}

//------------------------------------------------------------------------------
// Largest change of the angle of incidence between two nodes: those of sight ray and normal.
double SubCellDivision::GetAngle(const SubCellNode& a, const SubCellNode& b) const
{
  const glm::dvec3& eye = this->Geometry.GetMedia().Eye;
  return glm::length(
           glm::normalize(a.From.At.Position - eye) - glm::normalize(b.From.At.Position - eye)) +
    glm::length(glm::normalize(a.From.At.Normal) - glm::normalize(b.From.At.Normal));
}

//------------------------------------------------------------------------------
double SubCellDivision::GetIncidence(const SubCellNode& node) const
{
  const glm::dvec3 sight = glm::normalize(node.From.At.Position - this->Geometry.GetMedia().Eye);
  return std::acos(std::clamp(-glm::dot(sight, glm::normalize(node.From.At.Normal)), -1.0, 1.0));
}

//------------------------------------------------------------------------------
// True if rays may exist between three places without. Over a part of angle h the angle of
// incidence deviates from linear by about h^2 / 8; h^2 / 8 of both parts together is four times
// that.
bool SubCellDivision::MayReachLimit(
  const SubCellNode& a, const SubCellNode& middle, const SubCellNode& b) const
{
  const double angle = this->GetAngle(a, middle) + this->GetAngle(middle, b);
  const double least =
    std::min({ this->GetIncidence(a), this->GetIncidence(middle), this->GetIncidence(b) });
  const double pocket = 0.125 * angle * angle;
  return pocket > this->Tolerance && least - pocket < this->Limit;
}

//------------------------------------------------------------------------------
// True if the middle of a chord between two places at the limit is away from the limit by more than
// the tolerance, as an angle at the eye.
bool SubCellDivision::IsOffLimit(
  const SubCellNode& a, const SubCellNode& middle, const SubCellNode& b) const
{
  const double change = this->GetAngle(a, b);
  const double atEye = glm::length(a.From.At.Position - b.From.At.Position) /
    glm::length(middle.From.At.Position - this->Geometry.GetMedia().Eye);
  return std::fabs(this->GetIncidence(middle) - this->Limit) * atEye > this->Tolerance * change;
}

//------------------------------------------------------------------------------
double GetSize(const SubCell& nodes)
{
  const auto length = [&nodes](std::size_t i, std::size_t j)
  { return glm::length(nodes[i].From.At.Position - nodes[j].From.At.Position); };
  return std::max({ length(0, 1), length(1, 2), length(2, 0) });
}

//------------------------------------------------------------------------------
bool IsInside(const SubCell& nodes, const glm::dvec2& b)
{
  const double area = Cross(nodes[1].B - nodes[0].B, nodes[2].B - nodes[0].B);
  return Cross(nodes[1].B - b, nodes[2].B - b) / area >= 0.0 &&
    Cross(nodes[2].B - b, nodes[0].B - b) / area >= 0.0 &&
    Cross(nodes[0].B - b, nodes[1].B - b) / area >= 0.0;
}

//------------------------------------------------------------------------------
glm::dvec2 GuessSight(const SubCell& nodes, const glm::dvec3& point)
{
  const auto moment = [&nodes, &point](std::size_t k)
  { return glm::cross(nodes[k].From.At.Position - point, nodes[k].From.Ray); };
  const glm::dvec3 first = moment(0);
  const glm::dvec3 u = moment(1) - first;
  const glm::dvec3 v = moment(2) - first;
  const glm::dvec3 normal = glm::cross(u, v);
  const double squared = glm::dot(normal, normal);
  glm::dvec2 place(1.0 / 3.0);
  if (squared > 0.0)
  {
    // Foot of the perpendicular from 0 to the plane of the moments.
    place = { glm::dot(glm::cross(v, first), normal) / squared,
      glm::dot(glm::cross(first, u), normal) / squared };
    place = glm::clamp(place, 0.0, 1.0);
    place /= std::max(1.0, place.x + place.y);
  }
  return nodes[0].B + place.x * (nodes[1].B - nodes[0].B) + place.y * (nodes[2].B - nodes[0].B);
}

}
