// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/PrimitiveMapper.h"

#include "Refraction/Curved/CurveCrossings.h"
#include "Refraction/Images/UnrefractedPart.h"
#include "Refraction/Membrane/Optics.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// An edge is divided into 32 parts at most. What is finer lies within a thirty-second of a facet of
// total reflection or of a focus.
constexpr int DeepestLevel = 5;

// What limits a primitive; a corner has a bit for each that it lies on, the membrane first.
constexpr int Constraints = 4;

double GetSpread(double a, double b, double c)
{
  return std::max({ a, b, c }) - std::min({ a, b, c });
}

}

/// A corner of a sub-cell.
struct PrimitiveMapper::Node
{
  glm::dvec2 b;
  RefractedPoint from;
};

/// A corner of a clipped polygon. The values are linear in the sub-cell; none is negative inside.
/// Of a triangle: distance behind the membrane, barycentric coordinates, all times the cosine of
/// the ray. Of a line: distance, places from either end, and how far beside the line.
struct PrimitiveMapper::Corner
{
  glm::dvec2 b;
  double value[Constraints];
  unsigned edges;
  unsigned constraints;
};

/// What a clipped corner lies on.
struct PrimitiveMapper::Boundary
{
  int node = -1;          ///< the sub-cell's corner that it is
  int edge = -1;          ///< the sub-cell's, if it is on one and no corner of it
  bool membrane = false;  ///< where the primitive meets the membrane
  int side = -1;          ///< one of the primitive's sides, by its constraint
  glm::length_t end = -1; ///< the corner of the primitive that it is
};

/// The primitive in local coordinates; point = corner[0] + l0 axis[0] + l1 axis[1].
struct PrimitiveMapper::Context
{
  /// From corner k to k + 1, by its constraint k: the ends in one order for all primitives.
  struct Side
  {
    ObjectLine line;
    bool turned = false;
  };

  const MappedTriangle& primitive;
  std::int64_t sourceCell;
  ImageMesh* images;
  bool isLine;
  std::array<glm::dvec3, 3> corner;
  glm::dvec3 axis[2];
  glm::dvec3 normal;
  std::array<Side, Constraints> sides;
  const CurvedPatch* patch = nullptr;
  std::int32_t facet = CurvedPatches::NoFacet;
  std::vector<char>* isOnMembrane = nullptr; ///< of the points of `images`, if anybody asks

  void SetSides()
  {
    for (std::size_t k = this->isLine ? Constraints - 1 : 1; k < Constraints; ++k)
    {
      this->sides[k].line =
        ObjectLine::Order(this->corner[k % 3], this->corner[(k + 1) % 3], this->sides[k].turned);
    }
  }

  double GetSide(std::size_t k, const RefractedPoint& from) const
  {
    const double moment = GetMoment(this->sides[k].line, from);
    return this->sides[k].turned ? -moment : moment;
  }

  // A barycentric coordinate times the cosine is the ray's moment about the opposite side, in which
  // the plane does not appear: primitives that share the side take the same number.
  void Measure(const RefractedPoint& from, double* value) const
  {
    const glm::dvec3 away = from.at.position - this->corner[0];
    value[0] = -glm::dot(this->normal, away);
    value[3] = this->GetSide(3, from);
    if (this->isLine)
    {
      value[1] = -glm::dot(this->axis[1], glm::cross(away, from.ray));
      value[2] = glm::dot(this->normal, from.ray) - value[1];
      return;
    }
    value[1] = this->GetSide(1, from);
    value[2] = this->GetSide(2, from);
  }

  glm::dvec3 GetPoint(const glm::dvec3& weight) const
  {
    return weight.x * this->corner[0] + weight.y * this->corner[1] + weight.z * this->corner[2];
  }

  /// Weights of a point's sources in the order of the corners.
  glm::dvec3 GetWeight(const ImagePoint& point) const
  {
    glm::dvec3 weight(0.0);
    for (std::size_t k = 0; k < point.GetNumberOfSources(); ++k)
    {
      const auto& ids = this->primitive.ids;
      weight[static_cast<glm::length_t>(
        std::find(ids.begin(), ids.end() - 1, point.source[k]) - ids.begin())] += point.weight[k];
    }
    return weight;
  }

