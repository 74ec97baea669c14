// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/MembraneMapping.h"

#include "Refraction/FrontPart.h"
#include "Refraction/MappingPlace.h"
#include "Refraction/Optics.h"

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
struct MembraneMapping::Node
{
  glm::dvec2 b;
  PatchPoint at;
  glm::dvec3 ray;
  bool isValid; ///< there is a refracted ray
};

/// A corner of a clipped polygon. The values are linear in the sub-cell; none is negative inside.
/// Of a triangle: distance behind the membrane, barycentric coordinates, all times the cosine of
/// the ray. Of a line: distance, places from either end, and how far beside the line.
struct MembraneMapping::Corner
{
  glm::dvec2 b;
  double value[Constraints];
  unsigned edges;
  unsigned constraints;
};

/// What a clipped corner lies on.
struct MembraneMapping::Boundary
{
  int edge = -1;         ///< the sub-cell's, if it is on one and no corner of it
  bool membrane = false; ///< where the primitive meets the membrane
  unsigned lines = 0;    ///< how many of the primitive's lines
  glm::length_t from = 0;
  glm::length_t to = 1;
  bool isEnd = false; ///< a corner of the primitive
};

/// The primitive in local coordinates; point = corner[0] + l0 axis[0] + l1 axis[1].
struct MembraneMapping::Context
{
  const MappedTriangle& primitive;
  std::int64_t sourceCell;
  ImageMesh* images;
  bool isLine;
  std::array<glm::dvec3, 3> corner;
  glm::dvec3 axis[2];
  glm::dvec3 normal;
  const CurvedPatch* patch = nullptr;
  std::int32_t facet = CurvedPatches::NoFacet;
  void Measure(const Node& node, double* value) const
  {
    const glm::dvec3 away = node.at.position - this->corner[0];
    const double cosine = glm::dot(this->normal, node.ray);
    const double distance = -glm::dot(this->normal, away);
    const glm::dvec3 hit = cosine * away + distance * node.ray;
    const double squared = glm::dot(this->normal, this->normal);
    const double first = glm::dot(glm::cross(hit, this->axis[1]), this->normal) / squared;
    const double second = glm::dot(glm::cross(this->axis[0], hit), this->normal) / squared;
    value[0] = distance;
    value[1] = this->isLine ? first : cosine - first - second;
    value[2] = this->isLine ? cosine - first : first;
    value[3] = second;
  }

  glm::dvec3 GetPoint(const glm::dvec3& weight) const
  {
    return weight.x * this->corner[0] + weight.y * this->corner[1] + weight.z * this->corner[2];
  }

  /// Weights of a point in the plane, or of the nearest point of the line.
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
    }
    if (this->isLine)
    {
      on.lines = clipped.constraints >> 3 & 1u;
      on.isEnd = (clipped.constraints & 6u) != 0;
      return on;
    }
    // Constraint k is coordinate k - 1; where it vanishes is the line from corner k to k + 1.
    for (int k = 1; k < Constraints; ++k)
    {
      if (clipped.constraints >> k & 1u)
      {
        on.from = k % 3;
        on.to = (k + 1) % 3;
        ++on.lines;
      }
    }
    on.isEnd = on.lines == 2;
    return on;
  }
};

//------------------------------------------------------------------------------
MembraneMapping::MembraneMapping(
  const CurvedGeometry& geometry, double tolerance, double nearest, double farthest)
  : Geometry(geometry)
  , Tolerance(tolerance)
  , Distance{ nearest, farthest }
{
}

//------------------------------------------------------------------------------
void MembraneMapping::MapTriangle(
  const MappedTriangle& triangle, std::int64_t sourceCell, bool mayCross, ImageMesh& images) const
{
  Context context{ triangle, sourceCell, nullptr, false, {}, {}, {} };
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
  const glm::dvec3 half = 0.5 * (high - low);
  this->MapSides(
    context, 0.5 * (low + high), std::max({ half.x, half.y, half.z }), mayCross, images);
}

//------------------------------------------------------------------------------
// In the plane that holds the line and stands across the view.
void MembraneMapping::MapLine(
  const MappedTriangle& line, std::int64_t sourceCell, bool mayCross, ImageMesh& images) const
{
  Context context{ line, sourceCell, nullptr, true, {}, {}, {} };
  const glm::dvec3& origin = this->Geometry.GetMembrane().GetOrigin();
  context.corner = { line.corners[0] - origin, line.corners[1] - origin, line.corners[0] - origin };
  context.axis[0] = context.corner[1] - context.corner[0];
  const glm::dvec3 middle = 0.5 * (context.corner[0] + context.corner[1]);
  context.axis[1] = glm::cross(context.axis[0], middle - this->Geometry.GetMedia().eye);
  context.normal = glm::cross(context.axis[0], context.axis[1]);
  const glm::dvec3 half = 0.5 * glm::abs(context.axis[0]);
  this->MapSides(context, middle, std::max({ half.x, half.y, half.z }), mayCross, images);
}

