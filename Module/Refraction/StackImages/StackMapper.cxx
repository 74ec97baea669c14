// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/StackImages/StackMapper.h"

#include "Refraction/StackImages/SurfaceMeeting.h"
#include "Refraction/Surface/BracketedZero.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

// Places in a patch from which Newton's method starts again, so that its result does not depend on
// the first guess: so many along a side of a part that is no wider than its distance from the eye.
constexpr double Grid = 1024.0;

// Halvings of the way from a place to the middle of its cell: down to a tolerance of the filter's
// default in a cell that is seen at an angle of a radian.
constexpr int MostHalvings = 14;

// Error of a sum of areas, for thousands of parts with some roundings each.
constexpr double Covered = 1e-10;

glm::dvec3 Mix(const glm::dvec3& a, const glm::dvec3& b, double s)
{
  return (1.0 - s) * a + s * b;
}

}

//------------------------------------------------------------------------------
ObjectPrimitive StackMapper::MakeTriangle(
  const MappedTriangle& triangle, std::int64_t sourceCell) const
{
  return ObjectPrimitive::MakeTriangle(triangle, sourceCell, this->Stack.GetOrigin());
}

//------------------------------------------------------------------------------
ObjectPrimitive StackMapper::MakeLine(const MappedTriangle& line, std::int64_t sourceCell) const
{
  return ObjectPrimitive::MakeLine(line, sourceCell, this->Stack.GetOrigin(), this->Stack.GetEye());
}

//------------------------------------------------------------------------------
void StackMapper::Clip(const ObjectPrimitive& primitive, std::vector<Part>& parts) const
{
  const std::size_t links = this->Sheet.GetNumberOfLinks();
  if (links == 0 || !(glm::dot(primitive.Normal, primitive.Normal) > 0.0) ||
    !this->Solver.IsInReach(primitive.Middle))
  {
    return; // a primitive without area covers no pixel; neither does a line along the line of sight
  }
  AxisBox box;
  for (const glm::dvec3& corner : primitive.Corners)
  {
    double slack = 0.0;
    for (std::size_t surface = 1; surface <= links; ++surface)
    {
      slack = std::max(slack, this->GetSlack(surface, corner));
    }
    box.Add({ corner - slack, corner + slack });
  }
  std::vector<std::int32_t> facets;
  for (std::size_t leg = 0; leg <= links; ++leg)
  {
    this->CollectFacets(primitive, leg, facets);
    for (const std::int32_t facet : facets)
    {
      this->Sheet.Visit(
        this->Sheet.GetPatch(facet), leg, box,
        [&primitive](const SubCell& nodes) { return primitive.IsOutside(nodes); },
        [&](const LegCell& cell) {
          this->ClipCell(primitive, { leg, facet, cell, {}, 0.0 }, parts);
        });
    }
  }
}

//------------------------------------------------------------------------------
// Facets of the first surface whose rays may show the primitive on a leg, in their order.
void StackMapper::CollectFacets(
  const ObjectPrimitive& primitive, std::size_t leg, std::vector<std::int32_t>& facets) const
{
  facets.clear();
  if (leg > 0)
  {
    this->Solver.GetBeams().VisitFacets(leg, primitive.Middle, primitive.Padding,
      [&facets](std::int32_t facet) { facets.push_back(facet); });
  }
  else
  {
    // Straight rays to the primitive, at the parameter 1, that meet the surface behind it.
    const RefractionStack::Link& first = this->Stack.GetLinks().front();
    const glm::dvec3 eye = this->Stack.GetEye() - first.Shift;
    const glm::dvec3 toward = primitive.Middle - this->Stack.GetEye();
    const TubeBounds tube{ eye, eye, toward - primitive.Padding, toward + primitive.Padding };
    first.Surface->VisitFacets(tube,
      [&facets](std::int32_t facet, const TubeRange& range)
      {
        if (range.To >= 1.0 - 64.0 * Epsilon)
        {
          facets.push_back(facet);
        }
      });
  }
  std::sort(facets.begin(), facets.end());
}