  /// Weights of a point in the plane.
  glm::dvec3 GetWeight(const glm::dvec3& point) const
  {
    const glm::dvec3 away = point - this->corner[0];
    const double squared = glm::dot(this->normal, this->normal);
    const double first = glm::dot(glm::cross(away, this->axis[1]), this->normal) / squared;
    const double second =
      this->isLine ? 0.0 : glm::dot(glm::cross(this->axis[0], away), this->normal) / squared;
    return { 1.0 - first - second, first, second };
  }

  Boundary FindBoundary(const Corner& clipped) const
  {
    Boundary on;
    on.membrane = (clipped.constraints & 1u) != 0;
    for (int k = 0; k < 3; ++k)
    {
      on.edge = clipped.edges == 1u << k ? k : on.edge;
      on.node = clipped.edges == (7u & ~(1u << k)) ? k : on.node;
    }
    if (this->isLine)
    {
      on.side = (clipped.constraints >> 3 & 1u) != 0 ? 3 : -1;
      on.end = (clipped.constraints & 2u) != 0 ? 0 : ((clipped.constraints & 4u) != 0 ? 1 : -1);
      return on;
    }
    // Constraint k is coordinate k - 1; it vanishes on the side from corner k to k + 1. The corner
    // that two of them leave is the primitive's.
    int left = 3;
    int count = 0;
    for (int k = 1; k < Constraints; ++k)
    {
      if (clipped.constraints >> k & 1u)
      {
        on.side = k;
        left -= k - 1;
        ++count;
      }
    }
    on.end = count == 2 ? left : -1;
    return on;
  }
};

//------------------------------------------------------------------------------
PrimitiveMapper::PrimitiveMapper(
  const CurvedMembraneSolver& geometry, double tolerance, double nearest, double farthest)
  : Geometry(geometry)
  , Tolerance(tolerance)
  , Distance{ nearest, farthest }
{
}

//------------------------------------------------------------------------------
void PrimitiveMapper::MapTriangle(
  const MappedTriangle& triangle, std::int64_t sourceCell, bool mayCross, ImageMesh& images) const
{
  Context context{ triangle, sourceCell, nullptr, false, {}, {}, {}, {} };
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (std::size_t i = 0; i < 3; ++i)
  {
    context.corner[i] = triangle.corners[i] - this->Geometry.GetMembrane().GetOrigin();
    low = glm::min(low, context.corner[i]);
    high = glm::max(high, context.corner[i]);
  }
  context.axis[0] = context.corner[1] - context.corner[0];
  context.axis[1] = context.corner[2] - context.corner[0];
  context.normal = glm::cross(context.axis[0], context.axis[1]);
  context.SetSides();
  const glm::dvec3 half = 0.5 * (high - low);
  this->MapSides(
    context, 0.5 * (low + high), std::max({ half.x, half.y, half.z }), mayCross, images);
}

//------------------------------------------------------------------------------
// In the plane that holds the line and stands across the view.
void PrimitiveMapper::MapLine(
  const MappedTriangle& line, std::int64_t sourceCell, bool mayCross, ImageMesh& images) const
{
  Context context{ line, sourceCell, nullptr, true, {}, {}, {}, {} };
  const glm::dvec3& origin = this->Geometry.GetMembrane().GetOrigin();
  context.corner = { line.corners[0] - origin, line.corners[1] - origin, line.corners[0] - origin };
  context.axis[0] = context.corner[1] - context.corner[0];
  const glm::dvec3 middle = 0.5 * (context.corner[0] + context.corner[1]);
  context.axis[1] = glm::cross(context.axis[0], middle - this->Geometry.GetMedia().eye);
  context.normal = glm::cross(context.axis[0], context.axis[1]);
  context.SetSides();
  const glm::dvec3 half = 0.5 * glm::abs(context.axis[0]);
  this->MapSides(context, middle, std::max({ half.x, half.y, half.z }), mayCross, images);
}

