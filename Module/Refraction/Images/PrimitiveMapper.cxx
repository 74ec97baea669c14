// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/PrimitiveMapper.h"

#include "Refraction/Images/PrimitiveContext.h"
#include "Refraction/Images/UnrefractedPart.h"
#include "Refraction/Membrane/CrossProduct.h"
#include "Refraction/Membrane/Optics.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meniscus
{
//------------------------------------------------------------------------------
PrimitiveMapper::PrimitiveMapper(const CurvedMembraneSolver& geometry, double tolerance,
  double nearest, double farthest, SharedNodes& shared)
  : Geometry(geometry)
  , Tolerance(tolerance)
  , Division(geometry, tolerance, nearest, farthest, shared)
{
}

//------------------------------------------------------------------------------
void PrimitiveMapper::MapTriangle(
  const MappedTriangle& triangle, std::int64_t sourceCell, bool mayCross, ImageMesh& images) const
{
  Context context{ ObjectPrimitive::MakeTriangle(
    triangle, sourceCell, this->Geometry.GetMembrane().GetOrigin()) };
  this->MapSides(context, mayCross, images);
}

//------------------------------------------------------------------------------
void PrimitiveMapper::MapLine(
  const MappedTriangle& line, std::int64_t sourceCell, bool mayCross, ImageMesh& images) const
{
  Context context{ ObjectPrimitive::MakeLine(
    line, sourceCell, this->Geometry.GetMembrane().GetOrigin(), this->Geometry.GetMedia().Eye) };
  this->MapSides(context, mayCross, images);
}

//------------------------------------------------------------------------------
void PrimitiveMapper::MapSides(Context& context, bool mayCross, ImageMesh& images) const
{
  if (!mayCross)
  {
    context.Images = &images;
    this->Map(context);
    return;
  }
  if (this->MapAsBehind(context, images))
  {
    return;
  }
  ImageMesh behind;
  std::vector<char> isOnMembrane;
  context.Images = &behind;
  context.IsOnMembrane = &isOnMembrane;
  this->Map(context);
  const std::vector<WaterlinePiece> waterline = this->DropBeyond(context, behind, images);
  if (this->Geometry.GetMedia().Reflects)
  {
    return; // a mirror shows nothing of the part behind it
  }
  if (context.IsLine)
  {
    AddFrontOfLine(this->Geometry, context.Primitive, context.SourceCell, images);
  }
  else
  {
    AddFrontOfTriangle(
      this->Geometry, this->Tolerance, context.Primitive, context.SourceCell, waterline, images);
  }
}

//------------------------------------------------------------------------------
// Drops parts that lie on the other side of the membrane than its rays, in front of it or behind a
// mirror: a ray may leave through the membrane and meet the primitive outside, which is no image.
// Returns the pieces of the waterline.
std::vector<WaterlinePiece> PrimitiveMapper::DropBeyond(
  const Context& context, const ImageMesh& from, ImageMesh& images) const
{
  std::vector<WaterlinePiece> waterline;
  std::vector<glm::dvec3> weights;
  std::int64_t begin = 0;
  for (std::size_t cell = 0; cell < from.GetNumberOfCells(); ++cell)
  {
    const std::int64_t end = from.Ends[cell];
    weights.clear();
    glm::dvec3 middle(0.0);
    for (std::int64_t i = begin; i < end; ++i)
    {
      const auto id = static_cast<std::size_t>(from.Connectivity[static_cast<std::size_t>(i)]);
      weights.push_back(context.GetWeight(from.Points[id]));
      middle += context.GetPoint(weights.back()) / static_cast<double>(end - begin);
    }
    if (this->Geometry.IsOnRaySide(middle))
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const std::int64_t next = i + 1 < end ? i + 1 : begin;
        const auto id = static_cast<std::size_t>(from.Connectivity[static_cast<std::size_t>(i)]);
        const auto to = static_cast<std::size_t>(from.Connectivity[static_cast<std::size_t>(next)]);
        images.Connectivity.push_back(static_cast<std::int64_t>(images.Points.size()));
        images.Points.push_back(from.Points[id]);
        if ((*context.IsOnMembrane)[id] && (*context.IsOnMembrane)[to])
        {
          waterline.push_back({ { weights[static_cast<std::size_t>(i - begin)],
                                  from.Points[id].Vertex.Position },
            { weights[static_cast<std::size_t>(next - begin)], from.Points[to].Vertex.Position } });
        }
      }
      images.EndCell(from.SourceCells[cell], from.Orientations[cell]);
    }
    begin = end;
  }
  return waterline;
}

