// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/UnrefractedPart.h"

#include "Refraction/Images/FrontOutline.h"

#include <algorithm>
#include <array>
#include <vector>

namespace meniscus
{
namespace
{

// Smallest number of halvings for a primitive that crosses the membrane, and largest number along
// the membrane.
constexpr int FirstLevel = 2;
constexpr int LastLevel = 5;

// 2^-44 of a side, about the rounding of its ends.
constexpr int Bisections = 44;

// A thousandth of a side is enough to see whether a cut is straight.
constexpr int CoarseBisections = 10;

/** A place in the primitive, in barycentric coordinates. */
struct Place
{
  glm::dvec3 Weight;
  bool IsInFront;
};

class Cutter
{
public:
  Cutter(const CurvedMembraneSolver& geometry, double tolerance, const MappedTriangle& primitive,
    std::int64_t sourceCell, ImageMesh& images)
    : Geometry(geometry)
    , Tolerance(tolerance)
    , Primitive(primitive)
    , SourceCell(sourceCell)
    , Images(images)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->Corner[i] = primitive.Corners[i] - geometry.GetMembrane().GetOrigin();
    }
  }

  Place MakePlace(const glm::dvec3& weight) const
  {
    return { weight, this->Geometry.IsInFront(this->GetLocal(weight)) };
  }

  // A corner within the tolerance of the membrane may count to either side: the curve may have been
  // drawn on the other side of it, or its last piece may be missing.
  bool FindOutline(const std::array<Place, 3>& corner, const std::vector<WaterlinePiece>& waterline,
    std::vector<FrontOutline::Polygon>& polygons) const
  {
    unsigned near = 0;
    for (unsigned turned = 0; turned < 8; ++turned)
    {
      if (turned == 1)
      {
        near = this->FindNear(corner);
      }
      if ((turned & ~near) != 0)
      {
        continue;
      }
      std::array<glm::dvec3, 3> place = this->Primitive.Corners;
      std::array<bool, 3> isFront;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const bool isTurned = (turned >> k & 1u) != 0;
        isFront[k] = corner[k].IsInFront != isTurned;
        if (isTurned && isFront[k])
        {
          place[k] = this->FindSeenPlace(k);
        }
      }
      if (FrontOutline(waterline, place, isFront).Find(polygons))
      {
        return true;
      }
    }
    return false;
  }

  void CutTriangle(const std::array<Place, 3>& corner, int level) const
  {
    std::array<Place, 3> middle; // opposite the corners
    bool same =
      corner[0].IsInFront == corner[1].IsInFront && corner[0].IsInFront == corner[2].IsInFront;
    for (std::size_t k = 0; k < 3; ++k)
    {
      middle[k] = this->MakePlace(0.5 * (corner[(k + 1) % 3].Weight + corner[(k + 2) % 3].Weight));
      same = same && middle[k].IsInFront == corner[0].IsInFront;
    }
    if (level == LastLevel || (level >= FirstLevel && (same || this->IsCutStraight(corner))))
    {
      this->AddPolygon({ corner.begin(), corner.end() });
      return;
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->CutTriangle({ corner[k], middle[(k + 2) % 3], middle[(k + 1) % 3] }, level + 1);
    }
    this->CutTriangle(middle, level + 1);
  }

  void CutLine(const Place& from, const Place& to, int level) const
  {
    if (level < LastLevel)
    {
      const Place middle = this->MakePlace(0.5 * (from.Weight + to.Weight));
      this->CutLine(from, middle, level + 1);
      this->CutLine(middle, to, level + 1);
      return;
    }
    const Place crossing = from.IsInFront != to.IsInFront ? this->Cross(from, to) : from;
    const Place& begin = from.IsInFront ? from : crossing;
    const Place& end = to.IsInFront ? to : crossing;
    if (begin.IsInFront && end.IsInFront)
    {
      this->AddCell({ this->MakePoint(begin.Weight), this->MakePoint(end.Weight) });
    }
  }

  void AddCell(const std::vector<TrianglePoint>& corners) const
  {
    const auto pointOf = [this, &corners](std::size_t i)
    {
      const TrianglePoint& corner = corners[i];
      ImagePoint point;
      point.Vertex = this->Geometry.PassThrough(this->GetLocal(corner.Weight));
      point.Vertex.Position = corner.Position;
      point.Vertex.SightPoint = corner.Position;
      point.SetSource(this->Primitive.Ids, corner.Weight);
      return point;
    };
    this->Images.AddCell(corners.size(), pointOf, false, this->SourceCell, 1);
  }