//------------------------------------------------------------------------------
void PrimitiveMapper::MapSides(Context& context, const glm::dvec3& middle, double padding,
  bool mayCross, ImageMesh& images) const
{
  if (!mayCross)
  {
    context.images = &images;
    this->Map(context, middle, padding);
    return;
  }
  ImageMesh behind;
  std::vector<char> isOnMembrane;
  context.images = &behind;
  context.isOnMembrane = &isOnMembrane;
  this->Map(context, middle, padding);
  const std::vector<WaterlinePiece> waterline = this->DropInFront(context, behind, images);
  if (context.isLine)
  {
    AddFrontOfLine(this->Geometry, context.primitive, context.sourceCell, images);
  }
  else
  {
    AddFrontOfTriangle(
      this->Geometry, this->Tolerance, context.primitive, context.sourceCell, waterline, images);
  }
}

//------------------------------------------------------------------------------
// A ray may leave the interior through the membrane and meet the primitive outside: no image.
std::vector<WaterlinePiece> PrimitiveMapper::DropInFront(
  const Context& context, const ImageMesh& from, ImageMesh& images) const
{
  std::vector<WaterlinePiece> waterline;
  std::vector<glm::dvec3> weights;
  std::int64_t begin = 0;
  for (std::size_t cell = 0; cell < from.GetNumberOfCells(); ++cell)
  {
    const std::int64_t end = from.ends[cell];
    weights.clear();
    glm::dvec3 middle(0.0);
    for (std::int64_t i = begin; i < end; ++i)
    {
      const auto id = static_cast<std::size_t>(from.connectivity[static_cast<std::size_t>(i)]);
      weights.push_back(context.GetWeight(from.points[id]));
      middle += context.GetPoint(weights.back()) / static_cast<double>(end - begin);
    }
    if (!this->Geometry.IsInFront(middle))
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const std::int64_t next = i + 1 < end ? i + 1 : begin;
        const auto id = static_cast<std::size_t>(from.connectivity[static_cast<std::size_t>(i)]);
        const auto to = static_cast<std::size_t>(from.connectivity[static_cast<std::size_t>(next)]);
        images.connectivity.push_back(static_cast<std::int64_t>(images.points.size()));
        images.points.push_back(from.points[id]);
        if ((*context.isOnMembrane)[id] && (*context.isOnMembrane)[to])
        {
          waterline.push_back({ { weights[static_cast<std::size_t>(i - begin)],
                                  from.points[id].vertex.position },
            { weights[static_cast<std::size_t>(next - begin)], from.points[to].vertex.position } });
        }
      }
      images.EndCell(from.sourceCells[cell], from.orientations[cell]);
    }
    begin = end;
  }
  return waterline;
}

//------------------------------------------------------------------------------
void PrimitiveMapper::Map(const Context& context, const glm::dvec3& middle, double padding) const
{
  if (!(glm::dot(context.normal, context.normal) > 0.0) || !this->Geometry.IsInReach(middle))
  {
    return; // without area it covers no pixel; on the line of sight a line covers none
  }
  std::vector<std::int32_t> facets;
  this->Geometry.VisitFacets(
    middle, padding, [&facets](std::int32_t facet) { facets.push_back(facet); });
  std::sort(facets.begin(), facets.end());
  for (const std::int32_t facet : facets)
  {
    const CurvedPatch patch = this->Geometry.GetPatches().GetPatch(facet);
    Context inPatch = context;
    inPatch.patch = &patch;
    inPatch.facet = facet;
    this->Divide(inPatch,
      { this->MakeNode(patch, { 0.0, 0.0 }), this->MakeNode(patch, { 1.0, 0.0 }),
        this->MakeNode(patch, { 0.0, 1.0 }) },
      0);
  }
}

//------------------------------------------------------------------------------
PrimitiveMapper::Node PrimitiveMapper::MakeNode(const CurvedPatch& patch, const glm::dvec2& b) const
{
  return { b, RefractAt(patch.Evaluate(b), this->Geometry.GetMedia()) };
}