//------------------------------------------------------------------------------
void MembraneMapping::MapSides(Context& context, const glm::dvec3& middle, double padding,
  bool mayCross, ImageMesh& images) const
{
  if (!mayCross)
  {
    context.images = &images;
    this->Map(context, middle, padding);
    return;
  }
  ImageMesh behind;
  context.images = &behind;
  this->Map(context, middle, padding);
  this->DropInFront(context, behind, images);
  if (context.isLine)
  {
    AddFrontOfLine(this->Geometry, context.primitive, context.sourceCell, images);
  }
  else
  {
    AddFrontOfTriangle(this->Geometry, context.primitive, context.sourceCell, images);
  }
}

//------------------------------------------------------------------------------
// A ray may leave the interior through the membrane and meet the primitive outside: no image.
void MembraneMapping::DropInFront(
  const Context& context, const ImageMesh& from, ImageMesh& images) const
{
  std::int64_t begin = 0;
  for (std::size_t cell = 0; cell < from.GetNumberOfCells(); ++cell)
  {
    const std::int64_t end = from.ends[cell];
    glm::dvec3 middle(0.0);
    for (std::int64_t i = begin; i < end; ++i)
    {
      const ImagePoint& point =
        from.points[static_cast<std::size_t>(from.connectivity[static_cast<std::size_t>(i)])];
      for (std::size_t k = 0; k < 3; ++k)
      {
        const auto corner = static_cast<std::size_t>(
          std::find(context.primitive.ids.begin(), context.primitive.ids.end(), point.source[k]) -
          context.primitive.ids.begin());
        middle += point.weight[k] * context.corner[std::min<std::size_t>(corner, 2)];
      }
    }
    if (!this->Geometry.IsInFront(middle / static_cast<double>(end - begin)))
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        images.connectivity.push_back(static_cast<std::int64_t>(images.points.size()));
        images.points.push_back(
          from.points[static_cast<std::size_t>(from.connectivity[static_cast<std::size_t>(i)])]);
      }
      images.EndCell(from.sourceCells[cell], from.orientations[cell]);
    }
    begin = end;
  }
}

//------------------------------------------------------------------------------
void MembraneMapping::Map(const Context& context, const glm::dvec3& middle, double padding) const
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
MembraneMapping::Node MembraneMapping::MakeNode(const CurvedPatch& patch, const glm::dvec2& b) const
{
  const Media& media = this->Geometry.GetMedia();
  Node node;
  node.b = b;
  node.at = patch.Evaluate(b);
  const RefractionRay ray = ComputeRefractionRay(glm::normalize(node.at.position - media.eye),
    glm::normalize(node.at.normal), media.exterior / media.interior);
  node.ray = ray.direction;
  node.isValid =
    ray.kind == RayKind::Refracted && glm::length(node.at.normal) > CurvedPatch::ShortestNormal;
  return node;
}

//------------------------------------------------------------------------------
// What linear interpolation between a and b is off at the middle, in the object at its nearest or
// farthest, seen through the edge: the edge's angle at the eye for the distance between its ends'
// hits. Nothing here depends on the primitive, so its neighbours divide the edge alike.
bool MembraneMapping::IsSplit(const Node& a, const Node& middle, const Node& b) const
{
  if (!a.isValid || !middle.isValid || !b.isValid)
  {
    return a.isValid || middle.isValid || b.isValid;
  }
  const double angle = glm::length(a.at.position - b.at.position) /
    glm::length(middle.at.position - this->Geometry.GetMedia().eye);
  const auto isFar = [this, &a, &middle, &b, angle](double distance)
  {
    const auto hit = [distance](const Node& node)
    { return node.at.position + distance * node.ray; };
    const double error = glm::length(hit(middle) - 0.5 * (hit(a) + hit(b)));
    const double width = glm::length(hit(a) - hit(b));
    return angle * std::min(error, width) > this->Tolerance * width;
  };
  return isFar(this->Distance[0]) || isFar(this->Distance[1]);
}

