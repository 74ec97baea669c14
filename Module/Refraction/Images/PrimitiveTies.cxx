// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Primitives that touch the membrane, or lie in it, within rounding or within the tolerance.
#include "Refraction/Images/PrimitiveContext.h"
#include "Refraction/Images/PrimitiveMapper.h"
#include "Refraction/Images/SurfaceTie.h"
#include "Refraction/Membrane/CrossProduct.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

std::array<glm::dvec3, 3> GetCorners(const SubCell& nodes)
{
  return { nodes[0].From.At.Position, nodes[1].From.At.Position, nodes[2].From.At.Position };
}

}

//------------------------------------------------------------------------------
// Maps a primitive as if all of it were behind the membrane, if no part is farther in front than
// the tolerance. A side in the membrane, within rounding of object and membrane, is no waterline
// that could be computed. Returns false, and adds nothing, if a part is farther in front.
bool PrimitiveMapper::MapAsBehind(Context& context, ImageMesh& images) const
{
  const glm::dvec3& eye = this->Geometry.GetMedia().Eye;
  for (std::size_t k = 0; k < (context.IsLine ? 2u : 3u); ++k)
  {
    const KnownImages& known = context.Primitive.Images[k];
    const bool isInFront = known.Count == 1 && known.First->Vertex.Facet == CurvedPatches::NoFacet;
    const glm::dvec3 sight = context.Corners[k] - eye;
    if (this->Geometry.GetMedia().Reflects ||
      (isInFront && this->Geometry.IsInFront(eye + (1.0 + this->Tolerance) * sight)))
    {
      return false;
    }
  }
  const ImageMesh::Mark before = images.GetMark();
  bool isInFront = false;
  context.Images = &images;
  context.IsPartInFront = &isInFront;
  this->Map(context);
  context.IsPartInFront = nullptr;
  if (isInFront)
  {
    images.ReturnTo(before);
  }
  return !isInFront;
}

//------------------------------------------------------------------------------
// Length in front of the membrane up to which a primitive is looked for: none if its part in front
// is cut off, any if that is to be found.
double PrimitiveMapper::GetLengthInFront(const Context& context) const
{
  if (context.IsPartInFront != nullptr)
  {
    return std::numeric_limits<double>::infinity();
  }
  const glm::dvec3 away = glm::abs(context.Middle - this->Geometry.GetMedia().Eye);
  return context.IsOnMembrane ? 0.0 : this->Tolerance * glm::length(away + context.Padding);
}

//------------------------------------------------------------------------------
// Length that the tolerance is at the membrane.
double PrimitiveMapper::GetReach(const SubCell& nodes) const
{
  return this->Tolerance * glm::length(nodes[0].From.At.Position - this->Geometry.GetMedia().Eye);
}

//------------------------------------------------------------------------------
// True if a place on the line of a ray is in front of the membrane by more than the tolerance.
bool PrimitiveMapper::IsInFront(
  const SubCell& nodes, const RefractedPoint& from, const glm::dvec3& place) const
{
  return glm::dot(place - from.At.Position, from.Ray) < -this->GetReach(nodes);
}

//------------------------------------------------------------------------------
// Replaces a part that ends at the membrane by the one that does not, if that is in front of the
// membrane by less than the error of interpolation.
void PrimitiveMapper::KeepAsBehind(const Context& context, const SubCell& nodes,
  const Polygon& whole, double sign, Polygon& polygon) const
{
  const auto getCosine = [&context](const Corner& corner)
  { return corner.Value[1] + corner.Value[2] + (context.IsLine ? 0.0 : corner.Value[3]); };
  const auto isCut = [sign](const Corner& corner) { return sign * corner.Value[0] < 0.0; };
  const auto isFacing = [&](const Corner& corner) { return sign * getCosine(corner) > 0.0; };
  if (std::none_of(whole.begin(), whole.end(), isCut) ||
    std::none_of(whole.begin(), whole.end(), isFacing))
  {
    return;
  }
  Polygon uncut = whole;
  for (Corner& corner : uncut)
  {
    corner.Value[0] = 0.0;
  }
  context.Clip(Polygon(uncut), sign, uncut);
  // The distance behind the membrane is linear in the sub-cell.
  const glm::dvec2 u = whole[1].B - whole[0].B;
  const glm::dvec2 v = whole[2].B - whole[0].B;
  const double area = Cross(u, v);
  const double byU = (whole[1].Value[0] - whole[0].Value[0]) / area;
  const double byV = (whole[2].Value[0] - whole[0].Value[0]) / area;
  const double most = this->GetReach(nodes);
  const bool isNear = std::all_of(uncut.begin(), uncut.end(),
    [&](const Corner& corner)
    {
      const glm::dvec2 b = corner.B - whole[0].B;
      const double behind = whole[0].Value[0] + byU * Cross(b, v) + byV * Cross(u, b);
      return sign * behind >= -most * sign * getCosine(corner);
    });
  if (isNear)
  {
    polygon.swap(uncut);
  }
  else if (context.IsPartInFront)
  {
    *context.IsPartInFront = true;
  }
}

//------------------------------------------------------------------------------
// Tie of the primitive with the membrane: a membrane that clips nothing has the value 0. Returns
// false if the part of the primitive in the sub-cell is in front of the membrane.
bool PrimitiveMapper::ResolveTie(const Context& context, const SubCell& nodes, Polygon& whole) const
{
  const std::array<glm::dvec3, 3> corners = GetCorners(nodes);
  // Membrane and object were moved from world coordinates.
  const Membrane& membrane = this->Geometry.GetMembrane();
  const double slack =
    membrane.GetSlack(glm::length(corners[0]) + glm::length(membrane.GetOrigin()));
  return ResolveSurfaceTie(context, corners, 0, slack, whole);
}

//------------------------------------------------------------------------------
// True if the side, around its place `l`, stays closer to the membrane, over one length of the
// sub-cell, than the error of linear interpolation there. Then the sub-cell does not determine
// where the two cross, and may have a crossing where they have none. Moves `b` to the foot of the
// place, or, with `l`, to the crossing if the sub-cell has it: neighbours agree on that.
bool PrimitiveMapper::StaysAlong(const CurvedPatch& patch, const SubCell& nodes,
  const ObjectLine& side, double& l, glm::dvec2& b) const
{
  const double most = this->GetReach(nodes);
  glm::dvec3 normal;
  if (!RunsAlong(side.Direction, GetCorners(nodes), most, normal))
  {
    return false;
  }
  const auto findFoot = [&patch, &side, &normal, most](double place, glm::dvec2& foot)
  {
    double distance = 0.0;
    return MeetPatch(patch, { side.GetPoint(place), normal }, foot, distance) &&
      std::fabs(distance) <= most;
  };
  glm::dvec2 foot = b;
  if (!findFoot(l, foot))
  {
    return false;
  }
  b = foot;
  double crossing = l;
  if (MeetPatchAgain(patch, side, foot, crossing) && IsInside(nodes, foot))
  {
    b = foot;
    l = crossing;
  }
  return true;
}

}