//------------------------------------------------------------------------------
// What linear interpolation between a and b is off at the middle, in the object at its nearest or
// farthest, seen through the edge: the edge's angle at the eye for the distance between its ends'
// hits. Nothing here depends on the primitive, so its neighbours divide the edge alike.
bool PrimitiveMapper::IsSplit(const Node& a, const Node& middle, const Node& b) const
{
  if (!a.from.isValid || !middle.from.isValid || !b.from.isValid)
  {
    return a.from.isValid || middle.from.isValid || b.from.isValid;
  }
  const double angle = glm::length(a.from.at.position - b.from.at.position) /
    glm::length(middle.from.at.position - this->Geometry.GetMedia().eye);
  const auto isFar = [this, &a, &middle, &b, angle](double distance)
  {
    const auto hit = [distance](const Node& node)
    { return node.from.at.position + distance * node.from.ray; };
    const double error = glm::length(hit(middle) - 0.5 * (hit(a) + hit(b)));
    const double width = glm::length(hit(a) - hit(b));
    return angle * std::min(error, width) > this->Tolerance * width;
  };
  return isFar(this->Distance[0]) || isFar(this->Distance[1]);
}

//------------------------------------------------------------------------------
void PrimitiveMapper::Divide(
  const Context& context, const std::array<Node, 3>& nodes, int depth) const
{
  double value[3][Constraints];
  bool allValid = true;
  for (std::size_t i = 0; i < 3; ++i)
  {
    allValid = allValid && nodes[i].from.isValid;
    context.Measure(nodes[i].from, value[i]);
  }
  // Outside by more than the sub-cell's own extent: no bend brings it back.
  for (int k = 0; allValid && k < Constraints; ++k)
  {
    const double spread = GetSpread(value[0][k], value[1][k], value[2][k]);
    const bool beside = context.isLine && k == 3;
    const double most = std::max({ value[0][k], value[1][k], value[2][k] });
    const double least = std::min({ value[0][k], value[1][k], value[2][k] });
    const double cosine[3] = { glm::dot(context.normal, nodes[0].from.ray),
      glm::dot(context.normal, nodes[1].from.ray), glm::dot(context.normal, nodes[2].from.ray) };
    const bool front = cosine[0] > 0.0 && cosine[1] > 0.0 && cosine[2] > 0.0;
    const bool back = cosine[0] < 0.0 && cosine[1] < 0.0 && cosine[2] < 0.0;
    if (((front || beside) && most < -spread) || ((back || beside) && least > spread))
    {
      return;
    }
  }
  std::array<Node, 3> middle; // opposite to the corners
  bool split[3] = { false, false, false };
  if (depth < DeepestLevel)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Node& a = nodes[(k + 1) % 3];
      const Node& b = nodes[(k + 2) % 3];
      middle[k] = this->MakeNode(*context.patch, 0.5 * (a.b + b.b));
      split[k] = this->IsSplit(a, middle[k], b);
    }
  }
  const int count = split[0] + split[1] + split[2];
  if (count == 0)
  {
    if (allValid)
    {
      this->MapSubCell(context, nodes);
    }
    return;
  }
  if (count == 3)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->Divide(context, { nodes[k], middle[(k + 2) % 3], middle[(k + 1) % 3] }, depth + 1);
    }
    this->Divide(context, middle, depth + 1);
    return;
  }
  // One edge: two halves. Two edges: cut off the corner between them, halve the rest.
  std::size_t k = 0;
  while (split[k] != (count == 1))
  {
    ++k;
  }
  const std::size_t i = (k + 1) % 3;
  const std::size_t j = (k + 2) % 3;
  if (count == 1)
  {
    this->Divide(context, { nodes[k], nodes[i], middle[k] }, depth + 1);
    this->Divide(context, { nodes[k], middle[k], nodes[j] }, depth + 1);
    return;
  }
  this->Divide(context, { nodes[k], middle[j], middle[i] }, depth + 1);
  this->Divide(context, { middle[j], nodes[i], nodes[j] }, depth + 1);
  this->Divide(context, { middle[j], nodes[j], middle[i] }, depth + 1);
}