//------------------------------------------------------------------------------
void PrimitiveMapper::Map(const Context& context) const
{
  if (!(glm::dot(context.Normal, context.Normal) > 0.0) ||
    !this->Geometry.IsInReach(context.Middle))
  {
    return; // a primitive without area covers no pixel; neither does a line along the line of sight
  }
  std::vector<std::int32_t> facets;
  this->Geometry.VisitFacets(
    context.Middle, context.Padding, [&facets](std::int32_t facet) { facets.push_back(facet); });
  std::sort(facets.begin(), facets.end());
  const double inFront = this->GetLengthInFront(context);
  this->Shared.Start();
  Meetings meetings;
  Context inPatch = context;
  inPatch.Meetings = &meetings;
  for (const std::int32_t facet : facets)
  {
    inPatch.Facet = facet;
    std::optional<PatchBend> patchBend;
    this->Division.Visit(
      facet,
      [this, &inPatch, &patchBend, inFront](const SubCell& nodes)
      {
        return (inPatch.IsPartInFront && *inPatch.IsPartInFront) ||
          this->IsOutside(inPatch, patchBend, nodes, inFront);
      },
      [this, &inPatch](const CurvedPatch& patch, const SubCell& nodes)
      {
        inPatch.Patch = &patch;
        this->MapSubCell(inPatch, nodes);
      });
  }
}

//------------------------------------------------------------------------------
// True if no ray of the sub-cell shows the primitive. Next to a caustic the rays at its corners
// meet the primitive's plane close to each other, and those between them elsewhere. The bend of the
// patch is set when it is needed first.
bool PrimitiveMapper::IsOutside(const Context& context, std::optional<PatchBend>& patchBend,
  const SubCell& nodes, double inFront) const
{
  std::optional<SubCellBend> bend;
  return context.IsOutside(nodes, inFront,
    [this, &context, &patchBend, &nodes, &bend](int k, double extent)
    {
      if (k == 0)
      {
        return extent;
      }
      if (!patchBend)
      {
        patchBend.emplace(
          this->Geometry.GetPatches().GetPatch(context.Facet), this->Geometry.GetMedia());
      }
      bend = bend ? bend : patchBend->Measure(nodes);
      return context.GetDeviation(k, nodes, *bend);
    });
}

//------------------------------------------------------------------------------
void PrimitiveMapper::MapSubCell(const Context& context, const SubCell& nodes) const
{
  Polygon whole(3);
  for (std::size_t i = 0; i < 3; ++i)
  {
    whole[i].B = nodes[i].B;
    whole[i].Edges = 7u & ~(1u << i);
    context.Measure(nodes[i].From, whole[i].Value);
    whole[i].Limits = 0;
    for (int k = 1; k < PrimitiveConstraints && !context.IsLine; ++k)
    {
      whole[i].Limits |= whole[i].Value[k] == 0.0 ? 1u << k : 0u;
    }
  }
  const bool isFacing = !IsBeyond(context, whole, 1.0);
  const bool isTurned = !IsBeyond(context, whole, -1.0);
  if (!isFacing && !isTurned)
  {
    return;
  }
  for (Meeting& meeting : *context.Meetings)
  {
    meeting.IsKnown = false;
  }
  EdgeOn edgeOn;
  edgeOn.IsThere = !context.IsLine && this->FindEdgeOn(context, nodes, whole, edgeOn);
  const bool isOrdered = !context.IsLine && this->OrderCrossings(context, nodes, whole);
  if (context.IsOnMembrane && !this->ResolveTie(context, nodes, whole))
  {
    return;
  }
  Polygon polygon;
  polygon.reserve(whole.size() + PrimitiveConstraints);
  for (const double sign : { 1.0, -1.0 })
  {
    // A ray that meets the primitive edge-on begins a strip for either sign, which may end in the
    // sub-cell.
    if (!(sign > 0.0 ? isFacing : isTurned) && !(edgeOn.IsThere && edgeOn.IsMet))
    {
      continue;
    }
    const bool isCut = !context.IsLine && context.IsOnMembrane &&
      this->CutAtMembrane(context, nodes, whole, sign, edgeOn, polygon);
    if (!isCut)
    {
      context.Clip(whole, sign, polygon);
    }
    if (!context.IsOnMembrane)
    {
      this->KeepAsBehind(context, nodes, whole, sign, polygon);
    }
    if (context.IsLine && polygon.size() == 2)
    {
      this->EmitLine(context, nodes, polygon);
    }
    else if (!context.IsLine)
    {
      const bool isEnded = !isCut && edgeOn.IsThere && EndEdgeOn(edgeOn, whole, polygon);
      this->Emit(context, nodes, polygon, sign, !isOrdered && !isCut && !isEnded);
    }
  }
}