private:
  // A point of the primitive; its corners are used unchanged.
  TrianglePoint MakePoint(const glm::dvec3& weight) const
  {
    for (glm::length_t k = 0; k < 3; ++k)
    {
      if (weight[k] == 1.0)
      {
        return { weight, this->Primitive.Corners[static_cast<std::size_t>(k)] };
      }
    }
    return { weight, this->GetLocal(weight) + this->Geometry.GetMembrane().GetOrigin() };
  }

  glm::dvec3 GetLocal(const glm::dvec3& w) const
  {
    return w.x * this->Corner[0] + w.y * this->Corner[1] + w.z * this->Corner[2];
  }

  // Position of a corner behind the membrane that counts as in front of it: that of its image,
  // which the pieces behind the membrane use. Near the critical angle even a corner next to the
  // membrane has its image elsewhere; such a corner keeps its own position.
  glm::dvec3 FindSeenPlace(std::size_t k) const
  {
    const glm::dvec3& own = this->Primitive.Corners[k];
    const KnownImages& images = this->Primitive.Images[k];
    const auto getAngle = [this, &own](const ImagePoint& image)
    { return GetSineAtEye(this->Geometry, own, image.Vertex.Position); };
    const ImagePoint* nearest = std::min_element(images.First, images.First + images.Count,
      [&getAngle](const ImagePoint& a, const ImagePoint& b) { return getAngle(a) < getAngle(b); });
    // The corner is within one tolerance of the membrane, where image and place coincide.
    // Refraction at oblique incidence moves the image by a few times that.
    constexpr double most = 4.0;
    return images.Count > 0 && getAngle(*nearest) <= most * this->Tolerance
      ? nearest->Vertex.Position
      : own;
  }

  // Bit mask of the corners that change sides after a step of the tolerance into the triangle.
  unsigned FindNear(const std::array<Place, 3>& corner) const
  {
    unsigned near = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const glm::dvec3 middle = 0.5 * (corner[(k + 1) % 3].Weight + corner[(k + 2) % 3].Weight);
      const glm::dvec3 way = middle - corner[k].Weight;
      const glm::dvec3 from = this->GetLocal(corner[k].Weight);
      const double length = glm::length(this->GetLocal(middle) - from);
      const double step = this->Tolerance * glm::length(from - this->Geometry.GetMedia().Eye);
      const double part = step < length ? step / length : 1.0;
      const bool isOther =
        this->MakePlace(corner[k].Weight + part * way).IsInFront != corner[k].IsInFront;
      near |= isOther ? 1u << k : 0u;
    }
    return near;
  }

  // True if the membrane passes the middle of the straight cut within the tolerance.
  bool IsCutStraight(const std::array<Place, 3>& corner) const
  {
    std::size_t odd = 0; // the corner that is alone on its side of the membrane
    while (odd < 3 && corner[odd].IsInFront == corner[(odd + 1) % 3].IsInFront)
    {
      ++odd;
    }
    if (odd == 3)
    {
      return false;
    }
    odd = corner[odd].IsInFront == corner[(odd + 2) % 3].IsInFront ? (odd + 1) % 3 : odd;
    const Place& alone = corner[odd];
    const Place first = this->Cross(alone, corner[(odd + 1) % 3], CoarseBisections);
    const Place second = this->Cross(alone, corner[(odd + 2) % 3], CoarseBisections);
    const glm::dvec3 middle = 0.5 * (first.Weight + second.Weight);
    const glm::dvec3 way = alone.Weight - middle;
    const double length = glm::length(this->GetLocal(alone.Weight) - this->GetLocal(middle));
    const double allowed =
      this->Tolerance * glm::length(this->GetLocal(middle) - this->Geometry.GetMedia().Eye);
    if (length <= allowed)
    {
      return true;
    }
    const glm::dvec3 step = (allowed / length) * way;
    return this->MakePlace(middle + step).IsInFront == alone.IsInFront &&
      this->MakePlace(middle - step).IsInFront != alone.IsInFront;
  }

  // Last place in front of the membrane on the way between two places on different sides.
  Place Cross(const Place& a, const Place& b, int bisections = Bisections) const
  {
    Place front = a.IsInFront ? a : b;
    Place behind = a.IsInFront ? b : a;
    for (int i = 0; i < bisections; ++i)
    {
      const Place middle = this->MakePlace(0.5 * (front.Weight + behind.Weight));
      (middle.IsInFront ? front : behind) = middle;
    }
    return front;
  }

  void AddPolygon(const std::vector<Place>& polygon) const
  {
    std::vector<TrianglePoint> front;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Place& a = polygon[i];
      const Place& b = polygon[(i + 1) % polygon.size()];
      if (a.IsInFront)
      {
        front.push_back(this->MakePoint(a.Weight));
      }
      if (a.IsInFront != b.IsInFront)
      {
        front.push_back(this->MakePoint(this->Cross(a, b).Weight));
      }
    }
    if (front.size() > 2)
    {
      this->AddCell(front);
    }
  }

  const CurvedMembraneSolver& Geometry;
  double Tolerance;
  const MappedTriangle& Primitive;
  std::int64_t SourceCell;
  ImageMesh& Images;
  std::array<glm::dvec3, 3> Corner;
};

}