//------------------------------------------------------------------------------
// Sutherland and Hodgman's clipping, in homogeneous coordinates: rays that go away from the plane
// count as the other side of it, and a sub-cell with rays of both kinds is clipped on both.
void PrimitiveMapper::MapSubCell(const Context& context, const std::array<Node, 3>& nodes) const
{
  Polygon whole(3);
  for (std::size_t i = 0; i < 3; ++i)
  {
    whole[i].b = nodes[i].b;
    whole[i].edges = 7u & ~(1u << i);
    context.Measure(nodes[i].from, whole[i].value);
    whole[i].constraints = 0;
    for (int k = 1; k < Constraints && !context.isLine; ++k)
    {
      whole[i].constraints |= whole[i].value[k] == 0.0 ? 1u << k : 0u;
    }
  }
  const auto cross = [](const Corner& a, const Corner& b, int k)
  {
    Corner corner;
    const double part = a.value[k] / (a.value[k] - b.value[k]);
    corner.b = a.b + part * (b.b - a.b);
    for (int m = 0; m < Constraints; ++m)
    {
      corner.value[m] = a.value[m] + part * (b.value[m] - a.value[m]);
    }
    corner.value[k] = 0.0;
    corner.edges = a.edges & b.edges;
    corner.constraints = (a.constraints & b.constraints) | 1u << k;
    return corner;
  };
  for (const double sign : { 1.0, -1.0 })
  {
    Polygon polygon = whole;
    Polygon next;
    for (int k = 0; k < Constraints && !polygon.empty(); ++k)
    {
      const bool beside = context.isLine && k == 3;
      next.clear();
      for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        const Corner& a = polygon[i];
        const Corner& b = polygon[(i + 1) % polygon.size()];
        const bool inA = sign * a.value[k] >= 0.0;
        const bool inB = sign * b.value[k] >= 0.0;
        if (inA && !beside)
        {
          next.push_back(a);
        }
        if (inA != inB)
        {
          // From the inside out, whichever way round the polygon is.
          next.push_back(inA ? cross(a, b, k) : cross(b, a, k));
        }
      }
      polygon.swap(next);
    }
    if (context.isLine && polygon.size() == 2)
    {
      this->EmitLine(context, nodes, polygon);
    }
    else if (!context.isLine && polygon.size() > 2)
    {
      this->Emit(context, nodes, polygon, sign);
    }
  }
}

//------------------------------------------------------------------------------
void PrimitiveMapper::Emit(const Context& context, const std::array<Node, 3>& nodes,
  const Polygon& polygon, double sign) const
{
  // Twice the area in the primitive's second and third barycentric coordinates.
  double area = 0.0;
  const auto place = [](const Corner& corner)
  {
    const double sum = corner.value[1] + corner.value[2] + corner.value[3];
    return glm::dvec2(corner.value[2] / sum, corner.value[3] / sum);
  };
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    const glm::dvec2 u = place(polygon[i - 1]) - place(polygon[0]);
    const glm::dvec2 v = place(polygon[i]) - place(polygon[0]);
    area += u.x * v.y - u.y * v.x;
  }
  if (!(std::fabs(area) > 0.0))
  {
    return;
  }
  // The rays go with the plane's normal where `sign` is positive, against the facet's towards the
  // eye always: an upright image keeps the sense of rotation as the rays see it.
  const glm::dvec3 facet = glm::cross(nodes[1].from.at.position - nodes[0].from.at.position,
    nodes[2].from.at.position - nodes[0].from.at.position);
  const bool facetTurned = glm::dot(facet, nodes[0].from.ray) < 0.0;
  const bool imageTurned = (area < 0.0) != (sign < 0.0);
  const int orientation = facetTurned == imageTurned ? 1 : -1;
  std::vector<MappedPoint> points;
  for (const Corner& corner : polygon)
  {
    points.push_back(this->MakePoint(context, nodes, corner));
  }
  if (!IsSeen(points))
  {
    return;
  }
  const auto first = static_cast<std::int64_t>(context.images->points.size());
  const auto count = static_cast<std::int64_t>(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    points[i].point.vertex.orientation = static_cast<signed char>(orientation);
    context.images->points.push_back(points[i].point);
    if (context.isOnMembrane)
    {
      context.isOnMembrane->push_back((polygon[i].constraints & 1u) != 0);
    }
  }
  for (std::int64_t i = 0; i < count; ++i)
  {
    context.images->connectivity.push_back(first + (area > 0.0 ? i : count - 1 - i));
  }
  context.images->EndCell(context.sourceCell, orientation);
}