//------------------------------------------------------------------------------
void StackMapper::ClipCell(
  const ObjectPrimitive& primitive, const Part& cell, std::vector<Part>& parts) const
{
  const bool isLast = cell.Leg == this->Stack.GetLinks().size();
  Polygon whole(3);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const RefractedPoint& from = cell.Cell.Nodes[i].From;
    whole[i].B = cell.Cell.Nodes[i].B;
    whole[i].Edges = 7u & ~(1u << i);
    primitive.Measure(from, whole[i].Value);
    // The last leg has no end: 0 clips nothing. The cosine, which is the sum of the coordinates,
    // would clip within rounding where a primitive is seen edge-on.
    whole[i].Value[PrimitiveConstraints] =
      isLast ? 0.0 : glm::dot(primitive.Normal, cell.Cell.Ends[i] - primitive.Corners[0]);
    whole[i].Limits = 0;
    for (int k = 1; k < PrimitiveConstraints && !primitive.IsLine; ++k)
    {
      whole[i].Limits |= whole[i].Value[k] == 0.0 ? 1u << k : 0u;
    }
  }
  if (!this->ResolveTies(primitive, cell, whole))
  {
    return;
  }
  Polygon polygon;
  for (const double sign : { 1.0, -1.0 })
  {
    primitive.Clip(whole, sign, polygon);
    if (primitive.IsLine ? polygon.size() == 2 : polygon.size() > 2)
    {
      parts.push_back({ cell.Leg, cell.Facet, cell.Cell, polygon, sign });
    }
  }
}

//------------------------------------------------------------------------------
// Rounding of the surface, counted from 1, and of the object at a place: both were moved from world
// coordinates.
double StackMapper::GetSlack(std::size_t surface, const glm::dvec3& place) const
{
  return this->Stack.GetLinks()[surface - 1].Surface->GetSlack(
    glm::length(place) + glm::length(this->Stack.GetOrigin()));
}