//------------------------------------------------------------------------------
// True if all rays pass the primitive beyond one of its sides. Where `sign` is positive, the rays
// have a positive component along the plane's normal.
bool PrimitiveMapper::IsBeyond(const Context& context, const Polygon& whole, double sign)
{
  bool isBeyond = false;
  for (int k = 1; k < (context.IsLine ? 3 : PrimitiveConstraints); ++k)
  {
    isBeyond = isBeyond ||
      std::all_of(whole.begin(), whole.end(),
        [k, sign](const Corner& corner) { return sign * corner.Value[k] < 0.0; });
  }
  return isBeyond;
}

//------------------------------------------------------------------------------
// With `isLinear`, the values of the corners are linear in the sub-cell, and have the sign `sign`.
void PrimitiveMapper::Emit(
  const Context& context, const SubCell& nodes, Polygon polygon, double sign, bool isLinear) const
{
  double area = 1.0;
  if (isLinear)
  {
    area = GetTwiceArea(polygon.size(),
      [&polygon](std::size_t i)
      {
        const Corner& corner = polygon[i];
        const double sum = corner.Value[1] + corner.Value[2] + corner.Value[3];
        return glm::dvec2(corner.Value[2] / sum, corner.Value[3] / sum);
      });
  }
  if (polygon.size() < 3 || !(std::fabs(area) > 0.0))
  {
    return;
  }
  std::vector<MappedPoint> points;
  points.reserve(polygon.size());
  for (auto corner = polygon.begin(); corner != polygon.end();)
  {
    points.push_back(this->MakePoint(context, nodes, *corner));
    const bool isInFront = points.back().Outcome == Finding::InFront;
    if (isInFront)
    {
      points.pop_back();
    }
    corner = isInFront ? polygon.erase(corner) : corner + 1;
  }
  if (points.size() < 3 || !IsSeen(points))
  {
    return;
  }
  if (!isLinear)
  {
    area = GetTwiceArea(points.size(),
      [&context, &points](std::size_t i)
      {
        const glm::dvec3 weight = context.GetWeight(points[i].Point);
        return glm::dvec2(weight.y, weight.z);
      });
    sign = this->GetSlope(context, points);
  }
  // Where `sign` is positive, the rays have a positive component along the plane's normal; they
  // always point against the facet's normal, which faces the eye. An upright image keeps the sense
  // of rotation as seen along the rays.
  const glm::dvec3 facet = glm::cross(nodes[1].From.At.Position - nodes[0].From.At.Position,
    nodes[2].From.At.Position - nodes[0].From.At.Position);
  const bool facetTurned = glm::dot(facet, nodes[0].From.Ray) < 0.0;
  const bool imageTurned = (area < 0.0) != (sign < 0.0);
  const int orientation = facetTurned == imageTurned ? 1 : -1;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i].Point.Vertex.Orientation = static_cast<signed char>(orientation);
    if (context.IsOnMembrane)
    {
      context.IsOnMembrane->push_back((polygon[i].Limits & 1u) != 0);
    }
  }
  const auto pointOf = [&points](std::size_t i) -> const ImagePoint& { return points[i].Point; };
  const bool turned = !(area > 0.0);
  if (context.IsOnMembrane)
  {
    context.Images->AddCell(points.size(), pointOf, turned, context.SourceCell, orientation);
  }
  else
  {
    this->Shared.AddCell(
      points.size(), pointOf, turned, context.SourceCell, orientation, *context.Images);
  }
}

//------------------------------------------------------------------------------
// Component along the plane's normal of the ray to the point where it is largest; only its sign
// matters. It vanishes where the primitive is seen edge-on.
double PrimitiveMapper::GetSlope(
  const Context& context, const std::vector<MappedPoint>& points) const
{
  double largest = 0.0;
  for (const MappedPoint& point : points)
  {
    const double slope = context.GetSlope(point.Point, this->Geometry.GetMembrane().GetOrigin());
    largest = std::fabs(slope) > std::fabs(largest) ? slope : largest;
  }
  return largest;
}