//------------------------------------------------------------------------------
// Where rays are nearly parallel to the primitive, or at a caustic, interpolation may find it in a
// sub-cell that does not show it. Then a side does not meet the membrane there, the images of an
// end are elsewhere, or only ends of the primitive seem to be there and none of them is.
bool PrimitiveMapper::IsSeen(const std::vector<MappedPoint>& points)
{
  const auto count = [&points](Finding finding)
  {
    return static_cast<std::size_t>(std::count_if(points.begin(), points.end(),
      [finding](const MappedPoint& point) { return point.finding == finding; }));
  };
  return count(Finding::Elsewhere) == 0 && count(Finding::EndWithoutImage) < points.size();
}

//------------------------------------------------------------------------------
void PrimitiveMapper::EmitLine(
  const Context& context, const std::array<Node, 3>& nodes, const Polygon& polygon) const
{
  const auto along = [](const Corner& c) { return c.value[1] / (c.value[1] + c.value[2]); };
  const bool turned = along(polygon[0]) > along(polygon[1]);
  for (const Corner& corner : { polygon[turned ? 1 : 0], polygon[turned ? 0 : 1] })
  {
    context.images->connectivity.push_back(
      static_cast<std::int64_t>(context.images->points.size()));
    context.images->points.push_back(this->MakePoint(context, nodes, corner).point);
    if (context.isOnMembrane)
    {
      context.isOnMembrane->push_back((corner.constraints & 1u) != 0);
    }
  }
  context.images->EndCell(context.sourceCell, 1);
}

//------------------------------------------------------------------------------
// The place of a clipped corner: interpolation is the guess, what the corner lies on decides what
// is solved for. Corners of sub-cells are exact as they are.
PrimitiveMapper::MappedPoint PrimitiveMapper::MakePoint(
  const Context& context, const std::array<Node, 3>& nodes, const Corner& corner) const
{
  const Boundary on = context.FindBoundary(corner);
  if (on.membrane)
  {
    return this->MakeCrossing(context, nodes, corner, on);
  }
  if (on.end >= 0)
  {
    return this->MakeEnd(context, nodes, on.end, corner.b);
  }
  if (on.node >= 0 && on.side < 0)
  {
    // The coordinates have one sign here.
    const glm::dvec3 value(corner.value[1], corner.value[2], corner.value[3]);
    const glm::dvec3 weight = glm::max(value / (value.x + value.y + value.z), glm::dvec3(0.0));
    return { this->Finish(context, nodes[static_cast<std::size_t>(on.node)].from.at,
               context.GetPoint(weight), weight),
      Finding::Found };
  }
  const auto side = static_cast<std::size_t>(on.side);
  if (on.node >= 0)
  {
    return this->MakeOnSide(
      context, nodes, side, nodes[static_cast<std::size_t>(on.node)].from, corner.b);
  }
  const Node& a = nodes[static_cast<std::size_t>((on.edge + 1) % 3)];
  const Node& b = nodes[static_cast<std::size_t>((on.edge + 2) % 3)];
  return this->MakeOnSide(context, nodes, side,
    MeetLine(SubCellSide(*context.patch, a.b, b.b), this->Geometry.GetMedia(),
      context.sides[side].line, a.from, b.from),
    corner.b);
}

//------------------------------------------------------------------------------
// What a ray shows of a side that it meets. Beyond the side's end the piece ends with the side.
PrimitiveMapper::MappedPoint PrimitiveMapper::MakeOnSide(const Context& context,
  const std::array<Node, 3>& nodes, std::size_t side, const RefractedPoint& from,
  const glm::dvec2& interpolated) const
{
  const Context::Side& on = context.sides[side];
  const double l = GetParameter(on.line, from);
  const auto first = static_cast<glm::length_t>((side + (on.turned ? 1 : 0)) % 3);
  const auto last = static_cast<glm::length_t>((side + (on.turned ? 0 : 1)) % 3);
  if (!(l > 0.0 && l < 1.0))
  {
    return this->MakeEnd(context, nodes, l < 0.5 ? first : last, interpolated);
  }
  glm::dvec3 weight(0.0);
  weight[first] = 1.0 - l;
  weight[last] = l;
  const glm::dvec3 place = on.line.GetPoint(l);
  ImagePoint point = this->Finish(context, from.at, place, weight);
  if (glm::dot(place - from.at.position, from.ray) < 0.0)
  {
    // Where the primitive meets the membrane, interpolation may take a bit of what is in front.
    point.vertex.position = place + this->Geometry.GetMembrane().GetOrigin();
    point.vertex.sightPoint = point.vertex.position;
    point.vertex.depth = 0.0;
  }
  return { point, Finding::Found };
}

