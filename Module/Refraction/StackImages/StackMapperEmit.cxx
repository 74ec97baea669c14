// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Output of parts with exact corners.
#include "Refraction/StackImages/StackMapper.h"

#include "Refraction/Membrane/CrossProduct.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

// Each quartering of a cell reduces the error of linear interpolation to a quarter: five of them to
// a thousandth of the tolerance.
constexpr int MostQuarterings = 5;

}

//------------------------------------------------------------------------------
// Twice the signed area of a polygon in the primitive's second and third barycentric coordinates.
double StackMapper::GetArea(const Polygon& polygon)
{
  return GetTwiceArea(polygon.size(),
    [&polygon](std::size_t i)
    {
      const auto& value = polygon[i].Value;
      return glm::dvec2(value[2], value[3]) / (value[1] + value[2] + value[3]);
    });
}

//------------------------------------------------------------------------------
void StackMapper::Emit(
  const ObjectPrimitive& primitive, const std::vector<Part>& parts, ImageMesh& images) const
{
  for (const Part& part : parts)
  {
    this->EmitPart(primitive, part, 0, images);
  }
}

//------------------------------------------------------------------------------
// A part whose corners contradict each other is mapped again from the quarters of its cell: where a
// primitive is seen nearly edge-on, an error of the rays within the tolerance moves corners far
// along the primitive.
void StackMapper::EmitPart(
  const ObjectPrimitive& primitive, const Part& part, int depth, ImageMesh& images) const
{
  const Context context{ primitive, part.Leg, part.Facet,
    SightSheet::GetSurface(this->Sheet.GetPatch(part.Facet)), part.Cell };
  const bool isEmitted = primitive.IsLine ? this->EmitLine(context, part.Corners, images)
                                          : this->EmitPolygon(context, part, images);
  if (isEmitted)
  {
    return;
  }
  if (!this->IsVisible(context, part.Corners))
  {
    this->Solver.CountNarrowPart();
    return;
  }
  std::array<LegCell, 4> quarters;
  if (depth == MostQuarterings || !this->DivideCell(part, quarters))
  {
    this->Solver.CountUndecided();
    return;
  }
  std::vector<Part> parts;
  for (const LegCell& quarter : quarters)
  {
    this->ClipCell(primitive, { part.Leg, part.Facet, quarter, {}, 0.0 }, parts);
  }
  for (const Part& next : parts)
  {
    if (next.Sign == part.Sign)
    {
      this->EmitPart(primitive, next, depth + 1, images);
    }
  }
}

//------------------------------------------------------------------------------
// Sets the quarters of a part's cell. Returns false if the ray at the middle of a side does not go
// as far as the leg's end.
bool StackMapper::DivideCell(const Part& part, std::array<LegCell, 4>& quarters) const
{
  const std::size_t links = this->Stack.GetLinks().size();
  LegCell middle; // opposite the corners
  StackPath path;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2 b = 0.5 * (part.Cell.Nodes[(k + 1) % 3].B + part.Cell.Nodes[(k + 2) % 3].B);
    path.Forget(links);
    const std::size_t reach = std::min(part.Leg + 1, links);
    const PathEnd end = this->Stack.Trace({ part.Facet, b }, reach, false, path);
    if (path.Count < part.Leg || (end == PathEnd::Missed && path.Count < reach))
    {
      return false;
    }
    const RayJet* ray = part.Leg > 0 ? &path.Points[part.Leg - 1].Ray : nullptr;
    middle.Nodes[k] = { b,
      { { ray ? ray->Origin : this->Stack.GetEye(), glm::dvec3(0.0) },
        ray ? ray->Direction : path.Sight, true } };
    middle.Ends[k] = part.Leg < links ? path.Points[part.Leg].Ray.Origin : glm::dvec3(0.0);
  }
  quarters[3] = middle;
  for (std::size_t k = 0; k < 3; ++k)
  {
    quarters[k] = middle;
    quarters[k].Nodes[k] = part.Cell.Nodes[k];
    quarters[k].Ends[k] = part.Cell.Ends[k];
    std::swap(quarters[k].Nodes[(k + 1) % 3], quarters[k].Nodes[(k + 2) % 3]);
    std::swap(quarters[k].Ends[(k + 1) % 3], quarters[k].Ends[(k + 2) % 3]);
  }
  return true;
}

//------------------------------------------------------------------------------
// False if a part is seen as a strip, or as a dot, narrower than the tolerance: interpolation may
// have found it where the rays only come near the primitive.
bool StackMapper::IsVisible(const Context& context, const Polygon& polygon) const
{
  const glm::dvec3 eye = this->Stack.GetEye() - this->Stack.GetLinks().front().Shift;
  std::vector<glm::dvec3> sights;
  for (const Corner& corner : polygon)
  {
    sights.push_back(glm::normalize(context.Patch.Evaluate(corner.B).Position - eye));
  }
  double longest = 0.0;
  double area = 0.0;
  for (std::size_t i = 1; i < sights.size(); ++i)
  {
    longest = std::max(longest, glm::length(sights[i] - sights[0]));
    area += 0.5 * glm::length(glm::cross(sights[i - 1] - sights[0], sights[i] - sights[0]));
  }
  // A polygon of area A and length L has a width of A / L at least, and 2 A / L at most.
  const double width = context.Primitive.IsLine ? longest : area / longest;
  return width > this->Sheet.GetTolerance();
}

//------------------------------------------------------------------------------
// Returns false if interpolation has found the primitive where the corners do not.
bool StackMapper::EmitPolygon(const Context& context, const Part& part, ImageMesh& images) const
{
  const double area = GetArea(part.Corners);
  if (!(std::fabs(area) > 0.0))
  {
    return true;
  }
  std::vector<MappedPoint> points;
  std::size_t unseenEnds = 0;
  for (const Corner& corner : part.Corners)
  {
    points.push_back(this->MakePoint(context, corner));
    if (points.back().Outcome == Finding::Elsewhere)
    {
      return false; // as PrimitiveMapper::IsSeen
    }
    unseenEnds += points.back().Outcome == Finding::EndWithoutImage;
  }
  if (unseenEnds == points.size())
  {
    return false;
  }
  const int orientation = this->GetOrientation(context.Patch, part, area);
  for (MappedPoint& point : points)
  {
    point.Point.Vertex.Orientation = static_cast<signed char>(orientation);
  }
  images.AddCell(
    points.size(), [&points](std::size_t i) { return points[i].Point; }, !(area > 0.0),
    context.Primitive.SourceCell, orientation);
  return true;
}

//------------------------------------------------------------------------------
bool StackMapper::EmitLine(const Context& context, const Polygon& polygon, ImageMesh& images) const
{
  const auto along = [](const Corner& c) { return c.Value[1] / (c.Value[1] + c.Value[2]); };
  const bool turned = along(polygon[0]) > along(polygon[1]);
  const MappedPoint ends[2] = { this->MakePoint(context, polygon[turned ? 1 : 0]),
    this->MakePoint(context, polygon[turned ? 0 : 1]) };
  if (ends[0].Outcome == Finding::Elsewhere || ends[1].Outcome == Finding::Elsewhere)
  {
    return false;
  }
  images.AddCell(
    2, [&ends](std::size_t i) { return ends[i].Point; }, false, context.Primitive.SourceCell, 1);
  return true;
}

}