//------------------------------------------------------------------------------
// False if interpolation has found the primitive in a sub-cell that does not show it, which happens
// where rays are nearly parallel to the primitive, or at a caustic. Then a side does not meet the
// membrane there, the images of an end are elsewhere, or all corners are ends without an image.
bool PrimitiveMapper::IsSeen(const std::vector<MappedPoint>& points)
{
  const auto count = [&points](Finding finding)
  {
    return static_cast<std::size_t>(std::count_if(points.begin(), points.end(),
      [finding](const MappedPoint& point) { return point.Outcome == finding; }));
  };
  return count(Finding::Elsewhere) == 0 && count(Finding::EndWithoutImage) < points.size();
}

//------------------------------------------------------------------------------
void PrimitiveMapper::EmitLine(
  const Context& context, const SubCell& nodes, const Polygon& polygon) const
{
  const auto along = [](const Corner& c) { return c.Value[1] / (c.Value[1] + c.Value[2]); };
  const bool turned = along(polygon[0]) > along(polygon[1]);
  const Corner* const corners[2] = { &polygon[turned ? 1 : 0], &polygon[turned ? 0 : 1] };
  std::vector<MappedPoint> points;
  for (const Corner* corner : corners)
  {
    points.push_back(this->MakePoint(context, nodes, *corner));
  }
  if (!IsSeen(points))
  {
    return;
  }
  for (const Corner* corner : corners)
  {
    if (context.IsOnMembrane)
    {
      context.IsOnMembrane->push_back((corner->Limits & 1u) != 0);
    }
  }
  context.Images->AddCell(
    points.size(), [&points](std::size_t i) { return points[i].Point; }, false, context.SourceCell,
    1);
}

//------------------------------------------------------------------------------
// Image at a clipped corner: interpolation gives the initial guess, and the features that the
// corner lies on decide which equation is solved. Corners of sub-cells are exact already.
PrimitiveMapper::MappedPoint PrimitiveMapper::MakePoint(
  const Context& context, const SubCell& nodes, const Corner& corner) const
{
  const ClippedBoundary on = context.FindBoundary(corner);
  if (on.Membrane)
  {
    return this->MakeCrossing(context, nodes, corner, on);
  }
  if (on.End >= 0)
  {
    return this->MakeEnd(context, nodes, on.End, corner.B);
  }
  if (on.Node >= 0 && on.Side < 0)
  {
    // All coordinates have the same sign here.
    double exact[PrimitiveConstraints];
    context.Measure(nodes[static_cast<std::size_t>(on.Node)].From, exact);
    const glm::dvec3 value(exact[1], exact[2], exact[3]);
    const glm::dvec3 weight = glm::max(value / (value.x + value.y + value.z), glm::dvec3(0.0));
    return { this->Finish(context, nodes[static_cast<std::size_t>(on.Node)].From.At,
               context.GetPoint(weight), weight),
      Finding::Found };
  }
  return this->MakeOnSide(context, nodes, static_cast<std::size_t>(on.Side),
    this->FindRay(context, nodes, corner, on), corner.B);
}

//------------------------------------------------------------------------------
// Image of the point in which a ray meets a side of the primitive. Beyond the end of the side, the
// result is the image of that end.
PrimitiveMapper::MappedPoint PrimitiveMapper::MakeOnSide(const Context& context,
  const SubCell& nodes, std::size_t side, const RefractedPoint& from,
  const glm::dvec2& interpolated) const
{
  const Context::Side& on = context.Sides[side];
  const double l = GetParameter(on.Line, from);
  const auto first = static_cast<glm::length_t>((side + (on.Turned ? 1 : 0)) % 3);
  const auto last = static_cast<glm::length_t>((side + (on.Turned ? 0 : 1)) % 3);
  if (!(l > 0.0 && l < 1.0))
  {
    return this->MakeEnd(context, nodes, l < 0.5 ? first : last, interpolated);
  }
  glm::dvec3 weight(0.0);
  weight[first] = 1.0 - l;
  weight[last] = l;
  const glm::dvec3 place = on.Line.GetPoint(l);
  if (context.IsOnMembrane && this->IsInFront(nodes, from, place))
  {
    // Seen nearly edge-on: the part behind ends on this side, before it comes to the ray.
    return this->MakeSideCrossing(context, nodes, side, interpolated, weight);
  }
  ImagePoint point = this->Finish(context, from.At, place, weight);
  if (glm::dot(place - from.At.Position, from.Ray) < 0.0)
  {
    // Where the primitive meets the membrane, interpolation may include a small piece of the part
    // in front.
    point.Vertex.Position = place + this->Geometry.GetMembrane().GetOrigin();
    point.Vertex.SightPoint = point.Vertex.Position;
    point.Vertex.Depth = 0.0;
  }
  return { point, Finding::Found };
}