//------------------------------------------------------------------------------
// The image of an end of the primitive: the known one that is seen in the sub-cell or next to it.
// An end whose images are all elsewhere is not seen here, so the piece is not: near a silhouette or
// near total reflection the sub-cell's interpolated rays meet the primitive, the refracted rays do
// not. Near a caustic there may be no image at all; then the end is drawn where interpolation has
// it. Nothing here depends on the primitive's plane.
PrimitiveMapper::MappedPoint PrimitiveMapper::MakeEnd(const Context& context,
  const std::array<Node, 3>& nodes, glm::length_t end, const glm::dvec2& interpolated) const
{
  const auto index = static_cast<std::size_t>(end);
  const glm::dvec3 middle =
    context.patch->Evaluate(interpolated).position + this->Geometry.GetMembrane().GetOrigin();
  const double size = GetSize(nodes);
  glm::dvec3 weight(0.0);
  weight[end] = 1.0;
  const KnownImages& known = context.primitive.images[index];
  const ImagePoint* nearest = std::min_element(known.first, known.first + known.count,
    [&middle](const ImagePoint& a, const ImagePoint& b) {
      return glm::length(a.vertex.sightPoint - middle) < glm::length(b.vertex.sightPoint - middle);
    });
  if (known.count > 0 && nearest->vertex.facet != CurvedPatches::NoFacet &&
    glm::length(nearest->vertex.sightPoint - middle) <= size)
  {
    ImagePoint point;
    point.vertex = nearest->vertex;
    point.SetSource(context.primitive.ids, weight);
    return { point, Finding::Found };
  }
  constexpr int steps = 10;
  constexpr double reach = 0.5;
  const glm::dvec2 guess = GuessSight(nodes, context.corner[index]);
  PatchPoint at = context.patch->Evaluate(guess);
  const SightRoot root =
    this->Geometry.MakeEquation(context.corner[index]).Solve(*context.patch, guess, steps, reach);
  const bool isFound =
    root.end == SightRoot::End::Converged && glm::length(root.at.position - at.position) <= size;
  if (isFound)
  {
    at = root.at;
  }
  ImagePoint point = this->Finish(context, at, context.corner[index], weight);
  if (known.count == 1 && known.first->vertex.facet == CurvedPatches::NoFacet)
  {
    point.vertex.position = known.first->vertex.position; // in front, where all others have it
  }
  const bool isElsewhere = known.count > 0 && nearest->vertex.facet != CurvedPatches::NoFacet;
  const Finding without = isElsewhere ? Finding::Elsewhere : Finding::EndWithoutImage;
  return { point, isFound ? Finding::Found : without };
}

//------------------------------------------------------------------------------
double PrimitiveMapper::GetSize(const std::array<Node, 3>& nodes)
{
  const auto length = [&nodes](std::size_t i, std::size_t j)
  { return glm::length(nodes[i].from.at.position - nodes[j].from.at.position); };
  return std::max({ length(0, 1), length(1, 2), length(2, 0) });
}

//------------------------------------------------------------------------------
// Where the sub-cell's rays pass a point most closely, if their moments about it are linear.
glm::dvec2 PrimitiveMapper::GuessSight(const std::array<Node, 3>& nodes, const glm::dvec3& point)
{
  const auto moment = [&nodes, &point](std::size_t k)
  { return glm::cross(nodes[k].from.at.position - point, nodes[k].from.ray); };
  const glm::dvec3 first = moment(0);
  const glm::dvec3 u = moment(1) - first;
  const glm::dvec3 v = moment(2) - first;
  const glm::dvec3 normal = glm::cross(u, v);
  const double squared = glm::dot(normal, normal);
  glm::dvec2 place(1.0 / 3.0);
  if (squared > 0.0)
  {
    // The foot of 0 in the plane of the moments.
    place = { glm::dot(glm::cross(v, first), normal) / squared,
      glm::dot(glm::cross(first, u), normal) / squared };
    place = glm::clamp(place, 0.0, 1.0);
    place /= std::max(1.0, place.x + place.y);
  }
  return nodes[0].b + place.x * (nodes[1].b - nodes[0].b) + place.y * (nodes[2].b - nodes[0].b);
}