//------------------------------------------------------------------------------
void MembraneMapping::Divide(
  const Context& context, const std::array<Node, 3>& nodes, int depth) const
{
  double value[3][Constraints];
  bool allValid = true;
  for (std::size_t i = 0; i < 3; ++i)
  {
    allValid = allValid && nodes[i].isValid;
    context.Measure(nodes[i], value[i]);
  }
  // Outside by more than the sub-cell's own extent: no bend brings it back.
  for (int k = 0; allValid && k < Constraints; ++k)
  {
    const double spread = GetSpread(value[0][k], value[1][k], value[2][k]);
    const bool beside = context.isLine && k == 3;
    const double most = std::max({ value[0][k], value[1][k], value[2][k] });
    const double least = std::min({ value[0][k], value[1][k], value[2][k] });
    const double cosine[3] = { glm::dot(context.normal, nodes[0].ray),
      glm::dot(context.normal, nodes[1].ray), glm::dot(context.normal, nodes[2].ray) };
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
void MembraneMapping::MapSubCell(const Context& context, const std::array<Node, 3>& nodes) const
{
  Polygon whole(3);
  for (std::size_t i = 0; i < 3; ++i)
  {
    whole[i].b = nodes[i].b;
    whole[i].edges = 7u & ~(1u << i);
    whole[i].constraints = 0;
    context.Measure(nodes[i], whole[i].value);
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
          next.push_back(cross(a, b, k));
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
void MembraneMapping::Emit(const Context& context, const std::array<Node, 3>& nodes,
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
  const glm::dvec3 facet = glm::cross(
    nodes[1].at.position - nodes[0].at.position, nodes[2].at.position - nodes[0].at.position);
  const bool facetTurned = glm::dot(facet, nodes[0].ray) < 0.0;
  const bool imageTurned = (area < 0.0) != (sign < 0.0);
  const int orientation = facetTurned == imageTurned ? 1 : -1;
  const auto first = static_cast<std::int64_t>(context.images->points.size());
  const auto count = static_cast<std::int64_t>(polygon.size());
  for (const Corner& corner : polygon)
  {
    ImagePoint point = this->MakePoint(context, nodes, corner);
    point.vertex.orientation = static_cast<signed char>(orientation);
    context.images->points.push_back(point);
  }
  for (std::int64_t i = 0; i < count; ++i)
  {
    context.images->connectivity.push_back(first + (area > 0.0 ? i : count - 1 - i));
  }
  context.images->EndCell(context.sourceCell, orientation);
}

//------------------------------------------------------------------------------
void MembraneMapping::EmitLine(
  const Context& context, const std::array<Node, 3>& nodes, const Polygon& polygon) const
{
  const auto along = [](const Corner& c) { return c.value[1] / (c.value[1] + c.value[2]); };
  const bool turned = along(polygon[0]) > along(polygon[1]);
  for (const Corner& corner : { polygon[turned ? 1 : 0], polygon[turned ? 0 : 1] })
  {
    context.images->connectivity.push_back(
      static_cast<std::int64_t>(context.images->points.size()));
    context.images->points.push_back(this->MakePoint(context, nodes, corner));
  }
  context.images->EndCell(context.sourceCell, 1);
}

//------------------------------------------------------------------------------
// The place of a clipped corner: interpolation is the guess, what the corner lies on decides what
// is solved for. Corners of sub-cells are exact as they are.
ImagePoint MembraneMapping::MakePoint(
  const Context& context, const std::array<Node, 3>& nodes, const Corner& corner) const
{
  const Boundary on = context.FindBoundary(corner);
  glm::dvec2 b = corner.b;
  glm::dvec3 weight(corner.value[1], corner.value[2], corner.value[3]);
  if (context.isLine)
  {
    weight = glm::dvec3(corner.value[2], corner.value[1], 0.0);
  }
  weight /= weight.x + weight.y + weight.z;
  const auto setAlong = [&weight, &on](double l)
  {
    weight = glm::dvec3(0.0);
    weight[on.to] = l;
    weight[on.from] = 1.0 - l;
  };
  const ObjectLine object{ context.corner[static_cast<std::size_t>(on.from)],
    context.corner[static_cast<std::size_t>(on.to)] -
      context.corner[static_cast<std::size_t>(on.from)] };
  double l = weight[on.to];

  if (on.edge >= 0 && (on.lines == 1 || on.membrane))
  {
    const glm::dvec2 start = nodes[static_cast<std::size_t>((on.edge + 1) % 3)].b;
    const PatchLine curve{ start, nodes[static_cast<std::size_t>((on.edge + 2) % 3)].b - start };
    double s = glm::dot(b - start, curve.direction) / glm::dot(curve.direction, curve.direction);
    if (on.membrane)
    {
      MeetPlane(*context.patch, curve, context.corner[0], context.normal, s);
      weight = context.GetWeight(context.patch->Evaluate(start + s * curve.direction).position);
    }
    else if (LookAlong(*context.patch, this->Geometry.GetMedia(), curve, object, s, l))
    {
      setAlong(l);
    }
    b = start + s * curve.direction;
  }
  else if (on.isEnd && !on.membrane)
  {
    weight = glm::round(weight);
    this->FindSight(context, weight, b);
  }
  else if (on.membrane && on.lines == 1 && MeetPatch(*context.patch, object, b, l))
  {
    setAlong(l);
  }
  return this->Finish(context, b, weight);
}

//------------------------------------------------------------------------------
void MembraneMapping::FindSight(
  const Context& context, const glm::dvec3& weight, glm::dvec2& b) const
{
  constexpr int steps = 10;
  constexpr double reach = 0.5;
  const SightRoot root =
    this->Geometry.MakeEquation(context.GetPoint(weight)).Solve(*context.patch, b, steps, reach);
  if (root.end == SightRoot::End::Converged && glm::length(root.b - b) < reach)
  {
    b = root.b;
  }
}

//------------------------------------------------------------------------------
ImagePoint MembraneMapping::Finish(
  const Context& context, const glm::dvec2& b, const glm::dvec3& weight) const
{
  SightPlace place;
  place.facet = context.facet;
  place.root = { SightRoot::End::Converged, b, context.patch->Evaluate(b), 1.0 };
  ImagePoint point;
  point.vertex = this->Geometry.MakeVertex(context.GetPoint(weight), *context.patch, place);
  point.SetSource(context.primitive.ids, weight);
  return point;
}

}