//------------------------------------------------------------------------------
// Sight point of an end of the primitive in the sub-cell or next to it. Returns false if there is
// none; `at` is then the guess.
bool PrimitiveMapper::SolveEnd(
  const Context& context, const SubCell& nodes, std::size_t end, PatchPoint& at) const
{
  // The guess is in the sub-cell, so the search is a short one and stays near it.
  constexpr int steps = 10;
  constexpr double reach = 0.5;
  const glm::dvec2 guess = GuessSight(nodes, context.Corners[end]);
  at = context.Patch->Evaluate(guess);
  const SightRoot root =
    this->Geometry.MakeEquation(context.Corners[end]).Solve(*context.Patch, guess, steps, reach);
  const bool isFound = root.End == SightRoot::End::Converged &&
    glm::length(root.At.Position - at.Position) <= GetSize(nodes);
  at = isFound ? root.At : at;
  return isFound;
}

//------------------------------------------------------------------------------
// Image of an end of the primitive: the known image that is seen in the sub-cell or next to it. If
// all images of the end are elsewhere, the piece is not seen here: near a silhouette or near total
// reflection the interpolated rays of the sub-cell meet the primitive and the refracted rays do
// not. Near a caustic there may be no image at all; then the end is drawn at the interpolated
// place. An end in front has the position that all other primitives use, unless it is away from the
// membrane and seen elsewhere: the ray has left the interior before it meets the end, and the piece
// goes on to the image of the end. The result does not depend on the primitive's plane.
PrimitiveMapper::MappedPoint PrimitiveMapper::MakeEnd(const Context& context, const SubCell& nodes,
  glm::length_t end, const glm::dvec2& interpolated, bool isOnMembrane) const
{
  const auto index = static_cast<std::size_t>(end);
  const glm::dvec3 middle =
    context.Patch->Evaluate(interpolated).Position + this->Geometry.GetMembrane().GetOrigin();
  const double size = GetSize(nodes);
  glm::dvec3 weight(0.0);
  weight[end] = 1.0;
  const KnownImages& known = context.Primitive.Images[index];
  const ImagePoint* nearest = std::min_element(known.First, known.First + known.Count,
    [&middle](const ImagePoint& a, const ImagePoint& b) {
      return glm::length(a.Vertex.SightPoint - middle) < glm::length(b.Vertex.SightPoint - middle);
    });
  const bool hasImage = known.Count > 0 && nearest->Vertex.Facet != CurvedPatches::NoFacet;
  if (hasImage && glm::length(nearest->Vertex.SightPoint - middle) <= size)
  {
    ImagePoint point;
    point.Vertex = nearest->Vertex;
    point.SetSource(context.Primitive.Ids, weight);
    return { point, Finding::Found };
  }
  PatchPoint at;
  const bool isFound = this->SolveEnd(context, nodes, index, at);
  if (isFound && context.IsOnMembrane && !context.IsLine &&
    this->IsInFront(nodes, RefractAt(at, this->Geometry.GetMedia()), context.Corners[index]))
  {
    return { {}, Finding::InFront };
  }
  ImagePoint point = this->Finish(context, at, context.Corners[index], weight);
  const glm::dvec3& own = context.Primitive.Corners[index];
  const double sine = GetSineAtEye(this->Geometry, own, point.Vertex.Position);
  if (known.Count > 0 && !hasImage && (!isFound || isOnMembrane || sine <= this->Tolerance))
  {
    point.Vertex.Position = own;
  }
  const Finding without = hasImage ? Finding::Elsewhere : Finding::EndWithoutImage;
  return { point, isFound ? Finding::Found : without };
}