//------------------------------------------------------------------------------
// Where the primitive meets the membrane: a side of the sub-cell its plane, or the patch a side of
// the primitive. Beyond a side of the primitive the first one ends with the second.
PrimitiveMapper::MappedPoint PrimitiveMapper::MakeCrossing(const Context& context,
  const std::array<Node, 3>& nodes, const Corner& corner, const Boundary& on) const
{
  glm::dvec3 weight = context.isLine
    ? glm::dvec3(corner.value[2], corner.value[1], 0.0)
    : glm::dvec3(corner.value[1], corner.value[2], corner.value[3]);
  weight /= weight.x + weight.y + weight.z;
  int side = on.side;
  if (on.edge >= 0 && side < 0)
  {
    const Node& a = nodes[static_cast<std::size_t>((on.edge + 1) % 3)];
    const Node& b = nodes[static_cast<std::size_t>((on.edge + 2) % 3)];
    const RefractedPoint from = MeetPlane(SubCellSide(*context.patch, a.b, b.b),
      this->Geometry.GetMedia(), context.corner[0], context.normal, a.from, b.from);
    weight = context.GetWeight(from.at.position);
    const glm::length_t least =
      weight.x < weight.y ? (weight.x < weight.z ? 0 : 2) : (weight.y < weight.z ? 1 : 2);
    if (weight[least] >= 0.0)
    {
      return { this->Finish(context, from.at, from.at.position, weight), Finding::Found };
    }
    side = static_cast<int>(least) + 1;
  }
  return this->MakeSideCrossing(context, nodes, static_cast<std::size_t>(side), corner.b, weight);
}

//------------------------------------------------------------------------------
// Found from a guess, then again by the patch in which it is from a start that is the same for all
// guesses: every primitive with the side takes the same point.
PrimitiveMapper::MappedPoint PrimitiveMapper::MakeSideCrossing(const Context& context,
  const std::array<Node, 3>& nodes, std::size_t side, const glm::dvec2& guess,
  const glm::dvec3& weight) const
{
  const Context::Side& on = context.sides[side];
  const auto first = static_cast<glm::length_t>((side + (on.turned ? 1 : 0)) % 3);
  const auto last = static_cast<glm::length_t>((side + (on.turned ? 0 : 1)) % 3);
  Context inPatch = context;
  glm::dvec2 b = guess;
  double l = weight[last] / (weight[first] + weight[last]);
  const glm::dvec3 start = context.patch->Evaluate(guess).position;
  if (!this->Geometry.MeetLine(on.line, context.patch->GetNormal(guess), inPatch.facet, b, l))
  {
    return { {}, Finding::Elsewhere };
  }
  const CurvedPatch patch = this->Geometry.GetPatches().GetPatch(inPatch.facet);
  MeetPatchAgain(patch, on.line, b, l);
  inPatch.patch = &patch;
  const PatchPoint at = patch.Evaluate(b);
  if (glm::length(at.position - start) > GetSize(nodes))
  {
    return { {}, Finding::Elsewhere };
  }
  if (!(l > 0.0 && l < 1.0))
  {
    return this->MakeEnd(context, nodes, l < 0.5 ? first : last, guess);
  }
  glm::dvec3 place(0.0);
  place[first] = 1.0 - l;
  place[last] = l;
  return { this->Finish(inPatch, at, on.line.GetPoint(l), place), Finding::Found };
}

//------------------------------------------------------------------------------
ImagePoint PrimitiveMapper::Finish(const Context& context, const PatchPoint& at,
  const glm::dvec3& local, const glm::dvec3& weight) const
{
  SightPlace place;
  place.facet = context.facet;
  place.root.at = at;
  ImagePoint point;
  point.vertex = this->Geometry.MakeVertex(local, *context.patch, place);
  point.SetSource(context.primitive.ids, weight);
  return point;
}

}