//------------------------------------------------------------------------------
// Ties of a primitive with the surfaces at the ends of a leg: a surface that clips nothing has the
// value 0. Returns false if the leg does not show the primitive in the cell.
bool StackMapper::ResolveTies(
  const ObjectPrimitive& primitive, const Part& cell, Polygon& whole) const
{
  for (const bool isEnd : { false, true })
  {
    const std::size_t surface = cell.Leg + (isEnd ? 1 : 0); // counted from 1
    if (surface == 0 || surface > this->Stack.GetLinks().size())
    {
      continue;
    }
    const std::array<glm::dvec3, 3> corners = GetSurfaceCorners(cell.Cell, isEnd);
    if (!ResolveSurfaceTie(primitive, corners, isEnd ? PrimitiveConstraints : 0,
          this->GetSlack(surface, corners[0]), whole))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// The sense of rotation of the cell from the eye, and that of the primitive along the rays.
int StackMapper::GetOrientation(const CurvedPatch& patch, const Part& part, double area) const
{
  const SubCell& nodes = part.Cell.Nodes;
  const glm::dvec3 corner = patch.GetFlatPoint(nodes[0].B);
  const glm::dvec3 facet =
    glm::cross(patch.GetFlatPoint(nodes[1].B) - corner, patch.GetFlatPoint(nodes[2].B) - corner);
  const glm::dvec3 eye = this->Stack.GetEye() - this->Stack.GetLinks().front().Shift;
  const bool facetTurned = glm::dot(facet, corner - eye) < 0.0;
  const bool imageTurned = (area < 0.0) != (part.Sign < 0.0);
  return facetTurned == imageTurned ? 1 : -1;
}

//------------------------------------------------------------------------------
bool StackMapper::IsWhole(
  const ObjectPrimitive& triangle, const std::vector<Part>& parts, double tolerance) const
{
  const std::array<KnownImages, 3>& images = triangle.Primitive.Images;
  for (const KnownImages& known : images)
  {
    if (known.Count != 1 || known.First->Passed != images[0].First->Passed ||
      known.First->Vertex.Orientation != images[0].First->Vertex.Orientation)
    {
      return false;
    }
  }
  const glm::dvec3 eye = this->Stack.GetEye() + this->Stack.GetOrigin();
  const glm::dvec3 shift = this->Stack.GetLinks().front().Shift + this->Stack.GetOrigin();
  double sum = 0.0;
  for (const Part& part : parts)
  {
    const CurvedPatch& patch = SightSheet::GetSurface(this->Sheet.GetPatch(part.Facet));
    const double area = GetArea(part.Corners);
    if (part.Leg != static_cast<std::size_t>(images[0].First->Passed) ||
      this->GetOrientation(patch, part, area) != images[0].First->Vertex.Orientation)
    {
      return false;
    }
    sum += std::fabs(area);
    for (const Corner& corner : part.Corners)
    {
      const glm::dvec3 weight = glm::dvec3(corner.Value[1], corner.Value[2], corner.Value[3]) /
        (corner.Value[1] + corner.Value[2] + corner.Value[3]);
      glm::dvec3 drawn = -eye;
      for (glm::length_t k = 0; k < 3; ++k)
      {
        drawn += weight[k] * images[static_cast<std::size_t>(k)].First->Vertex.Position;
      }
      const glm::dvec3 seen = patch.Evaluate(corner.B).Position + shift - eye;
      // Written so that a NaN fails.
      if (!(glm::length(glm::cross(drawn, seen)) <=
            tolerance * glm::length(drawn) * glm::length(seen)))
      {
        return false;
      }
    }
  }
  return std::fabs(sum - 1.0) <= Covered;
}

//------------------------------------------------------------------------------
// As PrimitiveMapper::MakePoint: the features that the corner lies on decide which equation is
// solved.
StackMapper::MappedPoint StackMapper::MakePoint(const Context& context, const Corner& corner) const
{
  const ObjectPrimitive& primitive = context.Primitive;
  const ClippedBoundary on = primitive.FindBoundary(corner);
  if (on.Membrane || on.LegEnd)
  {
    return this->MakeOnSurface(context, on, corner);
  }
  if (on.End >= 0)
  {
    return this->MakeEnd(context, on.End, corner.B);
  }
  if (on.Node >= 0)
  {
    const SubCellNode& node = context.Cell.Nodes[static_cast<std::size_t>(on.Node)];
    StackPath path;
    const bool isTraced = this->TracePlace(context, node.B, context.Leg, path);
    if (on.Side >= 0)
    {
      return this->MakeOnSide(
        context, static_cast<std::size_t>(on.Side), node.B, node.From, isTraced ? &path : nullptr);
    }
    // All coordinates have the same sign here.
    const glm::dvec3 value(corner.Value[1], corner.Value[2], corner.Value[3]);
    const glm::dvec3 weight = glm::max(value / (value.x + value.y + value.z), glm::dvec3(0.0));
    return { this->Finish(
               context, isTraced ? &path : nullptr, node.B, primitive.GetPoint(weight), weight),
      Finding::Found };
  }
  return this->MakeOnEdge(context, on, corner.B);
}

//------------------------------------------------------------------------------
// Image of the point of a side of the primitive that the rays through an edge of the cell meet.
StackMapper::MappedPoint StackMapper::MakeOnEdge(
  const Context& context, const ClippedBoundary& on, const glm::dvec2& place) const
{
  const auto side = static_cast<std::size_t>(on.Side);
  const ObjectLine& line = context.Primitive.Sides[side].Line;
  const SubCellNode& a = context.Cell.Nodes[static_cast<std::size_t>((on.Edge + 1) % 3)];
  const SubCellNode& b = context.Cell.Nodes[static_cast<std::size_t>((on.Edge + 2) % 3)];
  const SubCellSide along(context.Patch, a.B, b.B);
  const SubCellNode& start = along.IsTurned() ? b : a;
  const SubCellNode& end = along.IsTurned() ? a : b;
  const double length = glm::length(line.Direction);
  StackPath path;
  RefractedPoint from;
  bool isTraced = false;
  // Where a ray of the side does not pass, interpolation takes its place.
  const auto trace = [&](double s)
  {
    isTraced = this->TraceSide(context, along, s, context.Leg, path);
    const RayJet* ray = isTraced && context.Leg > 0 ? &path.Points[context.Leg - 1].Ray : nullptr;
    const glm::dvec3 mixed = Mix(start.From.Ray, end.From.Ray, s);
    from.At.Position = ray ? ray->Origin : Mix(start.From.At.Position, end.From.At.Position, s);
    from.Ray = ray ? ray->Direction : (isTraced ? path.Sight : glm::normalize(mixed));
  };
  const double zero = FindZero(GetMoment(line, start.From), GetMoment(line, end.From),
    [&](double s, double& value)
    {
      trace(s);
      value = GetMoment(line, from);
      // The moment is a sum of products of three lengths, each rounded a few times.
      return std::fabs(value) <=
        4.0 * Epsilon * length * glm::length(from.At.Position - line.Origin);
    });
  if (zero == 0.0 || zero == 1.0)
  {
    const SubCellNode& node = zero == 0.0 ? start : end;
    isTraced = this->TracePlace(context, node.B, context.Leg, path);
    from = node.From;
  }
  else
  {
    trace(zero);
  }
  return this->MakeOnSide(context, side, place, from, isTraced ? &path : nullptr);
}

//------------------------------------------------------------------------------
// Image of the point in which a ray meets a side of the primitive. Beyond the end of the side, the
// result is the image of that end.
StackMapper::MappedPoint StackMapper::MakeOnSide(const Context& context, std::size_t side,
  const glm::dvec2& b, const RefractedPoint& from, const StackPath* path) const
{
  const ObjectPrimitive::Side& on = context.Primitive.Sides[side];
  const double l = GetParameter(on.Line, from);
  const auto first = static_cast<glm::length_t>((side + (on.Turned ? 1 : 0)) % 3);
  const auto last = static_cast<glm::length_t>((side + (on.Turned ? 0 : 1)) % 3);
  if (!(l > 0.0 && l < 1.0))
  {
    return this->MakeEnd(context, l < 0.5 ? first : last, b);
  }
  glm::dvec3 weight(0.0);
  weight[first] = 1.0 - l;
  weight[last] = l;
  return { this->Finish(context, path, b, on.Line.GetPoint(l), weight), Finding::Found };
}

//------------------------------------------------------------------------------
// As PrimitiveMapper::MakeEnd. An end next to an interface may have been found on the other side of
// it.
StackMapper::MappedPoint StackMapper::MakeEnd(
  const Context& context, glm::length_t end, const glm::dvec2& b) const
{
  const auto index = static_cast<std::size_t>(end);
  const glm::dvec3& local = context.Primitive.Corners[index];
  const glm::dvec3 shift = this->Stack.GetLinks().front().Shift;
  const glm::dvec3 middle = context.Patch.Evaluate(b).Position + shift + this->Stack.GetOrigin();
  const double size = this->GetSize(context);
  const KnownImages& known = context.Primitive.Primitive.Images[index];
  const auto leg = static_cast<std::int32_t>(context.Leg);
  const ImagePoint* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const ImagePoint* image = known.First; image != known.First + known.Count; ++image)
  {
    // A point in front of all interfaces is its own sight point.
    const bool isStraight = image->Passed == 0;
    const double distance = isStraight
      ? (leg == 0 ? 0.0 : glm::length(image->Vertex.Position - middle))
      : glm::length(image->Vertex.SightPoint - middle);
    if (std::abs(image->Passed - leg) <= 1 && distance < least)
    {
      nearest = image;
      least = distance;
    }
  }
  glm::dvec3 weight(0.0);
  weight[end] = 1.0;
  if (nearest && least <= size)
  {
    ImagePoint point = *nearest;
    point.SetSource(context.Primitive.Primitive.Ids, weight);
    return { point, Finding::Found };
  }
  const Finding without = nearest ? Finding::Elsewhere : Finding::EndWithoutImage;
  StackPath path;
  const glm::dvec2 guess = GuessSight(context.Cell.Nodes, local);
  const bool isTraced = this->TracePlace(context, guess, context.Leg, path);
  if (context.Leg == 0 || !isTraced)
  {
    return { this->Finish(context, nullptr, guess, local, weight), without };
  }
  StackPath shot = path;
  const bool isFound = Shoot(this->Stack, { local, context.Leg }, { context.Facet, guess },
                         ShotSteps, shot) == ShotEnd::Converged &&
    glm::length(shot.Points[0].Ray.Origin - path.Points[0].Ray.Origin) <= size;
  return { this->Finish(context, isFound ? &shot : &path, guess, local, weight),
    isFound ? Finding::Found : without };
}

//------------------------------------------------------------------------------
// Point where the primitive meets the surface at the beginning or the end of the leg: that of a
// side of the cell, or of a side of the primitive. Legs on both sides of the surface get the same
// point, which is seen on the leg in front of it.
StackMapper::MappedPoint StackMapper::MakeOnSurface(
  const Context& context, const ClippedBoundary& on, const Corner& corner) const
{
  const ObjectPrimitive& primitive = context.Primitive;
  glm::dvec3 weight = primitive.IsLine
    ? glm::dvec3(corner.Value[2], corner.Value[1], 0.0)
    : glm::dvec3(corner.Value[1], corner.Value[2], corner.Value[3]);
  weight /= weight.x + weight.y + weight.z;
  if (on.Membrane && context.Leg == 0)
  {
    return { this->Finish(context, nullptr, corner.B, primitive.GetPoint(weight), weight),
      Finding::Elsewhere }; // at the eye
  }
  const std::size_t surface = context.Leg + (on.Membrane ? 0 : 1);
  int side = on.Side;
  if (on.Edge >= 0 && side < 0)
  {
    const auto i = static_cast<std::size_t>((on.Edge + 1) % 3);
    const auto j = static_cast<std::size_t>((on.Edge + 2) % 3);
    const LegCell& cell = context.Cell;
    const SubCellSide along(context.Patch, cell.Nodes[i].B, cell.Nodes[j].B);
    const std::size_t start = along.IsTurned() ? j : i;
    const std::size_t end = along.IsTurned() ? i : j;
    const auto get = [&cell, &on](std::size_t k)
    { return on.Membrane ? cell.Nodes[k].From.At.Position : cell.Ends[k]; };
    StackPath path;
    glm::dvec3 place(0.0);
    bool isTraced = false;
    const auto trace = [&](double s)
    {
      isTraced = this->TraceSide(context, along, s, surface, path);
      place = isTraced ? path.Points[surface - 1].Ray.Origin : Mix(get(start), get(end), s);
    };
    const glm::dvec3& origin = primitive.Corners[0];
    const double length = glm::length(primitive.Normal);
    const double zero = FindZero(glm::dot(primitive.Normal, get(start) - origin),
      glm::dot(primitive.Normal, get(end) - origin),
      [&](double s, double& value)
      {
        trace(s);
        value = glm::dot(primitive.Normal, place - origin);
        return std::fabs(value) <= 4.0 * Epsilon * length * glm::length(place - origin);
      });
    trace(zero);
    weight = primitive.GetWeight(place);
    const glm::length_t least =
      weight.x < weight.y ? (weight.x < weight.z ? 0 : 2) : (weight.y < weight.z ? 1 : 2);
    if (weight[least] >= 0.0 && isTraced)
    {
      Context inFront{ primitive, surface - 1, context.Facet, context.Patch, cell };
      return { this->Finish(inFront, &path, corner.B, place, weight), Finding::Found };
    }
    side = static_cast<int>(least) + 1;
  }
  return side < 0
    ? MappedPoint{ {}, Finding::Elsewhere }
    : this->MakeSideCrossing(context, static_cast<std::size_t>(side), surface, corner.B, weight);
}

//------------------------------------------------------------------------------
// Point in which a side of the primitive crosses a surface.
StackMapper::MappedPoint StackMapper::MakeSideCrossing(const Context& context, std::size_t side,
  std::size_t surface, const glm::dvec2& b, glm::dvec3 weight) const
{
  const ObjectPrimitive& primitive = context.Primitive;
  const ObjectPrimitive::Side& on = primitive.Sides[side];
  const RefractionStack::Link& link = this->Stack.GetLinks()[surface - 1];
  const auto first = static_cast<glm::length_t>((side + (on.Turned ? 1 : 0)) % 3);
  const auto last = static_cast<glm::length_t>((side + (on.Turned ? 0 : 1)) % 3);
  const glm::dvec3 sight = context.Patch.Evaluate(context.Cell.Nodes[0].B).Position +
    this->Stack.GetLinks().front().Shift - this->Stack.GetEye();
  const double angle = this->GetSize(context) / glm::length(sight);
  double l = std::clamp(weight[last] / (weight[first] + weight[last]), 0.0, 1.0);
  if (!MoveToSurface(link, on.Line, GetSurfaceCorners(context.Cell, surface == context.Leg + 1),
        this->Sheet.GetTolerance() / angle, l))
  {
    return { {}, Finding::Elsewhere };
  }
  if (!(l > 0.0 && l < 1.0))
  {
    return this->MakeEnd(context, l < 0.5 ? first : last, b);
  }
  glm::dvec3 place(0.0);
  place[first] = 1.0 - l;
  place[last] = l;
  const glm::dvec3 local = on.Line.GetPoint(l);
  Context inFront{ primitive, surface - 1, context.Facet, context.Patch, context.Cell };
  if (surface == 1)
  {
    return { this->Finish(inFront, nullptr, b, local, place), Finding::Found };
  }
  StackPath path;
  const StackTarget target{ local, surface - 1 };
  const bool isFound = this->TracePlace(inFront, b, surface - 1, path) &&
    Shoot(this->Stack, target, { context.Facet, b }, ShotSteps, path) == ShotEnd::Converged &&
    this->ShootAgain(target, path);
  return { this->Finish(inFront, isFound ? &path : nullptr, b, local, place),
    isFound ? Finding::Found : Finding::Elsewhere };
}

//------------------------------------------------------------------------------
bool StackMapper::ShootAgain(const StackTarget& target, StackPath& path) const
{
  StackPlace place = path.Points[0].Place;
  const CurvedPatch patch = this->Stack.GetLinks()[0].Surface->GetPatches().GetPatch(place.Facet);
  const double grid = std::ldexp(Grid, BeamDivision::CountNearLevels(this->Stack, patch, place.B));
  place.B = glm::round(grid * place.B) / grid;
  return this->Stack.Trace(place, target.Count, true, path) == PathEnd::Passed &&
    Shoot(this->Stack, target, place, ShotSteps, path) == ShotEnd::Converged;
}

//------------------------------------------------------------------------------
// Path from a place on a side of the cell to the surface `count`, which it passes or is reflected
// at; with 0 to the first surface.
bool StackMapper::TraceSide(const Context& context, const SubCellSide& side, double s,
  std::size_t count, StackPath& path) const
{
  const std::size_t reach = std::max<std::size_t>(count, 1);
  const PathEnd end =
    this->Stack.TraceFrom({ context.Facet, glm::dvec2(1.0 / 3.0) }, side.Evaluate(s), reach, path);
  return path.Count == reach || (end == PathEnd::Reflected && path.Count + 1 == reach);
}

//------------------------------------------------------------------------------
bool StackMapper::TracePlace(
  const Context& context, const glm::dvec2& b, std::size_t count, StackPath& path) const
{
  path = StackPath();
  return count == 0 ||
    this->Stack.Trace({ context.Facet, b }, count, false, path) == PathEnd::Passed;
}

//------------------------------------------------------------------------------
// A ray of the context's leg next to a place in its cell. The limit of the leg, where a cell ends,
// is within the tolerance of the cell's side: a ray a little farther inside passes.
void StackMapper::TraceNear(const Context& context, const glm::dvec2& b, StackPath& path) const
{
  const SubCell& nodes = context.Cell.Nodes;
  const glm::dvec2 middle = (nodes[0].B + nodes[1].B + nodes[2].B) / 3.0;
  for (int k = MostHalvings; k >= 0; --k)
  {
    if (this->TracePlace(context, glm::mix(b, middle, std::ldexp(1.0, -k)), context.Leg, path))
    {
      return;
    }
  }
  this->TracePlace(context, nodes[0].B, context.Leg, path);
}

//------------------------------------------------------------------------------
// The image of a point on the context's leg. Without a path, a ray next to the place `b` gives one.
ImagePoint StackMapper::Finish(const Context& context, const StackPath* path, const glm::dvec2& b,
  const glm::dvec3& local, const glm::dvec3& weight) const
{
  const glm::dvec3 world = local + this->Stack.GetOrigin();
  ImagePoint point;
  StackPath own;
  if (context.Leg > 0)
  {
    if (path && path->Count >= context.Leg)
    {
      own = *path;
    }
    else
    {
      this->TraceNear(context, b, own);
    }
    own.Count = context.Leg;
    point.Vertex = this->Solver.MakeVertex(world, own);
    point.Passed = static_cast<std::int32_t>(context.Leg);
  }
  else
  {
    point.Vertex = this->Solver.MakeVertex(world, own);
  }
  point.SetSource(context.Primitive.Primitive.Ids, weight);
  return point;
}

//------------------------------------------------------------------------------
// Length of the cell's longest side on the first surface.
double StackMapper::GetSize(const Context& context) const
{
  std::array<glm::dvec3, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
  {
    corners[k] = context.Patch.Evaluate(context.Cell.Nodes[k].B).Position;
  }
  return GetLongestSide(corners);
}

}