//------------------------------------------------------------------------------
// Point where the primitive meets the membrane: a side of the sub-cell meets the primitive's plane,
// or a side of the primitive meets the patch. If the first point lies beyond a side of the
// primitive, it is replaced by the second.
PrimitiveMapper::MappedPoint PrimitiveMapper::MakeCrossing(const Context& context,
  const SubCell& nodes, const Corner& corner, const ClippedBoundary& on) const
{
  glm::dvec3 weight = context.IsLine
    ? glm::dvec3(corner.Value[2], corner.Value[1], 0.0)
    : glm::dvec3(corner.Value[1], corner.Value[2], corner.Value[3]);
  weight /= weight.x + weight.y + weight.z;
  int side = on.Side;
  if (on.Edge < 0 && side < 0)
  {
    const PatchPoint at = context.Patch->Evaluate(corner.B); // the ray is in the primitive's plane
    weight = glm::max(context.GetWeight(at.Position), glm::dvec3(0.0));
    return { this->Finish(context, at, at.Position, weight), Finding::Found };
  }
  if (on.Edge >= 0 && side < 0)
  {
    const SubCellNode& a = nodes[static_cast<std::size_t>((on.Edge + 1) % 3)];
    const SubCellNode& b = nodes[static_cast<std::size_t>((on.Edge + 2) % 3)];
    const RefractedPoint from = MeetPlane(SubCellSide(*context.Patch, a.B, b.B),
      this->Geometry.GetMedia(), context.Corners[0], context.Normal, a.From, b.From);
    weight = context.GetWeight(from.At.Position);
    const glm::length_t least =
      weight.x < weight.y ? (weight.x < weight.z ? 0 : 2) : (weight.y < weight.z ? 1 : 2);
    if (weight[least] >= 0.0)
    {
      return { this->Finish(context, from.At, from.At.Position, weight), Finding::Found };
    }
    side = static_cast<int>(least) + 1;
  }
  return this->MakeSideCrossing(context, nodes, static_cast<std::size_t>(side), corner.B, weight);
}

//------------------------------------------------------------------------------
// The crossing is found from a guess, and then solved again from a start that is the same for all
// guesses in the patch: every primitive with this side gets the same point.
PrimitiveMapper::MappedPoint PrimitiveMapper::MakeSideCrossing(const Context& context,
  const SubCell& nodes, std::size_t side, const glm::dvec2& guess, const glm::dvec3& weight) const
{
  const Context::Side& on = context.Sides[side];
  const auto first = static_cast<glm::length_t>((side + (on.Turned ? 1 : 0)) % 3);
  const auto last = static_cast<glm::length_t>((side + (on.Turned ? 0 : 1)) % 3);
  double l = weight[last] / (weight[first] + weight[last]);
  glm::dvec2 b = guess;
  std::int32_t facet = context.Facet;
  CurvedPatch patch = *context.Patch;
  const PatchPoint start = patch.Evaluate(guess);
  if (!this->StaysAlong(patch, nodes, on.Line, l, b))
  {
    if (!this->Geometry.MeetLine(on.Line, start.Normal, facet, b, l))
    {
      return { {}, Finding::Elsewhere };
    }
    patch = this->Geometry.GetPatches().GetPatch(facet);
    MeetPatchAgain(patch, on.Line, b, l);
  }
  const PatchPoint at = patch.Evaluate(b);
  if (glm::length(at.Position - start.Position) > GetSize(nodes))
  {
    return { {}, Finding::Elsewhere };
  }
  if (!(l > 0.0 && l < 1.0))
  {
    return this->MakeEnd(context, nodes, l < 0.5 ? first : last, guess, true);
  }
  glm::dvec3 place(0.0);
  place[first] = 1.0 - l;
  place[last] = l;
  Context inPatch = context;
  inPatch.Facet = facet;
  inPatch.Patch = &patch;
  return { this->Finish(inPatch, at, on.Line.GetPoint(l), place), Finding::Found };
}

//------------------------------------------------------------------------------
ImagePoint PrimitiveMapper::Finish(const Context& context, const PatchPoint& at,
  const glm::dvec3& local, const glm::dvec3& weight) const
{
  SightPlace place;
  place.Facet = context.Facet;
  place.Root.At = at;
  ImagePoint point;
  point.Vertex = this->Geometry.MakeVertex(local, *context.Patch, place);
  point.SetSource(context.Primitive.Ids, weight);
  return point;
}

}