//------------------------------------------------------------------------------
void AddFrontOfTriangle(const CurvedMembraneSolver& geometry, double tolerance,
  const MappedTriangle& triangle, std::int64_t sourceCell,
  const std::vector<WaterlinePiece>& waterline, ImageMesh& images)
{
  const Cutter cutter(geometry, tolerance, triangle, sourceCell, images);
  const std::array<Place, 3> corners = { cutter.MakePlace({ 1.0, 0.0, 0.0 }),
    cutter.MakePlace({ 0.0, 1.0, 0.0 }), cutter.MakePlace({ 0.0, 0.0, 1.0 }) };
  std::vector<FrontOutline::Polygon> polygons;
  if (!cutter.FindOutline(corners, waterline, polygons))
  {
    cutter.CutTriangle(corners, 0);
    return;
  }
  for (const FrontOutline::Polygon& polygon : polygons)
  {
    cutter.AddCell(polygon);
  }
}

//------------------------------------------------------------------------------
void AddFrontOfLine(const CurvedMembraneSolver& geometry, const MappedTriangle& line,
  std::int64_t sourceCell, ImageMesh& images)
{
  const Cutter cutter(geometry, 0.0, line, sourceCell, images);
  cutter.CutLine(cutter.MakePlace({ 1.0, 0.0, 0.0 }), cutter.MakePlace({ 0.0, 1.0, 0.0 }), 0);
}

//------------------------------------------------------------------------------
double GetSineAtEye(
  const CurvedMembraneSolver& geometry, const glm::dvec3& first, const glm::dvec3& second)
{
  const glm::dvec3 way = (first - geometry.GetMembrane().GetOrigin()) - geometry.GetMedia().Eye;
  const glm::dvec3 seen = way + (second - first);
  return glm::length(glm::cross(way, seen)) / (glm::length(way) * glm::length(seen));
}

}
